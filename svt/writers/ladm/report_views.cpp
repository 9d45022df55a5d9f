#include <svt/writers/ladm/report_views.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/canvas/drawing_painter.hpp>
#include <svt/writers/drawing/drawing_style.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace svt::writers {
namespace {

constexpr const char* kLit = "#ffd27f";
constexpr Vec3d kLitColor{255, 190, 90};
constexpr double kViewTitle = 5;   // millimetres below a view, for its title
constexpr double kCutAbove = 1.1;  // metres above the lowest point

// The largest standard scale at which a drawing fits.
double scaleFor(double width, double height, double paperWidth, double paperHeight) {
    constexpr double kSteps[] = {1, 2, 2.5, 5};
    double ten = 10;
    for (int power = 1; power < 9; ++power, ten *= 10)
        for (const double step : kSteps) {
            const double scale = step * ten, millimetres = 1000 / scale;
            if (width * millimetres <= paperWidth && height * millimetres <= paperHeight) return scale;
        }
    return 1e9;
}

PaperPath outlinePath(const drawing::Ring& ring, const DrawingPlace& place) {
    PaperPath path;
    for (const drawing::PlanePoint p : ring) path.push_back(place.onPaper(p));
    if (!path.empty()) path.push_back(path.front());
    return path;
}

std::string litColor(double light) {
    const auto part = [&](double value) {
        return static_cast<int>(std::lround(std::clamp(value * light, 0.0, 255.0)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", part(kLitColor.x), part(kLitColor.y), part(kLitColor.z));
}

}  // namespace

Result<ReportViews> ReportViews::make(const analyze::LegalSpaces& spaces, std::uint32_t space,
                                      const volume::SemanticVolume& volume, int threads) {
    ReportViews views(volume);
    const analyze::LegalSpace& unit = spaces.spaces[space];
    views.extent_ = analyze::Extents(volume.labels).of(unit.label);
    const std::array<Vec3d, 3>& axes = volume.grid.axes();
    const Vec3d size = unit.box.size();
    Vec3d low = unit.box.center();
    low.z = unit.box.min.z + std::min(kCutAbove, 0.5 * size.z);
    drawing::SectionOptions options;
    options.threads = threads;
    SVT_TRY(plan, drawing::drawSection(volume, drawing::SectionPlane{axes[2], low}, options));
    views.plan_ = std::move(*plan);
    // Seen from the long side: from the south, or from the east.
    const Vec3d toViewer = size.x >= size.y ? -axes[1] : axes[0];
    SVT_TRY(section, drawing::drawSection(volume, drawing::SectionPlane{toViewer, unit.box.center()}, options));
    views.section_ = std::move(*section);
    return views;
}

void ReportViews::paint(const drawing::SectionDrawing& drawing, const char* title, const PaperBox& box,
                        SheetCanvas& canvas) const {
    const auto [low, high] = drawnBox(drawing);
    const double width = high.u - low.u, height = high.v - low.v;
    if (width <= 0 || height <= 0) return;
    const double scale = scaleFor(width, height, box.right - box.left, box.bottom - box.top - kViewTitle);
    DrawingPlace place;
    place.low = low;
    place.millimetres = 1000 / scale;
    place.corner = {box.left + 0.5 * (box.right - box.left - width * place.millimetres),
                    box.bottom - kViewTitle - 0.5 * (box.bottom - box.top - kViewTitle - height * place.millimetres)};
    std::vector<PaperPath> lit;
    for (const drawing::SectionComponent& component : drawing.components) {
        if (!std::binary_search(extent_.begin(), extent_.end(), component.label)) continue;
        for (const drawing::SectionPolygon& polygon : component.polygons) {
            lit.push_back(outlinePath(polygon.outer, place));
            for (const drawing::Ring& hole : polygon.holes) lit.push_back(outlinePath(hole, place));
        }
    }
    canvas.beginLayer("Unit");
    if (!lit.empty()) canvas.fill(lit, kLit);
    canvas.endLayer();
    paintDrawing(drawing, volume_, place, canvas);
    canvas.beginLayer("Text");
    canvas.text({{box.left, box.bottom}, 2.6, fmt::format("{} 1:{:g}", title, scale)});
    canvas.endLayer();
}

void paintUnitInLines(const analyze::LegalSpaces& spaces, std::uint32_t space, const drawing::LineView& view,
                      const PaperBox& box, SheetCanvas& canvas) {
    const drawing::PlaneAxes& axes = view.drawing.axes;
    const auto [low, high] = drawnBox(view.drawing);
    const double width = high.u - low.u, height = high.v - low.v;
    if (width <= 0 || height <= 0) return;
    DrawingPlace place;
    place.low = low;
    place.millimetres = std::min((box.right - box.left) / width, (box.bottom - box.top - kViewTitle) / height);
    place.corner = {box.left + 0.5 * (box.right - box.left - width * place.millimetres),
                    box.bottom - kViewTitle - 0.5 * (box.bottom - box.top - kViewTitle - height * place.millimetres)};
    struct ShownFace {
        double depth;
        std::vector<PaperPath> rings;
        std::string color;
    };
    std::vector<ShownFace> shown;
    for (const analyze::BoundaryFace& face : spaces.faces) {
        if (face.minus != space && face.plus != space) continue;
        const Vec3d outward = face.minus == space ? face.normal : -face.normal;
        const double towards = dot(outward, axes.normal);
        if (towards <= 1e-6) continue;
        ShownFace& item = shown.emplace_back();
        item.depth = 0;
        for (const auto& ring : face.rings) {
            drawing::Ring flat;
            for (const Vec3d& p : ring) flat.push_back(axes.planeFromWorld(p));
            item.rings.push_back(outlinePath(flat, place));
        }
        for (const Vec3d& p : face.rings.front())
            item.depth += dot(p - axes.origin, axes.normal) / double(face.rings.front().size());
        item.color = litColor(0.6 + 0.4 * std::max(outward.z, 0.0) + 0.2 * std::abs(outward.x));
    }
    std::stable_sort(shown.begin(), shown.end(),
                     [](const ShownFace& a, const ShownFace& b) { return a.depth < b.depth; });
    canvas.beginLayer("Unit");
    for (const ShownFace& face : shown) canvas.fill(face.rings, face.color);
    canvas.endLayer();
    canvas.beginLayer("Building");
    std::vector<PaperPath> lines;
    for (const drawing::BeyondLine& line : view.drawing.beyond)
        if (line.kind == drawing::BeyondKind::Visible)
            lines.push_back({place.onPaper(line.from), place.onPaper(line.to)});
    canvas.stroke(lines, {0.09});
    canvas.endLayer();
    canvas.beginLayer("Text");
    canvas.text({{box.left, box.bottom}, 2.6, "Unit in the lines of the building"});
    canvas.endLayer();
}

}  // namespace svt::writers
