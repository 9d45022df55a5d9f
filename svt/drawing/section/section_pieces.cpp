#include <svt/drawing/section/section_pieces.hpp>
#include <svt/volume/face_planes.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

namespace svt::drawing {
namespace {

using volume::BrickVolume;

// Bit a of corner number c: the corner is the upper one along axis a. Edge e = 4 a + 2 y + x is parallel to axis a; x
// and y are its position (0 lower, 1 upper) along the next two axes.
struct BoxEdge {
    int axis = 0;
    int lower = 0;           // its lower corner
    std::uint8_t faces = 0;  // bit 2 a + (upper ? 1 : 0): the two faces that share it
};

constexpr std::array<BoxEdge, 12> boxEdges() {
    std::array<BoxEdge, 12> edges{};
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 4; ++side) {
            const int b = (axis + 1) % 3, c = (axis + 2) % 3, x = side & 1, y = side >> 1;
            edges[static_cast<std::size_t>(4 * axis + side)] = {
                axis, (x << b) | (y << c), static_cast<std::uint8_t>((1 << (2 * b + x)) | (1 << (2 * c + y)))};
        }
    return edges;
}
constexpr std::array<BoxEdge, 12> kEdges = boxEdges();

// The box edges that a plane crosses, counter-clockwise as seen from above the plane.
struct Outline {
    std::array<std::uint8_t, 6> edges{};
    std::uint8_t count = 0;
};

// Table of outlines by the set of corners above the plane (as by marching cubes). Two crossed edges of one face follow
// each other; their order follows from which corners are above.
std::array<Outline, 256> makeOutlines() {
    std::array<Outline, 256> outlines{};
    const auto place = [](int corner) { return Vec3i{corner & 1, (corner >> 1) & 1, (corner >> 2) & 1}; };
    for (int above = 1; above < 255; ++above) {
        const auto isAbove = [&](int corner) { return ((above >> corner) & 1) != 0; };
        std::array<int, 12> next{};
        next.fill(-1);
        bool isPlane = true;
        for (int face = 0; face < 6; ++face) {
            std::array<int, 4> crossed{};
            int count = 0;
            for (int e = 0; e < 12; ++e) {
                const BoxEdge& edge = kEdges[static_cast<std::size_t>(e)];
                if (((edge.faces >> face) & 1) != 0 && isAbove(edge.lower) != isAbove(edge.lower | (1 << edge.axis)))
                    crossed[static_cast<std::size_t>(count++)] = e;
            }
            if (count == 0) continue;
            if (count != 2) {
                isPlane = false;
                break;
            }
            // On a face seen from outside, the corners above the plane must be on the left of the outline's step; then
            // the piece, seen from above, is on its left.
            const auto middle = [&](int e) {
                const BoxEdge& edge = kEdges[static_cast<std::size_t>(e)];
                return place(edge.lower) * 2 + place(1 << edge.axis);
            };
            const Vec3i step = middle(crossed[1]) - middle(crossed[0]);
            Vec3i outward{};
            outward[face / 2] = (face & 1) != 0 ? 1 : -1;
            const BoxEdge& first = kEdges[static_cast<std::size_t>(crossed[0])];
            const int high = isAbove(first.lower) ? first.lower : first.lower | (1 << first.axis);
            const Vec3i towards = place(high) * 2 - middle(crossed[0]);
            // For a counter-clockwise outline, step x towards points outwards.
            const bool isForward = dot(cross(step, towards), outward) > 0;
            const int from = isForward ? crossed[0] : crossed[1], to = isForward ? crossed[1] : crossed[0];
            if (next[static_cast<std::size_t>(from)] != -1) isPlane = false;
            next[static_cast<std::size_t>(from)] = to;
        }
        if (!isPlane) continue;  // no plane separates the corners like this
        const auto start = std::find_if(next.begin(), next.end(), [](int e) { return e != -1; });
        Outline outline;
        int at = static_cast<int>(start - next.begin());
        const int begin = at;
        do {
            if (outline.count == 6 || at == -1) {
                outline.count = 0;
                break;
            }
            outline.edges[outline.count++] = static_cast<std::uint8_t>(at);
            at = next[static_cast<std::size_t>(at)];
        } while (at != begin);
        outlines[static_cast<std::size_t>(above)] = outline;
    }
    return outlines;
}

struct PieceCorner {
    Vec3d voxel;
    std::uint8_t faces = 0;  // faces of the brick that it lies on
};

// A convex piece: at most 6 corners, plus one for each of 5 splits.
struct Piece {
    std::array<PieceCorner, 12> corners;
    std::size_t count = 0;
    void add(const PieceCorner& corner) noexcept {
        if (count < corners.size()) corners[count++] = corner;
    }
};

// An edge of a piece on a face between two bricks.
struct FaceEdge {
    std::uint64_t face = 0;
    PieceEdge edge;
};

class CellCutter {
public:
    CellCutter(const BrickVolume& bricks, std::span<const volume::FacePlane> faces, const CutPlane& plane,
               std::span<const std::uint32_t> labelOfScalar)
        : bricks_(bricks),
          faces_({}, bricks.brickCount() * 8, faces),
          plane_(plane),
          labelOfScalar_(labelOfScalar),
          outlines_(makeOutlines()) {}

