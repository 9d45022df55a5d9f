#include <svt/readers/format/zip_member.hpp>

#include <svt/readers/format/zip_documents_test.hpp>
#include <svt/readers/read_model.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace svt::readers {
namespace {

using test::zipOf;

constexpr std::string_view kIfcText =
    "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n#1=IFCWALL('w',$,'Wall',$,$,$,#6,$,$);\n"
    "#6=IFCPRODUCTDEFINITIONSHAPE($,$,(#7));\n#7=IFCSHAPEREPRESENTATION($,'Body','CSG',(#8));\n#8=IFCBLOCK($,1.,2.,3.);"
    "\n"
    "ENDSEC;\nEND-ISO-10303-21;\n";

// An archive with one file before the one that is asked for.
std::string zipOf(const std::string& name, std::string_view text, int method, int flags = 0) {
    return zipOf({{"readme.txt", "hello", 0, flags}, {name, text, method, flags}});
}

Result<model::BuildingModel> readZipped(const std::string& bytes) {
    return readModel(std::as_bytes(std::span(bytes.data(), bytes.size())), "a.ifczip");
}

TEST(ZipMember, IfcFilesAreReadPackedAndStored) {
    for (const int method : {0, 8}) {
        const auto model = readZipped(zipOf("Model.IFC", kIfcText, method));
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_EQ(model->format, "IFC 4");
        EXPECT_EQ(model->features.size(), 1U);
    }
}

TEST(ZipMember, WhatCannotBeUnpackedIsNamed) {
    EXPECT_EQ(readZipped(zipOf("a.dwg", "x", 0)).error().code(), Code::UnknownFormat);
    EXPECT_NE(readZipped(zipOf("a.ifc", kIfcText, 8, 1)).error().message().find("encrypted"), std::string::npos);
    EXPECT_NE(readZipped(zipOf("a.ifc", kIfcText, 12)).error().message().find("method 12"), std::string::npos);
    EXPECT_EQ(readZipped("PK\3\4 and no more").error().code(), Code::CannotOpen);
    ReadOptions few;
    few.maxBytes = 400;
    const std::string large = zipOf("a.ifc", std::string(kIfcText) + std::string(100000, ' '), 8);
    EXPECT_LT(large.size(), 700U);
    few.maxBytes = 2000;
    EXPECT_EQ(readModel(std::as_bytes(std::span(large.data(), large.size())), "a", few).error().code(),
              Code::InputTooBig);
}

TEST(ZipMember, AnyCutIsAnError) {
    const std::string whole = zipOf("a.ifc", kIfcText, 8);
    for (std::size_t size = 4; size < whole.size(); ++size) EXPECT_FALSE(readZipped(whole.substr(0, size))) << size;
}

TEST(ZipMember, SeveralModelsAreNamed) {
    const auto model = readZipped(zipOf({{"north.ifc", kIfcText}, {"plan.pdf", "%PDF"}, {"east/South.IFC", kIfcText}}));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code(), Code::CannotOpen);
    for (const char* part : {"2 models", "'north.ifc'", "'east/South.IFC'", "unpack"})
        EXPECT_NE(model.error().message().find(part), std::string::npos) << model.error().message();
}

TEST(ZipMember, CompanionFilesOfMacOsAreNoModels) {
    const auto model = readZipped(zipOf({{"a.ifc", kIfcText}, {"__MACOSX/._a.ifc", "\0\5\x16\7"}, {"._b.ifc", "x"}}));
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(model->features.size(), 1U);
}

// Everything that is read of a model, as text.
std::string described(const model::BuildingModel& model) {
    std::string text = model.format + " " + std::to_string(model.features.size());
    for (const model::Feature& feature : model.features) text += " " + feature.id;
    for (const model::Polygon& polygon : model.polygons)
        for (const Vec3d& p : polygon.points)
            text += " " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
    return text;
}

TEST(ZipMember, AnyDamageIsAnErrorOrChangesNothing) {
    for (const int method : {0, 8}) {
        const std::string whole = zipOf("a.ifc", kIfcText, method);
        const std::string expected = described(*readZipped(whole));
        int errors = 0;
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const int bit : {0, 3, 7}) {
                std::string damaged = whole;
                damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
                const auto model = readZipped(damaged);
                if (model) {
                    EXPECT_EQ(described(*model), expected) << "byte " << at << ", bit " << bit;
                }
                errors += model ? 0 : 1;
            }
        EXPECT_GT(errors, 100);
        for (const char* added : {"x", "more bytes", "PK\5\6"}) EXPECT_FALSE(readZipped(whole + added)) << added;
    }
}

TEST(ZipMember, SizeAndChecksumOfTheArchiveHold) {
    const std::string whole = zipOf({{"a.ifc", kIfcText, 0}});
    const std::size_t entry = whole.find("PK\1\2");
    for (const std::size_t field : {std::size_t{16}, std::size_t{20}, std::size_t{24}}) {
        std::string damaged = whole;
        damaged[entry + field] = static_cast<char>(damaged[entry + field] ^ 1);
        const auto model = readZipped(damaged);
        ASSERT_FALSE(model) << field;
        EXPECT_EQ(model.error().code(), Code::CannotOpen) << field;
        EXPECT_NE(model.error().message().find("'a.ifc'"), std::string::npos) << model.error().message();
    }
}

}  // namespace
}  // namespace svt::readers
