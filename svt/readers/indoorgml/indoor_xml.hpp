#pragma once
/// \file
/// Elements of an IndoorGML document by their local names, so that extensions and all namespaces are read alike.

#include <svt/readers/xml/xml_names.hpp>

#include <pugixml.hpp>

#include <string>
#include <string_view>

namespace svt::readers::indoor {

[[nodiscard]] inline std::string_view localName(pugi::xml_node node) { return xml::splitName(node.name()).localName; }

/// True for a cell space of any class, those of the navigation module and of usual extensions included.
[[nodiscard]] bool isCellSpace(std::string_view localName);

/// True for a state or a transition by its names in versions 1 and 2.
[[nodiscard]] inline bool isState(std::string_view localName) { return localName == "State" || localName == "Node"; }
[[nodiscard]] inline bool isTransition(std::string_view localName) {
    return localName == "Transition" || localName == "Edge";
}

/// The next node in document order, only below `top`. Not recursive, so nesting may have any depth.
[[nodiscard]] pugi::xml_node nextNode(pugi::xml_node node, pugi::xml_node top, bool goesDown = true);

/// The value of an attribute by its local name, without blanks around it; empty if there is none.
[[nodiscard]] std::string_view attributeOf(pugi::xml_node node, std::string_view name);

/// The id that a reference within the file points to; empty for others.
[[nodiscard]] std::string target(pugi::xml_node node);

}  // namespace svt::readers::indoor