    std::vector<PieceEdge> run() {
        // Rows of bricks run along the axis closest to the plane's normal, so that each row meets it in few bricks.
        const Vec3d slope{std::abs(plane_.gradient().x), std::abs(plane_.gradient().y), std::abs(plane_.gradient().z)};
        const int along = slope.z >= slope.x && slope.z >= slope.y ? 2 : slope.y >= slope.x ? 1 : 0;
        const int b = (along + 1) % 3, c = (along + 2) % 3;
        const Vec3i count = bricks_.brickCount();
        Vec3i at{};
        for (at[c] = 0; at[c] < count[c]; ++at[c])
            for (at[b] = 0; at[b] < count[b]; ++at[b]) {
                double low = 0, high = 0;
                for (int corner = 0; corner < 4; ++corner) {
                    Vec3d voxel;
                    voxel[along] = 0;
                    voxel[b] = 8.0 * (at[b] + (corner & 1));
                    voxel[c] = 8.0 * (at[c] + (corner >> 1));
                    const double crossed = -plane_.heightOf(voxel) / plane_.gradient()[along] / 8;
                    low = corner == 0 ? crossed : std::min(low, crossed);
                    high = corner == 0 ? crossed : std::max(high, crossed);
                }
                const double last = count[along] - 1;
                const auto first = static_cast<std::int32_t>(std::clamp(std::floor(low - 0.01), 0.0, last + 1));
                const auto end = static_cast<std::int32_t>(std::clamp(std::floor(high + 0.01), -1.0, last)) + 1;
                for (at[along] = first; at[along] < end; ++at[along]) cutBrick(at);
            }
        joinFaces();
        return std::move(edges_);
    }

private:
    [[nodiscard]] std::uint32_t labelOf(volume::Scalar scalar) const noexcept {
        return scalar < labelOfScalar_.size() ? labelOfScalar_[scalar] : volume::kNoLabel;
    }

    // Set of the corners of [min, max] that are above the plane, as bits.
    [[nodiscard]] std::size_t cornersAbove(Vec3d min, Vec3d max) const noexcept {
        std::size_t above = 0;
        for (int corner = 0; corner < 8; ++corner)
            if (plane_.isAbove((corner & 1) != 0 ? max.x : min.x, (corner & 2) != 0 ? max.y : min.y,
                               (corner & 4) != 0 ? max.z : min.z))
                above |= std::size_t{1} << corner;
        return above;
    }

    // The section of [min, max], a part of the current brick.
    [[nodiscard]] Piece pieceOf(std::size_t above, Vec3d min, Vec3d max) const noexcept {
        Piece piece;
        const Outline& outline = outlines_[above];
        for (std::size_t n = 0; n < outline.count; ++n) {
            const BoxEdge& edge = kEdges[outline.edges[n]];
            const Vec3d corner{(edge.lower & 1) != 0 ? max.x : min.x, (edge.lower & 2) != 0 ? max.y : min.y,
                               (edge.lower & 4) != 0 ? max.z : min.z};
            // A face of the part is on a face of the brick if their planes coincide.
            std::uint8_t faces = 0;
            for (int face = 0; face < 6; ++face) {
                const int axis = face / 2;
                const bool isOuter = (face & 1) != 0 ? max[axis] == high_[axis] : min[axis] == low_[axis];
                if (((edge.faces >> face) & 1) != 0 && isOuter) faces = static_cast<std::uint8_t>(faces | (1 << face));
            }
            piece.add({plane_.crossing(edge.axis, corner), faces});
        }
        return piece;
    }

