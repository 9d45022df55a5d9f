#include <svt/render/packet_kernel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

// This file is compiled once for each set of instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/render/packet_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// 64 bits of `array` at a byte offset in each lane that is in `mask`; elsewhere 0.
HWY_INLINE VI gatherBytes(const void* array, VI offset) {
    return hn::GatherOffset(DI(), static_cast<const std::int64_t*>(array), offset);
}
// Element `index`, 0..7, of a table of 8 in each lane.
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
// The same for 32 bits; `count` is of the table, which has 7 more behind it.
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

// See expOfMinus() of the plain caster.
HWY_INLINE V expOfMinus(V x) {
    const D d;
    const DI di;
    const V one = hn::Set(d, 1.0);
    const auto isSmall = hn::Lt(x, hn::Set(d, 80.0));
    const V safe = hn::IfThenElseZero(isSmall, x);
    const V halvings = hn::Mul(safe, hn::Set(d, 1.4426950408889634));
    const V n = hn::Floor(hn::Add(halvings, hn::Set(d, 0.5)));
    const V r = hn::Mul(hn::Sub(halvings, n), hn::Set(d, 0.34657359027997264));
    const V square = hn::Mul(r, r);
    const auto pair = [&](double c0, double c1) { return hn::Sub(hn::Set(d, c0), hn::Mul(r, hn::Set(d, c1))); };
    const V high = hn::Add(pair(0.5, 1.0 / 6), hn::Mul(square, pair(1.0 / 24, 1.0 / 120)));
    const V sum = hn::Add(hn::Sub(one, r), hn::Mul(square, high));
    const V power = hn::BitCast(d, hn::ShiftLeft<52>(hn::Sub(hn::Set(di, 1023), toInt(n))));
    return hn::IfThenElseZero(isSmall, hn::Mul(hn::Mul(sum, sum), power));
}

