// Compares pictures of the command with visually approved pictures. The distance is defined in
// svt/image/image.hpp: below 0.005 a difference is invisible, below 0.05 it is visible only side by side.
//
// SVT_UPDATE_GOLDEN=1 rewrites the pictures; look at each before committing it.
#include "run_command.hpp"

#include <svt/core/test_data_test.hpp>
#include <svt/image/image.hpp>
#include <svt/image/png.hpp>

#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <utility>

namespace svt::test {
namespace {

constexpr double kInvisible = 0.005;

struct Picture {
    std::string name;
    std::vector<std::string> options;  ///< of `svt render`
    std::vector<std::string> build;    ///< of `svt build`, besides the spacing
    const char* size = "320x180";
};

void PrintTo(const Picture& picture, std::ostream* stream) { *stream << picture.name; }

image::Image<image::Rgba8> differenceOf(const image::Image<image::Rgba8>& a, const image::Image<image::Rgba8>& b) {
    image::Image<image::Rgba8> result(a.width(), a.height());
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const auto& p = a.pixels()[i];
        const auto& q = b.pixels()[i];
        const auto channel = [](int x, int y) {
            return static_cast<std::uint8_t>(255 - std::min(255, 4 * std::abs(x - y)));
        };
        result.pixels()[i] = {channel(p.r, q.r), channel(p.g, q.g), channel(p.b, q.b), 255};
    }
    return result;
}

// Draws `picture` of house.svt in `folder` and compares it with its reference.
void expectAsReference(const std::filesystem::path& folder, const Picture& picture) {
    std::vector<std::string> arguments{"render", "house.svt", "-o", "actual.png", "--size", picture.size};
    arguments.insert(arguments.end(), picture.options.begin(), picture.options.end());
    runSvtWell(folder, arguments);
    const auto actual = image::readPng(folder / "actual.png");
    ASSERT_TRUE(actual) << actual.error().toString();

    const std::filesystem::path reference =
        std::filesystem::path(sourceRoot()) / "tests/golden" / (picture.name + ".png");
    if (const char* update = std::getenv("SVT_UPDATE_GOLDEN"); update != nullptr && std::string(update) == "1") {
        std::filesystem::create_directories(reference.parent_path());
        std::filesystem::copy_file(folder / "actual.png", reference, std::filesystem::copy_options::overwrite_existing);
        GTEST_SKIP() << reference << " is written anew; look at it";
    }
    const auto expected = image::readPng(reference);
    ASSERT_TRUE(expected) << expected.error().toString() << "; SVT_UPDATE_GOLDEN=1 makes it";
    const image::ImageDifference difference = image::compareImages(*actual, *expected);
    if (difference.error < kInvisible) return;
    const std::filesystem::path kept = buildFolder() / "tests/pictures";
    std::filesystem::create_directories(kept);
    (void)image::writePng(kept / (picture.name + ".actual.png"), *actual);
    if (actual->width() == expected->width() && actual->height() == expected->height())
        (void)image::writePng(kept / (picture.name + ".difference.png"), differenceOf(*actual, *expected));
    ADD_FAILURE() << picture.name << ": error " << difference.error << " (mean " << difference.mean << ", worst block "
                  << difference.worstBlock << ", " << difference.differing << " pixels); actual and difference are in "
                  << kept;
}

class PictureTest : public ::testing::TestWithParam<Picture> {};

TEST_P(PictureTest, LooksAsItsReference) {
    // Those of scenes and models have the faces of the model.
    Picture picture = GetParam();
    picture.options.insert(picture.options.end(), {"--surfaces", "voxels"});
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.06", picture.build);
    expectAsReference(folder.path(), picture);
}

const std::vector<Picture> kPictures{
    {"iso", {}, {}},
    {"iso_north_west", {"--camera", "iso-nw"}, {}},
    {"front", {"--camera", "front", "--ortho"}, {}},
    {"plan", {"--camera", "top", "--ortho", "--section", "z=1.6"}, {}},
    {"glass", {"--around", "id=house_window_terrace", "--camera", "iso-sw"}, {}},
    {"cut", {"--camera", "front", "--section", "y<5"}, {}},
    {"corner_cut", {"--section", "x>6", "--section", "z>3.4"}, {}},
    {"oblique_cut", {"--section", "1,-1,0.5,-2"}, {}},
    {"without_roof",
     {"--hide", "name~'[Rr]oof' or name~'[Rr]after' or class=CeilingSurface or name~'[Cc]eiling'", "--camera",
      "iso-sw"},
     {}},
    {"rooms",
     {"--show", "class=BuildingRoom", "--opacity", "class=BuildingRoom:0.9", "--color", "id=house_living:tomato",
      "--color", "id=house_kitchen:gold"},
     {}},
    {"one_beam",
     {"--opacity", "all:0.06", "--opacity", "id=house_hidden_beam:1", "--color", "id=house_hidden_beam:red", "--edges",
      "0"},
     {}},
    {"patterns", {"--camera", "front", "--section", "y<5"}, {"--patterns"}, "224x126"},
    {"dark", {"--background", "#203040", "--edges", "1", "--camera", "iso-ne"}, {}},
    {"wireframe",
     {"--opacity", "all:0.3", "--opacity", "class=BuildingRoom:0.05", "--wireframe", "--wire-width", "0.7"},
     {"--vectors", "edges"}},
    {"hidden_lines",
     {"--wireframe", "class=BuildingRoom", "--hidden-lines", "dashed", "--wire-width", "1.5", "--edges", "0"},
     {"--vectors", "edges"}},
    {"meshes",
     {"--section", "z>1.3", "--vectors", "class=BuildingFurniture", "--vectors", "size<1", "--camera", "iso-sw",
      "--zoom", "2"},
     {"--vectors", "meshes"}},
    {"coarse", {"--level", "2", "--section", "y<5", "--camera", "iso-sw"}, {}},
    {"paper", {"--look", "paper", "--hide", "class=BuildingRoom", "--section", "y<5", "--camera", "front"}, {}},
    {"blueprint",
     {"--look", "blueprint", "--hide", "class=BuildingRoom", "--section", "storey=\"Ground floor\"+1.2", "--camera",
      "top", "--ortho"},
     {}},
    {"box_cut", {"--look", "paper", "--hide", "class=BuildingRoom", "--cut", "x>6 and y<5 or z>5"}, {}},
    {"storey", {"--look", "dark", "--keep", "storey(\"Upper floor\")", "--hide", "class=BuildingRoom"}, {}},
    {"lens", {"--hide", "class=BuildingRoom", "--lens", "view(0.5,0.5,0.35)", "--section", "y<5"}, {}},
    {"solid_lens",
     {"--hide", "class=BuildingRoom", "--lens", "ball(6,5,3,2.5)", "--section", "y<5", "--context", "solid"},
     {}},
    {"highlight", {"--look", "dark", "--highlight", "id=house_living", "--highlight", "id=house_hidden_beam"}, {}},
    {"highlight_in_shell", {"--highlight", "id=house_living", "--context", "shell"}, {}},
    {"highlight_in_coarse",
     {"--highlight", "id=house_living", "--context", "solid", "--context-level", "2", "--hide", "name~Roof"},
     {}},
    {"cutaway",
     {"--look", "paper", "--hide", "class=BuildingRoom", "--cutaway", "id=house_hidden_beam", "--color",
      "id=house_hidden_beam:red"},
     {}},
    {"many_targets",
     {"--look", "paper", "--hide", "class=BuildingRoom", "--cutaway", "class=BuildingFurniture", "--color",
      "class=BuildingFurniture:red"},
     {}},
    {"hulls", {"--shell", "storey", "--cut", "x>6 and y<5", "--look", "paper"}, {}},
    {"cells", {"--section", "y<5", "--zoom", "3", "--cells"}, {}},
    {"pattern_faces", {"--section", "x>6", "--section", "z>3.4", "--zoom", "2"}, {"--patterns"}, "224x126"},
    {"names",
     {"--look", "paper", "--hide", "class=BuildingRoom", "--section", "y<5", "--names", "name~'beam|slab'"},
     {}},
};
INSTANTIATE_TEST_SUITE_P(House, PictureTest, ::testing::ValuesIn(kPictures),
                         [](const auto& test) { return test.param.name; });

// The scenes of the examples: counterparts of the paper's figures.
class SceneTest : public ::testing::TestWithParam<const char*> {
protected:
    Picture picture() const {
        const std::string scene = sourceRoot() + "/examples/scenes/" + GetParam() + ".scene.json";
        // Lines do not compress.
        const char* size = std::string(GetParam()) == "wireframe" ? "192x108" : "256x144";
        return {std::string("scene_") + GetParam(), {"--scene", scene}, {}, size};
    }
    TemporaryFolder folder;
};
std::string nameOfScene(const ::testing::TestParamInfo<const char*>& info) { return info.param; }

class HouseSceneTest : public SceneTest {};
TEST_P(HouseSceneTest, LooksAsItsReference) {
    SVT_NEEDS_DATA(model, "fzk_haus_citygml3.gml");
    prepare(folder.path(), {"build", model.string(), "-o", "house.svt", "--spacing", "0.04", "--vectors", "edges"});
    expectAsReference(folder.path(), picture());
}
INSTANTIATE_TEST_SUITE_P(Scenes, HouseSceneTest,
                         ::testing::Values("slab_and_beam", "oblique_section", "lens", "beam_cutaway", "wireframe"),
                         nameOfScene);

class TowerSceneTest : public SceneTest {};
TEST_P(TowerSceneTest, LooksAsItsReference) {
    prepare(folder.path(), {"sample", "tower", "-o", "tower.gml"});
    prepare(folder.path(), {"build", "tower.gml", "-o", "house.svt", "--spacing", "0.1"});
    expectAsReference(folder.path(), picture());
}
INSTANTIATE_TEST_SUITE_P(Scenes, TowerSceneTest,
                         ::testing::Values("two_flats", "two_flats_in_their_tower", "hulls_of_storeys"), nameOfScene);

// Scenes with texts, which small pictures would not show.
class SampleSceneTest : public SceneTest {};
TEST_P(SampleSceneTest, LooksAsItsReference) {
    prepareHouse(folder.path(), "0.05");
    Picture asked = picture();
    asked.size = "450x320";
    expectAsReference(folder.path(), asked);
}
INSTANTIATE_TEST_SUITE_P(Scenes, SampleSceneTest,
                         ::testing::Values("plan_with_names", "inset", "rooms_by_area", "storeys_apart"), nameOfScene);

// Models of others, in which the glass of windows must show what is behind it.
struct ModelPicture {
    const char* file;
    Picture picture;
};
void PrintTo(const ModelPicture& model, std::ostream* stream) { *stream << model.picture.name; }

class ModelPictureTest : public ::testing::TestWithParam<ModelPicture> {};
TEST_P(ModelPictureTest, LooksAsItsReference) {
    SVT_NEEDS_DATA(model, GetParam().file);
    const TemporaryFolder folder;
    prepare(folder.path(), {"build", model.string(), "-o", "house.svt", "--spacing", "0.05"});
    expectAsReference(folder.path(), GetParam().picture);
}
const std::vector<ModelPicture> kModelPictures{
    {"fzk_haus.ifc",
     {"fzk_haus_glass", {"--around", "id=\"1srAI$R4T8ihLXSNHmUSET\"", "--camera", "iso-sw", "--zoom", "0.5"}, {}}},
    {"samplehouse.ifc", {"revit_house_glass", {"--camera", "left", "--zoom", "1.3"}, {}, "256x144"}},
};
INSTANTIATE_TEST_SUITE_P(Glass, ModelPictureTest, ::testing::ValuesIn(kModelPictures),
                         [](const auto& test) { return test.param.picture.name; });

class SmallHouse : public ::testing::Test {
protected:
    SmallHouse() { prepareHouse(folder.path(), "0.2"); }
    image::Image<image::Rgba8> draw(std::vector<std::string> options) {
        std::vector<std::string> arguments{"render", "house.svt", "-o", "p.png", "--size", "160x90"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        runSvtWell(folder.path(), arguments);
        auto image = image::readPng(folder / "p.png");
        if (!image) {
            ADD_FAILURE() << image.error().toString();
            return {1, 1};
        }
        return *image;
    }
    TemporaryFolder folder;
};

TEST_F(SmallHouse, HidingAllLeavesTheBackground) {
    const auto image = draw({"--hide", "all", "--background", "#102030"});
    for (const image::Rgba8& pixel : image.pixels()) ASSERT_EQ(pixel, (image::Rgba8{0x10, 0x20, 0x30, 255}));
}

TEST_F(SmallHouse, TransparentBackgroundHasNoAlpha) {
    const auto image = draw({"--transparent"});
    EXPECT_EQ(image.at(0, 0).a, 0);
    EXPECT_EQ(image.at(80, 45).a, 255);
}

TEST_F(SmallHouse, LinesAndMeshesOfTheModelAreThoseOfItsVolume) {
    const std::vector<std::string> options{"--wireframe", "--vectors", "class=BuildingFurniture", "--opacity",
                                           "all:0.3"};
    runSvtWell(folder.path(),
               {"build", "house.gml", "-o", "house.svt", "--spacing", "0.2", "--vectors", "edges,meshes"});
    const auto ofVolume = draw(options);
    std::vector<std::string> arguments{"render", "house.gml", "-o", "p.png", "--size", "160x90", "--spacing", "0.2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    runSvtWell(folder.path(), arguments);
    const auto ofModel = image::readPng(folder / "p.png");
    ASSERT_TRUE(ofModel);
    EXPECT_EQ(*ofModel, ofVolume);
    EXPECT_NE(draw({"--opacity", "all:0.3"}), ofVolume);
}

TEST_F(SmallHouse, WithoutLinesAndMeshesTheRemedyIsNamed) {
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "house.svt", "--spacing", "0.2", "--vectors", "none"});
    for (const auto& [option, query, what] : {std::tuple("--wireframe", "all", "--vectors edges"),
                                              std::tuple("--vectors", "size<0.5", "--vectors meshes")}) {
        const CommandResult result = runSvt(folder.path(), {"render", "house.svt", "-o", "p.png", option, query});
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    }
}

TEST_F(SmallHouse, ExactSurfacesAreThoseOfTheModelAndItsVolume) {
    const std::vector<std::string> options{"--surfaces", "exact", "--section", "y<5", "--hide", "class=BuildingRoom"};
    const auto ofVolume = draw(options);
    std::vector<std::string> arguments{"render", "house.gml", "-o", "p.png", "--size", "160x90", "--spacing", "0.2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const CommandResult result = runSvt(folder.path(), arguments);
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_EQ(result.err.find("exact surfaces"), std::string::npos) << "all features have closed meshes";
    const auto ofModel = image::readPng(folder / "p.png");
    ASSERT_TRUE(ofModel);
    EXPECT_EQ(*ofModel, ofVolume);
    EXPECT_EQ(draw({"--section", "y<5", "--hide", "class=BuildingRoom"}), ofVolume) << "exact is the default";
    EXPECT_NE(draw({"--section", "y<5", "--hide", "class=BuildingRoom", "--surfaces", "voxels"}), ofVolume);
}

TEST_F(SmallHouse, ExactSurfacesAreThoseOfStoreysApartAndOfDetails) {
    EXPECT_NE(draw({"--explode", "3"}), draw({"--explode", "3", "--surfaces", "voxels"}));
    // A detail of the same place and the same faces changes nothing, except where two rounded corners decide.
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "fine.svt", "--spacing", "0.1"});
    const auto ofDetail = draw({"--surfaces", "exact", "--with", "fine.svt"});
    EXPECT_LT(image::compareImages(ofDetail, draw({"--surfaces", "exact"})).error, 0.05);
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "fine.svt", "--spacing", "0.1", "--vectors", "none"});
    const CommandResult result =
        runSvt(folder.path(), {"render", "house.svt", "-o", "p.png", "--surfaces", "exact", "--with", "fine.svt"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("voxels show them"), std::string::npos) << result.toString();
}

