/// Levels, areas, schedules, hatches and outlines of the generated models against approved ones in tests/golden/drawing.

#include <svt/analyze/extents.hpp>
#include <svt/drawing/approved/drawing_record_test.hpp>
#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/external_parts.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/footprints.hpp>
#include <svt/drawing/hatches.hpp>
#include <svt/drawing/north.hpp>
#include <svt/drawing/opening_schedule.hpp>
#include <svt/drawing/sheet_set.hpp>
#include <svt/drawing/stair_flights.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/pipeline/sample_models_test.hpp>
#include <svt/record/options_text_test.hpp>
#include <svt/samples/approved_test.hpp>

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace svt::drawing {
namespace {

using approved::number, approved::idOf, approved::point;
using samples::SampleFormat, samples::SampleKind;
using volume::SemanticVolume;

std::string known(const std::optional<double>& value) { return value ? number(*value) : "-"; }

std::string levelsOf(const SemanticVolume& volume, const std::vector<BuildingLevel>& levels) {
    const North north = northOf(volume);
    std::string text =
        fmt::format("north {} {} zero {}\n", number(north.degrees), int(north.source), number(zeroLevel(levels)));
    for (const BuildingLevel& level : levels) {
        text += fmt::format("level '{}' {} bound {} rooms {} {} ground {}:", level.name, number(level.floor),
                            number(level.bound), level.hasRooms, known(level.roomFloor), level.isGround);
        for (const std::uint32_t storey : level.storeys) text += ' ' + idOf(volume, storey);
        text += '\n';
    }
    for (const StoreyHeights& storey : findStoreys(volume))
        text +=
            fmt::format("storey {} floor {} low {} top {} bound {} source {} declared {} measured {} area {} of {}\n",
                        idOf(volume, storey.label), number(storey.floor), number(storey.low), number(storey.top),
                        number(storey.bound), int(storey.source), known(storey.declared), known(storey.measured),
                        number(storey.roomArea), storey.features);
    return text;
}

std::string labelsOf(const SemanticVolume& volume, const std::vector<BuildingLevel>& levels) {
    const auto extents = labelExtents(volume);
    const auto level = levelsOfLabels(volume, levels, extents);
    const auto hatches = chooseHatches(volume.labels);
    const auto externals = findExternalParts(volume);
    const auto around = labelsAroundBuilding(volume);
    const DrawingTables tables(volume);
    std::string text;
    for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l) {
        const LabelFacts& facts = tables.facts()[l];
        const MeshPlan& plan = tables.plans().labels[l];
        text += fmt::format(
            "{} level {} floor {} {} {} | {} {} {} | external {} {} around {} | role {} area {} | {} {}{}{}{}{}{} | "
            "plan {} "
            "to {} {} points\n",
            idOf(volume, l), level[l], number(extents[l].floor), number(extents[l].floorArea), number(extents[l].bound),
            int(hatches[l].hatch), hatchSourceName(hatches[l].source), hatches[l].word, externals[l].isExternal,
            int(externals[l].source), around[l], int(tables.roles()[l]), known(tables.roomAreas()[l]),
            idOf(volume, facts.building), int(facts.isSpace), int(facts.isClosed), int(facts.isSheet),
            int(facts.isElement), int(facts.isBuilding), int(facts.hasSurfaces), number(plan.low), number(plan.high),
            tables.plans().of(l).size());
    }
    return text + externalSources(externals, volume.labels) + '\n';
}

std::string areasOf(const SemanticVolume& volume, const std::vector<BuildingLevel>& levels) {
    const auto areas = measureFloorAreas(volume, levels);
    EXPECT_TRUE(areas);
    std::string text;
    for (const RoomArea& room : areas->rooms)
        text +=
            fmt::format("room {} '{}' '{}' level {} use {} area {} stated {} height {} volume {} exact {}\n",
                        idOf(volume, room.label), room.number, room.name, room.level, int(room.use), number(room.area),
                        known(room.stated), number(room.height), number(room.volume), room.isExact);
    auto sums = areas->levels;
    sums.push_back(areas->total());
    for (const LevelArea& level : sums)
        text += fmt::format(
            "gross {} net {} construction {} use {} technical {} traffic {} unknown {} bound {} rooms {} "
            "{}{}{}\n",
            number(level.gross), number(level.net), number(level.construction), number(level.use),
            number(level.technical), number(level.traffic), number(level.unknown), number(level.grossBound),
            level.rooms, int(level.isExact), int(level.isFloor), int(level.isGrossKnown));
    for (const ComponentSum& sum : areas->components)
        text += fmt::format("{} {}: {}, {} m2, {} m3\n", sum.className, sum.type, sum.count, number(sum.area),
                            number(sum.volume));
    return text;
}

std::string openingsOf(const SemanticVolume& volume, const std::vector<BuildingLevel>& levels) {
    const OpeningSchedule schedule = scheduleOpenings(volume, levels);
    std::string text = fmt::format("{} unknown\n", schedule.unknown);
    for (const OpeningRow& row : schedule.rows) {
        text += fmt::format("{} door {} '{}' level {} stated {} x {} measured {} x {} sill {}:", row.mark, row.isDoor,
                            row.type, row.level, known(row.statedWidth), known(row.statedHeight),
                            known(row.measuredWidth), known(row.measuredHeight), known(row.sill));
        for (const std::uint32_t label : row.labels) text += ' ' + idOf(volume, label);
        text += '\n';
    }
    for (std::uint32_t l = 0; l < schedule.places.size(); ++l)
        if (const auto& place = schedule.places[l])
            text += fmt::format("{} {} at {} normal {} {} x {} low {} of {}\n", idOf(volume, l), schedule.marks[l],
                                point(place->center - volume.grid.origin()), point(place->normal), number(place->width),
                                number(place->height), number(place->low), idOf(volume, schedule.openings[l]));
    for (const StairFlight& flight : findStairFlights(volume)) {
        text += fmt::format("stair {} riser {} going {} to 3 m {}:", idOf(volume, flight.label), number(flight.riser),
                            number(flight.going), flight.risersTo(3));
        for (const StairTread& tread : flight.treads)
            text += fmt::format(" {} {} {}", point(tread.center - volume.grid.origin()), number(tread.height),
                                number(tread.area));
        text += '\n';
    }
    return text;
}

std::string outlinesOf(const SemanticVolume& volume) {
    const analyze::Extents extents(volume.labels);
    const Footprints footprints(volume, extents);
    std::string text;
    for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l)
        for (const auto outline : {analyze::PlanOutline::Footprint, analyze::PlanOutline::Roof}) {
            const Footprint footprint = footprints.of(l, outline);
            text +=
                fmt::format("{} {} {} '{}'", idOf(volume, l), int(outline), number(footprint.area), footprint.source);
            std::string rings;
            for (const PlanPolygon& polygon : footprint.polygons) {
                text += ' ' + number(areaOf(polygon));
                for (const auto& ring : polygon.rings) {
                    text += fmt::format(" {}", ring.size());
                    for (const auto& p : ring) rings += number(p[0]) + ',' + number(p[1]) + ' ';
                }
            }
            text += fmt::format(" {:016x}\n", test::digestOf(rings));
        }
    return text;
}

