#pragma once
/// \file
/// A label volume of another format while it is read: the content of its header, and its samples as a stream.

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

/// A label that the format itself describes, such as a segment of 3D Slicer.
struct ToldLabel {
    std::uint32_t first = 0, count = 1;  ///< values
    std::string id, className, name, parent;
    bool hasColor = false;
    Vec3f color{};
};

/// Fills the span with the next bytes of the samples. With an empty span, after the last sample, it checks that the
/// samples end there, undamaged.
using ReadSamples = std::function<Result<void>(std::span<std::byte>)>;

/// Samples of other kinds. They are labels if they are whole numbers from 0 to 2^32 - 1; many programs save labels like
/// this.
enum class OtherKind : std::uint8_t { None, Float32, Float64, Int64, UInt64 };

struct LabelImage {
    Vec3i dimension{};
    int bits = 0;  ///< 8, 16 or 32; 32 for other kinds
    OtherKind other = OtherKind::None;
    bool isSigned = false;   ///< negative values are an error
    bool isSwapped = false;  ///< samples have the other byte order than this machine
    Vec3d origin{};          ///< the first sample, metres
    std::array<Vec3d, 3> steps{Vec3d{1, 0, 0}, Vec3d{0, 1, 0},
                               Vec3d{0, 0, 1}};  ///< to the next sample along i, j, k, metres
    std::optional<volume::Grid> grid;            ///< exact, in place of origin and steps
    std::string headerJson, labelsJson;          ///< of `svt convert` in the file, as in a .svt; or empty
    std::string seal;  ///< checksums of both and of the samples (volume::readSeal()), or empty
    std::vector<ToldLabel> told;
    std::string crsName;
    ReadSamples read;
    std::vector<std::string> warnings;  ///< problems that do not prevent reading

    /// Bytes of a slice, in samples of `bits`.
    [[nodiscard]] std::uint64_t sliceBytes() const noexcept {
        return std::uint64_t(dimension.x) * std::uint64_t(dimension.y) * std::uint64_t(bits / 8);
    }
    /// Bytes of a slice, in samples as they are stored.
    [[nodiscard]] std::uint64_t storedSliceBytes() const noexcept {
        return other == OtherKind::None || other == OtherKind::Float32 ? sliceBytes() : 2 * sliceBytes();
    }
};

/// Checks the values of a header before they size an allocation: 2 to 65535 samples along each axis, 8, 16 or 32 bits,
/// and enough stored bytes for the samples.
/// \param storedBytes  of the samples in the file
/// \return nothing, or `code` with the problem
[[nodiscard]] Result<void> checkImage(const LabelImage& image, std::uint64_t storedBytes, bool isCompressed, Code code);

/// Uncompressed samples; bytes after them in `part` are an error.
[[nodiscard]] ReadSamples plainSamples(SharedFile file, FilePart part, Code code);
/// Samples in consecutive gzip members.
[[nodiscard]] ReadSamples gzipSamples(SharedFile file, FilePart part, Code code);
/// A block of samples, compressed separately by zlib, or raw.
struct ZlibBlock {
    FilePart stored;
    std::uint64_t size = 0;  ///< unpacked
};
[[nodiscard]] ReadSamples zlibSamples(SharedFile file, std::vector<ZlibBlock> blocks, bool isCompressed, Code code);

/// Reads all samples into columns, whose scalars are the values. Memory: the runs and two slices.
/// \param maxBytes  of memory
/// \return the columns, or InputTooBig, Cancelled, `code` for values that cannot be labels (negative, not whole, too
///         large), or an error of LabelImage::read
[[nodiscard]] Result<volume::ColumnVolume> readColumns(const LabelImage& image, std::uint64_t maxBytes, Code code,
                                                       const Progress* progress);

}  // namespace svt::volume_readers
