#include <svt/writers/drawing/dxf_file.hpp>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr const char* kObjects =
    "  0\nSECTION\n  2\nOBJECTS\n"
    "  0\nDICTIONARY\n  5\nC\n330\n0\n100\nAcDbDictionary\n281\n1\n  3\nACAD_GROUP\n350\nD\n"
    "  3\nACAD_PLOTSTYLENAME\n350\nE\n"
    "  0\nDICTIONARY\n  5\nD\n330\nC\n100\nAcDbDictionary\n281\n1\n"
    "  0\nACDBDICTIONARYWDFLT\n  5\nE\n330\nC\n100\nAcDbDictionary\n281\n1\n  3\nNormal\n350\nF\n"
    "100\nAcDbDictionaryWithDefault\n340\nF\n"
    "  0\nACDBPLACEHOLDER\n  5\nF\n330\nE\n"
    "  0\nENDSEC\n";

}  // namespace

DxfBlock DxfFile::newBlock(std::string name, bool isAnonymous) {
    return {newHandle(), newHandle(), newHandle(), std::move(name), {}, isAnonymous};
}

const std::string& DxfFile::layer(const std::string& name, int color, const char* lineType, int width) {
    const auto known = std::ranges::find(layers_, name, &Layer::name);
    if (known != layers_.end()) return known->name;
    layers_.push_back({name, lineType, color, width});
    return layers_.back().name;
}

std::string DxfFile::write(std::span<const std::string> comments, const DxfView& view, std::string_view entities) {
    // The header contains the next free handle, so it is written last.
    tables(view);
    out_.add({{0, "SECTION"}, {2, "BLOCKS"}});
    block({kModelSpace, "2A", "2B", "*Model_Space"});
    block({"1B", "2C", "2D", "*Paper_Space"});
    for (const DxfBlock& some : blocks_) block(some);
    out_.add({{0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}});
    out_.append(entities);
    out_.add({{0, "ENDSEC"}});
    const std::string body = out_.take();
    header(comments, view);
    return out_.take() + body + kObjects + "  0\nEOF\n";
}

