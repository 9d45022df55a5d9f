/// Words for classes and types.

#include <svt/writers/sheets/class_words.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>

#include <gtest/gtest.h>

namespace svt::writers {
namespace {

TEST(ClassWords, AreThoseOfTheTradeInBothLanguages) {
    EXPECT_EQ(classWord("IfcWallStandardCase", SheetLanguage::English), "Wall");
    EXPECT_EQ(classWord("IfcWallStandardCase", SheetLanguage::German), "Wand");
    EXPECT_EQ(classWord("IfcSlab", SheetLanguage::German), "Decke");
    EXPECT_EQ(classWord("BuildingConstructiveElement", SheetLanguage::English), "Component");
    EXPECT_EQ(classWord("IfcStairFlight", SheetLanguage::English), "Flight of stairs");
    EXPECT_EQ(classWord("wall", SheetLanguage::German), "Wand") << "a function";
}

TEST(ClassWords, UnknownNamesAreSplit) {
    EXPECT_EQ(classWord("IfcFlowInstrument", SheetLanguage::English), "Flow instrument");
    EXPECT_EQ(classWord("IfcUPSDevice", SheetLanguage::German), "UPS device");
    EXPECT_EQ(classWord("IfcUPSDevice", SheetLanguage::English), "UPS device");
    EXPECT_EQ(classWord("noise:NoiseBarrier", SheetLanguage::English), "Noise barrier");
    EXPECT_EQ(classWord("Ifc", SheetLanguage::English), "Ifc");
    EXPECT_EQ(classWord("", SheetLanguage::English), "");
}

drawing::FloorAreas areasOf(std::vector<drawing::ComponentSum> components) {
    drawing::FloorAreas areas;
    areas.components = std::move(components);
    return areas;
}

// Both types are walls; the third has an unknown area, which no sum may hide.
TEST(ComponentTable, HasARowPerWord) {
    const drawing::FloorAreas areas = areasOf({{"BuildingConstructiveElement", "IfcWall", 2, 10, 3},
                                               {"BuildingConstructiveElement", "IfcWallStandardCase", 3, 20, 4},
                                               {"BuildingConstructiveElement", "IfcWallElementedCase", 1, 0, 0},
                                               {"Window", "", 4, 5, 1}});
    const std::vector<SheetTable> tables = makeAreaTables(areas, {}, SheetLanguage::German);
    ASSERT_EQ(tables.size(), 1u);
    using Rows = std::vector<std::vector<std::string>>;
    EXPECT_EQ(
        tables[0].rows,
        (Rows{{"Fenster", "4", "5,00", "1,00"}, {"Wand", "5", "30,00", "7,00"}, {"Wand", "1", "\u2013", "\u2013"}}));
    EXPECT_EQ(tables[0].columns.front().heading, "Bauteil");
}

}  // namespace
}  // namespace svt::writers
