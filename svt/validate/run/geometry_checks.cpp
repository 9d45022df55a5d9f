#include <svt/validate/run/geometry_checks.hpp>

#include <svt/validate/run/indoor_checks.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::validate {
namespace {

using model::Feature;
using model::FeatureIndex;
using model::Geometry;
using model::SurfaceUse;

bool isPartOfBuilding(const Feature& feature) {
    return feature.className == "Building" || feature.className == "BuildingPart";
}

class GroupChecker {
public:
    GroupChecker(const model::BuildingModel& model, const Lattice& lattice, const ValidateOptions& options,
                 const std::vector<std::uint32_t>& groupOfPolygon, std::uint32_t group)
        : model_(model),
          lattice_(lattice),
          options_(options),
          groupOfPolygon_(groupOfPolygon),
          group_(group),
          tolerances_{options.snap, options.planarity, options.normalsDegrees},
          snap_(options.snap / lattice.unit()),
          overlap_(std::max({options.snap, 2 * options.overlap, 4 * lattice.unit()}) / lattice.unit()) {}

    GroupReport run(const std::vector<FeatureIndex>& members) {
        // Solids first: a face of a solid is reported with the solid, not with the wall that also uses it.
        for (const bool areSolids : {true, false})
            for (const FeatureIndex feature : members)
                forEachGeometry(feature, [&](int g, const Geometry& geometry) {
                    if ((geometry.kind == model::GeometryKind::Solid) == areSolids) checkGeometry(feature, g, geometry);
                });
        for (const FeatureIndex root : members)
            if (model_.features[root].parent == model::kNoFeature) compareParts();
        for (const FeatureIndex feature : members) {
            bool hasGeometry = false;
            forEachGeometry(feature, [&](int, const Geometry&) { hasGeometry = true; });
            if (hasGeometry) report_.features.emplace_back(feature, invalid_.count(feature) == 0);
        }
        return std::move(report_);
    }

private:
    template <class Visit>
    void forEachGeometry(FeatureIndex index, const Visit& visit) const {
        const Feature& feature = model_.features[index];
        if (options_.lod >= 0) {
            const int chosen = model::LodChoice{options_.lod}.choose(feature);
            if (chosen >= 0) visit(chosen, feature.geometries[static_cast<std::size_t>(chosen)]);
            return;
        }
        for (std::size_t g = 0; g < feature.geometries.size(); ++g) visit(static_cast<int>(g), feature.geometries[g]);
    }

    void report(FeatureIndex feature, int geometry, Defect defect) {
        invalid_[feature] = true;
        if (report_.counts[defect.code]++ >= Finding::kKeptPerCode) return;
        Finding& finding = report_.findings.emplace_back();
        finding.code = defect.code;
        finding.feature = feature;
        finding.geometry = geometry;
        finding.solid = defect.solid;
        finding.shell = defect.shell;
        finding.polygon = defect.polygon;
        finding.at = defect.at;
        finding.value = defect.value;
        finding.message = std::move(defect.message);
        finding.marks = std::move(defect.marks);
    }

    // The test of a polygon, done once.
    const CheckedPolygon& checked(model::PolygonIndex polygon, FeatureIndex feature, int geometry, int solid,
                                  int shell) {
        const auto [at, isNew] = polygons_.try_emplace(polygon);
        if (!isNew) return at->second;
        at->second = checkPolygon(model_.polygons[polygon], lattice_, tolerances_);
        if (groupOfPolygon_[polygon] == group_) {
            ++report_.polygonCount;
            for (Defect defect : at->second.defects) {
                defect.polygon = polygon;
                defect.solid = solid;
                defect.shell = shell;
                report(feature, geometry, std::move(defect));
            }
        }
        return at->second;
    }

    // Tests the polygons of a shell and puts them on common points; false if one is not valid.
    bool readShell(const std::vector<SurfaceUse>& uses, Snapper& points, Shell& shell, FeatureIndex feature,
                   int geometry, int solid, int number) {
        bool isValid = true;
        std::vector<std::uint32_t> ids;
        for (const SurfaceUse& use : uses) {
            const CheckedPolygon& result = checked(use.polygon, feature, geometry, solid, number);
            isValid = isValid && result.defects.empty();
            if (!isValid) continue;
            const model::Polygon& polygon = model_.polygons[use.polygon];
            ids.clear();
            for (const Vec3d& p : polygon.points) ids.push_back(points.add(lattice_.toLattice(p)));
            addFace(use, polygon, result, ids, shell);
        }
        return isValid;
    }

