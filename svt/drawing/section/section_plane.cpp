#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/north.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace svt::drawing {
namespace {

std::string unquoted(const std::string& text) {
    const bool isQuoted =
        text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
    return isQuoted ? text.substr(1, text.size() - 2) : text;
}

// Extent of the volume along `normal`, metres from the grid's lower corner.
std::pair<double, double> extentAlong(Vec3d normal, const volume::Grid& grid) {
    std::pair<double, double> extent{0, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const double along = dot(normal, grid.axes()[static_cast<std::size_t>(axis)]) * grid.spacing()[axis];
        const double low = -0.5 * along, high = (grid.dimension()[axis] - 0.5) * along;
        extent.first += std::min(low, high);
        extent.second += std::max(low, high);
    }
    return extent;
}

// The horizontal axis of the grid, with its sign, that points most to `direction`.
Vec3d nearestSide(const volume::Grid& grid, Vec3d direction) {
    Vec3d nearest = grid.axes()[0];
    for (const Vec3d axis : {grid.axes()[0], -grid.axes()[0], grid.axes()[1], -grid.axes()[1]})
        if (dot(axis, direction) > dot(nearest, direction) + 1e-9) nearest = axis;
    return nearest;
}

}  // namespace

double hairOffFaces(const SectionPlane& plane, const volume::SemanticVolume& volume) {
    // In voxels: the distance that rounding moves faces, see voxelize.hpp, and the offset of samples from whole
    // indices.
    constexpr double kRounding = 1.0 / 256, kShift = 0.5 - 1.0 / 512;
    constexpr double kInFace = 2e-4;  // metres
    const volume::Grid& grid = volume.grid;
    // Each face's height over the plane, towards the side that is cut away.
    std::vector<double> heights;
    double reach = kInFace;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = dot(plane.normal, grid.axes()[static_cast<std::size_t>(axis)]);
        reach = std::max(reach, 1.5 * kRounding * std::abs(along) * grid.spacing()[axis]);
    }
    for (const volume::FacePlane& face : volume.planes) {
        Vec3d normal{};
        for (int axis = 0; axis < 3; ++axis)
            normal =
                normal + grid.axes()[static_cast<std::size_t>(axis)] * (face.plane.normal[axis] / grid.spacing()[axis]);
        const double size = length(normal);
        if (!(size > 0) || length(cross(normal, plane.normal)) > 1e-6 * size) continue;
        const Vec3d n = face.plane.normal;
        const double at =
            -(face.plane.offset + kShift * (n.x + n.y + n.z)) / size * (dot(normal, plane.normal) < 0 ? -1 : 1);
        heights.push_back(at - dot(plane.normal, plane.point - grid.origin()));
    }
    // Downwards from the plane: past each face that is met within reach.
    std::sort(heights.begin(), heights.end(), std::greater<>());
    double moved = 0;
    for (const double height : heights)
        if (std::abs(height + moved) <= reach) moved = 2.5 * reach - height;
    return moved;
}

SectionPlane keptOffFaces(SectionPlane plane, const volume::SemanticVolume& volume) {
    const double moved = hairOffFaces(plane, volume);
    if (moved != 0) plane.point = plane.point - plane.normal * moved;
    return plane;
}

bool meetsGrid(const SectionPlane& plane, const volume::Grid& grid) {
    const auto [low, high] = extentAlong(plane.normal, grid);
    const double at = dot(plane.normal, plane.point - grid.origin());
    return low <= at && at <= high;
}

SectionPlane defaultSectionPlane(const volume::SemanticVolume& volume) {
    const volume::Grid& grid = volume.grid;
    SectionPlane plane{grid.axes()[2], grid.origin()};
    for (const BuildingLevel& level : findLevels(volume)) {
        if (!level.isGround) continue;
        plane.point = grid.origin() + plane.normal * (level.floor + kCutAboveFloor);
        plane.bound = level.bound;
        if (meetsGrid(plane, grid)) return plane;
    }
    plane.bound = 0;
    plane.point = grid.origin() + plane.normal * (0.5 * (grid.dimension().z - 1) * grid.spacing().z);
    return plane;
}

std::array<std::string_view, 4> elevationSides(const volume::SemanticVolume& volume) {
    const North north = northOf(volume);
    // The side nearest to north, and the others clockwise. One rounding for all keeps the four names different.
    const Vec3d first = nearestSide(volume.grid, north.direction());
    const std::size_t eighth = north.eighthOf(first);
    const auto names = compassNames();
    return {names[eighth % 8], names[(eighth + 2) % 8], names[(eighth + 4) % 8], names[(eighth + 6) % 8]};
}

