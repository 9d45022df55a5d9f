/// Sheets as an office expects them: every room has a stamp, the title block its fields, doors their marks, the paper
/// follows from the scale.

#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/opening_schedule.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/draw_sheets.hpp>
#include <svt/writers/drawing/drawing_files_test.hpp>
#include <svt/writers/marks/free_space.hpp>
#include <svt/writers/marks/ground_line.hpp>
#include <svt/writers/marks/plan_lines.hpp>
#include <svt/writers/marks/room_stamps.hpp>
#include <svt/writers/marks/terrain_lines.hpp>
#include <svt/writers/office_sheets.hpp>
#include <svt/writers/sheets/stamp_texts.hpp>
#include <svt/writers/sheets/title_block.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

/// A house of box meshes on one storey.
struct House {
    volume::SemanticVolume volume = volume::test::emptyVolume({100, 50, 12}, {0.5, 0.5, 0.5}, {0, 0, 0});
    std::uint32_t storey = 0;

    House() {
        volume.modelName = "P-1";
        volume::test::addGroup(volume, "site", "GenericLogicalSpace");
        volume::test::addGroup(volume, "building", "Building", 0).name = "House at the lake";
        volume::test::addGroup(volume, "storey", "Storey", 1).name = "EG";
        storey = 2;
    }

    volume::Label& add(const std::string& id, const std::string& className, Vec3d low, Vec3d high) {
        const auto label = static_cast<std::uint32_t>(volume.labels.labels.size());
        volume::Label& added = volume::test::addObject(volume, id, className, storey);
        const Vec3d size = high - low;
        added.volume = size.x * size.y * size.z;
        added.filling = volume::Filling::Solid;
        volume::test::addBoxMesh(volume, label, low, high);
        return volume.labels.labels[label];
    }

    /// A row of `count` rooms of `width` x 1.5 m between walls of 0.2 m; names R1, R2, ...
    void addRow(int count, double width) {
        const double pitch = width + 0.2, length = count * pitch + 0.2;
        add("south", "BuildingConstructiveElement", {0, 0, 0}, {length, 0.2, 3});
        add("north", "BuildingConstructiveElement", {0, 1.7, 0}, {length, 1.9, 3});
        for (int n = 0; n <= count; ++n)
            add(fmt::format("wall{}", n), "BuildingConstructiveElement", {n * pitch, 0.2, 0},
                {n * pitch + 0.2, 1.7, 3});
        for (int n = 0; n < count; ++n)
            add(fmt::format("room{}", n), "BuildingRoom", {n * pitch + 0.2, 0.2, 0}, {(n + 1) * pitch, 1.7, 3}).name =
                fmt::format("Room number {}", n + 1);
    }

    [[nodiscard]] SheetContent content(drawing::SheetSet set = {}) const {
        auto drawn = drawSheets(set, volume, 1);
        EXPECT_TRUE(drawn) << drawn.error().message();
        return std::move(*drawn);
    }
    [[nodiscard]] std::vector<std::string> sheets(const SheetOptions& options, drawing::SheetSet set = {}) const {
        const auto made = makeSvgSheets(content(std::move(set)), volume, options);
        EXPECT_TRUE(made) << made.error().message();
        return made ? *made : std::vector<std::string>();
    }
};

std::size_t countTexts(const std::vector<std::string>& sheets, const std::string& test) {
    std::size_t count = 0;
    for (const std::string& sheet : sheets) count += SvgFile(sheet).count("//text[" + test + "]");
    return count;
}

// Hatches depend on the materials of all labels: they are chosen once for all views.
TEST(DrawnSheets, ShareTheirHatches) {
    House house;
    house.addRow(3, 4);
    const SheetContent content = house.content();
    ASSERT_GT(content.views.size(), 5u);
    for (const DrawnView& view : content.views) {
        ASSERT_NE(view.drawing.hatches, nullptr);
        EXPECT_EQ(view.drawing.hatches, content.views.front().drawing.hatches);
    }
}

// Plans are drawn side by side if there are as many as threads.
TEST(DrawnSheets, DoNotDependOnTheNumberOfThreads) {
    House house;
    house.addRow(3, 4);
    drawing::SheetSet set;
    for (int n = 0; n < 5; ++n) {
        const std::string plane = fmt::format("z={}", 0.5 + 0.4 * n);
        drawing::SetView view;
        view.plan = plane;
        set.sheets.push_back({plane, 0, {view}});
    }
    drawing::SetView section;
    section.section = "x=2";
    set.sheets.push_back({"section", 0, {section}});
    const auto drawn = [&](int threads) {
        drawing::SheetSet own = set;
        const auto content = drawSheets(own, house.volume, threads);
        EXPECT_TRUE(content) << content.error().message();
        return *makeSvgSheets(*content, house.volume, {});
    };
    const std::vector<std::string> one = drawn(1);
    EXPECT_GT(one.size(), 5u);
    for (const int threads : {2, 3, 4}) EXPECT_EQ(drawn(threads), one) << threads;
}

// A search that ends at the first obstacle finds the same clear places.
TEST(FreeSpace, ASearchThatEndsEarlyDecidesTheSame) {
    FreeSpace space;
    space.add({0, 0}, {40, 13}, Obstacle::Border);
    for (int n = 0; n < 8; ++n) space.add({5.0 * n, 20}, {5.0 * n + 3, 30}, Obstacle::Line);
    space.add({0, 35}, {40, 35}, Obstacle::Light);
    space.take({{10, 40}, {20, 44}});
    for (double u = -3; u < 45; u += 1.5)
        for (double v = -3; v < 48; v += 1.5) {
            const MarkBox box{{u, v}, {u + 7, v + 2}};
            const FreeSpace::Hits all = space.hitsOf(box), few = space.hitsOf(box, 1);
            EXPECT_EQ(space.isClear(box), all.isClear());
            EXPECT_EQ(few.isTaken || few.borders > 0 || few.lines > 1, all.isTaken || all.borders > 0 || all.lines > 1);
        }
}

