#include <svt/core/file.hpp>
#include <svt/core/rounding.hpp>
#include <svt/core/text.hpp>
#include <svt/illustrate/hatches.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/svg_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::writers {
namespace {

using illustrate::PlanePoint;
using illustrate::SectionBorder;
using illustrate::SectionComponent;
using render::Hatch;
using volume::kNoLabel;

// Millimetres on paper.
constexpr double kMargin = 10, kTitleHeight = 24, kMinWidth = 90;
constexpr double kSlim = 0.7;
constexpr double kTextSize = 2.5, kLeastTextSize = 1.2;
constexpr double kTextWidth = 0.56;  // width of a character relative to the font size, sans serif

struct HatchStyle {
    Hatch hatch;
    const char* size;    // of the tile
    const char* turn;    // patternTransform
    const char* tint;    // background color below the lines
    const char* lines;   // path
    const char* filled;  // path, or none
};

constexpr HatchStyle kHatches[] = {
    {Hatch::Masonry, "width=\"1.4\" height=\"1.4\"", "rotate(-45)", "#f6e8e1", "M0 .7H1.4", ""},
    {Hatch::Concrete, "width=\"6\" height=\"6\"", "", "#eeeeec",
     "M.8 1.6l.9-.9.3 1.1zM3.6 4.9l1-.5-.1 1.1zM4.3 1.7l.5-.7.5.8z",
     "M2.9 .6h.22v.22h-.22zM1.2 3.3h.22v.22h-.22zM5.4 3.2h.22v.22h-.22zM3.1 2.7h.22v.22h-.22zM.6 5.3h.22v.22h-.22z"
     "M2.3 4.4h.22v.22h-.22zM5.6 .5h.22v.22h-.22zM4.2 3.7h.22v.22h-.22z"},
    {Hatch::ReinforcedConcrete, "width=\"2.6\" height=\"2.4\"", "rotate(-45)", "#e9edeb", "M0 .6H2.6M0 1.8H1.7", ""},
    {Hatch::Timber, "width=\"5\" height=\"1.8\"", "rotate(-20)", "#f8eed7",
     "M0 .45C1.2 .1 1.6 .9 2.5 .5S4.2 .3 5 .45M0 1.35C.9 1.6 1.8 1 2.7 1.3S4.2 1.5 5 1.35", ""},
    {Hatch::Insulation, "width=\"2.4\" height=\"3\"", "", "#fbf6d5", "M0 .2H2.4M0 2.8H2.4M0 2.8L1.2 .2L2.4 2.8", ""},
    {Hatch::Earth, "width=\"7\" height=\"7\"", "", "#efe6d8",
     "M.3 2.2L2.2 .3M1 2.9L2.9 1M1.7 3.6L3.6 1.7M4.2 .9L6.1 2.8M3.9 1.6L5.4 3.1M3.6 5.7L5.5 3.8M4.3 6.4L6.2 4.5"
     "M5 6.9L6.7 5.2M.4 4.4L2.3 6.3M1.1 4.2L3 6.1M.2 5.2L1.6 6.6",
     ""},
    {Hatch::Steel, "width=\"2\" height=\"1.8\"", "rotate(-45)", "#e3e8ee", "M0 .5H2M0 .95H2", ""},
    {Hatch::Glass, "width=\"4\" height=\"4\"", "", "#e6f2f7", "M.6 1.6L1.4 .8M1.1 1.9L1.9 1.1M2.8 3.5L3.6 2.7", ""},
    {Hatch::General, "width=\"2.8\" height=\"2.8\"", "rotate(-45)", "#f2f2f2", "M0 1.4H2.8", ""},
};

class SvgWriter {
public:
    SvgWriter(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume, double scale)
        : drawing_(drawing), volume_(volume), scale_(scale), millimetres_(1000 / scale) {
        hatches_ = illustrate::labelHatches(volume.labels);
        isSlim_.resize(volume.labels.labels.size());
        for (const SectionComponent& component : drawing.components)
            isSlim_[component.label] = isSlim(component) ? 1 : 0;
        low_ = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        high_ = {-low_.u, -low_.v};
        for (const SectionComponent& component : drawing.components)
            for (const auto& polygon : component.polygons)
                for (const PlanePoint p : polygon.outer) {
                    low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                    high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
                }
        for (const illustrate::SectionLine& line : drawing.lines)
            for (const PlanePoint p : line.points) {
                low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
            }
        for (const illustrate::BeyondLine& line : drawing.beyond)
            for (const PlanePoint p : {line.from, line.to}) {
                low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
            }
        if (drawing.components.empty() && drawing.lines.empty() && drawing.beyond.empty()) low_ = high_ = {};
        drawnWidth_ = (high_.u - low_.u) * millimetres_;
        drawnHeight_ = (high_.v - low_.v) * millimetres_;
        width_ = std::max(drawnWidth_, kMinWidth) + 2 * kMargin;
        left_ = 0.5 * (width_ - drawnWidth_);
        height_ = drawnHeight_ + 2 * kMargin + kTitleHeight;
    }

