#include <svt/readers/format/zip_member.hpp>

#include <svt/core/deflate.hpp>
#include <svt/readers/read_model.hpp>

#include <gtest/gtest.h>

#include <string>

namespace svt::readers {
namespace {

constexpr std::string_view kIfcText =
    "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n#1=IFCWALL('w',$,'Wall',$,$,$,#6,$,$);\n"
    "#6=IFCPRODUCTDEFINITIONSHAPE($,$,(#7));\n#7=IFCSHAPEREPRESENTATION($,'Body','CSG',(#8));\n#8=IFCBLOCK($,1.,2.,3.);"
    "\n"
    "ENDSEC;\nEND-ISO-10303-21;\n";

std::string little(std::uint64_t value, int size) {
    std::string text;
    for (int i = 0; i < size; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

std::string deflated(std::string_view text) {
    const auto packed = deflatePiece(std::as_bytes(std::span(text.data(), text.size())), -1, true);
    return {reinterpret_cast<const char*>(packed.data()), packed.size()};
}

// An archive with one file before the one that is asked for.
std::string zipOf(const std::string& name, std::string_view text, int method, int flags = 0) {
    std::string archive, directory;
    const auto add = [&](const std::string& file, std::string_view content, int how) {
        const std::string packed = how == 8 ? deflated(content) : std::string(content);
        const std::string common = little(std::uint64_t(flags), 2) + little(std::uint64_t(how), 2) + little(0, 4) +
                                   little(0, 4) + little(packed.size(), 4) + little(content.size(), 4) +
                                   little(file.size(), 2) + little(0, 2);
        directory += "PK\1\2" + little(20, 2) + little(20, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) +
                     little(0, 4) + little(archive.size(), 4) + file;
        archive += "PK\3\4" + little(20, 2) + common + file + packed;
    };
    add("readme.txt", "hello", 0);
    add(name, text, method);
    const std::size_t begin = archive.size();
    archive += directory;
    return archive + "PK\5\6" + little(0, 4) + little(2, 2) + little(2, 2) + little(directory.size(), 4) +
           little(begin, 4) + little(0, 2);
}

Result<model::BuildingModel> read(const std::string& bytes) {
    return readModel(std::as_bytes(std::span(bytes.data(), bytes.size())), "a.ifczip");
}

TEST(ZipMember, IfcFilesAreReadPackedAndStored) {
    for (const int method : {0, 8}) {
        const auto model = read(zipOf("Model.IFC", kIfcText, method));
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_EQ(model->format, "IFC 4");
        EXPECT_EQ(model->features.size(), 1U);
    }
}

TEST(ZipMember, WhatCannotBeUnpackedIsNamed) {
    EXPECT_EQ(read(zipOf("a.dwg", "x", 0)).error().code(), Code::UnknownFormat);
    EXPECT_NE(read(zipOf("a.ifc", kIfcText, 8, 1)).error().message().find("encrypted"), std::string::npos);
    EXPECT_NE(read(zipOf("a.ifc", kIfcText, 12)).error().message().find("method 12"), std::string::npos);
    EXPECT_EQ(read("PK\3\4 and no more").error().code(), Code::CannotOpen);
    std::string damaged = zipOf("a.ifc", kIfcText, 8);
    damaged[150] = static_cast<char>(damaged[150] ^ 0x55);
    (void)read(damaged);  // an error or a model, but no crash
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
    for (std::size_t size = 4; size < whole.size(); ++size) EXPECT_FALSE(read(whole.substr(0, size))) << size;
}

}  // namespace
}  // namespace svt::readers
