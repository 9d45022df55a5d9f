#include <svt/samples/parts/solid.hpp>

#include <svt/core/check.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace svt::samples {
namespace {

constexpr Length kUnits = kUnitsPerMillimetre;
// Cells of this width around a solid identify what is on the other side of its faces.
constexpr Length kMargin = 10;

struct Vertex2 {
    Length v = 0, z = 0;
};

bool inProfile(const Piece& piece, double v, double z) {
    for (const HalfPlane& side : piece.sides)
        if (double(side.across) * v + double(side.up) * z > double(side.limit)) return false;
    return true;
}

// a / scale is the same point; scales are positive.
bool isSame(const SectionCorner& a, const SectionCorner& b) {
    return a.v * b.scale == b.v * a.scale && a.z * b.scale == b.z * a.scale;
}

Box3d boxAround(Axis axis, const Piece& piece) {
    Box3d result;
    for (const SectionCorner& c : sectionOf(piece))
        for (const Length u : {piece.from, piece.to})
            result.add(axis == Axis::X ? Vec3d{double(u), c.across(), c.up()} : Vec3d{c.across(), double(u), c.up()});
    return result;
}

// Rounds outwards to whole millimetres.
Box3d rounded(Box3d box) {
    for (const int axis : {0, 1, 2}) {
        box.min[axis] = std::floor(box.min[axis] + 1e-6);
        box.max[axis] = std::ceil(box.max[axis] - 1e-6);
    }
    return box;
}

// A rectangle divided by whole lines into convex faces that meet edge to edge.
//
//     +------+---+----+
//     |      |  /|    |     every line runs through, so no vertex lies inside an edge
//     +------+-/-+----+
//     |      |/  |    |
//     +------+---+----+
class Arrangement {
public:
    Arrangement(Length v0, Length v1, Length z0, Length z1) {
        vertices_ = {{v0 * kUnits, z0 * kUnits},
                     {v1 * kUnits, z0 * kUnits},
                     {v1 * kUnits, z1 * kUnits},
                     {v0 * kUnits, z1 * kUnits}};
        faces_ = {{0, 1, 2, 3}};
    }

    void split(const HalfPlane& line) {
        std::vector<Length> distance(vertices_.size());
        bool anyBelow = false, anyAbove = false;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            distance[i] = line.across * vertices_[i].v + line.up * vertices_[i].z - line.limit * kUnits;
            anyBelow = anyBelow || distance[i] < 0;
            anyAbove = anyAbove || distance[i] > 0;
        }
        if (!anyBelow || !anyAbove) return;
        std::map<std::pair<int, int>, int> cuts;
        const std::size_t count = faces_.size();
        for (std::size_t f = 0; f < count; ++f) splitFace(f, distance, cuts);
    }

    // Must be called once after the last split().
    void connect() {
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for (std::size_t i = 0; i < faces_[f].size(); ++i)
                owners_[key(faces_[f][i], faces_[f][(i + 1) % faces_[f].size()])] = int(f);
    }

    [[nodiscard]] int across(int from, int to) const {
        const auto found = owners_.find(key(to, from));
        return found == owners_.end() ? -1 : found->second;
    }
    [[nodiscard]] const std::vector<std::vector<int>>& faces() const { return faces_; }
    [[nodiscard]] const Vertex2& vertex(int i) const { return vertices_[std::size_t(i)]; }

    // Millimetres.
    [[nodiscard]] std::array<double, 2> center(int face) const {
        double v = 0, z = 0;
        const auto& ring = faces_[std::size_t(face)];
        for (const int i : ring) {
            v += double(vertex(i).v);
            z += double(vertex(i).z);
        }
        const double scale = 1.0 / (double(ring.size()) * double(kUnits));
        return {v * scale, z * scale};
    }

    // Twice the area, in squared units.
    [[nodiscard]] Length doubleArea(int face) const {
        Length sum = 0;
        const auto& ring = faces_[std::size_t(face)];
        const Vertex2 o = vertex(ring[0]);
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
            const Vertex2 p = vertex(ring[i]), q = vertex(ring[i + 1]);
            sum += (p.v - o.v) * (q.z - o.z) - (p.z - o.z) * (q.v - o.v);
        }
        return sum;
    }

