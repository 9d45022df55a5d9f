#include <apps/cli/output/query_reports.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/face_areas.hpp>
#include <svt/analyze/gaps.hpp>
#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/parcel_parts.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/render/ray_labels.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace svt::cli {
namespace {

bool isIn(const Labels& selected, std::uint32_t label) {
    return std::binary_search(selected.begin(), selected.end(), label);
}

// Adds id, class and name of a label, or nulls for background.
void addNames(Row& row, const volume::LabelTable& table, std::uint32_t label) {
    if (label == volume::kNoLabel) {
        row.insert(row.end(), 3, nullptr);
        return;
    }
    const volume::Label& l = table.labels[label];
    row.insert(row.end(), {l.id, l.className, l.name});
}

Json boxJson(const Box3d& box) {
    if (box.isEmpty()) return nullptr;
    return {{"min", toJson(box.min)}, {"max", toJson(box.max)}};
}

void addBoxColumns(std::vector<Column>& columns) {
    for (const char* const end : {"min", "max"})
        for (const char* const axis : {"X", "Y", "Z"})
            columns.push_back({std::string(end) + axis, fmt::format("{} {}", end, char(axis[0] - 'A' + 'a'))});
}

std::vector<analyze::FeatureMeasure> measuresOf(const volume::SemanticVolume& volume, const Labels& selected,
                                                const With& with, int threads) {
    std::vector<analyze::Contact> contacts;
    if (with.surface) contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const auto own = with.surface || with.box ? analyze::measureLabels(volume, contacts)
                                              : analyze::ownMeasures(volume.labels, volume.grid);
    return analyze::measureFeatures(analyze::Extents(volume.labels), selected, own, contacts);
}

Cell known(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

// Areas of features without voxels are unknown.
Cell areaOf(const analyze::Measure& measure, double analyze::Measure::*area) {
    return measure.voxels > 0 ? Cell(measure.*area) : Cell();
}

Json ownerName(const analyze::OwnerTable& owners, std::uint32_t owner) {
    return owner == analyze::kNoOwner ? Json(nullptr) : Json(owners.names[owner]);
}

Json sharesJson(const analyze::OwnerTable& owners, const std::vector<analyze::OwnerShare>& shares) {
    Json list = Json::array();
    for (const analyze::OwnerShare& share : shares)
        list.push_back({{"owner", ownerName(owners, share.owner)}, {"area", share.area}, {"volume", share.volume}});
    return list;
}

// The stretches of a ray in `extent`; those that follow each other are one.
std::vector<render::LabelInterval> stretchesIn(const std::vector<render::LabelInterval>& all, std::uint32_t label,
                                               const Labels& extent) {
    std::vector<render::LabelInterval> joined;
    const render::LabelInterval* last = nullptr;
    for (const render::LabelInterval& stretch : all) {
        if (isIn(extent, stretch.label)) {
            if (last != nullptr && last + 1 == &stretch && last->leave == stretch.enter)
                joined.back().leave = stretch.leave;
            else
                joined.push_back({label, stretch.enter, stretch.leave});
            last = &stretch;
        }
    }
    return joined;
}

// Totals of the owners, of everything without owner, and of all.
void addTotals(const analyze::OwnerTable& owners, const analyze::Ownership& ownership, OwnerReport& report) {
    report.totals.columns = {{"owner", "owner"},
                             {"own", "own m3"},
                             {"alone", "walls alone m3"},
                             {"shared", "walls shared m3"},
                             {"total", "total m3"}};
    report.json["owners"] = Json::array();
    for (std::uint32_t o = 0; o < owners.names.size(); ++o) {
        const analyze::OwnerTotal& total = ownership.owners[o];
        const double sum = total.own + total.alone + total.shared;
        report.totals.rows.push_back({owners.names[o], total.own, total.alone, total.shared, sum});
        report.json["owners"].push_back({{"owner", owners.names[o]},
                                         {"own", total.own},
                                         {"alone", total.alone},
                                         {"shared", total.shared},
                                         {"total", sum},
                                         {"with", sharesJson(owners, total.with)}});
    }
    report.totals.rows.push_back({"(no owner)", ownership.unownedSpaces, nullptr, ownership.unowned,
                                  ownership.unownedSpaces + ownership.unowned});
    report.totals.rows.push_back({"(touch no space)", nullptr, nullptr, nullptr, ownership.untouched});
    report.totals.rows.push_back({"(all)", nullptr, nullptr, nullptr, ownership.all});
}

// The features of the table, with a row per owner.
void addOwnedFeatures(const volume::LabelTable& table, const analyze::OwnerTable& owners,
                      const analyze::Ownership& ownership, OwnerReport& report) {
    report.features.columns = {{"id", "id"},       {"class", "class"},    {"name", "name"},
                               {"owner", "owner"}, {"share", "share", 4}, {"volume", "m3"}};
    report.json["features"] = Json::array();
    for (std::size_t n = 0; n < owners.features.size(); ++n) {
        const analyze::OwnedFeature& feature = owners.features[n];
        const volume::Label& label = table.labels[feature.label];
        Json shares = Json::array();
        for (const auto& [owner, fraction] : feature.owners) {
            const double volume = ownership.ofFeature[n] * fraction;
            Row row;
            addNames(row, table, feature.label);
            row.insert(row.end(), {owners.names[owner], fraction, volume});
            report.features.rows.push_back(std::move(row));
            shares.push_back({{"owner", owners.names[owner]}, {"share", fraction}, {"volume", volume}});
        }
        report.json["features"].push_back({{"id", label.id},
                                           {"class", label.className},
                                           {"name", label.name},
                                           {"volume", ownership.ofFeature[n]},
                                           {"shares", std::move(shares)}});
    }
}

void addCommonProperty(const volume::LabelTable& table, const analyze::Ownership& ownership, OwnerReport& report) {
    report.common.columns = {{"building", "building"},
                             {"storey", "storey"},
                             {"spaces", "spaces m3"},
                             {"components", "walls and slabs m3"},
                             {"total", "total m3"}};
    const auto idOf = [&](std::uint32_t label) {
        return label == volume::kNoLabel ? Json(nullptr) : Json(table.labels[label].id);
    };
    const auto cellOf = [&](std::uint32_t label) {
        return label == volume::kNoLabel ? Cell() : Cell(table.labels[label].id);
    };
    report.json["common"] = Json::array();
    for (const auto& [building, storey, spaces, components] : ownership.common) {
        report.common.rows.push_back({cellOf(building), cellOf(storey), spaces, components, spaces + components});
        report.json["common"].push_back({{"building", idOf(building)},
                                         {"storey", idOf(storey)},
                                         {"spaces", spaces},
                                         {"components", components},
                                         {"total", spaces + components}});
    }
}

void addComponents(const volume::LabelTable& table, const Labels& selected, const analyze::OwnerTable& owners,
                   const analyze::Ownership& ownership, OwnerReport& report) {
    report.components.columns = {{"id", "id"},       {"class", "class"}, {"name", "name"},
                                 {"owner", "owner"}, {"area", "m2"},     {"volume", "m3"}};
    report.json["components"] = Json::array();
    for (const analyze::DividedComponent& component : ownership.components) {
        if (!isIn(selected, component.label)) continue;
        const volume::Label& label = table.labels[component.label];
        double sum = 0;
        for (const analyze::OwnerShare& share : component.shares) {
            Row row;
            addNames(row, table, component.label);
            row.push_back(share.owner == analyze::kNoOwner ? Cell() : Cell(owners.names[share.owner]));
            row.insert(row.end(), {share.area, share.volume});
            report.components.rows.push_back(std::move(row));
            sum += share.volume;
        }
        report.json["components"].push_back({{"id", label.id},
                                             {"class", label.className},
                                             {"name", label.name},
                                             {"volume", sum},
                                             {"shares", sharesJson(owners, component.shares)}});
    }
}

}  // namespace

Result<With> parseWith(const std::string& text) {
    With with;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (word == "volume")
            with.volume = true;
        else if (word == "surface")
            with.surface = true;
        else if (word == "faces")
            with.faces = true;
        else if (word == "box")
            with.box = true;
        else
            return Error(
                Code::BadArgument,
                fmt::format("--with '{}': unknown column '{}'; possible are volume, surface, faces, box", text, word));
        at = end + 1;
    }
    return with;
}

