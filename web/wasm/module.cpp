// The calls on an open volume or city, see kCalls.
#include "calls.hpp"
#include "font/font.hpp"
#include "replies.hpp"
#include "walk.hpp"
#include "whole.hpp"

#include <svt/core/parallel.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/crs/globe.hpp>
#include <svt/illustrate/color_by.hpp>
#include <svt/illustrate/view.hpp>
#include <svt/image/color_text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace svt::web {
namespace {

std::unique_ptr<Session> session;
std::unique_ptr<CityPage> cityPage;

// The context of a page's argument; Ghost by default.
illustrate::Context contextOf(const Json& value) {
    const auto known = fromName<illustrate::Context>(value.is_string() ? value.get<std::string>() : std::string());
    return known.value_or(illustrate::Context::Ghost);
}

// (name, or names) and, for several, (sizes in bytes); {draft, memory}; the concatenated bytes of the files ->
// VolumeInfo
Result<Reply> open(const Arguments& arguments) {
    const Progress progress = progressOfPage();
    std::vector<NamedBytes> files;
    std::size_t at = 0;
    if (arguments.at(0).is_array()) {
        for (std::size_t n = 0; n < arguments.at(0).size(); ++n) {
            const auto size = arguments.at(1).at(n).get<std::size_t>();
            files.push_back({arguments.at(0).at(n).get<std::string>(), arguments.bytes().subspan(at, size)});
            at += size;
        }
    } else {
        files.push_back({arguments.text(0), arguments.bytes()});
    }
    if (files.empty()) return Error(Code::BadArgument, "no file to open");
    OpenOptions options;
    if (const Json& wanted = arguments.at(2); wanted.is_object()) {
        options.isDraft = wanted.value("draft", false);
        options.memoryBytes = static_cast<std::uint64_t>(std::max(0.0, wanted.value("memory", 0.0)));
    }
    SVT_TRY(opened, Session::open(files, options, &progress));
    session = std::move(*opened);
    return Reply(infoOf(*session));
}

// (file name) and a table's bytes -> messages on rows that name no feature; features get owners
Result<Reply> owners(const Arguments& arguments) {
    const auto bytes = arguments.bytes();
    const std::string_view table(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    SVT_TRY(unknown, session->setOwners(table, arguments.text(0)));
    Json messages = Json::array();
    for (const Diagnostic& row : unknown->items())
        messages.push_back(fmt::format("{}: {}", row.where.line, row.message));
    return Reply(messages.dump());
}

Result<Vec3d> pointAt(const Arguments& arguments, std::size_t n) {
    const Json& given = arguments.at(n);
    if (!given.is_array() || given.size() != 3) return Error(Code::BadArgument, "a point is three numbers");
    return Vec3d{given[0].get<double>(), given[1].get<double>(), given[2].get<double>()};
}
Json jsonOf(Vec3d p) { return Json::array({p.x, p.y, p.z}); }

// (point) -> the eye of a person standing near it, or null
Result<Reply> stand(const Arguments& arguments) {
    SVT_TRY(wanted, pointAt(arguments, 0));
    const auto place = standingPlace(*session, *wanted);
    return Reply((place ? jsonOf(*place) : Json(nullptr)).dump());
}

// (eye, step) -> the eye after the step
Result<Reply> step(const Arguments& arguments) {
    SVT_TRY(eye, pointAt(arguments, 0), by = pointAt(arguments, 1));
    if (!by) return by.error();
    return Reply(jsonOf(afterStep(*session, *eye, *by)).dump());
}

// (scene) -> [{text, by}]: its section planes that lie in faces of the model, with the distance that they are moved
Result<Reply> movedPlanes(const Arguments& arguments) {
    SVT_TRY(scene, arguments.scene(0));
    Json list = Json::array();
    for (const illustrate::MovedPlane& plane : illustrate::planesInFaces(*scene, session->volume()))
        list.push_back({{"text", plane.text}, {"by", plane.by}});
    return Reply(list.dump());
}

// The bytes of DejaVuSans.ttf -> nothing. Needed before names are drawn.
Result<Reply> font(const Arguments& arguments) {
    SVT_DO(setFont(arguments.bytes()));
    return Reply(std::string("null"));
}

// ([[east, north], ...] in the coordinates of the model) -> [[longitude, latitude], ...] in degrees
Result<Reply> places(const Arguments& arguments) {
    const auto epsg = static_cast<int>(crs::epsgCodeOf(session->volume().crsName));
    Json list = Json::array();
    for (const Json& at : arguments.at(0)) {
        SVT_TRY(place, crs::placeOnEarth(epsg, {at.at(0).get<double>(), at.at(1).get<double>(), 0}));
        list.push_back({place->x, place->y});
    }
    return Reply(list.dump());
}

// (scene) -> the meaning of the colours of its colorBy or its field: {title, isRamp, low, high, ramp: [color],
// entries: [{text, count, color}], notes, hasUnknown, missing, missingColor}; the colours of a ramp are at equal steps
Result<Reply> legend(const Arguments& arguments) {
    SVT_TRY(scene, arguments.scene(0));
    illustrate::ColorScale scale;
    if (scene->field) {
        SVT_TRY(own, session->scaleOfField(*scene));
        scale = std::move(*own);
    } else {
        const analyze::LabelRows rows(session->volume());
        SVT_DO(illustrate::makeFrameSpec(*scene, session->volume(), rows, &scale));
    }
    Json entries = Json::array(), ramp = Json::array();
    for (const auto& entry : scale.entries)
        entries.push_back({{"text", entry.text}, {"count", entry.count}, {"color", image::colorText(entry.color)}});
    constexpr int kSteps = 16;
    for (int n = 0; scale.isRamp && n <= kSteps; ++n)
        ramp.push_back(
            image::colorText(illustrate::rampColor(scale, scale.low + (scale.high - scale.low) * n / kSteps)));
    return Reply(Json{{"title", scale.title},
                      {"isRamp", scale.isRamp},
                      {"low", scale.low},
                      {"high", scale.high},
                      {"ramp", std::move(ramp)},
                      {"entries", std::move(entries)},
                      {"notes", scale.notes},
                      {"hasUnknown", !scale.missingText.empty()},
                      {"missing", scale.missing},
                      {"missingColor", image::colorText(illustrate::missingColor())}}
                     .dump());
}

// (scene, width, height, whether a draft is sufficient) -> RGBA, row by row from the top
Result<Reply> draw(const Arguments& arguments) {
    SVT_TRY(scene, arguments.picture(0));
    scene->width = arguments.pixels(1);
    scene->height = arguments.pixels(2);
    SVT_TRY(frame, session->draw(*scene, arguments.at(3) == true));
    return Reply(std::as_bytes(std::span((*frame)->color.pixels())));
}

// (scene, width, height, whether it is an invisible trial) -> nothing; drawn into the current context
Result<Reply> drawGl(const Arguments& arguments) {
    SVT_TRY(scene, arguments.scene(0));
    scene->width = arguments.pixels(1);
    scene->height = arguments.pixels(2);
    const auto purpose = arguments.at(3) == true ? Session::Purpose::Trial : Session::Purpose::Shown;
    SVT_DO(session->drawGl(*scene, purpose));
    return Reply(std::string("null"));
}
Result<Reply> dropGl(const Arguments&) {
    if (session) session->dropGl();
    return Reply(std::string("null"));
}

// (scene, effects) -> scene
Result<Reply> compose(const Arguments& arguments) {
    SVT_TRY(scene, arguments.scene(0));
    const Json& effects = arguments.at(1);
    const auto textOf = [](const Json& of, const char* member) { return of.value(member, std::string()); };
    if (const auto lens = effects.find("lens"); lens != effects.end())
        illustrate::addLens(*scene, textOf(*lens, "region"), textOf(*lens, "cut"),
                            contextOf(lens->value("context", Json())));
    if (const auto highlight = effects.find("highlight"); highlight != effects.end())
        illustrate::addHighlight(*scene, highlight->value("queries", std::vector<std::string>{}),
                                 contextOf(highlight->value("context", Json())));
    if (const auto cutaway = effects.find("cutaway"); cutaway != effects.end())
        illustrate::addCutaway(*scene, textOf(*cutaway, "query"), cutaway->value("margin", 0.15));
    return Reply(illustrate::writeScene(*scene));
}

// (x, y, metres within which to snap to corners and edges of the model) -> Pick or null
Result<Reply> pick(const Arguments& arguments) {
    return Reply(pickOf(*session, arguments.number(0), arguments.number(1), arguments.number(2)));
}

Result<Reply> along(const Arguments& arguments) {
    return replyOf(intervalsOf(*session, arguments.number(0), arguments.number(1)));
}
Result<Reply> select(const Arguments& arguments) { return replyOf(selectionOf(*session, arguments.text(0))); }
Result<Reply> findInAttributes(const Arguments& arguments) {
    return Reply(attributesFoundIn(*session, arguments.text(0)));
}
Result<Reply> attributeValues(const Arguments& arguments) {
    return Reply(attributeValuesOf(*session, arguments.text(0)));
}
Result<Reply> properties(const Arguments& arguments) { return replyOf(propertiesOf(*session, arguments.text(0))); }

std::string cameraText(const illustrate::SceneCamera& camera) {
    return Json::parse(illustrate::cameraJson(camera)).at("camera").dump();
}

// (query, preset or null, camera) -> camera
Result<Reply> view(const Arguments& arguments) {
    const auto now = illustrate::parseScene(Json{{"camera", arguments.at(2)}}.dump(), "camera");
    if (!now) return now.error();
    SVT_TRY(camera, session->view(arguments.text(0), arguments.text(1), now->camera));
    return Reply(cameraText(*camera));
}

// ([[file, offset, size, bytes given, size of the file, reason for missing bytes], ...]) and the concatenated bytes ->
// nothing
Result<Reply> cityGive(const Arguments& arguments) {
    std::size_t at = 0;
    const auto bytes = arguments.bytes();
    for (const Json& row : arguments.at(0)) {
        const city::CityBytes::Range range{row.at(0).get<std::string>(), row.at(1).get<std::uint64_t>(),
                                           row.at(2).get<std::uint64_t>()};
        const auto size = row.at(3).get<std::size_t>();
        if (row.at(5).is_string()) {
            openCity().bytes().refuse(range, row.at(5).get<std::string>());
            continue;
        }
        const auto own = bytes.subspan(at, size);
        at += size;
        openCity().bytes().give(range, std::string(reinterpret_cast<const char*>(own.data()), own.size()),
                                row.at(4).get<std::uint64_t>());
    }
    return Reply(std::string("null"));
}

// (whether another city begins, scene or null, width, height, {pixels, memory, shown}) -> {needs}, or {info (null:
// nothing new), key, tiles, bytes, pixels, finest, coarsest, lacks, heap}: then the part of the city that the scene
// shows is open
Result<Reply> cityLook(const Arguments& arguments) {
    if (arguments.at(0) == true) cityPage.reset();
    CityWish wish;
    if (arguments.at(1).is_object()) {
        SVT_TRY(scene, arguments.scene(1));
        scene->width = arguments.pixels(2);
        scene->height = arguments.pixels(3);
        wish.scene = std::move(*scene);
    }
    const Json& options = arguments.at(4);
    wish.shown = options.value("shown", std::string());
    wish.pixels = options.value("pixels", 1.0);
    wish.memoryBytes = static_cast<std::uint64_t>(std::max(0.0, options.value("memory", 0.0)));
    auto look = openCity().look(wish);
    const Json needs = neededBytes();
    if (!look) return needs.is_null() ? Result<Reply>(look.error()) : Reply(needs.dump());
    Json reply{{"info", nullptr},        {"key", look->key},          {"tiles", look->tiles},
               {"bytes", look->bytes},   {"pixels", look->pixels},    {"lacks", look->lacks},
               {"finest", look->finest}, {"coarsest", look->coarsest}};
    if (look->session) {
        session = std::move(look->session);
        reply["info"] = Json::parse(infoOf(*session));
        reply["info"]["source"] = "city.json";
        reply["info"]["buildings"] = openCity().city()->buildings();
    }
    reply["heap"] = std::uint64_t{__builtin_wasm_memory_size(0)} * 65536;
    return Reply(reply.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// () -> nothing; another worker shows the city now
Result<Reply> cityDrop(const Arguments&) {
    session.reset();
    return Reply(std::string("null"));
}

// (id, camera, width / height) -> {needs}, or a camera that shows the building
Result<Reply> cityFind(const Arguments& arguments) {
    const auto now = illustrate::parseScene(Json{{"camera", arguments.at(1)}}.dump(), "camera");
    if (!now) return now.error();
    auto camera = openCity().find(arguments.text(0), now->camera, std::max(0.01, arguments.number(2)));
    const Json needs = neededBytes();
    if (!camera) return needs.is_null() ? Result<Reply>(camera.error()) : Reply(needs.dump());
    return Reply(cameraText(*camera));
}

// (words, maximum of buildings) -> {needs}, or {count, buildings: [{id, name, class, address}, ...]}
Result<Reply> citySearch(const Arguments& arguments) {
    const auto found =
        openCity().search(arguments.text(0), static_cast<std::size_t>(std::max(0.0, arguments.number(1))));
    const Json needs = neededBytes();
    if (!found) return needs.is_null() ? Result<Reply>(found.error()) : Reply(needs.dump());
    Json buildings = Json::array();
    for (const auto& [id, name, className, address] : found->buildings)
        buildings.push_back({{"id", id}, {"name", name}, {"class", className}, {"address", address}});
    const Json reply{{"count", found->count}, {"buildings", std::move(buildings)}};
    return Reply(reply.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// (scene) -> PNG
Result<Reply> picture(const Arguments& arguments) {
    SVT_TRY(scene, arguments.picture(0));
    SVT_TRY(png, session->picture(*scene));
    return Reply(std::move(*png));
}

// (scene) -> PNG, 16 bits gray: the scalar of each pixel
Result<Reply> labels(const Arguments& arguments) {
    SVT_TRY(scene, arguments.picture(0));
    SVT_TRY(png, session->labels(*scene));
    return Reply(std::move(*png));
}

// () -> the number of threads that work together; starts the further ones. 1 in the module without threads
Result<Reply> threads(const Arguments&) {
    const int count = hardwareThreads();
    parallelFor(static_cast<std::size_t>(count), 1, 0, [](std::size_t, std::size_t) {});
    return Reply(Json(count).dump());
}

constexpr Call kCalls[] = {{"open", open, false},
                           {"threads", threads, false},
                           {"font", font, false},
                           {"draw", draw},
                           {"drawGl", drawGl},
                           {"dropGl", dropGl, false},
                           {"compose", compose, false},
                           {"pick", pick},
                           {"along", along},
                           {"select", select},
                           {"findInAttributes", findInAttributes},
                           {"properties", properties},
                           {"attributeValues", attributeValues},
                           {"view", view},
                           {"picture", picture},
                           {"labels", labels},
                           {"owners", owners},
                           {"stand", stand},
                           {"step", step},
                           {"legend", legend},
                           {"places", places},
                           {"movedPlanes", movedPlanes},
                           {"cityGive", cityGive, false},
                           {"cityLook", cityLook, false},
                           {"cityDrop", cityDrop, false},
                           {"cityFind", cityFind, false},
                           {"citySearch", citySearch, false}};

}  // namespace

Session& openSession() noexcept { return *session; }

Json neededBytes() {
    Json list = Json::array();
    for (const city::CityBytes::Range& range : openCity().bytes().wanted())
        list.push_back({range.name, range.offset, range.size});
    return list.empty() ? Json(nullptr) : Json{{"needs", std::move(list)}};
}

CityPage& openCity() {
    if (!cityPage) cityPage = std::make_unique<CityPage>();
    return *cityPage;
}

Result<Reply> runCall(std::string_view name, const Arguments& arguments) {
    for (const std::span<const Call> calls : {std::span<const Call>(kCalls), wholeCalls(), fieldCalls()}) {
        const Call* const call = findCall(calls, name);
        if (call == nullptr) continue;
        if (call->needsVolume && !session) return Error(Code::BadArgument, "no volume is open; open one first");
        return call->run(arguments);
    }
    return unknownCall(name);
}

}  // namespace svt::web
