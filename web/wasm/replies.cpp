#include "replies.hpp"

#include <svt/analyze/extents.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/image/color_text.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace svt::web {
namespace {

using Json = nlohmann::ordered_json;

std::string textOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json pointOf(Vec3d p) { return Json::array({p.x, p.y, p.z}); }
Json pointOf(Vec3i p) { return Json::array({p.x, p.y, p.z}); }

// Id, class and name: the page's reference to a feature.
Json namesOf(const volume::Label& label) {
    return {{"id", label.id}, {"class", label.className}, {"name", label.name}};
}

Json storeysJson(const volume::SemanticVolume& volume) {
    Json list = Json::array();
    for (const drawing::StoreyHeights& storey : drawing::findStoreys(volume)) {
        const volume::Label& label = volume.labels.labels[storey.label];
        list.push_back({{"id", label.id}, {"name", label.name}, {"floor", storey.floor}, {"top", storey.top}});
    }
    if (!list.empty()) return list;
    // Without storeys, derives levels from rooms and slabs.
    const auto levels = drawing::findLevels(volume);
    const double top = (volume.grid.dimension().z - 1) * volume.grid.spacing().z;
    for (std::size_t n = 0; n < levels.size(); ++n)
        list.push_back({{"id", ""},
                        {"name", levels[n].name},
                        {"floor", levels[n].floor},
                        {"top", n + 1 < levels.size() ? levels[n + 1].floor : top}});
    return list;
}

// The type of a feature in the model's own format: IfcWall.
std::string typeOf(const volume::Label& label) {
    for (const Attribute& attribute : label.attributes)
        if (const auto* text = std::get_if<std::string>(&attribute.value); text && attribute.name == "ifcType")
            return *text;
    return {};
}

// Names of all attributes, the most frequent ones first.
Json attributeNames(const volume::LabelTable& table) {
    std::map<std::string, std::size_t> counts;
    for (const volume::Label& label : table.labels)
        for (const Attribute& attribute : label.attributes) ++counts[attribute.name];
    std::vector<std::pair<std::string, std::size_t>> ordered(counts.begin(), counts.end());
    std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    Json list = Json::array();
    for (std::size_t n = 0; n < std::min<std::size_t>(ordered.size(), 200); ++n) list.push_back(ordered[n].first);
    return list;
}

// [{name, count, isNumber, onSpaces}] of the same attributes: the number of features with the attribute, whether all
// values are numbers, and how many of the features are spaces.
Json attributeUses(const volume::LabelTable& table, const Json& names) {
    struct Use {
        std::size_t count = 0, onSpaces = 0;
        bool isNumber = true;
    };
    std::map<std::string_view, Use> uses;
    for (const volume::Label& label : table.labels)
        for (const Attribute& attribute : label.attributes) {
            Use& use = uses[attribute.name];
            ++use.count;
            if (model::isSpace(label.className)) ++use.onSpaces;
            use.isNumber = use.isNumber && (std::holds_alternative<double>(attribute.value) ||
                                            std::holds_alternative<std::int64_t>(attribute.value));
        }
    Json list = Json::array();
    for (const Json& name : names) {
        const Use& use = uses[name.get_ref<const std::string&>()];
        list.push_back({{"name", name}, {"count", use.count}, {"isNumber", use.isNumber}, {"onSpaces", use.onSpaces}});
    }
    return list;
}

Json featuresJson(const volume::LabelTable& table) {
    Json list = Json::array();
    std::vector<int> depth(table.labels.size(), 0);
    for (std::size_t l = 0; l < table.labels.size(); ++l) {
        const volume::Label& label = table.labels[l];
        const bool isRoot = label.parent == volume::kNoLabel;
        if (!isRoot) depth[l] = depth[label.parent] + 1;
        Json feature = namesOf(label);
        feature["parent"] = isRoot ? "" : table.labels[label.parent].id;
        feature["depth"] = depth[l];
        feature["first"] = label.first;
        feature["count"] = label.count;
        feature["color"] = image::colorText(label.color);
        feature["opacity"] = label.opacity;
        if (model::isSpace(label.className)) feature["isSpace"] = true;
        if (!label.groups.empty()) feature["groups"] = label.groups;
        if (std::string type = typeOf(label); !type.empty()) feature["type"] = std::move(type);
        list.push_back(std::move(feature));
    }
    return list;
}

Json findingsJson(const Diagnostics& findings) {
    std::vector<const Diagnostic*> ordered;
    for (const Diagnostic& finding : findings.items()) ordered.push_back(&finding);
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const Diagnostic* a, const Diagnostic* b) { return a->severity > b->severity; });
    Json list = Json::array();
    for (const Diagnostic* finding : ordered) list.push_back(finding->toString());
    return list;
}

// Edge lengths, in world axes, of the box around the centers of the first and last samples.
Vec3d worldSize(const volume::Grid& grid) {
    Vec3d size;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d edge =
            grid.axes()[static_cast<std::size_t>(axis)] * (grid.spacing()[axis] * (grid.dimension()[axis] - 1));
        size = size + Vec3d{std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)};
    }
    return size;
}

