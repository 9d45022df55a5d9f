#include <svt/writers/sheets/class_words.hpp>

#include <svt/core/text.hpp>

#include <algorithm>
#include <iterator>

namespace svt::writers {
namespace {

constexpr ClassTerm kClassTerms[] = {
    {"Wall", "", "Wand"},
    {"CurtainWall", "", "Vorhangfassade"},
    {"Slab", "", "Decke"},
    {"Roof", "", "Dach"},
    {"Column", "", "Stütze"},
    {"Beam", "", "Träger"},
    {"Member", "Structural member", "Stab"},
    {"Plate", "", "Platte"},
    {"Stair", "", "Treppe"},
    {"StairFlight", "Flight of stairs", "Treppenlauf"},
    {"Ramp", "", "Rampe"},
    {"RampFlight", "Flight of a ramp", "Rampenlauf"},
    {"Railing", "", "Geländer"},
    {"Footing", "", "Fundament"},
    {"Pile", "", "Pfahl"},
    {"Door", "", "Tür"},
    {"Window", "", "Fenster"},
    {"Covering", "", "Bekleidung, Belag"},
    {"Chimney", "", "Schornstein"},
    {"ShadingDevice", "", "Sonnenschutz"},
    {"BuildingElementProxy", "Other component", "Sonstiges Bauteil"},
    {"BuildingElementPart", "Layer or part", "Schicht, Teil"},
    {"ElementAssembly", "Assembly", "Baugruppe"},
    {"DiscreteAccessory", "Accessory", "Einbauteil"},
    {"MechanicalFastener", "Fastener", "Verbindungsmittel"},
    {"Fastener", "", "Verbindungsmittel"},
    {"ReinforcingBar", "", "Bewehrungsstab"},
    {"ReinforcingMesh", "", "Bewehrungsmatte"},
    {"Tendon", "", "Spannglied"},
    {"FurnishingElement", "Furniture", "Möbel"},
    {"Furniture", "", "Möbel"},
    {"TransportElement", "Lift or escalator", "Aufzug, Fahrtreppe"},
    {"DistributionElement", "Building services", "Haustechnik"},
    {"FlowSegment", "Pipe or duct", "Leitung"},
    {"PipeSegment", "Pipe", "Rohr"},
    {"DuctSegment", "Duct", "Luftkanal"},
    {"CableSegment", "Cable", "Kabel"},
    {"CableCarrierSegment", "Cable tray", "Kabeltrasse"},
    {"FlowFitting", "Fitting", "Formstück"},
    {"PipeFitting", "", "Rohrformstück"},
    {"DuctFitting", "", "Kanalformstück"},
    {"FlowTerminal", "Fixture", "Installationsgegenstand"},
    {"SanitaryTerminal", "Sanitary fixture", "Sanitärgegenstand"},
    {"LightFixture", "Luminaire", "Leuchte"},
    {"FlowController", "Valve or damper", "Armatur"},
    {"FlowMovingDevice", "Pump or fan", "Pumpe, Ventilator"},
    {"FlowStorageDevice", "Tank", "Behälter"},
    {"EnergyConversionDevice", "", "Energiewandler"},
    {"OpeningElement", "Opening", "Öffnung"},
    {"Site", "", "Gelände"},
    {"GeographicElement", "Terrain", "Gelände"},
    {"Building", "", "Gebäude"},
    {"BuildingPart", "Part of a building", "Gebäudeteil"},
    {"BuildingConstructiveElement", "Component", "Bauteil"},
    {"BuildingInstallation", "Installation", "Anbau, Einbau"},
    {"IntBuildingInstallation", "Installation", "Anbau, Einbau"},
    {"BuildingFurniture", "Furniture", "Möbel"},
    {"OuterWall", "", "Außenwand"},
    {"InnerWall", "", "Innenwand"},
    {"WallSurface", "Outer wall surface", "Außenwandfläche"},
    {"InteriorWallSurface", "Inner wall surface", "Innenwandfläche"},
    {"RoofSurface", "", "Dachfläche"},
    {"GroundSurface", "Ground slab surface", "Grundfläche"},
    {"FloorSurface", "", "Fußbodenfläche"},
    {"CeilingSurface", "", "Deckenfläche"},
    {"OuterFloorSurface", "", "Äußere Bodenfläche"},
    {"OuterCeilingSurface", "", "Äußere Deckenfläche"},
    {"ClosureSurface", "Open boundary", "Offene Begrenzung"},
    {"DoorSurface", "", "Türfläche"},
    {"WindowSurface", "", "Fensterfläche"},
    {"Canopy", "", "Vordach"},
    {"Rafter", "", "Sparren"},
    {"Step", "", "Stufe"},
    {"Terrace", "", "Terrasse"},
    {"Balcony", "", "Balkon"},
    {"SolitaryVegetationObject", "Tree or shrub", "Baum, Strauch"},
    {"PlantCover", "Planting", "Bewuchs"},
    {"CityFurniture", "Street furniture", "Stadtmobiliar"},
    {"ReliefFeature", "Terrain", "Gelände"},
    {"TINRelief", "Terrain", "Gelände"},
    {"Road", "", "Straße"},
    {"Bridge", "", "Brücke"},
    {"GenericCityObject", "Other object", "Sonstiges Objekt"},
    {"Space", "", "Raum"},
    {"Room", "", "Raum"},
    {"BuildingRoom", "Room", "Raum"},
    {"SpatialZone", "Zone", "Zone"},
    {"Zone", "", "Zone"},
    {"Storey", "", "Geschoss"},
    {"BuildingStorey", "Storey", "Geschoss"},
    {"BuildingUnit", "Unit", "Nutzungseinheit"},
    {"CellSpace", "Cell", "Raumzelle"},
    {"Actuator", "", "Stellantrieb"},
    {"AirTerminal", "", "Luftauslass"},
    {"AirTerminalBox", "", "Luftverteilkasten"},
    {"AirToAirHeatRecovery", "Heat recovery", "Wärmerückgewinnung"},
    {"Alarm", "", "Melder"},
    {"AudioVisualAppliance", "Audio and video device", "Audio- und Videogerät"},
    {"Boiler", "", "Heizkessel"},
    {"Burner", "", "Brenner"},
    {"CableCarrierFitting", "Cable tray fitting", "Kabeltrassenformstück"},
    {"CableFitting", "", "Kabelanschluss"},
    {"Chiller", "", "Kältemaschine"},
    {"Coil", "", "Heiz- oder Kühlregister"},
    {"CommunicationsAppliance", "Communication device", "Kommunikationsgerät"},
    {"Compressor", "", "Verdichter"},
    {"Condenser", "", "Verflüssiger"},
    {"Controller", "", "Regler"},
    {"CooledBeam", "Chilled beam", "Kühlbalken"},
    {"CoolingTower", "", "Kühlturm"},
    {"Damper", "", "Klappe"},
    {"DistributionChamberElement", "Chamber", "Schacht"},
    {"DistributionControlElement", "Control device", "Regelgerät"},
    {"DistributionFlowElement", "Building services", "Haustechnik"},
    {"DistributionPort", "Port", "Anschluss"},
    {"DuctSilencer", "", "Schalldämpfer"},
    {"ElectricAppliance", "", "Elektrogerät"},
    {"ElectricDistributionBoard", "Distribution board", "Elektroverteiler"},
    {"ElectricFlowStorageDevice", "Battery", "Stromspeicher"},
    {"ElectricGenerator", "Generator", "Generator"},
    {"ElectricMotor", "", "Elektromotor"},
    {"ElectricTimeControl", "Timer", "Zeitschaltuhr"},
    {"Engine", "", "Motor"},
    {"EvaporativeCooler", "", "Verdunstungskühler"},
    {"Evaporator", "", "Verdampfer"},
    {"Fan", "", "Ventilator"},
    {"Filter", "", "Filter"},
    {"FireSuppressionTerminal", "Fire suppression", "Löscheinrichtung"},
    {"FlowInstrument", "", "Messgerät"},
    {"FlowMeter", "", "Zähler"},
    {"FlowTreatmentDevice", "Treatment device", "Aufbereitungsgerät"},
    {"HeatExchanger", "", "Wärmetauscher"},
    {"Humidifier", "", "Befeuchter"},
    {"Interceptor", "", "Abscheider"},
    {"JunctionBox", "", "Abzweigdose"},
    {"Lamp", "", "Leuchtmittel"},
    {"MedicalDevice", "", "Medizingerät"},
    {"MotorConnection", "", "Motoranschluss"},
    {"Outlet", "", "Steckdose"},
    {"ProtectiveDevice", "", "Schutzgerät"},
    {"Pump", "", "Pumpe"},
    {"Sensor", "", "Sensor"},
    {"SolarDevice", "", "Solaranlage"},
    {"SpaceHeater", "", "Heizkörper"},
    {"StackTerminal", "", "Schornsteinkopf"},
    {"SwitchingDevice", "Switch", "Schalter"},
    {"Tank", "", "Behälter"},
    {"Transformer", "", "Transformator"},
    {"UnitaryControlElement", "Control unit", "Bedien- und Regelgerät"},
    {"UnitaryEquipment", "Air handling unit", "Klimagerät"},
    {"Valve", "", "Ventil"},
    {"WasteTerminal", "", "Ablauf"},
    {"ReinforcingElement", "Reinforcement", "Bewehrung"},
    {"TendonAnchor", "", "Spannanker"},
    {"VibrationIsolator", "", "Schwingungsdämpfer"},
    {"SystemFurnitureElement", "Furniture", "Möbel"},
    {"ProjectionElement", "Projection", "Vorsprung"},
    {"VirtualElement", "Virtual boundary", "Virtuelle Begrenzung"},
    {"CivilElement", "Civil work", "Tiefbauteil"},
    {"Bearing", "", "Lager"},
    {"DeepFoundation", "", "Tiefgründung"},
    {"Kerb", "", "Bordstein"},
    {"Pavement", "", "Fahrbahnbelag"},
    {"Rail", "", "Schiene"},
    {"Sign", "", "Schild"},
    {"Signal", "", "Signal"},
    {"EarthworksFill", "Fill", "Auffüllung"},
    {"EarthworksCut", "Excavation", "Aushub"},
    {"Grid", "", "Raster"},
    {"Annotation", "", "Beschriftung"},
    {"Proxy", "Other object", "Sonstiges Objekt"},
    {"BridgePart", "Part of a bridge", "Brückenteil"},
    {"Tunnel", "", "Tunnel"},
    {"TunnelPart", "Part of a tunnel", "Tunnelteil"},
    {"BridgeConstructiveElement", "Component", "Bauteil"},
    {"TunnelConstructiveElement", "Component", "Bauteil"},
    {"BridgeInstallation", "Installation", "Anbau, Einbau"},
    {"TunnelInstallation", "Installation", "Anbau, Einbau"},
    {"BridgeFurniture", "Furniture", "Möbel"},
    {"TunnelFurniture", "Furniture", "Möbel"},
    {"HollowSpace", "", "Hohlraum"},
    {"BridgeRoom", "Room", "Raum"},
    {"OtherConstruction", "", "Sonstiges Bauwerk"},
    {"WaterBody", "Water", "Gewässer"},
    {"WaterSurface", "", "Wasserfläche"},
    {"WaterGroundSurface", "Bed", "Gewässersohle"},
    {"LandUse", "", "Landnutzung"},
    {"Railway", "", "Eisenbahn"},
    {"Square", "", "Platz"},
    {"Track", "", "Weg"},
    {"Waterway", "", "Wasserstraße"},
    {"TrafficArea", "", "Verkehrsfläche"},
    {"AuxiliaryTrafficArea", "", "Verkehrsnebenfläche"},
    {"TrafficSpace", "", "Verkehrsraum"},
    {"AuxiliaryTrafficSpace", "", "Verkehrsnebenraum"},
    {"CityObjectGroup", "Group", "Gruppe"},
    {"GenericOccupiedSpace", "Other object", "Sonstiges Objekt"},
    {"GenericUnoccupiedSpace", "Other space", "Sonstiger Raum"},
    {"GenericLogicalSpace", "Other zone", "Sonstige Zone"},
};

bool isCapital(char c) noexcept { return c >= 'A' && c <= 'Z'; }

std::string_view withoutAffixes(std::string_view name) noexcept {
    if (const auto colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
    if (name.size() > 3 && name.starts_with("Ifc") && isCapital(name[3])) name.remove_prefix(3);
    for (const std::string_view ending : {"StandardCase", "ElementedCase"})
        if (name.size() > ending.size() && name.ends_with(ending)) name.remove_suffix(ending.size());
    return name;
}

// "FlowInstrument" becomes "Flow instrument"; abbreviations stay: "TINRelief" becomes "TIN relief".
std::string splitName(std::string_view name) {
    std::string text;
    for (std::size_t n = 0; n < name.size(); ++n) {
        const bool endsCapitals = n + 1 < name.size() && !isCapital(name[n + 1]);
        const bool isNewWord = n > 0 && isCapital(name[n]) && (!isCapital(name[n - 1]) || endsCapitals);
        if (isNewWord && name[n - 1] != ' ') text += ' ';
        text += isNewWord && endsCapitals ? lowerAscii(name[n]) : name[n] == '_' ? ' ' : name[n];
    }
    return text;
}

}  // namespace

std::span<const ClassTerm> classTerms() noexcept { return kClassTerms; }

std::string classWord(std::string_view name, SheetLanguage language) {
    std::string own(withoutAffixes(name));
    if (!own.empty() && own[0] >= 'a' && own[0] <= 'z') own[0] = static_cast<char>(own[0] - 'a' + 'A');
    const auto* const found = std::find_if(std::begin(kClassTerms), std::end(kClassTerms),
                                           [&](const auto& term) { return term.name == own; });
    if (found == std::end(kClassTerms)) return splitName(own);
    const std::string_view word = language == SheetLanguage::German ? found->german : found->english;
    return word.empty() ? splitName(own) : std::string(word);
}

}  // namespace svt::writers
