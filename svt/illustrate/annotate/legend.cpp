#include <svt/illustrate/annotate/legend.hpp>

#include <svt/core/rounding.hpp>
#include <svt/illustrate/annotate/name_tags.hpp>
#include <svt/image/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace svt::illustrate {
namespace {

constexpr double kWidthInHeights = 15;  // of the legend, in heights of its text
constexpr int kLinesOfBar = 9;

void fill(image::Image<image::Rgba8>& image, double x0, double y0, double x1, double y1, Vec3f color) {
    const auto byte = [](float c) { return static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0f, 1.0f) * 255)); };
    const auto within = [](double v, std::int32_t n) {
        return std::clamp(static_cast<std::int32_t>(std::lround(v)), 0, n);
    };
    for (std::int32_t y = within(y0, image.height()); y < within(y1, image.height()); ++y)
        for (std::int32_t x = within(x0, image.width()); x < within(x1, image.width()); ++x)
            image.at(x, y) = {byte(color.x), byte(color.y), byte(color.z), 255};
}

// Where the next line of a legend goes, and how it looks.
struct Pen {
    image::Image<image::Rgba8>& image;
    image::TextStyle style;
    double left, y;

    [[nodiscard]] double height() const { return style.height; }
    [[nodiscard]] double bottom() const { return image.height() - height(); }
    void text(double x, double at, const std::string& text) const {
        image::drawText(image, x, at, shortened(text, image.width() - x - height() / 2, height()), style);
    }
    // A line with a coloured field before it.
    void entry(const std::string& words, Vec3f color) {
        fill(image, left, y - 0.42 * height(), left + 1.2 * height(), y + 0.42 * height(), color);
        text(left + 1.7 * height(), y, words);
        y += 1.45 * height();
    }
};

void drawRamp(const ColorScale& scale, Pen& pen) {
    const double height = pen.height(), top = pen.y - 0.4 * height;
    const double bar = std::min(kLinesOfBar * 1.45 * height, std::max(height, pen.bottom() - top));
    const double range = scale.high - scale.low;
    for (int y = 0; y < bar; ++y)
        fill(pen.image, pen.left, top + y, pen.left + 1.2 * height, top + y + 1,
             rampColor(scale, scale.high - range * y / bar));
    const auto tick = [&](double value) {
        const double y = top + (range > 0 ? (scale.high - value) / range : 0.5) * bar;
        fill(pen.image, pen.left + 1.2 * height, y, pen.left + 1.5 * height, y + 1, pen.style.color);
        pen.text(pen.left + 1.7 * height, y, fmt::format("{:.6g}", value));
    };
    if (range > 0) {
        const double step = roundDownTo125(range / 3);
        for (double n = std::ceil(scale.low / step); n * step <= scale.high; n += 1) tick(n * step);
    } else {
        tick(scale.low);
    }
    pen.y = top + bar + height;
}

}  // namespace

double legendMargin(std::int32_t width, std::int32_t height) noexcept {
    return std::min(0.3, (kWidthInHeights + 1) * nameHeight(height) / width);
}

void drawLegend(const ColorScale& scale, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image) {
    const double height = nameHeight(image.height());
    Pen pen{image,
            {height, color, halo, std::max(1.0, 0.14 * height)},
            image.width() * (1 - legendMargin(image.width(), image.height())) + height / 2,
            1.5 * height};
    pen.text(pen.left, pen.y, scale.title);
    pen.y += 1.6 * height;
    if (scale.isRamp) drawRamp(scale, pen);
    for (std::size_t n = 0; n < scale.entries.size(); ++n) {
        // The last line that fits says how many do not.
        if (pen.y + 1.45 * height > pen.bottom() && n + 1 < scale.entries.size()) {
            pen.text(pen.left, pen.y, fmt::format("... {} more", scale.entries.size() - n));
            return;
        }
        pen.entry(scale.entries[n].text, scale.entries[n].color);
    }
    if (!scale.missingText.empty()) pen.entry(scale.missingText, missingColor());
    if (scale.missing != 0) pen.entry(fmt::format("no value ({})", scale.missing), missingColor());
    for (const std::string& note : scale.notes) {
        if (pen.y > pen.bottom()) break;
        pen.text(pen.left, pen.y, note);
        pen.y += 1.45 * height;
    }
}

}  // namespace svt::illustrate
