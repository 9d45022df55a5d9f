#pragma once
/// \file
/// Measures the objects of a volume for a take-off.

#include <apps/cli/quantities/take_off.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::cli {

/// Queries and options of a take-off.
struct TakeOffQuestion {
    std::string where, by, formwork;  ///< queries and keys; empty: none
    bool exterior = false;
    int threads = 0;      ///< 0: all cores
    bool isPart = false;  ///< the volume is one of many: a query may select nothing in it
};

/// The labels that a query selects, ascending. \param isPart  as in TakeOffQuestion: empty if it selects nothing
/// \return the labels, or an error of analyze::selectLabels()
[[nodiscard]] Result<std::vector<std::uint32_t>> selectedLabels(const volume::SemanticVolume& volume,
                                                                const std::string& query, bool isPart);

/// The areas of --exterior and --formwork. They stay empty for objects that lack a mesh.
/// \return nothing, or an error of the query
[[nodiscard]] Result<void> addTouchingAreas(const TakeOffQuestion& question, TakeOff& takeOff);

/// Storeys, materials, and the values of the keys.
void addTexts(const TakeOffQuestion& question, TakeOff& takeOff);

/// All of a take-off for objects of quantities::measureObjects().
/// \return nothing, or an error of a query
[[nodiscard]] Result<void> completeTakeOff(const TakeOffQuestion& question, TakeOff& takeOff);

}  // namespace svt::cli
