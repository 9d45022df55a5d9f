#include <svt/compare/shape/shapes.hpp>

#include <svt/analyze/label_measures.hpp>
#include <svt/core/hash.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace svt::compare {
namespace {

// The symmetric product of two vectors, in the order of Shape::moments.
std::array<double, 6> productOf(Vec3d a, Vec3d b) noexcept {
    return {a.x * b.x,
            a.y * b.y,
            a.z * b.z,
            0.5 * (a.x * b.y + a.y * b.x),
            0.5 * (a.y * b.z + a.z * b.y),
            0.5 * (a.z * b.x + a.x * b.z)};
}

// Sums over the triangles of one object, about a point near them.
void measureFaces(Shape& shape) {
    const Faces& faces = shape.faces;
    for (std::size_t t = 0; t < faces.triangles.size(); ++t)
        for (const Vec3d& corner : faces.corners(t)) shape.box.add(corner);
    const Vec3d about = shape.box.center();
    Vec3d first{};
    std::array<double, 6> second{};
    double volume = 0;
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        std::array<Vec3d, 3> p = faces.corners(t);
        for (Vec3d& corner : p) corner = corner - about;
        const double area = 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
        const Vec3d sum = p[0] + p[1] + p[2];
        shape.area += area;
        first = first + sum * (area / 3);
        volume += dot(p[0], cross(p[1], p[2])) / 6;
        const std::array<double, 6> whole = productOf(sum, sum);
        for (const Vec3d& corner : p) {
            const std::array<double, 6> own = productOf(corner, corner);
            for (std::size_t m = 0; m < 6; ++m) second[m] += own[m] * (area / 12);
        }
        for (std::size_t m = 0; m < 6; ++m) second[m] += whole[m] * (area / 12);
        shape.digest += volume::digestOf(*faces.parts, faces.triangles[t]);
    }
    const Vec3d center = shape.area > 0 ? first / shape.area : Vec3d{};
    const std::array<double, 6> shift = productOf(center, center);
    for (std::size_t m = 0; m < 6; ++m) shape.moments[m] = second[m] - shift[m] * shape.area;
    shape.center = about + center;
    shape.volume = volume;
    shape.digest = std::max<std::uint64_t>(1, mixHash(shape.digest, std::bit_cast<std::uint64_t>(faces.parts->unit)));
}

// Voxels that others took, and those that may lie outside of an open shell.
std::vector<std::uint64_t> uncertainVoxels(const volume::LabelTable& table) {
    std::vector<std::uint64_t> voxels(table.labels.size());
    for (std::size_t l = 0; l < voxels.size(); ++l) voxels[l] = table.labels[l].uncertainVoxels;
    for (const volume::Overlap& overlap : table.overlaps) voxels[overlap.b] += overlap.voxels;
    return voxels;
}

}  // namespace

std::vector<Shape> findShapes(const volume::SemanticVolume& volume, Vec3d offset) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<Shape> shapes;
    const std::vector<std::uint64_t> uncertain = uncertainVoxels(volume.labels);
    bool needsBoxes = false;
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        Shape shape;
        shape.label = l;
        shape.faces = {volume::trianglesOf(volume.vectors, l), &volume.vectors, offset};
        if (shape.faces.triangles.empty() && labels[l].voxels == 0) continue;
        shape.voxels = labels[l].voxels;
        shape.uncertainVoxels = uncertain[l];
        measureFaces(shape);
        shape.isSolid = shape.volume && !shape.faces.triangles.empty() &&
                        volume::enclosesStatedVolume(labels[l], *shape.volume, shape.area, volume.vectors.unit);
        if (!shape.isSolid) shape.volume.reset();
        shape.isCounted = !shape.isSolid && labels[l].filling != volume::Filling::Surface;
        needsBoxes = needsBoxes || shape.faces.triangles.empty();
        shapes.push_back(shape);
    }
    if (!needsBoxes) return shapes;
    const std::vector<Box3d> boxes = analyze::labelWorldBoxes(volume);
    const Vec3d origin = volume.grid.origin() - offset;
    for (Shape& shape : shapes)
        if (shape.faces.triangles.empty()) {
            const Box3d& box = boxes[shape.label];
            if (box.isEmpty()) continue;
            shape.box = {box.min - origin, box.max - origin};
            shape.center = shape.box.center();
            shape.digest = 0;
        }
    return shapes;
}

