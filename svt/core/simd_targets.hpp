#pragma once
/// \file
/// The instruction sets that SIMD kernels are compiled for. Include this header before Highway.
///
/// x86-64: AVX-512 (AVX3), AVX2, SSE4 and the baseline; the best set that the machine supports is chosen at run time.
/// SSSE3 adds nothing to the baseline for our kernels. Other architectures: only the baseline, which includes NEON and
/// WebAssembly SIMD.

#if defined(__x86_64__) || defined(_M_X64)
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#elif !defined(HWY_COMPILE_ONLY_EMU128)
#define HWY_COMPILE_ONLY_STATIC
#endif

#include <string_view>
#include <vector>

namespace svt {

/// Name of the instruction set that kernels use on this machine: "AVX3" (AVX-512), "AVX2", "SSE4", "EMU128" (portable).
[[nodiscard]] std::string_view simdTargetName() noexcept;

/// Names of the instruction sets that kernels are compiled for, the best first.
[[nodiscard]] std::vector<std::string_view> compiledSimdTargets();

}  // namespace svt
