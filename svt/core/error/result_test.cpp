#include <svt/core/result.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace svt {
namespace {

Result<int> half(int number) {
    if (number % 2 != 0) return Error(Code::BadArgument, "odd");
    return number / 2;
}

TEST(Result, HoldsAValue) {
    const Result<int> result = half(6);
    ASSERT_TRUE(result);
    EXPECT_TRUE(result.hasValue());
    EXPECT_EQ(*result, 3);
    EXPECT_EQ(result.value(), 3);
}

TEST(Result, HoldsAnError) {
    const Result<int> result = half(7);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code(), Code::BadArgument);
    EXPECT_EQ(result.error().message(), "odd");
}

TEST(Result, AnErrorIsAFailureEvenWhereAValueCouldBeMadeOfIt) {
    struct FromError {
        explicit FromError(const Error&) {}
    };
    const Result<FromError> result = Error(Code::Internal, "x");
    EXPECT_FALSE(result);
}

TEST(Result, MoveOnlyValuesCanBeTakenOut) {
    Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
    ASSERT_TRUE(result);
    const std::unique_ptr<int> taken = *std::move(result);
    EXPECT_EQ(*taken, 5);
}

TEST(Result, ArrowReachesTheValue) {
    Result<std::string> result = std::string("abc");
    result->push_back('d');
    EXPECT_EQ(result->size(), 4u);
}

TEST(Result, VoidIsDoneOrAnError) {
    const Result<void> done;
    EXPECT_TRUE(done);
    const Result<void> failed = Error(Code::DiskFull, "full");
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code(), Code::DiskFull);
}

}  // namespace
}  // namespace svt
