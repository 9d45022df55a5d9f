/// \file
/// The packet kernel for one set of instructions: SVT_KERNEL_TARGET, a target of Highway. Each is a source file of its
/// own (packet_kernel_avx2.cpp, ...), because compiling one takes as long as the rest of this folder.

#ifndef SVT_KERNEL_TARGET
#error "define SVT_KERNEL_TARGET before including this file"
#endif

#include <svt/core/simd_targets.hpp>
#include <svt/render/packet/packet_kernel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

// Highway includes this file once for each of its targets, HWY_TARGET; all but one are skipped.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/render/packet/packet_kernel-inl.hpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == SVT_KERNEL_TARGET

#include <svt/render/packet/packet_shader-inl.hpp>
#include <svt/render/packet/packet_walk-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace svt::render::HWY_NAMESPACE {
namespace {

// Walks and shades a packet: takes the box of the ray with the smallest t, lets all rays inside cross it, and repeats;
// see packet_kernel.hpp.
template <bool kWithFragments>
class Packet {
    using Shader = HWY_NAMESPACE::Shader<kWithFragments>;

public:
    HWY_INLINE Packet(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
                      PacketSamples& samples)
        : Packet(pass, rays, spans, context, samples, std::make_index_sequence<kGroups>()) {}

    HWY_INLINE void walk() {
        Vec3i voxel;
        while (findRearmostVoxel(voxel)) crossAt(voxel);
        for (Group& group : groups_) finish(group);
    }

private:
    static constexpr std::size_t kGroups = kPacketRays / hn::MaxLanes(D());

    // The rays of one vector.
    struct Group {
        RayVectors vectors;
        ChangeRows changes;
        Walk walk;
        Shader shader;
        bool isShaded = false;

        HWY_INLINE Group(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
                         PacketSamples& samples, const bool (&isNegative)[3], std::size_t first)
            : vectors(pass, rays, first),
              walk(pass, rays, vectors, first, changes),
              shader(pass, rays, vectors, first, context, samples) {
            vectors.isPlain = vectors.hasDirections(isNegative);
            changes.clear();
            walk.begin(spans.from, spans.to, samples.isDone);
        }
    };

    template <std::size_t... kNumbers>
    HWY_INLINE Packet(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
                      PacketSamples& samples, std::index_sequence<kNumbers...>)
        : pass_(pass),
          spans_(spans),
          isNegative_{rays.direction[0][0] < 0, rays.direction[1][0] < 0, rays.direction[2][0] < 0},
          shadeAtRows_(pass.withColor ? ChangeRows::kShadeAt : 1),
          groups_{Group(pass, rays, spans, context, samples, isNegative_, kNumbers * hn::MaxLanes(D()))...} {}

    // Shades the group's change rows; rays that the shader ends leave the walk.
    HWY_NOINLINE void shade(Group& group) {
        if (!group.isShaded) group.shader.begin(spans_);
        group.isShaded = true;
        group.shader.shade(group.changes);
        group.changes.clear();
        group.walk.end(group.shader.isDone());
    }
    HWY_INLINE void finish(Group& group) {
        const bool isUntouched = !group.isShaded && group.changes.count() == 0;
        if (isUntouched && !kWithFragments) return;
        shade(group);
        group.shader.finish();
    }

    // Finds the voxel of the ray with the smallest t; false if all rays have ended.
    HWY_INLINE bool findRearmostVoxel(Vec3i& voxel) const {
        const D d;
        V least = groups_[0].walk.times();
        for (std::size_t n = 1; n < kGroups; ++n) least = hn::Min(least, groups_[n].walk.times());
        least = hn::MinOfLanes(d, least);
        const double t = hn::GetLane(least);
        // If all are infinite, MinOfLanes() of Highway's portable targets returns the largest finite number.
        if (!(t < std::numeric_limits<double>::max())) return false;
        for (const Group& group : groups_) {
            const M isRearmost = hn::Eq(group.walk.times(), least);
            if (!any(isRearmost)) continue;
            voxel = group.walk.voxel(hn::FindKnownFirstTrue(d, isRearmost), t);
            break;
        }
        return true;
    }

