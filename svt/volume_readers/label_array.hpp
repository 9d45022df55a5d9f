#pragma once
/// \file
/// Entry point: a label volume from an array in memory, such as the result of a segmentation or a simulation. What
/// readLabelVolume() does for files.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace svt::volume_readers {

/// A dense array of labels, 0 for background. The bytes are the caller's.
struct LabelArray {
    volume::Grid grid;                     ///< of the samples; its dimension is that of the array
    std::span<const std::byte> samples{};  ///< x fastest, then y, then z, in the machine's byte order
    int bits = 8;                          ///< of a sample: 8, 16 or 32
    bool isSigned = false;                 ///< values must not be negative even so
    std::string crsName;
    std::string source;
};

/// The array as a volume. The scalars of the volume are those of the table; without one, values are numbered.
/// \param labelsJson  a table of labels as LabelReadOptions::labels has it, or a `labels.json` of a `.svt`, whose scalars
///                    are the values; empty: each value is a label. Voxels are counted in the array
/// \param maxBytes    memory that the columns may take; 0: half of what is granted
/// \param progress    stage "read"; may be null
/// \return the volume, or BadArgument if the bytes are not as many as the grid has samples, or a value is negative;
///         BadJson for the table, BadVolume if it does not fit the values; TooManyLabels, InputTooBig, Cancelled
/// Cost: O(samples), on one thread; rows that read as the ones below cost a comparison. Memory: the columns, two slices.
[[nodiscard]] Result<volume::SemanticVolume> volumeFromArray(const LabelArray& array, std::string_view labelsJson = {},
                                                             std::uint64_t maxBytes = 0,
                                                             const Progress* progress = nullptr);

}  // namespace svt::volume_readers
