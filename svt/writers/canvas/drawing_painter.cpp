#include <svt/writers/canvas/drawing_painter.hpp>

#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/drawing/name_place.hpp>
#include <svt/writers/field/field_marks.hpp>
#include <svt/writers/revisions/revision_clouds.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using render::Hatch;

constexpr double kTick = 0.35;  // millimetres

class DrawingPainter {
public:
    DrawingPainter(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                   const DrawingPlace& place, SheetCanvas& canvas, const PaintOptions& options)
        : drawing_(drawing),
          volume_(volume),
          place_(place),
          canvas_(canvas),
          options_(options),
          widths_(options.widths),
          style_(drawing, volume, place.millimetres) {}

    void paint() {
        inLayer("Cut", [&] { addComponents(); });
        if (options_.field.isShown()) inLayer("Field", [&] { addBands(); });
        for (const auto kind : {drawing::BeyondKind::Visible, drawing::BeyondKind::Hidden, drawing::BeyondKind::Above})
            addBeyond(kind);
        inLayer("Outlines", [&] { addBorders(); });
        if (!drawing_.doors.empty()) inLayer("Doors", [&] { addDoors(); });
        if (options_.field.isShown()) inLayer("Isolines", [&] { addIsolines(); });
        if (options_.field.isShown()) inLayer("Arrows", [&] { addArrows(); });
        if (options_.marks == nullptr)
            inLayer("Names", [&] { addNames(); });
        else
            for (const MarkShapes& marks : *options_.marks) inLayer(marks.layer, [&] { addMarks(marks); });
        if (hasDimensions(drawing_)) inLayer("Dimensions", [&] { addDimensions(); });
        if (hasRevisions(drawing_)) addRevisions();
    }

private:
    template <typename Body>
    void inLayer(std::string_view name, const Body& body) {
        canvas_.beginLayer(name);
        body();
        canvas_.endLayer();
    }

    [[nodiscard]] PaperPath pathOf(const std::vector<PlanePoint>& points, bool isRing) const {
        PaperPath path;
        for (const PlanePoint p : points) path.push_back(place_.onPaper(p));
        if (isRing) path.push_back(path.front());
        return path;
    }

    void addComponents() {
        for (const drawing::SectionComponent& component : drawing_.components) {
            if (component.polygons.empty()) continue;
            std::vector<PaperPath> rings;
            for (const auto& polygon : component.polygons) {
                rings.push_back(pathOf(polygon.outer, true));
                for (const auto& hole : polygon.holes) rings.push_back(pathOf(hole, true));
            }
            const Hatch hatch = style_.hatchOf(component.label);
            const auto tiles = hatchTiles();
            const auto tile =
                std::find_if(tiles.begin(), tiles.end(), [&](const HatchTile& t) { return t.hatch == hatch; });
            if (style_.isSpace(component.label)) continue;
            if (tile != tiles.end())
                canvas_.hatch(rings, *tile);
            else
                canvas_.fill(rings, "#d9d9d9");
        }
    }

    [[nodiscard]] std::vector<PaperPath> pathsOf(const std::vector<drawing::SectionPolygon>& polygons) const {
        std::vector<PaperPath> paths;
        for (const drawing::SectionPolygon& polygon : polygons) {
            paths.push_back(pathOf(polygon.outer, true));
            for (const drawing::Ring& hole : polygon.holes) paths.push_back(pathOf(hole, true));
        }
        return paths;
    }

    void addBands() {
        const drawing::FieldDrawing& field = *options_.field.field;
        if (!field.missing.empty()) canvas_.fill(pathsOf(field.missing), noValueColor());
        for (const drawing::FieldBand& band : field.bands)
            canvas_.fill(pathsOf(band.polygons), bandColor(options_.field, band));
    }

    // Values are upright: letters of a canvas turn by 90 degrees only.
    void addIsolines() {
        const drawing::FieldDrawing& field = *options_.field.field;
        std::vector<PaperPath> paths;
        for (const drawing::FieldIsoline& line : field.isolines) paths.push_back(pathOf(line.points, false));
        if (!paths.empty()) canvas_.stroke(paths, {widths_.beyond});
        for (const FieldLabel& label : placeFieldLabels(field, place_.millimetres)) {
            PaperPoint at = place_.onPaper(label.at);
            at.y += 0.35 * label.size;
            canvas_.text({at, label.size, label.text, TextAnchor::Middle, true});
        }
    }

    void addArrows() {
        std::vector<PaperPath> paths;
        for (const drawing::FieldArrow& arrow : options_.field.field->arrows) {
            paths.push_back({place_.onPaper(arrow.from), place_.onPaper(arrow.to)});
            paths.push_back(pathOf(arrowHead(arrow), false));
        }
        if (!paths.empty()) canvas_.stroke(paths, {widths_.beyond});
    }

