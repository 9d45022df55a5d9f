#include <svt/city/feature_rows.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/plane/hull.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace svt::city {
namespace {

using volume::kNoLabel;

using Point = std::array<double, 2>;

// The convex hull of points, counter-clockwise.
std::vector<Point> hullOf(std::vector<Point> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return {};
    const auto chain = [&] {
        return plane::hullChain(points, 1, [](const Point& point) { return Vec3d{point[0], point[1], 0}; });
    };
    std::vector<Point> hull = chain();
    std::reverse(points.begin(), points.end());
    const std::vector<Point> upper = chain();
    hull.insert(hull.end(), upper.begin() + 1, upper.end() - 1);
    return hull;
}

// Sums of a row while columns are read.
struct Gathered {
    std::int32_t low = INT32_MAX, high = -1;          // samples [low, high)
    double nearest = INFINITY, farthest = -INFINITY;  // of corners of voxels from the plane
    std::uint64_t columns = 0;
    std::int32_t lastI = -1, lastJ = -1;
    std::map<std::int32_t, std::array<std::int32_t, 2>> rows;  // by j: the first and last i
};

class Gatherer {
public:
    // \param extents  labels of each row
    Gatherer(const volume::SemanticVolume& volume, const std::vector<std::vector<std::uint32_t>>& extents,
             const drawing::SectionPlane* plane)
        : volume_(volume), plane_(plane), rowsOf_(volume.labels.labels.size()), gathered_(extents.size()) {
        for (std::uint32_t n = 0; n < extents.size(); ++n)
            for (const std::uint32_t part : extents[n]) rowsOf_[part].push_back(n);
        if (plane == nullptr) return;
        const Vec3d spacing = volume.grid.spacing();
        for (int axis = 0; axis < 3; ++axis)
            halfVoxel_ += std::abs(dot(volume.grid.axes()[std::size_t(axis)], plane->normal)) * spacing[axis] / 2;
    }

    std::vector<Gathered> run() {
        const Vec3i n = volume_.columns.dimension();
        const std::vector<std::uint32_t> labelOf = volume_.labels.labelOfScalar();
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                std::int32_t begin = 0;
                for (const volume::Run& run : volume_.columns.column(i, j)) {
                    const auto end = static_cast<std::int32_t>(run.end);
                    if (run.scalar != 0 && run.scalar < labelOf.size() && labelOf[run.scalar] != kNoLabel)
                        add(labelOf[run.scalar], i, j, begin, end);
                    begin = end;
                }
            }
        return std::move(gathered_);
    }

private:
    void add(std::uint32_t label, std::int32_t i, std::int32_t j, std::int32_t begin, std::int32_t end) {
        for (const std::uint32_t number : rowsOf_[label]) {
            Gathered& to = gathered_[number];
            to.low = std::min(to.low, begin);
            to.high = std::max(to.high, end);
            if (to.lastI != i || to.lastJ != j) ++to.columns;
            to.lastI = i;
            to.lastJ = j;
            const auto [row, isNew] = to.rows.emplace(j, std::array<std::int32_t, 2>{i, i});
            if (!isNew) row->second = {std::min(row->second[0], i), std::max(row->second[1], i)};
            if (plane_ == nullptr) continue;
            for (const std::int32_t k : {begin, end - 1}) {
                const double distance =
                    dot(volume_.grid.worldFromIndex({double(i), double(j), double(k)}) - plane_->point, plane_->normal);
                to.nearest = std::min(to.nearest, distance - halfVoxel_);
                to.farthest = std::max(to.farthest, distance + halfVoxel_);
            }
        }
    }

    const volume::SemanticVolume& volume_;
    const drawing::SectionPlane* plane_;
    std::vector<std::vector<std::uint32_t>> rowsOf_;  // by label: rows whose extent has it
    std::vector<Gathered> gathered_;
    double halfVoxel_ = 0;
};

std::vector<Point> outlineOf(const Gathered& gathered, const volume::Grid& grid) {
    std::vector<Point> points;
    for (const auto& [j, ends] : gathered.rows)
        for (const double x : {ends[0] - 0.5, ends[1] + 0.5})
            for (const double y : {j - 0.5, j + 0.5}) {
                const Vec3d world = grid.worldFromIndex({x, y, 0});
                points.push_back({world.x, world.y});
            }
    return hullOf(std::move(points));
}

// \param parts  labels of the extent of each row
void addRows(const volume::SemanticVolume& volume, const std::vector<std::vector<std::uint32_t>>& parts,
             std::span<const analyze::FeatureMeasure> measures, const drawing::SectionPlane* plane,
             std::vector<FeatureRow>& rows) {
    const std::vector<Gathered> gathered = Gatherer(volume, parts, plane).run();
    const Vec3d spacing = volume.grid.spacing();
    for (std::size_t n = 0; n < parts.size(); ++n) {
        FeatureRow& row = rows.emplace_back();
        row.label = measures[n].label;
        row.measure = measures[n];
        row.isOpen = std::any_of(parts[n].begin(), parts[n].end(),
                                 [&](std::uint32_t part) { return isOpenShell(volume.labels.labels[part]); });
        const Gathered& total = gathered[n];
        if (total.columns == 0) continue;
        row.area = double(total.columns) * spacing.x * spacing.y;
        row.lowest = volume.grid.worldFromIndex({0, 0, total.low - 0.5}).z;
        row.highest = volume.grid.worldFromIndex({0, 0, total.high - 0.5}).z;
        row.isCut = plane != nullptr && total.nearest < 0 && total.farthest > 0;
        row.outline = outlineOf(total, volume.grid);
    }
}

}  // namespace

bool isOpenShell(const volume::Label& label) noexcept {
    using volume::Filling;
    return label.filling == Filling::Capped || label.filling == Filling::Winding ||
           label.filling == Filling::Complemented;
}

std::vector<FeatureRow> featureRows(const volume::SemanticVolume& volume, std::span<const std::uint32_t> selected,
                                    const drawing::SectionPlane* plane) {
    // In passes, so that memory does not grow with the labels of all extents: many groups may have the same members.
    constexpr std::size_t kLabelsPerPass = std::size_t{1} << 24;
    const analyze::Extents extents(volume.labels);
    const auto measures = analyze::measureFeatures(extents, selected, analyze::ownMeasures(volume.labels, volume.grid));
    std::vector<FeatureRow> rows;
    rows.reserve(selected.size());
    while (rows.size() < selected.size()) {
        std::vector<std::vector<std::uint32_t>> parts;
        std::size_t labels = 0;
        for (std::size_t n = rows.size(); n < selected.size() && labels < kLabelsPerPass; ++n) {
            parts.push_back(extents.of(selected[n]));
            labels += parts.back().size();
        }
        addRows(volume, parts, std::span(measures).subspan(rows.size(), parts.size()), plane, rows);
    }
    return rows;
}

}  // namespace svt::city
