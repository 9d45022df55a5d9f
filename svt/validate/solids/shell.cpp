#include <svt/validate/solids/shell.hpp>

#include <svt/validate/solids/crossings.hpp>
#include <svt/validate/solids/shell_topology.hpp>

#include <fmt/format.h>

namespace svt::validate {

std::vector<Defect> checkShell(const Shell& shell, const PointSet& points, const ShellRules& rules) {
    std::vector<Defect> defects;
    constexpr std::size_t kTetrahedron = 4;
    if (rules.isClosed && shell.faces.size() < kTetrahedron) {
        Defect& defect = defects.emplace_back();
        defect.code = Code::TooFewFaces;
        defect.message = fmt::format("the shell has {} faces, fewer than four", shell.faces.size());
        if (!shell.faces.empty()) {
            defect.at = points.world(shell.faces.front().rings.front().front());
            defect.polygon = shell.faces.front().polygon;
        }
        return defects;
    }
    checkManifold(shell, points, rules, defects);
    if (defects.empty()) checkOnePiece(shell, points, defects);
    if (defects.empty() && rules.isClosed) checkClosed(shell, points, defects);
    if (defects.empty()) checkIntersections(shell, points, defects);
    return defects;
}

double sixfoldVolume(std::span<const Corners> triangles, const PointSet& points) noexcept {
    if (triangles.empty()) return 0;
    const Vec3d origin = points.units(triangles.front()[0]);
    double sum = 0;
    for (const Corners& t : triangles)
        sum += dot(points.units(t[0]) - origin, cross(points.units(t[1]) - origin, points.units(t[2]) - origin));
    return sum;
}

}  // namespace svt::validate
