#include <svt/writers/drawing/dimension_marks.hpp>

#include <svt/image/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::writers {
namespace {

using drawing::DimensionChain;
using drawing::DimensionSide;
using drawing::PlanePoint;

// Millimetres on paper.
constexpr double kFirst = 7, kPitch = 9, kFoot = 1.5, kTick = 1.1, kBeyondLast = 3;
constexpr double kGap = 0.7, kBesideTick = 1.3;  // between numbers, and beside the tick at the beginning of a part
// Baselines above the line on which numbers are tried, in this order; the lower edge of the last is clear of the feet.
constexpr double kBaselines[] = {0.7, 2.5, -3.3};
constexpr double kSizes[] = {2, 1.6};

double textWidthOf(const std::string& text, double size) {
    constexpr double kLine = 400, kEm = 312;  // pixels; see image::textWidth()
    return image::textWidth(text, kLine) / kEm * size;
}

// Where on the three levels of a chain numbers stand already.
class NumberRows {
public:
    // The level and size of a number that is centred at `middle`, in a part of `length`; level -1: no place.
    std::pair<int, double> place(const std::string& text, double middle, double length) {
        for (const double size : kSizes) {
            const double half = 0.5 * textWidthOf(text, size);
            for (int level = 0; level < 3; ++level) {
                double& taken = taken_[static_cast<std::size_t>(level)];
                if (level == 0 ? 2 * (half + kBesideTick) > length : middle - half - kGap < taken) continue;
                taken = std::max(taken, middle + half);
                return {level, size};
            }
        }
        return {-1, 0};
    }

private:
    std::array<double, 3> taken_{-1e9, -1e9, -1e9};
};

bool isHorizontal(DimensionSide side) noexcept { return side == DimensionSide::Below || side == DimensionSide::Above; }

}  // namespace

double dimensionReach(const drawing::SectionDrawing& drawing, DimensionSide side) noexcept {
    int rows = 0;
    for (const DimensionChain& chain : drawing.dimensions)
        if (chain.side == side) rows = std::max(rows, chain.row + 1);
    return rows == 0 ? 0 : kFirst + (rows - 1) * kPitch + kBeyondLast;
}

std::string dimensionText(double metres) {
    constexpr const char* kRaised[] = {"",       "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const long long millimetres = std::llround(metres * 1000);
    const char* rest = kRaised[millimetres % 10];
    const long long centimetres = millimetres / 10;
    if (centimetres < 100) return fmt::format("{}{}", centimetres, rest);
    return fmt::format("{}.{:02}{}", centimetres / 100, centimetres % 100, rest);
}

DimensionMarks placeDimensions(const drawing::SectionDrawing& drawing, const std::pair<PlanePoint, PlanePoint>& box,
                               double millimetres) {
    DimensionMarks placed;
    for (const DimensionChain& chain : drawing.dimensions) {
        const double away = kFirst + chain.row * kPitch;
        const bool isFlat = isHorizontal(chain.side);
        const double at = chain.side == DimensionSide::Below   ? box.first.v * millimetres - away
                          : chain.side == DimensionSide::Above ? box.second.v * millimetres + away
                          : chain.side == DimensionSide::Left  ? box.first.u * millimetres - away
                                                               : box.second.u * millimetres + away;
        // `off` is above the line for a reader: upwards, or, where one reads from the right, to the left.
        const auto point = [&](double along, double off) {
            return isFlat ? PlanePoint{along, at + off} : PlanePoint{at - off, along};
        };
        NumberRows rows;
        for (std::size_t n = 0; n + 1 < chain.stops.size(); ++n) {
            const double from = chain.stops[n] * millimetres, to = chain.stops[n + 1] * millimetres;
            DimensionMark mark;
            mark.metres = chain.stops[n + 1] - chain.stops[n];
            mark.line = {point(from, 0), point(to, 0)};
            for (const double end : {from, to}) {
                mark.feet.push_back({point(end, -kFoot), point(end, kFoot)});
                mark.ticks.push_back({point(end - kTick, -kTick), point(end + kTick, kTick)});
            }
            const std::string text = dimensionText(mark.metres);
            const double middle = 0.5 * (from + to);
            const auto [level, size] = rows.place(text, middle, to - from);
            if (level >= 0)
                mark.text = {point(middle, kBaselines[static_cast<std::size_t>(level)]), size, text, !isFlat};
            else
                ++placed.withoutPlace;
            placed.marks.push_back(std::move(mark));
        }
    }
    return placed;
}

}  // namespace svt::writers
