// `svt thumbnail`: pictures for file managers, its limits, and the files that a desktop gives it.
#include "run_command.hpp"
#include "small_model.hpp"

#include <svt/core/machine.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/image/image.hpp>
#include <svt/image/png.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace svt::test {
namespace {

using Picture = image::Image<image::Rgba8>;

// The part of a picture that shows the model: not fully transparent.
struct Shown {
    int left = 0, top = 0, right = 0, bottom = 0;  ///< first and last columns and rows
    double share = 0;                              ///< of all pixels
};

Shown shownPart(const Picture& picture) {
    Shown shown{picture.width(), picture.height(), -1, -1, 0};
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            if (picture.at(x, y).a == 0) continue;
            shown.left = std::min(shown.left, x);
            shown.right = std::max(shown.right, x);
            shown.top = std::min(shown.top, y);
            shown.bottom = std::max(shown.bottom, y);
            ++count;
        }
    shown.share = double(count) / (double(picture.width()) * picture.height());
    return shown;
}

Picture pictureOf(const std::filesystem::path& file) {
    auto read = image::readPng(file);
    EXPECT_TRUE(read) << file;
    return read ? std::move(*read) : Picture(1, 1);
}

// The whole model, not cut off at an edge, fills the picture.
void expectWholeModel(const Picture& picture, int size) {
    ASSERT_EQ(picture.width(), size);
    ASSERT_EQ(picture.height(), size);
    const Shown shown = shownPart(picture);
    EXPECT_GT(shown.share, 0.15);
    EXPECT_LT(shown.share, 0.9);
    EXPECT_GE(std::max(shown.right - shown.left, shown.bottom - shown.top), size * 8 / 10);
    EXPECT_GT(shown.left, 0);
    EXPECT_GT(shown.top, 0);
    EXPECT_LT(shown.right, size - 1);
    EXPECT_LT(shown.bottom, size - 1);
}

// Runs `svt thumbnail`, which prints nothing unless it fails.
void drawThumbnail(const std::filesystem::path& folder, const std::string& input, const std::string& output,
                   const std::string& size) {
    const CommandResult result = runSvt(folder, {"thumbnail", input, "-o", output, "--size", size});
    ASSERT_EQ(result.exitCode, kDone) << result.toString();
    EXPECT_EQ(result.out + result.err, "") << input;
}

class ThumbnailOf : public ::testing::TestWithParam<const char*> {};

TEST_P(ThumbnailOf, IsTheWholeModel) {
    const TemporaryFolder folder;
    const std::string file = GetParam();
    std::vector<std::string> sample{"sample", file.substr(0, file.find('.')), "-o", file};
    if (file == "house.old.gml") sample.insert(sample.end(), {"--format", "citygml2"});
    prepare(folder.path(), sample);
    drawThumbnail(folder.path(), file, "thumbnail.png", "128");
    expectWholeModel(pictureOf(folder / "thumbnail.png"), 128);
}

INSTANTIATE_TEST_SUITE_P(Formats, ThumbnailOf,
                         ::testing::Values("house.gml", "house.old.gml", "house.json", "house.jsonl", "house.ifc",
                                           "tower.gml", "tower.ifc"));

TEST(Thumbnail, LooksAsAPictureOfTheFineVolume) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.05");
    runSvtWell(folder.path(), {"render", "house.svt", "--size", "256x256", "--transparent", "-o", "fine.png"});
    const Picture fine = pictureOf(folder / "fine.png");
    for (const char* input : {"house.gml", "house.svt"}) {
        drawThumbnail(folder.path(), input, "thumbnail.png", "256");
        EXPECT_LT(image::compareImages(pictureOf(folder / "thumbnail.png"), fine).mean, 0.02) << input;
    }
}

TEST(Thumbnail, HasTheGivenSize) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    for (const int size : {16, 64, 512}) {
        drawThumbnail(folder.path(), "house.gml", "thumbnail.png", std::to_string(size));
        EXPECT_EQ(pictureOf(folder / "thumbnail.png").width(), size);
    }
    EXPECT_EQ(runSvt(folder.path(), {"thumbnail", "house.gml", "-o", "x.png", "--size", "8"}).exitCode, kUsage);
    EXPECT_EQ(runSvt(folder.path(), {"thumbnail", "house.gml", "-o", "x.png", "--size", "4096"}).exitCode, kUsage);
}

TEST(Thumbnail, OfACity) {
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"sample", "city", "-o", "files", "--buildings", "20", "--files", "2"});
    runSvtWell(folder.path(), {"city", "plan", "files", "-o", "town", "--spacing", "1"});
    runSvtWell(folder.path(), {"city", "run", "town"});
    drawThumbnail(folder.path(), "town", "thumbnail.png", "128");
    EXPECT_GT(shownPart(pictureOf(folder / "thumbnail.png")).share, 0.05);
}

