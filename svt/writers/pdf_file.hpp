#pragma once
/// \file
/// A PDF in memory, with the letters that it cannot show.

#include <string>

namespace svt::writers {

struct PdfFile {
    std::string bytes;
    std::string missingLetters;  ///< letters that no font of the machine has, each once; they are drawn as boxes
    /// Arabic or Hebrew text whose letters are neither joined nor ordered, because the FriBidi library is missing.
    bool hasUnorderedText = false;
};

}  // namespace svt::writers
