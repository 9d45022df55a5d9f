#include <svt/render/light/cap_hatch.hpp>
#include <svt/render/light/cell_edges.hpp>
#include <svt/render/packet/packet_caster.hpp>

#include <algorithm>
#include <limits>

namespace svt::render {
namespace {

using Kind = LinearStyle::Kind;

PacketStyle packetStyle(const LinearStyle& style) noexcept {
    PacketStyle packet{};
    for (int channel = 0; channel < 3; ++channel) packet.color[channel] = double(style.color[channel]);
    packet.density = double(style.density);
    packet.surface = double(style.surface);
    if (style.kind != Kind::Hidden) packet.kind |= kVisible;
    if (style.kind == Kind::Opaque) packet.kind |= kOpaque;
    if (style.isBody) packet.kind |= kBody;
    packet.object = style.object;
    packet.label = style.label;
    return packet;
}

PacketOcclusion packetOcclusion(const OcclusionField::Level& level) noexcept {
    PacketOcclusion packet;
    packet.voxels = level.voxels.data();
    for (int axis = 0; axis < 3; ++axis) packet.count[axis] = level.count[axis];
    packet.perVoxel = 1 / level.cellSize;
    packet.cellSize = level.cellSize;
    packet.gain = level.gain;
    packet.weight = level.weight;
    return packet;
}

}  // namespace

PacketPasses::PacketPasses(const PreparedFrame& frame) {
    for (const PreparedVolume& volume : frame.volumes) {
        auto& faces = faces_.emplace_back();
        const auto addSides = [&](const DirectionTable::Directions& found) {
            const auto& [normal, outwardIndex] = found;
            faces.push_back({{normal.x, normal.y, normal.z}, {outwardIndex.x, outwardIndex.y, outwardIndex.z}, {}});
            faces.push_back(
                {{-normal.x, -normal.y, -normal.z}, {-outwardIndex.x, -outwardIndex.y, -outwardIndex.z}, {}});
        };
        for (int axis = 0; axis < 3; ++axis) addSides(volume.directions.axis(axis));
        for (const DirectionTable::Directions& plane : volume.directions.planes()) addSides(plane);
    }
    PacketPass shared;
    shared.towardsLight = frame.towardsLight;
    shared.ambient = double(frame.spec.light.ambient);
    shared.key = double(frame.spec.light.key);
    shared.opaqueAt = double(frame.options.opaqueAt);
    shared.labelAt = double(frame.options.labelAt);
    for (const PreparedPass& pass : frame.passes) {
        auto& styles = styles_.emplace_back();
        for (const LinearStyle& style : pass.table.styles()) styles.push_back(packetStyle(style));
        PacketPass packetPass = shared;
        const PreparedVolume& volume = frame.volumes[pass.volume];
        packetPass.volume = volume.bricks.arrays();
        for (int axis = 0; axis < 3; ++axis) packetPass.count[axis] = volume.bricks.dimension()[axis];
        packetPass.faces = faces_[pass.volume].data();
        packetPass.styleCount = static_cast<std::int64_t>(styles.size());
        packetPass.hasOpaque = std::any_of(styles.begin(), styles.end(),
                                           [](const PacketStyle& style) { return (style.kind & kOpaque) != 0; });
        styles.push_back(packetStyle({}));
        packetPass.styles = styles.data();
        const auto& levels = pass.occlusion.levels();
        if (!levels.empty()) packetPass.ambientOcclusion = double(frame.spec.light.ambientOcclusion);
        for (std::size_t n = 0; n < levels.size(); ++n) packetPass.occlusion[n] = packetOcclusion(levels[n]);
        passes_.push_back(packetPass);
    }
}

PacketPass PacketPasses::labelsOnly(std::size_t pass) const noexcept {
    PacketPass labels = passes_[pass];
    labels.withColor = false;
    return labels;
}

void PacketCaster::cast(bool withColor, std::span<Sample> samples) {
    if (count_ == 0) return;
    for (std::size_t n = count_; n < kPacketRays; ++n) {
        rays_.u[n] = rays_.u[0];
        rays_.v[n] = rays_.v[0];
    }
    const auto [left, right] = std::minmax_element(rays_.u.begin(), rays_.u.end());
    const auto [low, high] = std::minmax_element(rays_.v.begin(), rays_.v.end());
    bool isAnyMet = false;
    for (std::size_t pass = 0; pass < frame_.passes.size(); ++pass) {
        const PassShapes& shapes = frame_.passes[pass].shapes;
        visible_[pass] = frame_.passes[pass].hull.spanOf({*left, *right, *low, *high});
        isAnyMet = isAnyMet || visible_[pass].from < visible_[pass].to ||
                   (!shapes.isEmpty() && shapes.hasAnyNear(rays_.u.data(), rays_.v.data(), count_));
    }
    if (isAnyMet)
        setUpRays(0);
    else
        for (std::size_t n = 0; n < count_; ++n) samples[places_[n]] = Sample();
    if (isAnyMet && frame_.passes.size() == 1) {
        castPass(0, withColor ? passes_[0] : passes_.labelsOnly(0));
        for (std::size_t n = 0; n < count_; ++n) writeSample(n, samples[places_[n]]);
    } else if (isAnyMet) {
        castPasses(withColor, samples);
    }
    count_ = 0;
}

bool PacketCaster::isAnyIn(const ViewRect& rect) const noexcept {
    for (std::size_t pass = 0; pass < frame_.passes.size(); ++pass) {
        const RaySpan visible = frame_.passes[pass].hull.spanOf(rect);
        if (visible.from < visible.to || !frame_.passes[pass].shapes.isEmpty()) return true;
    }
    return false;
}

// Sets the packet's rays up for a volume.
void PacketCaster::setUpRays(std::size_t volume) {
    const PreparedVolume& prepared = frame_.volumes[volume];
    setUpPacket(prepared.rays, prepared.bricks.dimension(), rays_);
    for (std::size_t n = count_; n < kPacketRays; ++n) rays_.to[n] = 0;
    volume_ = volume;
}

// Casts from the last pass to the first: where a pass hides all before it, those need not be cast. Joins first to last.
void PacketCaster::castPasses(bool withColor, std::span<Sample> samples) {
    const std::size_t last = frame_.passes.size() - 1;
    ofPasses_.resize(frame_.passes.size() * kPacketRays);
    std::array<std::size_t, kPacketRays> first;
    first.fill(last + 1);
    std::size_t open = count_;
    for (std::size_t pass = last + 1; pass-- > 0 && open > 0;) {
        if (frame_.passes[pass].volume != volume_) {
            setUpRays(frame_.passes[pass].volume);
            for (std::size_t n = 0; n < count_; ++n)
                if (first[n] != pass + 1) rays_.to[n] = 0;
        }
        castPass(pass, withColor ? passes_[pass] : passes_.labelsOnly(pass));
        for (std::size_t n = 0; n < count_; ++n) {
            if (first[n] != pass + 1) continue;  // hidden by a later pass
            Sample& sample = ofPasses_[pass * kPacketRays + n];
            writeSample(n, sample);
            first[n] = pass;
            if (pass == 0 || frame_.passes[pass].join == Pass::Join::Part ||
                !hidesAllBefore(frame_.passes[pass].join, sample))
                continue;
            first[n] = kPacketRays + pass;
            rays_.to[n] = 0;
            --open;
        }
    }
    for (std::size_t n = 0; n < count_; ++n) {
        const std::size_t begin = first[n] % kPacketRays;
        // Passes before `begin` are hidden.
        Sample& joined = samples[places_[n]];
        joined = Sample();
        for (std::size_t pass = begin; pass <= last;) {
            const std::size_t head = pass++;
            while (pass <= last && frame_.passes[pass].join == Pass::Join::Part) ++pass;
            const Sample sample = pass == head + 1 ? ofPasses_[head * kPacketRays + n] : joinedParts(n, head, pass);
            if (head == 0)
                joined = sample;
            else
                joinPass(frame_.passes[head].join, head, sample, joined);
        }
    }
}

// The sample of a pass and its parts [head, end).
Sample PacketCaster::joinedParts(std::size_t ray, std::size_t head, std::size_t end) const noexcept {
    std::array<const Sample*, FrameSpec::kMaxPasses> parts;
    for (std::size_t pass = head; pass < end; ++pass) parts[pass - head] = &ofPasses_[pass * kPacketRays + ray];
    return joinParts(std::span(parts).first(end - head));
}

void PacketCaster::castPass(std::size_t pass, const PacketPass& prepared) {
    pass_ = pass;
    PacketPass packetPass = prepared;
    packetPass.surface = &PacketCaster::shadeSurface;
    packetPass.fragment = &PacketCaster::blendFragment;
    if (!frame_.shadows.isEmpty()) packetPass.unshaded = &PacketCaster::shareOfLight;
    withColor_ = packetPass.withColor;
    // All other members are read only where depth is finite.
    for (auto& color : seen_.color) color.fill(0);
    seen_.transmittance.fill(1);
    seen_.depth.fill(std::numeric_limits<double>::infinity());
    seen_.isDone.fill(0);
    packetPass.hasPaint = withColor_ && frame_.volumeOf(pass).paint != nullptr;
    if (packetPass.hasPaint) seen_.painted.weight.fill(0);
    hasShapes_ = !frame_.passes[pass].shapes.isEmpty();
    if (hasShapes_) {
        seen_.lines.fill(1);
        seen_.nextFragment.fill(std::numeric_limits<double>::infinity());
        fragments_.clear();
        rayFragments_.fill({});
    }
    if (hasShapes_ || !frame_.passes[pass].clipper.isEmpty()) {
        castIntervals(packetPass);
    } else {
        caps_.fill({});
        spans_.from = rays_.from;
        spans_.to = rays_.to;
        spans_.capped.fill(0);
        walkVisible(packetPass);
    }
    if (packetPass.hasPaint) addPainted();
}

// Adds the colors of opaque surfaces by their place. Behind a surface a ray ends, so none is added after it.
void PacketCaster::addPainted() {
    const PreparedVolume& volume = frame_.volumeOf(pass_);
    const PassTable& table = frame_.passes[pass_].table;
    const PacketSamples::Painted& painted = seen_.painted;
    for (std::size_t n = 0; n < count_; ++n) {
        if (!(painted.weight[n] > 0)) continue;
        const LinearStyle& style = table[static_cast<volume::Scalar>(painted.scalar[n])];
        const double depth = painted.depth[n];
        const Vec3d origin{rays_.origin[0][n], rays_.origin[1][n], rays_.origin[2][n]};
        const Vec3d direction{rays_.direction[0][n], rays_.direction[1][n], rays_.direction[2][n]};
        const Vec3f color =
            volume.paint->colorAt({static_cast<std::uint32_t>(pass_),
                                   style.label,
                                   depth,
                                   volume.grid.worldFromIndex(origin + direction * depth - Vec3d{0.5, 0.5, 0.5}),
                                   {painted.normal[0][n], painted.normal[1][n], painted.normal[2][n]},
                                   painted.isCap[n] != 0,
                                   style.color});
        for (int channel = 0; channel < 3; ++channel)
            seen_.color[channel][n] += double(color[channel]) * painted.weight[n];
    }
}

// Casts the intervals that the clips leave: in round n, interval n of each ray.
void PacketCaster::castIntervals(PacketPass& packetPass) {
    parts_.clear();
    std::size_t most = 0;
    const PassShapes& shapes = frame_.passes[pass_].shapes;
    const bool hasShapes = !shapes.isEmpty() && shapes.hasAnyNear(rays_.u.data(), rays_.v.data(), count_);
    if (hasShapes && withColor_ && !shapes.lines().empty())
        for (std::size_t block = 0; block < count_; block += kLineRays) findLines(block);
    if (frame_.passes[pass_].clipper.isEmpty()) {
        caps_.fill({});
        spans_.from = rays_.from;
        spans_.to = rays_.to;
        spans_.capped.fill(0);
        for (std::size_t n = 0; n < count_ && hasShapes && shapes.hasTriangles(); ++n) {
            const DrawnInterval whole{spans_.from[n], spans_.to[n], {}};
            if (whole.from < whole.to) spans_.to[n] = std::min(whole.to, findSurfaces(n, std::span(&whole, 1)));
        }
        packetPass.hasFragments = hasShapes_ && !fragments_.items.empty();
        walkVisible(packetPass);
        addLastFragments();
        return;
    }
    for (std::size_t n = 0; n < count_; ++n) {
        rayIntervals_[n].next = parts_.size();
        findIntervals(n);
        rayIntervals_[n].end = parts_.size();
        most = std::max(most, rayIntervals_[n].end - rayIntervals_[n].next);
    }
    packetPass.hasFragments = hasShapes_ && !fragments_.items.empty();
    for (std::size_t part = 0; part < most; ++part) {
        spans_.from.fill(0);
        spans_.to.fill(0);
        spans_.capped.fill(0);
        for (std::size_t n = 0; n < count_; ++n) {
            if (part >= rayIntervals_[n].end - rayIntervals_[n].next) continue;
            const DrawnInterval& interval = parts_[rayIntervals_[n].next + part];
            spans_.from[n] = interval.from;
            spans_.to[n] = interval.to;
            caps_[n] = interval.cap;
            spans_.capped[n] = interval.cap ? 1 : 0;
        }
        walkVisible(packetPass);
    }
    addLastFragments();
}

// Walks the spans, cut to the pass's hull. A span that starts later because of the hull starts among hidden voxels, so
// it has no cap.
void PacketCaster::walkVisible(const PacketPass& packetPass) {
    const auto [from, to] = visible_[pass_];
    if (!(from < to)) return;
    for (std::size_t n = 0; n < kPacketRays; ++n) {
        if (spans_.from[n] < from) spans_.capped[n] = 0;
        spans_.from[n] = std::max(spans_.from[n], from);
        spans_.to[n] = std::min(spans_.to[n], to);
    }
    walkPacket(packetPass, rays_, spans_, this, seen_);
}

// Blends the fragments behind all voxels.
void PacketCaster::addLastFragments() {
    if (!hasShapes_ || fragments_.items.empty()) return;
    for (std::size_t n = 0; n < count_; ++n)
        while (seen_.isDone[n] == 0 && rayFragments_[n].next < rayFragments_[n].end) addFragment(n);
}

// Finds the lines that kLineRays rays meet; these are their first fragments. Unused places of the packet repeat ray 0.
void PacketCaster::findLines(std::size_t block) {
    std::array<std::size_t, kLineRays + 1> starts;
    const auto hits = finder_.findLines(pass_, rays_.u.data() + block, rays_.v.data() + block, starts);
    if (hits.empty()) return;
    for (std::size_t n = 0; n < std::min(kLineRays, count_ - block); ++n) {
        Range& found = rayFragments_[block + n];
        found.next = fragments_.items.size();
        finder_.addLines(pass_, hits.subspan(starts[n], starts[n + 1] - starts[n]), fragments_);
        found.end = fragments_.items.size();
        if (found.next < found.end) seen_.nextFragment[block + n] = fragments_.items[found.next].depth;
    }
}

// Finds the intervals that the clips leave of a ray, up to the first opaque triangle.
void PacketCaster::findIntervals(std::size_t ray) {
    const RaySpan span{rays_.from[ray], rays_.to[ray]};
    if (!(span.from < span.to)) return;
    const Clipper& clipper = frame_.passes[pass_].clipper;
    const std::size_t first = parts_.size();
    const auto of = [ray](const Lanes<double>(&lanes)[3]) {
        return Vec3d{lanes[0][ray], lanes[1][ray], lanes[2][ray]};
    };
    const DrawnIntervals drawn = clipper.cut(of(rays_.origin), of(rays_.direction), span);
    parts_.insert(parts_.end(), drawn.begin(), drawn.end());
    if (!frame_.passes[pass_].shapes.hasTriangles()) return;
    const double end = findSurfaces(ray, std::span(parts_).subspan(first));
    for (std::size_t part = first; part < parts_.size(); ++part) parts_[part].to = std::min(parts_[part].to, end);
}

// Adds the triangles that a ray meets to its fragments.
// \return depth of the first opaque one, where the ray ends; infinity if there is none
double PacketCaster::findSurfaces(std::size_t ray, std::span<const DrawnInterval> drawn) {
    const double u = rays_.u[ray], v = rays_.v[ray];
    if (!frame_.passes[pass_].shapes.hasTriangles(u, v)) return std::numeric_limits<double>::infinity();
    // The fragments of a ray must be contiguous: copy those found so far to the end.
    Range& found = rayFragments_[ray];
    const std::size_t begin = fragments_.items.size();
    for (std::size_t f = found.next; f < found.end; ++f) fragments_.items.push_back(Fragment(fragments_.items[f]));
    const double end = finder_.addSurfaces(pass_, u, v, frame_.volumeOf(pass_).rays.at(u, v), drawn, begin, fragments_);
    found = {begin, fragments_.items.size()};
    if (found.next < found.end) seen_.nextFragment[ray] = fragments_.items[found.next].depth;
    return end;
}

void PacketCaster::blendFragment(void* context, std::size_t ray) {
    static_cast<PacketCaster*>(context)->addFragment(ray);
}

// As RunShader::addFragment().
void PacketCaster::addFragment(std::size_t ray) {
    Range& found = rayFragments_[ray];
    const Fragment& fragment = fragments_.items[found.next++];
    seen_.nextFragment[ray] =
        found.next < found.end ? fragments_.items[found.next].depth : std::numeric_limits<double>::infinity();
    Vec3d color{seen_.color[0][ray], seen_.color[1][ray], seen_.color[2][ray]};
    blend(fragment, color, seen_.transmittance[ray], seen_.lines[ray]);
    for (int channel = 0; channel < 3; ++channel) seen_.color[channel][ray] = color[channel];
    const double opacity = 1 - seen_.transmittance[ray];
    const bool hasHit = seen_.depth[ray] < std::numeric_limits<double>::infinity();
    if (!fragment.isLine() && !hasHit && opacity > double(frame_.options.labelAt)) {
        const SurfaceFragment& surface = fragments_.surfaces[static_cast<std::size_t>(fragment.surface)];
        seen_.label[ray] = surface.label;
        seen_.object[ray] = surface.object;
        seen_.depth[ray] = fragment.depth;
        for (int axis = 0; axis < 3; ++axis) seen_.normal[axis][ray] = surface.normal[axis];
        seen_.isCap[ray] = surface.isCap ? 1 : 0;
    }
    const bool isDone = withColor_ ? opacity >= double(frame_.options.opaqueAt)
                                   : seen_.depth[ray] < std::numeric_limits<double>::infinity();
    if (isDone) seen_.isDone[ray] = -1;
}

// Writes the sample in place: copying it right after writing would stall on store forwarding.
void PacketCaster::writeSample(std::size_t ray, Sample& sample) const noexcept {
    sample = Sample();
    sample.depth = static_cast<float>(seen_.depth[ray]);
    if (sample.hasHit()) {
        sample.label = static_cast<volume::Scalar>(seen_.label[ray]);
        sample.object = static_cast<std::uint32_t>(seen_.object[ray]);
        sample.normal = toFloat({seen_.normal[0][ray], seen_.normal[1][ray], seen_.normal[2][ray]});
        sample.isCap = seen_.isCap[ray] != 0;
        sample.volume = frame_.passes[pass_].volume;
    }
    finishSample({seen_.color[0][ray], seen_.color[1][ray], seen_.color[2][ray]},
                 hasShapes_ ? seen_.transmittance[ray] * seen_.lines[ray] : seen_.transmittance[ray], frame_.options,
                 sample);
    if (hasShapes_ && rayFragments_[ray].next < rayFragments_[ray].end) {
        const Range& found = rayFragments_[ray];
        drawHidden(std::span(fragments_.items).subspan(found.next, found.end - found.next), sample);
    }
    if (sample.isCap) hatchCap(frame_, pass_, rays_.u[ray], rays_.v[ray], sample);
    if (frame_.spec.passes[pass_].hasCells) drawCellEdges(frame_, pass_, rays_.u[ray], rays_.v[ray], sample);
}

double PacketCaster::shareOfLight(void* context, const PacketPoint& point) {
    auto& caster = *static_cast<PacketCaster*>(context);
    const std::size_t n = point.lane;
    const PacketRays& rays = caster.rays_;
    const auto of = [n](const Lanes<double>(&lanes)[3]) { return Vec3d{lanes[0][n], lanes[1][n], lanes[2][n]}; };
    const SurfaceLight light(caster.frame_, caster.pass_, caster.cache_);
    return light.unshaded(of(rays.origin) + of(rays.direction) * point.from, point.normal);
}

Surface PacketCaster::shadeSurface(void* context, const PacketSurface& surface) {
    auto& caster = *static_cast<PacketCaster*>(context);
    const std::size_t n = surface.lane;
    const PacketRays& rays = caster.rays_;
    const auto of = [n](const Lanes<double>(&lanes)[3]) { return Vec3d{lanes[0][n], lanes[1][n], lanes[2][n]}; };
    const SurfaceLight light(caster.frame_, caster.pass_, caster.cache_);
    const LinearStyle& style = caster.frame_.passes[caster.pass_].table[static_cast<volume::Scalar>(surface.scalar)];
    const SurfaceHit hit{surface.from,
                         of(rays.origin),
                         of(rays.direction),
                         of(rays.view),
                         surface.voxel,
                         surface.axis,
                         static_cast<std::uint32_t>(surface.plane),
                         surface.isVoxel,
                         surface.from == caster.spans_.from[n] ? caster.caps_[n] : CapFace{}};
    // Opaque surfaces are lit by the kernel.
    return style.kind == Kind::Opaque ? light.findNormal(style, hit) : light.at(style, hit);
}

}  // namespace svt::render
