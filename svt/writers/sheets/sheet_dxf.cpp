#include <svt/core/text.hpp>
#include <svt/drawing/building_crop.hpp>
#include <svt/writers/drawing/dxf_text.hpp>
#include <svt/writers/office_sheets.hpp>
#include <svt/writers/sheets/sheet_details.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>
#include <svt/writers/sheets/title_block.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr const char* kPaperSpace = "1B";  // handle of the block record, see DxfFile
constexpr const char* kSheetLayer = "SHEET";
constexpr const char* kViewportLayer = "VIEWPORTS";

// New handles behind those of a DXF.
class DxfHandles {
public:
    explicit DxfHandles(const std::string& dxf) {
        const std::string_view before = "$HANDSEED\n  5\n";
        const std::size_t at = dxf.find(before);
        if (at == std::string::npos) return;
        const char* const begin = dxf.data() + at + before.size();
        std::from_chars(begin, dxf.data() + dxf.size(), next_, 16);
        seedAt_ = at + before.size();
    }
    [[nodiscard]] std::string take() { return fmt::format("{:X}", next_++); }
    void writeSeed(std::string& dxf) const {
        dxf.replace(seedAt_, dxf.find('\n', seedAt_) - seedAt_, fmt::format("{:X}", next_));
    }

private:
    unsigned next_ = 0x100;
    std::size_t seedAt_ = 0;
};

// Draws onto paper space: millimetres, y upwards.
class DxfPaperCanvas : public SheetCanvas {
public:
    DxfPaperCanvas(double height, DxfHandles& handles) : height_(height), handles_(handles) {}

    void beginSheet(double, double, const std::string&) override {}
    void endSheet() override {}
    void beginLayer(std::string_view) override {}
    void endLayer() override {}
    // Black areas are arrowheads: their outline shows them. White ones hide what is below, which paper space cannot.
    void fill(const std::vector<PaperPath>& paths, std::string_view color) override {
        if (color == "#000000") stroke(paths, {0.18});
    }
    void hatch(const std::vector<PaperPath>& paths, const HatchTile&) override { stroke(paths, {0.18}); }

    void stroke(const std::vector<PaperPath>& paths, const LineStyle& style) override {
        for (const PaperPath& path : paths) {
            if (path.size() < 2) continue;
            const bool isClosed = path.size() > 3 && path.front().x == path.back().x && path.front().y == path.back().y;
            const std::size_t count = path.size() - (isClosed ? 1 : 0);
            begin("LWPOLYLINE", kSheetLayer);
            out_.add({{370, static_cast<int>(std::lround(style.width * 100))}, {100, "AcDbPolyline"}});
            out_.add({{90, static_cast<int>(count)}, {70, isClosed ? 1 : 0}, {43, 0}});
            for (std::size_t n = 0; n < count; ++n) out_.point(10, onPaper(path[n]));
        }
    }

    void text(const PaperText& text) override {
        constexpr double kCapitals = 0.73;  // of the font size
        const PlanePoint at = onPaper(text.at);
        const int anchor = text.anchor == TextAnchor::Start ? 0 : text.anchor == TextAnchor::Middle ? 1 : 2;
        begin("TEXT", kSheetLayer);
        out_.add({{100, "AcDbText"}});
        out_.point(10, at);
        out_.add({{30, 0}, {40, kCapitals * text.size}, {1, dxfText(text.text)}});
        if (text.isUpright) out_.add({{50, 90}});
        out_.add({{7, "SVT_NAMES"}, {72, anchor}});
        if (anchor != 0) out_.point(11, at);
        out_.add({{100, "AcDbText"}, {73, 0}});
    }

    // A view of model space. Number 1 is the sheet itself.
    void viewport(int number, PlanePoint center, double width, double height, PlanePoint viewed, double viewHeight) {
        begin("VIEWPORT", kViewportLayer);
        out_.add({{100, "AcDbViewport"}});
        out_.point(10, center);
        out_.add({{30, 0}, {40, width}, {41, height}, {68, number}, {69, number}});
        out_.point(12, viewed);
        out_.point(13, PlanePoint{0, 0});
        out_.point(14, PlanePoint{10, 10});
        out_.point(15, PlanePoint{10, 10});
        out_.point(16, Vec3d{0, 0, 1});
        out_.point(17, Vec3d{0, 0, 0});
        out_.add({{42, 50}, {43, 0}, {44, 0}, {45, viewHeight}, {50, 0}, {51, 0}, {72, 100}, {90, 32800}});
        out_.add({{1, ""}, {281, 0}, {71, 1}, {74, 0}});
        out_.point(110, Vec3d{0, 0, 0});
        out_.point(111, Vec3d{1, 0, 0});
        out_.point(112, Vec3d{0, 1, 0});
        out_.add({{79, 0}, {146, 0}});
    }

