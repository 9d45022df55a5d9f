#pragma once
/// \file
/// Notes on PDF: letters without a font.

#include <svt/volume/label_table.hpp>

#include <string>

namespace svt::cli {

/// Prints a note on letters that are boxes in a PDF, with a remedy; nothing without letters.
void noteMissingLetters(const std::string& letters);

/// The same for the letters of all names, if no font of the machine has them.
void noteMissingLetters(const volume::LabelTable& table);

}  // namespace svt::cli