bool agreeWithin(const Shape& a, const Shape& b, double distance, Vec3d shift) noexcept {
    const double size = std::max(length(a.box.size()), length(b.box.size()));
    // Edges that move by the distance change the area by the product of both.
    const double areaOff = distance * size * 8 + 1e-9 * (a.area + b.area);
    if (std::abs(a.area - b.area) > areaOff) return false;
    if (length(a.center + shift - b.center) > distance + 1e-9 * size) return false;
    for (std::size_t m = 0; m < 6; ++m)
        if (std::abs(a.moments[m] - b.moments[m]) > areaOff * size * size) return false;
    return true;
}

namespace {

// Coefficients of the characteristic polynomial of a symmetric matrix: they do not change with a rotation.
struct Invariants {
    double trace = 0, minors = 0, determinant = 0;
};

Invariants invariantsOf(const std::array<double, 6>& moments) noexcept {
    const auto [xx, yy, zz, xy, yz, zx] = moments;
    return {xx + yy + zz, xx * yy + yy * zz + zz * xx - xy * xy - yz * yz - zx * zx,
            xx * yy * zz + 2 * xy * yz * zx - xx * yz * yz - yy * zx * zx - zz * xy * xy};
}

}  // namespace

bool areAlike(const Shape& a, const Shape& b, double tolerance) noexcept {
    if (a.isSolid != b.isSolid || a.faces.triangles.empty() != b.faces.triangles.empty()) return false;
    if (a.faces.triangles.empty()) return a.voxels == b.voxels && length(a.box.size() - b.box.size()) <= tolerance;
    if (a.digest == b.digest) return true;
    const double size = std::max(length(a.box.size()), length(b.box.size())) + tolerance;
    // A face that moves by the tolerance changes the area by about the tolerance times its edges.
    const double areaOff = tolerance * size * 8 + 1e-9 * (a.area + b.area);
    if (std::abs(a.area - b.area) > areaOff) return false;
    for (std::size_t m = 0; m < 6; ++m)
        if (std::abs(a.moments[m] - b.moments[m]) > areaOff * size * size) return false;
    return !a.volume || std::abs(*a.volume - *b.volume) <= tolerance * (a.area + b.area) + 1e-9 * std::abs(*a.volume);
}

bool areAlikeTurned(const Shape& a, const Shape& b, double tolerance) noexcept {
    if (!a.volume || !b.volume) return false;
    const double size = std::max(length(a.box.size()), length(b.box.size())) + tolerance;
    const double areaOff = tolerance * size * 8 + 1e-9 * (a.area + b.area);
    if (std::abs(a.area - b.area) > areaOff) return false;
    if (std::abs(*a.volume - *b.volume) > tolerance * (a.area + b.area) + 1e-9 * std::abs(*a.volume)) return false;
    const Invariants ofA = invariantsOf(a.moments), ofB = invariantsOf(b.moments);
    const double off = areaOff * size * size, most = std::max(ofA.trace, ofB.trace);
    return std::abs(ofA.trace - ofB.trace) <= off && std::abs(ofA.minors - ofB.minors) <= off * most &&
           std::abs(ofA.determinant - ofB.determinant) <= off * most * most;
}

bool areAtOnePlace(const Shape& a, const Shape& b, double tolerance) noexcept {
    if (!areAlike(a, b, tolerance)) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(a.center[axis] - b.center[axis]) > tolerance ||
            std::abs(a.box.min[axis] - b.box.min[axis]) > tolerance ||
            std::abs(a.box.max[axis] - b.box.max[axis]) > tolerance)
            return false;
    return true;
}

}  // namespace svt::compare
