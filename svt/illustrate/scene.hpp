#pragma once
/// \file
/// A scene: the contents of a picture, described by queries and regions, so that it applies to any volume of the model.
/// Plain data with a JSON representation (`*.scene.json`, docs/formats/scene.schema.json), made by the command line or
/// by a link to the viewer.

#include <svt/analyze/selection.hpp>
#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/illustrate/color_by.hpp>
#include <svt/illustrate/shell_groups.hpp>
#include <svt/image/color_map.hpp>
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
    Visible,  ///< the parts that the passes draw, without hidden and removed parts
    All       ///< the whole volume, so that pictures of several scenes have one camera
};
constexpr auto namesOf(Fit) { return std::to_array<Name<Fit>>({{Fit::Visible, "visible"}, {Fit::All, "all"}}); }

/// The camera of a scene: a named view, and members that override it. Points are in metres from the grid's lower
/// corner, along world axes.
struct SceneCamera {
    std::string preset = "iso";  ///< see render::cameraPresetNames()
    std::string around;          ///< query: the view is fitted to its selection; empty: see `fit`
    Fit fit = Fit::Visible;      ///< always All if eye or target is set
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
    std::string select;  ///< query: edges of these labels, visible or not; empty: of all visible labels
    float width = 1;     ///< pixels, 0.1 to 64
    std::optional<Vec3f> color;
    render::HiddenLines hidden = render::HiddenLines::Faint;  ///< style of parts behind opaque objects
    friend bool operator==(const SceneLines&, const SceneLines&) = default;
};

/// The source of the labels of a picture.
enum class SurfaceSource : std::uint8_t {
    Voxels,
    Exact  ///< the faces of the model (render::FaceModel), and voxels for features without closed mesh
};
constexpr auto namesOf(SurfaceSource) {
    return std::to_array<Name<SurfaceSource>>({{SurfaceSource::Voxels, "voxels"}, {SurfaceSource::Exact, "exact"}});
}

/// The representation of the volume that a pass draws.
struct VolumeRepresentation {
    std::optional<ShellLevel> shell;  ///< the hulls of groups of this level, two voxels thick; unset: the volume
    std::optional<int> level;         ///< level of detail, 0 (finest) to 6; unset: selected by the pixel size
    bool hasCells = false;            ///< each voxel, or cell of a level, is drawn as a box with edges
    friend bool operator==(const VolumeRepresentation&, const VolumeRepresentation&) = default;
};

/// A pass: a part of the volume, and its style.
struct ScenePass {
    /// Queries; if not empty, all other labels are hidden. If empty, rooms and other spaces are hidden, unless a style
    /// or a query of Scene::names selects only spaces, or nothing else is drawn.
    std::vector<std::string> show;
    std::vector<std::string> hide;  ///< queries
    std::vector<SceneStyle> styles;
    std::string cut;   ///< region to cut away; empty: none
    std::string keep;  ///< region to which drawing is limited; empty: no limit
    render::Pass::Join join = render::Pass::Join::Over;
    std::vector<SceneLines> lines;
    VolumeRepresentation representation{};
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

/// The changes of a scene with time, see motion.hpp.
struct Motion {
    /// The interpolation from key to key.
    enum class Pace : std::uint8_t { Smooth, Even };
    friend constexpr auto namesOf(Pace) {
        return std::to_array<Name<Pace>>({{Pace::Smooth, "smooth"}, {Pace::Even, "even"}});
    }
    struct Key {
        double at = 0;      ///< seconds
        std::string scene;  ///< JSON object: the values of members of the scene at this time
        friend bool operator==(const Key&, const Key&) = default;
    };

    double seconds = 6;
    int rate = 25;    ///< pictures per second
    double turn = 0;  ///< angle of the camera's orbit during the motion, degrees, counter-clockwise from above
    Pace pace = Pace::Smooth;
    std::vector<Key> keys;  ///< times ascend
    friend bool operator==(const Motion&, const Motion&) = default;
};

/// A small picture in a corner of the picture, and a frame in the picture around the part that it shows.
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
    bool hasMark = true;       ///< the frame around the part that it shows, and lines to it
    std::string scene = "{}";  ///< JSON object: members that differ from the picture's, see insetScene()
    friend bool operator==(const Inset&, const Inset&) = default;
};

/// The position of the sun, which is the key light and casts shadows. See sun.hpp.
struct Sun {
    std::string time;  ///< "2026-06-21 15:00", with "Z" or "+02:00" unless it is the zone of the meridian
    std::optional<std::array<double, 2>> place;  ///< latitude and longitude, degrees; unset: of the model
    double size = 0.53;                          ///< diameter of its disc in degrees, 0 to 20; larger is softer
    friend bool operator==(const Sun&, const Sun&) = default;
};

/// Lines between objects and at jumps of the depth. Members that are set override the look's.
struct BorderLook {
    std::optional<float> strength, width, cutWidth;  ///< 0..1; pixels; pixels, around cut faces
    std::optional<Vec3f> color;
    friend bool operator==(const BorderLook&, const BorderLook&) = default;
};

/// Hatches of cut faces. Members that are set override the look's.
struct HatchLook {
    std::optional<bool> show;
    std::optional<double> spacing;  ///< metres; unset: the largest 1, 2 or 5 * 10^n m within 11 pixels (4.4 to 11)
    friend bool operator==(const HatchLook&, const HatchLook&) = default;
};

