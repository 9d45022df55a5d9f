#include <svt/core/text.hpp>
#include <svt/image/text.hpp>

#include <svt/core/check.hpp>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

extern "C" {
extern const unsigned char svt_font[];
extern const std::size_t svt_font_size;
}

namespace svt::image {
namespace {

// The em size is about three quarters of the line height.
FT_UInt pixelsOf(double height) noexcept { return static_cast<FT_UInt>(std::clamp(0.78 * height, 3.0, 400.0) + 0.5); }

// FreeType faces are not thread-safe, so each text has its own.
class Font {
public:
    explicit Font(double height) {
        SVT_CHECK(FT_Init_FreeType(&library_) == 0);
        SVT_CHECK(FT_New_Memory_Face(library_, svt_font, static_cast<FT_Long>(svt_font_size), 0, &face_) == 0);
        FT_Set_Pixel_Sizes(face_, 0, pixelsOf(height));
    }
    ~Font() {
        FT_Done_Face(face_);
        FT_Done_FreeType(library_);
    }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    // Renders a glyph; null if it cannot be drawn.
    [[nodiscard]] FT_GlyphSlot glyph(char32_t letter) const {
        return FT_Load_Char(face_, letter, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) == 0 ? face_->glyph : nullptr;
    }
    // The advance of a glyph, without rendering it; 0 if it cannot be loaded.
    [[nodiscard]] double advanceOf(char32_t letter) const {
        return FT_Load_Char(face_, letter, FT_LOAD_NO_HINTING) == 0 ? advance(face_->glyph) : 0;
    }
    [[nodiscard]] bool has(char32_t letter) const { return FT_Get_Char_Index(face_, letter) != 0; }
    [[nodiscard]] double advance(FT_GlyphSlot glyph) const { return static_cast<double>(glyph->advance.x) / 64; }
    // Distance from the vertical centre to the baseline: half the height of capitals.
    [[nodiscard]] double baseline() const { return 0.36 * face_->size->metrics.y_ppem; }

private:
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

// Decodes UTF-8; each byte that is not valid UTF-8 becomes U+FFFD.
std::vector<char32_t> lettersOf(std::string_view text) {
    std::vector<char32_t> letters;
    for (std::size_t n = 0; n < text.size();) {
        const Utf8Character character = firstCharacter(text.substr(n));
        letters.push_back(character.size != 0 ? character.code : 0xFFFD);
        n += std::max<std::size_t>(character.size, 1);
    }
    return letters;
}

// The advances of letters by size. Sheets measure the same letters in thousands of texts, and opening the font takes
// longer than all of them.
class Advances {
public:
    double widthOf(std::string_view text, double height) {
        const FT_UInt size = pixelsOf(height);
        std::optional<Font> font;
        double width = 0;
        const std::lock_guard lock(inUse_);
        for (const char32_t letter : lettersOf(text)) {
            const std::uint64_t key = std::uint64_t{size} << 32 | letter;
            auto found = known_.find(key);
            if (found == known_.end()) {
                if (!font) font.emplace(height);
                if (known_.size() >= kMostLetters) known_.clear();
                found = known_.emplace(key, font->advanceOf(letter)).first;
            }
            width += found->second;
        }
        return width;
    }

private:
    static constexpr std::size_t kMostLetters = 4096;
    std::mutex inUse_;
    std::unordered_map<std::uint64_t, double> known_;
};

bool isIn(const Image<Rgba8>& image, std::int32_t x, std::int32_t y) {
    return x >= 0 && y >= 0 && x < image.width() && y < image.height();
}

void blend(Image<Rgba8>& image, std::int32_t x, std::int32_t y, Vec3f color, double share) {
    if (!isIn(image, x, y) || !(share > 0)) return;
    Rgba8& pixel = image.at(x, y);
    const double under = pixel.a / 255.0 * (1 - share), alpha = share + under;
    const auto channel = [&](std::uint8_t old, float drawn) {
        return static_cast<std::uint8_t>(
            std::clamp((double(drawn) * 255 * share + old * under) / alpha + 0.5, 0.0, 255.0));
    };
    pixel = {channel(pixel.r, color.x), channel(pixel.g, color.y), channel(pixel.b, color.z),
             static_cast<std::uint8_t>(std::min(255.0, alpha * 255 + 0.5))};
}

// Coverage of each pixel by letters.
struct Coverage {
    std::int32_t x = 0, y = 0, width = 0, height = 0;
    std::vector<float> shares;

