#pragma once
/// \file
/// Compares frames drawn by OpenGL with those of the CPU caster.

#include <svt/render/ray_caster.hpp>
#include <svt/render_gl/egl_context.hpp>
#include <svt/render_gl/gl_renderer.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

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

/// Pixels of the CPU's frame that change when the camera moves sideways by 1e-3 voxel, in one of eight directions. A frame is
/// cast for a direction when it is first needed: most edges show in the first few.
class Edges {
public:
    enum Kind : std::uint8_t { kLabel = 1, kColor = 2, kDepth = 4 };  ///< kDepth: by more than a voxel

    Edges(const volume::BrickVolume& volume, const volume::Grid& grid, const render::FrameSpec& spec,
          const render::Frame& frame, int colorBound)
        : volume_(volume), grid_(grid), spec_(spec), frame_(frame), colorBound_(colorBound) {}

    [[nodiscard]] bool contain(std::int32_t x, std::int32_t y, Kind kind) {
        for (const int direction : {0, 4, 2, 6, 1, 5, 3, 7}) {
            std::optional<render::Frame>& moved = moved_[std::size_t(direction)];
            if (!moved) moved = castFrom(direction);
            if (moved->label.width() > 0 && differs(*moved, x, y, kind)) return true;
        }
        return false;
    }

private:
    [[nodiscard]] render::Frame castFrom(int direction) const {
        const Vec3d forward = normalized(spec_.camera.target - spec_.camera.eye);
        const Vec3d right = normalized(cross(forward, spec_.camera.up)), up = cross(right, forward);
        const double angle = direction * 0.7853981633974483;
        const Vec3d aside = (right * std::cos(angle) + up * std::sin(angle)) * (1e-3 * voxel());
        render::FrameSpec moved = spec_;
        moved.camera.eye = moved.camera.eye + aside;
        moved.camera.target = moved.camera.target + aside;
        auto frame = render::castRays(volume_, grid_, moved);
        return frame ? std::move(*frame) : render::Frame{};
    }
    [[nodiscard]] bool differs(const render::Frame& moved, std::int32_t x, std::int32_t y, Kind kind) const {
        if (kind == kLabel) return moved.label.at(x, y) != frame_.label.at(x, y);
        if (kind == kColor) return apart(moved.color.at(x, y), frame_.color.at(x, y)) > colorBound_;
        return !(std::abs(moved.depth.at(x, y) - frame_.depth.at(x, y)) <= voxel());
    }
    [[nodiscard]] double voxel() const {
        const Vec3d spacing = grid_.spacing();
        return std::min({spacing.x, spacing.y, spacing.z});
    }

    const volume::BrickVolume& volume_;
    const volume::Grid& grid_;
    const render::FrameSpec& spec_;
    const render::Frame& frame_;
    int colorBound_;
    std::array<std::optional<render::Frame>, 8> moved_;
};

/// Compares two frames.
/// \param drawn, cast  by OpenGL, and by the CPU
/// \param colorBound   largest allowed difference of a channel, 0..255
inline FrameDifference compare(const volume::BrickVolume& volume, const volume::Grid& grid,
                               const render::FrameSpec& spec, const render::Frame& drawn, const render::Frame& cast,
                               int colorBound) {
    FrameDifference difference;
    Edges edges(volume, grid, spec, cast, colorBound);
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
                if (edges.contain(x, y, Edges::kLabel))
                    ++difference.edges;
                else
                    bad(difference.labels);
                continue;
            }
            const double depth = cast.depth.at(x, y);
            if (std::isfinite(depth) && std::abs(double(drawn.depth.at(x, y)) - depth) > 0.05 * voxel &&
                !edges.contain(x, y, Edges::kDepth))
                bad(difference.depths);
            const int color = apart(drawn.color.at(x, y), cast.color.at(x, y));
            if (color <= colorBound) {
                difference.largestColor = std::max(difference.largestColor, color);
                continue;
            }
            if (edges.contain(x, y, Edges::kColor)) {
                ++difference.colorEdges;
                continue;
            }
            bad(difference.colors);
            difference.largestColor = std::max(difference.largestColor, color);
        }
    return difference;
}

}  // namespace svt::render_gl::test
