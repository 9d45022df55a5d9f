#pragma once
/// \file
/// Compares frames drawn by OpenGL with those of the CPU caster.

#include <svt/render/ray_caster.hpp>
#include <svt/render_gl/egl_context.hpp>
#include <svt/render_gl/gl_renderer.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace svt::render_gl::test {

/// The context that all tests share; an error if none can be made, or if SVT_GL_RENDERER is set and names another
/// renderer.
inline const Result<EglContext>& context() {
    static const Result<EglContext> made = []() -> Result<EglContext> {
        auto context = EglContext::make();
        const char* wanted = std::getenv("SVT_GL_RENDERER");
        if (!context || wanted == nullptr || context->renderer().find(wanted) != std::string::npos) return context;
        return Error(Code::NoGraphics, context->renderer() + " draws, not " + wanted);
    }();
    return made;
}

/// Skips the test if no context can be made.
#define SVT_NEEDS_GL() \
    if (!::svt::render_gl::test::context()) GTEST_SKIP() << ::svt::render_gl::test::context().error().message()

/// Differences between two frames.
struct FrameDifference {
    std::size_t labels = 0;  ///< pixels with another label that are not at an edge
    std::size_t edges = 0;   ///< pixels with another label whose ray passes an edge within 1e-3 voxel
    std::size_t depths =
        0;  ///< pixels of the same label, not at an edge, whose depth differs by more than 0.05 of the largest spacing
    std::size_t colors = 0;       ///< pixels of the same label whose colour differs by more than the bound
    std::size_t colorEdges = 0;   ///< such pixels whose colour changes, too, if the camera moves by 1e-3 voxel
    int largestColor = 0;         ///< largest difference of a channel, without these, 0..255
    std::int32_t x = -1, y = -1;  ///< the first bad pixel
};

inline int apart(image::Rgba8 a, image::Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

/// Edges: pixels of the CPU's frame that change when the camera moves sideways by 1e-3 voxel. Bits: 1 the label, 2 the
/// color by more than the bound, 4 the depth by more than a voxel.
inline image::Image<std::uint8_t> edgesOf(const volume::BrickVolume& volume, const volume::Grid& grid,
                                          const render::FrameSpec& spec, const render::Frame& frame, int colorBound) {
    image::Image<std::uint8_t> edges(spec.width, spec.height);
    const Vec3d forward = normalized(spec.camera.target - spec.camera.eye);
    const Vec3d right = normalized(cross(forward, spec.camera.up)), up = cross(right, forward);
    const Vec3d spacing = grid.spacing();
    const double voxel = std::min({spacing.x, spacing.y, spacing.z});
    for (int direction = 0; direction < 8; ++direction) {
        const double angle = direction * 0.7853981633974483;
        const Vec3d aside = (right * std::cos(angle) + up * std::sin(angle)) * (1e-3 * voxel);
        render::FrameSpec moved = spec;
        moved.camera.eye = moved.camera.eye + aside;
        moved.camera.target = moved.camera.target + aside;
        const auto other = render::castRays(volume, grid, moved);
        if (!other) continue;
        for (std::size_t n = 0; n < edges.pixels().size(); ++n) {
            std::uint8_t& edge = edges.pixels()[n];
            if (other->label.pixels()[n] != frame.label.pixels()[n]) edge |= 1;
            if (apart(other->color.pixels()[n], frame.color.pixels()[n]) > colorBound) edge |= 2;
            if (!(std::abs(other->depth.pixels()[n] - frame.depth.pixels()[n]) <= voxel)) edge |= 4;
        }
    }
    return edges;
}

/// Compares two frames.
/// \param drawn, cast  by OpenGL, and by the CPU
/// \param colorBound   largest allowed difference of a channel, 0..255
inline FrameDifference compare(const volume::BrickVolume& volume, const volume::Grid& grid,
                               const render::FrameSpec& spec, const render::Frame& drawn, const render::Frame& cast,
                               int colorBound) {
    FrameDifference difference;
    std::optional<image::Image<std::uint8_t>> edges;
    const auto isEdge = [&](std::int32_t x, std::int32_t y, unsigned kind) {
        if (!edges) edges = edgesOf(volume, grid, spec, cast, colorBound);
        return (edges->at(x, y) & kind) != 0;
    };
    const double voxel = std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z});
    for (std::int32_t y = 0; y < spec.height; ++y)
        for (std::int32_t x = 0; x < spec.width; ++x) {
            const auto bad = [&](std::size_t& count) {
                if (++count == 1 && difference.x < 0) {
                    difference.x = x;
                    difference.y = y;
                }
            };
            if (drawn.label.at(x, y) != cast.label.at(x, y)) {
                if (isEdge(x, y, 1))
                    ++difference.edges;
                else
                    bad(difference.labels);
                continue;
            }
            const double depth = cast.depth.at(x, y);
            if (std::isfinite(depth) && std::abs(double(drawn.depth.at(x, y)) - depth) > 0.05 * voxel &&
                !isEdge(x, y, 4))
                bad(difference.depths);
            const int color = apart(drawn.color.at(x, y), cast.color.at(x, y));
            if (color <= colorBound) {
                difference.largestColor = std::max(difference.largestColor, color);
                continue;
            }
            if (isEdge(x, y, 2)) {
                ++difference.colorEdges;
                continue;
            }
            bad(difference.colors);
            difference.largestColor = std::max(difference.largestColor, color);
        }
    return difference;
}

}  // namespace svt::render_gl::test
