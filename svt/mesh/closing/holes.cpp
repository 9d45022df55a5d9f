#include <svt/mesh/closing/holes.hpp>

#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/polygons/triangulate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace svt::mesh {
namespace {

using Loop = std::vector<std::uint32_t>;  // vertices of the mesh, in the direction of the missing face

struct FittedPlane {
    Vec3d unitNormal{}, center{};
    double area = 0, deviation = kInfinity;
};

// The face at an open edge.
struct Beside {
    Vec3d unitNormal{};
    std::uint32_t component = 0;  // of findComponents()
};

class HoleCapper {
public:
    HoleCapper(ObjectMesh& mesh, double deviation) : mesh_(mesh), deviation_(deviation) {
        const std::vector<std::uint32_t> component = findComponents(mesh.triangles);
        std::map<std::pair<std::uint32_t, std::uint32_t>, Beside> all;
        for (const OpenEdge& edge : mesh.openEdges) all[{edge.from, edge.to}] = {};
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const Triangle& t = mesh.triangles[i];
            if (component[i] >= members_.size()) members_.resize(component[i] + 1);
            members_[component[i]].insert(members_[component[i]].end(), t.corners.begin(), t.corners.end());
            for (std::size_t c = 0; c < 3; ++c)
                if (const auto found = all.find({t.corners[c], t.corners[(c + 1) % 3]}); found != all.end()) {
                    const Vec3d a = mesh.vertices[t.corners[0]];
                    found->second = {
                        normalized(cross(mesh.vertices[t.corners[1]] - a, mesh.vertices[t.corners[2]] - a)),
                        component[i]};
                }
            for (const std::uint32_t corner : t.corners) box_.add(mesh.vertices[corner]);
        }
        besideEdge_ = std::move(all);
    }

    void closeAll(const std::vector<Loop>& loops) {
        const std::vector<std::size_t> holeOf = findHoles(loops);
        std::vector<std::vector<const Loop*>> holes(loops.size());
        for (std::size_t n = 0; n < loops.size(); ++n)
            if (holeOf[n] != kNoLoop) holes[holeOf[n]].push_back(&loops[n]);
        std::vector<char> isCapped(loops.size(), 0);
        for (std::size_t n = 0; n < loops.size(); ++n)
            isCapped[n] = !holes[n].empty() && !boundsFlatPart(loops[n]) && addCap(loops[n], holes[n]) ? 1 : 0;
        for (std::size_t n = 0; n < loops.size(); ++n)
            if (isCapped[n] == 0 && (holeOf[n] == kNoLoop || isCapped[holeOf[n]] == 0)) close(loops[n]);
    }

    // Slivers that float beside a shell get a back, so that they do not keep it open.
    void closeSlivers() {
        constexpr double kPartOfShell = 0.01;
        double slivers = 0, shell = 0;
        for (const Loop& loop : flatParts_) slivers += fit(loop).area;
        for (const Triangle& t : mesh_.triangles) {
            const Vec3d a = at(t.corners[0]);
            shell += length(cross(at(t.corners[1]) - a, at(t.corners[2]) - a)) / 2;
        }
        if (!(slivers < kPartOfShell * shell)) return;
        for (const Loop& loop : flatParts_) (void)addCap(loop);
    }

private:
    static constexpr std::size_t kNoLoop = ~std::size_t{0};

    void close(const Loop& loop) {
        if (loop.size() < 3) return;
        if (boundsFlatPart(loop)) {
            flatParts_.push_back(loop);
            return;
        }
        if (addCap(loop)) return;
        constexpr std::size_t kMaxCorners = 200;
        if (loop.size() > kMaxCorners || fit(loop).deviation <= deviation_) return;
        if (!closeCorner(loop)) closeAlongChords(loop);
    }

