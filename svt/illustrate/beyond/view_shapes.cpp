#include <svt/illustrate/beyond/view_shapes.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::illustrate {
namespace {

using volume::Filling;
using volume::kNoLabel;

constexpr double kOnViewPlane = 1e-5;         // metres, as for the cut
constexpr double kCosineOfCrease = 0.939693;  // of 20 degrees: facets of round things are not drawn
constexpr double kSeen = 1e-3;                // cosine: faces of outlines
constexpr double kFromTheSide = 1e-7;         // cosine below which a face is seen from the side
constexpr double kSliver = 5e-6;              // metres: lower triangles have no direction

bool isClosedFilling(Filling filling) noexcept { return filling >= Filling::Solid && filling <= Filling::Capped; }

// How the faces of a label are looked at.
struct LabelView {
    bool isShown = false;
    bool isClosed = false;  // faces that look away need not be asked
    double turn = 1;        // -1: seen from within
};

std::vector<LabelView> viewsOf(const volume::LabelTable& table, std::span<const std::uint8_t> isDrawn) {
    std::vector<LabelView> views(table.labels.size());
    std::vector<std::uint8_t> hasSurfaces(table.labels.size(), 0);
    for (const volume::Label& label : table.labels)
        if (label.parent != kNoLabel && label.count > 0 && model::isBoundarySurface(label.className))
            hasSurfaces[label.parent] = 1;
    for (std::uint32_t l = 0; l < views.size(); ++l) {
        const volume::Label& label = table.labels[l];
        LabelView& view = views[l];
        view.isClosed = isClosedFilling(label.filling);
        if (!model::isSpace(label.className)) {
            view.isShown = isDrawn[l] != 0 && label.className != "ClosureSurface";
            continue;
        }
        if (!view.isClosed || hasSurfaces[l] != 0) continue;
        std::uint32_t building = label.parent;
        while (building != kNoLabel && model::classRank(table.labels[building].className) != model::ClassRank::Building)
            building = table.labels[building].parent;
        view.isShown =
            building != kNoLabel && isDrawn[building] != 0 && isClosedFilling(table.labels[building].filling);
        view.turn = -1;
    }
    return views;
}

class MeshProjector {
public:
    MeshProjector(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
                  std::span<const std::uint8_t> isDrawn, const ViewOptions& options)
        : parts_(volume.vectors), options_(options), views_(viewsOf(volume.labels, isDrawn)) {
        const Vec3d away = plane.normal * (options.looksAtCut ? 1.0 : -1.0);
        handedness_ = dot(axes.normal, away) > 0 ? 1 : -1;
        const Vec3d base = volume.grid.origin() - axes.origin;
        points_.reserve(parts_.points.size());
        for (const Vec3i& point : parts_.points) {
            const Vec3d p = base + toDouble(point) * parts_.unit;
            const double depth = dot(p, away);
            points_.push_back({dot(p, axes.u), dot(p, axes.v), std::abs(depth) <= kOnViewPlane ? 0 : depth});
        }
    }

    ViewShapes run() {
        for (std::size_t first = 0; first < parts_.triangles.size();) {
            std::size_t end = first;
            while (end < parts_.triangles.size() && parts_.triangles[end].label == parts_.triangles[first].label) ++end;
            if (views_[parts_.triangles[first].label].isShown) addLabel(first, end);
            first = end;
        }
        sortFaces();
        return std::move(shapes_);
    }

private:
    struct HalfEdge {
        std::uint32_t low = 0, high = 0;  // points
        std::uint32_t triangle = 0;       // of normals_
    };

    // The normal of a triangle in view space, pointing out of the shell; zero for slivers.
    [[nodiscard]] Vec3d normalOf(const volume::VectorParts::Triangle& triangle, double turn) const noexcept {
        const Vec3d a = points_[triangle.corners[0]], b = points_[triangle.corners[1]],
                    c = points_[triangle.corners[2]];
        const Vec3d normal = cross(b - a, c - a) * (handedness_ * turn);
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        return length(normal) > kSliver * longest ? normalized(normal) : Vec3d{};
    }