TEST_F(SmallHouse, ASceneFileKeepsTheSourceOfTheSurfaces) {
    const auto voxels = draw({"--surfaces", "voxels", "--write-scene", "voxels.scene.json"});
    EXPECT_EQ(draw({"--scene", "voxels.scene.json"}), voxels);
    EXPECT_NE(draw({"--scene", "voxels.scene.json", "--surfaces", "exact"}), voxels);
}

TEST_F(SmallHouse, WithoutMeshesPicturesAreThoseOfVoxels) {
    const auto voxels = draw({"--surfaces", "voxels"});
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "house.svt", "--spacing", "0.2", "--vectors", "none"});
    EXPECT_EQ(draw({}), voxels);
    EXPECT_EQ(draw({"--cells"}), draw({"--cells", "--surfaces", "voxels"}));
    EXPECT_EQ(draw({"--level", "1"}), draw({"--level", "1", "--surfaces", "voxels"}));
}

TEST_F(SmallHouse, FeaturesWithoutExactSurfaceAreCounted) {
    const CommandResult result = runSvt(folder.path(), {"render", "house.gml", "-o", "p.png", "--spacing", "0.2",
                                                        "--surfaces", "exact", "--size", "160x90", "--patterns"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("have no closed mesh, a pattern"), std::string::npos) << result.toString();
}

TEST_F(SmallHouse, ExactSurfacesRefuseWhatNeedsVoxels) {
    const auto refused = [&](const std::vector<std::string>& more, const char* text) {
        std::vector<std::string> words{"render", "house.svt", "-o", "q.png", "--surfaces", "exact"};
        words.insert(words.end(), more.begin(), more.end());
        const CommandResult result = runSvt(folder.path(), words);
        EXPECT_EQ(result.exitCode, 2) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "q.png"));
    };
    refused({"--gl"}, "--surfaces exact does not support --gl");
    refused({"--cells"}, "--surfaces exact does not support --cells");
    refused({"--level", "2"}, "--surfaces exact does not support --level");
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "house.svt", "--spacing", "0.2", "--vectors", "none"});
    refused({}, "--vectors meshes");
}

