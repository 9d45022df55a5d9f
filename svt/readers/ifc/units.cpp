#include <svt/readers/ifc/units.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace svt::readers::ifc {
namespace {

using std::string_view;

constexpr std::pair<string_view, double> kPrefixes[] = {
    {"EXA", 1e18},  {"PETA", 1e15},  {"TERA", 1e12},   {"GIGA", 1e9},   {"MEGA", 1e6},   {"KILO", 1e3},
    {"HECTO", 1e2}, {"DECA", 1e1},   {"DECI", 1e-1},   {"CENTI", 1e-2}, {"MILLI", 1e-3}, {"MICRO", 1e-6},
    {"NANO", 1e-9}, {"PICO", 1e-12}, {"FEMTO", 1e-15}, {"ATTO", 1e-18}};

double prefixFactor(string_view prefix) noexcept {
    for (const auto& [name, factor] : kPrefixes)
        if (name == prefix) return factor;
    return 1;
}

RecordIndex modelContext(const IfcFile& file, RecordIndex project) {
    namespace geometric = at::GeometricRepresentationContext;
    for (const RecordIndex context : file.followAll(project, at::Project::RepresentationContexts))
        if (file.entityOf(context) == Entity::GeometricRepresentationContext &&
            file.fieldsOf(context)[geometric::CoordinateSpaceDimension].integer().value_or(3) == 3)
            return context;
    return kNoRecord;
}

// True north in the axes of the project, of the first context that states it. Contexts of models precede those of plans.
// \param finding  receives a defect of the direction, which has two ratios by the schema
std::optional<Vec3d> trueNorth(const IfcFile& file, RecordIndex project, std::string& finding) {
    constexpr double kUnit = 1e-6;

    std::vector<RecordIndex> contexts = file.followAll(project, at::Project::RepresentationContexts);
    contexts.insert(contexts.begin(), modelContext(file, project));
    for (const RecordIndex context : contexts) {
        if (file.entityOf(context) != Entity::GeometricRepresentationContext) continue;
        const auto north = file.direction(file.fieldsOf(context)[at::GeometricRepresentationContext::TrueNorth]);
        if (!north) continue;
        // An exporter writes the number of ratios before them: (2., 6.1E-17, 1.).
        if (north->x == 2 && std::abs(std::hypot(north->y, north->z) - 1) < kUnit) {
            finding = fmt::format(
                "the direction of true north has three ratios, ({:g}, {:g}, {:g}), instead of two; the "
                "first is their number, and the others count",
                north->x, north->y, north->z);
            return Vec3d{north->y, north->z, 0};
        }
        if (std::abs(north->z) > kUnit * length(*north)) {
            finding =
                fmt::format("the direction of true north, ({:g}, {:g}, {:g}), is not level; true north is unknown",
                            north->x, north->y, north->z);
            return std::nullopt;
        }
        if (std::hypot(north->x, north->y) > 0) return north;
    }
    return std::nullopt;
}

bool isMapConversion(Entity entity) noexcept {
    return entity == Entity::MapConversion || entity == Entity::MapConversionScaled || entity == Entity::RigidOperation;
}

// The axes of the project on the map.
// \param unit  of the map, in that of the project
void setAxes(Vec3d x, double scale, double unit, Transform& mapFromProject) {
    // Many writers give 1 although the units of model and map differ.
    const double given = scale * unit, factor = scale == 1 || !(given > 0) || !std::isfinite(given) ? 1 : given;
    x = length(x) > 0 ? normalized(x) : Vec3d{1, 0, 0};
    mapFromProject.x = x * factor;
    mapFromProject.y = Vec3d{-x.y, x.x, 0} * factor;
    mapFromProject.z = {0, 0, factor};
}

// How two conversions differ, in words; empty if they agree within a millimetre and a microradian.
std::string differenceOf(const MapPlace& a, const MapPlace& b) {
    constexpr double kSameMetres = 1e-3, kSameAxis = 1e-6;
    const Vec3d from = a.mapFromProject.origin, to = b.mapFromProject.origin;
    if (length(to - from) > kSameMetres)
        return fmt::format("origin ({:.3f}, {:.3f}, {:.3f}) and ({:.3f}, {:.3f}, {:.3f}) m", from.x, from.y, from.z,
                           to.x, to.y, to.z);
    if (length(b.mapFromProject.x - a.mapFromProject.x) > kSameAxis)
        return fmt::format("x axis ({:.6f}, {:.6f}) and ({:.6f}, {:.6f})", a.mapFromProject.x.x, a.mapFromProject.x.y,
                           b.mapFromProject.x.x, b.mapFromProject.x.y);
    if (!a.crs.empty() && !b.crs.empty() && !equalsIgnoringCase(a.crs, b.crs))
        return fmt::format("CRS '{}' and '{}'", a.crs, b.crs);
    return {};
}

// The conversion of the project to a map.
MapPlace readConversion(const IfcFile& file, const Place& where, Diagnostics& diagnostics) {
    MapPlace place;
    RecordIndex record = 0;
    while (record < file.step().records().size() && !isMapConversion(file.entityOf(record))) ++record;
    if (record == file.step().records().size()) return place;
    const Fields conversion = file.fieldsOf(record);
    const Fields crs = file.fieldsOf(file.follow(conversion[at::CoordinateOperation::TargetCRS]));
    // Eastings and heights are in the unit of the map. Scale converts project lengths, which are metres here, to that
    // unit.
    const double mapUnit = unitFactor(file, file.follow(crs[at::ProjectedCRS::MapUnit])).value_or(file.lengthUnit);
    const bool isShift = file.entityOf(record) == Entity::RigidOperation;
    // The coordinates of a shift may be angles, which give no place in metres.
    if (isShift && (conversion[at::RigidOperation::FirstCoordinate].typeName().ends_with("ANGLEMEASURE") ||
                    conversion[at::RigidOperation::SecondCoordinate].typeName().ends_with("ANGLEMEASURE"))) {
        diagnostics.add(
            Severity::Warning, Code::BadValue,
            "IfcRigidOperation gives the place on the map as angles, which is not supported; the model keeps "
            "the coordinates of its project",
            where);
        return place;
    }
    place.isGiven = true;
    place.crs = crs[at::ProjectedCRS::Name].string().value_or("");
    const auto number = [&](AttributePosition attribute, double otherwise) {
        return conversion[attribute].number().value_or(otherwise);
    };
    // A shift has its coordinates at the same positions.
    place.mapFromProject.origin = Vec3d{number(at::MapConversion::Eastings, 0), number(at::MapConversion::Northings, 0),
                                        number(at::MapConversion::OrthogonalHeight, 0)} *
                                  mapUnit;
    if (isShift) return place;
    setAxes({number(at::MapConversion::XAxisAbscissa, 1), number(at::MapConversion::XAxisOrdinate, 0), 0},
            number(at::MapConversion::Scale, 1), mapUnit / file.lengthUnit, place.mapFromProject);
    return place;
}

/// The properties of the sets of one name, on sites and projects.
class MapProperties {
public:
    MapProperties(const IfcFile& file, string_view name) : file_(file) {
        for (const RecordIndex relation : file.all(Entity::RelDefinesByProperties)) {
            const Fields fields = file.fieldsOf(relation);
            const RecordIndex set = file.follow(fields[at::RelDefinesByProperties::RelatingPropertyDefinition]);
            if (file.entityOf(set) != Entity::PropertySet || std::find(sets_.begin(), sets_.end(), set) != sets_.end())
                continue;
            if (!equalsIgnoringCase(file.fieldsOf(set)[at::PropertySet::Name].string().value_or(""), name)) continue;
            for (const RecordIndex object : file.followAll(fields[at::RelDefinesByProperties::RelatedObjects])) {
                const string_view type = file.typeName(object);
                if (!equalsIgnoringCase(type, "IFCSITE") && !equalsIgnoringCase(type, "IFCPROJECT")) continue;
                sets_.push_back(set);
                break;
            }
        }
    }

