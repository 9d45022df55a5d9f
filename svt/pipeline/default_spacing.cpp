#include <svt/pipeline/default_spacing.hpp>

#include <svt/core/machine.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::pipeline {
namespace {

// Maximum bytes per voxel on surfaces for building and drawing: 2 if solids are large, 9 if all walls and roofs are
// sheets as well (100 buildings of LoD2, 230 MB for 25 million voxels on surfaces).
constexpr double kBytesPerSurfaceVoxel = 10;
constexpr double kBytesPerColumn = 2;  // numbers of columns in rows that differ
constexpr double kBytesPerBrick = 4;   // index of bricks

// Spacing number n of 1, 2, 5, 10, 20, 50, ... mm. The quotient of whole numbers is the nearest double, as a user who
// types it gets.
double spacingOf(int n) noexcept {
    constexpr double kSteps[] = {1, 2, 5};
    double millimetres = kSteps[n % 3];
    for (int decade = 0; decade < n / 3; ++decade) millimetres *= 10;
    return millimetres / 1000;
}
constexpr int kUsualStep = 5;  // 50 mm

// The limit that a grid exceeds, as text; empty: none.
std::string excessOf(const GridForecast& forecast, std::uint64_t memoryBytes) {
    if (forecast.largestDimension > volume::Grid::kMaxDimension)
        return fmt::format("have {:.0f} samples along its longest side (at most {})", forecast.largestDimension,
                           volume::Grid::kMaxDimension);
    if (forecast.surfaceVoxels > SpacingChoice::kMostSurfaceVoxels)
        return fmt::format("have {:.0f} million voxels on surfaces (limit for default spacings: {:.0f})",
                           forecast.surfaceVoxels / 1e6, SpacingChoice::kMostSurfaceVoxels / 1e6);
    if (forecast.columns > SpacingChoice::kMostColumns)
        return fmt::format("have {:.0f} million columns (limit for default spacings: {:.0f})", forecast.columns / 1e6,
                           SpacingChoice::kMostColumns / 1e6);
    if (forecast.bytes > double(memoryBytes))
        return fmt::format("take about {} of memory (limit for default spacings: {})",
                           bytesText(static_cast<std::uint64_t>(std::min(forecast.bytes, 1e18))),
                           bytesText(memoryBytes));
    return {};
}

}  // namespace

GridForecast forecastGrid(Vec3d size, double area, double spacing) noexcept {
    const Vec3d samples{size.x / spacing + 2, size.y / spacing + 2, size.z / spacing + 2};
    constexpr double kBrick =
        volume::BrickVolume::kBrickSize * volume::BrickVolume::kBrickSize * volume::BrickVolume::kBrickSize;
    GridForecast forecast;
    forecast.largestDimension = std::max({samples.x, samples.y, samples.z});
    forecast.columns = samples.x * samples.y;
    forecast.surfaceVoxels = area / (spacing * spacing);
    forecast.bytes = kBytesPerSurfaceVoxel * forecast.surfaceVoxels + kBytesPerColumn * forecast.columns +
                     kBytesPerBrick * forecast.columns * samples.z / kBrick;
    return forecast;
}

SpacingChoice chooseSpacing(Vec3d size, double area, std::uint64_t memoryBytes) {
    constexpr int kLast = 60;  // beyond the size of the earth: any finite model is under the limits before
    const double longest = std::max({size.x, size.y, size.z});
    int step = kUsualStep;
    while (step > 0 && longest / spacingOf(step) < SpacingChoice::kFewestSamples) --step;
    SpacingChoice choice;
    choice.spacing = spacingOf(step);
    choice.forecast = forecastGrid(size, area, choice.spacing);
    if (step == kUsualStep)
        choice.reason = fmt::format("the usual {} m", choice.spacing);
    else
        choice.reason =
            fmt::format("{} m, because at {} m the longest side would have {:.0f} samples", choice.spacing,
                        SpacingChoice::kUsual, forecastGrid(size, area, SpacingChoice::kUsual).largestDimension);
    for (; step < kLast; ++step) {
        const std::string excess = excessOf(choice.forecast, memoryBytes);
        if (excess.empty()) break;
        const double finer = choice.spacing;
        choice.spacing = spacingOf(step + 1);
        choice.forecast = forecastGrid(size, area, choice.spacing);
        choice.reason = fmt::format("{} m, because at {} m it would {}", choice.spacing, finer, excess);
    }
    return choice;
}

}  // namespace svt::pipeline