TEST_F(SmallHouse, ASizeInMillimetresIsToldToThePrinter) {
    const auto perMetre = [&] {
        const std::string bytes = readText(folder / "p.png");
        const std::size_t at = bytes.find("pHYs");
        if (at == std::string::npos) return 0;
        const auto byte = [&](std::size_t n) {
            return static_cast<int>(static_cast<unsigned char>(bytes[at + 4 + n]));
        };
        return byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
    };
    (void)draw({});
    EXPECT_EQ(perMetre(), 0);
    runSvtWell(folder.path(), {"render", "house.svt", "-o", "p.png", "--size", "50.8x25.4mm", "--dpi", "100"});
    EXPECT_EQ(image::readPng(folder / "p.png")->width(), 200);
    EXPECT_EQ(perMetre(), 3937);
    runSvtWell(folder.path(), {"render", "house.svt", "-o", "p.png", "--size", "25.4x12.7mm"});
    EXPECT_EQ(image::readPng(folder / "p.png")->width(), 300);
    EXPECT_EQ(perMetre(), 11811);
}

TEST_F(SmallHouse, PictureOfTheModelIsThatOfItsVolume) {
    const auto ofVolume = draw({});
    runSvtWell(folder.path(), {"render", "house.gml", "-o", "p.png", "--size", "160x90", "--spacing", "0.2"});
    const auto ofModel = image::readPng(folder / "p.png");
    ASSERT_TRUE(ofModel);
    EXPECT_EQ(*ofModel, ofVolume);
}

