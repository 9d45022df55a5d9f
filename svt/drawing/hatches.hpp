#pragma once
/// \file
/// Hatches of components, for their caps (cut faces), and the reason for each.

#include <svt/analyze/selection.hpp>
#include <svt/drawing/material_table.hpp>
#include <svt/render/hatch.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::drawing {

/// The source of a hatch, in order of precedence.
enum class HatchSource : std::uint8_t {
    Stated,     ///< the attribute `hatch` of the component
    Window,     ///< panes of windows and windows without parts are glass, whatever their frames are made of
    Structure,  ///< a property that names the structural material (`... Structural Material`)
    Thickest,   ///< the thickest load-bearing layer; without one, the thickest layer
    Material,   ///< the only material, or the only one that matches
    First,      ///< the first load-bearing one of several materials of unknown thickness; without one, the first
    Class       ///< class, IFC type and name: no material matches, or there is none
};
[[nodiscard]] std::string_view hatchSourceName(HatchSource source) noexcept;  ///< "stated", "window", ...

struct HatchChoice {
    render::Hatch hatch = render::Hatch::None;
    HatchSource source = HatchSource::Class;
    std::string material;  ///< name of the material that decides; Class: all materials, empty without one
    std::string word;      ///< the matching entry of the table, or empty

    /// Whether no word of the table decides, although the component has a hatch.
    [[nodiscard]] bool isAssumed() const noexcept {
        return source == HatchSource::Class && hatch != render::Hatch::None;
    }
    friend bool operator==(const HatchChoice&, const HatchChoice&) = default;
};

/// The hatch of each label by index, with its source. Walls without a matching material are masonry, slabs and beams
/// reinforced concrete, rafters timber, ground earth. Spaces have no hatch. Parts of windows beside the pane have that
/// of their own material or style, otherwise none.
///
/// Layers come from the attribute `materialLayers` ("NAME 0.1 m; NAME 0.2 m"), materials from `material`, separated by
/// semicolons, otherwise by commas.
/// Cost: O(labels * rules), and O(entries) for each different material.
[[nodiscard]] std::vector<HatchChoice> chooseHatches(const analyze::LabelRows& labels,
                                                     const MaterialTable& table = MaterialTable::builtIn());

/// The hatches of chooseHatches() with the table of the program.
[[nodiscard]] std::vector<render::Hatch> labelHatches(const analyze::LabelRows& labels);

/// Writes the hatches as attributes `hatch`, so that all drawings and pictures of the volume use them.
/// \param choices  one per label
void stateHatches(const std::vector<HatchChoice>& choices, volume::LabelTable& labels);

/// Components with the same hatch for the same reason.
struct HatchUse {
    HatchChoice choice;
    std::vector<std::uint32_t> labels;  ///< ascending
};
/// The uses among `labels`, by hatch, then source, material and word. Labels without hatch are left out.
[[nodiscard]] std::vector<HatchUse> hatchUses(const std::vector<HatchChoice>& choices,
                                              const std::vector<std::uint32_t>& labels);
/// A sentence on the assumed hatches; empty if there are none.
[[nodiscard]] std::string assumedHatches(const std::vector<HatchUse>& uses);

}  // namespace svt::drawing
