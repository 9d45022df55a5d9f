#pragma once
/// \file
/// The levels of a hierarchical shell: the groups of components at each level, from the single component to the whole
/// building.
///
///     component   each feature separately.
///     room        a room with all features below it in the tree: boundary surfaces, furniture.
///     unit        a flat with its rooms and all components between them.
///     storey      a storey with its flats and rooms, and the walls between them.
///     building    all components of a building.
///
/// Spaces belong to their ancestors in the tree and to the groups that they are members of: a room may be the child of
/// one flat or storey, and the member of another. If several features of one level apply, the nearest counts; if
/// several buildings apply, the outermost counts. A BuildingPart inside a building counts as a unit, because CityGML
/// 2.0 has no class for flats. A CityObjectGroup of storeys counts as a storey.
///
/// A component (a wall with its windows, a slab, a beam: neither a space nor in one) belongs to the lowest room, flat,
/// storey or building that contains all spaces that it touches. Its own place in the tree has priority: a slab that is
/// a member of the upper storey stays there, regardless of the room below it. A wall between two rooms belongs to their
/// flat, a wall between two flats to their storey, the outer wall of one room to that room. A component that touches no
/// space keeps its place in the tree and the groups. A component that belongs to a feature above the requested level is
/// a group of its own, with all components below it.

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

/// A level of a model.
struct ShellStep {
    ShellLevel level = ShellLevel::Component;
    std::size_t features = 0;  ///< components, rooms, flats, storeys or buildings that contain voxels
    std::size_t groups = 0;    ///< these features, and the components outside of them
    friend bool operator==(const ShellStep&, const ShellStep&) = default;
};

/// The hierarchy of rooms, units, storeys and buildings of one volume, and the components in them. Immutable.
class ShellHierarchy {
public:
    /// \param threads  0: all cores; the result does not depend on it
    /// Cost: that of analyze::findContacts, and O(labels + memberships).
    [[nodiscard]] static ShellHierarchy ofVolume(const volume::SemanticVolume& volume, int threads = 0);

    /// Entry l: the label that represents the group of label l at this level: its room, flat, storey or building,
    /// otherwise its component. Groups of a level are unions of groups of the level below if the model's own rooms,
    /// flats and storeys are nested.
    [[nodiscard]] std::vector<std::uint32_t> groups(ShellLevel level) const;

    /// The levels of the model, bottom up; the first is Component.
    [[nodiscard]] std::vector<ShellStep> steps() const;

private:
    // Per label: the feature of each level that contains it; at Component the label itself. kNoLabel: none.
    using Holders = std::array<std::uint32_t, kNames<ShellLevel>.size()>;

    std::vector<Holders> holders_;
    std::vector<std::uint32_t> component_;  // per label: the component of which it is a part
    std::vector<bool> hasVoxels_;
};

/// The steps of `volume`: ShellHierarchy::ofVolume(volume).steps().
[[nodiscard]] std::vector<ShellStep> shellLevels(const volume::SemanticVolume& volume);

/// The groups of `volume` at a level.
/// \return entry per label, see ShellHierarchy::groups, or NothingSelected if the model has no feature of this level
///         (the message lists its levels)
[[nodiscard]] Result<std::vector<std::uint32_t>> groupLabels(const volume::SemanticVolume& volume, ShellLevel level,
                                                             int threads = 0);

}  // namespace svt::illustrate
