// The furnished house. README.md shows the plan; the section along y is
//
//                      8010  ridge
//                    . /\ .            roof slabs 250 thick (vertical), rafters 200 below them
//               7760 ./__\. 7496       ridge beam below the rafters
//                   /      \ .
//        5560 ___ ./________\. ___     attic floor 5360..5560
//                /|          |\ .
//        4160 _./ |          | \._     underside of the roof at the outer face of the walls
//             ' |_|__________|_| '
//        2960   |_|__________|_|       intermediate slab 2760..2960
//               | |          | |
//           0 __|_|__________|_|__     ground slab -250..0
//               0           9000
#include <svt/samples/designs/designs.hpp>
#include <svt/samples/parts/furniture.hpp>
#include <svt/samples/parts/openings.hpp>

#include <string>
#include <utility>

namespace svt::samples {
namespace {
namespace house {

constexpr Length kWidth = 11000, kDepth = 9000, kWall = 365;
constexpr Length kEast = kWidth - kWall, kNorth = kDepth - kWall;  // inner faces
constexpr Length kCeiling = 2760, kUpper = 2960, kUpperCeiling = 5360, kAttic = 5560;
constexpr Length kEaves = 4160, kRidge = kDepth / 2;
constexpr Length kRoofThickness = 250, kRafterDepth = 200;  // vertical
constexpr Length kSpine0 = 4620, kSpine1 = 4860;            // load-bearing wall along the house

// Below the underside of the roof raised by `lift`: 5 z - 4 y <= 5 (eaves + lift) on the south side.
HalfPlane southBelow(Length lift) { return {-4, 5, 5 * (kEaves + lift)}; }
HalfPlane northBelow(Length lift) { return {4, 5, 5 * (kEaves + lift) + 4 * kDepth}; }
HalfPlane above(HalfPlane below) { return {-below.across, -below.up, -below.limit}; }

// A box cut off by the underside of the roof.
Piece roofedBox(Length x0, Length x1, Length y0, Length y1, Length z0, Length z1) {
    Piece piece = box(x0, x1, y0, y1, z0, z1);
    piece.sides.push_back(southBelow(0));
    piece.sides.push_back(northBelow(0));
    return piece;
}

// A prism between two planes parallel to one side of the roof.
Piece roofPiece(bool isSouth, Length x0, Length x1, Length y0, Length y1, Length low, Length high) {
    const HalfPlane top = isSouth ? southBelow(high) : northBelow(high);
    const HalfPlane bottom = above(isSouth ? southBelow(low) : northBelow(low));
    if (!isSouth) {
        std::swap(y0, y1);
        y0 = kDepth - y0;
        y1 = kDepth - y1;
    }
    return {x0, x1, {{1, 0, y1}, {-1, 0, -y0}, top, bottom}, true};
}

class HouseDesign {
public:
    Plan build() {
        storeys();
        structure();
        roof();
        rooms();
        fitRoofAndChimney();
        groundOpenings();
        upperOpenings();
        roofWindow(true, bedroom2_, 4750, "roof_window_bedroom2", "Roof window bedroom 2");
        roofWindow(false, gallery_, 5540, "roof_window_gallery", "Roof window gallery");
        hatch();
        stair();
        outside();
        groundFurniture();
        upperFurniture();
        resolve(plan_);
        return std::move(plan_);
    }

private:
    Component& at(int component) { return plan_.components[std::size_t(component)]; }
    Solid& solid(int component) { return at(component).solids.front(); }

    void storeys() {
        ground_ = addComponent(plan_, Kind::Storey, "storey_0", "Ground floor");
        upper_ = addComponent(plan_, Kind::Storey, "storey_1", "Upper floor");
        attic_ = addComponent(plan_, Kind::Storey, "storey_2", "Attic");
        at(ground_).attributes = {{"elevation", 0.0, "m"}};
        at(upper_).attributes = {{"elevation", double(kUpper) / 1000, "m"}};
        at(attic_).attributes = {{"elevation", double(kAttic) / 1000, "m"}};
    }

