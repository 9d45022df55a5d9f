#pragma once
/// \file
/// The attribute `owner` of a legal unit in files that also have its rights.

#include <svt/analyze/land_administration.hpp>
#include <svt/core/text.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::writers {

/// Whether an attribute of the model is an owner that a table of owners replaces.
[[nodiscard]] inline bool isReplacedOwner(const analyze::LandAdministration& all, std::string_view name) {
    return all.partySource == analyze::PartySource::Table && equalsIgnoringCase(name, "owner");
}

/// The party that owns all of a unit by a table, so that a reader of attributes finds it; empty for several parties,
/// and for owners by attributes, which the file has anyway.
/// \param space  number of the legal space of the unit
[[nodiscard]] inline std::string soleOwner(const analyze::LandAdministration& all, std::uint32_t space) {
    if (all.partySource != analyze::PartySource::Table) return {};
    const analyze::PartyRight* sole = nullptr;
    for (const analyze::PartyRight& right : all.rights) {
        if (all.units[right.unit].space != space) continue;
        if (sole != nullptr) return {};
        sole = &right;
    }
    return sole != nullptr ? all.parties[sole->party] : std::string();
}

}  // namespace svt::writers