    void addBeyond(drawing::BeyondKind kind) {
        std::vector<PaperPath> paths;
        for (const drawing::BeyondLine& line : drawing_.beyond)
            if (line.kind == kind) paths.push_back({place_.onPaper(line.from), place_.onPaper(line.to)});
        if (paths.empty()) return;
        const LineType type = kind == drawing::BeyondKind::Visible  ? LineType::Continuous
                              : kind == drawing::BeyondKind::Hidden ? LineType::Dashed
                                                                    : LineType::LongDashDoubleDots;
        inLayer(fmt::format("Beyond: {}", beyondName(kind)), [&] { canvas_.stroke(paths, {widths_.beyond, type}); });
    }

    void addBorders() {
        for (const bool bold : {false, true}) {
            std::vector<PaperPath> paths;
            for (const drawing::SectionBorder& border : drawing_.borders) {
                if (style_.isSpace(border.left) && style_.isSpace(border.right)) continue;
                if (bold == style_.isBoldBetween(border.left, border.right))
                    paths.push_back(pathOf(border.points, false));
            }
            canvas_.stroke(paths, {bold ? widths_.bold : widths_.thin});
        }
        std::vector<PaperPath> bold, thin, dashed;
        for (const drawing::SectionLine& line : drawing_.lines) {
            const bool isVirtual = volume_.labels.labels[line.label].className == "ClosureSurface";
            (isVirtual ? dashed : style_.isBold(line.label) ? bold : thin).push_back(pathOf(line.points, false));
        }
        canvas_.stroke(dashed, {widths_.thin, LineType::Dashed});
        canvas_.stroke(thin, {widths_.thin});
        canvas_.stroke(bold, {widths_.bold});
    }

    void addDoors() {
        std::vector<PaperPath> leaves, arcs;
        for (const drawing::DoorSwing& door : drawing_.doors) {
            for (const auto& line : door.lines) leaves.push_back(pathOf(line, false));
            for (const auto& arc : door.arcs) arcs.push_back(pathOf(drawing::pointsOf(arc), false));
        }
        canvas_.stroke(leaves, {widths_.leaf});
        canvas_.stroke(arcs, {widths_.thin});
    }

    void addNames() {
        for (const drawing::SectionComponent& component : drawing_.components) {
            if (!style_.isSpace(component.label) || component.isZone || component.polygons.empty()) continue;
            const std::string name = shortened(shownName(volume_.labels.labels[component.label]), 2.5, 40);
            std::vector<std::string> lines{name};
            if (isPlan(drawing_, volume_.grid)) lines.push_back(fmt::format("{:.2f} m\u00B2", component.stampArea()));
            const auto note = options_.notes.find(component.label);
            if (note != options_.notes.end()) lines.push_back(note->second);
            if (addStamp(component, lines) || note == options_.notes.end()) continue;
            lines.pop_back();
            addStamp(component, lines);
        }
    }

    // Lines of text within a room; false if they do not fit.
    bool addStamp(const drawing::SectionComponent& component, const std::vector<std::string>& lines) {
        constexpr double kLine = 1.3;  // font sizes from one baseline to the next
        double width = 0;              // at size 1
        for (const std::string& line : lines) width = std::max(width, widthOnPaper(line, 1));
        const double more = kLine * static_cast<double>(lines.size() - 1);
        const auto at = placeName(component, drawing_, place_.millimetres, width, 1 + more);
        if (!at) return false;
        const PaperPoint p = place_.onPaper(at->center);
        double y = p.y + at->size * (lines.size() == 1 ? 0.35 : 0.4 - 0.5 * more);
        for (const std::string& line : lines) {
            canvas_.text({{p.x, y}, at->size, line, TextAnchor::Middle, true});
            y += at->size * kLine;
        }
        return true;
    }

    // From millimetres on paper from the drawing's zero.
    [[nodiscard]] PaperPoint ofMark(PlanePoint p) const {
        return place_.onPaper({p.u / place_.millimetres, p.v / place_.millimetres});
    }

    void addMarks(const MarkShapes& marks) {
        const auto pathsOf = [&](const std::vector<MarkPath>& from) {
            std::vector<PaperPath> paths;
            for (const MarkPath& path : from) {
                paths.emplace_back();
                for (const PlanePoint p : path) paths.back().push_back(ofMark(p));
            }
            return paths;
        };
        // One by one: the masks of two marks may overlap.
        for (const PaperPath& mask : pathsOf(marks.masks)) canvas_.fill({mask}, "#ffffff");
        for (const PaperPath& path : pathsOf(marks.filled)) canvas_.fill({path}, "#000000");
        if (!marks.thin.empty()) canvas_.stroke(pathsOf(marks.thin), {widths_.thin});
        if (!marks.axes.empty()) canvas_.stroke(pathsOf(marks.axes), {widths_.thin, LineType::LongDashDotted});
        if (!marks.medium.empty()) canvas_.stroke(pathsOf(marks.medium), {widths_.leaf});
        if (!marks.bold.empty()) canvas_.stroke(pathsOf(marks.bold), {widths_.bold});
        for (const MarkText& text : marks.texts)
            canvas_.text({ofMark(text.at), text.size, text.text, TextAnchor::Middle, false, text.isUpright});
    }

