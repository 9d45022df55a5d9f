#include <apps/cli/simulate/heat_report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace svt::cli {
namespace {

using simulate::HeatOverTime, simulate::HeatResult, simulate::SurfacePoint, simulate::ZoneHeat;

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

Table emptyTable() {
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
    return table;
}

// Rows of the rooms and of outside air.
std::vector<Row> zoneRows(const volume::SemanticVolume& volume, const std::vector<ZoneHeat>& rooms,
                          const ZoneHeat& outside) {
    std::vector<Row> rows;
    for (const ZoneHeat& room : rooms) {
        const volume::Label& label = volume.labels.labels[room.label];
        rows.push_back(zoneRow(label.id, label.name, room));
    }
    rows.push_back(zoneRow("(outside)", "", outside));
    return rows;
}

Json roomsJson(const volume::SemanticVolume& volume, const std::vector<ZoneHeat>& rooms) {
    Json all = Json::array();
    for (const ZoneHeat& room : rooms) {
        const volume::Label& label = volume.labels.labels[room.label];
        Json json{{"id", label.id}, {"name", label.name}};
        json.update(zoneJson(room));
        all.push_back(std::move(json));
    }
    return all;
}

Json idsJson(const volume::SemanticVolume& volume, const std::vector<std::uint32_t>& labels) {
    Json ids = Json::array();
    for (const std::uint32_t label : labels) ids.push_back(volume.labels.labels[label].id);
    return ids;
}

Json assumedJson(const volume::SemanticVolume& volume, const std::vector<simulate::ThermalAssumption>& assumed) {
    Json all = Json::array();
    for (const simulate::ThermalAssumption& one : assumed)
        all.push_back({{"conductivity", one.conductivity},
                       {"source", one.source},
                       {"detail", one.detail},
                       {"ids", idsJson(volume, one.labels)}});
    return all;
}

Json leaksJson(const volume::SemanticVolume& volume, const std::vector<simulate::AirLeak>& leaks) {
    Json all = Json::array();
    for (const simulate::AirLeak& leak : leaks)
        all.push_back({{"id", volume.labels.labels[leak.label].id},
                       {"at", {leak.at.x, leak.at.y, leak.at.z}},
                       {"area", rounded(leak.area)}});
    return all;
}

// "3 components have an assumed conductivity".
template <class Assumption>
void noteAssumed(const std::vector<Assumption>& assumed, const char* figure, std::vector<std::string>& notes) {
    std::size_t defaults = 0, words = 0;
    for (const Assumption& one : assumed) {
        if (one.source == "default") defaults += one.labels.size();
        if (one.source == "word") words += one.labels.size();
    }
    if (defaults > 0) notes.push_back(fmt::format("{} components have an assumed {}", defaults, figure));
    if (words > 0)
        notes.push_back(fmt::format("{} components have a {} by a word of their material or name", words, figure));
}

void noteQuality(double planeShare, std::size_t leaks, std::uint64_t undetermined, std::vector<std::string>& notes) {
    if (planeShare < 0.95)
        notes.push_back(
            fmt::format("{:.1f} % of the surfaces follow voxels, because the model has no plane there; a finer "
                        "--spacing gives better figures",
                        100 * (1 - planeShare)));
    if (leaks > 0)
        notes.push_back(
            fmt::format("{} rooms are open to outside air; the heat of this air is not in the figures", leaks));
    if (undetermined > 0)
        notes.push_back(fmt::format("{} voxels of solids touch no air and have no temperature", undetermined));
}

}  // namespace

Table heatTable(const volume::SemanticVolume& volume, const HeatResult& result) {
    Table table = emptyTable();
    table.rows = zoneRows(volume, result.rooms, result.outside);
    return table;
}

Table heatTable(const volume::SemanticVolume& volume, const HeatOverTime& result) {
    Table table = emptyTable();
    table.columns.insert(table.columns.begin(), {"seconds", "s"});
    for (const simulate::HeatAtTime& at : result.times)
        for (Row& row : zoneRows(volume, at.rooms, at.outside)) {
            row.insert(row.begin(), at.seconds);
            table.rows.push_back(std::move(row));
        }
    return table;
}

Json heatJson(const volume::SemanticVolume& volume, const HeatResult& result) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    Json openings = Json::array();
    for (const simulate::OpeningHeat& opening : result.openings)
        openings.push_back({{"id", labels[opening.label].id},
                            {"transmittance", opening.transmittance},
                            {"source", opening.source},
                            {"area", rounded(opening.area)},
                            {"watts", rounded(opening.watts)}});
    return {{"rooms", roomsJson(volume, result.rooms)},
            {"outside", zoneJson(result.outside)},
            {"openings", std::move(openings)},
            {"balance", result.balance},
            {"planes", {{"share", result.planeShare}, {"area", rounded(result.faceArea)}}},
            {"assumed", assumedJson(volume, result.assumed)},
            {"leaks", leaksJson(volume, result.leaks)},
            {"cells", result.cells},
            {"undetermined", result.undetermined},
            {"iterations", result.iterations}};
}

Json heatJson(const volume::SemanticVolume& volume, const HeatOverTime& result) {
    Json times = Json::array(), capacities = Json::array();
    for (const simulate::HeatAtTime& at : result.times)
        times.push_back(
            {{"seconds", at.seconds}, {"rooms", roomsJson(volume, at.rooms)}, {"outside", zoneJson(at.outside)}});
    for (const simulate::CapacityAssumption& one : result.capacities)
        capacities.push_back({{"heatCapacity", one.heatCapacity},
                              {"source", one.source},
                              {"detail", one.detail},
                              {"ids", idsJson(volume, one.labels)}});
    const double most = std::max(std::abs(result.stored), std::abs(result.received));
    return {{"times", std::move(times)},
            {"capacity", result.capacity},
            {"stored", result.stored},
            {"received", result.received},
            {"balance", most > 0 ? std::abs(result.stored - result.received) / most : 0},
            {"planes", {{"share", result.planeShare}, {"area", rounded(result.faceArea)}}},
            {"assumed", assumedJson(volume, result.assumed)},
            {"heatCapacities", std::move(capacities)},
            {"leaks", leaksJson(volume, result.leaks)},
            {"cells", result.cells},
            {"undetermined", result.undetermined},
            {"steps", result.steps},
            {"iterations", result.iterations}};
}

std::vector<std::string> heatNotes(const HeatOverTime& result) {
    std::vector<std::string> notes;
    noteAssumed(result.assumed, "conductivity", notes);
    noteAssumed(result.capacities, "heat capacity", notes);
    noteQuality(result.planeShare, result.leaks.size(), result.undetermined, notes);
    return notes;
}

std::vector<std::string> heatNotes(const volume::SemanticVolume& volume, const HeatResult& result) {
    std::vector<std::string> notes;
    noteAssumed(result.assumed, "conductivity", notes);
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
    noteQuality(result.planeShare, result.leaks.size(), result.undetermined, notes);
    return notes;
}

}  // namespace svt::cli
