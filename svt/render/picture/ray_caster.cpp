#include <svt/core/parallel.hpp>
#include <svt/image/color.hpp>
#include <svt/render/picture/tile_renderer.hpp>
#include <svt/render/plain/sample_caster.hpp>
#include <svt/render/ray_caster.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace svt::render {
namespace {

Result<void> checkCall(std::span<const DrawnVolume> volumes, const FrameSpec& spec, const CastOptions& options) {
    SVT_DO(checkFrameSpec(spec));
    if (volumes.empty() || volumes.size() > FrameSpec::kMaxPasses)
        return Error(Code::BadArgument,
                     fmt::format("{} volumes to draw; 1 to {} are possible", volumes.size(), FrameSpec::kMaxPasses));
    for (const DrawnVolume& volume : volumes)
        if (volume.bricks().dimension() != volume.grid().dimension())
            return Error(Code::BadArgument, "the grid and the volume have different dimensions");
    for (std::size_t n = 0; n < spec.passes.size(); ++n)
        if (spec.passes[n].volume >= volumes.size())
            return Error(Code::BadFrame, fmt::format("pass {} draws volume {}, but there are {}; the first is 0", n,
                                                     spec.passes[n].volume, volumes.size()));
    if (!(options.opaqueAt > 0 && options.opaqueAt <= 1) || !(options.labelAt >= 0 && options.labelAt < 1))
        return Error(Code::BadArgument,
                     fmt::format("opaqueAt of {} or labelAt of {} is out of range; (0, 1] and [0, 1) are "
                                 "possible",
                                 options.opaqueAt, options.labelAt));
    return {};
}

Vec3d towardsLight(const Light& light, const CameraRays& rays) {
    Vec3d direction = light.direction;
    if (light.space == Light::Space::Camera)
        direction = rays.right() * direction.x + rays.up() * direction.y - rays.forward() * direction.z;
    return normalized(direction);
}

// Bounds of the volume's box in the picture, one pixel wider; the whole picture if the box reaches the eye plane.
PixelRect drawnPixels(const CameraRays& rays, const volume::Grid& grid, const FrameSpec& spec) {
    const PixelRect whole{0, 0, static_cast<double>(spec.width), static_cast<double>(spec.height)};
    PixelRect rect{kInfinity, kInfinity, -kInfinity, -kInfinity};
    const Vec3i n = grid.dimension();
    double nearest = kInfinity, farthest = -kInfinity;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d index{(corner & 1) * n.x - 0.5, ((corner >> 1) & 1) * n.y - 0.5, (corner >> 2) * n.z - 0.5};
        const Vec3d seen = rays.seenAt(grid.worldFromIndex(index) - spec.camera.eye);
        const double x = (seen.x + 1) / 2 * spec.width, y = (1 - seen.y) / 2 * spec.height;
        rect = {std::min(rect.left, x - 1), std::min(rect.top, y - 1), std::max(rect.right, x + 1),
                std::max(rect.bottom, y + 1)};
        nearest = std::min(nearest, seen.z);
        farthest = std::max(farthest, seen.z);
    }
    return rays.isPerspective() && !(nearest > 1e-3 * (farthest - nearest)) ? whole : rect;
}

// Whether each voxel is at least one pixel wide, at the volume's greatest depth.
bool arePixelsFine(const CameraRays& rays, const volume::Grid& grid, const FrameSpec& spec) {
    double farthest = 0;
    const Vec3i n = grid.dimension();
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d index{(corner & 1) * n.x - 0.5, ((corner >> 1) & 1) * n.y - 0.5, (corner >> 2) * n.z - 0.5};
        farthest = std::max(farthest, dot(grid.worldFromIndex(index) - spec.camera.eye, rays.forward()));
    }
    const Vec3d spacing = grid.spacing();
    return rays.pixelSize(farthest) <= std::min({spacing.x, spacing.y, spacing.z});
}

PassTable tableOf(const Pass& pass, const FrameSpec& spec, const DrawnVolume& volume) {
    if (volume.level() != nullptr) return PassTable(pass, spec.objectOfScalar, *volume.level());
    const std::uint64_t ofSource = volume.source() == nullptr ? 0 : volume.source()->scalarCount();
    return PassTable(pass, spec.objectOfScalar, std::max(volume.bricks().scalarCount(), ofSource));
}

Result<PreparedPass> preparedPass(const Pass& pass, const PreparedFrame& frame, const DrawnVolume& drawn) {
    const FrameSpec& spec = frame.spec;
    const PreparedVolume& volume = frame.volumes[pass.volume];
    const int threads = frame.options.threads;
    PreparedPass prepared{
        tableOf(pass.triangles.empty() ? pass : makeVoxelPass(pass, spec.objectOfScalar), spec, drawn),
        Clipper(pass.clips, volume.grid),
        {},
        pass.join,
        static_cast<std::uint8_t>(pass.volume)};
    SVT_TRY(shapes, PassShapes::make(pass, spec, volume.rays, volume.grid, prepared.clipper, frame.lineSamples,
                                     SampleLayout(spec).blockMargin(frame.isAdaptive), threads));
    prepared.shapes = std::move(*shapes);
    if (!frame.isReference) prepared.hull = VisibleHull(volume.bricks, prepared.table, volume.rays, threads);
    if (spec.light.ambientOcclusion > 0 && prepared.table.hasOpaque()) {
        const PassTable& table = prepared.table;
        prepared.occlusion = OcclusionField(
            volume.bricks, volume.voxelSize, [&table](volume::Scalar scalar) { return table[scalar].isBody; },
            prepared.clipper, threads);
    }
    return prepared;
}

