#include <svt/frontend/scene_options.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/frontend/option_set.hpp>
#include <svt/illustrate/motion.hpp>
#include <svt/image/color_text.hpp>
#include <svt/render/camera_presets.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace svt::frontend {
namespace {

using illustrate::Scene;
using record::Faults, record::Json, record::member;

constexpr int kUsualDpi = 300;

// The members of a scene that options set. They are stored as given, because the scene is read later.
struct GivenMembers {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) { option.kind = OptionKind::Object; }
    static void read(Faults&, const Json&, const std::string&, const Option&, std::vector<illustrate::GivenMember>&) {}
    static Json write(const Option&, const std::vector<illustrate::GivenMember>&) { return {}; }
    static void set(Faults&, std::string_view rest, const Json& json, const std::string&, const Option&,
                    std::vector<illustrate::GivenMember>& to) {
        to.push_back({std::string(rest), json.dump(-1, ' ', false, Json::error_handler_t::replace)});
    }
    static void list(const std::string& pointer, std::deque<std::string>& texts, std::vector<Option>& all) {
        for (const Option& member : illustrate::sceneMembers())
            if (!member.option.empty())
                all.push_back({.name = texts.emplace_back(pointer + std::string(member.name)),
                               .group = member.group,
                               .option = member.option,
                               .member = member.name,
                               .like = member.name});
    }
};

