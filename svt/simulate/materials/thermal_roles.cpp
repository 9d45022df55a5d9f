#include <svt/simulate/materials/thermal_roles.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/simulate/materials/plate_thickness.hpp>
#include <svt/simulate/materials/thermal_words.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace svt::simulate {
namespace {

using volume::kNoLabel;
using volume::Label;

// The attribute of this name, else the first whose name ends with ".NAME".
const Attribute* findAttribute(const Label& label, std::string_view name) {
    const Attribute* member = nullptr;
    for (const Attribute& attribute : label.attributes) {
        const std::string_view own = attribute.name;
        if (own == name) return &attribute;
        const bool isMember =
            own.size() > name.size() && own.ends_with(name) && own[own.size() - name.size() - 1] == '.';
        if (isMember && member == nullptr) member = &attribute;
    }
    return member;
}

std::string textOf(const Label& label, std::string_view name) {
    const Attribute* attribute = findAttribute(label, name);
    return attribute != nullptr ? toText(attribute->value) : std::string();
}

std::optional<double> numberOf(const Label& label, std::string_view name) { return parseNumber(textOf(label, name)); }

bool isGround(const Label& label) {
    return textOf(label, "ifcType") == "IfcSite" || label.className == "LandUse" || label.className == "WaterBody" ||
           label.className.find("Relief") != std::string::npos;
}

// Surfaces without an inside that bound a room or a wall have no thickness.
bool isPassive(const Label& label) {
    const model::ClassRank rank = model::classRank(label.className);
    return rank == model::ClassRank::Furniture || rank == model::ClassRank::Installation ||
           (label.filling == volume::Filling::Surface && model::isBoundarySurface(label.className));
}

// A figure of a material, and where it is from.
struct Figure {
    double value = 0;
    std::string source, detail;
};

// A layer or several in series.
struct Series {
    double conductivity = 0, heatCapacity = 0;
};

// The equivalent figures of layers in series: "Beton 0.2 m; Putz 0.01 m". Nothing if one of them is unknown.
std::optional<Series> seriesOf(std::string_view layers) {
    double thickness = 0, resistance = 0, capacity = 0;
    std::size_t count = 0;
    while (!layers.empty()) {
        std::string_view layer = layers.substr(0, layers.find(';'));
        layers.remove_prefix(std::min(layer.size() + 1, layers.size()));
        layer = withoutBlanks(layer);
        if (!layer.ends_with(" m")) return std::nullopt;
        layer.remove_suffix(2);
        const std::size_t blank = layer.rfind(' ');
        if (blank == std::string_view::npos) return std::nullopt;
        const auto d = parseNumber(layer.substr(blank + 1));
        std::string_view word;
        const ThermalWord* row = findThermalWord(layer.substr(0, blank), word);
        if (!d || !(*d > 0) || row == nullptr) return std::nullopt;
        thickness += *d;
        resistance += *d / row->conductivity;
        capacity += *d * row->heatCapacity();
        ++count;
    }
    if (count == 0) return std::nullopt;
    return Series{thickness / resistance, capacity / thickness};
}

class RoleFinder {
public:
    RoleFinder(const volume::SemanticVolume& volume, const HeatOptions& options)
        : volume_(volume), options_(options), labels_(volume.labels.labels) {}

    Result<ThermalRoles> find(Diagnostics& findings) {
        SVT_DO(readRules());
        ThermalRoles roles;
        roles.ofScalar.resize(volume_.labels.scalarCount());
        roles.zones.push_back({});
        roles.zones.front().celsius = options_.outside;
        roles.zones.front().source = "--outside";
        roles_ = &roles;
        for (std::uint32_t l = 0; l < labels_.size(); ++l) {
            if (labels_[l].count == 0) continue;
            // A model may have many objects that lost all their voxels.
            const ScalarRole role = roleOf(l);
            for (volume::Scalar s = 0; s < labels_[l].count; ++s) roles.ofScalar[labels_[l].first + s] = role;
        }
        if (roles.zones.size() == 1)
            return Error(Code::BadArgument,
                         "the volume has no rooms, so nothing is heated; build it from a model with "
                         "rooms (BuildingRoom, IfcSpace)");
        for (auto& [key, assumption] : assumed_) roles.assumed.push_back(std::move(assumption));
        for (auto& [key, assumption] : capacities_) roles.capacities.push_back(std::move(assumption));
        report(roles, findings);
        return roles;
    }

private:
    Result<void> readRules() {
        const analyze::LabelRows rows(volume_);
        ruleOf_.assign(labels_.size(), nullptr);
        for (const ThermalRule& rule : options_.materials) {
            SVT_TRY(selected, analyze::selectWithParts(rows, rule.query));
            for (const std::uint32_t l : *selected)
                if (ruleOf_[l] == nullptr) ruleOf_[l] = &rule;
        }
        temperatureOf_.assign(labels_.size(), nullptr);
        for (const RoomTemperature& rule : options_.inside) {
            SVT_TRY(selected, analyze::selectWithParts(rows, rule.query));
            const bool hasRoom = std::any_of(selected->begin(), selected->end(),
                                             [&](std::uint32_t l) { return model::isSpace(labels_[l].className); });
            if (!hasRoom)
                return Error(Code::NothingSelected,
                             fmt::format("the query '{}' of a room's temperature selects no room", rule.query));
            for (const std::uint32_t l : *selected) temperatureOf_[l] = &rule;
        }
        return {};
    }

