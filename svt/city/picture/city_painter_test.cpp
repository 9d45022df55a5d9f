// One scene of a city has the same styles wherever it is drawn: the command's painter, and tiles that a page has read.
#include <svt/city/city_folder.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/city/city_pack.hpp>
#include <svt/city/city_painter.hpp>
#include <svt/city/city_plan.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/samples/city_sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::city {
namespace {

constexpr const char* kAllClasses = "class~'Building|Surface|Window|Door|Closure|Installation'";
constexpr Vec3f kBlue{0, 0, 1};

// A city whose coarsest detail has mixtures of classes; built once for all tests.
const City& smallCity() {
    static const test::TemporaryFolder folder;
    static const City city = [] {
        const std::filesystem::path input = folder / "files";
        std::filesystem::create_directories(input);
        const samples::CitySampleOptions sample{samples::CityProfile::Berlin, 96, 1, 3};
        std::string text;
        EXPECT_TRUE(samples::writeCitySample(sample, 0, [&](std::string_view part) {
            text += part;
            return true;
        }));
        test::writeText(input / samples::citySampleFileName(sample, 0), text);
        PlanOptions options;
        options.city.spacing = 0.15;
        options.program = "test";
        Diagnostics findings;
        const auto files = cityInputs(std::span(&input, 1));
        const auto plan = makePlan(*files, folder / "city", options, findings);
        EXPECT_TRUE(plan) << plan.error().toString();
        for (std::uint32_t pack = 0; pack < plan->packs; ++pack)
            EXPECT_TRUE(runPack(folder / "city", *plan, pack, PackOptions{}));
        EXPECT_TRUE(mergeCity(folder / "city", *plan));
        auto opened = City::open(folder / "city");
        EXPECT_TRUE(opened) << opened.error().toString();
        return *opened;
    }();
    return city;
}

illustrate::Scene smallScene() {
    illustrate::Scene scene;
    scene.width = 48;
    scene.height = 36;
    scene.samples = 1;
    return scene;
}

// What a page does with the tiles that it has fetched.
Result<JoinedTiles> tilesOfAPage(const ChosenTiles& chosen) {
    SVT_TRY(frame, frameVolume(smallCity()));
    SVT_TRY(parts, readTiles(smallCity(), chosen));
    return joinTiles(smallCity(), *frame, chosen, std::move(*parts));
}

Result<illustrate::Painting> paintAsAPage(const JoinedTiles& tiles, const illustrate::Scene& scene) {
    illustrate::ScenePainter painter(tiles.frame);
    std::vector<std::string> nothing;
    painter.tolerateNothing(&nothing);
    tiles.addTo(painter);
    return painter.paint(scene);
}

ChosenTiles topTile() {
    ChosenTiles chosen;
    chosen.entries.push_back(smallCity().top());
    return chosen;
}

TEST(CityPainter, StylesByClassReachCoarseMixtures) {
    ASSERT_GT(smallCity().topDetail(), kFirstClassDetail) << "the city has no mixtures";
    const auto tiles = tilesOfAPage(topTile());
    ASSERT_TRUE(tiles) << tiles.error().toString();
    ASSERT_FALSE(tiles->mixtures.empty());

    illustrate::Scene scene = smallScene();
    scene.background = Vec3f{0, 0, 0};
    scene.passes.front().styles.push_back({kAllClasses, kBlue, {}, {}, false});
    const auto blue = paintAsAPage(*tiles, scene);
    ASSERT_TRUE(blue) << blue.error().toString();
    for (const auto& mixture : tiles->mixtures) {
        const render::Style& style = blue->spec.passes.front().styles.at(mixture.scalar);
        EXPECT_EQ(style.color.x, 0);
        EXPECT_EQ(style.color.y, 0);
        EXPECT_GT(style.color.z, 0);
        EXPECT_GT(style.opacity, 0);
    }

    scene = smallScene();
    scene.passes.front().hide.emplace_back(kAllClasses);
    const auto hidden = paintAsAPage(*tiles, scene);
    ASSERT_TRUE(hidden) << hidden.error().toString();
    for (const auto& mixture : tiles->mixtures)
        EXPECT_EQ(hidden->spec.passes.front().styles.at(mixture.scalar).opacity, 0);
    EXPECT_TRUE(std::ranges::all_of(hidden->frame.label.pixels(), [](auto label) { return label == 0; }));
}

TEST(CityPainter, AMixtureIsTheMeanOfItsClassesByCoverage) {
    const auto tiles = tilesOfAPage(topTile());
    ASSERT_TRUE(tiles) << tiles.error().toString();
    illustrate::Scene scene = smallScene();
    scene.isTransparent = true;  // no background between the houses
    scene.passes.front().styles.push_back({"class=RoofSurface", kBlue, {}, {}, false});
    const auto painting = paintAsAPage(*tiles, scene);
    ASSERT_TRUE(painting) << painting.error().toString();
    const auto& styles = painting->spec.passes.front().styles;
    for (const auto& mixture : tiles->mixtures) {
        Vec3f sum{};
        float all = 0;
        for (const auto& [scalar, share] : mixture.parts) {
            if (styles.at(scalar).opacity <= 0) continue;
            sum = sum + styles.at(scalar).color * share;
            all += share;
        }
        if (all <= 0) continue;
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(styles.at(mixture.scalar).color[axis], sum[axis] / all, 1e-5) << axis;
    }
}

TEST(CityPainter, DrawsWhatAPageDraws) {
    auto painter = CityPainter::make(smallCity(), {});
    ASSERT_TRUE(painter) << painter.error().toString();
    illustrate::Scene scene = smallScene();
    scene.passes.front().styles.push_back({"class=RoofSurface", kBlue, {}, {}, false});
    const auto byCommand = painter->paint(scene, {});
    ASSERT_TRUE(byCommand) << byCommand.error().toString();
    const auto tiles = tilesOfAPage(painter->chosen());
    ASSERT_TRUE(tiles) << tiles.error().toString();
    const auto byPage = paintAsAPage(*tiles, scene);
    ASSERT_TRUE(byPage) << byPage.error().toString();
    EXPECT_TRUE(std::ranges::equal(byCommand->frame.color.pixels(), byPage->frame.color.pixels()));
    EXPECT_TRUE(std::ranges::equal(byCommand->frame.label.pixels(), byPage->frame.label.pixels()));
    EXPECT_TRUE(std::ranges::any_of(byPage->frame.label.pixels(), [](auto label) { return label != 0; }));
}

}  // namespace
}  // namespace svt::city
