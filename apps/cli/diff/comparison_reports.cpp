#include <apps/cli/diff/comparison_reports.hpp>

#include <svt/core/names.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace svt::cli {
namespace {

using compare::Change, compare::ComparisonRow;

// The features of one volume, as rows describe them.
class Features {
public:
    explicit Features(const volume::SemanticVolume& volume)
        : labels_(volume.labels.labels), storeys_(drawing::storeysOfLabels(volume.labels)) {}

    [[nodiscard]] const volume::Label& operator[](std::uint32_t label) const { return labels_[label]; }
    [[nodiscard]] std::string storeyOf(std::uint32_t label) const {
        const std::uint32_t storey = storeys_[label];
        if (storey == volume::kNoLabel) return {};
        return labels_[storey].name.empty() ? labels_[storey].id : labels_[storey].name;
    }
    [[nodiscard]] std::vector<std::string> ids(const std::vector<std::uint32_t>& labels) const {
        std::vector<std::string> ids;
        for (const std::uint32_t label : labels) ids.push_back(labels_[label].id);
        return ids;
    }

private:
    const std::vector<volume::Label>& labels_;
    std::vector<std::uint32_t> storeys_;
};

// Rounds to a tenth of a micrometre or the like, so that no report has digits from rounding errors.
double withoutRounding(double value) { return std::round(value * 1e7) / 1e7; }

Cell cellOf(const std::optional<double>& value) { return value ? Cell(withoutRounding(*value)) : Cell(); }
Json jsonOf(const std::optional<double>& value) { return value ? Json(withoutRounding(*value)) : Json(); }

// The feature that names a row: the new one, or the removed one.
struct Subject {
    const Features* features;
    std::uint32_t label;
};
Subject subjectOf(const ComparisonRow& row, const Features& was, const Features& is) {
    return row.is.empty() ? Subject{&was, row.was.front()} : Subject{&is, row.is.front()};
}

// Names of the properties that differ: "class, name, fireRating". \param most  further ones are counted
std::string otherProperties(const ComparisonRow& row, std::size_t most) {
    std::vector<std::string_view> names;
    if (row.hasOtherClass) names.emplace_back("class");
    if (row.hasOtherName) names.emplace_back("name");
    if (row.hasOtherStorey) names.emplace_back("storey");
    for (const compare::AttributeChange& attribute : row.attributes) names.emplace_back(attribute.name);
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + std::ptrdiff_t(std::min(most, names.size())), ", "));
    if (names.size() > most) text += fmt::format(", and {} more", names.size() - most);
    return text;
}

Json rowJson(const ComparisonRow& row, const Features& was, const Features& is) {
    const Subject subject = subjectOf(row, was, is);
    const volume::Label& label = (*subject.features)[subject.label];
    Json json;
    json["change"] = nameOf(row.change);
    json["old"] = was.ids(row.was);
    json["new"] = is.ids(row.is);
    json["class"] = label.className;
    json["name"] = label.name;
    const std::string storey = subject.features->storeyOf(subject.label);
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

// m3 by class: objects of one class hardly contain each other, so these sums count each place once.
struct ClassSums {
    std::string className;
    std::size_t objects = 0, unknown = 0;
    std::optional<double> added{}, removed{};  // of the objects whose volumes are known
};
std::vector<ClassSums> sumsByClass(const Compared& compared) {
    std::vector<ClassSums> sums;
    for (const ComparisonRow& row : compared.comparison.rows) {
        if (!row.hasGeometry || row.change == Change::Same) continue;
        const volume::Label& label =
            row.is.empty() ? compared.was.labels.labels[row.was.front()] : compared.is.labels.labels[row.is.front()];
        auto at =
            std::find_if(sums.begin(), sums.end(), [&](const ClassSums& s) { return s.className == label.className; });
        if (at == sums.end()) at = sums.insert(sums.end(), ClassSums{label.className});
        ++at->objects;
        if (!row.added && !row.removed) ++at->unknown;
        if (row.added) at->added = at->added.value_or(0) + *row.added;
        if (row.removed) at->removed = at->removed.value_or(0) + *row.removed;
    }
    return sums;
}

}  // namespace

Table comparisonTable(const Compared& compared, bool hasAll, std::size_t mostProperties) {
    const Features was(compared.was), is(compared.is);
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
        const Subject subject = subjectOf(row, was, is);
        const volume::Label& label = (*subject.features)[subject.label];
        Row cells;
        cells.emplace_back(nameOf(row.change));
        cells.emplace_back(label.className);
        cells.emplace_back(was.ids(row.was));
        cells.emplace_back(is.ids(row.is));
        cells.emplace_back(label.name);
        const std::string storey = subject.features->storeyOf(subject.label);
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

Json comparisonJson(const Compared& compared) {
    const Features was(compared.was), is(compared.is);
    Json json;
    Json& rows = json["rows"] = Json::array();
    for (const ComparisonRow& row : compared.comparison.rows) rows.push_back(rowJson(row, was, is));
    Json& summary = json["summary"];
    summary["different"] = compared.comparison.isDifferent();
    for (std::size_t change = 0; change < compare::kChangeCount; ++change)
        summary["changes"][std::string(nameOf(static_cast<Change>(change)))] = compared.comparison.counts[change];
    summary["otherProperties"] = compared.comparison.otherProperties;
    Json& classes = summary["classes"] = Json::array();
    for (const ClassSums& sums : sumsByClass(compared))
        classes.push_back({{"class", sums.className},
                           {"objects", sums.objects},
                           {"added", jsonOf(sums.added)},
                           {"removed", jsonOf(sums.removed)},
                           {"withoutVolume", sums.unknown}});
    summary["complete"] = compared.comparison.isComplete;
    return json;
}

std::string comparisonSummary(const Compared& compared) {
    std::string text;
    for (std::size_t change = compare::kChangeCount; change-- > 0;)
        if (const std::size_t count = compared.comparison.counts[change]; count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, nameOf(static_cast<Change>(change)));
    if (text.empty()) text = "no objects";
    if (compared.comparison.otherProperties > 0)
        text += fmt::format("; {} with other properties", compared.comparison.otherProperties);
    return text;
}

}  // namespace svt::cli
