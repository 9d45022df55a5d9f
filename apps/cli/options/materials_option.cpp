#include <apps/cli/options/materials_option.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>

#include <string>

namespace svt::cli {

Result<std::vector<drawing::HatchChoice>> readHatches(const std::filesystem::path& file, volume::LabelTable& labels) {
    if (file.empty()) return drawing::chooseHatches(labels);
    SVT_TRY(bytes, FileBytes::read(file));
    SVT_TRY(table, drawing::parseMaterials(bytes->text(), file.string()));
    std::vector<drawing::HatchChoice> choices = drawing::chooseHatches(labels, *table);
    drawing::stateHatches(choices, labels);
    return choices;
}

std::vector<drawing::HatchUse> usesIn(std::span<const drawing::SectionDrawing* const> drawings,
                                      const std::vector<drawing::HatchChoice>& choices) {
    std::vector<std::uint32_t> labels;
    for (const drawing::SectionDrawing* drawing : drawings)
        for (const drawing::SectionComponent& component : drawing->components)
            if (!component.polygons.empty()) labels.push_back(component.label);
    return drawing::hatchUses(choices, labels);
}

void noteHatches(const std::vector<drawing::HatchUse>& uses) {
    if (const std::string text = drawing::assumedHatches(uses); !text.empty()) note(text);
}

}  // namespace svt::cli
