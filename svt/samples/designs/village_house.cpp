// A house of the district: one or two storeys of two rooms each, and a loft under a gable roof that rests on the
// uppermost slab. The section along y (pitch n / d):
//
//            /\ .           roof slabs 250 thick (vertical)
//          / /\ \ .
//        / / loft \ \ .     the underside starts at the top of the slab, above the outer face of the wall
//     _/_/__________\_\_
//        |____slab____|     2550..2750 of each storey
//        |            |
//        |____slab____|     -250..0
#include <svt/samples/designs/designs.hpp>
#include <svt/samples/parts/openings.hpp>

#include <array>
#include <string>
#include <utility>

namespace svt::samples {
namespace {
namespace village {

constexpr Length kWall = 365, kPartition = 240;
constexpr Length kClear = 2550, kStoreyHeight = 2750;
constexpr Length kRoofThickness = 250, kOverhang = 500;

class VillageDesign {
public:
    explicit VillageDesign(const VillageHouse& house)
        : width_(9000 + 1000 * house.widthStep),
          depth_(8000 + 1000 * house.depthStep),
          rise_(house.pitchStep == 0   ? 3
                : house.pitchStep == 1 ? 4
                                       : 5),
          storeys_(house.storeys),
          top_(house.storeys * kStoreyHeight) {}

    Plan build() {
        for (int s = 0; s < storeys_; ++s)
            storeyFeatures_.push_back(addComponent(plan_, Kind::Storey, "storey_" + std::to_string(s),
                                                   s == 0 ? "Ground floor" : "Upper floor"));
        storeyFeatures_.push_back(addComponent(plan_, Kind::Storey, "storey_" + std::to_string(storeys_), "Loft"));
        addElement(plan_, storeyFeatures_[0], "ground_slab", "Ground slab", "slab", Material::Concrete,
                   box(0, width_, 0, depth_, -250, 0), HullPart::Ground, true);
        for (int s = 0; s < storeys_; ++s) storey(s);
        loft();
        resolve(plan_);
        return std::move(plan_);
    }

private:
    // Below the underside of the roof raised by `lift`: 5 z - rise * y <= 5 (top + lift) on the south side.
    [[nodiscard]] HalfPlane below(bool isSouth, Length lift) const {
        if (isSouth) return {-rise_, 5, 5 * (top_ + lift)};
        return {rise_, 5, 5 * (top_ + lift) + rise_ * depth_};
    }

    [[nodiscard]] Piece underRoof(Length x0, Length x1) const {
        return {x0, x1, {{0, -1, -top_}, below(true, 0), below(false, 0)}, true};
    }

    int wall(int s, std::string id, std::string name, Material material, Piece piece) {
        return addElement(plan_, storeyFeatures_[std::size_t(s)], std::move(id), std::move(name), "wall", material,
                          std::move(piece), HullPart::Wall, true);
    }

