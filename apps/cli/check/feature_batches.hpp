#pragma once
/// \file
/// Reads a large file as models of a few features each, so that a check takes the memory of one such model.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>

namespace svt::cli {

/// Whether a file is large enough to be read in batches: from 64 MiB on, or from 6 MiB if its name ends in .gz.
[[nodiscard]] bool isWorthBatches(const std::filesystem::path& file);

/// Reads a file in batches of about 16 MiB of features, in the order of the file.
///
/// Reports the same findings as a reader of the whole file, except features far away from all others. Faces of
/// adjoining features close a shell only within a batch.
/// \param take  receives each model and the findings of its reader; an error ends the work
/// \return true; or the first error; or false if the whole file must be read at once. Then the results of `take` are
///         useless. Reasons: features refer to each other, the format has no batches, or a batch cannot be read.
/// Cost: that of reading the file. Memory: that of a batch, and 16 bytes per feature.
[[nodiscard]] Result<bool> forEachBatch(const std::filesystem::path& file, const readers::ReadOptions& options,
                                        const std::function<Result<void>(model::BuildingModel&, Diagnostics&)>& take);

}  // namespace svt::cli
