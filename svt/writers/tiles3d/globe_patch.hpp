#pragma once
/// \file
/// Converts places of a projection to the frame of a tileset, with a lattice of exact places on the globe.
///
///     +---+---+---+    corners: projected exactly, with the upward direction there
///     |   | . |   |    between them: linear in plan, and along the upward direction in height
///     +---+---+---+    cells of 256 m miss the globe by 1 mm
///
/// A single plane would miss it by 1 m at 4 km, 80 m at 32 km.

#include <svt/core/result.hpp>
#include <svt/crs/globe.hpp>
#include <svt/writers/volume_formats.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {

/// The lattice of a rectangle. Threads: reads only.
class GlobePatch {
public:
    /// Converts from world space to the frame of the tileset. Beyond the rectangle, its outer cells are continued.
    [[nodiscard]] Vec3d place(Vec3d world) const noexcept;

private:
    friend class GlobeLattice;
    struct Corner {
        Vec3d place, up;
    };
    Vec3d first_{};
    double cell_ = 1;
    std::int64_t columns_ = 0;  // corners along x; 0: the frame is that of the world, moved
    std::vector<Corner> corners_;
};

/// Exact places, each computed once.
class GlobeLattice {
public:
    /// \param reference  world space; the origin of the frame
    /// \return CannotProject, BadArgument: like frameOfVolume()
    [[nodiscard]] static Result<std::unique_ptr<GlobeLattice>> create(const std::string& crsName, Vec3d reference,
                                                                      const VolumeWriteOptions& options);

    [[nodiscard]] const crs::GlobeFrame& frame() const noexcept { return frame_; }
    /// \param rectangle  west, south, east, north
    /// \return the patch, or CannotProject. Threads: any
    [[nodiscard]] Result<GlobePatch> patch(std::array<double, 4> rectangle);

private:
    Result<GlobePatch::Corner> cornerAt(std::int64_t i, std::int64_t j);

    crs::GlobeFrame frame_;
    std::array<Vec3d, 3> inverse_;  // rows
    Vec3d reference_{};
    double lift_ = 0;
    int epsg_ = 0;  // 0: a place was given, the frame is a plane
    std::mutex mutex_;
    std::map<std::pair<std::int64_t, std::int64_t>, GlobePatch::Corner> corners_;
};

}  // namespace svt::writers
