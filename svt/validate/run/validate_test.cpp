#include <svt/validate/validate.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace svt::validate {
namespace {

using Faces = std::vector<std::vector<Vec3d>>;

// Six faces that look outwards.
Faces box(Vec3d a, Vec3d b) {
    const Vec3d p[8] = {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z},
                        {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}};
    return {{p[0], p[3], p[2], p[1]}, {p[4], p[5], p[6], p[7]}, {p[0], p[1], p[5], p[4]},
            {p[1], p[2], p[6], p[5]}, {p[2], p[3], p[7], p[6]}, {p[3], p[0], p[4], p[7]}};
}

Faces inwards(Faces faces) {
    for (auto& face : faces) std::reverse(face.begin(), face.end());
    return faces;
}

Faces joined(Faces a, const Faces& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

using Shells = std::vector<Faces>;

class TestModel {
public:
    model::FeatureIndex addFeature(const std::string& id, const std::string& className, model::FeatureIndex parent) {
        model::Feature feature;
        feature.id = id;
        feature.className = className;
        return model.addFeature(std::move(feature), parent);
    }

    void addSolids(model::FeatureIndex feature, const std::vector<Shells>& solids, bool isComposite = false) {
        model::Geometry geometry;
        geometry.kind = model::GeometryKind::Solid;
        geometry.lod = 1;
        geometry.isComposite = isComposite;
        for (const Shells& shells : solids) {
            model::Solid solid;
            for (std::size_t s = 0; s < shells.size(); ++s)
                (s == 0 ? solid.exterior : solid.interiors.emplace_back()) = usesOf(shells[s]);
            geometry.solids.push_back(std::move(solid));
        }
        model.features[feature].geometries.push_back(std::move(geometry));
    }

    std::vector<model::SurfaceUse> usesOf(const Faces& faces) {
        std::vector<model::SurfaceUse> uses;
        for (const auto& face : faces) {
            model::Polygon polygon;
            polygon.points = face;
            polygon.ringEnds = {static_cast<std::uint32_t>(face.size())};
            uses.push_back({model.addPolygon(std::move(polygon)), false});
        }
        return uses;
    }

    model::BuildingModel model;
};

ValidationReport reportOf(const model::BuildingModel& model, const ValidateOptions& options = {}) {
    auto report = validateModel(model, options);
    EXPECT_TRUE(report);
    return report ? *report : ValidationReport{};
}

ValidationReport reportOfSolids(const std::vector<Shells>& solids, bool isComposite = false) {
    TestModel test;
    test.addSolids(test.addFeature("b", "Building", model::kNoFeature), solids, isComposite);
    return reportOf(test.model);
}

std::set<Code> codesOf(const ValidationReport& report) {
    std::set<Code> codes;
    for (const auto& entry : report.counts) codes.insert(entry.first);
    return codes;
}

std::set<Code> codesOfShells(const Shells& shells) { return codesOf(reportOfSolids({shells})); }

std::optional<double> volumeOfOnly(const ValidationReport& report) {
    return report.volumes.size() == 1 ? report.volumes.begin()->second.volume : std::nullopt;
}

const Faces kBox = box({0, 0, 0}, {9, 9, 9});

TEST(Validate, ABoxWithAVoidIsValidAndHasItsVolume) {
    const ValidationReport report = reportOfSolids({{kBox, inwards(box({2, 2, 2}, {4, 4, 4}))}});
    EXPECT_EQ(codesOf(report), std::set<Code>{});
    EXPECT_NEAR(volumeOfOnly(report).value_or(0), 729 - 8, 1e-9);
    EXPECT_EQ(report.features.at("Building").valid, 1u);
    EXPECT_EQ(report.primitives.at("Solid").valid, 1u);
    EXPECT_EQ(report.polygonCount, 12u);
}

TEST(Validate, FindsShellsWithMissingTurnedAndSurplusFaces) {
    EXPECT_EQ(codesOfShells({Faces(kBox.begin(), kBox.begin() + 3)}), std::set{Code::TooFewFaces});
    EXPECT_EQ(codesOfShells({Faces(kBox.begin(), kBox.begin() + 5)}), std::set{Code::ShellNotClosed});
    Faces turned = kBox;
    std::reverse(turned[2].begin(), turned[2].end());
    const ValidationReport report = reportOfSolids({{turned}});
    EXPECT_EQ(codesOf(report), std::set{Code::FaceTurnedOver});
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_EQ(report.findings[0].polygon, 2u) << "of six faces that disagree the one is wrong";
    EXPECT_EQ(codesOfShells({joined(kBox, {{{0, 0, 0}, {9, 0, 0}, {9, 9, 9}, {0, 9, 9}}})}),
              std::set{Code::NonManifold});
}

TEST(Validate, FindsEdgesThatMatchOnlyInParts) {
    // A point in the middle of an edge of the top, that the wall beside does not have.
    Faces tight = kBox;
    tight[1].insert(tight[1].begin() + 1, Vec3d{4, 0, 9});
    EXPECT_EQ(codesOfShells({tight}), std::set{Code::TJunction});
    tight[2].insert(tight[2].begin() + 3, Vec3d{4, 0, 9});
    EXPECT_EQ(codesOfShells({tight}), std::set<Code>{});
}

TEST(Validate, FindsPartsThatTouchInAPointOrNotAtAll) {
    EXPECT_EQ(codesOfShells({joined(kBox, box({9, 9, 9}, {12, 12, 12}))}), std::set{Code::NonManifold});
    EXPECT_EQ(codesOfShells({joined(kBox, box({20, 0, 0}, {29, 9, 9}))}), std::set{Code::ShellDisconnected});
    EXPECT_EQ(codesOfShells({joined(kBox, {{{20, 0, 0}, {29, 0, 0}, {29, 9, 0}}})}), std::set{Code::ShellDisconnected});
}

// A box with a pyramid instead of its top, whose tip is at a height.
Faces roofed(double height) {
    Faces faces = kBox;
    faces.erase(faces.begin() + 1);
    const Vec3d tip{4, 4, height};
    const Vec3d top[4] = {{0, 0, 9}, {9, 0, 9}, {9, 9, 9}, {0, 9, 9}};
    for (int i = 0; i < 4; ++i) faces.push_back({top[i], top[(i + 1) % 4], tip});
    return faces;
}

TEST(Validate, FindsShellsThatIntersectThemselves) {
    EXPECT_EQ(codesOfShells({roofed(12)}), std::set<Code>{});
    EXPECT_EQ(codesOfShells({roofed(0.00001)}), std::set<Code>{});
    EXPECT_EQ(codesOfShells({roofed(0)}), std::set{Code::ShellSelfIntersects}) << "the tip touches the floor";
    const ValidationReport report = reportOfSolids({{roofed(-3)}});
    EXPECT_EQ(codesOf(report), std::set{Code::ShellSelfIntersects});
    ASSERT_EQ(report.volumes.size(), 1u);
    EXPECT_FALSE(volumeOfOnly(report));
    EXPECT_EQ(report.volumes.begin()->second.reason, Code::ShellSelfIntersects);
}

TEST(Validate, FindsShellsThatLookTheWrongWayAndKeepsTheirVolume) {
    const ValidationReport report = reportOfSolids({{inwards(kBox)}});
    EXPECT_EQ(codesOf(report), std::set{Code::ShellTurnedOver});
    EXPECT_NEAR(volumeOfOnly(report).value_or(0), 729, 1e-9);
    EXPECT_EQ(codesOfShells({kBox, box({2, 2, 2}, {4, 4, 4})}), std::set{Code::ShellTurnedOver});
}

TEST(Validate, FindsVoidsThatStickOutShareFacesRepeatOrLieOutside) {
    const auto withVoid = [](Vec3d a, Vec3d b) { return codesOfShells({kBox, inwards(box(a, b))}); };
    EXPECT_EQ(withVoid({2, 2, 2}, {4, 4, 12}), std::set{Code::ShellsIntersect});
    EXPECT_EQ(withVoid({2, 2, 2}, {4, 4, 9.00001}), std::set{Code::ShellsIntersect});
    EXPECT_EQ(withVoid({2, 2, 2}, {4, 4, 9}), std::set{Code::ShellsIntersect}) << "a part of a face in common";
    EXPECT_EQ(withVoid({-1, -1, -1}, {10, 10, 10}), std::set{Code::ShellsIntersect}) << "the void is around the box";
    EXPECT_EQ(withVoid({12, 2, 2}, {14, 4, 4}), std::set{Code::InnerShellOutside});
    // A tip of a pyramid, ten micrometres out of the top.
    const Vec3d base[4] = {{2, 2, 2}, {6, 2, 2}, {6, 6, 2}, {2, 6, 2}}, tip{4, 4, 9.00001};
    Faces pyramid{{base[0], base[1], base[2], base[3]}};
    for (int i = 0; i < 4; ++i) pyramid.push_back({base[(i + 1) % 4], base[i], tip});
    EXPECT_EQ(codesOfShells({kBox, pyramid}), std::set{Code::ShellsIntersect});
    for (std::size_t i = 1; i < 5; ++i) pyramid[i][2].z = 9;
    EXPECT_EQ(codesOfShells({kBox, pyramid}), std::set<Code>{}) << "touches the top in a point";
    const Faces inner = inwards(box({2, 2, 2}, {4, 4, 4}));
    EXPECT_EQ(codesOfShells({kBox, inner, inner}), std::set{Code::DuplicateShell});
    EXPECT_EQ(codesOfShells({kBox, inner, inwards(box({3, 3, 3}, {6, 6, 6}))}), std::set{Code::ShellsIntersect});
    EXPECT_EQ(codesOfShells({kBox, inner, inwards(box({4, 2, 2}, {6, 4, 4}))}), std::set{Code::ShellsIntersect});
    EXPECT_EQ(codesOfShells({kBox, inner, inwards(box({4, 4, 2}, {6, 6, 4}))}), std::set<Code>{})
        << "an edge in common";
}

// Two pyramids base to base: a ring across the box at x = 4 whose tips lie at x = 2 and x = `tip`.
Faces diaphragm(double low, double tip) {
    const Vec3d ring[4] = {{4, low, low}, {4, 9, low}, {4, 9, 9}, {4, low, 9}};
    Faces faces;
    for (int i = 0; i < 4; ++i) {
        faces.push_back({ring[i], ring[(i + 1) % 4], {2, 5, 5}});
        faces.push_back({ring[(i + 1) % 4], ring[i], {tip, 5, 5}});
    }
    return faces;
}

TEST(Validate, FindsVoidsThatCutTheInteriorInTwo) {
    EXPECT_EQ(codesOfShells({kBox, diaphragm(0, 6)}), std::set{Code::SolidSplit});
    EXPECT_EQ(codesOfShells({kBox, diaphragm(1, 6)}), std::set<Code>{}) << "open along two sides";
}

TEST(Validate, FindsCompositesThatOverlapRepeatOrHaveGaps) {
    const auto composite = [](const Faces& other) { return codesOf(reportOfSolids({{kBox}, {other}}, true)); };
    EXPECT_EQ(composite(box({9, 0, 0}, {18, 9, 9})), std::set<Code>{});
    EXPECT_EQ(composite(box({9, 2, 2}, {18, 7, 12})), std::set<Code>{}) << "a part of a face in common";
    EXPECT_EQ(composite(box({8.99, 0, 0}, {18, 9, 9})), std::set{Code::SolidsIntersect});
    EXPECT_EQ(composite(box({2, 2, 2}, {4, 4, 4})), std::set{Code::SolidsIntersect}) << "one within the other";
    EXPECT_EQ(composite(kBox), std::set{Code::DuplicateSolid});
    EXPECT_EQ(composite(box({12, 0, 0}, {18, 9, 9})), std::set{Code::SolidsDisconnected});
    EXPECT_EQ(composite(box({9, 9, 0}, {18, 18, 9})), std::set{Code::SolidsDisconnected}) << "an edge is not enough";
}

TEST(Validate, SolidsOfAMultiSolidMayOverlapButHaveNoVolumeThen) {
    const ValidationReport apart = reportOfSolids({{kBox}, {box({12, 0, 0}, {18, 9, 9})}});
    EXPECT_EQ(codesOf(apart), std::set<Code>{});
    EXPECT_NEAR(volumeOfOnly(apart).value_or(0), 729 + 486, 1e-9);
    const ValidationReport twice = reportOfSolids({{kBox}, {kBox}});
    EXPECT_EQ(codesOf(twice), std::set<Code>{});
    EXPECT_FALSE(volumeOfOnly(twice));
    EXPECT_EQ(twice.volumes.begin()->second.reason, Code::DuplicateSolid);
}

TEST(Validate, FindsBuildingPartsThatOverlapAndLeavesBeWhatIsAllowed) {
    TestModel test;
    const auto building = test.addFeature("b", "Building", model::kNoFeature);
    test.addSolids(test.addFeature("west", "BuildingPart", building), {{kBox}});
    test.addSolids(test.addFeature("east", "BuildingPart", building), {{box({8.99, 0, 0}, {18, 9, 9})}});
    const ValidationReport report = reportOf(test.model);
    EXPECT_EQ(codesOf(report), std::set{Code::PartsOverlap});
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_EQ(test.model.features[report.findings[0].feature].id, "west");
    EXPECT_NEAR(report.findings[0].value.value_or(0), 0.01, 1e-3);
    ValidateOptions options;
    options.overlap = 0.01;
    EXPECT_EQ(codesOf(reportOf(test.model, options)), std::set<Code>{});
    // The same bodies in two buildings are no parts of each other.
    test.model.features[2].parent = model::kNoFeature;
    test.model.features[building].children.pop_back();
    test.model.roots.push_back(2);
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set<Code>{});
}