    [[nodiscard]] PlanePoint onPaper(PaperPoint p) const noexcept { return {p.x, height_ - p.y}; }
    [[nodiscard]] std::string take() { return out_.take(); }

private:
    void begin(const char* type, const char* layer) {
        out_.add({{0, type}, {5, handles_.take()}, {330, kPaperSpace}, {100, "AcDbEntity"}, {67, 1}, {8, layer}});
    }

    double height_;
    DxfHandles& handles_;
    DxfText out_;
};

// The object that makes a block a layout.
std::string layoutObject(const std::string& handle, const char* dictionary, const char* record, const std::string& name,
                         int order, const SheetPaper& paper) {
    const bool isModel = order == 0;
    DxfText out;
    out.add({{0, "LAYOUT"}, {5, handle}, {330, dictionary}, {100, "AcDbPlotSettings"}, {1, ""}, {2, "none_device"}});
    out.add({{4, isModel ? "" : fmt::format("ISO_{}_({:.2f}_x_{:.2f}_MM)", paper.name, paper.width, paper.height)}});
    out.add({{6, ""}, {40, 0}, {41, 0}, {42, 0}, {43, 0}, {44, paper.width}, {45, paper.height}});
    out.add({{46, 0}, {47, 0}, {48, 0}, {49, 0}, {140, 0}, {141, 0}, {142, 1}, {143, 1}});
    out.add({{70, isModel ? 1024 : 688}, {72, 1}, {73, 0}, {74, 5}, {7, ""}, {75, 16}, {147, 1}, {148, 0}, {149, 0}});
    out.add({{100, "AcDbLayout"}, {1, name}, {70, 1}, {71, order}});
    out.point(10, PlanePoint{0, 0});
    out.point(11, PlanePoint{paper.width, paper.height});
    out.point(12, Vec3d{0, 0, 0});
    out.point(14, Vec3d{0, 0, 0});
    out.point(15, Vec3d{paper.width, paper.height, 0});
    out.add({{146, 0}});
    out.point(13, Vec3d{0, 0, 0});
    out.point(16, Vec3d{1, 0, 0});
    out.point(17, Vec3d{0, 1, 0});
    out.add({{76, 0}, {330, record}});
    return out.take();
}

// Inserts text behind, or before, the first occurrence of another text that follows a mark.
void insertAt(std::string& dxf, std::string_view mark, std::string_view place, bool isBehind, std::string_view text) {
    const std::size_t begin = dxf.find(mark);
    const std::size_t at = begin == std::string::npos ? begin : dxf.find(place, begin);
    if (at != std::string::npos) dxf.insert(at + (isBehind ? place.size() : 0), text);
}

void addLayout(std::string& dxf, const std::string& entities, const std::string& name, const SheetPaper& paper,
               DxfHandles& handles) {
    const std::string dictionary = handles.take(), model = handles.take(), sheet = handles.take();
    DxfText layers, entry, objects;
    for (const auto& [layer, plots] : {std::pair(kSheetLayer, 1), std::pair(kViewportLayer, 0)}) {
        layers.add({{0, "LAYER"}, {5, handles.take()}, {330, "3"}, {100, "AcDbSymbolTableRecord"}});
        layers.add({{100, "AcDbLayerTableRecord"}, {2, layer}, {70, 0}, {62, 7}, {6, "Continuous"}});
        layers.add({{290, plots}, {370, 18}, {390, "F"}});
    }
    insertAt(dxf, "\n  2\nLAYER\n  5\n3\n", "  0\nENDTAB\n", false, layers.take());
    for (const auto& [block, layout] : {std::pair("*Model_Space", &model), std::pair("*Paper_Space", &sheet)}) {
        const std::string before = fmt::format("AcDbBlockTableRecord\n  2\n{}\n340\n", block);
        if (const std::size_t at = dxf.find(before + "0\n"); at != std::string::npos)
            dxf.replace(at + before.size(), 1, *layout);
    }
    insertAt(dxf, "  0\nSECTION\n  2\nENTITIES\n", "  0\nENDSEC\n", false, entities);
    entry.add({{3, "ACAD_LAYOUT"}, {350, dictionary}});
    insertAt(dxf, "  0\nSECTION\n  2\nOBJECTS\n", "AcDbDictionary\n281\n1\n", true, entry.take());
    objects.add({{0, "DICTIONARY"}, {5, dictionary}, {330, "C"}, {100, "AcDbDictionary"}, {281, 1}});
    objects.add({{3, "Model"}, {350, model}, {3, name}, {350, sheet}});
    insertAt(dxf, "  0\nSECTION\n  2\nOBJECTS\n", "  0\nENDSEC\n", false,
             objects.take() + layoutObject(model, dictionary.c_str(), "1A", "Model", 0, paper) +
                 layoutObject(sheet, dictionary.c_str(), kPaperSpace, name, 1, paper));
    handles.writeSeed(dxf);
}

