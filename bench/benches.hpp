#pragma once
/// \file
/// The four parts of the benchmark. Each appends its rows to the report and tells on stderr what it is at.

#include <bench/report.hpp>
#include <bench/workload.hpp>
#include <svt/core/result.hpp>

#include <filesystem>
#include <span>

namespace svt::bench {

struct BenchOptions {
    bool isQuick = false;           ///< the small grid alone, fewer runs
    std::filesystem::path scratch;  ///< a folder for files that the benchmark writes
    MeasureOptions measure;
};

/// CityGML into the tree, beside libcitygml; MB/s.
[[nodiscard]] Result<void> benchRead(const BenchOptions& options, Report& report);
/// Meshes in memory to the canonical volume, beside VTK and OpenVDB, with the labels compared voxel by voxel.
[[nodiscard]] Result<void> benchVoxelize(const Scene& scene, const BenchOptions& options, Report& report);
/// Frames beside VTK's volume mappers, with the labels compared pixel by pixel.
[[nodiscard]] Result<void> benchRender(const Scene& scene, const BenchOptions& options, Report& report);
/// Every stage from the file to the finished volume: time, memory, size.
[[nodiscard]] Result<void> benchStages(const Input& input, const Scene& scene, const BenchOptions& options,
                                       Report& report);

/// "svt_bench: <text>" on stderr.
void tell(const std::string& text);

}  // namespace svt::bench