    // The object that a phase belongs to.
    [[nodiscard]] std::uint32_t ownerOf(std::uint32_t l) const {
        while (model::isPhase(labels_[l].className) && labels_[l].parent < l) l = labels_[l].parent;
        return l;
    }

    ScalarRole roleOf(std::uint32_t l) {
        const std::uint32_t owner = ownerOf(l);
        const Label& label = labels_[owner];
        ScalarRole role{Role::Solid, 0, owner, 0};
        const ThermalRule* rule = ruleOf_[l] != nullptr ? ruleOf_[l] : ruleOf_[owner];
        if (model::isSpace(label.className)) {  // whatever a rule for a whole storey says
            role.role = Role::Room;
            role.number = zoneOf(owner);
        } else if (rule != nullptr) {
            role.conductivity = rule->conductivity;
            if (!(role.conductivity > 0)) role.role = Role::Blocked;
            assume(owner, {role.conductivity, "table", rule->query});
            role.heatCapacity = assumeCapacity(owner, capacityOf(owner, rule));
        } else if (model::isFilling(label.className)) {
            role.role = Role::Opening;
            role.number = openingOf(owner);
        } else if (isGround(label)) {
            role.role = Role::Ground;
            role.conductivity = kGroundConductivity;
            assume(owner, {kGroundConductivity, "word", "terrain"});
            role.heatCapacity = assumeCapacity(owner, {kGroundCapacity, "word", "terrain"});
        } else if (isPassive(label)) {
            role.role = Role::Passive;
        } else {
            const Figure known = conductivityOf(owner);
            role.conductivity = known.value;
            assume(owner, known);
            role.heatCapacity = assumeCapacity(owner, capacityOf(owner, nullptr));
        }
        return role;
    }

    std::uint32_t zoneOf(std::uint32_t l) {
        const auto [at, isNew] = zoneOfLabel_.try_emplace(l, static_cast<std::uint32_t>(roles_->zones.size()));
        if (!isNew) return at->second;
        ZoneHeat& zone = roles_->zones.emplace_back();
        zone.label = l;
        const auto stated = numberOf(labels_[l], "SpaceTemperatureMin");
        if (temperatureOf_[l] != nullptr) {
            zone.celsius = temperatureOf_[l]->celsius;
            zone.source = "--inside";
        } else if (stated && *stated > -60 && *stated < 100) {
            zone.celsius = *stated;
            zone.source = "model";
        } else {
            zone.celsius = 20;
            zone.source = "default";
        }
        return at->second;
    }

    std::uint32_t openingOf(std::uint32_t l) {
        const auto [at, isNew] = openingOfLabel_.try_emplace(l, static_cast<std::uint32_t>(roles_->openings.size()));
        if (!isNew) return at->second;
        OpeningHeat& opening = roles_->openings.emplace_back();
        opening.label = l;
        const auto stated = numberOf(labels_[l], "ThermalTransmittance");
        const bool isDoor = labels_[l].className.starts_with("Door");
        opening.transmittance = stated && *stated > 0 ? *stated : isDoor ? kDoorTransmittance : kWindowTransmittance;
        opening.source = stated && *stated > 0 ? "model" : "default";
        return at->second;
    }

