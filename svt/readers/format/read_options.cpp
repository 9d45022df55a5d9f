#include <svt/readers/read_options.hpp>

#include <svt/crs/crs_facts.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/readers/format/ended_features.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <string>

namespace svt::readers {
namespace {

using record::Codec, record::Faults, record::Json, record::member;

// A code or a name, such as EPSG:25832, 25832, urn:ogc:def:crs:EPSG::25832 or "RD New".
struct EpsgCode : record::PlainCodec<EpsgCode, int> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, int& to) {
        std::string text;
        Codec<std::string>::read(faults, json, path, option, text);
        to = crs::codesOf(text).horizontal;
        if (to <= 0)
            faults.add(path,
                       fmt::format("{} '{}': expected the EPSG code of a projection in metres, such as EPSG:25832",
                                   option.option, text));
    }
    static Json write(const Option&, int from) { return fmt::format("EPSG:{}", from); }
};

struct NamedNumber {
    std::string_view name;
    double value;
};

// A number that has a name; `Names` lists all, the default first.
template <const auto& Names, class T>
struct NumberName : record::PlainCodec<NumberName<Names, T>, T> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, T& to) {
        std::string text;
        record::Choice::read(faults, json, path, option, text);
        for (const NamedNumber& each : Names)
            if (text == each.name) to = static_cast<T>(each.value);
    }
    static Json write(const Option&, T from) {
        for (const NamedNumber& each : Names)
            if (from == static_cast<T>(each.value)) return std::string(each.name);
        return std::string(Names[0].name);
    }
};
constexpr NamedNumber kOrders[] = {{"by-name", 0}, {"east-north", 1}, {"north-east", -1}};
constexpr NamedNumber kUnits[] = {{"of-file", 0}, {"m", 1},       {"dm", 0.1},        {"cm", 0.01},
                                  {"mm", 0.001},  {"in", 0.0254}, {"ft", crs::kFoot}, {"ftUS", crs::kSurveyFoot}};

// A day as YYYY-MM-DD, or "all".
struct Day : record::PlainCodec<Day, std::string> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, std::string& to) {
        Codec<std::string>::read(faults, json, path, option, to);
        if (faults.isFine() && to != "all" && !isDay(to))
            faults.add(path, fmt::format("{} '{}': expected a day such as 2020-12-31, or all", option.option, to));
    }
    static Json write(const Option&, const std::string& from) { return from; }
};

}  // namespace

record::Members<ReadOptions> membersOf(const ReadOptions*) noexcept {
    static constexpr record::Member<ReadOptions> kMembers[] = {
        record::memberAs<EpsgCode, &ReadOptions::crs>(
            "crs", "transform the model to this projection in metres, such as EPSG:25832",
            {.value = "CODE",
             .otherwise = "that of the file; degrees and feet are projected to the usual projection of the place",
             .group = "Model",
             .option = "--crs",
             .isForModels = true,
             .isForProjects = true}),
        record::memberAs<NumberName<kOrders, int>, &ReadOptions::axisOrder>(
            "axisOrder", "order of the first two coordinates in the file, whatever its CRS says",
            {.choices = "by-name|east-north|north-east",
             .group = "Model",
             .option = "--axis-order",
             .isForModels = true,
             .isForProjects = true}),
        record::memberAs<NumberName<kUnits, double>, &ReadOptions::unit>(
            "unit", "GML, CityJSON: unit of the coordinates in the file, if they are lengths",
            {.choices = "of-file|m|dm|cm|mm|in|ft|ftUS",
             .group = "Model",
             .option = "--unit",
             .isForModels = true,
             .isForProjects = true}),
        record::memberAs<Day, &ReadOptions::date>(
            "date", "read the features that exist on this day (creation, termination, valid from, valid to)",
            {.value = "YYYY-MM-DD|all",
             .otherwise = "today, and features that begin later",
             .group = "Model",
             .option = "--date",
             .isForModels = true,
             .isForProjects = true}),
        member<&ReadOptions::keepFarFeatures>(
            "keepFarFeatures", "keep features that lie far away from all others",
            {.group = "Model", .option = "--keep-far-features", .isForModels = true, .isForProjects = true}),
        member<&ReadOptions::extrudeFootprints>(
            "extrudeFootprints", "make solids for features that have only a footprint and a height as attribute",
            {.group = "Model", .option = "--extrude-footprints", .isForModels = true, .isForProjects = true}),
        member<&ReadOptions::allowTruncated>(
            "allowTruncated", "read a file that was cut off (IFC, CityJSONSeq) up to the cut, with a warning",
            {.group = "Model", .option = "--allow-truncated", .isForModels = true, .isForProjects = true}),
        member<&ReadOptions::splitLayers>(
            "layers", "IFC: split walls and slabs into the layers of their material, each a separate object",
            {.group = "Model", .option = "--layers", .isForModels = true, .isForProjects = true}),
    };
    return kMembers;
}

}  // namespace svt::readers
