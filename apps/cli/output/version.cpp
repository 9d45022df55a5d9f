#include <apps/cli/output/version.hpp>

#include <svt/core/simd_targets.hpp>

#include <fmt/format.h>

// SVT_VERSION, SVT_COMMIT: written by the build, see cmake/Version.cmake.
#include <svt_version.hpp>

namespace svt::cli {

std::string_view versionNumber() noexcept { return SVT_VERSION; }

std::string versionText() {
#if defined(__clang__)
    const std::string compiler = fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    const std::string compiler = fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    const std::string compiler = "an unknown compiler";
#endif
#ifdef __EMSCRIPTEN__
    constexpr std::string_view kOpenGl = "none";
#else
    constexpr std::string_view kOpenGl = "OpenGL ES 3.0 by EGL";
#endif
    return fmt::format("svt {}\ncommit    {}\ncompiler  {}, {}\nSIMD      {}\nOpenGL    {}", SVT_VERSION, SVT_COMMIT,
                       compiler, SVT_BUILD_TYPE, simdTargetName(), kOpenGl);
}

}  // namespace svt::cli