    // True if a ring, seen along the main direction of its normal, goes around a point.
    [[nodiscard]] bool isAround(const Loop& ring, Vec3d unitNormal, Vec3d point) const {
        const Vec3d size{std::abs(unitNormal.x), std::abs(unitNormal.y), std::abs(unitNormal.z)};
        const int along = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        const int u = (along + 1) % 3, v = (along + 2) % 3;
        bool isInside = false;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec3d a = at(ring[i]), b = at(ring[(i + 1) % ring.size()]);
            if ((a[v] > point[v]) == (b[v] > point[v])) continue;
            if (point[u] < a[u] + (b[u] - a[u]) * (point[v] - a[v]) / (b[v] - a[v])) isInside = !isInside;
        }
        return isInside;
    }

    // The loop whose cap has each loop as a hole: in its plane, inside it, and in the opposite direction. The lower edges
    // of a court are such a hole in the floor of its building. A cap of each loop would cover the court twice.
    [[nodiscard]] std::vector<std::size_t> findHoles(const std::vector<Loop>& loops) const {
        constexpr std::size_t kMostLoops = 1000;  // the cost is quadratic
        constexpr double kSamePlane = 0.999;
        std::vector<std::size_t> holeOf(loops.size(), kNoLoop), order;
        if (loops.size() < 2 || loops.size() > kMostLoops) return holeOf;
        std::vector<FittedPlane> planes;
        for (std::size_t n = 0; n < loops.size(); ++n) {
            planes.push_back(fit(loops[n]));
            if (planes[n].area > 0 && planes[n].deviation <= deviation_) order.push_back(n);
        }
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return planes[a].area > planes[b].area; });
        for (std::size_t inner = 1; inner < order.size(); ++inner)
            for (std::size_t outer = inner; outer-- > 0;) {  // the smallest one around it
                const FittedPlane &own = planes[order[inner]], &around = planes[order[outer]];
                const Vec3d first = at(loops[order[inner]].front());
                const double direction = dot(own.unitNormal, around.unitNormal);
                if (std::abs(direction) < kSamePlane ||
                    std::abs(dot(first - around.center, around.unitNormal)) > deviation_ ||
                    !isAround(loops[order[outer]], around.unitNormal, first))
                    continue;
                if (direction < 0 && holeOf[order[outer]] == kNoLoop) holeOf[order[inner]] = order[outer];
                break;
            }
        return holeOf;
    }

    [[nodiscard]] Vec3d at(std::uint32_t vertex) const { return mesh_.vertices[vertex]; }

    [[nodiscard]] FittedPlane fit(const Loop& ring) const {
        std::vector<Vec3d> points;
        FittedPlane plane;
        for (const std::uint32_t vertex : ring) {
            points.push_back(at(vertex));
            plane.center = plane.center + points.back() / double(ring.size());
        }
        const Vec3d normal = newellNormal(points);
        plane.area = length(normal) / 2;
        plane.unitNormal = normalized(normal);
        if (!(plane.area > 0)) return plane;
        plane.deviation = 0;
        for (const Vec3d& point : points)
            plane.deviation = std::max(plane.deviation, std::abs(dot(point - plane.center, plane.unitNormal)));
        return plane;
    }

    // True if the loop is the border of a part that lies in its plane as a whole: a cap would only be its back. Where
    // faces overlap in a part that bends, a cap on them is right: it removes the doubled faces.
    [[nodiscard]] bool boundsFlatPart(const Loop& loop) const {
        const auto beside = besideEdge_.find({loop[1], loop[0]});
        if (beside == besideEdge_.end()) return false;
        const FittedPlane plane = fit(loop);
        if (!(plane.area > 0) || plane.deviation > deviation_) return false;
        const double limit = std::max(1e-3, 2 * plane.deviation);
        const auto& corners = members_[beside->second.component];
        return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
            return std::abs(dot(at(corner) - plane.center, plane.unitNormal)) <= limit;
        });
    }

    // True if a cap with this normal would lie on the faces beside most of its border.
    [[nodiscard]] bool foldsBack(const Loop& ring, Vec3d unitNormal) const {
        constexpr double kSamePlane = 0.95;
        double folded = 0, border = 0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::uint32_t from = ring[i], to = ring[(i + 1) % ring.size()];
            const auto beside = besideEdge_.find({to, from});
            if (beside == besideEdge_.end()) continue;  // a chord
            const double edge = length(at(to) - at(from));
            border += edge;
            if (dot(beside->second.unitNormal, unitNormal) < -kSamePlane) folded += edge;
        }
        return folded * 2 > border;
    }

    // Corners between the ends of a run where it changes its direction by more than 3 degrees.
    [[nodiscard]] int countBends(const Loop& run) const {
        int bends = 0;
        for (std::size_t i = 1; i + 1 < run.size(); ++i) {
            const Vec3d in = normalized(at(run[i]) - at(run[i - 1])), out = normalized(at(run[i + 1]) - at(run[i]));
            bends += length(cross(in, out)) > 0.05;
        }
        return bends;
    }

    // How far points of a run may be from a plane for it to count as one.
    [[nodiscard]] double runDeviation(const FittedPlane& plane) const {
        return std::min(deviation_, 0.02 * std::sqrt(plane.area));
    }

    // A planar cap, with holes in the opposite direction.
    bool addCap(const Loop& loop, const std::vector<const Loop*>& holes = {}) {
        Loop corners = loop;
        std::vector<std::uint32_t> ends{static_cast<std::uint32_t>(loop.size())};
        double area = fit(loop).area;
        for (const Loop* hole : holes) {
            corners.insert(corners.end(), hole->begin(), hole->end());
            ends.push_back(static_cast<std::uint32_t>(corners.size()));
            area -= fit(*hole).area;
        }
        std::vector<Vec3d> points;
        for (const std::uint32_t vertex : corners) points.push_back(at(vertex));
        const Triangulation cap = triangulatePolygon(points, ends);
        // If the ring crosses itself, the cap would need points that the shell does not have.
        if (cap.triangles.empty() || !cap.extraPoints.empty() || cap.planeDeviation > deviation_) return false;
        for (const auto& triangleCorners : cap.triangles) {
            Triangle triangle;
            for (std::size_t c = 0; c < 3; ++c) triangle.corners[c] = corners[triangleCorners[c]];
            mesh_.triangles.push_back(triangle);
        }
        Cap record;
        record.area = area;
        record.ring.assign(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(loop.size()));
        for (const Vec3d& point : record.ring) record.center = record.center + point / static_cast<double>(loop.size());
        mesh_.caps.push_back(std::move(record));
        return true;
    }

    // The longest run of edges from `begin` in one plane that bends at least `bends` times; empty if there is none.
    [[nodiscard]] Loop longestRun(const Loop& loop, std::size_t begin, std::size_t mostCorners, int bends) const {
        Loop run, best;
        for (std::size_t i = 0; i < mostCorners; ++i) {
            run.push_back(loop[(begin + i) % loop.size()]);
            if (run.size() < 3 || countBends(run) == 0) continue;
            const FittedPlane plane = fit(run);
            if (!(plane.deviation <= runDeviation(plane))) {
                if (countBends(run) >= 2) break;
                continue;
            }
            if (countBends(run) >= bends && !foldsBack(run, plane.unitNormal)) best = run;
        }
        return best;
    }

    // Three runs of edges whose planes meet in a point that the shell lacks.
    bool closeCorner(const Loop& loop) {
        const std::size_t n = loop.size();
        for (std::size_t begin = 0; begin < n; ++begin) {
            std::array<Loop, 3> runs;
            std::size_t used = 0;
            for (Loop& run : runs) {
                run = longestRun(loop, begin + used, n - used + 1, 1);
                if (run.empty()) break;
                used += run.size() - 1;
                if (used >= n) break;
            }
            if (used != n || runs[2].empty()) continue;
            if (addCorner(runs)) return true;
        }
        return false;
    }

    bool addCorner(std::array<Loop, 3>& runs) {
        std::array<FittedPlane, 3> planes;
        for (std::size_t r = 0; r < 3; ++r) planes[r] = fit(runs[r]);
        const Vec3d bc = cross(planes[1].unitNormal, planes[2].unitNormal),
                    ca = cross(planes[2].unitNormal, planes[0].unitNormal),
                    ab = cross(planes[0].unitNormal, planes[1].unitNormal);
        const double determinant = dot(planes[0].unitNormal, bc);
        if (std::abs(determinant) < 0.1) return false;
        const auto offset = [&](std::size_t r) { return dot(planes[r].unitNormal, planes[r].center); };
        const Vec3d corner = (bc * offset(0) + ca * offset(1) + ab * offset(2)) / determinant;
        const double margin = 0.05 * length(box_.size());
        const Vec3d around{margin, margin, margin};
        if (!Box3d{box_.min - around, box_.max + around}.contains(corner)) return false;
        const auto vertex = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(corner);
        const std::size_t triangles = mesh_.triangles.size(), caps = mesh_.caps.size();
        for (Loop& run : runs) {
            run.push_back(vertex);
            if (!foldsBack(run, fit(run).unitNormal) && addCap(run)) continue;
            mesh_.vertices.pop_back();
            mesh_.triangles.resize(triangles);
            mesh_.caps.resize(caps);
            return false;
        }
        return true;
    }

    // Cuts off the run with the largest area, again and again, until the rest is planar or nothing is left to cut.
    void closeAlongChords(Loop rest) {
        while (rest.size() > 3) {
            Loop best;
            double area = 0;
            for (std::size_t begin = 0; begin < rest.size(); ++begin) {
                const Loop run = longestRun(rest, begin, rest.size() - 1, 2);
                if (run.empty()) continue;
                if (const FittedPlane plane = fit(run); plane.area > area) {
                    area = plane.area;
                    best = run;
                }
            }
            if (best.empty() || !addCap(best)) return;
            std::erase_if(rest, [&](std::uint32_t vertex) {
                return std::find(best.begin() + 1, best.end() - 1, vertex) != best.end() - 1;
            });
            if (rest.size() >= 3 && !foldsBack(rest, fit(rest).unitNormal) && addCap(rest)) return;
        }
    }

    ObjectMesh& mesh_;
    double deviation_;
    std::vector<Loop> flatParts_;  // borders of parts that lie in one plane
    Box3d box_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Beside> besideEdge_;  // per open edge
    std::vector<std::vector<std::uint32_t>> members_;                       // corners per component
};

}  // namespace

void capHoles(ObjectMesh& mesh, double deviation) {
    HoleCapper capper(mesh, deviation);
    capper.closeAll(findBoundaryLoops(mesh.openEdges));
    capper.closeSlivers();
    mesh.openEdges = findOpenEdges(mesh.triangles);
}

}  // namespace svt::mesh
