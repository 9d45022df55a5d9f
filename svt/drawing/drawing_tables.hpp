#pragma once
/// \file
/// Tables of a volume that all its drawings need: made once and shared, so that a set of many views does not make them
/// for each.

#include <svt/core/result.hpp>
#include <svt/render/hatch.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace svt::drawing {

enum class PartRole : std::uint8_t;  // dimension/part_roles.hpp
struct HatchChoice;                  // hatches.hpp
struct RoomShare;                    // room_floor_areas.hpp

/// Facts about a label that follow from its class and its place in the tree.
struct LabelFacts {
    std::uint32_t building = volume::kNoLabel;  ///< the building that it is, or that contains it
    bool isSpace = false;
    bool isClosed = false;     ///< its mesh is closed
    bool isSheet = false;      ///< a boundary surface without a volume of its own
    bool isElement = false;    ///< an element, or a part of one
    bool isBuilding = false;   ///< a building or a part of one
    bool hasSurfaces = false;  ///< boundary surfaces with voxels are its children
    bool isStair = false;      ///< a stair, or a part of one
};

/// Triangles of one label, at most kMostTriangles, and the box around them.
struct MeshRun {
    static constexpr std::uint32_t kMostTriangles = 256;
    std::uint32_t label = 0;
    std::uint32_t first = 0, end = 0;  ///< of VectorParts::triangles
    Vec3i low, high;                   ///< corners of the box, in units of VectorParts

    /// The lowest and the highest value of dot(point, direction) in the box, in units of VectorParts.
    [[nodiscard]] std::pair<double, double> rangeAlong(Vec3d direction) const noexcept;
};

/// The mesh of a label seen along the grid's z axis.
struct MeshPlan {
    std::uint32_t firstRun = 0, endRun = 0;      ///< of DrawingTables::runs(); equal without a mesh
    std::uint32_t firstPoint = 0, endPoint = 0;  ///< of PlanHulls::points
    double low = 0, high = 0;                    ///< metres above the grid's lower corner
    /// Labels with the same number have the same triangles, one after the other, at another height: parts of equal
    /// storeys. Heights differ by rounding, positions in plan not at all. They share the points of their hull.
    std::uint32_t shape = 0;
};

/// The meshes of all labels seen along the grid's z axis.
struct PlanHulls {
    std::vector<MeshPlan> labels;  ///< by label
    std::vector<Vec3d> points;     ///< of convex hulls, counter-clockwise; along the grid's x and y axes, metres
    std::uint32_t shapes = 0;      ///< numbers of MeshPlan::shape are less

    [[nodiscard]] std::span<const Vec3d> of(std::uint32_t label) const noexcept {
        return std::span(points).subspan(labels[label].firstPoint, labels[label].endPoint - labels[label].firstPoint);
    }
};

/// Each table is made when it is first needed. Several threads may use the tables at a time, if they call bricks() with
/// one thread each.
class DrawingTables {
public:
    /// \param volume  must outlive the tables, unchanged
    explicit DrawingTables(const volume::SemanticVolume& volume) noexcept : volume_(volume) {}

    /// chooseHatches() of the volume.
    [[nodiscard]] const std::vector<HatchChoice>& hatchChoices() const;
    /// The hatches of hatchChoices().
    [[nodiscard]] std::shared_ptr<const std::vector<render::Hatch>> hatches() const;
    [[nodiscard]] const std::vector<PartRole>& roles() const;                   ///< partRoles() of the volume
    [[nodiscard]] const std::vector<std::optional<double>>& roomAreas() const;  ///< roomFloorAreas() of the volume
    [[nodiscard]] const std::vector<RoomShare>& roomShares() const;             ///< roomShares() of the volume
    [[nodiscard]] const std::vector<LabelFacts>& facts() const;                 ///< by label
    [[nodiscard]] const std::vector<MeshRun>& runs() const;                     ///< of all triangles, in their order
    [[nodiscard]] const PlanHulls& plans() const;
    /// The bricks of the volume, for parts that are drawn by their voxels.
    /// \return the bricks, which live as long as the tables, or an error of BrickVolume::fromColumns()
    [[nodiscard]] Result<const volume::BrickVolume*> bricks(int threads) const;

private:
    const volume::SemanticVolume& volume_;
    mutable std::mutex mutex_;  // of the tables below; those that are made do not change
    mutable std::shared_ptr<const std::vector<HatchChoice>> hatchChoices_;
    mutable std::shared_ptr<const std::vector<render::Hatch>> hatches_;
    mutable std::optional<std::vector<PartRole>> roles_;
    mutable std::optional<std::vector<std::optional<double>>> roomAreas_;
    mutable std::shared_ptr<const std::vector<RoomShare>> roomShares_;
    mutable std::optional<std::vector<LabelFacts>> facts_;
    mutable std::optional<std::vector<MeshRun>> runs_;
    mutable std::optional<PlanHulls> plans_;
    mutable std::optional<volume::BrickVolume> bricks_;
};

}  // namespace svt::drawing
