#include <svt/analyze/legal_spaces.hpp>

#include <svt/analyze/cadastre/face_planes.hpp>
#include <svt/analyze/cadastre/space_bodies.hpp>
#include <svt/model/classes.hpp>
#include <svt/plane/common_volume.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace svt::analyze {
namespace {

constexpr double kUpright = 0.01;      // normals whose z is below this look to a side
constexpr double kLeastVolume = 1e-6;  // m3; smaller overlaps come from rounding
constexpr double kRoundingOfSum = 1e-9;

using SpacePair = std::pair<std::uint32_t, std::uint32_t>;

class SpaceMaker {
public:
    SpaceMaker(const volume::SemanticVolume& volume, std::span<const std::uint32_t> labels,
               const LegalSpaceOptions& options)
        : volume_(volume), options_(options), extents_(volume.labels), labelOf_(volume.labels.labelOfScalar()) {
        makeSpaces(labels);
    }

    LegalSpaces run() {
        for (LegalSpace& space : found_.spaces) makeOutline(space);
        makeFaces();
        findOverlaps();
        findSharedFaces();
        findGaps();
        moveToWorld();
        std::sort(found_.relations.begin(), found_.relations.end(), [](const SpaceRelation& s, const SpaceRelation& t) {
            return std::tie(s.a, s.b, s.kind) < std::tie(t.a, t.b, t.kind);
        });
        std::sort(found_.withoutFaces.begin(), found_.withoutFaces.end());
        found_.withoutFaces.erase(std::unique(found_.withoutFaces.begin(), found_.withoutFaces.end()),
                                  found_.withoutFaces.end());
        return std::move(found_);
    }

private:
    void makeSpaces(std::span<const std::uint32_t> labels) {
        const BodyMaker maker(volume_, extents_, options_.maxBoxes);
        Box3d all;
        for (const std::uint32_t label : labels) {
            bool hasBoxes = true;
            found_.spaces.push_back(maker.make(label, hasBoxes));
            if (!hasBoxes) leaveOut(std::uint32_t(found_.spaces.size()) - 1);
            all.add(found_.spaces.back().box);
            extentOf_.push_back(extents_.of(label));
        }
        for (const Vec3d corner : {all.min, all.max})
            if (!all.isEmpty()) extent_ = std::max(extent_, length(corner) + 1);
    }

    void leaveOut(std::uint32_t space) { found_.withoutFaces.push_back(space); }

    // Whether one space is a part of the other.
    [[nodiscard]] bool areNested(std::uint32_t a, std::uint32_t b) const {
        const auto holds = [&](std::uint32_t outer, std::uint32_t inner) {
            return std::binary_search(extentOf_[outer].begin(), extentOf_[outer].end(), found_.spaces[inner].label);
        };
        return holds(a, b) || holds(b, a);
    }

    void makeOutline(LegalSpace& space) {
        PlaneOverlay overlay(extent_, options_.snap);
        for (const auto& solid : space.solids)
            for (const SpaceTriangle& t : solid) {
                const OverlayRing ring{{t[0].x, t[0].y}, {t[1].x, t[1].y}, {t[2].x, t[2].y}};
                const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
                if (normal.z > 1e-9) overlay.add(ring, 0);
            }
        const auto regions = overlay.run();
        if (!regions) return leaveOut(std::uint32_t(&space - found_.spaces.data()));
        for (const OverlayRegion& region : *regions)
            for (const OverlayPolygon& polygon : region.polygons)
                space.outline.push_back({polygon.outer, polygon.holes, polygon.area});
    }

    void makeFaces() {
        planes_ = facePlanes(found_.spaces, options_.flatness);
        for (const FacePlane& plane : planes_) {
            auto regions = regionsOf(plane, extent_, options_.snap);
            if (!regions) {
                for (const SpaceFacet& facet : plane.facets) leaveOut(facet.space);
                regions.emplace();
            }
            for (const BoundingRegion& region : *regions) addFaces(plane, region);
            regions_.push_back(std::move(*regions));
        }
        std::stable_sort(found_.faces.begin(), found_.faces.end(), [](const BoundaryFace& f, const BoundaryFace& g) {
            return std::tie(f.minus, f.plus) < std::tie(g.minus, g.plus);
        });
    }

