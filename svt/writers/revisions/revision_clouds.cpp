#include <svt/writers/revisions/revision_clouds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using CloudRing = RevisionMarks::Path;

constexpr double kSquare = 0.5;                                // millimetres: sides of the squares that find a cloud
constexpr double kAroundLines = 4;                             // millimetres between changed lines and their cloud
constexpr double kChord = 6;                                   // millimetres
constexpr double kMostSquares = 4e7;                           // larger drawings have larger squares
constexpr int kSmoothed = 5;                                   // corners of squares on each side that are averaged
constexpr double kTagSide = 7, kTagText = 2.2, kTagGap = 1.2;  // millimetres
constexpr std::size_t kTagsPerRow = 6;
constexpr std::uint8_t kThin = 1, kBold = 4, kTaken = 60;  // weights of obstacles, per square
constexpr std::uint32_t kNoCloud = 0xFFFFFFFFu;

// The squares of a drawing that lie within clouds.
class CloudRaster {
public:
    CloudRaster(RevisionObstacle box, double square) : square_(square), low_(box.low) {
        width_ = static_cast<std::int64_t>(std::ceil((box.high.u - box.low.u) / square)) + 2;
        height_ = static_cast<std::int64_t>(std::ceil((box.high.v - box.low.v) / square)) + 2;
        low_ = {low_.u - square, low_.v - square};
        inside_.assign(std::size_t(width_ * height_), 0);
        weights_.assign(inside_.size(), 0);
        const auto reach = static_cast<std::int64_t>(std::ceil(kAroundLines / square));
        for (std::int64_t y = -reach; y <= reach; ++y)
            for (std::int64_t x = -reach; x <= reach; ++x)
                if (std::hypot(double(x), double(y)) * square <= kAroundLines) disc_.emplace_back(x, y);
    }

    // The square at a point.
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> squareAt(PlanePoint p) const noexcept {
        return {static_cast<std::int64_t>(std::floor((p.u - low_.u) / square_)),
                static_cast<std::int64_t>(std::floor((p.v - low_.v) / square_))};
    }
    [[nodiscard]] bool isInside(std::int64_t x, std::int64_t y) const noexcept {
        return isWithin(x, y) && inside_[index(x, y)] != 0;
    }
    [[nodiscard]] PlanePoint cornerAt(std::int64_t x, std::int64_t y) const noexcept {
        return {low_.u + double(x) * square_, low_.v + double(y) * square_};
    }

    template <class Visit>
    void forEachSquareOf(PlanePoint from, PlanePoint to, const Visit& visit) const {
        const auto steps = static_cast<std::int64_t>(std::hypot(to.u - from.u, to.v - from.v) / square_) + 1;
        for (std::int64_t n = 0; n <= steps; ++n) {
            const double t = double(n) / double(steps);
            visit(squareAt({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)}));
        }
    }

    // Lines and texts that triangles keep clear.
    void addObstacle(PlanePoint from, PlanePoint to, std::uint8_t weight) {
        forEachSquareOf(from, to, [&](std::pair<std::int64_t, std::int64_t> at) {
            if (isWithin(at.first, at.second))
                weights_[index(at.first, at.second)] = std::max(weights_[index(at.first, at.second)], weight);
        });
    }
    void addObstacle(const RevisionObstacle& box, std::uint8_t weight) {
        const auto low = squareAt(box.low), high = squareAt(box.high);
        for (std::int64_t y = std::max<std::int64_t>(0, low.second); y <= std::min(high.second, height_ - 1); ++y)
            for (std::int64_t x = std::max<std::int64_t>(0, low.first); x <= std::min(high.first, width_ - 1); ++x)
                weights_[index(x, y)] = std::max(weights_[index(x, y)], weight);
    }
    [[nodiscard]] double weightIn(const RevisionObstacle& box) const {
        const auto low = squareAt(box.low), high = squareAt(box.high);
        double weight = 0;
        for (std::int64_t y = std::max<std::int64_t>(0, low.second); y <= std::min(high.second, height_ - 1); ++y)
            for (std::int64_t x = std::max<std::int64_t>(0, low.first); x <= std::min(high.first, width_ - 1); ++x)
                weight += weights_[index(x, y)];
        return weight;
    }

    void addLine(PlanePoint from, PlanePoint to) {
        forEachSquareOf(from, to, [&](std::pair<std::int64_t, std::int64_t> at) {
            if (at == last_) return;
            last_ = at;
            for (const auto& [x, y] : disc_)
                if (at.first + x > 0 && at.second + y > 0 && at.first + x + 1 < width_ && at.second + y + 1 < height_)
                    inside_[index(at.first + x, at.second + y)] = 1;
        });
    }

    // A cloud also owns the places that it encloses.
    void fillHoles() {
        std::vector<char> isOutside(inside_.size(), 0);
        std::vector<std::size_t> open{0};
        isOutside[0] = 1;
        forEachConnected(open, [&](std::size_t next) {
            if (inside_[next] != 0 || isOutside[next] != 0) return false;
            isOutside[next] = 1;
            return true;
        });
        for (std::size_t n = 0; n < inside_.size(); ++n) inside_[n] = isOutside[n] == 0 ? 1 : 0;
    }

    // Numbers the clouds, and returns the outline of each.
    std::vector<CloudRing> trace() {
        cloudOf_.assign(inside_.size(), kNoCloud);
        std::vector<CloudRing> outlines;
        for (std::size_t n = 0; n < inside_.size(); ++n) {
            if (inside_[n] == 0 || cloudOf_[n] != kNoCloud) continue;
            const auto number = static_cast<std::uint32_t>(outlines.size());
            cloudOf_[n] = number;
            std::vector<std::size_t> open{n};
            forEachConnected(open, [&](std::size_t next) {
                if (inside_[next] == 0 || cloudOf_[next] != kNoCloud) return false;
                cloudOf_[next] = number;
                return true;
            });
            outlines.push_back(outlineFrom(std::int64_t(n) % width_, std::int64_t(n) / width_));
        }
        return outlines;
    }
    [[nodiscard]] std::uint32_t cloudAt(std::int64_t x, std::int64_t y) const noexcept {
        return isWithin(x, y) ? cloudOf_[index(x, y)] : kNoCloud;
    }

