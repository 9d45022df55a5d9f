#pragma once
/// \file
/// What the writers write: buildings made of plans in their places, one after the other.

#include <svt/samples/designs/designs.hpp>
#include <svt/samples/parts/placement.hpp>
#include <svt/samples/sample.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace svt::samples {

/// A plan in its place: a whole house, or one storey of the tower.
struct Level {
    const Plan* plan = nullptr;
    std::string prefix;      ///< stands before the component ids
    std::string namePrefix;  ///< stands before the component names
    Placement placement;
    std::vector<std::vector<Attribute>> unitAttributes;  ///< by order of Kind::Unit in the plan
};

/// One top-level feature.
struct Document {
    std::string id;
    std::string name;
    std::string function;
    std::string roofType;
    int storeys = 0;
    Material wallMaterial = Material::PlasterWhite;  ///< in place of PlasterWhite
    Material roofMaterial = Material::RoofTiles;     ///< in place of RoofTiles
    std::vector<Level> levels;

    [[nodiscard]] Material shown(Material designed) const;
    [[nodiscard]] std::string idOf(const Level& level, int component) const;
    [[nodiscard]] std::string nameOf(const Level& level, int component) const;
    /// Owner as in CityGML 3.0: the component's parent, the storey of a unit, else the building.
    [[nodiscard]] std::string parentIdOf(const Level& level, int component) const;
    /// Attributes as written, the material included.
    [[nodiscard]] std::vector<Attribute> attributesOf(const Level& level, int component) const;
};

/// The buildings of a sample, made on demand.
class SampleSource {
public:
    /// Code::BadArgument where an option is out of range.
    [[nodiscard]] static Result<SampleSource> make(SampleKind kind, const SampleOptions& options);

    [[nodiscard]] std::int64_t buildingCount() const;
    /// Its plans live as long as this source.
    [[nodiscard]] Document building(std::int64_t index);

    [[nodiscard]] std::string title() const;
    /// Decimals that hold every coordinate of the file.
    [[nodiscard]] int decimals() const;
    /// Corners of a box around everything, in units of 10^-decimals().
    [[nodiscard]] std::array<WorldPoint, 2> envelope();
    [[nodiscard]] Point origin() const { return origin_; }

    /// The ground of a district, counter-clockwise from above; empty for the others.
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
    Turn modelTurn_;
    std::map<std::string, Plan> plans_;
    std::map<VillageHouse, Plan> villagePlans_;
};

}  // namespace svt::samples
