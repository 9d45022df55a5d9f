// Small files that refer to the same records again and again: what they stand for is bounded, and the rest of them is read.
#include <svt/core/machine.hpp>
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/step/read_guard.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <string>

namespace svt::readers {
namespace {

using namespace test;

// Of processor time, for one file. The budgets of the reader allow for some tenths of it.
constexpr double kMostSeconds = kIsSanitized ? 60 : 3;

struct BudgetOutcome {
    Code error = Code::Internal;  // where there is no model
    std::string findings;
    std::size_t points = 0, attributes = 0, materials = 0;
    bool hasSound = false;  // the wall 'sound' has its shape
    double seconds = 0;     // of processor time
};

// A file with `records`, and a wall 'sound' that has nothing to do with them.
BudgetOutcome readBeside(const std::string& records, const std::string& walls = "#100",
                         double mostSeconds = kMostSeconds) {
    const std::string text = ifcFile(records +
                                         "\n#900=IFCWALL('sound',$,'Sound',$,$,#15,#901,$,$);\n"
                                         "#901=IFCPRODUCTDEFINITIONSHAPE($,$,(#902));\n"
                                         "#902=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#903));\n"
                                         "#903=IFCBLOCK(#14,1000.,1000.,1000.);\n",
                                     walls + ",#900");
    Diagnostics log;
    const std::clock_t begin = std::clock();
    const auto model = readText(text, &log);
    BudgetOutcome outcome;
    outcome.seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_LT(outcome.seconds, mostSeconds);
    for (const Diagnostic& d : log.items()) outcome.findings += d.toString() + "\n";
    if (!model) {
        outcome.error = model.error().code();
        outcome.findings += model.error().toString();
        return outcome;
    }
    for (const model::Polygon& polygon : model->polygons) outcome.points += polygon.points.size();
    for (const model::Feature& feature : model->features) {
        outcome.attributes += feature.attributes.size();
        if (feature.id == "sound") outcome.hasSound = feature.geometries.size() == 1;
    }
    outcome.materials = model->materials.size();
    return outcome;
}

// The wall #100 with the item #200.
std::string wall(const std::string& records) {
    return "#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
           "#102=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#200));\n" +
           records;
}

std::string repeated(const std::string& id, int times) {
    std::string list = id;
    for (int i = 1; i < times; ++i) list += "," + id;
    return list;
}

void expectLeftOut(const BudgetOutcome& outcome) {
    EXPECT_TRUE(outcome.hasSound) << outcome.findings;
    EXPECT_NE(outcome.findings.find("E133"), std::string::npos) << outcome.findings;
    EXPECT_NE(outcome.findings.find("the limit for one product"), std::string::npos) << outcome.findings;
    EXPECT_EQ(outcome.points, 24U);  // of the sound wall alone
}

// Curves that trim each other, `length` of them around a triangle, extruded.
std::string trimmedChain(int length) {
    std::string text = fmt::format(
                           "#200=IFCEXTRUDEDAREASOLID(#201,#14,#11,1000.);\n"
                           "#201=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#{});\n",
                           999 + length) +
                       "#210=IFCCARTESIANPOINT((500.,0.));\n#211=IFCCARTESIANPOINT((500.,500.));\n"
                       "#999=IFCPOLYLINE((#16,#210,#211,#16));\n";
    for (int i = 1000; i < 1000 + length; ++i)
        text += fmt::format("#{}=IFCTRIMMEDCURVE(#{},(#16),(#211),.T.,.CARTESIAN.);\n", i, i - 1);
    return wall(text);
}

TEST(IfcBudget, CurvesThatTrimEachOtherAreReadOnce) {
    const BudgetOutcome outcome = readBeside(trimmedChain(30));
    EXPECT_TRUE(outcome.hasSound);
    EXPECT_EQ(outcome.findings.find("E13"), outcome.findings.find("E134")) << outcome.findings;
    EXPECT_EQ(outcome.points, 24U + 18U);
}

// Of processor time, for twenty readings; the least of several measurements.
double secondsOfReading(const std::string& text) {
    const std::string file = ifcFile(text, "#100");
    double least = 1e9;
    for (int round = 0; round < 7; ++round) {
        const std::clock_t begin = std::clock();
        for (int n = 0; n < 20; ++n) EXPECT_TRUE(readText(file));
        least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

TEST(IfcBudget, TimeGrowsNoFasterThanTheCurvesThatTrimEachOther) {
    const double ofFive = secondsOfReading(trimmedChain(5));
    EXPECT_LT(secondsOfReading(trimmedChain(15)), 3 * ofFive);
    EXPECT_LT(secondsOfReading(trimmedChain(30)), 6 * ofFive);
}

TEST(IfcBudget, MappedItemsOfMappedItems) {
    std::string text =
        "#999=IFCBLOCK(#14,100.,100.,100.);\n"
        "#300=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#10,1.,$);\n"
        "#200=IFCMAPPEDITEM(#2090,#300);\n";
    for (int i = 0; i < 10; ++i)
        text += fmt::format(
            "#{0}=IFCREPRESENTATIONMAP(#14,#{1});\n#{1}=IFCSHAPEREPRESENTATION(#20,'Body','MappedRepresentation',({2}))"
            ";\n"
            "#{3}=IFCMAPPEDITEM(#{0},#300);\n",
            2000 + 10 * i, 2001 + 10 * i, repeated(i == 0 ? "#999" : fmt::format("#{}", 1992 + 10 * i), 10),
            2002 + 10 * i);
    expectLeftOut(readBeside(wall(text)));
}

TEST(IfcBudget, ProfilesOfProfiles) {
    std::string text =
        "#200=IFCEXTRUDEDAREASOLID(#1008,#14,#11,1000.);\n"
        "#999=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);\n";
    for (int i = 1000; i < 1009; ++i)
        text +=
            fmt::format("#{}=IFCCOMPOSITEPROFILEDEF(.AREA.,$,({}),$);\n", i, repeated(fmt::format("#{}", i - 1), 10));
    expectLeftOut(readBeside(wall(text)));
}

TEST(IfcBudget, CurvesOfCurves) {
    std::string text = "#200=IFCSWEPTDISKSOLID(#1008,10.,$,$,$);\n#998=IFCCIRCLE(#14,1000.);\n";
    for (int i = 1000; i < 1009; ++i)
        text += fmt::format("#{}=IFCCOMPOSITECURVE(({}),.F.);\n#{}=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#{});\n",
                            i, repeated(fmt::format("#{}", i + 100), 10), i + 100, i == 1000 ? 998 : i - 1);
    expectLeftOut(readBeside(wall(text)));
}

// A ring of 90,000 points carried along a line of as many.
TEST(IfcBudget, SweepsOfLongCurvesAlongLongCurves) {
    std::string text =
        "#200=IFCFIXEDREFERENCESWEPTAREASOLID(#201,#14,#1002,0.,1.,#11);\n"
        "#201=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#1002);\n#998=IFCCIRCLE(#14,1000000.);\n";
    for (int i = 1000; i < 1003; ++i)
        text += fmt::format("#{}=IFCCOMPOSITECURVE(({}),.F.);\n#{}=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#{});\n",
                            i, repeated(fmt::format("#{}", i + 100), 7), i + 100, i == 1000 ? 998 : i - 1);
    expectLeftOut(readBeside(wall(text)));
}

TEST(IfcBudget, OpeningsOfManyParts) {
    std::string text =
        "#200=IFCBLOCK(#14,1000.,1000.,1000.);\n"
        "#110=IFCOPENINGELEMENT('o',$,$,$,$,#15,#101,$,$);\n";
    for (int i = 0; i < 20000; ++i) text += fmt::format("#{}=IFCRELVOIDSELEMENT('v',$,$,$,#100,#110);\n", 10000 + i);
    const BudgetOutcome outcome = readBeside(wall(text));
    EXPECT_TRUE(outcome.hasSound) << outcome.findings;
}

// Walls that share 3,000 items.
BudgetOutcome readWallsOfOneShape(int count, double mostSeconds = kMostSeconds) {
    std::string text =
                    "#200=IFCBLOCK(#14,100.,100.,100.);\n#300=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#10,1.,$);\n"
                    "#301=IFCREPRESENTATIONMAP(#14,#302);\n#302=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#200));\n"
                    "#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n",
                items, walls;
    for (int i = 0; i < 3000; ++i) {
        text += fmt::format("#{}=IFCMAPPEDITEM(#301,#300);\n", 10000 + i);
        items += fmt::format("{}#{}", i == 0 ? "" : ",", 10000 + i);
    }
    text += "#102=IFCSHAPEREPRESENTATION(#20,'Body','MappedRepresentation',(" + items + "));\n";
    for (int i = 0; i < count; ++i) {
        text += fmt::format("#{}=IFCWALL('w{}',$,'Wall',$,$,#15,#101,$,$);\n", 20000 + i, i);
        walls += fmt::format("{}#{}", i == 0 ? "" : ",", 20000 + i);
    }
    return readBeside(text, walls, mostSeconds);
}

// Reading ends before all 200 walls have their shape: the bound is the time of 150, which holds on a busy machine, too.
TEST(IfcBudget, ManyProductsOfOneLargeShapeAreRefused) {
    const BudgetOutcome ten = readWallsOfOneShape(10);
    EXPECT_TRUE(ten.hasSound) << ten.findings;
    const BudgetOutcome outcome = readWallsOfOneShape(200, std::max(kMostSeconds, 15 * ten.seconds));
    EXPECT_EQ(outcome.error, Code::InputTooBig) << outcome.findings;
    EXPECT_NE(outcome.findings.find("the limit for a file of this size"), std::string::npos) << outcome.findings;
}

TEST(IfcBudget, PropertiesOfProperties) {
    std::string text =
        "#200=IFCBLOCK(#14,1000.,1000.,1000.);\n#110=IFCRELDEFINESBYPROPERTIES('d',$,$,$,(#100),#111);\n"
        "#111=IFCPROPERTYSET('ps',$,'Pset',$,(#1008));\n#999=IFCPROPERTYSINGLEVALUE('Value',$,IFCREAL(1.),$);\n";
    for (int i = 1000; i < 1009; ++i)
        text +=
            fmt::format("#{}=IFCCOMPLEXPROPERTY('c{}',$,'use',({}));\n", i, i, repeated(fmt::format("#{}", i - 1), 30));
    const BudgetOutcome outcome = readBeside(wall(text));
    EXPECT_TRUE(outcome.hasSound) << outcome.findings;
    EXPECT_NE(outcome.findings.find("attributes of this product were read in part"), std::string::npos)
        << outcome.findings;
}

// 600 properties of 2,000 walls.
TEST(IfcBudget, PropertiesOfManyProductsAreRefused) {
    std::string text, properties, walls;
    for (int i = 0; i < 2000; ++i) {
        text += fmt::format("#{}=IFCWALL('w{}',$,$,$,$,#15,$,$,$);\n", 20000 + i, i);
        if (i < 600) {
            text += fmt::format("#{}=IFCPROPERTYSINGLEVALUE('p{}',$,IFCREAL(1.),$);\n", 10000 + i, i);
            properties += fmt::format("{}#{}", i == 0 ? "" : ",", 10000 + i);
        }
        walls += fmt::format("{}#{}", i == 0 ? "" : ",", 20000 + i);
    }
    text += fmt::format(
        "#110=IFCRELDEFINESBYPROPERTIES('d',$,$,$,({}),#111);\n#111=IFCPROPERTYSET('ps',$,'Pset',$,({}));\n", walls,
        properties);
    EXPECT_EQ(readBeside(text, walls).error, Code::InputTooBig);
}

// A list of 2,000 colours in 2,000 maps.
TEST(IfcBudget, ColoursOfManyMapsAreRefused) {
    std::string text =
        "#200=IFCBLOCK(#14,1000.,1000.,1000.);\n#110=IFCCOLOURRGBLIST((" + repeated("(1.,0.,0.)", 2000) + "));\n";
    for (int i = 0; i < 2000; ++i) text += fmt::format("#{}=IFCINDEXEDCOLOURMAP(#200,1.,#110,(1));\n", 10000 + i);
    EXPECT_EQ(readBeside(wall(text)).error, Code::InputTooBig);
}

// A product has half of what is free of the file, so one that is too large leaves enough for the others.
TEST(IfcBudget, OneProductDoesNotTakeAll) {
    Diagnostics log;
    const auto step =
        step::StepFile::scan("ISO-10303-21;\nDATA;\n#1=IFCWALL('a');\nENDSEC;\nEND-ISO-10303-21;\n", "a", log);
    ASSERT_TRUE(step);
    step::ReadGuard guard(*step);
    guard.beginProduct();
    EXPECT_TRUE(guard.takeElements(400'000));
    EXPECT_FALSE(guard.takeElements(400'000));
    EXPECT_TRUE(guard.isSpent());
    EXPECT_FALSE(guard.isFileSpent());
    guard.beginProduct();
    EXPECT_TRUE(guard.takeElements(100'000));
    EXPECT_FALSE(guard.affords(450'000));
    EXPECT_TRUE(guard.isFileSpent());  // 900,000 taken, so many are not left
}

}  // namespace
}  // namespace svt::readers
