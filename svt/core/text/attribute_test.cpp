#include <svt/core/attribute.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

TEST(Attribute, TextOfValues) {
    EXPECT_EQ(toText(std::string("Küche")), "Küche");
    EXPECT_EQ(toText(std::int64_t{-5}), "-5");
    EXPECT_EQ(toText(9.5), "9.5");
    EXPECT_EQ(toText(0.1), "0.1");
    EXPECT_EQ(toText(true), "true");
    EXPECT_EQ(toText(false), "false");
}

}  // namespace
}  // namespace svt
