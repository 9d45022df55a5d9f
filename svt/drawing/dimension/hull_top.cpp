#include <svt/drawing/hull_top.hpp>

#include <svt/drawing/dimension/part_roles.hpp>

#include <algorithm>

namespace svt::drawing {

HullTop::HullTop(const volume::LabelTable& table) {
    for (const PartRole role : partRoles(table))
        parts_.push_back(role == PartRole::Space ? Part::Space : role == PartRole::Hull ? Part::Hull : Part::Other);
}

std::optional<double> HullTop::of(const SectionDrawing& drawing) const {
    double hull = -kInfinity, any = -kInfinity;
    const auto add = [&](std::uint32_t label, const std::vector<PlanePoint>& points) {
        if (parts_[label] == Part::Space) return;
        for (const PlanePoint p : points) {
            any = std::max(any, p.v);
            if (parts_[label] == Part::Hull) hull = std::max(hull, p.v);
        }
    };
    for (const SectionComponent& component : drawing.components)
        for (const SectionPolygon& polygon : component.polygons) add(component.label, polygon.outer);
    for (const SectionLine& line : drawing.lines) add(line.label, line.points);
    for (const BeyondLine& line : drawing.beyond)
        if (line.kind == BeyondKind::Visible) add(line.label, {line.from, line.to});
    const double top = hull > -kInfinity ? hull : any;
    return top > -kInfinity ? std::optional(top) : std::nullopt;
}

}  // namespace svt::drawing
