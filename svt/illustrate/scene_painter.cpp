#include <svt/illustrate/scene_painter.hpp>

#include <svt/illustrate/name_tags.hpp>

#include <algorithm>

namespace svt::illustrate {
namespace {

Result<void> addNames(const Scene& scene, const volume::SemanticVolume& volume, Painting& painting) {
    if (scene.names.empty()) return {};
    const auto tags = findNameTags(scene.names, volume, painting.spec, painting.frame);
    if (!tags) return tags.error();
    const render::Background& background = painting.spec.background;
    const Vec3f paper = (background.top + background.bottom) * 0.5f;
    const bool isDark = paper.x + paper.y + paper.z < 1.5f && background.alpha > 0;
    const Vec3f dark{0.05f, 0.05f, 0.06f}, light{1, 1, 1};
    drawNameTags(*tags, 0, isDark ? light : dark, isDark ? paper : light, painting.frame.color);
    return {};
}

}  // namespace

ScenePainter::ScenePainter(const volume::SemanticVolume& volume, int threads) : volume_(volume), threads_(threads) {}

Result<const volume::BrickVolume*> ScenePainter::bricks() {
    if (!bricks_) {
        auto bricks = volume::BrickVolume::fromColumns(volume_.columns, threads_);
        if (!bricks) return bricks.error();
        bricks_ = std::move(*bricks);
    }
    return &*bricks_;
}

Result<render::Frame> ScenePainter::cast(const render::FrameSpec& spec, int level, const render::CastOptions& options) {
    if (level > 0) {
        if (!levels_) {
            auto levels = volume::buildLodPyramid(volume_.columns, volume_.grid, 6, threads_);
            if (!levels) return levels.error();
            levels_ = std::move(*levels);
        }
        if (!levels_->empty())
            return render::castRays((*levels_)[std::min(levels_->size(), static_cast<std::size_t>(level)) - 1], spec,
                                    options);
    }
    const auto finest = bricks();
    if (!finest) return finest.error();
    return render::castRays(**finest, volume_.grid, spec, options);
}

Result<Painting> ScenePainter::paint(const Scene& scene, const render::CastOptions& options, std::optional<int> level) {
    auto spec = frameOf(scene, volume_);
    if (!spec) return spec.error();
    auto frame = cast(*spec, level.value_or(render::levelForView(*spec, volume_.grid)), options);
    if (!frame) return frame.error();
    Painting painting{std::move(*frame), std::move(*spec)};
    if (auto named = addNames(scene, volume_, painting); !named) return named.error();
    return painting;
}

}  // namespace svt::illustrate
