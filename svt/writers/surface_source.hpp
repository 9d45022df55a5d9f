#pragma once
/// \file
/// The source of surfaces in formats of triangles: the faces of the model, or the voxels.

#include <svt/core/names.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace svt::writers {

/// The choice of a user.
enum class SurfaceSource : std::uint8_t {
    Auto,    ///< glTF: MeshChoice::Closed; 3D Tiles: MeshChoice::Open
    Meshes,  ///< MeshChoice::Open
    Voxels   ///< MeshChoice::None
};
constexpr auto namesOf(SurfaceSource) {
    using enum SurfaceSource;
    return std::to_array<Name<SurfaceSource>>({{Auto, "auto"}, {Meshes, "meshes"}, {Voxels, "voxels"}});
}

/// The labels whose surface consists of the stored triangles of the model. Other labels have the surface of their
/// voxels.
enum class MeshChoice : std::uint8_t {
    None,
    Sheets,  ///< labels without inside (volume::Filling::Surface)
    /// Also labels with a closed mesh, except those whose mesh is not their whole surface: they enclose rooms or bodies,
    /// or features with an inside, other than buildings, took more than 1/64 of their voxels.
    Closed,
    Open,  ///< the same with labels that have an open shell
    All    ///< all labels with triangles
};

/// The number of labels with voxels by the source of their surface.
struct SurfaceCounts {
    std::size_t meshes = 0, voxels = 0;
};
/// Cost: O(labels + triangles).
[[nodiscard]] SurfaceCounts countSurfaces(const volume::SemanticVolume& volume, MeshChoice choice);

}  // namespace svt::writers
