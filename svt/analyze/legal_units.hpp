#pragma once
/// \file
/// Checks of legal units (BuildingUnit: flats, offices, common areas) against each other, their storeys and the common
/// parts of their building.
///
/// A unit is its extent (see extents.hpp): its own solid, or its rooms if it has no solid. Common parts are units whose
/// function, class, usage or name says so ("common", "shared", "Gemeinschaft", ...), and rooms that belong to no unit.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// Space that two units claim: their own solids, or the rooms of both if one has no solid.
struct UnitOverlap {
    std::uint32_t a = 0, b = 0;  ///< labels of the units, a < b
    double volume = 0;           ///< m3
    double bound = 0;  ///< m3 by which `volume` may be off; infinite: unknown, because it is counted in voxels
    friend bool operator==(const UnitOverlap&, const UnitOverlap&) = default;
};

/// Space of a storey's own solid that no unit, room, wall or other feature claims.
struct StoreyGap {
    std::uint32_t storey = 0;
    std::uint64_t voxels = 0;
    double volume = 0;  ///< m3, of the voxels
    SampleBox box;
};

/// Whether a common part reaches a unit: they touch, or a door joins them.
enum class UnitAccess : std::uint8_t {
    Common,   ///< a common part reaches it, or it is one
    Outside,  ///< only the outside, by a door
    None,     ///< nothing reaches it
    Unknown   ///< the model has no doors, or no common parts
};

struct LegalUnit {
    std::uint32_t label = 0;
    bool isCommon = false;
    UnitAccess access = UnitAccess::Unknown;
};

struct LegalUnits {
    std::vector<LegalUnit> units;       ///< by label
    std::vector<UnitOverlap> overlaps;  ///< by (a, b)
    std::vector<StoreyGap> gaps;        ///< by storey
};

struct LegalUnitOptions {
    /// Units may overlap by this depth, metres.
    double depth = 0.001;
    /// Reach of a door in front of its leaf and behind it, metres: a door stands in a wall, not always at the air of a
    /// room.
    double doorReach = 0.5;
};

/// Whether function, class, usage or name of a unit says that it is common property.
[[nodiscard]] bool isCommonUnit(const volume::Label& label);

/// Checks the units of `volume`. A gap has at least 27 voxels; smaller ones come from rounding.
/// \param contacts  of the whole volume, see findContacts()
/// Cost: that of solidOverlaps(), and O(contacts + labels of the extents of units + samples around doors).
[[nodiscard]] LegalUnits checkLegalUnits(const volume::SemanticVolume& volume, std::span<const Contact> contacts,
                                         const LegalUnitOptions& options = {});

}  // namespace svt::analyze
