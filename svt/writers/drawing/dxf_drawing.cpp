#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/drawing/dxf_parts.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/labels/label_looks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <numbers>
#include <tuple>

namespace svt::writers {
namespace {

using illustrate::PlanePoint;

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

// Windows code page 1252 for its Latin-1 part; other characters as \U+XXXX, those beyond 16 bits as a question mark.
// Line breaks would end the value and are replaced.
std::string dxfText(std::string_view text) {
    std::string safe;
    for (std::size_t at = 0; at < text.size();) {
        const auto [c, size] = firstCharacter(text.substr(at));
        if (size == 0) {
            safe += '?';
            do ++at;
            while (at < text.size() && (text[at] & 0xC0) == 0x80);
            continue;
        }
        if (c < 0x80)
            safe += c < 0x20 || c == 0x7F ? ' ' : static_cast<char>(c);
        else if (c >= 0xA0 && c <= 0xFF)
            safe += static_cast<char>(c);
        else if (c < 0x10000)
            safe += fmt::format("\\U+{:04X}", static_cast<std::uint32_t>(c));
        else
            safe += '?';
        at += size;
    }
    return safe;
}

constexpr std::size_t kMostCharacters = 255;  // of a text in extended data

// Lines beyond the cut, by kind: narrow lines of ISO 128-2, dashes in widths of the line, gaps below zero.
struct BeyondStyle {
    illustrate::BeyondKind kind;
    const char *layer, *lineType, *words;
    int color;
    int dashCount;
    double dashes[6];
};
constexpr BeyondStyle kBeyondStyles[] = {
    {illustrate::BeyondKind::Visible, "BEYOND_VISIBLE", "Continuous", "", 7, 0, {}},
    {illustrate::BeyondKind::Hidden, "BEYOND_HIDDEN", "ACAD_ISO02W100", "ISO dash", 8, 2, {12, -3}},
    {illustrate::BeyondKind::Above,
     "BEYOND_ABOVE",
     "ACAD_ISO05W100",
     "ISO long-dash double-dot",
     8,
     6,
     {24, -3, 0, -3, 0, -3}}};
constexpr int kBeyondWidth = 18;            // hundredths of a millimetre
constexpr double kDashUnit = 1.8e-4 * 100;  // metres: the width of the line at a scale of 1:100

// Dimensions are placed for a scale of 1:100.
constexpr double kDimensionScale = 10;  // millimetres on paper per metre
constexpr const char* kDimensionLayer = "DIMENSIONS";

class DxfWriter {
    // The looks of a dimension, or a door.
    struct Block {
        std::string record, begin, end;  // handles
        std::string name, entities;
        bool isAnonymous = true;
    };

public:
    DxfWriter(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
              const DxfOptions& options)
        : drawing_(drawing), volume_(volume), options_(options), style_(drawing, volume, kDimensionScale) {
        findObjectAxes();
        std::tie(low_, high_) = drawnBox(drawing);
        for (const illustrate::BeyondLine& line : drawing.beyond) hasKind_[static_cast<std::size_t>(line.kind)] = true;
        if (!options.world || isPlan(drawing, volume.grid))
            dimensions_ = placeDimensions(drawing, {low_, high_}, kDimensionScale);
        for (const DimensionMark& mark : dimensions_.marks)
            for (const PlanePoint p : {inMetres(mark.line.from), inMetres(mark.line.to)}) {
                low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
            }
    }

    std::string write() {
        entities();
        const std::string body = std::move(dxf_);
        dxf_.clear();
        const std::string tablesText = [&] {
            tables();
            return std::move(dxf_);
        }();
        dxf_.clear();
        blocks();
        const std::string blocksText = std::move(dxf_);
        dxf_.clear();
        header();
        return dxf_ + tablesText + blocksText + body + objectsText() + "  0\nEOF\n";
    }

private:
    void tag(int code, std::string_view value) { dxf_ += fmt::format("{:>3}\n{}\n", code, value); }
    void tag(int code, int value) { dxf_ += fmt::format("{:>3}\n{}\n", code, value); }
    void number(int code, double value) { tag(code, shortNumber(value, 6)); }
    // Handles below 0x100 are reserved for the fixed parts.
    std::string newHandle() { return fmt::format("{:X}", nextHandle_++); }

