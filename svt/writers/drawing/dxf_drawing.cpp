#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_page.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/drawing/dxf_file.hpp>
#include <svt/writers/drawing/dxf_parts.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/field/field_marks.hpp>
#include <svt/writers/revisions/revision_clouds.hpp>
#include <svt/writers/revisions/revision_list.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

// AutoCAD color index by class.
int colorOf(const std::string& className) noexcept {
    if (model::isSpace(className)) return 8;
    switch (model::classRank(className)) {
        case model::ClassRank::Furniture: return 32;
        case model::ClassRank::Filling: return 4;
        case model::ClassRank::Installation: return 6;
        default: break;
    }
    if (className.starts_with("Roof")) return 1;
    if (className.starts_with("Ground") || className.starts_with("Floor") || className.starts_with("Ceiling")) return 3;
    if (className == "BuildingConstructiveElement") return 5;
    return 7;
}

constexpr std::size_t kMostCharacters = 255;  // of a text in extended data

// Lines beyond the cut, by kind: narrow lines of ISO 128-2, dashes in widths of the line, gaps below zero.
struct BeyondStyle {
    const char *layer, *field, *lineType, *words;
    int color;
    std::vector<double> dashes;
};
const BeyondStyle& beyondStyle(drawing::BeyondKind kind) {
    static const BeyondStyle kStyles[] = {
        {"BEYOND_VISIBLE", "VISIBLE-", "Continuous", "", 7, {}},
        {"BEYOND_HIDDEN", "HIDDEN--", "ACAD_ISO02W100", "ISO dash", 8, {12, -3}},
        {"BEYOND_ABOVE", "ABOVE---", "ACAD_ISO05W100", "ISO long-dash double-dot", 8, {24, -3, 0, -3, 0, -3}}};
    return kStyles[static_cast<std::size_t>(kind)];
}
// Hundredths of a millimetre: the series of ISO 128-2 at 1:100.
constexpr int kBoldWidth = 50, kMediumWidth = 25, kBeyondWidth = 18, kThinWidth = 13;
constexpr double kDashUnit = 1.8e-4 * 100;  // metres: the width of the line at a scale of 1:100

// Dimensions are placed for a scale of 1:100.
constexpr double kDimensionScale = 10;  // millimetres on paper per metre

double degreesOf(double radians) { return radians * 180 / std::numbers::pi; }

// Where points of a drawing are in the file: in the drawing's plane, or in the world.
class DxfPlace {
public:
    DxfPlace(const drawing::PlaneAxes& axes, bool isWorld) : axes_(axes), isWorld_(isWorld) {
        if (!isWorld) return;
        normal_ = axes.normal;
        const bool isUpright = std::abs(normal_.x) < 1.0 / 64 && std::abs(normal_.y) < 1.0 / 64;
        objectX_ = normalized(cross(isUpright ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}, normal_));
        objectY_ = normalized(cross(normal_, objectX_));
        elevation_ = dot(normal_, axes.origin);
        turnDegrees_ = degreesOf(std::atan2(dot(axes.u, objectY_), dot(axes.u, objectX_)));
    }

    // A point for entities in space, such as LINE.
    [[nodiscard]] Vec3d placed(PlanePoint p) const noexcept {
        return isWorld_ ? axes_.worldFromPlane(p) : Vec3d{p.u, p.v, 0};
    }
    // A point for flat entities. In the world they have axes of their own, which follow from their normal (the
    // "arbitrary axis").
    [[nodiscard]] PlanePoint flat(PlanePoint p) const noexcept {
        if (!isWorld_) return p;
        const Vec3d world = axes_.worldFromPlane(p);
        return {dot(world, objectX_), dot(world, objectY_)};
    }
    [[nodiscard]] bool isWorld() const noexcept { return isWorld_; }
    [[nodiscard]] Vec3d normal() const noexcept { return normal_; }
    [[nodiscard]] double elevation() const noexcept { return elevation_; }
    [[nodiscard]] double turnDegrees() const noexcept { return turnDegrees_; }

