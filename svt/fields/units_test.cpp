#include <svt/fields/units.hpp>

#include <gtest/gtest.h>

#include <set>

namespace svt::fields {
namespace {

TEST(Units, CodesAndSpellingsAreUnique) {
    std::set<std::string_view> seen;
    for (const Unit& unit : units()) EXPECT_TRUE(seen.insert(unit.code).second) << unit.code;
    EXPECT_GE(units().size(), 40u);
    for (const Unit& unit : units()) EXPECT_EQ(unitCode(unit.code), std::string(unit.code));
}

TEST(Units, KnowsTheSpellingsOfOtherPrograms) {
    EXPECT_EQ(unitCode("C"), "Cel");
    EXPECT_EQ(unitCode(" °C "), "Cel");
    EXPECT_EQ(unitCode("Celsius"), "Cel");
    EXPECT_EQ(unitCode("mol/mol"), "1");
    EXPECT_EQ(unitCode("kW/m^3"), "kW/m3");
    EXPECT_EQ(unitCode("ppm"), "[ppm]");
    EXPECT_EQ(unitCode("K"), "K");
    EXPECT_EQ(unitText("Cel"), "°C");
    EXPECT_EQ(unitText("1"), "");
}

TEST(Units, KeepsUnknownCodesAndRejectsOtherTexts) {
    EXPECT_EQ(unitCode("mol/m2"), "mol/m2");
    EXPECT_EQ(unitText("mol/m2"), "mol/m2");
    EXPECT_FALSE(unitCode(""));
    EXPECT_FALSE(unitCode("deg C"));
    EXPECT_FALSE(unitCode(std::string(41, 'm')));
}

TEST(Units, ConvertsOnlyTemperatures) {
    EXPECT_EQ(unitConversion("K", "Cel"), (UnitConversion{1, -273.15}));
    EXPECT_EQ(unitConversion("Cel", "K"), (UnitConversion{1, 273.15}));
    EXPECT_EQ(unitConversion("m", "m"), UnitConversion{});
    EXPECT_FALSE(unitConversion("m", "mm"));
}

}  // namespace
}  // namespace svt::fields