TEST_F(SmallHouse, LabelsAreThoseOfInfo) {
    (void)draw({"--labels", "labels.png", "--show", "id=house_chimney"});
    const auto labels = image::readGrayPng(folder / "labels.png");
    ASSERT_TRUE(labels);
    const auto rows = runSvtForJson(folder.path(), {"query", "house.svt", "id=house_chimney", "--json"});
    const int first = rows.at(0).at("first");
    std::size_t hits = 0;
    for (const std::uint16_t label : labels->pixels()) {
        ASSERT_TRUE(label == 0 || label == first) << label;
        hits += label == first;
    }
    EXPECT_GT(hits, 20u);
}

TEST_F(SmallHouse, DepthIsInMillimetres) {
    // From the south in parallel projection: hits lie within the house, 12.6 m deep, in front of the eye.
    (void)draw({"--depth", "depth.png", "--camera", "front"});
    const auto depth = image::readGrayPng(folder / "depth.png");
    ASSERT_TRUE(depth);
    std::uint16_t least = 65535, most = 0;
    for (const std::uint16_t step : depth->pixels()) {
        if (step == 0) continue;
        least = std::min(least, step);
        most = std::max(most, step);
    }
    EXPECT_LT(least, most);
    EXPECT_LT(most - least, 16000);
    EXPECT_GT(most - least, 1000);
}

