#pragma once
/// \file
/// Looks codes up in the tables.

#include <svt/core/vec.hpp>
#include <svt/crs/facts/crs_tables.hpp>

#include <optional>

namespace svt::crs::facts {

/// The projection in metres that differs from a projection in feet only in the unit.
struct MetricTwin {
    int epsg = 0;
    double metresPerUnit = 1;
    Vec3d offset;  ///< metres, to be added
};
[[nodiscard]] std::optional<MetricTwin> findMetricTwin(int epsg) noexcept;

/// The two-dimensional code of degrees of the same datum, or the code itself.
[[nodiscard]] int datumOfDegrees(int epsg) noexcept;

/// The datum of a code of degrees; null if it is based on an older ellipsoid or has no UTM zones.
[[nodiscard]] const Datum* findDatum(int epsg) noexcept;

}  // namespace svt::crs::facts
