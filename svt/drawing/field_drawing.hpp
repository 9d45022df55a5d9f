#pragma once
/// \file
/// A field on a section: lines of equal value and bands between them, which end at the walls; arrows of vectors.
///
///     +-----------+---+-----------+        regions of the medium (here of air) are cut out by the exact polygons of the
///     |  \    \   |###|    \    \ |        section; each has its own values, so that no line crosses a wall
///     | 20\  21\  |###|  24 \  25\|
///     +-----------+---+-----------+
///
/// - Values are sampled at the nodes of the lattice in the plane (FieldSampler), where they need no interpolation along the
///   walls. Between the last nodes and a wall they continue linearly, by at most three nodes. So a linear field has
///   straight lines up to the wall.
/// - Each cell is divided into four triangles by its middle. Lines and bands are those of the linear values on the
///   triangles (marching squares without ambiguous cells), clipped by the region.
/// - Vectors have lines and bands of their lengths, and arrows of their parts within the plane.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace svt::drawing {

struct FieldDrawingOptions {
    std::optional<double> time{};   ///< seconds; unset: the first time of the field
    double isolines = 0;            ///< step between lines, in the unit of the field; 0: none
    std::optional<double> bands{};  ///< step of bands; 0: none; unset: that of the lines, or about ten bands
    /// Metres between the arrows of a vector field; 0: none; unset: a round number, so that 40 to 100 lie across the drawing.
    std::optional<double> arrows{};
    /// Ends of the colour map; unset: least and largest value of all times.
    std::optional<std::array<double, 2>> range{};
    int threads = 0;  ///< 0: all cores; the result does not depend on it
};

/// A line of equal value. Higher values are to its left.
struct FieldIsoline {
    double value = 0;
    std::vector<PlanePoint> points;  ///< a closed one repeats the first at the end
};

/// The part of the section with values in [low, high].
struct FieldBand {
    double low = 0, high = 0;
    std::vector<SectionPolygon> polygons;
};

/// The part of a vector within the plane, around the middle between both points.
struct FieldArrow {
    PlanePoint from{}, to{};
    double value = 0;  ///< length of this part, in the unit
};

struct FieldDrawing {
    std::string name;                      ///< of the field
    std::string title;                     ///< with unit and time, for legends
    std::string unit;                      ///< text of the unit, "°C"; may be empty
    double seconds = 0;                    ///< time of the values
    double low = 0, high = 0;              ///< ends of the colour map, in the unit
    double isolineStep = 0, bandStep = 0;  ///< 0: none
    double arrowStep = 0;                  ///< metres between arrows; 0: none
    std::vector<FieldIsoline> isolines;    ///< by value
    std::vector<FieldBand> bands;          ///< by value
    std::vector<SectionPolygon> missing;   ///< parts of components of the medium without a value
    /// A value v has an arrow of kArrowPart * arrowStep * sqrt(v / high) metres. Arrows below a tenth of this are left out.
    std::vector<FieldArrow> arrows;

    /// Where a value lies on the colour map, 0 to 1.
    [[nodiscard]] double shareOf(double value) const noexcept;
};

/// Draws a field on the section `drawing` of `volume`. Lines of a field of air lie in rooms and in empty
/// space up to kFieldMargin beyond the extent of the section; those of a field of solids lie in the cut components. A field
/// of all voxels has both, each with its own values.
/// Lines keep 0.25 mm away from surfaces without thickness, and within 0.01 mm of the exact polygons otherwise.
/// \return the drawing, or
///         - BadQuery: the medium is not a valid query.
///         - BadArgument: a field without values, a time outside of the field, steps that give more than kMostLevels
///           lines or bands, or more than kMostArrows arrows; arrows of a field of numbers.
///         - BadSection: pieces of bands that do not join.
/// Cost: O(nodes in the plane + edges of the section * rows), about 1 us per node.
[[nodiscard]] Result<FieldDrawing> drawField(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                             const fields::Field& field, const FieldDrawingOptions& options = {});

inline constexpr double kFieldMargin = 0.5;  ///< metres
inline constexpr int kMostLevels = 400;
inline constexpr double kMostArrows = 1e6;
inline constexpr double kArrowPart = 0.95;  ///< of the distance between arrows: the longest one

/// The time of a drawing: `wanted`, or the first of the field.
/// \return seconds, or BadArgument outside of its times
[[nodiscard]] Result<double> timeOfField(const fields::FieldHead& head, std::optional<double> wanted);
/// "temperature (°C)", "soot (kg/m³), 300 s".
[[nodiscard]] std::string titleOfField(const fields::FieldHead& head, double seconds);
/// A value with its unit: "0.5 °C".
[[nodiscard]] std::string valueOfField(const fields::FieldHead& head, double value);
/// Checks that a step divides a range into at most kMostLevels parts.
/// \param option  for the message
[[nodiscard]] Result<void> checkStep(const fields::FieldHead& head, double step, double range, const char* option);

}  // namespace svt::drawing
