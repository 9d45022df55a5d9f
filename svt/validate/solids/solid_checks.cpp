#include <svt/validate/solids/solid_checks.hpp>

#include <svt/validate/polygons/groups.hpp>
#include <svt/validate/solids/interior.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::validate {
namespace {

// Steps within which shells of one solid touch: the largest error of rounding a common point to the lattice.
constexpr double kTouching = 4;

std::string nameOfShell(std::size_t shell) {
    return shell == 0 ? "the exterior shell" : fmt::format("interior shell {}", shell);
}

// The triangles of a shell, oriented away from the enclosed volume.
std::vector<Corners> outwards(const Shell& shell, const PointSet& points) {
    std::vector<Corners> triangles = shell.triangles;
    if (sixfoldVolume(triangles, points) < 0)
        for (Corners& t : triangles) std::swap(t[1], t[2]);
    return triangles;
}

Defect defectOf(Code code, const PointSet& points, Vec3d units, std::string message, std::size_t shell) {
    Defect defect;
    defect.code = code;
    defect.at = points.lattice->toWorld(units);
    defect.message = std::move(message);
    defect.shell = static_cast<int>(shell);
    return defect;
}

void markShell(Defect& defect, const Shell& shell, const PointSet& points) {
    constexpr std::size_t kMaxMarks = 200;
    for (const Face& face : shell.faces)
        for (const auto& ring : face.rings)
            for (std::size_t i = 0; i < ring.size() && defect.marks.size() < kMaxMarks; ++i)
                defect.marks.push_back({points.world(ring[i]), points.world(ring[i + 1 == ring.size() ? 0 : i + 1])});
}

std::vector<Box3d> boundsOf(const std::vector<Body>& bodies) {
    std::vector<Box3d> bounds;
    for (const Body& body : bodies) bounds.push_back(body.tree().bounds());
    return bounds;
}

// An interior shell compared with the exterior one.
std::optional<Defect> checkInterior(const Body& exterior, const Body& interior, std::size_t number,
                                    const PointSet& points) {
    const Relation relation = relate(interior, exterior, kTouching);
    const Share &own = relation.first, &around = relation.second;
    const std::string name = nameOfShell(number);
    if (relation.crossing)
        return defectOf(Code::ShellsIntersect, points, *relation.crossing, name + " crosses the exterior shell",
                        number);
    if (relation.shareFaces())
        return defectOf(Code::ShellsIntersect, points, own.onAt,
                        name + " has a part of a face in common with the exterior shell", number);
    if (around.inside > 0)
        return defectOf(Code::ShellsIntersect, points, around.insideAt, name + " encloses a part of the exterior shell",
                        number);
    if (own.outside == 0) return std::nullopt;
    if (own.inside > 0 || relation.haveContact)
        return defectOf(Code::ShellsIntersect, points, own.outsideAt, name + " leads out of the exterior shell",
                        number);
    return defectOf(Code::InnerShellOutside, points, own.outsideAt, name + " lies outside of the exterior shell",
                    number);
}

// Two interior shells compared with each other.
std::optional<Defect> checkInteriors(const Body& one, const Body& other, std::size_t i, std::size_t j,
                                     const PointSet& points) {
    const Relation relation = relate(one, other, kTouching);
    const std::string names = fmt::format("interior shells {} and {}", i, j);
    if (relation.areSame())
        return defectOf(Code::DuplicateShell, points, relation.first.onAt, names + " are the same", j);
    if (relation.crossing) return defectOf(Code::ShellsIntersect, points, *relation.crossing, names + " cross", j);
    if (relation.first.inside > 0 || relation.second.inside > 0)
        return defectOf(Code::ShellsIntersect, points,
                        relation.first.inside > 0 ? relation.first.insideAt : relation.second.insideAt,
                        names + " overlap", j);
    if (relation.shareFaces())
        return defectOf(Code::ShellsIntersect, points, relation.first.onAt, names + " have a part of a face in common",
                        j);
    return std::nullopt;
}

}  // namespace

