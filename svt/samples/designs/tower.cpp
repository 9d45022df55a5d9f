// One storey of the tower, floor at z = 0. Flats lie on both sides of a corridor, the core is in the north row:
//
//   16880 +----------+-----------+----------+
//         |  flat 3  | stair     |  flat 4  |      every flat:   facade
//         |          | lift util.|          |                +-------+-----+
//    9580 +----------+-----------+----------+                |living | bed |
//         |            corridor             |                +----+--+-----+ 2515 from the corridor
//    7300 +----------------+----------------+                |hall| bath   |
//         |     flat 1     |     flat 2     |                +-door--------+
//       0 +----------------+----------------+                    corridor
#include <svt/samples/designs/designs.hpp>
#include <svt/samples/parts/openings.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace svt::samples {
namespace {
namespace tower {

constexpr Length kExterior = 300, kHeavy = 240, kLight = 115;
constexpr Length kClear = 2840, kSlab = kTowerStoreyHeight - kClear;
constexpr Length kFlatDepth = 7000, kCorridor = 1800;
constexpr Length kSouth1 = kExterior + kFlatDepth;  // corridor face of the southern flats
constexpr Length kCorridor0 = kSouth1 + kHeavy, kCorridor1 = kCorridor0 + kCorridor;
constexpr Length kNorth0 = kCorridor1 + kHeavy;  // corridor face of the northern flats
constexpr Length kNorth1 = kNorth0 + kFlatDepth, kDepth = kNorth1 + kExterior;
constexpr Length kStairWidth = 2800, kCoreWall = 200, kLiftWidth = 2400;
constexpr Length kCoreWidth = kStairWidth + kCoreWall + kLiftWidth;
constexpr Length kLiftDepth = 1660;
constexpr Length kFlight0 = 12940, kFlight1 = kFlight0 + 8 * 280;  // y range of the flights
constexpr Length kRiser = 170, kTread = 280;
constexpr Length kReach = 100;  // thickness of the stand-ins for the storeys above and below

int southFlats(int flats) { return (flats + 1) / 2; }

Length interiorWidth(int flats) {
    const Length south = southFlats(flats), north = flats - southFlats(flats);
    return std::max(south * 7600 + (south - 1) * kHeavy, north * 7000 + kCoreWidth + north * kHeavy);
}

class TowerDesign {
public:
    explicit TowerDesign(const TowerStorey& storey)
        : storey_(storey), inner_(interiorWidth(storey.flats)), width_(inner_ + 2 * kExterior) {}

    Plan build() {
        feature_ = addComponent(plan_, Kind::Storey, "storey", "Storey");
        shell();
        core();
        flats();
        neighbors();
        resolve(plan_);
        return std::move(plan_);
    }

private:
    Component& at(int component) { return plan_.components[std::size_t(component)]; }
    Solid& solid(int component) { return at(component).solids.front(); }

    int wall(std::string id, std::string name, Material material, Piece piece, bool isLoadBearing = true) {
        return addElement(plan_, feature_, std::move(id), std::move(name), "wall", material, std::move(piece),
                          HullPart::Wall, isLoadBearing);
    }

    int room(int unit, std::string id, std::string name, std::string function, Piece piece) {
        const int index =
            addRoom(plan_, feature_, std::move(id), std::move(name), std::move(function), std::move(piece));
        at(index).unit = unit;
        return index;
    }

