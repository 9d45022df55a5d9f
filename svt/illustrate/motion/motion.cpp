#include <svt/illustrate/motion.hpp>

#include <svt/illustrate/motion/interpolate.hpp>
#include <svt/illustrate/scene/visible_points.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/illustrate/view.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::illustrate {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// The values of one member at their times, which ascend.
using Line = std::vector<std::pair<double, Json>>;
// By pointer; ordered, so that the list of passes grows from its front.
using Timeline = std::map<std::string, Line>;

Scene withoutMotion(Scene scene) {
    scene.motion.reset();
    return scene;
}

// Members without members below them, by pointer, except empty ones.
std::vector<std::pair<std::string, Json>> leavesOf(const Json& json) {
    std::vector<std::pair<std::string, Json>> leaves;
    const Json flat = json.flatten();
    for (const auto& [pointer, value] : flat.items())
        if (!value.is_null()) leaves.emplace_back(pointer, value);
    return leaves;
}

void put(Json& scene, const std::string& pointer, const Json& value) { scene[Pointer(pointer)] = value; }

Result<Scene> parsed(const Json& scene, const std::string& name) { return parseScene(scene.dump(), name); }

// The default of a member, unless it adds something to the scene: the default width of a line would add a line.
std::optional<Json> defaultIn(const Json& base, const std::string& pointer) {
    const Option* member = findSceneMember(pointer);
    if (member == nullptr || member->byDefault.empty() || member->count != 1) return {};
    const std::string text(member->byDefault);
    Json value = record::valueOfTexts(*member, std::span(&text, 1)), with = base;
    put(with, pointer, value);
    const auto plain = parsed(base, "scene"), same = parsed(with, "scene");
    if (!plain || !same || *plain != *same) return {};
    return value;
}

Timeline timelineOf(const Json& base, const Motion& motion) {
    Timeline timeline;
    for (const Motion::Key& key : motion.keys)
        for (auto& [pointer, value] : leavesOf(Json::parse(key.scene, nullptr, false)))
            timeline[pointer].emplace_back(key.at, std::move(value));
    for (auto& [pointer, value] : leavesOf(base)) {
        const auto line = timeline.find(pointer);
        if (line != timeline.end() && line->second.front().first > 0)
            line->second.insert(line->second.begin(), {0.0, std::move(value)});
    }
    // A member that the scene leaves out begins at its default.
    for (auto& [pointer, line] : timeline) {
        if (line.front().first == 0) continue;
        if (auto value = defaultIn(base, pointer)) line.insert(line.begin(), {0.0, std::move(*value)});
    }
    return timeline;
}

// Where a time lies in a line: the values around it, and the share of the way between them.
struct Between {
    const std::pair<double, Json>*from = nullptr, *to = nullptr;
    double share = 0;
};

std::optional<Between> find(const Line& line, double seconds, Motion::Pace pace) {
    const auto after = std::upper_bound(line.begin(), line.end(), seconds,
                                        [](double at, const auto& value) { return at < value.first; });
    if (after == line.begin()) return {};
    const auto before = std::prev(after);
    if (after == line.end()) return Between{&*before, &*before, 0};
    const double share = (seconds - before->first) / (after->first - before->first);
    return Between{&*before, &*after, pace == Motion::Pace::Even ? share : share * share * (3 - 2 * share)};
}

Json plainAt(const Json& base, const Timeline& timeline, double seconds, Motion::Pace pace) {
    Json scene = base;
    for (const auto& [pointer, line] : timeline)
        if (const auto between = find(line, seconds, pace))
            put(scene, pointer, valueBetween(between->from->second, between->to->second, between->share, pointer));
    return scene;
}

struct Orbit {
    double azimuth = 0, rise = 0, distance = 1;
};

Orbit orbitOf(Vec3d eye, Vec3d target) {
    const Vec3d offset = eye - target;
    return {std::atan2(offset.y, offset.x), std::atan2(offset.z, std::hypot(offset.x, offset.y)), length(offset)};
}

