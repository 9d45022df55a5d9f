#pragma once
/// \file
/// The font for names in pictures. Other builds embed it in the library; here the page loads its 750 KB only when names
/// are drawn, since most pages never need it.

#include <svt/core/result.hpp>

#include <cstddef>
#include <span>

namespace svt::web {

/// \param file  DejaVuSans.ttf, the same as when the module was built
/// \return BadArgument if its size differs
[[nodiscard]] Result<void> setFont(std::span<const std::byte> file);
[[nodiscard]] bool hasFont() noexcept;

}  // namespace svt::web
