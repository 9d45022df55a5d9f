#include <apps/cli/output/version.hpp>

#include <svt/core/simd_targets.hpp>

#include <fmt/format.h>

// SVT_VERSION, SVT_COMMIT: written by the build, see cmake/Version.cmake.
#include <svt_version.hpp>

namespace svt::cli {

std::string_view versionNumber() noexcept { return SVT_VERSION; }

BuildFacts buildFacts() {
    BuildFacts facts;
    facts.commit = SVT_COMMIT;
    facts.kind = SVT_BUILD_TYPE;
#if defined(__clang__)
    facts.compiler = fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    facts.compiler = fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    facts.compiler = "an unknown compiler";
#endif
#ifdef __EMSCRIPTEN__
    facts.openGl = "none";
#else
    facts.openGl = "OpenGL ES 3.0 by EGL";
#endif
#ifdef __OPTIMIZE__
    facts.isOptimized = true;
#endif
    return facts;
}

std::string versionText() {
    const BuildFacts facts = buildFacts();
    return fmt::format("svt {}\ncommit    {}\ncompiler  {}, {}\nSIMD      {}\nOpenGL    {}", SVT_VERSION, facts.commit,
                       facts.compiler, facts.kind, simdTargetName(), facts.openGl);
}

std::string programOfCity() { return fmt::format("{} {}", versionNumber(), buildFacts().commit); }

}  // namespace svt::cli
