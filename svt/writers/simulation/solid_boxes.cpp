#include <svt/record/record.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/simulation/air_labels.hpp>
#include <svt/writers/simulation/solid_boxes.hpp>

#include <svt/analyze/selection.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace svt::writers {
namespace {

using volume::Label;

std::string groupName(const Label& label, MergeBy by) {
    switch (by) {
        case MergeBy::Class: return label.className;
        case MergeBy::Material: return materialOf(label);
        case MergeBy::Label: break;
    }
    return shownName(label);
}

// The labels that a query selects; an empty query selects none.
Result<std::vector<bool>> selectedBy(const std::string& query, const volume::LabelTable& labels) {
    std::vector<bool> isSelected(labels.labels.size());
    if (query.empty()) return isSelected;
    SVT_TRY(selected, analyze::selectLabels(labels, query));
    for (const std::uint32_t label : *selected) isSelected[label] = true;
    return isSelected;
}

}  // namespace

std::string materialOf(const Label& label) {
    const auto found = std::find_if(label.attributes.begin(), label.attributes.end(),
                                    [](const Attribute& attribute) { return attribute.name == "material"; });
    const auto* text = found == label.attributes.end() ? nullptr : std::get_if<std::string>(&found->value);
    return text != nullptr && !text->empty() ? *text : label.className;
}

Vec3d cornerOf(Vec3i samples, const volume::Grid& grid) noexcept {
    const Vec3d spacing = grid.spacing();
    return {roundedMetres(samples.x * spacing.x), roundedMetres(samples.y * spacing.y),
            roundedMetres(samples.z * spacing.z)};
}

std::string placeText(const volume::Grid& grid) {
    const Vec3d corner = lowerCorner(grid);
    const auto& axes = grid.axes();
    return fmt::format("Metres from ({:.4f}, {:.4f}, {:.4f}) along ({}, {}, {}) and ({}, {}, {})", corner.x, corner.y,
                       corner.z, axes[0].x, axes[0].y, axes[0].z, axes[1].x, axes[1].y, axes[1].z);
}

double roundedMetres(double metres) noexcept { return std::round(metres * 1e6) / 1e6; }

Result<SolidBoxes> solidBoxes(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    const auto& labels = volume.labels.labels;
    const std::vector<std::uint32_t> air = airOfLabels(volume.labels);
    std::vector<bool> isSolid(labels.size());
    for (std::size_t l = 0; l < labels.size(); ++l) isSolid[l] = labels[l].voxels > 0 && air[l] == volume::kNoLabel;
    if (std::none_of(isSolid.begin(), isSolid.end(), [](bool is) { return is; }))
        for (std::size_t l = 0; l < labels.size(); ++l) isSolid[l] = labels[l].voxels > 0;

    SVT_TRY(isHole, selectedBy(options.boxes.holes, volume.labels));
    SVT_TRY(hasVents, selectedBy(options.boxes.vents, volume.labels));
    SolidBoxes result;
    std::map<std::tuple<std::string, bool, bool>, std::uint32_t> known;
    std::vector<std::uint32_t> groupOfScalar(volume.labels.scalarCount(), volume::kNoLabel);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (!isSolid[l]) continue;
        std::string name = groupName(labels[l], options.boxes.mergeBy);
        auto group = static_cast<std::uint32_t>(result.groups.size());
        if (options.boxes.mergeBy != MergeBy::Label)
            group = known.try_emplace({name, (*isHole)[l], (*hasVents)[l]}, group).first->second;
        if (group == result.groups.size())
            result.groups.push_back({std::move(name), l, labels[l].color, (*isHole)[l], (*hasVents)[l]});
        for (volume::Scalar s = labels[l].first; s < labels[l].first + labels[l].count; ++s) groupOfScalar[s] = group;
    }
    SVT_TRY(boxes, analyze::mergeBoxes(volume.columns, groupOfScalar, options.boxes.maxBoxes));
    result.boxes = std::move(*boxes);
    return result;
}

record::Members<BoxWriteOptions> membersOf(const BoxWriteOptions*) noexcept {
    using All = BoxWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::mergeBy>(
            "merge", "of an .fds and of lists of boxes: components that are merged into boxes together",
            {.group = "Output", .option = "--merge"}),
        record::member<&All::maxBoxes>("maxBoxes", "of an .fds and of lists of boxes: maximum number of boxes",
                                       {.least = 1, .most = 1e8, .group = "Output", .option = "--max-boxes"}),
        record::member<&All::holes>("holes", "of an .fds: components that are open, such as doors",
                                    {.value = "QUERY", .group = "Output", .option = "--holes"}),
        record::member<&All::vents>("vents", "of an .fds: components with a vent on both sides, such as windows",
                                    {.value = "QUERY", .group = "Output", .option = "--vents"}),
    };
    return kMembers;
}

}  // namespace svt::writers