// What is lit is as bright behind the walls of its house as it is alone.
TEST_F(SmallHouse, GhostsDoNotDullWhatIsHighlighted) {
    const std::string target = "id=house_chimney or class=BuildingFurniture";
    std::vector<std::string> common{"--edges", "0",      "--samples", "1",        "--fit",
                                    "all",     "--look", "dark",      "--labels", "labels.png"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), common.begin(), common.end());
        return more;
    };
    for (const char* context : {"ghost", "shell"}) {
        const auto lit = draw(with({"--highlight", target, "--context", context}));
        const auto labels = image::readGrayPng(folder / "labels.png");
        ASSERT_TRUE(labels);
        const auto alone = draw(with({"--show", target}));
        const auto own = image::readGrayPng(folder / "labels.png");
        ASSERT_TRUE(own);
        std::size_t seen = 0;
        for (std::int32_t y = 0; y < lit.height(); ++y)
            for (std::int32_t x = 0; x < lit.width(); ++x) {
                // Not at its outline, where a pixel has rays of both.
                bool isInside = true;
                for (int n = 0; n < 9 && isInside; ++n) {
                    const std::int32_t i = x + n % 3 - 1, j = y + n / 3 - 1;
                    isInside = i >= 0 && j >= 0 && i < lit.width() && j < lit.height() && own->at(i, j) != 0;
                }
                if (!isInside) continue;
                EXPECT_EQ(lit.at(x, y), alone.at(x, y)) << context << ' ' << x << ' ' << y;
                EXPECT_EQ(labels->at(x, y), own->at(x, y));
                ++seen;
            }
        EXPECT_GT(seen, 20u);
    }
}