// Splits "query:value" at the last colon (or equals sign) that is followed by a value.
Result<std::pair<std::string, std::string>> splitValue(const std::string& text, std::string_view option,
                                                       std::string_view example) {
    std::size_t at = text.rfind(':');
    if (at == std::string::npos) at = text.rfind('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
        return Error(Code::BadArgument,
                     fmt::format("{} '{}': expected a query, a colon and a value, such as {}", option, text, example));
    return std::pair(text.substr(0, at), text.substr(at + 1));
}

bool isMetric(const std::string& size) { return size.size() > 2 && size.compare(size.size() - 2, 2, "mm") == 0; }

// "1280x720" pixels, or "160x90mm" at `dpi`.
Result<void> parseSize(const std::string& text, int dpi, Scene& scene) {
    const auto bad = [&] {
        return Error(Code::BadFrame,
                     fmt::format("--size '{}': expected pixels such as 1280x720, or 160x90mm for print", text));
    };
    const bool inPrint = isMetric(text);
    const std::string numbers = inPrint ? text.substr(0, text.size() - 2) : text;
    const std::size_t at = numbers.find_first_of("xX,");
    if (at == std::string::npos) return bad();
    const auto across = parseNumber(withoutBlanks(std::string_view(numbers).substr(0, at)));
    const auto down = parseNumber(withoutBlanks(std::string_view(numbers).substr(at + 1)));
    if (!across || !down) return bad();
    const double width = inPrint ? std::round(*across * dpi / 25.4) : *across;
    const double height = inPrint ? std::round(*down * dpi / 25.4) : *down;
    const auto inRange = [](double v) { return v >= 1 && v <= render::FrameSpec::kMaxSize && v == std::floor(v); };
    if (!inRange(width) || !inRange(height))
        return Error(Code::BadFrame, fmt::format("--size '{}': 1 to {} pixels along a side are possible", text,
                                                 render::FrameSpec::kMaxSize));
    scene.width = static_cast<std::int32_t>(width);
    scene.height = static_cast<std::int32_t>(height);
    return {};
}

// Sections at the beginning and at the end of their way.
struct SectionEnds {
    std::vector<std::string> first, last;
    std::string moving;  // one of those that move; empty: none
};

// "z=0..6" moves from z=0 to z=6; other texts do not move.
Result<SectionEnds> endsOf(const std::vector<std::string>& sections) {
    SectionEnds ends;
    for (const std::string& text : sections) {
        const std::size_t dots = text.find("..");
        if (dots == std::string::npos) {
            ends.first.push_back(text);
            ends.last.push_back(text);
            continue;
        }
        const std::size_t begin = std::min(text.find_last_of("=<>+", dots), text.size() - 1) + 1;
        const std::string from = text.substr(std::min(begin, dots), dots - std::min(begin, dots));
        const std::string to = text.substr(dots + 2);
        if (begin > dots || !parseNumber(withoutBlanks(from)) || !parseNumber(to))
            return Error(
                Code::BadArgument,
                fmt::format("--section '{}': expected two numbers such as z=0..6 for a plane that moves", text));
        ends.first.push_back(text.substr(0, dots));
        ends.last.push_back(text.substr(0, begin) + to);
        ends.moving = text;
    }
    return ends;
}

Result<void> addStyles(const SceneOptions& arguments, illustrate::ScenePass& pass) {
    for (const std::string& text : arguments.color) {
        SVT_TRY(parts, splitValue(text, "--color", "'name=\"Unterzug-1\":red'"));
        const auto color = image::parseColor(parts->second);
        if (!color) return Error(Code::BadArgument, "--color: " + color.error().message());
        pass.styles.push_back({parts->first, *color, {}, {}, false});
    }
    for (const std::string& text : arguments.opacity) {
        SVT_TRY(parts, splitValue(text, "--opacity", "'class=BuildingRoom:0.2'"));
        const auto value = parseNumber(withoutBlanks(parts->second));
        if (!value || !(*value >= 0 && *value <= 1))
            return Error(Code::BadArgument,
                         fmt::format("--opacity '{}': {} is out of range; 0 to 1 (share of light stopped by 1 m)", text,
                                     parts->second));
        pass.styles.push_back({parts->first, {}, static_cast<float>(*value), {}, false});
    }
    for (const std::string& text : arguments.hatchOf) {
        SVT_TRY(parts, splitValue(text, "--hatch-of", "'class=WallSurface:insulation'"));
        const auto hatch = fromName<render::Hatch>(parts->second);
        if (!hatch)
            return Error(Code::BadArgument, fmt::format("--hatch-of '{}': unknown hatch '{}'; possible are {}", text,
                                                        parts->second, listedNames<render::Hatch>()));
        pass.styles.push_back({parts->first, {}, {}, *hatch, false});
    }
    return {};
}

Result<void> addEdges(const SceneOptions& arguments, illustrate::ScenePass& pass) {
    if (!arguments.wireframe) return {};
    illustrate::SceneLines lines;
    lines.select = *arguments.wireframe;
    if (arguments.wireWidth) lines.width = static_cast<float>(*arguments.wireWidth);
    if (arguments.wireColor) {
        const auto color = image::parseColor(*arguments.wireColor);
        if (!color) return Error(Code::BadArgument, "--wire-color: " + color.error().message());
        lines.color = *color;
    }
    lines.hidden = arguments.hiddenLines;
    pass.lines.push_back(lines);
    return {};
}

std::string either(const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : fmt::format("{} or {}", a, b);
}

// A plane of a region, quoted in case its storey name contains blanks.
std::string quoted(const std::string& plane) {
    const bool needsQuotes =
        plane.find_first_of(" ()") != std::string::npos && plane.find_first_of("\"'") == std::string::npos;
    return needsQuotes ? fmt::format("'{}'", plane) : plane;
}

Result<void> addPass(const SceneOptions& arguments, const std::vector<std::string>& sections, Scene& scene) {
    illustrate::ScenePass& pass = scene.passes.front();
    SVT_DO(addStyles(arguments, pass));
    SVT_DO(addEdges(arguments, pass));
    std::string section;
    for (const std::string& text : sections) section = either(section, quoted(text));
    if (!arguments.cut.empty()) pass.cut = either(pass.cut, fmt::format("({})", arguments.cut));
    // With a lens, sections cut only inside it.
    if (arguments.lens.empty()) pass.cut = either(pass.cut, section);
    if (!arguments.lens.empty()) addLens(scene, arguments.lens, section, arguments.context);
    if (!arguments.highlights.empty()) addHighlight(scene, arguments.highlights, arguments.context);
    if (!arguments.cutaway.empty()) addCutaway(scene, arguments.cutaway, 0.15);
    if (arguments.contextLevel && scene.passes.size() == 2)
        scene.passes.front().representation.level = arguments.contextLevel;
    for (illustrate::ScenePass& any : scene.passes)
        any.representation.hasCells = any.representation.hasCells || arguments.hasCells;
    for (illustrate::ScenePass& any : scene.passes)
        if (arguments.level && !any.representation.level) any.representation.level = arguments.level;
    return {};
}

// An inset for each query: in the corners from the right, or from the left where a legend stands at the right.
void addInsets(const SceneOptions& arguments, Scene& scene) {
    using enum illustrate::Inset::Corner;
    constexpr illustrate::Inset::Corner kFromRight[] = {TopRight, BottomRight, TopLeft, BottomLeft};
    constexpr illustrate::Inset::Corner kFromLeft[] = {BottomLeft, TopLeft, BottomRight, TopRight};
    for (const std::string& query : arguments.insets) {
        illustrate::Inset inset;
        for (const auto corner : scene.colorBy.empty() && !scene.field ? kFromRight : kFromLeft) {
            inset.corner = corner;
            if (std::none_of(scene.insets.begin(), scene.insets.end(),
                             [&](const illustrate::Inset& other) { return other.corner == corner; }))
                break;
        }
        Scene own;
        own.camera.preset = scene.camera.preset;
        own.camera.isParallel = scene.camera.isParallel;
        own.camera.around = query;
        inset.scene = illustrate::cameraJson(own.camera);
        scene.insets.push_back(inset);
    }
}

Result<Scene> readScene(const std::filesystem::path& file) {
    constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
    SVT_TRY(mapped, FileBytes::read(file));
    if (mapped->bytes().size() > kMaxBytes)
        return Error(Code::InputTooBig, fmt::format("{}: a scene of more than 16 MiB", file.string()));
    return illustrate::parseScene(mapped->text(), file.string());
}

}  // namespace