    int element(int storey, std::string id, std::string name, std::string function, Material material, Piece piece,
                HullPart part, bool isLoadBearing) {
        return addElement(plan_, storey, std::move(id), std::move(name), std::move(function), material,
                          std::move(piece), part, isLoadBearing);
    }

    int brick(int storey, std::string id, std::string name, Piece piece) {
        return element(storey, std::move(id), std::move(name), "wall", Material::Brick, std::move(piece),
                       HullPart::Wall, true);
    }
    int gypsum(int storey, std::string id, std::string name, Piece piece) {
        return element(storey, std::move(id), std::move(name), "wall", Material::Gypsum, std::move(piece),
                       HullPart::Wall, false);
    }

    int room(int storey, std::string id, std::string name, std::string function, Piece piece) {
        return addRoom(plan_, storey, std::move(id), std::move(name), std::move(function), std::move(piece));
    }

    void structure() {
        element(ground_, "ground_slab", "Ground slab", "slab", Material::Concrete, box(0, kWidth, 0, kDepth, -250, 0),
                HullPart::Ground, true);
        southWall_ =
            brick(ground_, "wall_south_0", "Exterior wall south, ground floor", box(0, kWidth, 0, kWall, 0, kCeiling));
        northWall_ = brick(ground_, "wall_north_0", "Exterior wall north, ground floor",
                           box(0, kWidth, kNorth, kDepth, 0, kCeiling));
        westWall_ = brick(ground_, "wall_west_0", "Exterior wall west, ground floor",
                          box(0, kWall, kWall, kNorth, 0, kCeiling));
        eastWall_ = brick(ground_, "wall_east_0", "Exterior wall east, ground floor",
                          box(kEast, kWidth, kWall, kNorth, 0, kCeiling));
        spine0_ = brick(ground_, "wall_spine_0", "Spine wall, ground floor",
                        box(kWall, kEast, kSpine0, kSpine1, 0, kCeiling));
        kitchenWall_ = gypsum(ground_, "wall_kitchen", "Wall between living room and kitchen",
                              box(7200, 7315, kWall, kSpine0, 0, kCeiling));
        studyWall_ = gypsum(ground_, "wall_study", "Wall of the study", box(2600, 2715, kSpine1, kNorth, 0, kCeiling));
        serviceWall_ = gypsum(ground_, "wall_service", "Wall of WC and utility room",
                              box(8900, 9015, kSpine1, kNorth, 0, kCeiling));
        gypsum(ground_, "wall_wc", "Wall between WC and utility room", box(9015, kEast, 6385, 6500, 0, kCeiling));
        beam_ = element(ground_, "hidden_beam", "Hidden beam", "beam", Material::Steel,
                        box(3580, 3820, 250, 4735, 2510, kCeiling), HullPart::Slab, true);
        element(ground_, "suspended_ceiling", "Suspended ceiling", "covering", Material::Gypsum,
                box(kWall, 7200, kWall, kSpine0, 2450, 2475), HullPart::Slab, false);
        slab_ = element(upper_, "slab_1", "Intermediate slab", "slab", Material::Concrete,
                        box(0, kWidth, 0, kDepth, kCeiling, kUpper), HullPart::Slab, true);
        solid(slab_).cut(box(4610, 7850, kSpine1, 5860, kCeiling, kUpper));
        for (const int bearing : {southWall_, spine0_}) solid(bearing).cut(solid(beam_).pieces.front());

        const Length high = 8000;  // upper bound; the roof cuts these off earlier
        southKnee_ = brick(upper_, "wall_south_1", "Exterior wall south, upper floor",
                           roofedBox(kWall, kEast, 0, kWall, kUpper, high));
        northKnee_ = brick(upper_, "wall_north_1", "Exterior wall north, upper floor",
                           roofedBox(kWall, kEast, kNorth, kDepth, kUpper, high));
        westGable_ = brick(upper_, "wall_west_1", "Gable wall west", roofedBox(0, kWall, 0, kDepth, kUpper, high));
        eastGable_ = brick(upper_, "wall_east_1", "Gable wall east", roofedBox(kEast, kWidth, 0, kDepth, kUpper, high));
        spine1_ = brick(upper_, "wall_spine_1", "Spine wall, upper floor",
                        box(kWall, kEast, kSpine0, kSpine1, kUpper, kUpperCeiling));
        gypsum(upper_, "wall_bedrooms_12", "Wall between bedrooms 1 and 2",
               roofedBox(3640, 3755, kWall, kSpine0, kUpper, kUpperCeiling));
        gypsum(upper_, "wall_bedrooms_23", "Wall between bedrooms 2 and 3",
               roofedBox(7200, 7315, kWall, kSpine0, kUpper, kUpperCeiling));
        bathWall_ = gypsum(upper_, "wall_bath", "Wall of the bath",
                           roofedBox(2600, 2715, kSpine1, kNorth, kUpper, kUpperCeiling));
        dressingWall_ = gypsum(upper_, "wall_dressing", "Wall of the dressing room",
                               roofedBox(8900, 9015, kSpine1, kNorth, kUpper, kUpperCeiling));
        atticFloor_ = element(attic_, "attic_floor", "Attic floor", "slab", Material::Timber,
                              roofedBox(kWall, kEast, kWall, kNorth, kUpperCeiling, kAttic), HullPart::Slab, true);
        chimney_ = brick(attic_, "chimney", "Chimney", box(7315, 7815, 3300, 3800, 0, 8700));
        at(chimney_).function = "chimney";
    }