    void header() {
        const auto vector = [](Vec3d v, int decimals) {
            return fmt::format("{} {} {}", shortNumber(v.x, decimals), shortNumber(v.y, decimals),
                               shortNumber(v.z, decimals));
        };
        const illustrate::PlaneAxes& axes = drawing_.axes;
        tag(999, dxfText(shownName(volume_)) + ", " + planeText(drawing_, volume_.grid));
        tag(999, (options_.world
                      ? std::string("coordinates of the world; the drawing lies at origin + u * x + v * y, metres")
                      : std::string("world = origin + u * x + v * y, metres")) +
                     (volume_.crsName.empty() ? std::string() : ", CRS " + dxfText(volume_.crsName)));
        tag(999, "origin " + vector(axes.origin, 6));
        tag(999, "u " + vector(axes.u, 15));
        tag(999, "v " + vector(axes.v, 15));
        section("HEADER");
        const auto variable = [&](const char* name, int code, std::string_view value) {
            tag(9, name);
            tag(code, value);
        };
        variable("$ACADVER", 1, "AC1015");
        variable("$DWGCODEPAGE", 3, "ANSI_1252");
        variable("$HANDSEED", 5, fmt::format("{:X}", nextHandle_));
        variable("$INSUNITS", 70, "6");     // metres
        variable("$MEASUREMENT", 70, "1");  // metric
        variable("$LUNITS", 70, "2");       // decimal
        const Vec3d a = placed(low_), b = placed(high_);
        tag(9, "$EXTMIN");
        point(10, {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)});
        tag(9, "$EXTMAX");
        point(10, {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
        endSection();
        section("CLASSES");
        endSection();
    }

    void section(const char* name) {
        tag(0, "SECTION");
        tag(2, name);
    }
    void endSection() { tag(0, "ENDSEC"); }
    void point(int code, PlanePoint p) {
        number(code, p.u);
        number(code + 10, p.v);
    }
    void point(int code, Vec3d p) {
        number(code, p.x);
        number(code + 10, p.y);
        number(code + 20, p.z);
    }

    // Flat entities in the world have axes of their own, which follow from their normal (the "arbitrary axis").
    void findObjectAxes() {
        if (!options_.world) return;
        normal_ = drawing_.axes.normal;
        const bool isUpright = std::abs(normal_.x) < 1.0 / 64 && std::abs(normal_.y) < 1.0 / 64;
        objectX_ = normalized(cross(isUpright ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}, normal_));
        objectY_ = normalized(cross(normal_, objectX_));
        elevation_ = dot(normal_, drawing_.axes.origin);
        turnDegrees_ =
            std::atan2(dot(drawing_.axes.u, objectY_), dot(drawing_.axes.u, objectX_)) * 180 / std::numbers::pi;
    }
    // A point for entities in space, such as LINE.
    [[nodiscard]] Vec3d placed(PlanePoint p) const noexcept {
        return options_.world ? drawing_.axes.worldFromPlane(p) : Vec3d{p.u, p.v, 0};
    }
    // A point for flat entities, in their own axes.
    [[nodiscard]] PlanePoint flat(PlanePoint p) const noexcept {
        if (!options_.world) return p;
        const Vec3d world = drawing_.axes.worldFromPlane(p);
        return {dot(world, objectX_), dot(world, objectY_)};
    }
    void extrusion() {
        if (!options_.world || normal_ == Vec3d{0, 0, 1}) return;
        point(210, normal_);
    }

    void table(const char* name, const char* handle, int count) {
        tag(0, "TABLE");
        tag(2, name);
        tag(5, handle);
        tag(330, "0");
        tag(100, "AcDbSymbolTable");
        tag(70, count);
    }
    void endTable() { tag(0, "ENDTAB"); }
    void record(const char* type, std::string_view handle, const char* owner, const char* subclass,
                std::string_view name) {
        tag(0, type);
        tag(std::string_view(type) == "DIMSTYLE" ? 105 : 5, handle);
        tag(330, owner);
        tag(100, "AcDbSymbolTableRecord");
        tag(100, subclass);
        tag(2, name);
        tag(70, 0);
    }

