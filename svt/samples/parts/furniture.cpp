#include <svt/samples/parts/furniture.hpp>

#include <utility>

namespace svt::samples {
namespace {

Solid solidOf(Material material, std::vector<Piece> pieces) { return {Axis::X, material, std::move(pieces)}; }

// A plate on four legs.
Solid tableSolid(Length width, Length depth, Length height, Length plate, Length leg) {
    Solid solid = solidOf(Material::Timber, {box(0, width, 0, depth, height - plate, height)});
    for (const Length x : {Length{30}, width - 30 - leg})
        for (const Length y : {Length{30}, depth - 30 - leg}) solid.add(box(x, x + leg, y, y + leg, 0, height - plate));
    return solid;
}

Solid chairSolid() {
    Solid solid = solidOf(Material::Timber, {box(0, 450, 0, 450, 430, 470)});
    for (const Length x : {0, 410})
        for (const Length y : {0, 410}) solid.add(box(x, x + 40, y, y + 40, 0, 430));
    return solid.add(box(0, 450, 410, 450, 470, 900)).cut(box(60, 390, 410, 450, 520, 640));
}

Solid seatSolid(Length width) {
    return solidOf(Material::Fabric, {box(0, width, 0, 850, 100, 420), box(0, width, 620, 850, 420, 800),
                                      box(0, 180, 0, 620, 420, 600), box(width - 180, width, 0, 620, 420, 600),
                                      box(40, 120, 40, 120, 0, 100), box(width - 120, width - 40, 40, 120, 0, 100),
                                      box(40, 120, 730, 810, 0, 100), box(width - 120, width - 40, 730, 810, 0, 100)});
}

Solid shelfSolid() {
    Solid solid = solidOf(Material::Timber, {box(0, 1200, 0, 320, 0, 2000)});
    for (Length level = 0; level < 5; ++level)
        solid.cut(box(30, 1170, 0, 300, 60 + level * 390, 60 + level * 390 + 350));
    return solid;
}

Solid bedSolid(Length width) {
    Solid solid = solidOf(Material::Timber, {box(0, width, 0, 2040, 120, 300), box(0, width, 2000, 2040, 300, 950)});
    for (const Length x : {Length{0}, width - 80})
        for (const Length y : {0, 1960}) solid.add(box(x, x + 80, y, y + 80, 0, 120));
    solid.add(box(40, width - 40, 40, 2000, 300, 480));
    const int pillows = width > 1200 ? 2 : 1;
    for (int i = 0; i < pillows; ++i) {
        const Length x = 100 + i * (width - 100) / 2;
        solid.add(box(x, x + (width - 100) / pillows - 100, 1550, 1950, 480, 580));
    }
    return solid;
}

}  // namespace

Solid furnitureSolid(Item item) {
    switch (item) {
        case Item::Table: return tableSolid(1800, 900, 750, 40, 80);
        case Item::Chair: return chairSolid();
        case Item::CoffeeTable: return tableSolid(1100, 600, 420, 40, 60);
        case Item::Sofa: return seatSolid(2200);
        case Item::Armchair: return seatSolid(950);
        case Item::Shelf: return shelfSolid();
        case Item::Sideboard:
            return solidOf(Material::Timber, {box(0, 1600, 0, 420, 100, 700), box(60, 1540, 40, 380, 0, 100)});
        case Item::Counter:
            return solidOf(Material::Timber, {box(0, 2600, 60, 600, 0, 100), box(0, 2600, 20, 600, 100, 870),
                                              box(0, 2600, 0, 600, 870, 910)})
                .cut(box(1600, 2200, 100, 500, 740, 910));
        case Item::Fridge: return solidOf(Material::Steel, {box(0, 600, 0, 620, 0, 1850)});
        case Item::Wardrobe:
            return solidOf(Material::Timber, {box(0, 1800, 0, 600, 0, 2050)}).cut(box(40, 1760, 0, 20, 80, 2010));
        case Item::Bed: return bedSolid(1000);
        case Item::DoubleBed: return bedSolid(1800);
        case Item::Desk:
            return solidOf(Material::Timber, {box(0, 1400, 0, 700, 710, 740), box(0, 400, 60, 660, 0, 710),
                                              box(1340, 1400, 60, 660, 0, 710)});
        case Item::Bathtub:
            return solidOf(Material::Ceramic, {box(0, 1700, 0, 750, 0, 560)}).cut(box(80, 1620, 80, 670, 150, 560));
        case Item::Basin:
            return solidOf(Material::Ceramic, {box(150, 350, 120, 400, 0, 700), box(0, 500, 0, 400, 700, 850)})
                .cut(box(60, 440, 60, 300, 760, 850));
        case Item::Toilet:
            return solidOf(Material::Ceramic, {box(60, 340, 120, 560, 0, 200), box(20, 380, 0, 560, 200, 420),
                                               box(0, 400, 560, 700, 200, 820)})
                .cut(box(90, 310, 80, 450, 300, 420));
        case Item::WashingMachine: break;
    }
    return solidOf(Material::Steel, {box(0, 600, 30, 600, 0, 850), box(150, 450, 0, 30, 300, 600)});
}

Solid placed(const Solid& solid, int quarterTurns, Point shift) {
    Solid result = solid;
    for (Piece& piece : result.pieces) {
        Length x0 = piece.from, x1 = piece.to, y1 = piece.sides[0].limit, y0 = -piece.sides[1].limit;
        const Length z1 = piece.sides[2].limit, z0 = -piece.sides[3].limit;
        for (int turn = 0; turn < quarterTurns; ++turn) {
            const Length nextX0 = -y1, nextX1 = -y0;
            y0 = x0;
            y1 = x1;
            x0 = nextX0;
            x1 = nextX1;
        }
        const bool adds = piece.adds;
        piece = box(x0 + shift.x, x1 + shift.x, y0 + shift.y, y1 + shift.y, z0 + shift.z, z1 + shift.z);
        piece.adds = adds;
    }
    return result;
}

int addFurniture(Plan& plan, int room, Item item, Length x, Length y, Length z, int quarterTurns, std::string id,
                 std::string name, bool isInstance) {
    const int furniture = addComponent(plan, Kind::Furniture, std::move(id), std::move(name), room);
    Component& component = plan.components[std::size_t(furniture)];
    component.storey = plan.components[std::size_t(room)].storey;
    component.unit = plan.components[std::size_t(room)].unit;
    component.function = "furniture";
    const Solid local = furnitureSolid(item);
    const Vec3d corner = boundsOf(placed(local, quarterTurns, {})).min;
    const Point shift{x - Length(corner.x), y - Length(corner.y), z};
    component.solids.push_back(placed(local, quarterTurns, shift));
    if (isInstance) component.instance = Instance{local, quarterTurns, shift, {}, {}};
    return furniture;
}

}  // namespace svt::samples