private:
    const drawing::PlaneAxes& axes_;
    bool isWorld_;
    Vec3d normal_{0, 0, 1}, objectX_{1, 0, 0}, objectY_{0, 1, 0};
    double elevation_ = 0, turnDegrees_ = 0;
};

class DxfWriter {
public:
    DxfWriter(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, const DxfOptions& options)
        : drawing_(drawing),
          volume_(volume),
          hasIsoLayers_(options.isoLayers),
          look_(options.field),
          style_(drawing, volume, kDimensionScale),
          place_(drawing.axes, options.world) {
        if (options.isoLayers)
            externals_ = options.externals != nullptr ? *options.externals : drawing::findExternalParts(volume);
        if (!options.world || isPlan(drawing, volume.grid))
            dimensions_ = placeDimensions(drawing, drawnBox(drawing), kDimensionScale);
    }

    std::string write() {
        addEntities();
        for (const auto kind :
             {drawing::BeyondKind::Visible, drawing::BeyondKind::Hidden, drawing::BeyondKind::Above}) {
            const BeyondStyle& style = beyondStyle(kind);
            const bool isUsed = std::ranges::any_of(drawing_.beyond,
                                                    [&](const drawing::BeyondLine& line) { return line.kind == kind; });
            if (style.dashes.empty() || !isUsed) continue;
            DxfLineType type{style.lineType, style.words, style.dashes};
            for (double& dash : type.dashes) dash *= kDashUnit;
            file_.add(std::move(type));
        }
        const BeyondStyle& removed = beyondStyle(drawing::BeyondKind::Hidden);
        const bool hasType = std::ranges::any_of(
            drawing_.beyond, [](const drawing::BeyondLine& l) { return l.kind == drawing::BeyondKind::Hidden; });
        if (hasRevisions(drawing_) && !hasType) {
            DxfLineType type{removed.lineType, removed.words, removed.dashes};
            for (double& dash : type.dashes) dash *= kDashUnit;
            file_.add(std::move(type));
        }
        return file_.write(comments(), view(), out_.take());
    }

private:
    // How a text is written; it is centred at its point.
    struct Letters {
        const char* style;
        double height, degrees;
        bool isTurned, isOnBaseline;
    };

    [[nodiscard]] std::vector<std::string> comments() const {
        const drawing::PlaneAxes& axes = drawing_.axes;
        std::vector<std::string> lines{
            dxfText(shownName(volume_)) + ", " + planeText(drawing_, volume_),
            (place_.isWorld() ? "coordinates of the world; the drawing lies at origin + u * x + v * y, metres"
                              : "world = origin + u * x + v * y, metres") +
                (volume_.crsName.empty() ? std::string() : ", CRS " + dxfText(volume_.crsName)),
            "origin " + vectorText(axes.origin, 6), "u " + vectorText(axes.u, 15), "v " + vectorText(axes.v, 15)};
        if (look_.isShown()) {
            lines.push_back("field " + dxfText(look_.field->title));
            for (const drawing::FieldBand& band : look_.field->bands)
                lines.push_back(fmt::format("{}: {:.9g} to {:.9g}, {}", bandLayerOf(band), band.low, band.high,
                                            bandColor(look_, band)));
        }
        if (std::string sources = drawing::externalSources(externals_, volume_.labels); !sources.empty())
            lines.push_back(std::move(sources));
        return lines;
    }

    [[nodiscard]] DxfView view() const {
        auto [low, high] = drawnBox(drawing_);
        for (const DimensionMark& mark : dimensions_.marks)
            for (const PlanePoint p : {inMetres(mark.line.from), inMetres(mark.line.to)}) {
                low = {std::min(low.u, p.u), std::min(low.v, p.v)};
                high = {std::max(high.u, p.u), std::max(high.v, p.v)};
            }
        return {place_.placed(low), place_.placed(high),
                place_.placed({0.5 * (low.u + high.u), 0.5 * (low.v + high.v)}), high.u - low.u, high.v - low.v};
    }

