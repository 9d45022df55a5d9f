#pragma once
/// \file
/// A scene: what a picture shows, in queries and regions, so that it holds for any volume of the model. Plain data with
/// a JSON form (`*.scene.json`, docs/formats/scene.schema.json); the command line makes one, a link may carry one.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/illustrate/shell_groups.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::illustrate {

/// Where a picture is taken from: a named view, changed by what is given. Points are metres from the grid's lower
/// corner, in world axes.
struct SceneCamera {
    std::string preset = "iso";  ///< see render::cameraPresetNames()
    std::string around;          ///< query: the view shows what it selects; empty: all
    bool isParallel = false;
    double fieldOfView = 30;  ///< degrees, vertical, perspective alone
    double zoom = 1;          ///< > 0; above 1 is nearer
    std::optional<Vec3d> eye, target;
    friend bool operator==(const SceneCamera&, const SceneCamera&) = default;
};

/// What a query's labels look like; what is set overrides what styles before it set.
struct SceneStyle {
    std::string select;
    std::optional<Vec3f> color;    ///< sRGB, 0..1
    std::optional<float> opacity;  ///< see render::Style
    std::optional<render::Hatch> hatch;
    bool isGhost = false;  ///< coloured air where it was solid, gone where it was air; before color and opacity
    friend bool operator==(const SceneStyle&, const SceneStyle&) = default;
};

/// Feature edges of the model's meshes, drawn at their depth inside the volume.
struct SceneLines {
    std::string select;  ///< query: whose, visible or not; empty: of all that is visible
    float width = 1;     ///< pixels, 0.1 to 64
    std::optional<Vec3f> color;
    render::HiddenLines hidden = render::HiddenLines::Faint;  ///< behind something opaque
    friend bool operator==(const SceneLines&, const SceneLines&) = default;
};

/// A form of the volume that passes draw.
struct VolumeForm {
    std::optional<ShellLevel> shell;  ///< the hulls of groups of this level, two voxels thick; nothing: the volume
    std::optional<int> level;         ///< level of detail, 0 (finest) to 6; nothing: as fine as the pixels show
    friend bool operator==(const VolumeForm&, const VolumeForm&) = default;
};

/// Part of the volume, and how it is drawn.
struct ScenePass {
    std::vector<std::string> show;  ///< queries; where there are any, all else is hidden
    std::vector<std::string> hide;  ///< queries
    std::vector<SceneStyle> styles;
    std::string cut;   ///< region that is cut away; empty: none
    std::string keep;  ///< region outside of which nothing is drawn; empty: no limit
    render::Pass::Join join = render::Pass::Join::Over;
    std::vector<SceneLines> lines;
    VolumeForm form{};
    std::vector<std::string> meshes;  ///< queries, or size<M: what is drawn as the model's meshes, not as voxels
    friend bool operator==(const ScenePass&, const ScenePass&) = default;
};

/// Colours, lines and hatches of the whole picture.
enum class Look : std::uint8_t {
    Plain,      ///< colours on white, thin lines
    Paper,      ///< for print: white paper, muted colours, hatches, bold lines around what is cut
    Blueprint,  ///< white lines on blue
    Dark        ///< for slides: colours on near black
};

struct Scene {
    std::int32_t width = 1280, height = 720;  ///< pixels
    int samples = 4;                          ///< rays a pixel
    Look look = Look::Plain;
    SceneCamera camera;
    std::optional<Vec3f> background;  ///< overrides the look's
    bool isTransparent = false;       ///< no background at all
    /// Override the look's.
    std::optional<float> lineStrength, lineWidth, cutWidth;
    std::optional<Vec3f> lineColor;
    std::optional<bool> hasHatches;
    std::optional<double> hatchSpacing;  ///< metres; else about 9 pixels
    std::optional<float> ambientOcclusion;
    std::vector<std::string> names;  ///< queries: what is named beside the picture, see name_tags.hpp
    std::vector<ScenePass> passes{ScenePass{}};

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// What is around a lens or a highlight.
enum class Context : std::uint8_t {
    Ghost,  ///< coloured air
    Solid,  ///< as it is
    Shell,  ///< glass: the outer hull of the building
    None
};

/// The scene's only pass becomes an S-Lens: within `region` the model is seen without what `cut` takes away, and covers
/// the context (Ropinski and Hinrichs 2005; section 5.1 of the paper).
void addLens(Scene& scene, const std::string& region, const std::string& cut, Context context);
/// The scene's only pass becomes a highlight of what the queries select, in its context; light reaches it whatever
/// stands in front (section 5.2 of the paper).
void addHighlight(Scene& scene, const std::vector<std::string>& queries, Context context);
/// Takes away what hides the selected, which is drawn whole.
void addCutaway(Scene& scene, const std::string& query, double margin);

/// What the passes of a scene draw, each once, in the order of their first use. At least one.
[[nodiscard]] std::vector<VolumeForm> formsOf(const Scene& scene);
/// The frame that shows `scene` on `volume`. Pass::volume counts formsOf(scene).
/// \return the frame, which passes checkFrameSpec(), or BadSection, BadQuery, NothingSelected, BadCamera, BadFrame;
///         BadArgument where lines or meshes are asked for and the volume was built without
[[nodiscard]] Result<render::FrameSpec> frameOf(const Scene& scene, const volume::SemanticVolume& volume);

/// \param name  stands for the file in messages
/// \return the scene, or BadJson, or BadScene that names the member (as a JSON path), what was found and what is
/// expected
[[nodiscard]] Result<Scene> parseScene(std::string_view json, const std::string& name = "scene");
/// Equal scenes give equal bytes; members that are as by default are left out.
[[nodiscard]] std::string writeScene(const Scene& scene);

[[nodiscard]] std::string_view lookName(Look look) noexcept;
[[nodiscard]] std::optional<Look> lookFromName(std::string_view name) noexcept;

}  // namespace svt::illustrate
