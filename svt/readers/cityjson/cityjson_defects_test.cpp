#include <svt/readers/cityjson/cityjson_documents_test.hpp>

#include <random>

namespace svt::readers::test {
namespace {

TEST(CityJsonDefects, BadInstancesAreReportedAndLeftOut) {
    const Reading reading = read(withGeometry(
        R"({"type":"GeometryInstance","template":7,"boundaries":[1]},)"
        R"({"type":"GeometryInstance","template":1,"boundaries":[1]},)"
        R"({"type":"GeometryInstance","template":0,"boundaries":[99]},)"
        R"({"type":"GeometryInstance","template":0,"boundaries":[1],"transformationMatrix":[1,2]})",
        R"(,"geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2.1","boundaries":[[[0,1,2]]]},{"type":"GeometryInstance"}],)"
        R"("vertices-templates":[[0,0,0],[1,0,0],[0,0.25,3]]})"));
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.model().features[0].geometries.empty());
    EXPECT_EQ(reading.diagnostics.count(Code::DanglingReference), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::ReferenceCycle), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::BadIndex), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::BadValue), 1u);
}

TEST(CityJsonDefects, MultipliedTemplatesAreLimited) {
    // 30 kB of template, instantiated 20,000 times with a few bytes each.
    std::string surfaces = "[[0,1,2]]";
    for (int i = 0; i < 3000; ++i) surfaces += ",[[0,1,2]]";
    std::string instances = R"({"type":"GeometryInstance","template":0,"boundaries":[1]})";
    for (int i = 0; i < 20000; ++i) instances += R"(,{"type":"GeometryInstance","template":0,"boundaries":[1]})";
    const Reading reading = read(withGeometry(
        instances, R"(,"geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[)" + surfaces +
                       R"(]}],"vertices-templates":[[0,0,0],[1,0,0],[0,0.25,3]]})"));
    ASSERT_FALSE(reading.result);
    EXPECT_EQ(reading.result.error().code(), Code::InputTooBig);
}

TEST(CityJsonDefects, BadSurfacesAreLeftOutAndTheRestStays) {
    const Reading reading = read(withGeometry(
        R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,8]],[[0,1,-1]],[[0,1,1000000000]],[[0,1.5,2]],[[0,1]],[[0,0,0]],)"
        R"([],[0,1,2],7,[[0,1,3,2],[4,5]],[[0,1,2,0]]]})"));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.diagnostics.count(Code::BadIndex), 4u);
    EXPECT_EQ(reading.diagnostics.count(Code::TooFewPoints), 4u);
    EXPECT_EQ(reading.diagnostics.count(Code::BadValue), 1u);
    ASSERT_EQ(reading.model().polygons.size(), 2u);
    EXPECT_EQ(reading.model().polygons[0].ringEnds, std::vector<std::uint32_t>{4});
    EXPECT_EQ(reading.model().polygons[1].ringEnds, std::vector<std::uint32_t>{3}) << "the closing point is dropped";
}

TEST(CityJsonDefects, WrongNestingLeavesTheGeometryOut) {
    const Reading reading = read(withGeometry(R"({"type":"Solid","lod":"2","boundaries":[[[0,1,2]],[[0,1,3]]]},)"
                                              R"({"type":"MultiSurface","lod":"2","boundaries":[[[[0,1,2]]]]},)"
                                              R"({"type":"Solid","lod":"2","boundaries":3},{"type":"Blob"},5)"));
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.model().features[0].geometries.empty());
    EXPECT_EQ(reading.diagnostics.count(Code::BadValue), 2u);
    EXPECT_EQ(reading.diagnostics.count(Code::BadJson), 2u);
    EXPECT_EQ(reading.diagnostics.count(Code::UnknownElement), 1u);
}

TEST(CityJsonDefects, BadVerticesSpoilOnlyTheirSurfaces) {
    const Reading reading = read(
        R"({"type":"CityJSON","version":"1.0","CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":2,)"
        "\n"
        R"("boundaries":[[[0,1,2]],[[0,1,3]],[[0,1,4]],[[0,1,5]]]}]}},"vertices":[[0.5,0,0],[1,0,0],[0,1,0],[1e999,0,0],[1,2],[1e300,0,0]]})");
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.model().polygons.size(), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::BadCoordinate), 3u);
    ASSERT_EQ(reading.diagnostics.count(Code::BadValue), 1u);
    const Diagnostic& number = reading.diagnostics.items().front();
    EXPECT_EQ(number.code, Code::BadValue);
    EXPECT_EQ(number.where.line, 2u);
    EXPECT_NE(number.message.find("1e999"), std::string::npos);
}