    HWY_INLINE void crossAt(Vec3i voxel) {
        const volume::BrickVolume::Arrays& volume = pass_.volume;
        const std::size_t entry = volume.entry(voxel.x >> 3, voxel.y >> 3, voxel.z >> 3);
        Bounds bounds;
        if (entry < volume.boxes.size()) {
            const volume::SameLabelBox& box = volume.boxes[entry];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                bounds.low[axis] = box.min[axis];
                bounds.high[axis] = box.max[axis];
            }
            if (entry < volume.uniformBoxes) return crossUniform(bounds, box.scalar);
            return crossCoded(bounds, volume.codes[box.scalar]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            bounds.low[axis] = voxel[axis] & ~7;
            bounds.high[axis] = bounds.low[axis] + 8;
        }
        crossVoxels(bounds, volume.bricks[entry - volume.boxes.size()]);
    }
    // Lets all rays that are inside a box cross it.
    template <class Cross>
    HWY_INLINE void crossAll(Bounds& bounds, const Cross& cross) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bounds.ahead[axis] = isNegative_[axis] ? bounds.low[axis] : bounds.high[axis];
            bounds.behind[axis] = isNegative_[axis] ? bounds.high[axis] : bounds.low[axis];
        }
        for (Group& group : groups_) {
            const Walk::Inside inside = group.walk.findInside(bounds);
            if (!any(inside.lanes)) continue;
            cross(group.walk, inside);
            if (group.changes.count() >= shadeAtRows_) shade(group);
        }
    }
    HWY_INLINE void crossUniform(Bounds& bounds, std::int64_t scalar) {
        crossAll(bounds, [&](Walk& walk, const Walk::Inside& inside) { walk.crossUniform(inside, scalar); });
    }
    HWY_INLINE void crossCoded(Bounds& bounds, const volume::BrickVolume::BoxCoding& code) {
        crossAll(bounds, [&](Walk& walk, const Walk::Inside& inside) { walk.crossCoded(inside, code); });
    }
    HWY_INLINE void crossVoxels(Bounds& bounds, const volume::BrickVolume::PaletteBrick& brick) {
        crossAll(bounds, [&](Walk& walk, const Walk::Inside& inside) { walk.crossVoxels(inside, bounds, brick); });
    }

    const PacketPass& pass_;
    const PacketSpans& spans_;
    bool isNegative_[3];  // by axis: ray 0 has a negative direction; nearly always all rays agree
    std::size_t shadeAtRows_;
    std::array<Group, kGroups> groups_;
};

}  // namespace

void setUp(const CameraRays& camera, Vec3i count, PacketRays& rays) {
    const D d;
    const CameraRays::Basis basis = camera.basis();
    const V one = hn::Set(d, 1.0), zero = hn::Zero(d), infinity = hn::Set(d, kInfinity);
    for (std::size_t i = 0; i < kPacketRays; i += hn::Lanes(d)) {
        const V x = hn::Mul(hn::Load(d, rays.u.data() + i), hn::Set(d, basis.halfWidth));
        const V y = hn::Mul(hn::Load(d, rays.v.data() + i), hn::Set(d, basis.halfHeight));
        const V3 aside = sum(times(broadcast(basis.rightVoxel), x), times(broadcast(basis.upVoxel), y));
        V3 origin = broadcast(basis.eyeVoxel), direction = broadcast(basis.forwardVoxel);
        V3 world = broadcast(basis.forward);
        V metres = one;
        if (camera.isPerspective()) {
            direction = sum(direction, aside);
            world = sum(sum(world, times(broadcast(basis.right), x)), times(broadcast(basis.up), y));
            metres = hn::Sqrt(hn::Add(hn::Add(one, hn::Mul(x, x)), hn::Mul(y, y)));
        } else {
            origin = sum(origin, aside);
        }
        const V least = hn::Mul(hn::Max(hn::Max(hn::Abs(direction.x), hn::Abs(direction.y)), hn::Abs(direction.z)),
                                hn::Set(d, 1e-12));
        const V far =
            hn::Add(hn::Add(hn::Add(hn::Abs(origin.x), hn::Abs(origin.y)), hn::Abs(origin.z)), hn::Set(d, 65536.0));
        store(hn::Mul(hn::Set(d, 1e-13), far), rays.slack, i);
        store(metres, rays.metresPerT, i);
        V from = zero, to = infinity;
        const auto axis = [&](int a, V o, V along) {
            const auto n = static_cast<std::size_t>(a);
            const M moves = hn::Gt(hn::Abs(along), least);
            const V inverse = hn::IfThenElse(moves, hn::Div(one, along), infinity);
            const V planeOrigin = hn::IfThenElse(moves, o, hn::Set(d, -1.0));
            const V voxels = hn::Set(d, static_cast<double>(count[a]));
            const V low = hn::Mul(hn::Sub(zero, planeOrigin), inverse);
            const V high = hn::Mul(hn::Sub(voxels, planeOrigin), inverse);
            from = hn::IfThenElse(moves, hn::Max(from, hn::Min(low, high)), from);
            to = hn::IfThenElse(moves, hn::Min(to, hn::Max(low, high)), to);
            const M misses = andNot(hn::Or(moves, hn::And(hn::Ge(o, zero), hn::Lt(o, voxels))), hn::Eq(one, one));
            to = hn::IfThenElse(misses, zero, to);
            store(o, rays.origin[n], i);
            store(hn::IfThenElseZero(moves, along), rays.direction[n], i);
            store(inverse, rays.inverse[n], i);
            store(planeOrigin, rays.planeOrigin[n], i);
        };
        axis(0, origin.x, direction.x);
        axis(1, origin.y, direction.y);
        axis(2, origin.z, direction.z);
        store(from, rays.from, i);
        store(to, rays.to, i);
        if (!any(hn::Lt(from, to))) continue;
        const V length = hn::Sqrt(dot(world, world));
        store(hn::Div(hn::Neg(world.x), length), rays.view[0], i);
        store(hn::Div(hn::Neg(world.y), length), rays.view[1], i);
        store(hn::Div(hn::Neg(world.z), length), rays.view[2], i);
    }
}

void walk(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
          PacketSamples& samples) {
    if (pass.hasFragments)
        Packet<true>(pass, rays, spans, context, samples).walk();
    else
        Packet<false>(pass, rays, spans, context, samples).walk();
}

}  // namespace svt::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