    // Exterior and corridor walls, slabs, corridor.
    void shell() {
        const Length east = width_ - kExterior;
        slab_ = addElement(plan_, feature_, "slab", storey_.isLowest ? "Base slab" : "Slab", "slab", Material::Concrete,
                           box(0, width_, 0, kDepth, storey_.isLowest ? -400 : -kSlab, 0),
                           storey_.isLowest ? HullPart::Ground : HullPart::Slab, true);
        southWall_ =
            wall("wall_south", "Exterior wall south", Material::PlasterWhite, box(0, width_, 0, kExterior, 0, kClear));
        northWall_ = wall("wall_north", "Exterior wall north", Material::PlasterWhite,
                          box(0, width_, kNorth1, kDepth, 0, kClear));
        const int westWall = wall("wall_west", "Exterior wall west", Material::PlasterWhite,
                                  box(0, kExterior, kExterior, kNorth1, 0, kClear));
        const int eastWall = wall("wall_east", "Exterior wall east", Material::PlasterWhite,
                                  box(east, width_, kExterior, kNorth1, 0, kClear));
        southCorridorWall_ = wall("wall_corridor_south", "Corridor wall south", Material::Concrete,
                                  box(kExterior, east, kSouth1, kCorridor0, 0, kClear));
        northCorridorWall_ = wall("wall_corridor_north", "Corridor wall north", Material::Concrete,
                                  box(kExterior, east, kCorridor1, kNorth0, 0, kClear));
        common_ = addComponent(plan_, Kind::Unit, "common", "Common area");
        at(common_).storey = feature_;
        at(common_).function = "common";
        corridor_ = room(common_, "corridor", "Corridor", "circulation",
                         box(kExterior, east, kCorridor0, kCorridor1, 0, kClear));
        addWindow(plan_, westWall, corridor_, {Opening::Normal::PlusX, 0, kExterior, 7940, 8940, 900, 2400}, 1, 1,
                  "window_corridor_west", "Window corridor west");
        addWindow(plan_, eastWall, corridor_, {Opening::Normal::MinusX, width_, kExterior, 7940, 8940, 900, 2400}, 1, 1,
                  "window_corridor_east", "Window corridor east");
        if (storey_.isHighest) roof();
    }

    void roof() {
        const Length top = kTowerStoreyHeight, parapet = top + 500;
        addElement(plan_, feature_, "roof_slab", "Roof slab", "roof", Material::Concrete,
                   box(0, width_, 0, kDepth, kClear, top), HullPart::Roof, true);
        const auto add = [&](const std::string& side, Piece piece) {
            wall("parapet_" + side, "Parapet " + side, Material::PlasterWhite, std::move(piece), false);
        };
        add("south", box(0, width_, 0, kExterior, top, parapet));
        add("north", box(0, width_, kNorth1, kDepth, top, parapet));
        add("west", box(0, kExterior, kExterior, kNorth1, top, parapet));
        add("east", box(width_ - kExterior, width_, kExterior, kNorth1, top, parapet));
    }

