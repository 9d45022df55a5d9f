#include <apps/cli/diff/city_comparison.hpp>
#include <apps/cli/diff/comparison_reports.hpp>

#include <svt/core/names.hpp>

#include <fmt/format.h>

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
        if (static_cast<Change>(change) != Change::Same) sum.counts[change] += comparison.counts[change];
    sum.otherProperties += comparison.otherProperties;
    sum.isComplete = sum.isComplete && comparison.isComplete;
}

}  // namespace

Result<CityComparison> compareCities(const city::City& was, const city::City& is,
                                     const compare::CompareOptions& options) {
    SVT_TRY(changes, city::findCityChanges(was, is, options.threads, options.progress));
    CityComparison sum;
    sum.rowsJson = Json::array();
    sum.equalTiles = changes->equalTiles;
    sum.equalBuildings = changes->equalBuildings;
    sum.apart = changes->apart;
    ProgressCounter counter(options.progress, "places", changes->places.size());
    compare::CompareOptions ofPlace = options;
    ofPlace.progress = nullptr;
    for (const city::ChangedTiles& place : changes->places) {
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped between tiles");
        SVT_TRY(states, city::readPlace(was, is, place));
        SVT_TRY(comparison, compare::compareVolumes(states->was, states->is, ofPlace));
        addPlace({states->was, states->is, *comparison}, sum);
        sum.changedTiles += std::max(place.was.size(), place.is.size());
        sum.hasMeshes =
            sum.hasMeshes || !states->was.vectors.triangles.empty() || !states->is.vectors.triangles.empty();
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
    summary["otherProperties"] = comparison.otherProperties;
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
    sums.otherProperties = comparison.otherProperties;
    const std::uint64_t tiles = comparison.changedTiles + comparison.equalTiles;
    const std::string changes = comparison.isDifferent() ? fmt::format("{} in {} of {} tiles", comparisonSummary(sums),
                                                                       comparison.changedTiles, tiles)
                                                         : "no differences";
    return fmt::format("{}; {} tiles with {} buildings are equal", changes, comparison.equalTiles,
                       comparison.equalBuildings);
}

}  // namespace svt::cli
