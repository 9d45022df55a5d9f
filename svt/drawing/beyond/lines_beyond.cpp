#include <svt/drawing/beyond/lines_beyond.hpp>

#include <svt/core/parallel.hpp>
#include <svt/drawing/beyond/cut_region.hpp>
#include <svt/drawing/beyond/labels_in_view.hpp>
#include <svt/drawing/beyond/merge_lines.hpp>
#include <svt/drawing/beyond/piercing.hpp>
#include <svt/drawing/beyond/view_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace svt::drawing {
namespace {

constexpr double kOnFace = 2e-4;      // metres: lines within this distance of a face lie on it
constexpr double kBehindFace = 2e-6;  // metres: where a line pierces a face
constexpr double kAlongSide = 5e-5;   // metres: lines that run along the side of a face are behind it
constexpr double kAcrossSide = 1e-7;  // metres: others end there
constexpr double kSteep = 0.05;       // sine of the angle that separates the two
constexpr double kBesideEdge = 2e-4;  // metres: where to look for the face on the other side of a joint
constexpr double kSameDirection = 0.99999;

// Whether faces of two labels that lie in one plane show no joint.
class JointRule {
public:
    JointRule(const volume::LabelTable& table, const DrawingTables& tables)
        : table_(table), facts_(tables.facts()), hatches_(tables.hatches()) {}

    [[nodiscard]] bool isJoint(std::uint32_t a, std::uint32_t b) const noexcept {
        if (a == b) return true;
        const LabelFacts &x = facts_[a], &y = facts_[b];
        if (!x.isElement || !y.isElement || x.building != y.building) return false;
        // A sheet lies on the object that it bounds.
        if (x.isSheet != y.isSheet) return true;
        return (*hatches_)[a] == (*hatches_)[b] && table_.labels[a].className == table_.labels[b].className;
    }

private:
    const volume::LabelTable& table_;
    const std::vector<LabelFacts>& facts_;
    std::shared_ptr<const std::vector<render::Hatch>> hatches_;
};

// Buffers of one thread.
struct ClipScratch {
    PlaneIndex::Seen seen;
    CutRegion::Scratch cut;
    std::vector<LinePart> covered, joints;
};

// A box around an edge or a face, with a margin that is larger than all distances within which they act on each other.
// Most faces near an edge end beside it or lie deeper: this small record decides that.
struct NearBox {
    float low[2], high[2], leastDepth;

    explicit NearBox(std::span<const Vec3d> corners) noexcept : low{kFar, kFar}, high{-kFar, -kFar}, leastDepth(kFar) {
        for (const Vec3d& corner : corners) {
            for (int axis = 0; axis < 2; ++axis) {
                low[axis] = std::min(low[axis], below(corner[axis]));
                high[axis] = std::max(high[axis], -below(-corner[axis]));
            }
            leastDepth = std::min(leastDepth, below(corner.z));
        }
    }
    [[nodiscard]] bool meets(const NearBox& other) const noexcept {
        return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1];
    }

private:
    static constexpr float kFar = 3e38F;
    // Farther than the rounding of a float.
    static float below(double at) noexcept {
        constexpr double kMargin = 1e-3, kShare = 1e-6;  // metres
        return static_cast<float>(std::clamp(at - kMargin - kShare * std::abs(at), -1e38, 1e38));
    }
};

class LineClipper {
public:
    LineClipper(const ViewShapes& shapes, const CutRegion& cut, const JointRule& rule, bool wantsHidden)
        : shapes_(shapes), cut_(cut), rule_(rule), wantsHidden_(wantsHidden), index_(indexOf(shapes)) {
        boxes_.reserve(shapes.faces.size());
        for (const ViewFace& face : shapes.faces) boxes_.emplace_back(std::span(face.corners).first(face.cornerCount));
    }

