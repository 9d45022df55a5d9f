#include <svt/writers/sheets/title_block.hpp>

#include <svt/analyze/stated_facts.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

namespace svt::writers {
namespace {

using render::Hatch;

constexpr LineStyle kBlockEdge{0.35}, kBlockLine{0.18};

// A text in a field: smaller where it is too long, then shortened.
void writeFitted(SheetCanvas& canvas, PaperPoint at, double size, double width, const std::string& text) {
    constexpr double kLeast = 1.8;
    const double wide = widthOnPaper(text, size);
    if (wide > width) size = std::max(std::min(size, kLeast), size * width / wide);
    canvas.text({at, size, shortened(text, size, width)});
}

std::string documentTypeOf(const BlockContext& context) {
    if (!context.options.block.documentType.empty()) return context.options.block.documentType;
    const SheetWord word = !context.sheet.tables.empty()                      ? SheetWord::ScheduleType
                           : context.sheet.kind == drawing::ViewKind::Plan    ? SheetWord::FloorPlan
                           : context.sheet.kind == drawing::ViewKind::Section ? SheetWord::Section
                                                                              : SheetWord::ElevationType;
    return std::string(sheetWord(word, context.options.language));
}

std::vector<Hatch> usedHatches(const BlockContext& context) {
    std::vector<Hatch> used;
    for (const PlacedView& placed : context.sheet.views) {
        const drawing::SectionDrawing& drawing = context.content.views[placed.view].drawing;
        const DrawingStyle style(drawing, context.volume, placed.place.millimetres);
        for (const drawing::SectionComponent& component : drawing.components) {
            if (component.polygons.empty() || style.isSpace(component.label)) continue;
            const Hatch hatch = style.hatchOf(component.label);
            if (hatch != Hatch::None && std::find(used.begin(), used.end(), hatch) == used.end()) used.push_back(hatch);
        }
    }
    std::sort(used.begin(), used.end());
    return used;
}

}  // namespace

ModelFacts modelFacts(const volume::SemanticVolume& volume) {
    ModelFacts facts;
    for (const volume::Label& label : volume.labels.labels) {
        if (facts.project.empty()) facts.project = analyze::statedText(label, "projectName");
        if (analyze::isPlaceholder(facts.project)) facts.project.clear();
        const std::string address = analyze::postalAddress(label);
        if (label.className == "Building") {
            std::string name = label.name;
            if (name.empty() || analyze::isPlaceholder(name)) name = analyze::statedText(label, "longName");
            if (!name.empty() && !analyze::isPlaceholder(name) && facts.building.size() < 500)
                facts.building += (facts.building.empty() ? "" : ", ") + name;
        }
        if (facts.address.empty()) facts.address = address;
    }
    if (facts.project.empty())
        facts.project = analyze::isPlaceholder(shownName(volume)) ? volume.source : shownName(volume);
    return facts;
}

void paintTitleBlock(const BlockContext& context, SheetCanvas& canvas) {
    const SheetPaper& paper = context.layout.paper;
    const SheetLanguage language = context.options.language;
    const drawing::TitleBlock& block = context.options.block;
    const double left = paper.right - SheetPaper::kTitleWidth, top = paper.bottom - SheetPaper::kTitleHeight;
    const ModelFacts& facts = context.facts;
    canvas.stroke({{{left, paper.bottom}, {left, top}, {paper.right, top}}}, kBlockEdge);
    const auto field = [&](double column, double width, double row, double size, std::string_view heading,
                           const std::string& text) {
        const double x = left + column, y = top + row;
        if (row > 0) canvas.stroke({{{x, y}, {x + width, y}}}, kBlockLine);
        if (column > 0) canvas.stroke({{{x, y}, {x, y + (row == 0 ? 12 : 8)}}}, kBlockLine);
        canvas.text({{x + 1.5, y + 2.4}, 1.6, std::string(heading)});
        writeFitted(canvas, {x + 1.5, y + 3.3 + size * 1.25}, size, width - 3, text.empty() ? "\u2013" : text);
    };
    const auto word = [&](SheetWord w) { return sheetWord(w, language); };
    const auto office = [&](SheetWord w) { return sheetWord(w, language); };
    const std::string place =
        facts.building + (facts.building.empty() || facts.address.empty() ? "" : ", ") + facts.address;
    const std::string scale = context.sheet.views.empty() ? std::string(word(SheetWord::NoScale))
                                                          : fmt::format("1:{}", shortNumber(context.sheet.scale, 2));
    const std::string number = block.number.empty() ? "" : fmt::format("{}-{}", block.number, context.number + 1);
    field(0, 135, 0, 5, office(SheetWord::Project),
          context.options.title.empty() ? facts.project : context.options.title);
    field(135, 45, 0, 5, word(SheetWord::Scale), scale);
    field(0, 90, 12, 2.8, word(SheetWord::Drawing), context.title);
    field(90, 45, 12, 2.8, office(SheetWord::DocumentType), documentTypeOf(context));
    field(135, 45, 12, 2.8, office(SheetWord::DrawingNumber), number);
    field(0, 90, 20, 2.5, office(SheetWord::BuildingAddress), place);
    field(90, 45, 20, 2.5, word(SheetWord::Model), context.source);
    field(135, 22.5, 20, 2.5, word(SheetWord::Sheet),
          fmt::format("{} {} {}", context.number + 1, word(SheetWord::SheetOf), context.layout.sheets.size()));
    field(157.5, 22.5, 20, 2.5, word(SheetWord::Paper), paper.name);
    field(0, 45, 28, 2.5, office(SheetWord::Owner), block.owner);
    field(45, 45, 28, 2.5, office(SheetWord::Creator), block.creator);
    field(90, 45, 28, 2.5, office(SheetWord::Approver), block.approver);
    field(135, 22.5, 28, 2.5, office(SheetWord::Revision), block.revision);
    field(157.5, 22.5, 28, 2.5, office(SheetWord::Date), block.date);
}

void paintLegend(const BlockContext& context, SheetCanvas& canvas) {
    constexpr double kSwatch = 7, kHigh = 3.4, kRow = 5.2, kColumn = 41, kText = 2;  // millimetres
    constexpr double kBesideBar = 95, kBesideNorth = 32;                             // of the strip beside the block
    const std::vector<Hatch> used = usedHatches(context);
    if (used.empty()) return;
    const SheetPaper& paper = context.layout.paper;
    const double blockTop = paper.bottom - SheetPaper::kTitleHeight;
    const double right = paper.right - SheetPaper::kTitleWidth - kBesideNorth;
    // Beside the block, or, on narrow paper, above it: see SheetPaper::legend.
    const bool isBeside = right - (paper.left + kBesideBar) >= kColumn;
    const double left = paper.left + (isBeside ? kBesideBar : 8);
    const double width = (isBeside ? right : paper.right) - left;
    const double top = isBeside ? blockTop + 6 : blockTop - paper.legend + 4;
    const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>(width / kColumn));
    canvas.text({{left, top - 1.2}, 1.6, std::string(sheetWord(SheetWord::Legend, context.options.language))});
    for (std::size_t n = 0; n < used.size(); ++n) {
        const std::size_t row = n / columns;
        const double x = left + kColumn * static_cast<double>(n % columns), y = top + kRow * static_cast<double>(row);
        const PaperPath box{{x, y}, {x + kSwatch, y}, {x + kSwatch, y + kHigh}, {x, y + kHigh}, {x, y}};
        const auto tiles = hatchTiles();
        const auto tile =
            std::find_if(tiles.begin(), tiles.end(), [&](const HatchTile& t) { return t.hatch == used[n]; });
        if (tile != tiles.end()) canvas.hatch({box}, *tile);
        canvas.stroke({box}, kBlockLine);
        canvas.text(
            {{x + kSwatch + 1.5, y + 2.4},
             kText,
             shortened(std::string(hatchWord(used[n], context.options.language)), kText, kColumn - kSwatch - 3)});
    }
}

}  // namespace svt::writers