    void roof() {
        for (const bool isSouth : {true, false}) {
            const std::string side = isSouth ? "south" : "north";
            (isSouth ? southRoof_ : northRoof_) =
                element(attic_, "roof_" + side, "Roof slab " + side, "roof", Material::RoofTiles,
                        roofPiece(isSouth, -400, kWidth + 400, -600, kRidge, 0, kRoofThickness), HullPart::Roof, true);
            // One rafter outside each gable, thirteen between them.
            for (int k = 0; k < 15; ++k) {
                const Length center = k == 0 ? -300 : k == 14 ? kWidth + 300 : 760 + 790 * (k - 1);
                rafters_.push_back(element(attic_, "rafter_" + side + "_" + std::to_string(k + 1),
                                           "Rafter " + side + " " + std::to_string(k + 1), "rafter", Material::Timber,
                                           roofPiece(isSouth, center - 40, center + 40, -520, kRidge, -kRafterDepth, 0),
                                           HullPart::Roof, true));
            }
        }
        ridgeBeam_ = element(attic_, "ridge_beam", "Ridge beam", "beam", Material::Timber,
                             box(-360, kWidth + 360, kRidge - 80, kRidge + 80, 7256, 7496), HullPart::Roof, true);
    }

    void rooms() {
        living_ = room(ground_, "living", "Living room", "living", box(kWall, 7200, kWall, kSpine0, 0, 2450));
        ceilingVoid_ =
            room(ground_, "ceiling_void", "Ceiling void", "void", box(kWall, 7200, kWall, kSpine0, 2475, kCeiling));
        kitchen_ = room(ground_, "kitchen", "Kitchen", "kitchen", box(7315, kEast, kWall, kSpine0, 0, kCeiling));
        study_ = room(ground_, "study", "Study", "work", box(kWall, 2600, kSpine1, kNorth, 0, kCeiling));
        hall_ = room(ground_, "hall", "Hall", "circulation", box(2715, 8900, kSpine1, kNorth, 0, kCeiling));
        utility_ = room(ground_, "utility", "Utility room", "utility", box(9015, kEast, kSpine1, 6385, 0, kCeiling));
        wc_ = room(ground_, "wc", "WC", "sanitary", box(9015, kEast, 6500, kNorth, 0, kCeiling));
        const auto upperRoom = [&](std::string id, std::string name, std::string function, Length x0, Length x1,
                                   Length y0, Length y1) {
            return room(upper_, std::move(id), std::move(name), std::move(function),
                        roofedBox(x0, x1, y0, y1, kUpper, kUpperCeiling));
        };
        bedroom1_ = upperRoom("bedroom1", "Bedroom 1", "sleeping", kWall, 3640, kWall, kSpine0);
        bedroom2_ = upperRoom("bedroom2", "Bedroom 2", "sleeping", 3755, 7200, kWall, kSpine0);
        bedroom3_ = upperRoom("bedroom3", "Bedroom 3", "sleeping", 7315, kEast, kWall, kSpine0);
        bath_ = upperRoom("bath", "Bath", "sanitary", kWall, 2600, kSpine1, kNorth);
        gallery_ = upperRoom("gallery", "Gallery", "circulation", 2715, 8900, kSpine1, kNorth);
        dressing_ = upperRoom("dressing", "Dressing room", "storage", 9015, kEast, kSpine1, kNorth);
        loft_ = room(attic_, "loft", "Loft", "storage", roofedBox(kWall, kEast, kWall, kNorth, kAttic, 8000));
        solid(hall_).add(box(4610, 7850, kSpine1, 5860, kCeiling, kUpper));
        solid(ceilingVoid_).cut(solid(beam_).pieces.front());
    }

