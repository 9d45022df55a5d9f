#pragma once
/// \file
/// The options that say what a picture shows, as a scene.

#include <svt/illustrate/scene.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace svt::cli {

/// What is not given is left to the scene file, or else to the scene's defaults.
struct SceneArguments {
    std::filesystem::path sceneFile;
    std::optional<std::string> camera, size, background, look;
    std::vector<std::string> hide, show, color, opacity, hatchOf, sections, highlights, names, meshes;
    std::optional<std::string> wireframe, wireColor;
    std::string hiddenLines = "faint";
    std::optional<double> wireWidth;
    std::string cut, keep, lens, cutaway, around, context = "ghost", shell;
    std::vector<double> eye, target;
    std::optional<int> samples, dpi, level, contextLevel;
    std::optional<double> edges, lineWidth, cutWidth, hatchSpacing, fov, zoom;
    bool isParallel = false, isTransparent = false, hasHatches = false;

    void addTo(CLI::App& command);
    /// What the picture says of its size in print; 0: nothing.
    [[nodiscard]] int printedDpi() const;
    /// The scene of frame `frame` of `frames`: sections such as z=0..6 move from the one end to the other.
    [[nodiscard]] Result<illustrate::Scene> toScene(int frame, int frames) const;
};

}  // namespace svt::cli