// What is lit stands out from what is around it.
TEST_F(SmallHouse, WhatIsHighlightedIsSeenInAllLooks) {
    const std::string target = "id=house_chimney or class=BuildingFurniture";
    for (const char* look : {"plain", "paper", "blueprint", "dark"}) {
        const std::vector<std::string> common{"--edges", "0",      "--samples", "1",        "--fit",
                                              "all",     "--look", look,        "--labels", "labels.png"};
        const auto with = [&](std::vector<std::string> more) {
            more.insert(more.end(), common.begin(), common.end());
            return more;
        };
        (void)draw(with({"--show", target}));
        const auto own = image::readGrayPng(folder / "labels.png");
        ASSERT_TRUE(own);
        const auto lit = draw(with({"--highlight", target}));
        // Of pixels of the target with eight neighbours of it, and of others at most 4 pixels beside it.
        double sums[2][3] = {}, counts[2] = {};
        for (std::int32_t y = 4; y < lit.height() - 4; ++y)
            for (std::int32_t x = 4; x < lit.width() - 4; ++x) {
                int near = 0, close = 0;
                for (std::int32_t j = -4; j <= 4; ++j)
                    for (std::int32_t i = -4; i <= 4; ++i) {
                        if (own->at(x + i, y + j) == 0) continue;
                        ++near;
                        close += std::abs(i) <= 1 && std::abs(j) <= 1;
                    }
                if (close != 9 && (close != 0 || near == 0)) continue;
                const std::size_t k = close == 9 ? 0 : 1;
                const image::Rgba8 pixel = lit.at(x, y);
                sums[k][0] += pixel.r;
                sums[k][1] += pixel.g;
                sums[k][2] += pixel.b;
                counts[k] += 1;
            }
        ASSERT_GT(counts[0], 20) << look;
        ASSERT_GT(counts[1], 20) << look;
        double difference = 0;
        for (std::size_t c = 0; c < 3; ++c)
            difference = std::max(difference, std::abs(sums[0][c] / counts[0] - sums[1][c] / counts[1]));
        EXPECT_GT(difference, 30) << look;
    }
}

TEST_F(SmallHouse, NamesWithoutRoomAreCounted) {
    const std::vector<std::string> arguments{"render", "house.svt", "-o",  "p.png",     "--size",
                                             "160x90", "--names",   "all", "--section", "y<5"};
    const CommandResult result = runSvt(folder.path(), arguments);
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("do not fit; choose a larger --size"), std::string::npos) << result.toString();
    EXPECT_NE(result.err.find("hidden features are not labelled"), std::string::npos) << result.toString();
}

TEST_F(SmallHouse, TargetsOfACutawayThatAreNotSeenAreNamed) {
    const auto notesOf = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"render", "house.svt", "-o", "p.png", "--size", "160x90", "--cutaway"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        return result.err;
    };
    EXPECT_EQ(notesOf({"id=house_chimney"}).find("cutaway:"), std::string::npos);
    EXPECT_NE(notesOf({"id=house_chimney", "--hide", "id=house_chimney"}).find("cutaway: 1 of 1 are not visible"),
              std::string::npos);
    EXPECT_NE(notesOf({"all"}).find("are not visible, behind other targets"), std::string::npos);
}

// A member of a scene asks for no less than the option does.
TEST_F(SmallHouse, LineDrawingsRefuseWhatTheyDoNotHaveFromScenesToo) {
    const std::pair<const char*, const char*> members[] = {
        {R"("sun":{"time":"2026-06-21 15:00","place":[49.1,8.4]})", "--sun"},
        {R"("insets":[{"scene":{"camera":{"preset":"top"}}}])", "--inset"},
        {R"("explode":3)", "--explode"},
        {R"("passes":[{"cells":true}])", "--cells"},
        {R"("look":"paper")", nullptr}};
    for (const auto& [member, option] : members) {
        writeText(folder / "l.scene.json", std::string(R"({"format":"svt-scene","version":1,)") + member + '}');
        for (const char* output : {"l.svg", "l.pdf"}) {
            const CommandResult result = runSvt(
                folder.path(), {"render", "house.svt", "-o", output, "--size", "160x90", "--scene", "l.scene.json"});
            EXPECT_EQ(result.exitCode != 0, option != nullptr) << result.toString();
            EXPECT_EQ(std::filesystem::exists(folder / output), option == nullptr) << member;
            if (option != nullptr) {
                EXPECT_NE(result.err.find(option), std::string::npos) << result.toString();
            }
        }
    }
}

