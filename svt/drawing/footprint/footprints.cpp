#include <svt/drawing/footprints.hpp>

#include <svt/drawing/footprint/outline_union.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::drawing {
namespace {

using Interval = std::pair<std::int32_t, std::int32_t>;  // [first, second)

// Sorted intervals that do not touch.
void unite(std::vector<Interval>& intervals) {
    std::sort(intervals.begin(), intervals.end());
    std::size_t kept = 0;
    for (const Interval& interval : intervals) {
        if (kept > 0 && intervals[kept - 1].second >= interval.first)
            intervals[kept - 1].second = std::max(intervals[kept - 1].second, interval.second);
        else
            intervals[kept++] = interval;
    }
    intervals.resize(kept);
}

// Adds the borders of columns of samples. Corners are places between samples: (i, j) is the lower corner of column (i, j).
class ColumnBorders {
public:
    ColumnBorders(const volume::Grid& grid, double unit, OutlineUnion& to) : grid_(grid), unit_(unit), to_(to) {}

    // \param intervals  of row `row`, united; rows ascend
    void addRow(std::int32_t row, std::vector<Interval> intervals) {
        if (row != row_ + 1) finish();
        addBorder(row, below_, intervals);
        for (const auto& [begin, end] : intervals) {
            add(end, row, end, row + 1);
            add(begin, row + 1, begin, row);
        }
        below_ = std::move(intervals);
        row_ = row;
    }
    void finish() {
        addBorder(row_ + 1, below_, {});
        below_.clear();
    }

private:
    // The border between two rows, cut at all ends so that edges meet at their ends.
    void addBorder(std::int32_t row, const std::vector<Interval>& below, const std::vector<Interval>& above) {
        std::vector<std::int32_t> ends;
        for (const std::vector<Interval>* intervals : {&below, &above})
            for (const auto& [begin, end] : *intervals) ends.insert(ends.end(), {begin, end});
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        const auto holds = [](const std::vector<Interval>& intervals, std::int32_t at) {
            const auto next = std::upper_bound(intervals.begin(), intervals.end(), Interval{at, INT32_MAX});
            return next != intervals.begin() && at < std::prev(next)->second;
        };
        for (std::size_t n = 0; n + 1 < ends.size(); ++n) {
            const bool isBelow = holds(below, ends[n]), isAbove = holds(above, ends[n]);
            if (isAbove && !isBelow) add(ends[n], row, ends[n + 1], row);
            if (isBelow && !isAbove) add(ends[n + 1], row, ends[n], row);
        }
    }
    void add(std::int32_t fromX, std::int32_t fromY, std::int32_t toX, std::int32_t toY) {
        to_.addEdge(placed(fromX, fromY), placed(toX, toY));
    }
    [[nodiscard]] plane::Point placed(std::int32_t x, std::int32_t y) const noexcept {
        const Vec3d place = grid_.worldFromIndex({x - 0.5, y - 0.5, 0}) - grid_.origin();
        return {static_cast<std::int64_t>(std::llround(place.x / unit_)),
                static_cast<std::int64_t>(std::llround(place.y / unit_))};
    }

    const volume::Grid& grid_;
    double unit_;
    OutlineUnion& to_;
    std::vector<Interval> below_;
    std::int32_t row_ = -2;
};

}  // namespace

Footprints::Footprints(const volume::SemanticVolume& volume, const analyze::Extents& extents)
    : volume_(volume), extents_(extents), faces_(volume.labels, vectors()) {}

const volume::VectorParts& Footprints::vectors() const noexcept {
    return volume_.vectors.triangles.empty() ? volume_.footprints : volume_.vectors;
}

void Footprints::addSpans() const {
    spansOf_.resize(volume_.labels.labels.size());
    const std::vector<std::uint32_t> labelOf = volume_.labels.labelOfScalar();
    const Vec3i n = volume_.columns.dimension();
    for (std::int32_t j = 0; j < n.y; ++j)
        for (std::int32_t i = 0; i < n.x; ++i)
            for (const volume::Run& run : volume_.columns.column(i, j)) {
                if (run.scalar == 0 || run.scalar >= labelOf.size() || labelOf[run.scalar] == volume::kNoLabel)
                    continue;
                std::vector<Span>& spans = spansOf_[labelOf[run.scalar]];
                if (!spans.empty() && spans.back().row == j && spans.back().end >= i)
                    spans.back().end = i + 1;
                else
                    spans.push_back({j, i, i + 1});
            }
}

Footprint Footprints::of(std::uint32_t label, analyze::PlanOutline outline) const {
    return of(extents_.of(label), outline);
}

Footprint Footprints::of(std::span<const std::uint32_t> extent, analyze::PlanOutline outline) const {
    Footprint footprint = unionOf(faces_.of(extent, outline), outline);
    // Upright faces have no area in plan.
    if (footprint.polygons.empty()) footprint = unionOf({{}, {extent.begin(), extent.end()}}, outline);
    return footprint;
}

Footprint Footprints::unionOf(const analyze::PlanParts& parts, analyze::PlanOutline outline) const {
    const volume::VectorParts& vectors = this->vectors();
    OutlineUnion borders;
    for (const std::uint32_t face : parts.faces) {
        std::array<plane::Point, 3> corners;
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3i place = vectors.points[vectors.triangles[face].corners[n]];
            corners[n] = {place.x, place.y};
        }
        borders.addTriangle(corners);
    }
    if (!parts.labels.empty()) addColumns(parts.labels, borders);
    Footprint footprint;
    const Vec3d origin = volume_.grid.origin();
    footprint.polygons = borders.polygons(vectors.unit, {origin.x, origin.y});
    for (const PlanPolygon& polygon : footprint.polygons) footprint.area += areaOf(polygon);
    // Free of the noise of large coordinates, so that a part of a city has the figures of the whole.
    footprint.area = std::round(footprint.area * 1e6) / 1e6;
    if (footprint.polygons.empty()) return footprint;
    const auto name = [&](bool isUsed, const char* source) {
        if (isUsed) footprint.source += (footprint.source.empty() ? "" : " and ") + std::string(source);
    };
    name(parts.hasSurfaces, outline == analyze::PlanOutline::Footprint ? "ground surfaces" : "roof surfaces");
    name(parts.hasSolids, "meshes");
    name(!parts.labels.empty(), "voxels");
    return footprint;
}

// Adds the columns of samples of labels.
void Footprints::addColumns(std::span<const std::uint32_t> labels, OutlineUnion& borders) const {
    std::call_once(areSpansKnown_, [this] { addSpans(); });
    std::vector<Span> spans;
    for (const std::uint32_t label : labels) spans.insert(spans.end(), spansOf_[label].begin(), spansOf_[label].end());
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.row < b.row; });
    ColumnBorders columns(volume_.grid, vectors().unit, borders);
    for (std::size_t begin = 0, end = 0; begin < spans.size(); begin = end) {
        std::vector<Interval> intervals;
        for (; end < spans.size() && spans[end].row == spans[begin].row; ++end)
            intervals.emplace_back(spans[end].begin, spans[end].end);
        unite(intervals);
        columns.addRow(spans[begin].row, std::move(intervals));
    }
    columns.finish();
}

}  // namespace svt::drawing
