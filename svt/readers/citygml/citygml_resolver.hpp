#pragma once
/// \file
/// Resolves references in the node graph of a joined part: yields the solids and surfaces of a node,
/// applies reversed orientation, places prototypes, and reports cycles and dangling links.

#include <svt/core/diagnostics.hpp>
#include <svt/readers/citygml/citygml_references.hpp>

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace svt::readers::citygml {

/// The result of resolving a geometry property.
struct Resolved {
    std::vector<model::Solid> solids;
    std::vector<model::SurfaceUse> surfaces;
};

/// Geometry properties in feature order.
class GeometriesByFeature {
public:
    explicit GeometriesByFeature(const Part& part);
    [[nodiscard]] const FeatureGeometry* begin(model::FeatureIndex feature) const {
        return all_.data() + first_[feature];
    }
    [[nodiscard]] const FeatureGeometry* end(model::FeatureIndex feature) const {
        return all_.data() + first_[feature + 1];
    }

private:
    std::vector<FeatureGeometry> all_;
    std::vector<std::size_t> first_;
};

/// Threads: not thread-safe.
class GeometryResolver {
public:
    using Report = std::function<void(Severity, Code, std::string message, std::uint64_t offset, std::string_view id)>;

    /// \param budget  limit on the work caused by references: visits of nodes, plus ten per point of a placed
    ///                prototype. A small file can expand to an unbounded model ("billion laughs").
    GeometryResolver(const Part& part, const References& references, const GeometriesByFeature& geometries,
                     std::uint64_t budget, Report report);

    /// Solids and surfaces of `node`, which belongs to `featureId` (for messages).
    /// References to features use their geometry of level `lod`.
    Resolved resolve(NodeIndex node, double lod, std::string_view featureId);

    /// Calls `visit` once for each polygon at or below `node`, prototypes untransformed.
    void forEachPolygon(NodeIndex node, const std::function<void(model::PolygonIndex)>& visit);

    /// Polygons of placed prototypes. Their indices follow those of the part's polygons.
    [[nodiscard]] std::vector<model::Polygon>& placedPolygons() noexcept { return placed_; }
    /// The reference point of each of placedPolygons().
    [[nodiscard]] const std::vector<Vec3d>& anchors() const noexcept { return anchors_; }

    /// Adds to the work done; false once the budget is exceeded.
    bool chargeBudget(std::uint64_t amount);
    [[nodiscard]] bool isOverBudget() const noexcept { return spent_ > budget_; }

private:
    void walk(NodeIndex node, bool isReversed, Resolved& into);
    void walkChildren(NodeIndex node, bool isReversed, Resolved& into);
    void walkSolid(NodeIndex node, Resolved& into);
    void walkReference(NodeIndex node, bool isReversed, Resolved& into);
    void walkImplicit(NodeIndex node, bool isReversed, Resolved& into);
    void collectSurfaces(NodeIndex node, bool isReversed, std::vector<model::SurfaceUse>& into);
    [[nodiscard]] const FeatureGeometry* findGeometry(model::FeatureIndex feature) const;
    NodeIndex follow(NodeIndex reference);
    model::PolygonIndex placed(model::PolygonIndex polygon, const Placement& placement,
                               std::unordered_map<model::PolygonIndex, model::PolygonIndex>& known);

    const Part& part_;
    const References& references_;
    const GeometriesByFeature& geometries_;
    std::uint64_t budget_;
    std::uint64_t spent_ = 0;
    Report report_;
    double lod_ = -1;
    std::string_view featureId_;
    std::uint32_t depth_ = 0;
    bool insidePlacement_ = false;
    std::vector<bool> isActive_;            // reference targets being resolved
    std::vector<std::uint32_t> visitedBy_;  // for forEachPolygon
    std::uint32_t visit_ = 0;
    std::vector<model::Polygon> placed_;
    std::vector<Vec3d> anchors_;
};

}  // namespace svt::readers::citygml
