#pragma once
/// \file
/// What this program was built from and for.

#include <string>
#include <string_view>

namespace svt::cli {

/// "0.1.0".
[[nodiscard]] std::string_view versionNumber() noexcept;

/// The rest of what can be told of a build.
struct BuildFacts {
    std::string_view commit;   ///< "3cedf5d2a1b0", with "-dirty" where files were changed; "unknown" without Git
    std::string compiler;      ///< "GCC 12.2.0"
    std::string_view kind;     ///< "Release"
    std::string_view openGl;   ///< "OpenGL ES 3.0 by EGL", "none"
    bool isOptimized = false;  ///< by the compiler
};
[[nodiscard]] BuildFacts buildFacts();

/// What `svt --version` prints: version, commit, compiler, SIMD instruction set, OpenGL.
[[nodiscard]] std::string versionText();

/// The version of this program as plans of cities name it.
[[nodiscard]] std::string programOfCity();

}  // namespace svt::cli
