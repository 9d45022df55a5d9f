#pragma once
/// \file
/// Values of CityGML properties as attributes of a feature. Internal to the readers.

#include <svt/model/building_model.hpp>
#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <string_view>
#include <vector>

namespace svt::readers::citygml {

/// The unit of a measure: "m" for "m", "#m" and "urn:ogc:def:uom:UCUM::m".
[[nodiscard]] std::string_view unitName(std::string_view uom) noexcept;

/// A property that holds text: a number, truth value or measure where its name or its uom says so, else text.
/// \return false where a number was expected and the text is none; the attribute is then kept as text
bool addTextAttribute(std::vector<Attribute>& attributes, std::string_view name, std::string_view text,
                      std::string_view uom);

/// A generic attribute of CityGML 1.0 and 2.0 (gen:intAttribute name="k") or 3.0 (gen:IntAttribute with gen:name).
/// Members of a set are named "set/name".
/// \return false where a number was expected and the text is none
bool addGenericAttribute(std::vector<Attribute>& attributes, xml::NameScope& scope, const xml::Element& element,
                         std::string_view set);

/// A value with parts (con:Height, core:ExternalReference, core:Address): one attribute per text, named
/// `property` for the value itself, else "property/part".
void addStructuredAttributes(std::vector<Attribute>& attributes, xml::NameScope& scope, const xml::Element& element,
                             std::string_view property);

}  // namespace svt::readers::citygml