    void addDimensions() {
        const DimensionMarks placed =
            placeDimensions(drawing_, drawnBox(drawing_), place_.millimetres, options_.openings);
        const auto at = [&](PlanePoint p) { return ofMark(p); };
        std::vector<PaperPath> thin, ticks;
        for (const DimensionMark& mark : placed.marks) {
            thin.push_back({at(mark.line.from), at(mark.line.to)});
            for (const MarkLine& foot : mark.feet) thin.push_back({at(foot.from), at(foot.to)});
            for (const MarkLine& tick : mark.ticks) ticks.push_back({at(tick.from), at(tick.to)});
        }
        canvas_.stroke(thin, {widths_.thin});
        canvas_.stroke(ticks, {kTick});
        // Numbers of rooms and openings stand over the lines of the drawing.
        const auto write = [&](const MarkText& text, bool hasHalo) {
            canvas_.text({at(text.at), text.size, text.text, TextAnchor::Middle, hasHalo, text.isUpright});
        };
        for (const DimensionMark& mark : placed.marks) write(mark.text, mark.feet.empty());
        for (const MarkText& text : placed.heights) write(text, true);
    }

    // Texts of other marks, which the numbers of revisions keep clear.
    [[nodiscard]] std::vector<RevisionObstacle> takenPlaces() const {
        std::vector<RevisionObstacle> taken;
        const auto add = [&](const MarkText& text) {
            constexpr double kRing = 1.5;  // millimetres: the circle or hexagon around a mark
            const double width = widthOnPaper(text.text, text.size);
            const double u = text.isUpright ? text.size : 0.5 * width, v = text.isUpright ? 0.5 * width : 0;
            taken.push_back(
                {{text.at.u - u - kRing, text.at.v - v - kRing},
                 {text.at.u + (text.isUpright ? 0 : u) + kRing, text.at.v + (text.isUpright ? v : text.size) + kRing}});
        };
        if (options_.marks != nullptr)
            for (const MarkShapes& shapes : *options_.marks)
                for (const MarkText& text : shapes.texts) add(text);
        if (!hasDimensions(drawing_)) return taken;
        const DimensionMarks placed =
            placeDimensions(drawing_, drawnBox(drawing_), place_.millimetres, options_.openings);
        for (const DimensionMark& mark : placed.marks) add(mark.text);
        for (const MarkText& text : placed.heights) add(text);
        return taken;
    }

    // Over everything else.
    void addRevisions() {
        const RevisionMarks marks = placeRevisions(drawing_, place_.millimetres, takenPlaces());
        const auto onPaper = [&](const RevisionMarks::Path& path) {
            PaperPath points;
            for (const PlanePoint p : path) points.push_back(ofMark(p));
            return points;
        };
        std::vector<PaperPath> removed, clouds, tags;
        for (const drawing::RevisionLines::Line& line : marks.removed)
            removed.push_back({ofMark(line.from), ofMark(line.to)});
        for (const RevisionMarks::Cloud& cloud : marks.clouds) clouds.push_back(onPaper(cloudPath(cloud)));
        for (const RevisionMarks::Tag& tag : marks.tags)
            tags.push_back(onPaper({tag.corners[0], tag.corners[1], tag.corners[2], tag.corners[0]}));
        if (!removed.empty()) inLayer("Removed", [&] { canvas_.stroke(removed, {widths_.beyond, LineType::Dashed}); });
        inLayer("Revisions", [&] {
            for (const PaperPath& tag : tags) canvas_.fill({tag}, "#ffffff");
            canvas_.stroke(clouds, {widths_.leaf});
            canvas_.stroke(tags, {widths_.leaf});
            for (const RevisionMarks::Tag& tag : marks.tags)
                canvas_.text({ofMark(tag.at), tag.size, tag.text, TextAnchor::Middle});
        });
    }

    const drawing::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    const DrawingPlace& place_;
    SheetCanvas& canvas_;
    const PaintOptions& options_;
    const LineWidths widths_;
    DrawingStyle style_;
};

}  // namespace

void paintDrawing(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                  const DrawingPlace& place, SheetCanvas& canvas, const PaintOptions& options) {
    DrawingPainter(drawing, volume, place, canvas, options).paint();
}

}  // namespace svt::writers
