#pragma once
/// \file
/// A field on a section drawing, as the writers show it: bands by a colour map, lines with their values, a legend.

#include <svt/drawing/field_drawing.hpp>

#include <vector>

namespace svt::writers {

#ifdef __EMSCRIPTEN__
/// Whether drawings contain fields. The module of the page leaves out this code to stay small.
inline constexpr bool kDrawsFields = false;
#else
inline constexpr bool kDrawsFields = true;
#endif

struct FieldLook {
    const drawing::FieldDrawing* field = nullptr;  ///< of the drawing; null: none. Must outlive the call
    std::vector<Vec3f> colors;  ///< of the range, from low to high, such as image::mapColors(); sRGB, 0..1

    [[nodiscard]] bool isShown() const noexcept { return kDrawsFields && field != nullptr; }
};

}  // namespace svt::writers
