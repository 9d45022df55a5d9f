#pragma once
/// \file
/// The parts of the benchmark. Each appends rows to the report and reports progress on stderr.

#include <bench/report.hpp>
#include <bench/workload.hpp>
#include <svt/core/result.hpp>

#include <filesystem>
#include <span>

namespace svt::bench {

struct BenchOptions {
    bool isQuick = false;            ///< only the small grid, fewer runs
    std::filesystem::path scratch;   ///< a folder for temporary files
    std::filesystem::path pictures;  ///< a folder for the compared pictures; empty: not written
    MeasureOptions measure;
};

/// Reads CityGML into the tree, compared with libcitygml; MB/s.
[[nodiscard]] Result<void> benchRead(const BenchOptions& options, Report& report);
/// From meshes in memory to the canonical volume, compared with VTK and OpenVDB; labels are compared voxel by voxel.
[[nodiscard]] Result<void> benchVoxelize(const Workload& workload, const BenchOptions& options, Report& report);
/// Frames, compared with VTK's volume mappers; labels are compared pixel by pixel.
[[nodiscard]] Result<void> benchRender(const Workload& workload, const BenchOptions& options, Report& report);
/// Every stage from the file to the finished volume: time, memory, size.
[[nodiscard]] Result<void> benchStages(const Input& input, const Workload& workload, const BenchOptions& options,
                                       Report& report);

/// A house, also rotated, at increasing resolutions: time, memory, and the size of a dense volume.
[[nodiscard]] Result<void> benchScaling(const Workload& workload, const BenchOptions& options, Report& report);
/// Many houses in one volume at 0.05 m, from the file to a frame.
[[nodiscard]] Result<void> benchDistrict(const BenchOptions& options, Report& report);

/// Work to run under a profiler: one thread, a fixed input, one piece of work after common preparation.
enum class ProfilePiece : std::uint8_t {
    Count,    ///< runs nothing; prints as JSON the number of crossings and rays of the others
    Prepare,  ///< preparation only, to be subtracted from the others
    Voxelize,
    Opaque,
    Translucent
};
[[nodiscard]] Result<void> runProfilePiece(ProfilePiece piece, const Input& input);

/// "svt_bench: <text>" on stderr.
void tell(const std::string& text);

}  // namespace svt::bench
