#include <svt/samples/ifc/ifc_layers.hpp>

#include <algorithm>
#include <cmath>

namespace svt::samples {
namespace {

using Color = std::array<double, 3>;

constexpr Color kPlaster{0.93, 0.92, 0.89}, kWool{0.93, 0.82, 0.45}, kBrick{0.76, 0.46, 0.36}, kGray{0.66, 0.66, 0.64},
    kTimber{0.72, 0.53, 0.33}, kScreed{0.78, 0.76, 0.70}, kBoard{0.92, 0.91, 0.88}, kTiles{0.70, 0.22, 0.16};

std::vector<LayerSpec> exteriorWall(double thickness, Material core) {
    const bool isBrick = core != Material::Concrete;
    return {{"exterior plaster", "Finish", 15, kPlaster},
            {"mineral wool insulation", "Insulation", 120, kWool},
            {isBrick ? "brick masonry" : "concrete", "LoadBearing", thickness - 150, isBrick ? kBrick : kGray},
            {"interior plaster", "Finish", 15, kPlaster}};
}

std::vector<LayerSpec> innerWall(double thickness, Material core) {
    if (core == Material::Gypsum)
        return {{"gypsum board", "Finish", 12.5, kBoard},
                {"mineral wool insulation", "Insulation", thickness - 25, kWool},
                {"gypsum board", "Finish", 12.5, kBoard}};
    const bool isBrick = core != Material::Concrete;
    return {{"interior plaster", "Finish", 15, kPlaster},
            {isBrick ? "brick masonry" : "concrete", "LoadBearing", thickness - 30, isBrick ? kBrick : kGray},
            {"interior plaster", "Finish", 15, kPlaster}};
}

// From the top downwards.
std::vector<LayerSpec> slab(double thickness, const Component& component) {
    if (component.solids.front().material == Material::Timber)
        return {{"timber boards", "Finish", 25, kTimber},
                {"mineral wool insulation", "Insulation", thickness - 50, kWool},
                {"timber boards", "Finish", 25, kTimber}};
    const double insulation = component.hullPart == HullPart::Ground ? 60 : 20;
    return {{"screed", "Finish", 50, kScreed},
            {"EPS insulation", "Insulation", insulation, kWool},
            {"reinforced concrete", "LoadBearing", thickness - 50 - insulation, kGray}};
}

// Whether a face of the component that looks along `normal` lies outside.
bool isOutside(const Plan& plan, const Component& component, Vec3d normal) {
    for (const Face& face : component.shells.front().faces)
        if (face.neighbor < 0 && dot(normalized(normalOf(plan, face)), normal) > 0.99) return true;
    return false;
}

LayeredBody wall(const Plan& plan, const Component& component) {
    LayeredBody body;
    const Solid& solid = component.solids.front();
    Solid first{solid.axis, solid.material, {solid.pieces.front()}};
    const Vec3d low = boundsOf(first).min, size = boundsOf(first).size();
    const bool isAlongX = size.x > size.y;
    const double thickness = std::min(size.x, size.y);
    if (thickness < 50 || thickness > 500 || solid.axis != Axis::X) return body;
    body.isWall = true;
    body.length = std::max(size.x, size.y);
    body.frame.x = isAlongX ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    body.frame.y = isAlongX ? Vec3d{0, 1, 0} : Vec3d{-1, 0, 0};
    // The face of the smaller y of the wall's own axes.
    const Vec3d right = isAlongX ? low : low + Vec3d{thickness, 0, 0};
    const bool isLeftOutside = isOutside(plan, component, body.frame.y);
    const bool isRightOutside = isOutside(plan, component, -body.frame.y);
    if (thickness >= 250 && isLeftOutside != isRightOutside) {
        // The reference line runs along the outer face.
        body.layers = exteriorWall(thickness, solid.material);
        body.isPositive = isRightOutside;
        body.frame.origin = isRightOutside ? right : right + body.frame.y * thickness;
        return body;
    }
    body.layers = innerWall(thickness, solid.material);
    body.frame.origin = right + body.frame.y * (thickness / 2);
    body.offset = -thickness / 2;
    return body;
}

// Layers along the normal of the slope, from below.
LayeredBody slope(const Component& component) {
    LayeredBody body;
    const Solid& solid = component.solids.front();
    const Piece& piece = solid.pieces.front();
    const auto top = std::find_if(piece.sides.begin(), piece.sides.end(),
                                  [](const HalfPlane& side) { return side.up > 0 && side.across != 0; });
    if (top == piece.sides.end() || solid.axis != Axis::X) return body;
    const auto bottom = std::find_if(piece.sides.begin(), piece.sides.end(), [&](const HalfPlane& side) {
        return side.up == -top->up && side.across == -top->across;
    });
    if (bottom == piece.sides.end()) return body;
    const double size = std::hypot(double(top->across), double(top->up));
    const Vec3d normal{0, double(top->across) / size, double(top->up) / size};
    const double thickness = double(top->limit + bottom->limit) / size;
    if (thickness < 150) return body;
    body.frame = {{1, 0, 0}, cross(normal, Vec3d{1, 0, 0}), normal, {0, 0, 0}};
    body.frame.origin = {double(piece.from), 0, -double(bottom->limit) / double(top->up)};
    body.layers = {{"timber boards", "Finish", 20, kTimber},
                   {"mineral wool insulation", "Insulation", thickness - 70, kWool},
                   {"roof tiles", "Cladding", 50, kTiles}};
    return body;
}

}  // namespace

LayeredBody layersOf(const Plan& plan, const Component& component) {
    LayeredBody body;
    if (component.kind != Kind::Element || component.solids.size() != 1 || component.shells.empty()) return body;
    if (component.function == "wall") return wall(plan, component);
    if (component.function == "roof") return slope(component);
    if (component.function != "slab") return body;
    const Solid& solid = component.solids.front();
    const Box3d bounds = boundsOf(Solid{solid.axis, solid.material, {solid.pieces.front()}});
    const double thickness = bounds.size().z;
    if (thickness < 150) return body;
    body.frame.origin = {bounds.min.x, bounds.min.y, bounds.max.z};
    body.isPositive = false;
    body.layers = slab(thickness, component);
    return body;
}

}  // namespace svt::samples
