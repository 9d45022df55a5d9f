#pragma once
/// \file
/// Profiles of swept solids as polygons in their plane.

#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <string>
#include <vector>

namespace svt::readers::ifc {

/// One area of a profile, metres, z = 0. The outer ring is counter-clockwise, the holes are clockwise; no closing point.
struct Region {
    std::vector<Vec3d> outer;
    std::vector<std::vector<Vec3d>> holes;

    [[nodiscard]] std::size_t pointCount() const noexcept {
        std::size_t count = outer.size();
        for (const std::vector<Vec3d>& hole : holes) count += hole.size();
        return count;
    }
};

/// The areas of a profile: one, but for composite profiles. Reads all profiles of IFC2x3 to IFC4.3 that bound an area.
/// \return false where it is of another kind or makes no sense, or file.guard() ends it; `why` says which
[[nodiscard]] bool readProfile(const IfcFile& file, RecordIndex profile, std::vector<Region>& regions,
                               std::string& why);

}  // namespace svt::readers::ifc