TEST(Validate, ACompositeSurfaceMayHaveABorderAMultiSurfaceAnyFaces) {
    TestModel test;
    const auto feature = test.addFeature("r", "Road", model::kNoFeature);
    model::Geometry geometry;
    geometry.surfaces = test.usesOf({{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}}, {{20, 0, 0}, {29, 0, 0}, {29, 9, 0}}});
    test.model.features[feature].geometries.push_back(geometry);
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set<Code>{});
    test.model.features[feature].geometries[0].isComposite = true;
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set{Code::ShellDisconnected});
    test.model.polygons[1].points[0] = {9, 0, 0};
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set{Code::NonManifold}) << "a point in common";
    test.model.polygons[1].points[2] = {9, 9, 0};
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set<Code>{}) << "an edge in common";
}

TEST(Validate, AFaceOfASolidAndOfAWallIsReportedOnceWithTheSolid) {
    TestModel test;
    const auto building = test.addFeature("b", "Building", model::kNoFeature);
    const auto wall = test.addFeature("w", "WallSurface", building);
    Faces bent = kBox;
    bent[1][0].z = 10;
    model::Geometry solid, surface;
    solid.kind = model::GeometryKind::Solid;
    solid.solids.emplace_back().exterior = test.usesOf(bent);
    surface.surfaces = {solid.solids[0].exterior[1]};
    test.model.features[wall].geometries.push_back(surface);
    test.model.features[building].geometries.push_back(solid);
    const ValidationReport report = reportOf(test.model);
    ASSERT_FALSE(report.findings.empty());
    EXPECT_EQ(report.counts.at(Code::NonPlanar), 1u);
    EXPECT_EQ(report.findings[0].feature, building);
    EXPECT_EQ(report.findings[0].polygon, 1u);
}

