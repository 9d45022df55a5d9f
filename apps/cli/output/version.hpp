#pragma once
/// \file
/// What this program was built from and for.

#include <string>
#include <string_view>

namespace svt::cli {

/// "0.1.0".
[[nodiscard]] std::string_view versionNumber() noexcept;

/// What `svt --version` prints: version, commit, compiler, SIMD instruction set, OpenGL.
[[nodiscard]] std::string versionText();

}  // namespace svt::cli
