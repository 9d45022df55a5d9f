#pragma once
/// \file
/// Parties, basic administrative units, rights, restrictions, responsibilities and sources of a building: ISO 19152,
/// from a table of owners.
///
///     LA_Party --- LA_RRR (type, share) --- LA_BAUnit --- LA_LegalSpaceBuildingUnit --- LA_BoundaryFace
///                        |                                         |
///              LA_AdministrativeSource                     LA_SpatialSource

#include <svt/analyze/legal_spaces.hpp>
#include <svt/analyze/owners.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::analyze {

/// A share as a fraction, for registers.
struct RightShare {
    std::int64_t numerator = 1, denominator = 1;
    friend bool operator==(const RightShare&, const RightShare&) = default;
};

/// The simplest fraction within 1e-14 of a share, with a denominator up to 10^6; nothing if there is none.
[[nodiscard]] std::optional<RightShare> shareOf(double fraction) noexcept;

/// A right, restriction or responsibility of a party in a unit.
struct PartyRight {
    std::uint32_t party = 0;          ///< index into LandAdministration::parties
    std::uint32_t unit = 0;           ///< index into LandAdministration::units
    std::uint8_t type = kOwnership;   ///< index into rightTypes()
    std::uint32_t source = 0;         ///< index into LandAdministration::sources
    std::optional<double> fraction;   ///< always known for ownership
    std::optional<RightShare> share;  ///< empty: the fraction is unknown or has no simple form
    [[nodiscard]] const RightType& rightType() const noexcept { return rightTypes()[type]; }
};

/// A basic administrative unit: a feature with rights.
struct AdministrativeUnit {
    std::uint32_t label = 0;
    std::uint32_t space = 0;  ///< index into LegalSpaces::spaces
};

/// The origin of the parties.
enum class PartySource : std::uint8_t {
    Table,      ///< a table of owners
    Attributes  ///< the attribute `owner` of the units in the model
};

struct LandAdministration {
    std::vector<std::string> parties;
    std::vector<AdministrativeUnit> units;  ///< by label
    std::vector<PartyRight> rights;         ///< by unit, then type; in order of the table
    /// Administrative sources of rights: the table or the model, then the documents that rows of the table name.
    std::vector<std::string> sources;
    LegalSpaces spaces;  ///< of the units of the model, and of the features of the table
    PartySource partySource = PartySource::Attributes;
    std::string partyFile;    ///< name of the table, or of the model; the first of `sources`
    std::string spatialFile;  ///< name of the model
};

/// The share of a right: "1/3"; the decimal fraction if it has no simple form, empty if it is unknown.
[[nodiscard]] std::string shareText(const PartyRight& right);

/// The sum of the shares of a type of right in a unit; nothing if no right of this type has a share.
[[nodiscard]] std::optional<double> sumOfShares(const LandAdministration& all, std::uint32_t unit, std::uint8_t type);

/// \param table      null: parties from the attribute `owner` of the units, each with the whole unit
/// \param tableName  name of the table's file
/// \return the administration, or NothingSelected: no units in the model and no table
[[nodiscard]] Result<LandAdministration> makeLandAdministration(const volume::SemanticVolume& volume,
                                                                const OwnerTable* table, const std::string& tableName,
                                                                const LegalSpaceOptions& options = {});

}  // namespace svt::analyze