    void addEntities() {
        for (const drawing::SectionComponent& component : drawing_.components)
            for (const drawing::SectionPolygon& polygon : component.polygons) addHatch(component.label, polygon);
        const DxfOutlines outlines(drawing_);
        for (const drawing::SectionComponent& component : drawing_.components) {
            const std::string layer = layerOf(component.label, DxfContent::Element);
            const auto addRing = [&](const drawing::Ring& ring) {
                bool isClosed = true;
                for (const auto& part : outlines.partsOf(ring, isClosed)) addPolyline(part, isClosed, layer, component);
            };
            for (const drawing::SectionPolygon& polygon : component.polygons) {
                addRing(polygon.outer);
                for (const drawing::Ring& hole : polygon.holes) addRing(hole);
            }
            if (component.lineLength > 0) addLines(component, layer);
            if (!component.polygons.empty() && model::isSpace(labelOf(component.label).className)) addName(component);
        }
        if (look_.isShown()) addField();
        for (const drawing::BeyondLine& line : drawing_.beyond) addBeyond(line);
        for (const drawing::DoorSwing& swing : drawing_.doors) addDoor(swing);
        for (const DimensionMark& mark : dimensions_.marks) addDimension(mark);
        for (const MarkText& text : dimensions_.heights) addDimensionText(text);
        if (hasRevisions(drawing_)) addRevisions();
    }

    // Clouds have arcs (42: their bulge), and the numbers of their revisions as extended data.
    void addRevisions() {
        const RevisionMarks marks = placeRevisions(drawing_, kDimensionScale);
        const std::string layer =
            file_.layer(hasIsoLayers_ ? isoLayerOf(DxfContent::Text) : "REVISIONS", 7, "Continuous", kMediumWidth);
        const BeyondStyle& style = beyondStyle(drawing::BeyondKind::Hidden);
        const std::string removed = file_.layer("REMOVED", style.color, style.lineType, kBeyondWidth);
        for (const drawing::RevisionLines::Line& line : marks.removed)
            addLine(place_.placed(inMetres(line.from)), place_.placed(inMetres(line.to)), removed);
        const auto addClosed = [&](std::span<const PlanePoint> points, double bulge) {
            begin("LWPOLYLINE", layer, "AcDbPolyline");
            out_.add({{90, static_cast<int>(points.size())}, {70, 1}, {43, 0}});
            if (place_.isWorld()) out_.add({{38, place_.elevation()}});
            for (const PlanePoint p : points) {
                out_.point(10, place_.flat(inMetres(p)));
                if (bulge != 0) out_.add({{42, bulge}});
            }
            addExtrusion();
        };
        for (const RevisionMarks::Cloud& cloud : marks.clouds) {
            addClosed(cloud.ends, RevisionMarks::kBulge);
            out_.add({{1001, "SVT"},
                      {1000, fmt::format("revisions {}", fmt::join(cloud.numbers, " ")).substr(0, kMostCharacters)}});
        }
        for (const RevisionMarks::Tag& tag : marks.tags) addClosed(tag.corners, 0);
        const double turn = place_.turnDegrees();
        const auto write = [&](PlanePoint at, double size, const std::string& text) {
            addText(at, dxfText(text), layer, {"SVT_NAMES", 0.73 * size / kDimensionScale, turn, turn != 0, true});
        };
        for (const RevisionMarks::Tag& tag : marks.tags) write(inMetres(tag.at), tag.size, tag.text);
        addRevisionList(layer);
    }

