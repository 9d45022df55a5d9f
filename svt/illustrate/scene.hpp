#pragma once
/// \file
/// A scene: what a picture shows, described by queries and regions, so that it applies to any volume of the model.
/// Plain data with a JSON form (`*.scene.json`, docs/formats/scene.schema.json); made by the command line, or by a link
/// to the viewer.

#include <svt/analyze/selection.hpp>
#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/illustrate/color_by.hpp>
#include <svt/illustrate/shell_groups.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::illustrate {

/// The part of the volume that a named view is fitted to.
enum class Fit : std::uint8_t {
    Visible,  ///< what the passes draw: not what is hidden or cut away
    All       ///< the whole volume, so that pictures of several scenes have one camera
};
constexpr auto namesOf(Fit) { return std::to_array<Name<Fit>>({{Fit::Visible, "visible"}, {Fit::All, "all"}}); }

/// The camera of a scene: a named view, and members that override it. Points are in metres from the grid's lower
/// corner, along world axes.
struct SceneCamera {
    std::string preset = "iso";  ///< see render::cameraPresetNames()
    std::string around;          ///< query: the view is fitted to what it selects; empty: as `fit` says
    Fit fit = Fit::Visible;      ///< All where eye or target is given
    bool isParallel = false;
    double fieldOfView = 30;  ///< degrees, vertical, perspective only
    double zoom = 1;          ///< > 0; above 1 is nearer
    std::optional<Vec3d> eye, target;
    friend bool operator==(const SceneCamera&, const SceneCamera&) = default;
};

/// Style of the labels that a query selects; members that are set override earlier styles.
struct SceneStyle {
    std::string select;
    std::optional<Vec3f> color;    ///< sRGB, 0..1
    std::optional<float> opacity;  ///< see render::Style
    std::optional<render::Hatch> hatch;
    bool isGhost = false;  ///< solid becomes translucent, air is hidden; applied before color and opacity
    friend bool operator==(const SceneStyle&, const SceneStyle&) = default;
};

/// Feature edges of the model's meshes, composited with the volume by depth.
struct SceneLines {
    std::string select;  ///< query: of these labels, visible or not; empty: of all visible ones
    float width = 1;     ///< pixels, 0.1 to 64
    std::optional<Vec3f> color;
    render::HiddenLines hidden = render::HiddenLines::Faint;  ///< style of parts behind something opaque
    friend bool operator==(const SceneLines&, const SceneLines&) = default;
};

/// The form of the volume that a pass draws.
struct VolumeForm {
    std::optional<ShellLevel> shell;  ///< the shells of groups of this level, two voxels thick; unset: the volume
    std::optional<int> level;         ///< level of detail, 0 (finest) to 6; unset: chosen by the pixel size
    bool hasCells = false;            ///< each voxel, or cell of a level, is drawn as a box with edges
    friend bool operator==(const VolumeForm&, const VolumeForm&) = default;
};

/// A pass: part of the volume, and how it is drawn.
struct ScenePass {
    std::vector<std::string> show;  ///< queries; if there are any, all else is hidden
    std::vector<std::string> hide;  ///< queries
    std::vector<SceneStyle> styles;
    std::string cut;   ///< region that is cut away; empty: none
    std::string keep;  ///< region to which drawing is limited; empty: no limit
    render::Pass::Join join = render::Pass::Join::Over;
    std::vector<SceneLines> lines;
    VolumeForm form{};
    std::vector<std::string> meshes;  ///< queries, or size<M: drawn as the model's meshes instead of voxels
    friend bool operator==(const ScenePass&, const ScenePass&) = default;
};

/// Colours, lines and hatches of the whole picture.
enum class Look : std::uint8_t {
    Plain,      ///< colours on white, thin lines
    Paper,      ///< for print: white paper, muted colours, hatches, bold lines around caps
    Blueprint,  ///< white lines on blue
    Dark        ///< for slides: colours on near black
};
constexpr auto namesOf(Look) {
    return std::to_array<Name<Look>>(
        {{Look::Plain, "plain"}, {Look::Paper, "paper"}, {Look::Blueprint, "blueprint"}, {Look::Dark, "dark"}});
}

/// How a scene changes with time, see motion.hpp.
struct Motion {
    /// How a member goes from key to key.
    enum class Pace : std::uint8_t { Smooth, Even };
    friend constexpr auto namesOf(Pace) {
        return std::to_array<Name<Pace>>({{Pace::Smooth, "smooth"}, {Pace::Even, "even"}});
    }
    struct Key {
        double at = 0;      ///< seconds
        std::string scene;  ///< JSON object: the members of the scene that have these values then
        friend bool operator==(const Key&, const Key&) = default;
    };

    double seconds = 6;
    int rate = 25;    ///< pictures a second
    double turn = 0;  ///< degrees by which the camera goes around meanwhile, counter-clockwise from above
    Pace pace = Pace::Smooth;
    std::vector<Key> keys;  ///< times ascend
    friend bool operator==(const Motion&, const Motion&) = default;
};

/// A small picture in a corner of the picture, with a frame in the picture around what it shows.
struct Inset {
    enum class Corner : std::uint8_t { TopRight, BottomRight, TopLeft, BottomLeft };
    friend constexpr auto namesOf(Corner) {
        return std::to_array<Name<Corner>>({{Corner::TopRight, "top-right"},
                                            {Corner::BottomRight, "bottom-right"},
                                            {Corner::TopLeft, "top-left"},
                                            {Corner::BottomLeft, "bottom-left"}});
    }

    Corner corner = Corner::TopRight;
    double size = 0.3;  ///< share of the picture's width and height, 0.05 to 0.5
    std::string title;
    bool hasMark = true;       ///< the frame around what it shows, and lines to it
    std::string scene = "{}";  ///< JSON object: its members that differ from the picture's, see insetScene()
    friend bool operator==(const Inset&, const Inset&) = default;
};

