#include <svt/core/check.hpp>
#include <svt/core/result.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

enum class Kind : std::uint8_t { A, B };

TEST(CheckDeathTest, PrintsTheValues) {
    const int count = 3;
    EXPECT_DEATH(SVT_CHECK(count == 4), "count == 4 \\[3 and 4\\] .*check_test.cpp");
    EXPECT_DEATH(SVT_CHECK(count + 1 < 2 * 2), "\\[4 and 4\\]");
    EXPECT_DEATH(SVT_CHECK(Kind::A == Kind::B), "\\[0 and 1\\]");
    EXPECT_DEATH(SVT_CHECK(count == 3 && count > 5), "count == 3 && count > 5 \\(");
    const bool isFine = false;
    EXPECT_DEATH(SVT_CHECK(isFine), "isFine \\[false\\]");
    SVT_CHECK(count == 3);
    SVT_CHECK(count >= 3 && !isFine);
}

TEST(ResultDeathTest, AValueThatIsNotThereStopsWithTheErrorsText) {
    const Result<int> failed = Error(Code::CannotOpen, "no such file", Place{"a.gml", 7, 0, {}});
    EXPECT_DEATH((void)failed.value(), "E101.*a.gml:7.*no such file");
    EXPECT_DEATH((void)*failed, "no such file");
    EXPECT_EQ(*Result<int>(5), 5);
}

TEST(ResultDeathTest, AnErrorThatIsNotThereStops) {
    Result<int> good(5);
    EXPECT_DEATH((void)good.error(), "!Result::hasValue\\(\\)");
    EXPECT_DEATH((void)std::move(good).error(), "!Result::hasValue\\(\\)");
    const Result<void> done;
    EXPECT_DEATH((void)done.error(), "!Result::hasValue\\(\\)");
}

}  // namespace
}  // namespace svt