    // Below the drawing and its dimensions. Texts are centred, so their ends become middles.
    void addRevisionList(const std::string& layer) {
        constexpr double kBelow = 16;  // millimetres
        const auto [low, high] = drawnBox(drawing_);
        const double left = low.u * kDimensionScale,
                     top = low.v * kDimensionScale - kBelow - dimensionReach(drawing_, drawing::DimensionSide::Below);
        const RevisionList list =
            makeRevisionList(revisionsOf(drawing_), 0, 0, std::max(110.0, (high.u - low.u) * kDimensionScale),
                             DrawingPage::kMostRevisions);
        const auto placed = [&](double x, double y) { return inMetres({left + x, top - y}); };
        for (const RevisionList::Rule& rule : list.rules)
            addLine(place_.placed(placed(rule.left, rule.y)), place_.placed(placed(rule.right, rule.y)), layer);
        const double turn = place_.turnDegrees();
        for (const RevisionList::Text& text : list.texts) {
            const double half = 0.3 * RevisionList::kText * double(characterCount(text.text));
            addText(placed(text.isEnd ? text.x - half : text.x + half, text.y), dxfText(text.text), layer,
                    {"SVT_NAMES", 0.73 * RevisionList::kText / kDimensionScale, turn, turn != 0, true});
        }
    }

    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const noexcept {
        return volume_.labels.labels[label];
    }
    [[nodiscard]] std::string isoOf(std::uint32_t label, DxfContent content, std::string_view field = {}) const {
        return isoLayerOf(labelOf(label), externals_[label].isExternal, content, field);
    }
    const std::string& layerOf(std::uint32_t label, DxfContent content) {
        const volume::Label& of = labelOf(label);
        const int color = content == DxfContent::Hatch ? 8 : colorOf(of.className);
        const int width =
            content == DxfContent::Element ? (style_.isBold(label) ? kBoldWidth : kMediumWidth) : kThinWidth;
        if (hasIsoLayers_) return file_.layer(isoOf(label, content), color, "Continuous", width);
        return file_.layer(dxfLayerOf(of) + (content == DxfContent::Hatch ? "_HATCH" : ""), color, "Continuous", width);
    }
    const std::string& dimensionLayer() {
        return file_.layer(hasIsoLayers_ ? isoLayerOf(DxfContent::Dimension) : "DIMENSIONS", 7, "Continuous", 13);
    }

    void begin(const char* type, std::string_view layer, const char* subclass) {
        out_.add({{0, type}, {5, file_.newHandle()}, {330, owner_}, {100, "AcDbEntity"}, {8, layer}, {100, subclass}});
    }
    // The output of `draw` becomes the content of a block.
    template <class Draw>
    void addBlock(DxfBlock block, const Draw& draw) {
        const std::string before = out_.take();
        owner_ = block.record;
        draw();
        block.entities = out_.take();
        owner_ = DxfFile::kModelSpace;
        out_.append(before);
        file_.add(std::move(block));
    }
    void addExtrusion() {
        if (place_.isWorld() && place_.normal() != Vec3d{0, 0, 1}) out_.point(210, place_.normal());
    }
    void addId(std::uint32_t label) {
        out_.add({{1001, "SVT"}, {1000, dxfText(labelOf(label).id).substr(0, kMostCharacters)}});
    }

    void addLine(Vec3d from, Vec3d to, std::string_view layer) {
        begin("LINE", layer, "AcDbLine");
        out_.point(10, from);
        out_.point(11, to);
    }

    // With id, area and its bound (m2), and whether it is exact (1) or drawn by voxels (0).
    void addPolyline(const std::vector<PlanePoint>& points, bool isClosed, std::string_view layer,
                     const drawing::SectionComponent& component) {
        begin("LWPOLYLINE", layer, "AcDbPolyline");
        out_.add({{90, static_cast<int>(points.size())}, {70, isClosed ? 1 : 0}, {43, 0}});
        if (place_.isWorld()) out_.add({{38, place_.elevation()}});
        for (const PlanePoint p : points) out_.point(10, place_.flat(p));
        addExtrusion();
        addId(component.label);
        out_.add({{1040, component.area}, {1040, component.areaBound}, {1070, component.isExact ? 1 : 0}});
    }

    void addLines(const drawing::SectionComponent& component, std::string_view layer) {
        for (const drawing::SectionLine& line : drawing_.lines) {
            if (line.label != component.label) continue;
            const bool isClosed = line.points.size() > 3 && line.points.front() == line.points.back();
            std::vector<PlanePoint> points = line.points;
            if (isClosed) points.pop_back();
            addPolyline(points, isClosed, layer, component);
        }
    }

