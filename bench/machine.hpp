#pragma once
/// \file
/// Describes the machine of the measurements. No host name, no path.

#include <nlohmann/json.hpp>

#include <cstdint>

namespace svt::bench {

/// cores, processor, simd, memory, compiler, build type.
[[nodiscard]] nlohmann::ordered_json describeMachine();

/// Memory in bytes available without swapping; 0 if unknown.
[[nodiscard]] std::uint64_t availableMemory();

}  // namespace svt::bench
