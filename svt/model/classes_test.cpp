#include <svt/model/classes.hpp>

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace svt::model {
namespace {

TEST(Classes, OldNamesBecomeThoseOfCityGml3) {
    EXPECT_EQ(canonicalClassName("Room"), "BuildingRoom");
    EXPECT_EQ(canonicalClassName("IntBuildingInstallation"), "BuildingInstallation");
    EXPECT_EQ(canonicalClassName("BuildingStorey"), "Storey");
    EXPECT_EQ(canonicalClassName("GenericCityObject"), "GenericOccupiedSpace");
    EXPECT_EQ(canonicalClassName("BridgeConstructionElement"), "BridgeConstructiveElement");
    EXPECT_EQ(canonicalClassName("TunnelHollowSpace"), "HollowSpace");
    EXPECT_EQ(canonicalClassName("room"), "BuildingRoom");
}

TEST(Classes, OtherNamesStayAsTheyAre) {
    for (const char* name : {"Building", "BuildingRoom", "WallSurface", "+NoiseBuilding", "Window", "Blimp", ""})
        EXPECT_EQ(canonicalClassName(name), name);
}

TEST(Classes, CanonicalNamesAreFixedPoints) {
    for (const char* name :
         {"Room", "IntBuildingInstallation", "BuildingStorey", "IntBridgeInstallation", "IntTunnelInstallation",
          "BridgeConstructionElement", "TunnelConstructionElement", "GenericCityObject", "TunnelHollowSpace"}) {
        const std::string canonical = canonicalClassName(name);
        EXPECT_EQ(canonicalClassName(canonical), canonical);
    }
}

TEST(Classes, FinerComponentsHaveTheLowerRank) {
    const std::vector<const char*> fromFineToCoarse{"BuildingFurniture",
                                                    "Window",
                                                    "BuildingInstallation",
                                                    "BuildingConstructiveElement",
                                                    "BuildingRoom",
                                                    "BuildingUnit",
                                                    "Storey",
                                                    "Building",
                                                    "LandUse"};
    for (std::size_t i = 1; i < fromFineToCoarse.size(); ++i)
        EXPECT_LT(classRank(fromFineToCoarse[i - 1]), classRank(fromFineToCoarse[i])) << fromFineToCoarse[i];
    EXPECT_EQ(classRank("WallSurface"), classRank("BuildingConstructiveElement"));
    EXPECT_EQ(classRank("BuildingPart"), classRank("Building"));
    EXPECT_EQ(classRank("DoorSurface"), classRank("Window"));
    EXPECT_EQ(classRank("BridgeInstallation"), ClassRank::Installation);
    EXPECT_EQ(classRank("SolitaryVegetationObject"), ClassRank::Furniture);
}

TEST(Classes, EveryClassIsBodyOrSurfaceAsItsMeaningSays) {
    // class, boundary surface, filling, space, solid meaning
    const std::vector<std::tuple<const char*, bool, bool, bool, bool>> expected{
        {"Building", false, false, false, true},
        {"BuildingRoom", false, false, true, true},
        {"Storey", false, false, true, true},
        {"BuildingUnit", false, false, true, true},
        {"HollowSpace", false, false, true, true},
        {"WallSurface", true, false, false, false},
        {"ClosureSurface", true, false, false, false},
        {"OuterFloorSurface", true, false, false, false},
        {"Door", false, true, false, true},
        {"WindowSurface", false, true, false, false},
        {"TINRelief", false, false, false, false},
        {"LandUse", false, false, false, false},
        {"CityObjectGroup", false, false, false, false},
        {"BuildingFurniture", false, false, false, true}};
    for (const auto& [name, boundary, filling, space, solid] : expected) {
        EXPECT_EQ(isBoundarySurface(name), boundary) << name;
        EXPECT_EQ(isFilling(name), filling) << name;
        EXPECT_EQ(isSpace(name), space) << name;
        EXPECT_EQ(hasSolidMeaning(name), solid) << name;
    }
}

TEST(Classes, WhatCanBeSheetsIsFilledOnlyWhereItIsDeclaredASolid) {
    for (const char* name : {"Building", "BuildingPart", "BuildingRoom", "BuildingInstallation", "BuildingFurniture",
                             "BuildingConstructiveElement", "Tunnel", "+NoiseBuilding", "Blimp"})
        EXPECT_EQ(insideOf(name), Inside::Always) << name;
    for (const char* name : {"SolitaryVegetationObject", "PlantCover", "GenericOccupiedSpace", "Bridge", "BridgePart",
                             "Door", "Window", "WaterBody", "CityFurniture"})
        EXPECT_EQ(insideOf(name), Inside::Declared) << name;
    for (const char* name : {"LandUse", "Road", "TransportSquare", "TINRelief", "WaterSurface", "TrafficSpace",
                             "DoorSurface", "WindowSurface", "TransportationMarking", "GroundSurface"})
        EXPECT_EQ(insideOf(name), Inside::Never) << name;
}

TEST(Classes, SurfacesLookOutOfWhatTheyBound) {
    for (const bool boundsSpace : {false, true}) {
        EXPECT_EQ(orientationOf("GroundSurface", boundsSpace), Orientation::Down);
        EXPECT_EQ(orientationOf("OuterCeilingSurface", boundsSpace), Orientation::Down);
        EXPECT_EQ(orientationOf("RoofSurface", boundsSpace), Orientation::Up);
        EXPECT_EQ(orientationOf("OuterFloorSurface", boundsSpace), Orientation::Up);
        EXPECT_EQ(orientationOf("WallSurface", boundsSpace), Orientation::Any);
        EXPECT_EQ(orientationOf("FloorSurface", boundsSpace), boundsSpace ? Orientation::Down : Orientation::Any);
        EXPECT_EQ(orientationOf("CeilingSurface", boundsSpace), boundsSpace ? Orientation::Up : Orientation::Any);
    }
}

}  // namespace
}  // namespace svt::model
