#include <apps/cli/output/query_reports.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/analyze/gaps.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/render/ray_labels.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::vector<analyze::LabelMeasure> measure(const volume::SemanticVolume& volume, const With& with, int threads) {
    std::vector<analyze::Contact> contacts;
    if (with.surface) contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    if (!with.surface && !with.box) return {};
    return analyze::measureLabels(volume, contacts);
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
        else if (word == "box")
            with.box = true;
        else
            return Error(
                Code::BadArgument,
                fmt::format("--with '{}': unknown column '{}'; possible are volume, surface, box", text, word));
        at = end + 1;
    }
    return with;
}

Table featureTable(const volume::SemanticVolume& volume, const Labels& selected, const With& with, int threads) {
    Table table;
    table.columns = {{"id", "id"}, {"class", "class"}, {"name", "name"}, {"volume", "m3"}, {"voxels", "voxels"}};
    if (with.volume) {
        table.columns.push_back({"voxelVolume", "voxel m3"});
        table.columns.push_back({"filling", "filling"});
    }
    if (with.surface) {
        table.columns.push_back({"surface", "m2"});
        table.columns.push_back({"outside", "m2 outside"});
    }
    if (with.box) addBoxColumns(table.columns);
    const std::vector<analyze::LabelMeasure> measures = measure(volume, with, threads);
    for (const std::uint32_t l : selected) {
        const volume::Label& label = volume.labels.labels[l];
        Row row;
        addNames(row, volume.labels, l);
        row.insert(row.end(), {label.volume, label.voxels});
        if (with.volume)
            row.insert(row.end(),
                       {double(label.voxels) * volume.grid.voxelVolume(), volume::fillingName(label.filling)});
        if (with.surface) row.insert(row.end(), {measures[l].area, measures[l].outsideArea});
        if (with.box) appendCorners(row, analyze::worldBox(measures[l].box, volume.grid));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Json featureJson(const volume::SemanticVolume& volume, const Labels& selected, const With& with, int threads) {
    const std::vector<analyze::LabelMeasure> measures = measure(volume, with, threads);
    Json rows = Json::array();
    for (const std::uint32_t l : selected) {
        Json row = labelJson(volume.labels, l, volume.grid);
        if (with.surface) row["surface"] = {{"area", measures[l].area}, {"outside", measures[l].outsideArea}};
        if (with.box) row["box"] = boxJson(analyze::worldBox(measures[l].box, volume.grid));
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
    struct Neighbor {
        std::uint32_t own, other;
        double area;
    };
    std::vector<Neighbor> neighbors;
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels, threads)) {
        if (isIn(selected, contact.a)) neighbors.push_back({contact.a, contact.b, contact.area});
        if (contact.b != volume::kNoLabel && isIn(selected, contact.b))
            neighbors.push_back({contact.b, contact.a, contact.area});
    }
    std::sort(neighbors.begin(), neighbors.end(), [](const Neighbor& a, const Neighbor& b) {
        return a.own != b.own ? a.own < b.own : a.area != b.area ? a.area > b.area : a.other < b.other;
    });
    for (const Neighbor& neighbor : neighbors) {
        Row row;
        addNames(row, volume.labels, neighbor.own);
        addNames(row, volume.labels, neighbor.other);
        row.push_back(neighbor.area);
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
    Table table;
    table.columns = {{"id", "id"},        {"class", "class"}, {"name", "name"},
                     {"enter", "from m"}, {"leave", "to m"},  {"length", "length m"}};
    for (const render::LabelInterval& stretch : *stretches) {
        if (!isIn(selected, stretch.label)) continue;
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

Result<Table> areaTable(const volume::SemanticVolume& volume, const Labels& selected, int threads) {
    const auto levels = drawing::findLevels(volume);
    SVT_TRY(areas, drawing::measureFloorAreas(volume, levels, threads));
    Table table{{{"kind", "kind"},
                 {"id", "id"},
                 {"number", "number"},
                 {"name", "name"},
                 {"storey", "storey"},
                 {"floor", "floor m", 2},
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
                 {"exact", "exact"}},
                {}};
    const double datum = dot(volume.grid.origin(), volume.grid.axes()[2]);
    for (const drawing::RoomArea& room : areas->rooms) {
        if (!isIn(selected, room.label)) continue;
        const auto use = drawing::roomUseName(room.use);
        Row row{"room",
                volume.labels.labels[room.label].id,
                room.number.empty() ? Cell() : Cell(room.number),
                room.name,
                levels[room.level].name,
                levels[room.level].floor,
                levels[room.level].bound,
                datum + levels[room.level].floor,
                use.empty() ? Cell() : Cell(use),
                room.area,
                room.height,
                room.volume};
        row.insert(row.end(), 7, nullptr);
        row.push_back(room.isExact);
        table.rows.push_back(std::move(row));
    }
    const auto addSums = [&](const char* kind, const drawing::LevelArea& sums, const drawing::BuildingLevel* level) {
        Row row{kind, nullptr, nullptr, nullptr};
        if (level != nullptr)
            row.insert(row.end(), {level->name, level->floor, level->bound, datum + level->floor});
        else
            row.insert(row.end(), 4, nullptr);
        row.insert(row.end(), 4, nullptr);
        row.insert(row.end(), {sums.use, sums.technical, sums.traffic, sums.unknown, sums.net, sums.construction,
                               sums.gross, sums.isExact});
        table.rows.push_back(std::move(row));
    };
    for (std::size_t n = 0; n < levels.size(); ++n) addSums("storey", areas->levels[n], &levels[n]);
    if (!levels.empty()) addSums("total", areas->total(), nullptr);
    return table;
}

Result<Table> parcelTable(const volume::SemanticVolume& volume, const Labels& selected,
                          const volume::SemanticVolume& parcels, int threads) {
    SVT_TRY(shared, analyze::sharedVoxels(volume, parcels, threads));
    Table table;
    table.columns = {{"id", "id"},         {"class", "class"},  {"name", "name"},
                     {"parcel", "parcel"}, {"parcelClass", ""}, {"parcelName", "name"},
                     {"voxels", ""},       {"volume", "m3"},    {"part", "part"}};
    for (const analyze::SharedVoxels& pair : *shared) {
        if (pair.a == volume::kNoLabel || !isIn(selected, pair.a)) continue;
        Row row;
        addNames(row, volume.labels, pair.a);
        addNames(row, parcels.labels, pair.b);
        row.insert(row.end(), {pair.voxels, double(pair.voxels) * volume.grid.voxelVolume(),
                               double(pair.voxels) / double(volume.labels.labels[pair.a].voxels)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

OwnerReport ownerReport(const volume::SemanticVolume& volume, const Labels& selected, const analyze::OwnerTable& owners,
                        int threads) {
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const analyze::Ownership ownership = analyze::divideByOwners(volume, contacts, owners);
    OwnerReport report;
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
    report.components.columns = {{"id", "id"},       {"class", "class"}, {"name", "name"},
                                 {"owner", "owner"}, {"area", "m2"},     {"volume", "m3"}};
    report.json["components"] = Json::array();
    for (const analyze::DividedComponent& component : ownership.components) {
        if (!isIn(selected, component.label)) continue;
        const volume::Label& label = volume.labels.labels[component.label];
        double sum = 0;
        for (const analyze::OwnerShare& share : component.shares) {
            Row row;
            addNames(row, volume.labels, component.label);
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
    report.json["unowned"] = ownership.unowned;
    report.json["untouched"] = ownership.untouched;
    return report;
}

}  // namespace svt::cli