private:
    static std::uint64_t key(int from, int to) {
        return (std::uint64_t(std::uint32_t(from)) << 32) | std::uint32_t(to);
    }

    int cutEdge(int p, int q, const std::vector<Length>& distance, std::map<std::pair<int, int>, int>& cuts) {
        const auto [it, isNew] = cuts.try_emplace(std::minmax(p, q), int(vertices_.size()));
        if (isNew) {
            const Vertex2 a = vertex(p), b = vertex(q);
            const Length dp = distance[std::size_t(p)], dq = distance[std::size_t(q)];
            const Length v = (b.v - a.v) * dp, z = (b.z - a.z) * dp;
            // The designs use only pitches whose line intersections lie on the grid of 1/120 mm.
            SVT_CHECK(v % (dp - dq) == 0 && z % (dp - dq) == 0);
            vertices_.push_back({a.v + v / (dp - dq), a.z + z / (dp - dq)});
        }
        return it->second;
    }

    void splitFace(std::size_t face, const std::vector<Length>& distance, std::map<std::pair<int, int>, int>& cuts) {
        const std::vector<int> ring = faces_[face];
        bool isBelow = false, isAbove = false;
        for (const int i : ring) {
            isBelow = isBelow || distance[std::size_t(i)] < 0;
            isAbove = isAbove || distance[std::size_t(i)] > 0;
        }
        if (!isBelow || !isAbove) return;
        std::vector<int> below, above;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const int p = ring[k], q = ring[(k + 1) % ring.size()];
            const Length dp = distance[std::size_t(p)], dq = distance[std::size_t(q)];
            if (dp <= 0) below.push_back(p);
            if (dp >= 0) above.push_back(p);
            if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
                const int cut = cutEdge(p, q, distance, cuts);
                below.push_back(cut);
                above.push_back(cut);
            }
        }
        faces_[face] = std::move(below);
        faces_.push_back(std::move(above));
    }

    std::vector<Vertex2> vertices_;
    std::vector<std::vector<int>> faces_;
    std::unordered_map<std::uint64_t, int> owners_;
};

HalfPlane normalizedLine(HalfPlane side) {
    const Length divisor = std::gcd(std::gcd(side.across, side.up), side.limit);
    const bool flips = side.across < 0 || (side.across == 0 && side.up < 0);
    const Length factor = flips ? -divisor : divisor;
    return {side.across / factor, side.up / factor, side.limit / factor};
}

using Edge = std::pair<Point, Point>;
using Quad = std::vector<Point>;

// One cell face of the boundary, with its plane and the neighbour on its other side.
struct FacePart {
    std::tuple<int, HalfPlane, Length, bool, int> group;
    Quad ring;
};

Vec3d normalOf(const std::vector<Point>& ring) {
    Vec3d sum;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum = sum + cross(toDouble(ring[i] - ring[0]), toDouble(ring[i + 1] - ring[0]));
    return sum;
}

