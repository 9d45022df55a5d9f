#include <svt/writers/field/field_marks.hpp>

#include <svt/core/rounding.hpp>
#include <svt/image/color_map.hpp>
#include <svt/image/color_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr double kEvery = 80;       // millimetres along a line from one value to the next
constexpr double kLetter = 0.6;     // width of a digit in font sizes
constexpr double kLeastLine = 2.5;  // shortest line with a value, in widths of the value
constexpr double kMostBar = 90, kBarHeight = 3, kNoValueWidth = 24;  // millimetres

double distance(PlanePoint a, PlanePoint b) noexcept { return std::hypot(b.u - a.u, b.v - a.v); }

// A point of a line at a distance from its start, with the direction there.
struct Spot {
    PlanePoint at;
    double degrees = 0;
};
Spot spotAt(const std::vector<PlanePoint>& line, double along, double reach) {
    const auto pointAt = [&](double s) {
        for (std::size_t n = 0; n + 1 < line.size(); ++n) {
            const double length = distance(line[n], line[n + 1]);
            if (s <= length || n + 2 == line.size()) {
                const double t = length > 0 ? std::clamp(s / length, 0.0, 1.0) : 0;
                return PlanePoint{line[n].u + (line[n + 1].u - line[n].u) * t,
                                  line[n].v + (line[n + 1].v - line[n].v) * t};
            }
            s -= length;
        }
        return line.front();
    };
    const PlanePoint before = pointAt(std::max(0.0, along - reach)), after = pointAt(along + reach);
    double degrees = std::atan2(after.v - before.v, after.u - before.u) * 180 / std::numbers::pi;
    if (degrees > 90) degrees -= 180;
    if (degrees <= -90) degrees += 180;
    return {pointAt(along), degrees};
}

// A tick of a bar: the round values of a range.
std::vector<double> ticksOf(const drawing::FieldDrawing& field) {
    if (!(field.high > field.low)) return {field.low};
    double step = roundDownTo125((field.high - field.low) / 4);
    if (field.bandStep > 0) step = std::max(step, field.bandStep);
    std::vector<double> ticks;
    for (double n = std::ceil(field.low / step - 1e-9); n * step <= field.high * (1 + 1e-12) + 1e-12 * step; n += 1)
        ticks.push_back(n * step);
    if (ticks.empty()) ticks = {field.low, field.high};
    return ticks;
}

// The colour at a share of the range, linear between the entries.
std::string colorAt(const FieldLook& look, double share) {
    if (look.colors.empty()) return noValueColor();
    const std::size_t last = look.colors.size() - 1;
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(last);
    const std::size_t below = std::min(static_cast<std::size_t>(at), last);
    const auto rest = static_cast<float>(at - static_cast<double>(below));
    const Vec3f low = look.colors[below], high = look.colors[std::min(below + 1, last)];
    return image::colorText(low * (1 - rest) + high * rest);
}

}  // namespace

std::string bandColor(const FieldLook& look, const drawing::FieldBand& band) {
    return colorAt(look, look.field->shareOf((band.low + band.high) / 2));
}

std::string noValueColor() { return image::colorText(image::kNoValueColor); }

int autocadColor(const std::string& color) {
    const auto parsed = image::parseColor(color);
    if (!parsed) return 7;
    constexpr std::array kShades{1.0f, 0.65f, 0.5f, 0.3f, 0.15f};
    constexpr std::array kGreys{0.2f, 0.357f, 0.518f, 0.678f, 0.839f, 1.0f};
    int best = 7;
    float least = 1e9f;
    const auto tryOne = [&](int number, Vec3f candidate) {
        const Vec3f away = candidate - *parsed;
        if (const float distance = dot(away, away); distance < least) {
            least = distance;
            best = number;
        }
    };
    for (int number = 10; number < 250; ++number) {
        const int quarter = number / 10 - 1;
        const float hue = static_cast<float>(quarter) / 4;  // sixths of a turn
        const auto channel = [&](float at) {
            const float away = std::abs(std::remainder(hue - at, 6.0f));
            return std::clamp(2 - away, 0.0f, 1.0f);
        };
        const float shade = kShades[static_cast<std::size_t>(number % 10 / 2)];
        Vec3f candidate = Vec3f{channel(0), channel(2), channel(4)} * shade;
        if (number % 2 == 1) candidate = candidate * 0.5f + Vec3f{shade, shade, shade} * 0.5f;
        tryOne(number, candidate);
    }
    for (int n = 0; n < 6; ++n) {
        const float grey = kGreys[static_cast<std::size_t>(n)];
        tryOne(250 + n, {grey, grey, grey});
    }
    return best;
}

