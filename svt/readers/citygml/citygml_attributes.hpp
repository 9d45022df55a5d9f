#pragma once
/// \file
/// Converts values of CityGML properties to attributes of a feature.

#include <svt/model/building_model.hpp>
#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::citygml {

/// Short name of a unit of measure: "m" for "m", "#m" and "urn:ogc:def:uom:UCUM::m".
[[nodiscard]] std::string_view unitName(std::string_view uom) noexcept;

/// Adds a property that holds text: as number, boolean or measure if its name or uom says so, else as text.
/// \return false if a number was expected but the text is not one; the attribute is then kept as text
bool addTextAttribute(std::vector<Attribute>& attributes, std::string_view name, std::string_view text,
                      std::string_view uom);

/// The name of a generic attribute or of a set of them.
[[nodiscard]] std::string genericName(xml::NameScope& scope, const xml::Element& element);

/// Adds a generic attribute of CityGML 1.0 and 2.0 (gen:intAttribute name="k") or 3.0 (gen:IntAttribute with gen:name).
/// Members of a set are named "set/name".
/// \return false if a number was expected but the text is not one
bool addGenericAttribute(std::vector<Attribute>& attributes, xml::NameScope& scope, const xml::Element& element,
                         std::string_view set);

/// Adds a structured value (con:Height, core:ExternalReference, core:Address): one attribute per text, named
/// `property` for the value itself, else "property/part".
void addStructuredAttributes(std::vector<Attribute>& attributes, xml::NameScope& scope, const xml::Element& element,
                             std::string_view property);

}  // namespace svt::readers::citygml
