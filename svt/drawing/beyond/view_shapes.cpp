#include <svt/drawing/beyond/view_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

constexpr double kOnViewPlane = 1e-5;         // metres, as for the cut
constexpr double kCosineOfCrease = 0.939693;  // of 20 degrees: facets of round things are not drawn
constexpr double kSeen = 1e-3;                // cosine: faces of outlines
constexpr double kFromTheSide = 1e-7;         // cosine below which a face is seen from the side
constexpr double kSliver = 5e-6;              // metres: lower triangles have no direction
// Facets of curved soffits and stringers of stairs. The two triangles of a helical soffit between two treads differ by
// up to 56 degrees near the newel.
constexpr double kCosineOfSoffit = 0.5;   // of 60 degrees
constexpr double kCosineOfString = 0.82;  // of 35 degrees: corners of hexagonal and octagonal posts stay
constexpr double kWidestFacet = 0.6;      // metres across an edge: straight flights and landings are wider
constexpr double kHorizontal = 0.98;      // cosine: treads and landings
constexpr double kUpright = 0.05;         // cosine
constexpr double kCoincident = 0.9999;    // cosine

// How the faces of a label are looked at.
struct LabelView {
    bool isShown = false;
    bool isClosed = false;  // faces that look away need not be asked
    bool isStair = false;
    double turn = 1;  // -1: seen from within
};

LabelView labelViewOf(std::uint32_t l, const volume::LabelTable& table, const std::vector<LabelFacts>& facts,
                      std::span<const std::uint8_t> isDrawn) {
    const volume::Label& label = table.labels[l];
    LabelView view;
    view.isClosed = facts[l].isClosed;
    view.isStair = facts[l].isStair;
    if (!facts[l].isSpace) {
        view.isShown = isDrawn[l] != 0 && label.className != "ClosureSurface";
        return view;
    }
    if (!view.isClosed || facts[l].hasSurfaces) return view;
    const std::uint32_t building = label.parent == kNoLabel ? kNoLabel : facts[label.parent].building;
    view.isShown = building != kNoLabel && isDrawn[building] != 0 && facts[building].isClosed;
    view.turn = -1;
    return view;
}

class MeshProjector {
public:
    MeshProjector(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
                  std::span<const std::uint8_t> isDrawn, const ViewOptions& options, const DrawingTables& tables)
        : parts_(volume.vectors),
          table_(volume.labels),
          isDrawn_(isDrawn),
          options_(options),
          tables_(tables),
          axes_(axes),
          away_(plane.normal * (options.looksAtCut ? 1.0 : -1.0)),
          base_(volume.grid.origin() - axes.origin) {
        handedness_ = dot(axes.normal, away_) > 0 ? 1 : -1;
        const Vec3d up = volume.grid.axes()[2];
        up_ = {dot(up, axes.u), dot(up, axes.v), dot(up, away_)};
        points_.resize(parts_.points.size());
        heights_.resize(parts_.points.size());
        isPlaced_.resize(parts_.points.size());
    }

    MeshProjector(const volume::SemanticVolume& volume, const EyeView& eye, std::span<const std::uint8_t> isDrawn,
                  const ViewOptions& options, const DrawingTables& tables)
        : parts_(volume.vectors),
          table_(volume.labels),
          isDrawn_(isDrawn),
          options_(options),
          tables_(tables),
          eye_(&eye) {
        handedness_ = dot(cross(eye.axes.u, eye.axes.v), eye.away) > 0 ? 1 : -1;
        const Vec3d up = volume.grid.axes()[2];
        up_ = {dot(up, eye.axes.u), dot(up, eye.axes.v), dot(up, eye.away)};
        for (const Vec3i& point : parts_.points) {
            const Vec3d world = volume.grid.origin() + toDouble(point) * parts_.unit;
            points_.push_back(eye.viewed(world));
            const double height = eye.hasCut ? dot(eye.cut.point - world, eye.cut.normal) : 1;
            heights_.push_back(std::abs(height) <= kOnViewPlane ? 0 : height);
        }
    }