    void addBeyond(const drawing::BeyondLine& line) {
        const BeyondStyle& style = beyondStyle(line.kind);
        const std::string layer = hasIsoLayers_ ? isoOf(line.label, DxfContent::Element, style.field) : style.layer;
        addLine(place_.placed(line.from), place_.placed(line.to),
                file_.layer(layer, style.color, style.lineType, kBeyondWidth));
        addId(line.label);
    }

    void addText(PlanePoint at, std::string_view content, std::string_view layer, const Letters& letters) {
        begin("TEXT", layer, "AcDbText");
        out_.point(10, place_.flat(at));
        out_.add({{30, place_.elevation()}, {40, letters.height}, {1, content}});
        if (letters.isTurned) out_.add({{50, letters.degrees}});
        out_.add({{7, letters.style}, {72, 1}});  // centred at the second point
        out_.point(11, place_.flat(at));
        out_.add({{31, place_.elevation()}});
        if (!letters.isOnBaseline) addExtrusion();
        out_.add({{100, "AcDbText"}, {73, letters.isOnBaseline ? 0 : 2}});
    }

    void addName(const drawing::SectionComponent& component) {
        if (component.isZone) return;
        const std::string& shown = shownName(labelOf(component.label));
        const auto& largest = *std::ranges::max_element(component.polygons, {}, &drawing::SectionPolygon::area);
        const drawing::TextPlace place = drawing::findTextPlace(largest);
        const double height =
            std::min({0.25, place.height / 3, place.width / (0.8 * double(std::max<std::size_t>(shown.size(), 6)))});
        if (!(height > 0)) return;
        const std::string layer = file_.layer(hasIsoLayers_ ? isoLayerOf(DxfContent::Text) : "TEXT", 7);
        const Letters letters{"SVT_NAMES", height, place_.turnDegrees(), place_.turnDegrees() != 0, false};
        const auto [u, v] = place.center;
        if (!isPlan(drawing_, volume_.grid)) return addText(place.center, dxfText(shown), layer, letters);
        addText({u, v + 0.8 * height}, dxfText(shown), layer, letters);
        addText({u, v - 0.8 * height}, dxfText(fmt::format("{:.2f} m\u00B2", component.stampArea())), layer, letters);
    }

    static std::string bandLayerOf(const drawing::FieldBand& band) {
        return plainName(fmt::format("FIELD_{:.9g}_{:.9g}", band.low, band.high));
    }

    void addSolid(const drawing::SectionPolygon& polygon, std::string_view layer) {
        beginHatch("SOLID", true, polygon, layer);
        out_.add({{75, 0}, {76, 1}, {98, 0}});
    }

    // \param isClosed  the last point repeats the first
    void addFieldLine(const std::vector<PlanePoint>& points, bool isClosed, const char* layer, double value) {
        const std::size_t count = points.size() - (isClosed ? 1 : 0);
        begin("LWPOLYLINE", file_.layer(layer, 7, "Continuous", kBeyondWidth), "AcDbPolyline");
        out_.add({{90, static_cast<int>(count)}, {70, isClosed ? 1 : 0}, {43, 0}});
        if (place_.isWorld()) out_.add({{38, place_.elevation()}});
        for (std::size_t n = 0; n < count; ++n) out_.point(10, place_.flat(points[n]));
        addExtrusion();
        out_.add({{1001, "SVT"}, {1040, value}});
    }