Vec3d eyeOf(const Orbit& orbit, Vec3d target) {
    const double flat = orbit.distance * std::cos(orbit.rise);
    return target +
           Vec3d{flat * std::cos(orbit.azimuth), flat * std::sin(orbit.azimuth), orbit.distance * std::sin(orbit.rise)};
}

// The eye on its way around the target, the shorter way, instead of straight through what it looks at.
void goAround(Scene& scene, const Scene& before, const Scene& after, double share) {
    const SceneCamera &a = before.camera, &b = after.camera;
    if (!a.eye || !a.target || !b.eye || !b.target || !scene.camera.target) return;
    const Orbit from = orbitOf(*a.eye, *a.target), to = orbitOf(*b.eye, *b.target);
    if (!(from.distance > 0) || !(to.distance > 0)) return;
    constexpr double kTurn = 2 * std::numbers::pi;
    const double turn = std::remainder(to.azimuth - from.azimuth, kTurn);
    const auto mix = [share](double x, double y) { return x + (y - x) * share; };
    scene.camera.eye = eyeOf({from.azimuth + turn * share, mix(from.rise, to.rise),
                              std::exp(mix(std::log(from.distance), std::log(to.distance)))},
                             *scene.camera.target);
}

// The points that an orbiting camera must show, metres from the grid's lower corner: of all parts that the scene draws
// at its beginning, including parts that are cut away. If it draws nothing, the corners of the volume's box.
std::vector<Vec3d> pointsToShow(Scene scene, const volume::SemanticVolume& volume) {
    for (ScenePass& pass : scene.passes) {
        pass.cut.clear();
        pass.keep.clear();
    }
    scene.field.reset();  // shown on the same parts
    std::vector<Vec3d> points;
    if (const auto spec = makeFrameSpec(scene, volume)) points = visiblePoints(spec->passes, volume);
    for (Vec3d& point : points) point = point - volume.grid.origin();
    if (!points.empty()) return points;
    const volume::Grid& grid = volume.grid;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        Vec3d& point = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            const double at = (corner >> axis & 1) != 0 ? grid.dimension()[a] - 0.5 : -0.5;
            point = point + grid.axes()[axis] * (at * grid.spacing()[a]);
        }
    }
    return points;
}

Vec3d middleOf(std::span<const Vec3d> points) {
    Box3d box;
    for (const Vec3d& point : points) box.add(point);
    return box.center();
}

// The least distance from which a camera that goes around `target` at one height keeps all points in its picture.
double turningDistance(std::span<const Vec3d> points, Vec3d target, const Orbit& start, const SceneCamera& camera,
                       double aspect) {
    constexpr int kDirections = 48;
    constexpr double kMargin = 0.96;  // as of named views
    const double up = std::tan(camera.fieldOfView * std::numbers::pi / 360) * kMargin, across = up * aspect;
    double distance = 0;
    for (int n = 0; n < kDirections; ++n) {
        const double azimuth = start.azimuth + n * 2 * std::numbers::pi / kDirections;
        const Vec3d back = eyeOf({azimuth, start.rise, 1}, {});
        const Vec3d right{-std::sin(azimuth), std::cos(azimuth), 0};
        const Vec3d above = cross(back, right);
        for (const Vec3d& point : points) {
            const Vec3d from = point - target;
            const double need = std::max(std::abs(dot(from, right)) / across, std::abs(dot(from, above)) / up);
            distance = std::max(distance, need + dot(from, back));
        }
    }
    return distance / camera.zoom;
}

// The camera of a scene after it has gone around by an angle.
// \param start  the scene at the beginning of its motion
Result<void> turnCamera(Scene& scene, const Scene& start, double degrees, const volume::SemanticVolume& volume) {
    SceneCamera& camera = scene.camera;
    const double aspect = double(scene.width) / scene.height;
    if (!camera.eye || !camera.target) {
        const SceneCamera named = camera;
        SVT_TRY(view, makeView(camera.around, camera.preset, camera, aspect, volume));
        camera = std::move(*view);
        if (named.around.empty() && !named.isParallel) {
            const auto points = pointsToShow(start, volume);
            const Orbit seen = orbitOf(*camera.eye, *camera.target);
            camera.target = middleOf(points);
            const double distance = turningDistance(points, *camera.target, seen, named, aspect);
            camera.eye = eyeOf({seen.azimuth, seen.rise, distance}, *camera.target);
            camera.zoom = 1;
        }
    }
    Orbit orbit = orbitOf(*camera.eye, *camera.target);
    orbit.azimuth += degrees * std::numbers::pi / 180;
    camera.eye = eyeOf(orbit, *camera.target);
    return {};
}

}  // namespace

