#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/gltf/model_faces.hpp>
#include <svt/writers/gltf/sheet_surfaces.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using volume::Filling;
using volume::SemanticVolume;

constexpr std::int32_t kMetre = 1 << 20;  // of points

// Adds the box from `low` to `high` (metres) as triangles of a label. \param faces  of six: bottom, top, south, east, north,
// west
void addBoxFaces(SemanticVolume& volume, std::uint32_t label, Vec3i low, Vec3i high, const std::vector<int>& faces) {
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
    auto& parts = volume.vectors;
    const auto first = static_cast<std::uint32_t>(parts.points.size());
    for (int corner = 0; corner < 8; ++corner)
        parts.points.push_back({(corner & 1 ? high.x : low.x) * kMetre, (corner & 2 ? high.y : low.y) * kMetre,
                                (corner & 4 ? high.z : low.z) * kMetre});
    for (const int f : faces) {
        const auto& c = kFaces[std::size_t(f)];
        parts.triangles.push_back({label, {first + c[0], first + c[1], first + c[2]}});
        parts.triangles.push_back({label, {first + c[0], first + c[2], first + c[3]}});
    }
}

const std::vector<int> kAllFaces{0, 1, 2, 3, 4, 5};

std::uint32_t addPart(SemanticVolume& volume, const char* id, const char* className, Filling filling,
                      std::uint32_t parent = volume::kNoLabel) {
    volume::Label& label = volume::test::addObject(volume, id, className, parent);
    label.filling = filling;
    label.voxels = 64;
    label.opacity = 1;
    return static_cast<std::uint32_t>(volume.labels.labels.size() - 1);
}

std::size_t countOf(const std::vector<TriangleUse>& uses, TriangleUse use) {
    return static_cast<std::size_t>(std::count(uses.begin(), uses.end(), use));
}

// A building of 4 x 4 x 4 m: its solid, and its roof and south wall as sheets.
SemanticVolume houseWithSheets() {
    SemanticVolume volume = volume::test::emptyVolume({8, 8, 8}, {1, 1, 1}, {0.5, 0.5, 0.5});
    const std::uint32_t solid = addPart(volume, "house", "Building", Filling::Solid);
    addBoxFaces(volume, solid, {0, 0, 0}, {4, 4, 4}, kAllFaces);
    addBoxFaces(volume, addPart(volume, "roof", "RoofSurface", Filling::Surface, solid), {0, 0, 0}, {4, 4, 4}, {1});
    addBoxFaces(volume, addPart(volume, "wall", "WallSurface", Filling::Surface, solid), {0, 0, 0}, {4, 4, 4}, {2});
    return volume;
}

TEST(ModelFaces, AFaceOfASolidThatAPartBelowHasIsCovered) {
    const SemanticVolume volume = houseWithSheets();
    const auto uses = drawnTriangles(volume, MeshChoice::Closed);
    ASSERT_EQ(uses.size(), 12u + 2 + 2);
    EXPECT_EQ(countOf(uses, TriangleUse::Covered), 4u);
    EXPECT_EQ(countOf(uses, TriangleUse::Drawn), 12u);
    for (std::size_t t = 12; t < 16; ++t) EXPECT_EQ(uses[t], TriangleUse::Drawn);
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::All), TriangleUse::Drawn), 16u);
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::Sheets), TriangleUse::Drawn), 4u);
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::None), TriangleUse::None), 16u);
    // Together they are the closed surface of the house.
    const SheetSurfaces sheets = sheetSurfaces(volume, MeshChoice::Closed);
    ASSERT_EQ(sheets.surfaces.size(), 3u);
    double area = 0, cubic = 0;
    for (std::size_t s = 0; s < 3; ++s)
        for (const auto& triangle : sheets.surfaces[s].triangles) {
            const Vec3d a = toDouble(sheets.positions[s][triangle[0]]), b = toDouble(sheets.positions[s][triangle[1]]),
                        c = toDouble(sheets.positions[s][triangle[2]]);
            area += length(cross(b - a, c - a)) / 2;
            cubic += dot(a, cross(b, c)) / 6;
        }
    EXPECT_NEAR(area, 96, 1e-4);
    EXPECT_NEAR(cubic, 64, 1e-4);
}

