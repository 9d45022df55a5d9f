#include <svt/core/deflate.hpp>
#include <svt/volume_readers/formats/label_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace svt::volume_readers {
namespace {

constexpr std::uint64_t kMaxNiftiHead = std::uint64_t{1} << 30;
constexpr std::int32_t kNiftiComment = 6;

Error badNifti(std::string message) { return Error(Code::BadImage, std::move(message)); }

/// A header as bytes, read at the offsets of the specification.
struct NiftiHead {
    std::string_view bytes;
    bool isSecond = false;

    template <class T>
    [[nodiscard]] T at(std::size_t offset) const {
        T value{};
        std::memcpy(&value, bytes.data() + offset, sizeof value);
        return value;
    }
    /// A number that version 1 has as `First` at one place and version 2 as `Second` at another.
    template <class First, class Second>
    [[nodiscard]] double number(std::size_t first, std::size_t second) const {
        return isSecond ? static_cast<double>(at<Second>(second)) : static_cast<double>(at<First>(first));
    }
    [[nodiscard]] double real(std::size_t first, std::size_t second, std::size_t index) const {
        return number<float, double>(first + 4 * index, second + 8 * index);
    }
};

Result<void> readNiftiType(int type, LabelImage& image) {
    switch (type) {
        case 2: image.bits = 8; return {};
        case 256: image.bits = 8; break;
        case 512: image.bits = 16; return {};
        case 4: image.bits = 16; break;
        case 768: image.bits = 32; return {};
        case 8: image.bits = 32; break;
        case 16: image.other = OtherKind::Float32; break;
        case 64: image.other = OtherKind::Float64; break;
        case 1024: image.other = OtherKind::Int64; break;
        case 1280: image.other = OtherKind::UInt64; break;
        default: return badNifti(fmt::format("samples of type {} cannot be labels; whole numbers are expected", type));
    }
    if (image.other != OtherKind::None) {
        image.bits = 32;
        return {};
    }
    image.isSigned = true;
    return {};
}

/// The matrix of sform, else the quaternion of qform, else only the spacing.
void readNiftiPlace(const NiftiHead& head, LabelImage& image) {
    const auto units = static_cast<int>(head.number<std::uint8_t, std::int32_t>(123, 500)) & 7;
    const double unit = units == 2 ? 1e-3 : units == 3 ? 1e-6 : 1;
    Vec3d spacing;
    for (int axis = 0; axis < 3; ++axis) spacing[axis] = std::abs(head.real(80, 112, std::size_t(axis)));
    if (head.number<std::int16_t, std::int32_t>(254, 348) > 0) {
        for (int row = 0; row < 3; ++row) {
            const auto value = [&](std::size_t c) {
                return unit * head.real(280 + 16 * std::size_t(row), 400 + 32 * std::size_t(row), c);
            };
            for (std::size_t c = 0; c < 3; ++c) image.steps[c][row] = value(c);
            image.origin[row] = value(3);
        }
        return;
    }
    for (int axis = 0; axis < 3; ++axis) image.steps[std::size_t(axis)][axis] = unit * spacing[axis];
    if (head.number<std::int16_t, std::int32_t>(252, 344) <= 0) return;
    const double b = head.real(256, 352, 0), c = head.real(256, 352, 1), d = head.real(256, 352, 2);
    const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
    const double side = head.real(76, 104, 0) < 0 ? -1 : 1;
    image.steps[0] =
        Vec3d{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)} * (unit * spacing.x);
    image.steps[1] =
        Vec3d{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)} * (unit * spacing.y);
    image.steps[2] =
        Vec3d{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c} * (unit * side * spacing.z);
    for (int axis = 0; axis < 3; ++axis) image.origin[axis] = unit * head.real(268, 376, std::size_t(axis));
}

void takeComment(std::string_view text, LabelImage& image) {
    if (text.starts_with("{\"labels\""))
        image.labelsJson = text;
    else if (text.starts_with('{'))
        image.headerJson = text;
    else if (text.starts_with("svt-seal"))
        image.seal = text;
}

/// Reads the bytes between the header and the samples: four bytes that state whether extensions follow, then the
/// extensions.
void readExtensions(std::string_view bytes, LabelImage& image) {
    const auto isBlank = [](std::string_view text) { return text.find_first_not_of('\0') == std::string_view::npos; };
    std::size_t at = 4;
    while (bytes.size() >= 4 && bytes[0] != '\0' && at + 8 <= bytes.size()) {
        std::int32_t size = 0, code = 0;
        std::memcpy(&size, bytes.data() + at, 4);
        std::memcpy(&code, bytes.data() + at + 4, 4);
        if (size < 16 || static_cast<std::size_t>(size) > bytes.size() - at) break;
        const std::string_view text = bytes.substr(at + 8, static_cast<std::size_t>(size) - 8);
        if (code == kNiftiComment) takeComment(text.substr(0, text.find('\0')), image);
        at += static_cast<std::size_t>(size);
    }
    if (at < bytes.size() && !isBlank(bytes.substr(at)))
        image.warnings.push_back(
            fmt::format("{} bytes between the header of the NIfTI and its samples are not a readable extension: the "
                        "header is damaged. A table of labels in them is not used; copy or download the file again",
                        bytes.size() - at));
}