    static void addFace(const SurfaceUse& use, const model::Polygon& polygon, const CheckedPolygon& result,
                        const std::vector<std::uint32_t>& ids, Shell& shell) {
        Face face;
        face.polygon = use.polygon;
        std::uint32_t begin = 0;
        for (const std::uint32_t end : polygon.ringEnds) {
            std::vector<std::uint32_t> ring;
            for (std::uint32_t i = begin; i < end; ++i)
                if (ring.empty() || ring.back() != ids[i]) ring.push_back(ids[i]);
            while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
            if (use.isReversed) std::reverse(ring.begin(), ring.end());
            if (ring.size() > 2) face.rings.push_back(std::move(ring));
            begin = end;
        }
        if (face.rings.empty()) return;
        for (const Corners& t : result.triangles) {
            const Corners corners{ids[t[0]], ids[t[use.isReversed ? 2 : 1]], ids[t[use.isReversed ? 1 : 2]]};
            if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
            shell.triangles.push_back(corners);
            shell.faceOf.push_back(static_cast<std::uint32_t>(shell.faces.size()));
        }
        shell.faces.push_back(std::move(face));
    }

    void checkGeometry(FeatureIndex feature, int number, const Geometry& geometry) {
        const std::size_t before = foundSoFar();
        if (geometry.kind == model::GeometryKind::Surface)
            checkSurfaces(feature, number, geometry);
        else
            checkSolids(feature, number, geometry);
        report_.primitives.push_back({primitiveType(geometry), foundSoFar() == before});
    }

    [[nodiscard]] std::size_t foundSoFar() const {
        std::size_t count = 0;
        for (const auto& entry : report_.counts) count += entry.second;
        return count;
    }

    void checkSurfaces(FeatureIndex feature, int number, const Geometry& geometry) {
        if (!geometry.isComposite) {
            for (const SurfaceUse& use : geometry.surfaces) checked(use.polygon, feature, number, -1, -1);
            return;
        }
        Snapper points(snap_);
        Shell shell;
        if (!readShell(geometry.surfaces, points, shell, feature, number, -1, -1) || shell.faces.empty()) return;
        const PointSet set{&points.points(), &lattice_, snap_};
        for (Defect& defect : checkShell(shell, set, ShellRules{false})) report(feature, number, std::move(defect));
    }

    void checkSolids(FeatureIndex feature, int number, const Geometry& geometry) {
        const auto points = std::make_shared<Snapper>(snap_);
        SolidBodies part{feature, number, geometry.lod, points, {}};
        std::vector<std::vector<Shell>> solids;
        SolidVolume volume{0.0, Code::Internal};
        bool areValid = true;
        for (std::size_t s = 0; s < geometry.solids.size(); ++s) {
            std::vector<Shell> shells;
            const std::optional<Code> defect =
                checkOneSolid(feature, number, geometry.solids[s], static_cast<int>(s), *points, shells);
            const PointSet set{&points->points(), &lattice_, snap_};
            if (defect && *defect != Code::ShellTurnedOver) {
                areValid = false;
                if (volume.volume) volume = {std::nullopt, *defect};
            } else if (volume.volume) {
                *volume.volume += volumeOf(shells, set);
            }
            areValid = areValid && !defect;
            solids.push_back(std::move(shells));
        }
        if (areValid) {
            const PointSet set{&points->points(), &lattice_, snap_};
            for (const std::vector<Shell>& shells : solids) part.solids.push_back(bodyOf(shells, set));
            if (const auto conflict = compareSolids(feature, number, geometry, part, set))
                volume = {std::nullopt, *conflict};
            if (isPartOfBuilding(model_.features[feature]))
                parts_.push_back(std::move(part));
            else if (isCellSpace(model_.features[feature]))
                report_.cells.push_back(std::move(part));
        }
        report_.volumes.push_back({feature, number, volume});
    }