// Rooms of 1 x 1.5 m are smaller than their stamps at 1:100: before, they had none.
TEST(RoomStamps, EachRoomHasOneOnThePlan) {
    House house;
    house.addRow(21, 1);
    const auto sheets = house.sheets({.scale = 100, .paper = "A3"});
    ASSERT_FALSE(sheets.empty());
    const SvgFile plan(sheets.front());
    for (int n = 1; n <= 21; ++n) EXPECT_EQ(plan.count(fmt::format("//text[.='Room number {}']", n)), 1u) << n;
    EXPECT_EQ(plan.count("//text[.='1.50 m\u00B2']"), 21u);
    EXPECT_EQ(plan.count("//text[starts-with(., 'h ')]"), 21u);
    EXPECT_EQ(plan.count("//text[contains(., 'without a stamp')]"), 0u);
}

// The right ends of all texts that begin at their place, millimetres.
double rightmostText(const std::string& sheet) {
    const std::regex text("<text x=\"([-0-9.]+)\" y=\"[-0-9.]+\" font-size=\"([0-9.]+)\">([^<]*)<");
    double right = 0;
    for (std::sregex_iterator found(sheet.begin(), sheet.end(), text), end; found != end; ++found)
        right = std::max(right, std::stod((*found)[1]) + widthOnPaper((*found)[3].str(), std::stod((*found)[2])));
    return right;
}

// Where no place is left, a list stands beside the caption, or a table on further sheets. Before, the list ended after
// three lines, and reached beyond the frame beside a long caption.
TEST(RoomStamps, RoomsWithoutPlaceStandInAListOrATable) {
    House house;
    house.volume.labels.labels[house.storey].name = "A storey with a name that leaves little room beside it for a list";
    house.addRow(60, 0.6);
    drawing::SheetSet set;
    set.tables = false;
    const auto sheets = house.sheets({.scale = 500, .paper = "A4"}, set);
    ASSERT_FALSE(sheets.empty());
    EXPECT_EQ(SvgFile(sheets.front()).count("//text[contains(., 'see the table')]"), 1u);
    for (int n = 1; n <= 60; ++n) EXPECT_GE(countTexts(sheets, fmt::format(".='Room number {}'", n)), 1u) << n;
    EXPECT_EQ(countTexts(sheets, "contains(., '0.90 m\u00B2')"), 60u) << "stamps and rows of the table";
    const double right = 297 - 10;  // the frame
    for (const std::string& sheet : sheets) EXPECT_LE(rightmostText(sheet), right);
}

// A list of a few rooms needs no table.
TEST(RoomStamps, AFewRoomsWithoutPlaceStandBesideTheCaption) {
    ViewMarks marks;
    EXPECT_TRUE(stampList(marks, 100, SheetLanguage::English).lines.empty());
    marks.withoutStamp = {{"Store 1", "2.00 m\u00B2"}, {"Store 2", "3.00 m\u00B2"}};
    const StampList list = stampList(marks, 100, SheetLanguage::English);
    EXPECT_FALSE(list.needsTable);
    EXPECT_EQ(list.lines,
              (std::vector<std::string>{"Rooms without a stamp: Store 1, 2.00 m\u00B2; Store 2, 3.00 m\u00B2"}));
    EXPECT_TRUE(stampList(marks, 30, SheetLanguage::English).needsTable) << "too narrow";
    const SheetTable table = stampTable(marks, "Plan EG", SheetLanguage::German);
    EXPECT_EQ(table.rows,
              (std::vector<std::vector<std::string>>{{"Store 1", "2.00 m\u00B2"}, {"Store 2", "3.00 m\u00B2"}}));
}

// A text covers neither a line nor another text, and a leader leads to a stamp outside.
TEST(RoomStamps, AreClearOfLinesAndOfEachOther) {
    House house;
    house.addRow(6, 0.7);
    house.add("hall", "BuildingRoom", {0.2, 2.1, 0}, {8, 8, 3}).name = "Hall";
    house.add("table", "BuildingFurniture", {3.5, 4.5, 0}, {4.7, 5.7, 0.8});
    drawing::SectionOptions options;
    options.beyond.visible = true;
    const auto drawn = *drawing::drawSection(house.volume, {{0, 0, 1}, {0, 0, 1.1}}, options);
    std::vector<RoomStamp> stamps;
    for (const auto& component : drawn.components)
        if (house.volume.labels.labels[component.label].className == "BuildingRoom")
            stamps.push_back({component.label, {house.volume.labels.labels[component.label].name, "12.34 m\u00B2"}});
    ASSERT_EQ(stamps.size(), 7u);
    FreeSpace space = freeSpaceOf(drawn, house.volume, 10), lines = space;
    const PlacedStamps placed = placeStamps(drawn, stamps, 10, {{-60, -60}, {160, 140}}, space);
    EXPECT_TRUE(placed.withoutPlace.empty());
    EXPECT_TRUE(placed.shortened.empty());
    EXPECT_EQ(placed.shapes.texts.size(), 14u);
    EXPECT_EQ(placed.shapes.thin.size(), 6u);  // leaders of the small rooms
    std::vector<MarkBox> boxes;
    for (const MarkText& text : placed.shapes.texts) {
        const double half = 0.5 * widthOnPaper(text.text, text.size);
        const MarkBox box{{text.at.u - half, text.at.v}, {text.at.u + half, text.at.v + 0.73 * text.size}};
        EXPECT_TRUE(lines.hitsOf(box).isClear()) << text.text;
        for (const MarkBox& other : boxes)
            EXPECT_TRUE(box.low.u >= other.high.u || other.low.u >= box.high.u || box.low.v >= other.high.v ||
                        other.low.v >= box.high.v)
                << text.text;
        boxes.push_back(box);
    }
}