TEST_F(SmallHouse, LastOfTwoColorsWins) {
    const auto isRed = [](const image::Rgba8& p) { return p.r > p.b + 60 && p.r > p.g + 60; };
    const auto isBlue = [](const image::Rgba8& p) { return p.b > p.r + 60 && p.b > p.g + 60; };
    const auto image = draw({"--color", "all:red", "--color", "all:blue", "--opacity", "all:1"});
    EXPECT_EQ(std::count_if(image.pixels().begin(), image.pixels().end(), isRed), 0);
    EXPECT_GT(std::count_if(image.pixels().begin(), image.pixels().end(), isBlue), 500);
}

// Films, of which ffprobe tells what a player sees.
class Films : public ::testing::Test {
protected:
    void SetUp() override {
        if (!hasProgram("ffmpeg -version")) GTEST_SKIP() << "ffmpeg is not installed (scripts/setup.sh readers)";
        prepareHouse(folder_.path(), "0.25");
    }
    [[nodiscard]] std::string streamOf(const std::string& film) const {
        const std::string text = runShellWell(
            folder_.path(),
            "ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,r_frame_rate,nb_read_frames "
            "-of csv=p=0 " +
                film);
        return text.substr(0, text.find('\n'));
    }
    [[nodiscard]] std::string bytesOf(const std::string& file) const { return readText(folder_.path() / file); }

    TemporaryFolder folder_;
};

TEST_F(Films, HaveTheSizeRateAndNumberOfPicturesThatWereAskedFor) {
    const Limits limits{.seconds = 120, .memoryBytes = std::uint64_t{8} << 30};
    for (const auto& [film, stream] :
         std::initializer_list<std::pair<std::string, std::string>>{{"turn.webm", "vp9,162,90,5/1,10"},
                                                                    {"turn.mp4", "h264,162,90,5/1,10"},
                                                                    {"turn.gif", "gif,161,90,5/1,10"}}) {
        const CommandResult made = runSvt(
            folder_.path(),
            {"render", "house.svt", "-o", film, "--turn", "360", "--seconds", "2", "--rate", "5", "--size", "161x90"},
            limits);
        EXPECT_EQ(made.exitCode, 0) << made.toString();
        EXPECT_EQ(streamOf(film), stream);
    }
}

TEST_F(Films, AreTheSameBytesEachTimeAndRepeatAsWebP) {
    const Limits limits{.seconds = 120, .memoryBytes = std::uint64_t{8} << 30};
    for (const char* film : {"a.webm", "b.webm", "a.webp", "b.webp"}) {
        const CommandResult made = runSvt(folder_.path(),
                                          {"render", "house.svt", "-o", film, "--section", "z=6..1", "--seconds", "1",
                                           "--rate", "6", "--size", "160x90"},
                                          limits);
        EXPECT_EQ(made.exitCode, 0) << made.toString();
    }
    EXPECT_FALSE(bytesOf("a.webm").empty());
    EXPECT_EQ(bytesOf("a.webm"), bytesOf("b.webm"));
    EXPECT_EQ(bytesOf("a.webp"), bytesOf("b.webp"));
    EXPECT_NE(bytesOf("a.webp").find("ANIM"), std::string::npos);
}

// Whether two files are there and have the same bytes.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    return std::filesystem::exists(a) && std::filesystem::exists(b) && readText(a) == readText(b);
}

TEST(Motion, PicturesOfASeriesAreThoseOfTheScene) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.25");
    writeText(folder / "move.scene.json",
              R"({"size":[160,90],"camera":{"fit":"all"},"passes":[{"cut":"z>6"}],"motion":{"seconds":2,"pace":"even",
            "keys":[{"at":2,"scene":{"passes":[{"cut":"z>1"}]}}]}})");
    runSvtWell(folder.path(), {"render", "house.svt", "-o", "p.png", "--scene", "move.scene.json", "--frames", "3"});
    const auto same = [&](const std::string& a, const std::string& b) { return isSameFile(folder / a, folder / b); };
    for (const auto& [file, plane] :
         {std::pair("p_0000.png", "z>6"), std::pair("p_0001.png", "z>3.5"), std::pair("p_0002.png", "z>1")}) {
        runSvtWell(folder.path(),
                   {"render", "house.svt", "-o", "one.png", "--cut", plane, "--size", "160x90", "--fit", "all"});
        EXPECT_TRUE(same(file, "one.png")) << file;
    }
}

