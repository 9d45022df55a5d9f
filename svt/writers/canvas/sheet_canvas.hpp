#pragma once
/// \file
/// The drawing surface of a sheet: paper in millimetres, x to the right and y downwards from the upper left corner. One
/// implementation per format.

#include <svt/writers/drawing/drawing_style.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

struct PaperPoint {
    double x = 0, y = 0;
};
/// Closed if the last point is the first.
using PaperPath = std::vector<PaperPoint>;

/// Types of lines of ISO 128-2; dashes are multiples of the width.
enum class LineType : std::uint8_t {
    Continuous,         ///< 01
    Dashed,             ///< 02: 12 long, 3 apart
    LongDashDotted,     ///< 04: 24, a dot
    LongDashDoubleDots  ///< 05: 24, two dots
};
struct LineStyle {
    double width = 0.25;  ///< millimetres
    LineType type = LineType::Continuous;
};
/// Alternating lengths of dashes and gaps, in widths of the line; empty for continuous lines.
[[nodiscard]] std::span<const double> dashesOf(LineType type) noexcept;

enum class TextAnchor : std::uint8_t { Start, Middle, End };
struct PaperText {
    PaperPoint at;      ///< on the baseline
    double size = 2.5;  ///< font size, millimetres
    std::string text;   ///< UTF-8
    TextAnchor anchor = TextAnchor::Start;
    bool hasHalo = false;    ///< white around the letters, over lines
    bool isUpright = false;  ///< turned by 90 degrees, read from the right
};
/// Whether fonts draw a letter one em wide: Chinese, Japanese and Korean. DejaVu Sans lacks all of them.
[[nodiscard]] bool isWideLetter(char32_t code) noexcept;
[[nodiscard]] bool hasWideLetters(std::string_view text) noexcept;
/// Width of a text in DejaVu Sans, millimetres; wide letters count as one em.
[[nodiscard]] double widthOnPaper(std::string_view text, double size);
/// The text, or its beginning and an ellipsis if it is wider.
[[nodiscard]] std::string shortened(const std::string& text, double size, double width);

class SheetCanvas {
public:
    virtual ~SheetCanvas() = default;
    virtual void beginSheet(double width, double height, const std::string& title) = 0;
    virtual void endSheet() = 0;
    /// Layers do not nest.
    virtual void beginLayer(std::string_view name) = 0;
    virtual void endLayer() = 0;
    /// Fills the area that an odd number of paths encloses. \param color "#rrggbb"
    virtual void fill(const std::vector<PaperPath>& paths, std::string_view color) = 0;
    virtual void hatch(const std::vector<PaperPath>& paths, const HatchTile& tile) = 0;
    virtual void stroke(const std::vector<PaperPath>& paths, const LineStyle& style) = 0;
    virtual void text(const PaperText& text) = 0;
};

}  // namespace svt::writers
