#pragma once
/// \file
/// A segment and an upright rectangle of the drawing plane: the part within it, and whether they meet.

#include <svt/drawing/section_drawing.hpp>

#include <optional>
#include <utility>

namespace svt::drawing {

/// The part of the segment from `a` to `b` within the rectangle from `low` to `high`, in its direction (Liang and
/// Barsky). All points have the same unit. An end within the rectangle is returned unchanged.
/// \return nothing if the segment is outside, touches the rectangle at one point only, or has no length
[[nodiscard]] std::optional<std::pair<PlanePoint, PlanePoint>> clipSegment(PlanePoint a, PlanePoint b, PlanePoint low,
                                                                           PlanePoint high) noexcept;

/// Whether the segment from `a` to `b`, which may be a point, has a point in the closed rectangle from `low` to `high`.
[[nodiscard]] bool meetsRectangle(PlanePoint a, PlanePoint b, PlanePoint low, PlanePoint high) noexcept;

}  // namespace svt::drawing
