#pragma once
/// \file
/// For the formats of label volumes: each opens a file, checks its header, and leaves the samples to be read. The formats
/// are declared as LabelFormat beside their code.

#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/volume_readers/samples/label_image.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace svt::volume_readers {

/// NRRD, one file, raw or gzip. Places in millimetres where it says so or names an anatomical space. Errors: BadNrrd.
[[nodiscard]] Result<LabelImage> openNrrd(const SharedFile& file);

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