    void cutBrick(Vec3i at) {
        low_ = at * 8;
        for (int axis = 0; axis < 3; ++axis) high_[axis] = std::min(low_[axis] + 8, bricks_.dimension()[axis]);
        const std::size_t above = cornersAbove(toDouble(low_), toDouble(high_));
        if (above == 0 || above == 255) return;
        brick_ = at;
        const BrickVolume::Entry entry = bricks_.entry(at.x, at.y, at.z);
        if (entry.isCoded()) {
            cutCoded(entry, above);
        } else if (entry.isMixed()) {
            cutVoxels();
        } else if (const std::uint32_t label = labelOf(bricks_.box(entry).scalar); label != volume::kNoLabel) {
            emit(pieceOf(above, toDouble(low_), toDouble(high_)), label);
        }
    }

    // The voxels of the current brick along an axis: where each begins and ends.
    struct Spans {
        struct Span {
            std::int32_t voxel = 0;
            double min = 0, max = 0;
        };
        std::array<Span, 10> spans;
        std::size_t count = 0;
    };

    // Borders lie on the model's faces. If the face for a side of the brick lies inside the brick, the space in front
    // of the face has the labels of the voxel beyond that side.
    [[nodiscard]] Spans spansAlong(int axis) const {
        Spans spans;
        double at = low_[axis];
        for (std::int32_t border = low_[axis]; border <= high_[axis]; ++border) {
            double place = border;
            const bool isOuter = border == 0 || border == bricks_.dimension()[axis];
            if (!isOuter)
                if (const auto face = faces_.find(axis, border, low_); face && face->normal[axis] == 1)
                    place = std::clamp(-face->offset, double(low_[axis]), double(high_[axis]));
            if (place > at) spans.spans[spans.count++] = {border - 1, at, place};
            at = place;
        }
        if (at < high_[axis]) spans.spans[spans.count++] = {high_[axis], at, double(high_[axis])};
        return spans;
    }

    void cutVoxels() {
        const Spans x = spansAlong(0), y = spansAlong(1), z = spansAlong(2);
        for (std::size_t k = 0; k < z.count; ++k)
            for (std::size_t j = 0; j < y.count; ++j)
                for (std::size_t i = 0; i < x.count; ++i) {
                    const auto &a = x.spans[i], &b = y.spans[j], &c = z.spans[k];
                    const Vec3d min{a.min, b.min, c.min}, max{a.max, b.max, c.max};
                    const std::size_t above = cornersAbove(min, max);
                    if (above == 0 || above == 255) continue;
                    emit(pieceOf(above, min, max), labelOf(bricks_.scalarAt(a.voxel, b.voxel, c.voxel)));
                }
    }

    void cutCoded(BrickVolume::Entry entry, std::size_t above) {
        const BrickVolume::BoxCoding& coding = bricks_.coding(entry);
        struct Part {
            Piece piece;
            std::size_t sides = 0;
        };
        std::array<Part, std::size_t{1} << BrickVolume::kMaxSides> parts;
        parts[0] = {pieceOf(above, toDouble(low_), toDouble(high_)), 0};
        std::size_t count = 1, bit = 1;
        const auto split = [&](Vec3d normal, double offset) {
            const std::size_t before = count;
            for (std::size_t n = 0; n < before; ++n) {
                const Piece whole = parts[n].piece;
                splitPiece(whole, normal, offset, parts[n].piece, parts[count].piece);
                parts[count++].sides = parts[n].sides | bit;
            }
            bit <<= 1;
        };
        coding.forEachSide(
            [&](int axis, std::uint16_t place) {
                Vec3d normal;
                normal[axis] = 1;
                split(normal, -double(place));
            },
            [&](std::uint32_t plane) { split(bricks_.planes()[plane].normal, bricks_.planes()[plane].offset); });
        for (std::size_t n = 0; n < count; ++n)
            if (parts[n].piece.count != 0) emit(parts[n].piece, labelOf(bricks_.sideScalar(coding, parts[n].sides)));
    }

