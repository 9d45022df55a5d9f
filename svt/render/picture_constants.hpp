#pragma once
/// \file
/// Numbers that the casters of this folder and the shaders of render_gl share, so that they draw the same picture. Each
/// is defined only here; render_gl passes them to its shaders. For renderers: used by render and render_gl.

#include <cstdint>

namespace svt::render {

// Light.

/// Sky light on a vertical surface, and the light added to it, times the normal's upward component.
inline constexpr double kSkyAside = 0.80, kSkyAbove = 0.20;
/// The shares of ambient light: sky, and light from the viewer.
inline constexpr double kSkyShare = 0.82, kViewerShare = 0.18;
/// Share of the key light at full occlusion, and the share added to it, times openness.
inline constexpr double kKeyShut = 0.45, kKeyOpen = 0.55;
/// Occlusion in a full cavity of voxels.
inline constexpr double kCavityOcclusion = 0.35;
/// A cavity begins where the filled share of the ball is this much over that on a plane, and grows by this factor.
inline constexpr double kCavityFrom = 0.05, kCavityGain = 2.5;

// Normals of voxels and seams, see fitNormal() and seamPlane().

/// Voxels in the ball around the voxel in front of a surface: all, and those filled on a plane.
inline constexpr std::int32_t kBallVoxels = 179, kPlaneVoxels = 71;
/// Fewer places than this are the edge of a step, not a face; a corner of two edges has 16.
inline constexpr std::int32_t kFacePlaces = 12;
/// With this many heights of slopes up to 1, no other axis gives a better fit.
inline constexpr std::int32_t kGentlePlaces = 24;
/// A plane of a seam is nearer to its point than this, voxels, and its normal has a larger component across the face.
inline constexpr double kSeamDistance = 0.75, kSeamSlope = 0.2;

// Lines inside the volume.

/// Depth bias towards the viewer: voxels, and half widths of the line. Next to the line, its surface may be nearer.
inline constexpr double kVoxelsBefore = 1.5, kHalfWidthsBefore = 4;
/// Lines this close in depth are one, voxels.
inline constexpr double kVoxelsTogether = 2;

// Border lines, see TileRenderer::lineBetween().

/// Least cosine between a surface's normal and the view direction with which depths next to it are predicted.
inline constexpr double kLeastFacing = 0.02;
/// Share of the predicted change of depth by which the depth may differ without a border.
inline constexpr double kDepthTolerance = 0.7;
/// Opacity of a border line on a fully transparent sample.
inline constexpr float kGlassLine = 0.5f;

// Hatches of caps.

/// From this component along the grid's up direction on, a cap's normal counts as vertical.
inline constexpr double kLevelCap = 0.9;
/// Least cosine between a cap's normal and the view direction with which lines are antialiased.
inline constexpr double kLeastCapFacing = 0.15;

}  // namespace svt::render