    // The bands of a field, its lines and arrows with their values (1040), and texts along lines.
    void addField() {
        const drawing::FieldDrawing& field = *look_.field;
        for (const drawing::SectionPolygon& polygon : field.missing)
            addSolid(polygon, file_.layer("FIELD_NO_VALUE", 9));
        for (const drawing::FieldBand& band : field.bands)
            for (const drawing::SectionPolygon& polygon : band.polygons)
                addSolid(polygon, file_.layer(bandLayerOf(band), autocadColor(bandColor(look_, band))));
        for (const drawing::FieldIsoline& line : field.isolines) {
            const bool isClosed = line.points.size() > 3 && line.points.front() == line.points.back();
            addFieldLine(line.points, isClosed, "FIELD_LINES", line.value);
        }
        for (const drawing::FieldArrow& arrow : field.arrows) {
            const std::vector<PlanePoint> head = arrowHead(arrow);
            addFieldLine({arrow.from, arrow.to, head[0]}, false, "FIELD_ARROWS", arrow.value);
            addFieldLine({arrow.to, head[2]}, false, "FIELD_ARROWS", arrow.value);
        }
        const std::string texts = file_.layer("FIELD_TEXT", 7);
        for (const FieldLabel& label : placeFieldLabels(field, kDimensionScale))
            addText(
                label.at, label.text, texts,
                {"SVT_NAMES", 0.73 * label.size / kDimensionScale, label.degrees + place_.turnDegrees(), true, false});
        addFieldLegend(texts);
    }

    // A box for each band at the right of the drawing, from below.
    void addFieldLegend(std::string_view texts) {
        constexpr double kSide = 0.4, kText = 0.2, kAway = 1.5;
        const auto [low, high] = drawnBox(drawing_);
        const Letters letters{"SVT_NAMES", kText, place_.turnDegrees(), place_.turnDegrees() != 0, false};
        const double u = high.u + kAway;
        double v = low.v;
        const auto addBox = [&](std::string_view layer, std::string_view text) {
            addSolid({{{u, v}, {u + kSide, v}, {u + kSide, v + kSide}, {u, v + kSide}}, {}, kSide * kSide}, layer);
            addText({u + 4 * kSide, v + kSide / 2}, text, texts, letters);
            v += kSide;
        };
        addBox(file_.layer("FIELD_NO_VALUE", 9), "no value");
        v += kSide / 2;
        for (const drawing::FieldBand& band : look_.field->bands)
            addBox(file_.layer(bandLayerOf(band), autocadColor(bandColor(look_, band))),
                   fmt::format("{:.6g} - {:.6g}", band.low, band.high));
        addText({u + 4 * kSide, v + kSide}, dxfText(look_.field->title), texts, letters);
    }

    // The beginning of a hatch with its rings.
    void beginHatch(const char* pattern, bool isSolid, const drawing::SectionPolygon& polygon, std::string_view layer) {
        begin("HATCH", layer, "AcDbHatch");
        out_.point(10, Vec3d{0, 0, place_.elevation()});
        out_.point(210, place_.normal());
        // A pattern; then how many rings follow.
        out_.add({{2, pattern}, {70, isSolid ? 1 : 0}, {71, 0}, {91, static_cast<int>(1 + polygon.holes.size())}});
        const auto addRing = [&](const drawing::Ring& ring, int kind) {
            out_.add({{92, kind}, {72, 0}, {73, 1}, {93, static_cast<int>(ring.size())}});
            for (const PlanePoint p : ring) out_.point(10, place_.flat(p));
            out_.add({{97, 0}});
        };
        addRing(polygon.outer, 1 + 2);  // external, a polyline
        for (const drawing::Ring& hole : polygon.holes) addRing(hole, 16 + 2);
    }

    void addHatch(std::uint32_t label, const drawing::SectionPolygon& polygon) {
        const DxfHatch* const pattern = dxfHatchOf(style_.hatchOf(label));
        if (pattern == nullptr) return;
        beginHatch(pattern->name, false, polygon, layerOf(label, DxfContent::Hatch));
        // Its own lines, not turned and not scaled.
        out_.add({{75, 0}, {76, 0}, {52, 0}, {41, 1}, {77, 0}, {78, static_cast<int>(pattern->lines.size())}});
        for (const DxfHatchLine& line : pattern->lines) {
            const double angle = line.degrees * std::numbers::pi / 180;
            out_.add({{53, line.degrees}, {43, line.x}, {44, line.y}});
            out_.add({{45, -line.distance * std::sin(angle)}, {46, line.distance * std::cos(angle)}});
            out_.add({{79, line.dash > 0 ? 2 : 0}});
            if (line.dash > 0) out_.add({{49, line.dash}, {49, -line.gap}});
        }
        out_.add({{98, 0}});
    }