private:
    [[nodiscard]] bool isWithin(std::int64_t x, std::int64_t y) const noexcept {
        return x >= 0 && y >= 0 && x < width_ && y < height_;
    }
    [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const noexcept {
        return std::size_t(y * width_ + x);
    }

    // Visits the squares that share sides, as long as `enter` takes them.
    template <class Enter>
    void forEachConnected(std::vector<std::size_t>& open, const Enter& enter) const {
        while (!open.empty()) {
            const auto at = std::int64_t(open.back());
            open.pop_back();
            const std::int64_t x = at % width_, y = at / width_;
            for (const auto& [a, b] :
                 {std::pair(x - 1, y), std::pair(x + 1, y), std::pair(x, y - 1), std::pair(x, y + 1)})
                if (isWithin(a, b) && enter(index(a, b))) open.push_back(index(a, b));
        }
    }

    // The outline along the sides of squares, counter-clockwise, from the lower left corner of the first square of the lowest
    // row. Squares that share only a corner are apart.
    [[nodiscard]] CloudRing outlineFrom(std::int64_t x, std::int64_t y) const {
        // By direction right, up, left, down: the squares ahead on the left and on the right, from the corner.
        constexpr std::array<std::array<std::int64_t, 2>, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        constexpr std::array<std::array<std::int64_t, 2>, 4> kLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
        constexpr std::array<std::array<std::int64_t, 2>, 4> kRight{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
        CloudRing path;
        std::int64_t cornerX = x, cornerY = y;
        std::size_t direction = 0;
        do {
            path.push_back(cornerAt(cornerX, cornerY));
            cornerX += kStep[direction][0];
            cornerY += kStep[direction][1];
            const bool left = isInside(cornerX + kLeft[direction][0], cornerY + kLeft[direction][1]);
            const bool right = isInside(cornerX + kRight[direction][0], cornerY + kRight[direction][1]);
            direction = (direction + (!left ? 1 : right ? 3 : 0)) % 4;
        } while (cornerX != x || cornerY != y || direction != 0);
        return path;
    }

    double square_;
    PlanePoint low_;
    std::int64_t width_ = 0, height_ = 0;
    std::vector<char> inside_;
    std::vector<std::uint8_t> weights_;  // of obstacles
    std::vector<std::uint32_t> cloudOf_;
    std::vector<std::pair<std::int64_t, std::int64_t>> disc_;
    std::pair<std::int64_t, std::int64_t> last_{-1, -1};
};

// The mean of each point and its neighbours: the stairs of squares become lines.
CloudRing smoothed(const CloudRing& ring) {
    const std::size_t count = ring.size();
    CloudRing smooth(count);
    for (std::size_t n = 0; n < count; ++n) {
        PlanePoint sum;
        for (int k = -kSmoothed; k <= kSmoothed; ++k) {
            const PlanePoint p = ring[(n + count + std::size_t(k + int(count))) % count];
            sum = {sum.u + p.u, sum.v + p.v};
        }
        smooth[n] = {sum.u / (2 * kSmoothed + 1), sum.v / (2 * kSmoothed + 1)};
    }
    return smooth;
}

// Points at equal distances along a closed path.
CloudRing dividedEvenly(const CloudRing& ring) {
    std::vector<double> at{0};  // length along the ring
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        at.push_back(at.back() + std::hypot(b.u - a.u, b.v - a.v));
    }
    const auto count = static_cast<std::size_t>(std::max(4.0, std::round(at.back() / kChord)));
    CloudRing points;
    std::size_t n = 0;
    for (std::size_t p = 0; p < count; ++p) {
        const double place = at.back() * double(p) / double(count);
        while (n + 2 < at.size() && at[n + 1] <= place) ++n;
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        const double length = at[n + 1] - at[n], t = length > 0 ? (place - at[n]) / length : 0;
        points.push_back({a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)});
    }
    return points;
}

