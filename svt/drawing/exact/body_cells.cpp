#include <svt/drawing/exact/body_cells.hpp>

#include <svt/core/triangle_distance.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

namespace svt::drawing {
namespace {

constexpr std::uint32_t kNoBody = 0xFFFFFFFFu;
constexpr double kLeafSize = 6e-3;      // metres: cells with borders in them are at most that large
constexpr double kSmallestCell = 6e-4;  // metres: of cells with more than two bodies
constexpr double kMargin = 2e-4;        // metres around the material

// A square of the plane.
struct Cell {
    plane::Point low;
    std::int32_t size = 0;
    [[nodiscard]] plane::Point corner(int n) const noexcept {  // counter-clockwise
        return {low.u + (n == 1 || n == 2 ? size : 0), low.v + (n >= 2 ? size : 0)};
    }
};

// One side of a part of a grid line: above or below a horizontal line, right or left of a vertical one.
struct LineSide {
    bool isVertical = false;
    std::int64_t line = 0, from = 0, to = 0;
    bool isUpper = false;
    std::uint32_t body = 0;
};

// Borders along grid lines: where the bodies on both sides differ.
void addLineBorders(std::vector<LineSide>& sides, std::vector<plane::ClaimSegment>& borders) {
    std::sort(sides.begin(), sides.end(), [](const LineSide& a, const LineSide& b) {
        return std::tie(a.isVertical, a.line, a.from, a.to, a.isUpper) <
               std::tie(b.isVertical, b.line, b.from, b.to, b.isUpper);
    });
    const auto add = [&](const LineSide& line, std::int64_t from, std::int64_t to, std::uint32_t lower,
                         std::uint32_t upper) {
        if (from >= to || lower == upper) return;
        const plane::Point a = line.isVertical ? plane::Point{line.line, from} : plane::Point{from, line.line};
        const plane::Point b = line.isVertical ? plane::Point{line.line, to} : plane::Point{to, line.line};
        const std::uint32_t left = line.isVertical ? lower : upper, right = line.isVertical ? upper : lower;
        if (left != kNoBody) borders.push_back({a, b, left, 1});
        if (right != kNoBody) borders.push_back({b, a, right, 1});
    };
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        std::vector<std::int64_t> ends;
        for (end = begin; end < sides.size() && sides[end].isVertical == sides[begin].isVertical &&
                          sides[end].line == sides[begin].line;
             ++end) {
            ends.push_back(sides[end].from);
            ends.push_back(sides[end].to);
        }
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        std::array<std::vector<std::uint32_t>, 2> bodies;  // below and above, by interval between ends
        for (auto& list : bodies) list.assign(ends.size(), kNoBody);
        for (std::size_t n = begin; n < end; ++n) {
            auto at =
                static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), sides[n].from) - ends.begin());
            for (; at < ends.size() && ends[at] < sides[n].to; ++at)
                bodies[sides[n].isUpper ? 1 : 0][at] = sides[n].body;
        }
        for (std::size_t n = 0; n + 1 < ends.size(); ++n)
            add(sides[begin], ends[n], ends[n + 1], bodies[0][n], bodies[1][n]);
    }
}

class BodyDivider {
public:
    BodyDivider(std::span<const BodyFace> faces, std::span<const MaterialEdge> material, const BodyPlane& plane,
                double unit)
        : faces_(faces), material_(material), plane_(plane), unit_(unit) {
        // Powers of two, so that cells can be halved.
        const auto powerOfTwo = [&](double metres) {
            return static_cast<std::int32_t>(std::bit_floor(static_cast<std::uint32_t>(std::max(4.0, metres / unit))));
        };
        leafSize_ = powerOfTwo(kLeafSize);
        smallest_ = powerOfTwo(kSmallestCell);
        margin_ = std::max(2, static_cast<std::int32_t>(kMargin / unit));
    }

    std::vector<plane::ClaimSegment> run() {
        plane::Box box;
        for (const MaterialEdge& edge : material_) {
            box.add(edge.first);
            box.add(edge.second);
        }
        const plane::Point low = box.low, high = box.high;
        const std::int64_t extent = std::max(high.u - low.u, high.v - low.v) + 4 * margin_;
        // Squares of at most 2^27; each is halved down to the leaves.
        std::int32_t side = leafSize_;
        while (side < extent && side < (1 << 27)) side *= 2;
        std::vector<std::uint32_t> all(faces_.size()), edges(material_.size());
        for (std::uint32_t n = 0; n < all.size(); ++n) all[n] = n;
        for (std::uint32_t n = 0; n < edges.size(); ++n) edges[n] = n;
        for (std::int64_t v = low.v - 2 * margin_; v < high.v + 2 * margin_; v += side)
            for (std::int64_t u = low.u - 2 * margin_; u < high.u + 2 * margin_; u += side) {
                const Cell cell{{u, v}, side};
                visit(cell, all, edgesIn(cell, edges));
            }
        addLineBorders(sides_, borders_);
        return std::move(borders_);
    }

private:
    [[nodiscard]] Vec3d placeOf(double u, double v) const noexcept { return plane_.u * u + plane_.v * v; }
    [[nodiscard]] double distanceOf(const BodyFace& face, Vec3d at) const noexcept {
        return distanceToTriangle(at, face.a, face.b, face.c);
    }

