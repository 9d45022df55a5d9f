#include <svt/readers/citygml/citygml_documents_test.hpp>

namespace svt::readers {
namespace {

using namespace gmltest;

// The only geometry of building "b" in a document whose lod2 property holds `geometry`.
Reading readGeometry(std::string_view geometry, int version = 2) {
    return readMembers(version, building("b", lod2Surfaces(version, geometry)));
}

const Geometry& onlyGeometry(const Reading& reading) {
    static const Geometry kNothing;
    const Feature& feature = reading.feature("b");
    EXPECT_EQ(feature.geometries.size(), 1u) << reading.findings();
    return feature.geometries.empty() ? kNothing : feature.geometries[0];
}

std::string polygonOf(std::string_view ring) {
    return multiSurface(
        surfaceMember(fmt::format("<gml:Polygon gml:id=\"p\"><gml:exterior>{}</gml:exterior></gml:Polygon>", ring)));
}

const model::Polygon& onlyPolygon(const Reading& reading) {
    static const model::Polygon kNothing;
    EXPECT_EQ(reading.model().polygons.size(), 1u) << reading.findings();
    return reading.model().polygons.empty() ? kNothing : reading.model().polygons[0];
}

const std::vector<Vec3d> kTriangle{{0, 0, 1}, {2, 0, 1}, {0, 3, 1}};

TEST(GmlGeometry, PosListDropsClosingPoint) {
    const Reading reading = readGeometry(polygonOf(ring(" 0 0 1\n2 0 1\t0 3 1 0 0 1 ")));
    EXPECT_EQ(onlyPolygon(reading).points, kTriangle);
    EXPECT_EQ(onlyPolygon(reading).ringEnds, std::vector<std::uint32_t>{3});
    EXPECT_EQ(onlyPolygon(reading).id, "p");
}

TEST(GmlGeometry, PositionsMayBeGivenInEveryWayAndMixed) {
    const std::string_view rings[] = {
        "<gml:LinearRing><gml:pos>0 0 1</gml:pos><gml:pos>2 0 1</gml:pos><gml:pos>0 3 1</gml:pos><gml:pos>0 0 "
        "1</gml:pos></gml:LinearRing>",
        "<gml:LinearRing><gml:coordinates>0,0,1 2,0,1 0,3,1 0,0,1</gml:coordinates></gml:LinearRing>",
        "<gml:LinearRing><gml:coordinates decimal=\",\" cs=\";\" "
        "ts=\"|\">0,0;0;1|2,0;0;1|0;3;1|0;0;1</gml:coordinates></gml:LinearRing>",
        "<gml:LinearRing><gml:pointProperty><gml:Point><gml:pos>0 0 1</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointRep><gml:Point><gml:pos>2 0 1</gml:pos></gml:Point></gml:pointRep><gml:posList>0 3 1 0 0 "
        "1</gml:posList></gml:LinearRing>",
        "<gml:LinearRing><gml:coord><gml:X>0</gml:X><gml:Y>0</gml:Y><gml:Z>1</gml:Z></gml:coord><gml:posList>2 0 1 0 3 "
        "1</gml:posList></gml:LinearRing>",
        "<gml:LinearRing><gml:posList>0 0 1 2 <!-- a comment -->0 1 <![CDATA[0 3 1]]> +0 -0 "
        "1e0</gml:posList></gml:LinearRing>",
        "<gml:Ring><gml:curveMember><gml:LineString><gml:posList>0 0 1 2 0 "
        "1</gml:posList></gml:LineString></gml:curveMember>"
        "<gml:curveMember><gml:Curve><gml:segments><gml:LineStringSegment><gml:posList>2 0 1 0 3 1 0 0 1</gml:posList>"
        "</gml:LineStringSegment></gml:segments></gml:Curve></gml:curveMember></gml:Ring>",
        "<gml:Ring><gml:curveMember><gml:OrientableCurve orientation=\"-\"><gml:baseCurve><gml:LineString>"
        "<gml:posList>0 3 1 2 0 1 0 0 "
        "1</gml:posList></gml:LineString></gml:baseCurve></gml:OrientableCurve></gml:curveMember></gml:Ring>",
    };
    for (const std::string_view text : rings) {
        const Reading reading = readGeometry(polygonOf(text));
        EXPECT_EQ(onlyPolygon(reading).points, kTriangle) << text << reading.findings();
    }
}

TEST(GmlGeometry, FlatRingsGetHeightZeroWhereverTheDimensionIsStated) {
    const std::vector<Vec3d> expected{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}};
    const std::string_view polygons[] = {
        "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList srsDimension=\"2\">0 0 2 0 2 3 0 "
        "0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>",
        "<gml:Polygon srsDimension=\"2\"><gml:exterior><gml:LinearRing><gml:posList>0 0 2 0 2 3 0 "
        "0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>",
        "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 2 0 2 3 0 "
        "0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>",
        "<gml:Polygon><gml:exterior><gml:LinearRing><gml:coordinates>0,0 2,0 2,3 "
        "0,0</gml:coordinates></gml:LinearRing></gml:exterior></gml:Polygon>",
    };
    // Beside a face with heights: a model that has none is refused.
    const auto readBesideAnother = [](std::string_view polygon) {
        Reading reading = readGeometry(multiSurface(surfaceMember(polygon) + surfaceMember(square({}, 5))));
        EXPECT_EQ(reading.count(Code::NoHeights), 1u);
        EXPECT_EQ(reading.model().polygons.size(), 2u);
        return reading.model().polygons.at(0).points;
    };
    for (const std::string_view polygon : polygons) EXPECT_EQ(readBesideAnother(polygon), expected) << polygon;
    // The number of values of six 2D points also divides by three, but the ring closes only as a 2D ring.
    EXPECT_EQ(readBesideAnother("<gml:Polygon><gml:exterior>" + ring("0 0 4 0 4 2 2 3 0 2 0 0") +
                                "</gml:exterior></gml:Polygon>")
                  .size(),
              5u);
    // A wrong dimension inherited from an ancestor does not break rings that are clearly three-dimensional.
    const Reading wrong =
        readGeometry("<gml:MultiSurface srsDimension=\"2\">" +
                     surfaceMember("<gml:Polygon><gml:exterior>" + ring("0 0 1 2 0 1 2 3 1 0 3 1 0 1 1 0 0 1") +
                                   "</gml:exterior></gml:Polygon>") +
                     "</gml:MultiSurface>");
    EXPECT_EQ(onlyPolygon(wrong).points.size(), 5u);
}

TEST(GmlGeometry, AModelWithoutHeightsIsOneError) {
    std::string members;
    for (int i = 0; i < 20; ++i)
        members +=
            surfaceMember("<gml:Polygon><gml:exterior>" + ring("0 0 2 0 2 3 0 0") + "</gml:exterior></gml:Polygon>");
    const Reading reading = readGeometry(multiSurface(members));
    EXPECT_EQ(reading.code(), Code::NoHeights);
    EXPECT_NE(reading.result.error().message().find("all 20 rings"), std::string::npos);
    EXPECT_EQ(reading.result.error().where().line, 3u);
}

TEST(GmlGeometry, HolesFollowTheExteriorWithOldAndNewNames) {
    for (const auto& [outer, inner] :
         {std::pair{"exterior", "interior"}, std::pair{"outerBoundaryIs", "innerBoundaryIs"}}) {
        const Reading reading = readGeometry(multiSurface(
            surfaceMember(fmt::format("<gml:Polygon><gml:{0}>{2}</gml:{0}><gml:{1}>{3}</gml:{1}></gml:Polygon>", outer,
                                      inner, ring("0 0 0 4 0 0 4 4 0 0 4 0 0 0 0"), ring("1 1 0 1 2 0 2 2 0 1 1 0")))));
        EXPECT_EQ(onlyPolygon(reading).ringEnds, (std::vector<std::uint32_t>{4, 7}));
    }
}

TEST(GmlGeometry, PatchesAndCompactPolygonsAreFaces) {
    const std::string triangle = "<gml:exterior>" + ring("0 0 1 2 0 1 0 3 1 0 0 1") + "</gml:exterior>";
    const std::string surfaces[] = {
        "<gml:Surface><gml:patches><gml:PolygonPatch>" + triangle + "</gml:PolygonPatch></gml:patches></gml:Surface>",
        "<gml:PolyhedralSurface><gml:polygonPatches><gml:PolygonPatch>" + triangle +
            "</gml:PolygonPatch></gml:polygonPatches></gml:PolyhedralSurface>",
        "<gml:TriangulatedSurface><gml:trianglePatches><gml:Triangle>" + triangle +
            "</gml:Triangle></gml:trianglePatches></gml:TriangulatedSurface>",
        "<gml:TriangulatedSurface><gml:patches><gml:Triangle>" + triangle +
            "</gml:Triangle></gml:patches></gml:TriangulatedSurface>",
        "<gml:Tin><gml:trianglePatches><gml:Triangle>" + triangle +
            "</gml:Triangle></gml:trianglePatches><gml:stopLines/><gml:controlPoint>"
            "<gml:posList>0 0 0</gml:posList></gml:controlPoint></gml:Tin>",
        "<gml:Surface><gml:patches><gml:Rectangle>" + triangle + "</gml:Rectangle></gml:patches></gml:Surface>",
        "<gml:MultiPolygon><gml:polygonMember><gml:Polygon>" + triangle +
            "</gml:Polygon></gml:polygonMember></gml:MultiPolygon>",
        "<gml:MultiGeometry><gml:geometryMember><gml:Polygon>" + triangle +
            "</gml:Polygon></gml:geometryMember></gml:MultiGeometry>",
        "<gml:MultiSurface><gml:surfaceMembers><gml:Polygon>" + triangle +
            "</gml:Polygon></gml:surfaceMembers></gml:MultiSurface>",
        multiSurface(
            surfaceMember("<ce:SimplePolygon><gml:posList>0 0 1 2 0 1 0 3 1</gml:posList></ce:SimplePolygon>")),
        multiSurface(
            surfaceMember("<ce:SimpleTriangle><gml:posList>0 0 1 2 0 1 0 3 1</gml:posList></ce:SimpleTriangle>")),
        "<gml:Polygon>" + triangle + "</gml:Polygon>",
    };
    for (const std::string& surface : surfaces) {
        const Reading reading = readGeometry(surface);
        EXPECT_EQ(onlyPolygon(reading).points, kTriangle) << surface << reading.findings();
        EXPECT_EQ(onlyGeometry(reading).kind, GeometryKind::Surface);
        EXPECT_EQ(onlyGeometry(reading).lod, 2);
        EXPECT_TRUE(reading.diagnostics.items().empty()) << reading.findings();
    }
}

TEST(GmlGeometry, TinOfPointsAloneIsReported) {
    const Reading reading = readGeometry(
        "<gml:Tin gml:id=\"t\"><gml:controlPoint><gml:posList>0 0 0 1 0 0 0 1 "
        "0</gml:posList></gml:controlPoint></gml:Tin>");
    EXPECT_TRUE(reading.feature("b").geometries.empty());
    ASSERT_NE(reading.first(Code::NoGeometry), nullptr);
    EXPECT_EQ(reading.first(Code::NoGeometry)->where.id, "t");
}

TEST(GmlGeometry, SolidTakesShellsOfBothGmlVersions) {
    const std::string faces = surfaceMember(square("", 0)) + surfaceMember(square("", 1));
    const std::string exteriors[] = {
        "<gml:CompositeSurface>" + faces + "</gml:CompositeSurface>", "<gml:Shell>" + faces + "</gml:Shell>",
        "<gml:Surface><gml:patches>" + square("", 0) + square("", 1) + "</gml:patches></gml:Surface>"};
    for (const std::string& exterior : exteriors) {
        const Reading reading = readGeometry(fmt::format(
            "<gml:Solid gml:id=\"s\"><gml:exterior>{0}</gml:exterior><gml:interior>{0}</gml:interior></gml:Solid>",
            exterior));
        const Geometry& geometry = onlyGeometry(reading);
        ASSERT_EQ(geometry.solids.size(), 1u) << exterior;
        EXPECT_EQ(geometry.kind, GeometryKind::Solid);
        EXPECT_EQ(geometry.id, "s");
        EXPECT_EQ(geometry.solids[0].id, "s");
        EXPECT_EQ(geometry.solids[0].exterior.size(), 2u);
        ASSERT_EQ(geometry.solids[0].interiors.size(), 1u);
        EXPECT_EQ(geometry.solids[0].interiors[0].size(), 2u);
    }
}

TEST(GmlGeometry, MultiAndCompositeSolidsKeepEachSolid) {
    const std::string_view names[] = {"MultiSolid", "CompositeSolid"};
    for (const std::string_view name : names) {
        const Reading reading = readGeometry(fmt::format(
            "<gml:{0} "
            "gml:id=\"m\"><gml:solidMember>{1}</gml:solidMember><gml:solidMember>{2}</gml:solidMember></gml:{0}>",
            name, solid("s1", surfaceMember(square(""))), solid("s2", surfaceMember(square("")))));
        ASSERT_EQ(onlyGeometry(reading).solids.size(), 2u);
        EXPECT_EQ(onlyGeometry(reading).id, "m");
        EXPECT_EQ(onlyGeometry(reading).solids[1].id, "s2");
        EXPECT_EQ(onlyGeometry(reading).isComposite, name == "CompositeSolid");
    }
}

TEST(GmlGeometry, SurfacesAreCompositeByTheirElementAlone) {
    for (const std::string_view name : {"MultiSurface", "CompositeSurface"}) {
        const Reading reading =
            readGeometry(fmt::format("<gml:{0} gml:id=\"m\">{1}</gml:{0}>", name, surfaceMember(square(""))));
        EXPECT_EQ(onlyGeometry(reading).isComposite, name == "CompositeSurface");
    }
    // The composite that a shell is made of says nothing of the solid.
    const Reading solids =
        readGeometry("<gml:Solid gml:id=\"s\"><gml:exterior><gml:CompositeSurface>" + surfaceMember(square("")) +
                     "</gml:CompositeSurface></gml:exterior></gml:Solid>");
    EXPECT_FALSE(onlyGeometry(solids).isComposite);
}

TEST(GmlGeometry, OrientationsOfNestedSurfacesMultiply) {
    const auto turned = [](std::string_view sign, std::string_view base) {
        return fmt::format(
            "<gml:OrientableSurface orientation=\"{}\"><gml:baseSurface>{}</gml:baseSurface></gml:OrientableSurface>",
            sign, base);
    };
    const Reading reading = readGeometry(multiSurface(
        surfaceMember(turned("-", square("a"))) + surfaceMember(turned("+", square("b1"))) +
        surfaceMember(turned("-", turned("-", square("c")))) +
        surfaceMember(turned("-", "<gml:CompositeSurface>" + surfaceMember(square("d")) +
                                      surfaceMember(turned("-", square("e"))) + "</gml:CompositeSurface>")) +
        surfaceMember(
            "<gml:OrientableSurface orientation=\"-\"><gml:baseSurface xlink:href=\"#b1\"/></gml:OrientableSurface>")));
    const auto& uses = onlyGeometry(reading).surfaces;
    ASSERT_EQ(uses.size(), 6u);
    const bool expected[] = {true, false, false, true, false, true};
    for (int i = 0; i < 6; ++i) EXPECT_EQ(uses[i].isReversed, expected[i]) << i;
    EXPECT_EQ(uses[5].polygon, uses[1].polygon);
    EXPECT_EQ(reading.model().polygons.size(), 5u);
}

TEST(GmlGeometry, BadRingsAreReportedAndTheRestIsKept) {
    struct Case {
        std::string_view positions;
        Code code;
    };
    const Case cases[] = {
        {"", Code::TooFewPoints},
        {"0 0 0", Code::TooFewPoints},
        {"0 0 0 1 1 1", Code::TooFewPoints},
        {"0 0 0 1 1 1 0 0 0", Code::TooFewPoints},
        {"0 0 0 1 1 1 1 1 1 0 0 0", Code::TooFewPoints},
        {"0 0 0 1 0 0 1 1 0 0 1", Code::BadValue},
        {"0 0 0 1 NaN 0 1 1 0 0 0 0", Code::BadCoordinate},
        {"0 0 0 1 INF 0 1 1 0 0 0 0", Code::BadCoordinate},
        {"0 0 0 1 1e308 0 1 1 0 0 0 0", Code::BadCoordinate},
        {"0 0 0 1 1e999 0 1 1 0 0 0 0", Code::BadCoordinate},
        {"0 0 0 1 1,5 0 1 1 0 0 0 0", Code::BadCoordinate},
        {"0 0 0 1 0x1 0 1 1 0 0 0 0", Code::BadCoordinate},
        {"0 0 0 1 +-1 0 1 1 0 0 0 0", Code::BadCoordinate},
    };
    for (const Case& bad : cases) {
        const Reading reading = readGeometry(multiSurface(
            std::string(1, '\n').append(surfaceMember("<gml:Polygon gml:id=\"bad\"><gml:exterior>" +
                                                      ring(bad.positions) + "</gml:exterior></gml:Polygon>")) +
            surfaceMember(square("good"))));
        EXPECT_EQ(onlyPolygon(reading).id, "good") << bad.positions;
        ASSERT_EQ(reading.count(bad.code), 1u) << bad.positions << reading.findings();
        EXPECT_EQ(reading.first(bad.code)->where.line, 4u);
        EXPECT_EQ(reading.first(bad.code)->where.id, "bad");
    }
}

TEST(GmlGeometry, BadHoleLeavesThePolygon) {
    const Reading reading = readGeometry(multiSurface(
        surfaceMember("<gml:Polygon><gml:exterior>" + ring("0 0 0 4 0 0 4 4 0 0 0 0") +
                      "</gml:exterior><gml:interior>" + ring("1 1 0 1 2 0") + "</gml:interior></gml:Polygon>")));
    EXPECT_EQ(onlyPolygon(reading).ringEnds, std::vector<std::uint32_t>{3});
    EXPECT_EQ(reading.count(Code::TooFewPoints), 1u);
}

TEST(GmlGeometry, UnknownGeometryIsNotedOnce) {
    const Reading reading = readGeometry(
        multiSurface(surfaceMember("<gml:Sphere/>") + surfaceMember("<gml:Sphere/>") + surfaceMember(square("p"))));
    EXPECT_EQ(reading.model().polygons.size(), 1u);
    EXPECT_EQ(reading.count(Code::UnknownElement), 1u);
}

// ---- references

TEST(CityGmlReader, SharedPolygonIsOneSurfaceWithTwoUses) {
    const Reading reading = readMembers(
        2, building("b", "<bldg:lod2Solid>" + solid("s", surfaceReference("#p") + surfaceReference("#q")) +
                             "</bldg:lod2Solid>"
                             "<bldg:boundedBy><bldg:WallSurface gml:id=\"w\">" +
                             lod2Surfaces(2, multiSurface(surfaceMember(square("p")) + surfaceMember(square("q", 1)))) +
                             "</bldg:WallSurface></bldg:boundedBy>"));
    ASSERT_EQ(reading.model().polygons.size(), 2u);
    const auto& exterior = reading.feature("b").geometries.at(0).solids.at(0).exterior;
    const auto& wall = reading.feature("w").geometries.at(0).surfaces;
    EXPECT_EQ(exterior, wall);
    EXPECT_TRUE(reading.diagnostics.items().empty()) << reading.findings();
}

TEST(CityGmlReader, ReferencesReachSurfacesSolidsAndFeaturesAcrossMembersInAnyOrder) {
    const std::string target = building(
        "t",
        "<bldg:lod2Solid>" +
            solid("ts", surfaceMember(
                            "<gml:CompositeSurface gml:id=\"cs\">" + surfaceMember(square("p")) +
                            surfaceMember("<gml:OrientableSurface gml:id=\"os\" orientation=\"-\"><gml:baseSurface>" +
                                          square("q", 1) + "</gml:baseSurface></gml:OrientableSurface>") +
                            "</gml:CompositeSurface>")) +
            "</bldg:lod2Solid>"
            "<bldg:boundedBy><bldg:WallSurface gml:id=\"w\"><bldg:lod3MultiSurface>" +
            multiSurface(surfaceMember(square("w3"))) + "</bldg:lod3MultiSurface>" +
            lod2Surfaces(2, multiSurface(surfaceMember(square("w2")))) + "</bldg:WallSurface></bldg:boundedBy>");
    const std::string user =
        building("u",
                 "<bldg:lod2Solid xlink:href=\"#ts\"/>"
                 "<bldg:lod3Solid><gml:Solid><gml:exterior xlink:href=\"#cs\"/></gml:Solid></bldg:lod3Solid>" +
                     lod2Surfaces(2, multiSurface(surfaceReference(" #os ") + surfaceReference("w") +
                                                  surfaceReference("#w%32") + surfaceReference("test.gml#p"))));
    for (const std::string& document : {user + target, target + user}) {
        const Reading reading = readMembers(2, document);
        const auto& geometries = reading.feature("u").geometries;
        ASSERT_EQ(geometries.size(), 3u) << reading.findings();
        EXPECT_EQ(geometries[0].solids.at(0).id, "ts");
        EXPECT_EQ(geometries[0].solids.at(0).exterior.size(), 2u);
        EXPECT_EQ(geometries[1].lod, 3);
        EXPECT_EQ(geometries[1].solids.at(0).exterior, geometries[0].solids.at(0).exterior);
        const auto& uses = geometries[2].surfaces;
        ASSERT_EQ(uses.size(), 4u) << reading.findings();
        EXPECT_TRUE(uses[0].isReversed);
        EXPECT_EQ(reading.model().polygons[uses[0].polygon].id, "q");
        EXPECT_EQ(reading.model().polygons[uses[1].polygon].id, "w2") << "of the level that refers to it";
        EXPECT_EQ(reading.model().polygons[uses[2].polygon].id, "w2");
        EXPECT_EQ(reading.model().polygons[uses[3].polygon].id, "p");
        EXPECT_EQ(reading.diagnostics.items().size(), 0u) << reading.findings();
    }
}

TEST(CityGmlReader, DanglingExternalAndCyclicReferencesAreToldWithPlace) {
    const Reading reading = readMembers(
        2, building("b",
                    "\n\n" + lod2Surfaces(
                                 2, multiSurface(
                                        surfaceReference("#none") + surfaceReference("http://example.org/x.gml#a") +
                                        surfaceMember("<gml:CompositeSurface gml:id=\"c1\">" + surfaceReference("#c2") +
                                                      surfaceMember(square("p")) + "</gml:CompositeSurface>") +
                                        surfaceMember("<gml:CompositeSurface gml:id=\"c2\">" + surfaceReference("#c1") +
                                                      "</gml:CompositeSurface>")))));
    ASSERT_EQ(reading.count(Code::DanglingReference), 1u) << reading.findings();
    EXPECT_EQ(reading.first(Code::DanglingReference)->where.file, "test.gml");
    EXPECT_EQ(reading.first(Code::DanglingReference)->where.line, 5u);
    EXPECT_EQ(reading.first(Code::DanglingReference)->where.id, "b");
    EXPECT_NE(reading.first(Code::DanglingReference)->message.find("none"), std::string::npos);
    EXPECT_EQ(reading.count(Code::ExternalReference), 1u);
    EXPECT_GE(reading.count(Code::ReferenceCycle), 1u);
    EXPECT_EQ(reading.model().polygons.size(), 1u);
}

TEST(CityGmlReader, MultiplyingReferencesAreRefused) {
    // Each surface references the next one twice: 2^40 uses.
    std::string members;
    for (int i = 0; i < 40; ++i)
        members += surfaceMember(fmt::format("<gml:CompositeSurface gml:id=\"c{0}\">{1}{1}</gml:CompositeSurface>", i,
                                             surfaceReference(fmt::format("#c{}", i + 1))));
    const Reading reading =
        readMembers(2, building("b", lod2Surfaces(2, multiSurface(members + surfaceMember(square("c40"))))));
    EXPECT_EQ(reading.code(), Code::InputTooBig);
}

TEST(CityGmlReader, LongChainsOfReferencesDoNotOverflowTheStack) {
    std::string members;
    for (int i = 0; i < 5000; ++i)
        members += surfaceMember(fmt::format(
            "<gml:CompositeSurface gml:id=\"c{0}\"><gml:surfaceMember xlink:href=\"#c{1}\"/></gml:CompositeSurface>", i,
            i + 1));
    const Reading reading = readMembers(2, building("b", lod2Surfaces(2, multiSurface(members))));
    EXPECT_GE(reading.count(Code::InputTooBig), 1u);
}

// ---- implicit geometry

std::string implicitGeometry(std::string_view matrix, std::string_view point, std::string_view shape) {
    return fmt::format(
        "<frn:CityFurniture "
        "gml:id=\"{0}\"><frn:lod3ImplicitRepresentation><core:ImplicitGeometry><core:transformationMatrix>{1}</"
        "core:transformationMatrix>"
        "{3}<core:referencePoint><gml:Point><gml:pos>{2}</gml:pos></gml:Point></core:referencePoint></"
        "core:ImplicitGeometry></frn:lod3ImplicitRepresentation></frn:CityFurniture>",
        shape.find("href") == std::string_view::npos ? "f1" : "f2", matrix, point, shape);
}

TEST(CityGmlReader, ImplicitGeometryIsPlacedByMatrixThenPoint) {
    // Rotates by 90 degrees about z, scales by 2, translates by (5, 6, 7); then moves to the reference point.
    const std::string_view matrix = "0 -2 0 5  2 0 0 6  0 0 2 7  0 0 0 1";
    const std::string first =
        implicitGeometry(matrix, "1000 2000 3000",
                         "<core:relativeGMLGeometry>" + std::string("<gml:MultiSurface gml:id=\"shape\">") +
                             surfaceMember(square("p")) + "</gml:MultiSurface></core:relativeGMLGeometry>");
    const std::string second = implicitGeometry("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "10 20 30",
                                                "<core:relativeGMLGeometry xlink:href=\"#shape\"/>");
    const Reading reading = readMembers(2, member(second) + member(first));
    ASSERT_EQ(reading.model().polygons.size(), 2u) << "the prototype itself is nowhere: " << reading.findings();
    const auto& placed = reading.model().polygons[reading.feature("f1").geometries.at(0).surfaces.at(0).polygon].points;
    EXPECT_EQ(placed,
              (std::vector<Vec3d>{{1005, 2006, 3007}, {1005, 2008, 3007}, {1003, 2008, 3007}, {1003, 2006, 3007}}));
    const auto& moved = reading.model().polygons[reading.feature("f2").geometries.at(0).surfaces.at(0).polygon].points;
    EXPECT_EQ(moved, (std::vector<Vec3d>{{10, 20, 30}, {11, 20, 30}, {11, 21, 30}, {10, 21, 30}}));
    EXPECT_EQ(reading.feature("f1").geometries.at(0).lod, 3);
}

TEST(CityGmlReader, ImplicitGeometryOfVersion3AndOtherFiles) {
    const Reading reading = readMembers(
        3,
        member(
            "<frn:CityFurniture "
            "gml:id=\"f\"><core:lod1ImplicitRepresentation><core:ImplicitGeometry><core:transformationMatrix>1 0 0 0 0 "
            "1 0 0 0 0 1 0 0 0 0 1</core:transformationMatrix>"
            "<core:libraryObject>tree.wrl</core:libraryObject><core:referencePoint><gml:Point><gml:pos>1 2 "
            "3</gml:pos></gml:Point></core:referencePoint>"
            "<core:relativeGeometry>" +
            multiSurface(surfaceMember(square("p"))) +
            "</core:relativeGeometry></core:ImplicitGeometry></core:lod1ImplicitRepresentation></frn:CityFurniture>"));
    EXPECT_EQ(onlyPolygon(reading).points[0], (Vec3d{1, 2, 3}));
    EXPECT_EQ(reading.count(Code::ExternalReference), 1u);
}

TEST(CityGmlReader, UnusableImplicitGeometryIsReported) {
    const std::string shape =
        "<core:relativeGMLGeometry>" + multiSurface(surfaceMember(square("p"))) + "</core:relativeGMLGeometry>";
    EXPECT_EQ(readMembers(2, member(implicitGeometry("1 2 3", "0 0 0", shape))).count(Code::BadValue), 1u);
    EXPECT_EQ(
        readMembers(2, member(implicitGeometry("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "", shape))).count(Code::BadValue),
        1u);
    EXPECT_EQ(readMembers(2, member(implicitGeometry("1e9 0 0 0 0 1e9 0 0 0 0 1 0 0 0 0 1", "1e9 9.99e9 0",
                                                     "<core:relativeGMLGeometry>" +
                                                         multiSurface(surfaceMember("<gml:Polygon><gml:exterior>" +
                                                                                    ring("0 0 0 90 0 0 0 90 0") +
                                                                                    "</gml:exterior></gml:Polygon>")) +
                                                         "</core:relativeGMLGeometry>")))
                  .count(Code::BadCoordinate),
              1u);
}

}  // namespace
}  // namespace svt::readers