    // Cuts rafters, ridge beam and chimney out of the parts they pass through.
    void fitRoofAndChimney() {
        for (const int rafter : rafters_) {
            const Piece& piece = solid(rafter).pieces.front();
            for (const int other : {southKnee_, northKnee_, atticFloor_, bedroom1_, bedroom2_, bedroom3_, bath_,
                                    gallery_, dressing_, loft_})
                if (solid(other).pieces.front().from < piece.to && piece.from < solid(other).pieces.front().to)
                    solid(other).cut(piece);
        }
        for (const int other : {westGable_, eastGable_, loft_}) solid(other).cut(solid(ridgeBeam_).pieces.front());
        for (const int other : {kitchen_, slab_, bedroom3_, atticFloor_, loft_, southRoof_})
            solid(other).cut(solid(chimney_).pieces.front());
        solid(chimney_).cut(box(7465, 7665, 3450, 3650, 300, 8700));
    }

    [[nodiscard]] static Opening south(Length x0, Length x1, Length z0, Length z1) {
        return {Opening::Normal::PlusY, 0, kWall, x0, x1, z0, z1};
    }
    [[nodiscard]] static Opening north(Length x0, Length x1, Length z0, Length z1) {
        return {Opening::Normal::MinusY, kDepth, kWall, x0, x1, z0, z1};
    }
    [[nodiscard]] static Opening west(Length y0, Length y1, Length z0, Length z1) {
        return {Opening::Normal::PlusX, 0, kWall, y0, y1, z0, z1};
    }
    [[nodiscard]] static Opening east(Length y0, Length y1, Length z0, Length z1) {
        return {Opening::Normal::MinusX, kWidth, kWall, y0, y1, z0, z1};
    }

    void window(int wall, int room, const Opening& opening, std::string id, std::string name, int columns = 2) {
        addWindow(plan_, wall, room, opening, columns, 2, std::move(id), std::move(name));
    }
    void door(int wall, int room, const Opening& opening, std::string id, std::string name) {
        addDoor(plan_, wall, room, opening, std::move(id), std::move(name));
    }

    void groundOpenings() {
        window(southWall_, living_, south(1200, 3400, 0, 2300), "window_terrace", "Terrace window");
        window(southWall_, living_, south(4400, 6200, 850, 2250), "window_dining", "Window dining area");
        window(westWall_, living_, west(1500, 3300, 850, 2250), "window_living_west", "Window living room west");
        window(southWall_, kitchen_, south(8200, 9800, 1000, 2250), "window_kitchen_south", "Window kitchen south");
        window(eastWall_, kitchen_, east(1800, 3000, 1000, 2250), "window_kitchen_east", "Window kitchen east");
        window(westWall_, study_, west(6000, 7400, 850, 2250), "window_study_west", "Window study west");
        window(northWall_, study_, north(900, 2100, 850, 2250), "window_study_north", "Window study north");
        window(northWall_, hall_, north(6300, 7700, 850, 2250), "window_hall", "Window hall");
        window(eastWall_, utility_, east(5300, 6000, 1300, 2250), "window_utility", "Window utility room", 1);
        window(eastWall_, wc_, east(7200, 7900, 1300, 2250), "window_wc", "Window WC", 1);
        door(northWall_, hall_, north(4600, 5710, 0, 2250), "door_entrance", "Entrance door");
        const auto spine = [](Length x0, Length x1) {
            return Opening{Opening::Normal::PlusY, kSpine0, kSpine1 - kSpine0, x0, x1, 0, 2100};
        };
        door(spine0_, hall_, spine(2775, 3660), "door_living", "Door living room");
        door(spine0_, hall_, spine(7930, 8815), "door_kitchen", "Door kitchen");
        door(studyWall_, study_, {Opening::Normal::MinusX, 2715, 115, 6400, 7285, 0, 2100}, "door_study", "Door study");
        door(serviceWall_, utility_, {Opening::Normal::PlusX, 8900, 115, 5000, 5885, 0, 2100}, "door_utility",
             "Door utility room");
        door(serviceWall_, wc_, {Opening::Normal::PlusX, 8900, 115, 6900, 7685, 0, 2100}, "door_wc", "Door WC");
        addPassage(plan_, kitchenWall_, living_, {Opening::Normal::PlusX, 7200, 115, 900, 2500, 0, 2250});
    }

