#pragma once
/// \file
/// The fields of a `.svt` file: the entries `fields.json` and `fields/`. docs/formats/svt.md specifies them to the bit.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/fields/field_blocks.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace svt::fields {

/// The heads of all fields of a `.svt`; may be empty. Reads neither labels nor values.
/// \return or CannotOpen, BadVolume, BadChecksum, BadField
[[nodiscard]] Result<std::vector<FieldHead>> readFieldHeads(const std::filesystem::path& path);

/// The same with the codes and ranges, and the bytes of each field in the file.
struct ListedField {
    StoredField stored;
    std::uint64_t bytes = 0;  ///< of its entries in the file
};
[[nodiscard]] Result<std::vector<ListedField>> listFields(const std::filesystem::path& path);
/// The same by ranges of bytes: of a file in memory, or at an address.
[[nodiscard]] Result<std::vector<ListedField>> listFields(const volume::ReadRange& read, std::uint64_t fileSize);

/// A field by name with all values.
/// \param maxBytes  limit for its values in memory
/// \param threads   at most this many; 0: all cores. The result does not depend on it
/// \return or as readFieldHeads(); UnknownField with the names of the fields; InputTooBig
[[nodiscard]] Result<Field> readField(const std::filesystem::path& path, const std::string& name,
                                      std::uint64_t maxBytes = std::uint64_t{8} << 30, int threads = 0);

/// The same by ranges of bytes.
/// \param read  called by several threads at once, unless `threads` is 1
[[nodiscard]] Result<Field> readField(const volume::ReadRange& read, std::uint64_t fileSize, const std::string& name,
                                      std::uint64_t maxBytes = std::uint64_t{8} << 30, int threads = 0);

/// Copies the `.svt` at `input` to `output` (may be the same file; written atomically), with `fields` added in place of those
/// with the same name, and without the fields in `removed`. All other entries are copied as bytes.
/// Equal fields give equal bytes, whatever the number of threads. Memory: the file, and the codes of a field.
/// \return bytes written, or as readFieldHeads(); UnknownField; BadField if a field is invalid (checkField), or its precision is
///         too fine for its range (see precisionFor()); CannotWrite, DiskFull, WouldDestroy
[[nodiscard]] Result<std::uint64_t> writeFields(const std::filesystem::path& input, const std::filesystem::path& output,
                                                std::span<const Field> fields,
                                                std::span<const std::string> removed = {}, int threads = 0);

/// The finest precision of 1, 2 or 5 times a power of ten for which 16 bits hold all values from `low` to `high`: a
/// range / 65534, rounded up. 0 where the range is not finite.
[[nodiscard]] double precisionFor(double low, double high) noexcept;

}  // namespace svt::fields
