#include <svt/drawing/section/exact_section.hpp>

#include <svt/drawing/exact/body_cells.hpp>
#include <svt/drawing/exact/mesh_cut.hpp>
#include <svt/drawing/section/section_pieces.hpp>
#include <svt/drawing/section/section_rings.hpp>
#include <svt/model/classes.hpp>
#include <svt/plane/regions.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

namespace svt::drawing {
namespace {

using volume::Filling;
using volume::kNoLabel;

constexpr std::uint32_t kNoClaim = 0xFFFFFFFFu;
constexpr double kMeetDistance = 8e-6;  // metres: closer points and edges meet, like welded points

// The claim of a label to a part of the plane; claims are ordered by priority, like those of the voxelizer.
struct SectionClaim {
    std::uint32_t label = 0;
    std::uint8_t rank = 0;
    bool isSheet = false;
    double volume = 0;
};

// A building whose material belongs to the boundary surfaces below it.
struct MaterialGroup {
    std::uint32_t building = 0;
    std::uint32_t firstBody = 0, endBody = 0;  // of ExactCutter::bodies_
};

class ExactCutter {
public:
    ExactCutter(const volume::SemanticVolume& volume, const volume::BrickVolume* bricks, const SectionPlane& plane,
                const PlaneAxes& axes, std::span<const std::uint8_t> isDrawn, const DrawingTables& tables, int threads)
        : volume_(volume),
          bricks_(bricks),
          plane_(plane),
          axes_(axes),
          isDrawn_(isDrawn),
          tables_(tables),
          threads_(threads) {}