    void upperOpenings() {
        window(westGable_, bedroom1_, west(1900, 3500, 3810, 5210), "window_bedroom1", "Window bedroom 1");
        window(westGable_, bath_, west(5800, 6800, 4160, 5210), "window_bath", "Window bath");
        window(eastGable_, bedroom3_, east(1900, 3500, 3810, 5210), "window_bedroom3", "Window bedroom 3");
        window(eastGable_, dressing_, east(6750, 7350, 4160, 5060), "window_dressing", "Window dressing room", 1);
        window(westGable_, loft_, west(4100, 4900, 5960, 6760), "window_loft_west", "Window loft west");
        window(eastGable_, loft_, east(4100, 4900, 5960, 6760), "window_loft_east", "Window loft east");
        const auto spine = [](Length x0, Length x1) {
            return Opening{Opening::Normal::MinusY, kSpine1, kSpine1 - kSpine0, x0, x1, kUpper, kUpper + 2100};
        };
        door(spine1_, bedroom1_, spine(2740, 3625), "door_bedroom1", "Door bedroom 1");
        door(spine1_, bedroom2_, spine(3770, 4600), "door_bedroom2", "Door bedroom 2");
        door(spine1_, bedroom3_, spine(7930, 8815), "door_bedroom3", "Door bedroom 3");
        door(bathWall_, bath_, {Opening::Normal::MinusX, 2715, 115, 5200, 6035, kUpper, kUpper + 2100}, "door_bath",
             "Door bath");
        door(dressingWall_, dressing_, {Opening::Normal::PlusX, 8900, 115, 6000, 6885, kUpper, kUpper + 2100},
             "door_dressing", "Door dressing room");
    }

    // A window between two rafters; its frame rises 40 mm above the tiles.
    void roofWindow(bool isSouth, int room, Length x0, std::string id, std::string name) {
        const int roof = isSouth ? southRoof_ : northRoof_;
        const Length x1 = x0 + 710, y0 = 650, y1 = 1400, rim = 60;
        const auto outer = [&](Length low, Length high) { return roofPiece(isSouth, x0, x1, y0, y1, low, high); };
        const auto inner = [&](Length low, Length high) {
            return roofPiece(isSouth, x0 + rim, x1 - rim, y0 + rim, y1 - rim, low, high);
        };
        const int window = addComponent(plan_, Kind::Window, std::move(id), std::move(name), roof);
        solid(roof).cut(outer(0, kRoofThickness));
        solid(room).add(outer(0, 100)).add(inner(100, 170));
        at(window).function = "roof window";
        at(window).storey = upper_;
        at(window).attributes = {{"material", std::string("painted timber, insulating glass"), ""},
                                 {"panes", std::int64_t{1}, ""}};
        at(window).solids = {{Axis::X, Material::Paint, {outer(100, 290)}},
                             {Axis::X, Material::Glass, {inner(170, 200)}}};
        solid(window).cut(inner(100, 290));
    }