TEST(RoomStamps, BreakNamesToStayInTheirRooms) {
    House house;
    house.addRow(6, 1.2);
    const auto drawn = *drawing::drawSection(house.volume, {{0, 0, 1}, {0, 0, 1.1}}, {});
    std::vector<RoomStamp> stamps;
    for (const auto& component : drawn.components)
        if (house.volume.labels.labels[component.label].className == "BuildingRoom")
            stamps.push_back({component.label, {"Living room", "12.34 m\u00B2"}});
    ASSERT_EQ(stamps.size(), 6u);
    FreeSpace space = freeSpaceOf(drawn, house.volume, 10);
    const PlacedStamps placed = placeStamps(drawn, stamps, 10, {{-60, -60}, {160, 140}}, space);
    EXPECT_TRUE(placed.shapes.thin.empty());
    ASSERT_EQ(placed.shapes.texts.size(), 18u);
    EXPECT_EQ(placed.shapes.texts[0].text, "Living");
    EXPECT_EQ(placed.shapes.texts[1].text, "room");
    EXPECT_NEAR(placed.shapes.texts[0].at.v - placed.shapes.texts[1].at.v, kLinePitch * placed.shapes.texts[0].size,
                1e-9);
}

// A small room between others: its number stands in it, and the rest in the list. Before, a leader crossed other rooms.
TEST(RoomStamps, LeadersDoNotCrossOtherRooms) {
    House house;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double low[] = {0, 4, 5}, high[] = {3.8, 4.8, 9};
            house.add(fmt::format("room{}{}", i, j), "BuildingRoom", {low[i], low[j], 0}, {high[i], high[j], 3}).name =
                i == 1 && j == 1 ? "K1" : fmt::format("Office {}{}", i, j);
        }
    const auto drawn = *drawing::drawSection(house.volume, {{0, 0, 1}, {0, 0, 1.1}}, {});
    std::vector<RoomStamp> stamps;
    for (const auto& component : drawn.components)
        stamps.push_back({component.label, {house.volume.labels.labels[component.label].name, "123.45 m\u00B2, oak"}});
    ASSERT_EQ(stamps.size(), 9u);
    FreeSpace space = freeSpaceOf(drawn, house.volume, 10);
    const PlacedStamps placed = placeStamps(drawn, stamps, 10, {{-60, -60}, {160, 150}}, space);
    EXPECT_TRUE(placed.withoutPlace.empty());
    EXPECT_EQ(placed.shortened, (std::vector<std::size_t>{4}));
    const auto text = std::find_if(placed.shapes.texts.begin(), placed.shapes.texts.end(),
                                   [](const MarkText& of) { return of.text == "K1"; });
    ASSERT_NE(text, placed.shapes.texts.end());
    const PlanePoint low = drawn.axes.planeFromWorld({4, 4, 0}), high = drawn.axes.planeFromWorld({4.8, 4.8, 0});
    const auto isInRoom = [&](PlanePoint p) {
        return p.u > 10 * low.u && p.u < 10 * high.u && p.v > 10 * low.v && p.v < 10 * high.v;
    };
    EXPECT_TRUE(isInRoom(text->at));
    for (const MarkPath& leader : placed.shapes.thin) EXPECT_TRUE(std::none_of(leader.begin(), leader.end(), isInRoom));
}

// Ids say nothing to a reader, and a number that repeats the name has it once.
TEST(RoomStamps, RoomsWithoutANameAreCalledRooms) {
    House house;
    house.add("GML_7b1a5a6f", "BuildingRoom", {0, 0, 0}, {6, 5, 2.5});
    volume::Label& room = house.add("bed", "BuildingRoom", {7, 0, 0}, {12, 5, 2.5});
    room.name = "Bedroom";
    room.attributes = {{"number", std::string("2 - Bedroom"), ""}};
    const auto sheets = house.sheets({.scale = 100, .paper = "A3"});
    EXPECT_EQ(countTexts(sheets, "contains(., 'GML_7b1a5a6f')"), 0u);
    EXPECT_EQ(countTexts({sheets.front()}, ".='Room'"), 1u);
    EXPECT_EQ(countTexts({sheets.front()}, ".='2 - Bedroom'"), 1u);
    EXPECT_EQ(countTexts({sheets.back()}, ".='2'"), 1u) << "the column of numbers";
    EXPECT_EQ(countTexts({sheets.back()}, ".='2 - Bedroom'"), 0u);
}

// Before, 10 came before 9.
TEST(RoomTable, IsInTheOrderOfNumbers) {
    drawing::FloorAreas areas;
    for (const char* number : {"B10", "10", "9", "B9", "009a", "1.10", "1.9", ""}) {
        drawing::RoomArea room;
        room.number = number;
        room.area = 1;
        areas.rooms.push_back(room);
    }
    areas.levels.resize(1);
    const std::vector<SheetTable> tables = makeAreaTables(areas, {drawing::BuildingLevel{}}, SheetLanguage::English);
    std::vector<std::string> numbers;
    for (const auto& row : tables.front().rows) numbers.push_back(row[0]);
    EXPECT_EQ(numbers, (std::vector<std::string>{"", "1.9", "1.10", "9", "009a", "10", "B9", "B10", ""}));
}

// 0.3 m above a floor: before, the mark of the roof was left out at 1:100.
TEST(LevelMarks, TheHighestHasAPlaceNearAFloor) {
    House house;
    house.addRow(3, 3);
    volume::test::addGroup(house.volume, "upper", "Storey", 1).name = "OG";
    house.storey = static_cast<std::uint32_t>(house.volume.labels.labels.size() - 1);
    house.volume.labels.labels[house.storey].attributes = {{"elevation", 3.0, "m"}};
    house.add("roof", "BuildingConstructiveElement", {0, 0, 3}, {9.8, 1.9, 3.3});
    drawing::SheetSet set;
    set.tables = false;
    EXPECT_GE(countTexts(house.sheets({.scale = 100, .paper = "A2"}, set), ".='+3.30'"), 6u);
}

