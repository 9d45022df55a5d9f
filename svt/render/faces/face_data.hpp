#pragma once
/// \file
/// The objects of a FaceModel by priority, and their triangles.

#include <svt/render/face_model.hpp>
#include <svt/render/faces/face_tree.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <vector>

namespace svt::render {

struct FaceModel::Data {
    static constexpr std::uint32_t kNobody = 0xFFFFFFFFu;

    /// An object, by priority: the first wins.
    struct Object {
        volume::Scalar scalar = 0;
        bool isSolid = false;
        bool isMaterial = false;  ///< a solid whose points belong to its skins
        bool isSkin = false;      ///< a surface that owns the material behind it
        double thickening = 1;    ///< factor on the length of a way through it, for the light that it absorbs
    };

    volume::Grid grid;
    std::vector<Object> objects;
    /// By scalar: the object that its voxels stand for; kNobody for objects with triangles, and for background.
    std::vector<std::uint32_t> objectOfVoxels;
    bool hasVoxels = false;          ///< any object gets its labels from voxels
    std::vector<char> isSkinScalar;  ///< by scalar
    FaceTree tree;

    /// Unit normal of a triangle, world space.
    [[nodiscard]] Vec3d worldNormal(std::uint32_t triangle) const noexcept;
};

}  // namespace svt::render
