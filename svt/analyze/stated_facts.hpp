#pragma once
/// \file
/// Facts that a model states in words, as a person reads them: addresses, and names that nobody filled in.

#include <svt/volume/label_table.hpp>

#include <string>
#include <string_view>

namespace svt::analyze {

/// Whether a text is one that templates of other programs have where nobody filled in a fact: "Enter address here".
[[nodiscard]] bool isPlaceholder(std::string_view text);

/// The first attribute with this name whose value is a text; empty without one.
[[nodiscard]] std::string statedText(const volume::Label& label, std::string_view name);

/// The address in one line, without placeholders: the attribute `address` of IFC, or the members "address/..." of CityGML
/// and CityJSON, as street and number, postal code and town, further members, country. Empty without an address.
[[nodiscard]] std::string postalAddress(const volume::Label& label);

}  // namespace svt::analyze
