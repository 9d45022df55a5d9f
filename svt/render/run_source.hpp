#pragma once
/// \file
/// The runs of a ray from another source than bricks, such as the faces of a model (face_model.hpp).

#include <svt/core/vec.hpp>
#include <svt/render/voxel_ray.hpp>
#include <svt/volume/brick_volume.hpp>

#include <cstdint>
#include <memory>

namespace svt::render {

class PointCaster;
struct PreparedFrame;

/// The start of a run.
struct RunStart {
    Vec3i voxel;
    std::uint32_t plane = volume::BrickVolume::kNoPlane;  ///< the oblique plane that the ray crosses, or of its seam
    bool isVoxel = false;                                 ///< the brick is one of voxels only
    const Vec3d* normal = nullptr;  ///< world space, unit length, of either sign; null: not by a face of the model
};

/// Receives the runs of a ray in order, as a visitor of walkRuns().
class RunVisitor {
public:
    RunVisitor() = default;
    RunVisitor(const RunVisitor&) = delete;
    RunVisitor& operator=(const RunVisitor&) = delete;
    virtual ~RunVisitor() = default;
    [[nodiscard]] virtual bool isDrawn(volume::Scalar scalar) const = 0;
    virtual bool enter(volume::Scalar scalar, double from, const RunStart& start) = 0;  ///< true ends the walk
    virtual bool leave(volume::Scalar scalar, double from, double to) = 0;              ///< true ends the walk
};

/// Finds the runs of rays through a volume. Thread-safe to read.
class RunSource {
public:
    RunSource() = default;
    RunSource(const RunSource&) = delete;
    RunSource& operator=(const RunSource&) = delete;
    virtual ~RunSource() = default;
    /// 1 + the largest scalar of a run that does not come from the bricks.
    [[nodiscard]] virtual std::uint64_t scalarCount() const noexcept = 0;
    /// Visits the runs of [from, to), which must lie in spanInVolume().
    /// \param bricks      of the volume
    /// \param metresPerT  metres per unit of the ray's parameter
    virtual void walk(const volume::BrickVolume& bricks, const VoxelRay& ray, double metresPerT, double from, double to,
                      RunVisitor& visitor) const = 0;
    /// The caster of its rays: packets know only bricks.
    [[nodiscard]] virtual std::unique_ptr<PointCaster> makeCaster(const PreparedFrame& frame) const = 0;
};

}  // namespace svt::render
