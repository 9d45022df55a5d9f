#include <svt/render/light/cap_hatch.hpp>
#include <svt/render/light/cell_edges.hpp>
#include <svt/render/light/fragments.hpp>
#include <svt/render/light/surface_light.hpp>
#include <svt/render/plain/sample_caster.hpp>
#include <svt/render/walk/run_walk.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace svt::render {
namespace {

using Kind = LinearStyle::Kind;

// exp(-x) for x >= 0 by only basic arithmetic, so that every machine and compiler gives the same bits. With n the
// integer nearest to x / ln 2, exp(-x) = 2^-n * exp(-r)^2, |r| <= ln(2) / 4; exp(-r) by its Taylor polynomial,
// evaluated by Estrin's scheme for a short dependency chain. Relative error below 1e-7.
double expOfMinus(double x) noexcept {
    if (!(x < 80)) return 0;
    const double halvings = x * 1.4426950408889634;
    const auto n = static_cast<std::int64_t>(halvings + 0.5);
    const double r = (halvings - static_cast<double>(n)) * 0.34657359027997264;
    const double square = r * r;
    const double sum = (1 - r) + square * ((0.5 - r * (1.0 / 6)) + square * (1.0 / 24 - r * (1.0 / 120)));
    return sum * sum * std::bit_cast<double>((1023 - n) << 52);
}

// Shades the runs of one ray under one pass, front to back; a visitor of walkRuns().
class RunShader {
public:
    RunShader(const PreparedFrame& frame, std::size_t pass, NormalCache& cache, const CameraRay& ray,
              const Fragments& fragments, bool withColor)
        : frame_(frame),
          pass_(frame.passes[pass]),
          passNumber_(pass),
          paint_(frame.volumeOf(pass).paint),
          surfaceLight_(frame, pass, cache),
          ray_(ray),
          fragments_(fragments.items),
          surfaces_(fragments.surfaces),
          withColor_(withColor) {}

    void beginInterval(const DrawnInterval& interval) noexcept {
        interval_ = &interval;
        previousObject_ = kNoObject;
    }

    bool enter(volume::Scalar scalar, double from, const RunStart& start) {
        if (addFragments(from)) return true;
        const LinearStyle& style = pass_.table[scalar];
        if (style.kind == Kind::Hidden) {
            previousObject_ = kNoObject;
            return false;
        }
        const bool isNewObject = style.object != previousObject_;
        previousObject_ = style.object;
        if (withColor_ && isNewObject)
            surface_ = surfaceLight_.at(
                style, {from, ray_.voxelRay.origin, ray_.voxelRay.direction, normalized(-ray_.direction), start.voxel,
                        ray_.voxelRay.entryAxis(from, start.voxel), start.plane, start.isVoxel,
                        from == interval_->from ? interval_->cap : CapFace{}, start.normal});
        if (style.kind == Kind::Translucent) return false;
        if (paint_ != nullptr && withColor_)
            add(painted(style, from), 1, from);
        else
            add(style, 1, from);
        hasEnded_ = true;
        return true;
    }

    bool leave(volume::Scalar scalar, double from, double to) {
        const LinearStyle& style = pass_.table[scalar];
        if (style.kind == Kind::Hidden) return addFragments(to);
        auto addUpTo = [&, begin = from](double end) mutable {
            add(style, 1 - expOfMinus(double(style.density) * (end - begin) * ray_.metresPerT), from);
            begin = end;
            return isDone();
        };
        while (next_ < fragments_.size() && fragments_[next_].depth <= to)
            if (addUpTo(fragments_[next_].depth) || addFragment()) return true;
        return addUpTo(to);
    }

    /// Blends the fragments behind all voxels.
    void finish() { addFragments(std::numeric_limits<double>::infinity()); }

    [[nodiscard]] bool isDone() const noexcept {
        if (hasEnded_) return true;
        return withColor_ ? 1 - transmittance_ >= double(frame_.options.opaqueAt) : sample_.hasHit();
    }

    [[nodiscard]] Sample result() const noexcept {
        Sample sample = sample_;
        finishSample(color_, transmittance_ * lines_, frame_.options, sample);
        sample.hasLine = lines_ < 1;
        drawHidden(fragments_.subspan(next_), sample);
        return sample;
    }

private:
    static constexpr std::uint64_t kNoObject = ~std::uint64_t{0};

    // Blends the fragments up to `depth`, outside of runs; true ends the ray.
    bool addFragments(double depth) {
        while (!isDone() && next_ < fragments_.size() && fragments_[next_].depth <= depth)
            if (addFragment()) return true;
        return isDone();
    }
    // Blends the next fragment; true ends the ray.
    bool addFragment() {
        const Fragment& fragment = fragments_[next_++];
        blend(fragment, color_, transmittance_, lines_);
        if (!fragment.isLine() && !sample_.hasHit() && 1 - transmittance_ > double(frame_.options.labelAt)) {
            const SurfaceFragment& surface = surfaces_[static_cast<std::size_t>(fragment.surface)];
            sample_.label = surface.label;
            sample_.object = surface.object;
            sample_.depth = static_cast<float>(fragment.depth);
            sample_.normal = toFloat(surface.normal);
            sample_.isCap = surface.isCap;
        }
        return isDone();
    }

    // The style with the colour of the surface's place.
    [[nodiscard]] LinearStyle painted(const LinearStyle& style, double from) const {
        LinearStyle own = style;
        const Vec3d index = ray_.voxelRay.origin + ray_.voxelRay.direction * from - Vec3d{0.5, 0.5, 0.5};
        own.color = paint_->colorAt({static_cast<std::uint32_t>(passNumber_), style.label, from,
                                     frame_.volumeOf(passNumber_).grid.worldFromIndex(index), surface_.normal,
                                     surface_.isCap, style.color});
        return own;
    }

