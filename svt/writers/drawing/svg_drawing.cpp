#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_page.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/drawing/name_place.hpp>
#include <svt/writers/field/field_marks.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/revisions/revision_clouds.hpp>
#include <svt/writers/revisions/revision_list.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/svg_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using drawing::SectionBorder;
using drawing::SectionComponent;
using render::Hatch;

// Millimetres on paper.
constexpr double kMargin = DrawingPage::kMargin;
constexpr double kTextWidth = 0.56;  // width of a character relative to the font size, sans serif

class SvgWriter {
public:
    SvgWriter(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, const DrawingPage& page,
              const FieldLook& look)
        : drawing_(drawing), volume_(volume), style_(drawing, volume, page.millimetres), page_(page), look_(look) {}

    std::string write() {
        begin();
        addComponents();
        if (look_.isShown()) addBands();
        addBeyond();
        addBorders();
        addLines();
        addDoors();
        if (look_.isShown()) addIsolines();
        if (look_.isShown()) addArrows();
        addNames();
        addDimensions();
        if (hasRevisions(drawing_)) addRevisions();
        if (look_.isShown()) addLegend();
        addTitle();
        svg_ += "</svg>\n";
        return std::move(svg_);
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const noexcept {
        return volume_.labels.labels[label];
    }

    [[nodiscard]] std::pair<double, double> onPaper(PlanePoint p) const noexcept {
        return {page_.left + (p.u - page_.low.u) * page_.millimetres,
                page_.top + (page_.high.v - p.v) * page_.millimetres};
    }
    [[nodiscard]] std::string pointText(PlanePoint p) const {
        const auto [x, y] = onPaper(p);
        return shortNumber(x, 3) + " " + shortNumber(y, 3);
    }
    void addLine(const std::vector<PlanePoint>& points) {
        for (std::size_t n = 0; n < points.size(); ++n)
            svg_ += (n == 0 ? "M" : n == 1 ? "L" : " ") + pointText(points[n]);
    }

    // A group that Inkscape knows as a layer.
    [[nodiscard]] std::string layer(std::string_view classes, std::string_view label, std::string_view further = "") {
        return fmt::format("<g id=\"layer-{}\" class=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\"{}>\n",
                           ++layers_, classes, xmlAttribute(label), further);
    }

    void begin() {
        const std::string width = shortNumber(page_.width, 3), height = shortNumber(page_.height, 3);
        svg_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
        svg_ += fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
            "xmlns:svt=\"urn:svt:drawing\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
            width, height);
        svg_ += fmt::format("<title>{}, {}</title>\n", xmlAttribute(shownName(volume_)), planeText(drawing_, volume_));
        addMetadata();
        svg_ +=
            "<style>\n"
            "text { font-family: 'Liberation Sans', Arial, Helvetica, sans-serif; fill: #000 }\n"
            ".thin, .bold { fill: none; stroke: #000; stroke-linecap: round; stroke-linejoin: round }\n"
            ".thin { stroke-width: 0.13 }\n"
            ".bold { stroke-width: 0.5 }\n"
            ".dashed { stroke-dasharray: 1.5 1 }\n"
            ".swing { fill: none; stroke: #000; stroke-width: 0.25; stroke-linecap: round; stroke-linejoin: round }\n"
            ".names { text-anchor: middle }\n"
            ".names text, .dimensions text { paint-order: stroke; stroke: #fff; stroke-width: 0.6; stroke-linejoin: "
            "round }\n";
        // Widths and lengths after ISO 128-2: narrow lines; dashes of 12 widths; long dashes of 24 with two dots.
        if (!drawing_.beyond.empty())
            svg_ +=
                ".beyond { fill: none; stroke: #000; stroke-width: 0.18; stroke-linecap: round }\n"
                ".hidden { stroke-linecap: butt; stroke-dasharray: 2.16 0.54 }\n"
                ".above { stroke-linecap: butt; stroke-dasharray: 4.32 0.54 0.18 0.54 0.18 0.54 }\n";
        if (look_.isShown())
            svg_ +=
                ".isoline { fill: none; stroke: #000; stroke-width: 0.18; stroke-linecap: round; "
                "stroke-linejoin: "
                "round }\n"
                ".values { text-anchor: middle }\n"
                ".values text { paint-order: stroke; stroke: #fff; stroke-width: 0.5; stroke-linejoin: round }\n";
        if (look_.isShown() && !look_.field->arrows.empty())
            svg_ += ".arrow { fill: none; stroke: #000; stroke-width: 0.18; stroke-linecap: round }\n";
        if (hasDimensions(drawing_))
            svg_ +=
                ".dimensions { text-anchor: middle }\n"
                ".tick { fill: none; stroke: #000; stroke-width: 0.35; stroke-linecap: round }\n";
        if (hasRevisions(drawing_))
            svg_ +=
                ".removed { fill: none; stroke: #000; stroke-width: 0.18; stroke-dasharray: 2.16 0.54 }\n"
                ".revision { fill: none; stroke: #000; stroke-width: 0.25; stroke-linejoin: round }\n"
                ".tag { fill: #fff }\n"
                ".numbers { text-anchor: middle }\n";
        svg_ += "</style>\n<defs>\n";
        for (const HatchTile& tile : hatchTiles())
            if (isUsed(tile.hatch)) svg_ += svgPattern(tile, tile.turnDegrees != 0);
        svg_ += fmt::format("</defs>\n<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
    }

    // Where the drawing lies in the world: world = origin + u * metres to the right + v * metres up.
    void addMetadata() {
        const drawing::PlaneAxes& axes = drawing_.axes;
        const PlanePoint corner{page_.low.u - page_.left / page_.millimetres,
                                page_.high.v + page_.top / page_.millimetres};
        svg_ += fmt::format(
            "<metadata><svt:drawing scale=\"{}\" crs=\"{}\" origin=\"{}\" u=\"{}\" v=\"{}\" normal=\"{}\" "
            "corner=\"{} {}\"{}/></metadata>\n",
            shortNumber(page_.scale, 6), xmlAttribute(volume_.crsName), vectorText(axes.origin, 6),
            vectorText(axes.u, 15), vectorText(axes.v, 15), vectorText(axes.normal, 15), shortNumber(corner.u, 6),
            shortNumber(corner.v, 6),
            isPlan(drawing_, volume_.grid) ? fmt::format(" height=\"{}\"", shortNumber(drawing_.plane.point.z, 6))
                                           : std::string());
    }

    [[nodiscard]] bool isUsed(Hatch hatch) const {
        return std::ranges::any_of(drawing_.components,
                                   [&](const SectionComponent& c) { return style_.hatchOf(c.label) == hatch; });
    }

    [[nodiscard]] std::string fillOf(std::uint32_t label) const {
        if (style_.isSpace(label)) return "#fff";
        if (style_.hatchOf(label) == Hatch::None) return "#d9d9d9";
        return fmt::format("url(#{})", nameOf(style_.hatchOf(label)));
    }

    void addComponents() {
        for (const drawing::ClassArea& group : drawing_.classes) {
            const std::string name = plainName(group.className);
            svg_ += layer(name, group.className,
                          fmt::format(" data-class=\"{}\" data-area=\"{}\"", xmlAttribute(group.className),
                                      shortNumber(group.area, 4)));
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
        addPolygons(component.polygons);
        svg_ += fmt::format("\"><title>{}{}{}</title></path>\n", xmlAttribute(label.id), label.name.empty() ? "" : ": ",
                            xmlAttribute(label.name));
    }

    void addPolygons(const std::vector<drawing::SectionPolygon>& polygons) {
        for (const auto& polygon : polygons) {
            addLine(polygon.outer);
            svg_ += "Z";
            for (const auto& hole : polygon.holes) {
                addLine(hole);
                svg_ += "Z";
            }
        }
    }

    // The bands of a field, and the parts of its medium without a value: one path each.
    void addBands() {
        const drawing::FieldDrawing& field = *look_.field;
        svg_ += layer("field", "Field",
                      fmt::format(" data-field=\"{}\" data-unit=\"{}\" data-seconds=\"{}\"", xmlAttribute(field.name),
                                  xmlAttribute(field.unit), shortNumber(field.seconds, 6)));
        if (!field.missing.empty()) {
            svg_ += fmt::format("<path class=\"no-value\" fill=\"{}\" fill-rule=\"evenodd\" d=\"", noValueColor());
            addPolygons(field.missing);
            svg_ += "\"/>\n";
        }
        for (const drawing::FieldBand& band : field.bands) {
            svg_ += fmt::format(
                "<path class=\"band\" data-low=\"{:.9g}\" data-high=\"{:.9g}\" fill=\"{}\" "
                "fill-rule=\"evenodd\" d=\"",
                band.low, band.high, bandColor(look_, band));
            addPolygons(band.polygons);
            svg_ += "\"/>\n";
        }
        svg_ += "</g>\n";
    }

    // The lines of a field: a path per line, then the values on them.
    void addIsolines() {
        if (look_.field->isolines.empty()) return;
        svg_ += layer("isolines", "Isolines");
        for (const drawing::FieldIsoline& line : look_.field->isolines) {
            svg_ += fmt::format("<path class=\"isoline\" data-value=\"{:.9g}\" d=\"", line.value);
            addLine(line.points);
            svg_ += line.points.front() == line.points.back() ? "Z\"/>\n" : "\"/>\n";
        }
        svg_ += "</g>\n" + layer("values", "Values");
        for (const FieldLabel& label : placeFieldLabels(*look_.field, page_.millimetres)) {
            const auto [x, y] = onPaper(label.at);
            const std::string turn = fmt::format(" transform=\"rotate({} {} {})\"", shortNumber(-label.degrees, 2),
                                                 shortNumber(x, 3), shortNumber(y, 3));
            addText(x, y + 0.35 * label.size, label.size, label.text, turn.c_str());
        }
        svg_ += "</g>\n";
    }

    // The arrows of a field: a path each.
    void addArrows() {
        if (look_.field->arrows.empty()) return;
        svg_ += layer("arrows", "Arrows");
        for (const drawing::FieldArrow& arrow : look_.field->arrows) {
            svg_ += fmt::format("<path class=\"arrow\" data-value=\"{:.6g}\" d=\"", arrow.value);
            addLine({arrow.from, arrow.to});
            addLine(arrowHead(arrow));
            svg_ += "\"/>\n";
        }
        svg_ += "</g>\n";
    }

    void addLegend() {
        svg_ += layer("legend", "Legend");
        const FieldLegend legend = makeFieldLegend(look_, kMargin, page_.legendTop(), page_.width - 2 * kMargin);
        for (const FieldLegend::Box& box : legend.boxes)
            svg_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"{}/>\n",
                                shortNumber(box.x, 3), shortNumber(box.y, 3), shortNumber(box.width, 3),
                                shortNumber(box.height, 3), box.color,
                                box.hasOutline ? " stroke=\"#000\" stroke-width=\"0.13\"" : "");
        for (const FieldLegend::Text& text : legend.texts)
            addText(text.x, text.y, text.size, text.text, text.isCentred ? " text-anchor=\"middle\"" : "");
        svg_ += "</g>\n";
    }

    void addBorders() {
        for (const bool bold : {false, true}) {
            svg_ += layer(bold ? "bold" : "thin", bold ? "Outlines" : "Thin outlines");
            for (const SectionBorder& border : drawing_.borders) {
                // Thin between two cut parts and around fillings and furniture; no line between two rooms.
                if (style_.isSpace(border.left) && style_.isSpace(border.right)) continue;
                if (bold != style_.isBoldBetween(border.left, border.right)) continue;
                svg_ += "<path d=\"";
                const bool isClosed = border.points.front() == border.points.back();
                addLine(border.points);
                svg_ += isClosed ? "Z\"/>\n" : "\"/>\n";
            }
            svg_ += "</g>\n";
        }
    }

    // Adds lines behind the plane, and above it: one group per kind, one path per component.
    void addBeyond() {
        const std::vector<drawing::BeyondLine>& lines = drawing_.beyond;
        for (std::size_t n = 0; n < lines.size();) {
            const drawing::BeyondKind kind = lines[n].kind;
            svg_ += layer(fmt::format("beyond {}", beyondName(kind)), fmt::format("Beyond: {}", beyondName(kind)));
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

    // Objects without an interior: as bold as the parts that they represent, once, on top of all borders.
    void addLines() {
        if (drawing_.lines.empty()) return;
        svg_ += layer("lines", "Lines");
        for (const drawing::SectionLine& line : drawing_.lines) {
            const volume::Label& label = labelOf(line.label);
            const bool isVirtual = label.className == "ClosureSurface";
            svg_ +=
                fmt::format("<path class=\"{} {}\" data-id=\"{}\" data-length=\"{}\" d=\"",
                            isVirtual                   ? "thin dashed"
                            : style_.isBold(line.label) ? "bold"
                                                        : "thin",
                            plainName(label.className), xmlAttribute(label.id), shortNumber(lengthOf(line.points), 4));
            addLine(line.points);
            svg_ += "\"/>\n";
        }
        svg_ += "</g>\n";
    }

    // How doors open: a group each, with the open leaves and the arcs that they swing through.
    void addDoors() {
        if (drawing_.doors.empty()) return;
        svg_ += layer("doors", "Doors");
        for (const drawing::DoorSwing& door : drawing_.doors) {
            svg_ += fmt::format("<path class=\"swing\" data-id=\"{}\" d=\"", xmlAttribute(labelOf(door.label).id));
            for (const auto& line : door.lines) addLine(line);
            svg_ += "\"/>\n";
            if (door.arcs.empty()) continue;
            svg_ += fmt::format("<path class=\"thin\" data-id=\"{}\" d=\"", xmlAttribute(labelOf(door.label).id));
            for (const drawing::DoorSwing::Arc& arc : door.arcs) {
                const double radius =
                    page_.millimetres * std::hypot(arc.from.u - arc.center.u, arc.from.v - arc.center.v);
                svg_ += fmt::format("M{}A{} {} 0 0 0 {}", pointText(arc.from), shortNumber(radius, 3),
                                    shortNumber(radius, 3), pointText(arc.to));
            }
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
        svg_ += layer("names", "Names");
        for (const SectionComponent& component : drawing_.components) {
            if (!style_.isSpace(component.label) || component.isZone || component.polygons.empty()) continue;
            const std::string& name = shownName(labelOf(component.label));
            const std::string area =
                isPlan(drawing_, volume_.grid) ? fmt::format("{:.2f} m\u00B2", component.stampArea()) : std::string();
            const auto longest = static_cast<double>(std::max(characterCount(name), characterCount(area)));
            const auto place =
                placeName(component, drawing_, page_.millimetres, kTextWidth * longest, area.empty() ? 1 : 2.3);
            if (!place) continue;
            const double size = place->size;
            const auto [x, y] = onPaper(place->center);
            addText(x, y + size * (area.empty() ? 0.35 : -0.25), size, name);
            if (!area.empty()) addText(x, y + size * 1.05, size, area);
        }
        svg_ += "</g>\n";
    }

    // Chains of dimensions: a group each, with its lines, ticks and numbers.
    void addDimensions() {
        if (!hasDimensions(drawing_)) return;
        const DimensionMarks placed = placeDimensions(drawing_, {page_.low, page_.high}, page_.millimetres);
        const auto at = [&](PlanePoint p) {
            return std::pair(page_.left + p.u - page_.low.u * page_.millimetres,
                             page_.top + page_.high.v * page_.millimetres - p.v);
        };
        const auto lineText = [&](const MarkLine& line) {
            const auto [x0, y0] = at(line.from);
            const auto [x1, y1] = at(line.to);
            return fmt::format("M{} {}L{} {}", shortNumber(x0, 3), shortNumber(y0, 3), shortNumber(x1, 3),
                               shortNumber(y1, 3));
        };
        svg_ += layer("dimensions", "Dimensions");
        for (const DimensionMark& mark : placed.marks) {
            svg_ += fmt::format("<path class=\"thin\" data-length=\"{}\" d=\"{}", shortNumber(mark.metres, 4),
                                lineText(mark.line));
            for (const MarkLine& foot : mark.feet) svg_ += lineText(foot);
            svg_ += "\"/>\n<path class=\"tick\" d=\"";
            for (const MarkLine& tick : mark.ticks) svg_ += lineText(tick);
            svg_ += "\"/>\n";
            addMarkText(mark.text, at(mark.text.at));
        }
        for (const MarkText& text : placed.heights) addMarkText(text, at(text.at));
        svg_ += "</g>\n";
    }

    [[nodiscard]] std::string markText(PlanePoint p) const {
        return shortNumber(page_.left + p.u - page_.low.u * page_.millimetres, 3) + " " +
               shortNumber(page_.top + page_.high.v * page_.millimetres - p.v, 3);
    }

    // Lines of removed parts, clouds with the numbers of their revisions, and the list.
    void addRevisions() {
        const RevisionMarks marks = placeRevisions(drawing_, page_.millimetres);
        svg_ += layer("removed", "Removed") + "<path d=\"";
        for (const drawing::RevisionLines::Line& line : marks.removed)
            svg_ += "M" + markText(line.from) + "L" + markText(line.to);
        svg_ += "\"/>\n</g>\n" + layer("revisions", "Revisions");
        for (const RevisionMarks::Cloud& cloud : marks.clouds) {
            svg_ += fmt::format("<path class=\"revision\" data-revisions=\"{}\" d=\"", fmt::join(cloud.numbers, " "));
            const RevisionMarks::Path path = cloudPath(cloud);
            for (std::size_t n = 0; n < path.size(); ++n)
                svg_ += (n == 0 ? "M" : n == 1 ? "L" : " ") + markText(path[n]);
            svg_ += "Z\"/>\n";
        }
        for (const RevisionMarks::Tag& tag : marks.tags)
            svg_ += fmt::format("<path class=\"revision tag\" d=\"M{}L{} {}Z\"/>\n", markText(tag.corners[0]),
                                markText(tag.corners[1]), markText(tag.corners[2]));
        svg_ += "<g class=\"numbers\">\n";
        for (const RevisionMarks::Tag& tag : marks.tags)
            addText(page_.left + tag.at.u - page_.low.u * page_.millimetres,
                    page_.top + page_.high.v * page_.millimetres - tag.at.v, tag.size, tag.text);
        svg_ += "</g>\n</g>\n" + layer("revision-table", "Revision table");
        const RevisionList list = makeRevisionList(revisionsOf(drawing_), kMargin, page_.revisionsTop(),
                                                   page_.width - 2 * kMargin, DrawingPage::kMostRevisions);
        for (const RevisionList::Rule& rule : list.rules)
            svg_ += fmt::format("<path class=\"thin\" d=\"M{} {}H{}\"/>\n", shortNumber(rule.left, 3),
                                shortNumber(rule.y, 3), shortNumber(rule.right, 3));
        for (const RevisionList::Text& text : list.texts)
            addText(text.x, text.y, RevisionList::kText, text.text, text.isEnd ? " text-anchor=\"end\"" : "");
        svg_ += "</g>\n";
    }

    void addMarkText(const MarkText& text, std::pair<double, double> place) {
        const auto& [x, y] = place;
        const std::string turn =
            text.isUpright ? fmt::format(" transform=\"rotate(-90 {} {})\"", shortNumber(x, 3), shortNumber(y, 3)) : "";
        addText(x, y, text.size, text.text, turn.c_str());
    }

    void addText(double x, double y, double size, std::string_view text, const char* extra = "") {
        svg_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}>{}</text>\n", shortNumber(x, 3),
                            shortNumber(y, 3), shortNumber(size, 2), extra, xmlAttribute(text));
    }

    void addTitle() {
        const double top = page_.titleTop(), right = page_.width - kMargin;
        svg_ +=
            layer("title", "Title") + fmt::format("<path class=\"thin\" d=\"M{} {}H{}\"/>\n", shortNumber(kMargin, 3),
                                                  shortNumber(top, 3), shortNumber(right, 3));
        addText(kMargin, top + 6, 3.5, shownName(volume_), " font-weight=\"bold\"");
        addText(kMargin, top + 11, 2.5,
                fmt::format("{}, 1:{}", planeText(drawing_, volume_), shortNumber(page_.scale, 2)));
        const double field = page_.field, size = field * page_.millimetres;
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

    const drawing::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    DrawingStyle style_;
    const DrawingPage& page_;
    const FieldLook& look_;
    int layers_ = 0;
    std::string svg_;
};

}  // namespace

Result<std::string> makeSvg(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                            const SvgOptions& options) {
    SVT_TRY(page, makeDrawingPage(drawing, options.scale));
    if (options.field.isShown()) addField(*options.field.field, *page);
    return SvgWriter(drawing, volume, *page, options.field).write();
}

}  // namespace svt::writers
