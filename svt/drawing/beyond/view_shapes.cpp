#include <svt/drawing/beyond/view_shapes.hpp>

#include <svt/drawing/exact/paged_array.hpp>

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

// A point of a mesh as seen.
struct PlacedPoint {
    Vec3d at;           // view space
    double height = 0;  // behind the plane that cuts; below zero is cut away
    bool isPlaced = false;
};

}  // namespace

class MeshProjection::Projector {
public:
    Projector(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
              std::span<const std::uint8_t> isDrawn, const ViewOptions& options, const DrawingTables& tables)
        : parts_(volume.vectors),
          table_(volume.labels),
          isDrawn_(isDrawn),
          options_(options),
          tables_(tables),
          facts_(tables.facts()),
          axes_(axes),
          away_(plane.normal * (options.looksAtCut ? 1.0 : -1.0)),
          origin_(volume.grid.origin()),
          points_(parts_.points.size()) {
        handedness_ = dot(axes.normal, away_) > 0 ? 1 : -1;
        const Vec3d up = volume.grid.axes()[2];
        up_ = {dot(up, axes.u), dot(up, axes.v), dot(up, away_)};
    }

    Projector(const volume::SemanticVolume& volume, const EyeView& eye, std::span<const std::uint8_t> isDrawn,
              const ViewOptions& options, const DrawingTables& tables)
        : parts_(volume.vectors),
          table_(volume.labels),
          isDrawn_(isDrawn),
          options_(options),
          tables_(tables),
          facts_(tables.facts()),
          origin_(volume.grid.origin()),
          eye_(&eye),
          points_(parts_.points.size()) {
        handedness_ = dot(cross(eye.axes.u, eye.axes.v), eye.away) > 0 ? 1 : -1;
        const Vec3d up = volume.grid.axes()[2];
        up_ = {dot(up, eye.axes.u), dot(up, eye.axes.v), dot(up, eye.away)};
    }

    [[nodiscard]] LabelView viewOf(std::uint32_t label) const { return labelViewOf(label, table_, facts_, isDrawn_); }

    void add(std::uint32_t label) {
        if (isAdded_.empty()) isAdded_.resize(table_.labels.size());
        if (std::exchange(isAdded_[label], 1) != 0) return;
        const LabelView view = viewOf(label);
        const auto& triangles = parts_.triangles;
        const auto first = std::lower_bound(triangles.begin(), triangles.end(), label,
                                            [](const auto& triangle, std::uint32_t l) { return triangle.label < l; });
        auto end = first;
        while (end != triangles.end() && end->label == label) ++end;
        if (!view.isShown || first == end) return;
        ShapesOfLabel own{label, shapes_.faces.size(), 0, shapes_.edges.size(), 0};
        addLabel(static_cast<std::size_t>(first - triangles.begin()), static_cast<std::size_t>(end - triangles.begin()),
                 view);
        own.endFace = shapes_.faces.size();
        own.endEdge = shapes_.edges.size();
        added_.push_back(own);
    }

    [[nodiscard]] const std::vector<ViewFace>& faces() const noexcept { return shapes_.faces; }

