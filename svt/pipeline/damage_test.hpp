#pragma once
/// \file
/// Damages a model on purpose, with a fixed seed, and counts how many voxels of each object are then wrong. The
/// undamaged model is the truth.

#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>
#include <svt/model/classes.hpp>
#include <svt/volume/grid.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace svt::test {

/// splitmix64: the same numbers on every machine.
class DamageRandom {
public:
    explicit DamageRandom(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ z >> 27) * 0x94D049BB133111EBull;
        return z ^ z >> 31;
    }
    double unit() { return double(next() >> 11) * 0x1p-53; }

private:
    std::uint64_t state_;
};

/// All lists of uses of a geometry.
template <class F>
void forEachUseList(model::BuildingModel& model, const F& body) {
    for (model::Feature& feature : model.features)
        for (model::Geometry& geometry : feature.geometries) {
            body(geometry.surfaces);
            for (model::Solid& solid : geometry.solids) {
                body(solid.exterior);
                for (auto& interior : solid.interiors) body(interior);
            }
        }
}

/// Polygons in use, ascending.
inline std::vector<model::PolygonIndex> polygonsInUse(model::BuildingModel& model) {
    std::set<model::PolygonIndex> used;
    forEachUseList(model, [&](const std::vector<model::SurfaceUse>& uses) {
        for (const model::SurfaceUse& use : uses) used.insert(use.polygon);
    });
    return {used.begin(), used.end()};
}

/// A part of the polygons in use, chosen by chance.
inline std::set<model::PolygonIndex> someOf(const std::vector<model::PolygonIndex>& polygons, double part,
                                            std::uint64_t seed) {
    DamageRandom random(seed);
    std::set<model::PolygonIndex> chosen;
    for (const model::PolygonIndex p : polygons)
        if (random.unit() < part) chosen.insert(p);
    return chosen;
}

inline std::set<model::PolygonIndex> someOf(model::BuildingModel& model, double part, std::uint64_t seed) {
    return someOf(polygonsInUse(model), part, seed);
}

/// Polygons of the boundary surfaces of one class.
inline std::set<model::PolygonIndex> polygonsOfClass(const model::BuildingModel& model, std::string_view className) {
    std::set<model::PolygonIndex> found;
    for (const model::Feature& feature : model.features)
        if (feature.className == className)
            for (const model::Geometry& geometry : feature.geometries)
                for (const model::SurfaceUse& use : geometry.surfaces) found.insert(use.polygon);
    return found;
}

inline Vec3d areaVectorOf(const model::Polygon& polygon) {
    Vec3d sum{};
    const std::uint32_t end = polygon.ringEnds.empty() ? 0 : polygon.ringEnds[0];
    for (std::uint32_t i = 0; i < end; ++i)
        sum =
            sum + cross(polygon.points[i] - polygon.points[0], polygon.points[(i + 1) % end] - polygon.points[0]) * 0.5;
    return sum;
}

/// Walls of two buildings (features directly above the boundary surfaces) that stand against each other: vertical, in
/// one plane up to 5 cm, facing opposite ways, the middle of one before the box of the other.
inline std::set<model::PolygonIndex> partyWalls(const model::BuildingModel& model) {
    struct Wall {
        model::PolygonIndex polygon;
        model::FeatureIndex building;
        Vec3d normal, center;
        Box3d box;
    };
    std::vector<Wall> walls;
    for (const model::Feature& feature : model.features) {
        if (feature.className != "WallSurface") continue;
        for (const model::Geometry& geometry : feature.geometries)
            for (const model::SurfaceUse& use : geometry.surfaces) {
                const model::Polygon& polygon = model.polygons[use.polygon];
                Wall wall{use.polygon, feature.parent, normalized(areaVectorOf(polygon)), {}, {}};
                for (const Vec3d& point : polygon.points) wall.box.add(point);
                wall.center = wall.box.center();
                if (std::abs(wall.normal.z) < 0.1) walls.push_back(wall);
            }
    }
    std::set<model::PolygonIndex> found;
    for (const Wall& a : walls)
        for (const Wall& b : walls) {
            if (a.building == b.building || dot(a.normal, b.normal) > -0.99) continue;
            if (std::abs(dot(a.center - b.center, a.normal)) > 0.05) continue;
            const Vec3d margin{0.05, 0.05, 0.05};
            if (!Box3d{b.box.min - margin, b.box.max + margin}.contains(a.center)) continue;
            found.insert(a.polygon);
            found.insert(b.polygon);
        }
    return found;
}

inline void removePolygons(model::BuildingModel& model, const std::set<model::PolygonIndex>& polygons) {
    forEachUseList(model, [&](std::vector<model::SurfaceUse>& uses) {
        std::erase_if(uses, [&](const model::SurfaceUse& use) { return polygons.count(use.polygon) != 0; });
    });
}

