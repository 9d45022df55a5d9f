#include <apps/cli/diff/city_comparison.hpp>
#include <apps/cli/diff/comparison_reports.hpp>

#include <svt/core/names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace svt::cli {
namespace {

using compare::Change;

void addPlace(const Compared& compared, CityComparison& sum) {
    const compare::Comparison& comparison = compared.comparison;
    if (!comparison.isDifferent()) return;
    Table table = comparisonTable(compared, false);
    if (sum.rows.columns.empty()) sum.rows.columns = std::move(table.columns);
    sum.rows.rows.insert(sum.rows.rows.end(), std::make_move_iterator(table.rows.begin()),
                         std::make_move_iterator(table.rows.end()));
    for (Json& row : rowsJson(compared, false)) sum.rowsJson.push_back(std::move(row));
    sum.classes = sumsByClass(compared, allRows(comparison), std::move(sum.classes));
    for (std::size_t change = 0; change < compare::kChangeCount; ++change)
        if (static_cast<Change>(change) != Change::Same) {
            sum.counts[change] += comparison.counts[change];
            sum.groups[change] += comparison.groups[change];
        }
    sum.otherProperties += comparison.otherProperties;
    sum.properties.classes += comparison.properties.classes;
    sum.properties.names += comparison.properties.names;
    sum.properties.storeys += comparison.properties.storeys;
    sum.properties.attributes += comparison.properties.attributes;
    sum.isComplete = sum.isComplete && comparison.isComplete;
}

// Compares the states of some tiles: only the buildings with these ids, or all others.
Result<void> compareTiles(const city::City& was, const city::City& is, const city::ChangedTiles& tiles,
                          const std::vector<std::string>& ids, bool areAlone, const compare::CompareOptions& options,
                          CityComparison& sum) {
    SVT_TRY(states, city::readPlace(was, is, tiles));
    sum.hasMeshes = sum.hasMeshes || !states->was.vectors.triangles.empty() || !states->is.vectors.triangles.empty();
    if (ids.empty()) {
        SVT_TRY(comparison, compare::compareVolumes(states->was, states->is, options));
        addPlace({states->was, states->is, *comparison}, sum);
        return {};
    }
    const std::vector<char> isTakenOfWas = city::takeGeometry(states->was, ids, areAlone),
                            isTakenOfIs = city::takeGeometry(states->is, ids, areAlone);
    SVT_TRY(comparison, compare::compareVolumes(states->was, states->is, options));
    compare::Comparison kept;
    kept.isComplete = comparison->isComplete;
    for (compare::ComparisonRow& row : comparison->rows) {
        const auto isTaken = [](const std::vector<std::uint32_t>& labels, const std::vector<char>& taken) {
            return std::any_of(labels.begin(), labels.end(), [&](std::uint32_t l) { return taken[l] != 0; });
        };
        if (isTaken(row.was, isTakenOfWas) || isTaken(row.is, isTakenOfIs)) continue;
        kept.count(row);
        kept.rows.push_back(std::move(row));
    }
    addPlace({states->was, states->is, kept}, sum);
    return {};
}

}  // namespace

Result<CityComparison> compareCities(const city::City& was, const city::City& is,
                                     const compare::CompareOptions& options) {
    SVT_TRY(changes, city::findCityChanges(was, is, options.threads, options.progress));
    CityComparison sum;
    sum.rowsJson = Json::array();
    sum.equalTiles = changes->equalTiles;
    sum.equalBuildings = changes->equalBuildings;
    std::vector<std::string> apart;
    for (const city::MovedBuildings& moved : changes->apart)
        apart.insert(apart.end(), moved.ids.begin(), moved.ids.end());
    std::sort(apart.begin(), apart.end());
    sum.apart = apart.size();
    ProgressCounter counter(options.progress, "places", changes->places.size() + changes->apart.size());
    compare::CompareOptions ofPlace = options;
    ofPlace.progress = nullptr;
    for (const city::ChangedTiles& place : changes->places) {
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped between tiles");
        SVT_DO(compareTiles(was, is, place, apart, false, ofPlace, sum));
        sum.changedTiles += std::max(place.was.size(), place.is.size());
        counter.add();
    }
    for (const city::MovedBuildings& moved : changes->apart) {
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped between tiles");
        SVT_DO(compareTiles(was, is, moved.tiles, moved.ids, true, ofPlace, sum));
        counter.add();
    }
    return sum;
}

Json cityComparisonJson(const CityComparison& comparison) {
    Json json;
    json["rows"] = comparison.rowsJson;
    Json& summary = json["summary"];
    summary["different"] = comparison.isDifferent();
    for (std::size_t change = 0; change < compare::kChangeCount; ++change)
        if (const auto kind = static_cast<Change>(change); kind != Change::Same)
            summary["changes"][std::string(nameOf(kind))] = comparison.counts[change];
    for (const Change change : {Change::Added, Change::Removed})
        summary["groups"][std::string(nameOf(change))] = comparison.groups[std::size_t(change)];
    summary["otherProperties"] = comparison.otherProperties;
    summary["properties"] = propertiesJson(comparison.properties);
    summary["classes"] = classesJson(comparison.classes);
    summary["complete"] = comparison.isComplete;
    summary["changedTiles"] = comparison.changedTiles;
    summary["equalTiles"] = comparison.equalTiles;
    summary["equalBuildings"] = comparison.equalBuildings;
    summary["apart"] = comparison.apart;
    return json;
}

std::string citySummary(const CityComparison& comparison) {
    compare::Comparison sums;
    sums.counts = comparison.counts;
    sums.groups = comparison.groups;
    sums.otherProperties = comparison.otherProperties;
    sums.properties = comparison.properties;
    const std::uint64_t tiles = comparison.changedTiles + comparison.equalTiles;
    const std::string changes = comparison.isDifferent() ? fmt::format("{} in {} of {} tiles", comparisonSummary(sums),
                                                                       comparison.changedTiles, tiles)
                                                         : "no differences";
    return fmt::format("{}; {} tiles with {} buildings are equal", changes, comparison.equalTiles,
                       comparison.equalBuildings);
}

}  // namespace svt::cli
