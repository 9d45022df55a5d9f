#include <svt/samples/parts/openings.hpp>

#include <utility>

namespace svt::samples {
namespace {

constexpr Length kFrameFront = 120, kFrameBack = 190;  // depth of the window frame behind the outer face
constexpr Length kPaneFront = 143, kPaneBack = 167;
constexpr Length kFrameWidth = 60, kBarWidth = 50;
constexpr Length kJamb = 40, kLeaf = 45;

Solid& firstSolid(Plan& plan, int component) { return plan.components[std::size_t(component)].solids.front(); }

}  // namespace

Piece Opening::part(Length d0, Length d1, Length a0, Length a1, Length b0, Length b1) const {
    switch (normal) {
        case Normal::PlusX: return box(base + d0, base + d1, a0, a1, b0, b1);
        case Normal::MinusX: return box(base - d1, base - d0, a0, a1, b0, b1);
        case Normal::PlusY: return box(a0, a1, base + d0, base + d1, b0, b1);
        case Normal::MinusY: break;
    }
    return box(a0, a1, base - d1, base - d0, b0, b1);
}

Piece Opening::piece(Length d0, Length d1, Length sides, Length bottom, Length top) const {
    return part(d0, d1, along0 + sides, along1 - sides, z0 + bottom, z1 - top);
}

int addWindow(Plan& plan, int wall, int room, const Opening& opening, int columns, int rows, std::string id,
              std::string name) {
    const int window = addComponent(plan, Kind::Window, std::move(id), std::move(name), wall);
    Solid frame{Axis::X, Material::Paint, {opening.piece(kFrameFront, kFrameBack)}};
    Solid& space = firstSolid(plan, room);
    firstSolid(plan, wall).cut(opening.piece(0, opening.thickness));
    space.add(opening.piece(kFrameBack, opening.thickness));
    std::vector<Solid> panes;
    const Length width = opening.along1 - opening.along0 - 2 * kFrameWidth - (columns - 1) * kBarWidth;
    const Length height = opening.z1 - opening.z0 - 2 * kFrameWidth - (rows - 1) * kBarWidth;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            // The panes share the space inside the frame; in whole millimetres, the last one takes the remainder.
            const Length a0 = opening.along0 + kFrameWidth + column * (width / columns + kBarWidth);
            const Length a1 = column + 1 == columns ? opening.along1 - kFrameWidth : a0 + width / columns;
            const Length b0 = opening.z0 + kFrameWidth + row * (height / rows + kBarWidth);
            const Length b1 = row + 1 == rows ? opening.z1 - kFrameWidth : b0 + height / rows;
            frame.cut(opening.part(kFrameFront, kFrameBack, a0, a1, b0, b1));
            space.add(opening.part(kPaneBack, kFrameBack, a0, a1, b0, b1));
            panes.push_back({Axis::X, Material::Glass, {opening.part(kPaneFront, kPaneBack, a0, a1, b0, b1)}});
        }
    Component& component = plan.components[std::size_t(window)];
    component.storey = plan.components[std::size_t(wall)].storey;
    component.function = "window";
    component.attributes = {{"material", std::string("painted timber, insulating glass"), ""},
                            {"panes", std::int64_t(columns) * rows, ""}};
    component.solids.push_back(std::move(frame));
    for (Solid& pane : panes) component.solids.push_back(std::move(pane));
    return window;
}

int addDoor(Plan& plan, int wall, int room, const Opening& opening, std::string id, std::string name) {
    const int door = addComponent(plan, Kind::Door, std::move(id), std::move(name), wall);
    Solid frame{Axis::X, Material::Paint, {opening.piece(0, opening.thickness)}};
    frame.cut(opening.piece(0, opening.thickness, kJamb, 0, kJamb));
    firstSolid(plan, wall).cut(opening.piece(0, opening.thickness));
    firstSolid(plan, room).add(opening.piece(kLeaf, opening.thickness, kJamb, 0, kJamb));
    Component& component = plan.components[std::size_t(door)];
    component.storey = plan.components[std::size_t(wall)].storey;
    component.unit = plan.components[std::size_t(wall)].unit;
    component.function = "door";
    component.solids.push_back(std::move(frame));
    component.solids.push_back({Axis::X, Material::Timber, {opening.piece(0, kLeaf, kJamb, 0, kJamb)}});
    return door;
}

void addPassage(Plan& plan, int wall, int room, const Opening& opening) {
    firstSolid(plan, wall).cut(opening.piece(0, opening.thickness));
    firstSolid(plan, room).add(opening.piece(0, opening.thickness));
}

}  // namespace svt::samples