    std::string write() {
        begin();
        addComponents();
        addBeyond();
        addBorders();
        addLines();
        addNames();
        addTitle();
        svg_ += "</svg>\n";
        return std::move(svg_);
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const noexcept {
        return volume_.labels.labels[label];
    }
    [[nodiscard]] bool isSpace(std::uint32_t label) const noexcept {
        return label == kNoLabel || model::isSpace(labelOf(label).className);
    }
    // Cut load-bearing or enclosing parts have bold outlines. Fillings, furniture and parts only a line or two thick
    // have thin ones.
    [[nodiscard]] bool isBold(std::uint32_t label) const {
        if (isSpace(label) || hatches_[label] == Hatch::Glass || isSlim_[label] != 0) return false;
        return model::classRank(labelOf(label).className) >= model::ClassRank::Installation;
    }

    // Sheets are one voxel thick whatever they represent: towards rooms they take the line of the part behind them.
    [[nodiscard]] bool isSheet(std::uint32_t label) const noexcept {
        return label != kNoLabel && labelOf(label).filling == volume::Filling::Surface;
    }
    [[nodiscard]] bool isBoldBetween(std::uint32_t left, std::uint32_t right) const {
        if ((isSheet(left) && !isSpace(right)) || (isSheet(right) && !isSpace(left))) return false;
        return isBold(left) != isBold(right);
    }

    [[nodiscard]] bool isSlim(const SectionComponent& component) const {
        if (isSheet(component.label) || component.polygons.empty()) return false;
        double length = 0;
        const auto add = [&](const illustrate::Ring& ring) {
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
                length += std::hypot(b.u - a.u, b.v - a.v);
            }
        };
        for (const auto& polygon : component.polygons) {
            add(polygon.outer);
            for (const auto& hole : polygon.holes) add(hole);
        }
        return 2 * component.area / length * millimetres_ < kSlim;
    }

    [[nodiscard]] std::string pointText(PlanePoint p) const {
        return shortNumber(left_ + (p.u - low_.u) * millimetres_, 3) + " " +
               shortNumber(kMargin + (high_.v - p.v) * millimetres_, 3);
    }
    void addLine(const std::vector<PlanePoint>& points) {
        for (std::size_t n = 0; n < points.size(); ++n)
            svg_ += (n == 0 ? "M" : n == 1 ? "L" : " ") + pointText(points[n]);
    }

    void begin() {
        const std::string width = shortNumber(width_, 3), height = shortNumber(height_, 3);
        svg_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
        svg_ += fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
            width, height);
        svg_ += fmt::format("<title>{}, {}</title>\n", xmlAttribute(modelName()), planeText(drawing_, volume_.grid));
        svg_ +=
            "<style>\n"
            "text { font-family: 'Liberation Sans', Arial, Helvetica, sans-serif; fill: #000 }\n"
            ".thin, .bold { fill: none; stroke: #000; stroke-linecap: round; stroke-linejoin: round }\n"
            ".thin { stroke-width: 0.13 }\n"
            ".bold { stroke-width: 0.5 }\n"
            ".dashed { stroke-dasharray: 1.5 1 }\n"
            ".names { text-anchor: middle }\n";
        // Widths and lengths after ISO 128-2: narrow lines; dashes of 12 widths; long dashes of 24 with two dots.
        if (!drawing_.beyond.empty())
            svg_ +=
                ".beyond { fill: none; stroke: #000; stroke-width: 0.18; stroke-linecap: round }\n"
                ".hidden { stroke-linecap: butt; stroke-dasharray: 2.16 0.54 }\n"
                ".above { stroke-linecap: butt; stroke-dasharray: 4.32 0.54 0.18 0.54 0.18 0.54 }\n"
                ".names text { paint-order: stroke; stroke: #fff; stroke-width: 0.6; stroke-linejoin: round }\n";
        svg_ += "</style>\n<defs>\n";
        for (const HatchStyle& style : kHatches) {
            if (!isUsed(style.hatch)) continue;
            const std::string turn = *style.turn == '\0' ? "" : fmt::format(" patternTransform=\"{}\"", style.turn);
            svg_ += fmt::format(
                "<pattern id=\"{0}\" patternUnits=\"userSpaceOnUse\" {1}{2}><rect {1} fill=\"{3}\"/><path d=\"{4}\" "
                "fill=\"none\" stroke=\"#444\" stroke-width=\"0.13\"/>",
                render::hatchName(style.hatch), style.size, turn, style.tint, style.lines);
            if (*style.filled != '\0') svg_ += fmt::format("<path d=\"{}\" fill=\"#444\"/>", style.filled);
            svg_ += "</pattern>\n";
        }
        svg_ += fmt::format("</defs>\n<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
    }