TEST(FloorFinish, IsThatOfACoveringInTheRoom) {
    volume::LabelTable table;
    table.labels.resize(3);
    table.labels[0].subtreeEnd = 2;
    table.labels[1].subtreeEnd = 2;
    table.labels[2].subtreeEnd = 3;
    for (const std::size_t l : {1u, 2u}) {
        table.labels[l].attributes = {{"predefinedType", std::string("FLOORING")},
                                      {"material", std::string(l == 1 ? "Parquet" : "Tiles")}};
    }
    EXPECT_EQ(floorFinish(table, 0), "Parquet");
    EXPECT_EQ(floorFinish(table, 2), "");
}

TEST(RoomStamps, HaveNumberHeightAndFloorFinish) {
    House house;
    volume::Label& room = house.add("room", "BuildingRoom", {0, 0, 0}, {6, 5, 2.5});
    room.name = "Kitchen";
    room.attributes = {{"number", std::string("0.04"), ""}, {"Pset_Space.FloorCovering", std::string("Oak"), ""}};
    const auto sheets = house.sheets({.scale = 100, .paper = "A3"});
    for (const char* text : {"0.04 Kitchen", "30.00 m\u00B2", "h 2.50 m", "Oak"})
        EXPECT_EQ(countTexts({sheets.front()}, fmt::format(".='{}'", text)), 1u) << text;
    EXPECT_EQ(floorFinish(house.volume.labels, 3), "Oak");
    house.volume.labels.labels[3].attributes.back().value = std::string("FloorCovering");
    EXPECT_EQ(floorFinish(house.volume.labels, 3), "") << "a template";
    for (const char* nothing : {"n/a", "N/A", "None", "-"}) {
        house.volume.labels.labels[3].attributes.back().value = std::string(nothing);
        EXPECT_EQ(floorFinish(house.volume.labels, 3), "") << nothing;
    }
    house.volume.labels.labels[3].attributes.pop_back();
    EXPECT_EQ(floorFinish(house.volume.labels, 3), "");
}

TEST(TitleBlock, HasTheFieldsOfTheFileAndOfTheOptions) {
    House house;
    house.add("room", "BuildingRoom", {0, 0, 0}, {6, 5, 2.5});
    auto& labels = house.volume.labels.labels;
    labels[0].attributes = {{"projectName", std::string("New town hall"), ""}};
    labels[1].attributes = {{"address", std::string("Enter address here, Lake Road 3, 8001 Town"), ""}};
    SheetOptions options{.scale = 100, .paper = "A3"};
    options.block = {"A-100", "Ms Smith", "Mr Jones", "City of Town", "2026-11-28", "b", ""};
    const auto sheets = house.sheets(options);
    const std::vector<std::string> plan{sheets.front()};
    for (const char* text :
         {"New town hall", "House at the lake, Lake Road 3, 8001 Town", "A-100-1", "Ms Smith", "Mr Jones",
          "City of Town", "2026-11-28", "b", "Floor plan", "Legal owner", "Created by", "Approved by", "Date of issue"})
        EXPECT_EQ(countTexts(plan, fmt::format(".='{}'", text)), 1u) << text;
    EXPECT_EQ(countTexts({sheets.back()}, ".='Schedule'"), 1u);
    options.title = "Other";
    options.language = SheetLanguage::German;
    EXPECT_EQ(countTexts({house.sheets(options).front()}, ".='Other' or .='Zeichnungsnummer'"), 2u);
}

TEST(TitleBlock, TheDatumEndsBeforeTheLegend) {
    House house;
    house.volume.labels.labels[house.storey].name = "Ground floor of the northern wing of the new town hall";
    house.volume.crsName = "EPSG:25832";
    house.addRow(1, 3);
    const std::string sheet = house.sheets({.scale = 100, .paper = "A3"}).front();
    std::smatch found;
    ASSERT_TRUE(std::regex_search(sheet, found, std::regex("font-size=\"([0-9.]+)\"[^>]*>(Heights above[^<]*)<")));
    EXPECT_LE(widthOnPaper(found[2].str(), std::stod(found[1].str())), 85.5);
    EXPECT_NE(found[2].str().find("\u2026"), std::string::npos);
}

TEST(TitleBlock, PlaceholdersOfTemplatesAreNoFacts) {
    House house;
    auto& labels = house.volume.labels.labels;
    labels[0].attributes = {{"projectName", std::string("// PROJECT/NAME //"), ""}};
    labels[1].attributes = {{"address", std::string("Enter address here"), ""}};
    labels[1].name = "Nicht definiert";
    const ModelFacts facts = modelFacts(house.volume);
    EXPECT_EQ(facts.project, "P-1");
    EXPECT_EQ(facts.building, "");
    EXPECT_EQ(facts.address, "");
    labels[1].attributes = {{"address", std::string("Lake Road 3, <Default>"), ""}};
    house.volume.modelName = "Project Number";
    house.volume.source = "hall.ifc";
    EXPECT_EQ(modelFacts(house.volume).project, "hall.ifc");
    EXPECT_EQ(modelFacts(house.volume).address, "Lake Road 3");
    labels[0].attributes = {{"projectName", std::string("Nombre de proyecto"), ""}};
    labels[1].attributes = {{"address/CountryName", std::string("Germany"), ""},
                            {"address/LocalityName", std::string("Town"), ""},
                            {"address/PostalCodeNumber", std::string("8001"), ""},
                            {"address/ThoroughfareNumber", std::string("3"), ""},
                            {"address/ThoroughfareName", std::string("Lake Road"), ""},
                            {"address/pos", std::string("1 2 3"), ""}};
    EXPECT_EQ(modelFacts(house.volume).project, "hall.ifc");
    EXPECT_EQ(modelFacts(house.volume).address, "Lake Road 3, 8001 Town, Germany");
    EXPECT_EQ(emptyBlockOptions({.number = "1",
                                 .creator = "",
                                 .approver = "x",
                                 .owner = "y",
                                 .date = "z",
                                 .revision = "",
                                 .documentType = ""}),
              std::vector<std::string>{"--creator"});
}

