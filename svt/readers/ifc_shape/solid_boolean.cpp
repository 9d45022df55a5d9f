#include <svt/readers/ifc_shape/solid_boolean.hpp>

#include <svt/plane/box_tree.hpp>
#include <svt/readers/ifc_shape/overlay.hpp>
#include <svt/readers/ifc_shape/sweeps.hpp>
#include <svt/readers/ifc_shape/welder.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::readers::ifc {
namespace {

using Polygons = std::vector<model::Polygon>;

constexpr std::uint64_t kMaxFacePairs = 200'000'000;
constexpr std::uint64_t kMaxSteps = 3'000'000'000;  // some seconds
constexpr std::uint64_t kStepsOfEach = 100'000;     // of the smallest boolean
constexpr double kWeld = 1e-7;

struct Plane {
    Transform axes;                                              // z is the normal
    Box3d region;                                                // of the faces on it
    std::vector<std::pair<std::uint32_t, std::uint32_t>> faces;  // operand, face

    [[nodiscard]] double distance(Vec3d p) const noexcept { return dot(p - axes.origin, axes.z); }
};

struct SolidFace {
    std::vector<std::vector<std::uint32_t>> rings;
    Vec3d normal;  // unit
};

struct Operand {
    std::vector<Vec3d> vertices;
    std::vector<SolidFace> faces;
    Box3d box;
};

bool isFlat(const model::Polygon& face, Vec3d normal) noexcept {
    return std::all_of(face.points.begin(), face.points.end(),
                       [&](Vec3d p) { return std::abs(dot(p - face.points[0], normal)) <= kSnap; });
}

// Faces that are not flat become fans of triangles where they have no holes.
Polygons flattened(const Polygons& faces) {
    Polygons result;
    for (const model::Polygon& face : faces) {
        const Vec3d normal = normalized(newellNormal(face));
        if (face.ringEnds.size() != 1 || face.points.size() == 3 || isFlat(face, normal)) {
            result.push_back(face);
            continue;
        }
        for (std::size_t i = 1; i + 1 < face.points.size(); ++i)
            addFace(result, {{face.points[0], face.points[i], face.points[i + 1]}});
    }
    return result;
}

Operand makeOperand(const Polygons& faces) {
    Operand operand;
    Welder welder(kWeld);
    const bool isInward = enclosedVolume(faces) < 0;
    for (const model::Polygon& face : faces) {
        SolidFace solid;
        std::size_t begin = 0;
        for (const std::uint32_t end : face.ringEnds) {
            std::vector<std::uint32_t> ring;
            for (std::size_t i = begin; i < end; ++i) ring.push_back(welder.add(face.points[i]));
            if (isInward) std::reverse(ring.begin(), ring.end());
            solid.rings.push_back(std::move(ring));
            begin = end;
        }
        solid.normal = normalized(newellNormal(face)) * (isInward ? -1.0 : 1.0);
        if (length(solid.normal) > 0.5) operand.faces.push_back(std::move(solid));
    }
    operand.vertices = welder.points();
    for (const Vec3d p : operand.vertices) operand.box.add(p);
    return operand;
}

class Boolean {
public:
    Boolean(BooleanOperator op, const std::vector<Polygons>& operands, std::uint64_t& budget)
        : op_(op), budget_(budget) {
        for (const Polygons& faces : operands) {
            sources_.push_back(flattened(faces));
            operands_.push_back(makeOperand(sources_.back()));
        }
    }

    std::optional<Polygons> run() {
        std::uint64_t faces = 0;
        for (const Operand& operand : operands_) faces += operand.faces.size();
        if (faces * faces > kMaxFacePairs || !take(kStepsOfEach + faces * faces)) return std::nullopt;
        findPlanes();
        for (const Plane& plane : planes_) {
            if (take(operands_.size())) evaluate(plane);
            if (budget_ == 0) return std::nullopt;
        }
        return conform();
    }

private:
    bool take(std::uint64_t steps) {
        budget_ = steps > budget_ ? 0 : budget_ - steps;
        return budget_ > 0;
    }