    void tables() {
        section("TABLES");
        viewportTable();
        lineTypeTable();
        layerTable();
        textStyleTable();
        table("VIEW", "5", 0);
        endTable();
        table("UCS", "6", 0);
        endTable();
        table("APPID", "7", 2);
        record("APPID", "28", "7", "AcDbRegAppTableRecord", "ACAD");
        record("APPID", "2E", "7", "AcDbRegAppTableRecord", "SVT");
        endTable();
        table("DIMSTYLE", "8", 1);
        tag(100, "AcDbDimStyleTable");
        record("DIMSTYLE", "29", "8", "AcDbDimStyleTableRecord", "Standard");
        endTable();
        blockRecordTable();
        endSection();
    }

    // The view that a program shows first: all of the drawing.
    void viewportTable() {
        table("VPORT", "1", 1);
        record("VPORT", "21", "1", "AcDbViewportTableRecord", "*Active");
        const double width = std::max(high_.u - low_.u, 1.0), height = std::max(high_.v - low_.v, 1.0);
        for (const auto& [code, p] :
             {std::pair(10, PlanePoint{0, 0}), std::pair(11, PlanePoint{1, 1}), std::pair(12, viewCenter()),
              std::pair(13, PlanePoint{0, 0}), std::pair(14, PlanePoint{1, 1}), std::pair(15, PlanePoint{1, 1}),
              std::pair(16, PlanePoint{0, 0}), std::pair(17, PlanePoint{0, 0})}) {
            point(code, p);
            if (code == 16) tag(36, "1");
            if (code == 17) tag(37, "0");
        }
        number(40, 1.1 * std::max(height, width / 1.5));
        number(41, 1.5);
        number(42, 50);
        endTable();
    }

    [[nodiscard]] PlanePoint viewCenter() const noexcept {
        const Vec3d middle = placed({0.5 * (low_.u + high_.u), 0.5 * (low_.v + high_.v)});
        return {middle.x, middle.y};
    }

    void lineTypeTable() {
        int count = 3;
        for (const BeyondStyle& style : kBeyondStyles)
            if (hasKind_[static_cast<std::size_t>(style.kind)] && style.dashCount != 0) ++count;
        table("LTYPE", "2", count);
        for (const auto& [handle, name] :
             {std::pair("22", "ByBlock"), std::pair("23", "ByLayer"), std::pair("24", "Continuous")}) {
            record("LTYPE", handle, "2", "AcDbLinetypeTableRecord", name);
            tag(3, "");
            tag(72, 65);
            tag(73, 0);
            tag(40, "0");
        }
        for (const BeyondStyle& style : kBeyondStyles) {
            if (!hasKind_[static_cast<std::size_t>(style.kind)] || style.dashCount == 0) continue;
            record("LTYPE", newHandle(), "2", "AcDbLinetypeTableRecord", style.lineType);
            tag(3, style.words);
            tag(72, 65);
            tag(73, style.dashCount);
            double length = 0;
            for (int n = 0; n < style.dashCount; ++n) length += std::abs(style.dashes[n]);
            number(40, kDashUnit * length);
            for (int n = 0; n < style.dashCount; ++n) {
                number(49, kDashUnit * style.dashes[n]);
                tag(74, 0);
            }
        }
        endTable();
    }

    void layerTable() {
        table("LAYER", "3", static_cast<int>(layers_.size()) + 1);
        const auto layer = [&](std::string_view handle, std::string_view name, int color, const char* lineType,
                               int width) {
            record("LAYER", handle, "3", "AcDbLayerTableRecord", name);
            tag(62, color);
            tag(6, lineType);
            tag(370, width);
            tag(390, "F");
        };
        layer("25", "0", 7, "Continuous", -3);
        for (const Layer& known : layers_) layer(newHandle(), known.name, known.color, known.lineType, known.width);
        endTable();
    }

