// A file that was cut off is an error wherever it was cut, unless the caller takes the part before the cut.
#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/readers/citygml/citygml_documents_test.hpp>
#include <svt/readers/feature_file.hpp>
#include <svt/readers/format/zip_documents_test.hpp>
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/read_model.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>

namespace svt::readers {
namespace {

const std::string kCube =
    R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,3,2,1]],[[0,1,4]],[[1,2,4]],[[2,3,4]],[[3,0,4]]]})";
const std::string kVertices = R"("vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[5,5,9]])";
const std::string kTransform = R"("transform":{"scale":[1,1,1],"translate":[0,0,0]})";

std::string cityJson() {
    return R"({"type":"CityJSON","version":"2.0",)" + kTransform +
           R"(,"CityObjects":{"b":{"type":"Building","geometry":[)" + kCube + "]}}," + kVertices + "}";
}

std::string line(const std::string& id) {
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{")" + id +
           R"(":{"type":"Building","attributes":{"note":"a \" and \\"},"geometry":[)" + kCube + "]}}," + kVertices +
           "}";
}

std::string sequence() {
    return R"({"type":"CityJSON","version":"2.0",)" + kTransform + R"(,"CityObjects":{},"vertices":[]})" + "\n" +
           line("a") + "\n" + line("b") + "\n";
}

std::string ifc() { return test::ifcWithItem("#200=IFCBLOCK(#14,1000.,2000.,3000.);"); }

std::string cityGml() {
    using namespace gmltest;
    return cityModel(2, building("b", lod2Surfaces(2, multiSurface(surfaceMember(square("p"))))));
}

Result<model::BuildingModel> readEnding(std::string_view text, bool allowTruncated = false,
                                        Diagnostics* log = nullptr) {
    ReadOptions options;
    options.allowTruncated = allowTruncated;
    return readModel(std::as_bytes(std::span(text)), "cut", options, log);
}

// Cut behind each byte from `first` on but for the last ones, which say nothing new.
void expectErrors(const std::string& text, std::size_t first, std::size_t last) {
    ASSERT_TRUE(readEnding(text)) << readEnding(text).error().toString();
    for (std::size_t size = first; size < last; ++size)
        ASSERT_FALSE(readEnding(std::string_view(text).substr(0, size))) << text.substr(0, size);
}

TEST(Truncated, IfcIsAnErrorWhereverItIsCut) {
    const std::string text = ifc();
    expectErrors(text, text.find("DATA;"), text.find("END-ISO") + std::string_view("END-ISO-10303-2").size());
    const auto model = readEnding(text.substr(0, text.rfind("ENDSEC")));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code(), Code::Truncated);
    EXPECT_NE(model.error().message().find("behind the record #200"), std::string::npos) << model.error().message();
    EXPECT_EQ(model.error().where().line,
              std::size_t(std::count(text.begin(), text.begin() + text.find("#200=IFC"), '\n')) + 1);
}

TEST(Truncated, IfcIsReadAsFarAsItGoesWhereThatIsAllowed) {
    const std::string text = ifc();
    Diagnostics log;
    const auto model = readEnding(text.substr(0, text.rfind("ENDSEC")), true, &log);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->features.back().id, "wall");
    EXPECT_FALSE(model->features.back().geometries.empty());
    EXPECT_EQ(log.count(Code::Truncated), 1u);
    EXPECT_EQ(log.count(Severity::Warning), 1u);
    Diagnostics cut;
    ASSERT_TRUE(readEnding(text.substr(0, text.find("#200=IFC")), true, &cut));
    EXPECT_EQ(cut.count(Code::Truncated), 1u);
    EXPECT_EQ(cut.count(Code::DanglingReference), 1u);
    EXPECT_EQ(cut.count(Code::ShapeNotRead), 1u);
}

TEST(Truncated, ABrokenLastRecordIsNoCut) {
    std::string text = ifc();
    text.insert(text.rfind("ENDSEC"), "#201=IFCLABEL('open);\n");
    Diagnostics log;
    EXPECT_TRUE(readEnding(text, false, &log));
    EXPECT_EQ(log.count(Code::BadRecord), 1u);
}

TEST(Truncated, CityGmlAndCityJsonAreErrorsWhereverTheyAreCut) {
    const std::string gml = cityGml(), json = cityJson();
    expectErrors(gml, 0, gml.rfind('>'));
    expectErrors(json, 0, json.rfind('}'));
    EXPECT_FALSE(readEnding(json.substr(0, json.size() - 1), true)) << "no part of it can be read";
    EXPECT_FALSE(readEnding(gml.substr(0, gml.rfind('>')), true));
}

TEST(Truncated, SequencesAreErrorsBetweenTheirLines) {
    const std::string text = sequence();
    ASSERT_TRUE(readEnding(text));
    const std::size_t second = text.find('\n') + 1, third = text.find('\n', second) + 1;
    for (std::size_t size = 1; size + 2 < text.size(); ++size) {
        const auto model = readEnding(std::string_view(text).substr(0, size));
        const bool isWhole = size == second || size + 1 == second || size == third || size + 1 == third;
        ASSERT_EQ(bool(model), isWhole) << text.substr(0, size);
        if (size > third) {
            EXPECT_EQ(model.error().code(), Code::Truncated);
            EXPECT_EQ(model.error().where().line, 3u);
        }
    }
    Diagnostics log;
    const auto model = readEnding(std::string_view(text).substr(0, text.size() - 40), true, &log);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->features.size(), 1u);
    EXPECT_EQ(log.count(Code::Truncated), 1u);
    EXPECT_EQ(log.count(Code::BadJson), 1u);
    // A damaged line is no cut.
    std::string damaged = text;
    damaged.replace(damaged.rfind("[5,5,9]"), 7, "[5,5 9]");
    Diagnostics found;
    EXPECT_TRUE(readEnding(damaged, false, &found));
    EXPECT_EQ(found.count(Code::Truncated), 0u);
    EXPECT_EQ(found.count(Code::BadJson), 1u);
}

