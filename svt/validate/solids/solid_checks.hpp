#pragma once
/// \file
/// The tests of a solid by its shells, of a composite by its solids, of a building by its parts.

#include <svt/validate/solids/bodies.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace svt::validate {

/// Tests the shells of a solid, each of which is valid; the exterior first. Turned shells (405) end the tests.
[[nodiscard]] std::vector<Defect> checkSolid(const std::vector<Shell>& shells, const PointSet& points);

/// The volume between exterior and interiors, m3; each shell counts with its enclosed volume, whatever its orientation.
[[nodiscard]] double volumeOf(const std::vector<Shell>& shells, const PointSet& points) noexcept;

/// A solid as one body, all its shells together.
[[nodiscard]] Body bodyOf(const std::vector<Shell>& shells, const PointSet& points);

/// A defect between two solids.
struct Conflict {
    bool areSame = false;
    Vec3d at{};                   ///< units
    std::optional<double> depth;  ///< units; empty for the same
};
/// Empty if two solids have no inside in common deeper than `noise` (units).
[[nodiscard]] std::optional<Conflict> findConflict(const Body& a, const Body& b, double noise);

/// Tests the solids of a composite, each of which is valid: no solid twice (502), disjoint insides (501), connected by
/// common faces (503).
[[nodiscard]] std::vector<Defect> checkComposite(const std::vector<Body>& solids, const PointSet& points, double noise);

}  // namespace svt::validate
