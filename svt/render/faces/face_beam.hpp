#pragma once
/// \file
/// The rays of a rectangle of the picture, and triangles as these rays see them.

#include <svt/core/vec.hpp>
#include <svt/render/camera_rays.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace svt::render {

/// A place in the rectangle of a beam has coordinates from -1 to 1.
struct BeamPlace {
    float right = 0, up = 0;
};

/// A triangle that rays of a beam may cross.
struct BeamTriangle {
    /// Where a ray passes an edge: a value linear in its place. All three are positive inside of the triangle. Nearly
    /// edge-on, the first two are positive near one edge, and the third is 0.
    struct Edge {
        float alongRight = 0, alongUp = 0, inMiddle = 0;
    };
    static constexpr float kMargin = 1e-5f;  ///< of these values, far above rounding
    std::array<Edge, 3> edges{};
    std::uint32_t number = 0;
    double from = 0;       ///< all crossings are at this t or later
    Vec3d corner, normal;  ///< the first corner, and the normal of FaceTree::normal()

    /// Below -kMargin: the ray at a place misses the triangle. Above kMargin: the ray crosses it. Between: both are
    /// possible, as everywhere if rays see the triangle nearly edge-on.
    [[nodiscard]] float insideAt(BeamPlace place) const noexcept {
        const auto at = [&](const Edge& edge) {
            return edge.alongRight * place.right + edge.alongUp * place.up + edge.inMiddle;
        };
        return std::min({at(edges[0]), at(edges[1]), at(edges[2])});
    }
};

/// The rays between four rays of a camera, in voxel space.
class FaceBeam {
public:
    /// \param left, right, bottom, top  of the rectangle: u and v of CameraRays::at()
    FaceBeam(const CameraRays& rays, double left, double right, double bottom, double top) noexcept;

    /// False if the lines of all rays miss a box.
    [[nodiscard]] bool mayMeet(Vec3d low, Vec3d high) const noexcept;
    /// The least t in a box, less a margin for rounding.
    [[nodiscard]] double depthOf(Vec3d low, Vec3d high) const noexcept;
    /// Sets the edges of a triangle of these corners. Returns false if the lines of all rays miss it.
    [[nodiscard]] bool findEdges(Vec3d a, Vec3d b, Vec3d c, BeamTriangle& triangle) const noexcept;

private:
    // Points of the space between the rays have dot(normal, p) <= offset; behind the eye of a perspective, >=.
    struct Side {
        Vec3d normal;  // unit length
        double offset;
    };
    std::array<Side, 4> sides_{};
    Vec3d origin_, direction_;  // of the ray in the middle
    Vec3d right_, up_;          // from the middle to the edges: of directions with perspective, else of origins
    Vec3d depth_;               // the t of all rays at a point p is dot(depth, p) - depthOfEye
    double depthOfEye_;
    bool isPerspective_;
};

}  // namespace svt::render
