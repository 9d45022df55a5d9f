/// \file
/// Writes the objects of a volume, and their contacts, as tables: CSV or Parquet for spreadsheets, pandas and
/// databases. Metres.

#include <svt/analyze/known_volumes.hpp>
#include <svt/core/file.hpp>
#include <svt/image/color_text.hpp>
#include <svt/writers/table.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <span>
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
Cell textCell(std::string_view text) { return text.empty() ? Cell() : Cell(text); }

/// The cells of a label, in the order of kObjectColumns.
Row cellsOf(const volume::SemanticVolume& volume, const analyze::FeatureMeasure& measure,
            const analyze::KnownVolume& volumeOf) {
    const auto& [number, own, total] = measure;
    const volume::Label& label = volume.labels.labels[number];
    const std::string_view parent =
        label.parent == volume::kNoLabel ? std::string_view() : volume.labels.labels[label.parent].id;
    const auto known = [](const std::optional<double>& value) { return value ? Cell(*value) : Cell(); };
    const auto area = [](const analyze::Measure& of, double value) { return of.voxels > 0 ? Cell(value) : Cell(); };
    Row cells{number,
              label.id,
              label.className,
              textCell(label.name),
              textCell(parent),
              label.first,
              label.count,
              own.voxels,
              total.voxels,
              known(own.volume),
              known(total.volume),
              total.volume ? Cell(total.countedVolume) : Cell(),
              area(own, own.area),
              area(total, total.area),
              area(own, own.outsideArea),
              area(total, total.outsideArea)};
    appendCorners(cells, total.box);
    cells.insert(cells.end(), {image::colorText(label.color), label.opacity, volume::fillingName(label.filling),
                               own.voxels, known(volumeOf.volume), own.area, own.outsideArea, known(volumeOf.bound),
                               textCell(analyze::volumeSourceName(volumeOf.source))});
    return cells;
}

// Deprecated are voxels, surface and outside: own voxels and areas, 0 where unknown.
constexpr const char* kObjectColumns[] = {
    "label",      "id",           "class",       "name",        "parent",        "first",      "count",
    "ownVoxels",  "totalVoxels",  "ownVolume",   "totalVolume", "countedVolume", "ownSurface", "totalSurface",
    "ownOutside", "totalOutside", "minX",        "minY",        "minZ",          "maxX",       "maxY",
    "maxZ",       "color",        "opacity",     "filling",     "voxels",        "volume",     "surface",
    "outside",    "volumeBound",  "volumeSource"};
constexpr const char* kContactColumns[] = {"a",     "aClass", "aName",  "b",      "bClass",
                                           "bName", "area",   "facesX", "facesY", "facesZ"};

Table emptyTable(std::span<const char* const> names, const volume::SemanticVolume& volume) {
    Table table;
    for (const char* name : names) table.columns.push_back({name});
    table.notes = {{"crs", volume.crsName}, {"source", volume.source}, {"unit", "metre"}};
    return table;
}

/// One row per label in table order. The first columns are number, id, class, name, parent's id and scalars. Own and
/// total figures follow: voxels, volume (m3), surface and its part towards background (m2). The last columns are the box
/// of the extent along world axes (m), colour, opacity and filling. Then the best known volume with its bound and source,
/// see analyze::KnownVolumes. Unknown volumes and areas are empty. Then follows each attribute of any label, named
/// `attribute:NAME`, with its unit in brackets if all labels have the same unit. Several values are a JSON array.
/// Cost: that of analyze::findContacts().
Table makeObjectTable(const volume::SemanticVolume& volume, int threads) {
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, threads);
    const auto own = analyze::measureLabels(volume, contacts);
    std::vector<std::uint32_t> all(own.size());
    std::iota(all.begin(), all.end(), 0U);
    Table table = emptyTable(kObjectColumns, volume);
    const analyze::Extents extents(volume.labels);
    const analyze::KnownVolumes volumes(volume.labels, volume.grid, extents);
    for (const auto& measure : analyze::measureFeatures(extents, all, own, contacts))
        table.rows.push_back(cellsOf(volume, measure, volumes.of(measure.label)));
    std::map<std::string, std::size_t, std::less<>> placeOf;
    for (const auto& [name, unit] : attributesOf(volume.labels)) {
        placeOf[name] = table.columns.size();
        table.columns.push_back({unit.empty() ? "attribute:" + name : fmt::format("attribute:{} [{}]", name, unit)});
    }
    for (std::size_t l = 0; l < table.rows.size(); ++l) {
        table.rows[l].resize(table.columns.size());
        for (const AttributeList& list : attributeLists(volume.labels.labels[l].attributes))
            table.rows[l][placeOf.find(list.name)->second] = list;
    }
    return table;
}

/// One row per pair of labels whose voxels share faces, and per label that touches background (b is empty): ids,
/// classes and names of both, area (m2), faces across x, y and z. Ordered by (a, b).
Table makeContactTable(const volume::SemanticVolume& volume, int threads) {
    Table table = emptyTable(kContactColumns, volume);
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels, threads)) {
        Row& row = table.rows.emplace_back();
        for (const std::uint32_t number : {contact.a, contact.b}) {
            const volume::Label none;
            const volume::Label& label = number == volume::kNoLabel ? none : volume.labels.labels[number];
            for (const std::string* text : {&label.id, &label.className, &label.name}) row.push_back(textCell(*text));
        }
        row.emplace_back(contact.area);
        for (const std::uint64_t faces : contact.faces) row.emplace_back(faces);
    }
    return table;
}

template <auto makeTable>
constexpr VolumeFormat csvFormat(std::string_view name, std::string_view endings, std::string_view holds) {
    return {.name = name,
            .endings = endings,
            .holds = holds,
            .readers = "spreadsheets, pandas, databases",
            .content = FileContent::Text,
            .write = [](const auto& volume, const auto& path, const auto& options) {
                return writeFileAtomically(path, makeCsv(makeTable(volume, options.threads)));
            }};
}

template <auto makeTable>
constexpr VolumeFormat parquetFormat(std::string_view name, std::string_view endings, std::string_view holds) {
    return {.name = name,
            .endings = endings,
            .holds = holds,
            .readers = "pandas, DuckDB, Spark, GDAL, R",
            .content = FileContent::Parquet,
            .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
                SVT_TRY(bytes, makeParquet(makeTable(volume, options.threads)));
                return writeFileAtomically(path, *bytes);
            }};
}

}  // namespace

extern const VolumeFormat kObjects = csvFormat<makeObjectTable>(
    "objects", ".csv", "a line per object: class, name, parent, volume, surface, box, attributes");
extern const VolumeFormat kContacts =
    csvFormat<makeContactTable>("contacts", ".contacts.csv", "a line per pair of objects that touch: area, faces");
extern const VolumeFormat kObjectParquet =
    parquetFormat<makeObjectTable>("objectparquet", ".parquet", "the table of objects as Apache Parquet");
extern const VolumeFormat kContactParquet =
    parquetFormat<makeContactTable>("contactparquet", ".contacts.parquet", "the table of contacts as Apache Parquet");

}  // namespace svt::writers
