#pragma once
/// \file
/// The object whose triangles are nearest to a point, by Embree: the owner of material between the surfaces of a body.

#include <svt/core/vec.hpp>
#include <svt/mesh/mesh_set.hpp>

#include <embree3/rtcore.h>

#include <cstdint>
#include <vector>

namespace svt::test {

class NearestFace {
public:
    /// \param surfaces  object numbers; `meshes` must outlive this
    NearestFace(RTCDevice device, const mesh::MeshSet& meshes, std::vector<std::uint32_t> surfaces);
    ~NearestFace();
    NearestFace(const NearestFace&) = delete;
    NearestFace& operator=(const NearestFace&) = delete;

    /// Objects whose distance exceeds the smallest one by at most `tie` metres, the nearest first.
    /// \param point  local space
    [[nodiscard]] std::vector<std::uint32_t> at(Vec3d point, double tie) const;

private:
    const mesh::MeshSet& meshes_;
    std::vector<std::uint32_t> surfaces_;  ///< by geometry of the scene
    RTCScene scene_;
};

/// Adds the triangles of an object to a scene as one geometry.
void addTriangles(RTCDevice device, RTCScene scene, const mesh::ObjectMesh& object);

}  // namespace svt::test
