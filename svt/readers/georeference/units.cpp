#include <svt/readers/georeference/units.hpp>

#include <svt/crs/crs_facts.hpp>
#include <svt/model/surface_uses.hpp>
#include <svt/readers/georeference/georeference.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace svt::readers::georeference {
namespace {

using std::string_view;

constexpr double kHighestRoom = 100, kHighRoom = 10, kHighestBuilding = 1000;  // metres

// Length of a unit by its label in GML or its code; 0: not known.
double unitLength(string_view label) noexcept {
    const std::size_t at = label.find_last_of(":/#");
    if (at != string_view::npos) label.remove_prefix(at + 1);
    for (const string_view metre : {"m", "metre", "meter", "9001"})
        if (label == metre) return 1;
    for (const string_view small : {"mm", "millimetre", "millimeter", "1025"})
        if (label == small) return 0.001;
    for (const string_view small : {"cm", "centimetre", "centimeter", "1033"})
        if (label == small) return 0.01;
    for (const string_view foot : {"ft", "foot", "feet", "[ft_i]", "9002"})
        if (label == foot) return crs::kFoot;
    for (const string_view foot : {"ftUS", "us-ft", "[ft_us]", "US_survey_foot", "9003"})
        if (label == foot) return crs::kSurveyFoot;
    return 0;
}

// Word `number` of a text, from 1.
string_view wordOf(string_view text, int number) noexcept {
    string_view word;
    for (int count = 0; count < number; ++count) {
        const std::size_t begin = text.find_first_not_of(" \t\r\n");
        if (begin == string_view::npos) return {};
        text.remove_prefix(begin);
        word = text.substr(0, text.find_first_of(" \t\r\n"));
        text.remove_prefix(word.size());
    }
    return word;
}

// Half of the features of these classes have at most this size; 0 without any.
template <class BoxOf, class SizeOf>
double medianSize(const model::BuildingModel& model, std::initializer_list<string_view> classes, const BoxOf& boxOf,
                  const SizeOf& sizeOf) {
    std::vector<double> sizes;
    for (const model::Feature& feature : model.features) {
        if (std::find(classes.begin(), classes.end(), feature.className) == classes.end()) continue;
        Box3d box;
        for (const model::Geometry& geometry : feature.geometries) box.add(boxOf(geometry));
        if (!box.isEmpty()) sizes.push_back(sizeOf(box.size()));
    }
    if (sizes.empty()) return 0;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

double medianHeight(const model::BuildingModel& model, std::initializer_list<string_view> classes) {
    return medianSize(
        model, classes, [&](const model::Geometry& geometry) { return model.bounds(geometry); },
        [](Vec3d size) { return size.z; });
}

}  // namespace

double heightUnitOf(string_view uomLabels) noexcept { return unitLength(wordOf(uomLabels, 3)); }

Result<double> unitOfModel(const model::BuildingModel& model, string_view labels, double stated, const Place& place) {
    if (stated != 0) return stated;
    if (const double unit = unitLength(wordOf(labels, 1)); unit != 0) return unit < 0.1 ? unit : 1;
    if (heightUnitOf(labels) != 0) return 1;
    const double room = medianHeight(model, {"BuildingRoom"});
    const double building = medianHeight(model, {"Building", "BuildingPart"});
    const bool areRooms = room > kHighestRoom;
    if (!areRooms && !(building > kHighestBuilding)) return 1;
    const double height = areRooms ? room : building;
    return Error(Code::UnitInDoubt,
                 fmt::format("half of the {} are {:.0f} units high or more, which cannot be metres, and the file "
                             "names no unit. State the unit of its coordinates, such as --unit {} (or --unit m, if "
                             "they are metres)",
                             areRooms ? "rooms" : "buildings", height, height > 1000 ? "mm" : "cm"),
                 place);
}

double medianWidth(const model::BuildingModel& model, std::span<const Vec3d> anchors) {
    const auto boxOf = [&](const model::Geometry& geometry) {
        Box3d box;
        model::forEachUse(geometry, [&](const model::SurfaceUse& use) {
            if (!anchors.empty() && anchors[use.polygon] != kNoAnchor)
                box.add(anchors[use.polygon]);
            else
                for (const Vec3d& point : model.polygons[use.polygon].points) box.add(point);
        });
        return box;
    };
    return medianSize(model, {"Building", "BuildingPart", "BuildingRoom"}, boxOf,
                      [](Vec3d size) { return std::max(size.x, size.y); });
}

void warnOfHighRooms(const model::BuildingModel& model, const Place& place, Diagnostics& diagnostics) {
    const double height = medianHeight(model, {"BuildingRoom"});
    if (!(height > kHighRoom)) return;
    diagnostics.add(
        Severity::Warning, Code::UnitInDoubt,
        fmt::format("half of the rooms are {:.0f} units high or more, and the file names neither a unit nor "
                    "a CRS; the units are taken as metres. State the unit with --unit if they are not",
                    height),
        place);
}

}  // namespace svt::readers::georeference
