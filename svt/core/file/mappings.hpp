#pragma once
/// \file
/// The ranges of memory that files are mapped to, so that no other memory is ever taken for one.

#include <cstddef>
#include <span>

namespace svt {

void rememberMapping(std::span<const std::byte> bytes);
void forgetMapping(std::span<const std::byte> bytes) noexcept;

}  // namespace svt
