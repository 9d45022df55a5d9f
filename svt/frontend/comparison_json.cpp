#include <svt/frontend/comparison_json.hpp>

#include <svt/core/names.hpp>
#include <svt/frontend/volume_json.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace svt::frontend {
namespace {

using compare::Change, compare::ClassSums, compare::Compared, compare::ComparisonRow, compare::StateFeatures;

Json knownJson(const std::optional<double>& value) { return value ? Json(compare::withoutRounding(*value)) : Json(); }

Json rowJson(const ComparisonRow& row, const StateFeatures& was, const StateFeatures& is) {
    const compare::RowSubject subject = subjectOf(row, was, is);
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
    json["vector"] = row.vector ? Json{compare::withoutRounding(row.vector->x), compare::withoutRounding(row.vector->y),
                                       compare::withoutRounding(row.vector->z)}
                                : Json();
    json["rotation"] = knownJson(row.rotation);
    json["added"] = knownJson(row.added);
    json["removed"] = knownJson(row.removed);
    json["distance"] = knownJson(row.distance);
    json["exact"] = row.isExact;
    json["bound"] = knownJson(row.bound);
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
                        {"added", knownJson(sums.added)},
                        {"removed", knownJson(sums.removed)},
                        {"bound", knownJson(sums.bound)},
                        {"withoutVolume", sums.unknown}});
    return json;
}

Json propertiesJson(const compare::PropertyCounts& counts) {
    return {{"class", counts.classes},
            {"name", counts.names},
            {"storey", counts.storeys},
            {"attributes", counts.attributes}};
}

Json comparisonJson(const Compared& compared) {
    Json json;
    json["rows"] = rowsJson(compared, true);
    Json& summary = json["summary"];
    summary["different"] = compared.comparison.isDifferent();
    for (std::size_t change = 0; change < compare::kChangeCount; ++change)
        summary["changes"][std::string(nameOf(static_cast<Change>(change)))] = compared.comparison.counts[change];
    for (const Change change : {Change::Same, Change::Added, Change::Removed})
        summary["groups"][std::string(nameOf(change))] = compared.comparison.groups[std::size_t(change)];
    summary["ambiguousGroups"] = compared.comparison.ambiguousGroups;
    summary["otherProperties"] = compared.comparison.otherProperties;
    summary["properties"] = propertiesJson(compared.comparison.properties);
    summary["classes"] = classesJson(compare::sumsByClass(compared, compare::allRows(compared.comparison)));
    summary["complete"] = compared.comparison.isComplete;
    return json;
}

std::string comparisonFile(const Compared& compared) {
    return comparisonJson(compared).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace svt::frontend