// Triangles in rows within a box.
struct TagBlock {
    std::size_t count = 0;
    double width = 0, height = 0;

    explicit TagBlock(std::size_t tags) : count(tags) {
        const std::size_t rows = (tags + kTagsPerRow - 1) / kTagsPerRow, columns = std::min(tags, kTagsPerRow);
        width = kTagSide * double(columns);
        height = 0.87 * kTagSide * double(rows);
    }
    // The lower left corner of a tag.
    [[nodiscard]] PlanePoint tagAt(PlanePoint low, std::size_t n) const noexcept {
        const std::size_t row = n / kTagsPerRow + 1;
        return {low.u + kTagSide * double(n % kTagsPerRow), low.v + height - 0.87 * kTagSide * double(row)};
    }
};

// The place beside a cloud with the fewest obstacles.
RevisionObstacle placeTags(const RevisionMarks::Cloud& cloud, const TagBlock& block, const CloudRaster& raster) {
    RevisionObstacle best{};
    double least = kInfinity;
    for (std::size_t n = 0; n < cloud.ends.size(); ++n) {
        const PlanePoint a = cloud.ends[n], b = cloud.ends[(n + 1) % cloud.ends.size()];
        const double u = b.u - a.u, v = b.v - a.v, length = std::hypot(u, v);
        if (!(length > 0)) continue;
        const PlanePoint out{v / length, -u / length};
        // The box stands off the arc by its support in this direction.
        const double away = 0.5 * length * RevisionMarks::kBulge + kTagGap + 0.5 * block.width * std::abs(out.u) +
                            0.5 * block.height * std::abs(out.v);
        const PlanePoint middle{0.5 * (a.u + b.u) + out.u * away, 0.5 * (a.v + b.v) + out.v * away};
        const RevisionObstacle box{{middle.u - 0.5 * block.width, middle.v - 0.5 * block.height},
                                   {middle.u + 0.5 * block.width, middle.v + 0.5 * block.height}};
        // Among equal places the upper right one.
        const double cost = raster.weightIn(box) - 1e-4 * (middle.u + middle.v);
        if (cost < least) {
            least = cost;
            best = box;
        }
    }
    return best;
}

void addTags(const RevisionMarks::Cloud& cloud, CloudRaster& raster, RevisionMarks& marks) {
    const TagBlock block(cloud.numbers.size());
    const RevisionObstacle box = placeTags(cloud, block, raster);
    raster.addObstacle(box, kTaken);
    for (std::size_t n = 0; n < cloud.numbers.size(); ++n) {
        const PlanePoint low = block.tagAt(box.low, n);
        const double side = kTagSide - 0.4;
        const PlanePoint left{low.u + 0.2, low.v + 0.2};
        RevisionMarks::Tag tag{{left, {left.u + side, left.v}, {left.u + 0.5 * side, left.v + 0.83 * side}},
                               {left.u + 0.5 * side, left.v + 0.7},
                               kTagText,
                               fmt::format("{}", cloud.numbers[n])};
        if (tag.text.size() > 2) tag.size *= 0.75;
        marks.tags.push_back(std::move(tag));
    }
}

// The lines of a drawing as obstacles: outlines of cut parts weigh more than others.
void addObstacles(const drawing::SectionDrawing& drawing, double millimetres, std::span<const RevisionObstacle> taken,
                  CloudRaster& raster) {
    const auto onPaper = [&](PlanePoint p) { return PlanePoint{p.u * millimetres, p.v * millimetres}; };
    const auto addPath = [&](const std::vector<PlanePoint>& points, std::uint8_t weight) {
        for (std::size_t n = 0; n + 1 < points.size(); ++n)
            raster.addObstacle(onPaper(points[n]), onPaper(points[n + 1]), weight);
    };
    for (const drawing::SectionBorder& border : drawing.borders) addPath(border.points, kBold);
    for (const drawing::SectionLine& line : drawing.lines) addPath(line.points, kBold);
    for (const drawing::BeyondLine& line : drawing.beyond)
        raster.addObstacle(onPaper(line.from), onPaper(line.to), kThin);
    for (const RevisionObstacle& box : taken) raster.addObstacle(box, kTaken);
}

}  // namespace

