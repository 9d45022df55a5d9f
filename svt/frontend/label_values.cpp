#include <svt/frontend/label_values.hpp>

#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/core/attribute.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace svt::frontend {
namespace {

bool isQuoted(std::string_view key) { return key.size() > 2 && key.front() == '"' && key.back() == '"'; }

std::string attributeText(const volume::Label& label, std::string_view name) {
    for (const AttributeList& list : attributeLists(label.attributes))
        if (equalsIgnoringCase(list.name, name)) return toText(list);
    return {};
}

// The colour of a label as #rrggbb.
std::string colorText(const Vec3f& color) {
    const auto byteOf = [](float share) { return static_cast<int>(std::lround(255 * std::clamp(share, 0.0f, 1.0f))); };
    return fmt::format("#{:02x}{:02x}{:02x}", byteOf(color.x), byteOf(color.y), byteOf(color.z));
}

std::string ownValue(const std::string& key, const volume::Label& label, const std::string& attribute) {
    if (equalsIgnoringCase(key, "class")) return label.className;
    if (equalsIgnoringCase(key, "name")) return label.name;
    if (equalsIgnoringCase(key, "id")) return label.id;
    if (equalsIgnoringCase(key, "color")) return colorText(label.color);
    return attributeText(label, attribute);
}

}  // namespace

std::vector<std::string> splitKeys(std::string_view keys) {
    std::vector<std::string> split;
    for (std::size_t at = 0; at < keys.size();) {
        const std::size_t comma = std::min(keys.find(',', at), keys.size());
        split.emplace_back(keys.substr(at, comma - at));
        at = comma + 1;
    }
    return split;
}

std::vector<std::string> valuesOfKey(const std::string& key, const volume::LabelTable& table,
                                     const analyze::Extents& extents, const std::vector<std::uint32_t>& features) {
    const auto& labels = table.labels;
    std::vector<std::string> values(labels.size());
    if (equalsIgnoringCase(key, "storey")) {
        const std::vector<std::uint32_t> storeys = drawing::storeysOfLabels(table);
        for (std::size_t l = 0; l < labels.size(); ++l)
            if (storeys[l] != volume::kNoLabel)
                values[l] = labels[storeys[l]].name.empty() ? labels[storeys[l]].id : labels[storeys[l]].name;
        return values;
    }
    constexpr std::string_view kOwn[] = {"class", "name", "id", "material", "ifcType", "color"};
    const bool isOwn =
        std::any_of(std::begin(kOwn), std::end(kOwn), [&](auto own) { return equalsIgnoringCase(key, own); });
    const std::string name = isQuoted(key) ? key.substr(1, key.size() - 2) : key;
    std::vector<std::string> ofFeatures;
    std::vector<std::uint32_t> bearers;
    for (const std::uint32_t feature : features) {
        std::string value = ownValue(key, labels[feature], name);
        // A pane or a frame is of the class and the material of its window.
        const bool isPart = model::isPhase(labels[feature].className) &&
                            std::binary_search(features.begin(), features.end(), labels[feature].parent);
        if (isPart && (value.empty() || equalsIgnoringCase(key, "class") || equalsIgnoringCase(key, "color"))) continue;
        if (!isOwn && value.empty()) continue;
        bearers.push_back(feature);
        ofFeatures.push_back(std::move(value));
    }
    const std::vector<std::uint32_t> finest = analyze::finestFeatures(extents, bearers, labels.size());
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (finest[l] == volume::kNoLabel) continue;
        const auto place = std::lower_bound(bearers.begin(), bearers.end(), finest[l]) - bearers.begin();
        values[l] = ofFeatures[static_cast<std::size_t>(place)];
    }
    return values;
}

std::string noValueOfKey(std::string_view key) {
    return fmt::format("no feature of these sums has a value for '{}'; svt info --json lists the attributes", key);
}

}  // namespace svt::frontend
