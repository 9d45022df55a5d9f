#include <svt/render_gl/painter/frame_painter.hpp>

#include <svt/image/color.hpp>
#include <svt/render/camera_rays.hpp>
#include <svt/render_gl/painter/shader_sources.hpp>
#include <svt/render_gl/painter/shared_constants.hpp>
#include <svt/render_gl/painter/view_depth.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::render_gl {
namespace {

/// Side of the render targets, samples: 32 MB for each set.
constexpr std::int32_t kTargetSamples = 1024;

std::int32_t reachOf(float width, int side) {
    return std::max(1, static_cast<std::int32_t>(width * static_cast<float>(side) / 2));
}

Vec3d towardsLight(const render::Light& light, const render::CameraRays& rays) {
    Vec3d direction = light.direction;
    if (light.space == render::Light::Space::Camera)
        direction = rays.right() * direction.x + rays.up() * direction.y - rays.forward() * direction.z;
    return normalized(direction);
}

std::string definesOf(std::initializer_list<std::pair<const char*, int>> values) {
    std::string text;
    for (const auto& [name, value] : values) text += fmt::format("#define {} {}\n", name, value);
    return text;
}

void drawPicture() { glDrawArrays(GL_TRIANGLES, 0, 3); }

}  // namespace

Result<void> FramePainter::prepare(const FrameParts& parts) {
    parts_.emplace(parts);
    const render::FrameSpec& spec = parts.spec;
    side_ = static_cast<int>(std::lround(std::sqrt(spec.samplesPerPixel)));
    lineReach_ = reachOf(spec.borders.width, side_);
    cutReach_ = reachOf(spec.borders.cutWidth, side_);
    margin_ = spec.borders.strength > 0 ? std::max(lineReach_, cutReach_ > 1 ? 2 * cutReach_ : 1) : 0;

    for (const render::Pass& pass : spec.passes)
        if (pass.hasCells || pass.join == render::Pass::Join::Part)
            return Error(Code::BadFrame, "only the CPU draws edges of voxels and several volumes; leave out --gl");
    if (spec.light.hasShadows) return Error(Code::BadFrame, "only the CPU draws shadows of the sun; leave out --gl");
    passes_.resize(spec.passes.size());
    passNeeds_.clear();
    for (std::size_t n = 0; n < passes_.size(); ++n) {
        const render::Pass& pass = spec.passes[n];
        if (pass.volume != 0)
            return Error(
                Code::BadFrame,
                fmt::format("pass {} draws volume {}; OpenGL draws only volume 0; leave out --gl", n, pass.volume));
        if (auto updated = passes_[n].update(pass, spec, parts.volume, parts.grid, parts.textures.middle, parts.limits,
                                             parts.options.threads);
            !updated)
            return updated;
        passNeeds_.push_back(needsOf(passes_[n]));
        SVT_DO(prepareCast(passNeeds_[n]));
    }
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindVertexArray(0);
    SVT_DO(checkGl("the tables of the frame"));
    return prepareResolve();
}

unsigned FramePainter::needsOf(const PassTextures& pass) const {
    unsigned needs = 0;
    if (pass.hasClips()) needs |= kClips;
    if (pass.hasTranslucent()) needs |= kTranslucent;
    if (pass.hasOpaque() && parts_->textures.hasVoxels) needs |= kFitted;
    if (pass.hasShapes()) needs |= kShapes;
    if (pass.hasTriangles()) needs |= kTriangles;
    if (pass.hasHatches() && parts_->spec.hatches.strength > 0) needs |= kHatches;
    return needs;
}

