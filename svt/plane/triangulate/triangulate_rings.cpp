#include <svt/plane/triangulate_rings.hpp>

#include <svt/plane/square_grid.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <queue>

namespace svt::plane {
namespace {

// The border that is still to be cut, as a closed chain.
struct Link {
    RingCorner corner;
    std::size_t previous = 0, next = 0;
    bool isCut = false;
};

// Squares over all rings: about one for every two corners.
SquareGrid gridOver(const std::vector<std::vector<RingCorner>>& rings) {
    Box box;
    std::size_t corners = 0;
    for (const auto& ring : rings) {
        corners += ring.size();
        for (const RingCorner& corner : ring) box.add(corner.at);
    }
    return {box, std::max(1.0, double(corners) / 2), 4096, 1};
}

class EarCutter {
public:
    explicit EarCutter(const std::vector<std::vector<RingCorner>>& rings)
        : grid_(gridOver(rings)), linksIn_(grid_.count()), linesIn_(grid_.count()), hasHoles_(rings.size() > 1) {
        std::size_t count = 0;
        for (const auto& ring : rings) count += ring.size();
        links_.reserve(count + 2 * rings.size());
        start_ = addRing(rings.front());
        addToBorder(start_);
        struct Hole {
            Point leftmost;
            std::size_t link;
        };
        std::vector<Hole> holes;
        for (std::size_t i = 1; i < rings.size(); ++i) {
            const std::size_t first = addRing(rings[i]);
            std::size_t best = first;
            for (std::size_t at = links_[first].next; at != first; at = links_[at].next)
                if (links_[at].corner.at < links_[best].corner.at) best = at;
            holes.push_back({links_[best].corner.at, best});
        }
        std::sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) {
            return a.leftmost != b.leftmost ? a.leftmost < b.leftmost : a.link < b.link;
        });
        for (const Hole& hole : holes) join(hole.link);
    }

    std::vector<Corners> cut() {
        std::vector<Corners> triangles;
        std::size_t remaining = 1;
        for (std::size_t at = links_[start_].next; at != start_; at = links_[at].next) ++remaining;
        remaining_ = remaining;
        std::size_t at = start_, tried = 0;
        while (remaining > 3) {
            const bool isStuck = tried > remaining;
            // A border that touches itself may leave no clean ear: then any corner that turns the right way.
            if (isStuck ? isConvex(at) || tried > 2 * remaining : isEar(at)) {
                emit(at, triangles);
                at = remove(at);
                remaining_ = --remaining;
                tried = 0;
            } else {
                at = links_[at].next;
                ++tried;
            }
        }
        emit(at, triangles);
        return triangles;
    }

private:
    std::size_t addRing(const std::vector<RingCorner>& ring) {
        const std::size_t first = links_.size();
        for (std::size_t i = 0; i < ring.size(); ++i)
            links_.push_back({ring[i], first + (i + ring.size() - 1) % ring.size(), first + (i + 1) % ring.size()});
        return first;
    }

    // Adds a ring, which becomes part of the border, to the grid. Lines are added only if there are holes.
    void addToBorder(std::size_t first) {
        std::size_t i = first;
        do {
            addToBorder(i, links_[i].next);
            i = links_[i].next;
        } while (i != first);
    }
    void addToBorder(std::size_t link, std::size_t next) {
        linksIn_[grid_.squareOf(at(link))].push_back(link);
        if (!hasHoles_) return;
        static_cast<void>(grid_.forSegment(at(link), at(next), 1, [&](std::size_t square) {
            linesIn_[square].push_back(lines_.size());
            return true;
        }));
        lines_.push_back({at(link), at(next)});
    }

    [[nodiscard]] const Point& at(std::size_t link) const { return links_[link].corner.at; }
    [[nodiscard]] int turnAt(std::size_t link) const {
        return turn(at(links_[link].previous), at(link), at(links_[link].next));
    }
    [[nodiscard]] bool isConvex(std::size_t link) const { return turnAt(link) > 0; }

    // True if a way from `link` towards `target` starts within the polygon.
    [[nodiscard]] bool opensTowards(std::size_t link, Point target) const {
        const Point previous = at(links_[link].previous), here = at(link), next = at(links_[link].next);
        if (turn(previous, here, next) > 0) return turn(here, target, previous) > 0 && turn(here, next, target) > 0;
        return !(turn(here, target, next) >= 0 && turn(here, previous, target) >= 0);
    }