void DxfFile::header(std::span<const std::string> comments, const DxfView& view) {
    for (const std::string& comment : comments) out_.add({{999, comment}});
    out_.add({{0, "SECTION"}, {2, "HEADER"}});
    out_.add({{9, "$ACADVER"}, {1, "AC1015"}, {9, "$DWGCODEPAGE"}, {3, "ANSI_1252"}});
    out_.add({{9, "$HANDSEED"}, {5, fmt::format("{:X}", nextHandle_)}});
    out_.add({{9, "$INSUNITS"}, {70, "6"}});     // metres
    out_.add({{9, "$MEASUREMENT"}, {70, "1"}});  // metric
    out_.add({{9, "$LUNITS"}, {70, "2"}});       // decimal
    const auto &a = view.low, &b = view.high;
    out_.add({{9, "$EXTMIN"}});
    out_.point(10, Vec3d{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)});
    out_.add({{9, "$EXTMAX"}});
    out_.point(10, Vec3d{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
    out_.add({{0, "ENDSEC"}, {0, "SECTION"}, {2, "CLASSES"}, {0, "ENDSEC"}});
}

void DxfFile::table(const char* name, const char* handle, int count) {
    out_.add({{0, "TABLE"}, {2, name}, {5, handle}, {330, "0"}, {100, "AcDbSymbolTable"}, {70, count}});
}

void DxfFile::record(const char* type, std::string_view handle, const char* owner, const char* subclass,
                     std::string_view name) {
    out_.add({{0, type},
              {std::string_view(type) == "DIMSTYLE" ? 105 : 5, handle},
              {330, owner},
              {100, "AcDbSymbolTableRecord"},
              {100, subclass},
              {2, name},
              {70, 0}});
}

void DxfFile::tables(const DxfView& view) {
    const DxfGroup end{0, "ENDTAB"};
    out_.add({{0, "SECTION"}, {2, "TABLES"}});
    viewportTable(view);
    lineTypeTable();
    layerTable();
    textStyleTable();
    table("VIEW", "5", 0);
    out_.add({end});
    table("UCS", "6", 0);
    out_.add({end});
    table("APPID", "7", 2);
    record("APPID", "28", "7", "AcDbRegAppTableRecord", "ACAD");
    record("APPID", "2E", "7", "AcDbRegAppTableRecord", "SVT");
    out_.add({end});
    table("DIMSTYLE", "8", 1);
    out_.add({{100, "AcDbDimStyleTable"}});
    record("DIMSTYLE", "29", "8", "AcDbDimStyleTableRecord", "Standard");
    out_.add({end});
    blockRecordTable();
    out_.add({{0, "ENDSEC"}});
}

// The view that a program shows first: all of the drawing.
void DxfFile::viewportTable(const DxfView& view) {
    table("VPORT", "1", 1);
    record("VPORT", "21", "1", "AcDbViewportTableRecord", "*Active");
    const PlanePoint zero{0, 0}, one{1, 1};
    out_.point(10, zero);
    out_.point(11, one);
    out_.point(12, PlanePoint{view.center.x, view.center.y});
    out_.point(13, zero);
    for (const int code : {14, 15}) out_.point(code, one);
    out_.point(16, zero);
    out_.add({{36, "1"}});
    out_.point(17, zero);
    const double width = std::max(view.width, 1.0), height = std::max(view.height, 1.0);
    out_.add({{37, "0"}, {40, 1.1 * std::max(height, width / 1.5)}, {41, 1.5}, {42, 50.0}, {0, "ENDTAB"}});
}

void DxfFile::lineTypeTable() {
    table("LTYPE", "2", 3 + static_cast<int>(lineTypes_.size()));
    const auto add = [&](std::string_view handle, const DxfLineType& type) {
        double length = 0;
        for (const double dash : type.dashes) length += std::abs(dash);
        record("LTYPE", handle, "2", "AcDbLinetypeTableRecord", type.name);
        out_.add({{3, type.words}, {72, 65}, {73, static_cast<int>(type.dashes.size())}, {40, length}});
        for (const double dash : type.dashes) out_.add({{49, dash}, {74, 0}});
    };
    add("22", {"ByBlock", "", {}});
    add("23", {"ByLayer", "", {}});
    add("24", {"Continuous", "", {}});
    for (const DxfLineType& type : lineTypes_) add(newHandle(), type);
    out_.add({{0, "ENDTAB"}});
}

void DxfFile::layerTable() {
    table("LAYER", "3", static_cast<int>(layers_.size()) + 1);
    const auto add = [&](std::string_view handle, const Layer& layer) {
        record("LAYER", handle, "3", "AcDbLayerTableRecord", layer.name);
        out_.add({{62, layer.color}, {6, layer.lineType}, {370, layer.width}, {390, "F"}});
    };
    add("25", {"0", "Continuous", 7, -3});
    for (const Layer& layer : layers_) add(newHandle(), layer);
    out_.add({{0, "ENDTAB"}});
}

void DxfFile::textStyleTable() {
    table("STYLE", "4", 3);
    for (const auto& [handle, name] :
         {std::pair("27", "Standard"), std::pair("2F", "SVT_NAMES"), std::pair("30", "SVT_DIMENSIONS")}) {
        record("STYLE", handle, "4", "AcDbTextStyleTableRecord", name);
        out_.add({{40, "0"}, {41, "1"}, {50, "0"}, {71, 0}, {42, "2.5"}, {3, "arial.ttf"}, {4, ""}});
    }
    out_.add({{0, "ENDTAB"}});
}

void DxfFile::blockRecordTable() {
    table("BLOCK_RECORD", "9", 2 + static_cast<int>(blocks_.size()));
    const auto add = [&](std::string_view handle, std::string_view name) {
        out_.add({{0, "BLOCK_RECORD"}, {5, handle}, {330, "9"}, {100, "AcDbSymbolTableRecord"}});
        out_.add({{100, "AcDbBlockTableRecord"}, {2, name}, {340, "0"}});
    };
    add(kModelSpace, "*Model_Space");
    add("1B", "*Paper_Space");
    for (const DxfBlock& block : blocks_) add(block.record, block.name);
    out_.add({{0, "ENDTAB"}});
}

void DxfFile::block(const DxfBlock& block) {
    out_.add({{0, "BLOCK"}, {5, block.begin}, {330, block.record}, {100, "AcDbEntity"}, {8, "0"}});
    out_.add({{100, "AcDbBlockBegin"}, {2, block.name}, {70, block.isAnonymous ? 1 : 0}});
    out_.point(10, PlanePoint{0, 0});
    out_.add({{30, "0"}, {3, block.name}, {1, ""}});
    out_.append(block.entities);
    out_.add({{0, "ENDBLK"}, {5, block.end}, {330, block.record}, {100, "AcDbEntity"}, {8, "0"}});
    out_.add({{100, "AcDbBlockEnd"}});
}

}  // namespace svt::writers
