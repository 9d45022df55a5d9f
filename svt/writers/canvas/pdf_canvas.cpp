#include <svt/writers/canvas/pdf_canvas.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/image/text.hpp>
#include <svt/writers/canvas/pdf_layers.hpp>
#include <svt/writers/canvas/system_fonts.hpp>
#include <svt/writers/canvas/tile_path.hpp>
#include <svt/writers/canvas/visual_order.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <cairo/cairo-ft.h>
#include <cairo/cairo-pdf.h>
#include <fmt/format.h>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <map>

namespace svt::writers {
namespace {

// cairo's functions, under cairo's names. As PROJ, the library is loaded with the first use and not linked: of the
// commands one needs it, and it brings 20 libraries.
struct Cairo {
    decltype(&::cairo_pdf_surface_create_for_stream) pdf_surface_create_for_stream = nullptr;
    decltype(&::cairo_pdf_surface_set_size) pdf_surface_set_size = nullptr;
    decltype(&::cairo_pdf_surface_set_metadata) pdf_surface_set_metadata = nullptr;
    decltype(&::cairo_pdf_surface_add_outline) pdf_surface_add_outline = nullptr;
    decltype(&::cairo_recording_surface_create) recording_surface_create = nullptr;
    decltype(&::cairo_surface_finish) surface_finish = nullptr;
    decltype(&::cairo_surface_destroy) surface_destroy = nullptr;
    decltype(&::cairo_surface_status) surface_status = nullptr;
    decltype(&::cairo_create) create = nullptr;
    decltype(&::cairo_destroy) destroy = nullptr;
    decltype(&::cairo_status) status = nullptr;
    decltype(&::cairo_status_to_string) status_to_string = nullptr;
    decltype(&::cairo_save) save = nullptr;
    decltype(&::cairo_restore) restore = nullptr;
    decltype(&::cairo_scale) scale = nullptr;
    decltype(&::cairo_translate) translate = nullptr;
    decltype(&::cairo_rotate) rotate = nullptr;
    decltype(&::cairo_show_page) show_page = nullptr;
    decltype(&::cairo_new_path) new_path = nullptr;
    decltype(&::cairo_move_to) move_to = nullptr;
    decltype(&::cairo_line_to) line_to = nullptr;
    decltype(&::cairo_curve_to) curve_to = nullptr;
    decltype(&::cairo_close_path) close_path = nullptr;
    decltype(&::cairo_rectangle) rectangle = nullptr;
    decltype(&::cairo_fill) fill = nullptr;
    decltype(&::cairo_stroke) stroke = nullptr;
    decltype(&::cairo_paint) paint = nullptr;
    decltype(&::cairo_set_source_rgb) set_source_rgb = nullptr;
    decltype(&::cairo_set_source) set_source = nullptr;
    decltype(&::cairo_set_fill_rule) set_fill_rule = nullptr;
    decltype(&::cairo_set_line_width) set_line_width = nullptr;
    decltype(&::cairo_set_line_cap) set_line_cap = nullptr;
    decltype(&::cairo_set_line_join) set_line_join = nullptr;
    decltype(&::cairo_set_dash) set_dash = nullptr;
    decltype(&::cairo_pattern_create_for_surface) pattern_create_for_surface = nullptr;
    decltype(&::cairo_pattern_destroy) pattern_destroy = nullptr;
    decltype(&::cairo_pattern_set_extend) pattern_set_extend = nullptr;
    decltype(&::cairo_pattern_set_matrix) pattern_set_matrix = nullptr;
    decltype(&::cairo_matrix_init_scale) matrix_init_scale = nullptr;
    decltype(&::cairo_matrix_rotate) matrix_rotate = nullptr;
    decltype(&::cairo_ft_font_face_create_for_ft_face) ft_font_face_create_for_ft_face = nullptr;
    decltype(&::cairo_font_face_destroy) font_face_destroy = nullptr;
    decltype(&::cairo_set_font_face) set_font_face = nullptr;
    decltype(&::cairo_set_font_size) set_font_size = nullptr;
    decltype(&::cairo_show_text) show_text = nullptr;
    decltype(&::cairo_text_path) text_path = nullptr;
};

Result<Cairo> loadCairo() {
    const Result<SharedLibrary> library = SharedLibrary::load(SVT_CAIRO_LIBRARY);
    if (!library)
        return Error(Code::NoCairo, fmt::format("PDF needs the cairo library ({}); install it (Debian: libcairo2), or "
                                                "write the sheets as SVG",
                                                library.error().message()));
    Cairo cairo;
    bool isWhole = true;
    const auto find = [&](const char* name, auto& function) { isWhole = library->find(name, function) && isWhole; };
#define SVT_FIND(name) find("cairo_" #name, cairo.name)
    SVT_FIND(pdf_surface_create_for_stream);
    SVT_FIND(pdf_surface_set_size);
    SVT_FIND(pdf_surface_set_metadata);
    SVT_FIND(pdf_surface_add_outline);
    SVT_FIND(recording_surface_create);
    SVT_FIND(surface_finish);
    SVT_FIND(surface_destroy);
    SVT_FIND(surface_status);
    SVT_FIND(create);
    SVT_FIND(destroy);
    SVT_FIND(status);
    SVT_FIND(status_to_string);
    SVT_FIND(save);
    SVT_FIND(restore);
    SVT_FIND(scale);
    SVT_FIND(translate);
    SVT_FIND(rotate);
    SVT_FIND(show_page);
    SVT_FIND(new_path);
    SVT_FIND(move_to);
    SVT_FIND(line_to);
    SVT_FIND(curve_to);
    SVT_FIND(close_path);
    SVT_FIND(rectangle);
    SVT_FIND(fill);
    SVT_FIND(stroke);
    SVT_FIND(paint);
    SVT_FIND(set_source_rgb);
    SVT_FIND(set_source);
    SVT_FIND(set_fill_rule);
    SVT_FIND(set_line_width);
    SVT_FIND(set_line_cap);
    SVT_FIND(set_line_join);
    SVT_FIND(set_dash);
    SVT_FIND(pattern_create_for_surface);
    SVT_FIND(pattern_destroy);
    SVT_FIND(pattern_set_extend);
    SVT_FIND(pattern_set_matrix);
    SVT_FIND(matrix_init_scale);
    SVT_FIND(matrix_rotate);
    SVT_FIND(ft_font_face_create_for_ft_face);
    SVT_FIND(font_face_destroy);
    SVT_FIND(set_font_face);
    SVT_FIND(set_font_size);
    SVT_FIND(show_text);
    SVT_FIND(text_path);
#undef SVT_FIND
    if (!isWhole) return Error(Code::NoCairo, SVT_CAIRO_LIBRARY " lacks functions of cairo 1.16");
    return cairo;
}

const Result<Cairo>& loadedCairo() {
    static const Result<Cairo> cairo = loadCairo();
    return cairo;
}

constexpr double kPointsPerMillimetre = 72 / 25.4;
constexpr double kTileUnits = 100;  // of a tile's surface per millimetre: its extent is rounded to whole units

// One for the whole program, never released: cairo keeps fonts that were used, and may look at them until the program
// ends.
FT_Face embeddedFace() {
    static FT_Library library = nullptr;
    static const FT_Face face = [] {
        const auto font = image::embeddedFont();
        FT_Face opened = nullptr;
        const bool isOpen = FT_Init_FreeType(&library) == 0 &&
                            FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font.data()),
                                               static_cast<FT_Long>(font.size()), 0, &opened) == 0;
        return isOpen ? opened : nullptr;
    }();
    return face;
}