    // The visible parts of an edge, and, if asked for, the others.
    void clip(const ViewEdge& edge, BeyondKind kind, ClipScratch& scratch, std::vector<BeyondLine>& lines) const {
        const PlanePoint from{edge.from.x, edge.from.y}, to{edge.to.x, edge.to.y};
        const double length = std::hypot(to.u - from.u, to.v - from.v);
        if (length < kShortestPiece) return;
        scratch.covered.clear();
        scratch.joints.clear();
        cut_.addCovered(from, to, scratch.cut, scratch.covered);
        const double deepest = std::max(edge.from.z, edge.to.z);
        const Vec3d ends[2] = {edge.from, edge.to};
        const NearBox box(ends);
        index_.visitNear(from, to, scratch.seen, [&](std::uint32_t f) {
            if (!boxes_[f].meets(box) || (edge.faceSide == 0 && boxes_[f].leastDepth > deepest)) return true;
            const ViewFace& face = shapes_.faces[f];
            if (edge.faceSide != 0) addJoint(edge, length, face, scratch.joints);
            if (face.leastDepth > deepest) return true;
            LinePart part;
            if (!hides(face, edge, length, part)) return true;
            scratch.covered.push_back(part);
            return part.from > 0 || part.to < 1 || (wantsHidden_ && edge.faceSide != 0);
        });
        const double least = kShortestPiece / length;
        const auto add = [&](const std::vector<LinePart>& parts, BeyondKind of) {
            for (const LinePart& part : parts)
                lines.push_back({at(edge, part.from), at(edge, part.to), edge.label, of});
        };
        scratch.covered.insert(scratch.covered.end(), scratch.joints.begin(), scratch.joints.end());
        const std::vector<LinePart> visible = partsLeft({0, 1}, scratch.covered, least);
        add(visible, kind);
        if (!wantsHidden_ || edge.isPiercing) return;
        scratch.joints.insert(scratch.joints.end(), visible.begin(), visible.end());
        add(partsLeft({0, 1}, scratch.joints, least), BeyondKind::Hidden);
    }

private:
    static PlaneIndex indexOf(const ViewShapes& shapes) {
        std::vector<PlanePoint> corners;
        std::vector<std::uint32_t> starts{0};
        for (const ViewFace& face : shapes.faces) {
            for (std::uint32_t n = 0; n < face.cornerCount; ++n)
                corners.push_back({face.corners[n].x, face.corners[n].y});
            starts.push_back(static_cast<std::uint32_t>(corners.size()));
        }
        return {corners, starts, 2 * kBesideEdge};
    }
    static PlanePoint at(const ViewEdge& edge, double t) noexcept {
        // The ends as they are: pieces of neighbouring edges meet in the same bits.
        if (t <= 0) return {edge.from.x, edge.from.y};
        if (t >= 1) return {edge.to.x, edge.to.y};
        const Vec3d p = edge.from + (edge.to - edge.from) * t;
        return {p.x, p.y};
    }

    // Clips a line to the sides of a face in the drawing.
    // \param slack  how far outside a line that runs along a side may lie; others: kAcrossSide, or 0 without slack
    static bool clipToFace(const ViewFace& face, Vec3d from, Vec3d along, double length, double slack,
                           LinePart& part) noexcept {
        double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
        for (std::uint32_t n = 0; n < face.cornerCount; ++n) {
            const Vec3d a = face.corners[n], b = face.corners[n + 1 < face.cornerCount ? n + 1 : 0];
            const double eu = b.x - a.x, ev = b.y - a.y, side = std::hypot(eu, ev);
            for (int axis = 0; axis < 2; ++axis) {
                low[axis] = std::min(low[axis], a[axis]);
                high[axis] = std::max(high[axis], a[axis]);
            }
            if (!(side > 0)) continue;
            const double begin = (eu * (from.y - a.y) - ev * (from.x - a.x)) / side;
            const double change = (eu * along.y - ev * along.x) / side;
            const double out = slack == 0 ? 0 : std::abs(change) > kSteep * length ? kAcrossSide : slack;
            if (!clipPart(part, begin + out, change)) return false;
        }
        // Between two sides at an acute angle the slack reaches far.
        for (int axis = 0; axis < 2; ++axis)
            if (!clipPart(part, from[axis] - low[axis] + slack, along[axis]) ||
                !clipPart(part, high[axis] - from[axis] + slack, -along[axis]))
                return false;
        return part.to > part.from;
    }

    static bool hides(const ViewFace& face, const ViewEdge& edge, double length, LinePart& part) noexcept {
        const Vec3d along = edge.to - edge.from;
        const double begin = dot(face.normal, edge.from - face.corners[0]), change = dot(face.normal, along);
        const double least = std::abs(change) > kSteep * svt::length(along) ? kBehindFace : kOnFace;
        return clipPart(part, begin - least, change) && clipToFace(face, edge.from, along, length, kAlongSide, part);
    }

    // Where a face lies in the plane of the edge's own, on its other side.
    void addJoint(const ViewEdge& edge, double length, const ViewFace& face, std::vector<LinePart>& joints) const {
        if (dot(face.normal, edge.normal) < kSameDirection) return;
        if (!rule_.isJoint(edge.label, face.label)) return;
        const Vec3d along = edge.to - edge.from;
        const double begin = dot(face.normal, edge.from - face.corners[0]), change = dot(face.normal, along);
        LinePart part;
        if (!clipPart(part, begin + kOnFace, change) || !clipPart(part, kOnFace - begin, -change)) return;
        const double beside = -edge.faceSide * kBesideEdge / length;
        const Vec3d from = edge.from + Vec3d{-along.y * beside, along.x * beside, 0};
        if (clipToFace(face, from, along, length, 0, part)) joints.push_back(part);
    }

