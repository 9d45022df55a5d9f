#pragma once
/// \file
/// The formats of label volumes: each opens a mapped file, checks its header, and leaves the samples to be read.

#include <svt/volume_readers/samples/label_image.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace svt::volume_readers {

/// NRRD, one file, raw or gzip. Places in millimetres where it says so or names an anatomical space. Errors: BadNrrd.
[[nodiscard]] Result<LabelImage> openNrrd(const SharedFile& file);
/// VTK XML image data, one piece, appended raw. Errors: BadImage.
[[nodiscard]] Result<LabelImage> openVti(const SharedFile& file);
/// NIfTI-1 and -2, one file. `bytes`: as it is, or unpacked from gzip as far as the header. Errors: BadImage.
[[nodiscard]] Result<LabelImage> openNifti(const SharedFile& file, bool isGzip);
/// TIFF and BigTIFF, a page per slice. Errors: BadImage.
[[nodiscard]] Result<LabelImage> openTiff(const SharedFile& file);
/// CityGML with a volume. What stands beside the document is looked for in its folder alone. Errors: BadImage.
[[nodiscard]] Result<LabelImage> openAde(const SharedFile& file, const std::filesystem::path& path);

/// Where the volume of a CityGML document begins: the start tag of its texture; npos: it has none.
[[nodiscard]] std::size_t findAdeTexture(std::string_view document) noexcept;

/// Reads N numbers separated by blanks, as lists in XML are; what follows them is left alone.
/// \return false where there are fewer, or something else
template <class T, std::size_t N>
[[nodiscard]] bool readNumbers(std::string_view text, std::array<T, N>& numbers) noexcept {
    for (T& number : numbers) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc()) return false;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return true;
}

}  // namespace svt::volume_readers
