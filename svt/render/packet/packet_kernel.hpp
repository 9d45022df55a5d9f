#pragma once
/// \file
/// Casts a packet of 64 rays: sets them up, walks them through a volume, and shades what they meet. Compiled for
/// several instruction sets (Highway); the best one that the machine has is chosen at run time.
///
///     samples of the picture, by ray         a group is as many rays as one vector of doubles has lanes
///
///      0  1  2  3 |  8  9 10 11              group 0    ray  0  1  2  3  4  5  6  7
///      4  5  6  7 | 12 13 14 15              group 1    ray  8  9 10 11 12 13 14 15
///     ------------+------------               ...
///     16 17 18 19 | 24 25 26 27              group 7    ray 56 57 58 59 60 61 62 63
///     20 21 22 23 | 28 29 30 31
///      ...                                   8 lanes with AVX-512 as drawn, 4 with AVX2, 2 with SSE2
///
///     change rows of a group (here of 4 lanes): written by the walk, read by the shader
///
///     |          lane 0    lane 1    lane 2    lane 3
///     | row 0    t, a      t, a      t, a      t, a       a lane has at most one change of label in a row, and its
///     | row 1    t, b      t, c      t, b      t, b       rows are in the order of t; lanes that change in the same
///     | row 2    -         t, d      t, d      -          step share a row
///
/// - Packet traversal (Wald et al. 2001): neighbouring rays cross mostly the same boxes of bricks. A box is looked up
///   once and its numbers are broadcast to all lanes, so the walk through boxes needs no gather.
/// - The next box is the one that the ray with the smallest t is in, and all rays inside that box cross it. So each
///   ray still meets its own boxes front to back, whatever order the packet takes (ours).
/// - Whether a ray is inside a box is a slab test on the times at which it crosses the box's planes. Each time is the
///   same expression for each plane, never a running sum, so crossing a box at once gives the same runs as stepping
///   through its voxels (after Amanatides and Woo 1987).
/// - Deferred shading: the walk only writes changes of label into rows; a group is shaded row by row at the end of its
///   walk, or once it has 24 rows (1 row where only labels are wanted). So most lanes are active in the shader. Rays
///   that it ends leave the walk (ours).
/// - The arithmetic and its order are those of VoxelRay, RunWalk and RunShader, in doubles and without fused
///   multiply-add. So runs, labels, depths and colors are those of the plain caster to the last bit, on every
///   instruction set (ours).

#include <svt/render/camera_rays.hpp>
#include <svt/render/light/surface_light.hpp>
#include <svt/render/occlusion.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace svt::render {

/// Rays of a packet: samples along x and along y. Where a grid of samples is cast, they are in blocks of 4 x 2, see
/// above and TileRenderer::castGrid(); otherwise rays may come in any order.
inline constexpr std::int32_t kPacketWidth = 8, kPacketHeight = 8;
inline constexpr std::size_t kPacketRays = kPacketWidth * kPacketHeight;

/// One value per ray of a packet.
template <class T>
struct alignas(64) Lanes : std::array<T, kPacketRays> {};

/// Rays of a packet; members as in VoxelRay and CameraRay.
struct PacketRays {
    Lanes<double> u, v;  ///< place in the picture, see CameraRays::at(); the input of setUpPacket()
    Lanes<double> origin[3], direction[3], inverse[3], planeOrigin[3];
    Lanes<double> slack;
    Lanes<double> view[3];  ///< world space, unit length, towards the viewer; unset where a whole vector of rays misses
    Lanes<double> metresPerT;
    Lanes<double> from, to;  ///< part of the ray inside the volume
};

/// Bits of PacketStyle::kind; 0: hidden.
enum PacketKind : std::int64_t { kVisible = 1, kOpaque = 2, kBody = 4 };

/// Style of a scalar; members as in LinearStyle.
struct PacketStyle {
    double color[3], density, surface;
    std::int64_t kind, object, label;
};
static_assert(sizeof(PacketStyle) == 64);