    [[nodiscard]] bool isUsed(Hatch hatch) const {
        return std::ranges::any_of(drawing_.components,
                                   [&](const SectionComponent& c) { return hatches_[c.label] == hatch; });
    }

    [[nodiscard]] const std::string& modelName() const noexcept {
        return volume_.modelName.empty() ? volume_.source : volume_.modelName;
    }

    [[nodiscard]] std::string fillOf(std::uint32_t label) const {
        if (isSpace(label)) return "#fff";
        if (hatches_[label] == Hatch::None) return "#d9d9d9";
        return fmt::format("url(#{})", render::hatchName(hatches_[label]));
    }

    void addComponents() {
        for (const illustrate::ClassArea& group : drawing_.classes) {
            const std::string name = plainName(group.className);
            svg_ += fmt::format("<g class=\"{}\" data-class=\"{}\" data-area=\"{}\">\n", name,
                                xmlAttribute(group.className), shortNumber(group.area, 4));
            for (const SectionComponent& component : drawing_.components)
                if (labelOf(component.label).className == group.className) addComponent(component, name);
            svg_ += "</g>\n";
        }
    }

    void addComponent(const SectionComponent& component, const std::string& className) {
        const volume::Label& label = labelOf(component.label);
        if (component.polygons.empty()) return;
        svg_ += fmt::format(
            "<path class=\"{}\" data-id=\"{}\" data-area=\"{}\" data-area-bound=\"{}\" data-exact=\"{}\" fill=\"{}\" "
            "fill-rule=\"evenodd\" d=\"",
            className, xmlAttribute(label.id), shortNumber(component.area, 4), shortNumber(component.areaBound, 4),
            component.isExact ? "yes" : "no", fillOf(component.label));
        for (const auto& polygon : component.polygons) {
            addLine(polygon.outer);
            svg_ += "Z";
            for (const auto& hole : polygon.holes) {
                addLine(hole);
                svg_ += "Z";
            }
        }
        svg_ += fmt::format("\"><title>{}{}{}</title></path>\n", xmlAttribute(label.id), label.name.empty() ? "" : ": ",
                            xmlAttribute(label.name));
    }

    void addBorders() {
        for (const bool bold : {false, true}) {
            svg_ += fmt::format("<g class=\"{}\">\n", bold ? "bold" : "thin");
            for (const SectionBorder& border : drawing_.borders) {
                // Thin between two cut parts and around fillings and furniture; no line between two rooms.
                if (isSpace(border.left) && isSpace(border.right)) continue;
                if (bold != isBoldBetween(border.left, border.right)) continue;
                svg_ += "<path d=\"";
                const bool isClosed = border.points.front() == border.points.back();
                addLine(border.points);
                svg_ += isClosed ? "Z\"/>\n" : "\"/>\n";
            }
            svg_ += "</g>\n";
        }
    }

    // What stands behind the plane, and above it: one group per kind, one path per component.
    void addBeyond() {
        const std::vector<illustrate::BeyondLine>& lines = drawing_.beyond;
        for (std::size_t n = 0; n < lines.size();) {
            const illustrate::BeyondKind kind = lines[n].kind;
            svg_ += fmt::format("<g class=\"beyond {}\">\n", beyondName(kind));
            while (n < lines.size() && lines[n].kind == kind) {
                const std::uint32_t label = lines[n].label;
                svg_ += fmt::format("<path class=\"{}\" data-id=\"{}\" d=\"", plainName(labelOf(label).className),
                                    xmlAttribute(labelOf(label).id));
                for (; n < lines.size() && lines[n].kind == kind && lines[n].label == label; ++n)
                    addLine({lines[n].from, lines[n].to});
                svg_ += "\"/>\n";
            }
            svg_ += "</g>\n";
        }
    }

    // Objects without inside: as bold as what they stand for, once on top of all borders.
    void addLines() {
        if (drawing_.lines.empty()) return;
        svg_ += "<g class=\"lines\">\n";
        for (const illustrate::SectionLine& line : drawing_.lines) {
            const volume::Label& label = labelOf(line.label);
            const bool isVirtual = label.className == "ClosureSurface";
            svg_ +=
                fmt::format("<path class=\"{} {}\" data-id=\"{}\" data-length=\"{}\" d=\"",
                            isVirtual            ? "thin dashed"
                            : isBold(line.label) ? "bold"
                                                 : "thin",
                            plainName(label.className), xmlAttribute(label.id), shortNumber(lengthOf(line.points), 4));
            addLine(line.points);
            svg_ += "\"/>\n";
        }
        svg_ += "</g>\n";
    }

