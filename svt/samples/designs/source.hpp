#pragma once
/// \file
/// Input of the writers: buildings composed of placed plans, one after the other.

#include <svt/samples/designs/designs.hpp>
#include <svt/samples/designs/plan_changes.hpp>
#include <svt/samples/parts/placement.hpp>
#include <svt/samples/sample.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace svt::samples {

/// A placed plan: a whole house, or one storey of the tower.
struct PlacedPlan {
    const Plan* plan = nullptr;
    std::string prefix;      ///< prefix of component ids
    std::string namePrefix;  ///< prefix of component names
    Placement placement;
    std::vector<std::vector<Attribute>> unitAttributes;  ///< in the order of Kind::Unit components in the plan

    [[nodiscard]] const Component& component(int index) const { return plan->components[std::size_t(index)]; }
};

/// One top-level feature.
struct Document {
    std::string id;
    std::string name;
    std::string function;
    std::string roofType;
    int storeys = 0;
    Material wallMaterial = Material::PlasterWhite;  ///< replaces PlasterWhite
    Material roofMaterial = Material::RoofTiles;     ///< replaces RoofTiles
    std::vector<PlacedPlan> plans;

    /// Calls visit(placed, index, component) for all components of all plans.
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (const PlacedPlan& placed : plans)
            for (int c = 0; c < int(placed.plan->components.size()); ++c) visit(placed, c, placed.component(c));
    }
    [[nodiscard]] Material shown(Material designed) const;
    [[nodiscard]] std::string idOf(const PlacedPlan& placed, int component) const;
    /// Component::mark with the prefix of the building.
    [[nodiscard]] std::string markOf(const PlacedPlan& placed, int component) const;
    [[nodiscard]] std::string nameOf(const PlacedPlan& placed, int component) const;
    /// Parent as in CityGML 3.0: the component's parent, the storey of a unit, else the building.
    [[nodiscard]] std::string parentIdOf(const PlacedPlan& placed, int component) const;
    /// Attributes as written, including the material.
    [[nodiscard]] std::vector<Attribute> attributesOf(const PlacedPlan& placed, int component) const;
};

/// The buildings of a sample, generated on demand.
class SampleSource {
public:
    /// Code::BadArgument if an option is out of range.
    [[nodiscard]] static Result<SampleSource> make(SampleKind kind, const SampleOptions& options);

    [[nodiscard]] std::int64_t buildingCount() const;
    /// The plans of the result are valid as long as this source.
    [[nodiscard]] Document building(std::int64_t index);

    [[nodiscard]] std::string title() const;
    /// Number of decimals sufficient for every coordinate of the file.
    [[nodiscard]] int decimals() const;
    /// Corners of a box around everything, in units of 10^-decimals().
    [[nodiscard]] std::array<WorldPoint, 2> envelope();
    [[nodiscard]] Point origin() const { return origin_; }
    /// The edits of the house; empty before building() and without SampleOptions::change.
    [[nodiscard]] const PlanChanges& changes() const { return changes_; }

    /// The ground of a district, counter-clockwise from above; empty for the other samples.
    [[nodiscard]] std::vector<WorldPoint> ground() const;

private:
    SampleSource(SampleKind kind, const SampleOptions& options);
    [[nodiscard]] Document house();
    [[nodiscard]] Document tower();
    [[nodiscard]] Document villageHouse(std::int64_t index);
    [[nodiscard]] const Plan& villagePlan(const VillageHouse& variant);
    [[nodiscard]] WorldPoint rescaled(const Placement& placement, Point p) const;

    SampleKind kind_;
    SampleOptions options_;
    Point origin_;
    Rotation modelRotation_;
    std::map<std::string, Plan> plans_;
    std::map<VillageHouse, Plan> villagePlans_;
    PlanChanges changes_;
};

}  // namespace svt::samples