    [[nodiscard]] bool isEar(std::size_t link) const {
        if (!isConvex(link)) return false;
        const std::size_t previous = links_[link].previous, next = links_[link].next;
        const std::array<Point, 3> t{at(previous), at(link), at(next)};
        Box box;
        for (const Point corner : t) box.add(corner);
        const auto isClear = [&](std::size_t i) {
            const Point& p = at(i);
            if (links_[i].isCut || !box.contains(p)) return true;
            if (p == t[0] || p == t[1] || p == t[2]) return true;
            // Only corners that do not turn outwards can reach into an ear first.
            return !(turnAt(i) <= 0 && holds(t, p));
        };
        if (2 * grid_.countIn(box) < double(remaining_))
            return grid_.forBox(box, [&](std::size_t square) {
                return std::all_of(linksIn_[square].begin(), linksIn_[square].end(), isClear);
            });
        for (std::size_t i = links_[next].next; i != previous; i = links_[i].next)
            if (!isClear(i)) return false;
        return true;
    }

    void emit(std::size_t link, std::vector<Corners>& triangles) const {
        const Link& l = links_[link];
        const Corners corners{links_[l.previous].corner.index, l.corner.index, links_[l.next].corner.index};
        if (turnAt(link) > 0) triangles.push_back(corners);
    }

    std::size_t remove(std::size_t link) {
        links_[links_[link].previous].next = links_[link].next;
        links_[links_[link].next].previous = links_[link].previous;
        links_[link].isCut = true;
        return links_[link].next;
    }

    // Joins a hole at its leftmost corner to the border left of it.
    void join(std::size_t hole) {
        const std::size_t partner = findPartner(hole);
        addToBorder(hole);
        if (at(partner) == at(hole)) {  // they touch here: the chains change over
            const std::size_t afterPartner = links_[partner].next, afterHole = links_[hole].next;
            links_[partner].next = afterHole;
            links_[afterHole].previous = partner;
            links_[hole].next = afterPartner;
            links_[afterPartner].previous = hole;
            return;
        }
        //  ... partner -> hole ... around the hole ... hole' -> partner' -> ...
        const std::size_t holeCopy = links_.size(), partnerCopy = holeCopy + 1;
        links_.push_back({links_[hole].corner, links_[hole].previous, partnerCopy});
        links_.push_back({links_[partner].corner, holeCopy, links_[partner].next});
        links_[links_[hole].previous].next = holeCopy;
        links_[links_[partner].next].previous = partnerCopy;
        links_[partner].next = hole;
        links_[hole].previous = partner;
        addToBorder(holeCopy, partnerCopy);
        addToBorder(partnerCopy, links_[partnerCopy].next);
    }

    // The nearest corner of the border from which the hole is seen; if there is none, one that touches it, else the
    // nearest.
    [[nodiscard]] std::size_t findPartner(std::size_t hole) const {
        const Point from = at(hole);
        using Candidate = std::pair<double, std::size_t>;  // squared distance, link
        std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
        std::optional<Candidate> nearest;
        const auto isPartner = [&](const Candidate& candidate) {
            const std::size_t link = candidate.second;
            if (candidate.first == 0)
                return opensTowards(link, at(links_[hole].next)) || opensTowards(link, at(links_[hole].previous));
            return at(link).u <= from.u && opensTowards(link, from) && opensTowards(hole, at(link)) && sees(hole, link);
        };
        for (std::int64_t ring = 0;; ++ring) {
            const bool isMore = grid_.forRing(from, ring, [&](std::size_t square) {
                for (const std::size_t i : linksIn_[square]) {
                    const double u = static_cast<double>(at(i).u - from.u), v = static_cast<double>(at(i).v - from.v);
                    candidates.emplace(u * u + v * v, i);
                }
            });
            // Candidates nearer than the squares of the next ring come in order.
            const double reach = double(ring) * grid_.side() * (double(ring) * grid_.side());
            while (!candidates.empty() && (!isMore || candidates.top().first <= reach)) {
                if (!nearest) nearest = candidates.top();
                if (isPartner(candidates.top())) return candidates.top().second;
                candidates.pop();
            }
            if (!isMore) return nearest->second;
        }
    }

