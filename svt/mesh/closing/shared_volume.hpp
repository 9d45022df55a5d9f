#pragma once
/// \file
/// Space that several solids of one object claim. Their volumes add up to more than that of the object.

#include <svt/mesh/closing/shell.hpp>
#include <svt/mesh/closing/sources.hpp>

#include <optional>
#include <vector>

namespace svt::mesh {

struct SharedVolume {
    double sum = 0;       ///< m3: of all solids
    double shared = 0;    ///< m3: of all pairs
    bool isKnown = true;  ///< false: three solids overlap each other, or there are too many faces to compare
    [[nodiscard]] bool isAny() const noexcept { return shared > 0 || !isKnown; }
    /// m3 of their union; nothing if it is unknown.
    [[nodiscard]] std::optional<double> unionVolume() const noexcept {
        return isKnown ? std::optional(sum - shared) : std::nullopt;
    }
};

/// The space that the solids of an object share, exact. Solids that only touch share none, nor do those that overlap by
/// less than kLeastOverlap on their faces.
/// \param solids  of splitIntoSolids()
/// \return nothing shared if a solid is not closed
/// Cost: O(solids * log solids), then for pairs whose boxes overlap that of plane::commonVolume().
[[nodiscard]] SharedVolume findSharedVolume(const std::vector<MeshSource>& solids, const ShellInput& input);

inline constexpr double kLeastOverlap = 1e-5;  ///< metres

}  // namespace svt::mesh
