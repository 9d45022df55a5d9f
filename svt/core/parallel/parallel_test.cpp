#include <svt/core/parallel.hpp>
#include <svt/core/simd_targets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace svt {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
    for (const int threads : {0, 1, 2}) {
        for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 1000u}) {
            for (const std::size_t grain : {0u, 1u, 7u, 5000u}) {
                std::vector<std::atomic<int>> visits(count);
                parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
                    EXPECT_LT(begin, end);
                    EXPECT_LE(end, count);
                    for (std::size_t i = begin; i < end; ++i) ++visits[i];
                });
                for (const auto& visit : visits) ASSERT_EQ(visit, 1) << count << " by " << grain << " on " << threads;
            }
        }
    }
}

TEST(Parallel, OneThreadIsTheCaller) {
    int calls = 0;  // not atomic, so ThreadSanitizer reports a second thread
    parallelFor(1000, 10, 1, [&](std::size_t, std::size_t) { ++calls; });
    EXPECT_GE(calls, 1);
}

TEST(Parallel, LoopsMayBeNested) {
    std::atomic<int> sum{0};
    parallelFor(8, 1, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            parallelFor(100, 10, 0, [&](std::size_t b, std::size_t e) { sum += static_cast<int>(e - b); });
    });
    EXPECT_EQ(sum, 800);
}

TEST(Parallel, MoreThreadsThanCoresAreNoReasonToPrint) {
    ::testing::internal::CaptureStderr();
    std::atomic<int> sum{0};
    parallelFor(1000, 1, 1000, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
    EXPECT_EQ(sum, 1000);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Parallel, ThereIsAtLeastOneCore) { EXPECT_GE(hardwareThreads(), 1); }

TEST(SimdTargets, TheOneInUseIsAmongThoseCompiled) {
    const std::vector<std::string_view> names = compiledSimdTargets();
    EXPECT_EQ(std::ranges::count(names, simdTargetName()), 1);
    EXPECT_EQ(std::ranges::count(names, "Unknown"), 0) << "a set of instructions without a name";
}

}  // namespace
}  // namespace svt
