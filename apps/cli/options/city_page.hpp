#pragma once
/// \file
/// Whether an input is a city, and all of it as one volume.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <filesystem>

namespace svt::cli {

/// Whether an input is a city: the folder of one, or an address (http://, https://).
[[nodiscard]] bool isCity(const std::filesystem::path& input);

/// All of a city as one volume for the page, at the finest detail that it draws without streaming; tells which in a note.
/// \return the volume, or an error of City::open(), extractVolume()
[[nodiscard]] Result<volume::SemanticVolume> pageVolume(const std::filesystem::path& folder);

}  // namespace svt::cli
