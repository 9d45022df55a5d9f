#pragma once
/// \file
/// The three ways in which X3D, and the CityGML extension after it, store a 3D texture: as numbers in the document, as one
/// file of all samples beside it, and as one picture per slice beside it.

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

/// Refuses more samples than a document should hold.
/// \return nothing, or BadArgument that tells the level or the kind of texture that would do
[[nodiscard]] Result<void> checkPixelCount(Vec3i dimension, std::uint64_t maxVoxels);

/// Refuses to write beside a document over what is something else: a file that begins otherwise.
/// \param begin  how a file begins that may be replaced
/// \return nothing, or WouldDestroy
[[nodiscard]] Result<void> checkSibling(const std::filesystem::path& file, std::string_view begin);

/// Appends the samples as decimal numbers, x fastest, with a blank before each and a line per row.
/// \param codeOf  the number that is written for a scalar; empty: the scalar
[[nodiscard]] Result<void> writePixelNumbers(const volume::SemanticVolume& volume, int bits,
                                             const std::vector<std::uint32_t>& codeOf, const StreamOptions& options,
                                             AtomicFile& file);

/// How a slice is a picture.
enum class SliceKind : std::uint8_t {
    Colors,  ///< opaque, 0xRRGGBB of the code of the scalar
    Gray16   ///< one channel of 16 bits
};

/// Writes one PNG per slice k, `<stem>_slices/0000.png` and so on, top row j = ny - 1, since X3D counts rows from below.
/// \param codeOf  of colours: the code of each scalar
/// \return the files relative to the document with '/', in order of k; or CannotWrite, DiskFull, WouldDestroy,
///         BadArgument if scalars do not fit into the pictures, Cancelled
[[nodiscard]] Result<std::vector<std::string>> writeSlices(const volume::SemanticVolume& volume, int bits,
                                                           SliceKind kind, const std::vector<std::uint32_t>& codeOf,
                                                           const std::filesystem::path& document,
                                                           const StreamOptions& options);

/// All slices in one picture, as X3DOM's ImageTextureAtlas has them: slice 0 in the corner above left, row j = 0 of each on top.
struct SliceAtlas {
    std::string file;                  ///< beside the document
    std::int32_t along = 0, rows = 0;  ///< slices from left to right, and from top to bottom

    static constexpr std::int32_t kMaxSide = 8192;  ///< pixels, that browsers hold
};

/// Writes `<stem>.atlas.png`. Memory: the picture, 4 bytes a sample.
/// \param lookOf  of each scalar, 0xRRGGBBAA; 0: background
/// \return the atlas, or BadArgument if it would be larger than kMaxSide, CannotWrite, DiskFull, WouldDestroy, Cancelled
[[nodiscard]] Result<SliceAtlas> writeAtlas(const volume::SemanticVolume& volume, int bits,
                                            const std::vector<std::uint32_t>& lookOf,
                                            const std::filesystem::path& document, const StreamOptions& options);

}  // namespace svt::writers
