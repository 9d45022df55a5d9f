// Features read one by one are those that the reader of the whole file gives, to the last bit.
#include <svt/core/deflate.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/readers/feature_file.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/city_sample.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <map>

namespace svt::city {
namespace {

using readers::FeatureFile;
using readers::FeatureFormat;
using readers::FeatureText;

void describe(const model::BuildingModel& model, const std::vector<model::SurfaceUse>& uses, std::string& to) {
    for (const model::SurfaceUse& use : uses) {
        to += use.isReversed ? " -(" : " (";
        for (const Vec3d& p : model.polygons[use.polygon].points)
            for (const double value : {p.x, p.y, p.z}) to += std::to_string(std::bit_cast<std::uint64_t>(value)) + ",";
        for (const std::uint32_t end : model.polygons[use.polygon].ringEnds) to += "|" + std::to_string(end);
        to += ")";
    }
}

// All of a model that belongs to its features, by id.
void describe(const model::BuildingModel& model, std::map<std::string, std::string>& to) {
    for (const model::Feature& feature : model.features) {
        std::string text = feature.className + " " + feature.name;
        if (feature.parent != model::kNoFeature) text += " in " + model.features[feature.parent].id;
        for (const Attribute& attribute : feature.attributes)
            text += " " + attribute.name + "=" + toText(attribute.value);
        for (const model::Geometry& geometry : feature.geometries) {
            text += " lod" + std::to_string(geometry.lod);
            describe(model, geometry.surfaces, text);
            for (const model::Solid& solid : geometry.solids) {
                text += " solid";
                describe(model, solid.exterior, text);
                for (const auto& interior : solid.interiors) describe(model, interior, text);
            }
        }
        EXPECT_TRUE(to.emplace(feature.id, text).second) << feature.id;
    }
}

readers::ReadOptions reading(int axisOrder) {
    readers::ReadOptions options;
    options.axisOrder = axisOrder;
    options.keepFarFeatures = true;
    return options;
}

// \return number of features that the file was cut into
std::size_t expectSameFeatures(const std::filesystem::path& path) {
    const auto whole = readers::readModel(path, reading(0));
    EXPECT_TRUE(whole) << whole.error().toString();
    std::map<std::string, std::string> expected, found;
    describe(*whole, expected);
    // One after the other; then by their spans, in a new object.
    std::vector<readers::FeatureSpan> spans;
    std::vector<std::string> texts;
    auto file = FeatureFile::open(path);
    EXPECT_TRUE(file) << file.error().toString();
    for (FeatureText feature;;) {
        const auto next = file->next(feature);
        EXPECT_TRUE(next) << next.error().toString();
        if (!next || !*next) break;
        spans.push_back(feature.span);
        texts.emplace_back(feature.text);
    }
    auto again = FeatureFile::open(path);
    std::size_t picked = 0;
    readers::ReadOptions options = reading(whole->crs.axesSwapped ? -1 : 1);
    options.crs = whole->crs.epsg;
    const auto done = again->pick(spans, [&](std::size_t n, std::string_view text) -> Result<void> {
        EXPECT_EQ(text, texts[n]);
        ++picked;
        SVT_TRY(model, again->read(std::span(&text, 1), options, nullptr));
        describe(*model, found);
        return {};
    });
    EXPECT_TRUE(done) << done.error().toString();
    EXPECT_EQ(picked, spans.size());
    EXPECT_EQ(found.size(), expected.size());
    for (const auto& [id, text] : expected) EXPECT_EQ(found[id], text) << id;
    return spans.size();
}

void writeGzip(const std::filesystem::path& path, const std::string& text) {
    const auto packed = gzipBytes(std::as_bytes(std::span(text)));
    test::writeText(path, {reinterpret_cast<const char*>(packed.data()), packed.size()});
}

TEST(FeatureFile, GivesTheDistrictOfEachFormat) {
    const test::TemporaryFolder folder;
    samples::SampleOptions options;
    options.columns = 2;
    options.rows = 2;
    for (const auto format : {samples::SampleFormat::CityGml3, samples::SampleFormat::CityGml2,
                              samples::SampleFormat::CityJson2, samples::SampleFormat::CityJsonSeq2}) {
        const auto text = writeSample(samples::SampleKind::District, format, options);
        ASSERT_TRUE(text);
        test::writeText(folder / "plain", *text);
        EXPECT_GE(expectSameFeatures(folder / "plain"), 4u) << int(format);
        writeGzip(folder / "packed.gz", *text);
        EXPECT_GE(expectSameFeatures(folder / "packed.gz"), 4u) << int(format);
    }
}

TEST(FeatureFile, GivesTheBuildingsOfEachCity) {
    const test::TemporaryFolder folder;
    for (const auto profile : {samples::CityProfile::Dutch, samples::CityProfile::Berlin, samples::CityProfile::NewYork,
                               samples::CityProfile::Plateau}) {
        std::string text;
        ASSERT_TRUE(samples::writeCitySample({profile, 40, 1, 7}, 0, [&](std::string_view part) {
            text += part;
            return true;
        }));
        test::writeText(folder / "plain", text);
        EXPECT_EQ(expectSameFeatures(folder / "plain"), 40u);
        writeGzip(folder / "packed.gz", text);
        EXPECT_EQ(expectSameFeatures(folder / "packed.gz"), 40u);
    }
}

TEST(FeatureFile, GivesTheBuildingsOfBerlin) {
    SVT_NEEDS_DATA(path, "berlin_lod2_citygml1.gml");
    EXPECT_EQ(expectSameFeatures(path), 61u);
}

TEST(FeatureFile, GivesAHundredBuildings) {
    SVT_NEEDS_DATA(path, "100_buildings_lod2_citygml3.gml");
    EXPECT_EQ(expectSameFeatures(path), 100u);
}

TEST(FeatureFile, GivesAHouseOfCityJson) {
    SVT_NEEDS_DATA(path, "fzk_haus.city.json");
    EXPECT_GE(expectSameFeatures(path), 1u);
}

TEST(FeatureFile, TakesAnIfcFileAsOneFeature) {
    SVT_NEEDS_DATA(path, "samplehouse.ifc");
    EXPECT_EQ(expectSameFeatures(path), 1u);
}

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\" "
    "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" xmlns:gml=\"http://www.opengis.net/gml\">\n";

std::vector<std::string> featuresOf(const std::filesystem::path& path, std::string& error) {
    std::vector<std::string> texts;
    auto file = FeatureFile::open(path);
    if (!file) {
        error = codeName(file.error().code());
        return texts;
    }
    for (FeatureText feature;;) {
        const auto next = file->next(feature);
        if (!next) error = codeName(next.error().code());
        if (!next || !*next) return texts;
        texts.emplace_back(feature.text);
    }
}

TEST(FeatureFile, CutsBetweenMembersOnly) {
    const test::TemporaryFolder folder;
    const std::string first =
                          "<cityObjectMember><bldg:Building gml:id=\"a>b\"><!-- </cityObjectMember> "
                          "--><gml:name><![CDATA[</x>]]></gml:name>"
                          "</bldg:Building></cityObjectMember>",
                      second = "<cityObjectMember/>";
    test::writeText(folder / "f", std::string(kHead) + "<gml:name>city</gml:name><!-- c -->" + first +
                                      "\n<appearanceMember><x/></appearanceMember>" + second + "</CityModel>\n");
    std::string error;
    EXPECT_EQ(featuresOf(folder / "f", error), (std::vector<std::string>{first, second}));
    EXPECT_EQ(error, "");
}

TEST(FeatureFile, NamesWhatIsDamaged) {
    const test::TemporaryFolder folder;
    const auto errorOf = [&](const std::string& text) {
        test::writeText(folder / "f", text);
        std::string error;
        featuresOf(folder / "f", error);
        return error;
    };
    const std::string head(kHead), json = R"({"type":"CityJSON","version":"2.0","CityObjects":)";
    EXPECT_EQ(errorOf(head + "<cityObjectMember><bldg:Building>"), "BadXml");
    EXPECT_EQ(errorOf(head + "<cityObjectMember><!-- "), "BadXml");
    EXPECT_EQ(errorOf(head + "<cityObjectMember a=\""), "BadXml");
    EXPECT_EQ(errorOf(head + "<cityObjectMember/>"), "BadXml");
    EXPECT_EQ(errorOf(head + "x</CityModel>"), "BadXml");
    EXPECT_EQ(errorOf(head + "<cityObjectMember><!DOCTYPE x></cityObjectMember>"), "DtdRefused");
    EXPECT_EQ(errorOf(json + R"({},"vertices":[])"), "BadJson");
    EXPECT_EQ(errorOf(json + R"({"a":{},"vertices":[]})"), "BadJson");
    EXPECT_EQ(errorOf(json + R"([],"vertices":[]})"), "BadJson");
    EXPECT_EQ(errorOf(json + R"({}})"), "BadJson");
    EXPECT_EQ(errorOf(std::string("\xFF\xFE<\0C\0", 6)), "BadEncoding");
    EXPECT_EQ(errorOf(std::string("\x1F\x8B\x08\0\0\0\0\0\0\xFF", 10) + std::string(40, '\xAB')), "CannotOpen");
    std::string whole;
    EXPECT_EQ(whole = errorOf(head + "</CityModel>"), "");
    std::string text = head + "<cityObjectMember/></CityModel>";
    const auto packed = gzipBytes(std::as_bytes(std::span(text)));
    EXPECT_EQ(errorOf(std::string(reinterpret_cast<const char*>(packed.data()), packed.size() - 4)), "CannotOpen");
}

TEST(FeatureFile, RefusesSpansWhereNoFeatureIs) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "f",
                    R"({"type":"CityJSON","version":"2.0","CityObjects":{"a":{"type":"Building"}},"vertices":[]})");
    auto file = FeatureFile::open(folder / "f");
    ASSERT_TRUE(file);
    const readers::FeatureSpan span{3, 5};
    const auto picked = file->pick(std::span(&span, 1), [](std::size_t, std::string_view) { return Result<void>(); });
    ASSERT_FALSE(picked);
    EXPECT_EQ(picked.error().code(), Code::InputChanged);
}

// Objects that are their own parents, and vertices that are not there, end in findings of the reader.
TEST(FeatureFile, EndsOnCirclesOfCityJson) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "f",
                    R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},
      "CityObjects":{"a":{"type":"Building","parents":["b"]},"b":{"type":"Building","parents":["a"]},
      "c":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,99]]]}]}},
      "vertices":[[0,0,0],[1,0,0],[1,1,0]]})");
    std::string error;
    const auto texts = featuresOf(folder / "f", error);
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_NE(texts[0].find("\"c\""), std::string::npos);
    EXPECT_NE(texts[0].find("99"), std::string::npos);
}

}  // namespace
}  // namespace svt::city