HWY_INLINE V3 broadcast(Vec3d v) {
    const D d;
    return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
HWY_INLINE V3 sum(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE V3 times(const V3& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }

bool setUp(const CameraRays& camera, Vec3i count, PacketRays& rays) {
    bool isAnyInside = false;
    const D d;
    const CameraRays::Basis basis = camera.basis();
    const V one = hn::Set(d, 1.0), zero = hn::Zero(d), infinity = hn::Set(d, kInfinity);
    for (std::size_t i = 0; i < kPacketRays; i += hn::Lanes(d)) {
        const V x = hn::Mul(hn::Load(d, rays.u.data() + i), hn::Set(d, basis.halfWidth));
        const V y = hn::Mul(hn::Load(d, rays.v.data() + i), hn::Set(d, basis.halfHeight));
        const V3 aside = sum(times(broadcast(basis.rightIndex), x), times(broadcast(basis.upIndex), y));
        V3 origin = broadcast(basis.eyeIndex), direction = broadcast(basis.forwardIndex);
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
        isAnyInside = true;
        const V length = hn::Sqrt(dot(world, world));
        store(hn::Div(hn::Neg(world.x), length), rays.view[0], i);
        store(hn::Div(hn::Neg(world.y), length), rays.view[1], i);
        store(hn::Div(hn::Neg(world.z), length), rays.view[2], i);
    }
    return isAnyInside;
}

// One axis of the rays.
struct Axis {
    V origin, direction, inverse, planeOrigin, count;
    M isNegative, isMoving;

    HWY_INLINE V planeTime(V plane) const { return hn::Mul(hn::Sub(plane, planeOrigin), inverse); }
    HWY_INLINE V at(V t) const { return hn::Add(origin, hn::Mul(t, direction)); }
};

// Whether the lanes, of which there must be one, have the same number: `first`. Neighbors mostly have.
HWY_INLINE bool isSame(VI numbers, M lanes, std::int64_t& first) {
    first = hn::ExtractLane(numbers, hn::FindKnownFirstTrue(D(), lanes));
    return !any(hn::And(lanes, toDoubles(hn::Ne(numbers, hn::Set(DI(), first)))));
}

// What a scalar, or each lane's own, looks like.
struct Looks {
    const PacketStyle* same;  // of all lanes; or null, and
    VI offset;                // bytes to each lane's
};

// Voxels [low, high) of a box.
struct Bounds {
    double low[3], high[3];
};

// Rays of a packet under way; as many as one vector takes. What lines and meshes need is left out where there are none:
// it would cost 4 %.
template <bool kWithFragments>
class Walk {
public:
    HWY_INLINE Walk(const PacketScene& scene, const PacketRays& rays, std::size_t first, void* context,
                    PacketSamples& samples)
        : scene_(scene),
          rays_(rays),
          first_(first),
          context_(context),
          samples_(samples),
          x_(axisOf(0)),
          y_(axisOf(1)),
          z_(axisOf(2)),
          metresPerT_(hn::Load(D(), rays.metresPerT.data() + first)),
          slack_(hn::Load(D(), rays.slack.data() + first)),
          runScalar_(hn::Set(DI(), -1)),
          object_(hn::Set(DI(), -1)),
          crossed_(hn::Set(DI(), -1)),
          light_(hn::Set(D(), 1.0)) {
        areMoving_ = hn::AllTrue(D(), hn::And(hn::And(x_.isMoving, y_.isMoving), z_.isMoving));
        areSameWay_ = true;
        const Axis* const axes[3]{&x_, &y_, &z_};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            goBack_[axis] = hn::AllTrue(D(), axes[axis]->isNegative);
            areSameWay_ = areSameWay_ && (goBack_[axis] || hn::AllFalse(D(), axes[axis]->isNegative));
        }
        normal_ = away_ = {hn::Zero(D()), hn::Zero(D()), hn::Zero(D())};
        isOnCap_ = isAroundEye_ = hn::Lt(light_, light_);
        const D d;
        color_ = loadV3(samples.color, first);
        transmittance_ = hn::Load(d, samples.transmittance.data() + first);
        if constexpr (kWithFragments) lines_ = hn::Load(d, samples.lines.data() + first);
        runStart_ = labelStart_ = hn::Zero(d);
    }

    // Starts on [from, to).
    HWY_INLINE void begin(const Lanes<double>& from, const Lanes<double>& to, const Lanes<std::int64_t>& capped) {
        const D d;
        from_ = t_ = hn::Load(d, from.data() + first_);
        end_ = hn::Load(d, to.data() + first_);
        isCapped_ = toDoubles(hn::Ne(hn::Load(DI(), capped.data() + first_), hn::Zero(DI())));
        isDone_ = toDoubles(hn::Ne(hn::Load(DI(), samples_.isDone.data() + first_), hn::Zero(DI())));
        active_ = started_ = andNot(isDone_, hn::Lt(t_, end_));
        isRunTranslucent_ = isOpaque_ = isUnlit_ = hn::Lt(t_, t_);
        t_ = hn::IfThenElse(active_, t_, hn::Set(d, kInfinity));
        if constexpr (kWithFragments)
            hasFragments_ = any(hn::Lt(hn::Load(d, samples_.nextFragment.data() + first_), hn::Set(d, kInfinity)));
    }

    // Where the rays are; infinity for those that have ended.
    HWY_INLINE V times() const { return t_; }
    // The voxel that one of them is in at t, see IndexRay::cellAt().
    HWY_INLINE Vec3i cell(std::size_t lane, double t) const {
        const std::size_t ray = first_ + lane;
        Vec3i cell;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double along = rays_.direction[axis][ray], position = rays_.origin[axis][ray] + t * along;
            const auto plane = static_cast<std::int64_t>(position + 0.5);
            const auto inner = static_cast<std::int64_t>(position);
            const double aside = position - static_cast<double>(plane);
            const double time = (static_cast<double>(plane) - rays_.planeOrigin[axis][ray]) * rays_.inverse[axis][ray];
            // Beside a plane rounding must not decide. Without branches: nobody foretells them.
            const bool isBeside = (std::abs(aside) <= rays_.slack[ray]) & (along != 0);
            const std::int64_t decided = plane - std::int64_t{(time <= t) == (along < 0)};
            const std::int64_t at = isBeside ? decided : inner;
            const auto last = static_cast<std::int64_t>(scene_.count[axis]) - 1;
            cell[static_cast<int>(axis)] = static_cast<std::int32_t>(std::clamp<std::int64_t>(at, 0, last));
        }
        return cell;
    }

    // The box that rays are in.
    struct Inside {
        M lanes;
        V exit;  // when they leave it
    };
    HWY_INLINE Inside findInside(const Bounds& box) const {
        const D d;
        Inside inside;
        inside.lanes = active_;
        const auto leaveTime = [&](const Axis& axis, std::size_t number) {
            const V low = hn::Set(d, box.low[number]), high = hn::Set(d, box.high[number]);
            V ahead, behind;
            if (areSameWay_) {
                // Mostly so; nothing needs to be chosen by lane.
                ahead = hn::Set(d, goBack_[number] ? box.low[number] : box.high[number]);
                behind = hn::Set(d, goBack_[number] ? box.high[number] : box.low[number]);
            } else {
                ahead = hn::IfThenElse(axis.isNegative, low, high);
                behind = hn::IfThenElse(axis.isNegative, high, low);
            }
            const V leave = axis.planeTime(ahead), enter = axis.planeTime(behind);
            M isIn = hn::And(hn::Le(enter, t_), hn::Lt(t_, leave));
            if (!areMoving_)
                isIn =
                    hn::Or(isIn, andNot(axis.isMoving, hn::And(hn::Ge(axis.origin, low), hn::Lt(axis.origin, high))));
            inside.lanes = hn::And(inside.lanes, isIn);
            return leave;
        };
        const V x = leaveTime(x_, 0), y = leaveTime(y_, 1), z = leaveTime(z_, 2);
        inside.exit = hn::Min(hn::Min(x, y), z);
        return inside;
    }

    // Through a box of one label.
    HWY_INLINE void crossUniform(const Inside& inside, std::int64_t scalar) {
        const DI di;
        const M lanes = change(inside.lanes, hn::Set(di, scalar), false);
        crossed_ = hn::IfThenElse(toInts(lanes), hn::Set(di, -1), crossed_);
        advance(lanes, inside.exit);
    }

    // Through a coded box, from side to side.
    HWY_INLINE void crossCoded(const Inside& inside, const volume::BrickVolume::BoxCoding& code) {
        const D d;
        Side sides[volume::BrickVolume::kMostSides];
        std::size_t count = 0;
        const auto addCut = [&](const Axis& axis, std::size_t number) {
            if (((code.cutAxes >> number) & 1u) == 0) return;
            const V place = hn::Set(d, static_cast<double>(code.cut[number]));
            Side& side = sides[count++];
            side.time = axis.planeTime(place);
            side.isBeyondAfter = hn::Not(axis.isNegative);
            // Not along this axis: on one side for good.
            if (!areMoving_)
                side.isBeyondAfter = hn::And(side.isBeyondAfter, hn::Or(axis.isMoving, hn::Lt(axis.origin, place)));
            side.plane = -1;
        };
        addCut(x_, 0);
        addCut(y_, 1);
        addCut(z_, 2);
        for (const std::uint32_t number : code.plane) {
            if (number == volume::BrickVolume::kNoPlane) continue;
            Side& side = sides[count++];
            findCrossing(scene_.volume.oblique[number], side.time, side.isBeyondAfter);
            side.plane = number;
        }
        const volume::Scalar* scalars = scene_.volume.palettes.data() + code.cells;
        switch (count) {
            case 1: return crossSides<1>(inside, sides, scalars);
            case 2: return crossSides<2>(inside, sides, scalars);
            case 3: return crossSides<3>(inside, sides, scalars);
            case 4: return crossSides<4>(inside, sides, scalars);
            case 5: return crossSides<5>(inside, sides, scalars);
            default: return crossSides<6>(inside, sides, scalars);
        }
    }

    // Through a brick of voxels, from voxel to voxel.
    HWY_INLINE void crossVoxels(const Inside& inside, const Bounds& box,
                                const volume::BrickVolume::PaletteBrick& brick) {
        const D d;
        const DI di;
        const V one = hn::Set(d, 1.0);
        const std::uint64_t* words = scene_.volume.words.data() + brick.planes;
        const volume::Scalar* scalars = scene_.volume.palettes.data() + brick.palette;
        M lanes = inside.lanes;
        const V3 cell = cells();
        const auto local = [&](V at, int axis) {
            return hn::IfThenElseZero(lanes, hn::Sub(at, hn::Set(d, box.low[axis])));
        };
        // Which bit of which word.
        VI bit = toInt(hn::Add(local(cell.x, 0), hn::Mul(local(cell.y, 1), hn::Set(d, 8.0))));
        VI word = toInt(local(cell.z, 2));
        // Faces of the voxel before the rays; they move by a voxel.
        const auto sign = [&](const Axis& axis) { return hn::IfThenElse(axis.isNegative, hn::Neg(one), one); };
        const V3 step{sign(x_), sign(y_), sign(z_)};
        const auto faceAhead = [&](const Axis& axis, V at) {
            return hn::IfThenElse(axis.isNegative, at, hn::Add(at, one));
        };
        V3 far{faceAhead(x_, cell.x), faceAhead(y_, cell.y), faceAhead(z_, cell.z)};
        const VI stepX = toInt(step.x), stepY = hn::ShiftLeft<3>(toInt(step.y)), stepZ = toInt(step.z);
        crossed_ = hn::IfThenElse(toInts(lanes), hn::Set(di, -1), crossed_);
        while (true) {
            VI index = hn::Zero(di);
            for (std::uint32_t plane = 0; plane < brick.planeCount; ++plane) {
                const VI bits = shiftRightBy(lookUp(words + std::size_t{8} * plane, word), bit);
                index = hn::Or(index, hn::IfThenElseZero(isSet(bits, 1), hn::Set(di, std::int64_t{1} << plane)));
            }
            const VI scalar = lookUp(scalars, brick.paletteSize, index);
            if (any(hn::And(lanes, toDoubles(hn::Ne(scalar, runScalar_))))) {
                lanes = change(lanes, scalar, true);
                crossed_ = hn::IfThenElse(toInts(lanes), hn::Set(di, -1), crossed_);
            }
            const V3 leave{x_.planeTime(far.x), y_.planeTime(far.y), z_.planeTime(far.z)};
            const V next = hn::Min(hn::Min(leave.x, leave.y), leave.z);
            lanes = hn::And(advance(lanes, next), hn::Lt(next, inside.exit));
            if (!any(lanes)) return;
            const auto move = [&](V time, V by, VI bits, V& face, VI& place) {
                const M crosses = hn::And(lanes, hn::Eq(time, next));
                face = hn::IfThenElse(crosses, hn::Add(face, by), face);
                place = hn::IfThenElse(toInts(crosses), hn::Add(place, bits), place);
            };
            move(leave.x, step.x, stepX, far.x, bit);
            move(leave.y, step.y, stepY, far.y, bit);
            move(leave.z, step.z, stepZ, far.z, word);
        }
    }

    HWY_INLINE void finish() {
        if (any(isOpaque_)) addOpaque();
        if (kWithFragments && hasFragments_) addFragments(started_, end_);
        const M leaving = hn::And(andNot(isDone_, started_), isRunTranslucent_);
        if (any(leaving)) leave(leaving, end_);
        const DI di;
        store(color_.x, samples_.color[0], first_);
        store(color_.y, samples_.color[1], first_);
        store(color_.z, samples_.color[2], first_);
        store(transmittance_, samples_.transmittance, first_);
        hn::Store(hn::IfThenElseZero(toInts(isDone_), hn::Set(di, -1)), di, samples_.isDone.data() + first_);
    }

private:
    // When the rays change sides of a cut or plane; whether they are beyond from then on, or until then.
    struct Side {
        V time;
        M isBeyondAfter;
        std::int64_t plane;  // its number, or -1
    };

    // From side to side, which stand in the order of the bits of a cell's number.
    template <std::size_t kCount>
    HWY_INLINE void crossSides(const Inside& inside, const Side* sides, const volume::Scalar* scalars) {
        const DI di;
        M lanes = inside.lanes;
        while (true) {
            VI cell = hn::Zero(di), nextPlane = hn::Set(di, -1);
            V next = inside.exit;
            for (std::size_t s = 0; s < kCount; ++s) {
                const M isAfter = hn::Ge(t_, sides[s].time);
                const M isNotBeyond = hn::Xor(isAfter, sides[s].isBeyondAfter);
                cell = hn::Or(cell, hn::IfThenZeroElse(toInts(isNotBeyond), hn::Set(di, std::int64_t{1} << s)));
                const M isNext = andNot(isAfter, hn::Lt(sides[s].time, next));
                next = hn::IfThenElse(isNext, sides[s].time, next);
                nextPlane = hn::IfThenElse(toInts(isNext), hn::Set(di, sides[s].plane), nextPlane);
            }
            lanes = change(lanes, lookUp(scalars, std::size_t{1} << kCount, cell), false);
            crossed_ = hn::IfThenElse(toInts(lanes), nextPlane, crossed_);
            lanes = hn::And(advance(lanes, next), hn::Lt(next, inside.exit));
            if (!any(lanes)) return;
        }
    }

    HWY_INLINE Axis axisOf(std::size_t a) const {
        const D d;
        Axis axis;
        axis.origin = hn::Load(d, rays_.origin[a].data() + first_);
        axis.direction = hn::Load(d, rays_.direction[a].data() + first_);
        axis.inverse = hn::Load(d, rays_.inverse[a].data() + first_);
        axis.planeOrigin = hn::Load(d, rays_.planeOrigin[a].data() + first_);
        axis.count = hn::Set(d, scene_.count[a]);
        axis.isNegative = hn::Lt(axis.direction, hn::Zero(d));
        axis.isMoving = hn::Ne(axis.direction, hn::Zero(d));
        return axis;
    }

    // ------------------------------------------------------------------------------------------------ where

    // The plane between voxels that a ray is nearest to at t, and when it crosses it.
    struct NearPlane {
        V position, plane, time;
    };
    HWY_INLINE NearPlane nearPlane(const Axis& axis) const {
        const V position = axis.at(t_), plane = hn::Round(position);
        return {position, plane, axis.planeTime(plane)};
    }
    // The voxels that the rays are in, see IndexRay::cellAt(). Any for those that have ended.
    HWY_INLINE V3 cells() const {
        const auto cellOf = [&](const Axis& axis) {
            const D d;
            const V one = hn::Set(d, 1.0);
            const NearPlane near = nearPlane(axis);
            // Beside a plane rounding must not decide.
            const M isBeside = hn::And(axis.isMoving, hn::Le(hn::Abs(hn::Sub(near.position, near.plane)), slack_));
            const M isBelow = hn::Not(hn::Xor(hn::Le(near.time, t_), axis.isNegative));
            const V decided = hn::IfThenElse(isBelow, hn::Sub(near.plane, one), near.plane);
            const V cell = hn::IfThenElse(isBeside, decided, hn::Floor(near.position));
            return hn::Min(hn::Max(cell, hn::Zero(d)), hn::Sub(axis.count, one));
        };
        return {cellOf(x_), cellOf(y_), cellOf(z_)};
    }

    // PlaneCrossing of the plain caster.
    HWY_INLINE void findCrossing(const volume::BrickPlane& plane, V& time, M& isRising) const {
        const D d;
        const V zero = hn::Zero(d);
        const V3 normal = broadcast(plane.normal);
        const V height = hn::Add(dot(normal, {x_.origin, y_.origin, z_.origin}), hn::Set(d, plane.offset));
        const V rise = dot(normal, {x_.direction, y_.direction, z_.direction});
        const M crosses = hn::Ne(rise, zero);
        time = hn::IfThenElse(crosses, hn::Div(hn::Neg(height), rise), hn::Set(d, kInfinity));
        isRising = hn::Or(hn::Gt(rise, zero), hn::Not(hn::Or(crosses, hn::Gt(height, zero))));
    }

    // Lanes go on to `t`; returns those that have not ended.
    HWY_INLINE M advance(M lanes, V t) {
        const D d;
        const M goesOn = hn::And(lanes, hn::Lt(t, end_));
        t_ = hn::IfThenElse(lanes, hn::IfThenElse(goesOn, t, hn::Set(d, kInfinity)), t_);
        active_ = andNot(andNot(goesOn, lanes), active_);
        return goesOn;
    }
    // ------------------------------------------------------------------------------------------------ what

    static HWY_INLINE M isBelow(VI entry, std::size_t end) {
        return toDoubles(hn::Lt(entry, hn::Set(DI(), static_cast<std::int64_t>(end))));
    }
    HWY_INLINE VI entryAt(const V3& brick, M lanes) const {
        const D d;
        const V place = hn::Add(brick.x, hn::Mul(hn::Set(d, scene_.bricksX),
                                                 hn::Add(brick.y, hn::Mul(hn::Set(d, scene_.bricksY), brick.z))));
        const VI brick64 = toInt(hn::IfThenElseZero(lanes, place));
        if (scene_.volume.narrow.empty())
            return lowHalf(gatherBytes(scene_.volume.wide.data(), hn::ShiftLeft<2>(brick64)));
        return bitsOf<0, 16>(gatherBytes(scene_.volume.narrow.data(), hn::ShiftLeft<1>(brick64)));
    }

    // The lanes are in `scalar` from t on; returns those that do not end there.
    HWY_INLINE M change(M lanes, VI scalar, bool isVoxel) {
        const M changed = hn::And(lanes, toDoubles(hn::Ne(scalar, runScalar_)));
        if (!any(changed)) return lanes;
        changeTo(changed, scalar, isVoxel);
        return andNot(isDone_, lanes);
    }
    HWY_NOINLINE void changeTo(M changed, VI scalar, bool isVoxel) {
        if (kWithFragments && hasFragments_) addFragments(changed, t_);
        const M leaving = hn::And(kWithFragments ? andNot(isDone_, changed) : changed, isRunTranslucent_);
        if (any(leaving)) leave(leaving, t_);
        const M entering = andNot(isDone_, changed);
        if (any(entering)) enter(entering, scalar, isVoxel);
        active_ = andNot(isDone_, active_);
        t_ = hn::IfThenElse(isDone_, hn::Set(D(), kInfinity), t_);
    }

    // ------------------------------------------------------------------------------------------------ how it looks

    HWY_INLINE Looks looksOf(VI scalar, M lanes) const {
        const DI di;
        std::int64_t first = 0;
        if (isSame(scalar, lanes, first)) return {scene_.styles + std::min(first, scene_.styleCount), hn::Zero(di)};
        const VI known = hn::Min(scalar, hn::Set(di, scene_.styleCount));
        return {nullptr, hn::ShiftLeft<6>(hn::IfThenElseZero(toInts(lanes), known))};
    }
    template <std::size_t kMember>
    HWY_INLINE V number(const Looks& looks) const {
        if (looks.same != nullptr) {
            double value;
            std::memcpy(&value, reinterpret_cast<const std::byte*>(looks.same) + kMember, sizeof value);
            return hn::Set(D(), value);
        }
        return hn::BitCast(D(), gatherBytes(reinterpret_cast<const std::byte*>(scene_.styles) + kMember, looks.offset));
    }
    template <std::size_t kMember>
    HWY_INLINE VI integer(const Looks& looks) const {
        return hn::BitCast(DI(), number<kMember>(looks));
    }

    // RunShader::add(); `share` of the light is stopped.
    HWY_INLINE void add(M lanes, V share, V from, const Looks& looks) {
        const D d;
        const V one = hn::Set(d, 1.0);
        const V surface = number<offsetof(PacketStyle, surface)>(looks);
        const V light = hn::Add(one, hn::Mul(hn::Sub(light_, one), surface));
        V weight = hn::Mul(share, light);
        if constexpr (kWithFragments) weight = hn::Mul(weight, lines_);
        constexpr std::size_t kRed = offsetof(PacketStyle, color), kNext = sizeof(double);
        const auto addColor = [&](V color, V ofLabel) {
            return hn::IfThenElse(lanes, hn::Add(color, hn::Mul(ofLabel, weight)), color);
        };
        color_ = {addColor(color_.x, number<kRed>(looks)), addColor(color_.y, number<kRed + kNext>(looks)),
                  addColor(color_.z, number<kRed + 2 * kNext>(looks))};
        transmittance_ = hn::IfThenElse(lanes, hn::Sub(transmittance_, share), transmittance_);
        const V opacity = hn::Sub(one, transmittance_);
        const V depth = hn::Load(d, samples_.depth.data() + first_);
        const M isHit =
            hn::And(hn::And(lanes, hn::Eq(depth, hn::Set(d, kInfinity))), hn::Gt(opacity, hn::Set(d, scene_.labelAt)));
        if (any(isHit)) {
            const auto keep = [&](V value, Lanes<double>& lanesOf) {
                store(hn::IfThenElse(isHit, value, hn::Load(d, lanesOf.data() + first_)), lanesOf, first_);
            };
            keep(from, samples_.depth);
            keep(normal_.x, samples_.normal[0]);
            keep(normal_.y, samples_.normal[1]);
            keep(normal_.z, samples_.normal[2]);
            const auto keepInt = [&](VI value, Lanes<std::int64_t>& lanesOf) {
                const DI di;
                hn::Store(hn::IfThenElse(toInts(isHit), value, hn::Load(di, lanesOf.data() + first_)), di,
                          lanesOf.data() + first_);
            };
            keepInt(integer<offsetof(PacketStyle, label)>(looks), samples_.label);
            keepInt(integer<offsetof(PacketStyle, object)>(looks), samples_.object);
            keepInt(hn::IfThenElseZero(toInts(isOnCap_), hn::Set(DI(), 1)), samples_.isCap);
        }
    }

    HWY_INLINE void markDone(M lanes) { isDone_ = hn::Or(isDone_, lanes); }

    // RunShader::leave() of translucent runs.
    HWY_INLINE void leave(M lanes, V to) {
        const D d;
        const V one = hn::Set(d, 1.0);
        const Looks looks = looksOf(runScalar_, lanes);
        const V density = number<offsetof(PacketStyle, density)>(looks);
        const V stopped = hn::Sub(one, expOfMinus(hn::Mul(hn::Mul(density, hn::Sub(to, runStart_)), metresPerT_)));
        add(lanes, hn::Mul(transmittance_, stopped), kWithFragments ? labelStart_ : runStart_, looks);
        if (scene_.withColor) {
            markDone(hn::And(lanes, hn::Ge(hn::Sub(one, transmittance_), hn::Set(d, scene_.opaqueAt))));
        } else {
            const V depth = hn::Load(d, samples_.depth.data() + first_);
            markDone(hn::And(lanes, hn::Lt(depth, hn::Set(d, kInfinity))));
        }
    }

    // Fragments that the rays meet up to `t`. A run is left where there is one and goes on behind it.
    HWY_NOINLINE void addFragments(M lanes, V t) {
        const D d;
        const DI di;
        alignas(64) std::int64_t wanted[hn::MaxLanes(D())];
        while (true) {
            const V next = hn::Load(d, samples_.nextFragment.data() + first_);
            const M due =
                hn::And(andNot(isDone_, lanes), hn::And(hn::Le(next, t), hn::Lt(next, hn::Set(d, kInfinity))));
            if (!any(due)) return;
            const M inRun = hn::And(due, isRunTranslucent_);
            if (any(inRun)) leave(inRun, next);
            runStart_ = hn::IfThenElse(inRun, next, runStart_);
            const M open = andNot(isDone_, due);
            store(color_.x, samples_.color[0], first_);
            store(color_.y, samples_.color[1], first_);
            store(color_.z, samples_.color[2], first_);
            store(transmittance_, samples_.transmittance, first_);
            store(lines_, samples_.lines, first_);
            hn::Store(hn::IfThenElseZero(toInts(open), hn::Set(di, 1)), di, wanted);
            for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
                if (wanted[lane] != 0) scene_.fragment(context_, first_ + lane);
            color_ = loadV3(samples_.color, first_);
            transmittance_ = hn::Load(d, samples_.transmittance.data() + first_);
            lines_ = hn::Load(d, samples_.lines.data() + first_);
            markDone(toDoubles(hn::Ne(hn::Load(di, samples_.isDone.data() + first_), hn::Zero(di))));
        }
    }

    // RunShader::enter().
    HWY_INLINE void enter(M lanes, VI scalar, bool isVoxel) {
        const DI di;
        const Looks looks = looksOf(scalar, lanes);
        runScalar_ = hn::IfThenElse(toInts(lanes), scalar, runScalar_);
        runStart_ = hn::IfThenElse(lanes, t_, runStart_);
        if constexpr (kWithFragments) labelStart_ = hn::IfThenElse(lanes, t_, labelStart_);
        const VI kind = integer<offsetof(PacketStyle, kind)>(looks);
        const VI object = integer<offsetof(PacketStyle, object)>(looks);
        const M visible = hn::And(lanes, toDoubles(isSet(kind, PacketKind::kVisible)));
        const M isNew = hn::And(visible, toDoubles(hn::Ne(object, object_)));
        object_ = hn::IfThenElse(toInts(lanes), hn::IfThenElse(toInts(visible), object, hn::Set(di, -1)), object_);
        const M opaque = hn::And(visible, toDoubles(isSet(kind, PacketKind::kOpaque)));
        if (scene_.withColor && any(isNew))
            findSurfaces(isNew, opaque, toDoubles(isSet(kind, PacketKind::kBody)), scalar, isVoxel);
        isRunTranslucent_ = hn::Or(andNot(lanes, isRunTranslucent_), andNot(opaque, visible));
        isOpaque_ = hn::Or(isOpaque_, opaque);
        markDone(opaque);
    }

    // Opaque runs end their rays; they are lit all at once.
    HWY_NOINLINE void addOpaque() {
        const M unlit = hn::And(isOpaque_, isUnlit_);
        if (any(unlit)) light_ = hn::IfThenElse(unlit, lightOn(openness()), light_);
        add(isOpaque_, transmittance_, runStart_, looksOf(runScalar_, isOpaque_));
    }

    // SurfaceLight::openness().
    HWY_INLINE V openness() const {
        const D d;
        const V one = hn::Set(d, 1.0), zero = hn::Zero(d);
        if (scene_.ambientOcclusion == 0) return one;
        const V3 point{hn::Add(x_.origin, hn::Mul(x_.direction, runStart_)),
                       hn::Add(y_.origin, hn::Mul(y_.direction, runStart_)),
                       hn::Add(z_.origin, hn::Mul(z_.direction, runStart_))};
        V occlusion = zero;
        for (const PacketOcclusion& level : scene_.occlusion)
            occlusion = hn::Add(
                occlusion,
                hn::Mul(hn::Set(d, level.weight), hn::Min(one, hn::Mul(sample(level, point), hn::Set(d, level.gain)))));
        occlusion = hn::Min(one, hn::Add(occlusion, hn::Mul(hn::Set(d, 0.35), crease_)));
        const V open = hn::Sub(one, hn::Mul(hn::Set(d, scene_.ambientOcclusion), occlusion));
        return hn::IfThenElse(isAroundEye_, one, open);
    }

    // OcclusionField::Level::sample(), a cell's size away from `point`.
    HWY_INLINE V sample(const PacketOcclusion& level, const V3& point) const {
        const D d;
        const V zero = hn::Zero(d), one = hn::Set(d, 1.0), size = hn::Set(d, level.cellSize);
        M inside = isOpaque_;
        const auto place = [&](V from, V away, double count, V& low) {
            const V p =
                hn::Add(hn::Mul(hn::Add(from, hn::Mul(away, size)), hn::Set(d, level.perVoxel)), hn::Set(d, 0.5));
            inside = hn::And(inside, hn::And(hn::Gt(p, zero), hn::Lt(p, hn::Set(d, count + 1))));
            low = hn::Floor(p);
            return hn::Sub(p, low);
        };
        V3 low;
        const V fx = place(point.x, away_.x, level.count[0], low.x);
        const V fy = place(point.y, away_.y, level.count[1], low.y);
        const V fz = place(point.z, away_.z, level.count[2], low.z);
        if (!any(inside)) return zero;
        const double nextY = level.count[0] + 2, nextZ = nextY * (level.count[1] + 2);
        const V first = hn::Add(hn::Add(low.x, hn::Mul(low.y, hn::Set(d, nextY))), hn::Mul(low.z, hn::Set(d, nextZ)));
        const VI corner = hn::ShiftLeft<2>(toInt(hn::IfThenElse(inside, first, zero)));
        const auto along = [](V a, V b, V s) { return hn::Add(a, hn::Mul(hn::Sub(b, a), s)); };
        const auto row = [&](double offset) {
            const VI pair = gatherBytes(level.voxels + static_cast<std::size_t>(offset), corner);
            return along(toDouble(lowHalf(pair)), toDouble(shiftRight<32>(pair)), fx);
        };
        const V value = along(along(row(0), row(nextY), fy), along(row(nextZ), row(nextZ + nextY), fy), fz);
        return hn::IfThenElse(inside, value, hn::Mul(zero, one));
    }

    // SurfaceLight::lightOn().
    HWY_INLINE V lightOn(V open) const {
        const D d;
        const V zero = hn::Zero(d);
        const V3 view = loadV3(rays_.view, first_);
        const V key = hn::Max(zero, dot(normal_, broadcast(scene_.towardsLight)));
        const V facing = hn::Max(zero, dot(normal_, view));
        const V sky = hn::Add(hn::Set(d, 0.80), hn::Mul(hn::Set(d, 0.20), normal_.z));
        const V ambient = hn::Mul(hn::Mul(hn::Set(d, scene_.ambient), open),
                                  hn::Add(hn::Mul(hn::Set(d, 0.82), sky), hn::Mul(hn::Set(d, 0.18), facing)));
        return hn::Add(ambient, hn::Mul(hn::Mul(hn::Set(d, scene_.key), key),
                                        hn::Add(hn::Set(d, 0.45), hn::Mul(hn::Set(d, 0.55), open))));
    }

    // SurfaceLight::facing(), and the light on what is not opaque.
    HWY_INLINE void findSurfaces(M lanes, M opaque, M isBody, VI scalar, bool isVoxel) {
        const D d;
        const DI di;
        const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
        const M isCap = hn::And(isCapped_, hn::Eq(t_, from_));
        M isOblique = toDoubles(hn::Gt(crossed_, hn::Set(di, -1)));
        M isNowhere = hn::Not(isOblique);
        V faceAxis = hn::Set(d, -1.0), faceAt = zero;
        V3 normal{zero, zero, zero}, away = normal;
        // The first axis whose plane the ray crosses at t.
        const auto face = [&](const Axis& axis, std::size_t number) {
            const NearPlane near = nearPlane(axis);
            const M isHere = hn::And(hn::And(isNowhere, axis.isMoving), hn::Eq(near.time, t_));
            isNowhere = andNot(isHere, isNowhere);
            faceAxis = hn::IfThenElse(isHere, hn::Set(d, static_cast<double>(number)), faceAxis);
            faceAt = hn::IfThenElse(isHere, near.plane, faceAt);
            const auto part = [&](V known, double value) {
                const V up = hn::Set(d, value);
                return hn::IfThenElse(isHere, hn::IfThenElse(axis.isNegative, up, hn::Neg(up)), known);
            };
            const Vec3d n = scene_.axisNormals[number], a = scene_.axisAways[number];
            normal = {part(normal.x, n.x), part(normal.y, n.y), part(normal.z, n.z)};
            away = {part(away.x, a.x), part(away.y, a.y), part(away.z, a.z)};
        };
        if (any(hn::And(lanes, isNowhere))) {
            face(x_, 0);
            face(y_, 1);
            face(z_, 2);
            // On the side of a brick?
            const V fraction = hn::Mul(faceAt, hn::Set(d, 0.125));
            const M atSide = hn::And(lanes, hn::Eq(hn::Floor(fraction), fraction));
            const M atSeam = hn::And(andNot(hn::Or(isNowhere, isOblique), atSide), hn::Gt(t_, from_));
            if (any(atSeam)) {
                crossed_ = seamPlanes(atSeam, faceAxis);
                isOblique = toDoubles(hn::Gt(crossed_, hn::Set(di, -1)));
            }
        }
        const M onPlane = hn::And(lanes, andNot(isCap, isOblique));
        if (any(onPlane)) {
            const auto& oblique = scene_.volume.oblique;
            // Of planes: normals in voxel space, and Surface::normal and Surface::away.
            V3 index, ofNormal, ofAway;
            std::int64_t first = 0;
            if (isSame(crossed_, onPlane, first)) {
                const double* directions = scene_.planeDirections + 8 * first;
                index = broadcast(oblique[static_cast<std::size_t>(first)].normal);
                ofNormal = broadcast({directions[0], directions[1], directions[2]});
                ofAway = broadcast({directions[3], directions[4], directions[5]});
            } else {
                const VI number = hn::IfThenElseZero(toInts(onPlane), crossed_);
                const VI plane = hn::ShiftLeft<5>(number), direction = hn::ShiftLeft<6>(number);
                const auto indexPart = [&](int n) {
                    return hn::BitCast(d, gatherBytes(reinterpret_cast<const double*>(oblique.data()) + n, plane));
                };
                const auto part = [&](int n) {
                    return hn::BitCast(d, gatherBytes(scene_.planeDirections + n, direction));
                };
                index = {indexPart(0), indexPart(1), indexPart(2)};
                ofNormal = {part(0), part(1), part(2)};
                ofAway = {part(3), part(4), part(5)};
            }
            const M isAway = hn::Gt(dot(index, {x_.direction, y_.direction, z_.direction}), zero);
            const auto turned = [&](V value, V known) {
                return hn::IfThenElse(onPlane, hn::IfThenElse(isAway, hn::Neg(value), value), known);
            };
            normal = {turned(ofNormal.x, normal.x), turned(ofNormal.y, normal.y), turned(ofNormal.z, normal.z)};
            away = {turned(ofAway.x, away.x), turned(ofAway.y, away.y), turned(ofAway.z, away.z)};
        }
        const auto keep = [&](V value, V known) { return hn::IfThenElse(lanes, value, known); };
        normal_ = {keep(normal.x, normal_.x), keep(normal.y, normal_.y), keep(normal.z, normal_.z)};
        away_ = {keep(away.x, away_.x), keep(away.y, away_.y), keep(away.z, away_.z)};
        crease_ = keep(zero, crease_);
        isOnCap_ = andNot(lanes, isOnCap_);
        isAroundEye_ = andNot(lanes, isAroundEye_);
        isUnlit_ = hn::Or(isUnlit_, hn::And(lanes, opaque));
        M needsNormal = andNot(opaque, lanes);
        if (isVoxel) needsNormal = hn::Or(needsNormal, andNot(isOblique, lanes));
        const M special = hn::And(lanes, hn::Or(hn::Or(isCap, isNowhere), hn::And(isBody, needsNormal)));
        const M glass = andNot(opaque, lanes);
        if (any(glass)) light_ = hn::IfThenElse(glass, lightOn(one), light_);
        if (any(special)) askForSurfaces(special, scalar, isVoxel, faceAxis);
    }

    // The numbers of the planes of each lane's brick; kNoPlane where there is none.
    struct Planes {
        VI first, second, third;
    };
    HWY_INLINE Planes planesOf(M lanes, const V3& brick) const {
        const DI di;
        const VI none = hn::Set(di, std::int64_t{volume::BrickVolume::kNoPlane});
        const VI entry = entryAt(brick, lanes);
        const M isBox = hn::And(lanes, isBelow(entry, scene_.volume.boxes.size()));
        const M coded = andNot(isBelow(entry, scene_.volume.uniformBoxes), isBox);
        if (!any(coded)) return {none, none, none};
        const VI box = hn::IfThenElseZero(toInts(coded), hn::ShiftLeft<4>(entry));
        const VI code = hn::IfThenElseZero(
            toInts(coded),
            shiftRight<32>(gatherBytes(reinterpret_cast<const std::byte*>(scene_.volume.boxes.data()) + 8, box)));
        const VI place = hn::Add(hn::ShiftLeft<4>(code), hn::ShiftLeft<3>(code));
        static_assert(sizeof(volume::BrickVolume::BoxCoding) == 24 && volume::BrickVolume::kMostPlanes == 3);
        const auto* codes = reinterpret_cast<const std::byte*>(scene_.volume.codes.data());
        const VI both = gatherBytes(codes + 8, place), rest = gatherBytes(codes + 16, place);
        const auto known = [&](VI planes) { return hn::IfThenElse(toInts(coded), planes, none); };
        return {known(lowHalf(both)), known(shiftRight<32>(both)), known(lowHalf(rest))};
    }

    // seamPlane(): the plane for each of the lanes, crossed_ for the others.
    HWY_NOINLINE VI seamPlanes(M lanes, V faceAxis) const {
        const D d;
        const DI di;
        const V3 point{hn::Add(x_.origin, hn::Mul(x_.direction, t_)), hn::Add(y_.origin, hn::Mul(y_.direction, t_)),
                       hn::Add(z_.origin, hn::Mul(z_.direction, t_))};
        VI found = crossed_;
        const auto look = [&](VI plane) {
            const VI none = hn::Set(di, std::int64_t{volume::BrickVolume::kNoPlane});
            const M isThere = hn::And(lanes, toDoubles(hn::Ne(plane, none)));
            if (!any(isThere)) return;
            const VI offset = hn::IfThenElseZero(toInts(isThere), hn::ShiftLeft<5>(plane));
            const auto number = [&](int n) {
                return hn::BitCast(
                    d, gatherBytes(reinterpret_cast<const double*>(scene_.volume.oblique.data()) + n, offset));
            };
            const V3 normal{number(0), number(1), number(2)};
            const V distance = hn::Add(dot(normal, point), number(3));
            const V along = hn::IfThenElse(hn::Eq(faceAxis, hn::Zero(d)), normal.x,
                                           hn::IfThenElse(hn::Eq(faceAxis, hn::Set(d, 1.0)), normal.y, normal.z));
            const M isNear = hn::And(
                isThere, hn::And(hn::Lt(hn::Abs(distance), hn::Set(d, 0.75)), hn::Gt(hn::Abs(along), hn::Set(d, 0.2))));
            found = hn::IfThenElse(toInts(isNear), plane, found);
            lanes = andNot(isNear, lanes);
        };
        const V eighth = hn::Set(d, 0.125), one = hn::Set(d, 1.0);
        const auto brickOf = [&](V voxel) { return hn::Floor(hn::Mul(voxel, eighth)); };
        const V3 cell = cells();
        const auto lookAll = [&](const Planes& planes) {
            look(planes.first);
            look(planes.second);
            look(planes.third);
        };
        lookAll(planesOf(lanes, {brickOf(cell.x), brickOf(cell.y), brickOf(cell.z)}));
        if (!any(lanes)) return found;
        const auto brickBefore = [&](const Axis& axis, V voxel, double number) {
            const V before = hn::IfThenElse(axis.isNegative, hn::Add(voxel, one), hn::Sub(voxel, one));
            return brickOf(hn::IfThenElse(hn::Eq(faceAxis, hn::Set(d, number)), before, voxel));
        };
        lookAll(planesOf(lanes, {brickBefore(x_, cell.x, 0), brickBefore(y_, cell.y, 1), brickBefore(z_, cell.z, 2)}));
        return found;
    }

    HWY_NOINLINE void askForSurfaces(M lanes, VI scalars, bool isVoxel, V faceAxis) {
        const D d;
        const DI di;
        constexpr std::size_t kMost = hn::MaxLanes(D());
        alignas(64) double t[kMost], axis[kMost], cell[3][kMost], light[kMost], crease[kMost], normal[3][kMost],
            away[3][kMost];
        alignas(64) std::int64_t scalar[kMost], plane[kMost], wanted[kMost], cap[kMost] = {}, eye[kMost] = {};
        hn::Store(t_, d, t);
        hn::Store(faceAxis, d, axis);
        hn::Store(light_, d, light);
        hn::Store(crease_, d, crease);
        const auto storeV3 = [&](const V3& v, double(&to)[3][kMost]) {
            hn::Store(v.x, d, to[0]);
            hn::Store(v.y, d, to[1]);
            hn::Store(v.z, d, to[2]);
        };
        storeV3(cells(), cell);
        storeV3(normal_, normal);
        storeV3(away_, away);
        hn::Store(scalars, di, scalar);
        hn::Store(crossed_, di, plane);
        hn::Store(hn::IfThenElseZero(toInts(lanes), hn::Set(di, 1)), di, wanted);
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
            if (wanted[lane] == 0) continue;
            const Vec3i at{static_cast<std::int32_t>(cell[0][lane]), static_cast<std::int32_t>(cell[1][lane]),
                           static_cast<std::int32_t>(cell[2][lane])};
            const Surface found = scene_.surface(context_, {first_ + lane, scalar[lane], plane[lane], t[lane], at,
                                                            static_cast<int>(axis[lane]), isVoxel});
            light[lane] = found.light;
            crease[lane] = found.crease;
            for (int a = 0; a < 3; ++a) {
                normal[a][lane] = found.normal[a];
                away[a][lane] = found.away[a];
            }
            cap[lane] = found.isCap ? 1 : 0;
            eye[lane] = found.isAroundEye ? 1 : 0;
        }
        const auto loadBack = [&](const double(&from)[3][kMost]) {
            return V3{hn::Load(d, from[0]), hn::Load(d, from[1]), hn::Load(d, from[2])};
        };
        light_ = hn::Load(d, light);
        crease_ = hn::Load(d, crease);
        normal_ = loadBack(normal);
        away_ = loadBack(away);
        isOnCap_ = hn::Or(isOnCap_, toDoubles(hn::Ne(hn::Load(di, cap), hn::Zero(di))));
        isAroundEye_ = hn::Or(isAroundEye_, toDoubles(hn::Ne(hn::Load(di, eye), hn::Zero(di))));
    }

    const PacketScene& scene_;
    const PacketRays& rays_;
    std::size_t first_;
    void* context_;
    PacketSamples& samples_;
    Axis x_, y_, z_;
    V metresPerT_, slack_;
    V t_, from_, end_, runStart_, labelStart_;
    VI runScalar_, object_, crossed_;  // crossed: the oblique plane that the ray crosses at t, or -1
    V light_, crease_ = hn::Zero(D());
    V3 normal_, away_;
    V3 color_;
    V transmittance_, lines_;
    bool areMoving_;               // all rays along all axes
    bool areSameWay_, goBack_[3];  // all rays to the same side along each axis; which one
    bool hasFragments_ = false;
    M active_, started_, isDone_, isCapped_, isRunTranslucent_;
    M isOpaque_, isUnlit_, isOnCap_, isAroundEye_;
};