    void hatch() {
        const int door = addComponent(plan_, Kind::Door, "attic_hatch", "Attic hatch", atticFloor_);
        solid(atticFloor_).cut(box(8100, 8800, 5100, 6300, kUpperCeiling, kAttic));
        solid(loft_).add(box(8100, 8800, 5100, 6300, kUpperCeiling + 40, kAttic));
        at(door).function = "hatch";
        at(door).storey = attic_;
        at(door).solids = {
            {Axis::X, Material::Timber, {box(8100, 8800, 5100, 6300, kUpperCeiling, kUpperCeiling + 40)}}};
    }

    // 16 risers of 185 mm, 15 treads of 270 mm; the soffit is parallel, one riser lower.
    void stair() {
        constexpr Length start = 3800, tread = 270, riser = 185;
        Solid steps{Axis::Y, Material::Concrete, {}};
        for (Length k = 0; k < 15; ++k)
            steps.add({kSpine1,
                       5860,
                       {{1, 0, start + (k + 1) * tread},
                        {-1, 0, -(start + k * tread)},
                        {0, 1, (k + 1) * riser},
                        {0, -1, 0},
                        {37, -54, 37 * start + 54 * riser}},
                       true});
        addInstallation(plan_, ground_, hall_, "stair", "Stair", "stair", std::move(steps));

        Solid rail{Axis::X,
                   Material::Steel,
                   {box(4570, 7850, 5860, 5900, 3820, 3870), box(4570, 4610, kSpine1, 5860, 3820, 3870),
                    box(4570, 7850, 5860, 5900, 3400, 3430), box(4570, 4610, kSpine1, 5860, 3400, 3430)}};
        for (const Length x : {4570, 5380, 6190, 7000, 7810}) rail.add(box(x, x + 40, 5860, 5900, kUpper, 3870));
        rail.add(box(4570, 4610, kSpine1, 4900, kUpper, 3870));
        addInstallation(plan_, upper_, gallery_, "railing", "Railing", "railing", std::move(rail));
    }

    void outside() {
        const auto add = [&](std::string id, std::string name, std::string function, Material material, Piece piece) {
            const int index = addInstallation(plan_, ground_, -1, std::move(id), std::move(name), std::move(function),
                                              {Axis::X, material, {std::move(piece)}});
            at(index).isOutside = true;
        };
        add("terrace", "Terrace", "terrace", Material::Concrete, box(900, 6600, -2400, 0, -250, -20));
        add("entrance_step", "Entrance step", "step", Material::Concrete, box(4400, 5910, kDepth, 10100, -250, -20));
        add("canopy", "Canopy", "canopy", Material::Steel, box(4400, 5910, kDepth, 10100, 2420, 2480));
    }

    void groundFurniture() {
        addFurniture(plan_, living_, Item::Sofa, 465, 1300, 0, 1, "sofa", "Sofa");
        addFurniture(plan_, living_, Item::CoffeeTable, 1700, 1850, 0, 1, "coffee_table", "Coffee table");
        addFurniture(plan_, living_, Item::Armchair, 2700, 1900, 0, 3, "armchair", "Armchair");
        addFurniture(plan_, living_, Item::Sideboard, 900, 4180, 0, 0, "sideboard", "Sideboard");
        addFurniture(plan_, living_, Item::Shelf, 4000, 4280, 0, 0, "shelf", "Shelf");
        addFurniture(plan_, living_, Item::Table, 4500, 1600, 0, 0, "table", "Dining table");
        addFurniture(plan_, living_, Item::Chair, 4700, 1050, 0, 2, "chair_1", "Chair 1");
        addFurniture(plan_, living_, Item::Chair, 5600, 1050, 0, 2, "chair_2", "Chair 2", true);
        addFurniture(plan_, living_, Item::Chair, 4700, 2600, 0, 0, "chair_3", "Chair 3", true);
        addFurniture(plan_, living_, Item::Chair, 5600, 2600, 0, 0, "chair_4", "Chair 4");
        addFurniture(plan_, kitchen_, Item::Counter, 7900, 385, 0, 2, "counter", "Kitchen counter");
        addFurniture(plan_, kitchen_, Item::Fridge, 9995, 1100, 0, 3, "fridge", "Fridge");
        addFurniture(plan_, kitchen_, Item::Sideboard, 10195, 2400, 0, 3, "cupboard", "Cupboard");
        addFurniture(plan_, study_, Item::Desk, 385, 6000, 0, 1, "desk", "Desk");
        addFurniture(plan_, study_, Item::Chair, 1200, 6450, 0, 3, "desk_chair", "Desk chair");
        addFurniture(plan_, study_, Item::Shelf, 900, 4880, 0, 2, "book_shelf", "Book shelf");
        addFurniture(plan_, hall_, Item::Wardrobe, 2750, 8015, 0, 0, "coat_wardrobe", "Coat wardrobe");
        addFurniture(plan_, wc_, Item::Toilet, 9300, 7915, 0, 0, "wc_toilet", "Toilet");
        addFurniture(plan_, wc_, Item::Basin, 10215, 6550, 0, 3, "wc_basin", "Wash basin");
        addFurniture(plan_, utility_, Item::WashingMachine, 10015, 4900, 0, 3, "washing_machine", "Washing machine");
    }

