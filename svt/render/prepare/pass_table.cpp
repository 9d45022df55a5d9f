#include <svt/image/color.hpp>
#include <svt/render/pass_table.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

using Kind = LinearStyle::Kind;

constexpr float kTranslucentSurface = 0.5f;

LinearStyle linearStyle(const Style& style, volume::Scalar scalar, std::span<const std::uint32_t> objectOfScalar) {
    LinearStyle linear;
    linear.object = scalar < objectOfScalar.size() ? objectOfScalar[scalar] : scalar;
    linear.label = scalar;
    if (style.opacity <= 0) return linear;
    linear.color = image::linearFromSrgb(style.color);
    linear.isBody = style.opacity >= 1;
    linear.kind = linear.isBody ? Kind::Opaque : Kind::Translucent;
    linear.surface = linear.isBody ? 1 : kTranslucentSurface;
    linear.density = linear.isBody ? 0 : -std::log1p(-style.opacity);
    return linear;
}

// Style of a cell with several labels: extinction and colour weighted by coverage.
// `opaqueDensity`: extinction of an opaque label that fills only part of the cell.
LinearStyle mixedStyle(const volume::Mixture& mixture, const std::vector<LinearStyle>& styles, float opaqueDensity) {
    LinearStyle mixed;
    float surface = 0;
    int opaqueCoverage = 0;
    const auto add = [&](volume::Scalar scalar, int coverage) {
        if (scalar >= styles.size() || styles[scalar].kind == Kind::Hidden || coverage == 0) return;
        const LinearStyle& style = styles[scalar];
        if (mixed.kind == Kind::Hidden) {  // the first one is the most frequent visible label
            mixed.kind = Kind::Translucent;
            mixed.object = style.object;
            mixed.label = style.label;
        }
        const bool isOpaque = style.kind == Kind::Opaque;
        const float density = static_cast<float>(coverage) / 255 * (isOpaque ? opaqueDensity : style.density);
        mixed.color = mixed.color + style.color * density;
        mixed.density += density;
        surface += style.surface * density;
        if (isOpaque) opaqueCoverage += coverage;
    };
    for (const volume::MixturePart& part : mixture.labels()) add(part.scalar, part.coverage);
    add(0, 255 - mixture.coverage());
    if (mixed.kind == Kind::Hidden) return mixed;
    mixed.color = mixed.color * (1 / mixed.density);
    mixed.surface = surface / mixed.density;
    mixed.isBody = opaqueCoverage > 0;
    if (opaqueCoverage >= 128) mixed.kind = Kind::Opaque;
    return mixed;
}

}  // namespace

const LinearStyle PassTable::kHidden{};

PassTable::PassTable(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, std::uint64_t scalarCount) {
    const std::size_t count = std::min<std::uint64_t>(pass.styles.size(), scalarCount);
    styles_.reserve(count);
    for (std::size_t scalar = 0; scalar < count; ++scalar) {
        styles_.push_back(linearStyle(pass.styles[scalar], static_cast<volume::Scalar>(scalar), objectOfScalar));
        hasOpaque_ = hasOpaque_ || styles_.back().kind == Kind::Opaque;
    }
}

PassTable::PassTable(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, const volume::LodLevel& level) {
    std::vector<LinearStyle> ofScalar;
    for (std::size_t scalar = 0; scalar < pass.styles.size(); ++scalar)
        ofScalar.push_back(linearStyle(pass.styles[scalar], static_cast<volume::Scalar>(scalar), objectOfScalar));
    const Vec3d spacing = level.grid.spacing();
    const double fine = std::min({spacing.x, spacing.y, spacing.z}) / static_cast<double>(1 << level.level);
    const auto opaqueDensity = static_cast<float>(std::log(100.0) / fine);
    for (const volume::Mixture& mixture : level.mixtures) {
        styles_.push_back(mixedStyle(mixture, ofScalar, opaqueDensity));
        hasOpaque_ = hasOpaque_ || styles_.back().isBody;
    }
}

}  // namespace svt::render