    [[nodiscard]] std::size_t count() const noexcept { return sets_.size(); }
    /// The record of a property; kNoRecord: none.
    [[nodiscard]] RecordIndex find(std::size_t set, string_view name) const {
        for (const RecordIndex property : file_.followAll(sets_[set], at::PropertySet::HasProperties))
            if (file_.entityOf(property) == Entity::PropertySingleValue &&
                equalsIgnoringCase(file_.fieldsOf(property)[at::PropertySingleValue::Name].string().value_or(""), name))
                return property;
        return kNoRecord;
    }
    [[nodiscard]] Value value(std::size_t set, string_view name) const {
        return file_.fieldsOf(find(set, name))[at::PropertySingleValue::NominalValue];
    }
    [[nodiscard]] std::string text(std::size_t set, string_view name) const {
        return value(set, name).string().value_or("");
    }
    /// A length in metres. Its unit is its own, else that of the map; else that of the project for a length measure,
    /// and the metre for a plain number.
    [[nodiscard]] std::optional<double> length(std::size_t set, string_view name, std::optional<double> mapUnit) const {
        const Fields fields = file_.fieldsOf(find(set, name));
        const Value value = fields[at::PropertySingleValue::NominalValue];
        const auto number = value.number();
        if (!number) return std::nullopt;
        const auto own = unitFactor(file_, file_.follow(fields[at::PropertySingleValue::Unit]));
        const double otherwise = value.typeName().ends_with("LENGTHMEASURE") ? file_.lengthUnit : 1;
        return *number * own.value_or(mapUnit.value_or(otherwise));
    }

private:
    const IfcFile& file_;
    std::vector<RecordIndex> sets_;
};

// Metres of a unit of the map that is a text; nothing for an empty or unknown one.
std::optional<double> namedMapUnit(string_view name) noexcept {
    constexpr double kSurveyFoot = 1200.0 / 3937;
    constexpr std::pair<string_view, double> kUnits[] = {
        {"METRE", 1},         {"METER", 1},  {"METRES", 1},
        {"METERS", 1},        {"M", 1},      {"MILLIMETRE", .001},
        {"MILLIMETER", .001}, {"MM", .001},  {"FOOT", .3048},
        {"FEET", .3048},      {"FT", .3048}, {"US SURVEY FOOT", kSurveyFoot},
        {"FTUS", kSurveyFoot}};
    for (const auto& [unit, metres] : kUnits)
        if (equalsIgnoringCase(name, unit)) return metres;
    return std::nullopt;
}

// The conversion by property sets, as IfcMapConversion and IfcProjectedCRS state it.
MapPlace readMapSets(const IfcFile& file, const Place& place, Diagnostics& diagnostics) {
    const auto warn = [&](std::string text) {
        diagnostics.add(Severity::Warning, Code::BadValue, std::move(text), place);
    };
    const MapProperties conversion(file, "ePSet_MapConversion"), crs(file, "ePSet_ProjectedCRS");
    MapPlace first;
    if (conversion.count() == 0 && crs.count() > 0)
        warn(
            "ePSet_ProjectedCRS names a CRS, but the file has no ePSet_MapConversion; the model keeps the "
            "coordinates of its project");
    for (std::size_t set = 0; set < conversion.count(); ++set) {
        MapPlace found;
        std::optional<double> mapUnit;
        found.crs = conversion.text(set, "TargetCRS");
        if (crs.count() > 0) {
            const std::size_t own = std::min(set, crs.count() - 1);
            if (const std::string name = crs.text(own, "Name"); !name.empty()) found.crs = name;
            const std::string unit = crs.text(own, "MapUnit");
            mapUnit = namedMapUnit(unit);
            if (!unit.empty() && !mapUnit)
                warn(fmt::format("the MapUnit '{}' of ePSet_ProjectedCRS is not known; the unit of each value counts",
                                 unit));
        }
        const auto east = conversion.length(set, "Eastings", mapUnit);
        const auto north = conversion.length(set, "Northings", mapUnit);
        if (!east || !north) {
            warn("ePSet_MapConversion lacks a number for Eastings or Northings and is not used");
            continue;
        }
        const auto number = [&](string_view name, double otherwise) {
            return conversion.value(set, name).number().value_or(otherwise);
        };
        const auto height = conversion.length(set, "OrthogonalHeight", mapUnit);
        if (!height) warn("ePSet_MapConversion lacks a number for OrthogonalHeight; 0 is assumed");
        found.isGiven = true;
        found.mapFromProject.origin = {*east, *north, height.value_or(0)};
        setAxes({number("XAxisAbscissa", 1), number("XAxisOrdinate", 0), 0}, number("Scale", 1),
                mapUnit.value_or(file.lengthUnit) / file.lengthUnit, found.mapFromProject);
        if (!first.isGiven)
            first = std::move(found);
        else if (const std::string difference = differenceOf(first, found); !difference.empty())
            warn(fmt::format("two property sets ePSet_MapConversion differ: {}; the first one is used", difference));
    }
    return first;
}

}  // namespace