// The box of a feature with its parts, metres from the corner of the grid.
Box3d boxOf(const analyze::Measure& total, const volume::Grid& grid) {
    Box3d world = total.box;
    if (world.isEmpty()) return {{}, {}};
    world.min = world.min - grid.origin();
    world.max = world.max - grid.origin();
    return world;
}

Json neighborsJson(Session& session, std::span<const std::uint32_t> extent) {
    const auto& labels = session.volume().labels.labels;
    Json list = Json::array();
    for (const analyze::Neighbor& neighbor : analyze::NeighborFinder(session.contacts(), labels.size()).of(extent)) {
        if (neighbor.label == volume::kNoLabel) continue;
        Json row = namesOf(labels[neighbor.label]);
        row["area"] = neighbor.area;
        list.push_back(std::move(row));
    }
    return list;
}

struct Snapped {
    Vec3d point;
    bool isCorner = false;
};

// The nearest corner of the model's edges within reach of a point, else the nearest point of an edge. Points are metres
// from the grid's lower corner. Cost: O(edges).
std::optional<Snapped> snapTo(const volume::VectorParts& parts, Vec3d from, double reach) {
    std::optional<Snapped> found;
    double corner = reach, edge = reach;
    for (const volume::VectorParts::Segment& segment : parts.segments) {
        const Vec3d a = parts.position(segment.ends[0], {}), b = parts.position(segment.ends[1], {});
        const Vec3d along = b - a;
        const double square = dot(along, along);
        const double share = square > 0 ? std::clamp(dot(from - a, along) / square, 0.0, 1.0) : 0;
        const Vec3d nearest = a + along * share;
        if (length(nearest - from) > edge && length(nearest - from) > corner) continue;
        for (const Vec3d end : {a, b})
            if (length(end - from) < corner) corner = length(end - from), found = Snapped{end, true};
        if ((found && found->isCorner) || length(nearest - from) >= edge) continue;
        edge = length(nearest - from);
        found = Snapped{nearest, false};
    }
    return found;
}

// \param by  from the corner of the session's grid to that of the page's
std::string propertiesIn(Session& session, std::uint32_t index, Vec3d by) {
    const volume::SemanticVolume& volume = session.volume();
    const auto found = volume.labels.labels.begin() + index;
    const bool isClosed = found->filling == volume::Filling::Solid || found->filling == volume::Filling::TJunctions;
    const analyze::Extents extents(volume.labels);
    const std::vector<std::uint32_t> feature{index};
    const analyze::FeatureMeasure measure =
        analyze::measureFeatures(extents, feature, session.measures(), session.contacts()).front();
    Box3d box = boxOf(measure.total, volume.grid);
    box.min = box.min + by;
    box.max = box.max + by;
    Json json = namesOf(*found);
    json["attributes"] = Json::object();
    for (const AttributeList& list : attributeLists(found->attributes)) {
        const Attribute* first = list.items.front().attribute;
        const std::string unit = first == nullptr || first->unit.empty() ? "" : " " + first->unit;
        json["attributes"][std::string(list.name)] = toText(list) + unit;
    }
    // Repeats numbers as numbers, for languages with a decimal comma.
    json["numbers"] = Json::object();
    for (const AttributeList& list : attributeLists(found->attributes))
        if (const Attribute* only = list.isSingle() ? list.items.front().attribute : nullptr)
            if (const auto* number = std::get_if<double>(&only->value))
                json["numbers"][only->name] = {{"value", *number}, {"unit", only->unit}};
    json["voxelVolume"] = double(measure.own.voxels) * volume.grid.voxelVolume();
    // Half a voxel along the surface, as analyze::KnownVolume counts it. Tiles of a city have other voxels than their frame.
    const Vec3d spacing = volume.grid.spacing();
    json["voxelBound"] = measure.own.area * std::max({spacing.x, spacing.y, spacing.z}) / 2;
    json["modelVolume"] = isClosed ? Json(found->volume) : Json(nullptr);
    const std::vector<double>& floors = session.floorAreas();
    json["floorArea"] = index < floors.size() && floors[index] > 0 ? Json(floors[index]) : Json(nullptr);
    json["surface"] = measure.own.area;
    json["totalVolume"] = measure.total.volume ? Json(*measure.total.volume) : Json(nullptr);
    json["totalSurface"] = measure.total.area;
    json["box"] = {{"low", pointOf(box.min)}, {"high", pointOf(box.max)}};
    json["neighbours"] = neighborsJson(session, extents.of(index));
    return textOf(json);
}

// Without streams, which would be the only users of std::locale in the module.
std::vector<std::string> wordsOf(const std::string& text) {
    constexpr const char* kBlanks = " \t\r\n";
    std::vector<std::string> words;
    for (std::size_t from = text.find_first_not_of(kBlanks), to = 0; from != std::string::npos;
         from = text.find_first_not_of(kBlanks, to)) {
        to = std::min(text.find_first_of(kBlanks, from), text.size());
        words.push_back(text.substr(from, to - from));
    }
    return words;
}

}  // namespace

