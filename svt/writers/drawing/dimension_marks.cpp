#include <svt/writers/drawing/dimension_marks.hpp>

#include <svt/drawing/clip_segment.hpp>
#include <svt/image/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace svt::writers {
namespace {

using drawing::DimensionChain;
using drawing::DimensionSide;
using drawing::DimensionUnit;
using drawing::PlanePoint;

// Millimetres on paper.
constexpr double kFirst = 8.5, kPitch = 9, kFoot = 1.5, kTick = 1.1, kBeyondLast = 3;
constexpr double kGap = 0.7, kBesideTick = 1.3;  // between numbers, and beside the tick at the beginning of a part
// Baselines of numbers: on the line, above it, below it. The lower edge of the last is clear of the feet.
constexpr std::array<double, 3> kBaselines = {0.7, 2.5, -3.3};
constexpr double kSize = 2, kSmallSize = 1.6, kCapital = 0.73;  // font sizes; height of capitals in font sizes
constexpr double kLeastScale = 10;  // millimetres per metre: rooms and openings are dimensioned from 1:100 on
constexpr double kLeastRoom = 18;   // millimetres: smaller rooms have no space beside their name
constexpr double kHeightsGap = 0.9, kHeightsPitch = 2.1;  // of the heights of openings

double textWidthOf(const std::string& text, double size) {
    constexpr double kLine = 400, kEm = 312;  // pixels; see image::textWidth()
    return image::textWidth(text, kLine) / kEm * size;
}

bool isHorizontal(DimensionSide side) noexcept { return side == DimensionSide::Below || side == DimensionSide::Above; }

// A number of a chain: its place along the line, on one of three levels.
struct ChainText {
    std::string text;
    double middle = 0, length = 0;  // of its part
    double size = kSize;
    std::size_t level = 0;
    double at = 0;
    [[nodiscard]] double width() const { return textWidthOf(text, size); }
};

// Moves the texts of a level apart, each as little as possible: isotonic regression of their places less their widths.
void moveApart(std::vector<ChainText*>& texts) {
    struct Block {
        double sum = 0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const noexcept { return sum / static_cast<double>(count); }
    };
    std::vector<Block> blocks;
    std::vector<double> offsets;
    double offset = 0;
    for (std::size_t n = 0; n < texts.size(); ++n) {
        if (n > 0) offset += 0.5 * (texts[n - 1]->width() + texts[n]->width()) + kGap;
        offsets.push_back(offset);
        blocks.push_back({texts[n]->middle - offset, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
            const Block last = blocks.back();
            blocks.pop_back();
            blocks.back().sum += last.sum;
            blocks.back().count += last.count;
        }
    }
    std::size_t n = 0;
    for (const Block& block : blocks)
        for (std::size_t end = n + block.count; n < end; ++n) texts[n]->at = block.mean() + offsets[n];
}

// Numbers on the line where they fit; the others above and below it in turn.
void placeTexts(std::vector<ChainText>& texts) {
    const auto fits = [](const ChainText& text, double size) {
        return textWidthOf(text.text, size) + 2 * kBesideTick <= text.length;
    };
    const auto isBeside = [&](std::size_t n) { return n < texts.size() && !fits(texts[n], kSmallSize); };
    std::array<std::vector<ChainText*>, 3> levels;
    for (std::size_t n = 0; n < texts.size(); ++n) {
        ChainText& text = texts[n];
        text.at = text.middle;
        if (!isBeside(n)) {
            text.size = fits(text, kSize) ? kSize : kSmallSize;
            continue;
        }
        text.size = isBeside(n + 1) || (n > 0 && isBeside(n - 1)) ? kSmallSize : kSize;
        // The level whose last number ends first.
        const auto endOf = [&](std::size_t level) {
            const std::vector<ChainText*>& others = levels[level];
            return others.empty() ? -1e9 : others.back()->middle + 0.5 * others.back()->width();
        };
        const bool isFree = endOf(1) + kGap <= text.middle - 0.5 * text.width();
        text.level = isFree || endOf(1) <= endOf(2) ? 1 : 2;
        levels[text.level].push_back(&text);
    }
    moveApart(levels[1]);
    moveApart(levels[2]);
}

struct TextBox {
    PlanePoint low, high;
    [[nodiscard]] bool overlaps(const TextBox& other) const noexcept {
        return low.u < other.high.u && other.low.u < high.u && low.v < other.high.v && other.low.v < high.v;
    }
};

TextBox boxOf(const MarkText& text) {
    const double half = 0.5 * textWidthOf(text.text, text.size), high = kCapital * text.size;
    const PlanePoint at = text.at;
    if (text.isUpright) return {{at.u - high - 0.2, at.v - half - 0.3}, {at.u + 0.2, at.v + half + 0.3}};
    return {{at.u - half - 0.3, at.v - 0.2}, {at.u + half + 0.3, at.v + high + 0.2}};
}

class DimensionPlacer {
public:
    DimensionPlacer(const drawing::SectionDrawing& drawing, const std::pair<PlanePoint, PlanePoint>& box,
                    double millimetres)
        : drawing_(drawing), box_(box), millimetres_(millimetres) {}

    DimensionMarks place(const OpeningWords& words) {
        for (const DimensionChain& chain : drawing_.dimensions) addChain(chain);
        if (millimetres_ < kLeastScale) return std::move(placed_);
        for (const drawing::OpeningHeights& opening : drawing_.openings) addHeights(opening, words);
        for (const drawing::RoomDimension& dimension : drawing_.roomDimensions) addRoom(dimension);
        return std::move(placed_);
    }

private:
    void addChain(const DimensionChain& chain) {
        const double away = kFirst + chain.row * kPitch;
        const bool isFlat = isHorizontal(chain.side);
        const double at = chain.side == DimensionSide::Below   ? box_.first.v * millimetres_ - away
                          : chain.side == DimensionSide::Above ? box_.second.v * millimetres_ + away
                          : chain.side == DimensionSide::Left  ? box_.first.u * millimetres_ - away
                                                               : box_.second.u * millimetres_ + away;
        // `off` is above the line for a reader: upwards, or, where one reads from the right, to the left.
        const auto point = [&](double along, double off) {
            return isFlat ? PlanePoint{along, at + off} : PlanePoint{at - off, along};
        };
        std::vector<ChainText> texts;
        for (std::size_t n = 0; n + 1 < chain.stops.size(); ++n) {
            const double from = chain.stops[n] * millimetres_, to = chain.stops[n + 1] * millimetres_;
            texts.push_back({textOf(chain.stops[n + 1] - chain.stops[n]), 0.5 * (from + to), to - from});
        }
        placeTexts(texts);
        for (std::size_t n = 0; n < texts.size(); ++n) {
            const double from = chain.stops[n] * millimetres_, to = chain.stops[n + 1] * millimetres_;
            DimensionMark mark;
            mark.metres = chain.stops[n + 1] - chain.stops[n];
            mark.line = {point(from, 0), point(to, 0)};
            for (const double end : {from, to}) {
                mark.feet.push_back({point(end, -kFoot), point(end, kFoot)});
                mark.ticks.push_back({point(end - kTick, -kTick), point(end + kTick, kTick)});
            }
            const ChainText& text = texts[n];
            const double baseline = kBaselines[text.level];
            if (text.level > 0) {
                const double end = text.level == 1 ? baseline - 0.3 : baseline + kCapital * text.size + 0.3;
                mark.feet.push_back({point(text.middle, 0), point(text.at, end)});
            }
            mark.text = {point(text.at, baseline), text.size, text.text, !isFlat};
            taken_.push_back(boxOf(mark.text));
            placed_.marks.push_back(std::move(mark));
        }
    }

    // Sill and head in two lines beside the wall, along it.
    void addHeights(const drawing::OpeningHeights& opening, const OpeningWords& words) {
        std::vector<std::string> lines;
        if (opening.sill > 0.005) lines.push_back(words.sill + " " + textOf(opening.sill));
        lines.push_back(words.head + " " + textOf(opening.head));
        const bool isUpright = std::abs(opening.away.u) > std::abs(opening.away.v);
        const PlanePoint up = isUpright ? PlanePoint{-1, 0} : PlanePoint{0, 1},
                         at{opening.at.u * millimetres_, opening.at.v * millimetres_};
        const bool isAbove = opening.away.u * up.u + opening.away.v * up.v > 0;
        const double above = static_cast<double>(lines.size() - 1) * kHeightsPitch;
        const double top = isAbove ? kHeightsGap + above : -kHeightsGap - kCapital * kSmallSize;
        const auto textsAt = [&](double shift, double out) {
            std::vector<MarkText> texts;
            for (std::size_t n = 0; n < lines.size(); ++n) {
                const double off = top - static_cast<double>(n) * kHeightsPitch + (isAbove ? out : -out);
                texts.push_back(
                    {{at.u + up.u * off + (isUpright ? 0 : shift), at.v + up.v * off + (isUpright ? shift : 0)},
                     kSmallSize,
                     lines[n],
                     isUpright});
            }
            return texts;
        };
        // The place with the fewest lines, and nearest to the wall among these.
        constexpr double kLineCost = 3, kShiftCost = 0.3;  // millimetres of distance
        const std::vector<MarkLine> near = linesAround(at);
        std::vector<MarkText> best;
        double least = kInfinity;
        for (const double out : {0.0, 1.5, 3.0, 4.5, 6.0})
            for (const double shift : {0.0, 3.0, -3.0, 6.0, -6.0}) {
                double cost = out + kShiftCost * std::abs(shift);
                if (cost >= least) continue;
                std::vector<MarkText> texts = textsAt(shift, out);
                for (const MarkText& text : texts) {
                    const TextBox box = boxOf(text);
                    if (isTaken(box)) cost = kInfinity;
                    for (const MarkLine& line : near)
                        if (drawing::clipSegment(line.from, line.to, box.low, box.high)) cost += kLineCost;
                }
                if (cost >= least) continue;
                least = cost;
                best = std::move(texts);
            }
        if (best.empty()) ++placed_.withoutPlace;
        for (MarkText& text : best) {
            taken_.push_back(boxOf(text));
            placed_.heights.push_back(std::move(text));
        }
    }

    // The lines of the drawing around a point, millimetres.
    [[nodiscard]] std::vector<MarkLine> linesAround(PlanePoint at) const {
        constexpr double kReach = 20;
        const PlanePoint low{at.u - kReach, at.v - kReach}, high{at.u + kReach, at.v + kReach};
        std::vector<MarkLine> lines;
        const auto add = [&](PlanePoint from, PlanePoint to) {
            const PlanePoint a{from.u * millimetres_, from.v * millimetres_},
                b{to.u * millimetres_, to.v * millimetres_};
            if (const auto part = drawing::clipSegment(a, b, low, high)) lines.push_back({part->first, part->second});
        };
        for (const drawing::SectionBorder& border : drawing_.borders)
            for (std::size_t n = 0; n + 1 < border.points.size(); ++n) add(border.points[n], border.points[n + 1]);
        for (const drawing::SectionLine& line : drawing_.lines)
            for (std::size_t n = 0; n + 1 < line.points.size(); ++n) add(line.points[n], line.points[n + 1]);
        for (const drawing::BeyondLine& line : drawing_.beyond) add(line.from, line.to);
        return lines;
    }

    // The shorter of the dimensions of a room, millimetres.
    [[nodiscard]] double shortestOf(std::uint32_t room) const noexcept {
        double shortest = 1e9;
        for (const drawing::RoomDimension& d : drawing_.roomDimensions)
            if (d.label == room) shortest = std::min(shortest, std::hypot(d.to.u - d.from.u, d.to.v - d.from.v));
        return shortest * millimetres_;
    }

    void addRoom(const drawing::RoomDimension& dimension) {
        if (shortestOf(dimension.label) < kLeastRoom) {
            ++placed_.withoutPlace;
            return;
        }
        const bool isFlat = dimension.from.v == dimension.to.v;
        const double at = (isFlat ? dimension.from.v : dimension.from.u) * millimetres_,
                     from = (isFlat ? dimension.from.u : dimension.from.v) * millimetres_,
                     to = (isFlat ? dimension.to.u : dimension.to.v) * millimetres_;
        const auto point = [&](double along, double off) {
            return isFlat ? PlanePoint{along, at + off} : PlanePoint{at - off, along};
        };
        DimensionMark mark;
        mark.metres = (to - from) / millimetres_;
        mark.line = {point(from, 0), point(to, 0)};
        for (const double end : {from, to})
            mark.ticks.push_back({point(end - kTick, -kTick), point(end + kTick, kTick)});
        mark.text = {{}, kSmallSize, textOf(mark.metres), !isFlat};
        const double half = 0.5 * textWidthOf(mark.text.text, kSmallSize) + kBesideTick;
        for (const double share : {0.5, 0.62, 0.38, 0.74, 0.8}) {
            const double middle = from + share * (to - from);
            mark.text.at = point(middle, kBaselines[0]);
            const TextBox box = boxOf(mark.text);
            if (middle - half < from || middle + half > to || isTaken(box) || meetsRoomLine(box, dimension)) continue;
            taken_.push_back(box);
            placed_.marks.push_back(std::move(mark));
            return;
        }
        ++placed_.withoutPlace;
    }

    [[nodiscard]] std::string textOf(double metres) const { return dimensionText(metres, drawing_.dimensionUnit); }
    [[nodiscard]] bool isTaken(const TextBox& box) const noexcept {
        return std::any_of(taken_.begin(), taken_.end(), [&](const TextBox& other) { return box.overlaps(other); });
    }
    // Whether the line of another room dimension runs through a box.
    [[nodiscard]] bool meetsRoomLine(const TextBox& box, const drawing::RoomDimension& own) const noexcept {
        return std::any_of(drawing_.roomDimensions.begin(), drawing_.roomDimensions.end(), [&](const auto& other) {
            const PlanePoint a{other.from.u * millimetres_, other.from.v * millimetres_},
                b{other.to.u * millimetres_, other.to.v * millimetres_};
            return !(other == own) &&
                   box.overlaps({{std::min(a.u, b.u), std::min(a.v, b.v)}, {std::max(a.u, b.u), std::max(a.v, b.v)}});
        });
    }

    const drawing::SectionDrawing& drawing_;
    const std::pair<PlanePoint, PlanePoint>& box_;
    double millimetres_;
    std::vector<TextBox> taken_;
    DimensionMarks placed_;
};

// A number of hundredths with a superscript for the thousandths.
std::string withRaised(long long millimetres, bool inMetres) {
    constexpr const char* kRaised[] = {"",       "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const long long centimetres = millimetres / 10;
    const char* rest = kRaised[millimetres % 10];
    if (!inMetres) return fmt::format("{}{}", centimetres, rest);
    return fmt::format("{}.{:02}{}", centimetres / 100, centimetres % 100, rest);
}

std::string feetAndInches(double metres) {
    const long long sixteenths = std::llround(metres / 0.0254 * 16);
    const long long feet = sixteenths / 192, inches = sixteenths % 192 / 16, rest = sixteenths % 16;
    if (sixteenths == 0) return "0'-0\"";
    std::string text = feet > 0 ? fmt::format("{}'-", feet) : std::string();
    if (inches > 0 || feet > 0) text += fmt::format("{}", inches);
    if (rest > 0) {
        const long long divisor = std::gcd(rest, 16LL);
        text += fmt::format("{}{}/{}", inches > 0 || feet > 0 ? " " : "", rest / divisor, 16 / divisor);
    }
    return text + "\"";
}

}  // namespace

double dimensionReach(const drawing::SectionDrawing& drawing, DimensionSide side) noexcept {
    int rows = 0;
    for (const DimensionChain& chain : drawing.dimensions)
        if (chain.side == side) rows = std::max(rows, chain.row + 1);
    return rows == 0 ? 0 : kFirst + (rows - 1) * kPitch + kBeyondLast;
}

std::string dimensionText(double metres, DimensionUnit unit) {
    const long long millimetres = std::llround(metres * 1000);
    switch (unit) {
        case DimensionUnit::Millimetres: return fmt::format("{}", millimetres);
        case DimensionUnit::Centimetres:
            return millimetres % 10 == 0 ? fmt::format("{}", millimetres / 10)
                                         : fmt::format("{}.{}", millimetres / 10, millimetres % 10);
        case DimensionUnit::Metres: return withRaised(millimetres, true);
        case DimensionUnit::FeetInches: return feetAndInches(metres);
        case DimensionUnit::MetresCentimetres: break;
    }
    return withRaised(millimetres, millimetres >= 1000);
}

DimensionMarks placeDimensions(const drawing::SectionDrawing& drawing, const std::pair<PlanePoint, PlanePoint>& box,
                               double millimetres, const OpeningWords& words) {
    return DimensionPlacer(drawing, box, millimetres).place(words);
}

}  // namespace svt::writers
