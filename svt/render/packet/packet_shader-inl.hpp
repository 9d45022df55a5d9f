#pragma once
/// \file
/// Shades the runs of the rays of a group: the vector version of RunShader.
///
/// Takes the change rows of a walk. At each change, the run before is blended front to back: extinction over its length
/// (Beer-Lambert) attenuates the transmittance. The new run gets a normal from a table of planes and voxel faces; if it
/// is opaque its ray ends, and all opaque runs of the group are lit together at the end. Rare cases (a fitted normal, a
/// cap, a translucent body, a fragment) go to the caster by PacketPass::surface and PacketPass::fragment, ray by ray.

#include <svt/render/packet/packet_vectors-inl.hpp>
#include <svt/render/picture_constants.hpp>
#include <svt/render/walk/plane_crossing.hpp>

HWY_BEFORE_NAMESPACE();
namespace svt::render::HWY_NAMESPACE {
namespace {

// Planes are read as four numbers each, normal and offset.
using Plane = volume::BrickPlane;
static_assert(sizeof(Plane) == 4 * sizeof(double) && offsetof(Plane, normal) == 0 &&
              sizeof(Plane::normal) == 3 * sizeof(double) && offsetof(Plane, offset) == 3 * sizeof(double));

// As expOfMinus() of the plain caster.
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

// Shades the rays of one group. Without kWithFragments the code for lines and meshes is left out, which would cost 4 %.
template <bool kWithFragments>
class Shader {
public:
    HWY_INLINE Shader(const PacketPass& pass, const PacketRays& rays, const RayVectors& vectors, std::size_t first,
                      void* context, PacketSamples& samples)
        : pass_(pass),
          rays_(rays),
          vectors_(vectors),
          styles_(pass),
          first_(first),
          context_(context),
          samples_(samples) {}

    // Loads the state of the rays; must be called first.
    HWY_INLINE void begin(const PacketSpans& spans) {
        const D d;
        const DI di;
        const V zero = hn::Zero(d);
        from_ = hn::Load(d, spans.from.data() + first_);
        end_ = hn::Load(d, spans.to.data() + first_);
        isCapped_ = toDoubles(hn::Ne(hn::Load(di, spans.capped.data() + first_), hn::Zero(di)));
        isDone_ = toDoubles(hn::Ne(hn::Load(di, samples_.isDone.data() + first_), hn::Zero(di)));
        started_ = andNot(isDone_, hn::Lt(from_, end_));
        metresPerT_ = hn::Load(d, rays_.metresPerT.data() + first_);
        color_ = loadV3(samples_.color, first_);
        transmittance_ = hn::Load(d, samples_.transmittance.data() + first_);
        if constexpr (kWithFragments) {
            lines_ = hn::Load(d, samples_.lines.data() + first_);
            hasFragments_ = any(hn::Lt(hn::Load(d, samples_.nextFragment.data() + first_), hn::Set(d, kInfinity)));
        }
        runScalar_ = object_ = crossedPlane_ = hn::Set(di, -1);
        runStart_ = labelStart_ = cavity_ = t_ = zero;
        light_ = hn::Set(d, 1.0);
        normal_ = outwardIndex_ = {zero, zero, zero};
        isRunTranslucent_ = isOpaque_ = isUnlit_ = isOnCap_ = isAroundEye_ = hn::Lt(zero, zero);
    }

    // Shades all changes of the rows.
    HWY_NOINLINE void shade(const ChangeRows& rows) {
        for (std::size_t n = 0; n < rows.count(); ++n) {
            const ChangeRows::Row row = rows[n];
            const M changed = andNot(isDone_, row.lanes());
            if (!any(changed)) continue;
            t_ = row.t;
            crossedPlane_ = row.plane();
            if (kWithFragments && hasFragments_) addFragments(changed, t_);
            const M leaving = hn::And(kWithFragments ? andNot(isDone_, changed) : changed, isRunTranslucent_);
            if (any(leaving)) leave(leaving, t_);
            const M entering = andNot(isDone_, changed);
            if (any(entering)) enter(entering, row.scalar(), row.isVoxel());
        }
    }

