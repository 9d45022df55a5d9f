#include <svt/crs/crs_facts.hpp>

#include <svt/crs/facts/crs_tables.hpp>
#include <svt/crs/facts/table_search.hpp>

#include <algorithm>
#include <span>

namespace svt::crs {
namespace {

bool isIn(std::span<const facts::CodeRange> ranges, int code) noexcept {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](facts::CodeRange range) { return range.first <= code && code <= range.last; });
}

}  // namespace

namespace facts {

int datumOfDegrees(int epsg) noexcept {
    for (const SameDegrees& same : kSameDegrees)
        if (same.epsg == epsg) return same.datum;
    return epsg;
}

const Datum* findDatum(int epsg) noexcept {
    const int code = datumOfDegrees(epsg);
    const auto found =
        std::find_if(std::begin(kDatums), std::end(kDatums), [&](const Datum& datum) { return datum.epsg == code; });
    return found == std::end(kDatums) ? nullptr : found;
}

std::optional<MetricTwin> findMetricTwin(int epsg) noexcept {
    for (const FeetCodes& row : kFeetCodes) {
        const int step = epsg - row.feet;
        if (step < 0 || step % row.feetStep != 0 || step / row.feetStep >= row.count) continue;
        MetricTwin twin{row.metres + step / row.feetStep * row.metreStep, row.isSurveyFoot ? kSurveyFoot : kFoot, {}};
        for (const OriginOffset& offset : kOriginOffsets)
            if (offset.first <= epsg && epsg <= offset.last) twin.offset = {offset.east, offset.north, 0};
        return twin;
    }
    return std::nullopt;
}

}  // namespace facts

CrsFacts factsOf(int epsg) noexcept {
    CrsFacts result;
    result.horizontal = epsg;
    for (const facts::Compound& compound : facts::kCompounds)
        if (compound.epsg <= epsg && epsg < compound.epsg + compound.count) {
            result.horizontal = compound.horizontal + compound.step * (epsg - compound.epsg);
            result.vertical = compound.vertical;
        }
    result.isDegrees = isIn(facts::kGeographicCodes, epsg) || isIn(facts::kGeographicCodes, result.horizontal);
    result.isGeocentric = std::find(std::begin(facts::kGeocentricCodes), std::end(facts::kGeocentricCodes), epsg) !=
                          std::end(facts::kGeocentricCodes);
    result.isMetres =
        !result.isDegrees && !isIn(facts::kOtherUnits, result.horizontal) && !facts::findMetricTwin(result.horizontal);
    if (result.isDegrees || isIn(facts::kNorthFirstCodes, epsg) || isIn(facts::kNorthFirstCodes, result.horizontal))
        result.order = AxisOrder::NorthEast;
    if (isIn(facts::kSouthWestCodes, epsg)) result.order = AxisOrder::SouthWest;
    return result;
}

std::optional<Box3d> areaOf(int epsg) noexcept {
    const facts::Datum* const datum = facts::findDatum(factsOf(epsg).horizontal);
    if (datum == nullptr || datum->west > datum->east) return std::nullopt;
    return Box3d{{datum->west, datum->south, 0}, {datum->east, datum->north, 0}};
}

double metresPerHeight(int vertical) noexcept {
    const auto has = [&](const auto& codes) { return std::find(std::begin(codes), std::end(codes), vertical); };
    if (has(facts::kHeightsInFeet) != std::end(facts::kHeightsInFeet)) return kFoot;
    if (has(facts::kHeightsInSurveyFeet) != std::end(facts::kHeightsInSurveyFeet)) return kSurveyFoot;
    return 1;
}

}  // namespace svt::crs