/// Reverses their rings.
inline void turnPolygons(model::BuildingModel& model, const std::set<model::PolygonIndex>& polygons) {
    for (const model::PolygonIndex p : polygons) {
        model::Polygon& polygon = model.polygons[p];
        std::uint32_t begin = 0;
        for (const std::uint32_t end : polygon.ringEnds) {
            std::reverse(polygon.points.begin() + begin, polygon.points.begin() + end);
            begin = end;
        }
    }
}

/// Adds a copy of each, used wherever it is used, and turned if wanted.
inline void doublePolygons(model::BuildingModel& model, const std::set<model::PolygonIndex>& polygons) {
    std::map<model::PolygonIndex, model::PolygonIndex> copyOf;
    for (const model::PolygonIndex p : polygons) copyOf[p] = model.addPolygon(model.polygons[p]);
    forEachUseList(model, [&](std::vector<model::SurfaceUse>& uses) {
        std::vector<model::SurfaceUse> added;
        for (const model::SurfaceUse& use : uses)
            if (const auto copy = copyOf.find(use.polygon); copy != copyOf.end())
                added.push_back({copy->second, use.isReversed});
        uses.insert(uses.end(), added.begin(), added.end());
    });
}

/// Moves each polygon as a whole by `distance` metres in a direction by chance.
inline void movePolygons(model::BuildingModel& model, const std::set<model::PolygonIndex>& polygons, double distance,
                         std::uint64_t seed) {
    DamageRandom random(seed);
    for (const model::PolygonIndex p : polygons) {
        Vec3d direction{};
        do direction = Vec3d{random.unit(), random.unit(), random.unit()} * 2.0 - Vec3d{1, 1, 1};
        while (!(length(direction) > 0.1 && length(direction) < 1));
        for (Vec3d& point : model.polygons[p].points) point = point + normalized(direction) * distance;
    }
}

/// Rings of a polygon changed one by one.
template <class F>
void changeRings(model::Polygon& polygon, const F& change) {
    model::Polygon changed = polygon;
    changed.points.clear();
    changed.ringEnds.clear();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : polygon.ringEnds) {
        std::vector<Vec3d> ring(polygon.points.begin() + begin, polygon.points.begin() + end);
        change(ring);
        changed.points.insert(changed.points.end(), ring.begin(), ring.end());
        changed.ringEnds.push_back(static_cast<std::uint32_t>(changed.points.size()));
        begin = end;
    }
    polygon = std::move(changed);
}

/// Adds a point in the first edge of each ring that its neighbour has not, `off` metres beside it along x.
inline void splitEdges(model::BuildingModel& model, const std::set<model::PolygonIndex>& polygons, double off) {
    for (const model::PolygonIndex p : polygons)
        changeRings(model.polygons[p], [&](std::vector<Vec3d>& ring) {
            ring.insert(ring.begin() + 1, ring[0] * 0.625 + ring[1] * 0.375 + Vec3d{off, 0, 0});
        });
}

/// Takes the last point of each ring away, as a ring that was not closed and lost its end.
inline void openRings(model::BuildingModel& model, const std::set<model::PolygonIndex>& polygons) {
    for (const model::PolygonIndex p : polygons)
        changeRings(model.polygons[p], [](std::vector<Vec3d>& ring) {
            if (ring.size() > 3) ring.pop_back();
        });
}

/// The solids of a model in voxels. Sheets are left out: they would take the voxels of the solids that they bound.
struct FilledSolids {
    volume::ColumnVolume columns;  // scalar: 1 + index in ids
    std::vector<std::string> ids;
    std::vector<mesh::ClosingMethod> closingMethods;
    std::vector<std::uint64_t> uncertain;
    double seconds = 0;
};

