/// Roles of components by class, type and name.

#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/exact/boxes_test.hpp>

#include <gtest/gtest.h>

#include <string>

namespace svt::drawing {
namespace {

struct Part {
    std::string className, ifcType, predefinedType, name;
};

PartRole roleOfPart(const Part& part) {
    Boxes boxes;
    boxes.addBox("part", part.className, {0, 0, 0}, {1, 1, 1});
    volume::Label& label = boxes.volume.labels.labels.back();
    label.name = part.name;
    if (!part.ifcType.empty()) label.attributes.push_back({"ifcType", part.ifcType, {}});
    if (!part.predefinedType.empty()) label.attributes.push_back({"predefinedType", part.predefinedType, {}});
    return partRoles(boxes.volume.labels).back();
}

constexpr const char* kElementClass = "BuildingConstructiveElement";

TEST(PartRoles, WallsSlabsAndRoofsAreHull) {
    for (const char* type : {"IfcWall", "IfcWallStandardCase", "IfcCurtainWall", "IfcSlab", "IfcRoof", "IfcPlate"})
        EXPECT_EQ(roleOfPart({kElementClass, type, "", ""}), PartRole::Hull) << type;
    EXPECT_EQ(roleOfPart({kElementClass, "IfcMember", "MULLION", ""}), PartRole::Hull);
    for (const char* surface : {"WallSurface", "RoofSurface", "GroundSurface", "Building", "BuildingPart"})
        EXPECT_EQ(roleOfPart({surface, "", "", ""}), PartRole::Hull) << surface;
}

TEST(PartRoles, FramesCountWhereTheyTouch) {
    for (const char* type : {"IfcBeam", "IfcMember", "IfcStair", "IfcChimney"})
        EXPECT_EQ(roleOfPart({kElementClass, type, "", ""}), PartRole::Frame) << type;
    EXPECT_EQ(roleOfPart({kElementClass, "IfcColumn", "", ""}), PartRole::Column);
    EXPECT_EQ(roleOfPart({kElementClass, "IfcCovering", "CLADDING", ""}), PartRole::Frame);
    EXPECT_EQ(roleOfPart({kElementClass, "IfcCovering", "CEILING", ""}), PartRole::Nothing);
}

TEST(PartRoles, NamesDecideOnlyForProxiesAndComponentsWithoutAType) {
    const std::string tree = "M_RPC Tree - Deciduous:Siberian Crab Apple - 6.1 Meters:356904";
    EXPECT_EQ(roleOfPart({kElementClass, "IfcBuildingElementProxy", "", tree}), PartRole::Surroundings);
    EXPECT_EQ(roleOfPart({kElementClass, "", "", "Laubbaum 7"}), PartRole::Surroundings);
    EXPECT_EQ(roleOfPart({kElementClass, "IfcBuildingElementProxy", "", "Treehouse"}), PartRole::Nothing);
    EXPECT_EQ(roleOfPart({kElementClass, "IfcWall", "", "Tree wall"}), PartRole::Hull);
    EXPECT_EQ(roleOfPart({kElementClass, "", "", "Wall 7"}), PartRole::Hull);
    EXPECT_EQ(roleOfPart({kElementClass, "", "", "Terrace"}), PartRole::Nothing);
}

TEST(PartRoles, OpeningsFurnitureAndTerrain) {
    EXPECT_EQ(roleOfPart({"Window", "", "", ""}), PartRole::Opening);
    EXPECT_EQ(roleOfPart({kElementClass, "IfcDoor", "", ""}), PartRole::Opening);
    EXPECT_EQ(roleOfPart({"BuildingRoom", "", "", ""}), PartRole::Space);
    EXPECT_EQ(roleOfPart({"BuildingFurniture", "", "", ""}), PartRole::Nothing);
    EXPECT_EQ(roleOfPart({"BuildingInstallation", "IfcRailing", "", ""}), PartRole::Nothing);
    for (const char* terrain :
         {"TINRelief", "SolitaryVegetationObject", "CityFurniture", "GenericLogicalSpace", "Road"})
        EXPECT_EQ(roleOfPart({terrain, "", "", ""}), PartRole::Surroundings) << terrain;
}

// The layers of a wall have no type of their own.
TEST(PartRoles, PartsOfAWallHaveItsRole) {
    Boxes boxes;
    boxes.addBox("wall", kElementClass, {0, 0, 0}, {1, 1, 1});
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcWall"), {}});
    boxes.addBox("layer", kElementClass, {0, 0, 0}, {1, 0.1, 1});
    boxes.volume.labels.labels.back().parent = 0;
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcBuildingElementPart"), {}});
    EXPECT_EQ(partRoles(boxes.volume.labels).back(), PartRole::Hull);
}

}  // namespace
}  // namespace svt::drawing