    [[nodiscard]] float at(std::int32_t i, std::int32_t j) const noexcept {
        return i < 0 || j < 0 || i >= width || j >= height
                   ? 0
                   : shares[static_cast<std::size_t>(i) +
                            static_cast<std::size_t>(width) * static_cast<std::size_t>(j)];
    }
};

Coverage cover(double x, double y, std::string_view text, double height) {
    const Font font(height);
    const auto margin = static_cast<std::int32_t>(height) + 2;
    Coverage coverage;
    coverage.x = static_cast<std::int32_t>(std::floor(x)) - margin;
    coverage.y = static_cast<std::int32_t>(std::floor(y)) - margin;
    coverage.width = static_cast<std::int32_t>(textWidth(text, height)) + 2 * margin + 2;
    coverage.height = 2 * margin + 1;
    coverage.shares.assign(static_cast<std::size_t>(coverage.width) * static_cast<std::size_t>(coverage.height), 0);
    double pen = x;
    const auto baseline = static_cast<std::int32_t>(std::lround(y + font.baseline()));
    for (const char32_t letter : lettersOf(text)) {
        const FT_GlyphSlot glyph = font.glyph(letter);
        if (glyph == nullptr) continue;
        const auto left = static_cast<std::int32_t>(std::lround(pen)) + glyph->bitmap_left - coverage.x;
        const std::int32_t top = baseline - glyph->bitmap_top - coverage.y;
        for (unsigned row = 0; row < glyph->bitmap.rows; ++row)
            for (unsigned column = 0; column < glyph->bitmap.width; ++column) {
                const std::int32_t i = left + static_cast<std::int32_t>(column);
                const std::int32_t j = top + static_cast<std::int32_t>(row);
                if (i < 0 || j < 0 || i >= coverage.width || j >= coverage.height) continue;
                float& share = coverage.shares[static_cast<std::size_t>(i) +
                                               static_cast<std::size_t>(coverage.width) * static_cast<std::size_t>(j)];
                const std::ptrdiff_t byte =
                    static_cast<std::ptrdiff_t>(row) * glyph->bitmap.pitch + static_cast<std::ptrdiff_t>(column);
                share = std::max(share, static_cast<float>(glyph->bitmap.buffer[byte]) / 255);
            }
        pen += font.advance(glyph);
    }
    return coverage;
}

}  // namespace

std::span<const std::byte> embeddedFont() noexcept { return std::as_bytes(std::span(svt_font, svt_font_size)); }

std::string missingLetters(std::string_view text) {
    const Font font(12);
    std::string missing;
    for (std::size_t n = 0; n < text.size();) {
        const Utf8Character character = firstCharacter(text.substr(n));
        const std::string_view letter = text.substr(n, std::max<std::size_t>(character.size, 1));
        n += letter.size();
        if (character.size == 0 || character.code < 0x80 || font.has(character.code)) continue;
        if (missing.find(letter) == std::string::npos) missing += letter;
    }
    return missing;
}

double textWidth(std::string_view text, double height) {
    static Advances advances;
    return advances.widthOf(text, height);
}

void drawText(Image<Rgba8>& image, double x, double y, std::string_view text, const TextStyle& style) {
    const Coverage coverage = cover(x, y, text, style.height);
    const auto reach = static_cast<std::int32_t>(std::ceil(style.haloWidth));
    if (style.haloWidth > 0)
        for (std::int32_t j = 0; j < coverage.height; ++j)
            for (std::int32_t i = 0; i < coverage.width; ++i) {
                if (!isIn(image, coverage.x + i, coverage.y + j)) continue;
                double halo = 0;
                for (std::int32_t dy = -reach; dy <= reach; ++dy)
                    for (std::int32_t dx = -reach; dx <= reach; ++dx) {
                        const double far = std::clamp(style.haloWidth + 0.5 - std::hypot(dx, dy), 0.0, 1.0);
                        halo = std::max(halo, far * double(coverage.at(i + dx, j + dy)));
                    }
                blend(image, coverage.x + i, coverage.y + j, style.halo, 0.85 * halo);
            }
    for (std::int32_t j = 0; j < coverage.height; ++j)
        for (std::int32_t i = 0; i < coverage.width; ++i)
            blend(image, coverage.x + i, coverage.y + j, style.color, double(coverage.at(i, j)));
}

void drawLine(Image<Rgba8>& image, double x0, double y0, double x1, double y1, const Stroke& look) {
    const double reach = look.width / 2 + 1, dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
    const auto first = [&](double a, double b) {
        return static_cast<std::int32_t>(std::floor(std::min(a, b) - reach));
    };
    const auto last = [&](double a, double b) { return static_cast<std::int32_t>(std::ceil(std::max(a, b) + reach)); };
    for (std::int32_t y = std::max(0, first(y0, y1)); y <= std::min(image.height() - 1, last(y0, y1)); ++y)
        for (std::int32_t x = std::max(0, first(x0, x1)); x <= std::min(image.width() - 1, last(x0, x1)); ++x) {
            const double px = x + 0.5 - x0, py = y + 0.5 - y0;
            const double at = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
            const double distance = std::hypot(px - at * dx, py - at * dy);
            blend(image, x, y, look.color, std::clamp(look.width / 2 + 0.5 - distance, 0.0, 1.0));
        }
}

void drawDot(Image<Rgba8>& image, double x, double y, double radius, Vec3f color) {
    drawLine(image, x, y, x, y, {2 * radius, color});
}

}  // namespace svt::image