    /// \param isNeeded  by label; empty: all
    ViewShapes run(std::span<const std::uint8_t> isNeeded) {
        const std::vector<MeshRun>& runs = tables_.runs();
        for (std::size_t run = 0; run < runs.size();) {
            const std::uint32_t label = runs[run].label;
            std::size_t next = run;
            while (next < runs.size() && runs[next].label == label) ++next;
            const LabelView view = isNeeded.empty() || isNeeded[label] != 0
                                       ? labelViewOf(label, table_, tables_.facts(), isDrawn_)
                                       : LabelView();
            if (view.isShown) addLabel(runs[run].first, runs[next - 1].end, view);
            run = next;
        }
        sortFaces();
        return std::move(shapes_);
    }

private:
    struct TriangleView {
        Vec3d normal;
        double facing = 0;  // see facingOf()
        std::uint32_t triangle = 0;
    };
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

    // Points of view space of a parallel view, where a label needs them.
    void place(std::uint32_t point) {
        if (eye_ != nullptr || isPlaced_[point] != 0) return;
        isPlaced_[point] = 1;
        const Vec3d p = base_ + toDouble(parts_.points[point]) * parts_.unit;
        const double depth = dot(p, away_);
        points_[point] = {dot(p, axes_.u), dot(p, axes_.v), std::abs(depth) <= kOnViewPlane ? 0 : depth};
        heights_[point] = points_[point].z;
    }

