#include <apps/cli/simulate/heat_report.hpp>

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

namespace svt::cli {
namespace {

using simulate::HeatResult, simulate::SurfacePoint, simulate::ZoneHeat;

// Figures below a tenth of a milliwatt or a tenth of a millikelvin are rounding.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json pointJson(const std::optional<SurfacePoint>& point) {
    if (!point) return nullptr;
    const auto coordinate = [](double v) { return std::round(v * 1e3) / 1e3; };
    return {{"celsius", rounded(point->celsius)},
            {"at", {coordinate(point->at.x), coordinate(point->at.y), coordinate(point->at.z)}}};
}

Json zoneJson(const ZoneHeat& zone) {
    return {{"temperature", zone.celsius},
            {"source", zone.source},
            {"watts", rounded(zone.watts)},
            {"openingWatts", rounded(zone.openingWatts)},
            {"area", rounded(zone.area)},
            {"lowestSurface", pointJson(zone.lowest)},
            {"highestSurface", pointJson(zone.highest)}};
}

Row zoneRow(const std::string& id, const std::string& name, const ZoneHeat& zone) {
    Row row{id, name, zone.celsius, zone.watts, zone.openingWatts, zone.area};
    if (!zone.lowest) {
        row.insert(row.end(), 4, Cell());
        return row;
    }
    row.insert(row.end(), {zone.lowest->celsius, zone.lowest->at.x, zone.lowest->at.y, zone.lowest->at.z});
    return row;
}

}  // namespace

Table heatTable(const volume::SemanticVolume& volume, const HeatResult& result) {
    Table table;
    table.columns = {{"id", "id"},
                     {"name", "name"},
                     {"temperature", "air C"},
                     {"watts", "W"},
                     {"openingWatts", "W openings"},
                     {"area", "m2"},
                     {"lowestSurface", "lowest C"},
                     {"x", "x"},
                     {"y", "y"},
                     {"z", "z"}};
    for (const ZoneHeat& room : result.rooms) {
        const volume::Label& label = volume.labels.labels[room.label];
        table.rows.push_back(zoneRow(label.id, label.name, room));
    }
    table.rows.push_back(zoneRow("(outside)", "", result.outside));
    return table;
}

Json heatJson(const volume::SemanticVolume& volume, const HeatResult& result) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    Json rooms = Json::array(), openings = Json::array(), assumed = Json::array(), leaks = Json::array();
    for (const ZoneHeat& room : result.rooms) {
        Json json{{"id", labels[room.label].id}, {"name", labels[room.label].name}};
        json.update(zoneJson(room));
        rooms.push_back(std::move(json));
    }
    for (const simulate::OpeningHeat& opening : result.openings)
        openings.push_back({{"id", labels[opening.label].id},
                            {"transmittance", opening.transmittance},
                            {"source", opening.source},
                            {"area", rounded(opening.area)},
                            {"watts", rounded(opening.watts)}});
    for (const simulate::ThermalAssumption& one : result.assumed) {
        Json ids = Json::array();
        for (const std::uint32_t label : one.labels) ids.push_back(labels[label].id);
        assumed.push_back({{"conductivity", one.conductivity},
                           {"source", one.source},
                           {"detail", one.detail},
                           {"ids", std::move(ids)}});
    }
    for (const simulate::AirLeak& leak : result.leaks)
        leaks.push_back(
            {{"id", labels[leak.label].id}, {"at", {leak.at.x, leak.at.y, leak.at.z}}, {"area", rounded(leak.area)}});
    return {{"rooms", std::move(rooms)},
            {"outside", zoneJson(result.outside)},
            {"openings", std::move(openings)},
            {"balance", result.balance},
            {"planes", {{"share", result.planeShare}, {"area", rounded(result.faceArea)}}},
            {"assumed", std::move(assumed)},
            {"leaks", std::move(leaks)},
            {"cells", result.cells},
            {"undetermined", result.undetermined},
            {"iterations", result.iterations}};
}

std::vector<std::string> heatNotes(const volume::SemanticVolume& volume, const HeatResult& result) {
    std::vector<std::string> notes;
    std::size_t defaults = 0, words = 0;
    for (const simulate::ThermalAssumption& one : result.assumed) {
        if (one.source == "default") defaults += one.labels.size();
        if (one.source == "word") words += one.labels.size();
    }
    if (defaults > 0) notes.push_back(fmt::format("{} components have an assumed conductivity", defaults));
    if (words > 0)
        notes.push_back(fmt::format("{} components have a conductivity by a word of their material or name", words));
    std::size_t windows = 0, blind = 0;
    for (const simulate::OpeningHeat& opening : result.openings) {
        const volume::Label& label = volume.labels.labels[opening.label];
        windows += opening.area > 0 && opening.source == "default";
        // A surface may stand before or behind the body of its window.
        blind += !(opening.area > 0) && label.filling != volume::Filling::Surface && label.voxels > 0;
    }
    if (blind > 0)
        notes.push_back(fmt::format("{} windows and doors have no air on both sides, and no heat passes them", blind));
    if (windows > 0) notes.push_back(fmt::format("{} windows and doors have an assumed U-value", windows));
    if (result.planeShare < 0.95)
        notes.push_back(
            fmt::format("{:.1f} % of the surfaces follow voxels, because the model has no plane there; a finer "
                        "--spacing gives better figures",
                        100 * (1 - result.planeShare)));
    if (!result.leaks.empty())
        notes.push_back(fmt::format("{} rooms are open to outside air; the heat of this air is not in the figures",
                                    result.leaks.size()));
    if (result.undetermined > 0)
        notes.push_back(fmt::format("{} voxels of solids touch no air and have no temperature", result.undetermined));
    return notes;
}

}  // namespace svt::cli
