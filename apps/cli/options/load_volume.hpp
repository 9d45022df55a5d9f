#pragma once
/// \file
/// The input of a command as a volume.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <filesystem>
#include <span>

namespace svt::cli {

/// Loads a volume from a `.svt`, or builds it from a model file.
/// \param grid  the grid of another volume, to build the model on; null: according to the options
[[nodiscard]] Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input,
                                                        const pipeline::BuildOptions& build, const Progress* progress,
                                                        Diagnostics& diagnostics, const volume::Grid* grid = nullptr);
/// The same, and prints the findings. \param isVerbose  prints all of them
[[nodiscard]] Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input,
                                                        const pipeline::BuildOptions& build, const Progress* progress,
                                                        bool isVerbose, const volume::Grid* grid = nullptr);

/// Loads parcels on the grid of a volume: another volume, a model, or polygons of GeoJSON, GeoPackage and shapefiles, which
/// become solids. Prints the findings.
/// \param heights  of these solids: lowest and highest point, metres; empty: they are higher and lower than the grid
/// \return the volume; BadArgument for heights that do not ascend or are given without polygons
[[nodiscard]] Result<volume::SemanticVolume> loadParcels(const std::filesystem::path& input,
                                                         const pipeline::BuildOptions& build, const Progress* progress,
                                                         const volume::SemanticVolume& volume,
                                                         std::span<const double> heights);

}  // namespace svt::cli