class CairoCanvas : public PdfCanvas {
public:
    CairoCanvas(const Cairo& cairo, const std::string& title, const std::string& language)
        : cairo_(cairo), systemFonts_(language) {
        surface_ = cairo_.pdf_surface_create_for_stream(&CairoCanvas::append, &bytes_, 595, 842);
        cairo_.pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_TITLE, title.c_str());
        cairo_.pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATOR, "svt");
        // The same bytes each time.
        cairo_.pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
        context_ = cairo_.create(surface_);
        if (FT_Face face = embeddedFace()) {
            font_ = cairo_.ft_font_face_create_for_ft_face(face, FT_LOAD_NO_HINTING);
            cairo_.set_font_face(context_, font_);
        }
    }
    ~CairoCanvas() override {
        for (const auto& [hatch, pattern] : patterns_) cairo_.pattern_destroy(pattern);
        if (font_ != nullptr) cairo_.font_face_destroy(font_);
        for (const auto& [face, font] : fonts_) cairo_.font_face_destroy(font);
        cairo_.destroy(context_);
        cairo_.surface_destroy(surface_);
    }
    CairoCanvas(const CairoCanvas&) = delete;
    CairoCanvas& operator=(const CairoCanvas&) = delete;

    void beginSheet(double width, double height, const std::string& title) override {
        cairo_.pdf_surface_set_size(surface_, width * kPointsPerMillimetre, height * kPointsPerMillimetre);
        isSheetNew_ = true;
        cairo_.pdf_surface_add_outline(surface_, CAIRO_PDF_OUTLINE_ROOT, title.c_str(),
                                       fmt::format("page={}", parts_.size() + 1).c_str(),
                                       static_cast<cairo_pdf_outline_flags_t>(0));
        cairo_.save(context_);
        cairo_.scale(context_, kPointsPerMillimetre, kPointsPerMillimetre);
        cairo_.set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
        cairo_.set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
    }
    void endSheet() override {
        if (isSheetNew_) openPart();
        cairo_.restore(context_);
        closePart();
    }
    void beginLayer(std::string_view name) override {
        if (hasLayers_) closePart();
        layer_ = name;
    }
    void endLayer() override { beginLayer({}); }

    void fill(const std::vector<PaperPath>& paths, std::string_view color) override {
        openPart();
        setColor(context_, color);
        addPaths(paths);
        cairo_.fill(context_);
    }
    void hatch(const std::vector<PaperPath>& paths, const HatchTile& tile) override {
        fill(paths, tile.tint);
        cairo_.set_source(context_, patternOf(tile));
        addPaths(paths);
        cairo_.fill(context_);
    }
    void stroke(const std::vector<PaperPath>& paths, const LineStyle& style) override {
        if (paths.empty()) return;
        openPart();
        std::vector<double> dashes(dashesOf(style.type).begin(), dashesOf(style.type).end());
        for (double& dash : dashes) dash *= style.width;
        cairo_.set_source_rgb(context_, 0, 0, 0);
        cairo_.set_line_width(context_, style.width);
        cairo_.set_line_cap(context_, dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
        cairo_.set_dash(context_, dashes.data(), static_cast<int>(dashes.size()), 0);
        addPaths(paths);
        cairo_.stroke(context_);
    }
    void text(const PaperText& text) override {
        openPart();
        if (text.isUpright) {
            cairo_.save(context_);
            cairo_.translate(context_, text.at.x, text.at.y);
            cairo_.rotate(context_, -0.5 * 3.14159265358979323846);
            PaperText flat = text;
            flat.isUpright = false;
            flat.at = {0, 0};
            this->text(flat);
            cairo_.restore(context_);
            return;
        }
        const std::string letters = orderedText(text.text);
        const double width = text.anchor == TextAnchor::Start ? 0 : widthOnPaper(letters, text.size);
        const double x = text.at.x - (text.anchor == TextAnchor::Middle ? 0.5 * width : width);
        cairo_.set_font_size(context_, text.size);
        const std::vector<TextRun> runs = runsOf(letters);
        const auto drawRuns = [&](auto draw) {
            cairo_.new_path(context_);
            cairo_.move_to(context_, x, text.at.y);
            for (const TextRun& run : runs) {
                cairo_.set_font_face(context_, run.font);
                draw(context_, run.text.c_str());
            }
        };
        if (text.hasHalo) {
            drawRuns(cairo_.text_path);
            cairo_.set_source_rgb(context_, 1, 1, 1);
            cairo_.set_line_width(context_, 0.6);
            cairo_.set_dash(context_, nullptr, 0, 0);
            cairo_.stroke(context_);
        }
        cairo_.set_source_rgb(context_, 0, 0, 0);
        drawRuns(cairo_.show_text);
        cairo_.new_path(context_);
    }

    Result<PdfFile> finish() override {
        const cairo_status_t drawn = cairo_.status(context_);
        cairo_.surface_finish(surface_);
        const cairo_status_t written = cairo_.surface_status(surface_);
        const cairo_status_t status = drawn != CAIRO_STATUS_SUCCESS ? drawn : written;
        if (font_ == nullptr || status != CAIRO_STATUS_SUCCESS)
            return Error(Code::CannotWrite,
                         fmt::format("cairo cannot make the PDF: {}",
                                     font_ == nullptr ? "the font cannot be read" : cairo_.status_to_string(status)));
        file_.bytes = std::move(bytes_);
        if (hasLayers_) {
            SVT_TRY(joined, joinPdfLayers(file_.bytes, parts_));
            file_.bytes = std::move(*joined);
        }
        return std::move(file_);
    }

private:
    // Letters of one font.
    struct TextRun {
        cairo_font_face_t* font;
        std::string text;
    };
    // Arabic and Hebrew letters from left to right, joined.
    std::string orderedText(const std::string& text) {
        if (!hasRightToLeft(text)) return text;
        std::optional<std::string> ordered = visualOrder(text);
        file_.hasUnorderedText = file_.hasUnorderedText || !ordered;
        if (!ordered) return text;
        return std::move(*ordered);
    }
    // Letters of no font stay with the embedded one, which draws boxes.
    std::vector<TextRun> runsOf(std::string_view text) {
        std::vector<TextRun> runs;
        while (!text.empty()) {
            const Utf8Character letter = firstCharacter(text);
            const std::string_view bytes = text.substr(0, letter.size != 0 ? letter.size : 1);
            text.remove_prefix(bytes.size());
            cairo_font_face_t* const font = letter.size == 0 ? font_ : fontOf(letter.code, bytes);
            if (runs.empty() || runs.back().font != font) runs.push_back({font, {}});
            runs.back().text += bytes;
        }
        return runs;
    }
    cairo_font_face_t* fontOf(char32_t letter, std::string_view bytes) {
        if (letter < 0x80) return font_;
        const auto [known, isNew] = fontOfLetter_.try_emplace(letter, font_);
        if (!isNew) return known->second;
        if (image::missingLetters(bytes).empty()) return font_;
        FT_Face face = systemFonts_.faceOf(letter);
        if (face == nullptr) {
            file_.missingLetters += bytes;
            return font_;
        }
        cairo_font_face_t*& font = fonts_[face];
        if (font == nullptr) font = cairo_.ft_font_face_create_for_ft_face(face, FT_LOAD_NO_HINTING);
        return known->second = font;
    }

    // Pages of cairo are parts of a sheet if there are layers, otherwise sheets. The first drawing operation begins a
    // page.
    void openPart() {
        if (isPartOpen_) return;
        parts_.push_back({isSheetNew_, hasLayers_ ? layer_ : std::string()});
        isSheetNew_ = false;
        isPartOpen_ = true;
    }
    void closePart() {
        if (!isPartOpen_) return;
        cairo_.show_page(context_);
        isPartOpen_ = false;
    }

    static cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
        static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    }

    void setColor(cairo_t* context, std::string_view color) const {
        const auto number = parseInteger<std::uint32_t>(color.substr(1), 16).value_or(0);
        cairo_.set_source_rgb(context, static_cast<double>(number >> 16 & 255) / 255,
                              static_cast<double>(number >> 8 & 255) / 255, static_cast<double>(number & 255) / 255);
    }

    void addPaths(const std::vector<PaperPath>& paths) const {
        cairo_.new_path(context_);
        for (const PaperPath& path : paths) {
            const bool isClosed = path.size() > 2 && path.front().x == path.back().x && path.front().y == path.back().y;
            for (std::size_t n = 0; n < path.size() - (isClosed ? 1 : 0); ++n)
                (n == 0 ? cairo_.move_to : cairo_.line_to)(context_, path[n].x, path[n].y);
            if (isClosed) cairo_.close_path(context_);
        }
    }

    // The lines of a hatch as a tile that repeats; made once for the file.
    cairo_pattern_t* patternOf(const HatchTile& tile) {
        if (const auto found = patterns_.find(tile.hatch); found != patterns_.end()) return found->second;
        const cairo_rectangle_t extent{0, 0, tile.width * kTileUnits, tile.height * kTileUnits};
        cairo_surface_t* surface = cairo_.recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extent);
        cairo_t* context = cairo_.create(surface);
        cairo_.scale(context, kTileUnits, kTileUnits);
        setColor(context, "#444444");
        cairo_.set_line_width(context, 0.13);
        for (const bool isFilled : {false, true}) {
            for (const TileStep& step : readTilePath(isFilled ? tile.filled : tile.lines)) {
                if (step.kind == TileStep::Kind::Move) cairo_.move_to(context, step.x, step.y);
                if (step.kind == TileStep::Kind::Line) cairo_.line_to(context, step.x, step.y);
                if (step.kind == TileStep::Kind::Curve)
                    cairo_.curve_to(context, step.x1, step.y1, step.x2, step.y2, step.x, step.y);
                if (step.kind == TileStep::Kind::Close) cairo_.close_path(context);
            }
            (isFilled ? cairo_.fill : cairo_.stroke)(context);
        }
        cairo_.destroy(context);
        cairo_pattern_t* pattern = cairo_.pattern_create_for_surface(surface);
        cairo_.surface_destroy(surface);
        cairo_.pattern_set_extend(pattern, CAIRO_EXTEND_REPEAT);
        cairo_matrix_t matrix;
        cairo_.matrix_init_scale(&matrix, kTileUnits, kTileUnits);
        cairo_.matrix_rotate(&matrix, -tile.turnDegrees * 3.14159265358979323846 / 180);
        cairo_.pattern_set_matrix(pattern, &matrix);
        patterns_.emplace(tile.hatch, pattern);
        return pattern;
    }

    const Cairo& cairo_;
    std::string bytes_;
    cairo_surface_t* surface_ = nullptr;
    cairo_t* context_ = nullptr;
    cairo_font_face_t* font_ = nullptr;
    SystemFonts systemFonts_;
    std::map<FT_Face, cairo_font_face_t*> fonts_;  // of the machine
    std::map<char32_t, cairo_font_face_t*> fontOfLetter_;
    PdfFile file_;
    std::map<render::Hatch, cairo_pattern_t*> patterns_;
    const bool hasLayers_ = missingPdfLayers().empty();
    std::vector<PdfPart> parts_;  // by page of cairo
    std::string layer_;
    bool isSheetNew_ = false, isPartOpen_ = false;
};

}  // namespace

Result<std::unique_ptr<PdfCanvas>> makePdfCanvas(const std::string& title, const volume::LabelTable* names) {
    if (!loadedCairo()) return loadedCairo().error();
    const std::string language = names != nullptr ? languageOfNames(*names) : "zh-cn";
    return std::unique_ptr<PdfCanvas>(std::make_unique<CairoCanvas>(*loadedCairo(), title, language));
}

}  // namespace svt::writers
