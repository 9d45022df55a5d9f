#pragma once
/// \file
/// Options that describe a picture, converted to a scene: of `svt render`, and keywords of render() in Python.

#include <svt/illustrate/scene.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/record/members.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::frontend {

/// Options not given are taken from the scene file, or else from the scene's defaults.
struct SceneOptions {
    std::filesystem::path sceneFile;
    std::vector<illustrate::GivenMember> members;  ///< of the scene, as given
    std::optional<std::string> size, wireframe, wireColor;
    std::vector<std::string> color, opacity, hatchOf, sections, highlights, insets;
    std::string cut, lens, cutaway;
    illustrate::Context context = illustrate::Context::Ghost;
    render::HiddenLines hiddenLines = render::HiddenLines::Faint;
    std::optional<double> wireWidth;
    std::optional<int> dpi, level, contextLevel;
    bool hasCells = false;

    /// Resolution to store in the picture for printing; 0: none.
    [[nodiscard]] int printedDpi() const;
    /// Whether an option sets that member of the scene.
    [[nodiscard]] bool isGiven(std::string_view member) const;
    /// The scene. Sections such as z=0..6 become keys of its motion: the plane is at its end in the last picture.
    /// \param pictures  drawn one by one; none: a film
    [[nodiscard]] Result<illustrate::Scene> toScene(std::optional<int> pictures) const;

private:
    /// `scene` with all options; these sections do not move.
    [[nodiscard]] Result<illustrate::Scene> stillScene(illustrate::Scene scene, const std::vector<std::string>& still,
                                                       bool isSeries) const;
};

record::Members<SceneOptions> membersOf(const SceneOptions*) noexcept;

}  // namespace svt::frontend