/// Fills the objects with these ids, or all that are closed where `ids` is null.
/// \param grid  made from the first model that comes with none
inline std::optional<FilledSolids> fillSolids(const model::BuildingModel& model, double spacing,
                                              std::optional<volume::Grid>& grid, const std::vector<std::string>* ids) {
    FilledSolids filled;
    const auto start = std::chrono::steady_clock::now();
    auto meshes = mesh::buildMeshes(model);
    if (!meshes) return std::nullopt;
    std::map<std::string, volume::Scalar> scalarOf;
    if (ids != nullptr)
        for (const std::string& id : *ids) scalarOf.emplace(id, static_cast<volume::Scalar>(scalarOf.size() + 1));
    std::erase_if(meshes->objects, [&](const mesh::ObjectMesh& object) {
        const std::string& id = model.features[object.feature].id;
        if (ids != nullptr) return scalarOf.count(id) == 0;
        if (!object.isSolid()) return true;
        scalarOf.emplace(id, static_cast<volume::Scalar>(scalarOf.size() + 1));
        filled.ids.push_back(id);
        return false;
    });
    if (ids != nullptr) filled.ids = *ids;
    filled.closingMethods.assign(filled.ids.size(), mesh::ClosingMethod::Surface);
    filled.uncertain.assign(filled.ids.size(), 0);
    if (!grid) {
        Box3d box{meshes->bounds.min + meshes->origin, meshes->bounds.max + meshes->origin};
        auto made = volume::Grid::fromSpacing(box, {spacing, spacing, spacing});
        if (!made) return std::nullopt;
        grid = *made;
    }
    std::vector<voxelize::ObjectClaim> claims;
    for (const mesh::ObjectMesh& object : meshes->objects) {
        const model::Feature& feature = model.features[object.feature];
        const volume::Scalar scalar = scalarOf[feature.id];
        filled.closingMethods[scalar - 1] = object.closingMethod;
        claims.push_back({scalar, static_cast<std::uint8_t>(model::classRank(feature.className)), feature.id});
    }
    // Which voxels parts thinner than a voxel get depends on how their faces are triangulated; that is not the question.
    voxelize::VoxelizeOptions options;
    options.keepThinParts = false;
    auto voxels = voxelize::voxelize(*meshes, *grid, claims, options);
    if (!voxels) return std::nullopt;
    for (std::size_t o = 0; o < claims.size(); ++o) filled.uncertain[claims[o].scalar - 1] = voxels->uncertainVoxels[o];
    filled.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    filled.columns = std::move(voxels->columns);
    return filled;
}

/// What damage did to the objects that have enough voxels for a figure in percent.
struct DamageFigures {
    std::size_t objects = 0;
    double median = 0, percentile95 = 0, worst = 0;  ///< wrong voxels of an object / its voxels
    std::string worstId;
    double volume = 0;                                           ///< sum of |voxels - true voxels| / sum of true voxels
    std::size_t closed = 0, capped = 0, open = 0, surfaces = 0;  ///< verdicts; capped: also complemented
    std::vector<std::pair<double, std::string>> all;             ///< ascending
};

inline DamageFigures compareSolids(const FilledSolids& truth, const FilledSolids& damaged,
                                   std::uint64_t fewestVoxels = 200) {
    const std::size_t count = truth.ids.size() + 1;
    std::vector<std::uint64_t> voxels(count, 0), damagedVoxels(count, 0), wrong(count, 0);
    const Vec3i n = truth.columns.dimension();
    for (std::int32_t j = 0; j < n.y; ++j)
        for (std::int32_t i = 0; i < n.x; ++i) {
            const auto a = truth.columns.column(i, j), b = damaged.columns.column(i, j);
            std::uint32_t k = 0;
            for (std::size_t p = 0, q = 0; p < a.size() && q < b.size();) {
                const std::uint32_t end = std::min(a[p].end, b[q].end);
                voxels[a[p].scalar] += end - k;
                damagedVoxels[b[q].scalar] += end - k;
                if (a[p].scalar != b[q].scalar) {
                    wrong[a[p].scalar] += end - k;
                    wrong[b[q].scalar] += end - k;
                }
                k = end;
                if (a[p].end == end) ++p;
                if (b[q].end == end) ++q;
            }
        }
    DamageFigures figures;
    double difference = 0, total = 0;
    for (std::size_t s = 1; s < count; ++s) {
        if (voxels[s] < fewestVoxels) continue;
        ++figures.objects;
        figures.all.emplace_back(
            double(wrong[s]) / double(voxels[s]),
            truth.ids[s - 1] + ", " + std::string(mesh::closingMethodName(damaged.closingMethods[s - 1])));
        difference += std::abs(double(damagedVoxels[s]) - double(voxels[s]));
        total += double(voxels[s]);
        switch (damaged.closingMethods[s - 1]) {
            case mesh::ClosingMethod::Closed:
            case mesh::ClosingMethod::TJunctions: ++figures.closed; break;
            case mesh::ClosingMethod::Complemented:
            case mesh::ClosingMethod::Capped: ++figures.capped; break;
            case mesh::ClosingMethod::Open: ++figures.open; break;
            case mesh::ClosingMethod::Surface: ++figures.surfaces; break;
        }
    }
    if (figures.all.empty()) return figures;
    std::sort(figures.all.begin(), figures.all.end());
    figures.median = figures.all[figures.all.size() / 2].first;
    figures.percentile95 = figures.all[figures.all.size() * 95 / 100].first;
    figures.worst = figures.all.back().first;
    figures.worstId = figures.all.back().second;
    figures.volume = total > 0 ? difference / total : 0;
    return figures;
}

}  // namespace svt::test
