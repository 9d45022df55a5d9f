#pragma once
/// \file
/// Sheets as SVG, one document each, with layers that Inkscape knows.

#include <svt/drawing/hatches.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>

#include <set>

namespace svt::writers {

class SvgCanvas : public SheetCanvas {
public:
    void beginSheet(double width, double height, const std::string& title) override;
    void endSheet() override;
    void beginLayer(std::string_view name) override;
    void endLayer() override;
    void fill(const std::vector<PaperPath>& paths, std::string_view color) override;
    void hatch(const std::vector<PaperPath>& paths, const HatchTile& tile) override;
    void stroke(const std::vector<PaperPath>& paths, const LineStyle& style) override;
    void text(const PaperText& text) override;

    /// The documents of all finished sheets.
    [[nodiscard]] std::vector<std::string> takeDocuments() { return std::move(documents_); }

private:
    void addPaths(const std::vector<PaperPath>& paths);

    std::string head_, body_;
    std::set<render::Hatch> hatches_;
    std::vector<std::string> documents_;
};

}  // namespace svt::writers
