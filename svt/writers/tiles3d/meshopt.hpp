#pragma once
/// \file
/// Compression of vertices and indices for glTF: EXT_meshopt_compression, version 0 of attributes and version 1 of index
/// sequences. Readers decode it at gigabytes per second; a web server compresses the result further.
///
/// Vertices: each byte of a vertex is a series of differences from vertex to vertex, in groups of 16 with 0, 2, 4 or 8
/// bits each. Indices: differences from one of the last two runs, in bytes of 7 bits.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace svt::writers {

/// \param stride  bytes of a vertex, a multiple of 4, at most 256
/// \param bytes   whole vertices, at least one
/// Cost: O(bytes).
[[nodiscard]] std::string compressVertices(std::span<const std::byte> bytes, std::size_t stride);

/// Indices in any order. Cost: O(indices).
[[nodiscard]] std::string compressIndices(std::span<const std::uint32_t> indices);

}  // namespace svt::writers
