#include <svt/render/frame/share.hpp>
#include <svt/render/shapes.hpp>

#include <fmt/format.h>

namespace svt::render {
namespace {

Error bad(std::string message) { return Error(Code::BadFrame, std::move(message)); }

Result<void> checkSet(const LineSet& set, std::size_t number) {
    if (!isColor(set.color) || !isShare(set.hiddenOpacity))
        return bad(fmt::format("lines {}: colour and opacity must be 0 to 1", number));
    if (!(set.width >= 0.1f && set.width <= 64))
        return bad(
            fmt::format("lines {}: a width of {} pixels is out of range; 0.1 to 64 are possible", number, set.width));
    if (!(set.dash >= 0.5f && set.dash <= 1000) || !(set.gap >= 0.5f && set.gap <= 1000))
        return bad(
            fmt::format("lines {}: dashes of {} and gaps of {} pixels are out of range; 0.5 to 1000 are possible",
                        number, set.dash, set.gap));
    for (const Line& line : set.lines)
        if (!isFinite(line.from) || !isFinite(line.to))
            return bad(fmt::format("lines {}: a point is not finite", number));
    return {};
}

}  // namespace

Result<void> checkShapes(const std::vector<LineSet>& lines, const std::vector<MeshTriangle>& triangles) {
    std::size_t count = 0;
    for (std::size_t number = 0; number < lines.size(); ++number) {
        count += lines[number].lines.size();
        SVT_DO(checkSet(lines[number], number));
    }
    if (count > kMaxShapes || triangles.size() > kMaxShapes)
        return bad(fmt::format("{} lines and {} triangles are over the limit of {} each", count, triangles.size(),
                               kMaxShapes));
    for (const MeshTriangle& triangle : triangles)
        for (const Vec3d corner : triangle.corners)
            if (!isFinite(corner)) return bad("a corner of a triangle is not finite");
    return {};
}

}  // namespace svt::render
