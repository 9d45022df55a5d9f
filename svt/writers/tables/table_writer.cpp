#include <svt/analyze/label_measures.hpp>
#include <svt/core/file.hpp>
#include <svt/writers/tables/table_writer.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <variant>
#include <vector>

namespace svt::writers {
namespace {

/// The attributes of all labels: name to the unit that all have, or none.
std::map<std::string, std::string> attributesOf(const volume::LabelTable& labels) {
    std::map<std::string, std::string> units;
    for (const volume::Label& label : labels.labels)
        for (const Attribute& attribute : label.attributes) {
            const auto [place, isNew] = units.emplace(attribute.name, attribute.unit);
            if (!isNew && place->second != attribute.unit) place->second.clear();
        }
    return units;
}

/// A cell that is empty without text.
TableCell textCell(std::string_view text) { return text.empty() ? TableCell() : TableCell(std::string(text)); }

template <class T>
TableCell wholeCell(T value) {
    return static_cast<std::int64_t>(value);
}

TableCell attributeCell(const volume::Label& label, const std::string& name) {
    const auto found = std::find_if(label.attributes.begin(), label.attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    if (found == label.attributes.end()) return {};
    return std::visit([](const auto& value) -> TableCell { return value; }, found->value);
}

/// The cells of a label, in the order of kObjectColumns.
std::vector<TableCell> cellsOf(const volume::SemanticVolume& volume, std::size_t number,
                               const analyze::LabelMeasure& measure, double cubicMetres) {
    const volume::Label& label = volume.labels.labels[number];
    const std::string_view parent =
        label.parent == volume::kNoLabel ? std::string_view() : volume.labels.labels[label.parent].id;
    std::vector<TableCell> cells{wholeCell(number),
                                 label.id,
                                 label.className,
                                 textCell(label.name),
                                 textCell(parent),
                                 wholeCell(label.first),
                                 wholeCell(label.count),
                                 wholeCell(label.voxels),
                                 cubicMetres,
                                 measure.area,
                                 measure.outsideArea};
    const Box3d box = analyze::worldBox(measure.box, volume.grid);
    for (const Vec3d corner : {box.min, box.max})
        for (int axis = 0; axis < 3; ++axis) cells.push_back(box.isEmpty() ? TableCell() : TableCell(corner[axis]));
    const auto byte = [](float c) { return static_cast<int>(std::clamp(c, 0.0f, 1.0f) * 255 + 0.5f); };
    cells.emplace_back(
        fmt::format("#{:02x}{:02x}{:02x}", byte(label.color.x), byte(label.color.y), byte(label.color.z)));
    cells.emplace_back(label.opacity);
    cells.emplace_back(std::string(volume::fillingName(label.filling)));
    return cells;
}

constexpr const char* kObjectColumns[] = {"label",  "id",     "class",   "name",    "parent",  "first",  "count",
                                          "voxels", "volume", "surface", "outside", "minX",    "minY",   "minZ",
                                          "maxX",   "maxY",   "maxZ",    "color",   "opacity", "filling"};
constexpr const char* kContactColumns[] = {"a",     "aClass", "aName",  "b",      "bClass",
                                           "bName", "area",   "facesX", "facesY", "facesZ"};

Table emptyTable(std::span<const char* const> names, const volume::SemanticVolume& volume) {
    Table table;
    for (const char* name : names) table.columns.push_back({name, {}});
    table.notes = {{"crs", volume.crsName}, {"source", volume.source}, {"unit", "metre"}};
    return table;
}

}  // namespace

Table makeObjectTable(const volume::SemanticVolume& volume, int threads) {
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const auto measures = analyze::measureLabels(volume, contacts);
    const auto volumes = analyze::ownVolumes(volume.labels, volume.grid);
    Table table = emptyTable(kObjectColumns, volume);
    for (std::size_t l = 0; l < volume.labels.labels.size(); ++l) {
        auto cells = cellsOf(volume, l, measures[l], volumes[l]);
        for (std::size_t c = 0; c < cells.size(); ++c) table.columns[c].cells.push_back(std::move(cells[c]));
    }
    for (const auto& [name, unit] : attributesOf(volume.labels)) {
        TableColumn column{unit.empty() ? "attribute:" + name : fmt::format("attribute:{} [{}]", name, unit), {}};
        for (const volume::Label& label : volume.labels.labels) column.cells.push_back(attributeCell(label, name));
        table.columns.push_back(std::move(column));
    }
    return table;
}

Table makeContactTable(const volume::SemanticVolume& volume, int threads) {
    Table table = emptyTable(kContactColumns, volume);
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels, threads)) {
        std::size_t column = 0;
        const auto add = [&](TableCell cell) { table.columns[column++].cells.push_back(std::move(cell)); };
        for (const std::uint32_t number : {contact.a, contact.b}) {
            const volume::Label none;
            const volume::Label& label = number == volume::kNoLabel ? none : volume.labels.labels[number];
            for (const std::string* text : {&label.id, &label.className, &label.name}) add(textCell(*text));
        }
        add(contact.area);
        for (const std::uint64_t faces : contact.faces) add(wholeCell(faces));
    }
    return table;
}

extern const VolumeFormat kObjects{.name = "objects",
                                   .endings = ".csv",
                                   .holds = "a line per object: class, name, parent, volume, surface, box, attributes",
                                   .readers = "spreadsheets, pandas, databases",
                                   .content = FileContent::Text,
                                   .write = [](const auto& volume, const auto& path, const auto& options) {
                                       return writeFileAtomically(path,
                                                                  makeCsv(makeObjectTable(volume, options.threads)));
                                   }};

extern const VolumeFormat kContacts{.name = "contacts",
                                    .endings = ".contacts.csv",
                                    .holds = "a line per pair of objects that touch: area, faces",
                                    .readers = "spreadsheets, pandas, databases",
                                    .content = FileContent::Text,
                                    .write = [](const auto& volume, const auto& path, const auto& options) {
                                        return writeFileAtomically(path,
                                                                   makeCsv(makeContactTable(volume, options.threads)));
                                    }};

extern const VolumeFormat kObjectParquet{
    .name = "objectparquet",
    .endings = ".parquet",
    .holds = "the table of objects as Apache Parquet",
    .readers = "pandas, DuckDB, Spark, GDAL, R",
    .content = FileContent::Parquet,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(bytes, makeParquet(makeObjectTable(volume, options.threads)));
        return writeFileAtomically(path, *bytes);
    }};

extern const VolumeFormat kContactParquet{
    .name = "contactparquet",
    .endings = ".contacts.parquet",
    .holds = "the table of contacts as Apache Parquet",
    .readers = "pandas, DuckDB, Spark, GDAL, R",
    .content = FileContent::Parquet,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(bytes, makeParquet(makeContactTable(volume, options.threads)));
        return writeFileAtomically(path, *bytes);
    }};

}  // namespace svt::writers