    // The plane of each face, shared by all faces whose points lie on it.
    void findPlanes() {
        for (std::uint32_t o = 0; o < operands_.size(); ++o)
            for (std::uint32_t f = 0; f < operands_[o].faces.size(); ++f) {
                const Operand& operand = operands_[o];
                const SolidFace& face = operand.faces[f];
                const auto liesOn = [&](const Plane& plane) {
                    if (std::abs(dot(plane.axes.z, face.normal)) < 0.99) return false;
                    for (const auto& ring : face.rings)
                        for (const std::uint32_t v : ring)
                            if (std::abs(plane.distance(operand.vertices[v])) > kSnap) return false;
                    return true;
                };
                auto plane = std::find_if(planes_.begin(), planes_.end(), liesOn);
                if (plane == planes_.end()) {
                    planes_.push_back({axesFrom(middleOf(operand, face), face.normal, {1, 0, 0}), {}, {}});
                    plane = planes_.end() - 1;
                }
                plane->faces.emplace_back(o, f);
                for (const std::uint32_t v : face.rings[0]) plane->region.add(operand.vertices[v]);
            }
    }

    static Vec3d middleOf(const Operand& operand, const SolidFace& face) {
        Vec3d sum{};
        for (const std::uint32_t v : face.rings[0]) sum = sum + operand.vertices[v];
        return sum / double(face.rings[0].size());
    }

    [[nodiscard]] std::uint8_t isInside(std::span<const std::int32_t> windings, std::size_t side) const {
        const auto isIn = [&](std::size_t o) { return windings[2 * o + side] > 0; };
        switch (op_) {
            case BooleanOperator::Union:
                for (std::size_t o = 0; o < operands_.size(); ++o)
                    if (isIn(o)) return 1;
                return 0;
            case BooleanOperator::Difference:
                for (std::size_t o = 1; o < operands_.size(); ++o)
                    if (isIn(o)) return 0;
                return isIn(0) ? 1 : 0;
            case BooleanOperator::Intersection:
                for (std::size_t o = 0; o < operands_.size(); ++o)
                    if (!isIn(o)) return 0;
                return 1;
        }
        return 0;
    }

    void evaluate(const Plane& plane) {
        const Box3d region = plane::grown(plane.region, 10 * kSnap);
        std::vector<std::uint32_t> near;
        for (std::uint32_t o = 0; o < operands_.size(); ++o)
            if (operands_[o].box.overlaps(region)) near.push_back(o);
        const bool hasFirst = !near.empty() && near.front() == 0;
        if (op_ == BooleanOperator::Difference && !hasFirst) return;
        if (op_ == BooleanOperator::Intersection && near.size() < operands_.size()) return;
        if (near.size() == 1) return keepFaces(plane);
        std::vector<OverlaySegment> segments;
        for (const std::uint32_t o : near)
            for (std::uint32_t side = 0; side < 2; ++side) cut(plane, o, side, segments);
        const auto stateOf = [&](std::span<const std::int32_t> windings) {
            const int below = isInside(windings, 0), above = isInside(windings, 1);
            return static_cast<std::uint8_t>(below == above ? 0 : below ? 1 : 2);
        };
        const auto channels = static_cast<std::uint32_t>(2 * operands_.size());
        for (const OverlayFace& face : overlay(segments, channels, stateOf, budget_)) {
            std::vector<std::vector<Vec3d>> rings;
            for (std::vector<Vec3d> ring : face.rings) {
                for (Vec3d& p : ring) p = plane.axes.point(p);
                if (face.state == 2) std::reverse(ring.begin(), ring.end());
                rings.push_back(std::move(ring));
            }
            faces_.push_back(std::move(rings));
        }
    }

