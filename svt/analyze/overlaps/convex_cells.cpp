#include <svt/analyze/overlaps/convex_cells.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::analyze {
namespace {

constexpr double kFlat = 1e-9;  // metres: corners this near to a plane lie on it
constexpr std::size_t kMostCells = 4096;

// Appends the part of a polygon that is inside (sign 1) or beyond (-1) a plane.
void appendPart(std::span<const Vec3d> polygon, const HalfSpace& plane, double sign, std::vector<Vec3d>& part) {
    Vec3d p = polygon.back();
    double atP = sign * plane.beyond(p);
    for (const Vec3d& q : polygon) {
        const double atQ = sign * plane.beyond(q);
        if ((atP <= 0) != (atQ <= 0)) part.push_back(p + (q - p) * (atP / (atP - atQ)));
        if (atQ <= 0) part.push_back(q);
        p = q;
        atP = atQ;
    }
}

void endFace(const HalfSpace& plane, std::size_t begin, ConvexCell& cell) {
    if (cell.corners.size() < begin + 3) {
        cell.corners.resize(begin);
        return;
    }
    for (std::size_t n = begin; n < cell.corners.size(); ++n) cell.box.add(cell.corners[n]);
    cell.faces.push_back({plane, std::uint32_t(begin), std::uint32_t(cell.corners.size())});
}

// The part of a plane that lies in a cell, counter-clockwise around the normal.
void findSection(const ConvexCell& cell, const HalfSpace& plane, std::vector<Vec3d>& section) {
    const Vec3d n = plane.normal, center = cell.box.center(), size = cell.box.size();
    const Vec3d axis = std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const double reach = 2 * (size.x + size.y + size.z);
    const Vec3d u = normalized(cross(n, axis)) * reach, v = cross(n, u), o = center - n * plane.beyond(center);
    section.assign({o - u - v, o + u - v, o + u + v, o - u + v});
    std::vector<Vec3d> part;
    for (const ConvexCell::Face& face : cell.faces) {
        part.clear();
        appendPart(section, face.plane, 1, part);
        section.swap(part);
        if (section.size() < 3) {
            section.clear();
            return;
        }
    }
}

enum class Lies : std::uint8_t { Inside, Beyond, Both };

Lies sideOf(const ConvexCell& cell, const HalfSpace& plane) {
    bool hasInside = false, hasBeyond = false;
    for (const Vec3d& corner : cell.corners) {
        const double at = plane.beyond(corner);
        hasInside = hasInside || at < -kFlat;
        hasBeyond = hasBeyond || at > kFlat;
        if (hasInside && hasBeyond) return Lies::Both;
    }
    return hasBeyond ? Lies::Beyond : Lies::Inside;
}

// Cuts a cell that lies on both sides of a plane.
std::pair<ConvexCell, ConvexCell> cut(const ConvexCell& cell, const HalfSpace& plane) {
    std::pair<ConvexCell, ConvexCell> parts;
    std::vector<Vec3d> section;
    findSection(cell, plane, section);
    for (const double sign : {1.0, -1.0}) {
        ConvexCell& part = sign > 0 ? parts.first : parts.second;
        part.faces.reserve(cell.faces.size() + 1);
        part.corners.reserve(cell.corners.size() + section.size() + 4);
        for (const ConvexCell::Face& face : cell.faces) {
            const std::size_t begin = part.corners.size();
            appendPart(std::span(cell.corners).subspan(face.begin, face.end - face.begin), plane, sign, part.corners);
            endFace(face.plane, begin, part);
        }
        const std::size_t begin = part.corners.size();
        if (sign > 0) {
            part.corners.insert(part.corners.end(), section.begin(), section.end());
            endFace(plane, begin, part);
        } else {
            part.corners.insert(part.corners.end(), section.rbegin(), section.rend());
            endFace({-plane.normal, -plane.offset}, begin, part);
        }
    }
    return parts;
}

bool takeSteps(std::uint64_t steps, std::uint64_t& work) {
    if (steps > work) return false;
    work -= steps;
    return true;
}

// Divides a cell by the faces of a mesh in it.
class CellDivider {
public:
    CellDivider(std::vector<ConvexCell>& cells, std::uint64_t& work) : cells_(cells), work_(work) {}

    struct Facet {
        HalfSpace plane;
        std::vector<Vec3d> corners;
        double area = 0;
    };

    // False if the work does not suffice. All facets lie in the cell.
    bool divide(ConvexCell cell, std::vector<Facet> facets) {
        while (true) {
            if (!takeSteps(facets.size() + cell.faces.size(), work_) || cells_.size() > kMostCells) return false;
            const auto largest = std::max_element(facets.begin(), facets.end(),
                                                  [](const Facet& a, const Facet& b) { return a.area < b.area; });
            const HalfSpace plane = largest->plane;
            auto [inside, beyond] = sorted(std::move(facets), plane);
            const Lies side = sideOf(cell, plane);
            if (side == Lies::Both) {
                auto [below, above] = cut(cell, plane);
                if (!beyond.empty() && !divide(std::move(above), std::move(beyond))) return false;
                cell = std::move(below);
            } else if (side == Lies::Beyond) {
                if (beyond.empty()) return true;
                facets = std::move(beyond);
                continue;
            }
            if (inside.empty()) {
                cells_.push_back(std::move(cell));
                return true;
            }
            facets = std::move(inside);
        }
    }

private:
    // The parts of the facets inside and beyond a plane, without those that lie on it.
    static std::pair<std::vector<Facet>, std::vector<Facet>> sorted(std::vector<Facet> facets, const HalfSpace& plane) {
        std::pair<std::vector<Facet>, std::vector<Facet>> parts;
        for (Facet& facet : facets) {
            double low = 0, high = 0;
            for (const Vec3d& corner : facet.corners) {
                low = std::min(low, plane.beyond(corner));
                high = std::max(high, plane.beyond(corner));
            }
            const bool hasInside = low<-kFlat, hasBeyond = high> kFlat;
            if (hasInside && hasBeyond) {
                for (const double sign : {1.0, -1.0}) {
                    Facet part{facet.plane, {}, facet.area};
                    appendPart(facet.corners, plane, sign, part.corners);
                    if (part.corners.size() >= 3) (sign > 0 ? parts.first : parts.second).push_back(std::move(part));
                }
            } else if (hasInside || hasBeyond) {
                (hasInside ? parts.first : parts.second).push_back(std::move(facet));
            }
        }
        return parts;
    }

