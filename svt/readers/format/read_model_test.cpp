#include <svt/readers/read_model.hpp>

#include <svt/core/test_data_test.hpp>
#include <svt/readers/citygml/citygml_documents_test.hpp>

#include <unistd.h>
#include <zlib.h>

#include <fstream>

namespace svt::readers {
namespace {

using namespace gmltest;

std::string smallModel() {
    return cityModel(2, building("b", lod2Surfaces(2, multiSurface(surfaceMember(square("p"))))));
}

Reading readBytes(std::string_view content, const ReadOptions& options = {}) {
    Reading reading;
    reading.result = readModel(bytesOf(content), "any.name", options, &reading.diagnostics);
    return reading;
}

std::string gzipped(std::string_view text) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(deflateBound(&stream, text.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

// A file that is removed when the test ends.
class TemporaryFile {
public:
    explicit TemporaryFile(std::string_view content, std::string_view name)
        : path_(std::filesystem::temp_directory_path() / fmt::format("svt_{}_{}", ::getpid(), name)) {
        std::ofstream(path_, std::ios::binary) << content;
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

TEST(ReadModel, ContentDecidesNotTheName) {
    const TemporaryFile gml(smallModel(), "model.json");
    const TemporaryFile json(
        "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"transform\":{\"scale\":[1,1,1],\"translate\":[0,0,0]},"
        "\"CityObjects\":{},\"vertices\":[]}",
        "model.gml");
    const auto first = readModel(gml.path());
    ASSERT_TRUE(first) << first.error().toString();
    EXPECT_EQ(first->format, "CityGML 2.0");
    EXPECT_EQ(first->source, gml.path().string());
    const auto second = readModel(json.path());
    ASSERT_TRUE(second) << second.error().toString();
    EXPECT_EQ(second->format, "CityJSON 2.0");
}

TEST(ReadModel, CannotOpenSaysWhy) {
    EXPECT_EQ(readModel("/nowhere/at/all.gml").error().code(), Code::CannotOpen);
    EXPECT_EQ(readModel(std::filesystem::temp_directory_path()).error().code(), Code::CannotOpen);
    EXPECT_EQ(readModel("/dev/zero").error().code(), Code::CannotOpen);
}

TEST(ReadModel, GzipIsDecompressedMembersIncluded) {
    const std::string text = smallModel();
    EXPECT_EQ(readBytes(gzipped(text)).model().features.size(), 1u);
    const std::string parts = gzipped(text.substr(0, 500)) + gzipped(text.substr(500));
    EXPECT_EQ(readBytes(parts).model().features.size(), 1u);
}

TEST(ReadModel, DamagedOrHugeGzipIsRefused) {
    const std::string packed = gzipped(smallModel());
    for (std::size_t size = 3; size < packed.size(); size += 7)
        EXPECT_EQ(readBytes(std::string_view(packed).substr(0, size)).code(), Code::CannotOpen) << size;
    std::string damaged = packed;
    damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
    EXPECT_EQ(readBytes(damaged).code(), Code::CannotOpen);
    ReadOptions options;
    options.maxBytes = 1 << 20;
    EXPECT_EQ(readBytes(gzipped(std::string(std::size_t{8} << 20, ' ')), options).code(), Code::InputTooBig);
}

TEST(ReadModel, AnyDamageOfGzipIsAnErrorOrChangesNothing) {
    const std::string packed = gzipped(smallModel());
    for (std::size_t at = 0; at < packed.size(); ++at) {
        std::string damaged = packed;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
        const Reading reading = readBytes(damaged);
        if (!reading.result) continue;
        EXPECT_LT(at, 10u) << "of the header: time, level and system";
        EXPECT_EQ(reading.result->features.size(), 1u);
    }
    for (const std::string& added : {std::string("x"), std::string(512, '\0'), std::string("\x1F\x8B"), smallModel()}) {
        const Reading reading = readBytes(packed + added);
        EXPECT_EQ(reading.code(), Code::CannotOpen) << added;
    }
}

TEST(ReadModel, UnknownContentIsNamed) {
    struct Case {
        std::string_view content;
        std::string_view word;
    };
    const Case cases[] = {
        {"", "empty"},
        {" \n\t ", "blanks"},
        {"<!DOCTYPE html><html><body>404</body></html>", "HTML"},
        {"<html></html>", "HTML"},
        {"<ifcXML/>", "STEP"},
        {"<kml/>", "KML"},
        {"<other:Thing/>", "other:Thing"},
        {"<?xml version=\"1.0\"?>", "no root"},
        {"{\"type\":\"FeatureCollection\"}", "JSON"},
        {"hello world", "hello"},
        {"\x01\x02\x03", "binary"},
    };
    for (const Case& unknown : cases) {
        const Reading reading = readBytes(unknown.content);
        ASSERT_EQ(reading.code(), Code::UnknownFormat) << unknown.content;
        EXPECT_NE(reading.result.error().message().find(unknown.word), std::string::npos)
            << reading.result.error().message();
        EXPECT_NE(reading.result.error().message().find("CityGML"), std::string::npos) << "says what can be read";
    }
    EXPECT_EQ(readBytes("<CityModel xmlns=\"http://www.citygml.org/citygml/1/0/0\"/>").code(), Code::UnknownVersion);
}

TEST(ReadModel, SizeLimitHoldsForFilesAndMemory) {
    const TemporaryFile file(smallModel(), "limit.gml");
    ReadOptions options;
    options.maxBytes = 10;
    EXPECT_EQ(readModel(file.path(), options).error().code(), Code::InputTooBig);
    EXPECT_EQ(readBytes(smallModel(), options).code(), Code::InputTooBig);
}

TEST(ReadModel, RealFilesOfAllFormatsAreRead) {
    SVT_NEEDS_DATA(indoor, "fzk_haus_indoorgml.gml");
    EXPECT_TRUE(readModel(indoor));
    SVT_NEEDS_DATA(ifc, "fzk_haus.ifc");
    EXPECT_TRUE(readModel(ifc));
    SVT_NEEDS_DATA(json, "fzk_haus.city.json");
    EXPECT_TRUE(readModel(json));
}

TEST(ModelEndings, AreThoseOfTheFormatsOnce) {
    const auto endings = modelEndings();
    EXPECT_EQ(endings, (std::vector<std::string_view>{".gml", ".xml", ".citygml", ".json", ".jsonl", ".cityjson",
                                                      ".ifc", ".ifczip"}));
    for (const char* name : {"a.gml", "a/b.city.json", "B.IFCZIP", "b.ifc.gz", "c.citygml", "d.cityjson", "e.jsonl"})
        EXPECT_TRUE(hasModelEnding(name)) << name;
    for (const char* name : {"gml", "a.png", "a.gml.zip", "a.gz", "a.gml.gz.gz", "a.gml/"})
        EXPECT_FALSE(hasModelEnding(name)) << name;
}

}  // namespace
}  // namespace svt::readers