/// Where the sun stands: the key light, with shadows. See sun.hpp.
struct Sun {
    std::string time;  ///< "2026-06-21 15:00", with "Z" or "+02:00" where it is not the zone of the meridian
    std::optional<std::array<double, 2>> place;  ///< latitude and longitude, degrees; unset: of the model
    double size = 0.53;                          ///< diameter of its disc in degrees, 0 to 20: how soft shadows are
    friend bool operator==(const Sun&, const Sun&) = default;
};

/// Lines between objects and where the depth jumps. Members that are set override the look's.
struct BorderLook {
    std::optional<float> strength, width, cutWidth;  ///< 0..1; pixels; pixels, around what is cut
    std::optional<Vec3f> color;
    friend bool operator==(const BorderLook&, const BorderLook&) = default;
};

/// Hatches of what is cut. Members that are set override the look's.
struct HatchLook {
    std::optional<bool> show;
    std::optional<double> spacing;  ///< metres; unset: the largest 1, 2 or 5 * 10^n m within 11 pixels (4.4 to 11)
    friend bool operator==(const HatchLook&, const HatchLook&) = default;
};

struct Scene {
    std::int32_t width = 1280, height = 720;  ///< pixels
    int samples = 4;                          ///< rays per pixel
    Look look = Look::Plain;
    SceneCamera camera;
    std::optional<Vec3f> background;  ///< overrides the look's
    bool isTransparent = false;       ///< no background at all
    BorderLook lines;
    HatchLook hatches;
    std::optional<float> ambientOcclusion;
    std::vector<std::string> names;  ///< queries: labels with name tags beside the picture, see name_tags.hpp
    std::string colorBy;             ///< see color_by.hpp; with a legend. Empty: colours by style
    bool hasLegend = true;           ///< where there is colorBy
    std::string title;               ///< written into the picture; empty: none
    bool hasScaleBar = false;        ///< parallel cameras only
    bool hasNorthArrow = false;
    double explode = 0;  ///< metres by which storeys are drawn apart, see exploded.hpp
    std::optional<Sun> sun;
    std::vector<Inset> insets;
    std::vector<ScenePass> passes{ScenePass{}};
    std::optional<Motion> motion;

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// How the context of a lens or a highlight is drawn.
enum class Context : std::uint8_t {
    Ghost,  ///< translucent
    Solid,  ///< unchanged
    Shell,  ///< the outer hull of the building, as glass
    None
};
constexpr auto namesOf(Context) {
    return std::to_array<Name<Context>>(
        {{Context::Ghost, "ghost"}, {Context::Solid, "solid"}, {Context::Shell, "shell"}, {Context::None, "none"}});
}

/// Turns the scene's only pass into an S-Lens: inside `region` the model is drawn without what `cut` cuts away, in
/// front of the context (Ropinski and Hinrichs 2005; section 5.1 of the paper).
void addLens(Scene& scene, const std::string& region, const std::string& cut, Context context);
/// Turns the scene's only pass into a highlight of what the queries select, drawn over its context, whatever is in
/// front (section 5.2 of the paper).
void addHighlight(Scene& scene, const std::vector<std::string>& queries, Context context);
/// Cuts away what hides the selected labels, which are drawn in full.
/// \param margin  metres left free around them
void addCutaway(Scene& scene, const std::string& query, double margin);

/// The scene of an inset: that of the picture with the members that the inset gives instead. Size, camera, title, scale
/// bar, north arrow, names, legend, motion and further insets are its own, and the look of lines is the picture's.
/// \return the scene, of the inset's size, or an error of parseScene()
[[nodiscard]] Result<Scene> insetScene(const Scene& scene, const Inset& inset);

/// The forms that the passes of a scene draw, each once, in the order of first use. At least one.
[[nodiscard]] std::vector<VolumeForm> volumeForms(const Scene& scene);
/// The frame that shows `scene` on `volume`. Pass::volume is an index into volumeForms(scene).
/// \return the frame, which passes checkFrameSpec(), or BadSection, BadQuery, NothingSelected, BadCamera, BadFrame;
///         BadArgument if lines or meshes are requested and the volume was built without them, or for colorBy()
[[nodiscard]] Result<render::FrameSpec> makeFrameSpec(const Scene& scene, const volume::SemanticVolume& volume);
/// The same with existing rows, which must be those of volume.labels.
/// \param scale  set to what the colours mean, if the scene has colorBy
[[nodiscard]] Result<render::FrameSpec> makeFrameSpec(const Scene& scene, const volume::SemanticVolume& volume,
                                                      const analyze::LabelRows& rows, ColorScale* scale = nullptr);

/// Reads the JSON form.
/// \param name  of the file, for messages
/// \return the scene, or BadJson, or BadScene; the latter names the member (as a JSON path), what was found and what is
///         expected
[[nodiscard]] Result<Scene> parseScene(std::string_view json, const std::string& name = "scene");
/// Writes the JSON form. Equal scenes give equal bytes; members with default values are left out.
[[nodiscard]] std::string writeScene(const Scene& scene);

/// The JSON of a scene that has this camera and nothing else.
[[nodiscard]] std::string cameraJson(const SceneCamera& camera);

/// A plane of a scene's regions that is drawn elsewhere than it is written.
struct MovedPlane {
    std::string text;  ///< as written: "y<5.5"
    double by = 0;     ///< metres to the side that is kept
};
/// Those planes of a scene's cuts that lie in faces of the model, each once.
[[nodiscard]] std::vector<MovedPlane> planesInFaces(const Scene& scene, const volume::SemanticVolume& volume);

}  // namespace svt::illustrate
