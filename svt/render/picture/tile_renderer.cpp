#include <svt/render/picture/tile_renderer.hpp>

#include <svt/render/picture_constants.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::render {
namespace {

std::int32_t reachOf(float width, std::int32_t side) noexcept {
    return std::max(1, static_cast<std::int32_t>(width * static_cast<float>(side) / 2));
}

// Whether the line between the two is the rim of a lens, with `sample` inside.
bool isRim(const Sample& sample, const Sample& other) noexcept { return sample.lens > other.lens; }

// Whether the line between the two is the outline of a cap, or a rim.
bool isCutLine(const Sample& sample, const Sample& other) noexcept {
    if (sample.lens != other.lens) return isRim(sample, other);
    return sample.isCap && (!other.hasHit() || !other.isCap || sample.object != other.object);
}

}  // namespace

SampleLayout::SampleLayout(const FrameSpec& spec)
    : side(static_cast<std::int32_t>(std::lround(std::sqrt(spec.samplesPerPixel)))),
      lineReach(reachOf(spec.borders.width, side)),
      cutReach(reachOf(spec.borders.cutWidth, side)),
      // Next to parts that are not cut, the whole line is drawn on the cap.
      margin(spec.borders.strength > 0 ? std::max(lineReach, cutReach > 1 ? 2 * cutReach : 1) : 0),
      pixelMargin((margin + side - 1) / side + 1) {}

TileRenderer::TileRenderer(const PreparedFrame& frame, const PacketPasses* packets, std::unique_ptr<PointCaster> caster,
                           Frame& picture)
    : frame_(frame),
      picture_(picture),
      caster_(std::move(caster)),
      isAdaptive_(frame.isAdaptive && !frame.isReference),
      layout_(frame.spec),
      stride_(kTilePixels * layout_.side + 2 * layout_.margin),
      backgroundTop_(image::linearFromSrgb(frame.spec.background.top)),
      backgroundBottom_(image::linearFromSrgb(frame.spec.background.bottom)),
      lineColor_(image::linearFromSrgb(frame.spec.borders.color)),
      samples_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_)),
      lines_(samples_.size()) {
    if (packets != nullptr) packets_.emplace(frame, *packets);
}

double TileRenderer::horizontal(double sampleX) const noexcept {
    return 2 * (tileX_ + sampleX / layout_.side) / frame_.spec.width - 1;
}

double TileRenderer::vertical(double sampleY) const noexcept {
    return 1 - 2 * (tileY_ + sampleY / layout_.side) / frame_.spec.height;
}

void TileRenderer::render(std::int32_t x, std::int32_t y) {
    tileX_ = x;
    tileY_ = y;
    tileWidth_ = std::min(kTilePixels, frame_.spec.width - x);
    tileHeight_ = std::min(kTilePixels, frame_.spec.height - y);
    const double side = layout_.side, around = layout_.pixelMargin * side;
    const ViewRect rect{horizontal(-around), horizontal(tileWidth_ * side + around),
                        vertical(tileHeight_ * side + around), vertical(-around)};
    if (!frame_.drawn.overlaps(x, y, tileWidth_, tileHeight_) || (packets_ && !packets_->isAnyIn(rect))) {
        fillBackground();
        return;
    }
    castSamples();
    // If no sample meets anything the tile is background. But with an even number of samples per side, none is at a
    // pixel's centre, whose ray may still meet a label.
    const bool isEmpty = std::all_of(samples_.begin(), samples_.end(),
                                     [](const Sample& sample) { return sample.alpha <= 0 && !sample.hasHit(); });
    if (isEmpty && layout_.side % 2 == 1) {
        fillBackground();
        return;
    }
    if (layout_.margin > 0) findLines();
    writePixels();
}

