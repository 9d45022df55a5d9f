#pragma once
/// \file
/// What the figures were taken on. No host name, no path.

#include <nlohmann/json.hpp>

#include <cstdint>

namespace svt::bench {

/// cores, processor, simd, memory, compiler, build type.
[[nodiscard]] nlohmann::ordered_json describeMachine();

/// Bytes that a program may still take without swapping; 0 where the system does not tell.
[[nodiscard]] std::uint64_t availableMemory();

}  // namespace svt::bench
