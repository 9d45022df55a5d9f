#include <svt/readers/ifc_quantities.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace svt::readers {
namespace {

constexpr const char* kWallId = "2XPyKWY018sA1ygZKgQPtU";

// A file with a wall, a door, and a set with quantities of another wall; lengths in millimetres, areas in square metres.
std::string smallIfc(const std::string& schema, const std::string& end, const std::string& more = "") {
    std::string text;
    for (const std::string& line :
         {std::string("ISO-10303-21;"), std::string("HEADER;"), "FILE_SCHEMA(('" + schema + "'));",
          std::string("ENDSEC;"), std::string("DATA;"), std::string("#1=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);"),
          std::string("#2=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.);"), std::string("#3=IFCUNITASSIGNMENT((#1,#2));"),
          std::string("#4=IFCPROJECT('0000000000000000000001',#9,'P',$,$,$,$,(),#3);"),
          "#5=IFCWALL('" + std::string(kWallId) + "',#9,'Wall',$,$,$,$,$);",
          std::string("#6=IFCDOOR('2XPyKWY018sA1ygZKgQPtV',#9,'Door',$,$,$,$,$);"),
          std::string("#70=IFCWALL('2XPyKWY018sA1ygZKgQPtW',#9,'Other',$,$,$,$,$);"),
          std::string("#8=IFCELEMENTQUANTITY('0000000000000000000002',#9,'Qto_WallBaseQuantities',$,$,());"),
          std::string("#10=IFCRELDEFINESBYPROPERTIES('0000000000000000000003',#9,$,$,(#70),#8);"), more,
          std::string("ENDSEC;"), std::string("END-ISO-10303-21;")})
        if (!line.empty()) text += line + end;
    return text;
}

std::vector<IfcElementQuantities> someQuantities() {
    const std::vector<IfcQuantity> all{{"Length", 4.29}, {"NetSideArea", 10.5}, {"NetVolume", 2.502}, {"Perimeter", 1}};
    return {{kWallId, all},
            {"2XPyKWY018sA1ygZKgQPtV", all},
            {"2XPyKWY018sA1ygZKgQPtW", all},
            {"2XPyKWY018sA1ygZKgQPtX", all}};
}

TEST(IfcQuantities, FollowTheLastRecordInTheUnitsOfTheFile) {
    const std::string text = smallIfc("IFC4", "\n");
    const auto copy = addIfcQuantities(text, "small.ifc", someQuantities());
    ASSERT_TRUE(copy.hasValue()) << copy.error().message();
    EXPECT_EQ(copy->elements, 1u);
    EXPECT_EQ(copy->otherTypes, 1u) << "the door";
    EXPECT_EQ(copy->keptSets, 1u);
    EXPECT_EQ(copy->missing, 1u);
    const std::size_t end = text.rfind("ENDSEC;");
    EXPECT_EQ(copy->text.substr(0, end), text.substr(0, end));
    EXPECT_TRUE(copy->text.ends_with(text.substr(end)));
    const std::string added = copy->text.substr(end, copy->text.size() - text.size());
    // The missing unit of volume is the cube of the millimetre.
    EXPECT_EQ(added.find("#71=IFCQUANTITYLENGTH('Length',$,$,4290.,$);\n"
                         "#72=IFCQUANTITYAREA('NetSideArea',$,$,10.5,$);\n"
                         "#73=IFCQUANTITYVOLUME('NetVolume',$,$,2502000000.,$);\n"
                         "#74=IFCELEMENTQUANTITY('"),
              0u)
        << added;
    EXPECT_NE(added.find(",#9,'Qto_WallBaseQuantities',$,'svt quantities',(#71,#72,#73));\n"), std::string::npos);
    EXPECT_NE(added.find(",#9,$,$,(#5),#74);\n"), std::string::npos) << added;
}

TEST(IfcQuantities, KeepTheFormOfTheFile) {
    const std::string text = "\xEF\xBB\xBF" + smallIfc("IFC2X3", "\r\n");
    const auto copy = addIfcQuantities(text, "small.ifc", someQuantities());
    ASSERT_TRUE(copy.hasValue()) << copy.error().message();
    EXPECT_EQ(copy->text.find("\xEF\xBB\xBFISO-10303-21;\r\n"), 0u);
    EXPECT_NE(copy->text.find("#71=IFCQUANTITYLENGTH('Length',$,$,4290.);\r\n"), std::string::npos) << copy->text;
    EXPECT_EQ(std::count(copy->text.begin(), copy->text.end(), '\n'),
              std::count(copy->text.begin(), copy->text.end(), '\r'));
}

TEST(IfcQuantities, RefuseFilesThatAreNotWhole) {
    const std::string text = smallIfc("IFC4", "\n");
    const auto isRefused = [](const std::string& file) {
        return !addIfcQuantities(file, "small.ifc", someQuantities()).hasValue();
    };
    EXPECT_TRUE(isRefused(text.substr(0, text.rfind("ENDSEC;"))));
    EXPECT_TRUE(isRefused(text.substr(0, text.size() / 2)));
    EXPECT_TRUE(isRefused("not a file"));
    EXPECT_TRUE(isRefused(smallIfc("AUTOMOTIVE_DESIGN", "\n")));
    EXPECT_TRUE(isRefused(smallIfc("IFC4", "\n", "#80=IFCWALL('a quote that is never closed);")));
    EXPECT_TRUE(isRefused(smallIfc("IFC4", "\n", "#4294967290=IFCPOLYLINE(());")));
}

// Two records with one GlobalId: the element that is meant is unknown.
TEST(IfcQuantities, NeedOneElement) {
    const std::string text =
        smallIfc("IFC4", "\n", "#80=IFCWALL('" + std::string(kWallId) + "',#9,'Again',$,$,$,$,$);");
    const auto copy = addIfcQuantities(text, "small.ifc", someQuantities());
    ASSERT_TRUE(copy.hasValue()) << copy.error().message();
    EXPECT_EQ(copy->elements, 0u);
    EXPECT_EQ(copy->missing, 2u);
    EXPECT_EQ(copy->text, text);
}

}  // namespace
}  // namespace svt::readers
