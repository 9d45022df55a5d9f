#include <svt/simulate/materials/plate_thickness.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>

namespace svt::simulate {
namespace {

using volume::Run;

// Adds to `starts` the voxels of `own` whose voxel at the same height in `before` has another label: the first voxels of rows.
void countRowStarts(std::span<const Run> before, std::span<const Run> own, std::span<const std::uint32_t> labelOf,
                    std::vector<std::uint64_t>& starts) {
    std::size_t b = 0;
    std::uint32_t begin = 0;
    for (const Run& run : own) {
        const std::uint32_t label = labelOf[run.scalar];
        for (std::uint32_t from = begin; from < run.end;) {
            while (b < before.size() && before[b].end <= from) ++b;
            const std::uint32_t to = b < before.size() ? std::min(run.end, before[b].end) : run.end;
            const bool isSame = b < before.size() && labelOf[before[b].scalar] == label;
            if (!isSame && label != volume::kNoLabel) starts[label] += to - from;
            from = to;
        }
        begin = run.end;
    }
}

// The area of the triangles of a label that are parallel to most others, m2; 0 without triangles.
double parallelArea(const volume::SemanticVolume& volume, std::uint32_t label) {
    std::map<std::array<int, 3>, double> byNormal;
    double most = 0;
    for (const volume::VectorParts::Triangle& triangle : volume::trianglesOf(volume.vectors, label)) {
        const Vec3d a = volume.vectors.position(triangle.corners[0], {}),
                    b = volume.vectors.position(triangle.corners[1], {}),
                    c = volume.vectors.position(triangle.corners[2], {});
        const Vec3d across = cross(b - a, c - a);
        const Vec3d normal = normalized(across);
        // Both sides of a plate count as parallel.
        constexpr double kSteps = 50;
        std::array<int, 3> key{int(std::lround(normal.x * kSteps)), int(std::lround(normal.y * kSteps)),
                               int(std::lround(normal.z * kSteps))};
        if (key < std::array{0, 0, 0})
            for (int& part : key) part = -part;
        most = std::max(most, byNormal[key] += length(across) / 2);
    }
    return most;
}

}  // namespace

std::vector<double> plateThicknesses(const volume::SemanticVolume& volume) {
    const std::vector<std::uint32_t> labelOf = volume.labels.labelOfScalar();
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::array<std::vector<std::uint64_t>, 3> rows;
    for (auto& one : rows) one.assign(labels.size(), 0);
    const Vec3i n = volume.grid.dimension();
    for (std::int32_t j = 0; j < n.y; ++j)
        for (std::int32_t i = 0; i < n.x; ++i) {
            const std::span<const Run> own = volume.columns.column(i, j);
            countRowStarts(i > 0 ? volume.columns.column(i - 1, j) : std::span<const Run>(), own, labelOf, rows[0]);
            countRowStarts(j > 0 ? volume.columns.column(i, j - 1) : std::span<const Run>(), own, labelOf, rows[1]);
            std::uint32_t last = volume::kNoLabel;
            for (const Run& run : own) {
                const std::uint32_t label = labelOf[run.scalar];
                if (label != volume::kNoLabel && label != last) ++rows[2][label];
                last = label;
            }
        }
    const Vec3d spacing = volume.grid.spacing();
    std::vector<double> thickness(labels.size(), 0);
    for (std::size_t l = 0; l < labels.size(); ++l) {
        const double x = double(rows[0][l]) * spacing.y * spacing.z, y = double(rows[1][l]) * spacing.x * spacing.z,
                     z = double(rows[2][l]) * spacing.x * spacing.y;
        // Rows along a plate end at its edges, so the axis that is least across it is left out.
        double area = std::sqrt(x * x + y * y + z * z - std::pow(std::min({x, y, z}), 2));
        const bool isExact = labels[l].volume > 0 && volume::hasClosedMesh(labels[l].filling);
        const double size = isExact ? labels[l].volume : double(labels[l].voxels) * volume.grid.voxelVolume();
        if (isExact)
            if (const double side = parallelArea(volume, static_cast<std::uint32_t>(l)) / 2; side > 0) area = side;
        if (area > 0) thickness[l] = size / area;
    }
    return thickness;
}

}  // namespace svt::simulate