std::size_t findRoot(std::vector<std::size_t>& parents, std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

// Closed loops of directed edges. If several edges leave a vertex, the sharpest right turn is taken, so that a
// hole that touches the outer ring remains a separate ring.
std::vector<std::vector<Point>> traceLoops(const std::set<Edge>& edges, Vec3d normal) {
    std::multimap<Point, Point> next(edges.begin(), edges.end());
    std::vector<std::vector<Point>> loops;
    while (!next.empty()) {
        std::vector<Point> loop;
        auto step = next.begin();
        const Point start = step->first;
        for (;;) {
            const Point from = step->first, to = step->second;
            loop.push_back(from);
            next.erase(step);
            if (to == start) break;
            const Vec3d incoming = toDouble(to - from);
            const auto [first, last] = next.equal_range(to);
            double best = 10;
            step = next.end();
            for (auto it = first; it != last; ++it) {
                const Vec3d outgoing = toDouble(it->second - to);
                const double turn =
                    std::atan2(dot(normal, cross(incoming, outgoing)) / length(normal), dot(incoming, outgoing));
                if (turn < best) {
                    best = turn;
                    step = it;
                }
            }
            SVT_CHECK(step != next.end());
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

// Joins the fragments with the same plane and neighbour into maximal faces with holes.
void joinFragments(const std::vector<Quad>& fragments, int neighbor, std::vector<RawFace>& faces) {
    const Vec3d normal = normalOf(fragments.front());
    std::map<Edge, std::size_t> owners;
    for (std::size_t f = 0; f < fragments.size(); ++f)
        for (std::size_t i = 0; i < fragments[f].size(); ++i)
            owners[{fragments[f][i], fragments[f][(i + 1) % fragments[f].size()]}] = f;
    std::vector<std::size_t> parents(fragments.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    for (const auto& [edge, f] : owners) {
        const auto twin = owners.find({edge.second, edge.first});
        if (twin != owners.end()) parents[findRoot(parents, f)] = findRoot(parents, twin->second);
    }
    std::map<std::size_t, std::set<Edge>> outlines;
    std::vector<std::size_t> order;
    for (const auto& [edge, f] : owners) {
        if (owners.count({edge.second, edge.first}) != 0) continue;
        const std::size_t root = findRoot(parents, f);
        if (outlines[root].empty()) order.push_back(root);
        outlines[root].insert(edge);
    }
    for (const std::size_t root : order) {
        RawFace face;
        face.neighbor = neighbor;
        for (std::vector<Point>& loop : traceLoops(outlines[root], normal)) {
            const bool isOuter = dot(normalOf(loop), normal) > 0;
            face.rings.insert(isOuter ? face.rings.begin() : face.rings.end(), std::move(loop));
        }
        faces.push_back(std::move(face));
    }
}

// The cell complex of one solid and its touching neighbours.
class CellComplex {
public:
    CellComplex(const Solid& solid, std::span<const Neighbor> neighbors) : solid_(solid), bounds_(boundsOf(solid)) {
        for (const Neighbor& neighbor : neighbors)
            if (neighbor.solid != &solid && bounds_.overlaps(neighbor.bounds)) neighbors_.push_back(&neighbor);
        margin_ = neighbors_.empty() ? 0 : kMargin;
        collectPlanes();
        markCells();
    }

    [[nodiscard]] Boundary extract() {
        Boundary result;
        Length doubleVolume = 0;  // mm times squared units
        std::map<decltype(FacePart::group), std::vector<Quad>> groups;
        for (std::size_t slice = 0; slice + 1 < stops_.size(); ++slice)
            for (std::size_t f = 0; f < faceCount(); ++f) {
                if (!isInside(slice, f)) continue;
                doubleVolume += arrangement().doubleArea(int(f)) * (stops_[slice + 1] - stops_[slice]);
                addFragments(slice, f, groups);
            }
        for (const auto& [group, fragments] : groups) joinFragments(fragments, std::get<4>(group), result.faces);
        result.volume = double(doubleVolume) / (2.0 * double(kUnits * kUnits)) * 1e-9;
        return result;
    }

private:
    [[nodiscard]] const Arrangement& arrangement() const { return arrangement_; }
    [[nodiscard]] std::size_t faceCount() const { return arrangement_.faces().size(); }

    void collectPlanes() {
        const int along = solid_.axis == Axis::X ? 0 : 1, across = 1 - along;
        // Pieces of a neighbour that do not reach this solid divide nothing.
        const Vec3d margin{double(margin_), double(margin_), double(margin_)};
        const Box3d reach{bounds_.min - margin, bounds_.max + margin};
        const Length u0 = Length(reach.min[along]), u1 = Length(reach.max[along]);
        std::set<Length> stops{u0, u1};
        std::set<HalfPlane> lines;
        const auto take = [&](const Piece& piece) {
            for (const Length stop : {piece.from, piece.to})
                if (stop > u0 && stop < u1) stops.insert(stop);
            for (const HalfPlane& side : piece.sides) lines.insert(normalizedLine(side));
        };
        for (const Piece& piece : solid_.pieces) take(piece);
        for (const Neighbor* neighbor : neighbors_)
            for (std::size_t i = 0; i < neighbor->pieces.size(); ++i)
                if (reach.overlaps(neighbor->pieces[i])) take(neighbor->solid->pieces[i]);
        stops_.assign(stops.begin(), stops.end());
        arrangement_ =
            Arrangement(Length(reach.min[across]), Length(reach.max[across]), Length(reach.min.z), Length(reach.max.z));
        for (const HalfPlane& line : lines) arrangement_.split(line);
        arrangement_.connect();
        for (std::size_t f = 0; f < faceCount(); ++f) centers_.push_back(arrangement_.center(int(f)));
    }

    void markCells() {
        inside_.assign((stops_.size() - 1) * faceCount(), 0);
        for (const Piece& piece : solid_.pieces)
            for (std::size_t f = 0; f < faceCount(); ++f) {
                const auto [v, z] = centers_[f];
                if (!inProfile(piece, v, z)) continue;
                for (std::size_t slice = 0; slice + 1 < stops_.size(); ++slice)
                    if (piece.from <= stops_[slice] && stops_[slice + 1] <= piece.to)
                        inside_[slice * faceCount() + f] = piece.adds ? 1 : 0;
            }
    }

    [[nodiscard]] bool isInside(std::size_t slice, std::size_t face) const {
        return inside_[slice * faceCount() + face] != 0;
    }

    // Tag of the neighbour that fills the cell, or -1.
    [[nodiscard]] int tagOf(std::ptrdiff_t slice, int face) const {
        if (neighbors_.empty() || slice < 0 || face < 0 || slice + 1 >= std::ptrdiff_t(stops_.size())) return -1;
        const auto [v, z] = centers_[std::size_t(face)];
        const double u = 0.5 * double(stops_[std::size_t(slice)] + stops_[std::size_t(slice) + 1]);
        const Vec3d p = solid_.axis == Axis::X ? Vec3d{u, v, z} : Vec3d{v, u, z};
        for (const Neighbor* neighbor : neighbors_)
            if (neighbor->bounds.contains(p) && contains(*neighbor->solid, p)) return neighbor->tag;
        return -1;
    }

    [[nodiscard]] Point at(std::size_t stop, int vertex) const {
        const Vertex2 p = arrangement_.vertex(vertex);
        const Length u = stops_[stop] * kUnits;
        return solid_.axis == Axis::X ? Point{u, p.v, p.z} : Point{p.v, u, p.z};
    }

    void addFragments(std::size_t slice, std::size_t face,
                      std::map<decltype(FacePart::group), std::vector<Quad>>& groups) {
        const std::vector<int>& ring = arrangement_.faces()[face];
        // (axis, across, up) is right-handed for Axis::X and left-handed for Axis::Y.
        const auto emit = [&](decltype(FacePart::group) group, Quad quad) {
            if (solid_.axis == Axis::Y) std::reverse(quad.begin(), quad.end());
            groups[std::move(group)].push_back(std::move(quad));
        };
        for (const bool isFront : {false, true}) {
            const std::ptrdiff_t other = std::ptrdiff_t(slice) + (isFront ? 1 : -1);
            const bool exists = other >= 0 && other + 1 < std::ptrdiff_t(stops_.size());
            if (exists && isInside(std::size_t(other), face)) continue;
            const std::size_t stop = slice + (isFront ? 1 : 0);
            Quad quad;
            for (const int i : ring) quad.push_back(at(stop, i));
            if (!isFront) std::reverse(quad.begin(), quad.end());
            emit({0, HalfPlane{}, stops_[stop], isFront, tagOf(other, int(face))}, std::move(quad));
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const int p = ring[i], q = ring[(i + 1) % ring.size()];
            const int other = arrangement_.across(p, q);
            if (other >= 0 && isInside(slice, std::size_t(other))) continue;
            const Vertex2 a = arrangement_.vertex(p), b = arrangement_.vertex(q);
            const Length dv = b.v - a.v, dz = b.z - a.z;
            const HalfPlane line = normalizedLine({dz, -dv, dz * a.v - dv * a.z});
            const bool isFlipped = dz < 0 || (dz == 0 && dv > 0);
            emit({1, line, 0, isFlipped, tagOf(std::ptrdiff_t(slice), other)},
                 {at(slice, p), at(slice, q), at(slice + 1, q), at(slice + 1, p)});
        }
    }

    const Solid& solid_;
    Box3d bounds_;
    std::vector<const Neighbor*> neighbors_;
    Length margin_ = 0;
    std::vector<Length> stops_;
    Arrangement arrangement_{0, 1, 0, 1};
    std::vector<std::array<double, 2>> centers_;
    std::vector<std::uint8_t> inside_;
};

bool isCorner(Point before, Point at, Point after) { return cross(at - before, after - at) != Point{}; }

}  // namespace

Solid& Solid::add(Piece piece) {
    piece.adds = true;
    pieces.push_back(std::move(piece));
    return *this;
}

Solid& Solid::cut(Piece piece) {
    piece.adds = false;
    pieces.push_back(std::move(piece));
    return *this;
}

Piece box(Length x0, Length x1, Length y0, Length y1, Length z0, Length z1) {
    return {x0, x1, {{1, 0, y1}, {-1, 0, -y0}, {0, 1, z1}, {0, -1, -z0}}, true};
}

// All crossings of two sides that lie in all others. Sides have small whole coefficients, so that nothing overflows.
std::vector<SectionCorner> sectionOf(const Piece& piece) {
    std::vector<SectionCorner> corners;
    for (std::size_t i = 0; i < piece.sides.size(); ++i)
        for (std::size_t j = i + 1; j < piece.sides.size(); ++j) {
            const HalfPlane &a = piece.sides[i], &b = piece.sides[j];
            SectionCorner corner{a.limit * b.up - b.limit * a.up, a.across * b.limit - b.across * a.limit,
                                 a.across * b.up - b.across * a.up};
            if (corner.scale == 0) continue;
            if (corner.scale < 0) corner = {-corner.v, -corner.z, -corner.scale};
            const bool isInside = std::all_of(piece.sides.begin(), piece.sides.end(), [&](const HalfPlane& side) {
                return side.across * corner.v + side.up * corner.z <= side.limit * corner.scale;
            });
            const bool isNew = std::none_of(corners.begin(), corners.end(),
                                            [&](const SectionCorner& known) { return isSame(known, corner); });
            if (isInside && isNew) corners.push_back(corner);
        }
    double middleV = 0, middleZ = 0;
    for (const SectionCorner& c : corners) {
        middleV += c.across() / double(corners.size());
        middleZ += c.up() / double(corners.size());
    }
    const auto angleOf = [&](const SectionCorner& c) { return std::atan2(c.up() - middleZ, c.across() - middleV); };
    std::sort(corners.begin(), corners.end(),
              [&](const SectionCorner& a, const SectionCorner& b) { return angleOf(a) < angleOf(b); });
    return corners;
}

bool contains(const Solid& solid, Vec3d point) {
    const double u = solid.axis == Axis::X ? point.x : point.y;
    const double v = solid.axis == Axis::X ? point.y : point.x;
    for (auto piece = solid.pieces.rbegin(); piece != solid.pieces.rend(); ++piece)
        if (u >= double(piece->from) && u <= double(piece->to) && inProfile(*piece, v, point.z)) return piece->adds;
    return false;
}

Neighbor::Neighbor(const Solid& of, int number) : solid(&of), tag(number), bounds(boundsOf(of)) {
    for (const Piece& piece : of.pieces) pieces.push_back(rounded(boxAround(of.axis, piece)));
}

Box3d boundsOf(const Solid& solid) {
    Box3d all;
    for (const Piece& piece : solid.pieces)
        if (piece.adds) all.add(boxAround(solid.axis, piece));
    SVT_CHECK(!all.isEmpty());
    return rounded(all);
}

Boundary boundary(const Solid& solid, std::span<const Neighbor> neighbors) {
    return CellComplex(solid, neighbors).extract();
}

void collectCorners(const RawFace& face, std::vector<Point>& corners) {
    for (const auto& ring : face.rings)
        for (std::size_t i = 0; i < ring.size(); ++i)
            if (isCorner(ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]))
                corners.push_back(ring[i]);
}

void simplify(RawFace& face, std::span<const Point> corners) {
    for (auto& ring : face.rings)
        std::erase_if(ring, [&](const Point& p) { return !std::binary_search(corners.begin(), corners.end(), p); });
}

}  // namespace svt::samples
