#pragma once
/// \file
/// Ownership of the parts of a building: spaces by a table, and the walls and slabs between them by a rule.
///
/// The rule: a feature in the table belongs to its owner. Each other component (wall, slab, window, ...; not a space)
/// is divided between the owners of the features that it touches, in proportion to the contact area; spaces that are
/// not listed count as unowned. The surfaces that bound a space are part of it. Outside air and other unlisted
/// components do not count, so an exterior wall belongs to the owners of the spaces behind it. A component that touches
/// no space at all (a beam inside a slab) is not divided.
///
///        flat A   |wall|  flat B        contact A 20 m2, B 20 m2: half each
///        ---------+    +--------
///        slab     |    |                A 60 m2 (its floor), C below 30 m2, corridor (not listed) 10 m2:
///                                       60 %, 30 %, and 10 % unowned

#include <svt/analyze/contacts.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::analyze {

inline constexpr std::uint32_t kNoOwner = 0xFFFFFFFFu;

struct OwnerTable {
    std::vector<std::string> names;      ///< of the owners, in order of first occurrence
    std::vector<std::uint32_t> ofLabel;  ///< entry l: index of the owner of label l, or kNoOwner
};

/// Reads a CSV table of two columns, feature and owner: UTF-8, separated by commas or semicolons; fields with
/// separators or quotes are in "...", with "" for a quote. The separator is the first of the two in the first line,
/// outside of quotes. A first line `feature,owner` and empty lines are skipped.
///
/// A feature is an id or a query. It includes all features below the selected ones in the tree, and their members: a
/// flat with its rooms and inner walls.
/// \param file  name for messages
/// \return the table, or an error with its line:
///         - BadValue         not two columns, an empty field, an open quote, a feature given to two owners, no rows.
///         - NothingSelected  neither an id nor a query that selects something (names the nearest).
///         - InputTooBig      over 64 MiB, or rows that look at more than 2^30 features in all.
/// Cost: O(bytes + selected labels) for ids; a query O(labels).
[[nodiscard]] Result<OwnerTable> parseOwners(std::string_view text, std::string_view file,
                                             const volume::LabelTable& labels);

/// An owner's share of one component.
struct OwnerShare {
    std::uint32_t owner = kNoOwner;  ///< kNoOwner: unowned
    double area = 0;                 ///< of contact, m2
    double volume = 0;               ///< by the rule above, m3
    friend bool operator==(const OwnerShare&, const OwnerShare&) = default;
};

/// A component and its shares: owners in their order, unowned last.
struct DividedComponent {
    std::uint32_t label = 0;
    std::vector<OwnerShare> shares;
};

/// Totals of one owner, m3.
struct OwnerTotal {
    double own = 0;     ///< listed in the table
    double alone = 0;   ///< components that touch no other owner's space
    double shared = 0;  ///< its share of the others
    /// Breakdown of `shared` by co-owner: the part in components in which this other owner has a share, too. A
    /// component of three owners counts for each pair. In order, unowned last; `area` is the owner's own contact with
    /// those components.
    std::vector<OwnerShare> with;
};

struct Ownership {
    std::vector<OwnerTotal> owners;            ///< as in OwnerTable::names
    std::vector<DividedComponent> components;  ///< by label
    double unowned = 0;                        ///< m3: the unowned shares of components
    double untouched = 0;                      ///< m3: components that touch no space
};

/// Divides the components of `volume` between owners. The volume of a label is that of ownVolumes().
/// \param contacts  of the whole volume, see findContacts()
/// Cost: O(labels + contacts).
[[nodiscard]] Ownership divideByOwners(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts,
                                       const OwnerTable& table);

}  // namespace svt::analyze
