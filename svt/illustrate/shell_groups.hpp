#pragma once
/// \file
/// The levels of a hierarchical shell: which components form a group at which level, from the single component up to
/// the whole building.
///
///     component   every feature by itself
///     room        a room with all below it in the tree: boundary surfaces, furniture
///     unit        a flat with its rooms and all between them
///     storey      a storey with its flats and rooms, and the walls between them
///     building    everything of a building
///
/// Spaces belong to their ancestors in the tree and to the groups that they are members of: a room may be the child of
/// one flat or storey, and the member of another. Of several features of one level the nearest counts, of buildings the
/// outermost. A BuildingPart inside a building counts as a unit, since CityGML 2.0 has no class for flats; a
/// CityObjectGroup of storeys as a storey.
///
/// A component (a wall with its windows, a slab, a beam: neither a space nor in one) belongs to the lowest room, flat,
/// storey or building that holds all spaces that it touches, unless this contradicts its own place in the tree: a slab
/// that is a member of the upper storey stays there, whatever room is below it.
/// A wall between two rooms belongs to their flat, a wall between two flats to their storey, the outer wall of one room
/// to that room. A component that touches no space keeps its place in the tree and the groups. A component that belongs
/// to something above the requested level is a group by itself, with all below it.

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace svt::illustrate {

enum class ShellLevel : std::uint8_t { Component, Room, Unit, Storey, Building };
constexpr auto namesOf(ShellLevel) {
    return std::to_array<Name<ShellLevel>>({{ShellLevel::Component, "component"},
                                            {ShellLevel::Room, "room"},
                                            {ShellLevel::Unit, "unit"},
                                            {ShellLevel::Storey, "storey"},
                                            {ShellLevel::Building, "building"}});
}

/// A level that a model has.
struct ShellStep {
    ShellLevel level = ShellLevel::Component;
    std::size_t features = 0;  ///< components, rooms, flats, storeys or buildings that contain voxels
    std::size_t groups = 0;    ///< these, and the components that belong to none of them
    friend bool operator==(const ShellStep&, const ShellStep&) = default;
};

/// The hierarchy of rooms, units, storeys and buildings of one volume, and the components in them. Immutable.
class ShellHierarchy {
public:
    /// \param threads  0: all cores; the result does not depend on it
    /// Cost: that of analyze::findContacts, and O(labels + memberships).
    [[nodiscard]] static ShellHierarchy ofVolume(const volume::SemanticVolume& volume, int threads = 0);

    /// Entry l: the label that represents the group of label l at this level: its room, flat, storey or building, else
    /// its component. Groups of a level are unions of groups of the level below, as far as the model's own rooms, flats
    /// and storeys are nested.
    [[nodiscard]] std::vector<std::uint32_t> groups(ShellLevel level) const;

    /// The levels that the model has, bottom up; the first is Component.
    [[nodiscard]] std::vector<ShellStep> steps() const;

private:
    // Per label: the feature of each level that holds it; at Component the label itself. kNoLabel: none.
    using Holders = std::array<std::uint32_t, kNames<ShellLevel>.size()>;

    std::vector<Holders> holders_;
    std::vector<std::uint32_t> component_;  // per label: the component of which it is a part
    std::vector<bool> hasVoxels_;
};

/// The steps of `volume`: ShellHierarchy::ofVolume(volume).steps().
[[nodiscard]] std::vector<ShellStep> shellLevels(const volume::SemanticVolume& volume);

/// The groups of `volume` at a level.
/// \return entry per label, see ShellHierarchy::groups, or NothingSelected if the model has no feature of that level
///         (the message names the levels that it has)
[[nodiscard]] Result<std::vector<std::uint32_t>> groupLabels(const volume::SemanticVolume& volume, ShellLevel level,
                                                             int threads = 0);

}  // namespace svt::illustrate
