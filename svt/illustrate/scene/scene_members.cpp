#include <svt/illustrate/scene_members.hpp>

#include <svt/core/check.hpp>
#include <svt/core/text.hpp>
#include <svt/illustrate/scene/scene_record.hpp>
#include <svt/image/color_text.hpp>
#include <svt/render/frame_spec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace svt::illustrate {
namespace {

using record::Choice, record::Codec, record::Faults, record::FormatName, record::FormatVersion, record::Json,
    record::Member, record::member, record::memberAs, record::memberOf, record::Members, record::PlainCodec,
    record::Written;

struct Color : record::TextOf<Vec3f, image::parseColor, image::colorText> {
    static constexpr void describe(Option& option) { option.value = "COLOR"; }
};

// Width and height.
struct PictureSize : PlainCodec<PictureSize, Scene> {
    using Numbers = Codec<std::array<std::int32_t, 2>>;
    static constexpr void describe(Option& option) { Numbers::describe(option); }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Scene& to) {
        std::array<std::int32_t, 2> size{};
        Numbers::read(faults, json, path, option, size);
        to.width = size[0];
        to.height = size[1];
    }
    static Json write(const Option& option, const Scene& from) {
        return Numbers::write(option, {from.width, from.height});
    }
};

// A JSON object kept as text: members of a scene that differ in it.
struct SceneText : PlainCodec<SceneText, std::string> {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) { option.kind = OptionKind::Object; }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option&, std::string& to) {
        if (!json.is_object()) return faults.add(path, "expected an object with members of a scene");
        to = json.dump();
    }
    static Json write(const Option&, const std::string& from) { return Json::parse(from, nullptr, false); }
};

constexpr std::string_view kColor = "#rrggbb, #rgb or a colour name";
constexpr std::string_view kSurfaces =
    "the source of the labels: the voxels, or the faces of the model, which are exact at any spacing, but take up to a "
    "few times as long";

void checkScene(Faults& faults, const std::string& path, const std::string& scene,
                std::span<const char* const> absent) {
    const Json json = Json::parse(scene, nullptr, false);
    for (const char* member : absent)
        if (json.contains(member)) faults.add(path + "/scene/" + member, "is that of the picture here; leave it out");
}

// "/passes/0/level" matches "/passes/*/level".
bool matches(std::string_view pattern, std::string_view pointer) noexcept {
    while (!pattern.empty() && !pointer.empty()) {
        if (pattern.front() == '*') {
            if (pointer.front() == '*')
                pointer.remove_prefix(1);
            else
                while (!pointer.empty() && isDigit(pointer.front())) pointer.remove_prefix(1);
        } else {
            if (pattern.front() != pointer.front()) return false;
            pointer.remove_prefix(1);
        }
        pattern.remove_prefix(1);
    }
    return pattern.empty() && pointer.empty();
}

}  // namespace

Members<SceneCamera> membersOf(const SceneCamera*) noexcept {
    static constexpr Member<SceneCamera> kMembers[] = {
        memberAs<Choice, &SceneCamera::preset>(
            "preset", "named view from which the picture is taken",
            {.choices = "iso|iso-se|iso-sw|iso-ne|iso-nw|front|back|left|right|top|bottom",
             .group = "View",
             .option = "--camera"}),
        member<&SceneCamera::around>("around", "fit the view to the selection of the query",
                                     {.value = "QUERY", .group = "View", .option = "--around"}),
        member<&SceneCamera::fit>("fit",
                                  "fit a named view to the visible parts, or always to the whole volume; all, if "
                                  "eye or target is given, or for a series of pictures",
                                  {.group = "View", .option = "--fit"}),
        member<&SceneCamera::isParallel>("parallel", "parallel projection", {.group = "View", .option = "--ortho"}),
        member<&SceneCamera::fieldOfView>(
            "fieldOfView", "vertical field of view",
            {.unit = "degrees", .least = 0.001, .most = 179.999, .group = "View", .option = "--fov"}),
        member<&SceneCamera::zoom>("zoom", "nearer (above 1) or farther than the preset",
                                   {.least = 0.01, .most = 100, .group = "View", .option = "--zoom"}),
        member<&SceneCamera::eye>(
            "eye", "position of the viewer, from the lower corner of the grid, in world axes",
            {.value = "X,Y,Z", .unit = "metres", .least = -1e9, .most = 1e9, .group = "View", .option = "--eye"}),
        member<&SceneCamera::target>(
            "target", "point in the centre of the picture, from the lower corner of the grid, in world axes",
            {.value = "X,Y,Z", .unit = "metres", .least = -1e9, .most = 1e9, .group = "View", .option = "--target"})};
    return kMembers;
}