void addFaceColumns(std::vector<Column>& columns) {
    for (const std::string_view kind : analyze::kFaceKindNames)
        columns.push_back({std::string(kind) + "Faces", std::string(kind) + " m2", 2, writers::CellType::Number});
}

// Columns without a title are deprecated names: only JSON and CSV have them.
Table featureTable(const volume::SemanticVolume& volume, const Labels& selected, const With& with, int threads) {
    using analyze::Measure;
    Table table;
    table.columns = {{"id", "id"},
                     {"class", "class"},
                     {"name", "name"},
                     {"ownVolume", "own m3"},
                     {"totalVolume", "total m3"},
                     {"ownVoxels", "own voxels"},
                     {"totalVoxels", "total voxels"}};
    const auto add = [&](std::initializer_list<Column> columns) { table.columns.insert(table.columns.end(), columns); };
    if (with.volume) add({{"solidVolume", "solid m3"}, {"countedVolume", "counted m3"}, {"filling", "filling"}});
    if (with.surface)
        add({{"ownSurface", "own m2"},
             {"totalSurface", "total m2"},
             {"ownOutside", "own m2 outside"},
             {"totalOutside", "total m2 outside"}});
    if (with.faces) addFaceColumns(table.columns);
    if (with.box) addBoxColumns(table.columns);
    add({{"volume", "best m3"}, {"voxels"}});
    if (with.volume) add({{"voxelVolume"}});
    if (with.surface) add({{"surface"}, {"outside"}});
    add({{"volumeBound", "+- m3"}, {"volumeSource", "best m3 from"}});
    const analyze::Extents extents(volume.labels);
    const analyze::KnownVolumes volumes(volume.labels, volume.grid, extents);
    const auto areasOfMeshes = with.faces ? analyze::meshAreas(volume) : std::vector<std::optional<double>>();
    for (const analyze::FeatureMeasure& measure : measuresOf(volume, selected, with, threads)) {
        const volume::Label& label = volume.labels.labels[measure.label];
        const auto& [l, own, total] = measure;
        Row row;
        addNames(row, volume.labels, l);
        row.insert(row.end(), {known(own.volume), known(total.volume), own.voxels, total.voxels});
        if (with.volume)
            row.insert(row.end(),
                       {known(analyze::solidVolumeOf(label)), total.volume ? Cell(total.countedVolume) : Cell(),
                        volume::fillingName(label.filling)});
        if (with.surface)
            row.insert(row.end(), {areaOf(own, &Measure::area), areaOf(total, &Measure::area),
                                   areaOf(own, &Measure::outsideArea), areaOf(total, &Measure::outsideArea)});
        if (with.faces)
            for (const auto& area : analyze::faceAreas(volume.labels, extents.of(l), areasOfMeshes))
                row.push_back(known(area));
        if (with.box) appendCorners(row, total.box);
        const analyze::KnownVolume best = volumes.of(l);
        row.insert(row.end(), {known(best.volume), label.voxels});
        if (with.volume) row.emplace_back(double(label.voxels) * volume.grid.voxelVolume());
        if (with.surface) row.insert(row.end(), {own.area, own.outsideArea});
        row.push_back(best.volume ? known(best.bound) : Cell());
        row.push_back(best.volume ? Cell(analyze::volumeSourceName(best.source)) : Cell());
        table.rows.push_back(std::move(row));
    }
    return table;
}