void expectTables(const std::string& name, const SemanticVolume& volume, bool isBrief = true) {
    const auto levels = findLevels(volume);
    const auto part = [&](const std::string& text) { return isBrief ? approved::brief(text) : text; };
    test::expectApproved("drawing/tables_of_" + name, levelsOf(volume, levels) + areasOf(volume, levels) +
                                                          part(labelsOf(volume, levels)) +
                                                          part(openingsOf(volume, levels)) + part(outlinesOf(volume)));
}

TEST(ApprovedTables, OfOptions) {
    std::string text = record::optionsText<SectionOptions>();
    for (const Option& option : sheetMembers())
        text += fmt::format("{} {} {} to {} {}{}{}\n", option.name, int(option.kind), option.least, option.most,
                            int(option.isRequired), int(option.mayRepeat), int(option.isForProjects));
    test::expectApproved("drawing/options", text);
}

TEST(ApprovedTables, OfAHouseOfSolids) {
    expectTables("house_of_solids", test::volumeOfSample(SampleKind::House, SampleFormat::Ifc4, 0.15), false);
}

TEST(ApprovedTables, OfAHouseOfSurfaces) {
    samples::SampleOptions options;
    options.thematic = true;
    options.turnDegrees = 30;
    expectTables("house_of_surfaces", test::volumeOfSample(SampleKind::House, SampleFormat::CityGml2, 0.15, options));
}

TEST(ApprovedTables, OfAHouseOfVoxels) {
    expectTables("house_of_voxels", test::volumeOfSample(SampleKind::House, SampleFormat::CityGml3, 0.15, {}, false));
}

TEST(ApprovedTables, OfATower) {
    samples::SampleOptions options;
    options.storeys = 2;
    expectTables("tower", test::volumeOfSample(SampleKind::Tower, SampleFormat::CityGml3, 0.25, options));
}

}  // namespace
}  // namespace svt::drawing
