#pragma once
/// \file
/// Casts rays one by one: walks the runs of a ray, lights and blends them.

#include <svt/render/light/surface_normal.hpp>
#include <svt/render/plain/point_caster.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

#include <memory>
#include <vector>

namespace svt::render {

class FragmentFinder;
struct Fragments;

/// The plain caster, against which the packet caster is tested.
class SampleCaster final : public PointCaster {
public:
    explicit SampleCaster(const PreparedFrame& frame);
    ~SampleCaster() override;

    [[nodiscard]] Sample cast(double u, double v, bool withColor) override;

private:
    const PreparedFrame& frame_;
    NormalCache cache_;
    std::vector<std::unique_ptr<RunWalker>> walkers_;  // by volume; null: by its bricks
    std::unique_ptr<FragmentFinder> finder_;
    std::unique_ptr<Fragments> fragments_;  // of the ray
};

[[nodiscard]] std::unique_ptr<PointCaster> makeSampleCaster(const PreparedFrame& frame);

}  // namespace svt::render