TEST(Validate, TheReportDoesNotDependOnThreads) {
    TestModel test;
    for (int i = 0; i < 200; ++i) {
        Faces faces = box({i * 10.0, 0, 0}, {i * 10.0 + 9, 9, 9});
        if (i % 3 == 0) faces.pop_back();
        if (i % 3 == 1) std::reverse(faces[i % 5].begin(), faces[i % 5].end());
        test.addSolids(test.addFeature("b" + std::to_string(i), "Building", model::kNoFeature), {{faces}});
    }
    ValidateOptions one, many;
    one.threads = 1;
    many.threads = 7;
    const ValidationReport a = reportOf(test.model, one), b = reportOf(test.model, many);
    ASSERT_EQ(a.findings.size(), 134u);
    ASSERT_EQ(b.findings.size(), a.findings.size());
    for (std::size_t i = 0; i < a.findings.size(); ++i) {
        EXPECT_EQ(a.findings[i].feature, b.findings[i].feature);
        EXPECT_EQ(a.findings[i].code, b.findings[i].code);
        EXPECT_EQ(a.findings[i].at, b.findings[i].at);
    }
}

TEST(Validate, RefusesTolerancesOutOfRange) {
    const auto codeFor = [](auto change) {
        ValidateOptions options;
        change(options);
        const auto report = validateModel(model::BuildingModel{}, options);
        return report ? Code::Internal : report.error().code();
    };
    EXPECT_EQ(codeFor([](ValidateOptions&) {}), Code::Internal);
    EXPECT_EQ(codeFor([](ValidateOptions& o) { o.snap = -1; }), Code::BadArgument);
    EXPECT_EQ(codeFor([](ValidateOptions& o) { o.planarity = 0; }), Code::BadArgument);
    EXPECT_EQ(codeFor([](ValidateOptions& o) { o.normalsDegrees = 200; }), Code::BadArgument);
    EXPECT_EQ(codeFor([](ValidateOptions& o) { o.overlap = kInfinity; }), Code::BadArgument);
}