Result<SectionPlane> elevationPlane(std::string_view side, const volume::SemanticVolume& volume) {
    constexpr double kBefore = 0.01;  // metres
    const auto names = compassNames();
    const auto found = std::find(names.begin(), names.end(), side);
    if (found == names.end())
        return Error(Code::BadSection,
                     fmt::format("the elevation '{}': expected north, east, south, west, or a direction between them, "
                                 "such as north-east",
                                 side));
    const volume::Grid& grid = volume.grid;
    const Vec3d normal = nearestSide(grid, northOf(volume).direction(45.0 * double(found - names.begin())));
    double before = extentAlong(normal, grid).second;
    if (!volume.vectors.triangles.empty()) {
        before = -kInfinity;
        for (const auto& triangle : volume.vectors.triangles)
            for (const std::uint32_t corner : triangle.corners)
                before = std::max(before, dot(volume.vectors.position(corner, {}), normal));
    }
    return SectionPlane{normal, grid.origin() + normal * (before + kBefore)};
}

Result<SectionPlane> parseSectionPlane(std::string_view text, const volume::SemanticVolume& volume) {
    return parseSectionPlane(text, volume, volume.labels);
}

Result<SectionPlane> parseSectionPlane(std::string_view text, const volume::SemanticVolume& volume,
                                       const analyze::LabelRows& rows) {
    const volume::Grid& grid = volume.grid;
    const auto badSection = [&](const std::string& reason) {
        return Error(Code::BadSection, fmt::format("the section '{}': {}", text, reason));
    };
    const std::string expected =
        "expected z=1.2, y<3 or x>4 (metres from the lower corner), z=abs(112.3) (in the CRS), storey=NAME+1.1, or "
        "A,B,C,D with "
        "A x + B y + C z + D > 0 cut away";
    SectionPlane plane;
    const std::string copy(text);
    const std::size_t at = copy.find_first_of("=<>");
    if (at == 1 && std::string_view("xyz").find(copy[0]) != std::string_view::npos) {
        const bool isAbsolute = copy.compare(2, 4, "abs(") == 0 && copy.ends_with(')');
        const auto value = parseNumber(withoutBlanks(isAbsolute ? text.substr(6, text.size() - 7) : text.substr(2)));
        if (!value) return badSection(expected);
        const int number = copy[0] - 'x';
        const Vec3d axis = grid.axes()[static_cast<std::size_t>(number)];
        if (isAbsolute && std::abs(axis[number]) < 1 - 1e-12)
            return badSection(
                fmt::format("the grid is turned, so {} has no coordinate of its own in the CRS; give "
                            "metres from the lower corner",
                            copy[0]));
        const double from = isAbsolute ? dot(axis, grid.origin()) : 0;
        plane = {axis * (copy[1] == '<' ? -1.0 : 1.0), grid.origin() + axis * (*value - from)};
    } else if (copy.rfind("storey=", 0) == 0) {
        // Split at the last sign, if a number follows; names may contain signs.
        const std::size_t sign = copy.find_last_of("+-");
        std::optional<double> above;
        if (sign != std::string::npos) above = parseNumber(text.substr(sign));
        const auto heights =
            storeyHeights(unquoted(copy.substr(7, above ? sign - 7 : std::string::npos)), volume, rows);
        if (!heights) return heights.error();
        plane = {grid.axes()[2], grid.origin() + grid.axes()[2] * (heights->floor + above.value_or(1.0)),
                 heights->bound};
    } else {
        const auto numbers = parseNumbers(text, 4);
        if (!numbers || numbers->size() != 4) return badSection(expected);
        const Vec3d normal{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
        if (!(length(normal) > 0)) return badSection("the normal is zero; give a direction that is cut away");
        plane = {normalized(normal), grid.origin() + normal * (-(*numbers)[3] / dot(normal, normal))};
    }
    if (meetsGrid(plane, grid)) return plane;
    const auto [low, high] = extentAlong(plane.normal, grid);
    return badSection(fmt::format(
        "the plane does not meet the volume: along its normal it lies at {:.3f} m from the lower corner, the volume "
        "from {:.3f} to {:.3f} m",
        dot(plane.normal, plane.point - grid.origin()), low, high));
}

}  // namespace svt::drawing