    // The rays that have ended.
    [[nodiscard]] HWY_INLINE M isDone() const { return isDone_; }

    // Ends the last runs, lights opaque surfaces, and stores the state of the rays.
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
    HWY_INLINE V3 voxels() const { return vectors_.voxels(t_); }
    HWY_INLINE StyleRef styleOf(VI scalar, M lanes) const { return styles_.find(scalar, lanes); }
    template <std::size_t kMember>
    HWY_INLINE V number(const StyleRef& style) const {
        return styles_.template number<kMember>(style);
    }
    template <std::size_t kMember>
    HWY_INLINE VI integer(const StyleRef& style) const {
        return styles_.template integer<kMember>(style);
    }

    // As RunShader::add(); `share`: how much of the light is stopped.
    HWY_INLINE void add(M lanes, V share, V from, const StyleRef& style) {
        const D d;
        const V one = hn::Set(d, 1.0);
        const V surface = number<offsetof(PacketStyle, surface)>(style);
        const V light = hn::Add(one, hn::Mul(hn::Sub(light_, one), surface));
        V weight = hn::Mul(share, light);
        if constexpr (kWithFragments) weight = hn::Mul(weight, lines_);
        constexpr std::size_t kRed = offsetof(PacketStyle, color), kNext = sizeof(double);
        const auto addColor = [&](V color, V ofLabel) {
            return hn::IfThenElse(lanes, hn::Add(color, hn::Mul(ofLabel, weight)), color);
        };
        color_ = {addColor(color_.x, number<kRed>(style)), addColor(color_.y, number<kRed + kNext>(style)),
                  addColor(color_.z, number<kRed + 2 * kNext>(style))};
        transmittance_ = hn::IfThenElse(lanes, hn::Sub(transmittance_, share), transmittance_);
        const V opacity = hn::Sub(one, transmittance_);
        const V depth = hn::Load(d, samples_.depth.data() + first_);
        const M isHit =
            hn::And(hn::And(lanes, hn::Eq(depth, hn::Set(d, kInfinity))), hn::Gt(opacity, hn::Set(d, pass_.labelAt)));
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
            keepInt(integer<offsetof(PacketStyle, label)>(style), samples_.label);
            keepInt(integer<offsetof(PacketStyle, object)>(style), samples_.object);
            keepInt(hn::IfThenElseZero(toInts(isOnCap_), hn::Set(DI(), 1)), samples_.isCap);
        }
    }

    HWY_INLINE void markDone(M lanes) { isDone_ = hn::Or(isDone_, lanes); }

    // As RunShader::leave(), for translucent runs.
    HWY_INLINE void leave(M lanes, V to) {
        const D d;
        const V one = hn::Set(d, 1.0);
        const StyleRef style = styleOf(runScalar_, lanes);
        const V density = number<offsetof(PacketStyle, density)>(style);
        const V stopped = hn::Sub(one, expOfMinus(hn::Mul(hn::Mul(density, hn::Sub(to, runStart_)), metresPerT_)));
        add(lanes, hn::Mul(transmittance_, stopped), kWithFragments ? labelStart_ : runStart_, style);
        if (pass_.withColor) {
            markDone(hn::And(lanes, hn::Ge(hn::Sub(one, transmittance_), hn::Set(d, pass_.opaqueAt))));
        } else {
            const V depth = hn::Load(d, samples_.depth.data() + first_);
            markDone(hn::And(lanes, hn::Lt(depth, hn::Set(d, kInfinity))));
        }
    }