Members<BorderLook> membersOf(const BorderLook*) noexcept {
    static constexpr Member<BorderLook> kMembers[] = {
        member<&BorderLook::strength>(
            "strength", "strength of lines between objects",
            {.least = 0, .most = 1, .otherwise = "by look", .group = "Style", .option = "--edges"}),
        member<&BorderLook::width>("width", "width of lines between objects",
                                   {.unit = "pixels",
                                    .least = 0,
                                    .most = double(render::BorderLines::kMaxWidth),
                                    .otherwise = "by look",
                                    .group = "Style",
                                    .option = "--line-width"}),
        member<&BorderLook::cutWidth>("cutWidth", "width of lines around cut faces",
                                      {.unit = "pixels",
                                       .least = 0,
                                       .most = double(render::BorderLines::kMaxWidth),
                                       .otherwise = "by look",
                                       .group = "Style",
                                       .option = "--cut-width"}),
        memberAs<Color, &BorderLook::color>("color", kColor, {.otherwise = "by look"})};
    return kMembers;
}

Members<HatchLook> membersOf(const HatchLook*) noexcept {
    static constexpr Member<HatchLook> kMembers[] = {
        member<&HatchLook::show>("show", "hatch cut faces, by material or class",
                                 {.otherwise = "paper and blueprint do so", .group = "Style", .option = "--hatch"}),
        member<&HatchLook::spacing>("spacing", "distance of hatch lines",
                                    {.unit = "metres",
                                     .least = 0.0001,
                                     .most = 10000,
                                     .otherwise = "the largest of 1, 2 or 5 times a power of ten within 11 pixels",
                                     .group = "Style",
                                     .option = "--hatch-spacing"})};
    return kMembers;
}

Members<Sun> membersOf(const Sun*) noexcept {
    static constexpr Member<Sun> kMembers[] = {
        member<&Sun::time>("time",
                           "date and hour of the sun, such as '2026-06-21 15:00'; with Z or +02:00 unless it is the "
                           "time of the meridian",
                           {.value = "TIME", .group = "Illustrate", .option = "--sun", .isRequired = true}),
        member<&Sun::place>("place", "latitude and longitude of the building",
                            {.value = "LAT,LON",
                             .unit = "degrees",
                             .least = -180,
                             .most = 180,
                             .otherwise = "that of the model",
                             .group = "Illustrate",
                             .option = "--place"}),
        member<&Sun::size>("size", "diameter of the sun: larger is softer",
                           {.unit = "degrees", .least = 0, .most = 20})};
    return kMembers;
}

Members<SceneField> membersOf(const SceneField*) noexcept {
    static constexpr Member<SceneField> kMembers[] = {
        member<&SceneField::name>("name",
                                  "colour cut faces and visible surfaces by this field of the volume, with a legend",
                                  {.value = "NAME", .group = "Illustrate", .option = "--field", .isRequired = true}),
        member<&SceneField::time>("time", "time of the field",
                                  {.unit = "seconds",
                                   .least = -1e12,
                                   .most = 1e12,
                                   .otherwise = "its first",
                                   .group = "Illustrate",
                                   .option = "--time"}),
        member<&SceneField::range>("range", "values of the field at the ends of the colour map",
                                   {.value = "A,B",
                                    .least = -1e12,
                                    .most = 1e12,
                                    .otherwise = "the least and the largest value of all times",
                                    .group = "Illustrate",
                                    .option = "--range"}),
        member<&SceneField::isolines>(
            "isolines", "draw lines of equal value of the field, this step apart, in its unit; 0: none",
            {.value = "STEP", .least = 0, .most = 1e12, .group = "Illustrate", .option = "--isolines"}),
        member<&SceneField::map>("map", "colour map of the field; vik is for values on both sides of a middle",
                                 {.group = "Illustrate", .option = "--map"}),
        member<&SceneField::per>("per",
                                 "colour each component by this figure of the field over its voxels, not by place",
                                 {.group = "Illustrate", .option = "--per"})};
    return kMembers;
}