    ViewShapes take(std::span<const std::uint8_t> isNeeded) {
        const bool isPart = !added_.empty();
        for (const MeshRun& run : tables_.runs())
            if (isNeeded.empty() || isNeeded[run.label] != 0) add(run.label);
        if (isPart) sortLabels(isNeeded);
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

    struct ShapesOfLabel {
        std::uint32_t label = 0;
        std::size_t firstFace = 0, endFace = 0, firstEdge = 0, endEdge = 0;  // of shapes_
    };

    // Keeps the shapes of the needed labels, by label.
    void sortLabels(std::span<const std::uint8_t> isNeeded) {
        std::erase_if(added_, [&](const ShapesOfLabel& own) { return !isNeeded.empty() && isNeeded[own.label] == 0; });
        std::sort(added_.begin(), added_.end(),
                  [](const ShapesOfLabel& a, const ShapesOfLabel& b) { return a.label < b.label; });
        std::vector<ViewFace> faces;
        for (const ShapesOfLabel& own : added_)
            for (std::size_t f = own.firstFace; f < own.endFace; ++f) faces.push_back(shapes_.faces[f]);
        shapes_.faces = std::move(faces);
        std::vector<ViewEdge> edges;
        for (const ShapesOfLabel& own : added_)
            for (std::size_t e = own.firstEdge; e < own.endEdge; ++e) edges.push_back(shapes_.edges[e]);
        shapes_.edges = std::move(edges);
    }

    [[nodiscard]] Vec3d pointAt(std::uint32_t point) const noexcept { return points_[point].at; }

    // The normal of a triangle in view space, pointing out of the shell; zero for slivers.
    [[nodiscard]] Vec3d normalOf(const volume::VectorParts::Triangle& triangle, double turn) const noexcept {
        const Vec3d a = pointAt(triangle.corners[0]), b = pointAt(triangle.corners[1]),
                    c = pointAt(triangle.corners[2]);
        const Vec3d normal = cross(b - a, c - a) * (handedness_ * turn);
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        return length(normal) > kSliver * longest ? normalized(normal) : Vec3d{};
    }

    void place(std::uint32_t point) {
        PlacedPoint& placed = points_.at(point);
        if (placed.isPlaced) return;
        placed.isPlaced = true;
        if (eye_ != nullptr) {
            const Vec3d world = origin_ + toDouble(parts_.points[point]) * parts_.unit;
            placed.at = eye_->viewed(world);
            const double height = eye_->hasCut ? dot(eye_->cut.point - world, eye_->cut.normal) : 1;
            placed.height = std::abs(height) <= kOnViewPlane ? 0 : height;
            return;
        }
        const Vec3d p = (origin_ - axes_.origin) + toDouble(parts_.points[point]) * parts_.unit;
        const double depth = dot(p, away_);
        placed.height = std::abs(depth) <= kOnViewPlane ? 0 : depth;
        placed.at = {dot(p, axes_.u), dot(p, axes_.v), placed.height};
    }

    void addLabel(std::size_t first, std::size_t end, const LabelView& view) {
        normals_.clear();
        halfEdges_.clear();
        for (std::size_t t = first; t < end; ++t) {
            const auto& triangle = parts_.triangles[t];
            const auto& c = triangle.corners;
            for (const std::uint32_t corner : c) place(corner);
            const bool isBehind = points_[c[0]].height > 0 || points_[c[1]].height > 0 || points_[c[2]].height > 0;
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
        const Vec3d middle = (pointAt(c[0]) + pointAt(c[1]) + pointAt(c[2])) * (1.0 / 3);
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
        for (const std::uint32_t c : triangle.corners) corners[count++] = {points_[c].at, points_[c].height};
        count = clipCorners(corners, count, clipped);
        if (eye_ != nullptr) {
            for (std::uint32_t n = 0; n < count; ++n) clipped[n].height = clipped[n].at.z - eye_->nearest;
            count = clipCorners(clipped, count, corners);
            clipped = corners;
        }
        if (count < 3) return;
        ViewFace face;
        face.label = triangle.label;
        face.normal = picturedNormal(seen.normal, seen.facing, pointAt(triangle.corners[0]));
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
        ClippedPoint from{points_[around[0].low].at, points_[around[0].low].height},
            to{points_[around[0].high].at, points_[around[0].high].height};
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
        const Vec3d start = pointAt(around[0].low), edge = pointAt(around[0].high) - start;
        const auto faces = outerFaces(around);
        int upright = 0;
        for (const TriangleView* face : faces) {
            if (face == nullptr) return false;
            const double rise = std::abs(dot(face->normal, up_));
            if (rise > kHorizontal || dot(face->normal, face->normal) == 0) return false;
            upright += rise < kUpright ? 1 : 0;
            for (const std::uint32_t corner : parts_.triangles[face->triangle].corners)
                if (length(cross(edge, pointAt(corner) - start)) > kWidestFacet * length(edge)) return false;
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
            if (corner != half.low && corner != half.high) third = pointAt(corner);
        const Vec3d along = pointAt(half.high) - pointAt(half.low), across = third - pointAt(half.low);
        if (isPerspective())
            return dot(pointAt(half.low) + Vec3d{0, 0, eye_->distance}, cross(along, across)) > 0 ? 1 : -1;
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
            edge.normal = picturedNormal(normal, facing, pointAt(half.low));
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
    const std::vector<LabelFacts>& facts_;
    PlaneAxes axes_;                     // of a parallel view, as away_
    Vec3d away_;                         // depth
    Vec3d origin_;                       // of the points, world space
    Vec3d up_;                           // the grid's z axis in view space
    double handedness_ = 1;              // of u, v and depth
    const EyeView* eye_ = nullptr;       // or the plane's
    PagedArray<PlacedPoint> points_;     // by point of the volume; those of added labels are placed
    std::vector<std::uint8_t> isAdded_;  // by label
    std::vector<ShapesOfLabel> added_;   // in the order of shapes_
    std::vector<TriangleView> normals_;  // of the label's triangles behind the plane
    std::vector<HalfEdge> halfEdges_;
    ViewShapes shapes_;
};

MeshProjection::MeshProjection(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
                               std::span<const std::uint8_t> isDrawn, const ViewOptions& options,
                               const DrawingTables& tables)
    : projector_(std::make_unique<Projector>(volume, plane, axes, isDrawn, options, tables)) {}

MeshProjection::MeshProjection(const volume::SemanticVolume& volume, const EyeView& eye,
                               std::span<const std::uint8_t> isDrawn, const ViewOptions& options,
                               const DrawingTables& tables)
    : projector_(std::make_unique<Projector>(volume, eye, isDrawn, options, tables)) {}

MeshProjection::~MeshProjection() = default;

bool MeshProjection::isShown(std::uint32_t label) const { return projector_->viewOf(label).isShown; }

void MeshProjection::add(std::uint32_t label) { projector_->add(label); }

const std::vector<ViewFace>& MeshProjection::faces() const noexcept { return projector_->faces(); }

ViewShapes MeshProjection::take(std::span<const std::uint8_t> isNeeded) { return projector_->take(isNeeded); }

}  // namespace svt::drawing