Json featureJson(const volume::SemanticVolume& volume, const Labels& selected, const With& with, int threads) {
    const auto areasOf = [](const analyze::Measure& measure) -> Json {
        if (measure.voxels == 0) return nullptr;
        return {{"area", measure.area}, {"outside", measure.outsideArea}};
    };
    Json rows = Json::array();
    const analyze::Extents extents(volume.labels);
    const analyze::KnownVolumes volumes(volume.labels, volume.grid, extents);
    const auto areasOfMeshes = with.faces ? analyze::meshAreas(volume) : std::vector<std::optional<double>>();
    for (const analyze::FeatureMeasure& measure : measuresOf(volume, selected, with, threads)) {
        Json row = labelJson(volume.labels, measure, volumes.of(measure.label), volume.grid);
        if (with.surface) {
            row["ownSurface"] = areasOf(measure.own);
            row["totalSurface"] = areasOf(measure.total);
            row["surface"] = {{"area", measure.own.area}, {"outside", measure.own.outsideArea}};
        }
        if (with.faces) {
            const auto areas = analyze::faceAreas(volume.labels, extents.of(measure.label), areasOfMeshes);
            for (std::size_t kind = 0; kind < areas.size(); ++kind)
                row["faces"][std::string(analyze::kFaceKindNames[kind])] = areas[kind] ? Json(*areas[kind]) : Json();
        }
        if (with.box) {
            row["totalBox"] = boxJson(measure.total.box);
            row["box"] = boxJson(measure.own.box);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

Table neighborTable(const volume::SemanticVolume& volume, const Labels& selected, int threads) {
    Table table;
    table.columns = {{"id", "id"},
                     {"class", ""},
                     {"name", "name"},
                     {"neighbour", "neighbour"},
                     {"neighbourClass", "class"},
                     {"neighbourName", "name"},
                     {"area", "m2"}};
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const analyze::NeighborFinder finder(contacts, volume.labels.labels.size());
    const analyze::Extents extents(volume.labels);
    for (const std::uint32_t label : selected)
        for (const analyze::Neighbor& neighbor : finder.of(extents.of(label))) {
            Row row;
            addNames(row, volume.labels, label);
            addNames(row, volume.labels, neighbor.label);
            row.emplace_back(neighbor.area);
            table.rows.push_back(std::move(row));
        }
    return table;
}

Result<Table> rayTable(const volume::SemanticVolume& volume, const Labels& selected, const illustrate::PickRay& ray,
                       int threads) {
    SVT_TRY(bricks,
            volume::BrickVolume::fromColumns(
                volume.columns, {.faces = volume::BrickFaces::Slopes, .planes = volume.planes, .threads = threads}));
    SVT_TRY(stretches, render::labelsAlong(*bricks, volume.grid, volume.labels, ray.origin, ray.direction));
    std::vector<render::LabelInterval> found;
    const auto wholes = analyze::Extents(volume.labels).wholes(selected);
    for (std::size_t n = 0; n < selected.size(); ++n) {
        const auto joined = stretchesIn(*stretches, selected[n], wholes[n]);
        found.insert(found.end(), joined.begin(), joined.end());
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.enter < b.enter; });
    Table table;
    table.columns = {{"id", "id"},        {"class", "class"}, {"name", "name"},
                     {"enter", "from m"}, {"leave", "to m"},  {"length", "length m"}};
    for (const render::LabelInterval& stretch : found) {
        Row row;
        addNames(row, volume.labels, stretch.label);
        row.insert(row.end(), {stretch.enter, stretch.leave, stretch.leave - stretch.enter});
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table overlapTable(const volume::SemanticVolume& volume, const Labels& selected) {
    Table table;
    table.columns = {{"a", "a (has it)"}, {"aClass", "class"}, {"aName", "name"},    {"b", "b (claims it)"},
                     {"bClass", "class"}, {"bName", "name"},   {"nested", "nested"}, {"voxels", ""},
                     {"volume", "m3"},    {"bound", "+- m3"},  {"exact", "exact"}};
    const analyze::SolidOverlaps overlaps = analyze::solidOverlaps(volume);
    if (overlaps.withoutMesh > 0)
        note(
            fmt::format("{} solids have no closed mesh in this volume: their overlaps are counted in voxels, and those "
                        "between samples are not found; build the volume with --vectors meshes, or close the solids",
                        overlaps.withoutMesh));
    if (!overlaps.isComplete)
        note(
            "the solids have too many faces to compare all pairs: overlaps between samples may be missing; query a "
            "part");
    for (const analyze::SolidOverlap& overlap : overlaps.pairs) {
        if (!isIn(selected, overlap.a) && !isIn(selected, overlap.b)) continue;
        Row row;
        addNames(row, volume.labels, overlap.a);
        addNames(row, volume.labels, overlap.b);
        row.insert(row.end(), {overlap.isNested, overlap.voxels, overlap.volume,
                               std::isfinite(overlap.bound) ? Cell(overlap.bound) : Cell(), overlap.isExact});
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table gapTable(const volume::SemanticVolume& volume, const Labels& selected) {
    Table table;
    table.columns = {{"volume", "m3"}, {"voxels", "voxels"}};
    addBoxColumns(table.columns);
    table.columns.push_back({"around", "around"});
    for (const analyze::Gap& gap : analyze::findGaps(volume.columns, volume.labels)) {
        std::vector<std::string> around;
        bool isNear = false;
        for (const std::uint32_t label : gap.around) {
            around.push_back(volume.labels.labels[label].id);
            isNear = isNear || isIn(selected, label);
        }
        if (!isNear) continue;
        Row row{double(gap.voxels) * volume.grid.voxelVolume(), gap.voxels};
        appendCorners(row, analyze::worldBox(gap.box, volume.grid));
        row.push_back(std::move(around));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<Column> areaColumns() {
    return {{"kind", "kind"},
            {"id", "id"},
            {"number", "number"},
            {"name", "name"},
            {"storey", "storey"},
            {"level", "level m", 2},
            {"floor", "", 2},
            {"floorBound", "+- m", 2},
            {"elevation", "elevation m", 2},
            {"use", "use"},
            {"area", "m2", 2},
            {"height", "height m", 2},
            {"volume", "m3", 2},
            {"nuf", "NUF", 2},
            {"tf", "TF", 2},
            {"vf", "VF", 2},
            {"unknownUse", "?", 2},
            {"nrf", "NRF", 2},
            {"kgf", "KGF", 2},
            {"bgf", "BGF", 2},
            {"exact", "exact"},
            {"statedArea", "stated m2", 2},
            {"areaDifference", "difference m2", 2},
            {"countedArea", "", 2}};
}

Result<Table> areaTable(const volume::SemanticVolume& volume, const Labels& selected, int threads,
                        Diagnostics& findings) {
    const auto levels = drawing::findLevels(volume);
    SVT_TRY(areas, drawing::measureFloorAreas(volume, levels, threads));
    drawing::reportStoreys(volume, findings);
    drawing::reportAreas(*areas, levels, volume, findings);
    Table table{areaColumns(), {}};
    const double datum = dot(volume.grid.origin(), volume.grid.axes()[2]), zero = drawing::zeroLevel(levels);
    for (const drawing::RoomArea& room : areas->rooms) {
        if (!isIn(selected, room.label)) continue;
        const auto use = drawing::roomUseName(room.use);
        Row row{room.isZone ? "zone" : "room",
                volume.labels.labels[room.label].id,
                room.number.empty() ? Cell() : Cell(room.number),
                room.name,
                levels[room.level].name,
                levels[room.level].floor - zero,
                levels[room.level].floor,
                levels[room.level].bound,
                datum + levels[room.level].floor,
                use.empty() ? Cell() : Cell(use),
                room.area > 0 ? Cell(room.area) : Cell(),
                room.height,
                room.volume > 0 ? Cell(room.volume) : Cell()};
        row.insert(row.end(), 7, nullptr);
        row.push_back(room.isExact);
        const bool isCompared = room.stated && room.area > 0;
        row.push_back(room.stated ? Cell(*room.stated) : Cell());
        row.push_back(isCompared ? Cell(std::round((room.area - *room.stated) * 1e4) / 1e4 + 0.0) : Cell());
        row.push_back(room.area > 0 ? Cell(room.countedArea) : Cell());
        table.rows.push_back(std::move(row));
    }
    const auto addSums = [&](const char* kind, const drawing::LevelArea& sums, const drawing::BuildingLevel* level) {
        Row row{kind, nullptr, nullptr, nullptr};
        if (level != nullptr)
            row.insert(row.end(), {level->name, level->floor - zero, level->floor, level->bound, datum + level->floor});
        else
            row.insert(row.end(), 5, nullptr);
        row.insert(row.end(), 4, nullptr);
        const auto known = [](bool isKnown, double value) { return isKnown ? Cell(value) : Cell(); };
        const bool hasGross = sums.isFloor && sums.isGrossKnown;
        for (const double value : {sums.use, sums.technical, sums.traffic, sums.unknown, sums.net})
            row.push_back(known(sums.isFloor, value));
        row.insert(row.end(), {known(hasGross && !sums.netExceedsGross(), sums.construction),
                               known(hasGross, sums.gross), sums.isExact, nullptr, nullptr, nullptr});
        table.rows.push_back(std::move(row));
    };
    for (std::size_t n = 0; n < levels.size(); ++n) addSums("storey", areas->levels[n], &levels[n]);
    if (!levels.empty()) addSums("total", areas->total(), nullptr);
    return table;
}

Result<Table> parcelTable(const volume::SemanticVolume& volume, const Labels& selected,
                          const volume::SemanticVolume& parcels, int threads) {
    SVT_TRY(parts, analyze::partsInParcels(volume, selected, parcels, threads));
    Table table;
    table.columns = {{"id", "id"},
                     {"class", "class"},
                     {"name", "name"},
                     {"parcel", "parcel"},
                     {"parcelClass", ""},
                     {"parcelName", "name"},
                     {"voxels", ""},
                     {"volume", "m3"},
                     {"volumeBound", "+- m3"},
                     {"volumeSource", "m3 from"},
                     {"part", "part"}};
    for (const analyze::ParcelPart& part : *parts) {
        Row row;
        addNames(row, volume.labels, part.label);
        addNames(row, parcels.labels, part.parcel);
        row.insert(row.end(), {part.voxels, part.volume, known(part.bound), volumeSourceName(part.source), part.part});
        table.rows.push_back(std::move(row));
    }
    return table;
}

OwnerReport ownerReport(const volume::SemanticVolume& volume, const Labels& selected, const analyze::OwnerTable& owners,
                        int threads) {
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const analyze::Ownership ownership = analyze::divideByOwners(volume, contacts, owners);
    OwnerReport report;
    addTotals(owners, ownership, report);
    addOwnedFeatures(volume.labels, owners, ownership, report);
    addCommonProperty(volume.labels, ownership, report);
    addComponents(volume.labels, selected, owners, ownership, report);
    report.json["unowned"] = ownership.unowned;
    report.json["untouched"] = ownership.untouched;
    report.json["unownedSpaces"] = ownership.unownedSpaces;
    report.json["all"] = ownership.all;
    report.json["sharedSpace"] = {{"ids", Json::array()}, {"volume", ownership.shared}};
    for (const std::uint32_t l : owners.shared) report.json["sharedSpace"]["ids"].push_back(volume.labels.labels[l].id);
    return report;
}

}  // namespace svt::cli