void TileRenderer::castSamples() {
    if (isAdaptive_ && layout_.side > 1) {
        castAdaptively();
        return;
    }
    if (packets_) {
        castPackets();
        return;
    }
    for (std::int32_t y = -layout_.margin; y < tileHeight_ * layout_.side + layout_.margin; ++y)
        for (std::int32_t x = -layout_.margin; x < tileWidth_ * layout_.side + layout_.margin; ++x)
            samples_[at(x, y)] = caster_->cast(horizontal(x + 0.5), vertical(y + 0.5), true);
}

void TileRenderer::castGrid(const RayGrid& grid, std::vector<Sample>& samples) {
    constexpr std::int32_t kWidth = 4, kHeight = 2;
    columns_.clear();
    rows_.clear();
    for (std::int32_t x = 0; x < grid.width; ++x) columns_.push_back(horizontal(grid.first + x * grid.step));
    for (std::int32_t y = 0; y < grid.height; ++y) rows_.push_back(vertical(grid.first + y * grid.step));
    if (!packets_) {
        for (std::int32_t y = 0; y < grid.height; ++y)
            for (std::int32_t x = 0; x < grid.width; ++x)
                samples[static_cast<std::size_t>(x + y * grid.stride)] =
                    caster_->cast(columns_[static_cast<std::size_t>(x)], rows_[static_cast<std::size_t>(y)], true);
        return;
    }
    const auto castBlock = [&](std::int32_t x0, std::int32_t y0) {
        const std::int32_t endX = std::min(x0 + kPacketWidth, grid.width);
        const std::int32_t endY = std::min(y0 + kPacketHeight, grid.height);
        for (std::int32_t top = y0; top < endY; top += kHeight)
            for (std::int32_t left = x0; left < endX; left += kWidth)
                for (std::int32_t y = top; y < std::min(top + kHeight, endY); ++y)
                    for (std::int32_t x = left; x < std::min(left + kWidth, endX); ++x)
                        packets_->add(columns_[static_cast<std::size_t>(x)], rows_[static_cast<std::size_t>(y)],
                                      static_cast<std::size_t>(x + y * grid.stride));
        packets_->cast(true, samples);
    };
    for (std::int32_t y = 0; y < grid.height; y += kPacketHeight)
        for (std::int32_t x = 0; x < grid.width; x += kPacketWidth) castBlock(x, y);
}

void TileRenderer::castPackets() {
    castGrid({0.5 - layout_.margin, 1, tileWidth_ * layout_.side + 2 * layout_.margin,
              tileHeight_ * layout_.side + 2 * layout_.margin, stride_},
             samples_);
}

// Adaptive sampling: casts all samples of pixels that differ from a neighbour; fills the others with their centre's.
void TileRenderer::castAdaptively() {
    castPixels();
    const std::int32_t endX = tileWidth_ * layout_.side + layout_.margin,
                       endY = tileHeight_ * layout_.side + layout_.margin;
    const std::int32_t around =
        (layout_.margin + layout_.side - 1) / layout_.side;  // pixels around the tile with samples of its margin
    for (std::int32_t y = -around; y < tileHeight_ + around; ++y)
        for (std::int32_t x = -around; x < tileWidth_ + around; ++x) {
            const bool isSmooth = !needsSamples(x, y);
            for (std::int32_t sy = std::max(y * layout_.side, -layout_.margin);
                 sy < std::min((y + 1) * layout_.side, endY); ++sy)
                for (std::int32_t sx = std::max(x * layout_.side, -layout_.margin);
                     sx < std::min((x + 1) * layout_.side, endX); ++sx) {
                    if (isSmooth) {
                        samples_[at(sx, sy)] = pixels_[middleOf(x, y)];
                        continue;
                    }
                    const double u = horizontal(sx + 0.5), v = vertical(sy + 0.5);
                    if (!packets_) {
                        samples_[at(sx, sy)] = caster_->cast(u, v, true);
                        continue;
                    }
                    packets_->add(u, v, at(sx, sy));
                    if (packets_->isFull()) packets_->cast(true, samples_);
                }
        }
    if (packets_) packets_->cast(true, samples_);
}

