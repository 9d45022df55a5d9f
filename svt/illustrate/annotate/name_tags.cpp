#include <svt/illustrate/annotate/name_tags.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/image/text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace svt::illustrate {
namespace {

using image::Image;
using volume::Label;

// For each label, the pixel farthest from the label's outline, and that distance.
std::vector<std::pair<int, std::int32_t>> innermostPixels(const image::Image<volume::Scalar>& seen,
                                                          const std::vector<std::uint32_t>& labelOf,
                                                          std::size_t labelCount) {
    const std::int32_t width = seen.width(), height = seen.height();
    const auto place = [&](std::int32_t x, std::int32_t y) {
        return static_cast<std::size_t>(x) + static_cast<std::size_t>(width) * static_cast<std::size_t>(y);
    };
    const auto labelAt = [&](std::int32_t x, std::int32_t y) { return labelOf[seen.at(x, y)]; };
    std::vector<int> far(seen.pixels().size(), 1);
    // Chamfer distance transform to the nearest other label, with weights 2 and 3, forward and backward pass (Borgefors
    // 1986).
    const auto relax = [&](std::int32_t x, std::int32_t y, std::int32_t dx, std::int32_t dy, int step) {
        const std::int32_t i = x + dx, j = y + dy;
        const bool isInside = i >= 0 && j >= 0 && i < width && j < height && labelAt(i, j) == labelAt(x, y);
        far[place(x, y)] = std::min(far[place(x, y)], isInside ? far[place(i, j)] + step : step);
    };
    std::fill(far.begin(), far.end(), width + height);
    for (std::int32_t y = 0; y < height; ++y)
        for (std::int32_t x = 0; x < width; ++x) {
            relax(x, y, -1, 0, 2);
            relax(x, y, 0, -1, 2);
            relax(x, y, -1, -1, 3);
            relax(x, y, 1, -1, 3);
        }
    std::vector<std::pair<int, std::int32_t>> best(labelCount, {0, -1});
    for (std::int32_t y = height - 1; y >= 0; --y)
        for (std::int32_t x = width - 1; x >= 0; --x) {
            relax(x, y, 1, 0, 2);
            relax(x, y, 0, 1, 2);
            relax(x, y, 1, 1, 3);
            relax(x, y, -1, 1, 3);
            const std::uint32_t label = labelAt(x, y);
            if (label < labelCount && far[place(x, y)] > best[label].first)
                best[label] = {far[place(x, y)], static_cast<std::int32_t>(place(x, y))};
        }
    return best;
}

// Range of pixel columns that are not background; the whole width if all are.
std::pair<double, double> columnsOf(const image::Image<volume::Scalar>& seen) {
    std::int32_t left = seen.width(), right = 0;
    for (std::int32_t y = 0; y < seen.height(); ++y)
        for (std::int32_t x = 0; x < seen.width(); ++x) {
            if (seen.at(x, y) == 0) continue;
            left = std::min(left, x);
            right = std::max(right, x + 1);
        }
    if (left < right) return {left, right};
    return {0, seen.width()};
}

// Number of pixels with one label from each pixel to the right.
image::Image<std::int32_t> runLengths(const image::Image<volume::Scalar>& seen,
                                      const std::vector<std::uint32_t>& labelOf) {
    image::Image<std::int32_t> lengths(seen.width(), seen.height());
    for (std::int32_t y = 0; y < seen.height(); ++y)
        for (std::int32_t x = seen.width() - 1; x >= 0; --x) {
            const bool goesOn = x + 1 < seen.width() && labelOf[seen.at(x, y)] == labelOf[seen.at(x + 1, y)];
            lengths.at(x, y) = goesOn ? lengths.at(x + 1, y) + 1 : 1;
        }
    return lengths;
}

// Finds places where texts fit into the labels that they name.
class RoomFinder {
public:
    RoomFinder(const image::Image<volume::Scalar>& seen, const std::vector<std::uint32_t>& labelOf)
        : seen_(seen), labelOf_(labelOf), lengths_(runLengths(seen, labelOf)) {}

    // Moves a tag to the place nearest to it where its text fits within `label`.
    void placeInside(std::uint32_t label, double textHeight, NameTag& tag) const {
        const auto width = static_cast<std::int32_t>(std::ceil(image::textWidth(tag.text, textHeight) + textHeight));
        const auto height = static_cast<std::int32_t>(std::ceil(1.3 * textHeight));
        // Within this reach of the innermost pixel; a name far away from it would look lost.
        const auto reach = static_cast<std::int32_t>(4 * textHeight);
        double nearest = 1e300;
        const double x = tag.x, y = tag.y;
        for (std::int32_t dy = -reach; dy <= reach; dy += 2)
            for (std::int32_t dx = -reach; dx <= reach; dx += 2) {
                const double distance = double(dx) * dx + double(dy) * dy;
                const auto left = static_cast<std::int32_t>(x) + dx - width / 2;
                const auto top = static_cast<std::int32_t>(y) + dy - height / 2;
                if (distance >= nearest || !isFree(left, top, width, height, label)) continue;
                nearest = distance;
                tag.isInside = true;
                tag.x = left + width / 2.0;
                tag.y = top + height / 2.0;
            }
    }

private:
    [[nodiscard]] bool isFree(std::int32_t left, std::int32_t top, std::int32_t width, std::int32_t height,
                              std::uint32_t label) const {
        if (left < 0 || top < 0 || left + width > seen_.width() || top + height > seen_.height()) return false;
        for (std::int32_t y = top; y < top + height; ++y)
            if (labelOf_[seen_.at(left, y)] != label || lengths_.at(left, y) < width) return false;
        return true;
    }

