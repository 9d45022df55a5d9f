// The paper's method (section 4.3), unoptimized: the labels as one dense 16-bit texture, the styles as one table, and a
// ray per pixel that samples the nearest label every half voxel, front to back, until it leaves the volume or is
// opaque. The paper does this in a fragment shader; here each core processes pixels, as in our caster.
#include <bench/peers.hpp>
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace svt::bench {
namespace {

constexpr float kOpaqueLeft = 0.001f;  // a ray ends when less than this fraction of light is left, as in our caster

// Color and opacity of one sample.
struct Entry {
    float r = 0, g = 0, b = 0, opacity = 0;
};

class DenseSteps final : public VolumePeer {
public:
    std::string name() const override { return "dense texture, fixed step (the paper's method)"; }
    int samplesPerVoxel() const override { return 2; }
    bool usesLabels() const override { return true; }

    void setVolume(const DenseLabels& labels, const volume::Grid& grid) override {
        labels_ = &labels;
        grid_ = grid;
        setSamplesPerVoxel(samplesPerVoxel());
    }

    void setStyles(std::span<const render::Style> styles) override {
        styles_.assign(styles.begin(), styles.end());
        makeTable();
    }

    void setSamplesPerVoxel(int samples) override {
        const Vec3d spacing = grid_.spacing();
        step_ = std::min({spacing.x, spacing.y, spacing.z}) / samples;
        makeTable();
    }

    void setCamera(const render::Camera& camera, std::int32_t width, std::int32_t height) override {
        image_ = image::Image<image::Rgba8>(width, height);
        eye_ = camera.eye;
        forward_ = normalized(camera.target - camera.eye);
        const Vec3d right = normalized(cross(forward_, camera.up));
        const double halfHeight = std::tan(camera.verticalFovDegrees * std::numbers::pi / 360);
        right_ = right * (halfHeight * width / height);
        up_ = cross(right, forward_) * halfHeight;
    }

    void draw() override {
        const auto rows = static_cast<std::size_t>(image_.height());
        parallelFor(rows, 4, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y)
                for (std::int32_t x = 0; x < image_.width(); ++x)
                    image_.at(x, static_cast<std::int32_t>(y)) = cast(x, static_cast<std::int32_t>(y));
        });
    }

    image::Image<image::Rgba8> picture() override { return image_; }

private:
    // Opacity is given per metre; converted to one step.
    void makeTable() {
        table_.assign(std::numeric_limits<std::uint16_t>::max() + std::size_t{1}, Entry{});
        for (std::size_t s = 0; s < styles_.size() && s < table_.size(); ++s) {
            const Vec3f color = styles_[s].color;
            const double opacity = 1 - std::pow(1 - double(styles_[s].opacity), step_);
            table_[s] = {color.x, color.y, color.z, static_cast<float>(opacity)};
        }
    }

    image::Rgba8 cast(std::int32_t x, std::int32_t y) const {
        const double u = 2 * (x + 0.5) / image_.width() - 1, v = 1 - 2 * (y + 0.5) / image_.height();
        const Vec3d direction = grid_.indexFromWorldDirection(normalized(forward_ + right_ * u + up_ * v));  // a metre
        const Vec3d origin = grid_.indexFromWorld(eye_) + Vec3d{0.5, 0.5, 0.5};  // voxel (i, j, k) is [i, i + 1) x ...
        const Vec3i n = labels_->dimension;
        double from = 0, to = std::numeric_limits<double>::infinity();  // metres
        for (int a = 0; a < 3; ++a) {
            const double first = -origin[a] / direction[a], second = (n[a] - origin[a]) / direction[a];
            from = std::max(from, std::min(first, second));
            to = std::min(to, std::max(first, second));
        }
        if (!(from < to)) return {0, 0, 0, 255};
        return march(origin + direction * (from + step_ / 2), direction * step_,
                     static_cast<int>((to - from) / step_ + 0.5));
    }

    image::Rgba8 march(Vec3d first, Vec3d step, int samples) const {
        const auto x0 = static_cast<float>(first.x), y0 = static_cast<float>(first.y), z0 = static_cast<float>(first.z);
        const auto dx = static_cast<float>(step.x), dy = static_cast<float>(step.y), dz = static_cast<float>(step.z);
        const auto nx = static_cast<std::uint32_t>(labels_->dimension.x),
                   ny = static_cast<std::uint32_t>(labels_->dimension.y),
                   nz = static_cast<std::uint32_t>(labels_->dimension.z);
        const std::uint16_t* const texture = labels_->scalars.data();
        const Entry* const table = table_.data();
        float r = 0, g = 0, b = 0, left = 1;
        for (int s = 0; s < samples; ++s) {
            const auto t = static_cast<float>(s);
            const auto i = static_cast<std::uint32_t>(static_cast<std::int32_t>(x0 + dx * t));
            const auto j = static_cast<std::uint32_t>(static_cast<std::int32_t>(y0 + dy * t));
            const auto k = static_cast<std::uint32_t>(static_cast<std::int32_t>(z0 + dz * t));
            if (i >= nx || j >= ny || k >= nz) continue;  // possible at the border due to rounding
            const Entry& entry = table[texture[i + std::size_t{nx} * (j + std::size_t{ny} * k)]];
            if (entry.opacity == 0) continue;
            const float share = left * entry.opacity;
            r += share * entry.r;
            g += share * entry.g;
            b += share * entry.b;
            left -= share;
            if (left < kOpaqueLeft) break;
        }
        const auto byte = [](float channel) {
            return static_cast<std::uint8_t>(std::min(255.0f, 255 * channel + 0.5f));
        };
        return {byte(r), byte(g), byte(b), 255};
    }

    const DenseLabels* labels_ = nullptr;
    volume::Grid grid_;
    double step_ = 1;  // metres
    std::vector<render::Style> styles_;
    std::vector<Entry> table_;
    Vec3d eye_{}, forward_{}, right_{}, up_{};  // right_ and up_ reach to the border of the picture
    image::Image<image::Rgba8> image_;
};

}  // namespace

Peer<VolumePeer> makeDenseSteps() { return {std::make_unique<DenseSteps>(), {}}; }

}  // namespace svt::bench