// The rays of a packet, together. Neighbors mostly cross the same boxes, so boxes are taken one at a time: that of the
// ray that is furthest behind, by all rays that are in it.
template <bool kWithFragments>
class Packet {
    using Walk = HWY_NAMESPACE::Walk<kWithFragments>;

public:
    HWY_INLINE Packet(const PacketScene& scene, const PacketRays& rays, void* context, PacketSamples& samples)
        : Packet(scene, rays, context, samples, std::make_index_sequence<kWalks>()) {}

    HWY_INLINE void walk(const Lanes<double>& from, const Lanes<double>& to, const Lanes<std::int64_t>& capped) {
        for (Walk& walk : walks_) walk.begin(from, to, capped);
        Vec3i cell;
        while (findLast(cell)) crossAt(cell);
        for (Walk& walk : walks_) walk.finish();
    }

private:
    static constexpr std::size_t kWalks = kPacketRays / hn::MaxLanes(D());

    template <std::size_t... kNumbers>
    HWY_INLINE Packet(const PacketScene& scene, const PacketRays& rays, void* context, PacketSamples& samples,
                      std::index_sequence<kNumbers...>)
        : scene_(scene), walks_{Walk(scene, rays, kNumbers * hn::MaxLanes(D()), context, samples)...} {}

    // The cell of the ray that is furthest behind; false if all have ended.
    HWY_INLINE bool findLast(Vec3i& cell) const {
        const D d;
        V least = walks_[0].times();
        for (std::size_t n = 1; n < kWalks; ++n) least = hn::Min(least, walks_[n].times());
        least = hn::MinOfLanes(d, least);
        const double t = hn::GetLane(least);
        // Of infinities, Highway's portable vectors give the largest finite number as the least.
        if (!(t < std::numeric_limits<double>::max())) return false;
        for (const Walk& walk : walks_) {
            const M isLast = hn::Eq(walk.times(), least);
            if (!any(isLast)) continue;
            cell = walk.cell(hn::FindKnownFirstTrue(d, isLast), t);
            break;
        }
        return true;
    }

