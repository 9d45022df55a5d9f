#pragma once
/// \file
/// Walks the rays of a group through boxes of bricks: the vector version of walkRuns().
///
/// A box of one label is left in one step. A coded box has up to three cuts and three planes. One bit per cut or plane
/// is the side on which a ray is. The bits form a side combination, and its label comes from a table (crossSides(),
/// with no branch per side). A brick of voxels is stepped through voxel by voxel as by Amanatides and Woo (1987); the
/// voxel is stored as a bit and a word of the brick's bit planes. Each step masks off the lanes that have left the box.

#include <svt/render/packet/packet_vectors-inl.hpp>
#include <svt/render/walk/plane_crossing.hpp>

HWY_BEFORE_NAMESPACE();
namespace svt::render::HWY_NAMESPACE {
namespace {

// Voxels [low, high) of a box; the same planes sorted by the packet's direction: where its rays leave, and enter.
struct Bounds {
    double low[3], high[3];
    double ahead[3], behind[3];
};

// Walks the rays of a group, and records where their labels change.
class Walk {
public:
    HWY_INLINE Walk(const PacketPass& pass, const PacketRays& rays, const RayVectors& vectors, std::size_t first,
                    ChangeRows& changes)
        : pass_(pass), rays_(rays), vectors_(vectors), styles_(pass), first_(first), changes_(changes) {}

    // Starts the rays on [from, to), except those that have ended before.
    HWY_INLINE void begin(const Lanes<double>& from, const Lanes<double>& to, const Lanes<std::int64_t>& isDone) {
        const D d;
        t_ = hn::Load(d, from.data() + first_);
        end_ = hn::Load(d, to.data() + first_);
        const M isOver = toDoubles(hn::Ne(hn::Load(DI(), isDone.data() + first_), hn::Zero(DI())));
        t_ = hn::IfThenElse(andNot(isOver, hn::Lt(t_, end_)), t_, hn::Set(d, kInfinity));
        runScalar_ = crossedPlane_ = hn::Set(DI(), -1);
    }

    // Ends the rays of a mask.
    HWY_INLINE void end(M lanes) { t_ = hn::IfThenElse(lanes, hn::Set(D(), kInfinity), t_); }

    // Current t of the rays; infinity for those that have ended.
    HWY_INLINE V times() const { return t_; }
    // The voxel that one ray is in at t, see VoxelRay::voxelAt().
    HWY_INLINE Vec3i voxel(std::size_t lane, double t) const {
        const std::size_t ray = first_ + lane;
        Vec3i voxel;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double along = rays_.direction[axis][ray], position = rays_.origin[axis][ray] + t * along;
            const auto plane = static_cast<std::int64_t>(position + 0.5);
            const auto inner = static_cast<std::int64_t>(position);
            const double aside = position - static_cast<double>(plane);
            const double time = (static_cast<double>(plane) - rays_.planeOrigin[axis][ray]) * rays_.inverse[axis][ray];
            // Next to a plane, the crossing time decides, not the rounded position. Unpredictable, so branch-free.
            const bool isBeside = (std::abs(aside) <= rays_.slack[ray]) & (along != 0);
            const std::int64_t decided = plane - std::int64_t{(time <= t) == (along < 0)};
            const std::int64_t at = isBeside ? decided : inner;
            const auto last = static_cast<std::int64_t>(pass_.count[axis]) - 1;
            voxel[static_cast<int>(axis)] = static_cast<std::int32_t>(std::clamp<std::int64_t>(at, 0, last));
        }
        return voxel;
    }

    // The lanes that are inside a box, and the time at which they leave it.
    struct Inside {
        M lanes;
        V exit;
    };
    HWY_INLINE Inside findInside(const Bounds& box) const {
        const D d;
        if (HWY_LIKELY(vectors_.isPlain)) {
            const auto time = [&](const Axis& axis, double plane) { return axis.planeTime(hn::Set(d, plane)); };
            const V exit = hn::Min(hn::Min(time(vectors_.x, box.ahead[0]), time(vectors_.y, box.ahead[1])),
                                   time(vectors_.z, box.ahead[2]));
            const V entry = hn::Max(hn::Max(time(vectors_.x, box.behind[0]), time(vectors_.y, box.behind[1])),
                                    time(vectors_.z, box.behind[2]));
            return {hn::And(hn::Le(entry, t_), hn::Lt(t_, exit)), exit};
        }
        return findInsideByLane(box);
    }

    // Crosses a box of one label.
    HWY_INLINE void crossUniform(const Inside& inside, std::int64_t scalar) {
        const DI di;
        const M lanes = change(inside.lanes, hn::Set(di, scalar), false);
        crossedPlane_ = hn::IfThenElse(toInts(lanes), hn::Set(di, -1), crossedPlane_);
        advance(lanes, inside.exit);
    }

