#include <svt/writers/canvas/recorded_sheet.hpp>

namespace svt::writers {

void RecordedSheet::beginSheet(double width, double height, const std::string& title) {
    calls_.emplace_back(SheetBegin{width, height, title});
}
void RecordedSheet::endSheet() { calls_.emplace_back(SheetEnd{}); }
void RecordedSheet::beginLayer(std::string_view name) { calls_.emplace_back(LayerBegin{std::string(name)}); }
void RecordedSheet::endLayer() { calls_.emplace_back(LayerEnd{}); }
void RecordedSheet::fill(const std::vector<PaperPath>& paths, std::string_view color) {
    calls_.emplace_back(Fill{paths, std::string(color)});
}
void RecordedSheet::hatch(const std::vector<PaperPath>& paths, const HatchTile& tile) {
    calls_.emplace_back(HatchFill{paths, tile});
}
void RecordedSheet::stroke(const std::vector<PaperPath>& paths, const LineStyle& style) {
    calls_.emplace_back(Stroke{paths, style});
}
void RecordedSheet::text(const PaperText& text) { calls_.emplace_back(text); }

void RecordedSheet::drawOn(SheetCanvas& canvas) const {
    struct Player {
        SheetCanvas& canvas;
        void operator()(const SheetBegin& call) const { canvas.beginSheet(call.width, call.height, call.title); }
        void operator()(const SheetEnd&) const { canvas.endSheet(); }
        void operator()(const LayerBegin& call) const { canvas.beginLayer(call.name); }
        void operator()(const LayerEnd&) const { canvas.endLayer(); }
        void operator()(const Fill& call) const { canvas.fill(call.paths, call.color); }
        void operator()(const HatchFill& call) const { canvas.hatch(call.paths, call.tile); }
        void operator()(const Stroke& call) const { canvas.stroke(call.paths, call.style); }
        void operator()(const PaperText& text) const { canvas.text(text); }
    };
    for (const Call& call : calls_) std::visit(Player{canvas}, call);
}

}  // namespace svt::writers
