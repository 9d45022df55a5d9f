#include <svt/drawing/hatches.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace svt::drawing {

void stateHatches(const std::vector<HatchChoice>& choices, volume::LabelTable& labels) {
    for (std::size_t l = 0; l < choices.size(); ++l) {
        std::vector<Attribute>& attributes = labels.labels[l].attributes;
        std::erase_if(attributes, [](const Attribute& attribute) { return attribute.name == "hatch"; });
        attributes.push_back({"hatch", std::string(nameOf(choices[l].hatch)), ""});
    }
}

std::vector<HatchUse> hatchUses(const std::vector<HatchChoice>& choices, const std::vector<std::uint32_t>& labels) {
    std::map<std::tuple<render::Hatch, HatchSource, std::string, std::string>, std::vector<std::uint32_t>> byChoice;
    for (const std::uint32_t label : labels) {
        const HatchChoice& choice = choices[label];
        if (choice.hatch == render::Hatch::None) continue;
        byChoice[{choice.hatch, choice.source, choice.material, choice.word}].push_back(label);
    }
    std::vector<HatchUse> uses;
    for (auto& [key, list] : byChoice) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        uses.push_back({choices[list.front()], std::move(list)});
    }
    return uses;
}

std::string assumedHatches(const std::vector<HatchUse>& uses) {
    std::size_t components = 0, without = 0;
    std::map<std::string, std::size_t> materials;  // components by material without a matching word
    for (const HatchUse& use : uses) {
        if (!use.choice.isAssumed()) continue;
        components += use.labels.size();
        if (use.choice.material.empty())
            without += use.labels.size();
        else
            materials[use.choice.material] += use.labels.size();
    }
    if (components == 0) return {};
    std::string text = fmt::format("the hatches of {} components are assumed from their class and name: ", components);
    if (without > 0) text += fmt::format("{} without material", without);
    if (materials.empty()) return text;
    constexpr std::size_t kMost = 5;
    std::string names;
    std::size_t shown = 0;
    for (const auto& [material, count] : materials)
        if (shown++ < kMost) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", material);
    if (materials.size() > kMost) names += fmt::format(" and {} others", materials.size() - kMost);
    return text + fmt::format("{}{} with materials without a matching word ({}); name these in a table for --materials",
                              without > 0 ? ", " : "", components - without, names);
}

}  // namespace svt::drawing