    // Blends the fragments up to `t`. A run is blended up to a fragment, and continues behind it.
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
                if (wanted[lane] != 0) pass_.fragment(context_, first_ + lane);
            color_ = loadV3(samples_.color, first_);
            transmittance_ = hn::Load(d, samples_.transmittance.data() + first_);
            lines_ = hn::Load(d, samples_.lines.data() + first_);
            markDone(toDoubles(hn::Ne(hn::Load(di, samples_.isDone.data() + first_), hn::Zero(di))));
        }
    }

    // As RunShader::enter().
    HWY_INLINE void enter(M lanes, VI scalar, M isVoxel) {
        const DI di;
        const StyleRef style = styleOf(scalar, lanes);
        runScalar_ = hn::IfThenElse(toInts(lanes), scalar, runScalar_);
        runStart_ = hn::IfThenElse(lanes, t_, runStart_);
        if constexpr (kWithFragments) labelStart_ = hn::IfThenElse(lanes, t_, labelStart_);
        const VI kind = integer<offsetof(PacketStyle, kind)>(style);
        const VI object = integer<offsetof(PacketStyle, object)>(style);
        const M visible = hn::And(lanes, toDoubles(isSet(kind, PacketKind::kVisible)));
        const M isNew = hn::And(visible, toDoubles(hn::Ne(object, object_)));
        object_ = hn::IfThenElse(toInts(lanes), hn::IfThenElse(toInts(visible), object, hn::Set(di, -1)), object_);
        const M opaque = hn::And(visible, toDoubles(isSet(kind, PacketKind::kOpaque)));
        if (pass_.withColor && any(isNew))
            findSurfaces(isNew, opaque, toDoubles(isSet(kind, PacketKind::kBody)), scalar, isVoxel);
        isRunTranslucent_ = hn::Or(andNot(lanes, isRunTranslucent_), andNot(opaque, visible));
        isOpaque_ = hn::Or(isOpaque_, opaque);
        markDone(opaque);
    }

    // Opaque runs end their rays; all of the group are lit together here.
    HWY_NOINLINE void addOpaque() {
        const M unlit = hn::And(isOpaque_, isUnlit_);
        if (any(unlit)) light_ = hn::IfThenElse(unlit, lightOn(unlit, openness(), runStart_), light_);
        const StyleRef style = styleOf(runScalar_, isOpaque_);
        if (!pass_.hasPaint) {
            add(isOpaque_, transmittance_, runStart_, style);
            return;
        }
        keepPainted(style);
        const V3 before = color_;
        add(isOpaque_, transmittance_, runStart_, style);
        color_ = before;
    }

    // Stores what the caller needs to add the color of opaque surfaces.
    HWY_NOINLINE void keepPainted(const StyleRef& style) {
        const D d;
        const DI di;
        const V one = hn::Set(d, 1.0);
        const V surface = number<offsetof(PacketStyle, surface)>(style);
        V weight = hn::Mul(transmittance_, hn::Add(one, hn::Mul(hn::Sub(light_, one), surface)));
        if constexpr (kWithFragments) weight = hn::Mul(weight, lines_);
        PacketSamples::Painted& painted = samples_.painted;
        const auto keep = [&](V value, Lanes<double>& lanesOf) {
            store(hn::IfThenElse(isOpaque_, value, hn::Load(d, lanesOf.data() + first_)), lanesOf, first_);
        };
        keep(weight, painted.weight);
        keep(runStart_, painted.depth);
        keep(normal_.x, painted.normal[0]);
        keep(normal_.y, painted.normal[1]);
        keep(normal_.z, painted.normal[2]);
        const auto keepInt = [&](VI value, Lanes<std::int64_t>& lanesOf) {
            hn::Store(hn::IfThenElse(toInts(isOpaque_), value, hn::Load(di, lanesOf.data() + first_)), di,
                      lanesOf.data() + first_);
        };
        keepInt(runScalar_, painted.scalar);
        keepInt(hn::IfThenElseZero(toInts(isOnCap_), hn::Set(di, 1)), painted.isCap);
    }

    // As SurfaceLight::openness().
    HWY_INLINE V openness() const {
        const D d;
        const V one = hn::Set(d, 1.0), zero = hn::Zero(d);
        if (pass_.ambientOcclusion == 0) return one;
        const V3 point{hn::Add(vectors_.x.origin, hn::Mul(vectors_.x.direction, runStart_)),
                       hn::Add(vectors_.y.origin, hn::Mul(vectors_.y.direction, runStart_)),
                       hn::Add(vectors_.z.origin, hn::Mul(vectors_.z.direction, runStart_))};
        V occlusion = zero;
        for (const PacketOcclusion& level : pass_.occlusion)
            occlusion = hn::Add(
                occlusion,
                hn::Mul(hn::Set(d, level.weight), hn::Min(one, hn::Mul(sample(level, point), hn::Set(d, level.gain)))));
        occlusion = hn::Min(one, hn::Add(occlusion, hn::Mul(hn::Set(d, kCavityOcclusion), cavity_)));
        const V open = hn::Sub(one, hn::Mul(hn::Set(d, pass_.ambientOcclusion), occlusion));
        return hn::IfThenElse(isAroundEye_, one, open);
    }

    // As OcclusionField::Level::sample(), at `point` moved by one cell along the surface's outward direction.
    HWY_INLINE V sample(const PacketOcclusion& level, const V3& point) const {
        const D d;
        const V zero = hn::Zero(d), one = hn::Set(d, 1.0), size = hn::Set(d, level.cellSize);
        M inside = isOpaque_;
        const auto place = [&](V from, V outwardIndex, double count, V& low) {
            const V p = hn::Add(hn::Mul(hn::Add(from, hn::Mul(outwardIndex, size)), hn::Set(d, level.perVoxel)),
                                hn::Set(d, 0.5));
            inside = hn::And(inside, hn::And(hn::Gt(p, zero), hn::Lt(p, hn::Set(d, count + 1))));
            low = hn::Floor(p);
            return hn::Sub(p, low);
        };
        V3 low;
        const V fx = place(point.x, outwardIndex_.x, level.count[0], low.x);
        const V fy = place(point.y, outwardIndex_.y, level.count[1], low.y);
        const V fz = place(point.z, outwardIndex_.z, level.count[2], low.z);
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

    // As SurfaceLight::unshaded().
    HWY_NOINLINE V unshaded(M lanes, V from) const {
        const D d;
        const DI di;
        alignas(64) std::int64_t wanted[hn::MaxLanes(D())];
        alignas(64) double t[hn::MaxLanes(D())], normal[3][hn::MaxLanes(D())], shares[hn::MaxLanes(D())];
        hn::Store(hn::IfThenElseZero(toInts(lanes), hn::Set(di, 1)), di, wanted);
        hn::Store(from, d, t);
        hn::Store(normal_.x, d, normal[0]);
        hn::Store(normal_.y, d, normal[1]);
        hn::Store(normal_.z, d, normal[2]);
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
            shares[lane] =
                wanted[lane] == 0
                    ? 1
                    : pass_.unshaded(context_,
                                     {first_ + lane, t[lane], {normal[0][lane], normal[1][lane], normal[2][lane]}});
        return hn::Load(d, shares);
    }

    // As SurfaceLight::lightOn().
    HWY_INLINE V lightOn(M lanes, V open, V from) const {
        const D d;
        const V zero = hn::Zero(d);
        const V3 view = loadV3(rays_.view, first_);
        V key = hn::Max(zero, dot(normal_, broadcast(pass_.towardsLight)));
        if (pass_.unshaded != nullptr) key = hn::Mul(key, unshaded(lanes, from));
        const V facing = hn::Max(zero, dot(normal_, view));
        const V sky = hn::Add(hn::Set(d, kSkyAside), hn::Mul(hn::Set(d, kSkyAbove), normal_.z));
        const V ambient =
            hn::Mul(hn::Mul(hn::Set(d, pass_.ambient), open),
                    hn::Add(hn::Mul(hn::Set(d, kSkyShare), sky), hn::Mul(hn::Set(d, kViewerShare), facing)));
        return hn::Add(ambient, hn::Mul(hn::Mul(hn::Set(d, pass_.key), key),
                                        hn::Add(hn::Set(d, kKeyShut), hn::Mul(hn::Set(d, kKeyOpen), open))));
    }

    // For lanes on a plane of a brick: the side of it that the ray comes from; for the others `face`.
    HWY_INLINE VI planeFaces(M onPlane, VI face) const {
        const D d;
        const DI di;
        const auto* planes = reinterpret_cast<const double*>(pass_.volume.planes.data());
        V3 normal;  // voxel space
        std::int64_t first = 0;
        if (isSame(crossedPlane_, onPlane, first)) {
            const double* same = planes + 4 * first;
            normal = broadcast({same[0], same[1], same[2]});
        } else {
            const VI plane = hn::ShiftLeft<5>(hn::IfThenElseZero(toInts(onPlane), crossedPlane_));
            const auto part = [&](int n) { return hn::BitCast(d, gatherBytes(planes + n, plane)); };
            normal = {part(0), part(1), part(2)};
        }
        const M isAway =
            hn::Gt(dot(normal, {vectors_.x.direction, vectors_.y.direction, vectors_.z.direction}), hn::Zero(d));
        const VI front = hn::Add(hn::Add(crossedPlane_, crossedPlane_), hn::Set(di, 6));
        const VI side = hn::IfThenElse(toInts(isAway), hn::Add(front, hn::Set(di, 1)), front);
        return hn::IfThenElse(toInts(onPlane), side, face);
    }

    // As Surface::normal and Surface::outwardIndex.
    HWY_INLINE void loadFaces(M lanes, VI face) {
        const D d;
        V3 normal, outwardIndex;
        std::int64_t first = 0;
        if (isSame(face, lanes, first)) {
            const PacketFace& same = pass_.faces[first];
            normal = broadcast({same.normal[0], same.normal[1], same.normal[2]});
            outwardIndex = broadcast({same.outwardIndex[0], same.outwardIndex[1], same.outwardIndex[2]});
        } else {
            static_assert(sizeof(PacketFace) == 64 && offsetof(PacketFace, normal) == 0 &&
                          offsetof(PacketFace, outwardIndex) == 3 * sizeof(double));
            const VI place = hn::ShiftLeft<6>(hn::IfThenElseZero(toInts(lanes), face));
            const auto* numbers = reinterpret_cast<const double*>(pass_.faces);
            const auto part = [&](int n) { return hn::BitCast(d, gatherBytes(numbers + n, place)); };
            normal = {part(0), part(1), part(2)};
            outwardIndex = {part(3), part(4), part(5)};
        }
        const auto keep = [&](V value, V known) { return hn::IfThenElse(lanes, value, known); };
        normal_ = {keep(normal.x, normal_.x), keep(normal.y, normal_.y), keep(normal.z, normal_.z)};
        outwardIndex_ = {keep(outwardIndex.x, outwardIndex_.x), keep(outwardIndex.y, outwardIndex_.y),
                         keep(outwardIndex.z, outwardIndex_.z)};
    }

    // As SurfaceLight::findNormal(); also lights what is not opaque.
    HWY_INLINE void findSurfaces(M lanes, M opaque, M isBody, VI scalar, M isVoxel) {
        const D d;
        const DI di;
        const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
        const M isCap = hn::And(isCapped_, hn::Eq(t_, from_));
        M isOblique = toDoubles(hn::Gt(crossedPlane_, hn::Set(di, -1)));
        M isNowhere = hn::Lt(zero, zero);
        V faceAxis = hn::Set(d, -1.0);
        VI face = hn::Zero(di);  // index into PacketPass::faces
        if (const M onGrid = andNot(isOblique, lanes); any(onGrid)) {
            // The first axis whose voxel plane the ray crosses at t.
            const auto nearX = RayVectors::nearPlane(vectors_.x, t_), nearY = RayVectors::nearPlane(vectors_.y, t_),
                       nearZ = RayVectors::nearPlane(vectors_.z, t_);
            const M isX = hn::Eq(nearX.time, t_), isY = hn::Eq(nearY.time, t_), isZ = hn::Eq(nearZ.time, t_);
            const auto first = [&](V ofX, V ofY, V ofZ) {
                return hn::IfThenElse(isX, ofX, hn::IfThenElse(isY, ofY, ofZ));
            };
            const auto side = [&](const Axis& axis, double number) {
                return hn::IfThenElse(axis.isNegative, hn::Set(d, 2 * number), hn::Set(d, 2 * number + 1));
            };
            isNowhere = andNot(hn::Or(isX, hn::Or(isY, isZ)), onGrid);
            faceAxis = first(zero, one, hn::Set(d, 2.0));
            faceAxis = hn::IfThenElse(isNowhere, hn::Set(d, -1.0), faceAxis);
            face = toInt(first(side(vectors_.x, 0), side(vectors_.y, 1), side(vectors_.z, 2)));
            // A multiple of 8 is a face of a brick.
            const V fraction = hn::Mul(first(nearX.plane, nearY.plane, nearZ.plane), hn::Set(d, 0.125));
            const M atSide = hn::And(onGrid, hn::Eq(hn::Floor(fraction), fraction));
            const M atSeam = hn::And(andNot(isNowhere, atSide), hn::Gt(t_, from_));
            if (any(atSeam)) {
                crossedPlane_ = seamPlanes(atSeam, faceAxis);
                isOblique = toDoubles(hn::Gt(crossedPlane_, hn::Set(di, -1)));
            }
        }
        const M onPlane = hn::And(lanes, andNot(isCap, isOblique));
        if (any(onPlane)) face = planeFaces(onPlane, face);
        loadFaces(lanes, face);
        cavity_ = hn::IfThenElse(lanes, zero, cavity_);
        isOnCap_ = andNot(lanes, isOnCap_);
        isAroundEye_ = andNot(lanes, isAroundEye_);
        isUnlit_ = hn::Or(isUnlit_, hn::And(lanes, opaque));
        M needsNormal = andNot(opaque, lanes);
        needsNormal = hn::Or(needsNormal, hn::And(isVoxel, andNot(isOblique, lanes)));
        const M special = hn::And(lanes, hn::Or(hn::Or(isCap, isNowhere), hn::And(isBody, needsNormal)));
        const M glass = andNot(opaque, lanes);
        if (any(glass)) light_ = hn::IfThenElse(glass, lightOn(glass, one, t_), light_);
        if (any(special)) shadeSpecialSurfaces(special, scalar, isVoxel, faceAxis);
    }

    // The lanes whose index entry is below `end`, see BrickVolume::Arrays.
    static HWY_INLINE M isBelow(VI entry, std::size_t end) {
        return toDoubles(hn::Lt(entry, hn::Set(DI(), static_cast<std::int64_t>(end))));
    }
    HWY_INLINE VI entryAt(const V3& brick, M lanes) const {
        constexpr std::size_t kLanes = hn::MaxLanes(D());
        alignas(64) std::int64_t x[kLanes], y[kLanes], z[kLanes], entries[kLanes];
        const auto store = [&](V along, std::int64_t* to) {
            hn::Store(toInt(hn::IfThenElseZero(lanes, along)), DI(), to);
        };
        store(brick.x, x);
        store(brick.y, y);
        store(brick.z, z);
        for (std::size_t n = 0; n < hn::Lanes(D()); ++n) {
            const bool isSame = n > 0 && x[n] == x[n - 1] && y[n] == y[n - 1] && z[n] == z[n - 1];
            entries[n] = isSame ? entries[n - 1]
                                : pass_.volume.entry(static_cast<std::int32_t>(x[n]), static_cast<std::int32_t>(y[n]),
                                                     static_cast<std::int32_t>(z[n]));
        }
        return hn::Load(DI(), entries);
    }

    // Numbers of the planes of each lane's brick; kNoPlane: none.
    struct Planes {
        VI first, second, third;
    };
    HWY_INLINE Planes planesOf(M lanes, const V3& brick) const {
        const DI di;
        const VI none = hn::Set(di, std::int64_t{volume::BrickVolume::kNoPlane});
        const VI entry = entryAt(brick, lanes);
        const M isBox = hn::And(lanes, isBelow(entry, pass_.volume.boxes.size()));
        const M coded = andNot(isBelow(entry, pass_.volume.uniformBoxes), isBox);
        if (!any(coded)) return {none, none, none};
        const VI box = hn::IfThenElseZero(toInts(coded), hn::ShiftLeft<4>(entry));
        // The 64 bits from byte 8 on have the scalar, here the number of a code, in their upper half.
        static_assert(sizeof(volume::SameLabelBox) == 16 && offsetof(volume::SameLabelBox, scalar) == 12);
        static_assert(sizeof(volume::Scalar) == 4);
        const VI code = hn::IfThenElseZero(
            toInts(coded),
            shiftRight<32>(gatherBytes(reinterpret_cast<const std::byte*>(pass_.volume.boxes.data()) + 8, box)));
        const VI place = hn::Add(hn::ShiftLeft<4>(code), hn::ShiftLeft<3>(code));
        using Coding = volume::BrickVolume::BoxCoding;
        static_assert(sizeof(Coding) == 24 && offsetof(Coding, plane) == 8 && sizeof(Coding::plane) == 3 * 4);
        const auto* codes = reinterpret_cast<const std::byte*>(pass_.volume.codes.data());
        const VI both = gatherBytes(codes + 8, place), rest = gatherBytes(codes + 16, place);
        const auto known = [&](VI planes) { return hn::IfThenElse(toInts(coded), planes, none); };
        return {known(lowHalf(both)), known(shiftRight<32>(both)), known(lowHalf(rest))};
    }

    // As seamPlane(): the plane for each lane of the mask, crossedPlane_ for the others.
    HWY_NOINLINE VI seamPlanes(M lanes, V faceAxis) const {
        const D d;
        const DI di;
        const V3 point{hn::Add(vectors_.x.origin, hn::Mul(vectors_.x.direction, t_)),
                       hn::Add(vectors_.y.origin, hn::Mul(vectors_.y.direction, t_)),
                       hn::Add(vectors_.z.origin, hn::Mul(vectors_.z.direction, t_))};
        VI found = crossedPlane_;
        const auto look = [&](VI plane) {
            const VI none = hn::Set(di, std::int64_t{volume::BrickVolume::kNoPlane});
            const M isThere = hn::And(lanes, toDoubles(hn::Ne(plane, none)));
            if (!any(isThere)) return;
            const VI offset = hn::IfThenElseZero(toInts(isThere), hn::ShiftLeft<5>(plane));
            const auto number = [&](int n) {
                return hn::BitCast(
                    d, gatherBytes(reinterpret_cast<const double*>(pass_.volume.planes.data()) + n, offset));
            };
            const V3 normal{number(0), number(1), number(2)};
            const V distance = hn::Add(dot(normal, point), number(3));
            const V along = hn::IfThenElse(hn::Eq(faceAxis, hn::Zero(d)), normal.x,
                                           hn::IfThenElse(hn::Eq(faceAxis, hn::Set(d, 1.0)), normal.y, normal.z));
            const M isNear = hn::And(isThere, hn::And(hn::Lt(hn::Abs(distance), hn::Set(d, kSeamDistance)),
                                                      hn::Gt(hn::Abs(along), hn::Set(d, kSeamSlope))));
            found = hn::IfThenElse(toInts(isNear), plane, found);
            lanes = andNot(isNear, lanes);
        };
        const V eighth = hn::Set(d, 0.125), one = hn::Set(d, 1.0);
        const auto brickOf = [&](V at) { return hn::Floor(hn::Mul(at, eighth)); };
        const V3 voxel = voxels();
        const auto lookAll = [&](const Planes& planes) {
            look(planes.first);
            look(planes.second);
            look(planes.third);
        };
        lookAll(planesOf(lanes, {brickOf(voxel.x), brickOf(voxel.y), brickOf(voxel.z)}));
        if (!any(lanes)) return found;
        const auto brickBefore = [&](const Axis& axis, V at, double number) {
            const V before = hn::IfThenElse(axis.isNegative, hn::Add(at, one), hn::Sub(at, one));
            return brickOf(hn::IfThenElse(hn::Eq(faceAxis, hn::Set(d, number)), before, at));
        };
        lookAll(planesOf(lanes, {brickBefore(vectors_.x, voxel.x, 0), brickBefore(vectors_.y, voxel.y, 1),
                                 brickBefore(vectors_.z, voxel.z, 2)}));
        return found;
    }

    // Asks PacketPass::surface for the surfaces of some lanes, ray by ray.
    HWY_NOINLINE void shadeSpecialSurfaces(M lanes, VI scalars, M isVoxel, V faceAxis) {
        const D d;
        const DI di;
        constexpr std::size_t kMaxLanes = hn::MaxLanes(D());
        alignas(64) double t[kMaxLanes], axis[kMaxLanes], voxel[3][kMaxLanes], light[kMaxLanes], cavity[kMaxLanes],
            normal[3][kMaxLanes], outwardIndex[3][kMaxLanes];
        alignas(64) std::int64_t scalar[kMaxLanes], plane[kMaxLanes], wanted[kMaxLanes], voxelOnly[kMaxLanes],
            cap[kMaxLanes] = {}, eye[kMaxLanes] = {};
        hn::Store(t_, d, t);
        hn::Store(faceAxis, d, axis);
        hn::Store(light_, d, light);
        hn::Store(cavity_, d, cavity);
        const auto storeV3 = [&](const V3& v, double(&to)[3][kMaxLanes]) {
            hn::Store(v.x, d, to[0]);
            hn::Store(v.y, d, to[1]);
            hn::Store(v.z, d, to[2]);
        };
        storeV3(voxels(), voxel);
        storeV3(normal_, normal);
        storeV3(outwardIndex_, outwardIndex);
        hn::Store(scalars, di, scalar);
        hn::Store(crossedPlane_, di, plane);
        hn::Store(hn::IfThenElseZero(toInts(lanes), hn::Set(di, 1)), di, wanted);
        hn::Store(hn::IfThenElseZero(toInts(isVoxel), hn::Set(di, 1)), di, voxelOnly);
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
            if (wanted[lane] == 0) continue;
            const Vec3i at{static_cast<std::int32_t>(voxel[0][lane]), static_cast<std::int32_t>(voxel[1][lane]),
                           static_cast<std::int32_t>(voxel[2][lane])};
            const Surface found = pass_.surface(context_, {first_ + lane, scalar[lane], plane[lane], t[lane], at,
                                                           static_cast<int>(axis[lane]), voxelOnly[lane] != 0});
            light[lane] = found.light;
            cavity[lane] = found.cavity;
            for (int a = 0; a < 3; ++a) {
                normal[a][lane] = found.normal[a];
                outwardIndex[a][lane] = found.outwardIndex[a];
            }
            cap[lane] = found.isCap ? 1 : 0;
            eye[lane] = found.isAroundEye ? 1 : 0;
        }
        const auto loadBack = [&](const double(&from)[3][kMaxLanes]) {
            return V3{hn::Load(d, from[0]), hn::Load(d, from[1]), hn::Load(d, from[2])};
        };
        light_ = hn::Load(d, light);
        cavity_ = hn::Load(d, cavity);
        normal_ = loadBack(normal);
        outwardIndex_ = loadBack(outwardIndex);
        isOnCap_ = hn::Or(isOnCap_, toDoubles(hn::Ne(hn::Load(di, cap), hn::Zero(di))));
        isAroundEye_ = hn::Or(isAroundEye_, toDoubles(hn::Ne(hn::Load(di, eye), hn::Zero(di))));
    }

    const PacketPass& pass_;
    const PacketRays& rays_;
    const RayVectors& vectors_;
    Styles styles_;
    std::size_t first_;
    void* context_;
    PacketSamples& samples_;
    V metresPerT_;
    V t_, from_, end_, runStart_, labelStart_;
    VI runScalar_, object_, crossedPlane_;  // crossedPlane_: the oblique plane that the ray crosses at t_, or -1
    V light_, cavity_;
    V3 normal_, outwardIndex_;
    V3 color_;
    V transmittance_, lines_;
    bool hasFragments_ = false;
    M started_, isDone_, isCapped_, isRunTranslucent_;
    M isOpaque_, isUnlit_, isOnCap_, isAroundEye_;
};

}  // namespace
}  // namespace svt::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