int SceneOptions::printedDpi() const { return dpi ? *dpi : size && isMetric(*size) ? kUsualDpi : 0; }

bool SceneOptions::isGiven(std::string_view member) const {
    return std::ranges::any_of(members, [&](const illustrate::GivenMember& given) { return given.member == member; });
}

Result<Scene> SceneOptions::toScene(std::optional<int> pictures) const {
    Scene file;
    if (!sceneFile.empty()) {
        auto read = readScene(sceneFile);
        if (!read) return read;
        file = std::move(*read);
    }
    SVT_TRY(ends, endsOf(sections));
    const bool isSeries = pictures.value_or(2) > 1;
    if (!ends->moving.empty() && !isSeries)
        return Error(Code::BadArgument,
                     fmt::format("--section '{}' moves; give the number of pictures with --frames, 2 or more, or "
                                 "write a film (-o P.webm)",
                                 ends->moving));
    auto scene = stillScene(file, ends->first, isSeries);
    if (!scene || ends->moving.empty()) return scene;
    SVT_TRY(last, stillScene(file, ends->last, isSeries));
    std::vector<std::string> cuts;
    for (const illustrate::ScenePass& pass : last->passes) cuts.push_back(pass.cut);
    const illustrate::Motion motion = scene->motion.value_or(illustrate::Motion{});
    // The last picture of a film is one picture before its end.
    const double lastSecond =
        pictures ? motion.seconds : std::max(1, illustrate::pictureCount(motion) - 1) / double(motion.rate);
    if (auto added = illustrate::addCutKey(*scene, cuts, std::min(lastSecond, motion.seconds)); !added)
        return Error(Code::BadArgument, "--section: " + added.error().message());
    return scene;
}

Result<Scene> SceneOptions::stillScene(Scene scene, const std::vector<std::string>& still, bool isSeries) const {
    if (size)
        if (auto parsed = parseSize(*size, dpi.value_or(kUsualDpi), scene); !parsed) return parsed.error();
    for (const illustrate::GivenMember& given : members)
        if (auto done = setSceneMember(scene, given); !done) return done.error();
    // All pictures of a series have one camera.
    if (isSeries && !isGiven("/camera/fit")) scene.camera.fit = illustrate::Fit::All;
    if (scene.sun && scene.sun->time.empty())
        return Error(Code::BadArgument, "--place is only used for the position of the sun; give the time with --sun");
    if (scene.field && scene.field->name.empty())
        return Error(Code::BadArgument,
                     "--time, --range, --isolines, --map and --per are for a field; give its name with --field");
    if (scene.field && scene.field->range && !((*scene.field->range)[0] < (*scene.field->range)[1]))
        return Error(Code::BadArgument, fmt::format("--range {:g},{:g}: expected a first value below the second",
                                                    (*scene.field->range)[0], (*scene.field->range)[1]));
    if (scene.motion && !scene.motion->keys.empty() && scene.motion->keys.back().at > scene.motion->seconds)
        return Error(Code::BadArgument, fmt::format("--seconds {} ends before the last key of the scene, at {} s",
                                                    scene.motion->seconds, scene.motion->keys.back().at));
    SVT_DO(addPass(*this, still, scene));
    if (insets.size() + scene.insets.size() > 4)
        return Error(Code::BadArgument,
                     fmt::format("{} insets; a picture has 4 corners", insets.size() + scene.insets.size()));
    addInsets(*this, scene);
    return scene;
}

