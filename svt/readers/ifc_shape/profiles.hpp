#pragma once
/// \file
/// Profiles of swept solids as polygons in their plane.

#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace svt::readers::ifc {

/// One area of a profile, metres, z = 0. The outer ring is counter-clockwise, the holes are clockwise; no closing
/// point.
struct Region {
    std::vector<Vec3d> outer;
    std::vector<std::vector<Vec3d>> holes;

    [[nodiscard]] std::size_t pointCount() const noexcept {
        std::size_t count = outer.size();
        for (const std::vector<Vec3d>& hole : holes) count += hole.size();
        return count;
    }
    /// Whether the rings of another region have as many points each.
    [[nodiscard]] bool hasCornersOf(const Region& other) const noexcept {
        return outer.size() == other.outer.size() &&
               std::equal(holes.begin(), holes.end(), other.holes.begin(), other.holes.end(),
                          [](const auto& p, const auto& q) { return p.size() == q.size(); });
    }
    /// The region with `map` applied to each ring.
    template <class Map>
    [[nodiscard]] Region mapped(Map&& map) const {
        Region result{map(outer), {}};
        for (const std::vector<Vec3d>& hole : holes) result.holes.push_back(map(hole));
        return result;
    }
};

/// The areas of a profile: one, or several for composite profiles. Reads all profiles of IFC2x3 to IFC4.3 that bound an
/// area.
/// \return false for an unknown kind, invalid values, or a limit of file.guard(); `why` names the reason
[[nodiscard]] bool readProfile(const IfcFile& file, RecordIndex profile, std::vector<Region>& regions,
                               std::string& why);

}  // namespace svt::readers::ifc
