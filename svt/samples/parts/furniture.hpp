#pragma once
/// \file
/// Furniture as unions of boxes in local coordinates: the footprint starts at (0, 0), the back is at greater y.

#include <svt/samples/parts/plan.hpp>

#include <string>

namespace svt::samples {

enum class Item : std::uint8_t {
    Table,
    Chair,
    CoffeeTable,
    Sofa,
    Armchair,
    Shelf,
    Sideboard,
    Counter,
    Fridge,
    Wardrobe,
    Bed,
    DoubleBed,
    Desk,
    Bathtub,
    Basin,
    Toilet,
    WashingMachine
};

/// \return the item's solid, standing on z = 0
[[nodiscard]] Solid furnitureSolid(Item item);

/// `solid` rotated counter-clockwise about z by quarter turns and translated. Boxes only.
[[nodiscard]] Solid placed(const Solid& solid, int quarterTurns, Point shift);

/// Places an item in a room, its rotated footprint starting at (x, y), standing on z.
/// \param isInstance  formats with templates write it as an instance of one
/// \return the component
int addFurniture(Plan& plan, int room, Item item, Length x, Length y, Length z, int quarterTurns, std::string id,
                 std::string name, bool isInstance = false);

}  // namespace svt::samples