record::Members<SceneOptions> membersOf(const SceneOptions*) noexcept {
    using Scene = SceneOptions;
    static constexpr record::Member<Scene> kMembers[] = {
        record::memberAs<GivenMembers, &Scene::members>("members", ""),
        member<&Scene::size>("--size", "width x height in pixels, or such as 160x90mm",
                             {.value = "WxH", .byDefault = "1280x720", .group = "View", .isForProjects = true}),
        member<&Scene::dpi>("--dpi", "pixels per inch, for sizes in mm; stored in the picture",
                            {.least = 1, .most = 4800, .byDefault = "300", .group = "View", .isForProjects = true}),
        member<&Scene::sections>(
            "--section",
            "cut away: z=1.2 or z>1.2 (above), y<3 (before), storey=NAME+1.1 (above 1.1 m over its floor), or A,B,C,D; "
            "metres from the lower corner; z=0..6 moves in films and with --frames",
            {.value = "PLANE", .group = "Cut", .isForProjects = true}),
        member<&Scene::cut>("--cut", "", {.group = "Cut", .like = "/passes/*/cut", .isForProjects = true}),
        member<&Scene::lens>(
            "--lens", "S-Lens: --section cuts the model only in this region; the rest is the context",
            {.value = "REGION", .group = "Illustrate", .excludes = "--highlight|--cutaway", .isForProjects = true}),
        member<&Scene::highlights>(
            "--highlight", "light the selected features, even behind others; the rest is the context",
            {.value = "QUERY", .group = "Illustrate", .excludes = "--lens|--cutaway", .isForProjects = true}),
        member<&Scene::cutaway>(
            "--cutaway", "remove only the parts that hide the selected features",
            {.value = "QUERY", .group = "Illustrate", .excludes = "--lens|--highlight", .isForProjects = true}),
        member<&Scene::context>("--context", "surroundings of a lens or highlight",
                                {.group = "Illustrate", .isForProjects = true}),
        member<&Scene::contextLevel>("--context-level",
                                     "level of detail of the context of a lens, highlight or cutaway, 0 is the finest",
                                     {.group = "Illustrate", .like = "/passes/*/level", .isForProjects = true}),
        member<&Scene::insets>(
            "--inset", "draw the selected features again, larger, in a corner, with a frame that marks their place",
            {.value = "QUERY", .group = "Illustrate", .isForProjects = true}),
        member<&Scene::hasCells>("--cells", "",
                                 {.group = "Illustrate", .like = "/passes/*/cells", .isForProjects = true}),
        member<&Scene::wireframe>(
            "--wireframe",
            "draw the edges of the selected features, at their depth inside the volume; without a query: of all "
            "visible features",
            {.value = "QUERY", .group = "Lines", .leastCount = 0, .isForProjects = true}),
        member<&Scene::hiddenLines>("--hidden-lines", "",
                                    {.group = "Lines", .like = "/passes/*/lines/*/hidden", .isForProjects = true}),
        member<&Scene::wireWidth>("--wire-width", "width of the edges",
                                  {.group = "Lines", .like = "/passes/*/lines/*/width", .isForProjects = true}),
        member<&Scene::wireColor>("--wire-color", "",
                                  {.group = "Lines", .like = "/passes/*/lines/*/color", .isForProjects = true}),
        member<&Scene::color>("--color", "colour by query, such as 'name=\"Unterzug-1\":red'",
                              {.value = "QUERY:COLOR", .group = "Style", .isForProjects = true}),
        member<&Scene::opacity>("--opacity", "share of light stopped by 1 m, 0 to 1, by query",
                                {.value = "QUERY:VALUE", .group = "Style", .isForProjects = true}),
        member<&Scene::hatchOf>("--hatch-of",
                                "hatch by query: masonry, concrete, reinforced-concrete, timber, insulation, earth, "
                                "steel, glass, general or none",
                                {.value = "QUERY:HATCH", .group = "Style", .isForProjects = true}),
        member<&Scene::level>("--level", "",
                              {.group = "Style", .like = "/passes/*/level", .excludes = "--gl", .isForProjects = true}),
        member<&Scene::sceneFile>("--scene", "scene file; the other options change it",
                                  {.value = "S.scene.json", .group = "Scene", .file = FileUse::OtherInput}),
    };
    return kMembers;
}

}  // namespace svt::frontend
