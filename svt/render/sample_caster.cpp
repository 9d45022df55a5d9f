#include <svt/render/sample_caster.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

using Kind = LinearStyle::Kind;

// exp(-x) for x >= 0 by basic arithmetic alone, so that every machine and compiler gives the same bits. With n the
// whole part of x / ln 2, exp(-x) = 2^-n * exp(-r)^2, r < ln(2) / 2, and exp(-r) by its Taylor polynomial; error below
// 1e-8.
float expOfMinus(double x) noexcept {
    if (!(x < 80)) return 0;
    const double halvings = x * 1.4426950408889634;
    const int n = static_cast<int>(halvings);
    const double r = (halvings - n) * 0.34657359027997264;
    double sum = 1 - r * (1.0 / 7);
    sum = 1 - sum * r * (1.0 / 6);
    sum = 1 - sum * r * (1.0 / 5);
    sum = 1 - sum * r * (1.0 / 4);
    sum = 1 - sum * r * (1.0 / 3);
    sum = 1 - sum * r * (1.0 / 2);
    sum = 1 - sum * r;
    return static_cast<float>(std::ldexp(sum * sum, -n));
}

Vec3f unit(Vec3d v) noexcept {
    const Vec3d n = normalized(v);
    return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

// Where a run begins, and how it is lit there.
struct Surface {
    Vec3f normal{};
    bool isCap = false;
    float light = 1;
};

// Takes the runs of one ray under one pass.
class RunShader {
public:
    RunShader(const Scene& scene, std::size_t pass, NormalCache& cache, const CameraRay& ray, bool withColor)
        : scene_(scene),
          pass_(scene.passes[pass]),
          passNumber_(pass),
          cache_(cache),
          ray_(ray),
          withColor_(withColor) {}

    void beginInterval(const DrawnInterval& interval) noexcept {
        interval_ = &interval;
        previousObject_ = kNoObject;
    }

    bool enter(volume::Scalar scalar, double from, const RunStart& start) {
        const LinearStyle& style = pass_.table[scalar];
        if (style.kind == Kind::Hidden) {
            previousObject_ = kNoObject;
            return false;
        }
        const bool isNewObject = style.object != previousObject_;
        previousObject_ = style.object;
        if (withColor_ && isNewObject) surface_ = surfaceAt(style, from, start);
        if (style.kind == Kind::Translucent) return false;
        add(style, 1, from);
        return true;
    }

    bool leave(volume::Scalar scalar, double from, double to) {
        const LinearStyle& style = pass_.table[scalar];
        if (style.kind == Kind::Hidden) return false;
        add(style, 1 - expOfMinus(style.density * (to - from) * ray_.metresPerT), from);
        return isDone();
    }

    [[nodiscard]] bool isDone() const noexcept {
        const float opacity = 1 - transmittance_;
        return withColor_ ? opacity >= scene_.options.opaqueAt : sample_.hasHit();
    }

    [[nodiscard]] Sample result() const noexcept {
        Sample sample = sample_;
        sample.alpha = 1 - transmittance_;
        // What is left behind a ray that ended early is not seen.
        if (sample.alpha >= scene_.options.opaqueAt && sample.alpha < 1) {
            sample.color = sample.color * (1 / sample.alpha);
            sample.alpha = 1;
        }
        return sample;
    }

private:
    static constexpr std::uint64_t kNoObject = ~std::uint64_t{0};

    void add(const LinearStyle& style, float alpha, double from) {
        const float share = transmittance_ * alpha;
        const float light = 1 + (surface_.light - 1) * style.surface;
        sample_.color = sample_.color + style.color * (share * light);
        transmittance_ -= share;
        if (!sample_.hasHit() && 1 - transmittance_ > scene_.options.labelAt) {
            sample_.label = style.label;
            sample_.object = style.object;
            sample_.depth = static_cast<float>(from);
            sample_.normal = surface_.normal;
            sample_.isCap = surface_.isCap;
        }
    }

    // Glass has the normal of the plane or voxel face that it begins with. For a body, the voxels around tell how deep
    // in a corner it lies, and, where there is no plane, its slope.
    Surface surfaceAt(const LinearStyle& style, double from, const RunStart& start) {
        if (interval_->capPlane != nullptr && from == interval_->from) {
            const Vec3d normal = interval_->capPlane->normal;
            return litSurface(unit(dot(normal, ray_.direction) > 0 ? -normal : normal), from,
                              SurfaceNormal::kPlaneCoverage, style.isBody, true);
        }
        const bool isOblique = start.plane != volume::BrickVolume::kNoPlane;
        const int axis = isOblique ? -1 : ray_.index.entryAxis(from, start.cell);
        if (!isOblique && axis < 0)  // the eye is inside
            return litSurface(unit(-ray_.direction), from, SurfaceNormal::kPlaneCoverage, false, false);
        float coverage = SurfaceNormal::kPlaneCoverage;
        Vec3d index{};
        if (!isOblique) index[axis] = -ray_.index.step[axis];
        if (isOblique) {
            const Vec3d normal = scene_.volume.oblique()[start.plane].normal;
            index = dot(normal, ray_.index.direction) > 0 ? -normal : normal;
        }
        if (style.isBody) {
            const SurfaceNormal& found = normalAt(style, start.cell, isOblique ? longestAxis(index) : axis);
            coverage = found.coverage;
            if (!isOblique) index = {found.indexNormal.x, found.indexNormal.y, found.indexNormal.z};
        }
        return litSurface(unit(worldNormal(index)), from, coverage, style.isBody, false);
    }

    [[nodiscard]] Vec3d worldNormal(Vec3d index) const noexcept {
        Vec3d normal{};
        for (int a = 0; a < 3; ++a)
            normal = normal + scene_.grid.axes()[static_cast<std::size_t>(a)] * (index[a] / scene_.grid.spacing()[a]);
        return normal;
    }
    [[nodiscard]] static int longestAxis(Vec3d v) noexcept {
        const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
        return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    }
    Surface litSurface(Vec3f normal, double from, float coverage, bool isBody, bool isCap) const {
        return {normal, isCap, lightOn(normal, from, coverage, isBody)};
    }

    const SurfaceNormal& normalAt(const LinearStyle& style, Vec3i cell, int axis) {
        const int sign = -ray_.index.step[axis];
        const auto part = [](std::int32_t c, int shift) { return static_cast<std::uint64_t>(c) << shift; };
        // 17 bits a coordinate, 3 the face, 6 the pass, 1 the kind of body.
        const std::uint64_t key = part(cell.x, 0) | part(cell.y, 17) | part(cell.z, 34) |
                                  part(2 * axis + (sign > 0 ? 1 : 0), 51) | part(std::int32_t(passNumber_), 54) |
                                  part(style.isBody ? 1 : 0, 60);
        NormalCache::Slot& slot = cache_.slot(key);
        if (slot.key != key) {
            slot.key = key;
            const PassTable& table = pass_.table;
            if (style.isBody) {
                slot.normal = surfaceNormal(scene_.volume, cell, axis, sign,
                                            [&](volume::Scalar scalar) { return table[scalar].isBody; });
            } else {
                slot.normal = surfaceNormal(scene_.volume, cell, axis, sign, [&](volume::Scalar scalar) {
                    const LinearStyle& other = table[scalar];
                    return other.kind != Kind::Hidden && other.object == style.object;
                });
            }
        }
        return slot.normal;
    }

    // Key light, sky and a little light from the viewer; corners get less of all.
    float lightOn(Vec3f normal, double t, float coverage, bool isBody) const {
        const Light& light = scene_.spec.light;
        float open = 1;
        if (light.ambientOcclusion > 0 && isBody) {
            const Vec3d world{normal.x, normal.y, normal.z};
            Vec3d away = scene_.grid.indexFromWorldDirection(world);
            const double longest = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
            if (longest > 0) away = away / longest;
            const Vec3d at = ray_.index.origin + ray_.index.direction * t;
            const Vec3f point{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
            const Vec3f outward{static_cast<float>(away.x), static_cast<float>(away.y), static_cast<float>(away.z)};
            const float crease = std::clamp((coverage - SurfaceNormal::kPlaneCoverage - 0.05f) * 2.5f, 0.0f, 1.0f);
            const float occlusion = std::min(1.0f, pass_.occlusion.occlusion(point, outward) + 0.35f * crease);
            open = 1 - light.ambientOcclusion * occlusion;
        }
        const Vec3f view = unit(-ray_.direction);
        const float key = std::max(0.0f, dot(normal, scene_.towardsLight));
        const float facing = std::max(0.0f, dot(normal, view));
        const float sky = 0.80f + 0.20f * normal.z;
        return light.ambient * open * (0.82f * sky + 0.18f * facing) + light.key * key * (0.45f + 0.55f * open);
    }

    const Scene& scene_;
    const PreparedPass& pass_;
    std::size_t passNumber_;
    NormalCache& cache_;
    const CameraRay& ray_;
    bool withColor_;
    const DrawnInterval* interval_ = nullptr;
    std::uint64_t previousObject_ = kNoObject;
    Surface surface_;
    Sample sample_;
    float transmittance_ = 1;
};

// `front` drawn over `back`; label and depth are the front's where it has any.
Sample over(const Sample& front, const Sample& back) noexcept {
    Sample joined = front.hasHit() ? front : back;
    joined.color = front.color + back.color * (1 - front.alpha);
    joined.alpha = front.alpha + back.alpha * (1 - front.alpha);
    return joined;
}

Sample joinPass(Pass::Join join, const Sample& pass, const Sample& before) noexcept {
    switch (join) {
        case Pass::Join::Replace: return pass.alpha > 0 ? pass : before;
        case Pass::Join::Depth: return pass.depth <= before.depth ? over(pass, before) : over(before, pass);
        case Pass::Join::Over: break;
    }
    return over(pass, before);
}

}  // namespace

Sample SampleCaster::cast(double u, double v, bool withColor) {
    Sample joined;
    const CameraRay ray = scene_.rays.at(u, v);
    const RaySpan span = spanInVolume(ray.index, scene_.volume.dimension());
    if (!(span.from < span.to)) return joined;
    for (std::size_t n = 0; n < scene_.passes.size(); ++n) {
        const PreparedPass& pass = scene_.passes[n];
        RunShader shader(scene_, n, cache_, ray, withColor);
        for (const DrawnInterval& interval : pass.clipper.cut(ray.index, span)) {
            shader.beginInterval(interval);
            if (scene_.isReference)
                walkRunsReference(scene_.volume, ray.index, interval.from, interval.to, shader);
            else
                walkRuns(scene_.volume, ray.index, interval.from, interval.to, shader);
            if (shader.isDone()) break;
        }
        joined = n == 0 ? shader.result() : joinPass(pass.join, shader.result(), joined);
    }
    return joined;
}

}  // namespace svt::render