Result<Scene> sceneAt(const Scene& scene, double seconds, const volume::SemanticVolume& volume) {
    if (!scene.motion) return scene;
    const Motion& motion = *scene.motion;
    const double at = std::clamp(seconds, 0.0, motion.seconds);
    const Scene plain = withoutMotion(scene);
    const Json base = Json::parse(writeScene(plain));
    const Timeline timeline = timelineOf(base, motion);
    auto now = parsed(plainAt(base, timeline, at, motion.pace), fmt::format("scene at {:.3f} s", at));
    if (!now) return now;
    if (const auto eye = timeline.find("/camera/eye/0"); eye != timeline.end()) {
        const auto between = find(eye->second, at, motion.pace);
        if (between && between->from != between->to) {
            const auto before = parsed(plainAt(base, timeline, between->from->first, motion.pace), "scene");
            const auto after = parsed(plainAt(base, timeline, between->to->first, motion.pace), "scene");
            if (before && after) goAround(*now, *before, *after, between->share);
        }
    }
    if (motion.turn != 0)
        if (auto turned = turnCamera(*now, plain, motion.turn * at / motion.seconds, volume); !turned)
            return turned.error();
    return now;
}

Result<void> addCutKey(Scene& scene, std::span<const std::string> cuts, double seconds) {
    Motion& motion = scene.motion ? *scene.motion : scene.motion.emplace();
    if (motion.keys.empty()) motion.pace = Motion::Pace::Even;
    std::vector<std::size_t> moved;
    for (std::size_t n = 0; n < std::min(cuts.size(), scene.passes.size()); ++n)
        if (cuts[n] != scene.passes[n].cut) moved.push_back(n);
    for (const Motion::Key& key : motion.keys) {
        const Json json = Json::parse(key.scene, nullptr, false);
        for (const std::size_t n : moved)
            if (json.contains(Pointer(fmt::format("/passes/{}/cut", n))))
                return Error(
                    Code::BadArgument,
                    fmt::format("the cut '{}' cannot move to '{}', because the motion of the scene already moves it "
                                "(key at {} s)",
                                scene.passes[n].cut, cuts[n], key.at));
    }
    auto key = std::lower_bound(motion.keys.begin(), motion.keys.end(), seconds,
                                [](const Motion::Key& before, double at) { return before.at < at; });
    if (key == motion.keys.end() || key->at != seconds) key = motion.keys.insert(key, Motion::Key{seconds, "{}"});
    Json json = Json::parse(key->scene, nullptr, false);
    for (const std::size_t n : moved) {
        Json& passes = json["passes"];
        while (passes.size() <= n) passes.push_back(Json::object());
        passes[n]["cut"] = cuts[n];
    }
    key->scene = json.dump();
    return {};
}

Result<void> checkMotion(const Scene& scene, const std::string& name) {
    if (!scene.motion) return {};
    const Json base = Json::parse(writeScene(withoutMotion(scene)));
    const Timeline timeline = timelineOf(base, *scene.motion);
    for (std::size_t n = 0; n < scene.motion->keys.size(); ++n) {
        SVT_TRY(then, parsed(plainAt(base, timeline, scene.motion->keys[n].at, scene.motion->pace),
                             fmt::format("{}: /motion/keys/{}/scene", name, n)));
    }
    return {};
}

int pictureCount(const Motion& motion) noexcept {
    return std::max(1, static_cast<int>(std::lround(motion.seconds * motion.rate)));
}

}  // namespace svt::illustrate