    void addFaces(const FacePlane& plane, const BoundingRegion& region) {
        std::set<std::uint32_t> met;  // spaces above that a space below touches
        for (const std::uint32_t below : region.below) {
            bool isAlone = true;
            for (const std::uint32_t above : region.above) {
                if (areNested(below, above)) continue;
                isAlone = false;
                met.insert(above);
                for (const OverlayPolygon& polygon : region.polygons) addFace(plane, polygon, below, above, false);
            }
            if (isAlone)
                for (const OverlayPolygon& polygon : region.polygons) addFace(plane, polygon, below, kNoSpace, false);
        }
        for (const std::uint32_t above : region.above)
            if (met.count(above) == 0)
                for (const OverlayPolygon& polygon : region.polygons) addFace(plane, polygon, above, kNoSpace, true);
    }

    void addFace(const FacePlane& plane, const OverlayPolygon& polygon, std::uint32_t minus, std::uint32_t plus,
                 bool isReversed) {
        BoundaryFace face;
        face.minus = minus;
        face.plus = plus;
        face.normal = isReversed ? -plane.axes.normal : plane.axes.normal;
        face.area = polygon.area;
        face.direction = std::abs(face.normal.z) < kUpright ? FaceDirection::Side
                         : face.normal.z > 0                ? FaceDirection::Up
                                                            : FaceDirection::Down;
        face.low = kInfinity;
        face.high = -kInfinity;
        const auto addRing = [&](const OverlayRing& flat) {
            std::vector<Vec3d>& ring = face.rings.emplace_back();
            for (const OverlayPoint& p : flat) {
                ring.push_back(plane.axes.inSpace(p, plane.height));
                face.low = std::min(face.low, ring.back().z);
                face.high = std::max(face.high, ring.back().z);
            }
            if (isReversed) std::reverse(ring.begin(), ring.end());
        };
        addRing(polygon.outer);
        for (const OverlayRing& hole : polygon.holes) addRing(hole);
        found_.faces.push_back(std::move(face));
    }

    // Triangles above or below other bodies, in order of minX.
    [[nodiscard]] static std::vector<plane::RoofTriangle> roofsOf(const LegalSpace& space) {
        std::vector<plane::RoofTriangle> roofs;
        for (const auto& solid : space.solids)
            for (const SpaceTriangle& triangle : solid)
                if (plane::RoofTriangle roof; plane::makeRoofTriangle(triangle, roof)) roofs.push_back(roof);
        std::sort(roofs.begin(), roofs.end(), [](const plane::RoofTriangle& s, const plane::RoofTriangle& t) {
            return std::tie(s.minX, s.minY, s.maxX, s.maxY) < std::tie(t.minX, t.minY, t.maxX, t.maxY);
        });
        return roofs;
    }

    void findOverlaps() {
        std::vector<std::vector<plane::RoofTriangle>> roofs;
        for (const LegalSpace& space : found_.spaces) roofs.push_back(roofsOf(space));
        for (std::uint32_t a = 0; a < found_.spaces.size(); ++a)
            for (std::uint32_t b = a + 1; b < found_.spaces.size(); ++b) {
                const LegalSpace &one = found_.spaces[a], &other = found_.spaces[b];
                if (one.solids.empty() || other.solids.empty() || !one.box.overlaps(other.box) || areNested(a, b))
                    continue;
                const double ground = std::min(one.box.min.z, other.box.min.z);
                SpaceRelation relation{SpaceRelationKind::Overlap, a, b};
                relation.volume = std::max(0.0, plane::commonVolume(roofs[a], roofs[b], ground));
                relation.isExact = one.body != SpaceBody::Voxels && other.body != SpaceBody::Voxels;
                relation.bound = relation.isExact ? boundOf(one, other) : kInfinity;
                if (*relation.volume > std::max(kLeastVolume, relation.isExact ? relation.bound : 0))
                    found_.relations.push_back(std::move(relation));
            }
    }

    // Each face in the common box lies within the rounding of its corners; the sum of prisms rounds, too.
    [[nodiscard]] double boundOf(const LegalSpace& a, const LegalSpace& b) const {
        Box3d common;
        common.min = {std::max(a.box.min.x, b.box.min.x), std::max(a.box.min.y, b.box.min.y),
                      std::max(a.box.min.z, b.box.min.z)};
        common.max = {std::min(a.box.max.x, b.box.max.x), std::min(a.box.max.y, b.box.max.y),
                      std::min(a.box.max.z, b.box.max.z)};
        const Vec3d size = common.size() + Vec3d{1, 1, 1} * (2 * volume_.vectors.unit);
        const double largest = length(Vec3d{size.x * size.y, size.y * size.z, size.z * size.x});
        double area = 0;
        for (const LegalSpace* space : {&a, &b})
            for (const auto& solid : space->solids)
                for (const SpaceTriangle& t : solid) {
                    Box3d box;
                    for (const Vec3d& corner : t) box.add(corner);
                    if (common.overlaps(box)) area += std::min(0.5 * length(cross(t[1] - t[0], t[2] - t[0])), largest);
                }
        return area * volume_.vectors.unit + kRoundingOfSum * size.x * size.y * std::max(1.0, size.z);
    }

