#include <apps/cli/field/field_tables.hpp>

#include <apps/cli/output/output_files.hpp>

#include <svt/core/file.hpp>
#include <svt/core/names.hpp>
#include <svt/fields/check_field.hpp>
#include <svt/fields/field_sampler.hpp>
#include <svt/fields/lattice_nodes.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::cli {
namespace {

using fields::FieldHead;
using fields::FieldKind;
using fields::ListedField;

// The nodes or places of a field in words; the number of labels stands in the volume only.
std::string placesText(const FieldHead& head) {
    if (head.kind == FieldKind::Label) return "labels";
    if (head.kind == FieldKind::Points) return fmt::format("{} points", head.points.size());
    return fmt::format("{} x {} x {}", head.lattice.size.x, head.lattice.size.y, head.lattice.size.z);
}

std::string timesText(const FieldHead& head) {
    if (head.times.size() == 1) return "1";
    return fmt::format("{} ({:g} to {:g} s)", head.times.size(), head.times.front(), head.times.back());
}

Json vectorJson(const auto& vector) { return {vector.x, vector.y, vector.z}; }

Json oneFieldJson(const ListedField& listed) {
    const FieldHead& head = listed.stored.head;
    Json json;
    json["name"] = head.name;
    json["kind"] = nameOf(head.kind);
    json["quantity"] = head.quantity.empty() ? Json() : Json(head.quantity);
    json["unit"] = head.unit;
    json["components"] = head.components;
    json["medium"] = head.medium;
    json["times"] = head.times;
    json["epoch"] = head.epoch ? Json(*head.epoch) : Json();
    json["range"] = nullptr;
    if (listed.stored.range) json["range"] = {double{listed.stored.range->first}, double{listed.stored.range->second}};
    json["precision"] = head.precision;
    if (head.kind == FieldKind::Grid) {
        Json& lattice = json["lattice"];
        lattice["first"] = vectorJson(head.lattice.first);
        lattice["step"] = vectorJson(head.lattice.step);
        lattice["size"] = vectorJson(head.lattice.size);
        if (!head.lattice.positions[0].empty()) lattice["axes"] = head.lattice.positions;
        json["levels"] = listed.stored.code.levels;
    }
    if (head.kind == FieldKind::Points) {
        Json& points = json["points"] = Json::array();
        for (const fields::FieldPoint& point : head.points)
            points.push_back({{"id", point.id}, {"at", vectorJson(point.at)}});
    }
    json["by"] = head.by.empty() ? Json() : Json(head.by);
    json["parameters"] = head.parameters.empty() ? Json() : Json::parse(head.parameters, nullptr, false);
    json["bytes"] = listed.bytes;
    return json;
}

Cell cellOf(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

Cell cellOf(float value) { return std::isnan(value) ? Cell() : Cell(value); }

void appendFigures(Row& row, const fields::FieldFigures& figures, const fields::StatisticsOptions& options) {
    for (const auto& value : {figures.mean, figures.min, figures.max, figures.deviation}) row.push_back(cellOf(value));
    row.emplace_back(figures.volume);
    row.emplace_back(figures.missing);
    if (options.over) row.push_back(cellOf(figures.shareOver));
    if (options.under) row.push_back(cellOf(figures.shareUnder));
}

// The cells that name a place of a field.
Row placeCells(const FieldHead& head, const volume::SemanticVolume& volume, std::size_t place) {
    if (head.kind == FieldKind::Label) {
        const volume::Label& label = volume.labels.labels[place];
        return {label.id, label.className, label.name};
    }
    if (head.kind == FieldKind::Points) {
        const fields::FieldPoint& point = head.points[place];
        return {point.id, point.at.x, point.at.y, point.at.z};
    }
    const Vec3d at = volume.grid.worldFromIndex(fields::nodeAt(head.lattice, place));
    return {at.x, at.y, at.z};
}

}  // namespace

Table fieldTable(std::span<const ListedField> listed) {
    Table table;
    table.columns = {{"name", "name"}, {"kind", "kind"}, {"unit", "unit"},     {"times", "times"}, {"medium", "medium"},
                     {"min", "min"},   {"max", "max"},   {"places", "places"}, {"bytes", "bytes"}};
    for (const ListedField& field : listed) {
        const FieldHead& head = field.stored.head;
        const auto& range = field.stored.range;
        table.rows.push_back({head.name, nameOf(head.kind), head.unit, timesText(head), head.medium,
                              range ? Cell(range->first) : Cell(), range ? Cell(range->second) : Cell(),
                              placesText(head), field.bytes});
    }
    return table;
}

Json fieldsJson(std::span<const ListedField> listed) {
    Json json;
    Json& list = json["fields"] = Json::array();
    for (const ListedField& field : listed) list.push_back(oneFieldJson(field));
    return json;
}

Table statisticsTable(const FieldHead& head, const fields::FieldStatistics& statistics,
                      std::span<const fields::StatisticsRow> rows, const volume::LabelTable& labels, bool hasTimes) {
    const bool isSeries = statistics.times.size() > 1;
    const fields::StatisticsOptions& options = statistics.options;
    Table table;
    table.columns = {{"id", "id"}, {"class", "class"}, {"name", "name"}};
    if (isSeries) table.columns.push_back({"time", "s"});
    for (const char* name : {"mean", "min", "max", "deviation"})
        table.columns.push_back({name, std::string(name) + " " + head.unit});
    table.columns.push_back({"volume", "m3"});
    table.columns.push_back({"missing", "m3 missing"});
    if (options.over) table.columns.push_back({"shareOver", "share over"});
    if (options.under) table.columns.push_back({"shareUnder", "share under"});
    if (isSeries && options.over) table.columns.push_back({"hoursOver", "h over"});
    if (isSeries && options.under) table.columns.push_back({"hoursUnder", "h under"});
    if (isSeries && (options.over || options.under)) table.columns.push_back({"hoursUnknown", "h unknown"});
    for (const fields::StatisticsRow& one : rows) {
        const volume::Label& label = labels.labels[one.label];
        const Row start{label.id, label.className, label.name};
        for (std::size_t time = 0; time < statistics.times.size() && (hasTimes || !isSeries); ++time) {
            Row row = start;
            if (isSeries) row.emplace_back(statistics.times[time]);
            appendFigures(row, fields::figuresAt(statistics, one.labels, time), options);
            row.resize(table.columns.size());
            table.rows.push_back(std::move(row));
        }
        if (!isSeries) continue;
        Row row = start;
        row.emplace_back();
        appendFigures(row, fields::figuresOverTimes(statistics, one.labels), options);
        const fields::HoursBeyond hours = fields::hoursBeyond(statistics, one.labels);
        if (options.over) row.push_back(cellOf(hours.over));
        if (options.under) row.push_back(cellOf(hours.under));
        if (options.over || options.under) row.emplace_back(hours.unknown);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Result<Table> probeTable(const fields::Field& field, const volume::SemanticVolume& volume,
                         std::span<const Vec3d> places) {
    SVT_TRY(sampler, fields::FieldSampler::make(field, volume));
    const std::vector<std::uint32_t> labelOfScalar = volume.labels.labelOfScalar();
    const Vec3i n = volume.grid.dimension();
    Table table;
    table.columns = {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"id", "id"}, {"time", "s"}};
    if (field.head.components == 1)
        table.columns.push_back({"value", field.head.unit});
    else
        for (const char* name : {"valueX", "valueY", "valueZ"}) table.columns.push_back({name, field.head.unit});
    for (const Vec3d place : places) {
        const Vec3d index = volume.grid.indexFromWorld(place), voxel = index + Vec3d{0.5, 0.5, 0.5};
        Cell id;
        if (voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < n.x && voxel.y < n.y && voxel.z < n.z) {
            const std::uint32_t label = labelOfScalar[volume.columns.scalarAt(static_cast<std::int32_t>(voxel.x),
                                                                              static_cast<std::int32_t>(voxel.y),
                                                                              static_cast<std::int32_t>(voxel.z))];
            if (label != volume::kNoLabel) id = volume.labels.labels[label].id;
        }
        for (std::size_t time = 0; time < field.head.times.size(); ++time) {
            Row row{place.x, place.y, place.z, id, field.head.times[time]};
            for (std::int32_t c = 0; c < field.head.components; ++c) row.push_back(cellOf(sampler->at(index, time, c)));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Result<Table> valueTable(const fields::Field& field, const volume::SemanticVolume& volume,
                         std::span<const std::size_t> times) {
    const FieldHead& head = field.head;
    const std::size_t places = fields::placeCount(head, volume.labels.labels.size());
    const auto components = static_cast<std::size_t>(head.components);
    Table table;
    if (head.kind != FieldKind::Grid) table.columns.push_back({"id", "id"});
    if (head.kind == FieldKind::Label)
        table.columns.insert(table.columns.end(), {{"class", "class"}, {"name", "name"}});
    else
        table.columns.insert(table.columns.end(), {{"x", "x"}, {"y", "y"}, {"z", "z"}});
    table.columns.push_back({"time", "s"});
    for (const char* name : {"valueX", "valueY", "valueZ"})
        if (components > 1) table.columns.push_back({name, head.unit});
    if (components == 1) table.columns.push_back({"value", head.unit});
    for (const std::size_t time : times)
        for (std::size_t place = 0; place < places; ++place) {
            const auto valueAt = [&](std::size_t c) { return field.values[(time * components + c) * places + place]; };
            bool isKnown = false;
            for (std::size_t c = 0; c < components; ++c) isKnown = isKnown || !std::isnan(valueAt(c));
            if (!isKnown) continue;
            if (table.rows.size() == kMostValueRows)
                return Error(
                    Code::InputTooBig,
                    fmt::format("the field '{}' has more than {} values; choose a time with --time, or write a "
                                ".vti, .vtr or .nrrd",
                                head.name, kMostValueRows));
            Row row = placeCells(head, volume, place);
            row.emplace_back(head.times[time]);
            for (std::size_t c = 0; c < components; ++c) row.push_back(cellOf(valueAt(c)));
            table.rows.push_back(std::move(row));
        }
    return table;
}

Result<void> writeTable(const Table& table, const std::filesystem::path& output) {
    const std::string ending = endingOf(output);
    std::string text;
    if (ending == ".parquet") {
        SVT_TRY(bytes, writers::makeParquet(table));
        text = std::move(*bytes);
    } else {
        text = ending == ".json" ? writers::makeJson(table) : writers::makeCsv(table);
    }
    SVT_DO(writeFileAtomically(output, text));
    return {};
}

}  // namespace svt::cli