TEST(Validate, EveryGeometryCodeHasANumberANameAndATerm) {
    for (int code = 220; code <= 242; ++code) {
        const Code known = static_cast<Code>(code);
        const int number = val3dityCode(known);
        EXPECT_NE(number, 0) << codeTag(known);
        EXPECT_FALSE(val3dityName(number).empty()) << codeTag(known);
        EXPECT_FALSE(isoTerm(known).empty()) << codeTag(known);
    }
}

// Cell spaces with states and transitions, as readers make them of IndoorGML.
class Indoor : public TestModel {
public:
    model::FeatureIndex addCell(const std::string& id, const Faces& shell,
                                model::FeatureIndex layer = model::kNoFeature) {
        const model::FeatureIndex cell = addFeature(id, "BuildingRoom", model::kNoFeature);
        model.features[cell].attributes.push_back({"cellSpaceClass", std::string("CellSpace"), ""});
        addSolids(cell, {{shell}});
        if (layer != model::kNoFeature) model.memberships.push_back({layer, cell, "member"});
        return cell;
    }
    void addState(const std::string& id, const std::string& cell, Vec3d at) {
        const model::FeatureIndex state = addFeature(id, "State", model::kNoFeature);
        model.features[state].attributes.push_back({"duality", cell, ""});
        model.lines.push_back({state, {at}});
    }
    void addTransition(const std::string& id, const std::string& from, const std::string& to) {
        const model::FeatureIndex transition = addFeature(id, "Transition", model::kNoFeature);
        model.features[transition].attributes.push_back({"from", from, ""});
        model.features[transition].attributes.push_back({"to", to, ""});
        model.lines.push_back({transition, {{0, 0, 0}, {2, 2, 2}}});
    }
};

