#pragma once
/// \file
/// A large file as models of a few features each, so that a check takes the memory of one of them.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>

namespace svt::cli {

/// Whether a file is so large that it should be read in batches: from 64 MiB on, from 6 MiB where its name ends in .gz.
[[nodiscard]] bool isWorthBatches(const std::filesystem::path& file);

/// Reads a file feature by feature, some 16 MiB of them at a time, in the order of the file.
///
/// What a reader of the whole file would tell is told, but for features far away from all others. Faces of adjoining
/// features close a shell only within a batch.
/// \param take  receives each model and what was found while it was read; an error ends the work
/// \return true; false where features refer to each other: the file has to be read whole, what `take` has done is of no
///         use; or the first error
/// Cost: that of reading the file. Memory: that of a batch, and 16 bytes a feature.
[[nodiscard]] Result<bool> forEachBatch(const std::filesystem::path& file, readers::ReadOptions options,
                                        const std::function<Result<void>(model::BuildingModel&, Diagnostics&)>& take);

}  // namespace svt::cli
