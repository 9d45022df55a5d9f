#pragma once
/// \file
/// A ray tracer on the triangles of a model, by Embree. It knows neither voxels nor the code of the casters, so pictures
/// are compared with it.
///
/// A ray has a crossing with each triangle that it meets. The tracer keeps the objects that the ray is inside of, by
/// winding numbers. Between two crossings, the object of the highest priority owns the ray: the rule by which a voxel gets
/// its label, evaluated along the ray. Objects without inside are surfaces that the ray meets.

#include <svt/core/vec.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/pipeline/labels.hpp>
#include <svt/render/clip_region.hpp>
#include <svt/render/view_ray.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace svt::test {

/// The first drawn surface on a ray.
struct SeenSurface {
    std::vector<volume::Scalar>
        scalars;         ///< the label, and those of other surfaces in the same place; empty: background
    double depth = 0;    ///< metres along the view direction
    Vec3d normal{};      ///< unit length, towards the viewer
    bool isCap = false;  ///< on the plane of the section
    bool isDecided =
        true;  ///< false: the winding numbers of an object do not agree along the ray, or an open shell is cut
};

/// A model to trace. `meshes` and `labelled` must outlive the tracer.
class MeshTracer {
public:
    /// \param table     labels of the volume that the pictures show, with their fillings
    /// \param isHidden  by scalar: the picture does not draw it
    MeshTracer(const mesh::MeshSet& meshes, const pipeline::LabelledObjects& labelled, const volume::LabelTable& table,
               std::vector<char> isHidden);
    ~MeshTracer();
    MeshTracer(const MeshTracer&) = delete;
    MeshTracer& operator=(const MeshTracer&) = delete;

    /// \param ray  world space
    /// \param cut  the points that the section cuts away; empty: no section
    [[nodiscard]] SeenSurface trace(const render::ViewRay& ray, const std::optional<render::HalfSpace>& cut) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace svt::test
