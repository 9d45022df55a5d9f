#include <svt/render_gl/painter/pass_textures.hpp>

#include <svt/render/pass_shapes.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/render_gl/painter/shared_constants.hpp>

#include <algorithm>
#include <array>

namespace svt::render_gl {
namespace {

using render::LinearStyle;

void append(std::vector<std::uint32_t>& words, Vec3d v, double w) {
    for (const double value : {v.x, v.y, v.z, w}) words.push_back(bitsOf(static_cast<float>(value)));
}

// Transforms a covector from world to voxel space: the gradient of dot(direction, p) with respect to voxel coordinates.
Vec3d inVoxels(Vec3d direction, const volume::Grid& grid) {
    Vec3d result;
    for (int axis = 0; axis < 3; ++axis)
        result[axis] = dot(direction, grid.axes()[static_cast<std::size_t>(axis)]) * grid.spacing()[axis];
    return result;
}

void appendPart(std::vector<std::uint32_t>& words, const render::ConvexPart& part, const volume::Grid& grid,
                Vec3i middle) {
    words.insert(words.end(), {static_cast<std::uint32_t>(part.halfSpaces.size()),
                               static_cast<std::uint32_t>(part.rounds.size()), 0u, 0u});
    // The middle in world space: voxel space is index space plus one half.
    const Vec3d half{0.5, 0.5, 0.5};
    const Vec3d center = grid.worldFromIndex(toDouble(middle) - half);
    for (const render::HalfSpace& space : part.halfSpaces)
        append(words, inVoxels(space.normal, grid), space.offset + dot(space.normal, center));
    for (const render::RoundBody& round : part.rounds) {
        using Kind = render::RoundBody::Kind;
        append(words, grid.indexFromWorld(round.center) + half - toDouble(middle),
               round.kind == Kind::Ball       ? 1
               : round.kind == Kind::Cylinder ? 0
                                              : -1);
        for (const Vec3d row : round.axes) append(words, inVoxels(row, grid), 0);
    }
}

}  // namespace

Result<void> PassTextures::update(const render::Pass& pass, const render::FrameSpec& spec,
                                  const volume::BrickVolume& volume, const volume::Grid& grid, Vec3i middle,
                                  const GlLimits& limits, int threads) {
    // Objects drawn as triangles are not drawn as voxels.
    SVT_DO(pass.triangles.empty()
               ? updateStyles(pass, spec, volume.scalarCount(), limits)
               : updateStyles(render::makeVoxelPass(pass, spec.objectOfScalar), spec, volume.scalarCount(), limits));
    SVT_DO(updateClips(pass, grid, middle, limits));
    SVT_DO(shapes_.update(pass, spec, grid, middle, limits, threads));
    if (spec.light.ambientOcclusion > 0 && hasOpaque_) return updateOcclusion(volume, grid, limits, threads);
    return {};
}

// Two texels per scalar: color and density; flags, object, surface, label.
Result<void> PassTextures::updateStyles(const render::Pass& pass, const render::FrameSpec& spec,
                                        std::uint64_t scalarCount, const GlLimits& limits) {
    if (!styleTexture_.isEmpty() && pass.styles == styles_ && spec.objectOfScalar == objects_) return {};
    const render::PassTable table(pass, spec.objectOfScalar, scalarCount);
    std::vector<std::uint32_t> words;
    bodies_.clear();
    hasOpaque_ = hasTranslucent_ = hasHatches_ = false;
    for (const LinearStyle& style : table.styles()) {
        const render::Hatch hatch = pass.styles[style.label].hatch;
        const std::array<std::uint32_t, 4 * kStyleTexels> texels{
            bitsOf(style.color.x), bitsOf(style.color.y), bitsOf(style.color.z), bitsOf(style.density),
            flagsOf(style, hatch), style.object,          bitsOf(style.surface), style.label};
        words.insert(words.end(), texels.begin(), texels.end());
        bodies_.push_back(style.isBody);
        hasOpaque_ = hasOpaque_ || style.kind == LinearStyle::Kind::Opaque;
        hasTranslucent_ = hasTranslucent_ || style.kind == LinearStyle::Kind::Translucent;
        hasHatches_ = hasHatches_ || hatch != render::Hatch::None;
    }
    styleCount_ = static_cast<std::uint32_t>(table.styles().size());
    SVT_DO(styleTexture_.setArray(GL_RGBA32UI, words.data(), words.size() / 4, limits));
    styles_ = pass.styles;
    objects_ = spec.objectOfScalar;
    return {};
}

// See clips.glsl.
Result<void> PassTextures::updateClips(const render::Pass& pass, const volume::Grid& grid, Vec3i middle,
                                       const GlLimits& limits) {
    if (!clipTexture_.isEmpty() && pass.clips == clips_) return {};
    std::vector<std::uint32_t> words;
    for (const render::ClipRegion& region : pass.clips) {
        const std::size_t head = words.size();
        words.insert(words.end(), {region.mode == render::ClipRegion::Mode::KeepOnly ? 1u : 0u,
                                   static_cast<std::uint32_t>(region.parts.size()), 0u, 0u});
        for (const render::ConvexPart& part : region.parts) appendPart(words, part, grid, middle);
        words[head + 2] = static_cast<std::uint32_t>(words.size() / 4);
    }
    SVT_DO(clipTexture_.setArray(GL_RGBA32UI, words.data(), words.size() / 4, limits));
    clips_ = pass.clips;
    clipRegions_ = static_cast<std::uint32_t>(pass.clips.size());
    return {};
}

Result<void> PassTextures::updateOcclusion(const volume::BrickVolume& volume, const volume::Grid& grid,
                                           const GlLimits& limits, int threads) {
    if (!occlusionTexture_.isEmpty() && bodies_ == occludingBodies_ && clips_ == occludingClips_) return {};
    const Vec3d spacing = grid.spacing();
    const render::OcclusionField field(
        volume, std::max({spacing.x, spacing.y, spacing.z}),
        [&](volume::Scalar scalar) { return scalar < bodies_.size() && bodies_[scalar] != 0; },
        render::Clipper(clips_, grid), threads);
    std::vector<std::uint32_t> voxels;
    occlusionCounts_.clear();
    occlusionFirsts_.clear();
    occlusionGains_.clear();
    occlusionCell_ = field.levels().empty() ? 8 : static_cast<float>(field.levels().front().cellSize);
    for (const render::OcclusionField::Level& level : field.levels()) {
        occlusionCounts_.push_back(level.count);
        occlusionFirsts_.push_back(static_cast<GLuint>(voxels.size()));
        occlusionGains_.push_back(static_cast<float>(level.gain));
        occlusionGains_.push_back(static_cast<float>(level.weight));
        voxels.insert(voxels.end(), level.voxels.begin(), level.voxels.end());
    }
    SVT_DO(occlusionTexture_.setArray(GL_R32UI, voxels.data(), voxels.size(), limits));
    occludingBodies_ = bodies_;
    occludingClips_ = clips_;
    return {};
}

void PassTextures::setUniforms(Program& program) const {
    program.bind("styles", styleTexture_);
    program.set("styleCount", GLuint{styleCount_});
    if (hasClips()) {
        program.bind("clips", clipTexture_);
        program.set("clipRegions", GLuint{clipRegions_});
    }
    if (hasShapes()) shapes_.setUniforms(program);
    // No ambient occlusion if nothing is opaque.
    if (!hasOpaque_) program.set("lightOcclusion", 0.0f);
    // Always bind something: a sampler must not refer to a texture that is drawn into (feedback loop).
    program.bind("occlusion", occlusionTexture_.isEmpty() ? styleTexture_ : occlusionTexture_);
    if (occlusionTexture_.isEmpty()) return;
    program.set("occlusionCell", occlusionCell_);
    program.set("occlusionLevels", GLint{render::OcclusionField::kLevels});
    program.set("occlusionCount[0]", std::span<const Vec3i>(occlusionCounts_));
    program.set("occlusionFirst[0]", std::span<const GLuint>(occlusionFirsts_));
    program.setPairs("occlusionGain[0]", occlusionGains_);
}

}  // namespace svt::render_gl
