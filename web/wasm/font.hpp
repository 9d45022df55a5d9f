#pragma once
/// \file
/// The font of names in pictures. Elsewhere it is built into the library; here, three quarters of a megabyte that most
/// pages never need, the page brings it when names are drawn.

#include <svt/core/result.hpp>

#include <cstddef>
#include <span>

namespace svt::web {

/// \param file  DejaVuSans.ttf as it was when the module was built \return BadArgument where it has another size
[[nodiscard]] Result<void> setFont(std::span<const std::byte> file);
[[nodiscard]] bool hasFont() noexcept;

}  // namespace svt::web
