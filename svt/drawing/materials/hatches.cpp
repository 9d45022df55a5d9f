#include <svt/drawing/hatches.hpp>

#include <svt/core/check.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/phases.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace svt::drawing {
namespace {

using render::Hatch;

struct Rule {
    const char* select;
    Hatch hatch;
};

// The last matching rule wins.
constexpr Rule kRules[] = {
    {"all", Hatch::General},
    {"class=Building or class=BuildingPart or class=CityObjectGroup", Hatch::None},
    {"class=BuildingRoom or class=BuildingUnit or class=Storey or class=HollowSpace or class=ClosureSurface",
     Hatch::None},
    {"class=WallSurface or class=InteriorWallSurface or ifcType~Wall", Hatch::Masonry},
    {"class=GroundSurface or class=FloorSurface or class=CeilingSurface or ifcType~'Slab|Footing|Stair'",
     Hatch::ReinforcedConcrete},
    {"name~'[Ss]lab|[Dd]ecke|[Bb]odenplatte'", Hatch::ReinforcedConcrete},
    {"ifcType~Beam or ifcType~Column or name~'[Bb]eam|Unterzug'", Hatch::ReinforcedConcrete},
    {"class=RoofSurface or ifcType~'Member|Roof' or name~'[Rr]after|Sparren|Pfette|[Pp]urlin'", Hatch::Timber},
    {"class=Door or class=DoorSurface or class=BuildingFurniture or ifcType~Door", Hatch::Timber},
    {"class=DoorPhase or class=BuildingFurniturePhase", Hatch::Timber},
    {"class=Window or class=WindowSurface or class=WindowPhase or ifcType~Window or phase=glass", Hatch::Glass},
    {"class=TINRelief or class=ReliefFeature or class=LandUse or ifcType=IfcSite", Hatch::Earth},
    {"class=SolitaryVegetationObject or class=PlantCover or class~Water", Hatch::None},
};

std::vector<Hatch> hatchesOfClasses(std::span<const model::QueryRow> rows) {
    std::vector<Hatch> hatches(rows.size(), Hatch::None);
    for (const Rule& rule : kRules) {
        const auto query = model::Query::parse(rule.select);
        SVT_CHECK(query.hasValue());
        for (const std::uint32_t label : query->select(rows)) hatches[label] = rule.hatch;
    }
    return hatches;
}

const std::string* textOf(const model::QueryRow& row, std::string_view name) noexcept {
    for (const Attribute& attribute : row.attributes)
        if (attribute.name == name) return std::get_if<std::string>(&attribute.value);
    return nullptr;
}

// A part of a window that is not its pane: its phases, and the window itself if the file names its parts.
bool isFrame(const model::QueryRow& row) noexcept {
    const std::string* phase = textOf(row, model::kPhaseAttribute);
    return phase != nullptr && *phase != model::kGlass;
}

// A phase that has the material of its object: the leaf of a door.
bool isWithoutMaterial(const model::QueryRow& row) noexcept {
    return model::isPhase(row.className) && textOf(row, "material") == nullptr && textOf(row, "hatch") == nullptr;
}

struct Layer {
    std::string name;
    double thickness = 0;  // metres; 0: unknown
};

std::vector<std::string> splitNames(std::string_view text, char separator) {
    std::vector<std::string> names;
    while (!text.empty()) {
        const std::string_view name = text.substr(0, text.find(separator));
        text.remove_prefix(std::min(name.size() + 1, text.size()));
        if (!withoutBlanks(name).empty()) names.emplace_back(withoutBlanks(name));
    }
    return names;
}

// "Brick, common 0.1 m": name and thickness.
Layer layerOf(const std::string& text) {
    if (!text.ends_with(" m")) return {text, 0};
    const std::string_view rest = std::string_view(text).substr(0, text.size() - 2);
    const std::size_t blank = rest.rfind(' ');
    const auto thickness = blank == std::string_view::npos ? std::nullopt : parseNumber(rest.substr(blank + 1));
    return thickness ? Layer{std::string(rest.substr(0, blank)), *thickness} : Layer{text, 0};
}

class HatchChooser {
public:
    explicit HatchChooser(const MaterialTable& table) : table_(table) {}