Result<PreparedFrame> prepareFrame(std::span<const DrawnVolume> volumes, const FrameSpec& spec,
                                   const CastOptions& options, bool isReference) {
    PreparedFrame frame{.spec = spec, .options = options, .isReference = isReference, .isAdaptive = options.isAdaptive};
    frame.drawn = {kInfinity, kInfinity, -kInfinity, -kInfinity};
    for (const DrawnVolume& drawn : volumes) {
        const PreparedVolume& volume = frame.volumes.emplace_back(drawn, spec);
        frame.drawn.include(drawnPixels(volume.rays, volume.grid, spec));
        frame.isAdaptive = frame.isAdaptive && arePixelsFine(volume.rays, volume.grid, spec);
    }
    if (!frame.isAdaptive) frame.lineSamples = std::round(std::sqrt(spec.samplesPerPixel));
    frame.towardsLight = towardsLight(spec.light, frame.rays());
    if (spec.light.hasShadows && spec.light.key > 0) {
        SVT_TRY(shadows, ShadowMaps::make(volumes, spec, frame.towardsLight, options));
        frame.shadows = std::move(*shadows);
    }
    frame.hatchColor = image::linearFromSrgb(spec.hatches.color);
    for (const Pass& pass : spec.passes) {
        SVT_TRY(prepared, preparedPass(pass, frame, volumes[pass.volume]));
        frame.hasShapes = frame.hasShapes || !prepared->shapes.isEmpty();
        frame.drawn.widen(prepared->shapes.reach());
        frame.passes.push_back(std::move(*prepared));
    }
    return frame;
}

// The volume whose runs do not come from its bricks; null: all do.
const RunSource* sourceOf(const PreparedFrame& frame) {
    for (const auto& volume : frame.volumes)
        if (volume.source != nullptr) return volume.source;
    return nullptr;
}

// \param makeReference  null: packets, where the frame allows them
Result<Frame> castFrame(std::span<const DrawnVolume> volumes, const FrameSpec& spec, const CastOptions& options,
                        MakePointCaster makeReference) {
    SVT_DO(checkCall(volumes, spec, options));
    SVT_TRY(prepared, prepareFrame(volumes, spec, options, makeReference != nullptr));
    const PreparedFrame& frame = *prepared;
    const RunSource* source = sourceOf(frame);
    const auto makeCaster = [&]() -> std::unique_ptr<PointCaster> {
        if (makeReference != nullptr) return makeReference(frame);
        return source != nullptr ? source->makeCaster(frame) : nullptr;
    };
    std::optional<PacketPasses> packets;
    if (makeReference == nullptr && source == nullptr) packets.emplace(frame);
    Frame picture;
    // In parallel: the time to touch new memory matters in fast frames.
    parallelFor(3, 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t image = begin; image < end; ++image) {
            if (image == 0) picture.color = image::Image<image::Rgba8>(spec.width, spec.height);
            if (image == 1) picture.label = image::Image<volume::Scalar>(spec.width, spec.height);
            if (image == 2)
                picture.depth = image::Image<float>(spec.width, spec.height, std::numeric_limits<float>::infinity());
        }
    });
    const auto tilesX = static_cast<std::size_t>((spec.width + kTilePixels - 1) / kTilePixels);
    const auto tilesY = static_cast<std::size_t>((spec.height + kTilePixels - 1) / kTilePixels);
    std::atomic<bool> isCancelled{false};
    ProgressCounter progress(options.progress, "render", tilesX * tilesY);
    parallelFor(tilesX * tilesY, 4, options.threads, [&](std::size_t begin, std::size_t end) {
        TileRenderer renderer(frame, packets ? &*packets : nullptr, makeCaster(), picture);
        for (std::size_t tile = begin; tile < end; ++tile) {
            if (Progress::isCancelled(options.progress)) {
                isCancelled = true;
                return;
            }
            renderer.render(static_cast<std::int32_t>(tile % tilesX) * kTilePixels,
                            static_cast<std::int32_t>(tile / tilesX) * kTilePixels);
            progress.add();
        }
    });
    if (isCancelled) return Error(Code::Cancelled, "the picture was cancelled");
    return picture;
}

}  // namespace

Result<Frame> castRays(std::span<const DrawnVolume> volumes, const FrameSpec& spec, const CastOptions& options) {
    return castFrame(volumes, spec, options, nullptr);
}

Result<Frame> castRaysReference(std::span<const DrawnVolume> volumes, const FrameSpec& spec,
                                const CastOptions& options) {
    return castFrame(volumes, spec, options, makeSampleCaster);
}

int levelForView(const FrameSpec& spec, const volume::Grid& grid, int coarsest) {
    const CameraRays rays(spec, grid);
    double nearest = std::numeric_limits<double>::infinity();
    const Vec3i n = grid.dimension();
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d index{(corner & 1) * n.x - 0.5, ((corner >> 1) & 1) * n.y - 0.5, (corner >> 2) * n.z - 0.5};
        nearest = std::min(nearest, dot(grid.worldFromIndex(index) - spec.camera.eye, rays.forward()));
    }
    const Vec3d spacing = grid.spacing();
    const double voxelsAPixel = rays.pixelSize(nearest) / std::max({spacing.x, spacing.y, spacing.z});
    if (!(voxelsAPixel >= 4) || nearest <= 0) return 0;
    return std::min(coarsest, static_cast<int>(std::log2(voxelsAPixel)) - 1);
}

}  // namespace svt::render
