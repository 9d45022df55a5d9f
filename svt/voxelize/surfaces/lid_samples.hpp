#pragma once
/// \file
/// Winding numbers of lids at the samples of a small block. SIMD by Google Highway: each lane is a sample, so that all
/// instruction sets do the same arithmetic in the same order.

#include <svt/voxelize/surfaces/lid_field.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace svt::voxelize {

/// Maximum number of samples; a multiple of the widest vector.
inline constexpr std::size_t kLidSamples = 64;

/// Error bound, in full turns, of the polynomial for the arc tangent in windingsAt().
inline constexpr double kArcError = 3e-6;

/// Positions relative to a centre. Entries beyond `count` up to the next multiple of 8 must be finite.
struct LidSamples {
    double x[kLidSamples], y[kLidSamples], z[kLidSamples];
    std::size_t count = 0;
};

/// Winding numbers of a set of pieces plus a polynomial about `center`.
/// \param windings  receives kLidSamples numbers, the first samples.count are valid, with an error of kArcError
void windingsAt(const LidField& field, std::span<const std::uint32_t> set, const Jet& far, Vec3d center,
                const LidSamples& samples, double* windings);

}  // namespace svt::voxelize