    void findSharedFaces() {
        std::map<SpacePair, SpaceRelation> byPair;
        for (std::uint32_t f = 0; f < found_.faces.size(); ++f) {
            const BoundaryFace& face = found_.faces[f];
            if (face.plus == kNoSpace) continue;
            const auto [a, b] = std::minmax(face.minus, face.plus);
            SpaceRelation& relation = byPair[{a, b}];
            relation.kind = SpaceRelationKind::SharedFace;
            relation.a = a;
            relation.b = b;
            relation.isExact = isExact(a) && isExact(b);
            relation.area = relation.area.value_or(0) + face.area;
            relation.faces.push_back(f);
        }
        for (auto& [pair, relation] : byPair) found_.relations.push_back(std::move(relation));
    }

    [[nodiscard]] bool isExact(std::uint32_t space) const { return found_.spaces[space].body != SpaceBody::Voxels; }

    // Faces that look at each other: those below a plane and those above a parallel one that is higher.
    void findGaps() {
        std::map<SpacePair, SpaceRelation> byPair;
        for (std::size_t p = 0; p < planes_.size(); ++p)
            for (std::size_t q = 0; q < planes_.size(); ++q) {
                const double width = planes_[q].height - planes_[p].height;
                if (width <= options_.flatness || width > options_.widestGap) continue;
                if (dot(planes_[p].axes.normal, planes_[q].axes.normal) < 1 - 1e-9) continue;
                addGaps(p, q, width, byPair);
            }
        for (auto& [pair, relation] : byPair) found_.relations.push_back(std::move(relation));
    }

    void addGaps(std::size_t p, std::size_t q, double width, std::map<SpacePair, SpaceRelation>& byPair) {
        // Claims: spaces below the lower plane are even, spaces above the upper plane odd.
        std::map<std::uint32_t, std::vector<const OverlayPolygon*>> claims;
        bool hasLower = false, hasUpper = false;
        for (const BoundingRegion& region : regions_[p]) {
            if (!region.above.empty()) continue;  // touches another space
            for (const std::uint32_t space : region.below)
                for (const OverlayPolygon& polygon : region.polygons) claims[2 * space].push_back(&polygon);
            hasLower = hasLower || !region.below.empty();
        }
        for (const BoundingRegion& region : regions_[q]) {
            if (!region.below.empty()) continue;
            for (const std::uint32_t space : region.above)
                for (const OverlayPolygon& polygon : region.polygons) claims[2 * space + 1].push_back(&polygon);
            hasUpper = hasUpper || !region.above.empty();
        }
        if (!hasLower || !hasUpper) return;
        PlaneOverlay overlay(extent_, options_.snap);
        for (const auto& [claim, polygons] : claims)
            for (const OverlayPolygon* polygon : polygons) {
                overlay.add(polygon->outer, claim);
                for (const OverlayRing& hole : polygon->holes) overlay.add(hole, claim);
            }
        const auto regions = overlay.run();
        if (!regions) return;
        for (const OverlayRegion& region : *regions)
            for (const std::uint32_t lower : region.claims)
                for (const std::uint32_t upper : region.claims)
                    if (lower % 2 == 0 && upper % 2 == 1)
                        addGap(planes_[p], width, region, lower / 2, upper / 2, byPair);
    }

