#pragma once
/// \file
/// Vector types and helpers of the packet kernel: rays as vectors (RayVectors), and table look-ups and gathers by lane
/// (lookUp(), gatherBytes(), Styles). ChangeRows carries changes of label from the walk to the shader.
///
///     change word of one lane     bits 0..31  scalar    bit 32  a brick of voxels only    bits 33..  plane + 1
///
/// If isSame() finds that all lanes need the same element, one scalar load replaces the gather.

#include <svt/render/packet/packet_kernel.hpp>

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace svt::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;
using MI = hn::Mask<DI>;

struct V3 {
    V x, y, z;
};

HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 loadV3(const Lanes<double> (&lanes)[3], std::size_t first) {
    const D d;
    return {hn::Load(d, lanes[0].data() + first), hn::Load(d, lanes[1].data() + first),
            hn::Load(d, lanes[2].data() + first)};
}
HWY_INLINE void store(V v, Lanes<double>& lanes, std::size_t first) { hn::Store(v, D(), lanes.data() + first); }

// 64 bits of `array` at a byte offset, per lane. All offsets must be valid, also those of inactive lanes.
HWY_INLINE VI gatherBytes(const void* array, VI offset) {
    return hn::GatherOffset(DI(), static_cast<const std::int64_t*>(array), offset);
}
// Element `index`, 0..7, of a table of 8 elements, per lane.
HWY_INLINE VI lookUp(const std::uint64_t* table, VI index) {
    const DI di;
    if constexpr (hn::MaxLanes(D()) == 8) {
        const VI all = hn::BitCast(di, hn::LoadU(DU(), table));
        return hn::TableLookupLanes(all, hn::IndicesFromVec(di, index));
    } else {
        return gatherBytes(table, hn::ShiftLeft<3>(index));
    }
}
HWY_INLINE VI lowHalf(VI v) { return hn::And(v, hn::Set(DI(), 0xFFFFFFFF)); }
// The same for 32-bit elements. `count` is the table's size; 7 more elements behind it must be readable.
HWY_INLINE VI lookUp(const volume::Scalar* table, std::size_t count, VI index) {
    const DI di;
    if constexpr (hn::MaxLanes(D()) == 8) {
        if (count <= 8) {
            const VI all = hn::BitCast(di, hn::PromoteTo(DU(), hn::LoadU(hn::Rebind<std::uint32_t, D>(), table)));
            return hn::TableLookupLanes(all, hn::IndicesFromVec(di, index));
        }
    }
    return lowHalf(gatherBytes(table, hn::ShiftLeft<2>(index)));
}
template <int kBits>
HWY_INLINE VI shiftRight(VI v) {
    return hn::BitCast(DI(), hn::ShiftRight<kBits>(hn::BitCast(DU(), v)));
}
HWY_INLINE VI shiftRightBy(VI v, VI bits) {
    return hn::BitCast(DI(), hn::Shr(hn::BitCast(DU(), v), hn::BitCast(DU(), bits)));
}
template <int kFirst, int kCount>
HWY_INLINE VI bitsOf(VI v) {
    return hn::And(shiftRight<kFirst>(v), hn::Set(DI(), (std::int64_t{1} << kCount) - 1));
}
HWY_INLINE MI isSet(VI v, std::int64_t bit) { return hn::Ne(hn::And(v, hn::Set(DI(), bit)), hn::Zero(DI())); }
HWY_INLINE V toDouble(VI v) { return hn::ConvertTo(D(), v); }
HWY_INLINE VI toInt(V v) { return hn::ConvertTo(DI(), v); }
HWY_INLINE M toDoubles(MI m) { return hn::RebindMask(D(), m); }
HWY_INLINE MI toInts(M m) { return hn::RebindMask(DI(), m); }
HWY_INLINE bool any(M m) { return !hn::AllFalse(D(), m); }
HWY_INLINE M andNot(M without, M m) { return hn::AndNot(without, m); }