CloudRing cloudPath(const RevisionMarks::Cloud& cloud) {
    constexpr int kParts = 8;
    const double turn = 4 * std::atan(RevisionMarks::kBulge);  // of an arc
    CloudRing path;
    for (std::size_t n = 0; n < cloud.ends.size(); ++n) {
        const PlanePoint a = cloud.ends[n], b = cloud.ends[(n + 1) % cloud.ends.size()];
        const double u = b.u - a.u, v = b.v - a.v, chord = std::hypot(u, v);
        path.push_back(a);
        if (!(chord > 0)) continue;
        const double radius = 0.5 * chord / std::sin(0.5 * turn), back = radius * std::cos(0.5 * turn);
        // The centre lies inwards, on the left of the chord.
        const PlanePoint center{0.5 * (a.u + b.u) - v / chord * back, 0.5 * (a.v + b.v) + u / chord * back};
        const double first = std::atan2(a.v - center.v, a.u - center.u);
        for (int part = 1; part < kParts; ++part) {
            const double angle = first + turn * part / kParts;
            path.push_back({center.u + radius * std::cos(angle), center.v + radius * std::sin(angle)});
        }
    }
    if (!path.empty()) path.push_back(path.front());
    return path;
}

RevisionMarks placeRevisions(const drawing::SectionDrawing& drawing, double millimetres,
                             std::span<const RevisionObstacle> taken) {
    constexpr double kMargin = 50;  // millimetres around changes for clouds and triangles
    RevisionMarks marks;
    RevisionObstacle box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
    const auto onPaper = [&](PlanePoint p) { return PlanePoint{p.u * millimetres, p.v * millimetres}; };
    const auto forEachLine = [&](const drawing::RevisionLines& revision, const auto& visit) {
        for (const auto* lines : {&revision.added, &revision.removed})
            for (const drawing::RevisionLines::Line& line : *lines) visit(onPaper(line.from), onPaper(line.to));
    };
    for (const drawing::RevisionLines& revision : drawing.revisions) {
        forEachLine(revision, [&](PlanePoint from, PlanePoint to) {
            for (const PlanePoint p : {from, to}) {
                box.low = {std::min(box.low.u, p.u), std::min(box.low.v, p.v)};
                box.high = {std::max(box.high.u, p.u), std::max(box.high.v, p.v)};
            }
        });
        for (const drawing::RevisionLines::Line& line : revision.removed)
            marks.removed.push_back({onPaper(line.from), onPaper(line.to)});
    }
    if (!(box.low.u <= box.high.u)) return marks;
    box = {{box.low.u - kMargin, box.low.v - kMargin}, {box.high.u + kMargin, box.high.v + kMargin}};
    const double area = (box.high.u - box.low.u) * (box.high.v - box.low.v);
    CloudRaster raster(box, std::max(kSquare, std::sqrt(area / kMostSquares)));
    for (const drawing::RevisionLines& revision : drawing.revisions)
        forEachLine(revision, [&](PlanePoint from, PlanePoint to) { raster.addLine(from, to); });
    raster.fillHoles();
    addObstacles(drawing, millimetres, taken, raster);
    for (const CloudRing& outline : raster.trace()) {
        marks.clouds.push_back({dividedEvenly(smoothed(outline)), {}});
        const CloudRing path = cloudPath(marks.clouds.back());
        for (std::size_t n = 0; n + 1 < path.size(); ++n) raster.addObstacle(path[n], path[n + 1], kBold);
    }
    for (const drawing::RevisionLines& revision : drawing.revisions)
        forEachLine(revision, [&](PlanePoint from, PlanePoint to) {
            raster.forEachSquareOf(from, to, [&](std::pair<std::int64_t, std::int64_t> at) {
                const std::uint32_t cloud = raster.cloudAt(at.first, at.second);
                if (cloud == kNoCloud) return;
                std::vector<std::uint32_t>& numbers = marks.clouds[cloud].numbers;
                if (numbers.empty() || numbers.back() != revision.revision.number)
                    numbers.push_back(revision.revision.number);
            });
        });
    for (RevisionMarks::Cloud& cloud : marks.clouds) addTags(cloud, raster, marks);
    return marks;
}

}  // namespace svt::writers