    void addGap(const FacePlane& plane, double width, const OverlayRegion& region, std::uint32_t lower,
                std::uint32_t upper, std::map<SpacePair, SpaceRelation>& byPair) {
        if (lower == upper || areNested(lower, upper)) return;
        const auto [a, b] = std::minmax(lower, upper);
        std::set<std::uint32_t> between;
        double area = 0;
        std::size_t samples = 0, ofThird = 0;  // points in a third legal space
        for (const OverlayPolygon& polygon : region.polygons) {
            area += polygon.area;
            for (const OverlayPoint& p : pointsInside(polygon)) {
                const std::uint32_t label = labelAt(plane.axes.inSpace(p, plane.height + 0.5 * width));
                ++samples;
                if (label != volume::kNoLabel && isInSpace(label))
                    ++ofThird;
                else
                    between.insert(label);
            }
        }
        if (2 * ofThird > samples) return;
        SpaceRelation& relation = byPair[{a, b}];
        relation.kind = SpaceRelationKind::Gap;
        relation.a = a;
        relation.b = b;
        relation.isExact = isExact(a) && isExact(b);
        relation.narrowest = relation.area ? std::min(relation.narrowest, width) : width;
        relation.widest = std::max(relation.widest, width);
        relation.area = relation.area.value_or(0) + area;
        for (const std::uint32_t label : between) {
            if (label == volume::kNoLabel) {
                relation.isOpen = true;
                continue;
            }
            const auto at = std::lower_bound(relation.between.begin(), relation.between.end(), label);
            if (at == relation.between.end() || *at != label) relation.between.insert(at, label);
        }
    }

    // Whether air with this label belongs to a legal space; walls that are members of a flat do not count.
    [[nodiscard]] bool isInSpace(std::uint32_t label) const {
        if (!model::isSpace(volume_.labels.labels[label].className)) return false;
        return std::any_of(extentOf_.begin(), extentOf_.end(), [&](const std::vector<std::uint32_t>& extent) {
            return std::binary_search(extent.begin(), extent.end(), label);
        });
    }

    [[nodiscard]] std::uint32_t labelAt(Vec3d fromCorner) const {
        const Vec3d index = volume_.grid.indexFromWorldDirection(fromCorner);
        Vec3i sample;
        for (int axis = 0; axis < 3; ++axis) {
            sample[axis] = static_cast<std::int32_t>(std::lround(index[axis]));
            if (sample[axis] < 0 || sample[axis] >= volume_.grid.dimension()[axis]) return volume::kNoLabel;
        }
        return labelOf_[volume_.columns.scalarAt(sample.x, sample.y, sample.z)];
    }

    void moveToWorld() {
        const Vec3d origin = volume_.grid.origin();
        for (LegalSpace& space : found_.spaces) {
            for (auto& solid : space.solids)
                for (SpaceTriangle& triangle : solid)
                    for (Vec3d& corner : triangle) corner = corner + origin;
            if (!space.box.isEmpty()) space.box = {space.box.min + origin, space.box.max + origin};
            const auto move = [&](std::vector<std::array<double, 2>>& ring) {
                for (auto& p : ring) p = {p[0] + origin.x, p[1] + origin.y};
            };
            for (PlanPolygon& polygon : space.outline) {
                move(polygon.outer);
                for (auto& hole : polygon.holes) move(hole);
            }
        }
        for (BoundaryFace& face : found_.faces) {
            for (auto& ring : face.rings)
                for (Vec3d& p : ring) p = p + origin;
            face.low += origin.z;
            face.high += origin.z;
        }
    }

    const volume::SemanticVolume& volume_;
    const LegalSpaceOptions options_;
    const Extents extents_;
    const std::vector<std::uint32_t> labelOf_;          // by scalar
    double extent_ = 1;                                 // maximum distance of a coordinate from the lower corner
    std::vector<std::vector<std::uint32_t>> extentOf_;  // by space
    std::vector<FacePlane> planes_;
    std::vector<std::vector<BoundingRegion>> regions_;  // by plane
    LegalSpaces found_;
};

}  // namespace

std::string_view spaceBodyName(SpaceBody body) noexcept {
    constexpr std::string_view kNames[] = {"none", "solid", "parts", "voxels"};
    return kNames[static_cast<std::size_t>(body)];
}

std::string_view faceDirectionName(FaceDirection direction) noexcept {
    constexpr std::string_view kNames[] = {"down", "up", "side"};
    return kNames[static_cast<std::size_t>(direction)];
}

std::string_view relationName(SpaceRelationKind kind) noexcept {
    constexpr std::string_view kNames[] = {"overlap", "shared face", "gap"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::vector<std::uint32_t> unitsOf(const volume::LabelTable& table) {
    std::vector<std::uint32_t> units;
    for (std::uint32_t l = 0; l < table.labels.size(); ++l)
        if (model::classRank(table.labels[l].className) == model::ClassRank::Unit) units.push_back(l);
    return units;
}

LegalSpaces makeLegalSpaces(const volume::SemanticVolume& volume, std::span<const std::uint32_t> labels,
                            const LegalSpaceOptions& options) {
    return SpaceMaker(volume, labels, options).run();
}

}  // namespace svt::analyze
