#pragma once
/// \file
/// Parses one chunk of a document independently.

#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <string>
#include <string_view>

namespace svt::readers::citygml {

/// \param document  the whole file, UTF-8
/// \param rootTag   start tag of the root; its namespace prefixes are in scope
/// \return the part, or one whose `error` is set (BadXml, BadEncoding, with line and column)
/// Threads: safe to call in parallel. Cost: O(chunk).
Part parseChunk(std::string_view document, std::string_view rootTag, const xml::Chunk& chunk,
                std::string_view fileName);

}  // namespace svt::readers::citygml
