#pragma once
/// \file
/// The parts of the benchmark. Each appends its rows to the report and tells on stderr what it is at.

#include <bench/report.hpp>
#include <bench/workload.hpp>
#include <svt/core/result.hpp>

#include <filesystem>
#include <span>

namespace svt::bench {

struct BenchOptions {
    bool isQuick = false;            ///< the small grid alone, fewer runs
    std::filesystem::path scratch;   ///< a folder for files that the benchmark writes
    std::filesystem::path pictures;  ///< a folder for the pictures that are compared; empty: not written
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

/// A house, and the turned one, at growing resolutions: time and memory, and what a dense volume would take.
[[nodiscard]] Result<void> benchScaling(const Scene& scene, const BenchOptions& options, Report& report);
/// Many houses in one volume at 0.05 m, from the file to a frame.
[[nodiscard]] Result<void> benchDistrict(const BenchOptions& options, Report& report);

/// What runs under a profiler: one thread, a fixed input, one piece of work after the same preparation.
enum class ProfilePiece : std::uint8_t {
    Count,    ///< nothing runs; prints as JSON how many crossings and rays the others have
    Prepare,  ///< the preparation alone, to be taken away from the others
    Voxelize,
    Opaque,
    Translucent
};
[[nodiscard]] Result<void> runProfilePiece(ProfilePiece piece, const Input& input);

/// "svt_bench: <text>" on stderr.
void tell(const std::string& text);

}  // namespace svt::bench