    // Crosses a coded box, from one cut or plane to the next.
    HWY_INLINE void crossCoded(const Inside& inside, const volume::BrickVolume::BoxCoding& code) {
        const D d;
        Side sides[volume::BrickVolume::kMaxSides];
        std::size_t count = 0;
        const auto addPlane = [&](std::uint32_t number) {
            if (number == volume::BrickVolume::kNoPlane) return;
            Side& side = sides[count++];
            findCrossing(pass_.volume.planes[number], side.time, side.isBeyondAfter);
            side.plane = number;
        };
        const auto addCut = [&](const Axis& axis, std::size_t number) {
            if (((code.cutAxes >> number) & 1u) == 0) return addPlane(code.planeInCut(static_cast<int>(number)));
            const V place = hn::Set(d, static_cast<double>(code.cut[number]));
            Side& side = sides[count++];
            side.time = axis.planeTime(place);
            side.isBeyondAfter = hn::Not(axis.isNegative);
            // Rays with a zero direction on this axis stay on one side.
            if (!vectors_.areNonZero)
                side.isBeyondAfter = hn::And(side.isBeyondAfter, hn::Or(axis.isNonZero, hn::Lt(axis.origin, place)));
            side.plane = -1;
        };
        addCut(vectors_.x, 0);
        addCut(vectors_.y, 1);
        addCut(vectors_.z, 2);
        for (const std::uint32_t number : code.plane) addPlane(number);
        const volume::Scalar* scalars = pass_.volume.palettes.data() + code.firstSideScalar;
        switch (count) {
            case 1: return crossSides<1>(inside, sides, scalars);
            case 2: return crossSides<2>(inside, sides, scalars);
            case 3: return crossSides<3>(inside, sides, scalars);
            case 4: return crossSides<4>(inside, sides, scalars);
            case 5: return crossSides<5>(inside, sides, scalars);
            default: return crossSides<6>(inside, sides, scalars);
        }
    }

