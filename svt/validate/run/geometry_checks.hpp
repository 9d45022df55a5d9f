#pragma once
/// \file
/// The tests of the geometries of one root feature and all below it.

#include <svt/validate/solids/solid_checks.hpp>
#include <svt/validate/validate.hpp>

#include <memory>
#include <unordered_map>
#include <vector>

namespace svt::validate {

/// Solids of a geometry that are valid, kept for comparison with others.
struct SolidBodies {
    model::FeatureIndex feature = model::kNoFeature;
    int geometry = -1;
    double lod = -1;
    std::shared_ptr<const Snapper> points;
    std::vector<Body> solids;
};

/// The contribution of one root feature to the report.
struct GroupReport {
    struct Volume {
        model::FeatureIndex feature;
        int geometry;
        SolidVolume volume;
    };
    struct Primitive {
        std::string_view type;
        bool isValid;
    };
    std::vector<Finding> findings;
    std::map<Code, std::size_t> counts;
    std::vector<Volume> volumes;
    std::vector<Primitive> primitives;
    std::vector<std::pair<model::FeatureIndex, bool>> features;  ///< those with geometry, and whether they are valid
    std::size_t polygonCount = 0;
    std::vector<SolidBodies> cells;  ///< of cell spaces, see indoor_checks.hpp
};

/// Tests all geometries of the features `members`, in tree order.
/// \param isOwn  of each polygon of the model: the group that reports it, so that a polygon that several groups use is
///               reported once
[[nodiscard]] GroupReport checkGroup(const model::BuildingModel& model, const Lattice& lattice,
                                     const ValidateOptions& options, const std::vector<model::FeatureIndex>& members,
                                     const std::vector<std::uint32_t>& groupOfPolygon, std::uint32_t group);

}  // namespace svt::validate