std::optional<double> unitFactor(const IfcFile& file, RecordIndex unit) {
    ReadGuard::Scope scope(file.guard());
    if (!scope.enter(unit)) return std::nullopt;
    const Fields fields = file.fieldsOf(unit);
    switch (file.entityOf(unit)) {
        case Entity::SIUnit: {
            const string_view name = fields[at::SIUnit::Name].enumeration();
            const double factor = prefixFactor(fields[at::SIUnit::Prefix].enumeration());
            // The prefix of a square metre counts twice.
            if (name == "SQUARE_METRE") return factor * factor;
            if (name == "CUBIC_METRE") return factor * factor * factor;
            return name == "GRAM" ? factor / 1000 : factor;
        }
        case Entity::ConversionBasedUnit:
        case Entity::ConversionBasedUnitWithOffset: {
            const Fields measure = file.fieldsOf(file.follow(fields[at::ConversionBasedUnit::ConversionFactor]));
            const auto value = measure[at::MeasureWithUnit::ValueComponent].number();
            if (!value || !(*value > 0)) return std::nullopt;
            const auto base = unitFactor(file, file.follow(measure[at::MeasureWithUnit::UnitComponent]));
            return base ? std::optional(*value * *base) : std::nullopt;
        }
        default: return std::nullopt;
    }
}

