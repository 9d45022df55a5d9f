// Volumes of each kind of shape, known in closed form. Polygons stand for circles, so their volumes are those of regular
// polygons, or a little less than those of the round bodies.
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/ifc_shape/body.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace svt::readers {
namespace {

using namespace test;

constexpr double kPiTest = std::numbers::pi;

struct ShapeRead {
    double volume = 0;
    bool isClosed = true;
    std::size_t solids = 0, faces = 0;
    std::string findings;
};

// Of the product with this id; NaN where it has no geometry.
ShapeRead readShapeOf(const std::string& text, const std::string& id = "wall") {
    Diagnostics log;
    const auto model = readText(text, &log);
    ShapeRead read;
    for (const Diagnostic& d : log.items())
        if (d.code != Code::ProductsRead) read.findings += d.toString() + "\n";
    if (!model) {
        read.findings += model.error().message();
        return read;
    }
    for (const model::Feature& feature : model->features) {
        if (feature.id != id || feature.geometries.empty()) continue;
        for (const model::Solid& solid : feature.geometries[0].solids) {
            std::vector<model::Polygon> faces;
            for (const model::SurfaceUse use : solid.exterior) faces.push_back(model->polygons[use.polygon]);
            ++read.solids;
            read.faces += faces.size();
            read.volume += ifc::enclosedVolume(faces);
            read.isClosed = read.isClosed && ifc::isClosed(faces);
        }
    }
    return read;
}

void expectVolume(const std::string& text, double volume, double tolerance = 1e-9) {
    const ShapeRead read = readShapeOf(text);
    EXPECT_NEAR(read.volume, volume, tolerance * volume);
    EXPECT_TRUE(read.isClosed);
    EXPECT_EQ(read.findings, "");
}

TEST(IfcShapes, ExtrudesAndInclines) {
    expectVolume(ifcWithProfile("#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);"), 0.06);
    expectVolume(ifcWithItem("#200=IFCEXTRUDEDAREASOLID(#300,#14,#201,2000.);\n#201=IFCDIRECTION((0.,0.6,-0.8));\n"
                             "#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);"),
                 0.06 * 1.6);
}

TEST(IfcShapes, TapersBetweenProfiles) {
    // A frustum: h / 3 (A + B + sqrt(A B)).
    expectVolume(ifcWithItem("#200=IFCEXTRUDEDAREASOLIDTAPERED(#300,#14,#11,3000.,#301);\n"
                             "#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,2000.,2000.);\n"
                             "#301=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,1000.,1000.);"),
                 4 + 1 + 2);
}

TEST(IfcShapes, RoundProfilesWithinTheirChordError) {
    const double r = 0.1, inner = 0.09;
    const double share = 48 * std::sin(2 * kPiTest / 48) / (2 * kPiTest);  // of a polygon of 48 corners
    expectVolume(ifcWithProfile("#300=IFCCIRCLEPROFILEDEF(.AREA.,$,#17,100.);"), share * kPiTest * r * r);
    expectVolume(ifcWithProfile("#300=IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,#17,100.,10.);"),
                 share * kPiTest * (r * r - inner * inner));
    expectVolume(ifcWithProfile("#300=IFCELLIPSEPROFILEDEF(.AREA.,$,#17,100.,50.);"), share * kPiTest * r * 0.05);
}

TEST(IfcShapes, RectanglesRoundedAndHollow) {
    const double corner = (4 - kPiTest) * 0.02 * 0.02;
    expectVolume(ifcWithProfile("#300=IFCROUNDEDRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.,20.);"), 0.06 - corner,
                 2e-4);
    expectVolume(ifcWithProfile("#300=IFCRECTANGLEHOLLOWPROFILEDEF(.AREA.,$,#17,200.,300.,10.,$,$);"),
                 0.06 - 0.18 * 0.28);
}

TEST(IfcShapes, RolledSections) {
    // Two flanges and the web.
    expectVolume(ifcWithProfile("#300=IFCISHAPEPROFILEDEF(.AREA.,$,#17,100.,200.,10.,20.,$,$,$);"),
                 2 * 0.1 * 0.02 + 0.16 * 0.01);
    const double fillet = (1 - kPiTest / 4) * 0.012 * 0.012;
    expectVolume(ifcWithProfile("#300=IFCISHAPEPROFILEDEF(.AREA.,$,#17,100.,200.,10.,20.,12.,$,$);"),
                 2 * 0.1 * 0.02 + 0.16 * 0.01 + 4 * fillet, 1e-3);
    expectVolume(
        ifcWithProfile("#300=IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$,#17,100.,200.,10.,20.,$,80.,15.,$,$,$,$,$);"),
        0.1 * 0.02 + 0.08 * 0.015 + 0.165 * 0.01);
    expectVolume(ifcWithProfile("#300=IFCLSHAPEPROFILEDEF(.AREA.,$,#17,100.,80.,10.,$,$,$);"),
                 0.1 * 0.01 + 0.07 * 0.01);
    expectVolume(ifcWithProfile("#300=IFCTSHAPEPROFILEDEF(.AREA.,$,#17,100.,80.,10.,12.,$,$,$,$,$);"),
                 0.08 * 0.012 + 0.088 * 0.01);
    expectVolume(ifcWithProfile("#300=IFCUSHAPEPROFILEDEF(.AREA.,$,#17,100.,60.,8.,10.,$,$,$);"),
                 0.1 * 0.008 + 2 * 0.052 * 0.01);
    expectVolume(ifcWithProfile("#300=IFCCSHAPEPROFILEDEF(.AREA.,$,#17,100.,60.,5.,20.,$);"),
                 0.1 * 0.005 + 2 * 0.055 * 0.005 + 2 * 0.015 * 0.005);
    expectVolume(ifcWithProfile("#300=IFCZSHAPEPROFILEDEF(.AREA.,$,#17,100.,60.,8.,10.,$,$);"),
                 0.1 * 0.008 + 2 * 0.052 * 0.01);
}

TEST(IfcShapes, SlopesKeepTheAreaOfTheFlanges) {
    // The thickness is that in the middle of what stands out, so the area is that without a slope.
    expectVolume(ifcWithProfile("#300=IFCISHAPEPROFILEDEF(.AREA.,$,#17,100.,200.,10.,20.,$,$,0.1);"),
                 2 * 0.1 * 0.02 + 0.16 * 0.01, 1e-9);
}

TEST(IfcShapes, TrapeziumAndLinesAsProfiles) {
    expectVolume(ifcWithProfile("#300=IFCTRAPEZIUMPROFILEDEF(.AREA.,$,#17,400.,200.,100.,50.);"), 0.03);
    const std::string points =
        "#310=IFCCARTESIANPOINT((0.,0.));\n#311=IFCCARTESIANPOINT((1000.,0.));\n"
        "#312=IFCCARTESIANPOINT((1000.,1000.));\n#313=IFCCARTESIANPOINT((0.,1000.));\n";
    expectVolume(
        ifcWithProfile("#300=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#301);\n#301=IFCPOLYLINE((#310,#311,#312,#313,"
                       "#310));\n" +
                       points),
        1);
    expectVolume(
        ifcWithProfile("#300=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#301,(#302));\n#302=IFCCIRCLE(#303,100.);\n"
                       "#303=IFCAXIS2PLACEMENT2D(#304,$);\n#304=IFCCARTESIANPOINT((500.,500.));\n"
                       "#301=IFCPOLYLINE((#310,#311,#312,#313,#310));\n" +
                       points),
        1 - kPiTest * 0.01, 1e-4);
    expectVolume(
        ifcWithProfile("#300=IFCCENTERLINEPROFILEDEF(.AREA.,$,#301,100.);\n#301=IFCPOLYLINE((#310,#311,#312));\n" +
                       points),
        0.2);
}

TEST(IfcShapes, IndexedCurvesWithArcs) {
    // A square with half a disk on its right side.
    expectVolume(
        ifcWithProfile(
            "#300=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#301);\n#301=IFCINDEXEDPOLYCURVE(#302,(IFCLINEINDEX((1,2)),"
            "IFCARCINDEX((2,3,4)),IFCLINEINDEX((4,5,1))),.F.);\n"
            "#302=IFCCARTESIANPOINTLIST2D(((0.,0.),(1000.,0.),(1500.,500.),(1000.,1000.),(0.,1000.)));"),
        1 + kPiTest / 8, 2e-3);
}

TEST(IfcShapes, CompositeCurvesOfTrimmedArcs) {
    // The same by a composite curve; the arc runs by parameters in radians.
    expectVolume(
        ifcWithProfile("#300=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#301);\n#301=IFCCOMPOSITECURVE((#302,#303),.F.);\n"
                       "#302=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#304);\n#303=IFCCOMPOSITECURVESEGMENT(."
                       "CONTINUOUS.,.T.,#305);\n"
                       "#304=IFCPOLYLINE((#310,#311,#312,#313));\n"
                       "#305=IFCTRIMMEDCURVE(#306,(IFCPARAMETERVALUE(-1.5707963267948966)),(IFCPARAMETERVALUE(1."
                       "5707963267948966)),.T.,"
                       ".PARAMETER.);\n#306=IFCCIRCLE(#307,500.);\n#307=IFCAXIS2PLACEMENT2D(#308,$);\n"
                       "#308=IFCCARTESIANPOINT((1000.,500.));\n#310=IFCCARTESIANPOINT((1000.,1000.));\n"
                       "#311=IFCCARTESIANPOINT((0.,1000.));\n#312=IFCCARTESIANPOINT((0.,0.));\n#313=IFCCARTESIANPOINT(("
                       "1000.,0.));"),
        1 + kPiTest / 8, 2e-3);
}

TEST(IfcShapes, DerivedAndCompositeProfiles) {
    expectVolume(ifcWithProfile("#300=IFCDERIVEDPROFILEDEF(.AREA.,$,#301,#302,$);\n"
                                "#301=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);\n"
                                "#302=IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$,#16,2.);"),
                 0.24);
    const ShapeRead read = readShapeOf(ifcWithProfile(
        "#300=IFCCOMPOSITEPROFILEDEF(.AREA.,$,(#301,#302),$);\n"
        "#301=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);\n#302=IFCRECTANGLEPROFILEDEF(.AREA.,$,#303,100.,100.);\n"
        "#303=IFCAXIS2PLACEMENT2D(#304,$);\n#304=IFCCARTESIANPOINT((1000.,0.));"));
    EXPECT_EQ(read.solids, 2U);
    EXPECT_NEAR(read.volume, 0.07, 1e-9);
}

TEST(IfcShapes, RevolvesWholeAndHalfTurns) {
    // Pappus: area times the way of its centre; chords make it shorter.
    const std::string solid =
        "#200=IFCREVOLVEDAREASOLID(#300,#14,#201,{});\n#201=IFCAXIS1PLACEMENT(#202,#13);\n"
        "#202=IFCCARTESIANPOINT((-1000.,0.,0.));\n#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);";
    for (const char* angle : {"3.14159265358979", "6.28318530717959", "-1.5"})
        expectVolume(ifcWithItem(fmt::format(fmt::runtime(solid), angle)), 0.06 * std::abs(std::stod(angle)), 1.5e-3);
}

TEST(IfcShapes, SweptDisksWithBends) {
    const std::string points =
        "#310=IFCCARTESIANPOINT((0.,0.,0.));\n#311=IFCCARTESIANPOINT((1000.,0.,0.));\n"
        "#312=IFCCARTESIANPOINT((1000.,1000.,0.));\n#301=IFCPOLYLINE((#310,#311,#312));\n";
    expectVolume(ifcWithItem("#200=IFCSWEPTDISKSOLID(#301,20.,$,$,$);\n" + points), 2 * kPiTest * 0.0004, 1e-6);
    expectVolume(ifcWithItem("#200=IFCSWEPTDISKSOLID(#301,20.,10.,$,$);\n" + points), 2 * kPiTest * 0.0003, 1e-6);
}

// Closed lines in a plane and in space: the volume of a bent bar is that of its straight parts.
TEST(IfcShapes, SweptDisksAlongClosedLines) {
    const auto bar = [](const std::vector<Vec3d>& points) {
        std::string records = "#200=IFCSWEPTDISKSOLID(#301,50.,$,$,$);\n", list;
        double length = 0;
        for (std::size_t n = 0; n < points.size(); ++n) {
            const Vec3d p = points[n];
            records += fmt::format("#{}=IFCCARTESIANPOINT(({:f},{:f},{:f}));\n", 310 + n, p.x, p.y, p.z);
            list += fmt::format("#{},", 310 + n);
            length += svt::length(points[(n + 1) % points.size()] - p) / 1000;
        }
        expectVolume(ifcWithItem(records + "#301=IFCPOLYLINE((" + list + "#310));\n"), length * kPiTest * 0.0025, 3e-3);
    };
    bar({{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {0, 1000, 0}});
    bar({{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {1000, 1000, 1000}, {0, 1000, 1000}, {0, 0, 1000}});
    bar({{0, 0, 0}, {1000, 0, 300}, {1200, 900, 0}, {100, 800, 500}});
    std::vector<Vec3d> ring;
    for (int n = 0; n < 8; ++n) ring.push_back({1000 * std::cos(kPiTest * n / 4), 1000 * std::sin(kPiTest * n / 4), 0});
    bar(ring);
}

TEST(IfcShapes, EndsOfSweptDisksAtParametersAreNamed) {
    const std::string points =
        "#310=IFCCARTESIANPOINT((0.,0.,0.));\n#311=IFCCARTESIANPOINT((1000.,0.,0.));\n"
        "#312=IFCCARTESIANPOINT((1000.,1000.,0.));\n#301=IFCPOLYLINE((#310,#311,#312));\n"
        "#302=IFCPOLYLINE((#310,#311));\n";
    const auto findingsOf = [&](const char* disk) {
        return readShapeOf(ifcWithItem(fmt::format("#200=IFCSWEPTDISKSOLID({});\n", disk) + points)).findings;
    };
    for (const char* part : {"#301,20.,$,0.,1.", "#301,20.,$,0.,0.5", "#301,20.,$,1.,2."})
        EXPECT_NE(findingsOf(part).find("ReadInPart"), std::string::npos) << part;
    for (const char* whole : {"#301,20.,$,0.,2.", "#301,20.,$,$,$", "#302,20.,$,0.,1.", "#301,20.,$,0.,2000."})
        EXPECT_EQ(findingsOf(whole), "") << whole;
}

// A profile of 200 x 300 mm along an L of 2 m and 3 m, with a mitre, and along a circle of radius 1 m.
TEST(IfcShapes, ProfilesAlongCurves) {
    const std::string rest =
        "#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);\n#310=IFCPOLYLINE((#311,#312,#313));\n"
        "#311=IFCCARTESIANPOINT((0.,0.,0.));\n#312=IFCCARTESIANPOINT((2000.,0.,0.));\n"
        "#313=IFCCARTESIANPOINT((2000.,3000.,0.));\n#320=IFCPLANE(#14);\n#330=IFCCIRCLE(#14,1000.);\n"
        "#340=IFCCYLINDRICALSURFACE(#14,1000.);\n";
    for (const char* sweep : {"#200=IFCFIXEDREFERENCESWEPTAREASOLID(#300,#14,#310,$,$,#11);\n",
                              "#200=IFCFIXEDREFERENCESWEPTAREASOLID(#300,$,#310,0.,1.,#11);\n",
                              "#200=IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID(#300,#14,#310,0.,2.,#11);\n",
                              "#200=IFCSURFACECURVESWEPTAREASOLID(#300,#14,#310,0.,5000.,#320);\n"})
        expectVolume(ifcWithItem(sweep + rest), 0.06 * 5);
    const ShapeRead ring =
        readShapeOf(ifcWithItem("#200=IFCFIXEDREFERENCESWEPTAREASOLID(#300,#14,#330,$,$,#11);\n" + rest));
    EXPECT_TRUE(ring.isClosed);
    EXPECT_NEAR(ring.volume, 0.06 * 2 * kPiTest, 0.002 * 0.06 * 2 * kPiTest);
    EXPECT_NE(readShapeOf(ifcWithItem("#200=IFCFIXEDREFERENCESWEPTAREASOLID(#300,#14,#310,0.5,0.7,#11);\n" + rest))
                  .findings.find("whole curve"),
              std::string::npos);
    EXPECT_NE(readShapeOf(ifcWithItem("#200=IFCSURFACECURVESWEPTAREASOLID(#300,#14,#310,$,$,#340);\n" + rest))
                  .findings.find("IFCCYLINDRICALSURFACE"),
              std::string::npos);
}

TEST(IfcShapes, Primitives) {
    expectVolume(ifcWithItem("#200=IFCCSGSOLID(#201);\n#201=IFCBLOCK(#14,1000.,2000.,3000.);"), 6);
    expectVolume(ifcWithItem("#200=IFCCSGSOLID(#201);\n#201=IFCRECTANGULARPYRAMID(#14,1000.,2000.,3000.);"), 2);
    expectVolume(ifcWithItem("#200=IFCCSGSOLID(#201);\n#201=IFCRIGHTCIRCULARCYLINDER(#14,1000.,500.);"), kPiTest / 4,
                 3e-3);
    expectVolume(ifcWithItem("#200=IFCCSGSOLID(#201);\n#201=IFCRIGHTCIRCULARCONE(#14,1000.,500.);"), kPiTest / 12,
                 3e-3);
    expectVolume(ifcWithItem("#200=IFCCSGSOLID(#201);\n#201=IFCSPHERE(#14,1000.);"), kPiTest * 4 / 3, 4e-3);
}

const char* const kCube =
    "#210=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1000.,0.,0.),(1000.,1000.,0.),(0.,1000.,0.),(0.,0.,1000.),"
    "(1000.,0.,1000.),(1000.,1000.,1000.),(0.,1000.,1000.)));\n";

TEST(IfcShapes, FaceSetsOfTrianglesAndPolygons) {
    expectVolume(
        ifcWithItem(
            std::string("#200=IFCTRIANGULATEDFACESET(#210,$,.T.,((1,3,2),(1,4,3),(5,6,7),(5,7,8),(1,2,6),(1,6,5),"
                        "(2,3,7),(2,7,6),(3,4,8),(3,8,7),(4,1,5),(4,5,8)),$);\n") +
            kCube),
        1);
    expectVolume(
        ifcWithItem(
            std::string("#200=IFCTRIANGULATEDFACESET(#210,.T.,$,((1,3,2),(1,4,3),(5,6,7),(5,7,8),(1,2,6),(1,6,5),"
                        "(2,3,7),(2,7,6),(3,4,8),(3,8,7),(4,1,5),(4,5,8)),$);\n") +
                kCube,
            "IFC4X3_ADD2"),
        1);
    const std::string polygons =
        "#200=IFCPOLYGONALFACESET(#210,.T.,(#220,#221,#222,#223,#224,#225),$);\n"
        "#220=IFCINDEXEDPOLYGONALFACE((1,4,3,2));\n#221=IFCINDEXEDPOLYGONALFACE((5,6,7,8));\n"
        "#222=IFCINDEXEDPOLYGONALFACE((1,2,6,5));\n#223=IFCINDEXEDPOLYGONALFACE((2,3,7,6));\n"
        "#224=IFCINDEXEDPOLYGONALFACE((3,4,8,7));\n#225=IFCINDEXEDPOLYGONALFACE((4,1,5,8));\n";
    expectVolume(ifcWithItem(polygons + kCube), 1);
}

TEST(IfcShapes, HalfSpacesCut) {
    const std::string box =
        "#210=IFCEXTRUDEDAREASOLID(#300,#14,#11,1000.);\n"
        "#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,1000.,1000.);\n";
    // Above an inclined plane through the middle.
    expectVolume(
        ifcWithItem("#200=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#210,#220);\n#220=IFCHALFSPACESOLID(#221,.F.);\n"
                    "#221=IFCPLANE(#222);\n#222=IFCAXIS2PLACEMENT3D(#223,#224,#12);\n"
                    "#223=IFCCARTESIANPOINT((0.,0.,500.));\n#224=IFCDIRECTION((0.,-0.6,0.8));\n" +
                    box),
        0.5);
    // A corner of 200 x 200 down to 700.
    expectVolume(ifcWithItem("#200=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#210,#220);\n"
                             "#220=IFCPOLYGONALBOUNDEDHALFSPACE(#221,.F.,#14,#225);\n#221=IFCPLANE(#222);\n"
                             "#222=IFCAXIS2PLACEMENT3D(#223,#11,#12);\n#223=IFCCARTESIANPOINT((0.,0.,700.));\n"
                             "#225=IFCPOLYLINE((#226,#227,#228,#229,#226));\n#226=IFCCARTESIANPOINT((300.,300.));\n"
                             "#227=IFCCARTESIANPOINT((500.,300.));\n#228=IFCCARTESIANPOINT((500.,500.));\n"
                             "#229=IFCCARTESIANPOINT((300.,500.));\n" +
                             box),
                 1 - 0.04 * 0.3);
}

TEST(IfcShapes, BooleansOfSolids) {
    const std::string two =
        "#210=IFCBLOCK(#14,1000.,1000.,1000.);\n#211=IFCBLOCK(#212,1000.,1000.,1000.);\n"
        "#212=IFCAXIS2PLACEMENT3D(#213,#11,#12);\n#213=IFCCARTESIANPOINT((500.,500.,0.));\n";
    expectVolume(ifcWithItem("#200=IFCBOOLEANRESULT(.UNION.,#210,#211);\n" + two), 1.75);
    expectVolume(ifcWithItem("#200=IFCBOOLEANRESULT(.DIFFERENCE.,#210,#211);\n" + two), 0.75);
    expectVolume(ifcWithItem("#200=IFCBOOLEANRESULT(.INTERSECTION.,#210,#211);\n" + two), 0.25);
}

// An empty result is an operand like any other; chains of many differences are one, however long.
TEST(IfcShapes, BooleansOfBooleans) {
    const std::string three =
        "#210=IFCBLOCK(#14,1000.,1000.,1000.);\n#211=IFCBLOCK(#212,1000.,1000.,1000.);\n"
        "#212=IFCAXIS2PLACEMENT3D(#213,#11,#12);\n#213=IFCCARTESIANPOINT((5000.,500.,0.));\n"
        "#220=IFCBLOCK(#14,2000.,500.,500.);\n";
    expectVolume(ifcWithItem("#200=IFCBOOLEANRESULT(.UNION.,#201,#220);\n"
                             "#201=IFCBOOLEANRESULT(.INTERSECTION.,#210,#211);\n" +
                             three),
                 0.5);
    expectVolume(ifcWithItem("#200=IFCBOOLEANRESULT(.DIFFERENCE.,#210,#201);\n"
                             "#201=IFCBOOLEANRESULT(.DIFFERENCE.,#220,#210);\n" +
                             three),
                 1);
    std::string chain = "#230=IFCBLOCK(#14,100000.,1000.,1000.);\n";
    for (int i = 0; i < 100; ++i)
        chain += fmt::format(
            "#{}=IFCBLOCK(#{},500.,1000.,1000.);\n#{}=IFCAXIS2PLACEMENT3D(#{},#11,#12);\n"
            "#{}=IFCCARTESIANPOINT(({}.,0.,0.));\n#{}=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#{},#{});\n",
            1000 + i, 2000 + i, 2000 + i, 3000 + i, 3000 + i, 1000 * i, i == 99 ? 200 : 4000 + i,
            i == 0 ? 230 : 3999 + i, 1000 + i);
    expectVolume(ifcWithItem(chain), 50);
}

std::string wallWithOpening(const std::string& openingDepth, const std::string& openingY) {
    return ifcFile(
        "#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
        "#102=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#103));\n#103=IFCEXTRUDEDAREASOLID(#104,#14,#11,2500.);\n"
        "#104=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,4000.,300.);\n"
        "#110=IFCOPENINGELEMENT('opening',$,$,$,$,#111,#114,$,$);\n#111=IFCLOCALPLACEMENT(#15,#112);\n"
        "#112=IFCAXIS2PLACEMENT3D(#113,#11,#12);\n#113=IFCCARTESIANPOINT((0.," +
            openingY +
            ",800.));\n"
            "#114=IFCPRODUCTDEFINITIONSHAPE($,$,(#115));\n#115=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#116));"
            "\n"
            "#116=IFCEXTRUDEDAREASOLID(#117,#14,#11,1200.);\n"
            "#117=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,1000.," +
            openingDepth +
            ");\n"
            "#120=IFCRELVOIDSELEMENT('voids',$,$,$,#100,#110);\n",
        "#100");
}

TEST(IfcShapes, OpeningsAreCutOut) {
    const double wall = 4 * 0.3 * 2.5;
    for (const char* depth : {"300.", "300.00001", "600."}) {  // flush with the faces, nearly so, beyond them
        const ShapeRead read = readShapeOf(wallWithOpening(depth, "0."));
        EXPECT_NEAR(read.volume, wall - 0.3 * 1.2, 1e-7) << depth;
        EXPECT_TRUE(read.isClosed) << depth;
        EXPECT_EQ(read.findings, "") << depth;
        EXPECT_EQ(read.faces, 10U) << depth;  // six of the box, two of them with a hole, and four of the opening
    }
    EXPECT_NEAR(readShapeOf(wallWithOpening("300.", "200.")).volume, wall - 0.1 * 1.2, 1e-9);  // a niche
    EXPECT_NEAR(readShapeOf(wallWithOpening("300.", "900.")).volume, wall, 1e-9);              // beside the wall
}

TEST(IfcShapes, MappedItemsMirroredAndUnequal) {
    const std::string map =
        "#201=IFCREPRESENTATIONMAP(#14,#202);\n#202=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#203));\n"
        "#203=IFCEXTRUDEDAREASOLID(#300,#14,#11,1000.);\n"
        "#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);\n#205=IFCDIRECTION((-1.,0.,0.));\n";
    expectVolume(ifcWithItem("#200=IFCMAPPEDITEM(#201,#204);\n"
                             "#204=IFCCARTESIANTRANSFORMATIONOPERATOR3D(#12,#13,#10,2.,#11);\n" +
                             map),
                 0.06 * 8);
    // x to the left and y kept: mirrored, and yet it looks outwards.
    expectVolume(ifcWithItem("#200=IFCMAPPEDITEM(#201,#204);\n"
                             "#204=IFCCARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM(#205,#13,#10,1.,#11,2.,3.);\n" +
                             map),
                 0.06 * 6);
}

TEST(IfcShapes, FacetedSolidsWithHollows) {
    const std::string points = [] {
        std::string text;
        const auto cube = [&](int first, double low, double high) {
            for (int i = 0; i < 8; ++i)
                text += fmt::format("#{}=IFCCARTESIANPOINT(({},{},{}));\n", first + i, (i & 1) != 0 ? high : low,
                                    (i & 2) != 0 ? high : low, (i & 4) != 0 ? high : low);
        };
        cube(400, 0, 1000);
        cube(410, 250, 750);
        return text;
    }();
    const auto shell = [](int id, int firstPoint, int firstFace) {
        constexpr int kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        std::string text, list;
        for (int f = 0; f < 6; ++f) {
            const int face = firstFace + 3 * f;
            const auto& c = kCorners[f];
            text += fmt::format(
                "#{}=IFCPOLYLOOP((#{},#{},#{},#{}));\n#{}=IFCFACEOUTERBOUND(#{},.T.);\n#{}=IFCFACE((#{}));\n", face,
                firstPoint + c[0], firstPoint + c[1], firstPoint + c[2], firstPoint + c[3], face + 1, face, face + 2,
                face + 1);
            list += fmt::format("{}#{}", f == 0 ? "" : ",", face + 2);
        }
        return text + fmt::format("#{}=IFCCLOSEDSHELL(({}));\n", id, list);
    };
    expectVolume(ifcWithItem("#200=IFCFACETEDBREP(#201);\n" + shell(201, 400, 500) + points), 1);
    expectVolume(ifcWithItem("#200=IFCFACETEDBREPWITHVOIDS(#201,(#202));\n" + shell(201, 400, 500) +
                             shell(202, 410, 600) + points),
                 1 - 0.125);
}

// A half cylinder of radius 1 m and height 1 m. Split, the arc below is two edges, so that the curved face is no longer one
// between two curves of equally many points.
enum class Side { Cylinder, Spline, Revolution };

std::string halfCylinder(bool isSplit, Side side = Side::Cylinder) {
    std::string text =
        "#200=IFCADVANCEDBREP(#201);\n#201=IFCCLOSEDSHELL((#210,#220,#230,#240));\n"
        "#300=IFCCARTESIANPOINT((1000.,0.,0.));\n#301=IFCCARTESIANPOINT((-1000.,0.,0.));\n"
        "#302=IFCCARTESIANPOINT((1000.,0.,1000.));\n#303=IFCCARTESIANPOINT((-1000.,0.,1000.));\n"
        "#304=IFCCARTESIANPOINT((0.,1000.,0.));\n"
        "#310=IFCVERTEXPOINT(#300);\n#311=IFCVERTEXPOINT(#301);\n#312=IFCVERTEXPOINT(#302);\n#313=IFCVERTEXPOINT(#303);"
        "\n"
        "#314=IFCVERTEXPOINT(#304);\n#320=IFCCIRCLE(#14,1000.);\n#321=IFCCIRCLE(#322,1000.);\n"
        "#322=IFCAXIS2PLACEMENT3D(#323,#11,#12);\n#323=IFCCARTESIANPOINT((0.,0.,1000.));\n"
        "#324=IFCLINE(#300,#325);\n#325=IFCVECTOR(#12,1.);\n#326=IFCVECTOR(#11,1.);\n#327=IFCLINE(#300,#326);\n"
        "#330=IFCEDGECURVE(#310,#311,#320,.T.);\n#331=IFCEDGECURVE(#312,#313,#321,.T.);\n"
        "#332=IFCEDGECURVE(#311,#310,#324,.T.);\n#333=IFCEDGECURVE(#313,#312,#324,.T.);\n"
        "#334=IFCEDGECURVE(#310,#312,#327,.T.);\n#335=IFCEDGECURVE(#311,#313,#327,.T.);\n"
        "#336=IFCEDGECURVE(#310,#314,#320,.T.);\n#337=IFCEDGECURVE(#314,#311,#320,.T.);\n"
        "#340=IFCPLANE(#14);\n";
    if (side == Side::Spline) {
        const int x[] = {1000, 1000, 0, -1000, -1000}, y[] = {0, 1000, 1000, 1000, 0};
        std::string rows;
        for (int i = 0; i < 5; ++i) {
            for (int k = 0; k < 2; ++k)
                text += fmt::format("#{}=IFCCARTESIANPOINT(({}.,{}.,{}.));\n", 350 + 2 * i + k, x[i], y[i], 1000 * k);
            rows += fmt::format("{}(#{},#{})", i == 0 ? "" : ",", 350 + 2 * i, 351 + 2 * i);
        }
        text += "#341=IFCRATIONALBSPLINESURFACEWITHKNOTS(2,1,(" + rows +
                "),.UNSPECIFIED.,.F.,.F.,.F.,(3,2,3),(2,2),(0.,1.,2.),(0.,1.),.UNSPECIFIED.,"
                "((1.,1.),(0.70710678118654752,0.70710678118654752),(1.,1.),"
                "(0.70710678118654752,0.70710678118654752),(1.,1.)));\n";
    } else if (side == Side::Revolution) {
        // A line of three points at (0.6, 0.8), which need not be where the face begins.
        text +=
            "#341=IFCSURFACEOFREVOLUTION(#342,$,#343);\n#342=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#344);\n"
            "#343=IFCAXIS1PLACEMENT(#10,#11);\n#344=IFCPOLYLINE((#345,#346,#347));\n"
            "#345=IFCCARTESIANPOINT((600.,800.,-100.));\n#346=IFCCARTESIANPOINT((600.,800.,300.));\n"
            "#347=IFCCARTESIANPOINT((600.,800.,1200.));\n";
    } else {
        text += "#341=IFCCYLINDRICALSURFACE(#14,1000.);\n";
    }
    int id = 400;
    const auto addFaceOf = [&](int number, int surface, const std::vector<std::pair<int, bool>>& edges) {
        std::string list;
        for (const auto& [edge, isForward] : edges) {
            text += fmt::format("#{}=IFCORIENTEDEDGE(*,*,#{},{});\n", id, edge, isForward ? ".T." : ".F.");
            list += fmt::format("{}#{}", list.empty() ? "" : ",", id++);
        }
        text += fmt::format(
            "#{}=IFCEDGELOOP(({}));\n#{}=IFCFACEOUTERBOUND(#{},.T.);\n#{}=IFCADVANCEDFACE((#{}),#{},.T.);\n", id, list,
            id + 1, id, number, id + 1, surface);
        id += 2;
    };
    if (isSplit) {
        addFaceOf(210, 340, {{332, false}, {337, false}, {336, false}});
        addFaceOf(230, 341, {{336, true}, {337, true}, {335, true}, {331, false}, {334, false}});
    } else {
        addFaceOf(210, 340, {{332, false}, {330, false}});
        addFaceOf(230, 341, {{330, true}, {335, true}, {331, false}, {334, false}});
    }
    addFaceOf(220, 340, {{331, true}, {333, true}});
    addFaceOf(240, 340, {{332, true}, {334, true}, {333, false}, {335, false}});
    return ifcWithItem(text);
}

TEST(IfcShapes, AdvancedBrepsWithCylinders) {
    const double share = 24 * std::sin(kPiTest / 24) / kPiTest;  // half a circle has 36 chords or more
    for (const bool isSplit : {false, true}) {
        const ShapeRead read = readShapeOf(halfCylinder(isSplit));
        EXPECT_TRUE(read.isClosed) << isSplit;
        EXPECT_EQ(read.findings, "") << isSplit;
        EXPECT_LT(read.volume, kPiTest / 2) << isSplit;
        EXPECT_GT(read.volume, share * kPiTest / 2) << isSplit;
        EXPECT_GE(read.faces, 27U) << isSplit;
    }
}

TEST(IfcShapes, AdvancedBrepsWithRationalSplines) {
    for (const bool isSplit : {false, true}) {
        const ShapeRead read = readShapeOf(halfCylinder(isSplit, Side::Spline));
        EXPECT_TRUE(read.isClosed) << isSplit;
        EXPECT_EQ(read.findings, "") << isSplit;
        EXPECT_NEAR(read.volume, kPiTest / 2, 0.003) << isSplit;  // chords within 1 mm of an area of pi m2
        EXPECT_GE(read.faces, 27U) << isSplit;
    }
}

TEST(IfcShapes, AdvancedBrepsWithSurfacesOfRevolution) {
    const ShapeRead read = readShapeOf(halfCylinder(true, Side::Revolution));
    EXPECT_TRUE(read.isClosed);
    EXPECT_EQ(read.findings, "");
    EXPECT_NEAR(read.volume, kPiTest / 2, 0.003);
    EXPECT_GE(read.faces, 50U);  // cut at the corner of the line, too
}

// A block of 1 m whose top is z = 1 + c x (1 - x) y (1 - y): its edges are those of the block, its volume is 1 + c / 36.
std::string bulgedBlock(int control) {
    std::string text =
        "#200=IFCADVANCEDBREP(#201);\n#201=IFCCLOSEDSHELL((#210,#211,#212,#213,#214,#215));\n#340=IFCPLANE(#14);\n"
        "#324=IFCLINE(#300,#325);\n#325=IFCVECTOR(#12,1.);\n";
    for (int i = 0; i < 8; ++i)
        text += fmt::format("#{}=IFCCARTESIANPOINT(({}.,{}.,{}.));\n#{}=IFCVERTEXPOINT(#{});\n", 300 + i,
                            (i & 1) * 1000, (i >> 1 & 1) * 1000, (i >> 2) * 1000, 310 + i, 300 + i);
    std::string rows;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            text += fmt::format("#{}=IFCCARTESIANPOINT(({}.,{}.,{}.));\n", 350 + 3 * i + j, 500 * i, 500 * j,
                                i == 1 && j == 1 ? control : 1000);
            rows += fmt::format("{}#{}{}", j == 0 ? (i == 0 ? "(" : ",(") : ",", 350 + 3 * i + j, j == 2 ? ")" : "");
        }
    text += "#341=IFCBSPLINESURFACEWITHKNOTS(2,2,(" + rows +
            "),.UNSPECIFIED.,.F.,.F.,.F.,(3,3),(3,3),(0.,1.),(0.,1.),.UNSPECIFIED.);\n";
    const int corners[6][4] = {{4, 5, 7, 6}, {0, 2, 3, 1}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    int id = 400;
    for (int face = 0; face < 6; ++face) {
        std::string loop;
        for (int i = 0; i < 4; ++i) {
            text += fmt::format("#{}=IFCEDGECURVE(#{},#{},#324,.T.);\n#{}=IFCORIENTEDEDGE(*,*,#{},.T.);\n", id,
                                310 + corners[face][i], 310 + corners[face][(i + 1) % 4], id + 1, id);
            loop += fmt::format("{}#{}", i == 0 ? "" : ",", id + 1);
            id += 2;
        }
        text += fmt::format(
            "#{}=IFCEDGELOOP(({}));\n#{}=IFCFACEOUTERBOUND(#{},.T.);\n#{}=IFCADVANCEDFACE((#{}),#{},.T.);\n", id, loop,
            id + 1, id, 210 + face, id + 1, face == 0 ? 341 : 340);
        id += 2;
    }
    return ifcWithItem(text);
}

TEST(IfcShapes, AdvancedBrepsWithSplines) {
    for (const int control : {1200, 800, 2000}) {
        const ShapeRead read = readShapeOf(bulgedBlock(control));
        EXPECT_TRUE(read.isClosed) << control;
        EXPECT_EQ(read.findings, "") << control;
        EXPECT_NEAR(read.volume, 1 + 4 * (control - 1000) / 1000.0 / 36, 0.001) << control;  // 1 mm over 1 m2
        EXPECT_GT(read.faces, 20U) << control;
    }
    // As much as is cut: 32 strips each way, for a spike of 25 m.
    const ShapeRead spike = readShapeOf(bulgedBlock(100'000));
    EXPECT_TRUE(spike.isClosed);
    EXPECT_EQ(spike.findings, "");
    EXPECT_NEAR(spike.volume, 1 + 4 * 99 / 36.0, 0.05);
    // Knots that are not in order: the face is a polygon of its edges, and that is said.
    std::string broken = bulgedBlock(1200);
    broken.replace(broken.find("(3,3),(0.,1.),(0.,1.)"), 21, "(3,3),(1.,0.),(0.,1.)");
    const ShapeRead read = readShapeOf(broken);
    EXPECT_NEAR(read.volume, 1, 1e-9);
    EXPECT_NE(read.findings.find("E132"), std::string::npos);
}

// A bridge deck: rectangles of 2 and 4 m along 10 m, with a third beside the curve.
TEST(IfcShapes, SectionedSolidsAlongCurves) {
    const std::string sections =
        "#210=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,2000.,1000.);\n#211=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,4000.,1000.);"
        "\n"
        "#220=IFCAXIS2PLACEMENTLINEAR(#221,$,$);\n#221=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(0.),$,$,$,#230);\n"
        "#222=IFCAXIS2PLACEMENTLINEAR(#223,$,$);\n"
        "#223=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(10000.),$,$,$,#230);\n";
    const std::string straight = "#230=IFCPOLYLINE((#10,#231));\n#231=IFCCARTESIANPOINT((20000.,0.,0.));\n";
    const auto solid = [](const char* profiles) {
        return fmt::format("#200=IFCSECTIONEDSOLIDHORIZONTAL(#230,({}),(#220,#222),.T.);\n", profiles);
    };
    expectVolume(ifcWithItem(solid("#210,#210") + sections + straight, "IFC4X3"), 20);
    expectVolume(ifcWithItem(solid("#210,#211") + sections + straight, "IFC4X3"), 30);

    // A quarter of a circle of 20/pi m: by Pappus as much as straight.
    const double radius = 20000 / 3.14159265358979323846;
    const std::string bent = fmt::format(
        "#230=IFCINDEXEDPOLYCURVE(#232,(IFCARCINDEX((1,2,3))),.F.);\n"
        "#232=IFCCARTESIANPOINTLIST3D((({0},0.,0.),({1},{1},0.),(0.,{0},0.)));\n",
        radius, radius * std::sqrt(0.5));
    expectVolume(ifcWithItem(solid("#210,#210") + sections + bent, "IFC4X3"), 20, 0.01);
    expectVolume(ifcWithItem(solid("#210,#211") + sections + bent, "IFC4X3"), 30, 0.02);

    // A corner of 90 degrees in the middle: mitred, as much as straight.
    const std::string corner =
        "#230=IFCPOLYLINE((#10,#231,#233));\n#231=IFCCARTESIANPOINT((5000.,0.,0.));\n"
        "#233=IFCCARTESIANPOINT((5000.,5000.,0.));\n";
    expectVolume(ifcWithItem(solid("#210,#210") + sections + corner, "IFC4X3"), 20);
}

TEST(IfcShapes, SectionedSolidsStandUpright) {
    const auto model = readText(
        ifcWithItem("#200=IFCSECTIONEDSOLIDHORIZONTAL(#230,(#210,#210),(#220,#222),.T.);\n"
                    "#210=IFCRECTANGLEPROFILEDEF(.AREA.,$,#212,2000.,1000.);\n#212=IFCAXIS2PLACEMENT2D(#213,$);\n"
                    "#213=IFCCARTESIANPOINT((3000.,5000.));\n"
                    "#220=IFCAXIS2PLACEMENTLINEAR(#221,$,$);\n#221=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(1000.)"
                    ",$,100.,$,#230);\n"
                    "#222=IFCAXIS2PLACEMENTLINEAR(#223,$,$);\n"
                    "#223=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(10000.),$,100.,$,#230);\n"
                    "#230=IFCPOLYLINE((#10,#231));\n#231=IFCCARTESIANPOINT((20000.,0.,0.));\n",
                    "IFC4X3"));
    ASSERT_TRUE(model);
    Box3d box;
    for (const model::Polygon& polygon : model->polygons)
        for (const Vec3d& p : polygon.points) box.add(p);
    // Along x from 1 to 10; x of the profile to the left (+y), its y up, 0.1 m above.
    EXPECT_NEAR(length(box.min - Vec3d{1, 2, 4.6}), 0, 1e-9);
    EXPECT_NEAR(length(box.max - Vec3d{10, 4, 5.6}), 0, 1e-9);
}

TEST(IfcShapes, SectionedSpines) {
    const std::string records =
        "#200=IFCSECTIONEDSPINE(#230,(#210,#211,#210),(#14,#220,#222));\n"
        "#210=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,2000.,1000.);\n#211=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,4000.,1000.);"
        "\n"
        "#220=IFCAXIS2PLACEMENT3D(#221,#11,#12);\n#221=IFCCARTESIANPOINT((0.,0.,5000.));\n"
        "#222=IFCAXIS2PLACEMENT3D(#223,#11,#12);\n#223=IFCCARTESIANPOINT((0.,0.,10000.));\n"
        "#230=IFCCOMPOSITECURVE((),.F.);\n";
    expectVolume(ifcWithItem(records), 30);
}

TEST(IfcShapes, SectionedSolidsThatMakeNoSenseAreNamed) {
    const std::string base =
        "#210=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,2000.,1000.);\n#211=IFCCIRCLEPROFILEDEF(.AREA.,$,#17,1000.);\n"
        "#220=IFCAXIS2PLACEMENT3D(#221,#11,#12);\n#221=IFCCARTESIANPOINT((0.,0.,5000.));\n";
    for (const char* spine : {"(#210),(#14)", "(#210,#211),(#14,#220)", "(#210,#210),(#14)", "(#210,#210),(#14,#14)"}) {
        Diagnostics log;
        EXPECT_TRUE(readText(ifcWithItem(fmt::format("#200=IFCSECTIONEDSPINE($,{});\n", spine) + base), &log));
        EXPECT_EQ(log.count(Code::ShapeNotRead), std::string_view(spine).ends_with("(#14,#14)") ? 0u : 1u) << spine;
    }
}

TEST(IfcShapes, BoundingBoxAsTheLastResort) {
    const ShapeRead read = readShapeOf(ifcFile(
        "#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
        "#102=IFCSHAPEREPRESENTATION(#20,'Box','BoundingBox',(#200));\n#200=IFCBOUNDINGBOX(#10,1000.,2000.,3000.);",
        "#100"));
    EXPECT_EQ(read.solids, 0u) << "a box states no volume";
    EXPECT_NE(read.findings.find("E132"), std::string::npos);
    EXPECT_NE(read.findings.find("bounding box"), std::string::npos);
}

TEST(IfcShapes, WhatIsNotReadIsNamed) {
    const ShapeRead unknown = readShapeOf(ifcWithItem("#200=IFCSPIRALSOLID(#10);"));
    EXPECT_EQ(unknown.solids, 0U);
    EXPECT_NE(unknown.findings.find("E133"), std::string::npos);
    EXPECT_NE(unknown.findings.find("IFCSPIRALSOLID"), std::string::npos);
    // A difference with something unknown keeps the first operand, and says so.
    const ShapeRead difference =
        readShapeOf(ifcWithItem("#200=IFCBOOLEANRESULT(.DIFFERENCE.,#210,#211);\n"
                                "#210=IFCBLOCK(#14,1000.,1000.,1000.);\n#211=IFCSPIRALSOLID(#10);"));
    EXPECT_NEAR(difference.volume, 1, 1e-9);
    EXPECT_NE(difference.findings.find("E132"), std::string::npos);
    EXPECT_NE(difference.findings.find("DIFFERENCE"), std::string::npos);
}

// 40 records for 2^20 unions and as many intersections.
TEST(IfcShapes, BooleansOfSharedOperandsEnd) {
    std::string text = "#1000=IFCBLOCK(#14,1000.,1000.,1000.);\n";
    for (int i = 0; i < 40; ++i)
        text += fmt::format("#{}=IFCBOOLEANRESULT(.{}.,#{},#{});\n", i == 39 ? 200 : 1001 + i,
                            i % 2 == 0 ? "UNION" : "INTERSECTION", 1000 + i, 1000 + i);
    EXPECT_NE(readShapeOf(ifcWithItem(text)).findings.find("the limit for one product"), std::string::npos);
    EXPECT_NE(readShapeOf(ifcWithItem("#200=IFCBOOLEANRESULT(.UNION.,#201,#201);\n"
                                      "#201=IFCBOOLEANRESULT(.INTERSECTION.,#200,#200);\n"))
                  .findings.find("circle"),
              std::string::npos);
}

TEST(IfcShapes, CirclesOfReferencesEnd) {
    EXPECT_NE(readShapeOf(ifcWithItem("#200=IFCBOOLEANRESULT(.DIFFERENCE.,#200,#200);")).findings.find("circle"),
              std::string::npos);
    EXPECT_EQ(readShapeOf(ifcWithItem("#200=IFCMAPPEDITEM(#201,#204);\n#201=IFCREPRESENTATIONMAP(#14,#202);\n"
                                      "#202=IFCSHAPEREPRESENTATION(#20,'Body','MappedRepresentation',(#200));\n"
                                      "#204=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#10,1.,$);"))
                  .solids,
              0U);
    EXPECT_EQ(readShapeOf(ifcWithProfile("#300=IFCDERIVEDPROFILEDEF(.AREA.,$,#300,#302,$);\n"
                                         "#302=IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$,#16,1.);"))
                  .solids,
              0U);
}

}  // namespace
}  // namespace svt::readers
