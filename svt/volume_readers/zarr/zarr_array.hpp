#pragma once
/// \file
/// The metadata of a Zarr array (versions 2 and 3): sizes, names and packing of chunks, type of samples.

#include <svt/core/result.hpp>
#include <svt/volume_readers/zarr/chunk_codecs.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace svt::volume_readers {

struct ZarrArray {
    static constexpr std::size_t kMostAxes = 5;

    std::vector<std::uint64_t> shape;  ///< three to five axes; all but the last three have one sample
    std::vector<std::uint64_t> file;   ///< samples per file along each axis: a chunk, or a shard of chunks
    std::vector<std::uint64_t> chunk;
    std::vector<std::size_t> order;  ///< stored axis a is axis order[a] of the array; the last one is fastest
    int itemBytes = 0;               ///< 1, 2, 4 or 8
    bool isSigned = false, isBigEndian = false;
    std::uint64_t fill = 0;         ///< bits of a sample if its chunk is missing
    std::string prefix;             ///< of file names, such as "c/"
    char separator = '/';           ///< between the numbers in file names
    std::vector<CodecKind> codecs;  ///< of a chunk, in the order of packing
    bool isSharded = false, isIndexAtEnd = true, isIndexBigEndian = false;
    std::vector<CodecKind> indexCodecs;

    [[nodiscard]] std::uint64_t chunkBytes() const noexcept;
    /// Number of chunks per file, over all axes.
    [[nodiscard]] std::uint64_t chunksOfFile() const noexcept;
};

/// Reads `.zarray`, or `zarr.json` of an array; all sizes are checked.
/// \return the array, or BadImage with the problem
[[nodiscard]] Result<ZarrArray> readZarrArray(const nlohmann::ordered_json& json);

/// The finest level of a group (OME-NGFF 0.1 to 0.5), from its metadata.
struct ZarrScale {
    std::string path;                                            ///< of the array in the group
    std::array<double, 3> scale{1, 1, 1}, translation{0, 0, 0};  ///< x, y, z, metres
    nlohmann::ordered_json colors, properties;                   ///< of image-label; may be null
};

/// \param attributes  of the group; in version 3 with OME's metadata in `ome`
/// \return the scale, or BadImage: no multiscales in it, axes in another order, an unknown unit, a path that leads out
///         of the folder
[[nodiscard]] Result<ZarrScale> readZarrScale(const nlohmann::ordered_json& attributes);

/// Whether a path in metadata stays in its folder: names with '/' between them, without "." and "..".
[[nodiscard]] bool isPathInside(std::string_view path) noexcept;

}  // namespace svt::volume_readers