TEST(Truncated, RowsOfFeaturesEndWithTheErrorToo) {
    const svt::test::TemporaryFolder folder;
    const std::string text = sequence();
    for (const bool isAllowed : {false, true}) {
        ASSERT_TRUE(writeFileAtomically(folder / "cut.city.jsonl", std::string_view(text).substr(0, text.size() - 40)));
        ReadOptions options;
        options.allowTruncated = isAllowed;
        auto file = FeatureFile::open(folder / "cut.city.jsonl", options);
        ASSERT_TRUE(file);
        FeatureText feature;
        ASSERT_TRUE(file->next(feature));
        const std::string first(feature.text);
        EXPECT_TRUE(file->read(std::vector<std::string_view>{first}, options, nullptr));
        const auto second = file->next(feature);
        ASSERT_EQ(bool(second), isAllowed);
        EXPECT_TRUE(file->isTruncated());
        if (isAllowed) {
            const std::string cut(feature.text);
            Diagnostics log;
            EXPECT_TRUE(file->read(std::vector<std::string_view>{cut}, {}, &log));
            EXPECT_EQ(log.count(Code::BadJson), 1u);
        } else {
            EXPECT_EQ(second.error().code(), Code::Truncated);
            EXPECT_EQ(second.error().where().line, 3u);
        }
    }
}

std::string asGzip(std::string_view text) {
    const std::vector<std::byte> packed = gzipBytes(std::as_bytes(std::span(text)));
    return {reinterpret_cast<const char*>(packed.data()), packed.size()};
}

// The archive and the gzip data are whole; the model in them is not.
TEST(Truncated, IfcIsAnErrorInArchivesAndGzipData) {
    const std::string whole = ifc(), cut = whole.substr(0, whole.rfind("ENDSEC"));
    const auto packings = {std::pair{asGzip(whole), asGzip(cut)},
                           {test::zipOf({{"a.ifc", whole}}), test::zipOf({{"a.ifc", cut}})},
                           {test::zipOf({{"a.ifc", whole, 0}}), test::zipOf({{"a.ifc", cut, 0}})}};
    for (const auto& [packedWhole, packedCut] : packings) {
        EXPECT_TRUE(readEnding(packedWhole));
        const auto model = readEnding(packedCut);
        ASSERT_FALSE(model);
        EXPECT_EQ(model.error().code(), Code::Truncated);
        EXPECT_NE(model.error().message().find("behind the record #200"), std::string::npos) << model.error().message();
        Diagnostics log;
        const auto part = readEnding(packedCut, true, &log);
        ASSERT_TRUE(part) << part.error().toString();
        EXPECT_FALSE(part->features.back().geometries.empty());
        EXPECT_EQ(log.count(Code::Truncated), 1u);
    }
}

TEST(Truncated, SequencesAreErrorsInGzipData) {
    const svt::test::TemporaryFolder folder;
    const std::string text = sequence(), packed = asGzip(std::string_view(text).substr(0, text.size() - 40));
    const auto model = readEnding(packed);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code(), Code::Truncated);
    EXPECT_EQ(model.error().where().line, 3u);
    Diagnostics log;
    const auto part = readEnding(packed, true, &log);
    ASSERT_TRUE(part) << part.error().toString();
    EXPECT_EQ(part->features.size(), 1u);
    EXPECT_EQ(log.count(Code::Truncated), 1u);

    const auto path = folder / "cut.city.jsonl.gz";
    svt::test::writeText(path, packed);
    auto file = FeatureFile::open(path);
    ASSERT_TRUE(file) << file.error().toString();
    FeatureText feature;
    ASSERT_TRUE(file->next(feature));
    const auto second = file->next(feature);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code(), Code::Truncated);
    EXPECT_EQ(second.error().where().line, 3u);
}

TEST(Truncated, AFileThatShrinksWhileItIsReadEndsNoProgram) {
    const svt::test::TemporaryFolder folder;
    std::string records = "#200=IFCBLOCK(#14,1000.,2000.,3000.);\n";
    for (int i = 1000; i < 20'000; ++i) records += "#" + std::to_string(i) + "=IFCCARTESIANPOINT((0.,0.,0.));\n";
    const std::string text = test::ifcWithItem(records);
    const auto path = folder / "house.ifc";
    svt::test::writeText(path, text);
    std::atomic<bool> isDone{false};
    std::thread writer([&] {
        while (!isDone) {
            std::filesystem::resize_file(path, 1000);
            svt::test::writeText(path, text);
        }
    });
    for (int i = 0; i < 50; ++i) {
        const auto model = readModel(path);
        if (model) {
            EXPECT_EQ(model->features.back().id, "wall");
        }
    }
    isDone = true;
    writer.join();
}

}  // namespace
}  // namespace svt::readers