// Casts rays through the centres of pixels, for adaptive sampling.
void TileRenderer::castPixels() {
    const std::int32_t stride = kTilePixels + 2 * layout_.pixelMargin;
    pixels_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride));
    castGrid({layout_.side / 2.0 - layout_.pixelMargin * layout_.side, double(layout_.side),
              tileWidth_ + 2 * layout_.pixelMargin, tileHeight_ + 2 * layout_.pixelMargin, stride},
             pixels_);
}

bool TileRenderer::needsSamples(std::int32_t x, std::int32_t y) const {
    const Sample& sample = pixels_[middleOf(x, y)];
    const double step = sample.hasHit() ? frame_.rays().pixelSize(static_cast<double>(sample.depth)) : 0;
    for (std::int32_t dy = -1; dy <= 1; ++dy)
        for (std::int32_t dx = -1; dx <= 1; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const Vec3d aside = frame_.rays().right() * (step * dx) - frame_.rays().up() * (step * dy);
            if (looksOther(sample, pixels_[middleOf(x + dx, y + dy)], aside)) return true;
        }
    return false;
}

// Whether two samples differ enough for more samples; `other` is offset from `sample` by `aside` (metres, world space).
bool TileRenderer::looksOther(const Sample& sample, const Sample& other, Vec3d aside) const {
    constexpr float kColor = 0.02f, kTurned = 0.995f;
    // Lines are antialiased already.
    const bool hasLine = sample.hasLine || other.hasLine;
    if (sample.hasHit() != other.hasHit() || (!hasLine && std::abs(sample.alpha - other.alpha) > kColor)) return true;
    if (!hasLine && std::max({std::abs(sample.color.x - other.color.x), std::abs(sample.color.y - other.color.y),
                              std::abs(sample.color.z - other.color.z)}) > kColor)
        return true;
    if (!sample.hasHit()) return false;
    return dot(sample.normal, other.normal) < kTurned || lineBetween(sample, other, aside, true) > 0 ||
           lineBetween(other, sample, -aside, true) > 0;
}

// Casts rays through the centres of pixels, needed if the number of samples along a pixel is even.
void TileRenderer::castCenters() {
    const double middle = layout_.side / 2.0;
    centers_.resize(static_cast<std::size_t>(tileWidth_) * static_cast<std::size_t>(tileHeight_));
    if (packets_) {
        for (std::int32_t y = 0; y < tileHeight_; ++y)
            for (std::int32_t x = 0; x < tileWidth_; ++x) {
                packets_->add(horizontal(x * layout_.side + middle), vertical(y * layout_.side + middle),
                              static_cast<std::size_t>(x + y * tileWidth_));
                if (packets_->isFull()) packets_->cast(false, centers_);
            }
        packets_->cast(false, centers_);
        return;
    }
    for (std::int32_t y = 0; y < tileHeight_; ++y)
        for (std::int32_t x = 0; x < tileWidth_; ++x)
            centers_[static_cast<std::size_t>(x + y * tileWidth_)] =
                caster_->cast(horizontal(x * layout_.side + middle), vertical(y * layout_.side + middle), false);
}

void TileRenderer::findLines() {
    for (std::int32_t y = 0; y < tileHeight_ * layout_.side; ++y)
        for (std::int32_t x = 0; x < tileWidth_ * layout_.side; ++x) {
            const Sample& sample = samples_[at(x, y)];
            lines_[at(x, y)] = sample.hasHit() ? lineOn(sample, x, y) : 0;
        }
}

