#pragma once
/// \file
/// Names of files that belong to another one.

#include <filesystem>
#include <string>

namespace svt::writers {

/// NAME.roofs.geojson for NAME.geojson.
[[nodiscard]] inline std::filesystem::path fileBeside(const std::filesystem::path& path, const std::string& content) {
    std::filesystem::path beside = path;
    beside.replace_extension("." + content + path.extension().string());
    return beside;
}

}  // namespace svt::writers
