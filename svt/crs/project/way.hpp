#pragma once
/// \file
/// The conversion of points by a projection; one class per kind of projection.

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
