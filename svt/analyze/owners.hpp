#pragma once
/// \file
/// Ownership of the parts of a building: features by a table, and the walls and slabs between them by a rule.
///
/// A feature of the table belongs to its owners, with its extent (see extents.hpp). If features of the table contain
/// each other, the finer one decides: a flat within a building that belongs to all. Space in several features that do
/// not contain each other, such as a cellar of two flats, counts once, divided equally between these features.
///
/// The rule for all else: each component (wall, slab, window, ...; not a space) is divided between the owners of the
/// features that it touches, in proportion to the contact area. Spaces that are not listed count as unowned. The sheets
/// that bound a space are part of it. Outside air and other unlisted components do not count, so an exterior wall
/// belongs to the owners of the spaces behind it. A component that touches no space at all (a beam inside a slab) is
/// not divided.
///
///        flat A   |wall|  flat B        contact A 20 m2, B 20 m2: half each
///        ---------+    +--------
///        slab     |    |                A 60 m2 (its floor), C below 30 m2, corridor (not listed) 10 m2:
///                                       60 %, 30 %, and 10 % unowned

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/right_types.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::analyze {

inline constexpr std::uint32_t kNoOwner = 0xFFFFFFFFu;

/// The part of a feature or label that belongs to an owner.
struct OwnerFraction {
    std::uint32_t owner = 0;
    double fraction = 1;  ///< more than 0, up to 1
    friend bool operator==(const OwnerFraction&, const OwnerFraction&) = default;
};

/// A feature of the table.
struct OwnedFeature {
    std::uint32_t label = 0;
    std::vector<OwnerFraction> owners;  ///< by owner; if they add up to less than 1, the rest is unowned
    std::vector<std::uint32_t> parts;   ///< labels of its extent that no finer feature of the table has, ascending
};

/// A right, restriction or responsibility of a party in a feature, as the table states it.
struct TableRight {
    std::uint32_t label = 0;
    std::uint32_t party = 0;         ///< index into OwnerTable::parties
    std::uint32_t source = 0;        ///< index into OwnerTable::sources
    std::uint8_t type = kOwnership;  ///< index into rightTypes()
    std::optional<double> fraction;  ///< more than 0, up to 1; always known for ownership
    friend bool operator==(const TableRight&, const TableRight&) = default;
};

struct OwnerTable {
    std::vector<std::string> names;                   ///< of the owners, in order of first occurrence
    std::vector<OwnedFeature> features;               ///< by label
    std::vector<std::vector<OwnerFraction>> ofLabel;  ///< entry l: owners of label l, by owner; empty: not in the table
    std::vector<std::uint32_t> shared;                ///< labels that are parts of several features, ascending
    std::vector<std::string> parties;                 ///< of all rights, in order of first occurrence
    std::vector<std::string> sources;                 ///< documents; the first is empty: the row names none
    std::vector<TableRight> rights;                   ///< by label, type, then row; equal rows once
};

/// Reads a CSV table: UTF-8, separated by commas or semicolons; fields with separators or quotes are in "...", with ""
/// for a quote. The separator is the first of the two in the first line, outside of quotes. Empty lines are skipped.
///
/// The first line may name the columns in any order: `feature`, `owner`, and optionally `share`, `right` and `source`.
/// Optional fields may then be empty or missing. Without this line, the columns are feature, owner and optionally share.
///
/// A feature is an id or a query. A share is a fraction (1/2), a percentage (50%) or a number (0.5). A right is one of
/// rightTypes(), ownership by default. Several owners of a feature have a row each, with their shares, which add up to 1
/// at most. Other rights do not restrict each other. The same owner may have any number of features.
/// \param file  name for messages
/// \param unknown  receives a warning for each row that names no feature, which has no effect then; null, or if there is
///                 no other row: an error
/// \return the table, or an error with its line:
///         - BadValue         unknown or missing columns, an empty field, an open quote, a bad share, an unknown right,
///                            or no rows. Several owners of a feature without shares, or with more than 1 in all.
///         - NothingSelected  neither an id nor a query that selects something (names the nearest).
///         - InputTooBig      over 64 MiB, rows that look at more than 2^30 features in all, or more than 2^24 rights.
/// Cost: O(bytes + labels of all extents) for ids; a query O(labels).
[[nodiscard]] Result<OwnerTable> parseOwners(std::string_view text, std::string_view file,
                                             const volume::LabelTable& labels, Diagnostics* unknown = nullptr);

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
    double own = 0;     ///< listed in the table, by shares
    double alone = 0;   ///< its share of components that touch only spaces of the same owners
    double shared = 0;  ///< its share of the others
    /// Breakdown of the shares of components by co-owner: the part in components in which this other owner has a share,
    /// too. A component of three owners counts for each pair. In order, unowned last; `area` is the owner's own contact
    /// with those components.
    std::vector<OwnerShare> with;
};

/// The common property of a storey of a building: volumes of the features that are not in the table, m3.
struct CommonProperty {
    std::uint32_t building = volume::kNoLabel;  ///< kNoLabel: in none
    std::uint32_t storey = volume::kNoLabel;    ///< kNoLabel: in none, or in several
    double spaces = 0;
    double components = 0;
};

/// Totals of all owners, `unowned`, `untouched` and `unownedSpaces` add up to `all`.
struct Ownership {
    std::vector<OwnerTotal> owners;            ///< as in OwnerTable::names
    std::vector<DividedComponent> components;  ///< by label
    std::vector<double> ofFeature;             ///< m3 of each of OwnerTable::features; shared space divided
    std::vector<CommonProperty> common;        ///< by building, then storey; kNoLabel last
    double unowned = 0;                        ///< m3: the unowned shares of components
    double untouched = 0;                      ///< m3: components that touch no space
    double unownedSpaces = 0;                  ///< m3: spaces that are not listed, and shares that no owner has
    double shared = 0;                         ///< m3: of OwnerTable::shared
    double all = 0;                            ///< m3: of all labels, each counted once
};

/// Divides the components of `volume` between owners. The volume of a label is that of ownVolumes().
/// \param contacts  of the whole volume, see findContacts()
/// Cost: O(contacts + labels of the extents of buildings and storeys).
[[nodiscard]] Ownership divideByOwners(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts,
                                       const OwnerTable& table);

}  // namespace svt::analyze
