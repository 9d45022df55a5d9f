// Plans of more buildings than a test can read: the survey is made up, all after it is real.
#include <svt/city/plan/survey.hpp>
#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace svt::city {
namespace {

// Buildings every 14 m, in files of 50,000, along rows; costs as of LoD2.
Survey madeUp(std::uint64_t count) {
    Survey survey;
    survey.crs = 25833;
    const auto side = static_cast<std::uint64_t>(std::sqrt(double(count))) + 1;
    std::uint64_t state = 1;
    for (std::uint64_t n = 0; n < count; ++n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const auto file = static_cast<std::uint32_t>(n / 50'000);
        survey.features.push_back({n % 50'000 * 14'000, 13'800, state, state ^ n,
                                   static_cast<std::int32_t>(38'000'000 + n % side * 1400),
                                   static_cast<std::int32_t>(581'000'000 + n / side * 1400), file,
                                   static_cast<std::uint32_t>(900 + (state >> 40) % 400)});
        if (file >= survey.files.size()) {
            survey.fileNames.push_back("/files/" + std::to_string(file));
            survey.files.push_back({survey.fileNames.back(), 1, 25833, 1, 7});
        }
    }
    return survey;
}

std::uint64_t peakKilobytes() {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("VmHWM:")) return std::strtoull(line.c_str() + 6, nullptr, 10);
    return 0;
}

void plan(std::uint64_t count) {
    const test::TemporaryFolder folder;
    Diagnostics findings;
    const Survey survey = madeUp(count);
    PlanOptions options;
    options.program = "test";
    const auto begin = std::chrono::steady_clock::now();
    const auto made = planSurveyed(survey, folder / "city", options, findings);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ASSERT_TRUE(made) << made.error().toString();
    EXPECT_EQ(made->features, count);
    EXPECT_LE(made->tasks, 1000u);
    std::uint64_t features = 0, most = 0;
    for (const PlanTile& tile : made->tiles) {
        features += tile.featureCount;
        most = std::max<std::uint64_t>(most, tile.featureCount);
    }
    EXPECT_EQ(features, count);
    EXPECT_LE(most, Plan::kMaxFeatures);
    const auto read = readPlan(folder / "city", "test");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->packDigests, made->packDigests);
    EXPECT_LT(peakKilobytes(), 1'000'000u);
    std::printf("%llu features: %zu tiles, %u packs, %u tasks, %.1f s after the survey, at most %.0f MB\n",
                static_cast<unsigned long long>(count), made->tiles.size(), made->packs, made->tasks, seconds,
                double(peakKilobytes()) / 1e3);
}

TEST(LargePlan, OfAHundredThousand) { plan(100'000); }
// --gtest_also_run_disabled_tests --gtest_filter=LargePlan.DISABLED_OfTenMillion: half a minute and 0.6 GB
TEST(LargePlan, DISABLED_OfAMillion) { plan(1'000'000); }
TEST(LargePlan, DISABLED_OfTenMillion) { plan(10'000'000); }

}  // namespace
}  // namespace svt::city
