#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace svt::model {
namespace {

using std::string_view;

template <std::size_t N>
bool isIn(const std::array<string_view, N>& names, string_view name) noexcept {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool endsWith(string_view text, string_view tail) noexcept {
    return text.size() >= tail.size() && text.substr(text.size() - tail.size()) == tail;
}

constexpr std::array<std::pair<string_view, string_view>, 14> kAliases{{
    {"Room", "BuildingRoom"},
    {"IntBuildingInstallation", "BuildingInstallation"},
    {"BuildingStorey", "Storey"},
    {"IntBridgeInstallation", "BridgeInstallation"},
    {"IntTunnelInstallation", "TunnelInstallation"},
    {"BridgeConstructionElement", "BridgeConstructiveElement"},
    {"TunnelConstructionElement", "TunnelConstructiveElement"},
    {"TINRelief", "TINRelief"},
    {"GenericCityObject", "GenericOccupiedSpace"},
    {"HollowSpace", "HollowSpace"},
    {"BridgeConstructiveElement", "BridgeConstructiveElement"},
    {"TunnelHollowSpace", "HollowSpace"},
    {"+Window", "Window"},  // CityJSON has no objects for openings; the generated models use an extension
    {"+Door", "Door"},
}};

constexpr string_view kPhase = "Phase";
constexpr std::array<string_view, 4> kFillings{"Door", "Window", "DoorSurface", "WindowSurface"};
constexpr std::array<string_view, 4> kRooms{"BuildingRoom", "BridgeRoom", "HollowSpace", "TunnelRoom"};
constexpr std::array<string_view, 8> kBuildings{
    "Building", "BuildingPart", "Bridge", "BridgePart", "Tunnel", "TunnelPart", "OtherConstruction", "+NoiseBuilding"};
// Thematic surfaces of all modules; water body and transportation surfaces bound spaces too.
constexpr std::array<string_view, 19> kBoundaries{"WallSurface",
                                                  "RoofSurface",
                                                  "GroundSurface",
                                                  "FloorSurface",
                                                  "CeilingSurface",
                                                  "ClosureSurface",
                                                  "InteriorWallSurface",
                                                  "OuterFloorSurface",
                                                  "OuterCeilingSurface",
                                                  "WaterSurface",
                                                  "WaterGroundSurface",
                                                  "WaterClosureSurface",
                                                  "TrafficArea",
                                                  "AuxiliaryTrafficArea",
                                                  "GenericThematicSurface",
                                                  "HoleSurface",
                                                  "Marking",
                                                  "TransportationMarking",
                                                  "TransportationHole"};
// Transportation objects are surfaces in CityGML 1.0 and 2.0, and spaces without their own solid in 3.0.
constexpr std::array<string_view, 22> kSurfaceOnly{"TINRelief",
                                                   "ReliefFeature",
                                                   "LandUse",
                                                   "CityObjectGroup",
                                                   "BreaklineRelief",
                                                   "RasterRelief",
                                                   "MassPointRelief",
                                                   "CityModel",
                                                   "TransportationComplex",
                                                   "Road",
                                                   "Railway",
                                                   "Track",
                                                   "Square",
                                                   "Waterway",
                                                   "TransportSquare",
                                                   "Section",
                                                   "Intersection",
                                                   "TrafficSpace",
                                                   "AuxiliaryTrafficSpace",
                                                   "ClearanceSpace",
                                                   "Hole",
                                                   "DoorSurface"};
// Classes that files store as loose sheets as often as bodies.
constexpr std::array<string_view, 13> kBodyIfDeclared{"Door",
                                                      "Window",
                                                      "SolitaryVegetationObject",
                                                      "PlantCover",
                                                      "CityFurniture",
                                                      "GenericOccupiedSpace",
                                                      "GenericUnoccupiedSpace",
                                                      "GenericLogicalSpace",
                                                      "Bridge",
                                                      "BridgePart",
                                                      "BridgeInstallation",
                                                      "WaterBody",
                                                      "OtherConstruction"};

}  // namespace

std::string canonicalClassName(string_view sourceName) {
    for (const auto& [alias, name] : kAliases)
        if (equalsIgnoringCase(alias, sourceName)) return std::string(name);
    return std::string(sourceName);
}

ClassRank classRank(string_view className) noexcept {
    if (isPhase(className)) return classRank(className.substr(0, className.size() - kPhase.size()));
    if (endsWith(className, "Furniture") || className == "SolitaryVegetationObject" || className == "PlantCover")
        return ClassRank::Furniture;
    if (isFilling(className)) return ClassRank::Filling;
    if (endsWith(className, "Installation")) return ClassRank::Installation;
    if (endsWith(className, "ConstructiveElement") || isBoundarySurface(className)) return ClassRank::Element;
    if (isIn(kRooms, className)) return ClassRank::Room;
    if (className == "BuildingUnit") return ClassRank::Unit;
    if (className == "Storey") return ClassRank::Storey;
    if (isIn(kBuildings, className)) return ClassRank::Building;
    return ClassRank::Other;
}

bool isBoundarySurface(string_view className) noexcept { return isIn(kBoundaries, className); }

Orientation orientationOf(string_view surfaceClass, bool boundsSpace) noexcept {
    if (surfaceClass == "GroundSurface" || surfaceClass == "OuterCeilingSurface") return Orientation::Down;
    if (surfaceClass == "RoofSurface" || surfaceClass == "OuterFloorSurface") return Orientation::Up;
    if (boundsSpace && surfaceClass == "FloorSurface") return Orientation::Down;
    if (boundsSpace && surfaceClass == "CeilingSurface") return Orientation::Up;
    return Orientation::Any;
}

std::string phaseClassOf(string_view className) { return std::string(className).append(kPhase); }

bool isPhase(string_view className) noexcept { return className.size() > kPhase.size() && endsWith(className, kPhase); }

bool isFilling(string_view className) noexcept { return isIn(kFillings, className); }

bool isSpace(string_view className) noexcept {
    return isIn(kRooms, className) || className == "BuildingUnit" || className == "Storey";
}

Inside insideOf(string_view className) noexcept {
    if (isBoundarySurface(className) || className == "WindowSurface" || isIn(kSurfaceOnly, className))
        return Inside::Never;
    return isPhase(className) || isIn(kBodyIfDeclared, className) ? Inside::Declared : Inside::Always;
}

bool hasSolidMeaning(string_view className) noexcept { return insideOf(className) != Inside::Never; }

}  // namespace svt::model