std::vector<FieldLabel> placeFieldLabels(const drawing::FieldDrawing& field, double millimetres) {
    std::vector<FieldLabel> labels;
    struct Disc {
        PlanePoint at;
        double radius;
    };
    std::vector<Disc> taken;
    for (const drawing::FieldIsoline& line : field.isolines) {
        FieldLabel label;
        label.text = fmt::format("{:.6g}", line.value);
        const double width = kLetter * label.size * static_cast<double>(label.text.size()) / millimetres;
        double length = 0;
        for (std::size_t n = 0; n + 1 < line.points.size(); ++n) length += distance(line.points[n], line.points[n + 1]);
        if (!(length > kLeastLine * width)) continue;
        const double every = kEvery / millimetres;
        const int count = static_cast<int>(std::clamp(std::floor(length / every), 1.0, 1e6));
        for (int n = 0; n < count; ++n) {
            const Spot spot = spotAt(line.points, length * (n + 0.5) / count, width / 2);
            const double radius = width / 2 + label.size / millimetres / 2;
            const bool isFree = std::none_of(taken.begin(), taken.end(), [&](const Disc& disc) {
                return distance(disc.at, spot.at) < disc.radius + radius;
            });
            if (!isFree) continue;
            taken.push_back({spot.at, radius});
            label.at = spot.at;
            label.degrees = spot.degrees;
            labels.push_back(label);
        }
    }
    return labels;
}

std::vector<PlanePoint> arrowHead(const drawing::FieldArrow& arrow) {
    constexpr double kBack = 0.3, kAside = 0.14;  // of the arrow's length
    const double u = arrow.to.u - arrow.from.u, v = arrow.to.v - arrow.from.v;
    const PlanePoint back{arrow.to.u - kBack * u, arrow.to.v - kBack * v};
    return {{back.u - kAside * v, back.v + kAside * u}, arrow.to, {back.u + kAside * v, back.v - kAside * u}};
}

FieldLegend makeFieldLegend(const FieldLook& look, double left, double top, double width) {
    const drawing::FieldDrawing& field = *look.field;
    FieldLegend legend;
    std::string title = field.title;
    if (field.isolineStep > 0)
        title += fmt::format(", lines every {:.6g}{}{}", field.isolineStep, field.unit.empty() ? "" : " ", field.unit);
    if (!field.arrows.empty())
        title += fmt::format(", longest arrow {:.3g}{}{}", field.high, field.unit.empty() ? "" : " ", field.unit);
    legend.texts.push_back({left, top + 2.5, 2.5, title, false});
    const double y = top + 4, bar = std::min(kMostBar, width - kNoValueWidth - 6);
    const double range = field.high - field.low;
    const auto placeOf = [&](double value) { return left + bar * (range > 0 ? (value - field.low) / range : 0.5); };
    if (field.bandStep > 0 && range > 0) {
        for (double k = std::floor(field.low / field.bandStep + 1e-9); k * field.bandStep < field.high - 1e-9 * range;
             k += 1) {
            const double low = k * field.bandStep, high = (k + 1) * field.bandStep;
            const double from = placeOf(std::max(low, field.low)), to = placeOf(std::min(high, field.high));
            legend.boxes.push_back({from, y, to - from, kBarHeight, bandColor(look, {low, high, {}}), false});
        }
    } else {
        constexpr int kSteps = 64;
        for (int n = 0; n < kSteps; ++n)
            legend.boxes.push_back(
                {left + bar * n / kSteps, y, bar / kSteps, kBarHeight, colorAt(look, (n + 0.5) / kSteps), false});
    }
    for (const double tick : ticksOf(field)) {
        legend.boxes.push_back({placeOf(tick) - 0.065, y, 0.13, kBarHeight + 0.8, "#000000", false});
        legend.texts.push_back({placeOf(tick), y + kBarHeight + 2.8, 1.8, fmt::format("{:.6g}", tick), true});
    }
    legend.boxes.push_back({left + bar + 6, y, 4, kBarHeight, noValueColor(), true});
    legend.texts.push_back({left + bar + 11, y + kBarHeight - 0.6, 2.2, "no value", false});
    return legend;
}

}  // namespace svt::writers
