#include <apps/cli/diff/comparison_reports.hpp>

#include <svt/core/names.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::cli {
namespace {

using compare::Change, compare::ComparisonRow;

Cell cellOf(const std::optional<double>& value) { return value ? Cell(withoutRounding(*value)) : Cell(); }
Json jsonOf(const std::optional<double>& value) { return value ? Json(withoutRounding(*value)) : Json(); }

Json rowJson(const ComparisonRow& row, const StateFeatures& was, const StateFeatures& is) {
    const RowSubject subject = subjectOf(row, was, is);
    const volume::Label& label = *subject;
    Json json;
    json["change"] = nameOf(row.change);
    json["old"] = was.ids(row.was);
    json["new"] = is.ids(row.is);
    json["class"] = label.className;
    json["name"] = label.name;
    const std::string storey = subject.storey();
    json["storey"] = storey.empty() ? Json() : Json(storey);
    json["geometry"] = row.hasGeometry;
    json["vector"] = row.vector ? Json{withoutRounding(row.vector->x), withoutRounding(row.vector->y),
                                       withoutRounding(row.vector->z)}
                                : Json();
    json["added"] = jsonOf(row.added);
    json["removed"] = jsonOf(row.removed);
    json["distance"] = jsonOf(row.distance);
    json["exact"] = row.isExact;
    json["bound"] = jsonOf(row.bound);
    Json& properties = json["properties"] = Json::object();
    if (row.was.size() == 1 && row.is.size() == 1) {
        const std::uint32_t a = row.was.front(), b = row.is.front();
        if (row.hasOtherId) properties["id"] = {was[a].id, is[b].id};
        if (row.hasOtherClass) properties["class"] = {was[a].className, is[b].className};
        if (row.hasOtherName) properties["name"] = {was[a].name, is[b].name};
        if (row.hasOtherStorey) properties["storey"] = {was.storeyOf(a), is.storeyOf(b)};
    }
    Json& attributes = json["attributes"] = Json::object();
    for (const compare::AttributeChange& attribute : row.attributes)
        attributes[attribute.name] = {attribute.was ? toJson(*attribute.was) : Json(),
                                      attribute.is ? toJson(*attribute.is) : Json()};
    return json;
}

}  // namespace

Table comparisonTable(const Compared& compared, bool hasAll, std::size_t mostProperties) {
    const StateFeatures was(compared.was), is(compared.is);
    Table table;
    table.columns = {{"change", "change"},
                     {"class", "class"},
                     {"old", "old id"},
                     {"new", "new id"},
                     {"name", "name"},
                     {"storey", "storey"},
                     {"vectorX", "dx m", 4},
                     {"vectorY", "dy m", 4},
                     {"vectorZ", "dz m", 4},
                     {"added", "added m3", 4},
                     {"removed", "removed m3", 4},
                     {"bound", "+- m3", 4},
                     {"distance", "distance m", 4},
                     {"exact", "exact"},
                     {"properties", "other properties"}};
    for (const ComparisonRow& row : compared.comparison.rows) {
        if (!hasAll && !row.isDifferent()) continue;
        const RowSubject subject = subjectOf(row, was, is);
        const volume::Label& label = *subject;
        Row cells;
        cells.emplace_back(nameOf(row.change));
        cells.emplace_back(label.className);
        cells.emplace_back(was.ids(row.was));
        cells.emplace_back(is.ids(row.is));
        cells.emplace_back(label.name);
        const std::string storey = subject.storey();
        cells.push_back(storey.empty() ? Cell() : Cell(storey));
        for (int axis = 0; axis < 3; ++axis)
            cells.push_back(row.vector ? Cell(withoutRounding((*row.vector)[axis])) : Cell());
        for (const auto* value : {&row.added, &row.removed, &row.bound, &row.distance}) cells.push_back(cellOf(*value));
        cells.push_back(row.hasGeometry ? Cell(row.isExact) : Cell());
        const std::string properties = otherProperties(row, mostProperties);
        cells.push_back(properties.empty() ? Cell() : Cell(properties));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Json rowsJson(const Compared& compared, bool hasAll) {
    const StateFeatures was(compared.was), is(compared.is);
    Json rows = Json::array();
    for (const ComparisonRow& row : compared.comparison.rows)
        if (hasAll || row.isDifferent()) rows.push_back(rowJson(row, was, is));
    return rows;
}

Json classesJson(std::span<const ClassSums> classes) {
    Json json = Json::array();
    for (const ClassSums& sums : classes)
        json.push_back({{"class", sums.className},
                        {"objects", sums.objects},
                        {"added", jsonOf(sums.added)},
                        {"removed", jsonOf(sums.removed)},
                        {"bound", jsonOf(sums.bound)},
                        {"withoutVolume", sums.unknown}});
    return json;
}

Json comparisonJson(const Compared& compared) {
    Json json;
    json["rows"] = rowsJson(compared, true);
    Json& summary = json["summary"];
    summary["different"] = compared.comparison.isDifferent();
    for (std::size_t change = 0; change < compare::kChangeCount; ++change)
        summary["changes"][std::string(nameOf(static_cast<Change>(change)))] = compared.comparison.counts[change];
    summary["otherProperties"] = compared.comparison.otherProperties;
    summary["classes"] = classesJson(sumsByClass(compared, allRows(compared.comparison)));
    summary["complete"] = compared.comparison.isComplete;
    return json;
}

}  // namespace svt::cli
