#pragma once
/// \file
/// Units of an IFC project, and its place on earth.

#include <svt/core/diagnostics.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <optional>
#include <string>

namespace svt::readers::ifc {

/// Factors to SI units.
struct Units {
    double length = 1, area = 1, volume = 1, angle = 1, mass = 1, time = 1;
};

/// The units of the project: SI with prefixes, and units defined by conversion. A missing or invalid unit becomes the
/// SI unit, with a warning (BadValue) for lengths. Missing units of area and volume become the square and the cube of
/// the unit of length, with a note (BadValue) unless that is the metre.
[[nodiscard]] Units readUnits(const IfcFile& file, RecordIndex project, const Place& place, Diagnostics& diagnostics);

/// Factor of a unit to the SI unit; nothing for a unit that is missing or invalid.
[[nodiscard]] std::optional<double> unitFactor(const IfcFile& file, RecordIndex unit);

/// `value` in SI units. Decimal fractions stay so: 15650000 mm2 are 15.65 m2, not 15.649999999999999.
[[nodiscard]] double converted(double value, double factor) noexcept;

/// The conversion of project coordinates to map coordinates.
struct MapPlace {
    Transform mapFromProject;
    std::string crs;                         ///< name of IfcProjectedCRS, such as EPSG:25832; empty: none
    bool isGiven = false;                    ///< an IfcMapConversion, or the property sets in its place
    std::optional<double> trueNorthDegrees;  ///< from the y axis of the map to true north, clockwise
};
/// The conversion is an IfcMapConversion, else the property sets `ePSet_MapConversion` and `ePSet_ProjectedCRS` of a
/// site or project, by which IFC 2x3 states it. Findings (BadValue): both differ, or the sets lack a place. The direction
/// of true north is that of a geometric context of the project (TrueNorth), turned by the conversion.
[[nodiscard]] MapPlace readMapPlace(const IfcFile& file, RecordIndex project, const Place& place,
                                    Diagnostics& diagnostics);

/// Degrees of an IfcCompoundPlaneAngleMeasure: (49,5,59,0); nothing for another value.
[[nodiscard]] std::optional<double> compoundDegrees(Value list);

}  // namespace svt::readers::ifc
