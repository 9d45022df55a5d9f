#pragma once
/// \file
/// Who owns what of a building: spaces by a table, and the walls and slabs between them by a rule.
///
/// The rule. What the table names is its owner's own. Every other component (wall, slab, window, ...; no space) that
/// touches what is owned is divided between the owners that it touches, in proportion to the area of contact; spaces
/// that the table does not name take part as nobody's. The surfaces that bound a space are part of it. Outside air and
/// other components take no part, so an exterior wall belongs to those who live behind it. What touches no space at all
/// (a beam inside a slab) is left out.
///
///        flat A   |wall|  flat B        contact A 20 m2, B 20 m2: half each
///        ---------+    +--------
///        slab     |    |                A 60 m2 (its floor), C below 30 m2, corridor (not named) 10 m2:
///                                       60 %, 30 %, and 10 % nobody's

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
    std::vector<std::string> names;      ///< of the owners, in order of first mention
    std::vector<std::uint32_t> ofLabel;  ///< entry l: index of the owner of label l, or kNoOwner
};

/// Reads a table of two columns, feature and owner: UTF-8, separated by commas or semicolons, fields with separators or
/// quotes in "...", "" for a quote; the separator is the first of the two that the first line has outside of quotes. A
/// first line `feature,owner` and empty lines are passed over.
///
/// A feature is an id or a query. Either stands for what it selects, all below that and its members: a flat with its
/// rooms and inner walls.
/// \param file  name in messages
/// \return the table, or with line
///         - BadValue         not two columns, an empty field, an open quote, a feature given to two owners, no rows
///         - NothingSelected  neither an id nor a query that selects something (names the nearest)
///         - InputTooBig      over 64 MiB, or rows that look at more than 2^30 features in all
/// Cost: O(bytes + selected labels) for ids; a query O(labels).
[[nodiscard]] Result<OwnerTable> parseOwners(std::string_view text, std::string_view file,
                                             const volume::LabelTable& labels);

/// What an owner has of one component. m2 by contact, m3 by the rule above.
struct OwnerShare {
    std::uint32_t owner = kNoOwner;  ///< kNoOwner: nobody's
    double area = 0;
    double volume = 0;
    friend bool operator==(const OwnerShare&, const OwnerShare&) = default;
};

/// A component and those that have a part in it: owners in their order, nobody last.
struct DividedComponent {
    std::uint32_t label = 0;
    std::vector<OwnerShare> shares;
};

/// What one owner has, m3.
struct OwnerTotal {
    double own = 0;     ///< what the table names
    double alone = 0;   ///< components that touch nobody else's space
    double shared = 0;  ///< its share of the others
    /// Of `shared`: what lies in components that this one has a part in too. A component of three owners counts for
    /// each pair. In order, nobody last; `area` is the owner's own contact with those components.
    std::vector<OwnerShare> with;
};

struct Ownership {
    std::vector<OwnerTotal> owners;            ///< as in OwnerTable::names
    std::vector<DividedComponent> components;  ///< by label
    double nobody = 0;                         ///< m3 of components that are nobody's share
    double untouched = 0;                      ///< m3 of components that touch no space
};

/// Divides the components of `volume` between owners. The volume of a label is that of volume::ownVolumes().
/// \param contacts  of the whole volume, see volume::contactsOf()
/// Cost: O(labels + contacts).
[[nodiscard]] Ownership divideByOwners(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts,
                                       const OwnerTable& table);

}  // namespace svt::analyze