/// Results of the rays of a packet; members as in Sample.
struct PacketSamples {
    Lanes<double> color[3], transmittance, depth, normal[3];
    Lanes<std::int64_t> label, object, isCap;
    Lanes<std::int64_t> isDone;  ///< -1: the ray has ended
    Lanes<double> lines;         ///< transmittance of the lines met so far
    Lanes<double> nextFragment;  ///< depth of the ray's next fragment; infinity if there is none
    /// With PacketPass::hasPaint, the opaque surface at the end of the ray, whose color is not in `color` yet.
    struct Painted {
        Lanes<double> weight;  ///< factor of its color; 0: none
        Lanes<double> depth, normal[3];
        Lanes<std::int64_t> scalar, isCap;
    } painted;
};

/// A surface that PacketPass::surface shades for the kernel. Its normal is fitted to voxels, it is a cap, the eye is
/// inside, or it belongs to a body that is not opaque.
struct PacketSurface {
    std::size_t lane;
    std::int64_t scalar, plane;
    double from;
    Vec3i voxel;
    int axis;  ///< axis of the voxel face that the ray crosses there, or -1
    bool isVoxel;
};

/// A surface whose shadow the kernel asks PacketPass::unshaded for.
struct PacketPoint {
    std::size_t lane;
    double from;   ///< t of the ray
    Vec3d normal;  ///< world space, unit length
};

/// Surface::normal and Surface::outwardIndex of one side of a plane.
struct PacketFace {
    double normal[3], outwardIndex[3], unused[2];
};

/// View of an OcclusionField::Level.
struct PacketOcclusion {
    const std::uint32_t* voxels = nullptr;
    double count[3]{}, perVoxel = 0, cellSize = 0, gain = 0, weight = 0;
};

/// A pass and its volume, read by all packets.
struct PacketPass {
    volume::BrickVolume::Arrays volume;
    double count[3]{};                    ///< voxels
    const PacketStyle* styles = nullptr;  ///< by scalar; element styleCount is hidden and stands for all larger scalars
    std::int64_t styleCount = 0;
    /// Elements 2 a and 2 a + 1: voxel faces across axis a, for rays in the negative and in the positive direction.
    /// Elements 6 + 2 p and 7 + 2 p: plane p of volume.planes, seen from its positive and from its negative side.
    const PacketFace* faces = nullptr;
    std::array<PacketOcclusion, OcclusionField::kLevels> occlusion;
    double ambientOcclusion = 0;
    Vec3d towardsLight;
    double ambient = 0, key = 0;
    double opaqueAt = 1, labelAt = 0;
    bool hasOpaque = false;  ///< whether any style is opaque
    bool withColor = true;   ///< false: label and depth only; rays end at the first label
    /// Normal and light of a surface that the kernel does not shade.
    Surface (*surface)(void* context, const PacketSurface& surface) = nullptr;
    /// Share of the key light that reaches a surface of a ray; null: all of it, everywhere.
    double (*unshaded)(void* context, const PacketPoint& point) = nullptr;
    bool hasPaint = false;      ///< the caller adds the colors of opaque surfaces, see PacketSamples::painted
    bool hasFragments = false;  ///< rays may meet lines or meshes; else samples.lines and nextFragment are not read
    /// Blends the next fragment of a ray into its sample.
    void (*fragment)(void* context, std::size_t ray) = nullptr;
};

/// Sets up the rays through (rays.u, rays.v), and clips them to a volume of `count` voxels.
void setUpPacket(const CameraRays& camera, Vec3i count, PacketRays& rays);

/// The interval [from, to) of each ray that is cast; must lie within [PacketRays::from, PacketRays::to).
struct PacketSpans {
    Lanes<double> from, to;
    Lanes<std::int64_t> capped{};  ///< not 0 if the ray starts on a cap, the cut face of a clip
};

/// Walks the rays over their spans, and blends what they meet into `samples`, front to back.
/// \param context  passed to pass.surface and pass.fragment
void walkPacket(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
                PacketSamples& samples);

}  // namespace svt::render
