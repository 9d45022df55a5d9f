#pragma once
/// \file
/// A difference volume as `.svt` with both states and their comparison beside it, for drawings of the new state with
/// marks at its changes. docs/formats/svt.md specifies the entries.
///
///     | entry              | content
///     | states/rows.json   | the comparison (deflated)
///     | states/was.svt     | the old state
///     | states/is.svt      | the new state

#include <svt/compare/compare_states.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace svt::compare {

/// Writes a difference volume with its states, atomically. Other programs read it like any `.svt`.
/// \param difference  of makeDifferenceVolume()
/// \param compared    the file has both states moved back by its shift, so that the new one has its own coordinates
/// \return bytes written, or an error of volume::writeSvt()
/// Cost: that of writing three volumes. Memory: their files.
[[nodiscard]] Result<std::uint64_t> writeDifference(const volume::SemanticVolume& difference, const Compared& compared,
                                                    const std::filesystem::path& path);

/// The states of a file of writeDifference(). Rows lack the names of attributes, options other than the tolerance are the
/// defaults, and both states are in their own coordinates.
/// \return empty for files without states; BadVolume if its entries contradict each other; errors of volume::readSvt()
/// Cost: O(1) for other files: the central directory is read.
[[nodiscard]] Result<std::optional<ComparedStates>> readStates(const std::filesystem::path& path);

}  // namespace svt::compare
