#include <svt/analyze/land_administration.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace svt::analyze {
namespace {

constexpr double kLargestDenominator = 1e6, kTolerance = 1e-14;

std::string ownerAttribute(const volume::Label& label) {
    for (const Attribute& attribute : label.attributes)
        if (equalsIgnoringCase(attribute.name, "owner")) return toText(attribute.value);
    return {};
}

// The owners of units by their attributes, in the form of a table.
OwnerTable tableOfAttributes(const volume::LabelTable& labels) {
    OwnerTable table;
    std::unordered_map<std::string, std::uint32_t> numberOf;
    for (const std::uint32_t unit : unitsOf(labels)) {
        const std::string owner = ownerAttribute(labels.labels[unit]);
        if (owner.empty()) continue;
        const auto [at, isNew] = numberOf.try_emplace(owner, static_cast<std::uint32_t>(table.names.size()));
        if (isNew) table.names.push_back(owner);
        table.features.push_back({unit, {{at->second, 1}}, {}});
        table.rights.push_back({unit, at->second, 0, kOwnership, 1.0});
    }
    table.parties = table.names;
    table.sources = {{}};
    return table;
}

}  // namespace

std::optional<RightShare> shareOf(double fraction) noexcept {
    // Convergents of the continued fraction.
    double rest = fraction;
    std::int64_t above = 1, below = 0, aboveBefore = 0, belowBefore = 1;
    for (int step = 0; step < 40; ++step) {
        const double whole = std::floor(rest);
        const double nextBelow = whole * double(below) + double(belowBefore);
        if (nextBelow > kLargestDenominator) return std::nullopt;
        const auto nextAbove = static_cast<std::int64_t>(whole) * above + aboveBefore;
        aboveBefore = std::exchange(above, nextAbove);
        belowBefore = std::exchange(below, static_cast<std::int64_t>(nextBelow));
        if (std::abs(double(above) / double(below) - fraction) <= kTolerance) return RightShare{above, below};
        if (rest - whole < 1e-15) return std::nullopt;
        rest = 1 / (rest - whole);
    }
    return std::nullopt;
}

std::string shareText(const PartyRight& right) {
    if (right.share) return fmt::format("{}/{}", right.share->numerator, right.share->denominator);
    return right.fraction ? fmt::format("{}", *right.fraction) : std::string();
}

std::optional<double> sumOfShares(const LandAdministration& all, std::uint32_t unit, std::uint8_t type) {
    std::optional<double> sum;
    for (const PartyRight& right : all.rights)
        if (right.unit == unit && right.type == type && right.fraction) sum = sum.value_or(0) + *right.fraction;
    return sum;
}

Result<LandAdministration> makeLandAdministration(const volume::SemanticVolume& volume, const OwnerTable* table,
                                                  const std::string& tableName, const LegalSpaceOptions& options) {
    LandAdministration administration;
    const OwnerTable ofAttributes = table == nullptr ? tableOfAttributes(volume.labels) : OwnerTable();
    const OwnerTable& owners = table == nullptr ? ofAttributes : *table;
    administration.partySource = table == nullptr ? PartySource::Attributes : PartySource::Table;
    administration.partyFile = table == nullptr ? volume.source : tableName;
    administration.spatialFile = volume.source;
    administration.parties = owners.parties;
    administration.sources = owners.sources;
    administration.sources.front() = administration.partyFile;
    std::vector<std::uint32_t> labels = unitsOf(volume.labels);
    for (const TableRight& right : owners.rights) labels.push_back(right.label);
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    if (labels.empty())
        return Error(Code::NothingSelected,
                     "the model has no legal units (BuildingUnit); name features that belong to somebody in a table "
                     "(--owners)");
    administration.spaces = makeLegalSpaces(volume, labels, options);
    for (const TableRight& right : owners.rights) {
        if (administration.units.empty() || administration.units.back().label != right.label) {
            const auto space = std::lower_bound(labels.begin(), labels.end(), right.label) - labels.begin();
            administration.units.push_back({right.label, static_cast<std::uint32_t>(space)});
        }
        const auto unit = static_cast<std::uint32_t>(administration.units.size()) - 1;
        const std::optional<RightShare> share = right.fraction ? shareOf(*right.fraction) : std::nullopt;
        administration.rights.push_back({right.party, unit, right.type, right.source, right.fraction, share});
    }
    return administration;
}

}  // namespace svt::analyze
