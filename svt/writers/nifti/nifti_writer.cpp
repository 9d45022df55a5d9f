/// \file
/// Writes a semantic volume as NIfTI (.nii, .nii.gz), which nibabel, ITK, 3D Slicer, FSL and SPM read.
///
/// Samples as they are, x fastest, then y, then z; unit metre; the sform matrix leads from index to world space (east
/// is "right", north "anterior", up "superior"). NIfTI-1 where its 16-bit sizes and 32-bit floats say enough, NIfTI-2
/// (64 bits) where they would move a sample by a hundredth of a voxel, as coordinates of most CRSs do. Three comments
/// (code 6) hold `svt.json` and `labels.json` of a `.svt` and their seal, so that the file can become a volume again.

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/dense/gzip_writer.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/volume_formats.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace svt::writers {
namespace {

constexpr std::size_t kHeaderBytes1 = 348, kHeaderBytes2 = 540;
constexpr std::int32_t kCommentCode = 6, kLabelIntent = 1002;
constexpr char kNiftiMetres = 1;

/// A header under construction: values at the offsets of the specification.
class NiftiHeader {
public:
    explicit NiftiHeader(std::size_t size) : bytes_(size, '\0') {}

    template <class T>
    void put(std::size_t offset, T value) {
        std::memcpy(bytes_.data() + offset, &value, sizeof value);
    }
    void put(std::size_t offset, std::string_view text) {
        std::memcpy(bytes_.data() + offset, text.data(), text.size());
    }
    [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

private:
    std::string bytes_;
};

/// Rows of the matrix from index to world space.
std::array<std::array<double, 4>, 3> worldMatrix(const volume::Grid& grid) {
    const Vec3d x = grid.worldFromIndexDirection({1, 0, 0}), y = grid.worldFromIndexDirection({0, 1, 0}),
                z = grid.worldFromIndexDirection({0, 0, 1}), origin = grid.origin();
    return {{{x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}}};
}

/// Whether NIfTI-1 says where the samples are, to a hundredth of a voxel.
bool fitsNifti1(const volume::Grid& grid, std::uint64_t dataOffset) {
    if (dataOffset >= 1u << 24) return false;  // a 32-bit float
    const Vec3i dimension = grid.dimension();
    const Vec3d spacing = grid.spacing();
    const double tolerance = 0.01 * std::min({spacing.x, spacing.y, spacing.z});
    for (const auto& row : worldMatrix(grid)) {
        double error = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const double steps = c < 3 ? double(dimension[static_cast<int>(c)] - 1) : 1;
            error += steps * std::abs(double(static_cast<float>(row[c])) - row[c]);
        }
        if (!(error <= tolerance)) return false;
    }
    return std::max({dimension.x, dimension.y, dimension.z}) <= 32767;
}

std::int16_t niftiType(int bits) { return bits == 8 ? 2 : bits == 16 ? 512 : 768; }

std::string nifti1(const volume::Grid& grid, int bits, std::uint64_t dataOffset) {
    NiftiHeader header(kHeaderBytes1);
    header.put(0, std::int32_t{kHeaderBytes1});
    header.put(40, std::int16_t{3});
    header.put(68, static_cast<std::int16_t>(kLabelIntent));
    header.put(70, niftiType(bits));
    header.put(72, static_cast<std::int16_t>(bits));
    header.put(76, 1.0f);
    for (int axis = 0; axis < 7; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        header.put(42 + 2 * a, static_cast<std::int16_t>(axis < 3 ? grid.dimension()[axis] : 1));
        header.put(80 + 4 * a, axis < 3 ? static_cast<float>(grid.spacing()[axis]) : 1.0f);
    }
    header.put(108, static_cast<float>(dataOffset));
    header.put(112, 1.0f);
    header.put(123, kNiftiMetres);
    header.put(254, std::int16_t{1});  // sform: world space
    std::size_t at = 280;
    for (const auto& row : worldMatrix(grid))
        for (const double value : row) {
            header.put(at, static_cast<float>(value));
            at += 4;
        }
    header.put(344, std::string_view("n+1\0", 4));
    return header.bytes();
}

std::string nifti2(const volume::Grid& grid, int bits, std::uint64_t dataOffset) {
    NiftiHeader header(kHeaderBytes2);
    header.put(0, std::int32_t{kHeaderBytes2});
    header.put(4, std::string_view("n+2\0\r\n\032\n", 8));
    header.put(12, niftiType(bits));
    header.put(14, static_cast<std::int16_t>(bits));
    header.put(16, std::int64_t{3});
    header.put(104, 1.0);
    for (int axis = 0; axis < 7; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        header.put(24 + 8 * a, std::int64_t{axis < 3 ? grid.dimension()[axis] : 1});
        header.put(112 + 8 * a, axis < 3 ? grid.spacing()[axis] : 1.0);
    }
    header.put(168, static_cast<std::int64_t>(dataOffset));
    header.put(176, 1.0);
    header.put(348, std::int32_t{1});  // sform: world space
    std::size_t at = 400;
    for (const auto& row : worldMatrix(grid))
        for (const double value : row) {
            header.put(at, value);
            at += 8;
        }
    header.put(500, std::int32_t{kNiftiMetres});
    header.put(504, kLabelIntent);
    return header.bytes();
}

/// A comment behind the header: size of all (a multiple of 16), code, text.
std::string niftiComment(std::string_view text) {
    const std::size_t size = (8 + text.size() + 15) / 16 * 16;
    NiftiHeader bytes(size);
    bytes.put(0, static_cast<std::int32_t>(size));
    bytes.put(4, kCommentCode);
    bytes.put(8, text);
    return bytes.bytes();
}

std::string niftiBeginning(const volume::SemanticVolume& volume, int bits) {
    const std::string extensions = std::string("\1\0\0\0", 4) + niftiComment(volume::writeHeaderJson(volume)) +
                                   niftiComment(volume::writeLabelsJson(volume.labels)) +
                                   niftiComment(volume::sealText(volume, volume.columns));
    // Samples begin at a multiple of 16.
    const std::uint64_t offset1 = (kHeaderBytes1 + extensions.size() + 15) / 16 * 16;
    const std::uint64_t offset2 = (kHeaderBytes2 + extensions.size() + 15) / 16 * 16;
    const bool isFirst = fitsNifti1(volume.grid, offset1);
    std::string bytes = isFirst ? nifti1(volume.grid, bits, offset1) : nifti2(volume.grid, bits, offset2);
    bytes += extensions;
    bytes.resize(isFirst ? offset1 : offset2, '\0');
    return bytes;
}

/// Writes one file, all or nothing, compressed by gzip if its name ends in .gz. Equal volumes give equal bytes.
/// Cost: O(samples); memory: about 48 MB, besides the label table.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument as checkedSampleBits()
Result<std::uint64_t> writeNifti(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                 const VolumeWriteOptions& options) {
    SVT_TRY(bits, checkedSampleBits(volume));
    SVT_TRY(file, AtomicFile::create(path));
    std::optional<GzipWriter> gzip;
    if (lowerAscii(path.extension().string()) == ".gz") gzip.emplace(*file, options.threads);
    const auto write = [&](std::span<const std::byte> bytes) { return gzip ? gzip->write(bytes) : file->write(bytes); };
    const std::string head = niftiBeginning(volume, *bits);
    SVT_DO(write(std::as_bytes(std::span(head))));
    SVT_DO(streamSamples(volume.columns, *bits, writeStream(options), write));
    if (gzip) SVT_DO(gzip->finish());
    return file->commit();
}

}  // namespace

extern const VolumeFormat kNifti{.name = "nifti",
                                 .endings = ".nii",
                                 .holds = "NIfTI-1, or NIfTI-2 where coordinates need it",
                                 .readers = "nibabel, ITK, 3D Slicer, FSL, SPM",
                                 .content = FileContent::Nifti,
                                 .isDense = true,
                                 .write = writeNifti};

extern const VolumeFormat kNiftiGzip{.name = "niftigz",
                                     .endings = ".nii.gz",
                                     .holds = "NIfTI, compressed",
                                     .readers = "nibabel, ITK, 3D Slicer, FSL, SPM",
                                     .content = FileContent::Gzip,
                                     .isDense = true,
                                     .write = writeNifti};

}  // namespace svt::writers
