#include <svt/pipeline/default_spacing.hpp>

#include <svt/core/machine.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

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
    if (forecast.usedColumns > SpacingChoice::kMostColumns)
        return fmt::format("have {:.0f} million columns (limit for default spacings: {:.0f})",
                           forecast.usedColumns / 1e6, SpacingChoice::kMostColumns / 1e6);
    if (forecast.columns > SpacingChoice::kMostAllColumns)
        return fmt::format("have {:.0f} million columns, most of them empty (limit for default spacings: {:.0f})",
                           forecast.columns / 1e6, SpacingChoice::kMostAllColumns / 1e6);
    if (forecast.bytes > double(memoryBytes))
        return fmt::format("take about {} of memory (limit for default spacings: {})",
                           bytesText(static_cast<std::uint64_t>(std::min(forecast.bytes, 1e18))),
                           bytesText(memoryBytes));
    return {};
}

}  // namespace

GridForecast forecastGrid(Vec3d size, double area, double spacing, double share) noexcept {
    const Vec3d samples{size.x / spacing + 2, size.y / spacing + 2, size.z / spacing + 2};
    constexpr double kBrick =
        volume::BrickVolume::kBrickSize * volume::BrickVolume::kBrickSize * volume::BrickVolume::kBrickSize;
    GridForecast forecast;
    forecast.largestDimension = std::max({samples.x, samples.y, samples.z});
    forecast.columns = samples.x * samples.y;
    forecast.usedColumns = forecast.columns * share;
    forecast.surfaceVoxels = area / (spacing * spacing);
    forecast.bytes = kBytesPerSurfaceVoxel * forecast.surfaceVoxels + kBytesPerColumn * forecast.usedColumns +
                     kBytesPerBrick * forecast.columns * samples.z / kBrick;
    return forecast;
}

double occupiedShare(const Box3d& box, std::span<const Box3d> parts) {
    constexpr std::int64_t kCells = 512;
    const Vec3d size = box.size();
    if (!(size.x > 0) || !(size.y > 0)) return 1;
    std::vector<char> isUsed(std::size_t{kCells * kCells}, 0);
    const auto cellOf = [&](double place, double low, double extent) {
        const double cell = std::floor((place - low) / extent * double(kCells));
        return static_cast<std::int64_t>(std::clamp(cell, 0.0, double(kCells - 1)));
    };
    std::size_t used = 0;
    for (const Box3d& part : parts) {
        if (part.isEmpty()) continue;
        const std::int64_t west = cellOf(part.min.x, box.min.x, size.x), east = cellOf(part.max.x, box.min.x, size.x);
        const std::int64_t south = cellOf(part.min.y, box.min.y, size.y), north = cellOf(part.max.y, box.min.y, size.y);
        for (std::int64_t y = south; y <= north && used < isUsed.size(); ++y)
            for (std::int64_t x = west; x <= east; ++x) {
                char& cell = isUsed[static_cast<std::size_t>(y * kCells + x)];
                used += cell == 0 ? 1 : 0;
                cell = 1;
            }
    }
    return double(used) / double(isUsed.size());
}

SpacingChoice chooseSpacing(Vec3d size, double area, std::uint64_t memoryBytes, double share) {
    constexpr int kLast = 60;  // beyond the size of the earth: any finite model is under the limits before
    const double longest = std::max({size.x, size.y, size.z});
    int step = kUsualStep;
    while (step > 0 && longest / spacingOf(step) < SpacingChoice::kFewestSamples) --step;
    SpacingChoice choice;
    choice.spacing = spacingOf(step);
    choice.forecast = forecastGrid(size, area, choice.spacing, share);
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
        choice.forecast = forecastGrid(size, area, choice.spacing, share);
        choice.reason = fmt::format("{} m, because at {} m it would {}", choice.spacing, finer, excess);
    }
    return choice;
}

}  // namespace svt::pipeline