// Coverage of sample (x, y) by border lines.
float TileRenderer::lineOn(const Sample& sample, std::int32_t x, std::int32_t y) const {
    const double step = frame_.rays().pixelSize(static_cast<double>(sample.depth)) / layout_.side;
    const std::int32_t most = sample.isCap || sample.lens > 0 ? layout_.margin : layout_.lineReach;
    float line = 0;
    for (std::int32_t reach = 1; reach <= most && line < 1; ++reach) {
        const Vec3d right = frame_.rays().right() * (step * reach), up = frame_.rays().up() * (step * reach);
        const auto look = [&](std::int32_t dx, std::int32_t dy, Vec3d aside, bool isFirst) {
            const Sample& other = samples_[at(x + dx * reach, y + dy * reach)];
            if (most > 1 && reach > reachBetween(sample, other)) return;
            line = std::max(line, lineBetween(sample, other, aside, isFirst || most > 1));
        };
        look(1, 0, right, true);
        look(-1, 0, -right, false);
        look(0, -1, up, false);
        look(0, 1, -up, true);
    }
    return line;
}

std::int32_t TileRenderer::reachBetween(const Sample& sample, const Sample& other) const noexcept {
    if (!isCutLine(sample, other)) return layout_.lineReach;
    return isRim(sample, other) || (other.hasHit() && other.isCap) ? layout_.cutReach
                                                                   : std::max(layout_.lineReach, layout_.margin);
}

// Coverage of `sample` by the line along its border with `other`, which is offset by `aside` (metres, world space). The
// line is drawn on the nearer of the two. If both are on one surface it is drawn on both, or, with one sample per
// pixel, on the first only, so that it is one pixel wide.
float TileRenderer::lineBetween(const Sample& sample, const Sample& other, Vec3d aside, bool isFirst) const {
    if (!other.hasHit() || isRim(sample, other)) return 1;
    if (isRim(other, sample)) return 0;
    const double difference = static_cast<double>(other.depth) - static_cast<double>(sample.depth);
    // Depth of the sample's tangent plane at the other ray. At a grazing angle one voxel is a large step in depth.
    const Vec3d normal = toDouble(sample.normal);
    const double facing = std::max(-dot(normal, frame_.rays().forward()), kLeastFacing);
    const double predicted = dot(normal, aside) / facing;
    // A step of one voxel in a face of one object is not a border, though the side of the step faces the viewer.
    const double otherFacing = std::max(-dot(toDouble(other.normal), frame_.rays().forward()), kLeastFacing);
    const double grazing = sample.object == other.object ? std::min(facing, otherFacing) : facing;
    const double tolerance = (1 + 2 / grazing) * frame_.volumes[sample.volume].voxelSize + length(aside) +
                             kDepthTolerance * std::abs(predicted);
    const bool isJump = std::abs(difference - predicted) > tolerance;
    const bool isOtherLabel = sample.object != other.object || sample.isCap != other.isCap;
    if (!isJump && !isOtherLabel) return 0;
    if (isJump) return difference > 0 ? 1 : 0;
    return layout_.side > 1 || isFirst ? 1 : 0;
}

void TileRenderer::fillBackground() {
    for (std::int32_t y = 0; y < tileHeight_; ++y) writeColors(y, {});
}

void TileRenderer::writePixels() {
    const bool isOdd = layout_.side % 2 == 1;
    const bool isAdaptive = isAdaptive_;
    if (!isOdd && !isAdaptive) castCenters();
    const auto centerOf = [&](std::int32_t x, std::int32_t y) -> const Sample& {
        if (isOdd) return samples_[at(x * layout_.side + layout_.side / 2, y * layout_.side + layout_.side / 2)];
        return isAdaptive ? pixels_[middleOf(x, y)] : centers_[static_cast<std::size_t>(x + y * tileWidth_)];
    };
    LightRow row{};
    for (std::int32_t y = 0; y < tileHeight_; ++y) {
        volume::Scalar* labels = &picture_.label.at(tileX_, tileY_ + y);
        float* depths = &picture_.depth.at(tileX_, tileY_ + y);
        for (std::int32_t x = 0; x < tileWidth_; ++x) {
            const auto n = static_cast<std::size_t>(x);
            const Sample& center = centerOf(x, y);
            labels[n] = center.label;
            depths[n] = center.depth;
            const auto [color, alpha] = layout_.side == 1 ? lightOf(at(x, y)) : lightOf(x, y);
            row.red[n] = color.x;
            row.green[n] = color.y;
            row.blue[n] = color.z;
            row.alpha[n] = alpha;
        }
        writeColors(y, row);
    }
}