    std::vector<ConvexCell>& cells_;
    std::uint64_t& work_;
};

// Adds what remains of a cell without another.
bool addRest(const ConvexCell& cell, const ConvexCell& other, std::vector<ConvexCell>& rest, std::uint64_t& work) {
    const std::size_t before = rest.size();
    ConvexCell inner = cell;
    for (const ConvexCell::Face& face : other.faces) {
        if (!takeSteps(inner.faces.size(), work)) return false;
        const Lies side = sideOf(inner, face.plane);
        if (side == Lies::Inside) continue;
        if (side == Lies::Beyond) {
            rest.resize(before);
            rest.push_back(cell);
            return true;
        }
        auto [below, above] = cut(inner, face.plane);
        rest.push_back(std::move(above));
        inner = std::move(below);
    }
    return rest.size() <= kMostCells;
}

}  // namespace

ConvexCell cellOfBox(const Box3d& box) {
    ConvexCell cell;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            HalfSpace plane;
            plane.normal[axis] = sign;
            plane.offset = sign > 0 ? box.max[axis] : -box.min[axis];
            const int a = (axis + 1) % 3, b = (axis + 2) % 3;
            const std::size_t begin = cell.corners.size();
            for (int n = 0; n < 4; ++n) {
                const int turn = sign > 0 ? n : 3 - n;
                Vec3d corner;
                corner[axis] = sign > 0 ? box.max[axis] : box.min[axis];
                corner[a] = turn == 1 || turn == 2 ? box.max[a] : box.min[a];
                corner[b] = turn >= 2 ? box.max[b] : box.min[b];
                cell.corners.push_back(corner);
            }
            endFace(plane, begin, cell);
        }
    return cell;
}

double volumeOf(const ConvexCell& cell) {
    if (cell.corners.empty()) return 0;
    const Vec3d origin = cell.corners.front();
    double sum = 0;
    for (const ConvexCell::Face& face : cell.faces) {
        const Vec3d o = cell.corners[face.begin];
        Vec3d twice{};
        for (std::size_t n = face.begin + 1; n + 1 < face.end; ++n)
            twice = twice + cross(cell.corners[n] - o, cell.corners[n + 1] - o);
        sum += dot(twice, o - origin);
    }
    return sum / 6;
}

std::optional<std::vector<ConvexCell>> convexCells(std::span<const std::array<Vec3d, 3>> triangles, double volume,
                                                   std::uint64_t& work) {
    std::vector<CellDivider::Facet> facets;
    Box3d box;
    double area = 0;
    for (const auto& c : triangles) {
        for (const Vec3d& corner : c) box.add(corner);
        const Vec3d across = cross(c[1] - c[0], c[2] - c[0]);
        const double twice = length(across);
        if (!(twice > 0)) continue;
        const Vec3d normal = across / twice;
        facets.push_back({{normal, dot(normal, c[0])}, {c.begin(), c.end()}, twice / 2});
        area += twice / 2;
    }
    std::vector<ConvexCell> cells;
    if (facets.empty() || !CellDivider(cells, work).divide(cellOfBox(box), std::move(facets))) return std::nullopt;
    double sum = 0;
    for (const ConvexCell& cell : cells) sum += volumeOf(cell);
    if (!(std::abs(sum - volume) <= 10 * kFlat * area)) return std::nullopt;
    return cells;
}

std::optional<double> volumeWithin(std::span<const ConvexCell> cells,
                                   std::span<const std::vector<ConvexCell>* const> others, std::uint64_t& work) {
    double sum = 0;
    std::vector<ConvexCell> rest, next;
    for (const ConvexCell& cell : cells) {
        rest.assign(1, cell);
        bool isCut = false;
        for (const std::vector<ConvexCell>* other : others) {
            if (!takeSteps(other->size(), work)) return std::nullopt;
            for (const ConvexCell& taken : *other) {
                if (!taken.box.overlaps(cell.box)) continue;
                next.clear();
                for (ConvexCell& part : rest)
                    if (!taken.box.overlaps(part.box))
                        next.push_back(std::move(part));
                    else if (!addRest(part, taken, next, work))
                        return std::nullopt;
                isCut = true;
                rest.swap(next);
            }
        }
        if (!isCut) continue;
        double left = 0;
        for (const ConvexCell& part : rest) left += volumeOf(part);
        sum += volumeOf(cell) - left;
    }
    return sum;
}

}  // namespace svt::analyze
