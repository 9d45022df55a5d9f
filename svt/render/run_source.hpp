#pragma once
/// \file
/// The runs of a ray from another source than bricks, such as the faces of a model (face_model.hpp).

#include <svt/core/vec.hpp>
#include <svt/render/camera_rays.hpp>
#include <svt/volume/brick_volume.hpp>

#include <cstdint>
#include <memory>

namespace svt::render {

class PointCaster;
struct PreparedFrame;

struct PictureSize {
    std::int32_t width = 0, height = 0;
};

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

/// Finds the runs of the rays of one camera. Not thread-safe: one per thread.
class RunWalker {
public:
    RunWalker() = default;
    RunWalker(const RunWalker&) = delete;
    RunWalker& operator=(const RunWalker&) = delete;
    virtual ~RunWalker() = default;
    /// Visits the runs of [from, to) of the ray through (u, v), which must lie in spanInVolume().
    /// \param ray  CameraRays::at(u, v)
    virtual void walk(double u, double v, const CameraRay& ray, double from, double to, RunVisitor& visitor) = 0;
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
    /// A walker of the rays of a camera, which must outlive it, like the bricks.
    /// \param bricks  of the volume
    /// \param size    of the picture, pixels; nearby rays may share work. Not positive: each ray is walked by itself,
    ///                with the same runs
    [[nodiscard]] virtual std::unique_ptr<RunWalker> makeWalker(const volume::BrickVolume& bricks,
                                                                const CameraRays& rays, PictureSize size) const = 0;
    /// The caster of its rays: packets know only bricks.
    [[nodiscard]] virtual std::unique_ptr<PointCaster> makeCaster(const PreparedFrame& frame) const = 0;
};

}  // namespace svt::render
