// Compares pictures drawn with OpenGL with those drawn without it.
#include "run_command.hpp"

#include <svt/image/image.hpp>
#include <svt/image/png.hpp>

#include <cstdlib>

namespace svt::test {
namespace {

constexpr int kNoGraphics = 6;
// A driver compiles shaders, and maps more memory than it uses.
Limits glLimits() {
    Limits limits;
    limits.seconds = 60;
    limits.memoryBytes = std::uint64_t{8} << 30;
    return limits;
}

// Draws with and without OpenGL and compares pictures and labels.
void expectSame(const std::vector<std::string>& options) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.1", {"--vectors", "edges,meshes"});
    std::vector<std::string> arguments{"render", "house.svt", "--size", "320x180"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), arguments.begin(), arguments.end());
        return more;
    };
    const auto drawn = runSvt(folder.path(), with({"-o", "gl.png", "--labels", "glIds.png", "--gl"}), glLimits());
    if (drawn.exitCode == kNoGraphics) GTEST_SKIP() << drawn.err;
    ASSERT_EQ(drawn.exitCode, 0) << drawn.toString();
    runSvtWell(folder.path(), with({"-o", "cpu.png", "--labels", "cpuIds.png", "--surfaces", "voxels"}));
    const auto gl = image::readPng(folder / "gl.png"), cpu = image::readPng(folder / "cpu.png");
    ASSERT_TRUE(gl && cpu);
    // Not 0: the CPU supersamples a pixel only if it differs from its neighbours.
    EXPECT_LT(image::compareImages(*gl, *cpu).error, 0.02);
    const auto glIds = image::readGrayPng(folder / "glIds.png"), cpuIds = image::readGrayPng(folder / "cpuIds.png");
    ASSERT_TRUE(glIds && cpuIds);
    std::size_t apart = 0;
    for (std::size_t n = 0; n < glIds->pixels().size(); ++n) apart += glIds->pixels()[n] != cpuIds->pixels()[n];
    EXPECT_LE(apart, 10u);
}

TEST(RenderByGl, IsThePictureOfTheCpu) {
    expectSame({"--look", "paper", "--hide", "class=BuildingRoom", "--section", "y<5"});
}

TEST(RenderByGl, DrawsLensesAndLines) {
    expectSame({"--hide", "class=BuildingRoom", "--lens", "view(0.45,0.5,0.3)", "--section", "y<5", "--wireframe",
                "--samples", "1"});
}

TEST(RenderByGl, WithoutADriverExitsWith6) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    // The driver loader then finds no driver.
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);
    const auto result =
        runSvt(folder.path(), {"render", "house.gml", "-o", "house.png", "--spacing", "0.3", "--gl"}, glLimits());
    ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    if (result.exitCode == 0) GTEST_SKIP() << "this machine's EGL has no loader of drivers";
    EXPECT_EQ(result.exitCode, kNoGraphics) << result.toString();
    EXPECT_NE(result.err.find("E505 NoGraphics"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "house.png"));
}

TEST(RenderByGl, KnowsNoLevelsOfDetail) {
    const TemporaryFolder folder;
    EXPECT_EQ(runSvt(folder.path(), {"render", "house.svt", "-o", "house.png", "--gl", "--level", "1"}).exitCode, 2);
}

}  // namespace
}  // namespace svt::test