TEST(SheetPaperChoice, IsTheSmallestOnWhichAllViewsFit) {
    House house;
    house.addRow(21, 1);  // 25.4 m
    const SheetContent content = house.content();
    SheetOptions options{.scale = 100};
    const auto paperAt = [&](double scale) {
        options.scale = scale;
        const auto paper = smallestPaper(content, house.volume, options);
        return paper ? *paper : paper.error().message();
    };
    EXPECT_EQ(paperAt(200), "A4");
    EXPECT_EQ(paperAt(100), "A3");
    EXPECT_EQ(paperAt(50), "A1");
    const std::string message = paperAt(5);
    EXPECT_NE(message.find("do not fit onto any paper"), std::string::npos) << message;
    EXPECT_NE(message.find("--hide"), std::string::npos) << message;
}

TEST(SheetLegend, NamesOnlyTheHatchesOfTheSheet) {
    House house;
    house.addRow(3, 3);
    for (const char* paper : {"A3", "A4"}) {
        const std::vector<std::string> plan{house.sheets({.scale = 200, .paper = paper}).front()};
        EXPECT_EQ(countTexts(plan, ".='Materials'"), 1u) << paper;
        EXPECT_EQ(countTexts(plan, ".='Timber' or .='Steel' or .='Insulation'"), 0u) << paper;
    }
}

// One door type in two sizes and a window: three marks, in plan and schedule. A property with the clear width is preferred
// to the linings.
TEST(OpeningMarks, OfThePlanAreThoseOfTheSchedule) {
    House house;
    house.addRow(4, 3);
    const auto addDoor = [&](const std::string& id, double x, double width) -> std::vector<Attribute>& {
        volume::Label& door = house.add(id, "Door", {x, 0, 0}, {x + width, 0.2, 2.01});
        door.attributes = {{"overallWidth", 0.885, "m"}, {"overallHeight", 2.01, "m"}, {"liningThickness", 0.05, "m"}};
        return door.attributes;
    };
    addDoor("door1", 1, 0.885).push_back({"operationType", "SINGLE_SWING_LEFT", ""});
    addDoor("door2", 4.4, 0.885).push_back({"operationType", "SINGLE_SWING_RIGHT", ""});
    addDoor("door3", 7.6, 1.01).push_back({"Doors.Clear Width", 0.8, "m"});
    addDoor("door4", 10.6, 1.01).push_back({"operationType", "SLIDING_TO_LEFT", ""});
    addDoor("door5", 10.6, 1.01).push_back({"operationType", "SWING_FIXED_LEFT", ""});
    house.add("window", "Window", {2, 1.7, 0.9}, {3.2, 1.9, 2.1});
    drawing::SheetSet set;
    set.tables = false;
    const SheetContent content = house.content();
    ASSERT_TRUE(content.openings);
    const Table table = openingTable(*content.openings, content.levels, house.volume.labels);
    const std::string csv = makeCsv(table);
    EXPECT_NE(csv.find("D1,door,,EG,0.885,2.01,0.885,2.01,0.785,0,2,door1 door2"), std::string::npos) << csv;
    EXPECT_NE(csv.find("D3,door,,EG,0.885,2.01,1.01,2.01,0.8,0,1,door3"), std::string::npos) << csv;
    EXPECT_NE(csv.find("D2,door,,EG,0.885,2.01,1.01,2.01,,0,2,door4 door5"), std::string::npos) << csv;
    EXPECT_NE(csv.find("W1,window,,EG,,,1.2,1.2,,0.9,1,window"), std::string::npos) << csv;
    SheetOptions options{.scale = 50, .paper = "A2"};
    const auto sheets = *makeSvgSheets(content, house.volume, options);
    EXPECT_EQ(countTexts({sheets.front()}, ".='D1'"), 2u);
    EXPECT_EQ(countTexts({sheets.front()}, ".='D2'"), 1u);
    EXPECT_EQ(countTexts({sheets.front()}, ".='W1'"), 1u);
    EXPECT_EQ(countTexts({sheets.back()}, ".='D1'"), 1u);  // the table
    EXPECT_EQ(countTexts({sheets.back()}, ".='Doors' or .='Windows'"), 2u);
    EXPECT_EQ(countTexts({sheets.back()}, ".='clear'"), 1u);
    EXPECT_EQ(countTexts({sheets.back()}, ".='0.785'"), 1u);
    EXPECT_EQ(countTexts({sheets.back()}, ".='0.800'"), 1u);
}

// The jambs of a deep wall have more area than the pane: before, they decided the width, and sills the height.
TEST(OpeningSchedule, DeepOpeningsAreAsWideAsTheyAre) {
    House house;
    house.addRow(4, 3);
    house.add("tall", "Window", {2, 0, 0.9}, {2.02, 0.42, 2.9});
    auto label = static_cast<std::uint32_t>(house.volume.labels.labels.size() - 1);
    volume::test::addBoxMesh(house.volume, label, {2.58, 0, 0.9}, {2.6, 0.42, 2.9});
    volume::test::addBoxMesh(house.volume, label, {2.02, 0.2, 0.9}, {2.58, 0.21, 2.9});
    house.add("low", "Window", {4, 0, 2}, {4.8, 0.42, 2.02});
    label = static_cast<std::uint32_t>(house.volume.labels.labels.size() - 1);
    volume::test::addBoxMesh(house.volume, label, {4, 0, 2.58}, {4.8, 0.42, 2.6});
    volume::test::addBoxMesh(house.volume, label, {4, 0.2, 2.02}, {4.8, 0.21, 2.58});
    house.add("hatch", "Window", {6, 0.5, 2.8}, {7, 1.2, 3});
    const auto schedule = drawing::scheduleOpenings(house.volume, {});
    const auto sizeOf = [&](const std::string& id) {
        for (const drawing::OpeningRow& row : schedule.rows)
            for (const std::uint32_t of : row.labels)
                if (house.volume.labels.labels[of].id == id) return std::pair(*row.measuredWidth, *row.measuredHeight);
        return std::pair(0.0, 0.0);
    };
    EXPECT_EQ(sizeOf("tall"), std::pair(0.6, 2.0));
    EXPECT_EQ(sizeOf("low"), std::pair(0.8, 0.6));
    EXPECT_EQ(sizeOf("hatch"), std::pair(1.0, 0.7));
}

