#include <svt/readers/ifc/units.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

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
std::optional<Vec3d> trueNorth(const IfcFile& file, RecordIndex project) {
    std::vector<RecordIndex> contexts = file.followAll(project, at::Project::RepresentationContexts);
    contexts.insert(contexts.begin(), modelContext(file, project));
    for (const RecordIndex context : contexts) {
        if (file.entityOf(context) != Entity::GeometricRepresentationContext) continue;
        const auto north = file.direction(file.fieldsOf(context)[at::GeometricRepresentationContext::TrueNorth]);
        if (north && std::hypot(north->x, north->y) > 0) return north;
    }
    return std::nullopt;
}

bool isMapConversion(Entity entity) noexcept {
    return entity == Entity::MapConversion || entity == Entity::MapConversionScaled || entity == Entity::RigidOperation;
}

// The conversion of the project to a map.
MapPlace readConversion(const IfcFile& file) {
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
                    conversion[at::RigidOperation::SecondCoordinate].typeName().ends_with("ANGLEMEASURE")))
        return place;
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
    double scale = number(at::MapConversion::Scale, 1) * mapUnit / file.lengthUnit;
    // Many writers give 1 although the units of model and map differ.
    if (number(at::MapConversion::Scale, 1) == 1 || !(scale > 0) || !std::isfinite(scale)) scale = 1;
    Vec3d x{number(at::MapConversion::XAxisAbscissa, 1), number(at::MapConversion::XAxisOrdinate, 0), 0};
    x = length(x) > 0 ? normalized(x) : Vec3d{1, 0, 0};
    place.mapFromProject.x = x * scale;
    place.mapFromProject.y = Vec3d{-x.y, x.x, 0} * scale;
    place.mapFromProject.z = {0, 0, scale};
    return place;
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

MapPlace readMapPlace(const IfcFile& file, RecordIndex project) {
    MapPlace place = readConversion(file);
    if (const auto north = trueNorth(file, project)) {
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