TEST(CityJsonDefects, VerticesThatAreNoIntegersAreAWarning) {
    const auto readOf = [](std::string_view transform) {
        return read(
            R"({"type":"CityJSON","version":"1.0",)" + std::string(transform) +
            R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":2,"boundaries":[[[0,1,2]]]}]}},)"
            R"("vertices":[[0.5,0,0],[1,0,0.25],[0,1,0]]})");
    };
    const Reading reading = readOf(R"("transform":{"scale":[1,1,1],"translate":[0,0,0]},)");
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    ASSERT_EQ(reading.diagnostics.count(Code::BadValue), 1u);
    EXPECT_NE(reading.diagnostics.items().front().message.find("2 vertices are not integers"), std::string::npos);
    EXPECT_EQ(readOf("").diagnostics.count(Code::BadValue), 0u);
}

TEST(CityJsonDefects, MissingMembersAreErrors) {
    const auto codeOf = [](std::string_view text) {
        const Reading reading = read(text);
        return reading.result ? Code::Internal : reading.result.error().code();
    };
    EXPECT_EQ(codeOf(R"({"type":"CityJSON","version":"2.0","CityObjects":{}})"), Code::BadJson);
    EXPECT_EQ(codeOf(R"({"type":"CityJSON","version":"2.0","vertices":[]})"), Code::BadJson);
    EXPECT_EQ(codeOf(R"({"type":"Topology","version":"2.0"})"), Code::BadJson);
    EXPECT_EQ(codeOf(R"({"type":"CityJSONFeature","id":"a","CityObjects":{},"vertices":[]})"), Code::BadJson);
    EXPECT_EQ(codeOf("[]"), Code::BadJson);
    EXPECT_EQ(codeOf(""), Code::BadJson);
    EXPECT_EQ(codeOf("  \n"), Code::BadJson);
    EXPECT_EQ(
        codeOf(
            R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})"),
        Code::BadValue);
}

TEST(CityJsonDefects, EmptyCityObjectsIsAModelWithoutFeatures) {
    const Reading reading = read(document("{}"));
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.model().features.empty());
}

TEST(CityJsonDefects, TruncatedFileIsRefusedWithItsPlace) {
    const std::string text = "{\n\"type\":\"CityJSON\",\n\"vertices\":[[1,2";
    const Reading reading = read(text);
    ASSERT_FALSE(reading.result);
    EXPECT_EQ(reading.result.error().code(), Code::BadJson);
    EXPECT_EQ(reading.result.error().where().line, 3u);
    EXPECT_NE(reading.result.error().message().find("cut off"), std::string::npos);
    EXPECT_EQ(reading.result.error().where().column, 17u) << "behind the last byte";
}

TEST(CityJsonDefects, DepthAndSizeAreLimited) {
    const Reading deep = read(document(R"({"b":{"type":"Building","attributes":{"x":)" + std::string(100000, '[') +
                                       std::string(100000, ']') + "}}}"));
    ASSERT_FALSE(deep.result);
    EXPECT_EQ(deep.result.error().code(), Code::InputTooBig);
    ReadOptions options;
    options.maxBytes = 10;
    const Reading big = read(document("{}"), options);
    ASSERT_FALSE(big.result);
    EXPECT_EQ(big.result.error().code(), Code::InputTooBig);
}

TEST(CityJsonDefects, BytesThatAreNoUtf8AreRefused) {
    const Reading reading = read(document("{\"b\xFF\":{\"type\":\"Building\"}}"));
    ASSERT_FALSE(reading.result);
    EXPECT_EQ(reading.result.error().code(), Code::BadEncoding);
}

TEST(CityJsonDefects, MutatedDocumentsGiveAModelOrAnError) {
    const std::string whole = withGeometry(
        cube(
            R"(,"semantics":{"surfaces":[{"type":"WallSurface","id":"w"},{"type":"Door","parent":0}],"values":[[0,1,0,0,null,0]]},"material":{"t":{"value":0}})") +
            R"(,{"type":"GeometryInstance","template":0,"boundaries":[1],"transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})",
        R"(,"appearance":{"materials":[{"name":"a"}]},"geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]})");
    std::mt19937 random(20240607);
    int models = 0, errors = 0;
    for (const std::string& document : {whole, sequence()})
        for (int round = 0; round < 1000; ++round) {
            std::string text = document;
            const int flips = 1 + static_cast<int>(random() % 4);
            for (int k = 0; k < flips; ++k) {
                const std::size_t at = random() % text.size();
                switch (random() % 4) {
                    case 0: text[at] = static_cast<char>(random() % 256); break;
                    case 1: text[at] = "0123456789[]{},:\"-e."[random() % 20]; break;
                    case 2: text.erase(at, 1 + random() % 8); break;
                    default:
                        if (random() % 4 == 0) text.resize(at + 1);
                }
                if (text.empty()) text.push_back('{');
            }
            const Reading reading = read(text);
            (reading.result ? models : errors) += 1;
            if (!reading.result) {
                EXPECT_FALSE(reading.result.error().message().empty());
                continue;
            }
            for (const Feature& feature : reading.model().features)
                for (const auto& geometry : feature.geometries)
                    for (const auto& use : geometry.surfaces) ASSERT_LT(use.polygon, reading.model().polygons.size());
        }
    EXPECT_GT(models, 100);
    EXPECT_GT(errors, 100);
}

}  // namespace
}  // namespace svt::readers::test