    const image::Image<volume::Scalar>& seen_;
    const std::vector<std::uint32_t>& labelOf_;
    image::Image<std::int32_t> lengths_;
};

// Heights of the texts of one side, top down, without overlaps, each as close to its leader's end as possible.
std::vector<double> heightsOf(const std::vector<NameTag>& tags, double line, double height) {
    std::vector<double> at;
    double least = line;
    for (const NameTag& tag : tags) {
        at.push_back(std::max(tag.y, least));
        least = at.back() + line;
    }
    double most = height - line;
    for (std::size_t n = at.size(); n > 0 && at[n - 1] > most; --n, most -= line) at[n - 1] = most;
    return at;
}

// The names of one side of a picture. x counts from that side inwards.
struct Side {
    std::vector<NameTag> tags;
    bool isRight = false;
    double textEdge = 0;     // where texts end, in x
    double knee = 0;         // where leaders bend, in x
    std::vector<double> at;  // heights of the texts

    [[nodiscard]] double inwards(double x, double pictureWidth) const { return isRight ? pictureWidth - x : x; }
};

// Keeps what there is room for, and gives each place the tag whose leader crosses no other.
void arrange(Side& side, const NameTags& tags, double pictureWidth, double pictureHeight) {
    const double height = tags.textHeight, line = 1.35 * height;
    const auto most = static_cast<std::size_t>(std::max(0.0, pictureHeight / line - 1));
    std::stable_sort(side.tags.begin(), side.tags.end(),
                     [](const NameTag& a, const NameTag& b) { return a.clearance > b.clearance; });
    if (side.tags.size() > most) side.tags.resize(most);
    std::stable_sort(side.tags.begin(), side.tags.end(), [](const NameTag& a, const NameTag& b) { return a.y < b.y; });
    side.at = heightsOf(side.tags, line, pictureHeight);

    double longest = 0;
    for (const NameTag& tag : side.tags) longest = std::max(longest, image::textWidth(tag.text, height));
    const double free = side.isRight ? pictureWidth - tags.right : tags.left;
    // Beside what is shown; over it only where there is next to no room.
    side.textEdge = std::min(std::max(free - 2.5 * height, 9 * height), height + longest);
    if (free - 2.5 * height > side.textEdge) side.textEdge = free - 2.5 * height;
    side.knee = side.textEdge + 1.35 * height;

    for (std::size_t place = 0; place < side.tags.size(); ++place) {
        const auto slope = [&](const NameTag& tag) {
            return (tag.y - side.at[place]) / std::max(1.0, side.inwards(tag.x, pictureWidth) - side.knee);
        };
        const auto first = side.tags.begin() + static_cast<std::ptrdiff_t>(place);
        const auto highest = std::min_element(first, side.tags.end(),
                                              [&](const NameTag& a, const NameTag& b) { return slope(a) < slope(b); });
        std::iter_swap(first, highest);
    }
}

}  // namespace

std::string shortened(const std::string& text, double width, double height) {
    if (image::textWidth(text, height) <= width) return text;
    std::string part = text;
    while (!part.empty()) {
        // By whole characters of UTF-8.
        while (part.size() > 1 && (static_cast<unsigned char>(part.back()) & 0xC0U) == 0x80U) part.pop_back();
        part.pop_back();
        if (image::textWidth(part + "\u2026", height) <= width) break;
    }
    return part + "\u2026";
}

double nameHeight(std::int32_t pictureHeight) noexcept { return std::max(11.0, pictureHeight / 50.0); }

double nameMargin(std::int32_t width, std::int32_t height) noexcept {
    return std::min(0.3, 14 * nameHeight(height) / width);
}

namespace {

// Entry per label: the feature that is named where the label is seen: the smallest selected one that stands for it.
// \param hasVoxels  per label; becomes true for features whose parts have voxels
std::vector<std::uint32_t> namedFeatures(const std::vector<std::uint32_t>& selected, const analyze::Extents& extents,
                                         std::vector<bool>& hasVoxels) {
    std::vector<std::uint32_t> named(hasVoxels.size());
    std::iota(named.begin(), named.end(), 0U);
    const auto wholes = extents.wholes(selected);
    std::vector<std::size_t> order(selected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wholes[a].size() > wholes[b].size(); });
    for (const std::size_t n : order)
        for (const std::uint32_t part : wholes[n]) {
            named[part] = selected[n];
            if (hasVoxels[part]) hasVoxels[selected[n]] = true;
        }
    return named;
}

}  // namespace

