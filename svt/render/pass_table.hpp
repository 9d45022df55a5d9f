#pragma once
/// \file
/// The styles of a pass, prepared for the inner loop. For renderers: used by render and render_gl.

#include <svt/render/frame_spec.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::render {

/// Style of a scalar in linear light.
struct LinearStyle {
    enum class Kind : std::uint8_t { Hidden, Translucent, Opaque };

    Vec3f color{};
    float density = 0;  ///< extinction per metre: -ln(1 - opacity)
    float surface = 0;  ///< how much its colour depends on the light at the start of a run, 0..1
    Kind kind = Kind::Hidden;
    bool isBody = false;  ///< opaque, or on a coarse level partly: counts for occlusion and fitted normals
    std::uint32_t object = 0;
    volume::Scalar label = 0;  ///< value for Frame::label
};

/// Styles by scalar; scalars beyond the end are hidden.
class PassTable {
public:
    /// Table of a full-resolution volume.
    /// \param scalarCount  styles from this scalar on are left out
    PassTable(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, std::uint64_t scalarCount);
    /// Table of a coarse level, by mixture number: each mixture's style under the pass's styles.
    PassTable(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, const volume::LodLevel& level);

    [[nodiscard]] const LinearStyle& operator[](volume::Scalar scalar) const noexcept {
        return scalar < styles_.size() ? styles_[scalar] : kHidden;
    }
    /// All styles, by scalar.
    [[nodiscard]] std::span<const LinearStyle> styles() const noexcept { return styles_; }
    [[nodiscard]] bool hasOpaque() const noexcept { return hasOpaque_; }

private:
    static const LinearStyle kHidden;
    std::vector<LinearStyle> styles_;
    bool hasOpaque_ = false;
};

}  // namespace svt::render
