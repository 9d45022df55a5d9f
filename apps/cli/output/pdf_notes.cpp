#include <apps/cli/output/pdf_notes.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

namespace svt::cli {

void noteMissingLetters(const std::string& letters) {
    if (letters.empty()) return;
    note(
        fmt::format("no font on this machine has the letters '{}'; the PDF has boxes in their place. Install a font "
                    "that has them (Debian: fonts-noto-cjk for Chinese, Japanese and Korean, fonts-noto-core for "
                    "other scripts), or write SVG",
                    letters));
}

void noteMissingLetters(const volume::LabelTable& table) {
    std::string names;
    for (const volume::Label& label : table.labels) names += label.name;
    noteMissingLetters(writers::lettersWithoutFont(names));
}

}  // namespace svt::cli