    // Returns the first defect, empty for a valid solid.
    std::optional<Code> checkOneSolid(FeatureIndex feature, int number, const model::Solid& solid, int solidNumber,
                                      Snapper& points, std::vector<Shell>& shells) {
        shells.resize(1 + solid.interiors.size());
        bool areValid = true;
        std::optional<Code> first;
        for (std::size_t s = 0; s < shells.size(); ++s) {
            const bool isValid = readShell(s == 0 ? solid.exterior : solid.interiors[s - 1], points, shells[s], feature,
                                           number, solidNumber, static_cast<int>(s));
            if (!isValid && !first) first = Code::TriangulationFailed;
            areValid = areValid && isValid;
        }
        if (!areValid) return first;
        const PointSet set{&points.points(), &lattice_, snap_};
        const auto keep = [&](std::vector<Defect> defects, int shell) {
            for (Defect& defect : defects) {
                if (!first) first = defect.code;
                defect.solid = solidNumber;
                if (shell >= 0) defect.shell = shell;
                report(feature, number, std::move(defect));
            }
        };
        for (std::size_t s = 0; s < shells.size(); ++s) keep(checkShell(shells[s], set), static_cast<int>(s));
        if (!first) keep(checkSolid(shells, set), -1);
        return first;
    }

    // Solids of one geometry. Solids of a MultiSolid may have any position, but if they overlap, the geometry has no
    // defined volume.
    std::optional<Code> compareSolids(FeatureIndex feature, int number, const Geometry& geometry,
                                      const SolidBodies& part, const PointSet& set) {
        if (part.solids.size() < 2) return std::nullopt;
        std::optional<Code> first;
        if (geometry.isComposite) {
            for (Defect& defect : checkComposite(part.solids, set, overlap_)) {
                if (!first && defect.code != Code::SolidsDisconnected) first = defect.code;
                report(feature, number, std::move(defect));
            }
            return first;
        }
        for (std::size_t i = 0; i < part.solids.size() && !first; ++i)
            for (std::size_t j = i + 1; j < part.solids.size() && !first; ++j)
                if (const auto conflict = findConflict(part.solids[i], part.solids[j], snap_))
                    first = conflict->areSame ? Code::DuplicateSolid : Code::SolidsIntersect;
        return first;
    }

    // Bodies of a building at one level of detail, those of its parts included.
    void compareParts() {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            for (std::size_t j = i + 1; j < parts_.size(); ++j)
                if (parts_[i].lod == parts_[j].lod) comparePair(parts_[i], parts_[j]);
    }

    void comparePair(const SolidBodies& one, const SolidBodies& other) {
        for (const Body& a : one.solids)
            for (const Body& b : other.solids) {
                const auto conflict = findConflict(a, b, overlap_);
                if (!conflict) continue;
                Defect defect;
                defect.code = Code::PartsOverlap;
                defect.at = lattice_.toWorld(conflict->at);
                const std::string& id = model_.features[other.feature].id;
                defect.message = conflict->areSame ? fmt::format("the solid is the same as that of '{}'", id)
                                                   : fmt::format("the solid overlaps with that of '{}', by {} or more",
                                                                 id, depthText(*conflict->depth));
                if (conflict->depth) defect.value = *conflict->depth * lattice_.unit();
                for (const Corners& t : b.triangles())
                    if (defect.marks.size() < kLargestDefectCount)
                        defect.marks.push_back({b.points().world(t[0]), b.points().world(t[1])});
                report(one.feature, one.geometry, std::move(defect));
                return;
            }
    }

    [[nodiscard]] std::string depthText(double units) const { return fmt::format("{:.3f} m", units * lattice_.unit()); }

    const model::BuildingModel& model_;
    const Lattice& lattice_;
    const ValidateOptions& options_;
    const std::vector<std::uint32_t>& groupOfPolygon_;
    std::uint32_t group_;
    PolygonTolerances tolerances_;
    double snap_, overlap_;  // units
    std::unordered_map<model::PolygonIndex, CheckedPolygon> polygons_;
    std::vector<SolidBodies> parts_;
    std::map<FeatureIndex, bool> invalid_;
    GroupReport report_;
};

}  // namespace

GroupReport checkGroup(const model::BuildingModel& model, const Lattice& lattice, const ValidateOptions& options,
                       const std::vector<FeatureIndex>& members, const std::vector<std::uint32_t>& groupOfPolygon,
                       std::uint32_t group) {
    return GroupChecker(model, lattice, options, groupOfPolygon, group).run(members);
}

}  // namespace svt::validate
