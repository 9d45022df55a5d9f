#pragma once
/// \file
/// Entry point: a label volume from an array in memory, such as the result of a segmentation or a simulation.
/// readLabelVolume() does the same for files.

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
    bool isSigned = false;                 ///< negative values are an error
    std::string crsName;
    std::string source;
};

/// Converts the array to a volume. The scalars of the volume are those of the table; without a table, values are
/// numbered.
/// \param labelsJson  a table of labels as in LabelReadOptions::labels, or a `labels.json` of a `.svt` whose scalars
///                    are the values; empty: each value is a label. Voxels are counted in the array
/// \param maxBytes    memory that the columns may take; 0: half of the granted memory
/// \param progress    stage "read"; may be null
/// \return the volume, or BadArgument if the number of bytes does not match the grid or a value is negative. BadJson:
///         an invalid table. BadVolume: the table does not fit the values. Also TooManyLabels, InputTooBig, Cancelled
/// Cost: O(samples), on one thread; a row that equals the row below costs one comparison. Memory: the columns and two
/// slices.
[[nodiscard]] Result<volume::SemanticVolume> volumeFromArray(const LabelArray& array, std::string_view labelsJson = {},
                                                             std::uint64_t maxBytes = 0,
                                                             const Progress* progress = nullptr);

}  // namespace svt::volume_readers