    void add(const LinearStyle& style, double alpha, double from) {
        const double share = transmittance_ * alpha;
        const double light = 1 + (surface_.light - 1) * double(style.surface);
        color_ = color_ + Vec3d{style.color.x, style.color.y, style.color.z} * (share * light * lines_);
        transmittance_ -= share;
        if (!sample_.hasHit() && 1 - transmittance_ > double(frame_.options.labelAt)) {
            sample_.label = style.label;
            sample_.object = style.object;
            sample_.depth = static_cast<float>(from);
            sample_.normal = toFloat(surface_.normal);
            sample_.isCap = surface_.isCap;
        }
    }

    const PreparedFrame& frame_;
    const PreparedPass& pass_;
    std::size_t passNumber_;
    const SurfacePaint* paint_;
    SurfaceLight surfaceLight_;
    const CameraRay& ray_;
    std::span<const Fragment> fragments_;
    std::span<const SurfaceFragment> surfaces_;
    std::size_t next_ = 0;  // the first fragment that is not blended yet
    bool withColor_;
    bool hasEnded_ = false;
    const DrawnInterval* interval_ = nullptr;
    std::uint64_t previousObject_ = kNoObject;
    Surface surface_;
    Sample sample_;
    Vec3d color_{};
    double transmittance_ = 1, lines_ = 1;  // transmittance of voxels and surfaces, and of lines
};

// Shades the runs of a RunSource.
class SourceShader final : public RunVisitor {
public:
    SourceShader(const PassTable& table, RunShader& shader) : table_(table), shader_(shader) {}
    [[nodiscard]] bool isDrawn(volume::Scalar scalar) const override { return table_[scalar].kind != Kind::Hidden; }
    bool enter(volume::Scalar scalar, double from, const RunStart& start) override {
        return shader_.enter(scalar, from, start);
    }
    bool leave(volume::Scalar scalar, double from, double to) override { return shader_.leave(scalar, from, to); }

private:
    const PassTable& table_;
    RunShader& shader_;
};

}  // namespace

SampleCaster::SampleCaster(const PreparedFrame& frame)
    : frame_(frame),
      finder_(frame.hasShapes ? std::make_unique<FragmentFinder>(frame) : nullptr),
      fragments_(std::make_unique<Fragments>()) {
    const PictureSize size = frame.isReference ? PictureSize{} : PictureSize{frame.spec.width, frame.spec.height};
    for (const PreparedVolume& volume : frame.volumes)
        walkers_.push_back(volume.source != nullptr ? volume.source->makeWalker(volume.bricks, volume.rays, size)
                                                    : nullptr);
}
SampleCaster::~SampleCaster() = default;

Sample SampleCaster::cast(double u, double v, bool withColor) {
    Sample joined;
    std::vector<Sample> parts;
    std::size_t head = 0;  // the pass to which the parts belong
    for (std::size_t n = 0; n < frame_.passes.size(); ++n) {
        const PreparedPass& pass = frame_.passes[n];
        const PreparedVolume& volume = frame_.volumes[pass.volume];
        const CameraRay ray = volume.rays.at(u, v);
        const RaySpan span = spanInVolume(ray.voxelRay, volume.bricks.dimension());
        const DrawnIntervals drawn = pass.clipper.cut(ray.voxelRay, span);
        fragments_->clear();
        double end = std::numeric_limits<double>::infinity();
        if (!pass.shapes.isEmpty()) {
            if (withColor) finder_->addLines(n, finder_->findLines(n, u, v), *fragments_);
            end = finder_->addSurfaces(n, u, v, ray, {drawn.begin(), drawn.end()}, 0, *fragments_);
        }
        RunShader shader(frame_, n, cache_, ray, *fragments_, withColor);
        for (DrawnInterval interval : drawn) {
            interval.to = std::min(interval.to, end);
            if (!(interval.from < interval.to)) break;
            shader.beginInterval(interval);
            if (walkers_[pass.volume] != nullptr) {
                SourceShader runs(pass.table, shader);
                walkers_[pass.volume]->walk(u, v, ray, interval.from, interval.to, runs);
            } else if (frame_.isReference)
                walkRunsReference(volume.bricks, ray.voxelRay, interval.from, interval.to, shader);
            else
                walkRuns(volume.bricks, ray.voxelRay, interval.from, interval.to, shader);
            if (shader.isDone()) break;
        }
        shader.finish();
        Sample sample = shader.result();
        sample.volume = pass.volume;
        if (sample.isCap) hatchCap(frame_, n, u, v, sample);
        if (frame_.spec.passes[n].hasCells) drawCellEdges(frame_, n, u, v, sample);
        if (pass.join != Pass::Join::Part) head = n;
        if (n > 0 && head == n) parts.clear();
        parts.push_back(sample);
        if (n + 1 < frame_.passes.size() && frame_.passes[n + 1].join == Pass::Join::Part) continue;
        if (parts.size() > 1) {
            std::vector<const Sample*> ordered;
            for (const Sample& part : parts) ordered.push_back(&part);
            sample = joinParts(ordered);
        }
        if (head == 0)
            joined = sample;
        else
            joinPass(frame_.passes[head].join, head, sample, joined);
    }
    return joined;
}

std::unique_ptr<PointCaster> makeSampleCaster(const PreparedFrame& frame) {
    return std::make_unique<SampleCaster>(frame);
}

}  // namespace svt::render
