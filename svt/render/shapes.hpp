#pragma once
/// \file
/// Lines and triangles that a pass draws inside the volume, composited by depth, as plain data.

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::render {

/// How hidden parts of a line, those behind something opaque, are drawn.
enum class HiddenLines : std::uint8_t { None, Faint, Dashed };
constexpr auto namesOf(HiddenLines) {
    return std::to_array<Name<HiddenLines>>(
        {{HiddenLines::Faint, "faint"}, {HiddenLines::Dashed, "dashed"}, {HiddenLines::None, "none"}});
}

/// World space, metres.
struct Line {
    Vec3d from{}, to{};
    volume::Scalar scalar = 0;  ///< scalar that the line belongs to; drawn if the pass shows that scalar
    friend bool operator==(const Line&, const Line&) = default;
};

/// Lines of one style. A depth bias of 1.5 voxels and four half widths draws them in front of the surface that they lie
/// on, so that the edges of a body lie on its voxels. They change only the colour of a picture, not its labels and
/// depths. Where lines coincide, as the edges of neighbours do, only the strongest is drawn. Lines shorter than half a
/// pixel are left out.
struct LineSet {
    std::vector<Line> lines;
    Vec3f color{0.10f, 0.10f, 0.12f};  ///< sRGB, 0..1; not lit
    float width = 1;                   ///< pixels, 0.1 to 64, at any depth
    HiddenLines hidden = HiddenLines::Faint;
    float hiddenOpacity = 0.25f;    ///< of the hidden part, or of its dashes, 0..1
    float dash = 6, gap = 4;        ///< of hidden lines, pixels along the line in the picture, 0.5 to 1000
    bool withHiddenLabels = false;  ///< whether lines of scalars with opacity 0 are drawn as well
    friend bool operator==(const LineSet&, const LineSet&) = default;
};

/// A triangle of a mesh, world space, metres; visible from both sides. It has the style of its scalar: opacity 1 is an
/// opaque surface, 0 hides it. An opacity in (0, 1) is that of a metre, as for voxels: two faces of a closed mesh stop
/// the light that its mean thickness stops. This is twice the volume over the area, at least the largest spacing. A face
/// of an open mesh stops the light of one spacing. Where a triangle is the first thing that a ray meets, label, depth and
/// normal of the picture are its own.
///
/// A pass does not draw the voxels of objects (FrameSpec::objectOfScalar) that have triangles in it. Where a clip cuts
/// a closed mesh open, its cap is drawn. Nothing is drawn outside the volume's voxels.
struct MeshTriangle {
    std::array<Vec3d, 3> corners{};  ///< counter-clockwise from outside
    volume::Scalar scalar = 0;
    friend bool operator==(const MeshTriangle&, const MeshTriangle&) = default;
};

/// Maximum number of lines, and of triangles, of a pass.
inline constexpr std::size_t kMaxShapes = std::size_t{1} << 24;

/// \return BadFrame if there are too many, a number is out of range or a point is not finite
[[nodiscard]] Result<void> checkShapes(const std::vector<LineSet>& lines, const std::vector<MeshTriangle>& triangles);

}  // namespace svt::render
