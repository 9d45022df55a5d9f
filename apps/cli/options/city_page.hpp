#pragma once
/// \file
/// Cities as inputs, and as models of a page.

#include <svt/core/result.hpp>
#include <svt/serve/site.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <filesystem>

namespace svt::cli {

/// Whether an input is a city: the folder of one, or an address (http://, https://).
[[nodiscard]] bool isCity(const std::filesystem::path& input);

/// A city as a model of a page, which fetches it in parts.
/// \return the model, or an error of City::open(); CannotOpen for a pack that cannot be read
[[nodiscard]] Result<serve::SiteModel> cityModel(const std::filesystem::path& input, const std::string& name);

/// The whole city as one volume of a few megabytes, for previews and server-side pictures.
/// \return the volume, or an error of City::open(), extractVolume()
[[nodiscard]] Result<volume::SemanticVolume> pageVolume(const std::filesystem::path& folder);

}  // namespace svt::cli
