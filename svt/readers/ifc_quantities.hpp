#pragma once
/// \file
/// Measured quantities in a copy of an IFC file, as sets of the schema (`Qto_WallBaseQuantities`, ...).

#include <svt/core/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers {

/// A quantity by its name in the sets of IFC: `NetVolume` (m3), `GrossSideArea` (m2), `Length` (m).
struct IfcQuantity {
    std::string_view name;
    double value = 0;
};

/// The quantities of one element.
struct IfcElementQuantities {
    std::string_view globalId;
    std::vector<IfcQuantity> quantities;
};

/// An IFC file with additional quantities.
struct IfcWithQuantities {
    std::string text;
    std::size_t elements = 0;    ///< that have a new set
    std::size_t otherTypes = 0;  ///< without a new set: IFC defines none for their class, or no quantity is given
    std::size_t keptSets = 0;    ///< without a new set: the file has the set already
    std::size_t missing = 0;     ///< without a new set: not exactly one record of the file has their GlobalId
};

/// Adds an IfcElementQuantity and its IfcRelDefinesByProperties for each element, behind the last record. All other bytes
/// are those of `text`. New ids follow the largest one; the GlobalIds depend on those of the elements only. Numbers are in
/// the units of the project, with twelve digits.
/// Classes: walls, slabs, roofs, plates, coverings, curtain walls, beams, columns, members, footings, piles, flights of
/// stairs and ramps. Each gets the quantities that its set of IFC 4 names.
/// \param text  of an IFC file
/// \param name  of the file, for messages
/// \return the file; BadStep, UnknownVersion or Truncated: it is not a whole IFC file; BadRecord: it has records that
///         cannot be read; InputTooBig: its ids leave no space, or its relations are too many
/// Cost: three passes over the text. Memory: twice the text.
[[nodiscard]] Result<IfcWithQuantities> addIfcQuantities(std::string_view text, std::string_view name,
                                                         std::span<const IfcElementQuantities> elements);

}  // namespace svt::readers
