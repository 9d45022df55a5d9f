#include <svt/readers/ifc_schema/product_classes.hpp>

#include <svt/core/text.hpp>

#include <algorithm>

namespace svt::readers::ifc {
namespace {

using std::string_view;

struct Group {
    string_view className;
    ProductKind kind;
    string_view ifcTypes;  // without "Ifc", separated by blanks
};

constexpr string_view kElement = "BuildingConstructiveElement";
constexpr string_view kInstallation = "BuildingInstallation";

constexpr Group kGroups[] = {
    {"GenericLogicalSpace", ProductKind::Spatial,
     "Site Facility FacilityPart FacilityPartCommon ExternalSpatialElement SpatialZone MarineFacility MarinePart"},
    {"Building", ProductKind::Spatial, "Building"},
    {"Bridge", ProductKind::Spatial, "Bridge"},
    {"BridgePart", ProductKind::Spatial, "BridgePart"},
    {"Road", ProductKind::Spatial, "Road"},
    {"Railway", ProductKind::Spatial, "Railway"},
    {"Section", ProductKind::Spatial, "RoadPart RailwayPart"},
    {"Storey", ProductKind::Spatial, "BuildingStorey"},
    {"BuildingRoom", ProductKind::Spatial, "Space"},
    {"Door", ProductKind::Element, "Door DoorStandardCase"},
    {"Window", ProductKind::Element, "Window WindowStandardCase"},
    {"BuildingFurniture", ProductKind::Element, "FurnishingElement Furniture SystemFurnitureElement"},
    {kElement, ProductKind::Element,
     // Elements of buildings.
     "Wall WallStandardCase WallElementedCase Slab SlabStandardCase SlabElementedCase Beam BeamStandardCase Column "
     "ColumnStandardCase Member MemberStandardCase Plate PlateStandardCase Roof Stair StairFlight Ramp RampFlight "
     "CurtainWall Footing Pile Covering Chimney BuildingElement BuiltElement BuildingElementProxy "
     // Parts, foundations, reinforcement and accessories.
     "BuildingElementComponent BuildingElementPart ElementAssembly DeepFoundation CaissonFoundation "
     "ReinforcingElement ReinforcingBar ReinforcingMesh Tendon TendonAnchor TendonConduit DiscreteAccessory Fastener "
     "MechanicalFastener VibrationIsolator VibrationDamper ImpactProtectionDevice "
     // Infrastructure.
     "Bearing EarthworksElement EarthworksFill ReinforcedSoil Kerb Pavement Course MooringDevice NavigationElement "
     "Rail TrackElement Sign"},
    {kInstallation, ProductKind::Element,
     // General classes.
     "Railing ShadingDevice TransportElement TransportationDevice Vehicle DistributionElement "
     "DistributionFlowElement DistributionControlElement DistributionChamberElement EnergyConversionDevice "
     "FlowController FlowFitting FlowMovingDevice FlowSegment FlowStorageDevice FlowTerminal FlowTreatmentDevice "
     // Devices from A to C.
     "Actuator AirTerminal AirTerminalBox AirToAirHeatRecovery Alarm AudioVisualAppliance Boiler Burner "
     "CableCarrierFitting CableCarrierSegment CableFitting CableSegment Chiller Coil CommunicationsAppliance "
     "Compressor Condenser Controller ConveyorSegment CooledBeam CoolingTower "
     // Devices from D to F.
     "Damper DistributionBoard DuctFitting DuctSegment DuctSilencer ElectricAppliance ElectricDistributionBoard "
     "ElectricDistributionPoint ElectricFlowStorageDevice ElectricFlowTreatmentDevice ElectricGenerator ElectricMotor "
     "ElectricTimeControl Engine EvaporativeCooler Evaporator Fan Filter FireSuppressionTerminal FlowInstrument "
     "FlowMeter "
     // Devices from H to W, and general classes of IFC2x3.
     "HeatExchanger Humidifier Interceptor JunctionBox Lamp LightFixture LiquidTerminal MedicalDevice "
     "MobileTelecommunicationsAppliance MotorConnection Outlet PipeFitting PipeSegment ProtectiveDevice "
     "ProtectiveDeviceTrippingUnit Pump SanitaryTerminal Sensor Signal SolarDevice SpaceHeater StackTerminal "
     "SwitchingDevice Tank Transformer TubeBundle UnitaryControlElement UnitaryEquipment Valve WasteTerminal "
     "EquipmentElement ElectricalElement"},
    {"GenericOccupiedSpace", ProductKind::Element,
     "GeographicElement GeotechnicalElement GeotechnicalStratum SolidStratum WaterStratum VoidStratum "
     "GeotechnicalAssembly Borehole Geomodel Geoslice"},
    {"OtherConstruction", ProductKind::Element, "CivilElement"},
    {"Annotation", ProductKind::Element, "Annotation"},
    {"Grid", ProductKind::Element, "Grid"},
    {"", ProductKind::Opening,
     "OpeningElement OpeningStandardCase VoidingFeature EarthworksCut EdgeFeature ChamferEdgeFeature "
     "RoundedEdgeFeature ProjectionElement SurfaceFeature"},
    {"", ProductKind::Ignored,
     "Port DistributionPort VirtualElement Proxy Referent Alignment AlignmentHorizontal AlignmentVertical "
     "AlignmentCant AlignmentSegment LinearPositioningElement PositioningElement StructuralCurveMember "
     "StructuralCurveMemberVarying StructuralSurfaceMember StructuralSurfaceMemberVarying StructuralPointConnection "
     "StructuralCurveConnection StructuralSurfaceConnection StructuralPointAction StructuralPointReaction "
     "StructuralLinearAction StructuralCurveAction StructuralCurveReaction StructuralPlanarAction "
     "StructuralSurfaceAction StructuralSurfaceReaction"},
};

// Classes with attributes of their own before PredefinedType, or not derived from IfcElement.
constexpr struct {
    string_view ifcType;
    AttributePosition predefinedType;
} kPredefinedTypes[] = {
    {"IfcDoor", at::Door::PredefinedType},
    {"IfcDoorStandardCase", at::Door::PredefinedType},
    {"IfcWindow", at::Window::PredefinedType},
    {"IfcWindowStandardCase", at::Window::PredefinedType},
    {"IfcStairFlight", at::StairFlight::PredefinedType},
    {"IfcElementAssembly", at::ElementAssembly::PredefinedType},
    {"IfcReinforcingBar", at::ReinforcingBar::PredefinedType},
    {"IfcReinforcingMesh", at::ReinforcingMesh::PredefinedType},
    {"IfcTendon", at::Tendon::PredefinedType},
    {"IfcTendonAnchor", at::Tendon::PredefinedType},
    {"IfcTendonConduit", at::Tendon::PredefinedType},
    {"IfcMechanicalFastener", at::MechanicalFastener::PredefinedType},
    {"IfcGrid", at::Grid::PredefinedType},
    {"IfcAnnotation", at::Annotation::PredefinedType},
};

}  // namespace

ProductClass productClassOf(string_view typeName) noexcept {
    if (typeName.size() <= 3 || !equalsIgnoringCase(typeName.substr(0, 3), "Ifc")) return {};
    const string_view name = typeName.substr(3);
    for (const Group& group : kGroups) {
        string_view rest = group.ifcTypes;
        while (!rest.empty()) {
            const string_view word = rest.substr(0, rest.find(' '));
            if (equalsIgnoringCase(word, name)) return {word, group.className, group.kind};
            rest.remove_prefix(std::min(rest.size(), word.size() + 1));
        }
    }
    return {};
}

AttributePosition predefinedTypeOf(string_view ifcType) noexcept {
    for (const auto& [name, position] : kPredefinedTypes)
        if (name == ifcType) return position;
    return at::Wall::PredefinedType;
}

}  // namespace svt::readers::ifc