std::string infoOf(const Session& session) {
    const volume::SemanticVolume& volume = session.volume();
    const auto& axes = volume.grid.axes();
    const Json attributes = attributeNames(volume.labels);
    return textOf({{"name", volume.modelName},
                   {"source", volume.source},
                   {"crs", volume.crsName},
                   {"dimension", pointOf(volume.grid.dimension())},
                   {"spacing", pointOf(volume.grid.spacing())},
                   {"origin", pointOf(volume.grid.origin())},
                   {"size", pointOf(worldSize(volume.grid))},
                   {"axes", Json::array({pointOf(axes[0]), pointOf(axes[1]), pointOf(axes[2])})},
                   {"storeys", storeysJson(volume)},
                   {"features", featuresJson(volume.labels)},
                   {"hasEdges", !volume.vectors.segments.empty()},
                   {"hasMeshes", !volume.vectors.triangles.empty()},
                   {"spacingReason", session.spacingReason()},
                   {"details", session.details()},
                   {"attributes", attributes},
                   {"attributeUses", attributeUses(volume.labels, attributes)},
                   {"findings", findingsJson(session.findings())}});
}

Result<std::string> propertiesOf(Session& session, const std::string& id) {
    const volume::SemanticVolume& volume = session.volume();
    const auto& labels = volume.labels.labels;
    const auto found =
        std::find_if(labels.begin(), labels.end(), [&](const volume::Label& label) { return label.id == id; });
    if (found == labels.end())
        return Error(Code::NothingSelected, fmt::format("there is no feature with the id '{}'", id));
    const auto index = static_cast<std::uint32_t>(found - labels.begin());
    const auto around = session.isOfParts() ? session.around(index) : nullptr;
    if (around) {
        const Vec3d by = around->volume().grid.origin() - volume.grid.origin();
        return propertiesIn(*around, index, by);
    }
    return propertiesIn(session, index, {});
}

std::string attributeValuesOf(const Session& session, const std::string& name) {
    Json values = Json::array();
    std::optional<std::string> unit;
    std::vector<Attribute> named;
    for (const volume::Label& label : session.volume().labels.labels) {
        named.clear();
        for (const Attribute& attribute : label.attributes)
            if (attribute.name == name) named.push_back(attribute);
        Json value;
        for (const AttributeList& list : attributeLists(named)) {
            const Attribute* only = list.isSingle() ? list.items.front().attribute : nullptr;
            const auto* number = only == nullptr ? nullptr : std::get_if<double>(&only->value);
            const auto* whole = only == nullptr ? nullptr : std::get_if<std::int64_t>(&only->value);
            const std::string own = only == nullptr ? std::string() : only->unit;
            if ((number != nullptr || whole != nullptr) && unit.value_or(own) == own) {
                unit = own;
                value = number != nullptr ? Json(*number) : Json(*whole);
            } else {
                value = toText(list) + (own.empty() ? "" : " " + own);
            }
        }
        values.push_back(std::move(value));
    }
    return textOf({{"values", std::move(values)}, {"unit", unit.value_or(std::string())}});
}

std::string pickOf(Session& session, double x, double y, double reach) {
    const auto picked = session.pick(x, y);
    if (!picked) return "null";
    Json json{{"scalar", picked->scalar}};
    json.update(namesOf(session.volume().labels.labels[picked->label]));
    json["point"] = pointOf(picked->point);
    if (const auto snapped = snapTo(session.volume().vectors, picked->point, reach); reach > 0 && snapped)
        json["snapped"] = {{"point", pointOf(snapped->point)}, {"to", snapped->isCorner ? "corner" : "edge"}};
    return textOf(json);
}

Result<std::string> intervalsOf(Session& session, double x, double y) {
    SVT_TRY(intervals, session.along(x, y));
    Json list = Json::array();
    for (const render::LabelInterval& interval : *intervals) {
        Json row = namesOf(session.volume().labels.labels[interval.label]);
        row["from"] = interval.enter;
        row["to"] = interval.leave;
        list.push_back(std::move(row));
    }
    return textOf(list);
}

Result<std::string> selectionOf(const Session& session, const std::string& query) {
    const auto& table = session.volume().labels;
    SVT_TRY(selected, analyze::selectLabels(session.volume(), query));
    Json list = Json::array();
    for (const std::uint32_t l : *selected) list.push_back(table.labels[l].id);
    return textOf(list);
}

std::string attributesFoundIn(const Session& session, const std::string& words) {
    const std::vector<std::string> wanted = wordsOf(lowerAscii(words));
    Json list = Json::array();
    const auto hasAll = [&](const Attribute& attribute) {
        const std::string text = lowerAscii(attribute.name + " " + toText(attribute.value));
        return std::all_of(wanted.begin(), wanted.end(),
                           [&](const std::string& word) { return text.find(word) != std::string::npos; });
    };
    for (const volume::Label& label : session.volume().labels.labels)
        if (!wanted.empty() && std::any_of(label.attributes.begin(), label.attributes.end(), hasAll))
            list.push_back(label.id);
    return textOf(list);
}

}  // namespace svt::web
