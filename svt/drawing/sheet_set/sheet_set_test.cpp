/// Sets of sheets as JSON: the same back, and what is wrong is told with its place.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/sheet_set.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

TEST(SheetSet, WhatIsWrittenIsReadAgain) {
    SheetSet set;
    set.title = "Haus \u00A7 5";
    set.paper = "A2";
    set.language = "de";
    set.scale = 50;
    set.tables = false;
    set.hide = {"class=BuildingFurniture"};
    set.sheets = {{"Grundrisse", 0, {{"storey=EG+1.1", "", "", "EG", false}}},
                  {"", 20, {{"", "x>4", "", "A", true}, {"", "", "north", "", false}}}};
    const auto read = parseSheetSet(writeSheetSet(set));
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(*read, set);
}

TEST(SheetSet, TheChosenViewsComeBack) {
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0.3, 0.3, 0.2}, {7.8, 5.7, 2.7});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {0.3, 6, 6});
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    const SheetSet set = sheetSetOf(*chosen, boxes.volume);
    EXPECT_EQ(set.sheets.size(), 3u);
    const auto again = viewsOfSet(*parseSheetSet(writeSheetSet(set)), boxes.volume);
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->views.size(), chosen->views.size());
    for (std::size_t n = 0; n < again->views.size(); ++n) {
        const SheetView &a = again->views[n], &b = chosen->views[n];
        EXPECT_EQ(a.kind, b.kind);
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.floor, b.floor);
        EXPECT_EQ(a.beyond.above, b.beyond.above);
        EXPECT_NEAR(length(a.plane.normal - b.plane.normal), 0, 1e-9);
        EXPECT_NEAR(dot(a.plane.point - b.plane.point, b.plane.normal), 0, 1e-5);
    }
}

TEST(SheetSet, WhatIsWrongIsToldWithItsPlace) {
    const auto messageOf = [](const std::string& members) {
        const auto set = parseSheetSet("{\"format\": \"svt-sheets\", " + members + "}", "my");
        EXPECT_FALSE(set) << members;
        return set ? std::string() : set.error().message();
    };
    EXPECT_NE(messageOf("\"sheets\": [{\"views\": [{\"plan\": \"z=1\", \"scal\": 5}]}]").find("/sheets/0/views/0"),
              std::string::npos);
    EXPECT_NE(messageOf("\"sheets\": [{\"views\": [{\"plan\": \"z=1\", \"section\": \"x>1\"}]}]").find("one of plan"),
              std::string::npos);
    EXPECT_NE(messageOf("\"sheets\": [{\"views\": [{\"name\": \"A\"}]}]").find("one of plan"), std::string::npos);
    EXPECT_NE(messageOf("\"sheets\": [{\"views\": [{\"elevation\": \"up\"}]}]").find("north"), std::string::npos);
    EXPECT_NE(messageOf("\"sheets\": [{\"title\": \"x\"}]").find("views"), std::string::npos);
    EXPECT_NE(messageOf("\"sheets\": []").find("array"), std::string::npos);
    EXPECT_NE(messageOf("\"sheets\": 5").find("array"), std::string::npos);
    EXPECT_NE(messageOf("\"paper\": \"A9\"").find("A4"), std::string::npos);
    EXPECT_NE(messageOf("\"scale\": -1").find("/scale"), std::string::npos);
    EXPECT_NE(messageOf("\"tables\": 1").find("true or false"), std::string::npos);
    EXPECT_EQ(parseSheetSet("{").error().code(), Code::BadJson);
    EXPECT_EQ(parseSheetSet("[]").error().code(), Code::BadSheets);
    EXPECT_EQ(parseSheetSet("{}").error().code(), Code::BadSheets);
}

TEST(SheetSet, PlansAreHorizontalAndSectionsAreNot) {
    Boxes boxes;
    boxes.addBox("house", "Building", {0, 0, 0}, {8, 6, 3});
    SheetSet set;
    set.sheets = {{"", 0, {{"x>4", "", "", "", false}}}};
    EXPECT_EQ(viewsOfSet(set, boxes.volume).error().code(), Code::BadSection);
    set.sheets = {{"", 0, {{"", "z=1", "", "", false}}}};
    EXPECT_EQ(viewsOfSet(set, boxes.volume).error().code(), Code::BadSection);
    set.sheets = {{"", 0, {{"z=100", "", "", "", false}}}};
    EXPECT_EQ(viewsOfSet(set, boxes.volume).error().code(), Code::BadSection);
}

}  // namespace
}  // namespace svt::drawing