    // Crosses a brick of voxels, from voxel to voxel.
    HWY_INLINE void crossVoxels(const Inside& inside, const Bounds& box,
                                const volume::BrickVolume::PaletteBrick& brick) {
        const D d;
        const DI di;
        const V one = hn::Set(d, 1.0);
        const std::uint64_t* words = pass_.volume.words.data() + brick.bitPlanes;
        const volume::Scalar* scalars = pass_.volume.palettes.data() + brick.palette;
        M lanes = inside.lanes;
        const V3 voxel = vectors_.voxels(t_);
        const auto local = [&](V at, int axis) {
            return hn::IfThenElseZero(lanes, hn::Sub(at, hn::Set(d, box.low[axis])));
        };
        // Bit and word of the voxel in each bit plane.
        VI bit = toInt(hn::Add(local(voxel.x, 0), hn::Mul(local(voxel.y, 1), hn::Set(d, 8.0))));
        VI word = toInt(local(voxel.z, 2));
        // The planes by which the rays leave the current voxel; they advance by one voxel.
        const auto sign = [&](const Axis& axis) { return hn::IfThenElse(axis.isNegative, hn::Neg(one), one); };
        const V3 step{sign(vectors_.x), sign(vectors_.y), sign(vectors_.z)};
        const auto faceAhead = [&](const Axis& axis, V at) {
            return hn::IfThenElse(axis.isNegative, at, hn::Add(at, one));
        };
        V3 far{faceAhead(vectors_.x, voxel.x), faceAhead(vectors_.y, voxel.y), faceAhead(vectors_.z, voxel.z)};
        const VI stepX = toInt(step.x), stepY = hn::ShiftLeft<3>(toInt(step.y)), stepZ = toInt(step.z);
        crossedPlane_ = hn::IfThenElse(toInts(lanes), hn::Set(di, -1), crossedPlane_);
        while (true) {
            VI index = hn::Zero(di);
            for (std::uint32_t plane = 0; plane < brick.bitPlaneCount; ++plane) {
                const VI bits = shiftRightBy(lookUp(words + std::size_t{8} * plane, word), bit);
                index = hn::Or(index, hn::IfThenElseZero(isSet(bits, 1), hn::Set(di, std::int64_t{1} << plane)));
            }
            const VI scalar = lookUp(scalars, brick.paletteSize, index);
            lanes = change(lanes, scalar, true);
            const V3 leave{vectors_.x.planeTime(far.x), vectors_.y.planeTime(far.y), vectors_.z.planeTime(far.z)};
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

private:
    HWY_NOINLINE Inside findInsideByLane(const Bounds& box) const {
        const D d;
        Inside inside;
        inside.lanes = hn::Lt(t_, end_);
        const auto leaveTime = [&](const Axis& axis, std::size_t number) {
            const V low = hn::Set(d, box.low[number]), high = hn::Set(d, box.high[number]);
            const V leave = axis.planeTime(hn::IfThenElse(axis.isNegative, low, high));
            const V enter = axis.planeTime(hn::IfThenElse(axis.isNegative, high, low));
            const M isIn = hn::And(hn::Le(enter, t_), hn::Lt(t_, leave));
            const M stays = andNot(axis.isNonZero, hn::And(hn::Ge(axis.origin, low), hn::Lt(axis.origin, high)));
            inside.lanes = hn::And(inside.lanes, hn::Or(isIn, stays));
            return leave;
        };
        const V x = leaveTime(vectors_.x, 0), y = leaveTime(vectors_.y, 1), z = leaveTime(vectors_.z, 2);
        inside.exit = hn::Min(hn::Min(x, y), z);
        return inside;
    }

    // A cut or plane of a coded box: when the rays cross it, and whether they are beyond it after or before that time.
    struct Side {
        V time;
        M isBeyondAfter;
        std::int64_t plane;  // its number; -1: a cut
    };

    // Crosses a box with kCount sides; side s gives bit s of the side combination.
    template <std::size_t kCount>
    HWY_INLINE void crossSides(const Inside& inside, const Side* sides, const volume::Scalar* scalars) {
        const DI di;
        M lanes = inside.lanes;
        while (true) {
            VI combination = hn::Zero(di), nextPlane = hn::Set(di, -1);
            V next = inside.exit;
            for (std::size_t s = 0; s < kCount; ++s) {
                const M isAfter = hn::Ge(t_, sides[s].time);
                const M isNotBeyond = hn::Xor(isAfter, sides[s].isBeyondAfter);
                combination =
                    hn::Or(combination, hn::IfThenZeroElse(toInts(isNotBeyond), hn::Set(di, std::int64_t{1} << s)));
                const M isNext = andNot(isAfter, hn::Lt(sides[s].time, next));
                next = hn::IfThenElse(isNext, sides[s].time, next);
                nextPlane = hn::IfThenElse(toInts(isNext), hn::Set(di, sides[s].plane), nextPlane);
            }
            lanes = change(lanes, lookUp(scalars, std::size_t{1} << kCount, combination), false);
            crossedPlane_ = hn::IfThenElse(toInts(lanes), nextPlane, crossedPlane_);
            lanes = hn::And(advance(lanes, next), hn::Lt(next, inside.exit));
            if (!any(lanes)) return;
        }
    }

    // As PlaneCrossing of the plain caster.
    HWY_INLINE void findCrossing(const volume::BrickPlane& plane, V& time, M& isRising) const {
        const D d;
        const V zero = hn::Zero(d);
        const V3 normal = broadcast(plane.normal);
        const V height =
            hn::Add(dot(normal, {vectors_.x.origin, vectors_.y.origin, vectors_.z.origin}), hn::Set(d, plane.offset));
        const V rise = dot(normal, {vectors_.x.direction, vectors_.y.direction, vectors_.z.direction});
        const M crosses = hn::Ne(rise, zero);
        time = hn::IfThenElse(crosses, hn::Div(hn::Neg(height), rise), hn::Set(d, kInfinity));
        isRising = hn::Or(hn::Gt(rise, zero), hn::Not(hn::Or(crosses, hn::Gt(height, zero))));
    }

    // Moves the lanes on to `t`; returns those that have not reached their end.
    HWY_INLINE M advance(M lanes, V t) {
        const D d;
        const M goesOn = hn::And(lanes, hn::Lt(t, end_));
        t_ = hn::IfThenElse(lanes, hn::IfThenElse(goesOn, t, hn::Set(d, kInfinity)), t_);
        return goesOn;
    }

    // Records that the lanes are in `scalar` from t_ on; returns those that go on. Opaque scalars end their rays.
    HWY_INLINE M change(M lanes, VI scalar, bool isVoxel) {
        const M changed = hn::And(lanes, toDoubles(hn::Ne(scalar, runScalar_)));
        if (!any(changed)) return lanes;
        runScalar_ = hn::IfThenElse(toInts(changed), scalar, runScalar_);
        changes_.add(changed, t_, scalar, crossedPlane_, isVoxel);
        if (pass_.hasOpaque) {
            const VI kind = styles_.integer<offsetof(PacketStyle, kind)>(styles_.find(scalar, changed));
            const M ending = hn::And(changed, toDoubles(isSet(kind, PacketKind::kOpaque)));
            end(ending);
            lanes = andNot(ending, lanes);
        }
        return lanes;
    }

    const PacketPass& pass_;
    const PacketRays& rays_;
    const RayVectors& vectors_;
    Styles styles_;
    std::size_t first_;
    ChangeRows& changes_;
    V t_, end_;
    VI runScalar_, crossedPlane_;  // crossedPlane_: the oblique plane that the ray crosses at t_, or -1
};

}  // namespace
}  // namespace svt::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