    void addLabel(std::size_t first, std::size_t end) {
        const LabelView& view = views_[parts_.triangles[first].label];
        normals_.clear();
        halfEdges_.clear();
        for (std::size_t t = first; t < end; ++t) {
            const auto& triangle = parts_.triangles[t];
            const auto& c = triangle.corners;
            const bool isBehind = points_[c[0]].z > 0 || points_[c[1]].z > 0 || points_[c[2]].z > 0;
            if (!isBehind) continue;
            normals_.push_back({normalOf(triangle, view.turn), static_cast<std::uint32_t>(t)});
            addFace(triangle, normals_.back().first, view);
            for (std::size_t n = 0; n < 3; ++n) {
                const std::uint32_t a = c[n], b = c[(n + 1) % 3];
                halfEdges_.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(normals_.size() - 1)});
            }
        }
        std::sort(halfEdges_.begin(), halfEdges_.end(), [](const HalfEdge& a, const HalfEdge& b) {
            return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
        });
        for (std::size_t from = 0; from < halfEdges_.size();) {
            std::size_t to = from;
            while (to < halfEdges_.size() && halfEdges_[to].low == halfEdges_[from].low &&
                   halfEdges_[to].high == halfEdges_[from].high)
                ++to;
            addEdge(std::span(halfEdges_).subspan(from, to - from), parts_.triangles[first].label, view);
            from = to;
        }
    }

    // What lies behind the plane of a triangle that is not seen from the side.
    void addFace(const volume::VectorParts::Triangle& triangle, Vec3d normal, const LabelView& view) {
        if (std::abs(normal.z) < kFromTheSide || (view.isClosed && normal.z > 0)) return;
        ViewFace face;
        face.label = triangle.label;
        face.normal = normal.z > 0 ? normal : -normal;
        face.leastDepth = 1e300;
        const auto add = [&](Vec3d p) {
            face.corners[face.cornerCount++] = p;
            face.leastDepth = std::min(face.leastDepth, p.z);
        };
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3d a = points_[triangle.corners[n]], b = points_[triangle.corners[(n + 1) % 3]];
            if (a.z >= 0) add(a);
            if ((a.z < 0) != (b.z < 0) && a.z != 0 && b.z != 0) add(onPlane(a, b));
        }
        if (face.cornerCount < 3) return;
        if (areaOf(face) < 0) std::reverse(face.corners.begin(), face.corners.begin() + face.cornerCount);
        shapes_.faces.push_back(face);
    }
    // The same bits from both sides.
    static Vec3d onPlane(Vec3d a, Vec3d b) noexcept {
        if (b < a) std::swap(a, b);
        Vec3d p = a + (b - a) * (a.z / (a.z - b.z));
        p.z = 0;
        return p;
    }
    static double areaOf(const ViewFace& face) noexcept {
        double area = 0;
        for (std::uint32_t n = 2; n < face.cornerCount; ++n) {
            const Vec3d a = face.corners[n - 1] - face.corners[0], b = face.corners[n] - face.corners[0];
            area += 0.5 * (a.x * b.y - a.y * b.x);
        }
        return area;
    }

    void addEdge(std::span<const HalfEdge> around, std::uint32_t label, const LabelView& view) {
        Vec3d first{};
        double nearest = 1, farthest = -1;  // of the normals' components away from the eye
        bool isCrease = false;
        int count = 0;
        for (const HalfEdge& half : around) {
            const Vec3d normal = normals_[half.triangle].first;
            if (dot(normal, normal) == 0) continue;
            if (count++ == 0) first = normal;
            const double cosine = dot(first, normal);
            isCrease = isCrease || (view.isClosed ? cosine : std::abs(cosine)) < kCosineOfCrease;
            nearest = std::min(nearest, normal.z);
            farthest = std::max(farthest, normal.z);
        }
        if (count == 0) return;
        // Where a round surface turns away from the eye: beside a face that is seen there is one that is not.
        const bool isOutline = view.isClosed ? nearest < -kSeen && farthest > -kSeen : count == 2 && isFold(around);
        if (count > 1 && !isCrease && !isOutline) return;
        if (view.isClosed && !options_.everyEdge && nearest > kFromTheSide) return;
        Vec3d from = points_[around[0].low], to = points_[around[0].high];
        if (!(from.z > 0) && !(to.z > 0)) return;
        if (from.z < 0) from = onPlane(from, to);
        if (to.z < 0) to = onPlane(from, to);
        ViewEdge edge{from, to, label, {}, 0, false};
        findFace(around, view, edge);
        shapes_.edges.push_back(edge);
    }

    // Whether the two faces of a sheet lie on one side of their edge, or one is seen from the side.
    [[nodiscard]] bool isFold(std::span<const HalfEdge> around) const noexcept {
        int sides = 0;
        for (const HalfEdge& half : around) {
            const auto& [normal, t] = normals_[half.triangle];
            if (std::abs(normal.z) > kSeen) sides += sideOf(half, t);
        }
        return sides != 0;
    }
    // On which side of an edge a triangle lies in the drawing: 1 for the left from the lower point to the higher one.
    [[nodiscard]] int sideOf(const HalfEdge& half, std::uint32_t triangle) const noexcept {
        Vec3d third{};
        for (const std::uint32_t corner : parts_.triangles[triangle].corners)
            if (corner != half.low && corner != half.high) third = points_[corner];
        const Vec3d along = points_[half.high] - points_[half.low], across = third - points_[half.low];
        return along.x * across.y - along.y * across.x > 0 ? 1 : -1;
    }

    // The face that looks to the eye, where it is the only one.
    void findFace(std::span<const HalfEdge> around, const LabelView& view, ViewEdge& edge) const {
        for (const HalfEdge& half : around) {
            const auto& [normal, t] = normals_[half.triangle];
            if (std::abs(normal.z) < kFromTheSide || (view.isClosed && normal.z > 0)) continue;
            if (edge.faceSide != 0) {
                edge.faceSide = 0;
                return;
            }
            edge.faceSide = sideOf(half, t);
            edge.normal = normal.z > 0 ? normal : -normal;
        }
    }

    // The largest hide most, so they are asked first.
    void sortFaces() {
        std::vector<std::pair<double, std::uint32_t>> order;
        order.reserve(shapes_.faces.size());
        for (std::uint32_t f = 0; f < shapes_.faces.size(); ++f) order.emplace_back(-areaOf(shapes_.faces[f]), f);
        std::sort(order.begin(), order.end());
        std::vector<ViewFace> sorted;
        sorted.reserve(order.size());
        for (const auto& [area, f] : order) sorted.push_back(shapes_.faces[f]);
        shapes_.faces = std::move(sorted);
    }

    const volume::VectorParts& parts_;
    const ViewOptions& options_;
    std::vector<LabelView> views_;
    double handedness_ = 1;      // of u, v and depth
    std::vector<Vec3d> points_;  // view space
    std::vector<std::pair<Vec3d, std::uint32_t>>
        normals_;  // of the label's triangles behind the plane, and their numbers
    std::vector<HalfEdge> halfEdges_;
    ViewShapes shapes_;
};

}  // namespace

ViewShapes projectMeshes(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
                         std::span<const std::uint8_t> isDrawn, const ViewOptions& options) {
    return MeshProjector(volume, plane, axes, isDrawn, options).run();
}

}  // namespace svt::illustrate
