#pragma once
/// \file
/// Command-line options that describe a picture, converted to a scene.

#include <apps/cli/options/command_line.hpp>

#include <svt/illustrate/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace svt::cli {

/// Options not given are taken from the scene file, or else from the scene's defaults.
struct SceneArguments {
    std::filesystem::path sceneFile;
    std::optional<std::string> camera, fit, size, background, look;
    std::vector<std::string> hide, show, color, opacity, hatchOf, sections, highlights, names, meshes, insets;
    std::optional<std::string> wireframe, wireColor;
    std::string hiddenLines, colorBy, title, sunTime;
    bool hasScaleBar = false, hasNorthArrow = false, hasCells = false;
    std::optional<double> wireWidth, explode;
    std::string cut, keep, lens, cutaway, around, context, shell;
    std::vector<double> eye, target, place;
    std::optional<int> samples, dpi, level, contextLevel, rate;
    std::optional<double> edges, lineWidth, cutWidth, hatchSpacing, fov, zoom, turn, seconds;
    int dpiByDefault = 0;
    bool isParallel = false, isTransparent = false, hasHatches = false;

    void connect(Command& command);
    /// Resolution to store in the picture for printing; 0: none.
    [[nodiscard]] int printedDpi() const;
    /// The scene. Sections such as z=0..6 are keys of its motion: the plane is at its end in the last picture.
    /// \param pictures  drawn one by one; none: a film
    [[nodiscard]] Result<illustrate::Scene> toScene(std::optional<int> pictures) const;

private:
    /// `scene` with all options; these sections do not move.
    [[nodiscard]] Result<illustrate::Scene> stillScene(illustrate::Scene scene, const std::vector<std::string>& still,
                                                       bool isSeries) const;
};

}  // namespace svt::cli