Members<Inset> membersOf(const Inset*) noexcept {
    static constexpr Member<Inset> kMembers[] = {
        member<&Inset::corner>("corner", "corner of the picture that contains the inset"),
        member<&Inset::size>("size", "share of the picture's width and height", {.least = 0.05, .most = 0.5}),
        member<&Inset::title>("title", "write a title into the inset", {.value = "TEXT"}),
        member<&Inset::hasMark>("mark", "frame the part of the picture that the inset shows, with lines to it"),
        memberAs<SceneText, &Inset::scene>("scene", "its camera, and members of the scene that differ in it", {},
                                           Written::Always)};
    return kMembers;
}

Members<Motion::Key> membersOf(const Motion::Key*) noexcept {
    static constexpr Member<Motion::Key> kMembers[] = {
        member<&Motion::Key::at>("at", "the time, after that of the previous key",
                                 {.unit = "seconds", .least = 0, .most = 3600, .isRequired = true}),
        memberAs<SceneText, &Motion::Key::scene>("scene", "values of members of the scene at this time",
                                                 {.isRequired = true})};
    return kMembers;
}

Members<Motion> membersOf(const Motion*) noexcept {
    static constexpr Member<Motion> kMembers[] = {
        member<&Motion::seconds>(
            "seconds", "duration of the motion",
            {.unit = "seconds", .least = 0.01, .most = 3600, .group = "Motion", .option = "--seconds"}),
        member<&Motion::rate>("rate", "pictures per second of a film",
                              {.least = 1, .most = 120, .group = "Motion", .option = "--rate"}),
        member<&Motion::turn>(
            "turn",
            "angle by which the camera orbits the model, counter-clockwise from above, evenly; 360: once "
            "around",
            {.unit = "degrees", .least = -36000, .most = 36000, .group = "Motion", .option = "--turn"}),
        member<&Motion::pace>("pace", "change of values from key to key: smooth at both ends, or even"),
        member<&Motion::keys>("keys",
                              "the scene at some times; numbers, points, colours and the numbers of regions are "
                              "interpolated between them")};
    return kMembers;
}

Members<SceneStyle> membersOf(const SceneStyle*) noexcept {
    static constexpr Member<SceneStyle> kMembers[] = {
        member<&SceneStyle::select>("select", "labels that get the style", {.value = "QUERY", .isRequired = true}),
        member<&SceneStyle::isGhost>("ghost", "draw solid labels as coloured air, and hide air"),
        memberAs<Color, &SceneStyle::color>("color", kColor),
        member<&SceneStyle::opacity>("opacity", "share of light stopped by 1 m; 1: solid, 0: hidden",
                                     {.least = 0, .most = 1}),
        member<&SceneStyle::hatch>("hatch", "hatch of cut faces")};
    return kMembers;
}

Members<SceneLines> membersOf(const SceneLines*) noexcept {
    static constexpr Member<SceneLines> kMembers[] = {
        member<&SceneLines::select>("select", "labels whose edges are drawn, visible or not",
                                    {.value = "QUERY", .otherwise = "all visible labels"}),
        member<&SceneLines::width>("width", "width of the lines", {.unit = "pixels", .least = 0.1, .most = 64}),
        memberAs<Color, &SceneLines::color>("color", kColor, {.otherwise = "by look"}),
        member<&SceneLines::hidden>("hidden", "lines behind opaque objects")};
    return kMembers;
}

