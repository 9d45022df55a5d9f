// Alignments, earthworks, curves of IFC2x3, boxes and units. Places and volumes are known in closed form.
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/ifc_shape/body.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::readers {
namespace {

using namespace test;

const char* const kUnitCube =
    "#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n#102=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#103));\n"
    "#103=IFCBLOCK(#104,1000.,1000.,1000.);\n#104=IFCAXIS2PLACEMENT3D(#105,$,$);\n"
    "#105=IFCCARTESIANPOINT((-500.,-500.,0.));\n";

const model::Feature* productNamed(const model::BuildingModel& model, std::string_view id) {
    const auto found = std::ranges::find(model.features, id, &model::Feature::id);
    return found == model.features.end() ? nullptr : &*found;
}

double solidVolumeOf(const model::BuildingModel& model, const model::Feature& feature) {
    double volume = 0;
    for (const model::Geometry& geometry : feature.geometries)
        for (const model::Solid& solid : geometry.solids) {
            std::vector<model::Polygon> faces;
            for (const model::SurfaceUse& use : solid.exterior) faces.push_back(model.polygons[use.polygon]);
            volume += ifc::enclosedVolume(faces);
        }
    return volume;
}

std::string attributeNamed(const model::Feature& feature, std::string_view name) {
    for (const Attribute& a : feature.attributes)
        if (a.name == name) return toText(a.value) + (a.unit.empty() ? "" : " " + a.unit);
    return "none";
}

TEST(IfcInfrastructure, CompositeCurvesOfIfc2x3AreRead) {
    // Half a disc of 1 m, 1 m high: an arc and the line that closes it.
    const auto model = readText(ifcWithItem(
        "#200=IFCEXTRUDEDAREASOLID(#300,#14,#11,1000.);\n#300=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#310);\n"
        "#310=IFC2DCOMPOSITECURVE((#311,#312),.F.);\n#311=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#313);\n"
        "#312=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#316);\n"
        "#313=IFCTRIMMEDCURVE(#314,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(3.14159265358979)),.T.,.PARAMETER.);\n"
        "#314=IFCCIRCLE(#17,1000.);\n#316=IFCPOLYLINE((#317,#318));\n#317=IFCCARTESIANPOINT((-1000.,0.));\n"
        "#318=IFCCARTESIANPOINT((1000.,0.));",
        "IFC2X3"));
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_NEAR(solidVolumeOf(*model, *productNamed(*model, "wall")), std::numbers::pi / 2, 5e-3);
}

// A sign at a distance along the curve #120, 2 m above and 1 m beside it.
std::string signAlong(double metres, const std::string& curve) {
    return ifcFile(fmt::format("#100=IFCSIGN('sign',$,'Sign',$,$,#110,#101,$,$);\n"
                               "#110=IFCLINEARPLACEMENT($,#111,$);\n#111=IFCAXIS2PLACEMENTLINEAR(#112,$,$);\n"
                               "#112=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE({:.6f}),$,$,$,#120);\n",
                               1000 * metres) +
                       kUnitCube + curve,
                   "#100", "IFC4X3_ADD2");
}

// The middle of the lower face of the sign; NaN without geometry.
Vec3d placeOfSign(const std::string& text) {
    const auto model = readText(text);
    EXPECT_TRUE(model) << model.error().message();
    const model::Feature& sign = *productNamed(*model, "sign");
    if (sign.geometries.empty()) return Vec3d{1, 1, 1} * std::nan("");
    Vec3d sum{};
    double count = 0;
    for (const model::Solid& solid : sign.geometries[0].solids)
        for (const model::SurfaceUse& use : solid.exterior)
            for (const Vec3d& p : model->polygons[use.polygon].points) {
                sum = sum + p;
                ++count;
            }
    return sum / count - Vec3d{0, 0, 0.5};
}

// 100 m to the east, then a quarter to the left with a radius of 50 m. The gradient begins with 2 % at 10 m; a parabola
// takes it to -2 % between 40 and 80 m, where the height is 10.8 m again.
const std::string kPlan =
    "#121=IFCCOMPOSITECURVE((#122,#123,#124),.F.);\n"
    "#122=IFCCURVESEGMENT(.CONTINUOUS.,#125,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(100000.),#140);\n"
    "#123=IFCCURVESEGMENT(.CONTINUOUS.,#126,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(78539.81633974483),#141);\n"
    "#124=IFCCURVESEGMENT(.DISCONTINUOUS.,#127,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(0.),#140);\n"
    "#125=IFCAXIS2PLACEMENT2D(#16,$);\n#126=IFCAXIS2PLACEMENT2D(#128,$);\n#127=IFCAXIS2PLACEMENT2D(#129,#130);\n"
    "#128=IFCCARTESIANPOINT((100000.,0.));\n#129=IFCCARTESIANPOINT((150000.,50000.));\n"
    "#130=IFCDIRECTION((0.,1.));\n#131=IFCDIRECTION((1.,0.));\n#140=IFCLINE(#16,#142);\n#142=IFCVECTOR(#131,1.);\n"
    "#141=IFCCIRCLE(#17,50000.);\n";
const std::string kGradient =
    "#120=IFCGRADIENTCURVE((#150,#151,#152,#153),.F.,#121,$);\n"
    "#150=IFCCURVESEGMENT(.CONTINUOUS.,#160,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(40008.),#140);\n"
    "#151=IFCCURVESEGMENT(.CONTINUOUS.,#161,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(40002.7),#170);\n"
    "#152=IFCCURVESEGMENT(.CONTINUOUS.,#162,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(98559.5),#140);\n"
    "#153=IFCCURVESEGMENT(.DISCONTINUOUS.,#163,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(0.),#140);\n"
    "#160=IFCAXIS2PLACEMENT2D(#164,#168);\n#161=IFCAXIS2PLACEMENT2D(#165,#168);\n"
    "#162=IFCAXIS2PLACEMENT2D(#166,#169);\n#163=IFCAXIS2PLACEMENT2D(#167,#169);\n"
    "#164=IFCCARTESIANPOINT((0.,10000.));\n#165=IFCCARTESIANPOINT((40000.,10800.));\n"
    "#166=IFCCARTESIANPOINT((80000.,10800.));\n#167=IFCCARTESIANPOINT((178539.81633974483,8829.2036732));\n"
    "#168=IFCDIRECTION((1.,0.02));\n#169=IFCDIRECTION((1.,-0.02));\n"
    "#170=IFCPOLYNOMIALCURVE(#125,(0.,1.),(0.,0.02,-0.0005),$);\n";

TEST(IfcInfrastructure, SignsStandAlongAnAlignmentWithItsGradient) {
    const auto expectAt = [](double distance, Vec3d place) {
        const Vec3d found = placeOfSign(signAlong(distance, kPlan + kGradient));
        // The foot of the sign is inclined with the gradient, which moves the middle of its height.
        EXPECT_NEAR(found.x, place.x, 0.011) << distance;
        EXPECT_NEAR(found.y, place.y, 0.011) << distance;
        EXPECT_NEAR(found.z, place.z, 0.003) << distance;
    };
    expectAt(0, {0, 0, 10});
    expectAt(30, {30, 0, 10.6});
    expectAt(60, {60, 0, 11});  // the top of the parabola: 10.8 + 0.02 * 20 - 0.0005 * 20 * 20
    expectAt(100, {100, 0, 10.4});
    const double half = std::sqrt(0.5) * 50;
    expectAt(100 + 25 * std::numbers::pi / 2, {100 + half, 50 - half, 10.4 - 0.02 * 39.27});
    expectAt(100 + 25 * std::numbers::pi, {150, 50, 10.4 - 0.02 * 78.54});
}

TEST(IfcInfrastructure, ClothoidsTurnWithTheirDistance) {
    // The constant is 100 m: after 50 m the curvature is 1/200, and the place is that of the series of Fresnel.
    const std::string curve =
        "#120=IFCCOMPOSITECURVE((#122),.F.);\n"
        "#122=IFCCURVESEGMENT(.DISCONTINUOUS.,#125,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE({}50000.),#140);\n"
        "#125=IFCAXIS2PLACEMENT2D(#16,$);\n#140=IFCCLOTHOID(#125,100000.);\n";
    const auto withSign = [&](const std::string& sign) {
        std::string text = curve;
        return text.replace(text.find("{}"), 2, sign);
    };
    const Vec3d left = placeOfSign(signAlong(50, withSign("")));
    EXPECT_NEAR(left.x, 49.921931, 1e-4);
    EXPECT_NEAR(left.y, 2.081009, 1e-4);
    // Against its parent curve it turns the same way at first, with growing curvature.
    const Vec3d back = placeOfSign(signAlong(50, withSign("-")));
    EXPECT_NEAR(back.x, 49.921931, 1e-4);
    EXPECT_NEAR(back.y, 2.081009, 1e-4);
}

// Where a curve leads whose curvature is a function of the distance, by many small steps.
template <class CurvatureAt>
Vec3d endOf(double size, const CurvatureAt& curvatureAt) {
    constexpr int kSteps = 100'000;
    const double step = size / kSteps;
    double direction = 0;
    Vec3d at{};
    for (int n = 0; n < kSteps; ++n) {
        const double half = 0.5 * step * curvatureAt((n + 0.25) * step);
        at = at + Vec3d{std::cos(direction + half), std::sin(direction + half), 0} * step;
        direction += step * curvatureAt((n + 0.5) * step);
    }
    return at;
}

// Transition curves of 100 m from a straight line to an arc with a radius of 300 m.
TEST(IfcInfrastructure, SpiralsTurnAsTheirCurvatureSays) {
    constexpr double kSize = 100, kRadius = 300, kTurn = 2 * std::numbers::pi;
    struct Spiral {
        const char* type;
        std::vector<double> terms;  // metres; 0: none
        double (*shape)(double t);  // curvature of the end at t = 1, from 0 to 1
    };
    const auto term = [&](double factor, int power) {  // of factor * t^power
        const double value = factor * std::pow(kSize, -power) / kRadius;
        return std::copysign(std::pow(std::abs(value), -1.0 / (power + 1)), value);
    };
    const std::vector<Spiral> spirals{
        {"IFCTHIRDORDERPOLYNOMIALSPIRAL",  // Bloss
         {term(-2, 3), term(3, 2), 0, 0},
         [](double t) { return 3 * t * t - 2 * t * t * t; }},
        {"IFCCOSINESPIRAL", {-2 * kRadius, 2 * kRadius}, [](double t) { return 0.5 - 0.5 * std::cos(kTurn * t / 2); }},
        {"IFCSINESPIRAL", {-kTurn * kRadius, term(1, 1), 0}, [](double t) { return t - std::sin(kTurn * t) / kTurn; }},
        {"IFCSECONDORDERPOLYNOMIALSPIRAL",  // the first half of Helmert
         {term(2, 2), 0, 0},
         [](double t) { return 2 * t * t; }},
        {"IFCSEVENTHORDERPOLYNOMIALSPIRAL",  // Vienna
         {term(-20, 7), term(70, 6), term(-84, 5), term(35, 4), 0, 0, 0, 0},
         [](double t) { return std::pow(t, 4) * (35 + t * (-84 + t * (70 - 20 * t))); }}};
    for (const Spiral& spiral : spirals) {
        std::string terms;
        for (const double value : spiral.terms) terms += value == 0 ? ",$" : fmt::format(",{:.9f}", 1000 * value);
        const std::string curve =
            "#120=IFCCOMPOSITECURVE((#122,#123),.F.);\n"
            "#122=IFCCURVESEGMENT(.CONTINUOUS.,#125,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(100000.),#140);\n"
            "#123=IFCCURVESEGMENT(.DISCONTINUOUS.,#126,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(0.),#141);\n"
            "#125=IFCAXIS2PLACEMENT2D(#16,$);\n#126=IFCAXIS2PLACEMENT2D(#127,$);\n"
            "#127=IFCCARTESIANPOINT((99000.,9000.));\n#141=IFCCIRCLE(#125,300000.);\n" +
            fmt::format("#140={}(#125{});\n", spiral.type, terms);
        Diagnostics log;
        const std::string text = signAlong(60, curve);
        ASSERT_TRUE(readText(text, &log));
        EXPECT_EQ(log.count(Code::ReadInPart), 0u) << spiral.type;
        const Vec3d found = placeOfSign(text);
        const Vec3d place = endOf(60, [&](double s) { return spiral.shape(s / kSize) / kRadius; });
        EXPECT_NEAR(found.x, place.x, 2e-3) << spiral.type;
        EXPECT_NEAR(found.y, place.y, 1e-3) << spiral.type;
    }
}

// A place along a curve of another kind is near the right one: the finding says so.
TEST(IfcInfrastructure, PlacesAlongInexactCurvesAreReported) {
    const auto findingOf = [](const std::string& curve) {
        Diagnostics log;
        const auto model = readText(signAlong(30, curve), &log);
        EXPECT_TRUE(model);
        EXPECT_FALSE(productNamed(*model, "sign")->geometries.empty());
        const auto found = std::ranges::find(log.items(), Code::ReadInPart, &Diagnostic::code);
        return found == log.items().end() ? std::string() : found->message;
    };
    EXPECT_EQ(findingOf(kPlan + kGradient), "");
    std::string cant = kPlan + kGradient;
    cant.replace(cant.find("#120="), 5, "#119=");
    const std::string ofCant = findingOf(cant + "#120=IFCSEGMENTEDREFERENCECURVE((#150),.F.,#119,$);\n");
    EXPECT_NE(ofCant.find("the cant of its place along a curve"), std::string::npos) << ofCant;
    const std::string ofParabola = findingOf(
        "#120=IFCCOMPOSITECURVE((#122,#123),.F.);\n"
        "#122=IFCCURVESEGMENT(.CONTINUOUS.,#125,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(100000.),#140);\n"
        "#123=IFCCURVESEGMENT(.DISCONTINUOUS.,#126,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(0.),#141);\n"
        "#125=IFCAXIS2PLACEMENT2D(#16,$);\n#126=IFCAXIS2PLACEMENT2D(#127,$);\n"
        "#127=IFCCARTESIANPOINT((99000.,5000.));\n#141=IFCCIRCLE(#125,300000.);\n"
        "#140=IFCPOLYNOMIALCURVE(#125,(0.,1.),(0.,0.,0.,5.E-12),$);\n");
    EXPECT_NE(ofParabola.find("IFCPOLYNOMIALCURVE"), std::string::npos) << ofParabola;
}

TEST(IfcInfrastructure, AProductWithoutItsPlaceAlongACurveHasNoShape) {
    for (const char* curve :
         {"#120=IFCUNKNOWNCURVE(#16);\n", "#120=IFCPOLYLINE((#10,#130));\n#130=IFCCARTESIANPOINT((9.,0.,0.));\n"}) {
        Diagnostics log;
        const auto model = readText(signAlong(5, curve), &log);
        ASSERT_TRUE(model);
        EXPECT_TRUE(productNamed(*model, "sign")->geometries.empty()) << "at the origin it would be in the wrong place";
        ASSERT_EQ(log.count(Code::ShapeNotRead), 1u);
        const auto found = std::ranges::find(log.items(), Code::ShapeNotRead, &Diagnostic::code);
        EXPECT_NE(found->message.find("its place along a curve"), std::string::npos) << found->message;
    }
}

TEST(IfcInfrastructure, CartesianPositionsStandInForCurvesThatAreNotRead) {
    for (const char* placement :
         {"#110=IFCLINEARPLACEMENT($,#111,#113);\n", "#110=IFCLINEARPLACEMENT(#120,#111,$,#113);\n"}) {
        const std::string records =
            std::string("#100=IFCSIGN('sign',$,'Sign',$,$,#110,#101,$,$);\n") + placement +
            "#111=IFCDISTANCEEXPRESSION(5000.,$,$,$,.T.);\n#113=IFCAXIS2PLACEMENT3D(#114,$,$);\n"
            "#114=IFCCARTESIANPOINT((7000.,8000.,9000.));\n#120=IFCALIGNMENTCURVE($,$,$);\n" +
            kUnitCube;
        const Vec3d place = placeOfSign(ifcFile(records, "#100", "IFC4X3_ADD2"));
        EXPECT_NEAR(length(place - Vec3d{7, 8, 9}), 0, 1e-9) << placement;
    }
}

TEST(IfcInfrastructure, EarthworksCutsAreCutOutOrAreSpaceToExcavate) {
    const std::string cut =
        std::string("#100=IFCEARTHWORKSCUT('cut',$,'Trench',$,$,#15,#101,$,.TRENCH.);\n") + kUnitCube;
    const auto alone = readText(ifcFile(cut, "#100", "IFC4X3_ADD2"));
    ASSERT_TRUE(alone) << alone.error().message();
    const model::Feature* trench = productNamed(*alone, "cut");
    ASSERT_NE(trench, nullptr);
    EXPECT_EQ(trench->className, "GenericLogicalSpace");
    EXPECT_EQ(attributeNamed(*trench, "ifcType"), "IfcEarthworksCut");
    EXPECT_NEAR(solidVolumeOf(*alone, *trench), 1, 1e-9);
    const auto inEarth = readText(ifcFile(
        cut + "#200=IFCGEOGRAPHICELEMENT('earth',$,'Earth',$,$,#15,#201,$,$);\n"
              "#201=IFCPRODUCTDEFINITIONSHAPE($,$,(#202));\n#202=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#203));\n"
              "#203=IFCBLOCK(#204,4000.,4000.,2000.);\n#204=IFCAXIS2PLACEMENT3D(#205,$,$);\n"
              "#205=IFCCARTESIANPOINT((-2000.,-2000.,-1000.));\n#206=IFCRELVOIDSELEMENT('v',$,$,$,#200,#100);",
        "#200", "IFC4X3_ADD2"));
    ASSERT_TRUE(inEarth);
    EXPECT_EQ(productNamed(*inEarth, "cut"), nullptr);
    EXPECT_NEAR(solidVolumeOf(*inEarth, *productNamed(*inEarth, "earth")), 32 - 1, 1e-9);
}

TEST(IfcInfrastructure, ABoundingBoxHasNoVolume) {
    Diagnostics log;
    const auto model = readText(
        ifcFile("#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
                "#102=IFCSHAPEREPRESENTATION(#20,'Box','BoundingBox',(#200));\n"
                "#200=IFCBOUNDINGBOX(#10,1000.,2000.,3000.);",
                "#100"),
        &log);
    ASSERT_TRUE(model);
    const model::Feature& wall = *productNamed(*model, "wall");
    ASSERT_EQ(wall.geometries.size(), 1u);
    EXPECT_EQ(wall.geometries[0].kind, model::GeometryKind::Surface);
    EXPECT_EQ(wall.geometries[0].surfaces.size(), 6u);
    EXPECT_EQ(attributeNamed(wall, "shape"), "bounding box");
    EXPECT_EQ(log.count(Code::ReadInPart), 1u);
}

TEST(IfcInfrastructure, UnitsOfAreaAndVolumeFollowTheLength) {
    const std::string records =
        std::string("#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n") + kUnitCube +
        "#210=IFCRELDEFINESBYPROPERTIES('c',$,$,$,(#100),#211);\n"
        "#211=IFCELEMENTQUANTITY('d',$,'Q',$,$,(#212,#213,#214,#215));\n"
        "#212=IFCQUANTITYVOLUME('Volume',$,$,60000000.);\n#213=IFCQUANTITYAREA('Area',$,$,15650000.);\n"
        "#214=IFCQUANTITYAREA('Own',$,#220,15.65);\n#215=IFCQUANTITYLENGTH('Length',$,$,3150.);\n"
        "#220=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.);\n"
        "#230=IFCRELDEFINESBYPROPERTIES('e',$,$,$,(#100),#231);\n#231=IFCPROPERTYSET('f',$,'P',$,(#232));\n"
        "#232=IFCPROPERTYSINGLEVALUE('Own',$,IFCLENGTHMEASURE(2.5),#233);\n#233=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);";
    std::string text = ifcFile(records, "#100");
    const std::string units = "(#3,#4,#5,#6)";
    text.replace(text.find(units), units.size(), "(#3,#6)");
    Diagnostics log;
    const auto model = readText(text, &log);
    ASSERT_TRUE(model);
    const model::Feature& wall = *productNamed(*model, "wall");
    EXPECT_EQ(attributeNamed(wall, "Q.Volume"), "0.06 m3");
    EXPECT_EQ(attributeNamed(wall, "Q.Area"), "15.65 m2") << "no 15.649999999999999";
    EXPECT_EQ(attributeNamed(wall, "Q.Own"), "15.65 m2");
    EXPECT_EQ(attributeNamed(wall, "Q.Length"), "3.15 m");
    EXPECT_EQ(attributeNamed(wall, "P.Own"), "2.5 m");
    ASSERT_EQ(log.count(Code::BadValue), 1u);
    const auto found = std::ranges::find(log.items(), Code::BadValue, &Diagnostic::code);
    EXPECT_EQ(found->severity, Severity::Note);
}

}  // namespace
}  // namespace svt::readers
