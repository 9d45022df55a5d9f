#pragma once
/// \file
/// A label volume of another format while it is read: what its header says, and its samples as a stream.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume_readers/samples/label_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::volume_readers {

/// A label that a format tells of itself, such as a segment of 3D Slicer.
struct ToldLabel {
    std::uint32_t first = 0, count = 1;  ///< values
    std::string id, className, name, parent;
    bool hasColor = false;
    Vec3f color{};
};

/// Takes the next bytes of the samples, exactly as many as there is room for. Without room, behind the last sample, it tells
/// whether the samples end there, undamaged.
using ReadSamples = std::function<Result<void>(std::span<std::byte>)>;

/// Samples of other kinds, which are labels where they are whole numbers from 0 to 2^32 - 1: many programs save so.
enum class OtherKind : std::uint8_t { None, Float32, Float64, Int64, UInt64 };

struct LabelImage {
    Vec3i dimension{};
    int bits = 0;  ///< 8, 16 or 32; 32 for other kinds
    OtherKind other = OtherKind::None;
    bool isSigned = false;   ///< values must not be negative even so
    bool isSwapped = false;  ///< samples have the other byte order than this machine
    Vec3d origin{};          ///< the first sample, metres
    std::array<Vec3d, 3> steps{Vec3d{1, 0, 0}, Vec3d{0, 1, 0},
                               Vec3d{0, 0, 1}};  ///< to the next sample along i, j, k, metres
    std::optional<volume::Grid> grid;            ///< exact, in place of origin and steps
    std::string headerJson, labelsJson;          ///< what `svt convert` left in the file, as in a .svt; empty: nothing
    std::string seal;  ///< checksums of both and of the samples (volume::readSeal()), or empty
    std::vector<ToldLabel> told;
    std::string crsName;
    ReadSamples read;
    std::vector<std::string> warnings;  ///< what is odd, but keeps nothing from being read

    /// Of samples of 8, 16 or 32 bits.
    [[nodiscard]] std::uint64_t sliceBytes() const noexcept {
        return std::uint64_t(dimension.x) * std::uint64_t(dimension.y) * std::uint64_t(bits / 8);
    }
    /// Of samples as they are stored.
    [[nodiscard]] std::uint64_t storedSliceBytes() const noexcept {
        return other == OtherKind::None || other == OtherKind::Float32 ? sliceBytes() : 2 * sliceBytes();
    }
};

/// Checks what a header says before anything is allocated by it: 1 to 65535 samples along each axis (a grid has two at
/// least), 8, 16 or 32 bits, and compressed samples that can be as many as that.
/// \param storedBytes  of the samples in the file
/// \return nothing, or `code` with what was found
[[nodiscard]] Result<void> checkImage(const LabelImage& image, std::uint64_t storedBytes, bool isCompressed, Code code);

/// Samples that stand in the file as they are, and nothing behind them in `part`.
[[nodiscard]] ReadSamples plainSamples(SharedFile file, FilePart part, Code code);
/// Samples in gzip members, one behind the other.
[[nodiscard]] ReadSamples gzipSamples(SharedFile file, FilePart part, Code code);
/// Samples in blocks of zlib, each for itself.
struct ZlibBlock {
    FilePart stored;
    std::uint64_t size = 0;  ///< unpacked
};
[[nodiscard]] ReadSamples zlibSamples(SharedFile file, std::vector<ZlibBlock> blocks, bool isCompressed, Code code);

/// Reads all samples into columns, whose scalars are the values. Memory: the runs and two slices.
/// \param maxBytes  of memory
/// \return the columns, or InputTooBig, Cancelled, `code` for values that are no labels (negative, no whole
///         numbers, too large), or an error of LabelImage::read
[[nodiscard]] Result<volume::ColumnVolume> readColumns(const LabelImage& image, std::uint64_t maxBytes, Code code,
                                                       const Progress* progress);

}  // namespace svt::volume_readers