    void textStyleTable() {
        table("STYLE", "4", 3);
        for (const auto& [handle, name] :
             {std::pair("27", "Standard"), std::pair("2F", "SVT_NAMES"), std::pair("30", "SVT_DIMENSIONS")}) {
            record("STYLE", handle, "4", "AcDbTextStyleTableRecord", name);
            tag(40, "0");
            tag(41, "1");
            tag(50, "0");
            tag(71, 0);
            tag(42, "2.5");
            tag(3, "arial.ttf");
            tag(4, "");
        }
        endTable();
    }

    void blockRecordTable() {
        table("BLOCK_RECORD", "9", 2 + static_cast<int>(blocks_.size()));
        for (const auto& [handle, name] : {std::pair("1A", "*Model_Space"), std::pair("1B", "*Paper_Space")}) {
            tag(0, "BLOCK_RECORD");
            tag(5, handle);
            tag(330, "9");
            tag(100, "AcDbSymbolTableRecord");
            tag(100, "AcDbBlockTableRecord");
            tag(2, name);
            tag(340, "0");
        }
        for (const Block& block : blocks_) {
            tag(0, "BLOCK_RECORD");
            tag(5, block.record);
            tag(330, "9");
            tag(100, "AcDbSymbolTableRecord");
            tag(100, "AcDbBlockTableRecord");
            tag(2, block.name);
            tag(340, "0");
        }
        endTable();
    }

    void blocks() {
        section("BLOCKS");
        addBlock({"1A", "2A", "2B", "*Model_Space", "", false}, 0);
        addBlock({"1B", "2C", "2D", "*Paper_Space", "", false}, 0);
        for (const Block& block : blocks_) addBlock(block, block.isAnonymous ? 1 : 0);
        endSection();
    }

    void addBlock(const Block& block, int flags) {
        tag(0, "BLOCK");
        tag(5, block.begin);
        tag(330, block.record);
        tag(100, "AcDbEntity");
        tag(8, "0");
        tag(100, "AcDbBlockBegin");
        tag(2, block.name);
        tag(70, flags);
        point(10, PlanePoint{0, 0});
        tag(30, "0");
        tag(3, block.name);
        tag(1, "");
        dxf_ += block.entities;
        tag(0, "ENDBLK");
        tag(5, block.end);
        tag(330, block.record);
        tag(100, "AcDbEntity");
        tag(8, "0");
        tag(100, "AcDbBlockEnd");
    }

    static std::string objectsText() {
        return "  0\nSECTION\n  2\nOBJECTS\n"
               "  0\nDICTIONARY\n  5\nC\n330\n0\n100\nAcDbDictionary\n281\n1\n  3\nACAD_GROUP\n350\nD\n"
               "  3\nACAD_PLOTSTYLENAME\n350\nE\n"
               "  0\nDICTIONARY\n  5\nD\n330\nC\n100\nAcDbDictionary\n281\n1\n"
               "  0\nACDBDICTIONARYWDFLT\n  5\nE\n330\nC\n100\nAcDbDictionary\n281\n1\n  3\nNormal\n350\nF\n"
               "100\nAcDbDictionaryWithDefault\n340\nF\n"
               "  0\nACDBPLACEHOLDER\n  5\nF\n330\nE\n"
               "  0\nENDSEC\n";
    }

    void entity(const char* type, std::string_view layer) {
        tag(0, type);
        tag(5, newHandle());
        tag(330, owner_);
        tag(100, "AcDbEntity");
        tag(8, layer);
    }

    void polyline(const std::vector<PlanePoint>& points, bool isClosed, std::string_view layer,
                  const illustrate::SectionComponent& component) {
        entity("LWPOLYLINE", layer);
        tag(100, "AcDbPolyline");
        tag(90, static_cast<int>(points.size()));
        tag(70, isClosed ? 1 : 0);
        number(43, 0);
        if (options_.world) number(38, elevation_);
        for (const PlanePoint p : points) point(10, flat(p));
        extrusion();
        extendedData(component);
    }

    // Id, area and its bound (m2), and whether it is exact (1) or drawn by voxels (0).
    void extendedData(const illustrate::SectionComponent& component) {
        tag(1001, "SVT");
        tag(1000, dxfText(volume_.labels.labels[component.label].id).substr(0, kMostCharacters));
        number(1040, component.area);
        number(1040, component.areaBound);
        tag(1070, component.isExact ? 1 : 0);
    }

