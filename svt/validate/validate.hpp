#pragma once
/// \file
/// Is the geometry of a model valid by ISO 19107? Rings, polygons, shells, solids, composite solids and the parts of
/// buildings are tested from the bottom up, on the rings as read. Nothing is repaired.
///
/// The terms, the hierarchy of tests and the numbers that findings are known by elsewhere are those of Ledoux, "On the
/// validation of solids represented with the international standards for geographic information", CACAIE 28(9), 2013,
/// and "val3dity: validation of 3D GIS primitives according to the international standards", OGDSS 3(1), 2018.

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
    /// Geometries to test: all levels of detail, or with a level (0 or more) the one that each feature is used with.
    double lod = -1;
    int threads = 0;  ///< 0: all cores
    const Progress* progress = nullptr;
};

/// What is wrong, and where. All places are world space.
struct Finding {
    /// Findings of each code that are kept; all are counted.
    static constexpr std::size_t kKeptPerCode = 1000;

    Code code = Code::Internal;
    model::FeatureIndex feature = model::kNoFeature;
    int geometry = -1;  ///< in Feature::geometries, -1: of the feature as a whole
    int solid = -1;     ///< in Geometry::solids, -1: of the geometry as a whole
    int shell = -1;     ///< 0: exterior, 1...: interiors; -1: of the solid as a whole
    model::PolygonIndex polygon = kNoPolygon;
    Vec3d at{};
    /// What is measured: metres for NonPlanar and overlaps, degrees for NormalsDeviate, else empty.
    std::optional<double> value;
    std::string message;  ///< what was found; without place and code
    /// Lines that show the defect: pairs of points. Empty: `at` alone shows it.
    std::vector<std::array<Vec3d, 2>> marks;
};

/// The volume of a geometry as its shells enclose it.
struct SolidVolume {
    std::optional<double> volume;  ///< m3; empty where the shells enclose none that one could state
    Code reason = Code::Internal;  ///< the finding because of which there is none
};

/// How many there are, and how many of them have no finding.
struct ValidCount {
    std::size_t total = 0, valid = 0;
};

struct ValidationReport {
    std::vector<Finding> findings;  ///< by root, in tree order; rings before polygons before shells before solids
    std::map<Code, std::size_t> counts;
    /// By class, of features with geometry; parts count for themselves.
    std::map<std::string, ValidCount> features;
    /// By type: Solid, CompositeSolid, MultiSolid, CompositeSurface, MultiSurface.
    std::map<std::string, ValidCount> primitives;
    /// Of geometries with solids: feature and geometry -> volume.
    std::map<std::pair<model::FeatureIndex, int>, SolidVolume> volumes;
    std::size_t polygonCount = 0;  ///< tested
};

/// Tests the geometries of all features.
///
/// From the bottom up: a shell is tested if its polygons are valid, a solid if its shells are, a composite or a building
/// if its solids are, since what stands above a defect would only repeat it.
/// \return the report, BadArgument if an option is out of range, or Cancelled
/// Cost: O(n log n) in the points of a feature where its faces meet only at their borders. Memory beyond the report: that
/// of the largest root feature, per thread. The result does not depend on `threads`.
[[nodiscard]] Result<ValidationReport> validateModel(const model::BuildingModel& model,
                                                     const ValidateOptions& options = {});

/// The number by which val3dity reports the same, 0 if it has none.
[[nodiscard]] int val3dityCode(Code code) noexcept;
/// val3dity's name of one of its numbers, such as "SHELL_NOT_CLOSED"; empty if it has none.
[[nodiscard]] std::string_view val3dityName(int val3dityCode) noexcept;
/// What ISO 19107 requires that is not the case, as a noun, such as "GM_Ring: simple"; empty if it is not of geometry.
[[nodiscard]] std::string_view isoTerm(Code code) noexcept;
/// Solid, CompositeSolid, MultiSolid, CompositeSurface or MultiSurface.
[[nodiscard]] std::string_view primitiveType(const model::Geometry& geometry) noexcept;

}  // namespace svt::validate
