#pragma once
/// \file
/// Tests whether the geometry of a model is valid by ISO 19107. Rings, polygons, shells, solids, composite solids and
/// the parts of buildings are tested from the bottom up, on the rings as read. Nothing is repaired.
///
/// The terms, the hierarchy of tests and the numbers of val3dity follow two papers of Ledoux. The first is "On the
/// validation of solids represented with the international standards for geographic information", CACAIE 28(9), 2013.
/// The second is "val3dity: validation of 3D GIS primitives according to the international standards", OGDSS 3(1),
/// 2018.

#include <svt/core/error.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::validate {

inline constexpr model::PolygonIndex kNoPolygon = 0xFFFFFFFFu;

struct ValidateOptions {
    double snap = 0.001;         ///< points closer than this are one point, metres; 0 or more
    double planarity = 0.01;     ///< largest distance of a point from the plane of its polygon, metres; more than 0
    double normalsDegrees = 20;  ///< largest angle between the triangles of a polygon, degrees; more than 0
    /// Solids may overlap by twice this depth, metres; negative: not deeper than `snap`.
    double overlap = -1;
    /// Geometries to test. Negative: all levels of detail; 0 or more: only the geometry that LodChoice selects for each
    /// feature.
    double lod = -1;
    int threads = 0;  ///< 0: all cores
    const Progress* progress = nullptr;
};

/// A defect and its place. All places are in world space.
struct Finding {
    /// Maximum number of kept findings per code; all are counted.
    static constexpr std::size_t kKeptPerCode = 1000;

    Code code = Code::Internal;
    model::FeatureIndex feature = model::kNoFeature;
    int geometry = -1;  ///< in Feature::geometries, -1: of the feature as a whole
    int solid = -1;     ///< in Geometry::solids, -1: of the geometry as a whole
    int shell = -1;     ///< 0: exterior, 1...: interiors; -1: of the solid as a whole
    model::PolygonIndex polygon = kNoPolygon;
    Vec3d at{};
    /// The measured value: metres for NonPlanar and overlaps, degrees for NormalsDeviate; otherwise empty.
    std::optional<double> value;
    std::string message;  ///< description of the defect, without place and code
    /// Lines that show the defect: pairs of points. Empty if `at` is enough to show it.
    std::vector<std::array<Vec3d, 2>> marks;
};

/// The volume that the shells of a geometry enclose.
struct SolidVolume {
    std::optional<double> volume;  ///< m3; empty if the shells do not enclose a definite volume
    Code reason = Code::Internal;  ///< code of the finding that prevents a volume
};

/// The number of items, and of those without a finding.
struct ValidCount {
    std::size_t total = 0, valid = 0;
};

struct ValidationReport {
    std::vector<Finding> findings;  ///< by root, in tree order; rings before polygons before shells before solids
    std::map<Code, std::size_t> counts;
    /// Features with geometry, by class; parts count separately.
    std::map<std::string, ValidCount> features;
    /// Geometries by type: Solid, CompositeSolid, MultiSolid, CompositeSurface, MultiSurface.
    std::map<std::string, ValidCount> primitives;
    /// Volumes of geometries with solids, by feature and geometry.
    std::map<std::pair<model::FeatureIndex, int>, SolidVolume> volumes;
    std::size_t polygonCount = 0;  ///< number of tested polygons
};

/// Tests the geometries of all features.
///
/// Tests from the bottom up: a shell is tested if its polygons are valid, a solid if its shells are, a composite or a
/// building if its solids are. Tests above a defect would only repeat the defect.
/// \return the report, BadArgument if an option is out of range, or Cancelled
/// Cost: O(n log n) in the points of a feature if its faces meet only at their borders. Memory beyond the report: that
/// of the largest root feature, per thread. The result does not depend on `threads`.
[[nodiscard]] Result<ValidationReport> validateModel(const model::BuildingModel& model,
                                                     const ValidateOptions& options = {});

/// The number of the same error in val3dity; 0 if val3dity does not report it.
[[nodiscard]] int val3dityCode(Code code) noexcept;
/// The name of a number in val3dity, such as "SHELL_NOT_CLOSED"; empty if unknown.
[[nodiscard]] std::string_view val3dityName(int val3dityCode) noexcept;
/// The violated requirement of ISO 19107, as a noun, such as "GM_Ring: simple"; empty if the code is not about
/// geometry.
[[nodiscard]] std::string_view isoTerm(Code code) noexcept;
/// Whether a warning or error of this code prevents the use of a model: a part is missing or at the wrong place, a body
/// is open or counts twice, or links contradict each other. Results from the model are then wrong or incomplete.
[[nodiscard]] bool preventsUse(Code code) noexcept;
/// Solid, CompositeSolid, MultiSolid, CompositeSurface or MultiSurface.
[[nodiscard]] std::string_view primitiveType(const model::Geometry& geometry) noexcept;

}  // namespace svt::validate
