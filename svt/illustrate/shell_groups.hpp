#pragma once
/// \file
/// The steps of a hierarchical shell: which components are one at which level, bottom up from the single component to
/// the whole building.
///
///     component   every feature by itself
///     room        a room with all that is below it: boundary surfaces, furniture
///     unit        a flat with its rooms and all that lies between them
///     storey      a storey with its flats and rooms, and the walls between them
///     building    everything of a building
///
/// Spaces say where they belong by the tree and by their groups: a room is the child of one flat or storey, the member
/// of another. Of several features of one level the nearest counts, of buildings the outermost. A BuildingPart inside a
/// building counts as a unit, since CityGML 2.0 has no class for flats; a CityObjectGroup of storeys as a storey.
///
/// A component (a wall with its windows, a slab, a beam: what is no space and lies in none) belongs to the lowest room,
/// flat, storey or building that holds all spaces that it touches, but to none that its own place in the tree
/// contradicts: a slab that is a member of the upper storey stays there, whatever room lies below it.
/// A wall between two rooms belongs to their flat, a wall between two flats to their storey, the outer wall of one room
/// to that room. What touches no space stays where the tree and the groups have it. A component that belongs to
/// something above the level asked for is a group by itself, with all below it.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace svt::illustrate {

enum class ShellLevel : std::uint8_t { Component, Room, Unit, Storey, Building };
inline constexpr std::array<ShellLevel, 5> kShellLevels{ShellLevel::Component, ShellLevel::Room, ShellLevel::Unit,
                                                        ShellLevel::Storey, ShellLevel::Building};

[[nodiscard]] std::string_view shellLevelName(ShellLevel level) noexcept;  ///< "component", "room", ...
[[nodiscard]] std::optional<ShellLevel> shellLevelFromName(std::string_view name) noexcept;

/// A level that a model has.
struct ShellStep {
    ShellLevel level = ShellLevel::Component;
    std::size_t features = 0;  ///< components, rooms, flats, storeys or buildings with voxels in them
    std::size_t groups = 0;    ///< these and the components that belong to none of them
    friend bool operator==(const ShellStep&, const ShellStep&) = default;
};

/// What belongs to what, of one volume. Immutable.
class ShellHierarchy {
public:
    /// \param threads  0: all cores; the result does not depend on it
    /// Cost: that of volume::contactsOf, and O(labels + memberships).
    [[nodiscard]] static ShellHierarchy ofVolume(const volume::SemanticVolume& volume, int threads = 0);

    /// Entry l = label that stands for the group of label l at this level: its room, flat, storey or building, else its
    /// component. Groups of a level are unions of groups of the level below, as far as the model's own rooms, flats and
    /// storeys are nested.
    [[nodiscard]] std::vector<std::uint32_t> groups(ShellLevel level) const;

    /// The levels that the model has, bottom up; the first is Component.
    [[nodiscard]] std::vector<ShellStep> steps() const;

private:
    // Per label: the feature of each level that holds it; at Component itself. kNoLabel: none.
    using Holders = std::array<std::uint32_t, kShellLevels.size()>;

    std::vector<Holders> holders_;
    std::vector<std::uint32_t> component_;  // per label: the component of which it is a part
    std::vector<bool> hasVoxels_;
};

/// The steps of `volume`: ShellHierarchy::ofVolume(volume).steps().
[[nodiscard]] std::vector<ShellStep> shellLevels(const volume::SemanticVolume& volume);

/// The grouping of `volume` at a level.
/// \return entry per label, see ShellHierarchy::groups, or NothingSelected where the model has no feature of that level
///         (the message names the levels that it has)
[[nodiscard]] Result<std::vector<std::uint32_t>> groupLabels(const volume::SemanticVolume& volume, ShellLevel level,
                                                             int threads = 0);

}  // namespace svt::illustrate