    const ViewShapes& shapes_;
    const CutRegion& cut_;
    const JointRule& rule_;
    bool wantsHidden_;
    PlaneIndex index_;
    std::vector<NearBox> boxes_;  // by face
};

void clipEdges(const std::vector<ViewEdge>& edges, const LineClipper& clipper, BeyondKind kind, int threads,
               std::vector<BeyondLine>& lines) {
    constexpr std::size_t kBatch = 64;
    std::vector<std::vector<BeyondLine>> ofBatch((edges.size() + kBatch - 1) / kBatch);
    parallelFor(ofBatch.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        ClipScratch scratch;
        for (std::size_t batch = begin; batch < end; ++batch)
            for (std::size_t e = batch * kBatch; e < std::min((batch + 1) * kBatch, edges.size()); ++e)
                clipper.clip(edges[e], kind, scratch, ofBatch[batch]);
    });
    for (const std::vector<BeyondLine>& batch : ofBatch) lines.insert(lines.end(), batch.begin(), batch.end());
}

// Leaves out edges beyond a depth, and the faces that cannot hide the others. Without this, the plan of each storey would
// search the faces of all storeys below.
void leaveOutBeyond(double depth, ViewShapes& shapes) {
    std::erase_if(shapes.edges, [&](const ViewEdge& edge) { return std::min(edge.from.z, edge.to.z) > depth; });
    double deepest = 0;
    for (const ViewEdge& edge : shapes.edges) deepest = std::max({deepest, edge.from.z, edge.to.z});
    std::erase_if(shapes.faces, [&](const ViewFace& face) { return face.leastDepth > deepest; });
}

}  // namespace

void addLinesBeyond(SectionDrawing& drawing, const volume::SemanticVolume& volume,
                    std::span<const std::uint8_t> isDrawn, const BeyondOptions& options, const DrawingTables& tables,
                    int threads) {
    if (!options.isAny() || volume.vectors.triangles.empty()) return;
    const CutRegion cut(drawing, volume.labels);
    const JointRule rule(volume.labels, tables);
    std::vector<BeyondLine> lines;
    for (const bool looksAtCut : {false, true}) {
        if (looksAtCut ? !options.above : !options.visible && !options.hidden) continue;
        const bool wantsHidden = !looksAtCut && options.hidden;
        const ViewOptions view{looksAtCut, wantsHidden};
        const double depth = looksAtCut ? 0 : options.depth;
        MeshProjection projection(volume, drawing.plane, drawing.axes, isDrawn, view, tables);
        ViewShapes shapes = projection.take(labelsInView(volume, drawing, view, depth, tables, projection));
        if (depth > 0) leaveOutBeyond(depth, shapes);
        const LineClipper clipper(shapes, cut, rule, wantsHidden);
        const BeyondKind kind = looksAtCut ? BeyondKind::Above : BeyondKind::Visible;
        clipEdges(shapes.edges, clipper, kind, threads, lines);
        clipEdges(findPiercingLines(shapes.faces), clipper, kind, threads, lines);
    }
    drawing.beyond = mergeLines(std::move(lines), drawing, volume.labels, threads);
    if (!options.visible)
        std::erase_if(drawing.beyond, [](const BeyondLine& line) { return line.kind == BeyondKind::Visible; });
}

void addLinesOfView(SectionDrawing& drawing, const volume::SemanticVolume& volume,
                    std::span<const std::uint8_t> isDrawn, const EyeView& eye, bool isHidden, int threads) {
    if (volume.vectors.triangles.empty()) return;
    const DrawingTables tables(volume);
    const CutRegion cut(drawing, volume.labels);
    const JointRule rule(volume.labels, tables);
    const ViewOptions view{false, isHidden};
    const ViewShapes shapes = MeshProjection(volume, eye, isDrawn, view, tables).take({});
    const LineClipper clipper(shapes, cut, rule, isHidden);
    std::vector<BeyondLine> lines;
    clipEdges(shapes.edges, clipper, BeyondKind::Visible, threads, lines);
    clipEdges(findPiercingLines(shapes.faces), clipper, BeyondKind::Visible, threads, lines);
    drawing.beyond = mergeLines(std::move(lines), drawing, volume.labels, threads);
}

}  // namespace svt::drawing