    void addLabel(std::size_t first, std::size_t end, const LabelView& view) {
        normals_.clear();
        halfEdges_.clear();
        for (std::size_t t = first; t < end; ++t) {
            const auto& triangle = parts_.triangles[t];
            const auto& c = triangle.corners;
            for (const std::uint32_t corner : c) place(corner);
            const bool isBehind = heights_[c[0]] > 0 || heights_[c[1]] > 0 || heights_[c[2]] > 0;
            if (!isBehind) continue;
            const Vec3d normal = normalOf(triangle, view.turn);
            normals_.push_back({normal, facingOf(triangle, normal), static_cast<std::uint32_t>(t)});
            addFace(triangle, normals_.back(), view);
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

    // The cosine between a normal and the line of sight: that of a perspective eye goes to the middle of the face.
    [[nodiscard]] double facingOf(const volume::VectorParts::Triangle& triangle, Vec3d normal) const noexcept {
        if (!isPerspective()) return normal.z;
        const auto& c = triangle.corners;
        const Vec3d middle = (points_[c[0]] + points_[c[1]] + points_[c[2]]) * (1.0 / 3);
        return dot(normal, normalized(middle + Vec3d{0, 0, eye_->distance}));
    }
    [[nodiscard]] bool isPerspective() const noexcept { return eye_ != nullptr && eye_->distance > 0; }
    [[nodiscard]] Vec3d pictured(Vec3d p) const noexcept { return eye_ != nullptr ? eye_->pictured(p) : p; }
    // The normal of a face in the picture, from one of its points; pointing away from the eye.
    [[nodiscard]] Vec3d picturedNormal(Vec3d normal, double facing, Vec3d point) const noexcept {
        Vec3d n = facing > 0 ? normal : -normal;
        if (isPerspective()) n = normalized(n + Vec3d{0, 0, dot(n, point) / eye_->distance});
        return n;
    }

    struct ClippedPoint {
        Vec3d at;
        double height = 0;  // over the plane that clips
    };
    // Adds the part of a triangle behind the plane, unless the triangle is seen edge-on.
    void addFace(const volume::VectorParts::Triangle& triangle, const TriangleView& seen, const LabelView& view) {
        if (std::abs(seen.facing) < kFromTheSide || (view.isClosed && seen.facing > 0)) return;
        std::array<ClippedPoint, 8> corners{}, clipped{};
        std::uint32_t count = 0;
        for (const std::uint32_t c : triangle.corners) corners[count++] = {points_[c], heights_[c]};
        count = clipCorners(corners, count, clipped);
        if (eye_ != nullptr) {
            for (std::uint32_t n = 0; n < count; ++n) clipped[n].height = clipped[n].at.z - eye_->nearest;
            count = clipCorners(clipped, count, corners);
            clipped = corners;
        }
        if (count < 3) return;
        ViewFace face;
        face.label = triangle.label;
        face.normal = picturedNormal(seen.normal, seen.facing, points_[triangle.corners[0]]);
        face.leastDepth = 1e300;
        for (std::uint32_t n = 0; n < count; ++n) {
            const Vec3d p = pictured(clipped[n].at);
            face.corners[face.cornerCount++] = p;
            face.leastDepth = std::min(face.leastDepth, p.z);
        }
        if (areaOf(face) < 0) std::reverse(face.corners.begin(), face.corners.begin() + face.cornerCount);
        shapes_.faces.push_back(face);
    }
    // The part of a convex polygon with heights from zero up.
    std::uint32_t clipCorners(const std::array<ClippedPoint, 8>& from, std::uint32_t count,
                              std::array<ClippedPoint, 8>& to) const noexcept {
        std::uint32_t kept = 0;
        for (std::uint32_t n = 0; n < count; ++n) {
            const ClippedPoint &a = from[n], &b = from[n + 1 < count ? n + 1 : 0];
            if (a.height >= 0) to[kept++] = a;
            if ((a.height < 0) != (b.height < 0) && a.height != 0 && b.height != 0) to[kept++] = {crossing(a, b), 0};
        }
        return kept;
    }
    // The same bits from both sides.
    [[nodiscard]] Vec3d crossing(ClippedPoint a, ClippedPoint b) const noexcept {
        if (b.at < a.at) std::swap(a, b);
        Vec3d p = a.at + (b.at - a.at) * (a.height / (a.height - b.height));
        if (eye_ == nullptr) p.z = 0;
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
            const auto& [normal, facing, t] = normals_[half.triangle];
            if (dot(normal, normal) == 0) continue;
            if (count++ == 0) first = normal;
            const double cosine = dot(first, normal);
            isCrease = isCrease || (view.isClosed ? cosine : std::abs(cosine)) < kCosineOfCrease;
            nearest = std::min(nearest, facing);
            farthest = std::max(farthest, facing);
        }
        if (count == 0) return;
        if (isCrease && view.isStair && isBetweenFacets(around)) {
            isCrease = false;
            const auto [a, b] = outerFaces(around);
            nearest = std::min(a->facing, b->facing);
            farthest = std::max(a->facing, b->facing);
        }
        // Where a round surface turns away from the eye: beside a face that is seen there is one that is not.
        const bool isOutline = view.isClosed ? nearest < -kSeen && farthest > -kSeen : count == 2 && isFold(around);
        if (count > 1 && !isCrease && !isOutline) return;
        if (view.isClosed && !options_.everyEdge && nearest > kFromTheSide) return;
        ClippedPoint from{points_[around[0].low], heights_[around[0].low]},
            to{points_[around[0].high], heights_[around[0].high]};
        if (!clipEdge(from, to)) return;
        if (eye_ != nullptr) {
            from.height = from.at.z - eye_->nearest;
            to.height = to.at.z - eye_->nearest;
            if (!clipEdge(from, to)) return;
        }
        ViewEdge edge{pictured(from.at), pictured(to.at), label, {}, 0, false};
        findFace(around, view, edge);
        shapes_.edges.push_back(edge);
    }

    // The two faces at an edge, without pairs of faces that lie on each other: those between two solid steps. Null if
    // others than two are left.
    [[nodiscard]] std::array<const TriangleView*, 2> outerFaces(std::span<const HalfEdge> around) const noexcept {
        std::array<const TriangleView*, 4> faces{};
        if (around.size() != 2 && around.size() != 4) return {};
        for (std::size_t n = 0; n < around.size(); ++n) faces[n] = &normals_[around[n].triangle];
        if (around.size() == 2) return {faces[0], faces[1]};
        for (const auto& [a, b, c, d] : {std::array{0, 1, 2, 3}, std::array{0, 2, 1, 3}, std::array{0, 3, 1, 2},
                                         std::array{1, 2, 0, 3}, std::array{1, 3, 0, 2}, std::array{2, 3, 0, 1}})
            if (dot(faces[std::size_t(a)]->normal, faces[std::size_t(b)]->normal) < -kCoincident)
                return {faces[std::size_t(c)], faces[std::size_t(d)]};
        return {};
    }

    // Whether an edge of a stair lies between two narrow facets of a curved soffit, or of a curved upright face.
    [[nodiscard]] bool isBetweenFacets(std::span<const HalfEdge> around) const noexcept {
        const Vec3d start = points_[around[0].low], edge = points_[around[0].high] - start;
        const auto faces = outerFaces(around);
        int upright = 0;
        for (const TriangleView* face : faces) {
            if (face == nullptr) return false;
            const double rise = std::abs(dot(face->normal, up_));
            if (rise > kHorizontal || dot(face->normal, face->normal) == 0) return false;
            upright += rise < kUpright ? 1 : 0;
            for (const std::uint32_t corner : parts_.triangles[face->triangle].corners)
                if (length(cross(edge, points_[corner] - start)) > kWidestFacet * length(edge)) return false;
        }
        if (upright == 1) return false;
        return dot(faces[0]->normal, faces[1]->normal) > (upright == 2 ? kCosineOfString : kCosineOfSoffit);
    }

    // Whether an edge has a part above zero, and that part.
    bool clipEdge(ClippedPoint& from, ClippedPoint& to) const noexcept {
        if (!(from.height > 0) && !(to.height > 0)) return false;
        if (from.height < 0) from = {crossing(from, to), 0};
        if (to.height < 0) to = {crossing(from, to), 0};
        return true;
    }

    // Whether the two faces of a sheet lie on one side of their edge, or one is seen from the side.
    [[nodiscard]] bool isFold(std::span<const HalfEdge> around) const noexcept {
        int sides = 0;
        for (const HalfEdge& half : around) {
            const auto& [normal, facing, t] = normals_[half.triangle];
            if (std::abs(facing) > kSeen) sides += sideOf(half, t);
        }
        return sides != 0;
    }
    // On which side of an edge a triangle lies in the drawing: 1 for the left from the lower point to the higher one.
    [[nodiscard]] int sideOf(const HalfEdge& half, std::uint32_t triangle) const noexcept {
        Vec3d third{};
        for (const std::uint32_t corner : parts_.triangles[triangle].corners)
            if (corner != half.low && corner != half.high) third = points_[corner];
        const Vec3d along = points_[half.high] - points_[half.low], across = third - points_[half.low];
        if (isPerspective())
            return dot(points_[half.low] + Vec3d{0, 0, eye_->distance}, cross(along, across)) > 0 ? 1 : -1;
        return along.x * across.y - along.y * across.x > 0 ? 1 : -1;
    }

    // The face that looks to the eye, where it is the only one.
    void findFace(std::span<const HalfEdge> around, const LabelView& view, ViewEdge& edge) const {
        for (const HalfEdge& half : around) {
            const auto& [normal, facing, t] = normals_[half.triangle];
            if (std::abs(facing) < kFromTheSide || (view.isClosed && facing > 0)) continue;
            if (edge.faceSide != 0) {
                edge.faceSide = 0;
                return;
            }
            edge.faceSide = sideOf(half, t);
            edge.normal = picturedNormal(normal, facing, points_[half.low]);
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
    const volume::LabelTable& table_;
    std::span<const std::uint8_t> isDrawn_;
    const ViewOptions& options_;
    const DrawingTables& tables_;
    PlaneAxes axes_;     // of a parallel view, as away_ and base_
    Vec3d away_, base_;  // depth; from the axes' origin to that of the points
    Vec3d up_;           // the grid's z axis in view space
    std::vector<std::uint8_t> isPlaced_;
    double handedness_ = 1;              // of u, v and depth
    const EyeView* eye_ = nullptr;       // or the plane's
    std::vector<Vec3d> points_;          // view space
    std::vector<double> heights_;        // of points behind the plane that cuts; below zero is cut away
    std::vector<TriangleView> normals_;  // of the label's triangles behind the plane
    std::vector<HalfEdge> halfEdges_;
    ViewShapes shapes_;
};

}  // namespace

ViewShapes projectMeshes(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
                         std::span<const std::uint8_t> isDrawn, const ViewOptions& options, const DrawingTables& tables,
                         std::span<const std::uint8_t> isNeeded) {
    return MeshProjector(volume, plane, axes, isDrawn, options, tables).run(isNeeded);
}

ViewShapes projectMeshes(const volume::SemanticVolume& volume, const EyeView& eye,
                         std::span<const std::uint8_t> isDrawn, bool everyEdge, const DrawingTables& tables) {
    const ViewOptions options{false, everyEdge};
    return MeshProjector(volume, eye, isDrawn, options, tables).run({});
}

}  // namespace svt::drawing
