#pragma once
/// \file
/// A sheet that is painted once and drawn in several formats.

#include <svt/writers/canvas/sheet_canvas.hpp>

#include <string>
#include <variant>
#include <vector>

namespace svt::writers {

/// Records the calls of a canvas. It keeps a copy of all paths and texts in memory.
class RecordedSheet : public SheetCanvas {
public:
    void beginSheet(double width, double height, const std::string& title) override;
    void endSheet() override;
    void beginLayer(std::string_view name) override;
    void endLayer() override;
    void fill(const std::vector<PaperPath>& paths, std::string_view color) override;
    void hatch(const std::vector<PaperPath>& paths, const HatchTile& tile) override;
    void stroke(const std::vector<PaperPath>& paths, const LineStyle& style) override;
    void text(const PaperText& text) override;

    /// Repeats all calls, in their order.
    void drawOn(SheetCanvas& canvas) const;

private:
    struct SheetBegin {
        double width, height;
        std::string title;
    };
    struct SheetEnd {};
    struct LayerBegin {
        std::string name;
    };
    struct LayerEnd {};
    struct Fill {
        std::vector<PaperPath> paths;
        std::string color;
    };
    struct HatchFill {
        std::vector<PaperPath> paths;
        HatchTile tile;
    };
    struct Stroke {
        std::vector<PaperPath> paths;
        LineStyle style;
    };
    using Call = std::variant<SheetBegin, SheetEnd, LayerBegin, LayerEnd, Fill, HatchFill, Stroke, PaperText>;

    std::vector<Call> calls_;
};

}  // namespace svt::writers
