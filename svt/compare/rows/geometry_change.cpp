#include <svt/compare/rows/geometry_change.hpp>

#include <svt/compare/shape/rotation.hpp>
#include <svt/compare/shape/surface_distance.hpp>

#include <algorithm>
#include <cmath>

namespace svt::compare {
namespace {

constexpr double kMostPoints = 400'000;  // of a lattice over the faces of one object

bool haveOnePosition(const Shape& a, const Shape& b) noexcept {
    return a.digest != 0 && a.digest == b.digest && a.box == b.box;
}

// Every distance that the two shapes have from each other, at sampled points.
double distanceBetween(const Shape& a, const FaceTree& treeOfA, const Shape& b, const FaceTree& treeOfB,
                       Vec3d shift = {}, double step = 0) {
    return std::max(largestDistance(a.faces, treeOfB, shift, step), largestDistance(b.faces, treeOfA, -shift, step));
}

}  // namespace

bool GeometryMeasurer::measureExactly(const Match& match, ComparisonRow& row) {
    double was = 0, is = 0, common = 0, bound = 0;
    for (const std::uint32_t s : match.was) {
        if (!sides_.wasShapes[s].volume) return false;
        was += *sides_.wasShapes[s].volume;
        bound += sides_.wasShapes[s].area * sides_.was.vectors.unit;
    }
    for (const std::uint32_t s : match.is) {
        if (!sides_.isShapes[s].volume) return false;
        is += *sides_.isShapes[s].volume;
        bound += sides_.isShapes[s].area * sides_.is.vectors.unit;
    }
    for (const std::uint32_t s : match.was)
        for (const std::uint32_t t : match.is) {
            const auto space = spaces_.of(sides_.wasShapes[s].label, sides_.isShapes[t].label);
            if (!space) return false;
            common += space->volume;
            bound += space->bound;
        }
    // A difference below the bound is rounding.
    const auto beyondBound = [&](double volume) { return volume > bound ? volume : 0.0; };
    row.added = beyondBound(is - common);
    row.removed = beyondBound(was - common);
    row.bound = bound;
    row.isExact = true;
    return true;
}

double GeometryMeasurer::voxelBound(const Match& match) const {
    const Vec3d spacing = sides_.was.grid.spacing();
    double area = 0;
    std::uint64_t uncertain = 0;
    for (const std::uint32_t s : match.was) {
        area += sides_.wasShapes[s].area;
        uncertain += sides_.wasShapes[s].uncertainVoxels;
    }
    for (const std::uint32_t s : match.is) {
        area += sides_.isShapes[s].area;
        uncertain += sides_.isShapes[s].uncertainVoxels;
    }
    return area * 0.5 * std::max({spacing.x, spacing.y, spacing.z}) + double(uncertain) * sides_.was.grid.voxelVolume();
}

// Sheets have no volume, so theirs stays unknown.
void GeometryMeasurer::measureVoxels(const Match& match, ComparisonRow& row) const {
    if (!match.was.empty() && !match.is.empty() && !voxels_.isOnOneLattice()) return;
    double was = 0, is = 0, common = 0;
    bool hasFaces = true;
    for (const std::uint32_t s : match.was) {
        const Shape& shape = sides_.wasShapes[s];
        if (!shape.isSolid && !shape.isCounted) return;
        hasFaces = hasFaces && !shape.faces.triangles.empty();
        was += double(shape.voxels);
    }
    for (const std::uint32_t s : match.is) {
        const Shape& shape = sides_.isShapes[s];
        if (!shape.isSolid && !shape.isCounted) return;
        hasFaces = hasFaces && !shape.faces.triangles.empty();
        is += double(shape.voxels);
    }
    for (const std::uint32_t s : match.was)
        for (const std::uint32_t t : match.is)
            common += double(voxels_.of(sides_.wasShapes[s].label, sides_.isShapes[t].label));
    const double voxel = (match.is.empty() ? sides_.was.grid : sides_.is.grid).voxelVolume();
    row.added = (is - common) * voxel;
    row.removed = (was - common) * voxel;
    if (hasFaces) row.bound = voxelBound(match);  // without faces, the surface is unknown
}

void GeometryMeasurer::measureVolumes(const Match& match, ComparisonRow& row) {
    row.change = match.was.empty()      ? Change::Added
                 : match.is.empty()     ? Change::Removed
                 : match.was.size() > 1 ? Change::Merged
                 : match.is.size() > 1  ? Change::Split
                                        : Change::Changed;
    const bool isPair = match.was.size() == 1 && match.is.size() == 1;
    if (isPair) {
        const Shape &a = sides_.wasShapes[match.was[0]], &b = sides_.isShapes[match.is[0]];
        if (haveOnePosition(a, b) && !a.isCounted && !b.isCounted) {
            row.added = row.removed = row.bound = 0;
            row.isExact = true;
            return;
        }
    }
    if (!measureExactly(match, row)) measureVoxels(match, row);
}

void GeometryMeasurer::measureFaces(const Match& match, ComparisonRow& row) const {
    if (match.was.size() != 1 || match.is.size() != 1) return;
    const Shape &a = sides_.wasShapes[match.was[0]], &b = sides_.isShapes[match.is[0]];
    const double changed = row.added.value_or(0) + row.removed.value_or(0);
    const auto same = [&] {
        const bool isOther =
            sides_.was.labels.labels[a.label].className != sides_.is.labels.labels[b.label].className &&
            sides_.was.labels.labels[a.label].id != sides_.is.labels.labels[b.label].id;
        row.change = isOther ? Change::Reassigned : Change::Same;
    };
    if (a.faces.triangles.empty() || b.faces.triangles.empty()) {
        // Voxels do not tell a move from another shape.
        if (changed == 0 && row.added) same();
        return;
    }
    // Voxels show a change of an open shell, or of material behind a surface, that its faces do not show.
    const double hidden = row.bound.value_or(0) + options_.tolerance * (a.area + b.area);
    const bool isHiddenChange = (a.isCounted || b.isCounted) && changed > hidden;
    if (haveOnePosition(a, b)) {
        row.distance = 0;
        if (!isHiddenChange) same();
        return;
    }
    const FaceTree treeOfA(a.faces), treeOfB(b.faces);
    double distance = distanceBetween(a, treeOfA, b, treeOfB);
    // Faces that are off by a little change the volume by no more than their area times that. More is a change between the
    // points, such as a hole.
    const bool isExplained = row.isExact ? distance <= options_.tolerance / 4 && changed <= distance * (a.area + b.area)
                                         : agreeWithin(a, b, distance);
    if (distance <= options_.tolerance && !(row.isExact && changed == 0) && !isExplained) {
        const double step = std::max(options_.tolerance, std::sqrt(std::max(a.area, b.area) / kMostPoints));
        distance = std::max(distance, distanceBetween(a, treeOfA, b, treeOfB, {}, step));
    }
    row.distance = distance;
    if (distance <= options_.tolerance && !isHiddenChange) {
        same();
        return;
    }
    measureMove(a, treeOfA, b, treeOfB, row);
}

void GeometryMeasurer::measureMove(const Shape& a, const FaceTree& treeOfA, const Shape& b, const FaceTree& treeOfB,
                                   ComparisonRow& row) const {
    const Vec3d vector = b.center - a.center;
    const double rounding = sides_.was.vectors.unit + sides_.is.vectors.unit;  // of points, at two places
    if (areAlike(a, b, options_.tolerance) && length(vector) > 0) {
        // A move leaves no other difference than rounding, and hardly any volume of its own.
        const double rest = distanceBetween(a, treeOfA, b, treeOfB, vector);
        const double volumes = a.volume && b.volume ? std::abs(*a.volume - *b.volume) : 0;
        const double most = std::min(options_.tolerance, std::max(1e-4, length(vector) / 20));
        if (rest <= most && volumes <= most * std::min(a.area, b.area) && agreeWithin(a, b, rest + rounding, vector)) {
            row.change = Change::Moved;
            row.vector = vector;
            return;
        }
    }
    // So does a turn, as a share of the distance that it explains.
    const double most = std::min(options_.tolerance, std::max(1e-4, row.distance.value_or(0) / 20));
    const auto rotation = rotationBetween(a, treeOfA, b, treeOfB, most);
    if (rotation && std::abs(*rotation) >= 1e-3) row.rotation = std::round(*rotation * 1e3) / 1e3;
}

}  // namespace svt::compare
