#pragma once
/// \file
/// The faces of a model, exact: rays find labels by triangles instead of voxels.
///
///     ray  --->   air | wall        | room    | wall | air      crossings of triangles, by depth
///     wall        0   | 1           | 0       | 1    | 0        winding number of each closed object
///     room        0   | 0           | 1       | 0    | 0
///     label       -   | wall        | room    | wall | -        the object of the highest priority
///
/// A closed object owns the points that its winding number puts inside it. A surface without inside has a label only on
/// its triangles. A closed object counts as a surface where it is thinner than 0.1 mm. Where several objects contain a
/// point, the one with the highest priority owns it: the rule by which voxels get their labels (voxelize.hpp), evaluated
/// along the ray. So the faces of a picture do not depend on the spacing.
///
/// Voxels still give the labels of objects without closed mesh: open shells, thematic bodies, objects with patterns.
/// If both kinds of objects contain a point, the priority decides, too.

#include <svt/core/result.hpp>
#include <svt/render/run_source.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace svt::render {

/// Immutable. Thread-safe to read.
class FaceModel final : public RunSource {
public:
    /// How many objects get their labels from triangles.
    struct Counts {
        std::size_t solids = 0, sheets = 0;
        std::size_t byVoxels = 0;  ///< all others
        std::size_t triangles = 0;
    };

    /// \param volume  with the triangles of its objects (SemanticVolume::vectors); only read here
    /// \param order   all labels, the highest priority first
    /// \return the model, or BadArgument if the volume has no triangles
    /// Objects whose triangles do not form a closed mesh keep their voxels, whatever their Filling.
    /// Cost: O(n log n) in the number of triangles. Memory: about 60 bytes per triangle.
    [[nodiscard]] static Result<std::unique_ptr<FaceModel>> make(const volume::SemanticVolume& volume,
                                                                 std::span<const std::uint32_t> order);
    ~FaceModel() override;

    [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
    [[nodiscard]] std::size_t sizeBytes() const noexcept;
    [[nodiscard]] std::uint64_t scalarCount() const noexcept override;

    /// Visits the runs of one ray in [from, to), which must lie in spanInVolume(). Crossings within 0.1 mm of each other
    /// are in one place. A translucent sheet absorbs light as if it were one voxel thick. So does a body whose mean
    /// thickness (2 * volume / area) is less than a voxel, as in pictures of voxels.
    /// \param metresPerT  metres per unit of the ray's parameter
    /// Cost: O(log(triangles) * crossings up to the end of the walk).
    void walk(const volume::BrickVolume& bricks, const VoxelRay& ray, double metresPerT, double from, double to,
              RunVisitor& visitor) const;
    /// Walks as walk(). The rays of 8 x 8 pixels share the list of triangles that they may cross. Cost: O(log(triangles))
    /// for each list, and O(its triangles up to the end of the walk) for each ray.
    [[nodiscard]] std::unique_ptr<RunWalker> makeWalker(const volume::BrickVolume& bricks, const CameraRays& rays,
                                                        PictureSize size) const override;
    [[nodiscard]] std::unique_ptr<PointCaster> makeCaster(const PreparedFrame& frame) const override;

    struct Data;

private:
    explicit FaceModel(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
    Counts counts_;
};

}  // namespace svt::render