TEST(ValidateIndoor, CellSpacesThatTouchAreValidAndThoseThatOverlapAreNot) {
    Indoor beside;
    beside.addCell("a", kBox);
    beside.addCell("b", box({9, 0, 0}, {12, 9, 9}));
    EXPECT_EQ(codesOf(reportOf(beside.model)), std::set<Code>{});

    Indoor over;
    over.addCell("a", kBox);
    over.addCell("b", box({8, 1, 1}, {12, 8, 8}));
    over.addCell("c", kBox);
    const ValidationReport report = reportOf(over.model);
    EXPECT_EQ(codesOf(report), std::set{Code::CellsOverlap});
    EXPECT_EQ(report.counts.at(Code::CellsOverlap), 3u) << "a and b, a and c, b and c";
    EXPECT_EQ(report.features.at("BuildingRoom").total, 3u);
    EXPECT_EQ(report.features.at("BuildingRoom").valid, 1u) << "the findings are on a and b";
    ValidateOptions patient;
    patient.overlap = 0.6;
    EXPECT_EQ(reportOf(over.model, patient).counts.at(Code::CellsOverlap), 1u) << "the same twice";
}

TEST(ValidateIndoor, CellSpacesOfDifferentLayersMayOverlap) {
    Indoor test;
    const auto one = test.addFeature("l1", "CityObjectGroup", model::kNoFeature);
    const auto other = test.addFeature("l2", "CityObjectGroup", model::kNoFeature);
    test.addCell("a", kBox, one);
    test.addCell("b", kBox, other);
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set<Code>{});
    test.addCell("c", kBox);
    EXPECT_EQ(reportOf(test.model).counts.at(Code::CellsOverlap), 2u) << "c is in no layer, so in all";
}

