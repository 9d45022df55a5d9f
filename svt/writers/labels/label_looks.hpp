#pragma once
/// \file
/// The names and colours of labels and models in all formats, and the corner of the grid.

#include <svt/volume/semantic_volume.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>

namespace svt::writers {

/// The name of a feature, or its id if it has no name.
[[nodiscard]] inline const std::string& shownName(const volume::Label& label) noexcept {
    return label.name.empty() ? label.id : label.name;
}
/// The name of a model, or its source if it has no name.
[[nodiscard]] inline const std::string& shownName(const volume::SemanticVolume& volume) noexcept {
    return volume.modelName.empty() ? volume.source : volume.modelName;
}

/// The lower corner of the grid, world space: the outer corner of sample (0, 0, 0).
[[nodiscard]] inline Vec3d lowerCorner(const volume::Grid& grid) noexcept {
    return grid.worldFromIndex({-0.5, -0.5, -0.5});
}

/// The colour of a scalar: that of its phase if its label has a pattern, otherwise that of the label.
[[nodiscard]] inline Vec3f colorOf(const volume::LabelTable& labels, const volume::Label& label,
                                   volume::Scalar scalar) noexcept {
    return labels.phaseColors.empty() || label.count == 1 ? label.color : labels.phaseColors[scalar];
}

/// The opacity of a surface of a label, for formats without volumes: that of the model's material for glass, otherwise
/// the share of light that one metre stops.
[[nodiscard]] inline float surfaceOpacity(const volume::Label& label) noexcept {
    // A style that makes the label opaque or hides it wins.
    if (label.opacity <= 0 || label.opacity >= 1) return label.opacity;
    for (const Attribute& attribute : label.attributes)
        if (const double* share = std::get_if<double>(&attribute.value);
            share != nullptr && attribute.name == "transparency" && *share > 0 && *share <= 1)
            return std::max(static_cast<float>(1 - *share), 0.05f);
    return label.opacity;
}

/// A channel of a colour, 0 to 1, as a byte.
[[nodiscard]] inline std::uint8_t colorByte(float channel) noexcept {
    return static_cast<std::uint8_t>(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f);
}

/// The look of a scalar, 0xRRGGBBAA. Its opacity is at least 1, so that no label is invisible.
[[nodiscard]] inline std::uint32_t lookOf(const volume::LabelTable& labels, const volume::Label& label,
                                          volume::Scalar scalar) noexcept {
    const Vec3f color = colorOf(labels, label, scalar);
    std::uint32_t look = 0;
    for (int axis = 0; axis < 3; ++axis) look = look << 8 | colorByte(color[axis]);
    return look << 8 | std::max<std::uint32_t>(colorByte(label.opacity), 1);
}

/// A channel of sRGB, 0 to 1, as glTF and USD store it: linear.
[[nodiscard]] inline double linearChannel(float value) noexcept {
    return value <= 0.04045f ? value / 12.92 : std::pow((double(value) + 0.055) / 1.055, 2.4);
}
/// The same, rounded to four decimals, so that files are equal even if math libraries differ in the last bit.
[[nodiscard]] inline double roundedLinearChannel(float value) noexcept {
    return std::round(linearChannel(value) * 1e4) / 1e4;
}

}  // namespace svt::writers