    HWY_INLINE void crossAt(Vec3i cell) {
        const volume::BrickVolume::Arrays& volume = scene_.volume;
        const auto bricksX = static_cast<std::size_t>(scene_.bricksX),
                   bricksY = static_cast<std::size_t>(scene_.bricksY);
        const std::size_t place =
            static_cast<std::size_t>(cell.x >> 3) +
            bricksX * (static_cast<std::size_t>(cell.y >> 3) + bricksY * static_cast<std::size_t>(cell.z >> 3));
        const std::size_t entry = volume.narrow.empty() ? volume.wide[place] : volume.narrow[place];
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
            bounds.low[axis] = cell[axis] & ~7;
            bounds.high[axis] = bounds.low[axis] + 8;
        }
        crossVoxels(bounds, volume.bricks[entry - volume.boxes.size()]);
    }
    // All rays that are in a box cross it.
    HWY_INLINE void crossUniform(const Bounds& bounds, std::int64_t scalar) {
        for (Walk& walk : walks_) {
            const auto inside = walk.findInside(bounds);
            if (any(inside.lanes)) walk.crossUniform(inside, scalar);
        }
    }
    HWY_INLINE void crossCoded(const Bounds& bounds, const volume::BrickVolume::BoxCoding& code) {
        for (Walk& walk : walks_) {
            const auto inside = walk.findInside(bounds);
            if (any(inside.lanes)) walk.crossCoded(inside, code);
        }
    }
    HWY_INLINE void crossVoxels(const Bounds& bounds, const volume::BrickVolume::PaletteBrick& brick) {
        for (Walk& walk : walks_) {
            const auto inside = walk.findInside(bounds);
            if (any(inside.lanes)) walk.crossVoxels(inside, bounds, brick);
        }
    }

    const PacketScene& scene_;
    std::array<Walk, kWalks> walks_;
};

void walk(const PacketScene& scene, const PacketRays& rays, const Lanes<double>& from, const Lanes<double>& to,
          const Lanes<std::int64_t>& capped, void* context, PacketSamples& samples) {
    if (scene.hasFragments)
        Packet<true>(scene, rays, context, samples).walk(from, to, capped);
    else
        Packet<false>(scene, rays, context, samples).walk(from, to, capped);
}

}  // namespace
}  // namespace svt::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::render {

HWY_EXPORT(setUp);
HWY_EXPORT(walk);

bool setUpPacket(const CameraRays& camera, Vec3i count, PacketRays& rays) {
    return HWY_DYNAMIC_DISPATCH(setUp)(camera, count, rays);
}

void walkPacket(const PacketScene& scene, const PacketRays& rays, const Lanes<double>& from, const Lanes<double>& to,
                const Lanes<std::int64_t>& capped, void* context, PacketSamples& samples) {
    HWY_DYNAMIC_DISPATCH(walk)(scene, rays, from, to, capped, context, samples);
}

}  // namespace svt::render
#endif
