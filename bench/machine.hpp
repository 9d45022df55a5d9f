#pragma once
/// \file
/// What the figures were taken on. No host name, no path.

#include <nlohmann/json.hpp>

namespace svt::bench {

/// cores, processor, simd, memory, compiler, build type, load of the last minute when the benchmark began.
[[nodiscard]] nlohmann::ordered_json describeMachine();

}  // namespace svt::bench
