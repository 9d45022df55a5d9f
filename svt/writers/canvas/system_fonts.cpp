#include <svt/writers/canvas/system_fonts.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <fontconfig/fontconfig.h>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace svt::writers {
namespace {

// fontconfig's functions, under their names. The library comes with cairo and is loaded with the first use.
struct Fontconfig {
    decltype(&::FcInitLoadConfigAndFonts) InitLoadConfigAndFonts = nullptr;
    decltype(&::FcConfigDestroy) ConfigDestroy = nullptr;
    decltype(&::FcConfigSubstitute) ConfigSubstitute = nullptr;
    decltype(&::FcDefaultSubstitute) DefaultSubstitute = nullptr;
    decltype(&::FcPatternCreate) PatternCreate = nullptr;
    decltype(&::FcPatternDestroy) PatternDestroy = nullptr;
    decltype(&::FcPatternAddString) PatternAddString = nullptr;
    decltype(&::FcPatternGetString) PatternGetString = nullptr;
    decltype(&::FcPatternGetInteger) PatternGetInteger = nullptr;
    decltype(&::FcPatternGetBool) PatternGetBool = nullptr;
    decltype(&::FcPatternGetCharSet) PatternGetCharSet = nullptr;
    decltype(&::FcCharSetHasChar) CharSetHasChar = nullptr;
    decltype(&::FcFontSort) FontSort = nullptr;
    decltype(&::FcFontSetDestroy) FontSetDestroy = nullptr;
};

std::optional<Fontconfig> loadFontconfig() {
    const Result<SharedLibrary> library = SharedLibrary::load("libfontconfig.so.1");
    if (!library) return std::nullopt;
    Fontconfig found;
    bool isWhole = true;
    const auto find = [&](const char* name, auto& function) { isWhole = library->find(name, function) && isWhole; };
#define SVT_FIND(name) find("Fc" #name, found.name)
    SVT_FIND(InitLoadConfigAndFonts);
    SVT_FIND(ConfigDestroy);
    SVT_FIND(ConfigSubstitute);
    SVT_FIND(DefaultSubstitute);
    SVT_FIND(PatternCreate);
    SVT_FIND(PatternDestroy);
    SVT_FIND(PatternAddString);
    SVT_FIND(PatternGetString);
    SVT_FIND(PatternGetInteger);
    SVT_FIND(PatternGetBool);
    SVT_FIND(PatternGetCharSet);
    SVT_FIND(CharSetHasChar);
    SVT_FIND(FontSort);
    SVT_FIND(FontSetDestroy);
#undef SVT_FIND
    return isWhole ? std::optional(found) : std::nullopt;
}

// Opens a face once for the whole program: cairo keeps fonts that were used.
FT_Face openFace(const std::string& file, int index) {
    static std::mutex inUse;
    static FT_Library library = nullptr;
    static std::map<std::pair<std::string, int>, FT_Face> faces;
    const std::lock_guard lock(inUse);
    if (library == nullptr && FT_Init_FreeType(&library) != 0) return nullptr;
    const auto [at, isNew] = faces.try_emplace({file, index}, nullptr);
    if (!isNew) return at->second;
    FT_Face face = nullptr;
    if (FT_New_Face(library, file.c_str(), index, &face) != 0) return nullptr;
    const bool isAllowed = (FT_Get_FSType_Flags(face) & FT_FSTYPE_RESTRICTED_LICENSE_EMBEDDING) == 0;
    at->second = isAllowed ? face : nullptr;
    return at->second;
}

bool isKana(char32_t letter) noexcept { return letter >= 0x3041 && letter <= 0x30FF; }
bool isHangul(char32_t letter) noexcept { return letter >= 0xAC00 && letter <= 0xD7A3; }

}  // namespace

std::string languageOfNames(const volume::LabelTable& table) {
    bool hasHangul = false;
    for (const volume::Label& label : table.labels)
        for (std::string_view rest = label.name; !rest.empty();) {
            const Utf8Character letter = firstCharacter(rest);
            rest.remove_prefix(letter.size != 0 ? letter.size : 1);
            if (letter.size == 0) continue;
            if (isKana(letter.code)) return "ja";
            hasHangul = hasHangul || isHangul(letter.code);
        }
    return hasHangul ? "ko" : "zh-cn";
}

struct SystemFonts::Fonts {
    std::optional<Fontconfig> library = loadFontconfig();
    FcConfig* config = nullptr;
    FcFontSet* sorted = nullptr;
    std::map<char32_t, FT_Face> known{};

    // By closeness to a sans-serif font of the language. The language is always given, because fontconfig would take
    // that of the environment.
    explicit Fonts(const std::string& language) {
        if (!library) return;
        config = library->InitLoadConfigAndFonts();
        FcPattern* const pattern = library->PatternCreate();
        const auto add = [&](const char* object, const char* text) {
            library->PatternAddString(pattern, object, reinterpret_cast<const FcChar8*>(text));
        };
        add(FC_FAMILY, "sans-serif");
        add(FC_LANG, language.c_str());
        library->ConfigSubstitute(config, pattern, FcMatchPattern);
        library->DefaultSubstitute(pattern);
        FcResult result = FcResultMatch;
        sorted = library->FontSort(config, pattern, FcFalse, nullptr, &result);
        library->PatternDestroy(pattern);
    }
    ~Fonts() {
        if (sorted != nullptr) library->FontSetDestroy(sorted);
        if (config != nullptr) library->ConfigDestroy(config);
    }
    Fonts(const Fonts&) = delete;
    Fonts& operator=(const Fonts&) = delete;

    [[nodiscard]] FT_Face find(char32_t letter) const {
        for (int n = 0; sorted != nullptr && n < sorted->nfont; ++n) {
            const FcPattern* const font = sorted->fonts[n];
            FcCharSet* letters = nullptr;
            FcBool isOutline = FcFalse, isColored = FcFalse;
            FcChar8* file = nullptr;
            int index = 0;
            if (library->PatternGetCharSet(font, FC_CHARSET, 0, &letters) != FcResultMatch ||
                library->CharSetHasChar(letters, letter) == FcFalse ||
                library->PatternGetString(font, FC_FILE, 0, &file) != FcResultMatch)
                continue;
            library->PatternGetBool(font, FC_OUTLINE, 0, &isOutline);
            library->PatternGetBool(font, FC_COLOR, 0, &isColored);
            library->PatternGetInteger(font, FC_INDEX, 0, &index);
            if (isOutline == FcFalse || isColored == FcTrue) continue;
            // The upper half of an index is an instance of a variable font: its default is taken.
            if (FT_Face face = openFace(reinterpret_cast<const char*>(file), index & 0xFFFF)) return face;
        }
        return nullptr;
    }
};

SystemFonts::SystemFonts(std::string language) : language_(std::move(language)) {}
SystemFonts::~SystemFonts() = default;

FT_Face SystemFonts::faceOf(char32_t letter) {
    if (!fonts_) fonts_ = std::make_unique<Fonts>(language_);
    const auto [at, isNew] = fonts_->known.try_emplace(letter, nullptr);
    if (isNew) at->second = fonts_->find(letter);
    return at->second;
}

}  // namespace svt::writers
