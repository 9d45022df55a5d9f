#pragma once
/// \file
/// Reads IndoorGML 1.0 and 1.1, and the parts of 2.0 with the same encoding.
///
/// | in IndoorGML                                    | in the model                                               |
/// |-------------------------------------------------|------------------------------------------------------------|
/// | cell space of any class                         | BuildingRoom, its class as the attribute `cellSpaceClass`  |
/// | Solid of a cell space, else its surfaces        | solid with its hollows, else surfaces                      |
/// | name, description, function, class, usage, level | name, attributes                                          |
/// | description `storey="EG":usage="office"`        | one attribute each                                         |
/// | space layers, states and transitions            | features with lines, see indoor_graph.hpp                  |
/// | boundaries of cell spaces                       | nothing: the solids have them                              |
///
/// Elements are identified by their local names, so that extensions and both namespaces of version 1 are read in the
/// same way.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace svt::readers {

/// True if the text is XML with a root named IndoorFeatures.
[[nodiscard]] bool looksLikeIndoorGml(std::span<const std::byte> head) noexcept;

/// \return the model, or BadXml with its line, DtdRefused, BadEncoding, EmptyModel (no cell space), InputTooBig,
///         Cancelled, or an error of georeference(). Findings: BadCoordinate, TooFewPoints, DanglingReference,
///         DuplicateId, MissingId, DualityBroken, and those of georeference().
/// Cost: O(bytes); the whole document is in memory as a tree, about five times the size of the file.
[[nodiscard]] Result<model::BuildingModel> readIndoorGml(std::span<const std::byte> bytes, std::string_view name,
                                                         const ReadOptions& options, Diagnostics* diagnostics);

}  // namespace svt::readers
