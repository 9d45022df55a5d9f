#pragma once
/// \file
/// Casts rays one by one: walks the runs, lights them and blends them.

#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

#include <memory>

namespace svt::render {

class FragmentFinder;
struct Fragments;

/// Casts rays one by one: the plain way, which packets are held against. Belongs to one thread.
class SampleCaster {
public:
    explicit SampleCaster(const PreparedFrame& frame);
    ~SampleCaster();

    /// \param withColor  false: label and depth alone
    [[nodiscard]] Sample cast(double u, double v, bool withColor);

private:
    const PreparedFrame& frame_;
    NormalCache cache_;
    std::unique_ptr<FragmentFinder> finder_;
    std::unique_ptr<Fragments> fragments_;  // of the ray
};

}  // namespace svt::render
