#pragma once
/// \file
/// A difference volume as `.svt` with both states and their comparison beside it, for drawings of the new state with
/// marks at its changes. docs/formats/svt.md specifies the entries.
///
///     | entry              | content
///     | states/rows.json   | the comparison (deflated)
///     | states/was.svt     | the old state
///     | states/is.svt      | the new state

#include <svt/compare/comparison.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace svt::compare {

/// Two volumes and their comparison.
struct ComparedStates {
    volume::SemanticVolume was, is;
    Comparison comparison;    ///< rows without names of attributes
    double tolerance = 0.01;  ///< metres, of the comparison
};

/// Writes a difference volume with its states, atomically. Other programs read it like any `.svt`.
/// \param difference  of makeDifferenceVolume()
/// \param shift       metres by which the new volume was moved for the comparison; the file has both states moved back, so
///                    that the new one has its own coordinates
/// \return bytes written, or an error of volume::writeSvt()
/// Cost: that of writing three volumes. Memory: their files.
[[nodiscard]] Result<std::uint64_t> writeDifference(const volume::SemanticVolume& difference,
                                                    const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                                                    const Comparison& comparison, double tolerance, Vec3d shift,
                                                    const std::filesystem::path& path);

/// The states of a file of writeDifference().
/// \return empty for files without states; BadVolume if its entries contradict each other; errors of volume::readSvt()
/// Cost: O(1) for other files: the central directory is read.
[[nodiscard]] Result<std::optional<ComparedStates>> readStates(const std::filesystem::path& path);

}  // namespace svt::compare