HWY_INLINE V3 broadcast(Vec3d v) {
    const D d;
    return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
HWY_INLINE V3 sum(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE V3 times(const V3& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }

// One axis of the rays of a vector; members as in VoxelRay.
struct Axis {
    V origin, direction, inverse, planeOrigin, count;
    M isNegative, isNonZero;

    HWY_INLINE V planeTime(V plane) const { return hn::Mul(hn::Sub(plane, planeOrigin), inverse); }
    HWY_INLINE V at(V t) const { return hn::Add(origin, hn::Mul(t, direction)); }
};

// Whether all lanes of the mask, which must not be empty, hold the same number, `first`. Neighbouring rays usually do.
HWY_INLINE bool isSame(VI numbers, M lanes, std::int64_t& first) {
    first = hn::ExtractLane(numbers, hn::FindKnownFirstTrue(D(), lanes));
    return !any(hn::And(lanes, toDoubles(hn::Ne(numbers, hn::Set(DI(), first)))));
}

// The rays of one group: one vector per component.
struct RayVectors {
    Axis x, y, z;
    V slack;
    bool areNonZero;       // no ray has a zero direction on any axis
    bool isPlain = false;  // also, the signs of its directions are those of the packet's ray 0, see hasDirections()

    HWY_INLINE RayVectors(const PacketPass& pass, const PacketRays& rays, std::size_t first)
        : x(axisOf(pass, rays, first, 0)),
          y(axisOf(pass, rays, first, 1)),
          z(axisOf(pass, rays, first, 2)),
          slack(hn::Load(D(), rays.slack.data() + first)) {
        areNonZero = hn::AllTrue(D(), hn::And(hn::And(x.isNonZero, y.isNonZero), z.isNonZero));
    }

    // Whether all directions are non-zero, and negative exactly on the axes of `isNegative`.
    HWY_INLINE bool hasDirections(const bool (&isNegative)[3]) const {
        const auto isSo = [&](const Axis& axis, bool back) {
            return hn::AllTrue(D(), axis.isNonZero) &&
                   (back ? hn::AllTrue(D(), axis.isNegative) : hn::AllFalse(D(), axis.isNegative));
        };
        return isSo(x, isNegative[0]) && isSo(y, isNegative[1]) && isSo(z, isNegative[2]);
    }

    // The voxel plane nearest to a ray at t, and the time at which the ray crosses it.
    struct NearPlane {
        V position, plane, time;
    };
    static HWY_INLINE NearPlane nearPlane(const Axis& axis, V t) {
        const V position = axis.at(t), plane = hn::Round(position);
        return {position, plane, axis.planeTime(plane)};
    }
    // The voxels that the rays are in at t, see VoxelRay::voxelAt(). Undefined for rays that have ended.
    HWY_INLINE V3 voxels(V t) const {
        const auto voxelOf = [&](const Axis& axis) {
            const D d;
            const V one = hn::Set(d, 1.0);
            const NearPlane near = nearPlane(axis, t);
            // Next to a plane, the crossing time decides, not the rounded position.
            const M isBeside = hn::And(axis.isNonZero, hn::Le(hn::Abs(hn::Sub(near.position, near.plane)), slack));
            const M isBelow = hn::Not(hn::Xor(hn::Le(near.time, t), axis.isNegative));
            const V decided = hn::IfThenElse(isBelow, hn::Sub(near.plane, one), near.plane);
            const V voxel = hn::IfThenElse(isBeside, decided, hn::Floor(near.position));
            return hn::Min(hn::Max(voxel, hn::Zero(d)), hn::Sub(axis.count, one));
        };
        return {voxelOf(x), voxelOf(y), voxelOf(z)};
    }

private:
    static HWY_INLINE Axis axisOf(const PacketPass& pass, const PacketRays& rays, std::size_t first, std::size_t a) {
        const D d;
        Axis axis;
        axis.origin = hn::Load(d, rays.origin[a].data() + first);
        axis.direction = hn::Load(d, rays.direction[a].data() + first);
        axis.inverse = hn::Load(d, rays.inverse[a].data() + first);
        axis.planeOrigin = hn::Load(d, rays.planeOrigin[a].data() + first);
        axis.count = hn::Set(d, pass.count[a]);
        axis.isNegative = hn::Lt(axis.direction, hn::Zero(d));
        axis.isNonZero = hn::Ne(axis.direction, hn::Zero(d));
        return axis;
    }
};

// Reference to the style of each lane.
struct StyleRef {
    const PacketStyle* same;  // the style of all lanes; null if they differ, and then
    VI offset;                // byte offset of each lane's style
};

// Styles by scalar, read per lane.
class Styles {
public:
    HWY_INLINE explicit Styles(const PacketPass& pass) : styles_(pass.styles), count_(pass.styleCount) {}

    HWY_INLINE StyleRef find(VI scalar, M lanes) const {
        const DI di;
        std::int64_t first = 0;
        if (isSame(scalar, lanes, first)) return {styles_ + std::min(first, count_), hn::Zero(di)};
        const VI known = hn::Min(scalar, hn::Set(di, count_));
        return {nullptr, hn::ShiftLeft<6>(hn::IfThenElseZero(toInts(lanes), known))};
    }
    template <std::size_t kMember>
    HWY_INLINE V number(const StyleRef& style) const {
        if (style.same != nullptr) {
            double value;
            std::memcpy(&value, reinterpret_cast<const std::byte*>(style.same) + kMember, sizeof value);
            return hn::Set(D(), value);
        }
        return hn::BitCast(D(), gatherBytes(reinterpret_cast<const std::byte*>(styles_) + kMember, style.offset));
    }
    template <std::size_t kMember>
    HWY_INLINE VI integer(const StyleRef& style) const {
        return hn::BitCast(DI(), number<kMember>(style));
    }

private:
    const PacketStyle* styles_;
    std::int64_t count_;
};

// Changes of label of the rays of a group, in rows: at most one change per ray and row, in ascending order of t by ray.
class ChangeRows {
public:
    // A walk through one box adds fewer than kMaxRowsPerBox rows, so rows must be emptied once there are kShadeAt.
    static constexpr std::size_t kShadeAt = 24, kMaxRowsPerBox = 24, kMaxRows = kShadeAt + kMaxRowsPerBox;

    HWY_INLINE void clear() {
        count_ = 0;
        next_ = hn::Zero(DI());
    }
    [[nodiscard]] HWY_INLINE std::size_t count() const { return count_; }

    // `plane`: number of the oblique plane that the ray crosses at t, or -1.
    HWY_INLINE void add(M lanes, V t, VI scalar, VI plane, bool isVoxel) {
        const D d;
        const DI di;
        VI change = hn::Or(scalar, hn::ShiftLeft<33>(hn::Add(plane, hn::Set(di, 1))));
        if (isVoxel) change = hn::Or(change, hn::Set(di, std::int64_t{1} << 32));
        // The first row behind the last rows of all these lanes. It may hold changes of other lanes already: lanes that
        // meet the same wall in different boxes share a row.
        const auto row =
            static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(di, hn::IfThenElseZero(toInts(lanes), next_))));
        const V before = row < count_ ? hn::Load(d, t_[row]) : t;
        const VI known = row < count_ ? hn::Load(di, changes_[row]) : hn::Set(di, kNone);
        hn::Store(hn::IfThenElse(lanes, t, before), d, t_[row]);
        hn::Store(hn::IfThenElse(toInts(lanes), change, known), di, changes_[row]);
        next_ = hn::IfThenElse(toInts(lanes), hn::Set(di, static_cast<std::int64_t>(row) + 1), next_);
        count_ = std::max(count_, row + 1);
    }

    struct Row {
        V t;
        VI change;

        HWY_INLINE M lanes() const { return toDoubles(hn::Ne(change, hn::Set(DI(), kNone))); }
        HWY_INLINE VI scalar() const { return lowHalf(change); }
        HWY_INLINE VI plane() const { return hn::Sub(shiftRight<33>(change), hn::Set(DI(), 1)); }
        HWY_INLINE M isVoxel() const { return toDoubles(isSet(change, std::int64_t{1} << 32)); }
    };
    [[nodiscard]] HWY_INLINE Row operator[](std::size_t row) const {
        return {hn::Load(D(), t_[row]), hn::Load(DI(), changes_[row])};
    }

private:
    static constexpr std::int64_t kNone = -1;
    static constexpr std::size_t kLanes = hn::MaxLanes(D());

    std::size_t count_ = 0;
    VI next_;  // by lane: the row after its last one
    alignas(64) double t_[kMaxRows][kLanes];
    alignas(64) std::int64_t changes_[kMaxRows][kLanes];
};

}  // namespace
}  // namespace svt::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