std::vector<Defect> checkSolid(const std::vector<Shell>& shells, const PointSet& points) {
    std::vector<Defect> defects;
    for (std::size_t s = 0; s < shells.size(); ++s) {
        const double volume = sixfoldVolume(shells[s].triangles, points);
        if (s == 0 ? volume > 0 : volume < 0) continue;
        defects.push_back(defectOf(Code::ShellTurnedOver, points, points.units(shells[s].triangles.front()[0]),
                                   nameOfShell(s) + (s == 0 ? " faces inwards" : " faces out of its void"), s));
        markShell(defects.back(), shells[s], points);
    }
    if (!defects.empty() || shells.size() < 2) return defects;
    std::vector<Body> bodies;
    bodies.reserve(shells.size());
    for (const Shell& shell : shells) bodies.emplace_back(outwards(shell, points), points);
    const auto keep = [&](std::optional<Defect> defect, std::size_t shell) {
        if (!defect || defects.size() >= kLargestDefectCount) return;
        markShell(*defect, shells[shell], points);
        defects.push_back(std::move(*defect));
    };
    for (std::size_t i = 1; i < bodies.size(); ++i) keep(checkInterior(bodies[0], bodies[i], i, points), i);
    const plane::BoxTree bounds = treeOf(boundsOf(bodies));
    for (std::size_t i = 1; i < bodies.size(); ++i)
        for (const std::uint32_t j : bounds.findAll(plane::grown(bodies[i].tree().bounds(), 1)))
            if (j > i) keep(checkInteriors(bodies[i], bodies[j], i, j, points), j);
    if (!defects.empty()) return defects;
    std::vector<Body> material;  // oriented away from the material between the shells
    material.reserve(shells.size());
    for (const Shell& shell : shells) material.emplace_back(shell.triangles, points);
    std::vector<const Body*> pointers;
    for (const Body& body : material) pointers.push_back(&body);
    if (const auto at = findCutOffPart(pointers, kTouching)) {
        defects.push_back(defectOf(Code::SolidSplit, points, *at,
                                   "shells touch so that they cut the interior of the solid in two", 1));
        defects.back().shell = -1;
        for (std::size_t s = 1; s < shells.size(); ++s) markShell(defects.back(), shells[s], points);
    }
    return defects;
}

double volumeOf(const std::vector<Shell>& shells, const PointSet& points) noexcept {
    const double unit = points.lattice->unit();
    double volume = 0;
    for (std::size_t s = 0; s < shells.size(); ++s) {
        const double own = std::abs(sixfoldVolume(shells[s].triangles, points)) / 6 * unit * unit * unit;
        volume += s == 0 ? own : -own;
    }
    return volume;
}

Body bodyOf(const std::vector<Shell>& shells, const PointSet& points) {
    std::vector<Corners> triangles;
    for (const Shell& shell : shells) triangles.insert(triangles.end(), shell.triangles.begin(), shell.triangles.end());
    return Body(std::move(triangles), points);
}

std::optional<Conflict> findConflict(const Body& a, const Body& b, double noise) {
    const Box3d one = a.tree().bounds(), other = b.tree().bounds();
    // Boxes that overlap by less than the depth hold no overlap that is deeper.
    if (!plane::grown(one, -std::trunc(noise)).overlaps(other)) return std::nullopt;
    const Relation relation = relate(a, b, noise);
    if (!relation.overlap()) return std::nullopt;
    Conflict conflict;
    conflict.areSame = relation.areSame();
    const bool isFirst = relation.first.depth >= relation.second.depth;
    conflict.at = conflict.areSame ? relation.first.onAt : isFirst ? relation.first.insideAt : relation.second.insideAt;
    if (!conflict.areSame) conflict.depth = std::max(relation.first.depth, relation.second.depth);
    return conflict;
}

std::vector<Defect> checkComposite(const std::vector<Body>& solids, const PointSet& points, double noise) {
    std::vector<Defect> defects;
    Groups groups(solids.size());
    const plane::BoxTree bounds = treeOf(boundsOf(solids));
    for (std::size_t i = 0; i < solids.size(); ++i)
        for (const std::uint32_t j : bounds.findAll(plane::grown(solids[i].tree().bounds(), std::ceil(noise) + 1))) {
            if (j <= i) continue;
            const Relation relation = relate(solids[i], solids[j], noise);
            if (relation.first.opposite > 0 || relation.second.opposite > 0) groups.join(i, j);
            if (!relation.overlap() || defects.size() >= kLargestDefectCount) continue;
            const bool isFirst = relation.first.depth >= relation.second.depth;
            const Vec3d at = relation.areSame() ? relation.first.onAt
                             : isFirst          ? relation.first.insideAt
                                                : relation.second.insideAt;
            Defect& defect = defects.emplace_back();
            defect.code = relation.areSame() ? Code::DuplicateSolid : Code::SolidsIntersect;
            defect.solid = static_cast<int>(j);
            defect.at = points.lattice->toWorld(at);
            defect.message = fmt::format("solids {} and {} of the composite {}", i + 1, j + 1,
                                         relation.areSame() ? "are the same" : "overlap");
        }
    if (!defects.empty()) return defects;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        if (groups.leaderOf(i) != i || i == 0) continue;
        Defect& defect = defects.emplace_back();
        defect.code = Code::SolidsDisconnected;
        defect.solid = static_cast<int>(i);
        defect.at = points.lattice->toWorld(solids[i].points().units(solids[i].triangles().front()[0]));
        defect.message = fmt::format("solid {} of the composite shares no face with those before it", i + 1);
        if (defects.size() >= kLargestDefectCount) break;
    }
    return defects;
}

}  // namespace svt::validate
