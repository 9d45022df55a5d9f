#pragma once
/// \file
/// The values of one field of a `.svt`, read block by block by ranges of bytes: from a file, or by HTTP.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/zip_entries.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace svt::fields {

/// How the values of a field are stored.
struct FieldCode {
    bool isFloat = false;  ///< 32-bit floats; else 16-bit codes
    double scale = 1;      ///< value = offset + scale * code; code 65535 is a missing value
    double offset = 0;
    std::int32_t levels = 1;  ///< of a grid: level n halves the nodes of level n - 1

    [[nodiscard]] std::size_t bytes() const noexcept { return isFloat ? 4 : 2; }
};

/// A field as `fields.json` describes it.
struct StoredField {
    FieldHead head;
    FieldCode code;
    std::optional<std::pair<float, float>> range;  ///< smallest and largest stored value; none if all are missing
};

/// Nodes of a block along each axis.
inline constexpr std::int32_t kBlockNodes = 64;

/// Nodes of a level: half those of the level below it, rounded up.
[[nodiscard]] Vec3i levelSize(const Lattice& lattice, std::int32_t level) noexcept;
/// Blocks of a level along each axis.
[[nodiscard]] Vec3i blockCount(const Lattice& lattice, std::int32_t level) noexcept;

/// A grid field of a file. Copyable; any thread may read blocks if its source allows it.
class FieldBlocks {
public:
    /// A box of nodes of a level.
    struct Block {
        Vec3i first, size;
        std::vector<float> values;  ///< x fastest, then y, z; component slowest; NaN where missing
    };

    /// Opens a field of kind grid. Reads the end of the file, its directory, `fields.json`, and the index of the blocks.
    /// \return the field; or UnknownField with the names of the fields; BadField where a part is damaged, or the field is not
    ///         a grid; BadVolume, BadChecksum; CannotOpen or an error of `read`
    [[nodiscard]] static Result<FieldBlocks> open(volume::ReadRange read, std::uint64_t fileSize,
                                                  const std::string& name);
    [[nodiscard]] static Result<FieldBlocks> open(const std::filesystem::path& path, const std::string& name);

    [[nodiscard]] const StoredField& stored() const noexcept { return stored_; }
    [[nodiscard]] const FieldHead& head() const noexcept { return stored_.head; }

    /// Reads one block: its frame only, or nothing if all its nodes have one value.
    /// \param level  0 .. levels - 1
    /// \param time   index into the times
    /// \param block  from 0 to blockCount() - 1 along each axis
    /// \return the block, or BadField where it does not exist or is damaged; an error of the source
    [[nodiscard]] Result<Block> read(std::int32_t level, std::size_t time, Vec3i block) const;

    /// Smallest and largest value of a block; none if all are missing. Reads nothing.
    /// The block must exist.
    [[nodiscard]] std::optional<std::pair<float, float>> range(std::int32_t level, std::size_t time, Vec3i block,
                                                               std::int32_t component = 0) const noexcept;

    /// Number of blocks of all levels and times.
    [[nodiscard]] std::size_t blocks() const noexcept { return entries_.size(); }

private:
    struct Entry {
        std::uint64_t offset = 0;  // in the frames
        std::uint32_t size = 0, crc = 0;
    };

    Result<void> readIndex(const std::vector<std::byte>& index, std::uint64_t frameBytes);
    [[nodiscard]] std::size_t entryOf(std::int32_t level, std::size_t time, Vec3i block) const noexcept;

    StoredField stored_;
    std::shared_ptr<const volume::ZipRanges> file_;
    std::uint64_t framesOffset_ = 0;  // in the file
    std::vector<Entry> entries_;
    std::vector<std::pair<float, float>> ranges_;  // per entry and component; NaN: all missing
};

}  // namespace svt::fields
