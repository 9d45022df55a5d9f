#pragma once
/// \file
/// The bytes of the values of a field: codes of 16 bits or floats, levels, blocks and their index.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/fields/field_blocks.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::fields {

inline constexpr std::uint16_t kMissingCode = 0xFFFF;

/// The code for the values of a field, with its levels.
/// \return or BadField if the precision is too fine for the range
[[nodiscard]] Result<FieldCode> codeFor(const Field& field);

/// The code of a value; kMissingCode for NaN.
[[nodiscard]] std::uint16_t codeOf(float value, const FieldCode& code) noexcept;
[[nodiscard]] float valueOf(std::uint16_t code, const FieldCode& how) noexcept;

/// Bytes of a record of the index: size and CRC of the frame, then the smallest and the largest value of each component.
[[nodiscard]] std::size_t indexRecordBytes(const FieldCode& code, std::int32_t components) noexcept;

/// Blocks of a level of one time.
[[nodiscard]] std::uint64_t blocksOf(const Lattice& lattice, std::int32_t level) noexcept;
/// Blocks of all levels and times.
[[nodiscard]] std::uint64_t blocksOf(const FieldHead& head, const FieldCode& code) noexcept;

/// The entries `index` and `blocks` of a grid field.
struct EncodedBlocks {
    std::vector<std::byte> index;
    std::vector<std::vector<std::byte>> frames;  ///< in the order of the index; empty for blocks of one value
};
[[nodiscard]] Result<EncodedBlocks> encodeBlocks(const Field& field, const FieldCode& code, int threads);

/// The entry `values` of a field of labels or points.
[[nodiscard]] std::vector<std::byte> encodeValues(std::span<const float> values, const FieldCode& code);
/// The inverse. `bytes` must hold whole values.
[[nodiscard]] Result<std::vector<float>> decodeValues(std::span<const std::byte> bytes, const FieldCode& code);

/// Appends the smallest and the largest of some values, as they are in the index; NaN and NaN if all are missing.
void appendRange(std::vector<std::byte>& to, std::pair<float, float> range, const FieldCode& code);
/// \param at  offset in `bytes`
[[nodiscard]] std::pair<float, float> loadRange(std::span<const std::byte> bytes, std::size_t at,
                                                const FieldCode& code);

}  // namespace svt::fields