void drawMarks(const ViewMarks& marks, const DrawingPlace& place, SheetCanvas& canvas) {
    const auto at = [&](PlanePoint p) { return place.onPaper({p.u / place.millimetres, p.v / place.millimetres}); };
    const auto draw = [&](const std::vector<MarkPath>& paths, double width) {
        for (const MarkPath& path : paths) {
            PaperPath points;
            for (const PlanePoint p : path) points.push_back(at(p));
            canvas.stroke({points}, {width});
        }
    };
    for (const MarkShapes& shapes : marks.layers) {
        if (shapes.layer == "Names" || shapes.layer == "Panes") continue;  // model space has them
        draw(shapes.thin, 0.13);
        draw(shapes.axes, 0.13);
        draw(shapes.filled, 0.13);
        draw(shapes.medium, 0.25);
        draw(shapes.bold, 0.5);
        for (const MarkText& text : shapes.texts)
            canvas.text({at(text.at), text.size, text.text, TextAnchor::Middle, false, text.isUpright});
    }
}

std::string titleOfView(const drawing::SheetView& view, SheetLanguage language) {
    if (view.kind == drawing::ViewKind::Elevation) return elevationText(view.name, language);
    if (view.kind == drawing::ViewKind::Section)
        return fmt::format("{0} {1}\u2013{1}", sheetWord(SheetWord::Section, language), view.name);
    return fmt::format("{} {}", sheetWord(SheetWord::Plan, language), view.name);
}

}  // namespace

Result<std::string> makeSheetDxf(const SheetContent& content, std::size_t view, const volume::SemanticVolume& volume,
                                 const SheetOptions& options, const DxfOptions& dxfOptions,
                                 std::span<const std::uint8_t> isAround) {
    const DrawnView& drawn = content.views[view];
    std::string dxf = makeDxf(drawn.drawing, volume, dxfOptions);
    if (dxfOptions.world) return dxf;
    SheetContent own;
    own.levels = content.levels;
    own.groups = content.groups;
    own.areas = content.areas;
    own.openings = content.openings;
    own.stairs = content.stairs;
    own.revisions = content.revisions;
    own.views.push_back(drawn);
    own.views.front().drawing = drawing::croppedToBuilding(drawn.drawing, isAround);
    SVT_TRY(layout, layOutSheets(own, options));
    if (layout->sheets.empty()) return dxf;  // nothing is drawn
    const Sheet& sheet = layout->sheets.front();
    const PlacedView& placed = sheet.views.front();
    const SheetPaper& paper = layout->paper;
    DxfHandles handles(dxf);
    DxfPaperCanvas canvas(paper.height, handles);
    const double mm = placed.place.millimetres;
    canvas.viewport(1, {0.5 * paper.width, 0.5 * paper.height}, paper.width, paper.height,
                    {0.5 * paper.width, 0.5 * paper.height}, paper.height);
    // The drawing with its dimensions.
    const ViewMargins& margins = placed.margins;
    const double left = placed.place.corner.x - margins.left - 2,
                 right = placed.place.corner.x + placed.width + margins.right + 2,
                 low = placed.place.corner.y + margins.below + 2,
                 top = placed.place.corner.y - placed.height - margins.above - 2;
    const PaperPoint middle{0.5 * (left + right), 0.5 * (low + top)};
    const PlanePoint viewed{placed.place.low.u + (middle.x - placed.place.corner.x) / mm,
                            placed.place.low.v + (placed.place.corner.y - middle.y) / mm};
    canvas.viewport(2, canvas.onPaper(middle), right - left, low - top, viewed, (low - top) / mm);
    canvas.stroke({{{paper.left, paper.top},
                    {paper.right, paper.top},
                    {paper.right, paper.bottom},
                    {paper.left, paper.bottom},
                    {paper.left, paper.top}}},
                  {0.7});
    const std::string title = titleOfView(drawn.view, options.language);
    drawMarks(marksOf({own, volume, options, own.views.front(), placed, *layout, sheet, {}}), placed.place, canvas);
    const ModelFacts facts = modelFacts(volume);
    const BlockContext block{own, volume, options, *layout, sheet, view, title, volume.source, facts};
    paintTitleBlock(block, canvas);
    paintLegend(block, canvas);
    paintRevisionList(block, canvas);
    canvas.text({{placed.place.corner.x, placed.place.corner.y + margins.below + 14}, 3.5, title});
    addLayout(dxf, canvas.take(), fmt::format("{} 1 to {:g}", paper.name, sheet.scale), paper, handles);
    return dxf;
}

}  // namespace svt::writers