    void lines(const illustrate::SectionComponent& component, std::string_view layer) {
        for (const illustrate::SectionLine& line : drawing_.lines) {
            if (line.label != component.label) continue;
            const bool isClosed = line.points.size() > 3 && line.points.front() == line.points.back();
            std::vector<PlanePoint> points = line.points;
            if (isClosed) points.pop_back();
            polyline(points, isClosed, layer, component);
        }
    }

    void beyond(const illustrate::BeyondLine& line) {
        const BeyondStyle& style = kBeyondStyles[static_cast<std::size_t>(line.kind)];
        entity("LINE", layerFor(style.layer, style.color, style.lineType, kBeyondWidth));
        tag(100, "AcDbLine");
        point(10, placed(line.from));
        point(11, placed(line.to));
        tag(1001, "SVT");
        tag(1000, dxfText(volume_.labels.labels[line.label].id).substr(0, kMostCharacters));
    }

    void text(PlanePoint at, double height, std::string_view content) {
        entity("TEXT", layerFor(options_.isoLayers ? isoLayerOf(DxfContent::Text) : "TEXT", 7));
        tag(100, "AcDbText");
        point(10, flat(at));
        number(30, elevation_);
        number(40, height);
        tag(1, content);
        if (turnDegrees_ != 0) number(50, turnDegrees_);
        tag(7, "SVT_NAMES");
        tag(72, 1);  // centred at the second point
        point(11, flat(at));
        number(31, elevation_);
        extrusion();
        tag(100, "AcDbText");
        tag(73, 2);
    }

    // The name of a layer, which is added to the table where it is new.
    const std::string& layerFor(const std::string& name, int color, const char* lineType = "Continuous",
                                int width = -3) {
        const auto known = std::ranges::find(layers_, name, &Layer::name);
        if (known != layers_.end()) return known->name;
        layers_.push_back({name, lineType, color, width});
        return layers_.back().name;
    }
    const std::string& layerOf(std::uint32_t label, DxfContent content) {
        const volume::Label& of = volume_.labels.labels[label];
        if (options_.isoLayers)
            return layerFor(isoLayerOf(of, content), content == DxfContent::Hatch ? 8 : colorOf(of.className));
        if (content == DxfContent::Hatch) return layerFor(dxfLayerOf(of) + "_HATCH", 8);
        return layerFor(dxfLayerOf(of), colorOf(of.className));
    }

    void entities() {
        section("ENTITIES");
        for (const illustrate::SectionComponent& component : drawing_.components)
            for (const illustrate::SectionPolygon& polygon : component.polygons) hatch(component.label, polygon);
        for (const illustrate::SectionComponent& component : drawing_.components) {
            const volume::Label& label = volume_.labels.labels[component.label];
            const std::string layer = layerOf(component.label, DxfContent::Element);
            for (const illustrate::SectionPolygon& polygon : component.polygons) {
                polyline(polygon.outer, true, layer, component);
                for (const illustrate::Ring& hole : polygon.holes) polyline(hole, true, layer, component);
            }
            if (component.lineLength > 0) lines(component, layer);
            if (component.polygons.empty()) continue;
            if (model::isSpace(label.className)) name(component, shownName(label));
        }
        for (const illustrate::BeyondLine& line : drawing_.beyond) beyond(line);
        for (const illustrate::DoorSwing& swing : drawing_.doors) door(swing);
        for (const DimensionMark& mark : dimensions_.marks) dimension(mark);
        endSection();
    }

