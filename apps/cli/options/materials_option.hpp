#pragma once
/// \file
/// The option --materials: hatches by a table of materials, and the notes on assumed ones.

#include <svt/core/result.hpp>
#include <svt/drawing/hatches.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <filesystem>
#include <span>
#include <vector>

namespace svt::cli {

/// The hatch of each label, with its source.
/// \param file  table of the user, or empty; with a table, the labels get the hatches as attributes, for drawings
/// \return the hatches, or an error of parseMaterials() or FileBytes::read()
[[nodiscard]] Result<std::vector<drawing::HatchChoice>> readHatches(const std::filesystem::path& file,
                                                                    volume::LabelTable& labels);

/// The uses of the hatches in drawings.
[[nodiscard]] std::vector<drawing::HatchUse> usesIn(std::span<const drawing::SectionDrawing* const> drawings,
                                                    const std::vector<drawing::HatchChoice>& choices);

/// Prints a note on assumed hatches, if there are any.
void noteHatches(const std::vector<drawing::HatchUse>& uses);

}  // namespace svt::cli
