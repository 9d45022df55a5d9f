#include <svt/drawing/external_parts.hpp>

#include <svt/analyze/outside_faces.hpp>
#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <variant>

namespace svt::drawing {
namespace {

bool isWallOrDoor(const volume::Label& label) {
    return isWallPart(label) || label.className == "InteriorWallSurface" || label.className.starts_with("Door") ||
           lowerTexts(label, {"ifcType"}).find("ifcdoor") != std::string::npos;
}

// As the file states it; nothing if it does not.
std::optional<bool> statedExternal(const volume::Label& label) {
    if (label.className == "WallSurface") return true;
    if (label.className == "InteriorWallSurface") return false;
    for (const Attribute& attribute : label.attributes)
        if (const bool* truth = std::get_if<bool>(&attribute.value))
            if (attribute.name == "IsExternal" || attribute.name.ends_with(".IsExternal")) return *truth;
    return std::nullopt;
}

// Layers, phases and surfaces belong to the wall or door that has them.
std::vector<std::uint32_t> ownersOf(const volume::LabelTable& table) {
    std::vector<std::uint32_t> owners;
    for (std::uint32_t l = 0; l < table.labels.size(); ++l) {
        const volume::Label& label = table.labels[l];
        const bool isOfParent =
            label.parent < l &&
            (model::isPhase(label.className) || (isWallOrDoor(table.labels[label.parent]) &&
                                                 (isWallPart(label) || model::isBoundarySurface(label.className))));
        owners.push_back(isOfParent ? owners[label.parent] : l);
    }
    return owners;
}

bool hasRooms(const volume::LabelTable& table) {
    return std::any_of(table.labels.begin(), table.labels.end(), [](const volume::Label& label) {
        const bool isInside =
            model::isSpace(label.className) || model::classRank(label.className) == model::ClassRank::Building;
        return isInside && label.voxels > 0;
    });
}

}  // namespace

std::vector<ExternalPart> findExternalParts(const volume::SemanticVolume& volume) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<ExternalPart> parts(labels.size());
    std::vector<std::uint8_t> isPart;
    for (const volume::Label& label : labels) isPart.push_back(isWallOrDoor(label) ? 1 : 0);
    const std::vector<std::uint32_t> owners = ownersOf(volume.labels);
    bool needsHull = false;
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (isPart[l] == 0) continue;
        if (const auto stated = statedExternal(labels[l]))
            parts[l] = {*stated, ExternalSource::File};
        else
            needsHull = true;
    }
    if (needsHull) {
        const std::vector<PartRole> roles = partRoles(volume.labels);
        std::vector<std::uint32_t> groupOf = volume.labels.labelOfScalar();
        for (std::uint32_t& group : groupOf)
            if (group != volume::kNoLabel)
                group = roles[group] == PartRole::Surroundings && isPart[owners[group]] == 0 ? volume::kNoLabel
                                                                                             : owners[group];
        const auto sides = analyze::findSideAreas(volume.columns, volume.grid, groupOf, labels.size());
        const bool isClosed = hasRooms(volume.labels);
        for (std::size_t l = 0; l < labels.size(); ++l) {
            const analyze::SideArea& side = sides[owners[l]];
            if (isPart[l] == 0 || parts[l].source != ExternalSource::None || !(side.whole > 0)) continue;
            const double share = side.outside / (0.5 * side.whole);
            const bool isUndecided = share > kBothSidesShare && !isClosed;
            parts[l] = {share >= kExternalShare && !isUndecided,
                        isUndecided ? ExternalSource::Open : ExternalSource::Hull};
        }
    }
    // A layer that states nothing is where its wall is.
    for (std::size_t l = 0; l < labels.size(); ++l)
        if (owners[l] != l && !model::isBoundarySurface(labels[l].className)) parts[l] = parts[owners[l]];
    return parts;
}

std::string externalSources(std::span<const ExternalPart> parts, const volume::LabelTable& table) {
    std::size_t stated = 0, found = 0, undecided = 0, all = 0;
    for (std::size_t l = 0; l < parts.size(); ++l) {
        const ExternalPart& part = parts[l];
        const std::uint32_t parent = table.labels[l].parent;
        const bool isLayer = parent < l && parts[parent].source != ExternalSource::None;
        if (part.source == ExternalSource::None || isLayer) continue;
        ++all;
        stated += part.source == ExternalSource::File && part.isExternal ? 1 : 0;
        found += part.source == ExternalSource::Hull && part.isExternal ? 1 : 0;
        undecided += part.source == ExternalSource::Open ? 1 : 0;
    }
    if (all == 0) return {};
    std::string text = fmt::format(
        "external walls and doors: {} of {} (stated in the file: {}; found by the outside air at a quarter or more of "
        "one side: {})",
        stated + found, all, stated, found);
    if (undecided > 0)
        text += fmt::format(
            "; {} undecided, drawn as internal: outside air reaches both of their sides, because the model has no "
            "rooms "
            "and is not closed",
            undecided);
    return text;
}

}  // namespace svt::drawing
