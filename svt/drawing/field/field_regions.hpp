#pragma once
/// \file
/// The regions of a section in which a field has connected values.

#include <svt/drawing/footprint/outline_union.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::drawing {

/// A connected part of the medium: rings with the region to their left.
struct FieldRegion {
    std::vector<Ring> rings;
    bool isAir = false;
};

/// Grid of the outlines, metres.
inline constexpr double kFieldUnit = 1.0 / (1 << 20);
[[nodiscard]] plane::Point onFieldGrid(PlanePoint p) noexcept;
/// Rings of a union as polygons of the drawing.
[[nodiscard]] std::vector<SectionPolygon> fieldPolygons(const OutlineUnion& outline, double leastArea);

/// \param isMedium, isAir  by scalar, see fields::mediumOf()
/// \param areRoomsApart    each room is a region of its own, for values that belong to rooms
[[nodiscard]] std::vector<FieldRegion> findFieldRegions(const SectionDrawing& drawing,
                                                        const volume::SemanticVolume& volume,
                                                        const std::vector<char>& isMedium,
                                                        const std::vector<char>& isAir, bool areRoomsApart);

}  // namespace svt::drawing