    void core() {
        const int south = southFlats(storey_.flats), north = storey_.flats - south;
        const Length share = (inner_ - kCoreWidth - north * kHeavy) / north;
        stair0_ = kExterior + (north / 2) * (share + kHeavy);
        const Length stair1 = stair0_ + kStairWidth, lift0 = stair1 + kCoreWall, lift1 = lift0 + kLiftWidth;
        const Length lift = kNorth0 + kLiftDepth;
        const int coreWall =
            wall("wall_core", "Core wall", Material::Concrete, box(stair1, lift0, kNorth0, kNorth1, 0, kClear));
        const int liftWall =
            wall("wall_lift", "Lift shaft wall", Material::Concrete, box(lift0, lift1, lift, lift + kHeavy, 0, kClear));
        at(coreWall).unit = at(liftWall).unit = common_;
        stairwell_ =
            room(common_, "stairwell", "Stairwell", "circulation", box(stair0_, stair1, kNorth0, kNorth1, 0, kClear));
        lift_ = room(common_, "lift", "Lift shaft", "lift", box(lift0, lift1, kNorth0, lift, 0, kClear));
        const int utility =
            room(common_, "utility", "Utility room", "utility", box(lift0, lift1, lift + kHeavy, kNorth1, 0, kClear));
        // The flight up from this storey begins in the western half of the opening, the one from below ends in the
        // eastern half.
        risingHole_ = box(stair0_, stair0_ + 1600, kFlight0, kNorth1, -kSlab, 0);
        arrivingHole_ = box(stair0_ + 1600, stair1, kFlight0, kNorth1, -kSlab, 0);
        liftHole_ = box(lift0, lift1, kNorth0, lift, -kSlab, 0);
        if (!storey_.isLowest) {
            solid(slab_).cut(risingHole_).cut(arrivingHole_).cut(liftHole_);
            solid(stairwell_).add(risingHole_);
            solid(lift_).add(liftHole_);
        }
        if (!storey_.isHighest) solid(stairwell_).add(lifted(arrivingHole_, kClear, kTowerStoreyHeight));
        const auto corridorDoor = [&](Length x0, Length x1) {
            return Opening{Opening::Normal::PlusY, kCorridor1, kHeavy, x0, x1, 0, 2200};
        };
        const Opening stairDoor = corridorDoor(stair0_ + 900, stair0_ + 1910);
        const Opening liftDoor = corridorDoor(lift0 + 600, lift1 - 600);
        addDoor(plan_, northCorridorWall_, stairwell_, stairDoor, "door_stairwell", "Door stairwell");
        addDoor(plan_, northCorridorWall_, lift_, liftDoor, "door_lift", "Lift door");
        addDoor(plan_, coreWall, utility, {Opening::Normal::PlusX, stair1, kCoreWall, 11700, 12585, 0, 2100},
                "door_utility", "Door utility room");
        addWindow(plan_, northWall_, stairwell_,
                  {Opening::Normal::MinusY, kDepth, kExterior, stair0_ + 900, stair0_ + 1900, 1700, 2700}, 1, 1,
                  "window_stairwell", "Window stairwell");
        if (!storey_.isHighest) stair();
        Solid space{Axis::X, Material::Air, solid(corridor_).pieces};
        space.add(box(stair0_, lift1, kNorth0, kNorth1, 0, kClear));
        // The doorways connect the core to the corridor.
        space.add(stairDoor.piece(0, kHeavy)).add(liftDoor.piece(0, kHeavy));
        for (const int part : {stairwell_, lift_, utility}) addReveals(space, part);
        at(common_).solids.push_back(std::move(space));
    }

    // Reveals of doors and windows, which extend a room beyond its box.
    void addReveals(Solid& space, int room) {
        const std::vector<Piece>& pieces = solid(room).pieces;
        for (std::size_t i = 1; i < pieces.size(); ++i) space.add(pieces[i]);
    }

    // Two flights of 9 risers and 8 treads with a landing between; the flights rest on slab edges and landing.
    void stair() {
        const int stair =
            addInstallation(plan_, feature_, stairwell_, "stair", "Stair", "stair", {Axis::X, Material::Concrete, {}});
        Solid& up = solid(stair);
        for (Length k = 0; k < 8; ++k) {
            const Length y = kFlight0 + k * kTread;
            Piece step{
                stair0_,
                stair0_ + 1200,
                {{1, 0, y + kTread}, {-1, 0, -y}, {0, 1, (k + 1) * kRiser}, {17, -28, 17 * kFlight0 + 28 * kRiser}},
                true};
            if (storey_.isLowest) step.sides.push_back({0, -1, 0});
            up.add(std::move(step));
        }
        const Length landing = 9 * kRiser;
        Solid further{Axis::X, Material::Concrete, {}};
        for (Length k = 0; k < 8; ++k) {
            const Length y = kFlight1 - k * kTread;
            further.add({stair0_ + 1600,
                         stair0_ + kStairWidth,
                         {{1, 0, y},
                          {-1, 0, -(y - kTread)},
                          {0, 1, landing + (k + 1) * kRiser},
                          {-17, -28, -17 * kFlight1 - 28 * (landing - kRiser)}},
                         true});
        }
        at(stair).solids.push_back({Axis::X,
                                    Material::Concrete,
                                    {box(stair0_, stair0_ + kStairWidth, kFlight1, kNorth1, landing - 250, landing)}});
        at(stair).solids.push_back(std::move(further));
    }