double converted(double value, double factor) noexcept {
    constexpr double kSame = 1e-12;
    const double divisor = std::round(1 / factor);
    return factor < 1 && std::abs(divisor * factor - 1) < kSame ? value / divisor : value * factor;
}

Units readUnits(const IfcFile& file, RecordIndex project, const Place& place, Diagnostics& diagnostics) {
    Units units;
    bool hasLength = false, hasArea = false, hasVolume = false;
    const RecordIndex assignment = file.follow(project, at::Project::UnitsInContext);
    for (const RecordIndex unit : file.followAll(assignment, at::UnitAssignment::Units)) {
        const string_view type = file.fieldsOf(unit)[at::NamedUnit::UnitType].enumeration();
        const auto factor = unitFactor(file, unit);
        if (!factor || !(*factor > 0)) continue;
        if (type == "LENGTHUNIT") {
            units.length = *factor;
            hasLength = true;
        }
        if (type == "AREAUNIT") {
            units.area = *factor;
            hasArea = true;
        }
        if (type == "VOLUMEUNIT") {
            units.volume = *factor;
            hasVolume = true;
        }
        if (type == "PLANEANGLEUNIT") units.angle = *factor;
        if (type == "MASSUNIT") units.mass = *factor;
        if (type == "TIMEUNIT") units.time = *factor;
    }
    if (!hasLength)
        diagnostics.add(Severity::Warning, Code::BadValue,
                        "the project names no unit of length that is known; lengths are taken as metres", place);
    if (!hasArea) units.area = units.length * units.length;
    if (!hasVolume) units.volume = units.length * units.length * units.length;
    if ((!hasArea || !hasVolume) && units.length != 1)
        diagnostics.add(Severity::Note, Code::BadValue,
                        fmt::format("the project names no unit of {}; {} taken from its unit of length",
                                    !hasArea && !hasVolume ? "area and volume"
                                    : hasArea              ? "volume"
                                                           : "area",
                                    !hasArea && !hasVolume ? "both are" : "it is"),
                        place);
    return units;
}

MapPlace readMapPlace(const IfcFile& file, RecordIndex project, const Place& where, Diagnostics& diagnostics) {
    MapPlace place = readConversion(file, where, diagnostics);
    MapPlace ofSets = readMapSets(file, where, diagnostics);
    if (!place.isGiven) {
        place = std::move(ofSets);
    } else if (ofSets.isGiven) {
        if (const std::string difference = differenceOf(place, ofSets); !difference.empty())
            diagnostics.add(Severity::Warning, Code::BadValue,
                            fmt::format("IfcMapConversion and ePSet_MapConversion differ: {}; IfcMapConversion is used",
                                        difference),
                            where);
        if (place.crs.empty()) place.crs = std::move(ofSets.crs);
    }
    std::string finding;
    const auto north = trueNorth(file, project, finding);
    if (!finding.empty()) diagnostics.add(Severity::Warning, Code::BadValue, std::move(finding), where);
    if (north) {
        const Vec3d onMap = place.mapFromProject.direction(*north);
        place.trueNorthDegrees = std::atan2(onMap.x, onMap.y) * 180 / std::numbers::pi;
    }
    return place;
}

std::optional<double> compoundDegrees(Value list) {
    const std::vector<Value> parts = step::itemsOf(list);
    if (parts.size() < 3) return std::nullopt;
    double degrees = 0, unit = 1;
    for (std::size_t i = 0; i < parts.size() && i < 4; ++i) {
        const auto part = parts[i].integer();
        if (!part) return std::nullopt;
        degrees += double(*part) * unit;
        unit /= i < 2 ? 60 : 1e6;
    }
    return degrees;
}

}  // namespace svt::readers::ifc