Result<void> FramePainter::prepareCast(unsigned needs) {
    if (cast_[needs]) return {};
    const auto has = [&](unsigned need) { return (needs & need) != 0 ? 1 : 0; };
    const std::string defines = definesOf({{"ROW_BITS", parts_->limits.rowBits},
                                           {"CLIPS", has(kClips)},
                                           {"TRANSLUCENT", has(kTranslucent)},
                                           {"FITTED", has(kFitted)},
                                           {"HATCHES", has(kHatches)},
                                           {"SHAPES", has(kShapes)},
                                           {"TRIANGLES", has(kTriangles)}});
    std::vector<std::string_view> sources{sharedConstants(), shaders::tables(), shaders::ray()};
    if (has(kClips) != 0) sources.push_back(shaders::clips());
    sources.push_back(shaders::light());
    if (has(kFitted) != 0) sources.push_back(shaders::fitted());
    if (has(kHatches) != 0) sources.push_back(shaders::hatches());
    sources.push_back(shaders::cast());
    if (has(kShapes) != 0) sources.push_back(shaders::shapes());
    SVT_TRY(program, Program::make(defines, sources));
    cast_[needs].emplace(std::move(*program));
    return {};
}

Result<void> FramePainter::prepareResolve() {
    const std::size_t which = parts_->spec.borders.strength > 0 ? 1 : 0;
    if (resolve_[which]) return {};
    const std::array sources{sharedConstants(), shaders::tables(), shaders::resolve()};
    auto program =
        Program::make(definesOf({{"ROW_BITS", parts_->limits.rowBits}, {"BORDERS", static_cast<int>(which)}}), sources);
    if (!program) return program.error();
    resolve_[which].emplace(std::move(*program));
    return {};
}

std::int32_t FramePainter::tilePixels() const noexcept { return (kTargetSamples - 2 * margin_) / side_; }

void FramePainter::castSamples(const PixelTile& tile) {
    castGrid({double(tile.x * side_ - margin_), double(tile.y * side_ - margin_), side_,
              tile.width * side_ + 2 * margin_, tile.height * side_ + 2 * margin_});
}

// Sets the scissor to where rays may meet anything: the bounds of the volume's box in the picture, one pixel wider. The
// whole picture if the box reaches the eye plane, or if there are lines, which may lie outside.
void FramePainter::scissorTo(const SampleGrid& samples) const {
    glScissor(0, 0, samples.width, samples.height);
    const render::CameraRays rays(parts_->spec, parts_->grid);
    const Vec3i n = parts_->grid.dimension();
    double left = samples.width, top = samples.height, right = 0, bottom = 0;
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d index{(corner & 1) * n.x - 0.5, ((corner >> 1) & 1) * n.y - 0.5, (corner >> 2) * n.z - 0.5};
        const Vec3d seen = rays.seenAt(parts_->grid.worldFromIndex(index) - parts_->spec.camera.eye);
        const double x = (seen.x + 1) / 2 * parts_->spec.width * samples.side - samples.firstX;
        const double y = (1 - seen.y) / 2 * parts_->spec.height * samples.side - samples.firstY;
        left = std::min(left, x - samples.side);
        top = std::min(top, y - samples.side);
        right = std::max(right, x + samples.side);
        bottom = std::max(bottom, y + samples.side);
        nearest = std::min(nearest, seen.z);
        farthest = std::max(farthest, seen.z);
    }
    if (rays.isPerspective() && !(nearest > 1e-3 * (farthest - nearest))) return;
    if (std::any_of(passNeeds_.begin(), passNeeds_.end(), [](unsigned needs) { return (needs & kShapes) != 0; }))
        return;
    const auto at = [](double sample, std::int32_t end) {
        return static_cast<GLint>(std::clamp(sample, 0.0, static_cast<double>(end)));
    };
    const GLint x = at(left, samples.width), y = at(top, samples.height);
    glScissor(x, y, std::max(at(right + 1, samples.width) - x, 0), std::max(at(bottom + 1, samples.height) - y, 0));
}

