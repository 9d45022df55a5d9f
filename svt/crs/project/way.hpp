#pragma once
/// \file
/// What a projection does with points; one class for each kind of it.

#include <svt/crs/projection.hpp>

namespace svt::crs {

class Projection::Way {
public:
    Way() = default;
    Way(const Way&) = delete;
    Way& operator=(const Way&) = delete;
    virtual ~Way() = default;
    virtual void apply(std::span<Vec3d> points) const = 0;
};

}  // namespace svt::crs
