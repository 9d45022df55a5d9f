#pragma once
/// \file
/// Files of an OpenFOAM case whose text does not depend on the volume.

#include <span>
#include <string_view>

namespace svt::writers {

/// A dictionary, without its header.
struct FoamSetting {
    std::string_view file, className, text;
};
[[nodiscard]] std::span<const FoamSetting> foamSettings() noexcept;

/// A script or another text.
struct FoamText {
    std::string_view file, text;
};
[[nodiscard]] std::span<const FoamText> foamTexts() noexcept;

}  // namespace svt::writers