    [[nodiscard]] std::vector<std::uint32_t> edgesIn(const Cell& cell, const std::vector<std::uint32_t>& edges) const {
        std::vector<std::uint32_t> kept;
        const double reach = margin_, lowU = double(cell.low.u) - reach, lowV = double(cell.low.v) - reach;
        const double highU = double(cell.low.u) + cell.size + reach, highV = double(cell.low.v) + cell.size + reach;
        for (const std::uint32_t e : edges) {
            const plane::Point a = material_[e].first, b = material_[e].second;
            const plane::Box box = plane::boxOf(a, b);
            if (double(box.high.u) < lowU || double(box.low.u) > highU || double(box.high.v) < lowV ||
                double(box.low.v) > highV)
                continue;
            // All corners on one side of the line?
            const double du = double(b.u - a.u), dv = double(b.v - a.v);
            const auto side = [&](double u, double v) { return du * (v - double(a.v)) - dv * (u - double(a.u)); };
            const auto [least, most] =
                std::minmax({side(lowU, lowV), side(highU, lowV), side(highU, highV), side(lowU, highV)});
            if (least <= 0 && most >= 0) kept.push_back(e);
        }
        return kept;
    }

    // Whether the material encloses the middle of a cell: crossings of a ray to the right.
    [[nodiscard]] bool isInside(const Cell& cell) const noexcept {
        const double u = double(cell.low.u) + 0.5 * cell.size + 0.25, v = double(cell.low.v) + 0.5 * cell.size + 0.25;
        int winding = 0;
        for (const auto& [a, b] : material_) {
            const double au = double(a.u), av = double(a.v), bu = double(b.u), bv = double(b.v);
            if ((av > v) == (bv > v)) continue;
            if (au + (v - av) / (bv - av) * (bu - au) > u) winding += b.v > a.v ? 1 : -1;
        }
        return winding > 0;
    }

    void visit(const Cell& cell, const std::vector<std::uint32_t>& candidates,
               const std::vector<std::uint32_t>& edges) {
        if (edges.empty() && !isInside(cell)) return;
        const double half = 0.5 * cell.size, radius = half * std::sqrt(2.0) * unit_;
        const Vec3d middle = placeOf(double(cell.low.u) + half, double(cell.low.v) + half);
        std::vector<double> distances(candidates.size());
        double nearest = std::numeric_limits<double>::infinity(), nearestOther = nearest;
        std::uint32_t best = kNoBody;
        for (std::size_t n = 0; n < candidates.size(); ++n) {
            const BodyFace& face = faces_[candidates[n]];
            const double distance = distances[n] = distanceOf(face, middle);
            if (distance < nearest || (distance == nearest && face.body < best)) {
                if (face.body != best) nearestOther = nearest;
                nearest = distance;
                best = face.body;
            } else if (face.body != best) {
                nearestOther = std::min(nearestOther, distance);
            }
        }
        if (nearestOther - nearest > 2 * radius) return addUniform(cell, best);
        std::vector<std::uint32_t> kept;
        for (std::size_t n = 0; n < candidates.size(); ++n)
            if (distances[n] <= nearest + 2 * radius) kept.push_back(candidates[n]);
        if (cell.size <= leafSize_ && march(cell, kept)) return;
        const std::int32_t part = cell.size / 2;
        for (const auto& [du, dv] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
            const Cell child{{cell.low.u + du * part, cell.low.v + dv * part}, part};
            visit(child, kept, edgesIn(child, edges));
        }
    }

    void addSide(plane::Point a, plane::Point b, std::uint32_t body) {
        // Counter-clockwise around the cell: the cell is to the left.
        if (a == b) return;
        if (a.v == b.v)
            sides_.push_back({false, a.v, std::min(a.u, b.u), std::max(a.u, b.u), a.u < b.u, body});
        else
            sides_.push_back({true, a.u, std::min(a.v, b.v), std::max(a.v, b.v), a.v > b.v, body});
    }

