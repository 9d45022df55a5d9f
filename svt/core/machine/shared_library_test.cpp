#include <svt/core/machine.hpp>

#include <gtest/gtest.h>

#include <string>

namespace svt {
namespace {

TEST(SharedLibrary, FindsFunctionsByName) {
    const Result<SharedLibrary> library = SharedLibrary::load("libz.so.1");
    if (!library) GTEST_SKIP() << library.error().message();
    const char* (*version)() = nullptr;
    ASSERT_TRUE(library->find("zlibVersion", version));
    EXPECT_EQ(version()[0], '1');
    EXPECT_FALSE(library->find("noSuchFunction", version));
    EXPECT_EQ(version, nullptr);
}

TEST(SharedLibrary, SaysWhichOneCannotBeLoaded) {
    const Result<SharedLibrary> library = SharedLibrary::load("libnone.so.7");
    ASSERT_FALSE(library);
    EXPECT_EQ(library.error().code(), Code::CannotOpen);
    EXPECT_NE(library.error().message().find("libnone.so.7"), std::string::npos);
}

}  // namespace
}  // namespace svt
