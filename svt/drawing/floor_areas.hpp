#pragma once
/// \file
/// Areas and volumes of rooms, storeys and components, as tables of architects have them: floor areas after DIN 277-1
/// where the model says enough, and sums of what is there.
///
///     BGF  gross floor area          what a plan encloses: the sum of all that is cut 0.15 m above the floor
///     NRF  net room area             the sum of rooms
///     KGF  area of construction      BGF - NRF
///     NUF, TF, VF                    net room area for use, technical rooms, circulation: by what a room is called

#include <svt/core/result.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// What a room is for, after DIN 277-1.
enum class RoomUse : std::uint8_t { Unknown, Use, Technical, Traffic };
/// "NUF", "TF", "VF"; empty where it is not known.
[[nodiscard]] std::string_view roomUseName(RoomUse use) noexcept;

/// The use that German or English words of a room's name, function, usage, class or type tell.
[[nodiscard]] RoomUse roomUseOf(const volume::Label& label);

struct RoomArea {
    std::uint32_t label = 0;
    std::string number, name;  ///< number: attribute `number`, or empty
    std::size_t level = 0;     ///< of the levels given
    RoomUse use = RoomUse::Unknown;
    double area = 0;       ///< m2: of its mesh seen from above; furniture and slopes of the roof do not count
    double height = 0;     ///< metres, from its lowest to its highest point
    double volume = 0;     ///< m3
    bool isExact = false;  ///< from a closed mesh; else from a section of its voxels
};

/// Sums of a level, m2.
struct LevelArea {
    double gross = 0, net = 0, construction = 0;
    double use = 0, technical = 0, traffic = 0, unknown = 0;  ///< parts of `net`
    double grossBound = 0;  ///< by which `gross` may be off beside its floor: the sum of SectionComponent::areaBound
    std::size_t rooms = 0;
    bool isExact = false;  ///< its floor, what a plan encloses there and all of its rooms are from meshes
};

/// All components of one class and IFC type.
struct ComponentSum {
    std::string className, type;  ///< type: attribute `ifcType`, or empty
    std::size_t count = 0;
    double area = 0;    ///< m2: of each seen face-on, from the direction of its largest face; 0 without meshes
    double volume = 0;  ///< m3: of bodies
};

struct FloorAreas {
    std::vector<RoomArea> rooms;           ///< by level, number, name
    std::vector<LevelArea> levels;         ///< one for each level given
    std::vector<ComponentSum> components;  ///< by class and type; spaces and what has no voxels are left out
    [[nodiscard]] LevelArea total() const noexcept;
};

/// Measures the floors. Rooms lower than 1.5 m are voids and do not count; a room belongs to the highest level that
/// is at most 0.3 m above its floor. Storeys and units are no rooms.
/// \param levels   of findLevels()
/// \param threads  0: all cores; the result does not depend on it
/// \param bricks   of the volume, if the caller has them; objects with open shells need them
/// \return the areas, or an error of drawSection()
/// Cost: O(triangles), and a section for each level.
[[nodiscard]] Result<FloorAreas> measureFloorAreas(const volume::SemanticVolume& volume,
                                                   const std::vector<BuildingLevel>& levels, int threads = 0,
                                                   const volume::BrickVolume* bricks = nullptr);

}  // namespace svt::drawing
