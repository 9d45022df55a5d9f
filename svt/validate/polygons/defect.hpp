#pragma once
/// \file
/// A defect found by a test, before it is assigned to a feature.

#include <svt/core/error.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::validate {

/// A defect with its place; world space. The last three say where in the geometry, as in Finding.
struct Defect {
    Code code = Code::Internal;
    Vec3d at{};
    std::optional<double> value;
    std::string message;
    std::vector<std::array<Vec3d, 2>> marks;
    std::uint32_t polygon = 0xFFFFFFFFu;
    int solid = -1;
    int shell = -1;
};

}  // namespace svt::validate
