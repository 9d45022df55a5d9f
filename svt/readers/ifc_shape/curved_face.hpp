#pragma once
/// \file Faces on curved surfaces as flat polygons: the face is converted to the parameters of its surface, cut along
/// lines of equal parameter, and each cell is converted back.
///
///     v ^   ,-----.           cells of a cylinder are strips, which are flat;
///       | _/| | | |\_         those of a sphere or torus rectangles, cut in triangles
///       |/ || | | || \.
///       +---------------> u = angle * radius

#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <svt/model/building_model.hpp>

#include <vector>

namespace svt::readers::ifc {

/// Appends the polygons of a face. Corners and edges of its rings stay, so that neighbours have the same chords.
/// Chords across a B-spline surface stay within kChordError of it, with at most 32 strips each way.
/// \param surface  cylinder, cone, sphere, torus, surface of linear extrusion or revolution, or B-spline surface
/// \param rings    exterior ring first, in the orientation of the face
/// \return false for another kind of surface, a ring around it or through its pole or apex, or a spent budget of
///         file.guard()
[[nodiscard]] bool addCurvedFace(const IfcFile& file, RecordIndex surface, const std::vector<std::vector<Vec3d>>& rings,
                                 std::vector<model::Polygon>& faces);

}  // namespace svt::readers::ifc