    static double lengthOf(const std::vector<PlanePoint>& points) {
        double length = 0;
        for (std::size_t n = 0; n + 1 < points.size(); ++n)
            length += std::hypot(points[n + 1].u - points[n].u, points[n + 1].v - points[n].v);
        return length;
    }

    void addNames() {
        svg_ += "<g class=\"names\">\n";
        for (const SectionComponent& component : drawing_.components) {
            if (!isSpace(component.label) || component.polygons.empty()) continue;
            const auto& largest = *std::ranges::max_element(component.polygons, {}, &illustrate::SectionPolygon::area);
            const std::string& name = shownName(labelOf(component.label));
            const std::string area =
                isPlan(drawing_, volume_.grid) ? fmt::format("{:.2f} m\u00B2", component.area) : std::string();
            const illustrate::TextPlace place = illustrate::findTextPlace(largest);
            const auto longest = static_cast<double>(std::max(characterCount(name), characterCount(area)));
            const double lines = area.empty() ? 1 : 2.3;
            const double size = std::min({kTextSize, 0.9 * place.width * millimetres_ / (kTextWidth * longest),
                                          0.8 * place.height * millimetres_ / lines});
            if (!(size >= kLeastTextSize)) continue;
            const double x = left_ + (place.center.u - low_.u) * millimetres_;
            const double y = kMargin + (high_.v - place.center.v) * millimetres_;
            addText(x, y + size * (area.empty() ? 0.35 : -0.25), size, name);
            if (!area.empty()) addText(x, y + size * 1.05, size, area);
        }
        svg_ += "</g>\n";
    }

    void addText(double x, double y, double size, std::string_view text, const char* extra = "") {
        svg_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}>{}</text>\n", shortNumber(x, 3),
                            shortNumber(y, 3), shortNumber(size, 2), extra, xmlAttribute(text));
    }

    void addTitle() {
        const double top = height_ - kTitleHeight - 2, right = width_ - kMargin;
        svg_ += fmt::format("<g class=\"title\">\n<path class=\"thin\" d=\"M{} {}H{}\"/>\n", shortNumber(kMargin, 3),
                            shortNumber(top, 3), shortNumber(right, 3));
        addText(kMargin, top + 6, 3.5, modelName(), " font-weight=\"bold\"");
        addText(kMargin, top + 11, 2.5,
                fmt::format("{}, 1:{}", planeText(drawing_, volume_.grid), shortNumber(scale_, 2)));
        // Four fields of a rounded length, 5 to 12.5 mm each.
        const double field = roundDownTo125(12.5 / millimetres_), size = field * millimetres_;
        const double y = top + 17;
        for (int n = 0; n < 4; ++n)
            svg_ += fmt::format(
                "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"1.2\" fill=\"{}\" stroke=\"#000\" "
                "stroke-width=\"0.13\"/>\n",
                shortNumber(kMargin + n * size, 3), shortNumber(y, 3), shortNumber(size, 3),
                n % 2 == 0 ? "#000" : "#fff");
        for (int n = 0; n <= 4; n += n == 0 ? 1 : n == 1 ? 1 : 2)
            addText(kMargin + n * size, y - 0.8, 1.8, shortNumber(n * field, 3) + (n == 4 ? " m" : ""),
                    n == 0 ? "" : " text-anchor=\"middle\"");
        svg_ += "</g>\n";
    }

    const illustrate::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    double scale_, millimetres_;        // millimetres on paper per metre
    std::vector<Hatch> hatches_;        // by label
    std::vector<std::uint8_t> isSlim_;  // by label
    PlanePoint low_, high_;
    double drawnWidth_ = 0, drawnHeight_ = 0, width_ = 0, height_ = 0, left_ = 0;
    std::string svg_;
};

}  // namespace

Result<std::string> makeSvg(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                            const SvgOptions& options) {
    if (!(options.scale >= 0.01 && options.scale <= 1e7))
        return Error(Code::BadArgument,
                     fmt::format("a scale of 1:{} is out of range; 1:0.01 to 1:10000000 are possible", options.scale));
    return SvgWriter(drawing, volume, options.scale).write();
}

Result<std::uint64_t> writeSvg(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                               const std::filesystem::path& path, const SvgOptions& options) {
    const auto text = makeSvg(drawing, volume, options);
    if (!text) return text.error();
    return writeFileAtomically(path, *text);
}

}  // namespace svt::writers