TEST(Motion, PicturesInWhichNothingMovesAreRefused) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.5");
    const CommandResult still =
        runSvt(folder.path(), {"render", "house.svt", "-o", "p.png", "--frames", "3", "--section", "z=2"});
    EXPECT_EQ(still.exitCode, kUsage) << still.toString();
    EXPECT_NE(still.err.find("nothing moves in these pictures"), std::string::npos) << still.toString();
}

TEST(Motion, AMovingSectionIsKeptInTheWrittenScene) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.25");
    const auto same = [&](const std::string& a, const std::string& b) { return isSameFile(folder / a, folder / b); };
    const std::vector<std::vector<std::string>> cases{{"--section", "z=6..1"},
                                                      {"--section", "z=6..1", "--section", "y<3", "--turn", "90"},
                                                      {"--section", "z=4..1", "--lens", "box(0,0,0,5,5,5)"}};
    for (const auto& sections : cases) {
        std::vector<std::string> command{"render", "house.svt", "-o", "a.png",         "--size",
                                         "160x90", "--frames",  "3",  "--write-scene", "move.scene.json"};
        command.insert(command.end(), sections.begin(), sections.end());
        runSvtWell(folder.path(), command);
        runSvtWell(folder.path(),
                   {"render", "house.svt", "-o", "b.png", "--scene", "move.scene.json", "--frames", "3"});
        for (const char* picture : {"_0000.png", "_0001.png", "_0002.png"})
            EXPECT_TRUE(same("a" + std::string(picture), "b" + std::string(picture))) << sections[1] << picture;
        EXPECT_FALSE(same("a_0000.png", "a_0002.png")) << "it moves";
    }
    runSvtWell(folder.path(),
               {"render", "house.svt", "-o", "a.png", "--size", "160x90", "--frames", "3", "--section", "z=6..1"});
    for (const auto& [file, plane] :
         {std::pair("a_0000.png", "z=6"), std::pair("a_0001.png", "z=3.5"), std::pair("a_0002.png", "z=1")}) {
        runSvtWell(folder.path(),
                   {"render", "house.svt", "-o", "one.png", "--section", plane, "--size", "160x90", "--fit", "all"});
        EXPECT_TRUE(same(file, "one.png")) << file;
    }
}

TEST(Motion, TheSceneFileIsReadOnce) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.5");
    const auto file = folder.path() / "move.scene.json";
    writeText(file, R"({"size":[64,36],"motion":{"turn":360}})");
    const int events = ::inotify_init1(IN_NONBLOCK);
    if (events < 0) GTEST_SKIP() << "no inotify on this machine";
    ASSERT_GE(::inotify_add_watch(events, file.c_str(), IN_OPEN | IN_CLOSE_NOWRITE), 0);
    const auto opened = [&](const char* frames) {
        runSvtWell(folder.path(),
                   {"render", "house.svt", "-o", "p.png", "--scene", "move.scene.json", "--frames", frames});
        int count = 0;
        alignas(inotify_event) char buffer[16384];
        for (ssize_t bytes = 0; (bytes = ::read(events, buffer, sizeof buffer)) > 0;)
            for (const char* at = buffer; at < buffer + bytes;) {
                const auto* event = reinterpret_cast<const inotify_event*>(at);
                count += (event->mask & IN_OPEN) != 0;
                at += sizeof(inotify_event) + event->len;
            }
        return count;
    };
    const int few = opened("2");
    EXPECT_GT(few, 0);
    EXPECT_EQ(opened("7"), few);
    ::close(events);
}

TEST(Motion, FilmsThatCannotBeAreRefusedBeforeTheWork) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    const auto refused = [&](const std::vector<std::string>& more, const char* text) {
        std::vector<std::string> words{"render", "house.gml", "-o", "film.webm", "--size", "160x90"};
        words.insert(words.end(), more.begin(), more.end());
        const CommandResult result = runSvt(folder.path(), words);
        EXPECT_NE(result.exitCode, 0);
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "film.webm"));
    };
    refused({}, "nothing moves in this film");
    refused({"--turn", "360", "--frames", "5"}, "--seconds and --rate");
    refused({"--turn", "360", "--labels", "l.png"}, "not for films");
    const CommandResult still = runSvt(folder.path(), {"render", "house.gml", "-o", "p.png", "--turn", "90"});
    EXPECT_NE(still.exitCode, 0);
    EXPECT_NE(still.err.find("--turn moves the camera, which needs several pictures"), std::string::npos)
        << still.toString();
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    refused({"--turn", "360"}, "ffmpeg, which is not installed");
    setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace svt::test