Members<ScenePass> membersOf(const ScenePass*) noexcept {
    static constexpr Member<ScenePass> kMembers[] = {
        member<&ScenePass::show>("show", "show only the selection of the query",
                                 {.value = "QUERY", .group = "Style", .option = "--show"}),
        member<&ScenePass::hide>("hide", "hide the selection of the query",
                                 {.value = "QUERY", .group = "Style", .option = "--hide"}),
        member<&ScenePass::styles>("styles", "styles of labels; later ones override earlier ones"),
        member<&ScenePass::cut>("cut", "cut away a region, such as 'z>1.2 and not box(2,2,0,4,4,3)'",
                                {.value = "REGION"}),
        member<&ScenePass::keep>("keep", "draw nothing outside of a region, such as storey(Attic)",
                                 {.value = "REGION", .group = "Cut", .option = "--keep"}),
        member<&ScenePass::join>("join",
                                 "over: in front of earlier passes; replace: removes earlier passes wherever it draws; "
                                 "depth: the nearer pass is in front"),
        member<&ScenePass::representation, &VolumeRepresentation::shell>(
            "shell", "draw only the hulls of components, rooms, units, storeys or the building",
            {.group = "Illustrate", .option = "--shell"}),
        member<&ScenePass::representation, &VolumeRepresentation::level>(
            "level", "level of detail, 0 is the finest",
            {.least = 0, .most = 6, .otherwise = "as fine as the pixels show"}),
        member<&ScenePass::lines>("lines", "feature edges of the model's meshes, at their depth inside the volume"),
        member<&ScenePass::meshes>("meshes",
                                   "draw the selection of the query as meshes, not as voxels; size<M: all objects "
                                   "shorter than M metres along each axis",
                                   {.value = "QUERY", .group = "Lines", .option = "--vectors"}),
        member<&ScenePass::representation, &VolumeRepresentation::hasCells>("cells",
                                                                            "draw each voxel as a box with edges")};
    return kMembers;
}

Members<Scene> membersOf(const Scene*) noexcept {
    static constexpr Member<Scene> kMembers[] = {
        memberOf<Scene, FormatName<Scene>>("format", "identifies a scene", {.choices = "svt-scene"}),
        memberOf<Scene, FormatVersion<Scene>>("version", "version of the format", {.least = 1, .most = 1}),
        memberOf<Scene, PictureSize>("size", "width and height",
                                     {.unit = "pixels", .least = 1, .most = render::FrameSpec::kMaxSize}),
        member<&Scene::samples>("samples", "rays per pixel",
                                {.least = 1,
                                 .most = double(render::BorderLines::kMaxWidth),
                                 .choices = "1|4|9|16",
                                 .group = "View",
                                 .option = "--samples"}),
        member<&Scene::surfaces>(
            "surfaces", kSurfaces,
            {.otherwise = "exact, if the model has meshes", .group = "Style", .option = "--surfaces"}),
        member<&Scene::look>(
            "look",
            "colours, lines and hatches of the whole picture: plain, paper (for print), blueprint or dark (for slides)",
            {.group = "Style", .option = "--look"}),
        member<&Scene::title>("title", "write a title into the picture",
                              {.value = "TEXT", .group = "Illustrate", .option = "--title"}),
        member<&Scene::hasScaleBar>("scaleBar",
                                    "draw a scale bar; parallel projection only, because no other picture has a single "
                                    "scale",
                                    {.group = "Illustrate", .option = "--scale-bar"}),
        member<&Scene::hasNorthArrow>("northArrow", "draw an arrow to true north",
                                      {.group = "Illustrate", .option = "--north-arrow"}),
        member<&Scene::colorBy>("colorBy",
                                "colour visible components by class, name, storey, volume, area of rooms, owner, "
                                "voxels or an attribute, with a legend",
                                {.value = "KEY", .group = "Illustrate", .option = "--color-by"}),
        member<&Scene::field>("field", "a field of the volume as colours of surfaces"),
        member<&Scene::hasLegend>("legend", "draw a legend for the colours of colorBy or of a field"),
        member<&Scene::explode>("explode", "draw the storeys apart, with this vertical gap between them",
                                {.value = "DISTANCE",
                                 .unit = "metres",
                                 .least = 0,
                                 .most = 1000,
                                 .group = "Illustrate",
                                 .option = "--explode"}),
        member<&Scene::sun>("sun", "light by the sun, with shadows"),
        member<&Scene::insets>("insets", "small pictures in the corners of the picture", {.least = 0, .most = 4}),
        member<&Scene::camera>("camera", "position and view direction of the picture"),
        memberAs<Color, &Scene::background>("background", kColor,
                                            {.otherwise = "by look", .group = "Style", .option = "--background"}),
        member<&Scene::isTransparent>("transparent", "leave the background transparent",
                                      {.group = "Style", .option = "--transparent"}),
        member<&Scene::lines>("lines", "lines between objects, and at jumps of the depth"),
        member<&Scene::hatches>("hatches", "hatches of cut faces"),
        member<&Scene::ambientOcclusion>("ambientOcclusion", "strength of the darkening in corners",
                                         {.least = 0, .most = 1, .byDefault = "0.6"}),
        member<&Scene::names>("names",
                              "name the visible labels that the query selects: inside them if the text fits, "
                              "otherwise at the sides of the picture, with leader lines",
                              {.value = "QUERY", .group = "Illustrate", .option = "--names"}),
        member<&Scene::passes>("passes", "passes, drawn one after the other",
                               {.least = 1, .most = double(render::FrameSpec::kMaxPasses)}, Written::Always),
        member<&Scene::motion>("motion", "changes of the scene with time, for films")};
    return kMembers;
}