    void upperFurniture() {
        addFurniture(plan_, bedroom1_, Item::DoubleBed, 385, 1700, kUpper, 1, "double_bed", "Double bed");
        addFurniture(plan_, bedroom1_, Item::Wardrobe, 400, 4000, kUpper, 0, "wardrobe_1", "Wardrobe");
        addFurniture(plan_, bedroom2_, Item::Bed, 3900, 420, kUpper, 2, "bed_2", "Bed");
        addFurniture(plan_, bedroom2_, Item::Desk, 5100, 420, kUpper, 2, "desk_2", "Desk");
        addFurniture(plan_, bedroom2_, Item::Chair, 5600, 1200, kUpper, 0, "desk_chair_2", "Desk chair");
        addFurniture(plan_, bedroom2_, Item::Wardrobe, 5300, 4000, kUpper, 0, "wardrobe_2", "Wardrobe");
        addFurniture(plan_, bedroom3_, Item::Bed, 8575, 1900, kUpper, 3, "bed_3", "Bed");
        addFurniture(plan_, bedroom3_, Item::Desk, 9000, 420, kUpper, 2, "desk_3", "Desk");
        addFurniture(plan_, bedroom3_, Item::Wardrobe, 8830, 4000, kUpper, 0, "wardrobe_3", "Wardrobe");
        addFurniture(plan_, bath_, Item::Bathtub, 400, 7850, kUpper, 0, "bathtub", "Bathtub");
        addFurniture(plan_, bath_, Item::Toilet, 385, 6900, kUpper, 1, "toilet", "Toilet");
        addFurniture(plan_, bath_, Item::Basin, 1000, 4880, kUpper, 2, "basin", "Wash basin");
        addFurniture(plan_, gallery_, Item::Armchair, 3000, 7300, kUpper, 0, "reading_chair", "Reading chair");
        addFurniture(plan_, gallery_, Item::Sideboard, 5200, 8195, kUpper, 0, "gallery_sideboard", "Sideboard");
        addFurniture(plan_, dressing_, Item::Wardrobe, 10015, 4900, kUpper, 3, "dressing_wardrobe", "Wardrobe");
    }

    Plan plan_;
    int ground_ = 0, upper_ = 0, attic_ = 0;
    int southWall_ = 0, northWall_ = 0, westWall_ = 0, eastWall_ = 0, spine0_ = 0, kitchenWall_ = 0, studyWall_ = 0;
    int serviceWall_ = 0, beam_ = 0, slab_ = 0, southKnee_ = 0, northKnee_ = 0, westGable_ = 0, eastGable_ = 0;
    int spine1_ = 0, bathWall_ = 0, dressingWall_ = 0, atticFloor_ = 0, chimney_ = 0;
    int southRoof_ = 0, northRoof_ = 0, ridgeBeam_ = 0;
    std::vector<int> rafters_;
    int living_ = 0, ceilingVoid_ = 0, kitchen_ = 0, study_ = 0, hall_ = 0, utility_ = 0, wc_ = 0;
    int bedroom1_ = 0, bedroom2_ = 0, bedroom3_ = 0, bath_ = 0, gallery_ = 0, dressing_ = 0, loft_ = 0;
};

}  // namespace house
}  // namespace

Plan housePlan() { return house::HouseDesign().build(); }

}  // namespace svt::samples
