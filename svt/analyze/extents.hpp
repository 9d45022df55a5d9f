#pragma once
/// \file
/// The extent of a feature: the labels whose voxels together are the feature.
///
/// Each voxel has one label, that of the finest feature that claims it. So a flat has hardly a voxel of its own: its
/// rooms and inner walls have them. The extent of a feature is the union of its own voxels and those of its parts.
/// Parts are children in the tree and members, with their own parts. Each label occurs once in an extent, whatever the
/// number of paths to it, so each voxel counts once:
///
///     storey --child--> unit --member--> room --child--> wall surfaces, furniture
///        |                 +----member--> inner wall --child--> door
///        +--member--> room
///
/// Rooms, units and groups are spaces. A surface that bounds a space is a part of it if it is a sheet, because a sheet
/// lies inside of the space. A surface that stands for material (volume::Filling::Body) is the wall around the space:
/// with all below it, it belongs to storey and building, not to the room. The same holds for solid doors and windows in
/// such surfaces.
///
/// "Own" means the voxels with the label of the feature, "total" those of its extent.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// Extents of the features of one table. Not thread-safe.
class Extents {
public:
    /// \param labels  must outlive the object, unchanged
    /// Cost: O(labels + memberships).
    explicit Extents(const volume::LabelTable& labels);

    /// Labels of the extent of `label`, ascending, with itself. Cycles of members are allowed.
    /// Cost: O(n log n) for n labels of the extent.
    [[nodiscard]] std::vector<std::uint32_t> of(std::uint32_t label) const;
    /// Voxels, volume and box of the extent; areas are 0.
    /// \param own  of all labels
    /// Cost: O(labels of the extent).
    [[nodiscard]] Measure total(std::uint32_t label, std::span<const Measure> own) const;
    /// The union of the extents of several labels.
    [[nodiscard]] std::vector<std::uint32_t> of(std::span<const std::uint32_t> labels) const;

    /// Whether a selection of the feature means its parts. Units, storeys, buildings, bridges, tunnels, groups and other
    /// features without a body of their own stand for their parts, and so do objects whose only parts are phases. A room
    /// does not: its furniture is selected apart.
    [[nodiscard]] bool standsForParts(std::uint32_t label) const;

    /// Labels that each selected label stands for: entry n is the extent of selected[n] if that stands for its parts
    /// and none of these is selected, otherwise selected[n] itself. So `class=BuildingUnit` means whole flats, and
    /// `not class=Window` does not mean the windows of the selected building.
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> wholes(std::span<const std::uint32_t> selected) const;
    /// The union of wholes(), ascending.
    [[nodiscard]] std::vector<std::uint32_t> withParts(std::span<const std::uint32_t> selected) const;

private:
    /// The parts of a label that count: those of a space are parts of the space, and the sheets around it.
    enum class Reach : std::uint8_t { None, Sheets, Space, All };
    /// Surfaces bound a space; spaces are rooms, units and groups, which have no material of their own.
    enum class Kind : std::uint8_t { Unknown, Surface, Space, Material };
    [[nodiscard]] Kind kindOf(std::uint32_t label) const;
    [[nodiscard]] bool hasParts(std::uint32_t label) const;
    [[nodiscard]] Reach reachOf(std::uint32_t root) const;
    [[nodiscard]] Reach reachOf(Reach above, std::uint32_t part) const;
    template <class Use>
    void forEachWhole(std::span<const std::uint32_t> selected, const Use& use) const;
    template <class Visit>
    bool visit(std::uint32_t root, const Visit& use) const;

    const std::vector<volume::Label>& labels_;
    std::vector<std::uint32_t> firstMember_, members_;  // members of l: members_[firstMember_[l]] .. [l + 1]
    std::vector<std::uint32_t> ends_;                   // Label::subtreeEnd by label, close together in memory
    mutable std::vector<Kind> kinds_;                   // by label
    mutable std::vector<std::uint64_t> reached_;        // by label: 4 * visit + its greatest reach
    mutable std::uint64_t visits_ = 0;
};

/// Measures of a feature: of its own voxels, and of its extent.
struct FeatureMeasure {
    std::uint32_t label = 0;
    Measure own, total;
};

/// Measures of features and their extents. The total volume is the sum of the own volumes. The total area counts the
/// outer boundary: contacts within the extent are inside.
/// \param own       of all labels: measureLabels(), or ownMeasures(), then boxes and areas of the result are empty
/// \param contacts  of the whole volume; empty: areas are 0
/// Cost: O(labels and contacts of all extents). Groups that contain each other in a long chain, or many groups of the
/// same members, make this quadratic: 50000 groups in a chain take some seconds.
[[nodiscard]] std::vector<FeatureMeasure> measureFeatures(const Extents& extents,
                                                          std::span<const std::uint32_t> selected,
                                                          std::span<const Measure> own,
                                                          std::span<const Contact> contacts = {});

/// Neighbours of sets of labels.
class NeighborFinder {
public:
    /// \param contacts    of the whole volume; must outlive the object
    /// \param labelCount  number of labels of the table
    /// Cost: O(contacts + labels).
    NeighborFinder(std::span<const Contact> contacts, std::size_t labelCount);

    /// Labels outside of `extent` that touch a label in it, with the area of all their contacts, largest area first;
    /// those of equal area by label. The sum of the areas is the surface of the extent.
    /// \param extent  labels, each once
    /// Cost: O(contacts of the extent). Not thread-safe.
    [[nodiscard]] std::vector<Neighbor> of(std::span<const std::uint32_t> extent) const;

private:
    std::span<const Contact> contacts_;
    std::vector<std::uint32_t> firstContact_, contactsOf_;  // of l: contactsOf_[firstContact_[l]] .. [l + 1]
    mutable std::vector<double> area_;                      // by label, last for background; 0 between calls
    mutable std::vector<char> isInside_;                    // by label; 0 between calls
};

}  // namespace svt::analyze
