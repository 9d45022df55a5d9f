#include <svt/drawing/dimension/part_roles.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace svt::drawing {
namespace {

using std::string_view;

constexpr string_view kPlantWords[] = {"tree",   "trees", "rpc",   "plant",   "plants",     "shrub",
                                       "shrubs", "hedge", "bush",  "grass",   "vegetation", "entourage",
                                       "baum",   "hecke", "busch", "strauch", "pflanze",    "rasen"};
constexpr string_view kPlantEndings[] = {"baum", "b\u00E4ume", "hecke", "busch", "strauch"};
constexpr string_view kOuterLayers[] = {"cladding", "roofing", "insulation"};  // coverings
constexpr string_view kUnmeasured[] = {"covering", "proxy",   "railing",   "shading",     "terrace",
                                       "terrasse", "balcony", "balkon",    "canopy",      "shutter",
                                       "handle",   "furnish", "furniture", "installation"};
constexpr string_view kFrameTypes[] = {"beam", "member", "rafter",  "purlin", "post",    "stair",
                                       "ramp", "pile",   "chimney", "truss",  "reinforc"};
constexpr string_view kHullTypes[] = {"wall", "slab", "roof", "plate", "floor", "footing", "foundation", "curtain"};

bool hasOneOf(string_view text, std::span<const string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](string_view word) { return text.find(word) != string_view::npos; });
}

// Whether a name has a word for vegetation; "Treehouse" and "Planter" do not.
bool isPlant(const std::string& lower) {
    for (std::size_t n = 0; n < lower.size();) {
        const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; };
        std::size_t end = n;
        while (end < lower.size() && isLetter(lower[end])) ++end;
        const string_view word = string_view(lower).substr(n, end - n);
        for (const string_view plant : kPlantWords)
            if (word == plant) return true;
        for (const string_view ending : kPlantEndings)
            if (word.ends_with(ending)) return true;
        n = std::max(end, n + 1);
    }
    return false;
}

// The role of an element by its type; nothing if no word is known.
std::optional<PartRole> roleOfType(const std::string& type, const volume::Label& label) {
    if (type.find("ifcdoor") != std::string::npos || type.find("ifcwindow") != std::string::npos)
        return PartRole::Opening;
    if (type.find("proxy") != std::string::npos && isPlant(lowerAscii(label.name))) return PartRole::Surroundings;
    const std::string predefined = lowerTexts(label, {"predefinedType"});
    if (type.find("covering") != std::string::npos && hasOneOf(predefined, kOuterLayers)) return PartRole::Frame;
    if (hasOneOf(type, kUnmeasured)) return PartRole::Nothing;
    if (type.find("column") != std::string::npos) return PartRole::Column;
    if (hasOneOf(type, kFrameTypes)) {
        return predefined.find("mullion") != std::string::npos ? PartRole::Hull : PartRole::Frame;
    }
    if (hasOneOf(type, kHullTypes)) return PartRole::Hull;
    return std::nullopt;
}

PartRole roleOfElement(const volume::Label& label, PartRole parent) {
    const std::string type = lowerTexts(label, {"ifcType", "function"});
    if (const auto role = roleOfType(type, label)) return *role;
    if (parent == PartRole::Hull) return parent;
    if (!type.empty()) return PartRole::Frame;
    const std::string name = lowerAscii(label.name);
    if (isPlant(name)) return PartRole::Surroundings;
    return hasOneOf(name, kUnmeasured) ? PartRole::Nothing : PartRole::Hull;
}

bool isPartOfTerrain(string_view surface) {
    return surface.starts_with("Water") || surface.starts_with("Transportation") || surface.find("Traffic") == 0 ||
           surface.starts_with("AuxiliaryTraffic") || surface.ends_with("Marking");
}

PartRole roleOf(const volume::Label& label, PartRole parent) {
    const string_view name = label.className;
    if (model::isSpace(name)) return PartRole::Space;
    if (parent == PartRole::Opening) return parent;
    if (model::isPhase(name)) return parent;
    switch (model::classRank(name)) {
        case model::ClassRank::Furniture:
            return name.ends_with("Furniture") && name != "CityFurniture" ? PartRole::Nothing : PartRole::Surroundings;
        case model::ClassRank::Filling: return PartRole::Opening;
        case model::ClassRank::Installation: return PartRole::Nothing;
        case model::ClassRank::Element:
            if (name == "ClosureSurface") return PartRole::Nothing;
            if (!model::isBoundarySurface(name)) return roleOfElement(label, parent);
            return isPartOfTerrain(name)         ? PartRole::Surroundings
                   : parent == PartRole::Nothing ? PartRole::Nothing
                                                 : PartRole::Hull;
        case model::ClassRank::Building: return PartRole::Hull;
        default: return PartRole::Surroundings;
    }
}

}  // namespace

std::vector<PartRole> partRoles(const volume::LabelTable& table) {
    std::vector<PartRole> roles;
    roles.reserve(table.labels.size());
    for (const volume::Label& label : table.labels) {
        // Parents come first. Buildings do not decide: their installations would become hull.
        const bool hasParent = label.parent < roles.size() &&
                               model::classRank(table.labels[label.parent].className) != model::ClassRank::Building;
        roles.push_back(roleOf(label, hasParent ? roles[label.parent] : PartRole::Space));
    }
    return roles;
}

std::vector<PartRole> rolesIn(const SectionDrawing& drawing, std::vector<PartRole> roles) {
    const auto isCut = [&](PartRole role) {
        return std::any_of(drawing.components.begin(), drawing.components.end(),
                           [&](const SectionComponent& component) { return roles[component.label] == role; });
    };
    const auto replace = [&](PartRole from, PartRole to) {
        for (PartRole& role : roles)
            if (role == from) role = to;
    };
    if (!isCut(PartRole::Hull)) {
        replace(PartRole::Column, PartRole::Hull);
        replace(PartRole::Frame, PartRole::Nothing);
        return roles;
    }
    replace(PartRole::Column, PartRole::Frame);
    // A post that touches a beam at a wall counts too.
    for (bool isChanged = true; isChanged;) {
        isChanged = false;
        for (const SectionBorder& border : drawing.borders) {
            if (border.left == volume::kNoLabel || border.right == volume::kNoLabel) continue;
            PartRole &left = roles[border.left], &right = roles[border.right];
            for (const auto& [hull, other] : {std::pair(&left, &right), std::pair(&right, &left)}) {
                if (*hull != PartRole::Hull || *other != PartRole::Frame) continue;
                *other = PartRole::Hull;
                isChanged = true;
            }
        }
    }
    replace(PartRole::Frame, PartRole::Nothing);
    return roles;
}

}  // namespace svt::drawing