    void flats() {
        const int south = southFlats(storey_.flats), north = storey_.flats - south;
        int number = 1;
        const Length southShare = (inner_ - (south - 1) * kHeavy) / south;
        Length x = kExterior;
        for (int i = 0; i < south; ++i) {
            const Length end = i + 1 == south ? kExterior + inner_ : x + southShare;
            flat(number++, x, end, true, i % 2 == 1);
            if (i + 1 < south) partyWall("south", i, end, kExterior, kSouth1);
            x = end + kHeavy;
        }
        const Length northShare = (inner_ - kCoreWidth - north * kHeavy) / north;
        x = kExterior;
        for (int i = 0; i <= north; ++i) {
            const bool isCore = i == north / 2;
            const Length end = i == north ? kExterior + inner_ : x + (isCore ? kCoreWidth : northShare);
            if (!isCore) flat(number++, x, end, false, i % 2 == 1);
            if (i < north) partyWall("north", i, end, kNorth0, kNorth1);
            x = end + kHeavy;
        }
    }

    void partyWall(const std::string& side, int index, Length x, Length y0, Length y1) {
        wall("wall_party_" + side + "_" + std::to_string(index + 1),
             "Party wall " + side + " " + std::to_string(index + 1), Material::Concrete,
             box(x, x + kHeavy, y0, y1, 0, kClear));
    }

    // A flat between x = a and b. Its interior uses coordinates (s, v): s from one side wall to the other (mirrored for
    // every second flat), v from the corridor to the facade.
    struct Layout {
        Length a = 0, b = 0;
        bool isSouth = true, isMirrored = false;

        [[nodiscard]] Piece box(Length s0, Length s1, Length v0, Length v1, Length z0, Length z1) const {
            const auto [x0, x1] = alongX(s0, s1);
            if (isSouth) return samples::box(x0, x1, kSouth1 - v1, kSouth1 - v0, z0, z1);
            return samples::box(x0, x1, kNorth0 + v0, kNorth0 + v1, z0, z1);
        }
        [[nodiscard]] std::pair<Length, Length> alongX(Length s0, Length s1) const {
            return isMirrored ? std::pair{b - s1, b - s0} : std::pair{a + s0, a + s1};
        }
        // Through a wall that runs along x, from the corridor's side at `v` towards the facade.
        [[nodiscard]] Opening towardsFacade(Length v, Length thickness, Length s0, Length s1, Length z1) const {
            const auto [x0, x1] = alongX(s0, s1);
            return {isSouth ? Opening::Normal::MinusY : Opening::Normal::PlusY,
                    isSouth ? kSouth1 - v : kNorth0 + v,
                    thickness,
                    x0,
                    x1,
                    0,
                    z1};
        }
        // Through a cross wall, starting at `s`.
        [[nodiscard]] Opening across(Length s, Length thickness, Length v0, Length v1, Length z1) const {
            return {isMirrored ? Opening::Normal::MinusX : Opening::Normal::PlusX,
                    isMirrored ? b - s : a + s,
                    thickness,
                    isSouth ? kSouth1 - v1 : kNorth0 + v0,
                    isSouth ? kSouth1 - v0 : kNorth0 + v1,
                    0,
                    z1};
        }
        [[nodiscard]] Opening facade(Length s0, Length s1, Length z0, Length z1) const {
            const auto [x0, x1] = alongX(s0, s1);
            return {isSouth ? Opening::Normal::PlusY : Opening::Normal::MinusY,
                    isSouth ? 0 : kDepth,
                    kExterior,
                    x0,
                    x1,
                    z0,
                    z1};
        }
    };

