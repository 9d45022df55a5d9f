#pragma once
/// \file
/// The default distance of samples: 5 cm, or coarser if the volume would take too much memory or time, or finer if the
/// model is small. It depends only on the model and on the given memory limit, so the same model gets the same grid on
/// every machine.

#include <svt/core/vec.hpp>

#include <cstdint>
#include <string>

namespace svt::pipeline {

/// The estimated size of a volume, computed only from the sizes of the model.
struct GridForecast {
    double largestDimension = 0;  ///< samples along the longest side
    double columns = 0;
    double surfaceVoxels = 0;  ///< area of all faces / spacing^2; work and files are proportional to it
    double bytes = 0;          ///< memory for building and for drawing
};

/// \param size     of the envelope, metres
/// \param area     of all faces, m2
/// \param spacing  metres, > 0
[[nodiscard]] GridForecast forecastGrid(Vec3d size, double area, double spacing) noexcept;

/// A chosen spacing and the reason for it.
struct SpacingChoice {
    static constexpr double kUsual = 0.05;                        ///< metres
    static constexpr double kFinest = 0.001;                      ///< metres
    static constexpr double kFewestSamples = 100;                 ///< along the longest side, if kFinest allows it
    static constexpr double kMostSurfaceVoxels = 80e6;            ///< some seconds of work
    static constexpr double kMostColumns = 60e6;                  ///< the same
    static constexpr std::uint64_t kMemoryBytes = 1'000'000'000;  ///< default limit

    double spacing = 0;  ///< metres
    GridForecast forecast;
    std::string reason;  ///< "the usual 0.05 m", "0.1 m, because at 0.05 m it would take ..."
};

/// The coarsest of ..., 0.01, 0.02, 0.05 m at which the longest side has kFewestSamples. If that spacing exceeds a
/// limit, the next coarser one of ..., 0.1, 0.2, 0.5, 1, ... m that does not.
/// \param memoryBytes  limit; below kMemoryBytes if the caller grants less
[[nodiscard]] SpacingChoice chooseSpacing(Vec3d size, double area, std::uint64_t memoryBytes);

}  // namespace svt::pipeline
