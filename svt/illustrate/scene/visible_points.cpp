#include <svt/illustrate/scene/visible_points.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/render/clip_intervals.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace svt::illustrate {
namespace {

// Places that are looked at along an axis. More would not show in a picture: points are at most half a step too far
// out.
constexpr std::int32_t kMostColumns = 256;

struct Heights {
    double low, high;  // voxel space
};

std::vector<std::uint8_t> drawnScalars(const render::Pass& pass, std::size_t scalarCount) {
    std::vector<std::uint8_t> isDrawn(scalarCount, 0);
    for (std::size_t s = 1; s < std::min(scalarCount, pass.styles.size()); ++s)
        isDrawn[s] = pass.styles[s].opacity > 0 ? 1 : 0;
    return isDrawn;
}

// Lowest and highest place of a column that is drawn.
std::optional<Heights> drawnHeights(std::span<const volume::Run> runs, std::span<const std::uint8_t> isDrawn,
                                    const render::DrawnIntervals& kept) {
    Heights heights{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    double from = 0;
    for (const volume::Run& run : runs) {
        const double to = run.end;
        if (run.scalar < isDrawn.size() && isDrawn[run.scalar] != 0)
            for (const render::DrawnInterval& interval : kept) {
                const double low = std::max(from, interval.from), high = std::min(to, interval.to);
                if (low >= high) continue;
                heights.low = std::min(heights.low, low);
                heights.high = std::max(heights.high, high);
            }
        from = to;
    }
    if (heights.low >= heights.high) return std::nullopt;
    return heights;
}

// A place in a vertical plane.
struct Place {
    double x, z;
};

// Adds `next` to an upper (side 1) or lower (side -1) hull of places with ascending x (Andrew 1979).
void addToHull(std::vector<Place>& hull, Place next, double side) {
    const auto isInside = [&] {
        const Place a = hull[hull.size() - 2], b = hull.back();
        return side * ((b.x - a.x) * (next.z - a.z) - (b.z - a.z) * (next.x - a.x)) >= 0;
    };
    while (hull.size() >= 2 && isInside()) hull.pop_back();
    hull.push_back(next);
}

// A part of the plan, voxel space.
struct Window {
    double minX = std::numeric_limits<double>::infinity(), minY = minX, maxX = -minX, maxY = -minX;

    [[nodiscard]] bool isEmpty() const { return !(minX < maxX && minY < maxY); }
    void add(double x0, double y0, double x1, double y1) {
        minX = std::min(minX, x0);
        minY = std::min(minY, y0);
        maxX = std::max(maxX, x1);
        maxY = std::max(maxY, y1);
    }
};

class PointFinder {
public:
    PointFinder(const render::Pass& pass, const volume::SemanticVolume& volume)
        : volume_(volume),
          clipper_(pass.clips, volume.grid),
          isDrawn_(drawnScalars(pass, volume.labels.scalarCount())) {}

    void addTo(std::span<const analyze::SampleBox> boxes, std::vector<Vec3d>& points) {
        Window window;
        const auto& labels = volume_.labels.labels;
        for (std::size_t l = 0; l < labels.size(); ++l) {
            const bool isAny =
                std::any_of(isDrawn_.begin() + labels[l].first, isDrawn_.begin() + labels[l].first + labels[l].count,
                            [](std::uint8_t is) { return is != 0; });
            if (isAny && !boxes[l].isEmpty())
                window.add(boxes[l].min.x, boxes[l].min.y, boxes[l].max.x + 1.0, boxes[l].max.y + 1.0);
        }
        scan(window);
        // Clips may leave a small part of the window: once more, as fine as that part deserves.
        if (!clipper_.isEmpty()) scan(found_);
        points.insert(points.end(), points_.begin(), points_.end());
    }

    [[nodiscard]] bool keeps(Vec3d point) const {
        return clipper_.isEmpty() || clipper_.keeps(volume_.grid.indexFromWorld(point) + Vec3d{0.5, 0.5, 0.5});
    }

private:
    // Finds the points of the drawn parts in `window`; keeps the previous points if there are none.
    void scan(const Window& window) {
        if (window.isEmpty()) return;
        const double least = clipper_.isEmpty() ? 1 : 0;  // a column is cut in different heights at its sides
        const Vec3d step{std::max(least, (window.maxX - window.minX) / kMostColumns),
                         std::max(least, (window.maxY - window.minY) / kMostColumns), 0};
        std::vector<Vec3d> before = std::exchange(points_, {});
        const Window outer = window;  // found_ is written
        found_ = {};
        const auto rows = static_cast<int>(std::ceil((outer.maxY - outer.minY) / step.y));
        for (int row = 0; row < rows; ++row) scanRow(outer, outer.minY + (row + 0.5) * step.y, step);
        if (points_.empty()) points_ = std::move(before);
    }

    void scanRow(const Window& window, double y, Vec3d step) {
        upper_.clear();
        lower_.clear();
        const auto places = static_cast<int>(std::ceil((window.maxX - window.minX) / step.x));
        for (int place = 0; place < places; ++place) {
            const double x = window.minX + (place + 0.5) * step.x;
            const auto heights = heightsAt(x, y);
            if (!heights) continue;
            addToHull(upper_, {x, heights->high}, 1);
            addToHull(lower_, {x, heights->low}, -1);
        }
        if (upper_.empty()) return;
        found_.add(upper_.front().x - step.x, y - step.y, upper_.back().x + step.x, y + step.y);
        // A place represents everything up to half a step beside it.
        for (const auto* hull : {&upper_, &lower_})
            for (const Place place : *hull)
                for (const double besideX : {place.x - step.x / 2, place.x + step.x / 2})
                    for (const double besideY : {y - step.y / 2, y + step.y / 2})
                        points_.push_back(volume_.grid.worldFromIndex({besideX - 0.5, besideY - 0.5, place.z - 0.5}));
    }

    [[nodiscard]] std::optional<Heights> heightsAt(double x, double y) const {
        const Vec3i n = volume_.grid.dimension();
        const auto i = std::clamp(static_cast<std::int32_t>(x), 0, n.x - 1);
        const auto j = std::clamp(static_cast<std::int32_t>(y), 0, n.y - 1);
        const auto runs = volume_.columns.column(i, j);
        const render::RaySpan whole{0, double(n.z)};
        if (!clipper_.isEmpty()) return drawnHeights(runs, isDrawn_, clipper_.cut({x, y, 0}, {0, 0, 1}, whole));
        render::DrawnIntervals all;
        all.add({whole.from, whole.to, {nullptr, nullptr}});
        return drawnHeights(runs, isDrawn_, all);
    }

    const volume::SemanticVolume& volume_;
    render::Clipper clipper_;
    std::vector<std::uint8_t> isDrawn_;
    Window found_;  // of the last scan, and a step around it
    std::vector<Vec3d> points_;
    std::vector<Place> upper_, lower_;
};

}  // namespace

std::vector<Vec3d> visiblePoints(std::span<const render::Pass> passes, const volume::SemanticVolume& volume) {
    std::vector<Vec3d> points;
    const std::vector<analyze::SampleBox> boxes = analyze::labelBoxes(volume.columns, volume.labels);
    for (const render::Pass& pass : passes) {
        PointFinder finder(pass, volume);
        finder.addTo(boxes, points);
        for (const render::MeshTriangle& triangle : pass.triangles)
            for (const Vec3d& corner : triangle.corners)
                if (finder.keeps(corner)) points.push_back(corner);
    }
    return points;
}

}  // namespace svt::illustrate
