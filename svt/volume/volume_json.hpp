#pragma once
/// \file
/// The JSON parts of a `.svt` file: `svt.json` (grid, names, version) and `labels.json` (the label table). Equal
/// volumes give equal bytes; every number is checked on reading. docs/formats/svt.md lists all keys.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace svt::volume {

inline constexpr int kSvtMajorVersion = 1;
inline constexpr int kSvtMinorVersion = 0;
inline constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxLabelsBytes = std::size_t{1} << 30;

/// The content of `svt.json`.
struct SvtHeader {
    Grid grid;
    Scalar scalarCount = 1;
    std::string crsName;
    std::string modelName;
    std::string source;
};

/// The characters that are written to JSON without escapes.
enum class JsonCharacters { Utf8, AsciiOnly };

/// Appends `text` as a JSON string with quotes. Bytes that are not valid UTF-8 become U+FFFD.
void appendJsonString(std::string& json, std::string_view text, JsonCharacters characters = JsonCharacters::Utf8);

/// One label as a JSON object on one line, keys in a fixed order, numbers in shortest round-trip form.
/// An attribute that is a real number always has a '.' or an exponent, an integer never has.
void appendJsonLabel(std::string& json, const Label& label, JsonCharacters characters = JsonCharacters::Utf8);

/// `svt.json` of a volume.
[[nodiscard]] std::string writeHeaderJson(const SemanticVolume& volume);
/// `labels.json`: one label per line.
[[nodiscard]] std::string writeLabelsJson(const LabelTable& labels);

/// \return the header, or VolumeVersion if a newer program wrote it, BadVolume that names the key, or InputTooBig
[[nodiscard]] Result<SvtHeader> readHeaderJson(std::string_view json);
/// The table, checked as by checkLabels(). Memory: at most a few times the text.
/// \return the table, or BadVolume that names label and key, or InputTooBig
[[nodiscard]] Result<LabelTable> readLabelsJson(std::string_view json);

/// Checks the invariants of a table: parents before children, subtrees nested, references inside the table, scalar
/// ranges disjoint, ascending in tree order and below kMaxScalarCount, one phase colour per scalar or none, finite
/// numbers.
/// \return success, or BadVolume that names the label
[[nodiscard]] Result<void> checkLabels(const LabelTable& labels);

// ------------------------------------------------------------------------------------------------------- the seal
// A volume in a format of other programs has checksums next to its table, which reveal damage if the format has no own
// checksums.

/// CRC-32 of `svt.json` followed by `labels.json` of a volume.
[[nodiscard]] std::uint32_t tableChecksum(const SemanticVolume& volume);
/// CRC-32 of the samples, whatever the order of equal rows and columns in memory. Cost: as countVoxels().
[[nodiscard]] std::uint32_t columnsChecksum(const ColumnVolume& columns);

struct VolumeSeal {
    std::uint32_t table = 0, columns = 0;
};
/// Both checksums as text, such as "svt-seal 01234567 89abcdef".
/// \param columns  the samples that are written
[[nodiscard]] std::string sealText(const SemanticVolume& volume, const ColumnVolume& columns);
/// The seal at the start of a text; nullopt if there is no seal.
[[nodiscard]] std::optional<VolumeSeal> readSeal(std::string_view text) noexcept;

}  // namespace svt::volume