/// A figure of a field over the voxels of a component.
enum class FieldFigure : std::uint8_t { Mean, Max, Min };
constexpr auto namesOf(FieldFigure) {
    return std::to_array<Name<FieldFigure>>(
        {{FieldFigure::Mean, "mean"}, {FieldFigure::Max, "max"}, {FieldFigure::Min, "min"}});
}

/// A field of the volume (svt/fields) as the colours of opaque surfaces and cut faces.
struct SceneField {
    std::string name;
    std::optional<double> time;  ///< seconds, within the times of the field; unset: the first
    std::optional<std::array<double, 2>>
        range;            ///< values of the ends of the map; unset: the least and largest of all times
    double isolines = 0;  ///< step between lines of equal value, in the unit of the field; 0: none
    image::ColorMap map = image::ColorMap::Viridis;
    std::optional<FieldFigure>
        per;  ///< each component has one colour, by this figure of its own voxels; unset: by place
    friend bool operator==(const SceneField&, const SceneField&) = default;
};

struct Scene {
    std::int32_t width = 1280, height = 720;  ///< pixels
    int samples = 4;                          ///< rays per pixel
    std::optional<SurfaceSource> surfaces;    ///< unset: see drawsFaces()
    Look look = Look::Plain;
    SceneCamera camera;
    std::optional<Vec3f> background;  ///< overrides the look's
    bool isTransparent = false;       ///< without any background
    BorderLook lines;
    HatchLook hatches;
    std::optional<float> ambientOcclusion;
    std::vector<std::string> names;   ///< queries: labels with name tags beside the picture, see name_tags.hpp
    std::string colorBy;              ///< key, see color_by.hpp; adds a legend; empty: colours by style
    std::optional<SceneField> field;  ///< a ScenePainter draws it, see showField(); adds a legend
    bool hasLegend = true;            ///< if colorBy or a field is set
    std::string title;                ///< drawn into the picture; empty: none
    bool hasScaleBar = false;         ///< parallel cameras only
    bool hasNorthArrow = false;
    double explode = 0;  ///< distance between storeys drawn apart, metres, see exploded.hpp
    std::optional<Sun> sun;
    std::vector<Inset> insets;
    std::vector<ScenePass> passes{ScenePass{}};
    std::optional<Motion> motion;

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// The style of the context of a lens or a highlight.
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

/// Turns the scene's only pass into an S-Lens: inside `region` the model is drawn without the region `cut`, in front of
/// the context (Ropinski and Hinrichs 2005; section 5.1 of the paper).
void addLens(Scene& scene, const std::string& region, const std::string& cut, Context context);
/// Turns the scene's only pass into a highlight of the labels that the queries select. They are drawn over the context,
/// even behind other parts (section 5.2 of the paper).
void addHighlight(Scene& scene, const std::vector<std::string>& queries, Context context);
/// Cuts away everything that hides the selected labels. The selected labels are drawn completely.
/// \param margin  metres left free around them
void addCutaway(Scene& scene, const std::string& query, double margin);

/// The scene of an inset: the scene of the picture, overridden by members of the inset. Size, camera, title, scale bar,
/// north arrow, names, legend, motion and further insets are not inherited. All other members are inherited, such as
/// the look of lines.
/// \return the scene, of the inset's size, or an error of parseScene()
[[nodiscard]] Result<Scene> insetScene(const Scene& scene, const Inset& inset);

/// The representations that the passes of a scene draw, each once, in the order of first use. At least one.
[[nodiscard]] std::vector<VolumeRepresentation> volumeRepresentations(const Scene& scene);
/// The frame of `scene` on `volume`. Pass::volume is an index into volumeRepresentations(scene).
/// \return the frame, which passes checkFrameSpec(), or BadSection, BadQuery, NothingSelected, BadCamera, BadFrame;
///         BadArgument if lines or meshes are requested and the volume was built without them, or for colorBy(). A scene
///         with a field is BadArgument: only a ScenePainter draws it.
[[nodiscard]] Result<render::FrameSpec> makeFrameSpec(const Scene& scene, const volume::SemanticVolume& volume);
/// The same with existing rows, which must be those of volume.labels.
/// \param scale  receives the meaning of the colours if the scene has colorBy
[[nodiscard]] Result<render::FrameSpec> makeFrameSpec(const Scene& scene, const volume::SemanticVolume& volume,
                                                      const analyze::LabelRows& rows, ColorScale* scale = nullptr);

/// Reads the JSON representation.
/// \param name  name of the file, for messages
/// \return the scene, or BadJson, or BadScene with the member (as a JSON path), the found and the expected value
[[nodiscard]] Result<Scene> parseScene(std::string_view json, const std::string& name = "scene");
/// Writes the JSON representation. Equal scenes give equal bytes; members with default values are omitted.
[[nodiscard]] std::string writeScene(const Scene& scene);

/// The JSON of a scene that has only this camera.
[[nodiscard]] std::string cameraJson(const SceneCamera& camera);

/// A plane of a scene's regions that is moved for drawing.
struct MovedPlane {
    std::string text;  ///< as written: "y<5.5"
    double by = 0;     ///< metres to the side that is kept
};
/// The planes of a scene's cuts that lie in faces of the model, each once.
[[nodiscard]] std::vector<MovedPlane> planesInFaces(const Scene& scene, const volume::SemanticVolume& volume);

}  // namespace svt::illustrate