    // Keeps the faces of a single operand unchanged.
    void keepFaces(const Plane& plane) {
        for (const auto& [o, f] : plane.faces) {
            std::vector<std::vector<Vec3d>> rings;
            for (const auto& ring : operands_[o].faces[f].rings) {
                rings.emplace_back();
                for (const std::uint32_t v : ring) rings.back().push_back(operands_[o].vertices[v]);
            }
            faces_.push_back(std::move(rings));
        }
    }

    // The section of an operand just below (side 0) or just above (side 1) a plane, in the axes of the plane.
    void cut(const Plane& plane, std::uint32_t o, std::uint32_t side, std::vector<OverlaySegment>& segments) {
        const Operand& operand = operands_[o];
        if (!take(operand.vertices.size() + 4 * operand.faces.size())) return;
        distances_.clear();
        for (const Vec3d p : operand.vertices) {
            const double d = plane.distance(p);
            distances_.push_back(std::abs(d) <= kSnap ? 0 : d);
        }
        // A point on the plane lies above one that is just below it.
        const auto isAbove = [&](std::uint32_t v) { return side == 0 ? distances_[v] >= 0 : distances_[v] > 0; };
        for (const SolidFace& face : operand.faces) {
            crossings_.clear();
            const Vec3d along = cross(plane.axes.z, face.normal);
            for (const auto& ring : face.rings)
                for (std::size_t i = 0; i < ring.size(); ++i) {
                    const std::uint32_t v = ring[i], w = ring[(i + 1) % ring.size()];
                    if (isAbove(v) == isAbove(w)) continue;
                    const Vec3d p = crossing(operand, v, w);
                    crossings_.push_back({dot(p, along), p, isAbove(v) ? 1 : -1});
                }
            std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& p, const Crossing& q) {
                return std::tie(p.along, p.step) < std::tie(q.along, q.step);
            });
            std::int32_t count = 0;
            for (std::size_t i = 0; i + 1 < crossings_.size(); ++i) {
                count += crossings_[i].step;
                if (count != 0)
                    segments.push_back(
                        {flat(plane, crossings_[i].at), flat(plane, crossings_[i + 1].at), 2 * o + side, count});
            }
        }
    }

    // The same bits whichever face of an edge asks.
    [[nodiscard]] Vec3d crossing(const Operand& operand, std::uint32_t v, std::uint32_t w) const {
        if (distances_[v] == 0) return operand.vertices[v];
        if (distances_[w] == 0) return operand.vertices[w];
        if (v > w) std::swap(v, w);
        const double share = distances_[v] / (distances_[v] - distances_[w]);
        return operand.vertices[v] + (operand.vertices[w] - operand.vertices[v]) * share;
    }

    static Vec3d flat(const Plane& plane, Vec3d p) {
        const Vec3d local = p - plane.axes.origin;
        return {dot(local, plane.axes.x), dot(local, plane.axes.y), 0};
    }

    // Points of all faces made one, points on straight lines dropped, then put in where another face has a corner.
    std::optional<Polygons> conform() {
        Welder welder(kSnap);
        for (const Operand& operand : operands_)
            for (const Vec3d p : operand.vertices) (void)welder.add(p);
        std::vector<std::vector<std::vector<std::uint32_t>>> faces;
        std::vector<std::uint32_t> corners;
        for (const auto& rings : faces_) {
            faces.emplace_back();
            for (const auto& ring : rings) {
                std::vector<std::uint32_t> ids;
                for (const Vec3d p : ring) ids.push_back(welder.add(p));
                dropStraight(welder.points(), ids);
                if (ids.size() < 3 && &ring == &rings.front()) break;
                if (ids.size() < 3) continue;
                corners.insert(corners.end(), ids.begin(), ids.end());
                faces.back().push_back(std::move(ids));
            }
        }
        const std::vector<Vec3d>& points = welder.points();
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        std::sort(corners.begin(), corners.end(), [&](std::uint32_t v, std::uint32_t w) {
            return std::tie(points[v].x, v) < std::tie(points[w].x, w);
        });
        Polygons result;
        for (const auto& rings : faces) {
            std::vector<std::vector<Vec3d>> cornersOfRings;
            for (const auto& ring : rings) cornersOfRings.push_back(withCorners(points, corners, ring));
            if (!cornersOfRings.empty()) addFace(result, cornersOfRings);
        }
        if (!result.empty() && !isClosed(result)) return std::nullopt;
        return result;
    }

    static void dropStraight(const std::vector<Vec3d>& points, std::vector<std::uint32_t>& ring) {
        for (bool isChanged = true; isChanged && ring.size() >= 3;) {
            isChanged = false;
            std::vector<std::uint32_t> kept;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const std::uint32_t before = kept.empty() ? ring.back() : kept.back(),
                                    behind = ring[(i + 1) % ring.size()];
                const Vec3d p = points[ring[i]], a = p - points[before], b = points[behind] - p;
                const bool isSame = ring[i] == before;
                const bool isStraight = length(cross(a, b)) <= 1e-6 * length(a + b) && dot(a, b) > 0;
                if (isSame || isStraight)
                    isChanged = true;
                else
                    kept.push_back(ring[i]);
            }
            ring = std::move(kept);
        }
    }

    static std::vector<Vec3d> withCorners(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& corners,
                                          const std::vector<std::uint32_t>& ring) {
        std::vector<Vec3d> result;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::uint32_t v = ring[i], w = ring[(i + 1) % ring.size()];
            const Vec3d a = points[v], d = points[w] - a;
            const double size = dot(d, d), low = std::min(a.x, points[w].x) - kSnap,
                         high = std::max(a.x, points[w].x) + kSnap;
            std::vector<std::pair<double, std::uint32_t>> on;
            auto it = std::lower_bound(corners.begin(), corners.end(), low,
                                       [&](std::uint32_t corner, double x) { return points[corner].x < x; });
            for (; it != corners.end() && points[*it].x <= high; ++it) {
                if (*it == v || *it == w) continue;
                const Vec3d p = points[*it] - a;
                const double share = dot(p, d) / size;
                if (share > 0 && share < 1 && length(p - d * share) <= 2 * kSnap) on.emplace_back(share, *it);
            }
            std::sort(on.begin(), on.end());
            result.push_back(a);
            for (const auto& [share, corner] : on) result.push_back(points[corner]);
        }
        return result;
    }

    struct Crossing {
        double along;
        Vec3d at;
        std::int32_t step;
    };

    BooleanOperator op_;
    std::uint64_t& budget_;  // steps left
    std::vector<Polygons> sources_;
    std::vector<Operand> operands_;
    std::vector<Plane> planes_;
    std::vector<std::vector<std::vector<Vec3d>>> faces_;
    std::vector<double> distances_;    // of the vertices of one operand
    std::vector<Crossing> crossings_;  // of one face
};

}  // namespace

std::optional<Polygons> evaluateBoolean(BooleanOperator op, const std::vector<Polygons>& operands) {
    std::uint64_t left = kMaxSteps;
    return Boolean(op, operands, left).run();
}

std::optional<Polygons> evaluateBoolean(BooleanOperator op, const std::vector<Polygons>& operands,
                                        step::ReadGuard& guard) {
    const std::uint64_t granted = std::min(kMaxSteps, guard.stepsLeft());
    std::uint64_t left = granted;
    auto result = Boolean(op, operands, left).run();
    guard.takeSteps(granted - left + (left == 0 ? 1 : 0));
    return result;
}

Polygons halfSpaceAround(const Box3d& around, Vec3d onPlane, Vec3d inside) {
    const Vec3d z = normalized(inside), center = around.center();
    const double reach = length(around.size()) + 1;
    Transform axes = axesFrom(center - z * dot(center - onPlane, z), z, {1, 0, 0});
    const double depth = std::max(0.0, dot(center - onPlane, z)) + reach;
    return transformed(
        extrude({{{-reach, -reach, 0}, {reach, -reach, 0}, {reach, reach, 0}, {-reach, reach, 0}}, {}}, {0, 0, depth}),
        axes);
}

}  // namespace svt::readers::ifc
