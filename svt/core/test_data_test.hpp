#pragma once
/// \file
/// Finds the checkout, and real models that are not part of the repository.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace svt::test {

/// Root of the checkout that the test was built from; the build defines it (cmake/SvtLibrary.cmake).
extern const char* const kSourceRoot;

/// $SVT_DATA_DIR, else ../shared/data beside the checkout.
inline std::filesystem::path dataDir() {
    if (const char* dir = std::getenv("SVT_DATA_DIR")) return dir;
    return std::filesystem::path(kSourceRoot) / "../shared/data";
}

}  // namespace svt::test

/// Skips the test if `file` is missing in the data directory; else declares `variable`.
#define SVT_NEEDS_DATA(variable, file)                                      \
    const std::filesystem::path variable = ::svt::test::dataDir() / (file); \
    if (!std::filesystem::exists(variable)) GTEST_SKIP() << variable << " is absent; set SVT_DATA_DIR to run this test"