void FramePainter::castGrid(const SampleGrid& grid) {
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, grid.width, grid.height);
    const render::FrameSpec& spec = parts_->spec;
    for (std::size_t n = 0; n < std::max<std::size_t>(passes_.size(), 1); ++n) {
        last_ = n % 2;
        color_[last_].setTarget(GL_RGBA32UI, grid.width, grid.height);
        hit_[last_].setTarget(GL_RGBA32UI, grid.width, grid.height);
        targets_[last_].bind({color_[last_].name(), hit_[last_].name()});
        const std::array<GLuint, 4> nothing{0, 0, bitsOf(kFar), 0}, noColor{};
        if (n < 2) {
            glClearBufferuiv(GL_COLOR, 0, noColor.data());
            glClearBufferuiv(GL_COLOR, 1, nothing.data());
        }
        if (passes_.empty()) return;
        scissorTo(grid);
        glEnable(GL_SCISSOR_TEST);
        Program& program = *cast_[passNeeds_[n]];
        program.use();
        parts_->textures.setUniforms(program);
        setView(program);
        passes_[n].setUniforms(program);
        program.set("firstSample", grid.firstX, grid.firstY);
        program.set("perSample", 2.0 / (spec.width * grid.side), 2.0 / (spec.height * grid.side));
        program.set("samplesAPixel", double(grid.side));
        if ((passNeeds_[n] & kHatches) != 0) setHatches(program, grid.side);
        program.set("join", n == 0 ? GLuint{kFirstPass} : static_cast<GLuint>(spec.passes[n].join));
        program.bind("colorBefore", n > 0 ? color_[1 - last_] : parts_->textures.boxes);
        program.bind("hitBefore", n > 0 ? hit_[1 - last_] : parts_->textures.boxes);
        drawPicture();
        glDisable(GL_SCISSOR_TEST);
    }
}

// Sets the camera's rays. t = 0 is at the depth of the volume's middle, where floats are most precise.
void FramePainter::setView(Program& program) const {
    const render::FrameSpec& spec = parts_->spec;
    const volume::Grid& grid = parts_->grid;
    const render::CameraRays rays(spec, grid);
    const auto basis = rays.basis();
    const Vec3d middle = toDouble(parts_->textures.middle);
    const double depth = middleDepthOf(spec.camera, rays, grid, parts_->textures.middle);
    const bool isPerspective = rays.isPerspective();
    const Vec3d right = basis.rightVoxel * basis.halfWidth, up = basis.upVoxel * basis.halfHeight;
    const double reach = isPerspective ? depth : 1, turn = isPerspective ? 1 : 0;
    program.set("rayMiddle", basis.eyeVoxel + basis.forwardVoxel * depth - middle);
    program.set("rayRight", right * reach);
    program.set("rayUp", up * reach);
    program.set("directionAhead", basis.forwardVoxel);
    program.set("directionRight", right * turn);
    program.set("directionUp", up * turn);
    program.set("worldAhead", basis.forward);
    program.set("worldRight", basis.right * (basis.halfWidth * turn));
    program.set("worldUp", basis.up * (basis.halfHeight * turn));
    program.set("middleDepth", depth);
    program.set("isPerspective", isPerspective ? 1 : 0);
    program.set("worldOriginRight", basis.right * (basis.halfWidth * reach));
    program.set("worldOriginUp", basis.up * (basis.halfHeight * reach));
    // 1e-4 voxel, converted to depth.
    program.set("clipSlack", 1e-4 / length(basis.forwardVoxel));

    const render::Light& light = spec.light;
    program.set("towardsLight", towardsLight(light, rays));
    program.set("lightKey", light.key);
    program.set("lightAmbient", light.ambient);
    program.set("lightOcclusion", light.ambientOcclusion);
    std::array<Vec3d, 3> covectors, directions;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d unit{};
        unit[axis] = 1;
        covectors[static_cast<std::size_t>(axis)] =
            grid.axes()[static_cast<std::size_t>(axis)] * (1 / grid.spacing()[axis]);
        directions[static_cast<std::size_t>(axis)] = grid.indexFromWorldDirection(unit);
    }
    program.set("worldFromCovector", covectors);
    program.set("indexFromWorld", directions);
    program.set("opaqueAt", parts_->options.opaqueAt);
    program.set("labelAt", parts_->options.labelAt);
}

