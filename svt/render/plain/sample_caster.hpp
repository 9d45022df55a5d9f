#pragma once
/// \file
/// Casts rays one by one: walks the runs of a ray, lights and blends them.

#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

#include <memory>

namespace svt::render {

class FragmentFinder;
struct Fragments;

/// The plain caster, against which the packet caster is tested. Not thread-safe: one per thread.
class SampleCaster {
public:
    explicit SampleCaster(const PreparedFrame& frame);
    ~SampleCaster();

    /// Casts the ray through (u, v), see CameraRays::at().
    /// \param withColor  false: label and depth only
    [[nodiscard]] Sample cast(double u, double v, bool withColor);

private:
    const PreparedFrame& frame_;
    NormalCache cache_;
    std::unique_ptr<FragmentFinder> finder_;
    std::unique_ptr<Fragments> fragments_;  // of the ray
};

}  // namespace svt::render