// File managers make an empty file for the picture, such as /tmp/.thumbnailer.X4T2PQ. Some hold it open, and read the
// picture from there.
TEST(Thumbnail, IsWrittenIntoAnEmptyFileWithAnyEnding) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    writeText(folder / ".thumbnailer.X4T2PQ", "");
    std::ifstream held(folder / ".thumbnailer.X4T2PQ", std::ios::binary);
    drawThumbnail(folder.path(), "house.gml", ".thumbnailer.X4T2PQ", "64");
    EXPECT_EQ(pictureOf(folder / ".thumbnailer.X4T2PQ").width(), 64);
    const std::string seen{std::istreambuf_iterator<char>(held), {}};
    EXPECT_EQ(seen, readText(folder / ".thumbnailer.X4T2PQ"));

    // A full disk leaves it empty.
    writeText(folder / "reserved", "");
    Limits limits;
    limits.fileBytes = 64;
    EXPECT_EQ(runSvt(folder.path(), {"thumbnail", "house.gml", "-o", "reserved"}, limits).exitCode, kOutput);
    EXPECT_EQ(readText(folder / "reserved"), "");

    writeText(folder / "letter.txt", "dear reader");
    EXPECT_EQ(runSvt(folder.path(), {"thumbnail", "house.gml", "-o", "letter.txt"}).exitCode, kUsage);
    EXPECT_EQ(readText(folder / "letter.txt"), "dear reader");
    EXPECT_EQ(runSvt(folder.path(), {"thumbnail", "house.gml", "-o", "new.X4T2PQ"}).exitCode, kUsage);
}

TEST(Thumbnail, GoesToStdout) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    drawThumbnail(folder.path(), "house.gml", "thumbnail.png", "64");
    const CommandResult result = runSvt(folder.path(), {"thumbnail", "house.gml", "-o", "/dev/stdout", "--size", "64"});
    EXPECT_EQ(result.exitCode, kDone) << result.err;
    EXPECT_EQ(result.out, readText(folder / "thumbnail.png"));
}

// Ends with an error about `what`, and leaves no picture.
void expectRefusal(const std::filesystem::path& folder, std::vector<std::string> arguments, int exitCode,
                   const std::string& what) {
    arguments.insert(arguments.begin(), "thumbnail");
    arguments.insert(arguments.end(), {"-o", "thumbnail.png"});
    const CommandResult result = runSvt(folder, arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.toString();
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "thumbnail.png"));
}

TEST(Thumbnail, RefusesFilesOverTheLimit) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    ASSERT_GT(std::filesystem::file_size(folder / "house.gml"), 1'000'000u);
    expectRefusal(folder.path(), {"house.gml", "--max-file", "1"}, kLimit, "E104 InputTooBig: house.gml: the file has");

    runShellWell(folder.path(), "gzip -c house.gml >packed.gml.gz");
    ASSERT_LT(std::filesystem::file_size(folder / "packed.gml.gz"), 1'000'000u);
    expectRefusal(folder.path(), {"packed.gml.gz", "--max-file", "1"}, kLimit, "E104 InputTooBig: packed.gml.gz");
    drawThumbnail(folder.path(), "packed.gml.gz", "thumbnail.png", "64");
}

TEST(Thumbnail, EndsAfterItsTime) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "tower", "-o", "tower.gml", "--storeys", "40"});
    expectRefusal(folder.path(), {"tower.gml", "--max-seconds", "0.02"}, kLimit,
                  "E104 InputTooBig: tower.gml: the thumbnail takes more than 0.02 s");
}

TEST(Thumbnail, EndsAtItsMemory) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "tower", "-o", "tower.gml", "--storeys", "80"});
    if (!kIsSanitized) expectRefusal(folder.path(), {"tower.gml", "--memory", "64"}, kLimit, "memory");
}

TEST(Thumbnail, IsNeverEmpty) {
    const TemporaryFolder folder;
    writeText(folder / "glass.json", R"({"rules": [{"select": "all", "opacity": 0}]})");
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "glass.svt", "--spacing", "0.5", "--style", "glass.json"});
    expectRefusal(folder.path(), {"glass.svt"}, kInput, "E109 EmptyModel: glass.svt: nothing in this file is visible");
    writeText(folder / "note.gml", "no model");
    expectRefusal(folder.path(), {"note.gml"}, kInput, "E103 UnknownFormat");
    expectRefusal(folder.path(), {"missing.gml"}, kInput, "E101 CannotOpen");
}

// Findings would fill the log of the desktop.
TEST(Thumbnail, PrintsNoFindings) {
    const TemporaryFolder folder;
    std::vector<Face> faces = boxFaces(0, 0, 0, 4, 6, 3);
    faces.pop_back();
    writeText(folder / "open.gml", cityModel(building("open", solid(faces))));
    EXPECT_NE(runSvt(folder.path(), {"build", "open.gml", "-o", "open.svt"}).err.find("warning"), std::string::npos);
    drawThumbnail(folder.path(), "open.gml", "thumbnail.png", "64");
}

}  // namespace
}  // namespace svt::test
