#pragma once
/// \file
/// The font for names in pictures. Other builds embed it in the library. Here, the page loads its 750 KB only if names
/// are drawn, because most pages never need it.

#include <svt/core/result.hpp>

#include <cstddef>
#include <span>

namespace svt::web {

/// \param file  DejaVuSans.ttf, the same file as at the build of the module
/// \return BadArgument if its size differs
[[nodiscard]] Result<void> setFont(std::span<const std::byte> file);
[[nodiscard]] bool hasFont() noexcept;

}  // namespace svt::web
