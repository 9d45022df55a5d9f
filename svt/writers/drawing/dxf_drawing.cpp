#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/dimension_marks.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/dxf_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

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
    // The looks of a dimension.
    struct DimensionBlock {
        std::string record, begin, end;  // handles
        std::string name, entities;
    };

public:
    DxfWriter(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume)
        : drawing_(drawing), volume_(volume) {
        double low = std::numeric_limits<double>::infinity();
        low_ = {low, low};
        high_ = {-low, -low};
        for (const auto& component : drawing.components)
            for (const auto& polygon : component.polygons)
                for (const PlanePoint p : polygon.outer) {
                    low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                    high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
                }
        for (const auto& line : drawing.lines)
            for (const PlanePoint p : line.points) {
                low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
            }
        for (const illustrate::BeyondLine& line : drawing.beyond) {
            for (const PlanePoint p : {line.from, line.to}) {
                low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
                high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
            }
            hasKind_[static_cast<std::size_t>(line.kind)] = true;
        }
        if (drawing.components.empty() && drawing.beyond.empty()) low_ = high_ = {};
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
        tag(999, dxfText(volume_.modelName.empty() ? volume_.source : volume_.modelName) + ", " +
                     planeText(drawing_, volume_.grid));
        tag(999, "world = origin + u * x + v * y, metres" +
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
        tag(9, "$EXTMIN");
        point(10, low_);
        tag(30, "0");
        tag(9, "$EXTMAX");
        point(10, high_);
        tag(30, "0");
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
             {std::pair(10, PlanePoint{0, 0}), std::pair(11, PlanePoint{1, 1}),
              std::pair(12, PlanePoint{0.5 * (low_.u + high_.u), 0.5 * (low_.v + high_.v)}),
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
        const auto kinds = static_cast<int>(std::count(std::begin(hasKind_), std::end(hasKind_), true));
        table("LAYER", "3", static_cast<int>(layers_.size()) + 2 + kinds + (blocks_.empty() ? 0 : 1));
        const auto layer = [&](std::string_view handle, std::string_view name, int color,
                               const char* lineType = "Continuous", int width = -3) {
            record("LAYER", handle, "3", "AcDbLayerTableRecord", name);
            tag(62, color);
            tag(6, lineType);
            tag(370, width);
            tag(390, "F");
        };
        layer("25", "0", 7);
        layer("26", "TEXT", 7);
        if (!blocks_.empty()) layer(newHandle(), kDimensionLayer, 7, "Continuous", 13);
        for (const auto& [name, className] : layers_) layer(newHandle(), name, colorOf(className));
        for (const BeyondStyle& style : kBeyondStyles)
            if (hasKind_[static_cast<std::size_t>(style.kind)])
                layer(newHandle(), style.layer, style.color, style.lineType, kBeyondWidth);
        endTable();
    }

    void textStyleTable() {
        table("STYLE", "4", 1);
        record("STYLE", "27", "4", "AcDbTextStyleTableRecord", "Standard");
        tag(40, "0");
        tag(41, "1");
        tag(50, "0");
        tag(71, 0);
        tag(42, "2.5");
        tag(3, "arial.ttf");
        tag(4, "");
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
        for (const DimensionBlock& block : blocks_) {
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
        addBlock({"1A", "2A", "2B", "*Model_Space", ""}, 0);
        addBlock({"1B", "2C", "2D", "*Paper_Space", ""}, 0);
        for (const DimensionBlock& block : blocks_) addBlock(block, 1);  // anonymous
        endSection();
    }

    void addBlock(const DimensionBlock& block, int flags) {
        tag(0, "BLOCK");
        tag(5, block.begin);
        tag(330, block.record);
        tag(100, "AcDbEntity");
        tag(8, "0");
        tag(100, "AcDbBlockBegin");
        tag(2, block.name);
        tag(70, flags);
        point(10, {0, 0});
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
        for (const PlanePoint p : points) point(10, p);
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
        entity("LINE", kBeyondStyles[static_cast<std::size_t>(line.kind)].layer);
        tag(100, "AcDbLine");
        point(10, line.from);
        tag(30, "0");
        point(11, line.to);
        tag(31, "0");
        tag(1001, "SVT");
        tag(1000, dxfText(volume_.labels.labels[line.label].id).substr(0, kMostCharacters));
    }

    void text(PlanePoint at, double height, std::string_view content) {
        entity("TEXT", "TEXT");
        tag(100, "AcDbText");
        point(10, at);
        tag(30, "0");
        number(40, height);
        tag(1, content);
        tag(72, 1);  // centred at the second point
        point(11, at);
        tag(31, "0");
        tag(100, "AcDbText");
        tag(73, 2);
    }

    void entities() {
        section("ENTITIES");
        for (const illustrate::ClassArea& group : drawing_.classes) {
            const std::string layer = plainName(group.className);
            if (std::ranges::find(layers_, layer, &Layer::name) == layers_.end())
                layers_.push_back({layer, group.className});
        }
        for (const illustrate::SectionComponent& component : drawing_.components) {
            const volume::Label& label = volume_.labels.labels[component.label];
            const std::string layer = plainName(label.className);
            for (const illustrate::SectionPolygon& polygon : component.polygons) {
                polyline(polygon.outer, true, layer, component);
                for (const illustrate::Ring& hole : polygon.holes) polyline(hole, true, layer, component);
            }
            if (component.lineLength > 0) lines(component, layer);
            if (component.polygons.empty()) continue;
            if (model::isSpace(label.className)) name(component, shownName(label));
        }
        for (const illustrate::BeyondLine& line : drawing_.beyond) beyond(line);
        for (const DimensionMark& mark : dimensions_.marks) dimension(mark);
        endSection();
    }

    void line(const MarkLine& drawn) {
        entity("LINE", kDimensionLayer);
        tag(100, "AcDbLine");
        point(10, inMetres(drawn.from));
        tag(30, "0");
        point(11, inMetres(drawn.to));
        tag(31, "0");
    }
    static PlanePoint inMetres(PlanePoint p) noexcept { return {p.u / kDimensionScale, p.v / kDimensionScale}; }

    // A DIMENSION, and the block that says how it looks, as programs write both.
    void dimension(const DimensionMark& mark) {
        DimensionBlock block{newHandle(), newHandle(), newHandle(), fmt::format("*D{}", blocks_.size() + 1), {}};
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
        entity("DIMENSION", kDimensionLayer);
        tag(100, "AcDbDimension");
        tag(2, block.name);
        point(10, inMetres(mark.line.to));
        tag(30, "0");
        point(11, at);
        tag(31, "0");
        tag(70, 32 + 128);  // linear; its block is its own; the place of the text is set
        tag(1, mark.text.text.empty() ? " " : dxfText(mark.text.text));
        tag(3, "Standard");
        tag(100, "AcDbAlignedDimension");
        point(13, inMetres(mark.line.from));
        tag(33, "0");
        point(14, inMetres(mark.line.to));
        tag(34, "0");
        tag(50, isUpright ? "90" : "0");
        tag(100, "AcDbRotatedDimension");
        blocks_.push_back(std::move(block));
    }

    void dimensionNumber(const DimensionMark& mark, PlanePoint at) {
        entity("TEXT", kDimensionLayer);
        tag(100, "AcDbText");
        point(10, at);
        tag(30, "0");
        number(40, 0.73 * mark.text.size / kDimensionScale);  // height of capitals
        tag(1, dxfText(mark.text.text));
        if (mark.text.isUpright) tag(50, "90");
        tag(72, 1);  // centred on the baseline at the second point
        point(11, at);
        tag(31, "0");
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
        std::string name, className;
    };
    const illustrate::SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    PlanePoint low_, high_;
    std::vector<Layer> layers_;
    bool hasKind_[3] = {};  // of lines beyond the cut
    DimensionMarks dimensions_;
    std::vector<DimensionBlock> blocks_;
    unsigned nextHandle_ = 0x100;
    std::string owner_ = "1A", dxf_;
};

}  // namespace

std::string makeDxf(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    return DxfWriter(drawing, volume).write();
}

Result<std::uint64_t> writeDxf(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                               const std::filesystem::path& path) {
    return writeFileAtomically(path, makeDxf(drawing, volume));
}

}  // namespace svt::writers
