#pragma once
/// \file
/// A caster of single rays. Programs that cast only packets, such as the module of the page, do not link one.

#include <svt/render/light/sample.hpp>

#include <memory>

namespace svt::render {

struct PreparedFrame;

/// Not thread-safe: one per thread.
class PointCaster {
public:
    PointCaster() = default;
    PointCaster(const PointCaster&) = delete;
    PointCaster& operator=(const PointCaster&) = delete;
    virtual ~PointCaster() = default;

    /// Casts the ray through (u, v), see CameraRays::at().
    /// \param withColor  false: label and depth only
    [[nodiscard]] virtual Sample cast(double u, double v, bool withColor) = 0;
};

using MakePointCaster = std::unique_ptr<PointCaster> (*)(const PreparedFrame& frame);

}  // namespace svt::render
