#pragma once
/// \file
/// Reads an attached NRRD with three axes and unsigned samples, as written by writeNrrd and rewritten by other
/// tools.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::writers {

/// A dense image, x fastest, then y, then z.
struct NrrdImage {
    Vec3i dimension{};
    int bits = 0;                       ///< 8, 16 or 32 per sample
    Vec3d origin{};                     ///< first sample; zero if not stated
    std::array<Vec3d, 3> directions{};  ///< step to the next sample along each axis; zero if not stated
    std::vector<std::pair<std::string, std::string>> keyValues;  ///< in file order, unescaped
    std::vector<std::byte> data;                                 ///< samples in the byte order of this machine

    /// The value of a key, or nullptr.
    [[nodiscard]] const std::string* find(std::string_view key) const noexcept;
    /// Sample `index` = i + nx * (j + ny * k).
    [[nodiscard]] std::uint32_t sample(std::size_t index) const noexcept;
};

struct NrrdReadOptions {
    std::uint64_t maxDataBytes = std::uint64_t{8} << 30;  ///< limit on the image size
};

/// Reads the types uint8, uint16 and uint32 under all their names, encodings raw and gzip, both byte orders.
/// Ignores `data file`: a file never makes the library open another one.
/// \return the image, or CannotOpen; BadNrrd with the reason; InputTooBig
[[nodiscard]] Result<NrrdImage> readNrrd(const std::filesystem::path& path, const NrrdReadOptions& options = {});

}  // namespace svt::writers
