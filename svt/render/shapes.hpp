#pragma once
/// \file
/// Lines and triangles that a pass draws inside the volume, at their depth, as plain data.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::render {

/// How the part of a line is drawn that lies behind something opaque.
enum class HiddenLines : std::uint8_t { None, Faint, Dashed };

/// World space, metres.
struct Line {
    Vec3d from{}, to{};
    volume::Scalar scalar = 0;  ///< whose line it is; drawn where the pass shows that scalar
    friend bool operator==(const Line&, const Line&) = default;
};

/// Lines of one look. They are drawn over what is up to 1.5 voxels before them, so that the edges of a body lie on its
/// voxels. They change the colour of a picture alone, not its labels and depths. Where lines lie on each other, as the
/// edges of neighbours do, the strongest alone is drawn. What is shorter than half a pixel is left out.
struct LineSet {
    std::vector<Line> lines;
    Vec3f color{0.10f, 0.10f, 0.12f};  ///< sRGB, 0..1; not lit
    float width = 1;                   ///< pixels, 0.1 to 64, at any depth
    HiddenLines hidden = HiddenLines::Faint;
    float hiddenOpacity = 0.25f;    ///< of the hidden part, or of its dashes, 0..1
    float dash = 6, gap = 4;        ///< of hidden lines, pixels from where the line begins in the picture, 0.5 to 1000
    bool withHiddenLabels = false;  ///< whether lines of scalars with opacity 0 are drawn, too
    friend bool operator==(const LineSet&, const LineSet&) = default;
};

/// A triangle of a mesh, world space, metres; seen from both sides. It has the style of its scalar: opacity 1 is an
/// opaque surface, opacity o in (0, 1) a pane that stops o of the light, 0 hides it. Label, depth and normal of a
/// picture are those of the triangle where it is what is seen first.
///
/// Voxels of objects (FrameSpec::objectOfScalar) that have triangles in a pass are not drawn in it. Where a clip cuts a
/// closed mesh open, its cut face is drawn. Outside of the volume's voxels nothing is.
struct MeshTriangle {
    std::array<Vec3d, 3> corners{};  ///< counter-clockwise from outside
    volume::Scalar scalar = 0;
    friend bool operator==(const MeshTriangle&, const MeshTriangle&) = default;
};

/// Most lines, and most triangles, of a pass.
inline constexpr std::size_t kMaxShapes = std::size_t{1} << 24;

/// \return BadFrame where there are too many, a number is out of range or a point not finite
[[nodiscard]] Result<void> checkShapes(const std::vector<LineSet>& lines, const std::vector<MeshTriangle>& triangles);

}  // namespace svt::render