void FramePainter::setHatches(Program& program, int side) const {
    const render::FrameSpec& spec = parts_->spec;
    const volume::Grid& grid = parts_->grid;
    const render::CameraRays rays(spec, grid);
    std::array<Vec3d, 3> directions;
    for (int axis = 0; axis < 3; ++axis)
        directions[static_cast<std::size_t>(axis)] = grid.axes()[static_cast<std::size_t>(axis)] * grid.spacing()[axis];
    program.set("worldFromIndex", directions);
    program.set("originFromMiddle", Vec3d{0.5, 0.5, 0.5} - toDouble(parts_->textures.middle));
    program.set("gridNorth", grid.axes()[1]);
    program.set("gridUp", grid.axes()[2]);
    program.set("hatchColor", toDouble(image::linearFromSrgb(spec.hatches.color)));
    program.set("hatchSpacing", spec.hatches.spacing);
    program.set("hatchWidth", spec.hatches.width);
    program.set("hatchStrength", spec.hatches.strength);
    program.set("pixelPerDepth", rays.isPerspective() ? rays.pixelSize(1) : 0.0);
    program.set("pixelSize", rays.isPerspective() ? 0.0 : rays.pixelSize(1));
    program.set("samplesAlong", double(side));
    program.set("cameraForward", rays.forward());
}

void FramePainter::resolve(const PixelTile& tile, const PixelTile& window) {
    const render::FrameSpec& spec = parts_->spec;
    const render::CameraRays rays(spec, parts_->grid);
    Program& program = *resolve_[spec.borders.strength > 0 ? 1 : 0];
    program.use();
    program.bind("colorSamples", color_[last_]);
    program.bind("hitSamples", hit_[last_]);
    program.set("side", side_);
    program.set("margin", margin_);
    program.set("lineReach", lineReach_);
    program.set("cutReach", cutReach_);
    program.setPair("pictureFirst", window.x, window.y + window.height - 1);
    program.setPair("tileFirst", tile.x, tile.y);
    program.set("pictureHeight", double(spec.height));
    program.set("backgroundTop", toDouble(image::linearFromSrgb(spec.background.top)));
    program.set("backgroundBottom", toDouble(image::linearFromSrgb(spec.background.bottom)));
    program.set("backgroundAlpha", spec.background.alpha);
    program.set("lineColor", toDouble(image::linearFromSrgb(spec.borders.color)));
    program.set("lineStrength", spec.borders.strength);
    program.set("cameraRight", rays.right());
    program.set("cameraUp", rays.up());
    program.set("cameraForward", rays.forward());
    const double size = rays.pixelSize(1) / side_;
    program.set("samplePerDepth", rays.isPerspective() ? size : 0.0);
    program.set("sampleSize", rays.isPerspective() ? 0.0 : size);
    const Vec3d spacing = parts_->grid.spacing();
    program.set("voxelSize", std::max({spacing.x, spacing.y, spacing.z}));
    glViewport(0, 0, window.width, window.height);
    glEnable(GL_SCISSOR_TEST);
    glScissor(tile.x - window.x, window.y + window.height - tile.y - tile.height, tile.width, tile.height);
    drawPicture();
    glDisable(GL_SCISSOR_TEST);
}

void FramePainter::readCenters(const PixelTile& tile, const HitCallback& taken) {
    // A single sample is at the pixel's centre.
    if (side_ > 1) return pick(tile, taken);
    targets_[last_].bind({color_[last_].name(), hit_[last_].name()});
    readHits(margin_, tile, taken);
}

void FramePainter::pick(const PixelTile& tile, const HitCallback& taken) {
    castGrid({double(tile.x), double(tile.y), 1, tile.width, tile.height});
    readHits(0, tile, taken);
}

// Reads hits from the bound targets, from sample (first, first) on.
void FramePainter::readHits(std::int32_t first, const PixelTile& tile, const HitCallback& taken) {
    std::vector<std::array<std::uint32_t, 4>> hits(static_cast<std::size_t>(tile.width) *
                                                   static_cast<std::size_t>(tile.height));
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(first, first, tile.width, tile.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, hits.data());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    for (std::int32_t y = 0; y < tile.height; ++y)
        for (std::int32_t x = 0; x < tile.width; ++x) {
            const auto& hit =
                hits[static_cast<std::size_t>(x) + static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(y)];
            const auto depth = floatOf(hit[2]);
            taken(x, y, {hit[0], depth < kFar ? depth : std::numeric_limits<float>::infinity()});
        }
}

}  // namespace svt::render_gl
