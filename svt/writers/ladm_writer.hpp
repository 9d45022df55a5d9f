#pragma once
/// \file
/// The land administration of a building (ISO 19152, LADM) as a GeoPackage, CityGML 3.0, CityJSON 2.0 and IFC4.
///
/// GeoPackage: one table per class, with foreign keys.
///
/// | table | geometry | contents |
/// |---|---|---|
/// | `la_party` | none | parties. |
/// | `la_baunit` | none | basic administrative units: features with rights. |
/// | `la_right` | none | rights: `type`, `party`, `baunit`, share as fraction and number, `source`. |
/// | `la_restriction` | none | restrictions, with the columns of `la_right`. |
/// | `la_responsibility` | none | responsibilities, with the columns of `la_right`. |
/// | `la_spatialunit` | MultiPolygon | legal spaces: outline in plan, volumes, heights; `baunit` may be empty. |
/// | `la_boundaryface` | PolygonZ | faces: `minus` and `plus` spatial unit, direction, area, lowest and highest point. |
/// | `la_relation` | none | pairs of spatial units: overlap, shared face, gap. |
/// | `la_relation_face` | none | the faces of a relation. |
/// | `la_source` | none | the files of parties and geometry, and the documents of rights. |
///
/// CityGML 3.0: buildings with a BuildingUnit per legal space. Rights and sources are sets of generic attributes
/// (`LA_Right`, `LA_Restriction`, `LA_Responsibility`, `LA_SpatialSource`). Bodies are `lod3Solid`. Names, ids and classes of attributes of the model stay.
///
/// CityJSON 2.0: the same objects, with the extension LADM (docs/formats/ladm.ext.json): attributes such as `+LA_Right`, and
/// the root property `+LADM` with parties, sources, boundary faces and relations.
///
/// IFC4: each legal space is an IfcSpatialZone for occupancy with a closed B-rep, and an IfcZone groups it with its rooms
/// (IfcSpace). Parties are IfcActor, assigned to the zones of their rights. Property sets have the data of the register.

#include <svt/analyze/land_administration.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>

namespace svt::writers {

/// \return the bytes of the file, or CannotWrite, also if the SQLite library is missing. Equal input gives equal bytes
///         with the same release of SQLite.
[[nodiscard]] Result<std::string> makeLadmGeoPackage(const analyze::LandAdministration& administration,
                                                     const volume::SemanticVolume& volume);

/// The document. Equal input gives equal bytes.
[[nodiscard]] std::string makeLadmCityGml(const analyze::LandAdministration& administration,
                                          const volume::SemanticVolume& volume);

/// The same.
[[nodiscard]] std::string makeLadmCityJson(const analyze::LandAdministration& administration,
                                           const volume::SemanticVolume& volume);
[[nodiscard]] std::string makeLadmIfc(const analyze::LandAdministration& administration,
                                      const volume::SemanticVolume& volume);

/// The name of the extension of CityJSON.
inline constexpr const char* kLadmExtensionUrl = "https://svt.example.org/cityjson/ladm.ext.json";

}  // namespace svt::writers
