#include <svt/drawing/sheet_set.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace svt::drawing {
namespace {

// A plane along an axis of the grid as parseSectionPlane() reads it, to a hundredth of a millimetre.
std::string planeOfAxis(const SectionPlane& plane, const volume::Grid& grid) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = dot(plane.normal, grid.axes()[axis]);
        if (std::abs(along) < 1 - 1e-9) continue;
        const double at = dot(plane.point - grid.origin(), grid.axes()[axis]);
        return fmt::format("{}{}{:.5f}", "xyz"[axis], along > 0 ? '>' : '<', at);
    }
    const Vec3d n = plane.normal;
    return fmt::format("{:.9f},{:.9f},{:.9f},{:.6f}", n.x, n.y, n.z, -dot(n, plane.point - grid.origin()));
}

Result<SheetView> viewOf(const SetView& view, const SheetSet& set, const volume::SemanticVolume& volume,
                         const std::vector<BuildingLevel>& levels) {
    SheetView made;
    made.name = view.name;
    made.beyond = {.visible = true, .hidden = view.hidden, .above = false};
    if (!view.elevation.empty()) {
        SVT_TRY(plane, elevationPlane(view.elevation, volume));
        made.kind = ViewKind::Elevation;
        made.name = view.elevation;
        made.plane = *plane;
        return made;
    }
    const bool isPlan = !view.plan.empty();
    SVT_TRY(plane, parseSectionPlane(isPlan ? view.plan : view.section, volume));
    const Vec3d up = volume.grid.axes()[2];
    const double upright = dot(plane->normal, up);
    if (isPlan ? std::abs(upright) < 1 - 1e-9 : std::abs(upright) > 1 - 1e-9)
        return Error(Code::BadSection,
                     fmt::format("the plane '{}' is {}", isPlan ? view.plan : view.section,
                                 isPlan ? "not horizontal; give it as a section" : "horizontal; give it as a plan"));
    made.kind = isPlan ? ViewKind::Plan : ViewKind::Section;
    made.plane = *plane;
    if (!isPlan) return made;
    made.beyond.above = set.above;
    const double at = dot(plane->point - volume.grid.origin(), up);
    for (const BuildingLevel& level : levels)
        if (level.floor <= at) made.floor = level.floor;
    return made;
}

}  // namespace

SheetSet sheetSetOf(const SheetViews& views, const volume::SemanticVolume& volume) {
    SheetSet set;
    ViewKind last = ViewKind::Plan;
    for (const SheetView& view : views.views) {
        if (set.sheets.empty() || view.kind != last) set.sheets.emplace_back();
        last = view.kind;
        SetView written;
        if (view.kind == ViewKind::Plan) written.plan = planeOfAxis(view.plane, volume.grid);
        if (view.kind == ViewKind::Section) written.section = planeOfAxis(view.plane, volume.grid);
        if (view.kind == ViewKind::Elevation)
            written.elevation = view.name;
        else
            written.name = view.name;
        set.sheets.back().views.push_back(std::move(written));
    }
    return set;
}

Result<SheetViews> viewsOfSet(const SheetSet& set, const volume::SemanticVolume& volume) {
    SheetViews views;
    views.levels = findLevels(volume);
    for (const SetSheet& sheet : set.sheets)
        for (const SetView& view : sheet.views) {
            SVT_TRY(made, viewOf(view, set, volume, views.levels));
            views.views.push_back(std::move(*made));
        }
    return views;
}

}  // namespace svt::drawing