    // \param ofClass  hatch by class and name
    HatchChoice choose(const model::QueryRow& row, Hatch ofClass) {
        if (const std::string* stated = textOf(row, "hatch"))
            if (const auto hatch = fromName<Hatch>(*stated)) return {*hatch, HatchSource::Stated, {}, {}};
        HatchChoice choice{ofClass, HatchSource::Class, {}, {}};
        const std::string* const materials = textOf(row, "material");
        if (materials != nullptr) choice.material = *materials;
        // Rooms, plants and water have no hatch, whatever their material.
        if (ofClass == Hatch::None) return choice;
        if (ofClass == Hatch::Glass) {
            if (isFrame(row)) return ofFrame(row);
            choice.source = HatchSource::Window;
            return choice;
        }
        if (auto structure = byStructure(row)) return std::move(*structure);
        if (const std::string* layers = textOf(row, "materialLayers")) {
            std::vector<Layer> list;
            for (const std::string& layer : splitNames(*layers, ';')) list.push_back(layerOf(layer));
            if (auto found = decide(list)) return std::move(*found);
        }
        if (materials == nullptr) return choice;
        std::vector<Layer> list;
        const bool isList = materials->find(';') != std::string::npos;
        for (std::string& name : splitNames(*materials, isList ? ';' : ',')) list.push_back({std::move(name), 0});
        auto found = decide(list);
        if (!found) return choice;
        // A comma may be a part of one name: "Brick, Common".
        if (!isList && found->source == HatchSource::Material) found->material = *materials;
        return std::move(*found);
    }

private:
    // By its own material or style. The material of a window names that of its panes, too.
    HatchChoice ofFrame(const model::QueryRow& row) {
        for (const char* attribute : {"material", "style"}) {
            const std::string* stated = textOf(row, attribute);
            if (stated == nullptr) continue;
            for (const std::string& name : splitNames(*stated, stated->find(';') != std::string::npos ? ';' : ','))
                if (const auto& match = find(name); match && match->row.hatch != Hatch::Glass)
                    return choiceOf(name, *match, HatchSource::Material);
        }
        return {Hatch::None, HatchSource::Class, {}, {}};
    }

    // By the structural material of a wall. Its layers inherit this property, but have their own materials.
    std::optional<HatchChoice> byStructure(const model::QueryRow& row) {
        const bool isLayer = std::any_of(row.attributes.begin(), row.attributes.end(),
                                         [](const Attribute& attribute) { return attribute.name == "layer"; });
        if (isLayer) return std::nullopt;
        for (const Attribute& attribute : row.attributes) {
            const auto* name = std::get_if<std::string>(&attribute.value);
            if (name == nullptr || !attribute.name.ends_with("Structural Material")) continue;
            if (const auto& match = find(*name)) return choiceOf(*name, *match, HatchSource::Structure);
        }
        return std::nullopt;
    }

    const std::optional<MaterialTable::Match>& find(const std::string& name) {
        const auto known = known_.find(name);
        if (known != known_.end()) return known->second;
        return known_.emplace(name, table_.find(name)).first->second;
    }

    static HatchChoice choiceOf(const std::string& name, const MaterialTable::Match& match, HatchSource source) {
        return {match.row.hatch, source, name, match.entry};
    }

    // The thickest load-bearing layer; without one, the thickest of the others. The first of equal ones.
    std::optional<HatchChoice> decide(const std::vector<Layer>& layers) {
        const Layer* best = nullptr;
        bool isBearing = false, isKnown = true;
        std::size_t matching = 0;
        for (const Layer& layer : layers) {
            const auto& match = find(layer.name);
            isKnown = isKnown && layer.thickness > 0;
            if (!match || (match->row.hatch == Hatch::None && layers.size() > 1)) continue;
            ++matching;
            const bool isBetter = best == nullptr || (match->row.isLoadBearing && !isBearing) ||
                                  (match->row.isLoadBearing == isBearing && layer.thickness > best->thickness);
            if (!isBetter) continue;
            best = &layer;
            isBearing = match->row.isLoadBearing;
        }
        if (best == nullptr) return std::nullopt;
        const HatchSource source = matching == 1         ? HatchSource::Material
                                   : best->thickness > 0 ? HatchSource::Thickest
                                                         : HatchSource::First;
        return choiceOf(best->name, *find(best->name), source);
    }

    const MaterialTable& table_;
    std::map<std::string, std::optional<MaterialTable::Match>, std::less<>> known_;
};

}  // namespace

std::string_view hatchSourceName(HatchSource source) noexcept {
    constexpr std::string_view kSources[] = {
        "stated", "window", "structural material", "thickest layer", "material", "first material", "class"};
    return kSources[static_cast<std::size_t>(source)];
}

std::vector<HatchChoice> chooseHatches(const analyze::LabelRows& labels, const MaterialTable& table) {
    const std::span<const model::QueryRow> rows = labels.get();
    const std::vector<Hatch> ofClass = hatchesOfClasses(rows);
    HatchChooser chooser(table);
    std::vector<HatchChoice> choices;
    choices.reserve(rows.size());
    for (std::size_t l = 0; l < rows.size(); ++l) {
        const bool hasParent = rows[l].parent < l;
        const bool isOfWindow =
            hasParent && model::isPhase(rows[l].className) && ofClass[rows[l].parent] == Hatch::Glass;
        const Hatch own = isOfWindow ? Hatch::Glass : ofClass[l];
        const bool isOfObject = isWithoutMaterial(rows[l]) && hasParent && own != Hatch::Glass;
        choices.push_back(isOfObject ? choices[rows[l].parent] : chooser.choose(rows[l], own));
    }
    return choices;
}

std::vector<Hatch> labelHatches(const analyze::LabelRows& labels) {
    std::vector<Hatch> hatches;
    for (const HatchChoice& choice : chooseHatches(labels)) hatches.push_back(choice.hatch);
    return hatches;
}

}  // namespace svt::drawing