void checkMembers(Faults& faults, const std::string& path, const SceneField& field) {
    if (field.range && !((*field.range)[0] < (*field.range)[1]))
        faults.add(path + "/range", "expected a first value below the second");
}

void checkMembers(Faults& faults, const std::string& path, const Inset& inset) {
    static constexpr const char* kAbsent[] = {"size", "motion", "insets"};
    checkScene(faults, path, inset.scene, kAbsent);
}

void checkMembers(Faults& faults, const std::string& path, const Motion::Key& key) {
    static constexpr const char* kAbsent[] = {"size", "motion"};
    checkScene(faults, path, key.scene, kAbsent);
}

void checkMembers(Faults& faults, const std::string& path, const Motion& motion) {
    for (std::size_t n = 1; n < motion.keys.size(); ++n)
        if (motion.keys[n].at <= motion.keys[n - 1].at)
            return faults.add(fmt::format("{}/keys/{}/at", path, n),
                              "expected a later time than that of the previous key");
    if (!motion.keys.empty() && motion.keys.back().at > motion.seconds)
        faults.add(path + "/keys", fmt::format("the last key is at {} s, after the end of the motion at {} s; change "
                                               "\"seconds\"",
                                               motion.keys.back().at, motion.seconds));
}

std::span<const Option> sceneMembers() noexcept { return record::declared<Scene>(); }

const Option* findSceneMember(std::string_view pointer) {
    for (const Option& member : sceneMembers()) {
        const std::size_t slash = pointer.rfind('/');
        const bool isOneValue = member.count > 1 && matches(member.name, pointer.substr(0, slash));
        if (isOneValue || matches(member.name, pointer)) return &member;
    }
    return nullptr;
}

const Option& sceneMember(std::string_view pointer) {
    const Option* found = findSceneMember(pointer);
    SVT_CHECK(found != nullptr);
    return *found;
}

Result<void> setSceneMember(Scene& scene, const GivenMember& given) {
    Faults faults;
    record::setMember(faults, given.member, Json::parse(given.value, nullptr, false), "", scene);
    if (faults.isFine()) return {};
    std::string_view member = given.member;
    if (member.ends_with("/-")) member.remove_suffix(2);
    return faults.error(Code::BadArgument, fmt::format("{}: ", sceneMember(member).option));
}

}  // namespace svt::illustrate
