#pragma once
/// \file
/// Chunks of a level for neuroglancer in shards (neuroglancer_uint64_sharded_v1): a file contains up to 64 chunks that
/// are near each other, with an index of eight minishards. So a large volume needs only some files instead of one per
/// chunk. A chunk is identified by its compressed Morton code: alternating bits of x, y and z, as many per axis as its
/// number of chunks needs.

#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <string>

namespace svt::writers {

/// The division of the bits of a chunk's code.
struct ShardBits {
    int chunk = 0, minishard = 0, shard = 0;
    [[nodiscard]] static ShardBits of(Vec3i chunks);
};

/// The compressed Morton code of a chunk in a grid of `chunks`.
[[nodiscard]] std::uint64_t mortonCode(Vec3i place, Vec3i chunks) noexcept;

/// Writes the shards of a level as `<key>/<number>.shard`, chunks of `side` samples in compressed_segmentation, chunks
/// and indices packed by gzip. Memory: the chunks of a shard.
/// \return nothing, or CannotWrite, DiskFull, Cancelled
[[nodiscard]] Result<void> writeShards(const volume::ColumnVolume& columns, std::int32_t side, const std::string& key,
                                       const VolumeWriteOptions& options, NewFolder& folder);

}  // namespace svt::writers
