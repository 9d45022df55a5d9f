#pragma once
/// \file
/// The words of the trade for classes of CityGML and types of IFC.

#include <svt/writers/sheet_writer.hpp>

#include <string>
#include <string_view>

namespace svt::writers {

/// The word for a class or a type: "Wall" and "Wand" for `IfcWallStandardCase`. A name without a word is split:
/// `IfcFlowInstrument` becomes "Flow instrument". Cost: O(words of the table).
[[nodiscard]] std::string classWord(std::string_view name, SheetLanguage language);

}  // namespace svt::writers