// Elements that state their type in IFC are doors and windows, and both sides of a wall show one window.
TEST(OpeningSchedule, CountsElementsByTheirTypeAndSurfacesOnce) {
    House house;
    house.addRow(4, 3);
    house.add("door", "BuildingConstructiveElement", {1, 0, 0}, {2, 0.2, 2}).attributes = {
        {"ifcType", std::string("IfcDoor"), ""}};
    for (const double y : {1.7, 1.9})
        house.add(fmt::format("window{}", y), "Window", {2, y, 0.9}, {3.2, y, 2.1}).filling = volume::Filling::Surface;
    const auto schedule = drawing::scheduleOpenings(house.volume, {});
    ASSERT_EQ(schedule.rows.size(), 2u);
    EXPECT_EQ(schedule.rows[0].mark, "D1");
    EXPECT_EQ(schedule.rows[0].labels.size(), 1u);
    EXPECT_EQ(schedule.rows[1].mark, "W1");
    EXPECT_EQ(schedule.rows[1].labels.size(), 1u);
}

// Some writers export windows without a shape and a size.
TEST(OpeningMarks, OpeningsOfUnknownSizeAreCounted) {
    House house;
    house.addRow(1, 3);
    for (const char* id : {"window", "another"}) volume::test::addGroup(house.volume, id, "Window", house.storey);
    volume::test::addGroup(house.volume, "stated", "Window", house.storey).attributes = {{"overallWidth", 1.2, "m"}};
    const SheetContent content = house.content();
    ASSERT_TRUE(content.openings);
    EXPECT_EQ(content.openings->unknown, 2u);
    EXPECT_EQ(content.openings->rows.size(), 1u);
}

// 16 risers of 17.5 cm; the plan cuts the stair, so that its line of travel ends at a break line.
TEST(StairMarks, HaveTheNumberOfRisers) {
    House house;
    house.addRow(1, 8);
    const auto stair = static_cast<std::uint32_t>(house.volume.labels.labels.size());
    volume::Label& label = house.add("stair", "BuildingConstructiveElement", {1, 0.5, 0}, {1.28, 1.5, 0.175});
    label.name = "Stair";
    for (int n = 1; n < 15; ++n)
        volume::test::addBoxMesh(house.volume, stair, {1 + 0.28 * n, 0.5, 0.175 * n},
                                 {1 + 0.28 * (n + 1), 1.5, 0.175 * (n + 1)});
    volume::test::addGroup(house.volume, "upper", "Storey", 1).name = "OG";
    house.storey = static_cast<std::uint32_t>(house.volume.labels.labels.size() - 1);
    house.add("room above", "BuildingRoom", {0.2, 0.2, 2.8}, {8.2, 1.7, 5.4});
    const auto sheets = house.sheets({.scale = 50, .paper = "A2"});
    EXPECT_EQ(countTexts({sheets.front()}, ".='16 R 17.5/28'"), 2u);  // below and above
    EXPECT_EQ(SvgFile(sheets.front()).count("//g[@inkscape:label='Stairs']"), 2u);
}

// Before, circles stood between the chains of dimensions and covered their numbers.
TEST(GridMarks, NamesStandOutsideOfTheDimensions) {
    House house;
    house.addRow(3, 3);  // 9.8 x 1.9 m
    volume::Label& grid = volume::test::addGroup(house.volume, "grid", "Grid", 1);
    grid.attributes = {{"axis A", std::string("-0.5 1 0, 10.5 1 0"), "m"},
                       {"axis B", std::string("-0.5 1.1 0, 10.5 1.1 0"), "m"},
                       {"axis 1", std::string("3 0.9 0, 6 0.9 0"), "m"}};
    const auto drawn = *drawing::drawSection(house.volume, {{0, 0, 1}, {0, 0, 1.1}}, {});
    FreeSpace space;
    const MarkBox dimensions{{-30, -30}, {130, 50}};
    const MarkShapes shapes = drawGrids(drawn, house.volume, 10, dimensions, space);
    ASSERT_EQ(shapes.texts.size(), 6u);
    EXPECT_NEAR(shapes.texts[0].at.u, -33.5, 1e-6);
    EXPECT_NEAR(shapes.texts[1].at.u, 133.5, 1e-6);
    EXPECT_NEAR(shapes.texts[2].at.u, -40.5, 1e-6) << "behind the circle of A";
    // Each storey may have the same grid.
    volume::test::addGroup(house.volume, "grid of OG", "Grid", 1).attributes = grid.attributes;
    EXPECT_EQ(drawGrids(drawn, house.volume, 10, dimensions, space).texts.size(), 6u);
    EXPECT_NEAR(shapes.texts[4].at.u, 10 * drawn.axes.planeFromWorld({3, 0, 0}).u - 3.5, 1e-6)
        << "an axis that ends within the drawing";
}

TEST(GridMarks, AxesHaveTheirNamesAtBothEnds) {
    House house;
    house.addRow(3, 3);
    volume::Label& grid = volume::test::addGroup(house.volume, "grid", "Grid", 1);
    grid.attributes = {{"axis A", std::string("-2 1 0, 12 1 0"), "m"},
                       {"axis 7", std::string("5 -2 0, 5 4 0"), "m"},
                       {"axis far", std::string("500 -2 0, 500 4 0"), "m"},
                       {"axis bad", std::string("1 2"), "m"}};
    const auto sheets = house.sheets({.scale = 100, .paper = "A3"});
    EXPECT_EQ(countTexts({sheets.front()}, ".='A'") >= 2u, true);
    EXPECT_EQ(countTexts({sheets.front()}, ".='7'"), 2u);
    EXPECT_EQ(countTexts({sheets.front()}, ".='far' or .='bad'"), 0u);
}

