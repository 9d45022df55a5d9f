#pragma once
/// \file
/// Rays of neighbouring pixels at once: set up, and walked through a volume. Compiled for several instruction sets, of
/// which the best that the machine has is taken when the program runs. Internal to render.
///
/// The same arithmetic in the same order as VoxelRay, RunWalk and RunShader, in doubles and without fused operations,
/// so every set of instructions gives the very runs, labels, depths and colors of the plain caster.

#include <svt/render/camera_rays.hpp>
#include <svt/render/light/surface_light.hpp>
#include <svt/render/occlusion.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace svt::render {

/// A packet has the rays of so many pixels, in blocks of 4 x 2 that lie beside each other and are read one by one.
inline constexpr std::int32_t kPacketWidth = 8, kPacketHeight = 8;
inline constexpr std::size_t kPacketRays = kPacketWidth * kPacketHeight;

template <class T>
struct alignas(64) Lanes : std::array<T, kPacketRays> {};

/// Rays of a packet, as VoxelRay and CameraRay have them.
struct PacketRays {
    Lanes<double> u, v;  ///< where in the picture, see CameraRays::at(): what setUpPacket() is given
    Lanes<double> origin[3], direction[3], inverse[3], planeOrigin[3];
    Lanes<double> slack;
    Lanes<double> view[3];  ///< world space, unit length, towards the viewer; not set where no ray beside is inside
    Lanes<double> metresPerT;
    Lanes<double> from, to;  ///< where the ray is in the volume
};

/// Bits of PacketStyle::kind; none: hidden.
enum PacketKind : std::int64_t { kVisible = 1, kOpaque = 2, kBody = 4 };

/// Look of a scalar, as LinearStyle has it.
struct PacketStyle {
    double color[3], density, surface;
    std::int64_t kind, object, label;
};
static_assert(sizeof(PacketStyle) == 64);

/// What one packet has seen; the members of Sample.
struct PacketSamples {
    Lanes<double> color[3], transmittance, depth, normal[3];
    Lanes<std::int64_t> label, object, isCap;
    Lanes<std::int64_t> isDone;  ///< -1: the ray has ended
    Lanes<double> lines;         ///< share of the light that lines have let through
    Lanes<double> nextFragment;  ///< depth of the next fragment that the ray comes to; infinity where there is none
};

/// A surface whose normal is not found here: among voxels, on a cut face, or around the eye; and that of a body which
/// is not opaque.
struct PacketSurface {
    std::size_t lane;
    std::int64_t scalar, plane;
    double from;
    Vec3i cell;
    int axis;  ///< whose voxel face the ray crosses there, or -1
    bool isVoxel;
};

/// Surface::normal and Surface::away of all that is seen of a plane from one side.
struct PacketFace {
    double normal[3], away[3], unused[2];
};

/// OcclusionField::Level, for reading.
struct PacketOcclusion {
    const std::uint32_t* voxels = nullptr;
    double count[3]{}, perVoxel = 0, cellSize = 0, gain = 0, weight = 0;
};

/// A pass over a volume, as all packets share it.
struct PacketPass {
    volume::BrickVolume::Arrays volume;
    double bricksX = 0, bricksY = 0;
    double count[3]{};                    ///< voxels
    const PacketStyle* styles = nullptr;  ///< by scalar; one more, hidden, for all scalars from styleCount on
    std::int64_t styleCount = 0;
    /// 2 a, 2 a + 1: faces of voxels across axis a, seen by rays that go back along it, and on; from 6 on, the same for
    /// each of volume.oblique: seen from its positive side, and from the other.
    const PacketFace* faces = nullptr;
    std::array<PacketOcclusion, OcclusionField::kLevels> occlusion;
    double ambientOcclusion = 0;
    Vec3d towardsLight;
    double ambient = 0, key = 0;
    double opaqueAt = 1, labelAt = 0;
    bool hasOpaque = false;  ///< whether any style is opaque
    bool withColor = true;   ///< false: ends at the first label, without light
    Surface (*surface)(void* context, const PacketSurface& surface) = nullptr;
    bool hasFragments = false;  ///< rays may come to lines or meshes; else samples.lines and nextFragment are not read
    /// Adds the next fragment of a ray to its samples.
    void (*fragment)(void* context, std::size_t ray) = nullptr;
};

/// Rays through the places `rays.u`, `rays.v`, and where they are in a volume of `count` voxels.
void setUpPacket(const CameraRays& camera, Vec3i count, PacketRays& rays);

/// Where the rays of a packet are cast: on [from, to) each, which must lie in PacketRays::from and to.
struct PacketSpans {
    Lanes<double> from, to;
    Lanes<std::int64_t> capped{};  ///< not 0 where a clip made the start
};

/// Walks the rays over their spans and adds to `samples`. \param context  handed to pass.surface
void walkPacket(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
                PacketSamples& samples);

}  // namespace svt::render
