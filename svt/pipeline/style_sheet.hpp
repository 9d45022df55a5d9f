#pragma once
/// \file
/// Style sheets: colour, opacity and spatial pattern by class or query, read from a JSON file
/// (docs/formats/style.schema.json). A default style for buildings is built in.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/query.hpp>
#include <svt/voxelize/patterns.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace svt::pipeline {

/// One rule; its members override those of earlier rules.
struct StyleRule {
    model::Query select;
    std::optional<Vec3f> color;    ///< sRGB, 0..1
    std::optional<float> opacity;  ///< fraction of light stopped by 1 m, 0..1; 1: opaque
    std::optional<voxelize::Pattern> pattern;
    std::vector<Vec3f> patternColors;  ///< per phase; missing ones are shades of the colour
};

/// Rules in order; later rules win.
struct StyleSheet {
    std::vector<StyleRule> rules;
};

/// The built-in style: colours and opacities by class; with `withPatterns` also brick, block, concrete, timber,
/// insulation by class and material.
[[nodiscard]] const StyleSheet& defaultStyle(bool withPatterns);

/// Reads a style file; files of image patterns are found relative to it.
/// \return the sheet, or CannotOpen, BadStyle (with the JSON path, found and expected values), BadPattern, BadImage
[[nodiscard]] Result<StyleSheet> readStyleSheet(const std::filesystem::path& file);
[[nodiscard]] Result<StyleSheet> parseStyleSheet(std::string_view json, const std::filesystem::path& folder);

/// The files that the patterns of a style file name, relative to it; empty if the style cannot be read, which
/// readStyleSheet() reports.
[[nodiscard]] std::vector<std::filesystem::path> filesOfStyle(const std::filesystem::path& file);

/// The resulting style of one row.
struct ResolvedStyle {
    Vec3f color{0.8f, 0.8f, 0.8f};
    float opacity = 1;
    voxelize::Pattern pattern;
    std::vector<Vec3f> phaseColors;  ///< pattern.phaseCount() entries
};

/// Applies the sheets in order; one entry per row.
/// \param materialColors  per row: the colour from the model; overrides the built-in sheet (the first), but not
///                        the others
/// \param materialOpacities  per row: the opacity from the model, in the same way; may be empty
[[nodiscard]] std::vector<ResolvedStyle> resolveStyles(std::span<const model::QueryRow> rows,
                                                       std::span<const StyleSheet* const> sheets,
                                                       std::span<const std::optional<Vec3f>> materialColors,
                                                       std::span<const std::optional<float>> materialOpacities = {});

}  // namespace svt::pipeline