    void flat(int number, Length a, Length b, bool isSouth, bool isMirrored) {
        const Layout layout{a, b, isSouth, isMirrored};
        const std::string id = "F" + std::to_string(number), name = "Flat " + std::to_string(number);
        const Length width = b - a, band = 2400, front = band + kLight;
        const Length bath = width - 2600, bedroom = width - width * 2 / 25 * 5;
        const int unit = addComponent(plan_, Kind::Unit, id, name);
        at(unit).storey = feature_;
        at(unit).function = "residential";
        const auto squareDecimetres = width * kFlatDepth / 10000;
        at(unit).attributes = {{"floorArea", squareDecimetres / 100.0, "m2"}};
        const auto inner = [&](const std::string& part, const std::string& title, Piece piece) {
            const int index = wall(id + "_" + part, name + " " + title, Material::Gypsum, std::move(piece), false);
            at(index).unit = unit;
            return index;
        };
        const int bathWall = inner("wall_bath", "wall of bath", layout.box(bath - kLight, bath, 0, band, 0, kClear));
        const int bandWall = inner("wall_hall", "wall of hall", layout.box(0, width, band, front, 0, kClear));
        const int bedroomWall = inner("wall_bedroom", "wall of bedroom",
                                      layout.box(bedroom - kLight, bedroom, front, kFlatDepth, 0, kClear));
        const int hall =
            room(unit, id + "_hall", name + " hall", "circulation", layout.box(0, bath - kLight, 0, band, 0, kClear));
        const int bathroom =
            room(unit, id + "_bath", name + " bath", "sanitary", layout.box(bath, width, 0, band, 0, kClear));
        const int living = room(unit, id + "_living", name + " living room", "living",
                                layout.box(0, bedroom - kLight, front, kFlatDepth, 0, kClear));
        const int sleeping = room(unit, id + "_bedroom", name + " bedroom", "sleeping",
                                  layout.box(bedroom, width, front, kFlatDepth, 0, kClear));
        addDoor(plan_, isSouth ? southCorridorWall_ : northCorridorWall_, hall,
                layout.towardsFacade(-kHeavy, kHeavy, 600, 1610, 2200), id + "_door_entrance", name + " entrance door");
        addDoor(plan_, bathWall, bathroom, layout.across(bath - kLight, kLight, 900, 1785, 2100), id + "_door_bath",
                name + " bath door");
        addDoor(plan_, bandWall, living, layout.towardsFacade(band, kLight, 700, 1585, 2100), id + "_door_living",
                name + " living room door");
        addDoor(plan_, bedroomWall, sleeping, layout.across(bedroom - kLight, kLight, front + 200, front + 1085, 2100),
                id + "_door_bedroom", name + " bedroom door");
        facade(layout, id, name, unit, living, sleeping, bedroom, width);

        Solid space{Axis::X, Material::Air, {layout.box(0, width, 0, kFlatDepth, 0, kClear)}};
        for (const int part : {hall, bathroom, living, sleeping}) addReveals(space, part);
        at(unit).solids.push_back(std::move(space));
    }

