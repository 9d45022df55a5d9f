#pragma once
/// \file
/// Turns the joined part of a whole file into a model: makes ids unique, resolves references,
/// assigns materials to polygons, collects memberships, brings coordinates to metres.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/read_options.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace svt::readers::citygml {

/// Properties of the document that the assembly needs.
struct DocumentFacts {
    std::string fileName;
    std::string format;  ///< "CityGML 2.0"
    std::uint64_t bytes = 0;
    std::function<std::uint64_t(std::uint64_t)> lineOf;  ///< 1-based line of a byte offset
};

/// \return the model; an error of georeference(); NoHeights; InputTooBig if references expand to a model
///         that is too large for the size of the file
Result<model::BuildingModel> assemble(Part&& part, const DocumentFacts& facts, const ReadOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace svt::readers::citygml