    // Splits a piece by a plane. Both parts get the same new corners, and so do all pieces that share an edge.
    static void splitPiece(const Piece& piece, Vec3d normal, double offset, Piece& rest, Piece& positive) noexcept {
        rest.count = positive.count = 0;
        for (std::size_t n = 0; n < piece.count; ++n) {
            const PieceCorner& here = piece.corners[n];
            const PieceCorner& next = piece.corners[(n + 1) % piece.count];
            const double side = dot(normal, here.voxel) + offset, nextSide = dot(normal, next.voxel) + offset;
            (side > 0 ? positive : rest).add(here);
            if ((side > 0) == (nextSide > 0)) continue;
            const bool isOrdered = here.voxel < next.voxel;
            const Vec3d from = isOrdered ? here.voxel : next.voxel, to = isOrdered ? next.voxel : here.voxel;
            const double fromSide = isOrdered ? side : nextSide, toSide = isOrdered ? nextSide : side;
            const PieceCorner corner{from + (to - from) * (fromSide / (fromSide - toSide)),
                                     static_cast<std::uint8_t>(here.faces & next.faces)};
            rest.add(corner);
            positive.add(corner);
        }
    }

    void emit(const Piece& piece, std::uint32_t label) {
        if (label == volume::kNoLabel) return;
        std::array<plane::Point, 12> points;
        for (std::size_t n = 0; n < piece.count; ++n) points[n] = plane_.quantized(piece.corners[n].voxel);
        for (std::size_t n = 0; n < piece.count; ++n) {
            const std::size_t next = (n + 1) % piece.count;
            if (points[n] == points[next]) continue;
            const PieceEdge edge{points[n], points[next], label};
            const auto faces = static_cast<std::uint8_t>(piece.corners[n].faces & piece.corners[next].faces);
            if (faces == 0)
                edges_.push_back(edge);
            else
                faceEdges_.push_back({faceNumber(std::countr_zero(faces)), edge});
        }
    }

    // Number of a face, the same for both bricks that share it.
    [[nodiscard]] std::uint64_t faceNumber(int face) const noexcept {
        Vec3i at = brick_;
        const int axis = face / 2;
        if ((face & 1) != 0) ++at[axis];
        const Vec3i count = bricks_.brickCount();
        const auto number = static_cast<std::uint64_t>(at.x) +
                            static_cast<std::uint64_t>(count.x + 1) *
                                (static_cast<std::uint64_t>(at.y) +
                                 static_cast<std::uint64_t>(count.y + 1) * static_cast<std::uint64_t>(at.z));
        return 3 * number + static_cast<std::uint64_t>(axis);
    }

    // Bricks are cut independently, so on a shared face, edges of each brick are split at the corners of the other.
    void joinFaces() {
        std::ranges::sort(faceEdges_, [](const FaceEdge& a, const FaceEdge& b) {
            return std::tie(a.face, a.edge.from, a.edge.to, a.edge.label) <
                   std::tie(b.face, b.edge.from, b.edge.to, b.edge.label);
        });
        std::vector<plane::Point> points;
        for (std::size_t begin = 0, end = 0; begin < faceEdges_.size(); begin = end) {
            while (end < faceEdges_.size() && faceEdges_[end].face == faceEdges_[begin].face) ++end;
            points.clear();
            for (std::size_t n = begin; n < end; ++n) {
                points.push_back(faceEdges_[n].edge.from);
                points.push_back(faceEdges_[n].edge.to);
            }
            std::ranges::sort(points);
            points.erase(std::unique(points.begin(), points.end()), points.end());
            // All points are on one line, up to a drawing unit; sort them along it.
            const std::int64_t du = points.back().u - points.front().u, dv = points.back().v - points.front().v;
            const auto isBefore = [&](plane::Point a, plane::Point b) {
                const std::int64_t ta = a.u * du + a.v * dv, tb = b.u * du + b.v * dv;
                return ta != tb ? ta < tb : a < b;
            };
            std::ranges::sort(points, isBefore);
            for (std::size_t n = begin; n < end; ++n) addThrough(faceEdges_[n].edge, points, isBefore);
        }
    }