    void storey(int s) {
        const std::string suffix = std::string("_").append(std::to_string(s));
        const Length z0 = s * kStoreyHeight, z1 = z0 + kClear, east = width_ - kWall, north = depth_ - kWall;
        const Length middle = (width_ - kPartition) / 2;
        const int southWall = wall(s, "wall_south" + suffix, "Exterior wall south", Material::PlasterWhite,
                                   box(0, width_, 0, kWall, z0, z1));
        const int northWall = wall(s, "wall_north" + suffix, "Exterior wall north", Material::PlasterWhite,
                                   box(0, width_, north, depth_, z0, z1));
        wall(s, "wall_west" + suffix, "Exterior wall west", Material::PlasterWhite,
             box(0, kWall, kWall, north, z0, z1));
        wall(s, "wall_east" + suffix, "Exterior wall east", Material::PlasterWhite,
             box(east, width_, kWall, north, z0, z1));
        const int partition = wall(s, "wall_middle" + suffix, "Interior wall", Material::Gypsum,
                                   box(middle, middle + kPartition, kWall, north, z0, z1));
        addElement(plan_, storeyFeatures_[std::size_t(s) + 1], "slab_" + std::to_string(s + 1), "Slab", "slab",
                   Material::Concrete, box(0, width_, 0, depth_, z1, z0 + kStoreyHeight), HullPart::Slab, true);
        const std::array<int, 2> rooms{
            addRoom(plan_, storeyFeatures_[std::size_t(s)], s == 0 ? "living" : "bedroom",
                    s == 0 ? "Living room" : "Bedroom", s == 0 ? "living" : "sleeping",
                    box(kWall, middle, kWall, north, z0, z1)),
            addRoom(plan_, storeyFeatures_[std::size_t(s)], s == 0 ? "kitchen" : "bath", s == 0 ? "Kitchen" : "Bath",
                    s == 0 ? "kitchen" : "sanitary", box(middle + kPartition, east, kWall, north, z0, z1))};
        const std::array<Length, 2> starts{kWall + 900, middle + kPartition + 900};
        for (int side = 0; side < 2; ++side) {
            const Length x0 = starts[std::size_t(side)], x1 = x0 + 1600;
            const std::string where = (side == 0 ? "west" : "east") + suffix;
            const int room = rooms[std::size_t(side)];
            const Opening north_{Opening::Normal::MinusY, depth_, kWall, x0, x1, z0 + 850, z0 + 2250};
            addWindow(plan_, northWall, room, north_, 1, 1, "window_north_" + where, "Window north");
            const bool isEntrance = s == 0 && side == 0;
            const Opening south{Opening::Normal::PlusY,    0,        kWall, x0, isEntrance ? x0 + 1010 : x1,
                                isEntrance ? 0 : z0 + 850, z0 + 2250};
            if (isEntrance)
                addDoor(plan_, southWall, room, south, "door_entrance", "Entrance door");
            else
                addWindow(plan_, southWall, room, south, 1, 1, "window_south_" + where, "Window south");
        }
        addDoor(plan_, partition, rooms[1],
                {Opening::Normal::PlusX, middle, kPartition, kWall + 1200, kWall + 2085, z0, z0 + 2100},
                "door_middle" + suffix, "Interior door");
    }

    void loft() {
        const int storey = storeyFeatures_.back();
        const Length ridge = depth_ / 2;
        for (const bool isSouth : {true, false}) {
            const std::string side = isSouth ? "south" : "north";
            const HalfPlane bottom = below(isSouth, 0);
            const HalfPlane outer = isSouth ? HalfPlane{-1, 0, kOverhang} : HalfPlane{1, 0, depth_ + kOverhang};
            const HalfPlane inner = isSouth ? HalfPlane{1, 0, ridge} : HalfPlane{-1, 0, -ridge};
            addElement(plan_, storey, "roof_" + side, "Roof slab " + side, "roof", Material::RoofTiles,
                       {-kOverhang,
                        width_ + kOverhang,
                        {inner, outer, below(isSouth, kRoofThickness), {-bottom.across, -bottom.up, -bottom.limit}},
                        true},
                       HullPart::Roof, true);
        }
        const int west = wall(storeys_, "gable_west", "Gable west", Material::PlasterWhite, underRoof(0, kWall));
        const int east =
            wall(storeys_, "gable_east", "Gable east", Material::PlasterWhite, underRoof(width_ - kWall, width_));
        const int room = addRoom(plan_, storey, "loft", "Loft", "storage", underRoof(kWall, width_ - kWall));
        const Opening westOpening{Opening::Normal::PlusX, 0, kWall, ridge - 500, ridge + 500, top_ + 500, top_ + 1400};
        Opening eastOpening = westOpening;
        eastOpening.normal = Opening::Normal::MinusX;
        eastOpening.base = width_;
        addWindow(plan_, west, room, westOpening, 2, 1, "window_loft_west", "Window loft west");
        addWindow(plan_, east, room, eastOpening, 2, 1, "window_loft_east", "Window loft east");
    }

    Length width_, depth_, rise_;
    int storeys_;
    Length top_;
    Plan plan_;
    std::vector<int> storeyFeatures_;
};

}  // namespace village
}  // namespace

Plan villageHousePlan(const VillageHouse& house) { return village::VillageDesign(house).build(); }

}  // namespace svt::samples
