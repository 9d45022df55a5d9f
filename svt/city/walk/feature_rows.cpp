#include <svt/city/feature_rows.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace svt::city {
namespace {

using volume::kNoLabel;

// Sums of a row while columns are read.
struct Gathered {
    std::int32_t low = INT32_MAX, high = -1;          // samples [low, high)
    double nearest = INFINITY, farthest = -INFINITY;  // of corners of voxels from the plane
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

// \param parts  labels of the extent of each row
void addRows(const volume::SemanticVolume& volume, const std::vector<std::vector<std::uint32_t>>& parts,
             std::span<const analyze::FeatureMeasure> measures, const drawing::Footprints& footprints,
             const FeatureRowOptions& options, std::vector<FeatureRow>& rows) {
    const std::vector<Gathered> gathered = Gatherer(volume, parts, options.plane).run();
    const std::size_t first = rows.size();
    for (std::size_t n = 0; n < parts.size(); ++n) {
        FeatureRow& row = rows.emplace_back();
        row.label = measures[n].label;
        row.measure = measures[n];
        row.isOpen = std::any_of(parts[n].begin(), parts[n].end(),
                                 [&](std::uint32_t part) { return isOpenShell(volume.labels.labels[part]); });
        const Gathered& total = gathered[n];
        if (total.high < 0) continue;
        row.lowest = volume.grid.worldFromIndex({0, 0, total.low - 0.5}).z;
        row.highest = volume.grid.worldFromIndex({0, 0, total.high - 0.5}).z;
        row.isCut = options.plane != nullptr && total.nearest < 0 && total.farthest > 0;
    }
    parallelFor(parts.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            FeatureRow& row = rows[first + n];
            row.footprint = footprints.of(parts[n], analyze::PlanOutline::Footprint);
            if (options.hasRoofs) row.roof = footprints.of(parts[n], analyze::PlanOutline::Roof);
            row.area = row.footprint.area;
        }
    });
}

}  // namespace

bool isOpenShell(const volume::Label& label) noexcept {
    using volume::Filling;
    return label.filling == Filling::Capped || label.filling == Filling::Winding ||
           label.filling == Filling::Complemented;
}

std::vector<FeatureRow> featureRows(const volume::SemanticVolume& volume, std::span<const std::uint32_t> selected,
                                    const FeatureRowOptions& options) {
    // In passes, so that memory does not grow with the labels of all extents: many groups may have the same members.
    constexpr std::size_t kLabelsPerPass = std::size_t{1} << 24;
    const analyze::Extents extents(volume.labels);
    const auto measures = analyze::measureFeatures(extents, selected, analyze::ownMeasures(volume.labels, volume.grid));
    const analyze::KnownVolumes volumes(volume.labels, volume.grid, extents);
    const drawing::Footprints footprints(volume, extents);
    std::vector<FeatureRow> rows;
    rows.reserve(selected.size());
    while (rows.size() < selected.size()) {
        std::vector<std::vector<std::uint32_t>> parts;
        std::size_t labels = 0;
        for (std::size_t n = rows.size(); n < selected.size() && labels < kLabelsPerPass; ++n) {
            parts.push_back(extents.of(selected[n]));
            labels += parts.back().size();
        }
        addRows(volume, parts, std::span(measures).subspan(rows.size(), parts.size()), footprints, options, rows);
    }
    const bool hasMeshes = !volume.vectors.triangles.empty();
    const std::vector<Box3d> boxes = hasMeshes ? analyze::labelWorldBoxes(volume) : std::vector<Box3d>();
    for (FeatureRow& row : rows) {
        row.volume = volumes.of(row.label);
        if (!hasMeshes || row.measure.total.voxels == 0) continue;
        Box3d box;
        for (const std::uint32_t part : extents.of(row.label)) box.add(boxes[part]);
        row.lowest = box.min.z;
        row.highest = box.max.z;
    }
    return rows;
}

}  // namespace svt::city
