#pragma once
/// \file
/// Version and build of this program.

#include <string>
#include <string_view>

namespace svt::cli {

/// "0.1.0".
[[nodiscard]] std::string_view versionNumber() noexcept;

/// Facts about a build, besides its version.
struct BuildFacts {
    std::string_view commit;   ///< "3cedf5d2a1b0", with "-dirty" if files were changed; "unknown" without Git
    std::string compiler;      ///< "GCC 12.2.0"
    std::string_view kind;     ///< "Release"
    std::string_view openGl;   ///< "OpenGL ES 3.0 by EGL", "none"
    bool isOptimized = false;  ///< by the compiler
};
[[nodiscard]] BuildFacts buildFacts();

/// The text of `svt --version`: version, commit, compiler, SIMD instruction set, OpenGL.
[[nodiscard]] std::string versionText();

/// Version, build, versions of file formats, libraries and compiled parts as JSON; docs/user/json.md lists the keys.
[[nodiscard]] std::string versionJson();

/// The version of this program in the form that plans of cities use.
[[nodiscard]] std::string programOfCity();

}  // namespace svt::cli