    void hatch(std::uint32_t label, const illustrate::SectionPolygon& polygon) {
        const DxfHatch* const pattern = dxfHatchOf(style_.hatchOf(label));
        if (pattern == nullptr) return;
        entity("HATCH", layerOf(label, DxfContent::Hatch));
        tag(100, "AcDbHatch");
        point(10, Vec3d{0, 0, elevation_});
        point(210, options_.world ? normal_ : Vec3d{0, 0, 1});
        tag(2, pattern->name);
        tag(70, 0);  // a pattern
        tag(71, 0);
        tag(91, static_cast<int>(1 + polygon.holes.size()));
        const auto path = [&](const illustrate::Ring& ring, int kind) {
            tag(92, kind);
            tag(72, 0);
            tag(73, 1);
            tag(93, static_cast<int>(ring.size()));
            for (const PlanePoint p : ring) point(10, flat(p));
            tag(97, 0);
        };
        path(polygon.outer, 1 + 2);  // external, a polyline
        for (const illustrate::Ring& hole : polygon.holes) path(hole, 16 + 2);
        tag(75, 0);
        tag(76, 0);  // its own lines
        number(52, 0);
        number(41, 1);
        tag(77, 0);
        tag(78, static_cast<int>(pattern->lines.size()));
        for (const DxfHatchLine& line : pattern->lines) {
            const double angle = line.degrees * std::numbers::pi / 180;
            number(53, line.degrees);
            number(43, line.x);
            number(44, line.y);
            number(45, -line.distance * std::sin(angle));
            number(46, line.distance * std::cos(angle));
            tag(79, line.dash > 0 ? 2 : 0);
            if (line.dash > 0) {
                number(49, line.dash);
                number(49, -line.gap);
            }
        }
        tag(98, 0);
    }

    // A block with leaves and arcs about the first hinge, and where it is inserted.
    void door(const illustrate::DoorSwing& swing) {
        const std::string& layer = layerOf(swing.label, DxfContent::Element);
        const std::string inBlock = layer;
        Block block{newHandle(), newHandle(), newHandle(), fmt::format("DOOR_{}", ++doorCount_), {}, false};
        const PlanePoint base = flat(swing.lines.front().front());
        const auto local = [&](PlanePoint p) {
            const PlanePoint at = flat(p);
            return PlanePoint{at.u - base.u, at.v - base.v};
        };
        const std::string before = std::move(dxf_);
        dxf_.clear();
        owner_ = block.record;
        for (const auto& points : swing.lines)
            for (std::size_t n = 0; n + 1 < points.size(); ++n) {
                entity("LINE", inBlock);
                tag(100, "AcDbLine");
                point(10, local(points[n]));
                tag(30, "0");
                point(11, local(points[n + 1]));
                tag(31, "0");
            }
        for (const illustrate::DoorSwing::Arc& arc : swing.arcs) {
            const PlanePoint center = local(arc.center), from = local(arc.from), to = local(arc.to);
            const auto degrees = [&](PlanePoint p) {
                const double turn = std::atan2(p.v - center.v, p.u - center.u) * 180 / std::numbers::pi;
                return turn < -1e-9 ? turn + 360 : turn;
            };
            entity("ARC", inBlock);
            tag(100, "AcDbCircle");
            point(10, center);
            tag(30, "0");
            number(40, std::hypot(from.u - center.u, from.v - center.v));
            tag(100, "AcDbArc");
            number(50, degrees(from));
            number(51, degrees(to));
        }
        block.entities = std::move(dxf_);
        dxf_ = before;
        owner_ = "1A";
        entity("INSERT", inBlock);
        tag(100, "AcDbBlockReference");
        tag(2, block.name);
        point(10, base);
        number(30, elevation_);
        extrusion();
        tag(1001, "SVT");
        tag(1000, dxfText(volume_.labels.labels[swing.label].id).substr(0, kMostCharacters));
        blocks_.push_back(std::move(block));
    }

    [[nodiscard]] const std::string& dimensionLayer() {
        return layerFor(options_.isoLayers ? isoLayerOf(DxfContent::Dimension) : kDimensionLayer, 7, "Continuous", 13);
    }

    void line(const MarkLine& drawn) {
        entity("LINE", dimensionLayer());
        tag(100, "AcDbLine");
        point(10, placed(inMetres(drawn.from)));
        point(11, placed(inMetres(drawn.to)));
    }
    static PlanePoint inMetres(PlanePoint p) noexcept { return {p.u / kDimensionScale, p.v / kDimensionScale}; }

