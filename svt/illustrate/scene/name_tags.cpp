#include <svt/illustrate/scene/name_tags.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/image/text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
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

// Projects a point of world space to pixels; nothing if it is behind the viewer or outside the picture.
std::optional<std::pair<double, double>> seenAt(Vec3d point, const render::FrameSpec& spec) {
    const render::Camera& camera = spec.camera;
    const Vec3d forward = normalized(camera.target - camera.eye);
    const Vec3d right = normalized(cross(forward, normalized(camera.up))), up = cross(right, forward);
    const Vec3d from = point - camera.eye;
    const double depth = dot(from, forward);
    if (!(depth > 0)) return std::nullopt;
    const bool isPerspective = camera.projection == render::Camera::Projection::Perspective;
    const double half = isPerspective ? depth * std::tan(camera.verticalFovDegrees * std::numbers::pi / 360)
                                      : camera.orthographicHeight / 2;
    const double x = (dot(from, right) / (half * spec.width / spec.height) + 1) / 2 * spec.width;
    const double y = (1 - dot(from, up) / half) / 2 * spec.height;
    if (x < 0 || y < 0 || x >= spec.width || y >= spec.height) return std::nullopt;
    return std::pair(x, y);
}

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

}  // namespace

Result<NameTags> findNameTags(const std::vector<std::string>& queries, const volume::SemanticVolume& volume,
                              const analyze::LabelRows& rows, const render::FrameSpec& spec,
                              const render::Frame& frame) {
    const auto& labels = volume.labels.labels;
    std::vector<bool> isSelected(labels.size(), false);
    for (const std::string& query : queries) {
        const auto selected = analyze::selectLabels(rows, query);
        if (!selected) return selected.error();
        for (const std::uint32_t l : *selected) isSelected[l] = true;
    }
    std::vector<std::uint32_t> labelOf = volume.labels.labelOfScalar();
    const auto best = innermostPixels(frame.label, labelOf, labels.size());
    const auto boxes = analyze::labelBoxes(volume.columns, volume.labels);
    NameTags result;
    std::tie(result.left, result.right) = columnsOf(frame.label);
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (!isSelected[l]) continue;
        NameTag tag{labels[l].name.empty() ? labels[l].id : labels[l].name, 0, 0, best[l].second < 0};
        if (!tag.isHidden) {
            const auto column = best[l].second % frame.label.width(), row = best[l].second / frame.label.width();
            tag.x = column + 0.5;
            tag.y = row + 0.5;
        } else {
            const analyze::SampleBox& box = boxes[l];
            if (box.isEmpty()) continue;
            Vec3d middle;
            for (int axis = 0; axis < 3; ++axis) middle[axis] = (double(box.min[axis]) + box.max[axis]) / 2;
            const auto seen = seenAt(volume.grid.worldFromIndex(middle), spec);
            if (!seen) continue;
            std::tie(tag.x, tag.y) = *seen;
        }
        result.tags.push_back(std::move(tag));
    }
    return result;
}

std::size_t drawNameTags(const NameTags& tags, double textHeight, Vec3f color, Vec3f halo,
                         image::Image<image::Rgba8>& image) {
    const double height = textHeight > 0 ? textHeight : std::max(11.0, image.height() / 50.0);
    const double line = 1.35 * height, margin = height, stroke = std::max(1.0, height / 14);
    std::vector<NameTag> sides[2];
    for (const NameTag& tag : tags.tags) sides[tag.x < (tags.left + tags.right) / 2 ? 0 : 1].push_back(tag);
    const auto most = static_cast<std::size_t>(std::max(0.0, image.height() / line - 1));
    std::size_t drawn = 0;
    for (int side = 0; side < 2; ++side) {
        auto& ofSide = sides[side];
        std::stable_sort(ofSide.begin(), ofSide.end(), [](const NameTag& a, const NameTag& b) { return a.y < b.y; });
        if (ofSide.size() > most) ofSide.resize(most);
        const std::vector<double> at = heightsOf(ofSide, line, image.height());
        for (std::size_t n = 0; n < ofSide.size(); ++n, ++drawn) {
            const NameTag& tag = ofSide[n];
            const double width = image::textWidth(tag.text, height);
            const double left = side == 0 ? std::max(margin, tags.left - 2.5 * height - width)
                                          : std::min(image.width() - margin - width, tags.right + 2.5 * height);
            const double end = side == 0 ? left + width + 0.35 * height : left - 0.35 * height;
            const double knee = end + (side == 0 ? height : -height);
            for (const auto& [extra, tone] : {std::pair(2.4 * stroke, halo), std::pair(stroke, color)}) {
                image::drawLine(image, end, at[n], knee, at[n], {extra, tone});
                image::drawLine(image, knee, at[n], tag.x, tag.y, {extra, tone});
                image::drawDot(image, tag.x, tag.y, 0.17 * height + extra - stroke, tone);
            }
            // A ring instead of a dot if the component is hidden.
            if (tag.isHidden) image::drawDot(image, tag.x, tag.y, 0.17 * height - stroke, halo);
            image::drawText(image, left, at[n], tag.text, {height, color, halo, std::max(1.0, 0.14 * height)});
        }
    }
    return drawn;
}

}  // namespace svt::illustrate
