#pragma once
/// \file
/// The same model with other faces: each without holes is cut into triangles; for tests.

#include <svt/core/vec.hpp>
#include <svt/model/building_model.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace svt::test {

inline double twiceArea(Vec3d a, Vec3d b, Vec3d c, Vec3d normal) { return dot(cross(b - a, c - a), normal); }

// Ears of a ring without holes, one after the other: triangles.
inline std::vector<std::vector<Vec3d>> earsOf(std::vector<Vec3d> ring) {
    Vec3d normal{};
    for (std::size_t n = 1; n + 1 < ring.size(); ++n) normal = normal + cross(ring[n] - ring[0], ring[n + 1] - ring[0]);
    normal = normalized(normal);
    std::vector<std::vector<Vec3d>> ears;
    const auto isEar = [&](std::size_t n) {
        const std::size_t count = ring.size();
        const Vec3d a = ring[(n + count - 1) % count], b = ring[n], c = ring[(n + 1) % count];
        if (twiceArea(a, b, c, normal) < 1e-6) return false;
        return std::none_of(ring.begin(), ring.end(), [&](Vec3d p) {
            return p != a && p != b && p != c && twiceArea(a, b, p, normal) > -1e-9 &&
                   twiceArea(b, c, p, normal) > -1e-9 && twiceArea(c, a, p, normal) > -1e-9;
        });
    };
    while (ring.size() > 3) {
        std::size_t n = 0;
        while (n < ring.size() && !isEar(n)) ++n;
        if (n == ring.size()) break;
        const std::size_t count = ring.size();
        ears.push_back({ring[(n + count - 1) % count], ring[n], ring[(n + 1) % count]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(n));
    }
    ears.push_back(ring);
    return ears;
}

// Replaces each face without holes by triangles.
inline void splitFaces(model::BuildingModel& model) {
    std::vector<std::vector<model::PolygonIndex>> pieces(model.polygons.size());
    for (model::PolygonIndex p = 0; p < pieces.size(); ++p) {
        pieces[p] = {p};
        if (model.polygons[p].ringEnds.size() != 1) continue;
        const auto ears = earsOf(model.polygons[p].points);
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
}

}  // namespace svt::test
