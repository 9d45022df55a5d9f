#pragma once
/// \file
/// The same model with other faces: each is cut into triangles; for tests.

#include <svt/core/vec.hpp>
#include <svt/model/building_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace svt::test {

using FaceRing = std::vector<Vec3d>;

/// Twice the area of a triangle seen along `normal`. The rounding of world coordinates is below 1e-7 m2.
inline double twiceArea(Vec3d a, Vec3d b, Vec3d c, Vec3d normal) { return dot(cross(b - a, c - a), normal); }

inline Vec3d normalOf(const FaceRing& ring) {
    Vec3d normal{};
    for (std::size_t n = 1; n + 1 < ring.size(); ++n) normal = normal + cross(ring[n] - ring[0], ring[n + 1] - ring[0]);
    return normalized(normal);
}

inline std::size_t before(std::size_t n, const FaceRing& ring) { return n == 0 ? ring.size() - 1 : n - 1; }
inline std::size_t behind(std::size_t n, const FaceRing& ring) { return n + 1 == ring.size() ? 0 : n + 1; }

/// Ears of a ring, one after the other: triangles. The ring may touch itself, as one with bridges does.
/// \return the triangles, and behind them what is left where no ear is found
inline std::vector<FaceRing> earsOf(FaceRing ring) {
    constexpr double kRounding = 1e-7;
    const Vec3d normal = normalOf(ring);
    std::vector<FaceRing> ears;
    const auto isEar = [&](std::size_t n) {
        const Vec3d a = ring[before(n, ring)], b = ring[n], c = ring[behind(n, ring)];
        if (twiceArea(a, b, c, normal) < 1e-6) return false;
        return std::none_of(ring.begin(), ring.end(), [&](Vec3d p) {
            return p != a && p != b && p != c && twiceArea(a, b, p, normal) > -kRounding &&
                   twiceArea(b, c, p, normal) > -kRounding && twiceArea(c, a, p, normal) > -kRounding;
        });
    };
    while (ring.size() > 3) {
        std::size_t n = 0;
        while (n < ring.size() && !isEar(n)) ++n;
        if (n == ring.size()) break;
        ears.push_back({ring[before(n, ring)], ring[n], ring[behind(n, ring)]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(n));
    }
    ears.push_back(ring);
    return ears;
}

/// Joins the holes of a face to its outer ring, one after the other, each by the shortest bridge.
class HoleBridger {
public:
    explicit HoleBridger(const model::Polygon& face) {
        std::size_t begin = 0;
        for (const std::uint32_t end : face.ringEnds) {
            rings_.emplace_back(face.points.begin() + static_cast<std::ptrdiff_t>(begin), face.points.begin() + end);
            begin = end;
        }
        normal_ = normalOf(rings_[0]);
        for (std::size_t r = 1; r < rings_.size(); ++r)
            if (dot(normalOf(rings_[r]), normal_) > 0) std::reverse(rings_[r].begin(), rings_[r].end());
    }

    /// One ring that walks along each bridge twice; empty if a hole cannot be reached.
    FaceRing run() {
        while (rings_.size() > 1)
            if (!joinNearest()) return {};
        return rings_[0];
    }

private:
    bool joinNearest() {
        double shortest = kInfinity;
        std::size_t hole = 0, from = 0, to = 0;
        for (std::size_t r = 1; r < rings_.size(); ++r)
            for (std::size_t i = 0; i < rings_[0].size(); ++i)
                for (std::size_t j = 0; j < rings_[r].size(); ++j) {
                    const double distance = length(rings_[r][j] - rings_[0][i]);
                    if (distance >= shortest || !isInside(i, rings_[r][j]) || !isFree(rings_[0][i], rings_[r][j]))
                        continue;
                    shortest = distance;
                    hole = r;
                    from = i;
                    to = j;
                }
        if (hole == 0) return false;
        FaceRing& outer = rings_[0];
        FaceRing walk = rings_[hole];
        std::rotate(walk.begin(), walk.begin() + static_cast<std::ptrdiff_t>(to), walk.end());
        walk.push_back(walk.front());
        walk.push_back(outer[from]);
        outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(from) + 1, walk.begin(), walk.end());
        rings_.erase(rings_.begin() + static_cast<std::ptrdiff_t>(hole));
        return true;
    }

    // Whether the way from a corner of the outer ring leads into the face. Points may stand in the ring twice.
    [[nodiscard]] bool isInside(std::size_t corner, Vec3d to) const {
        const FaceRing& ring = rings_[0];
        const Vec3d a = ring[before(corner, ring)], b = ring[corner], c = ring[behind(corner, ring)];
        const bool isLeftOfFirst = twiceArea(a, b, to, normal_) > 0, isLeftOfSecond = twiceArea(b, c, to, normal_) > 0;
        return twiceArea(a, b, c, normal_) > 0 ? isLeftOfFirst && isLeftOfSecond : isLeftOfFirst || isLeftOfSecond;
    }

    // Whether a bridge crosses no edge and passes through no corner.
    [[nodiscard]] bool isFree(Vec3d a, Vec3d b) const {
        for (const FaceRing& ring : rings_)
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const Vec3d p = ring[n], q = ring[behind(n, ring)];
                const double ofP = twiceArea(a, b, p, normal_), ofQ = twiceArea(a, b, q, normal_);
                if (p != a && p != b && std::abs(ofP) < 1e-6 && dot(p - a, b - a) > 0 && dot(p - b, a - b) > 0)
                    return false;
                if (ofP * ofQ < 0 && twiceArea(p, q, a, normal_) * twiceArea(p, q, b, normal_) < 0) return false;
            }
        return true;
    }

    std::vector<FaceRing> rings_;
    Vec3d normal_;
};

/// Replaces each face by triangles.
/// \return how many faces with holes stay whole, since no way to cut them is found
inline std::size_t splitFaces(model::BuildingModel& model) {
    std::size_t whole = 0;
    std::vector<std::vector<model::PolygonIndex>> pieces(model.polygons.size());
    for (model::PolygonIndex p = 0; p < pieces.size(); ++p) {
        pieces[p] = {p};
        const bool hasHoles = model.polygons[p].ringEnds.size() != 1;
        const FaceRing ring = hasHoles ? HoleBridger(model.polygons[p]).run() : model.polygons[p].points;
        const std::vector<FaceRing> ears = ring.empty() ? std::vector<FaceRing>() : earsOf(ring);
        if (ears.empty() || (hasHoles && ears.back().size() > 3)) {
            ++whole;
            continue;
        }
        for (std::size_t n = 0; n < ears.size(); ++n) {
            if (n > 0) {
                pieces[p].push_back(static_cast<model::PolygonIndex>(model.polygons.size()));
                model.polygons.push_back(model.polygons[p]);
                model.polygons.back().id.clear();
            }
            model::Polygon& piece = model.polygons[pieces[p].back()];
            piece.points = ears[n];
            piece.ringEnds = {static_cast<std::uint32_t>(ears[n].size())};
        }
    }
    const auto replace = [&](std::vector<model::SurfaceUse>& uses) {
        std::vector<model::SurfaceUse> split;
        for (const model::SurfaceUse& use : uses)
            for (const model::PolygonIndex piece : pieces[use.polygon]) split.push_back({piece, use.isReversed});
        uses = std::move(split);
    };
    for (model::Feature& feature : model.features)
        for (model::Geometry& geometry : feature.geometries) {
            replace(geometry.surfaces);
            for (model::Solid& solid : geometry.solids) {
                replace(solid.exterior);
                for (auto& shell : solid.interiors) replace(shell);
            }
        }
    return whole;
}

}  // namespace svt::test
