#include <svt/model/phases.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/surface_uses.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace svt::model {
namespace {

using std::string_view;

constexpr float kAssumedTransparency = 0.7f;
constexpr float kLeastTransparency = 0.2f;  // materials that let less light through are opaque

constexpr std::array<string_view, 14> kGlassWords{"glass",     "glas",    "glazing", "glazed", "verglasung",
                                                  "verre",     "vitrage", "vidrio",  "vetro",  "vidro",
                                                  "beglazing", "szklo",   "sklo",    "lasi"};
constexpr std::array<string_view, 6> kFibreWords{"wool", "fiber", "fibre", "fibres", "fibra", "wolle"};

template <std::size_t N>
bool isAnyOf(string_view word, const std::array<string_view, N>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Compounds of German and Dutch, such as Isolierglas.
bool isGlassWord(string_view word) {
    if (isAnyOf(word, kGlassWords)) return true;
    return (word.ends_with("glas") || word.ends_with("verglasung")) && !word.starts_with("fiber");
}

double areaOf(const Polygon& polygon) {
    double area = 0;
    std::size_t begin = 0;
    for (const std::size_t end : polygon.ringEnds) {
        Vec3d twice{};
        for (std::size_t i = begin; i < end; ++i)
            twice = twice + cross(polygon.points[i] - polygon.points[begin],
                                  polygon.points[i + 1 == end ? begin : i + 1] - polygon.points[begin]);
        area += (begin == 0 ? 0.5 : -0.5) * length(twice);
        begin = end;
    }
    return std::max(area, 0.0);
}

// Whether each edge is used as often in one direction as in the other.
bool areClosed(const BuildingModel& model, const std::vector<SurfaceUse>& uses) {
    using Point = std::tuple<double, double, double>;
    std::map<std::pair<Point, Point>, int> edges;
    const auto pointOf = [](Vec3d p) { return Point{p.x, p.y, p.z}; };
    for (const SurfaceUse& use : uses) {
        const Polygon& polygon = model.polygons[use.polygon];
        std::size_t begin = 0;
        for (const std::size_t end : polygon.ringEnds) {
            for (std::size_t i = begin; i < end; ++i) {
                Point a = pointOf(polygon.points[i]), b = pointOf(polygon.points[i + 1 == end ? begin : i + 1]);
                const bool isForward = a < b;
                if (!isForward) std::swap(a, b);
                edges[{a, b}] += isForward == use.isReversed ? -1 : 1;
            }
            begin = end;
        }
    }
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

// The parts of an object with one material.
struct Group {
    std::int32_t material = -1;
    double area = 0, extent = 0;  // m2; diagonal of its box, metres
    Geometry parts;
    bool isGlass = false, isTransparent = false;
};

class PhaseSplitter {
public:
    explicit PhaseSplitter(BuildingModel& model) : model_(model) {
        // Files repeat equal materials.
        std::map<std::tuple<string_view, string_view, bool, float, float, float, float>, std::int32_t> known;
        for (const Material& m : model.materials)
            same_.push_back(
                known
                    .try_emplace({m.name, m.part, m.hasColor, m.diffuse.x, m.diffuse.y, m.diffuse.z, m.transparency},
                                 static_cast<std::int32_t>(same_.size()))
                    .first->second);
    }

    std::size_t run() {
        const std::size_t count = model_.materials.empty() ? 0 : model_.features.size();
        for (FeatureIndex f = 0; f < count; ++f)
            if (mayHavePhases(model_.features[f])) split(f);
        return added_;
    }

private:
    static bool mayHavePhases(const Feature& feature) {
        if (feature.geometries.empty() || isSpace(feature.className) || isPhase(feature.className)) return false;
        return std::none_of(feature.attributes.begin(), feature.attributes.end(),
                            [](const Attribute& attribute) { return attribute.name == kPhaseAttribute; });
    }

    static bool isBuiltPart(const Feature& feature) {
        return classRank(feature.className) <= ClassRank::Element && feature.className != "SolitaryVegetationObject" &&
               feature.className != "PlantCover";
    }

    void split(FeatureIndex f) {
        std::vector<Group> groups = groupsOf(model_.features[f]);
        if (groups.empty()) return;
        const bool isSplit = groups.size() > 1;
        // The opaque group of the largest extent comes first: the frame of a door, not its leaf.
        for (Group& group : groups) group.extent = length(model_.bounds(group.parts).size());
        std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
            const double slack = 1e-6 * a.extent;
            if (a.isTransparent != b.isTransparent) return b.isTransparent;
            if (std::abs(a.extent - b.extent) > slack) return a.extent > b.extent;
            return a.area > b.area;
        });
        while (groups.size() > kMaxPhases + 1) {
            join(groups.back().parts, groups.front().parts);
            groups.pop_back();
        }
        describe(model_.features[f], groups.front(), isSplit);
        if (!isSplit) return;
        const bool hadSolids = model_.features[f].geometries.front().kind == GeometryKind::Solid;
        replace(model_.features[f].geometries.front(), std::move(groups.front().parts), hadSolids);
        for (std::size_t g = 1; g < groups.size(); ++g) {
            Feature phase;
            phase.id = model_.features[f].id + "_phase" + std::to_string(g);
            phase.className = phaseClassOf(model_.features[f].className);
            phase.line = model_.features[f].line;
            describe(phase, groups[g], true);
            phase.name = std::get<std::string>(phase.attributes.front().value);
            Geometry geometry;
            geometry.lod = model_.features[f].geometries.front().lod;
            replace(geometry, std::move(groups[g].parts), hadSolids);
            phase.geometries.push_back(std::move(geometry));
            model_.addFeature(std::move(phase), f);
            ++added_;
        }
    }

    static void join(const Geometry& from, Geometry& to) {
        to.solids.insert(to.solids.end(), from.solids.begin(), from.solids.end());
        to.surfaces.insert(to.surfaces.end(), from.surfaces.begin(), from.surfaces.end());
    }

    static void replace(Geometry& geometry, Geometry parts, bool hadSolids) {
        geometry.solids = std::move(parts.solids);
        geometry.surfaces = std::move(parts.surfaces);
        geometry.isComposite = false;
        geometry.kind = hadSolids && !geometry.solids.empty() ? GeometryKind::Solid : GeometryKind::Surface;
    }

    [[nodiscard]] std::int32_t materialOf(const SurfaceUse& use) const {
        const std::int32_t material = model_.polygons[use.polygon].material;
        return material < 0 ? -1 : same_[static_cast<std::size_t>(material)];
    }

    // Whether all faces of an object have one material, as most objects do.
    bool hasOneMaterial(const Feature& feature, std::int32_t& material) const {
        bool isOne = true, isFirst = true;
        for (const Geometry& geometry : feature.geometries)
            forEachUse(geometry, [&](const SurfaceUse& use) {
                if (isFirst) material = materialOf(use);
                isFirst = false;
                isOne = isOne && materialOf(use) == material;
            });
        return isOne;
    }

    // The material with the largest area of some faces; -1: none.
    std::int32_t mainMaterial(const std::vector<SurfaceUse>& uses, double& area) const {
        std::map<std::int32_t, double> areas;
        for (const SurfaceUse& use : uses) {
            const double own = areaOf(model_.polygons[use.polygon]);
            areas[materialOf(use)] += own;
            area += own;
        }
        const auto best = std::max_element(areas.begin(), areas.end(),
                                           [](const auto& p, const auto& q) { return p.second < q.second; });
        return best == areas.end() ? -1 : best->first;
    }

    // The groups into which an object is split; one if it stays whole.
    [[nodiscard]] std::vector<Group> groupsOf(const Feature& feature) const {
        std::map<std::int32_t, Group> byMaterial;
        if (std::int32_t material = -1; hasOneMaterial(feature, material)) {
            std::vector<Group> whole(1);
            whole.front().material = material;
            classify(feature, whole.front());
            return whole;
        }
        for (const Geometry& geometry : feature.geometries) {
            for (const Solid& solid : geometry.solids) {
                double area = 0;
                Group& group = byMaterial[mainMaterial(solid.exterior, area)];
                group.area += area;
                group.parts.solids.push_back(solid);
            }
            for (const SurfaceUse& use : geometry.surfaces) {
                Group& group = byMaterial[materialOf(use)];
                group.area += areaOf(model_.polygons[use.polygon]);
                group.parts.surfaces.push_back(use);
            }
        }
        std::vector<Group> groups;
        for (auto& [material, group] : byMaterial) {
            group.material = material;
            classify(feature, group);
            groups.push_back(std::move(group));
        }
        return isWhole(feature, groups) ? oneOf(std::move(groups)) : withRest(feature, std::move(groups));
    }

    void classify(const Feature& feature, Group& group) const {
        if (group.material < 0) return;
        const Material& material = model_.materials[static_cast<std::size_t>(group.material)];
        group.isTransparent = material.transparency >= kLeastTransparency;
        group.isGlass = saysGlass(material.part) || saysGlass(material.name) ||
                        (group.isTransparent && isBuiltPart(feature) && !isBoundarySurface(feature.className));
        if (group.isGlass && isFilling(feature.className)) group.isTransparent = true;
    }

    // Whether an object is not split: its class, its levels of detail, or surfaces that only together are closed.
    [[nodiscard]] bool isWhole(const Feature& feature, const std::vector<Group>& groups) const {
        if (groups.size() < 2 || feature.geometries.size() > 1 || isBoundarySurface(feature.className)) return true;
        if (insideOf(feature.className) == Inside::Never || classRank(feature.className) == ClassRank::Building)
            return true;
        if (std::all_of(groups.begin(), groups.end(),
                        [&](const Group& group) { return areClosed(model_, group.parts.surfaces); }))
            return false;
        const bool boundsSpace =
            feature.parent != kNoFeature && isBoundarySurface(model_.features[feature.parent].className);
        return boundsSpace || insideOf(feature.className) == Inside::Always ||
               areClosed(model_, feature.geometries.front().surfaces);
    }

    static std::vector<Group> oneOf(std::vector<Group> groups) {
        if (groups.size() < 2) return groups;
        const auto largest = std::max_element(groups.begin(), groups.end(),
                                              [](const Group& a, const Group& b) { return a.area < b.area; });
        // Faces that are closed only together: the whole is glass only if most of it is.
        return {std::move(*largest)};
    }

    // Joins the parts that do not become phases: those without material, and opaque ones of walls and their like.
    [[nodiscard]] std::vector<Group> withRest(const Feature& feature, std::vector<Group> groups) const {
        const ClassRank rank = classRank(feature.className);
        const bool splitsColors = rank <= ClassRank::Installation;
        std::vector<Group> result;
        std::vector<Group> rest;
        for (Group& group : groups) {
            const bool isNamed =
                group.material >= 0 && !model_.materials[static_cast<std::size_t>(group.material)].part.empty();
            const bool isPhase =
                group.material >= 0 && (splitsColors || isNamed || group.isTransparent || group.isGlass);
            (isPhase ? result : rest).push_back(std::move(group));
        }
        if (rest.empty()) return result;
        const auto largest =
            std::max_element(rest.begin(), rest.end(), [](const Group& a, const Group& b) { return a.area < b.area; });
        Group all = *largest;
        all.parts = {};
        all.area = 0;
        for (const Group& group : rest) {
            join(group.parts, all.parts);
            all.area += group.area;
        }
        result.push_back(std::move(all));
        return result;
    }

    // Adds the attributes of a phase; `isSplit`: the object has others.
    void describe(Feature& feature, const Group& group, bool isSplit) const {
        const Material none;
        const Material& material =
            group.material < 0 ? none : model_.materials[static_cast<std::size_t>(group.material)];
        const auto add = [&](string_view name, AttributeValue value) {
            feature.attributes.push_back({std::string(name), std::move(value), ""});
        };
        const std::string name = group.isGlass            ? std::string(kGlass)
                                 : !material.part.empty() ? material.part
                                 : !material.name.empty() ? material.name
                                                          : std::string("unstyled");
        if (isSplit || group.isGlass) add(kPhaseAttribute, name);
        if (isSplit && !material.name.empty()) add("style", material.name);
        if (!group.isTransparent) return;
        const bool isAssumed = material.transparency < kLeastTransparency;
        const double share = isAssumed ? kAssumedTransparency : material.transparency;
        add(kTransparencyAttribute, std::round(share * 1e4) / 1e4);
        if (isAssumed) add("transparencyAssumed", true);
    }

    BuildingModel& model_;
    std::vector<std::int32_t> same_;  // by material: the first that equals it
    std::size_t added_ = 0;
};

}  // namespace

bool saysGlass(string_view name) {
    const std::string text = lowerAscii(name);
    bool isGlass = false;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; };
        while (end < text.size() && isLetter(text[end])) ++end;
        const string_view word = string_view(text).substr(i, end - i);
        if (isAnyOf(word, kFibreWords)) return false;
        isGlass = isGlass || isGlassWord(word);
        i = end + 1;
    }
    return isGlass;
}

std::size_t splitPhases(BuildingModel& model) { return PhaseSplitter(model).run(); }

}  // namespace svt::model
