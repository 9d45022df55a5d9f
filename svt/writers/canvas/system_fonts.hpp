#pragma once
/// \file
/// Fonts of the machine for letters that the embedded font lacks, found by fontconfig.

#include <svt/volume/label_table.hpp>

#include <memory>
#include <string>

using FT_Face = struct FT_FaceRec_*;

namespace svt::writers {

/// The language whose forms Chinese characters take: "ja" if a name has kana, "ko" if one has Hangul, otherwise "zh-cn".
/// Cost: O(letters of all names).
[[nodiscard]] std::string languageOfNames(const volume::LabelTable& table);

/// The font of a letter depends only on the installed fonts, their configuration and the language. Not thread-safe.
class SystemFonts {
public:
    /// Loads nothing yet.
    explicit SystemFonts(std::string language);
    ~SystemFonts();
    SystemFonts(const SystemFonts&) = delete;
    SystemFonts& operator=(const SystemFonts&) = delete;

    /// The first outline font that has the letter and may be embedded; null: none, or no fontconfig library. Faces stay
    /// open until the program ends. Cost: the first call sorts all fonts, tens of milliseconds; then O(fonts) per letter.
    [[nodiscard]] FT_Face faceOf(char32_t letter);

private:
    struct Fonts;
    std::string language_;
    std::unique_ptr<Fonts> fonts_;
};

}  // namespace svt::writers
