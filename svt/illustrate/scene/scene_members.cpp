#include <svt/illustrate/scene_members.hpp>

#include <svt/core/check.hpp>
#include <svt/core/text.hpp>
#include <svt/render/frame_spec.hpp>

#include <algorithm>
#include <iterator>

namespace svt::illustrate {
namespace {

using enum OptionKind;

constexpr std::string_view kColor = "#rrggbb, #rgb or a colour name";
constexpr std::string_view kHatches =
    "none|masonry|concrete|reinforced-concrete|timber|insulation|earth|steel|glass|general";

constexpr Option kMembers[] = {
    {.name = "/format", .choices = "svt-scene", .help = "says that this is a scene"},
    {.name = "/version", .kind = Whole, .least = 1, .most = 1, .help = "version of the format"},
    {.name = "/size",
     .kind = Whole,
     .unit = "pixels",
     .least = 1,
     .most = render::FrameSpec::kMaxSize,
     .byDefault = "1280,720",
     .help = "width and height",
     .count = 2,
     .leastCount = 2},
    {.name = "/samples",
     .kind = Whole,
     .least = 1,
     .most = double(render::BorderLines::kMaxWidth),
     .choices = "1|4|9|16",
     .byDefault = "4",
     .help = "rays per pixel"},
    {.name = "/look",
     .choices = "plain|paper|blueprint|dark",
     .byDefault = "plain",
     .help =
         "colours, lines and hatches of the whole picture: plain, paper (for print), blueprint or dark (for slides)"},
    {.name = "/camera", .kind = Object, .help = "where the picture is taken from"},
    {.name = "/camera/preset",
     .choices = "iso|iso-se|iso-sw|iso-ne|iso-nw|front|back|left|right|top|bottom",
     .byDefault = "iso",
     .help = "a named view"},
    {.name = "/camera/around", .value = "QUERY", .help = "the view shows what the query selects, as large as it fits"},
    {.name = "/camera/fit",
     .choices = "visible|all",
     .byDefault = "visible",
     .help = "a named view shows what is visible as large as possible, or always the whole volume; where eye or "
             "target is given, or pictures are a series, all"},
    {.name = "/camera/parallel", .kind = Flag, .byDefault = "false", .help = "parallel projection"},
    {.name = "/camera/fieldOfView",
     .kind = Number,
     .unit = "degrees",
     .least = 0.001,
     .most = 179.999,
     .byDefault = "30",
     .help = "vertical field of view"},
    {.name = "/camera/zoom",
     .kind = Number,
     .least = 0.01,
     .most = 100,
     .byDefault = "1",
     .help = "nearer (above 1) or further than the preset"},
    {.name = "/camera/eye",
     .kind = Number,
     .unit = "metres",
     .least = -1e9,
     .most = 1e9,
     .help = "where the viewer stands, from the lower corner of the grid, in world axes",
     .count = 3,
     .leastCount = 3},
    {.name = "/camera/target",
     .kind = Number,
     .unit = "metres",
     .least = -1e9,
     .most = 1e9,
     .help = "what stands in the middle of the picture, from the lower corner of the grid, in world axes",
     .count = 3,
     .leastCount = 3},
    {.name = "/background", .value = "COLOR", .otherwise = "by look", .help = kColor},
    {.name = "/transparent", .kind = Flag, .byDefault = "false", .help = "leave the background transparent"},
    {.name = "/lines", .kind = Object, .help = "lines between objects, and where the depth jumps"},
    {.name = "/lines/strength",
     .kind = Number,
     .least = 0,
     .most = 1,
     .otherwise = "by look",
     .help = "strength of lines between objects"},
    {.name = "/lines/width",
     .kind = Number,
     .unit = "pixels",
     .least = 0,
     .most = double(render::BorderLines::kMaxWidth),
     .otherwise = "by look",
     .help = "width of lines between objects"},
    {.name = "/lines/cutWidth",
     .kind = Number,
     .unit = "pixels",
     .least = 0,
     .most = double(render::BorderLines::kMaxWidth),
     .otherwise = "by look",
     .help = "width of lines around what is cut"},
    {.name = "/lines/color", .value = "COLOR", .otherwise = "by look", .help = kColor},
    {.name = "/hatches", .kind = Object, .help = "hatches of what is cut"},
    {.name = "/hatches/show",
     .kind = Flag,
     .otherwise = "paper and blueprint do so",
     .help = "hatch what is cut, by material or class"},
    {.name = "/hatches/spacing",
     .kind = Number,
     .unit = "metres",
     .least = 0.0001,
     .most = 10000,
     .otherwise = "the largest of 1, 2 or 5 times a power of ten within 11 pixels",
     .help = "distance of hatch lines"},
    {.name = "/ambientOcclusion",
     .kind = Number,
     .least = 0,
     .most = 1,
     .byDefault = "0.6",
     .help = "how much corners are darkened"},
    {.name = "/names",
     .value = "QUERY",
     .help = "name what is seen of the selected: inside it where the text fits, else at the sides of the picture, with "
             "leader "
             "lines",
     .mayRepeat = true},
    {.name = "/title", .value = "TEXT", .help = "write a title into the picture"},
    {.name = "/scaleBar",
     .kind = Flag,
     .byDefault = "false",
     .help = "draw a scale bar; parallel projection only, since no other picture has one scale"},
    {.name = "/northArrow", .kind = Flag, .byDefault = "false", .help = "draw an arrow to grid north (+y)"},
    {.name = "/colorBy",
     .value = "KEY",
     .help = "colour what is seen by class, name, storey, volume, area of rooms, owner, voxels or an attribute, with a "
             "legend"},
    {.name = "/legend", .kind = Flag, .byDefault = "true", .help = "draw what the colours of colorBy mean"},
    {.name = "/explode",
     .kind = Number,
     .unit = "metres",
     .least = 0,
     .most = 1000,
     .byDefault = "0",
     .help = "draw the storeys apart, each so much higher above the one below"},
    {.name = "/sun", .kind = Object, .help = "light by the sun, with shadows"},
    {.name = "/sun/time",
     .value = "TIME",
     .help = "date and hour of the sun, such as '2026-06-21 15:00', with Z or +02:00 where it is not the time of the "
             "meridian",
     .isRequired = true},
    {.name = "/sun/place",
     .kind = Number,
     .unit = "degrees",
     .least = -180,
     .most = 180,
     .otherwise = "that of the model",
     .help = "latitude and longitude of the building",
     .count = 2,
     .leastCount = 2},
    {.name = "/sun/size",
     .kind = Number,
     .unit = "degrees",
     .least = 0,
     .most = 20,
     .byDefault = "0.53",
     .help = "diameter of the sun: larger is softer"},
    {.name = "/insets", .kind = List, .least = 0, .most = 4, .help = "small pictures in the corners of the picture"},
    {.name = "/insets/*/corner",
     .choices = "top-right|bottom-right|top-left|bottom-left",
     .byDefault = "top-right",
     .help = "corner of the picture in which it stands"},
    {.name = "/insets/*/size",
     .kind = Number,
     .least = 0.05,
     .most = 0.5,
     .byDefault = "0.3",
     .help = "share of the picture's width and height"},
    {.name = "/insets/*/title", .value = "TEXT", .help = "write a title into the inset"},
    {.name = "/insets/*/mark",
     .kind = Flag,
     .byDefault = "true",
     .help = "frame in the picture what the inset shows, with lines to it"},
    {.name = "/insets/*/scene", .kind = Object, .help = "its camera, and members of the scene that are others in it"},
    {.name = "/motion", .kind = Object, .help = "how the scene changes with time, for films"},
    {.name = "/motion/seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.01,
     .most = 3600,
     .byDefault = "6",
     .help = "how long it lasts"},
    {.name = "/motion/rate", .kind = Whole, .least = 1, .most = 120, .byDefault = "25", .help = "pictures a second"},
    {.name = "/motion/turn",
     .kind = Number,
     .unit = "degrees",
     .least = -36000,
     .most = 36000,
     .byDefault = "0",
     .help = "how far the camera goes around, counter-clockwise from above, evenly; 360: once"},
    {.name = "/motion/pace",
     .choices = "smooth|even",
     .byDefault = "smooth",
     .help = "how values go from key to key: gently at both ends, or evenly"},
    {.name = "/motion/keys",
     .kind = List,
     .help = "what the scene is at some times; between them, numbers, points, "
             "colours and the numbers of regions go from one to the next"},
    {.name = "/motion/keys/*/at",
     .kind = Number,
     .unit = "seconds",
     .least = 0,
     .most = 3600,
     .help = "the time, after that of the key before",
     .isRequired = true},
    {.name = "/motion/keys/*/scene",
     .kind = Object,
     .help = "members of the scene that have these values then",
     .isRequired = true},
    {.name = "/passes",
     .kind = List,
     .least = 1,
     .most = double(render::FrameSpec::kMaxPasses),
     .help = "passes, drawn one after the other"},
    {.name = "/passes/*/show", .value = "QUERY", .help = "show only what the query selects", .mayRepeat = true},
    {.name = "/passes/*/hide", .value = "QUERY", .help = "hide what the query selects", .mayRepeat = true},
    {.name = "/passes/*/styles", .kind = List, .help = "what is given overrides the styles before it"},
    {.name = "/passes/*/styles/*/select", .value = "QUERY", .help = "what the style is for", .isRequired = true},
    {.name = "/passes/*/styles/*/ghost",
     .kind = Flag,
     .byDefault = "false",
     .help = "coloured air where it was solid, gone where it was air"},
    {.name = "/passes/*/styles/*/color", .value = "COLOR", .help = kColor},
    {.name = "/passes/*/styles/*/opacity",
     .kind = Number,
     .least = 0,
     .most = 1,
     .help = "share of light stopped by 1 m; 1: solid, 0: hidden"},
    {.name = "/passes/*/styles/*/hatch", .choices = kHatches, .help = "hatch of what is cut"},
    {.name = "/passes/*/cut", .value = "REGION", .help = "cut away a region, such as 'z>1.2 and not box(2,2,0,4,4,3)'"},
    {.name = "/passes/*/keep", .value = "REGION", .help = "draw nothing outside of a region, such as storey(Attic)"},
    {.name = "/passes/*/join",
     .choices = "over|replace|depth",
     .byDefault = "over",
     .help = "over: in front of what is drawn already; replace: where anything is drawn, all before it is dropped; "
             "depth: whichever is nearer in front"},
    {.name = "/passes/*/shell",
     .choices = "component|room|unit|storey|building",
     .help = "draw only the hulls of components, rooms, units, storeys or the building"},
    {.name = "/passes/*/level",
     .kind = Whole,
     .least = 0,
     .most = 6,
     .otherwise = "as fine as the pixels show",
     .help = "level of detail, 0 is the finest"},
    {.name = "/passes/*/cells", .kind = Flag, .byDefault = "false", .help = "draw each voxel as a box with edges"},
    {.name = "/passes/*/lines",
     .kind = List,
     .help = "feature edges of the model's meshes, at their depth inside the volume"},
    {.name = "/passes/*/lines/*/select",
     .value = "QUERY",
     .otherwise = "all that is visible",
     .help = "what the edges belong to, visible or not"},
    {.name = "/passes/*/lines/*/width",
     .kind = Number,
     .unit = "pixels",
     .least = 0.1,
     .most = 64,
     .byDefault = "1",
     .help = "width of the lines"},
    {.name = "/passes/*/lines/*/color", .value = "COLOR", .otherwise = "by look", .help = kColor},
    {.name = "/passes/*/lines/*/hidden",
     .choices = "faint|dashed|none",
     .byDefault = "faint",
     .help = "lines behind something opaque"},
    {.name = "/passes/*/meshes",
     .value = "QUERY",
     .help = "draw what the query selects as meshes, not as voxels; size<M: all that is shorter than M metres along "
             "each axis",
     .mayRepeat = true},
};

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

std::span<const Option> sceneMembers() noexcept { return kMembers; }

const Option& sceneMember(std::string_view pointer) {
    const auto found = std::find_if(std::begin(kMembers), std::end(kMembers),
                                    [&](const Option& m) { return matches(m.name, pointer); });
    SVT_CHECK(found != std::end(kMembers));
    return *found;
}

std::vector<std::string_view> sceneMembersOf(std::string_view pointer) {
    std::vector<std::string_view> names;
    for (const Option& member : kMembers) {
        const std::size_t slash = member.name.rfind('/');
        if (matches(member.name.substr(0, slash), pointer) && member.name.substr(slash + 1) != "*")
            names.push_back(member.name.substr(slash + 1));
    }
    return names;
}

}  // namespace svt::illustrate