    Figure conductivityOf(std::uint32_t l) {
        const Label& label = labels_[l];
        if (const auto stated = numberOf(label, "ThermalConductivity"); stated && *stated > 0)
            return {*stated, "model", "ThermalConductivity"};
        // A layer of a wall has the attributes of the wall.
        const bool isLayer = !textOf(label, "layer").empty();
        if (const auto u = numberOf(label, "ThermalTransmittance"); !isLayer && u && *u > 0 && *u < 10) {
            if (thickness_.empty()) thickness_ = plateThicknesses(volume_);
            const double films = isInterior(label) ? 2 * options_.resistances.inside
                                                   : options_.resistances.inside + options_.resistances.outside;
            const double resistance = 1 / *u - films;
            if (resistance > 0.01 && thickness_[l] > 0)
                return {thickness_[l] / resistance, "transmittance", fmt::format("{} W/(m2 K)", *u)};
        }
        if (const std::string layers = textOf(label, "materialLayers"); !isLayer && !layers.empty())
            if (const auto series = seriesOf(layers)) return {series->conductivity, "word", layers};
        for (const std::string& name : {textOf(label, "material"), label.name}) {
            std::string_view word;
            if (const ThermalWord* row = findThermalWord(name, word))
                return {row->conductivity, "word", std::string(word)};
        }
        return {kUnknownConductivity, "default", label.className};
    }

    // J/(m3 K)
    [[nodiscard]] Figure capacityOf(std::uint32_t l, const ThermalRule* rule) const {
        const Label& label = labels_[l];
        if (rule != nullptr && rule->density > 0 && rule->specificHeat > 0)
            return {rule->density * rule->specificHeat, "table", rule->query};
        const auto density = numberOf(label, "MassDensity"), heat = numberOf(label, "SpecificHeatCapacity");
        if (density && heat && *density > 0 && *heat > 0)
            return {*density * *heat, "model", "MassDensity, SpecificHeatCapacity"};
        if (const std::string layers = textOf(label, "materialLayers"); textOf(label, "layer").empty())
            if (const auto series = seriesOf(layers)) return {series->heatCapacity, "word", layers};
        for (const std::string& name : {textOf(label, "material"), label.name}) {
            std::string_view word;
            if (const ThermalWord* row = findThermalWord(name, word))
                return {row->heatCapacity(), "word", std::string(word)};
        }
        return {kUnknownCapacity, "default", label.className};
    }

    double assumeCapacity(std::uint32_t l, const Figure& known) {
        if (labels_[l].voxels == 0) return known.value;
        CapacityAssumption& assumption = capacities_[{known.source, known.detail, known.value}];
        assumption.source = known.source;
        assumption.detail = known.detail;
        assumption.heatCapacity = known.value;
        if (assumption.labels.empty() || assumption.labels.back() != l) assumption.labels.push_back(l);
        return known.value;
    }

    static bool isInterior(const Label& label) { return textOf(label, "IsExternal") == "false"; }

    void assume(std::uint32_t l, const Figure& known) {
        if (labels_[l].voxels == 0) return;
        ThermalAssumption& assumption = assumed_[{known.source, known.detail, known.value}];
        assumption.source = known.source;
        assumption.detail = known.detail;
        assumption.conductivity = known.value;
        if (assumption.labels.empty() || assumption.labels.back() != l) assumption.labels.push_back(l);
    }

    void report(const ThermalRoles& roles, Diagnostics& findings) const {
        for (const ThermalAssumption& assumption : roles.assumed) {
            if (assumption.source != "default") continue;
            const Label& first = labels_[assumption.labels.front()];
            findings.add(
                Severity::Warning, Code::UnknownMaterial,
                fmt::format("{} components of class {} have no known conductivity; {} W/(m K) is assumed; name "
                            "their materials in a table (--materials)",
                            assumption.labels.size(), first.className, assumption.conductivity),
                {volume_.source, 0, 0, first.id});
        }
    }

    const volume::SemanticVolume& volume_;
    const HeatOptions& options_;
    const std::vector<Label>& labels_;
    std::vector<const ThermalRule*> ruleOf_;
    std::vector<const RoomTemperature*> temperatureOf_;
    std::vector<double> thickness_;  // empty: not computed yet
    std::map<std::uint32_t, std::uint32_t> zoneOfLabel_, openingOfLabel_;
    std::map<std::tuple<std::string, std::string, double>, ThermalAssumption> assumed_;
    std::map<std::tuple<std::string, std::string, double>, CapacityAssumption> capacities_;
    ThermalRoles* roles_ = nullptr;
};

}  // namespace

Result<ThermalRoles> findThermalRoles(const volume::SemanticVolume& volume, const HeatOptions& options,
                                      Diagnostics& findings) {
    return RoleFinder(volume, options).find(findings);
}

}  // namespace svt::simulate
