#include <svt/writers/canvas/svg_canvas.hpp>

#include <svt/core/text.hpp>
#include <svt/writers/drawing/drawing_text.hpp>

#include <fmt/format.h>

namespace svt::writers {

void SvgCanvas::beginSheet(double width, double height, const std::string& title) {
    const std::string w = shortNumber(width, 3), h = shortNumber(height, 3);
    head_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    head_ += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
        "width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n<title>{2}</title>\n",
        w, h, xmlAttribute(title));
    head_ +=
        "<style>\ntext { font-family: 'DejaVu Sans', Verdana, sans-serif; fill: #000 }\n"
        ".halo { paint-order: stroke; stroke: #fff; stroke-width: 0.6; stroke-linejoin: round }\n"
        "path { stroke-linecap: round; stroke-linejoin: round }\n</style>\n";
    body_ = fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", w, h);
    hatches_.clear();
}

void SvgCanvas::endSheet() {
    if (hasWideLetters(body_))
        head_ +=
            "<style>text { font-family: 'DejaVu Sans', 'Noto Sans CJK JP', 'Noto Sans CJK SC', 'Noto Sans CJK KR', "
            "'Droid Sans Fallback', sans-serif }</style>\n";
    if (!hatches_.empty()) {
        head_ += "<defs>\n";
        for (const HatchTile& tile : hatchTiles())
            if (hatches_.contains(tile.hatch)) head_ += svgPattern(tile, true);
        head_ += "</defs>\n";
    }
    documents_.push_back(head_ + body_ + "</svg>\n");
}

void SvgCanvas::beginLayer(std::string_view name) {
    body_ += fmt::format("<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\">\n", xmlAttribute(name));
}
void SvgCanvas::endLayer() { body_ += "</g>\n"; }

void SvgCanvas::addPaths(const std::vector<PaperPath>& paths) {
    body_ += " d=\"";
    for (const PaperPath& path : paths) {
        const bool isClosed = path.size() > 2 && path.front().x == path.back().x && path.front().y == path.back().y;
        for (std::size_t n = 0; n < path.size() - (isClosed ? 1 : 0); ++n)
            body_ += (n == 0 ? "M" : n == 1 ? "L" : " ") + shortNumber(path[n].x, 3) + " " + shortNumber(path[n].y, 3);
        if (isClosed) body_ += 'Z';
    }
    body_ += "\"/>\n";
}

void SvgCanvas::fill(const std::vector<PaperPath>& paths, std::string_view color) {
    body_ += fmt::format("<path fill=\"{}\" fill-rule=\"evenodd\"", color);
    addPaths(paths);
}

void SvgCanvas::hatch(const std::vector<PaperPath>& paths, const HatchTile& tile) {
    hatches_.insert(tile.hatch);
    body_ += fmt::format("<path fill=\"url(#{})\" fill-rule=\"evenodd\"", nameOf(tile.hatch));
    addPaths(paths);
}

void SvgCanvas::stroke(const std::vector<PaperPath>& paths, const LineStyle& style) {
    if (paths.empty()) return;
    std::string dashes;
    for (const double dash : dashesOf(style.type))
        dashes += (dashes.empty() ? "" : " ") + shortNumber(dash * style.width, 3);
    if (!dashes.empty()) dashes = fmt::format(" stroke-dasharray=\"{}\" style=\"stroke-linecap: butt\"", dashes);
    body_ +=
        fmt::format("<path fill=\"none\" stroke=\"#000\" stroke-width=\"{}\"{}", shortNumber(style.width, 3), dashes);
    addPaths(paths);
}

void SvgCanvas::text(const PaperText& text) {
    const char* anchor = text.anchor == TextAnchor::Start ? ""
                         : text.anchor == TextAnchor::End ? " text-anchor=\"end\""
                                                          : " text-anchor=\"middle\"";
    const std::string x = shortNumber(text.at.x, 3), y = shortNumber(text.at.y, 3);
    const std::string turn = text.isUpright ? fmt::format(" transform=\"rotate(-90 {} {})\"", x, y) : std::string();
    body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}{}>{}</text>\n", x, y, shortNumber(text.size, 2),
                         anchor, text.hasHalo ? " class=\"halo\"" : "", turn, xmlAttribute(text.text));
}

}  // namespace svt::writers
