#pragma once
/// \file
/// The module of reports: comparisons and quantities. It reads the files itself, and has no renderer.

#include <web/wasm/calls.hpp>

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::web {

using Files = std::vector<NamedBytes>;

/// The files of a list of names and sizes in the concatenated bytes.
/// \param at  their begin; becomes their end
/// \return the files; BadArgument if the list is empty
[[nodiscard]] Result<Files> filesOf(const Json& names, const Json& sizes, std::span<const std::byte> bytes,
                                    std::size_t& at);

/// Whether one of the files is a volume (.svt).
[[nodiscard]] bool isVolume(const Files& files);

/// A volume with meshes, from one volume or from one or several models, as the commands read them.
/// \param memoryBytes  limit of the volume without a given spacing; 0: as for the commands
/// \param grid         its sample positions are those of the result of a model; null: as for the commands
/// \param spacing      gets the reason for a spacing that is not the usual one; may be null
/// \return the volume, or an error of the readers
[[nodiscard]] Result<volume::SemanticVolume> readVolume(const Files& files, std::uint64_t memoryBytes,
                                                        const volume::Grid* grid, const Progress& progress,
                                                        Diagnostics& findings, std::string* spacing = nullptr);

/// Warnings, errors, and notes that the commands always print, as texts.
[[nodiscard]] Json findingsJson(const Diagnostics& findings);

/// The calls of compare.cpp and of quantities.cpp.
[[nodiscard]] std::span<const Call> comparisonCalls() noexcept;
[[nodiscard]] std::span<const Call> quantityCalls() noexcept;

}  // namespace svt::web