/// Reads the header from the beginning of the unpacked file; `dataOffset` receives the position of the samples.
Result<LabelImage> readNiftiHead(std::string_view text, std::uint64_t& dataOffset) {
    NiftiHead head{text};
    if (text.size() < 352) return badNifti("the header of the NIfTI is cut short");
    head.isSecond = head.at<std::int32_t>(0) == 540;
    if ((head.isSecond && text.size() < 544) || (!head.isSecond && head.at<std::int32_t>(0) != 348))
        return badNifti("the file is not NIfTI, or is big-endian; save it as little-endian NIfTI");
    if (text.substr(head.isSecond ? 4 : 344, 2) != "n+")
        return badNifti("the samples of the NIfTI stand in another file; save it as one .nii");
    LabelImage image;
    SVT_DO(readNiftiType(head.isSecond ? head.at<std::int16_t>(12) : head.at<std::int16_t>(70), image));
    const auto axes = head.number<std::int16_t, std::int64_t>(40, 16);
    for (int axis = 0; axis < 7; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double size = head.number<std::int16_t, std::int64_t>(42 + 2 * a, 24 + 8 * a);
        if (axis < 3)
            image.dimension[axis] = axes > axis && size > 0 && size < 1e9 ? static_cast<std::int32_t>(size) : 0;
        else if (axes > axis && size > 1)
            return badNifti("the image has more than three axes");
    }
    const double slope = head.real(112, 176, 0), shift = head.real(116, 184, 0);
    if (slope != 0 && (slope != 1 || shift != 0))
        return badNifti("the values of the image are scaled; labels are stored as they are");
    const double offset = head.number<float, std::int64_t>(108, 168);
    if (!(offset >= (head.isSecond ? 544 : 352)) || offset > double(kMaxNiftiHead))
        return badNifti("the samples begin at an impossible place");
    dataOffset = static_cast<std::uint64_t>(offset);
    readNiftiPlace(head, image);
    return image;
}

bool isGzip(std::string_view text) noexcept { return text.starts_with("\x1f\x8b"); }

// Size of the header, after which extensions follow.
std::size_t headBytes(std::string_view head) noexcept {
    return head.starts_with(std::string_view("\x1c\2", 2)) ? 540 : 348;
}

// Whether a file begins with the header of NIfTI-1 or -2.
bool beginsAsNifti(std::string_view head) noexcept {
    return head.size() >= 348 && ((head.starts_with(std::string_view("\x5c\1\0\0", 4)) && head[344] == 'n') ||
                                  head.starts_with(std::string_view("\x1c\2\0\0n", 5)));
}

bool looksLikeNifti(const SharedFile& file) {
    std::string head = file->head(348);
    if (!isGzip(head)) return beginsAsNifti(head);
    head.assign(348, '\0');
    const ReadSamples read = gzipSamples(file, file->from(0), Code::BadImage);
    return static_cast<bool>(read(std::as_writable_bytes(std::span(head)))) && beginsAsNifti(head);
}

// Reads one stream: the header, then the bytes before the samples, then the samples.
Result<LabelImage> openPackedNifti(const SharedFile& file) {
    std::string unpacked(544, '\0');
    ReadSamples read = gzipSamples(file, file->from(0), Code::BadImage);
    SVT_DO(read(std::as_writable_bytes(std::span(unpacked))));
    std::uint64_t offset = 0;
    SVT_TRY(image, readNiftiHead(unpacked, offset));
    if (offset / 1032 > file->size()) return badNifti("the samples begin at an impossible place");
    if (offset < 544) {
        // NIfTI-1 without extensions: samples were read with the header.
        read = gzipSamples(file, file->from(0), Code::BadImage);
        unpacked.assign(static_cast<std::size_t>(offset), '\0');
        SVT_DO(read(std::as_writable_bytes(std::span(unpacked))));
    } else {
        unpacked.resize(static_cast<std::size_t>(offset));
        SVT_DO(read(std::as_writable_bytes(std::span(unpacked).subspan(544))));
    }
    readExtensions(std::string_view(unpacked).substr(headBytes(unpacked)), *image);
    SVT_DO(checkImage(*image, file->size(), true, Code::BadImage));
    image->read = std::move(read);
    return image;
}

// NIfTI-1 and -2 in one file, as it is or in gzip.
Result<LabelImage> openNifti(const SharedFile& file) {
    std::string buffer;
    SVT_TRY(head, file->text({0, 544}, buffer));
    if (isGzip(*head)) return openPackedNifti(file);
    std::uint64_t offset = 0;
    SVT_TRY(image, readNiftiHead(*head, offset));
    if (offset > file->size()) return badNifti("the samples begin behind the end of the file: it is cut short");
    const std::size_t size = headBytes(*head);
    SVT_TRY(extensions, file->text({size, offset - size}, buffer));
    readExtensions(*extensions, *image);
    const FilePart stored = file->from(offset);
    SVT_DO(checkImage(*image, stored.size, false, Code::BadImage));
    image->read = plainSamples(file, stored, Code::BadImage);
    return image;
}

}  // namespace

extern const LabelFormat kNifti{.name = "nifti",
                                .endings = ".nii|.nii.gz",
                                .holds = "NIfTI-1 and -2",
                                .looksLike = [](const auto& file, const auto&) { return looksLikeNifti(file); },
                                .open = [](const auto& file, const auto&, std::uint64_t) { return openNifti(file); }};

}  // namespace svt::volume_readers
