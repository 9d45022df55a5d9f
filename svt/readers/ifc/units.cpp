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

// Factor of a unit to that of SI; the prefix of a square metre counts twice.
std::optional<double> unitFactor(const IfcFile& file, RecordIndex unit) {
    ReadGuard::Scope scope(file.guard());
    if (!scope.enter(unit)) return std::nullopt;
    const Fields fields = file.fieldsOf(unit);
    switch (file.entityOf(unit)) {
        case Entity::SIUnit: {
            const string_view name = fields[3].enumeration();
            const double factor = prefixFactor(fields[2].enumeration());
            if (name == "SQUARE_METRE") return factor * factor;
            if (name == "CUBIC_METRE") return factor * factor * factor;
            return name == "GRAM" ? factor / 1000 : factor;
        }
        case Entity::ConversionBasedUnit:
        case Entity::ConversionBasedUnitWithOffset: {
            const Fields measure = file.fieldsOf(file.follow(fields[3]));
            const auto value = measure[0].number();
            if (!value || !(*value > 0)) return std::nullopt;
            const auto base = unitFactor(file, file.follow(measure[1]));
            return base ? std::optional(*value * *base) : std::nullopt;
        }
        default: return std::nullopt;
    }
}

RecordIndex contextOf(const IfcFile& file, RecordIndex project) {
    for (const RecordIndex context : file.followAll(file.fieldsOf(project)[7]))
        if (file.entityOf(context) == Entity::GeometricRepresentationContext &&
            file.fieldsOf(context)[2].integer().value_or(3) == 3)
            return context;
    return kNoRecord;
}

}  // namespace

Units readUnits(const IfcFile& file, RecordIndex project, const Place& place, Diagnostics& diagnostics) {
    Units units;
    bool hasLength = false;
    for (const RecordIndex unit : file.followAll(file.fieldsOf(file.follow(file.fieldsOf(project)[8]))[0])) {
        const string_view type = file.fieldsOf(unit)[1].enumeration();
        const auto factor = unitFactor(file, unit);
        if (!factor || !(*factor > 0)) continue;
        if (type == "LENGTHUNIT") {
            units.length = *factor;
            hasLength = true;
        }
        if (type == "AREAUNIT") units.area = *factor;
        if (type == "VOLUMEUNIT") units.volume = *factor;
        if (type == "PLANEANGLEUNIT") units.angle = *factor;
        if (type == "MASSUNIT") units.mass = *factor;
        if (type == "TIMEUNIT") units.time = *factor;
    }
    if (!hasLength)
        diagnostics.add(Severity::Warning, Code::BadValue,
                        "the project names no unit of length that is known; lengths are taken as metres", place);
    return units;
}

MapPlace readMapPlace(const IfcFile& file, RecordIndex project) {
    MapPlace place;
    const RecordIndex context = contextOf(file, project);
    if (const auto north = file.direction(file.fieldsOf(context)[5]))
        place.trueNorthDegrees = std::atan2(north->x, north->y) * 180 / std::numbers::pi;
    RecordIndex conversion = kNoRecord;
    for (RecordIndex i = 0; i < file.step().records().size() && conversion == kNoRecord; ++i)
        if (file.entityOf(i) == Entity::MapConversion || file.entityOf(i) == Entity::MapConversionScaled ||
            file.entityOf(i) == Entity::RigidOperation)
            conversion = i;
    if (conversion == kNoRecord) return place;
    const Fields fields = file.fieldsOf(conversion);
    const Fields crs = file.fieldsOf(file.follow(fields[1]));
    place.isGiven = true;
    place.crs = crs[0].string().value_or("");
    // Eastings and heights are in the unit of the map; Scale takes lengths of the project to it, and lengths are metres here.
    double mapUnit = file.lengthUnit;
    if (const auto unit = unitFactor(file, file.follow(crs[6]))) mapUnit = *unit;
    if (file.entityOf(conversion) == Entity::RigidOperation) {
        // A shift alone. Angles, which its coordinates may be, make no place in metres.
        if (fields[2].typeName().ends_with("ANGLEMEASURE") || fields[3].typeName().ends_with("ANGLEMEASURE")) {
            place.isGiven = false;
            place.crs.clear();
            return place;
        }
        place.mapFromProject.origin =
            Vec3d{fields[2].number().value_or(0), fields[3].number().value_or(0), fields[4].number().value_or(0)} *
            mapUnit;
        return place;
    }
    double scale = fields[7].number().value_or(1) * mapUnit / file.lengthUnit;
    // Many writers give 1 although the units of model and map differ.
    if (fields[7].number().value_or(1) == 1) scale = 1;
    if (!(scale > 0) || !std::isfinite(scale)) scale = 1;
    Vec3d x{fields[5].number().value_or(1), fields[6].number().value_or(0), 0};
    x = length(x) > 0 ? normalized(x) : Vec3d{1, 0, 0};
    place.mapFromProject.x = x * scale;
    place.mapFromProject.y = Vec3d{-x.y, x.x, 0} * scale;
    place.mapFromProject.z = {0, 0, scale};
    place.mapFromProject.origin =
        Vec3d{fields[2].number().value_or(0), fields[3].number().value_or(0), fields[4].number().value_or(0)} * mapUnit;
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