    Result<std::optional<ExactSection>> run() {
        const MeshCut cut = cutMeshes(volume_.vectors, volume_.grid.origin(), axes_,
                                      dot(plane_.normal, axes_.normal) < 0, tables_.runs());
        findGroups();
        orderClaims(cut);
        section_.edgesInPlane = cut.edgesInPlane;
        section_.planeShift = cut.shift;
        chooseUnit(cut);
        addMeshSegments(cut);
        SVT_DO(addVoxelSegments());
        if (!groups_.empty() && !addBodies()) return std::optional<ExactSection>{};
        if (!drawRegions()) return std::optional<ExactSection>{};
        return std::optional<ExactSection>(std::move(section_));
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const noexcept {
        return volume_.labels.labels[label];
    }
    [[nodiscard]] std::size_t labelCount() const noexcept { return volume_.labels.labels.size(); }

    void findGroups() {
        for (std::uint32_t l = 0; l < labelCount(); ++l) {
            const volume::Label& building = labelOf(l);
            const bool isSolid = volume::hasClosedMesh(building.filling) || building.filling == Filling::Winding;
            if (!isSolid || !tables_.facts()[l].isBuilding) continue;
            MaterialGroup group{l, static_cast<std::uint32_t>(bodies_.size()), 0};
            for (std::uint32_t below = l + 1; below < building.subtreeEnd; ++below)
                if (labelOf(below).filling == Filling::Body) bodies_.push_back(below);
            group.endBody = static_cast<std::uint32_t>(bodies_.size());
            if (group.firstBody != group.endBody) groups_.push_back(group);
        }
    }

    // Lower rank first; at equal rank solids before sheets, then the smaller volume, then the id. Only labels that the
    // plane cuts have claims.
    void orderClaims(const MeshCut& cut) {
        section_.isExact.assign(labelCount(), 1);
        std::vector<std::uint8_t> isCut(labelCount(), 0);
        for (const CutSegment& segment : cut.segments) isCut[segment.label] = 1;
        for (const MaterialGroup& group : groups_) isCut[group.building] = 1;
        for (std::uint32_t l = 0; l < labelCount(); ++l) {
            const volume::Label& label = labelOf(l);
            if (label.count == 0) continue;
            if (label.filling == Filling::Winding) section_.isExact[l] = 0;
            if (isCut[l] == 0 && section_.isExact[l] != 0) continue;
            const auto rank = static_cast<std::uint8_t>(model::classRank(label.className));
            if (volume::hasClosedMesh(label.filling) || label.filling == Filling::Winding)
                claims_.push_back({l, rank, false, volume::hasClosedMesh(label.filling) ? label.volume : 0});
            else
                claims_.push_back({l, rank, true, 0});
        }
        // Material of open shells: the voxels of its bodies stand for it.
        for (const MaterialGroup& group : groups_) {
            if (labelOf(group.building).filling != Filling::Winding) continue;
            const auto rank = static_cast<std::uint8_t>(model::ClassRank::Building);
            for (std::uint32_t b = group.firstBody; b < group.endBody; ++b) {
                claims_.push_back({bodies_[b], rank, false, 0});
                section_.isExact[bodies_[b]] = 0;
            }
        }
        const auto key = [&](const SectionClaim& c) {
            return std::tuple<std::uint8_t, bool, double, std::string_view, std::uint32_t>(
                c.rank, c.isSheet, c.volume, labelOf(c.label).id, c.label);
        };
        std::sort(claims_.begin(), claims_.end(),
                  [&](const SectionClaim& a, const SectionClaim& b) { return key(a) < key(b); });
        solidClaim_.assign(labelCount(), kNoClaim);
        sheetClaim_.assign(labelCount(), kNoClaim);
        for (std::uint32_t c = 0; c < claims_.size(); ++c)
            (claims_[c].isSheet ? sheetClaim_ : solidClaim_)[claims_[c].label] = c;
        std::vector<const MaterialGroup*> groupOf(labelCount(), nullptr);
        for (auto group = groups_.rbegin(); group != groups_.rend(); ++group) groupOf[group->building] = &*group;
        for (const SectionClaim& claim : claims_) groupOfClaim_.push_back(groupOf[claim.label]);
    }

    // A power of two, so that all coordinates are within 2^29.
    void chooseUnit(const MeshCut& cut) {
        double extent = 1e-3;
        const Vec3i dimension = volume_.grid.dimension();
        for (int corner = 0; corner < 8; ++corner) {
            Vec3d index;
            for (int axis = 0; axis < 3; ++axis)
                index[axis] = ((corner >> axis) & 1) != 0 ? dimension[axis] - 0.5 : -0.5;
            const PlanePoint p = axes_.planeFromWorld(volume_.grid.worldFromIndex(index));
            extent = std::max({extent, std::abs(p.u), std::abs(p.v)});
        }
        for (const CutSegment& segment : cut.segments)
            extent = std::max({extent, std::abs(segment.from.u), std::abs(segment.from.v), std::abs(segment.to.u),
                               std::abs(segment.to.v)});
        section_.drawingUnit = std::ldexp(1.0, std::ilogb(extent) + 1 - 28);
        section_.tolerance = std::max(2, static_cast<std::int32_t>(std::lround(kMeetDistance / section_.drawingUnit)));
    }

    [[nodiscard]] plane::Point placed(PlanePoint p) const noexcept {
        return {static_cast<std::int64_t>(std::floor(p.u / section_.drawingUnit + 0.5)),
                static_cast<std::int64_t>(std::floor(p.v / section_.drawingUnit + 0.5))};
    }

    void addMeshSegments(const MeshCut& cut) {
        for (const CutSegment& segment : cut.segments) {
            const plane::Point from = placed(segment.from), to = placed(segment.to);
            if (volume::hasClosedMesh(labelOf(segment.label).filling))
                segments_.push_back({from, to, solidClaim_[segment.label], 1});
            else if (sheetClaim_[segment.label] != kNoClaim)
                segments_.push_back({from, to, sheetClaim_[segment.label], 0});
        }
    }

    // Adds the polygons of objects that are drawn by voxels.
    Result<void> addVoxelSegments() {
        std::vector<std::uint32_t> labels = volume_.labels.labelOfScalar();
        bool isNeeded = false;
        for (std::uint32_t& label : labels) {
            if (label != kNoLabel && section_.isExact[label] != 0) label = kNoLabel;
            isNeeded = isNeeded || label != kNoLabel;
        }
        if (!isNeeded) return {};
        if (bricks_ == nullptr) {
            SVT_TRY(made, tables_.bricks(threads_));
            bricks_ = *made;
        }
        const CutPlane cut(plane_, axes_, volume_.grid);
        std::vector<DrawingBorder> borders = joinEdges(cutPieces(*bricks_, volume_.planes, cut, labels));
        const Vec3d spacing = volume_.grid.spacing();
        straighten(borders, 0.01 * std::min({spacing.x, spacing.y, spacing.z}) / cut.drawingUnit());
        const auto moved = [&](plane::Point p) {
            return placed({double(p.u) * cut.drawingUnit(), double(p.v) * cut.drawingUnit()});
        };
        for (const DrawingBorder& border : borders)
            for (std::size_t n = 0; n + 1 < border.points.size(); ++n) {
                const plane::Point a = moved(border.points[n]), b = moved(border.points[n + 1]);
                if (border.left != kNoLabel) segments_.push_back({a, b, solidClaim_[border.left], 1});
                if (border.right != kNoLabel) segments_.push_back({b, a, solidClaim_[border.right], 1});
            }
        return {};
    }

    // The claim of highest priority. The claims of thematic bodies follow after all claims of labels.
    [[nodiscard]] std::uint32_t topClaim(std::span<const plane::ClaimCount> counts) const noexcept {
        for (const plane::ClaimCount& count : counts) {
            if (count.winding <= 0) continue;
            if (count.claim >= claims_.size()) return kNoClaim;
            const MaterialGroup* const group = groupOfClaim_[count.claim];
            return group != nullptr ? bodyClaim(counts, *group, count.claim) : count.claim;
        }
        return kNoClaim;
    }
    [[nodiscard]] std::uint32_t bodyClaim(std::span<const plane::ClaimCount> counts, const MaterialGroup& group,
                                          std::uint32_t otherwise) const noexcept {
        for (const plane::ClaimCount& count : counts)
            if (count.winding > 0 && count.claim >= claims_.size() + group.firstBody &&
                count.claim < claims_.size() + group.endBody)
                return count.claim;
        return otherwise;
    }
    [[nodiscard]] std::uint32_t labelOfClaim(std::uint32_t claim) const noexcept {
        if (claim == kNoClaim) return kNoLabel;
        return claim < claims_.size() ? claims_[claim].label : bodies_[claim - claims_.size()];
    }

    // Divides the material of closed buildings: where they are on top without regard to their bodies.
    bool addBodies() {
        const auto arranged = plane::arrangeSegments(segments_, section_.tolerance);
        if (!arranged) return false;
        const auto sides =
            plane::sweepRegions(*arranged, [&](std::span<const plane::ClaimCount> c) { return topClaim(c); });
        for (const MaterialGroup& group : groups_) {
            const std::uint32_t claim = solidClaim_[group.building];
            if (section_.isExact[group.building] == 0) continue;
            std::vector<MaterialEdge> material;
            for (std::size_t e = 0; e < sides.size(); ++e) {
                const plane::ArrangementEdge& edge = arranged->edges[e];
                if ((sides[e].left == claim) == (sides[e].right == claim)) continue;
                material.emplace_back(sides[e].left == claim ? edge.from : edge.to,
                                      sides[e].left == claim ? edge.to : edge.from);
            }
            const Vec3d u = axes_.u * section_.drawingUnit, v = axes_.v * section_.drawingUnit;
            for (plane::ClaimSegment border : divideBodies(facesOf(group), material, {u, v}, section_.drawingUnit)) {
                border.claim += static_cast<std::uint32_t>(claims_.size()) + group.firstBody;
                segments_.push_back(border);
            }
        }
        return true;
    }

    [[nodiscard]] std::vector<BodyFace> facesOf(const MaterialGroup& group) const {
        const std::uint32_t first = group.building, end = bodies_[group.endBody - 1] + 1;
        std::vector<std::uint32_t> bodyOf(end - first, kNoLabel);
        for (std::uint32_t b = group.firstBody; b < group.endBody; ++b)
            bodyOf[bodies_[b] - first] = b - group.firstBody;
        std::vector<BodyFace> faces;
        const auto place = [&](std::uint32_t point) {
            return volume_.vectors.position(point, volume_.grid.origin() - axes_.origin);
        };
        const auto& triangles = volume_.vectors.triangles;
        auto triangle = std::lower_bound(triangles.begin(), triangles.end(), first,
                                         [](const auto& t, std::uint32_t label) { return t.label < label; });
        for (; triangle != triangles.end() && triangle->label < end; ++triangle)
            if (const std::uint32_t body = bodyOf[triangle->label - first]; body != kNoLabel)
                faces.push_back(
                    {place(triangle->corners[0]), place(triangle->corners[1]), place(triangle->corners[2]), body});
        return faces;
    }

    bool drawRegions() {
        const auto arranged = plane::arrangeSegments(segments_, section_.tolerance);
        if (!arranged) return false;
        const auto sides =
            plane::sweepRegions(*arranged, [&](std::span<const plane::ClaimCount> c) { return topClaim(c); });
        const auto drawn = [&](std::uint32_t label) {
            return label != kNoLabel && isDrawn_[label] != 0 ? label : kNoLabel;
        };
        for (std::size_t e = 0; e < sides.size(); ++e) {
            const plane::ArrangementEdge& edge = arranged->edges[e];
            const std::uint32_t left = labelOfClaim(sides[e].left), right = labelOfClaim(sides[e].right);
            if (drawn(left) != drawn(right)) {
                if (drawn(left) != kNoLabel) section_.edges.push_back({edge.from, edge.to, left});
                if (drawn(right) != kNoLabel) section_.edges.push_back({edge.to, edge.from, right});
            }
            for (std::uint32_t m = edge.firstMark; m < edge.endMark; ++m) {
                const std::uint32_t claim = arranged->marks[m].claim;
                if (claim >= claims_.size() || !claims_[claim].isSheet) continue;
                const std::uint32_t label = claims_[claim].label;
                // Hidden between parts of a higher rank; a part of the body of its own needs no line.
                const bool isHidden = sides[e].left < claim && sides[e].right < claim;
                if (!isHidden && label != left && label != right && isDrawn_[label] != 0)
                    section_.lines.push_back({edge.from, edge.to, label});
            }
        }
        return true;
    }

    const volume::SemanticVolume& volume_;
    const volume::BrickVolume* bricks_;
    const SectionPlane& plane_;
    const PlaneAxes& axes_;
    std::span<const std::uint8_t> isDrawn_;
    const DrawingTables& tables_;
    int threads_;
    ExactSection section_;
    std::vector<SectionClaim> claims_;
    std::vector<std::uint32_t> solidClaim_, sheetClaim_;  // by label
    std::vector<MaterialGroup> groups_;
    std::vector<const MaterialGroup*> groupOfClaim_;  // null: the material is whole
    std::vector<std::uint32_t> bodies_;               // labels
    std::vector<plane::ClaimSegment> segments_;
};

}  // namespace

bool hasMeshes(const volume::SemanticVolume& volume) noexcept { return !volume.vectors.triangles.empty(); }

Result<std::optional<ExactSection>> cutExactly(const volume::SemanticVolume& volume, const volume::BrickVolume* bricks,
                                               const SectionPlane& plane, const PlaneAxes& axes,
                                               std::span<const std::uint8_t> isDrawn, const DrawingTables& tables,
                                               int threads) {
    return ExactCutter(volume, bricks, plane, axes, isDrawn, tables, threads).run();
}

}  // namespace svt::drawing