// An arc around the middle of the house, cut by the edge of the drawing, a bend, and a whole circle within it.
TEST(GridMarks, CurvedAxesAreDrawnAsPolylines) {
    House house;
    house.addRow(3, 3);
    volume::Label& grid = volume::test::addGroup(house.volume, "grid", "Grid", 1);
    const auto arc = [](double radius, int degrees) {
        std::string text;
        for (int n = 0; n <= 48; ++n) {
            const double turn = (degrees * n / 48.0) * std::numbers::pi / 180;
            const bool isClosed = degrees == 360 && n == 48;
            text += fmt::format("{}{:.6f} {:.6f} 0", n == 0 ? "" : ", ", 5 + radius * (isClosed ? 1 : std::cos(turn)),
                                1 + radius * (isClosed ? 0 : std::sin(turn)));
        }
        return text;
    };
    grid.attributes = {{"axis K", arc(2, 180), "m"},
                       {"axis Q", arc(0.8, 360), "m"},
                       {"axis W", std::string("1 -2 0, 1 1 0, 9 1 0"), "m"},
                       {"axis Z", arc(200, 180), "m"}};
    drawing::SheetSet set;
    set.tables = false;
    const SvgFile plan(house.sheets({.scale = 100, .paper = "A3"}, set).front());
    EXPECT_EQ(plan.count("//text[.='K']"), 2u);
    EXPECT_EQ(plan.count("//text[.='Q']"), 1u) << "a whole circle has no ends";
    EXPECT_EQ(plan.count("//text[.='W']"), 2u);
    EXPECT_EQ(plan.count("//text[.='Z']"), 0u);
}

TEST(LineWidths, FollowTheScale) {
    House house;
    house.addRow(1, 3);
    const auto boldAt = [&](double scale, const char* width) {
        return SvgFile(house.sheets({.scale = scale, .paper = "A1"}).front())
            .count(fmt::format("//g[@inkscape:label='Outlines']//path[@stroke-width='{}']", width));
    };
    EXPECT_GT(boldAt(50, "0.7"), 0u);
    EXPECT_GT(boldAt(100, "0.5"), 0u);
    EXPECT_GT(boldAt(200, "0.35"), 0u);
}

// A section through a surface of terrain has a bold ground line with strokes of earth.
TEST(GroundLine, IsBoldInSections) {
    House house;
    house.addRow(3, 3);
    const auto ground = static_cast<std::uint32_t>(house.volume.labels.labels.size());
    volume::test::addObject(house.volume, "ground", "TINRelief").filling = volume::Filling::Surface;
    volume::test::addQuad(house.volume, ground, {{{-3, -3, 0.1}, {13, -3, 0.1}, {13, 5, 0.1}, {-3, 5, 0.1}}});
    const SheetContent content = house.content();
    SheetOptions options{.scale = 100, .paper = "A3"};
    std::size_t layers = 0;
    const auto sheets = makeSvgSheets(content, house.volume, options);
    ASSERT_TRUE(sheets);
    for (const std::string& sheet : *sheets) layers += SvgFile(sheet).count("//g[@inkscape:label='Ground']");
    EXPECT_EQ(layers, 6u);  // sections A and B, four elevations
}

// A foundation below an assumed ground is hidden; below the terrain of the model, nothing is drawn.
TEST(GroundLine, WhatLiesBelowItIsHidden) {
    House house;
    house.addRow(3, 3);
    house.add("footing", "BuildingConstructiveElement", {0, 0, -1}, {9.8, 1.9, 0});
    for (const bool hasTerrain : {false, true}) {
        const auto ground = static_cast<std::uint32_t>(house.volume.labels.labels.size());
        if (hasTerrain) {
            volume::test::addObject(house.volume, "ground", "TINRelief").filling = volume::Filling::Surface;
            volume::test::addQuad(house.volume, ground,
                                  {{{-5, -4, -0.4}, {15, -4, -0.4}, {15, 5, -0.4}, {-5, 5, -0.4}}});
            volume::test::addQuad(house.volume, ground,
                                  {{{-5, -4, -0.9}, {15, -4, -0.9}, {15, 5, -0.9}, {-5, 5, -0.9}}});
        }
        drawing::SectionOptions options;
        options.beyond.visible = true;
        auto drawn = *drawing::drawSection(house.volume, *drawing::elevationPlane("south", house.volume), options);
        const double zero = drawn.axes.planeFromWorld({0, 0, hasTerrain ? -0.4 : 0.0}).v;
        const std::vector<std::uint8_t> isAround = drawing::labelsAroundBuilding(house.volume);
        hideBelowGround(drawn, house.volume, drawing::findLevels(house.volume), isAround);
        std::size_t hidden = 0;
        for (const drawing::BeyondLine& line : drawn.beyond) {
            const double middle = 0.5 * (line.from.v + line.to.v);
            EXPECT_EQ(line.kind == drawing::BeyondKind::Hidden, middle < zero - 0.01) << middle;
            if (line.kind == drawing::BeyondKind::Hidden) {
                EXPECT_EQ(isAround[line.label], 0);
            }
            hidden += line.kind == drawing::BeyondKind::Hidden ? 1 : 0;
        }
        EXPECT_EQ(hidden >= 3, !hasTerrain);
    }
}

// A space in the open air reaches higher than the roof, and so does a tree.
TEST(LevelMarks, TheHighestIsThatOfTheHull) {
    House house;
    house.addRow(3, 3);
    house.add("terrace", "BuildingRoom", {0, 0, 3}, {9.8, 1.9, 5.67});
    house.add("tree", "BuildingConstructiveElement", {4, 2, 0}, {5, 3, 4.56}).attributes = {
        {"ifcType", std::string("IfcBuildingElementProxy"), ""}};
    house.volume.labels.labels.back().name = "Tree";
    drawing::SheetSet set;
    set.tables = false;
    const auto sheets = house.sheets({.scale = 100, .paper = "A2"}, set);
    EXPECT_GT(countTexts(sheets, ".='+3.00'"), 0u);
    EXPECT_EQ(countTexts(sheets, ".='+5.67' or .='+4.56'"), 0u);
}