    // A DIMENSION, and the block that says how it looks, as programs write both.
    void dimension(const DimensionMark& mark) {
        Block block{newHandle(), newHandle(), newHandle(), fmt::format("*D{}", blocks_.size() + 1), {}, true};
        const std::string before = std::move(dxf_);
        dxf_.clear();
        owner_ = block.record;
        line(mark.line);
        for (const MarkLine& foot : mark.feet) line(foot);
        for (const MarkLine& tick : mark.ticks) line(tick);
        const bool isUpright = mark.line.from.u == mark.line.to.u;
        const PlanePoint middle =
            inMetres({0.5 * (mark.line.from.u + mark.line.to.u), 0.5 * (mark.line.from.v + mark.line.to.v)});
        const PlanePoint at = mark.text.text.empty() ? middle : inMetres(mark.text.at);
        if (!mark.text.text.empty()) dimensionNumber(mark, at);
        block.entities = std::move(dxf_);
        dxf_ = before;
        owner_ = "1A";
        entity("DIMENSION", dimensionLayer());
        tag(100, "AcDbDimension");
        tag(2, block.name);
        point(10, placed(inMetres(mark.line.to)));
        point(11, placed(at));
        tag(70, 32 + 128);  // linear; its block is its own; the place of the text is set
        tag(1, mark.text.text.empty() ? " " : dxfText(mark.text.text));
        tag(3, "Standard");
        tag(100, "AcDbAlignedDimension");
        point(13, placed(inMetres(mark.line.from)));
        point(14, placed(inMetres(mark.line.to)));
        number(50, (isUpright ? 90 : 0) + turnDegrees_);
        tag(100, "AcDbRotatedDimension");
        blocks_.push_back(std::move(block));
    }

    void dimensionNumber(const DimensionMark& mark, PlanePoint at) {
        entity("TEXT", dimensionLayer());
        tag(100, "AcDbText");
        point(10, flat(at));
        number(30, elevation_);
        number(40, 0.73 * mark.text.size / kDimensionScale);  // height of capitals
        tag(1, dxfText(mark.text.text));
        if (mark.text.isUpright || turnDegrees_ != 0) number(50, (mark.text.isUpright ? 90 : 0) + turnDegrees_);
        tag(7, "SVT_DIMENSIONS");
        tag(72, 1);  // centred on the baseline at the second point
        point(11, flat(at));
        number(31, elevation_);
        tag(100, "AcDbText");
        tag(73, 0);
    }

    void name(const illustrate::SectionComponent& component, const std::string& shown) {
        const auto& largest = *std::ranges::max_element(component.polygons, {}, &illustrate::SectionPolygon::area);
        const illustrate::TextPlace place = illustrate::findTextPlace(largest);
        const double height =
            std::min({0.25, place.height / 3, place.width / (0.8 * double(std::max<std::size_t>(shown.size(), 6)))});
        if (!(height > 0)) return;
        if (!isPlan(drawing_, volume_.grid)) {
            text(place.center, height, dxfText(shown));
            return;
        }
        text({place.center.u, place.center.v + 0.8 * height}, height, dxfText(shown));
        text({place.center.u, place.center.v - 0.8 * height}, height,
             dxfText(fmt::format("{:.2f} m\u00B2", component.area)));
    }

    struct Layer {
        std::string name;
        const char* lineType;
        int color, width;
    };
    const illustrate::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    DxfOptions options_;
    DrawingStyle style_;
    Vec3d normal_{0, 0, 1}, objectX_{1, 0, 0}, objectY_{0, 1, 0};
    double elevation_ = 0, turnDegrees_ = 0;
    int doorCount_ = 0;
    PlanePoint low_, high_;
    std::deque<Layer> layers_;  // in order of first use
    bool hasKind_[3] = {};      // of lines beyond the cut
    DimensionMarks dimensions_;
    std::vector<Block> blocks_;
    unsigned nextHandle_ = 0x100;
    std::string owner_ = "1A", dxf_;
};

}  // namespace

std::string makeDxf(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                    const DxfOptions& options) {
    return DxfWriter(drawing, volume, options).write();
}

Result<std::uint64_t> writeDxf(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                               const std::filesystem::path& path, const DxfOptions& options) {
    return writeFileAtomically(path, makeDxf(drawing, volume, options));
}

}  // namespace svt::writers
