#pragma once
/// \file
/// Helpers for the formats of label volumes. Each format opens a file and checks its header; the samples are read
/// later. Each is declared as a LabelFormat next to its code.

#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/volume_readers/samples/label_image.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace svt::volume_readers {

/// NRRD, one file, raw or gzip. Lengths are millimetres if the file states so or names an anatomical space. Errors:
/// BadNrrd.
[[nodiscard]] Result<LabelImage> openNrrd(const SharedFile& file);

/// Reads N numbers separated by blanks, as in lists in XML; ignores the text after them.
/// \return false if there are fewer numbers, or other text
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
