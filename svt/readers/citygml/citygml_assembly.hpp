#pragma once
/// \file
/// The joined part of a whole file into a model: ids made unique, references followed,
/// materials given to polygons, memberships found, axes brought to east, north, up. Internal to the readers.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/read_options.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace svt::readers::citygml {

/// What the assembly needs to know of the document.
struct DocumentFacts {
    std::string fileName;
    std::string format;  ///< "CityGML 2.0"
    std::uint64_t bytes = 0;
    std::function<std::uint64_t(std::uint64_t)> lineOf;  ///< 1-based line of a byte offset
};

/// \return the model; GeographicCrs for coordinates in degrees; InputTooBig where references ask for a model
///         out of all proportion to the file
Result<model::BuildingModel> assemble(Part&& part, const DocumentFacts& facts, Diagnostics& diagnostics);

}  // namespace svt::readers::citygml
