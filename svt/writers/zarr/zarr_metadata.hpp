#pragma once
/// \file
/// The JSON of a Zarr folder, see zarr_writer.cpp.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace svt::writers {

/// Samples along each axis of a chunk, and of a file.
struct ZarrShape {
    std::int32_t chunk = 0;
    std::int32_t file = 0;
};
[[nodiscard]] ZarrShape zarrShape(int version) noexcept;

/// The metadata of the group: `.zattrs`, or `zarr.json`. \param levels from the volume itself
[[nodiscard]] std::string zarrGroupJson(const volume::SemanticVolume& volume, std::span<const volume::Grid> levels,
                                        int version);
/// The metadata of an array: `.zarray`, or `zarr.json`.
[[nodiscard]] std::string zarrArrayJson(const volume::Grid& grid, int bits, int version);

}  // namespace svt::writers