TEST(ModelFaces, AWallBetweenClosedPartsOfABuildingIsCovered) {
    SemanticVolume volume = volume::test::emptyVolume({8, 8, 8}, {1, 1, 1}, {0.5, 0.5, 0.5});
    volume::test::addGroup(volume, "house", "Building");
    // The diagonals of the common side are the same: both parts have the corner (4, 0, 0) first.
    const std::uint32_t west = addPart(volume, "west", "BuildingPart", Filling::Solid, 0);
    addBoxFaces(volume, west, {0, 0, 0}, {4, 4, 4}, {0, 1, 2, 4, 5});
    const auto first = static_cast<std::uint32_t>(volume.vectors.points.size());
    for (const Vec3i p : {Vec3i{4, 0, 0}, {4, 4, 0}, {4, 4, 4}, {4, 0, 4}}) volume.vectors.points.push_back(p * kMetre);
    volume.vectors.triangles.push_back({west, {first, first + 1, first + 2}});
    volume.vectors.triangles.push_back({west, {first, first + 2, first + 3}});
    const std::uint32_t east = addPart(volume, "east", "BuildingPart", Filling::Solid, 0);
    addBoxFaces(volume, east, {4, 0, 0}, {8, 4, 4}, {0, 1, 2, 3, 4});
    volume.vectors.triangles.push_back({east, {first, first + 2, first + 1}});
    volume.vectors.triangles.push_back({east, {first, first + 3, first + 2}});
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::Closed), TriangleUse::Covered), 4u);
    // Glass shows the wall behind it, and parts of two buildings stay whole.
    volume.labels.labels[west].opacity = 0.5f;
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::Closed), TriangleUse::Covered), 0u);
    volume.labels.labels[west].opacity = 1;
    volume.labels.labels[west].className = volume.labels.labels[east].className = "BuildingRoom";
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::Closed), TriangleUse::Covered), 0u);
}

TEST(ModelFaces, ASolidAroundRoomsOrBodiesHasTheSurfaceOfItsVoxels) {
    for (const auto& [className, filling] :
         {std::pair{"BuildingRoom", Filling::Solid}, {"WallSurface", Filling::Body}}) {
        SemanticVolume volume = houseWithSheets();
        EXPECT_EQ(countSurfaces(volume, MeshChoice::Closed).voxels, 0u);
        addPart(volume, "inside", className, filling, 0);
        EXPECT_EQ(chosenLabels(volume.labels, MeshChoice::Closed)[0], 0);
        EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::Closed), TriangleUse::Drawn), 4u);
        const SurfaceCounts counts = countSurfaces(volume, MeshChoice::Closed);
        EXPECT_EQ(counts.meshes, 2u);  // roof and wall
        EXPECT_EQ(counts.voxels, 2u);
    }
}

TEST(ModelFaces, ASolidThatLostVoxelsToAnotherFeatureHasTheSurfaceOfItsVoxels) {
    SemanticVolume volume = houseWithSheets();
    const std::uint32_t window = addPart(volume, "window", "Window", Filling::Solid);
    volume.labels.overlaps.push_back({window, 0, 1, false});
    EXPECT_NE(chosenLabels(volume.labels, MeshChoice::Closed)[0], 0) << "1 of 65 voxels";
    volume.labels.overlaps.back().voxels = 2;
    EXPECT_EQ(chosenLabels(volume.labels, MeshChoice::Closed)[0], 0);
    volume.labels.labels[window].filling = Filling::Surface;
    EXPECT_NE(chosenLabels(volume.labels, MeshChoice::Closed)[0], 0) << "a sheet is drawn on the solid";
    volume.labels.labels[window].filling = Filling::Solid;
    volume.labels.labels[window].className = "Building";
    EXPECT_NE(chosenLabels(volume.labels, MeshChoice::Closed)[0], 0) << "neighbours overlap in many models";
}

TEST(ModelFaces, OpenShellsAreDrawnOnRequest) {
    SemanticVolume volume = houseWithSheets();
    volume.labels.labels[0].filling = Filling::Winding;
    EXPECT_EQ(countSurfaces(volume, MeshChoice::Closed).voxels, 1u);
    EXPECT_EQ(countSurfaces(volume, MeshChoice::Open).voxels, 0u);
    EXPECT_EQ(countOf(drawnTriangles(volume, MeshChoice::Open), TriangleUse::Covered), 4u);
}

}  // namespace
}  // namespace svt::writers