    // Window bands, balcony and the door to it.
    void facade(const Layout& layout, const std::string& id, const std::string& name, int unit, int living,
                int sleeping, Length bedroom, Length width) {
        const int outer = layout.isSouth ? southWall_ : northWall_;
        const Length livingEnd = bedroom - kLight;
        const auto panes = [](Length s0, Length s1) { return int((s1 - s0) / 900); };
        addWindow(plan_, outer, living, layout.facade(400, livingEnd - 1600, 900, 2400), panes(400, livingEnd - 1600),
                  1, id + "_window_living", name + " living room window");
        addWindow(plan_, outer, living, layout.facade(livingEnd - 1300, livingEnd - 300, 0, 2400), 1, 1,
                  id + "_window_balcony", name + " balcony window");
        addWindow(plan_, outer, sleeping, layout.facade(bedroom + 400, width - 400, 900, 2400),
                  panes(bedroom + 400, width - 400), 1, id + "_window_bedroom", name + " bedroom window");
        // v of the balcony, beyond the facade
        const Length v0 = kFlatDepth + kExterior, v1 = v0 + 1500, s0 = livingEnd - 3200, s1 = livingEnd - 100;
        Solid balcony{Axis::X, Material::Concrete, {layout.box(s0, s1, v0, v1, -180, 0)}};
        balcony.add(layout.box(s0, s1, v1 - 100, v1, 0, 1000));
        balcony.add(layout.box(s0, s0 + 100, v0, v1, 0, 1000)).add(layout.box(s1 - 100, s1, v0, v1, 0, 1000));
        const int index =
            addInstallation(plan_, feature_, -1, id + "_balcony", name + " balcony", "balcony", std::move(balcony));
        at(index).unit = unit;
        at(index).isOutside = true;
    }

    void ghost(Kind kind, std::string id, Piece piece) {
        const int index = addComponent(plan_, kind, std::move(id), "");
        at(index).isStandIn = true;
        at(index).hullPart = HullPart::Slab;
        at(index).solids = {{Axis::X, Material::Air, {std::move(piece)}}};
    }

    static Piece lifted(Piece piece, Length z0, Length z1) {
        piece.sides[2].limit = z1;
        piece.sides[3].limit = -z0;
        return piece;
    }

    // Stand-ins for the storeys above and below, as far as faces of this one depend on them.
    void neighbors() {
        if (!storey_.isHighest) {
            const Length top = kTowerStoreyHeight;
            ghost(Kind::Element, "above", box(0, width_, 0, kDepth, kClear, top));
            const int above = int(plan_.components.size()) - 1;
            for (const Piece& hole : {risingHole_, arrivingHole_, liftHole_})
                solid(above).cut(lifted(hole, kClear, top));
            ghost(Kind::Room, "hole_above", lifted(risingHole_, kClear, top));
            ghost(Kind::Room, "hole_above", lifted(liftHole_, kClear, top));
            ghost(Kind::Room, "stairwell_above", lifted(arrivingHole_, top, top + kReach));
        }
        if (storey_.isLowest) return;
        const Length low = -kSlab - kReach, high = -kSlab;
        ghost(Kind::Element, "wall_below", box(0, width_, 0, kExterior, low, high));
        ghost(Kind::Element, "wall_below", box(0, width_, kNorth1, kDepth, low, high));
        ghost(Kind::Element, "wall_below", box(0, kExterior, kExterior, kNorth1, low, high));
        ghost(Kind::Element, "wall_below", box(width_ - kExterior, width_, kExterior, kNorth1, low, high));
        ghost(Kind::Element, "below", box(kExterior, width_ - kExterior, kExterior, kNorth1, low, high));
        const int below = int(plan_.components.size()) - 1;
        for (const Piece& hole : {risingHole_, liftHole_}) {
            solid(below).cut(lifted(hole, low, high));
            ghost(Kind::Room, "stairwell_below", lifted(hole, low, high));
        }
        ghost(Kind::Room, "hole_below", arrivingHole_);
    }

    TowerStorey storey_;
    Length inner_, width_;
    Plan plan_;
    int feature_ = 0, slab_ = 0, southWall_ = 0, northWall_ = 0, southCorridorWall_ = 0, northCorridorWall_ = 0;
    int common_ = 0, corridor_ = 0, stairwell_ = 0, lift_ = 0;
    Length stair0_ = 0;
    Piece risingHole_, arrivingHole_, liftHole_;
};

}  // namespace tower
}  // namespace

Plan towerPlan(const TowerStorey& storey) { return tower::TowerDesign(storey).build(); }

Point towerSize(int flats) { return {tower::interiorWidth(flats) + 2 * tower::kExterior, tower::kDepth, 0}; }

}  // namespace svt::samples