    template <class IsBefore>
    void addThrough(const PieceEdge& edge, const std::vector<plane::Point>& points, const IsBefore& isBefore) {
        const auto placeOf = [&](plane::Point p) {
            return std::lower_bound(points.begin(), points.end(), p, isBefore) - points.begin();
        };
        const std::ptrdiff_t from = placeOf(edge.from), to = placeOf(edge.to), step = from < to ? 1 : -1;
        for (std::ptrdiff_t n = from; n != to; n += step)
            edges_.push_back(
                {points[static_cast<std::size_t>(n)], points[static_cast<std::size_t>(n + step)], edge.label});
    }

    const BrickVolume& bricks_;
    const volume::FaceBorders faces_;
    const CutPlane& plane_;
    std::span<const std::uint32_t> labelOfScalar_;
    std::array<Outline, 256> outlines_;
    Vec3i brick_, low_, high_;  // the current brick, and its voxels
    std::vector<PieceEdge> edges_;
    std::vector<FaceEdge> faceEdges_;
};

}  // namespace

CutPlane::CutPlane(const SectionPlane& plane, const PlaneAxes& axes, const volume::Grid& grid) {
    const Vec3d spacing = grid.spacing(), toOrigin = grid.origin() - axes.origin;
    const auto affine = [&](Vec3d direction, Vec3d& perVoxel, double& offset) {
        for (int axis = 0; axis < 3; ++axis)
            perVoxel[axis] = dot(direction, grid.axes()[static_cast<std::size_t>(axis)]) * spacing[axis];
        offset = dot(direction, toOrigin) - 0.5 * (perVoxel.x + perVoxel.y + perVoxel.z);
    };
    affine(axes.normal, gradient_, offset_);
    affine(axes.u, uOfVoxel_, uOffset_);
    affine(axes.v, vOfVoxel_, vOffset_);
    // Remove rounding noise, so that planes parallel to a grid axis are exactly so.
    const double whole = std::abs(gradient_.x) + std::abs(gradient_.y) + std::abs(gradient_.z);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(gradient_[axis]) < 1e-13 * whole) gradient_[axis] = 0;
    const double smallest = std::min({spacing.x, spacing.y, spacing.z});
    offset_ += (dot(plane.normal, axes.normal) > 0 ? 1e-6 : -1e-6) * smallest;
    double extent = 0;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d voxel;
        for (int axis = 0; axis < 3; ++axis) voxel[axis] = ((corner >> axis) & 1) != 0 ? grid.dimension()[axis] : 0;
        extent =
            std::max({extent, std::abs(dot(uOfVoxel_, voxel) + uOffset_), std::abs(dot(vOfVoxel_, voxel) + vOffset_)});
    }
    drawingUnit_ = std::ldexp(1.0, std::ilogb(extent) + 1 - 29);
}

Vec3d CutPlane::crossing(int axis, Vec3d voxel) const noexcept {
    voxel[axis] = 0;
    voxel[axis] = -heightOf(voxel) / gradient_[axis];
    return voxel;
}

plane::Point CutPlane::quantized(Vec3d voxel) const noexcept {
    return {static_cast<std::int64_t>(std::floor((dot(uOfVoxel_, voxel) + uOffset_) / drawingUnit_ + 0.5)),
            static_cast<std::int64_t>(std::floor((dot(vOfVoxel_, voxel) + vOffset_) / drawingUnit_ + 0.5))};
}

std::vector<PieceEdge> cutPieces(const BrickVolume& bricks, std::span<const volume::FacePlane> faces,
                                 const CutPlane& plane, std::span<const std::uint32_t> labelOfScalar) {
    return CellCutter(bricks, faces, plane, labelOfScalar).run();
}

}  // namespace svt::drawing
