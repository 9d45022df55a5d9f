#pragma once
/// \file
/// The default distance of samples: 5 cm, or coarser if the volume would take too much memory or time, or finer if the
/// model is small. It depends only on the model and on the given memory limit, so the same model gets the same grid on
/// every machine.

#include <svt/core/vec.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::pipeline {

/// The estimated size of a volume, computed only from the sizes of the model.
struct GridForecast {
    double largestDimension = 0;  ///< samples along the longest side
    double columns = 0;
    double usedColumns = 0;    ///< columns over or below an object; the others cost almost nothing
    double surfaceVoxels = 0;  ///< area of all faces / spacing^2; work and files are proportional to it
    double bytes = 0;          ///< memory for building and for drawing
};

/// \param size     of the envelope, metres
/// \param area     of all faces, m2
/// \param spacing  metres, > 0
/// \param share    0..1: part of the plan that objects occupy, see occupiedShare()
[[nodiscard]] GridForecast forecastGrid(Vec3d size, double area, double spacing, double share = 1) noexcept;

/// The part of a box that boxes cover in plan: less than 1 % for 50 buildings on 100 km2. Rounded up to cells of
/// 1/512 of the box along x and y.
/// Cost: O(boxes * cells that each covers), at most 2^18 cells.
[[nodiscard]] double occupiedShare(const Box3d& box, std::span<const Box3d> parts);

/// A chosen spacing and the reason for it.
struct SpacingChoice {
    static constexpr double kUsual = 0.05;                        ///< metres
    static constexpr double kFinest = 0.001;                      ///< metres
    static constexpr double kFewestSamples = 100;                 ///< along the longest side, if kFinest allows it
    static constexpr double kMostSurfaceVoxels = 80e6;            ///< some seconds of work
    static constexpr double kMostColumns = 60e6;                  ///< the same, of used columns
    static constexpr double kMostAllColumns = 600e6;              ///< the same, of all columns
    static constexpr std::uint64_t kMemoryBytes = 1'000'000'000;  ///< default limit

    double spacing = 0;  ///< metres
    GridForecast forecast;
    std::string reason;  ///< "the usual 0.05 m", "0.1 m, because at 0.05 m it would take ..."
    /// Objects of the meshes that are far larger than all others together: the grid covers the others and a margin.
    std::vector<std::uint32_t> cutObjects{};
    double spacingOfAll = 0;  ///< metres; the default for a grid that covers these too; 0: there are none
};

/// The coarsest of ..., 0.01, 0.02, 0.05 m at which the longest side has kFewestSamples. If that spacing exceeds a
/// limit, the next coarser one of ..., 0.1, 0.2, 0.5, 1, ... m that does not.
/// \param memoryBytes  limit; below kMemoryBytes if the caller grants less
/// \param share        see forecastGrid(): sparse models get finer spacings
[[nodiscard]] SpacingChoice chooseSpacing(Vec3d size, double area, std::uint64_t memoryBytes, double share = 1);

}  // namespace svt::pipeline
