#pragma once
/// \file
/// Writes the rooms of a volume as IndoorGML 1.0.3, core and navigation module.
///
/// | of the volume                       | in IndoorGML                                                            |
/// |-------------------------------------|-------------------------------------------------------------------------|
/// | room | GeneralSpace (or the class from an IndoorGML file) with a Solid: its mesh if that is closed, otherwise the
/// faces of its voxels and of the objects in it; a room in several pieces is several cells |
/// | door with a room at one end or both | AnchorSpace or ConnectionSpace: a box through the wall, see doorway.hpp |
/// | faces that two cells have in common | CellSpaceBoundary, or NavigableBoundary for passages |
/// | door and room; rooms with a vertical common face | Transition; its weight is the length of its line in metres |
/// | name, storey                        | name, description `storey="EG"`                                         |
/// | attributes class, function, usage | those of the navigation module; otherwise "unknown" |
/// | id, source | gml:id if it is an XML name; externalReference |
///
/// One layer; states lie well inside of their cells. Coordinates are those of the volume's CRS, to a tenth of a
/// micrometre.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <string>

namespace svt::writers {

/// \return the document, the same for any number of threads; NothingSelected if the volume has no room; or an error of
///         labelSurfaces()
/// Cost: O(n log n) in the triangles of the rooms, plus pairs of triangles of rooms that touch. Memory: that of the
/// document and the triangles.
[[nodiscard]] Result<std::string> makeIndoorGml(const volume::SemanticVolume& volume,
                                                const VolumeWriteOptions& options = {});

}  // namespace svt::writers