    // Only the border, with the holes joined so far, can lie between a hole and a corner to the left of it.
    [[nodiscard]] bool sees(std::size_t hole, std::size_t link) const {
        const Point a = at(hole), b = at(link);
        const auto isClear = [&](std::size_t line) {
            const auto& [c, d] = lines_[line];
            return c == b || d == b || c == a || d == a || meet(a, b, c, d) == Meeting::None;
        };
        return grid_.forSegment(a, b, 1, [&](std::size_t square) {
            return std::all_of(linesIn_[square].begin(), linesIn_[square].end(), isClear);
        });
    }

    SquareGrid grid_;
    std::vector<std::vector<std::size_t>> linksIn_, linesIn_;  // by square
    bool hasHoles_;
    std::vector<std::pair<Point, Point>> lines_;  // of the border, with those to holes
    std::size_t remaining_ = 0;                   // corners that are not cut
    std::vector<Link> links_;
    std::size_t start_ = 0;
};

double cotangent(Vec3d corner, Vec3d a, Vec3d b) {
    const Vec3d p = a - corner, q = b - corner;
    const double area = length(cross(p, q));
    return area > 0 ? dot(p, q) / area : kInfinity;
}

// Turns the edges between triangles whose opposite angles sum up to more than 180 degrees.
class EdgeTurner {
public:
    EdgeTurner(std::vector<Corners>& triangles, const std::map<std::uint32_t, Point>& flat,
               const std::vector<Vec3d>& points)
        : triangles_(triangles), flat_(flat), points_(points) {}

    void run() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> triangleAt;  // directed edge -> triangle
        const auto enter = [&](std::size_t t) {
            for (std::size_t i = 0; i < 3; ++i) triangleAt[{triangles_[t][i], triangles_[t][(i + 1) % 3]}] = t;
        };
        for (std::size_t t = 0; t < triangles_.size(); ++t) enter(t);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
        for (const auto& entry : triangleAt)
            if (entry.first.first < entry.first.second) open.push_back(entry.first);
        // Lawson's turns end; the limit is for angles that rounding cannot order.
        for (std::size_t steps = 0; !open.empty() && steps < 50 * triangles_.size() + 100; ++steps) {
            const auto [a, b] = open.back();
            open.pop_back();
            const auto one = triangleAt.find({a, b}), other = triangleAt.find({b, a});
            if (one == triangleAt.end() || other == triangleAt.end()) continue;
            const std::size_t s = one->second, t = other->second;
            const std::uint32_t c = opposite(s, a, b), d = opposite(t, a, b);
            if (c == d || !isBetter(a, b, c, d)) continue;
            triangleAt.erase(one);
            triangleAt.erase(other);
            triangles_[s] = {c, a, d};
            triangles_[t] = {d, b, c};
            enter(s);
            enter(t);
            for (const auto& [p, q] : {std::pair{a, d}, std::pair{d, b}, std::pair{b, c}, std::pair{c, a}})
                open.emplace_back(std::min(p, q), std::max(p, q));
        }
    }

private:
    [[nodiscard]] std::uint32_t opposite(std::size_t t, std::uint32_t a, std::uint32_t b) const {
        for (const std::uint32_t corner : triangles_[t])
            if (corner != a && corner != b) return corner;
        return a;
    }

    [[nodiscard]] bool isBetter(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
        const Point pa = flat_.at(a), pb = flat_.at(b), pc = flat_.at(c), pd = flat_.at(d);
        if (turn(pc, pa, pd) <= 0 || turn(pd, pb, pc) <= 0) return false;
        const double sum =
            cotangent(points_[c], points_[a], points_[b]) + cotangent(points_[d], points_[a], points_[b]);
        return sum < -1e-9;
    }

    std::vector<Corners>& triangles_;
    const std::map<std::uint32_t, Point>& flat_;
    const std::vector<Vec3d>& points_;
};

}  // namespace

std::vector<Corners> triangulateRings(const std::vector<std::vector<RingCorner>>& rings,
                                      const std::vector<Vec3d>& points) {
    std::vector<Corners> triangles = EarCutter(rings).cut();
    if (triangles.size() > 1) {
        std::map<std::uint32_t, Point> flat;
        for (const auto& ring : rings)
            for (const RingCorner& corner : ring) flat.emplace(corner.index, corner.at);
        EdgeTurner(triangles, flat, points).run();
    }
    return triangles;
}

}  // namespace svt::plane