Result<NameTags> findNameTags(const std::vector<std::string>& queries, const volume::SemanticVolume& volume,
                              const analyze::LabelRows& rows, const render::Frame& frame) {
    const auto& labels = volume.labels.labels;
    std::vector<bool> isSelected(labels.size(), false);
    for (const std::string& query : queries) {
        SVT_TRY(selected, analyze::selectLabels(rows, query));
        for (const std::uint32_t l : *selected) isSelected[l] = true;
    }
    std::vector<std::uint32_t> all;
    std::vector<bool> hasVoxels;
    const auto boxes = analyze::labelBoxes(volume.columns, volume.labels);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (isSelected[l]) all.push_back(l);
        hasVoxels.push_back(!boxes[l].isEmpty());
    }
    const std::vector<std::uint32_t> named = namedFeatures(all, rows.extents(), hasVoxels);
    std::vector<std::uint32_t> labelOf = volume.labels.labelOfScalar();
    for (std::uint32_t& label : labelOf)
        if (label != volume::kNoLabel) label = named[label];
    const auto innermost = innermostPixels(frame.label, labelOf, labels.size());
    const RoomFinder room(frame.label, labelOf);
    NameTags result;
    result.textHeight = nameHeight(frame.label.height());
    std::tie(result.left, result.right) = columnsOf(frame.label);
    constexpr int kLeastSpot = 3;  // half pixels from the middle of a spot to its outline
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (!isSelected[l] || !hasVoxels[l]) continue;
        if (innermost[l].first < kLeastSpot) {
            ++result.hiddenCount;
            continue;
        }
        NameTag tag;
        tag.text = labels[l].name.empty() ? labels[l].id : labels[l].name;
        const std::int32_t row = innermost[l].second / frame.label.width();
        tag.x = innermost[l].second % frame.label.width() + 0.5;
        tag.y = row + 0.5;
        tag.clearance = innermost[l].first / 2.0;
        room.placeInside(static_cast<std::uint32_t>(l), result.textHeight, tag);
        result.tags.push_back(std::move(tag));
    }
    return result;
}

std::vector<Leader> layOutLeaders(const NameTags& tags, double width, double height) {
    Side sides[2];
    sides[1].isRight = true;
    for (const NameTag& tag : tags.tags)
        if (!tag.isInside) sides[tag.x < (tags.left + tags.right) / 2 ? 0 : 1].tags.push_back(tag);
    std::vector<Leader> leaders;
    for (Side& side : sides) {
        arrange(side, tags, width, height);
        for (std::size_t n = 0; n < side.tags.size(); ++n) {
            const NameTag& tag = side.tags[n];
            Leader leader;
            leader.text = shortened(tag.text, side.textEdge - tags.textHeight / 2, tags.textHeight);
            leader.isRight = side.isRight;
            leader.textLeft =
                side.isRight ? width - side.textEdge : side.textEdge - image::textWidth(leader.text, tags.textHeight);
            leader.x0 = side.inwards(side.knee, width);
            leader.y0 = side.at[n];
            leader.x1 = tag.x;
            leader.y1 = tag.y;
            leaders.push_back(std::move(leader));
        }
    }
    return leaders;
}

std::size_t drawNameTags(const NameTags& tags, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image) {
    const double height = tags.textHeight, stroke = std::max(1.0, height / 14);
    const std::vector<Leader> leaders = layOutLeaders(tags, image.width() - tags.taken, image.height());
    // Outlines below all lines, lines below all texts.
    for (const auto& [extra, tone] : {std::pair(2.4 * stroke, halo), std::pair(stroke, color)})
        for (const Leader& leader : leaders) {
            const double begin = leader.x0 + (leader.isRight ? height : -height);
            image::drawLine(image, begin, leader.y0, leader.x0, leader.y0, {extra, tone});
            image::drawLine(image, leader.x0, leader.y0, leader.x1, leader.y1, {extra, tone});
            image::drawDot(image, leader.x1, leader.y1, 0.17 * height + extra - stroke, tone);
        }
    const image::TextStyle style{height, color, halo, std::max(1.0, 0.14 * height)};
    std::size_t drawn = leaders.size();
    for (const Leader& leader : leaders) image::drawText(image, leader.textLeft, leader.y0, leader.text, style);
    for (const NameTag& tag : tags.tags) {
        if (!tag.isInside) continue;
        image::drawText(image, tag.x - image::textWidth(tag.text, height) / 2, tag.y, tag.text, style);
        ++drawn;
    }
    return drawn;
}

}  // namespace svt::illustrate