TEST(ValidateIndoor, StatesLieInTheirCellSpaceOrOnItsSurface) {
    Indoor good;
    good.addCell("a", kBox);
    good.addState("s", "a", {1, 2, 3});
    good.addState("t", "a", {0, 4, 4});
    good.addState("u", "a", {9, 9, 9});
    EXPECT_EQ(codesOf(reportOf(good.model)), std::set<Code>{});
    for (const auto& [at, distance] :
         {std::pair{Vec3d{11, 4, 4}, 2.0}, {Vec3d{4, 4, -0.01}, 0.01}, {Vec3d{1e7, 0, 0}, 1e7 - 9}}) {
        Indoor bad;
        bad.addCell("a", kBox);
        bad.addState("s", "a", at);
        const ValidationReport report = reportOf(bad.model);
        ASSERT_EQ(codesOf(report), std::set{Code::StateOutsideCell});
        EXPECT_NEAR(report.findings[0].value.value_or(0), distance, 1e-5);
        EXPECT_EQ(report.findings[0].at, at);
    }
}

TEST(ValidateIndoor, AStateInTheNotchOfItsCellSpaceIsOutside) {
    // An L of two arms 3 m wide, 9 m long.
    const Vec3d p[6] = {{0, 0, 0}, {9, 0, 0}, {9, 3, 0}, {3, 3, 0}, {3, 9, 0}, {0, 9, 0}};
    const Vec3d up{0, 0, 3};
    Faces ell{{p[5], p[4], p[3], p[2], p[1], p[0]}, {p[0] + up, p[1] + up, p[2] + up, p[3] + up, p[4] + up, p[5] + up}};
    for (int i = 0; i < 6; ++i) ell.push_back({p[i], p[(i + 1) % 6], p[(i + 1) % 6] + up, p[i] + up});
    Indoor test;
    test.addCell("a", ell);
    test.addState("s", "a", {1, 7, 1});
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set<Code>{});
    test.addState("t", "a", {5, 7, 1});
    const ValidationReport report = reportOf(test.model);
    ASSERT_EQ(codesOf(report), std::set{Code::StateOutsideCell});
    EXPECT_NEAR(report.findings[0].value.value_or(0), 2, 1e-5);
}

TEST(ValidateIndoor, TransitionsJoinCellSpacesThatTouch) {
    Indoor test;
    test.addCell("a", kBox);
    test.addCell("b", box({9, 0, 0}, {12, 9, 9}));
    test.addCell("c", box({12.5, 0, 0}, {15, 9, 9}));
    test.addState("sa", "a", {4, 4, 4});
    test.addState("sb", "b", {10, 4, 4});
    test.addState("sc", "c", {13, 4, 4});
    test.addTransition("t1", "sa", "sb");
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set<Code>{});
    test.addTransition("t2", "sb", "sc");
    const ValidationReport report = reportOf(test.model);
    ASSERT_EQ(codesOf(report), std::set{Code::CellsNotAdjacent});
    EXPECT_EQ(report.findings[0].message, "the transition 't2' leads to the cell space 'c', which it does not touch");
    EXPECT_EQ(report.findings[0].marks.size(), 1u);
}

TEST(ValidateIndoor, CellSpacesThatAreNotValidAreNotCompared) {
    Indoor test;
    test.addCell("a", Faces(kBox.begin(), kBox.begin() + 5));
    test.addCell("b", kBox);
    test.addState("s", "a", {50, 50, 50});
    EXPECT_EQ(codesOf(reportOf(test.model)), std::set{Code::ShellNotClosed});
}

TEST(Validate, NumbersOfIndoorGmlAreThoseOfVal3dity) {
    EXPECT_EQ(val3dityCode(Code::CellsOverlap), 701);
    EXPECT_EQ(val3dityCode(Code::StateOutsideCell), 702);
    EXPECT_EQ(val3dityCode(Code::DualityBroken), 703);
    EXPECT_EQ(val3dityCode(Code::CellsNotAdjacent), 704);
    for (const int code : {701, 702, 703, 704}) EXPECT_NE(val3dityName(code), "");
}

}  // namespace
}  // namespace svt::validate
