#pragma once
/// \file
/// The styles of a pass, ready for the inner loop. Internal to render.

#include <svt/render/frame_spec.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::render {

/// Look of a scalar in linear light.
struct LinearStyle {
    enum class Kind : std::uint8_t { Hidden, Translucent, Opaque };

    Vec3f color{};
    float density = 0;  ///< extinction per metre: -ln(1 - opacity)
    float surface = 0;  ///< how much of its colour is lit by the normal where it begins, 0..1
    Kind kind = Kind::Hidden;
    bool isBody = false;  ///< its surface is found among all bodies, not among its own object's voxels
    std::uint32_t object = 0;
    volume::Scalar label = 0;  ///< what Frame::label shows
};

/// By scalar; scalars beyond the end are hidden.
class PassTable {
public:
    /// Table of the styles as they are. `scalarCount`: entries beyond it are left out.
    PassTable(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, std::uint64_t scalarCount);
    /// Table by mixture number: each mixture's look under the pass' styles.
    PassTable(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, const volume::LodLevel& level);

    [[nodiscard]] const LinearStyle& operator[](volume::Scalar scalar) const noexcept {
        return scalar < styles_.size() ? styles_[scalar] : kHidden;
    }
    /// All of them, by scalar.
    [[nodiscard]] std::span<const LinearStyle> styles() const noexcept { return styles_; }
    [[nodiscard]] bool hasOpaque() const noexcept { return hasOpaque_; }

private:
    static const LinearStyle kHidden;
    std::vector<LinearStyle> styles_;
    bool hasOpaque_ = false;
};

}  // namespace svt::render
