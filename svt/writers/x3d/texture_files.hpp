#pragma once
/// \file
/// The three ways in which X3D, and the CityGML extension based on it, store a 3D texture. The samples are numbers in
/// the document, one file beside it, or one picture per slice beside it.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::writers {

/// "house" of "a/house.x3d" and of "a/house.ade.gml".
[[nodiscard]] std::string stemOf(const std::filesystem::path& document);

/// Rejects more samples than a document should contain.
/// \return success, or BadArgument that suggests a level or a kind of texture
[[nodiscard]] Result<void> checkPixelCount(Vec3i dimension, std::uint64_t maxVoxels);

/// Refuses to overwrite a file beside a document that begins with other bytes.
/// \param begin  first bytes of a file that may be replaced
/// \return nothing, or WouldDestroy
[[nodiscard]] Result<void> checkSibling(const std::filesystem::path& file, std::string_view begin);

/// Appends the samples as decimal numbers, x fastest, with a blank before each and a line per row.
/// \param codeOf  the number to write for each scalar; empty: the scalar
[[nodiscard]] Result<void> writePixelNumbers(const volume::SemanticVolume& volume, int bits,
                                             const std::vector<std::uint32_t>& codeOf, const StreamOptions& options,
                                             AtomicFile& file);

/// The encoding of a slice as a picture.
enum class SliceKind : std::uint8_t {
    Colors,  ///< opaque, 0xRRGGBB of the code of the scalar
    Gray16   ///< one channel of 16 bits
};

/// Writes one PNG per slice k, `<stem>_slices/0000.png` and so on, top row j = ny - 1, because X3D counts rows from
/// below.
/// \param codeOf  for colours: the code of each scalar
/// \return the files relative to the document with '/', in order of k; or CannotWrite, DiskFull, WouldDestroy,
///         BadArgument if scalars do not fit into the pictures, Cancelled
[[nodiscard]] Result<std::vector<std::string>> writeSlices(const volume::SemanticVolume& volume, int bits,
                                                           SliceKind kind, const std::vector<std::uint32_t>& codeOf,
                                                           const std::filesystem::path& document,
                                                           const StreamOptions& options);

/// All slices in one picture for X3DOM's ImageTextureAtlas: slice 0 in the upper left corner, row j = 0 of each slice
/// on top.
struct SliceAtlas {
    std::string file;                  ///< beside the document
    std::int32_t along = 0, rows = 0;  ///< slices from left to right, and from top to bottom

    static constexpr std::int32_t kMaxSide = 8192;  ///< pixels; limit of browsers
};

/// Writes `<stem>.atlas.png`. Memory: the picture, 4 bytes per sample.
/// \param lookOf  per scalar, 0xRRGGBBAA; 0: background
/// \return the atlas, or BadArgument if it would be larger than kMaxSide, CannotWrite, DiskFull, WouldDestroy,
///         Cancelled
[[nodiscard]] Result<SliceAtlas> writeAtlas(const volume::SemanticVolume& volume, int bits,
                                            const std::vector<std::uint32_t>& lookOf,
                                            const std::filesystem::path& document, const StreamOptions& options);

}  // namespace svt::writers