// The pieces of a flat site have no lines between them in a plan; its outer edges stay. Before, lines ran from the corners
// of the house to the edge of the drawing.
TEST(TerrainLines, PiecesOfASiteJoin) {
    House house;
    house.addRow(3, 3);
    const auto site = static_cast<std::uint32_t>(house.volume.labels.labels.size());
    volume::test::addObject(house.volume, "site ground", "TINRelief").filling = volume::Filling::Solid;
    volume::test::addBoxMesh(house.volume, site, {-6, -6, -1}, {4, 0, 0});
    volume::test::addBoxMesh(house.volume, site, {4, -6, -1}, {14, 0, 0});
    drawing::SectionOptions options;
    options.beyond.visible = true;
    auto drawn = *drawing::drawSection(house.volume, {{0, 0, 1}, {0, 0, 1.1}}, options);
    const std::vector<std::uint8_t> isAround = drawing::labelsAroundBuilding(house.volume);
    ASSERT_EQ(isAround[site], 1);
    const auto linesAt = [&](double x) {
        const double u = drawn.axes.planeFromWorld({x, 0, 0}).u;
        return std::count_if(drawn.beyond.begin(), drawn.beyond.end(), [&](const drawing::BeyondLine& line) {
            return line.label == site && std::abs(line.from.u - u) < 1e-4 && std::abs(line.to.u - u) < 1e-4;
        });
    };
    removeTerrainJoints(drawn, house.volume, isAround);
    EXPECT_EQ(linesAt(4), 0);
    EXPECT_EQ(linesAt(-6), 1);
    EXPECT_EQ(linesAt(14), 1);
    // A step of 20 cm is a line.
    volume::test::addBoxMesh(house.volume, site, {14, -6, -1}, {16, 0, -0.2});
    drawn = *drawing::drawSection(house.volume, {{0, 0, 1}, {0, 0, 1.1}}, options);
    removeTerrainJoints(drawn, house.volume, isAround);
    EXPECT_EQ(linesAt(14), 1);
}

struct GroundOf {
    std::size_t layers = 0, assumed = 0;
    friend bool operator==(const GroundOf&, const GroundOf&) = default;
};
GroundOf groundOf(const House& house) {
    drawing::SheetSet set;
    set.tables = false;
    GroundOf ground;
    for (const std::string& sheet : house.sheets({.scale = 100, .paper = "A3"}, set)) {
        ground.layers += SvgFile(sheet).count("//g[@inkscape:label='Ground']");
        ground.assumed += SvgFile(sheet).count("//text[.='Ground line assumed at the ground floor']");
    }
    return ground;
}

// Without terrain, elevations had no ground line.
TEST(GroundLine, OfElevationsIsAssumedWhereTheModelHasNone) {
    House house;
    house.addRow(3, 3);
    EXPECT_EQ(groundOf(house), (GroundOf{4, 4}));
    house.add("ground", "GroundSurface", {0, 0, -0.2}, {9.8, 1.9, -0.2});
    EXPECT_EQ(groundOf(house), (GroundOf{4, 0}));
}

// Terrain that rises to the east, only on the northern side of the house.
TEST(GroundLine, FollowsTheTerrainBeforeTheBuilding) {
    House house;
    house.addRow(3, 3);  // 9.8 x 1.9 m
    const auto ground = static_cast<std::uint32_t>(house.volume.labels.labels.size());
    volume::test::addObject(house.volume, "ground", "TINRelief").filling = volume::Filling::Surface;
    volume::test::addQuad(house.volume, ground, {{{-5, 1.9, -0.5}, {15, 1.9, 1.5}, {15, 9, 1.5}, {-5, 9, -0.5}}});
    const auto linesOf = [&](const char* side) {
        drawing::SectionOptions options;
        options.beyond.visible = true;
        const auto plane = *drawing::elevationPlane(side, house.volume);
        const auto drawn = *drawing::drawSection(house.volume, plane, options);
        const auto levels = drawing::findLevels(house.volume);
        return std::pair(drawn.axes, drawGroundBefore(drawn, house.volume, levels, 10));
    };
    const auto [axes, north] = linesOf("north");
    ASSERT_EQ(north.shapes.bold.size(), 1u);
    EXPECT_FALSE(north.isAssumed);
    for (const PlanePoint& p : north.shapes.bold.front()) {
        const Vec3d world = axes.worldFromPlane({p.u / 10, p.v / 10});
        EXPECT_NEAR(world.z, 0.1 * world.x, 1e-6);
    }
    EXPECT_NEAR(std::abs(north.shapes.bold.front().front().u - north.shapes.bold.front().back().u), 200, 1e-3);
    EXPECT_TRUE(linesOf("south").second.isAssumed) << "no terrain before this wall";
}

// A plan ends at the floor below: the ground beside a lower storey is not in the plan of the third.
TEST(PlanDepth, EndsAtTheFloorBelow) {
    House house;
    house.addRow(2, 3);
    house.add("ground", "BuildingConstructiveElement", {-5, -5, -0.4}, {12, 8, -0.2});
    for (int n = 1; n <= 2; ++n) {
        volume::test::addGroup(house.volume, fmt::format("upper{}", n), "Storey", 1).name = fmt::format("OG{}", n);
        house.storey = static_cast<std::uint32_t>(house.volume.labels.labels.size() - 1);
        house.add(fmt::format("room of {}", n), "BuildingRoom", {0.2, 0.2, 3.0 * n}, {6, 1.7, 3.0 * n + 2.6});
    }
    const SheetContent content = house.content();
    const auto seesGround = [&](std::size_t view) {
        return std::any_of(
            content.views[view].drawing.beyond.begin(), content.views[view].drawing.beyond.end(),
            [&](const drawing::BeyondLine& line) { return house.volume.labels.labels[line.label].id == "ground"; });
    };
    ASSERT_GE(content.views.size(), 3u);
    EXPECT_TRUE(seesGround(0));
    EXPECT_FALSE(seesGround(2));
}

}  // namespace
}  // namespace svt::writers
