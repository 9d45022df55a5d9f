/// The outside of buildings with surfaces: each voxel there has the label of a surface whose face lies on it. Compared
/// with the distance from all faces of the model, by code that the voxelizer does not use.

#include <svt/mesh/models_test.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace svt::pipeline {
namespace {

using model::BuildingModel;
using test::Ring;

constexpr double kDegree = std::numbers::pi / 180;

// A building with surfaces, and the triangles of each surface.
struct SurfaceModel {
    BuildingModel model;
    model::FeatureIndex building = model::kNoFeature;
    std::map<std::string, std::vector<std::array<Vec3d, 3>>> faces;  // by feature id

    void add(const std::string& className, const std::string& id, const std::vector<Ring>& rings,
             bool isTurned = false) {
        std::vector<model::SurfaceUse> uses;
        for (const Ring& ring : rings) {
            uses.push_back({test::addRings(model, {ring}), isTurned});
            for (std::size_t p = 1; p + 1 < ring.size(); ++p) faces[id].push_back({ring[0], ring[p], ring[p + 1]});
        }
        test::addFeature(model, className, id, building, {test::surfaceOf(std::move(uses), 2)});
    }
};

double distanceToSegment(Vec3d p, Vec3d a, Vec3d b) {
    const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
    return length(p - a - (b - a) * t);
}

double distanceToFace(Vec3d p, const std::array<Vec3d, 3>& f) {
    const Vec3d n = normalized(cross(f[1] - f[0], f[2] - f[0]));
    bool isOver = true;
    double nearest = 1e9;
    for (std::size_t c = 0; c < 3; ++c) {
        const Vec3d a = f[c], b = f[(c + 1) % 3];
        isOver = isOver && dot(cross(b - a, p - a), n) >= 0;
        nearest = std::min(nearest, distanceToSegment(p, a, b));
    }
    return isOver ? std::abs(dot(p - f[0], n)) : nearest;
}

// m2 of the outside, along the faces of voxels.
struct Outside {
    double all = 0;
    double bare = 0;   // labelled Building, with a face within one voxel
    double wrong = 0;  // labelled as a surface that is farther away than `tolerance`, where another is closer
};

Outside measureOutside(const SurfaceModel& made, const volume::SemanticVolume& volume, double tolerance) {
    Outside outside;
    const Vec3i d = volume.columns.dimension();
    const double spacing = volume.grid.spacing().x;
    std::vector<std::uint32_t> labelOf(volume.labels.scalarCount(), volume::kNoLabel);
    for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l)
        if (volume.labels.labels[l].count != 0) labelOf[volume.labels.labels[l].first] = l;
    const auto at = [&](Vec3i v) {
        const bool isInside = v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < d.x && v.y < d.y && v.z < d.z;
        return isInside ? volume.columns.scalarAt(v.x, v.y, v.z) : 0;
    };
    for (std::int32_t z = 0; z < d.z; ++z)
        for (std::int32_t y = 0; y < d.y; ++y)
            for (std::int32_t x = 0; x < d.x; ++x) {
                const volume::Scalar scalar = at({x, y, z});
                if (scalar == 0) continue;
                int sides = 0;
                for (const Vec3i step : {Vec3i{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
                    sides += at(Vec3i{x, y, z} + step) == 0 ? 1 : 0;
                if (sides == 0) continue;
                const double area = sides * spacing * spacing;
                outside.all += area;
                const volume::Label& label = volume.labels.labels[labelOf[scalar]];
                const Vec3d p = volume.grid.worldFromIndex({double(x), double(y), double(z)});
                double own = 1e9, nearest = 1e9;
                for (const auto& [id, faces] : made.faces)
                    for (const auto& face : faces) {
                        const double distance = distanceToFace(p, face);
                        nearest = std::min(nearest, distance);
                        if (id == label.id) own = std::min(own, distance);
                    }
                if (label.className == "Building") {
                    if (nearest <= spacing) outside.bare += area;
                } else if (own > tolerance && own > nearest) {
                    outside.wrong += area;
                }
            }
    return outside;
}

// A house of 8 x 6 m with eaves at 3 m and a ridge at 5 m, turned by `degrees`. Its roof reaches `overhang` metres
// beyond the walls. The solid has polygons of its own, or shares those of the surfaces.
SurfaceModel gabledHouse(double degrees, double overhang, bool isShared = false, bool isRoofTurned = false) {
    const auto turn = [&](Ring ring) {
        for (Vec3d& p : ring)
            p = {std::cos(degrees * kDegree) * p.x - std::sin(degrees * kDegree) * p.y,
                 std::sin(degrees * kDegree) * p.x + std::cos(degrees * kDegree) * p.y, p.z};
        return ring;
    };
    const auto roof = [&](double o) {
        const double low = 3 - o * 2 / 3;
        return std::vector<Ring>{turn({{-o, -o, low}, {8 + o, -o, low}, {8 + o, 3, 5}, {-o, 3, 5}}),
                                 turn({{8 + o, 6 + o, low}, {-o, 6 + o, low}, {-o, 3, 5}, {8 + o, 3, 5}})};
    };
    const std::vector<Ring> walls{turn({{0, 0, 0}, {8, 0, 0}, {8, 0, 3}, {0, 0, 3}}),
                                  turn({{8, 0, 0}, {8, 6, 0}, {8, 6, 3}, {8, 3, 5}, {8, 0, 3}}),
                                  turn({{8, 6, 0}, {0, 6, 0}, {0, 6, 3}, {8, 6, 3}}),
                                  turn({{0, 6, 0}, {0, 0, 0}, {0, 0, 3}, {0, 3, 5}, {0, 6, 3}})};
    const Ring ground = turn({{0, 0, 0}, {0, 6, 0}, {8, 6, 0}, {8, 0, 0}});
    SurfaceModel made;
    made.building = test::addFeature(made.model, "Building", "house");
    made.add("GroundSurface", "ground", {ground});
    for (std::size_t w = 0; w < walls.size(); ++w) made.add("WallSurface", "wall-" + std::to_string(w), {walls[w]});
    for (std::size_t r = 0; r < 2; ++r)
        made.add("RoofSurface", "roof-" + std::to_string(r), {roof(overhang)[r]}, isRoofTurned);
    std::vector<model::SurfaceUse> shell;
    if (isShared) {
        for (model::PolygonIndex p = 0; p < made.model.polygons.size(); ++p) shell.push_back({p, false});
    } else {
        std::vector<Ring> rings = walls;
        rings.push_back(ground);
        for (const Ring& ring : roof(0)) rings.push_back(ring);
        for (const Ring& ring : rings) shell.push_back({test::addRings(made.model, {ring}), false});
    }
    made.model.features[made.building].geometries = {test::solidOf(std::move(shell), 2)};
    return made;
}

// A dome of 5 m radius on a drum, with surfaces and without a solid: 20 sectors of 12 faces. Neighbouring sectors
// overlap by up to `gap` metres, or leave that gap; three faces are missing.
SurfaceModel openDome(double gap) {
    constexpr int kSectors = 20, kRows = 12;
    SurfaceModel made;
    made.building = test::addFeature(made.model, "Building", "dome");
    const auto at = [&](int sector, int side, int row) {
        const double radius = 5, angle = (sector + side) * 2 * std::numbers::pi / kSectors;
        const double height = row < 0 ? -3 : radius * std::sin(row * 90 * kDegree / kRows);
        const double across = row < 0 ? radius : radius * std::cos(row * 90 * kDegree / kRows);
        const double shift = sector % 2 == 0 ? 0 : (side == 0 ? 1 : -0.5) * gap;
        return Vec3d{across * std::cos(angle) - shift * std::sin(angle),
                     across * std::sin(angle) + shift * std::cos(angle), height};
    };
    std::vector<Ring> dome, drum;
    Ring ground;
    for (int s = 0; s < kSectors; ++s) {
        drum.push_back({at(s, 0, -1), at(s, 1, -1), at(s, 1, 0), at(s, 0, 0)});
        ground.insert(ground.begin(), at(2 * (s / 2), s % 2, -1));
        for (int r = 0; r < kRows; ++r) {
            if (r == 6 && s % 7 == 3) continue;
            if (r + 1 < kRows)
                dome.push_back({at(s, 0, r), at(s, 1, r), at(s, 1, r + 1), at(s, 0, r + 1)});
            else
                dome.push_back({at(s, 0, r), at(s, 1, r), {0, 0, 5}});
        }
    }
    made.add("GroundSurface", "ground", {ground});
    made.add("WallSurface", "drum", drum);
    made.add("RoofSurface", "roof", dome);
    return made;
}

BuildOutput buildSurfaces(const SurfaceModel& made, double spacing, int threads = 0) {
    BuildOptions options;
    options.spacing = Vec3d{spacing, spacing, spacing};
    options.threads = threads;
    BuildingModel model = made.model;
    auto output = buildVolume(model, options);
    EXPECT_TRUE(output);
    return output ? std::move(*output) : BuildOutput{};
}

TEST(Outside, OfATurnedHouseShowsItsSurfaces) {
    for (const double degrees : {0.0, 17.0, 45.0, 107.0})
        for (const double overhang : {0.0, 0.4}) {
            const SurfaceModel made = gabledHouse(degrees, overhang);
            for (const double spacing : {0.13, 0.25}) {
                const Outside outside = measureOutside(made, buildSurfaces(made, spacing).volume, spacing);
                EXPECT_GT(outside.all, 200);
                EXPECT_EQ(outside.bare, 0) << degrees << " degrees, overhang " << overhang << ", spacing " << spacing;
                EXPECT_EQ(outside.wrong, 0) << degrees << " degrees, overhang " << overhang << ", spacing " << spacing;
            }
        }
}

TEST(Outside, OfAnOpenDomeShowsItsRoof) {
    for (const double gap : {0.0, 0.06, 0.12}) {
        const SurfaceModel made = openDome(gap);
        const double spacing = 0.15;
        const BuildOutput output = buildSurfaces(made, spacing);
        ASSERT_NE(output.volume.labels.labels[0].filling, volume::Filling::Surface);
        // Where edges were joined over a gap, the shell is up to this gap away from the faces of the model.
        const Outside outside = measureOutside(made, output.volume, spacing + gap);
        EXPECT_GT(outside.all, 200);
        EXPECT_EQ(outside.bare, 0) << "gap " << gap;
        EXPECT_EQ(outside.wrong, 0) << "gap " << gap;
    }
}

TEST(Outside, DoesNotDependOnThreads) {
    const SurfaceModel made = openDome(0.06);
    EXPECT_EQ(buildSurfaces(made, 0.1, 1).volume.columns, buildSurfaces(made, 0.1, 4).volume.columns);
}

// A surface that faces the other way than the body keeps its sheet on its own side, as interior walls do in a wall.
TEST(Outside, KeepsTheSidesOfSheets) {
    SurfaceModel made = gabledHouse(17, 0, true, true);
    made.model.features[made.building].className = "BuildingRoom";
    const BuildOutput room = buildSurfaces(made, 0.1);
    BuildingModel onlyRoom;
    onlyRoom.polygons = made.model.polygons;
    test::addFeature(onlyRoom, "BuildingRoom", "house", model::kNoFeature,
                     made.model.features[made.building].geometries);
    BuildOptions options;
    options.grid = room.volume.grid;
    const auto output = buildVolume(onlyRoom, options);
    ASSERT_TRUE(output);
    const auto roomVoxels = [](const BuildOutput& of) { return of.volume.labels.labels[0].voxels; };
    std::uint64_t walls = 0;
    for (const volume::Label& label : room.volume.labels.labels)
        if (label.className != "BuildingRoom" && label.className != "RoofSurface") walls += label.voxels;
    // Only the roof faces the other way; its sheet lies above the room. At the eaves, the roof gets voxels of the room.
    const auto all = double(roomVoxels(*output));
    EXPECT_NEAR(double(roomVoxels(room) + walls), all, 0.001 * all);
}

}  // namespace
}  // namespace svt::pipeline