    // A block with leaves and arcs about the first hinge, and where it is inserted.
    void addDoor(const drawing::DoorSwing& swing) {
        const std::string layer = layerOf(swing.label, DxfContent::Element);
        const std::string name = fmt::format("DOOR_{}", ++doorCount_);
        const PlanePoint base = place_.flat(swing.lines.front().front());
        const auto local = [&](PlanePoint p) {
            const PlanePoint at = place_.flat(p);
            return Vec3d{at.u - base.u, at.v - base.v, 0};
        };
        addBlock(file_.newBlock(name, false), [&] {
            for (const auto& points : swing.lines)
                for (std::size_t n = 0; n + 1 < points.size(); ++n)
                    addLine(local(points[n]), local(points[n + 1]), layer);
            for (const drawing::DoorSwing::Arc& arc : swing.arcs) {
                const Vec3d center = local(arc.center), from = local(arc.from) - center, to = local(arc.to) - center;
                const auto degrees = [](Vec3d v) {
                    const double turn = degreesOf(std::atan2(v.y, v.x));
                    return turn < -1e-9 ? turn + 360 : turn;
                };
                begin("ARC", layer, "AcDbCircle");
                out_.point(10, center);
                out_.add({{40, std::hypot(from.x, from.y)}, {100, "AcDbArc"}, {50, degrees(from)}, {51, degrees(to)}});
            }
        });
        begin("INSERT", layer, "AcDbBlockReference");
        out_.add({{2, name}});
        out_.point(10, base);
        out_.add({{30, place_.elevation()}});
        addExtrusion();
        addId(swing.label);
    }

    static PlanePoint inMetres(PlanePoint p) noexcept { return {p.u / kDimensionScale, p.v / kDimensionScale}; }

    void addDimensionText(const MarkText& text) {
        const double degrees = (text.isUpright ? 90 : 0) + place_.turnDegrees();
        const double height = 0.73 * text.size / kDimensionScale;  // of capitals
        addText(inMetres(text.at), dxfText(text.text), dimensionLayer(),
                {"SVT_DIMENSIONS", height, degrees, text.isUpright || place_.turnDegrees() != 0, true});
    }

    // A DIMENSION, and the block that says how it looks, as programs write both.
    void addDimension(const DimensionMark& mark) {
        const std::string name = fmt::format("*D{}", file_.blockCount() + 1), content = dxfText(mark.text.text);
        const auto placed = [&](PlanePoint p) { return place_.placed(inMetres(p)); };
        const PlanePoint from = mark.line.from, to = mark.line.to;
        addBlock(file_.newBlock(name, true), [&] {
            addLine(placed(from), placed(to), dimensionLayer());
            for (const auto* const lines : {&mark.feet, &mark.ticks})
                for (const MarkLine& line : *lines) addLine(placed(line.from), placed(line.to), dimensionLayer());
            addDimensionText(mark.text);
        });
        begin("DIMENSION", dimensionLayer(), "AcDbDimension");
        out_.add({{2, name}});
        out_.point(10, placed(to));
        out_.point(11, placed(mark.text.at));
        // Linear; its block is its own; the place of the text is set.
        out_.add({{70, 32 + 128}, {1, content}, {3, "Standard"}});
        out_.add({{100, "AcDbAlignedDimension"}});
        out_.point(13, placed(from));
        out_.point(14, placed(to));
        out_.add({{50, (from.u == to.u ? 90 : 0) + place_.turnDegrees()}, {100, "AcDbRotatedDimension"}});
    }

    const drawing::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    bool hasIsoLayers_;
    FieldLook look_;
    std::vector<drawing::ExternalPart> externals_;  // by label, for ISO layers
    DrawingStyle style_;
    DxfPlace place_;
    DimensionMarks dimensions_;
    int doorCount_ = 0;
    std::string owner_ = DxfFile::kModelSpace;
    DxfFile file_;
    DxfText out_;
};

}  // namespace

std::string makeDxf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                    const DxfOptions& options) {
    return DxfWriter(drawing, volume, options).write();
}

}  // namespace svt::writers