    void addUniform(const Cell& cell, std::uint32_t body) {
        for (int n = 0; n < 4; ++n) addSide(cell.corner(n), cell.corner((n + 1) % 4), body);
    }

    [[nodiscard]] std::uint32_t nearestBody(plane::Point at, const std::vector<std::uint32_t>& candidates) const {
        // Behind a corner that two surfaces share both are equally near, up to rounding.
        constexpr double kSame = 1e-9;
        const Vec3d place = placeOf(double(at.u), double(at.v));
        double nearest = std::numeric_limits<double>::infinity();
        std::uint32_t best = kNoBody;
        for (const std::uint32_t f : candidates) {
            const double distance = distanceOf(faces_[f], place);
            if (distance > nearest + kSame || (distance >= nearest - kSame && faces_[f].body >= best)) {
                nearest = std::min(nearest, distance);
                continue;
            }
            nearest = std::min(nearest, distance);
            best = faces_[f].body;
        }
        return best;
    }

    // Where a side of a cell leaves the body of `from`.
    [[nodiscard]] plane::Point endOf(plane::Point from, plane::Point to, std::uint32_t body,
                                     const std::vector<std::uint32_t>& candidates) const {
        for (std::int64_t step = std::max(std::abs(to.u - from.u), std::abs(to.v - from.v)); step > 1;) {
            const plane::Point middle{from.u + (to.u - from.u) / 2, from.v + (to.v - from.v) / 2};
            (nearestBody(middle, candidates) == body ? from : to) = middle;
            step = std::max(std::abs(to.u - from.u), std::abs(to.v - from.v));
        }
        return to;
    }

    // Draws the borders within a small cell, from where they cross its sides. False if it should be divided.
    bool march(const Cell& cell, const std::vector<std::uint32_t>& candidates) {
        struct Crossing {
            plane::Point point;
            std::uint32_t before = 0, after = 0;
        };
        std::vector<Crossing> crossings;
        std::vector<std::pair<plane::Point, std::uint32_t>> outline;  // points, and the body of the way to the next
        std::array<std::uint32_t, 4> corners{};
        for (int n = 0; n < 4; ++n) corners[static_cast<std::size_t>(n)] = nearestBody(cell.corner(n), candidates);
        for (int n = 0; n < 4; ++n) {
            const plane::Point a = cell.corner(n), b = cell.corner((n + 1) % 4);
            const std::uint32_t first = corners[static_cast<std::size_t>(n)];
            const std::uint32_t last = corners[static_cast<std::size_t>((n + 1) % 4)];
            outline.emplace_back(a, first);
            if (first == last) continue;
            // Both cells that share the side search from the same end, so they find the same point.
            const bool isTurned = b < a;
            const plane::Point leaves = isTurned ? endOf(b, a, last, candidates) : endOf(a, b, first, candidates);
            crossings.push_back({leaves, first, last});
            outline.emplace_back(leaves, last);
        }
        std::vector<std::uint32_t> bodies;
        for (const auto& [point, body] : outline)
            if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) bodies.push_back(body);
        if ((bodies.size() > 2 || crossings.size() > 2) && cell.size > smallest_) return false;
        for (std::size_t n = 0; n < outline.size(); ++n)
            addSide(outline[n].first, outline[(n + 1) % outline.size()].first, outline[n].second);
        if (crossings.size() == 2) {
            addBorder(crossings[1].point, crossings[0].point, crossings[0].after, crossings[0].before);
        } else {
            const plane::Point middle{cell.low.u + cell.size / 2, cell.low.v + cell.size / 2};
            for (const Crossing& crossing : crossings)
                addBorder(middle, crossing.point, crossing.after, crossing.before);
        }
        return true;
    }

    void addBorder(plane::Point from, plane::Point to, std::uint32_t left, std::uint32_t right) {
        borders_.push_back({from, to, left, 1});
        borders_.push_back({to, from, right, 1});
    }

    std::span<const BodyFace> faces_;
    std::span<const MaterialEdge> material_;
    BodyPlane plane_;
    double unit_;
    std::int32_t leafSize_ = 0, smallest_ = 0, margin_ = 0;
    std::vector<LineSide> sides_;
    std::vector<plane::ClaimSegment> borders_;
};

}  // namespace

std::vector<plane::ClaimSegment> divideBodies(std::span<const BodyFace> faces, std::span<const MaterialEdge> material,
                                              const BodyPlane& plane, double unit) {
    if (faces.empty() || material.empty()) return {};
    return BodyDivider(faces, material, plane, unit).run();
}

}  // namespace svt::drawing