TileRenderer::PixelLight TileRenderer::lightOf(std::size_t place) const noexcept {
    const Sample& sample = samples_[place];
    if (sample.alpha <= 0) return {{}, 0};
    // Clamped before averaging, so that overexposed samples do not dominate a pixel.
    const Vec3f color{std::min(sample.color.x, 1.0f), std::min(sample.color.y, 1.0f), std::min(sample.color.z, 1.0f)};
    const float line = layout_.margin > 0 ? frame_.spec.borders.strength * lines_[place] : 0;
    if (line == 0) return {color, sample.alpha};
    // A line is visible, however transparent the sample.
    const float covered = sample.alpha + (1 - sample.alpha) * line * kGlassLine;
    return {color * (1 - line) + lineColor_ * (line * covered), covered};
}

TileRenderer::PixelLight TileRenderer::lightOf(std::int32_t x, std::int32_t y) const noexcept {
    PixelLight sum{};
    for (std::int32_t sy = y * layout_.side; sy < (y + 1) * layout_.side; ++sy)
        for (std::int32_t sx = x * layout_.side; sx < (x + 1) * layout_.side; ++sx) {
            const PixelLight light = lightOf(at(sx, sy));
            sum.color = sum.color + light.color;
            sum.alpha += light.alpha;
        }
    const float share = 1.0f / static_cast<float>(layout_.side * layout_.side);
    return {sum.color * share, sum.alpha * share};
}

Vec3f TileRenderer::backgroundOf(std::int32_t y) const noexcept {
    const float down = (static_cast<float>(tileY_ + y) + 0.5f) / static_cast<float>(frame_.spec.height);
    return backgroundTop_ + (backgroundBottom_ - backgroundTop_) * down;
}

// Composites a row of premultiplied linear light over the background, and converts it to sRGB.
void TileRenderer::writeColors(std::int32_t y, const LightRow& row) noexcept {
    const Vec3f background = backgroundOf(y);
    const float behind = frame_.spec.background.alpha;
    const bool isEmpty = std::all_of(row.alpha.begin(), row.alpha.end(), [](float alpha) { return alpha <= 0; });
    const std::size_t count = isEmpty ? 1 : static_cast<std::size_t>(tileWidth_);
    // Indices first, so that the compiler can vectorize this loop; the table look-ups follow.
    std::array<std::int32_t, kTilePixels> red, green, blue, alpha;
    for (std::size_t n = 0; n < count; ++n) {
        const float rest = (1 - row.alpha[n]) * behind, covered = row.alpha[n] + rest;
        const float safe = covered > 0 ? covered : 1;
        red[n] = image::SrgbBytes::place((row.red[n] + background.x * rest) / safe);
        green[n] = image::SrgbBytes::place((row.green[n] + background.y * rest) / safe);
        blue[n] = image::SrgbBytes::place((row.blue[n] + background.z * rest) / safe);
        alpha[n] = static_cast<std::int32_t>(std::min(covered, 1.0f) * 255 + 0.5f);
    }
    image::Rgba8* pixels = &picture_.color.at(tileX_, tileY_ + y);
    const bool isOpen = behind <= 0;
    for (std::size_t n = 0; n < count; ++n)
        pixels[n] = isOpen && row.alpha[n] <= 0 ? image::Rgba8{}
                                                : image::Rgba8{bytes_[red[n]], bytes_[green[n]], bytes_[blue[n]],
                                                               static_cast<std::uint8_t>(alpha[n])};
    if (isEmpty) std::fill_n(pixels, tileWidth_, image::Rgba8(pixels[0]));
}

}  // namespace svt::render
