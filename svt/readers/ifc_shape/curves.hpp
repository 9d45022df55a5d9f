#pragma once
/// \file
/// Curves as polylines. Arcs are cut so that no chord is farther from its arc than kChordError, with at least
/// kMinSegments and at most kMaxSegments per full turn; all points lie on the arc. Curves of alignments (IFC 4.3) are
/// composite curves of IfcCurveSegment in plan (lines, arcs, spirals), and gradient curves above them.

#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <string>
#include <vector>

namespace svt::readers::ifc {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kChordError = 0.001;  ///< metres
inline constexpr int kMinSegments = 48, kMaxSegments = 256;

/// Sine and cosine of an angle (radians) to twelve decimals, which are the same on every machine.
struct SineCosine {
    double sine, cosine;
};
[[nodiscard]] SineCosine sineCosine(double angle) noexcept;

/// Segments for an arc: at least one. \param radius metres \param angle radians, of any sign
[[nodiscard]] int arcSegments(double radius, double angle, int minSegments = kMinSegments) noexcept;

/// Points of an arc of an ellipse, with both ends. \param axes  x and y are multiplied by the radii
void appendArc(const Transform& axes, double radiusX, double radiusY, double from, double to,
               std::vector<Vec3d>& points);

/// Points of a curve in its order; the last point of a closed curve equals the first. Reads polylines, indexed poly
/// curves, composite and trimmed curves, circles, ellipses, B-splines, curves of alignments, and the 3D curve of a curve
/// on a surface.
/// Metres; curves in 2D have z = 0.
/// \return false for a curve with a part of unknown kind, invalid values, or a limit of file.guard(); `why` names the
///         reason
[[nodiscard]] bool readCurve(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points, std::string& why);

/// Whether a curve consists of IfcCurveSegment: a composite curve of them, a gradient curve or a segmented reference
/// curve.
[[nodiscard]] bool isOfCurveSegments(const IfcFile& file, RecordIndex curve);

/// Whether distances along a curve are measured in plan: on gradient curves and those above them.
[[nodiscard]] bool isMeasuredInPlan(const IfcFile& file, RecordIndex curve) noexcept;

/// Appends the points of a curve of isOfCurveSegments(), metres. Chords are within kChordError of arcs and spirals;
/// gradients have a point every 5 m. A segment of another parent curve, such as a cubic parabola, becomes the cubic curve
/// between its start and the start of the next segment. Cant is not applied.
/// \return false for invalid values or a limit of file.guard(); `why` names the reason
[[nodiscard]] bool readCurveSegments(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points,
                                     std::string& why);

/// The parts of a curve of isOfCurveSegments() that readCurveSegments() does not read exactly: its cant, a transition
/// curve of another kind. Empty for other curves.
[[nodiscard]] std::string inexactParts(const IfcFile& file, RecordIndex curve);

/// Points of the part of a curve between two points on it, as an edge uses it. Lines are two points.
/// \param isForward  whether the edge runs with the curve
[[nodiscard]] bool readCurveBetween(const IfcFile& file, RecordIndex curve, Vec3d from, Vec3d to, bool isForward,
                                    std::vector<Vec3d>& points, std::string& why);

/// Appends points by a list of their numbers, beginning with 1. \return whether all numbers are in range
bool appendNumbered(Value numbers, const std::vector<Vec3d>& points, std::vector<Vec3d>& result);

/// Drops points that are closer than `distance` to the one before, and a last one that equals the first.
void closeRing(std::vector<Vec3d>& points, double distance = 1e-7);

/// Twice the signed area in the plane z = 0.
[[nodiscard]] double twiceArea(const std::vector<Vec3d>& ring) noexcept;

}  // namespace svt::readers::ifc
