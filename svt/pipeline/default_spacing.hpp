#pragma once
/// \file
/// The distance of samples where none was asked for: 5 cm, or coarser where the volume would take too much memory or
/// time, or finer where the model is small. It depends on the model and on the memory that was named alone, so the same
/// model gets the same grid on every machine.

#include <svt/core/vec.hpp>

#include <cstdint>
#include <string>

namespace svt::pipeline {

/// What a volume will take, foretold from sizes alone.
struct GridForecast {
    double largestDimension = 0;  ///< samples along the longest side
    double columns = 0;
    double surfaceVoxels = 0;  ///< area of all faces / spacing^2: what work and files grow with
    double bytes = 0;          ///< of memory, for building and for drawing
};

/// \param size     of the envelope, metres
/// \param area     of all faces, m2
/// \param spacing  metres, > 0
[[nodiscard]] GridForecast forecastGrid(Vec3d size, double area, double spacing) noexcept;

/// A spacing that was chosen, and why.
struct SpacingChoice {
    static constexpr double kUsual = 0.05;                        ///< metres
    static constexpr double kFinest = 0.001;                      ///< metres
    static constexpr double kFewestSamples = 100;                 ///< along the longest side, where kFinest allows it
    static constexpr double kMostSurfaceVoxels = 80e6;            ///< some seconds of work
    static constexpr double kMostColumns = 60e6;                  ///< the same
    static constexpr std::uint64_t kMemoryBytes = 1'000'000'000;  ///< at most taken without being asked

    double spacing = 0;  ///< metres
    GridForecast forecast;
    std::string reason;  ///< "the usual 0.05 m", "0.1 m, since 0.05 m would take ..."
};

/// The coarsest of ..., 0.01, 0.02, 0.05 m by which the longest side gets kFewestSamples; if that is over a limit, the
/// first of 0.1, 0.2, 0.5, 1, ... m which is not.
/// \param memoryBytes  at most; below kMemoryBytes where the caller grants less
[[nodiscard]] SpacingChoice chooseSpacing(Vec3d size, double area, std::uint64_t memoryBytes);

}  // namespace svt::pipeline
