#include <svt/readers/citygml/citygml_resolver.hpp>

#include <svt/model/surface_uses.hpp>
#include <svt/readers/citygml/gml_geometry.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace svt::readers::citygml {
namespace {

using model::FeatureIndex;
using model::Polygon;
using model::PolygonIndex;
using model::SurfaceUse;
using std::string_view;

// The scanner limits inline nesting; a chain of references could still overflow the stack.
constexpr std::uint32_t kMaxReferenceDepth = 2000;
constexpr std::uint64_t kCostPerPlacedPoint = 10;

Vec3d place(const Placement& placement, Vec3d p) noexcept {
    const auto& m = placement.matrix;
    const Vec3d moved{m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                      m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    return moved + placement.referencePoint;
}

bool isWithinEarth(const Polygon& polygon) noexcept {
    return std::all_of(polygon.points.begin(), polygon.points.end(), [](Vec3d p) {
        return std::abs(p.x) <= gml::kLargestCoordinate && std::abs(p.y) <= gml::kLargestCoordinate &&
               std::abs(p.z) <= gml::kLargestCoordinate;
    });
}

void appendSurfaces(const Resolved& from, bool isReversed, std::vector<SurfaceUse>& into) {
    const auto add = [&](const std::vector<SurfaceUse>& uses) {
        for (const SurfaceUse use : uses) into.push_back({use.polygon, use.isReversed != isReversed});
    };
    for (const model::Solid& solid : from.solids) {
        add(solid.exterior);
        for (const auto& interior : solid.interiors) add(interior);
    }
    add(from.surfaces);
}

}  // namespace

GeometriesByFeature::GeometriesByFeature(const Part& part)
    : all_(part.geometries), first_(part.features.size() + 1, 0) {
    std::stable_sort(all_.begin(), all_.end(),
                     [](const FeatureGeometry& a, const FeatureGeometry& b) { return a.feature < b.feature; });
    for (const FeatureGeometry& geometry : all_) ++first_[geometry.feature + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

GeometryResolver::GeometryResolver(const Part& part, const References& references,
                                   const GeometriesByFeature& geometries, std::uint64_t budget, Report report)
    : part_(part),
      references_(references),
      geometries_(geometries),
      budget_(budget),
      report_(std::move(report)),
      isActive_(part.nodes.size(), false),
      visitedBy_(part.nodes.size(), 0) {}

Resolved GeometryResolver::resolve(NodeIndex node, double lod, string_view featureId) {
    lod_ = lod;
    featureId_ = featureId;
    Resolved resolved;
    walk(node, false, resolved);
    std::erase_if(resolved.solids, [](const model::Solid& solid) { return solid.exterior.empty(); });
    return resolved;
}

bool GeometryResolver::chargeBudget(std::uint64_t amount) {
    spent_ += amount;
    return spent_ <= budget_;
}

void GeometryResolver::walk(NodeIndex index, bool isReversed, Resolved& into) {
    if (!chargeBudget(1)) return;
    const Node& node = part_.nodes[index];
    if (depth_ >= kMaxReferenceDepth) {
        report_(Severity::Warning, Code::InputTooBig,
                fmt::format("references lead deeper than {} levels; the rest is left out", kMaxReferenceDepth),
                node.offset, featureId_);
        return;
    }
    ++depth_;
    isActive_[index] = true;
    isReversed = isReversed != node.isReversed;
    switch (node.kind) {
        case NodeKind::Empty: break;
        case NodeKind::Polygon: into.surfaces.push_back({node.payload, isReversed}); break;
        case NodeKind::Surfaces:
        case NodeKind::Interior:
        case NodeKind::Bodies: walkChildren(index, isReversed, into); break;
        case NodeKind::Solid: walkSolid(index, into); break;
        case NodeKind::Reference: walkReference(index, isReversed, into); break;
        case NodeKind::Implicit: walkImplicit(index, isReversed, into); break;
    }
    isActive_[index] = false;
    --depth_;
}

void GeometryResolver::walkChildren(NodeIndex node, bool isReversed, Resolved& into) {
    for (NodeIndex child = part_.nodes[node].firstChild; child != kNone; child = part_.nodes[child].nextSibling)
        walk(child, isReversed, into);
}

void GeometryResolver::collectSurfaces(NodeIndex node, bool isReversed, std::vector<SurfaceUse>& into) {
    Resolved below;
    walkChildren(node, isReversed, below);
    if (into.empty() && below.solids.empty())
        into = std::move(below.surfaces);
    else
        appendSurfaces(below, false, into);
}

void GeometryResolver::walkSolid(NodeIndex index, Resolved& into) {
    model::Solid solid;
    solid.id = idOfNode(part_, index);
    for (NodeIndex child = part_.nodes[index].firstChild; child != kNone; child = part_.nodes[child].nextSibling) {
        if (part_.nodes[child].kind == NodeKind::Interior) {
            solid.interiors.emplace_back();
            collectSurfaces(child, false, solid.interiors.back());
            if (solid.interiors.back().empty()) solid.interiors.pop_back();
        } else {
            collectSurfaces(child, false, solid.exterior);
        }
    }
    into.solids.push_back(std::move(solid));
}

// The geometry of the level being resolved, else the finest.
const FeatureGeometry* GeometryResolver::findGeometry(FeatureIndex feature) const {
    const FeatureGeometry* best = nullptr;
    for (const FeatureGeometry* geometry = geometries_.begin(feature); geometry != geometries_.end(feature);
         ++geometry) {
        if (geometry->lod == lod_) return geometry;
        if (best == nullptr || geometry->lod > best->lod) best = geometry;
    }
    return best;
}

// The target node of a reference, or kNone if an error has been reported.
NodeIndex GeometryResolver::follow(NodeIndex reference) {
    const Node& node = part_.nodes[reference];
    const std::string& href = part_.hrefs[node.payload];
    const auto shown = string_view(href).substr(0, 200);
    const Target target = references_.geometry(href);
    if (target.kind == Target::Kind::Node) return target.index;
    if (target.kind == Target::Kind::Feature) {
        if (const FeatureGeometry* geometry = findGeometry(target.index)) return geometry->node;
        report_(Severity::Warning, Code::DanglingReference,
                fmt::format("'{}' refers to a {} that has no geometry", shown, part_.features[target.index].className),
                node.offset, featureId_);
    } else if (target.kind == Target::Kind::Elsewhere) {
        report_(Severity::Warning, Code::ExternalReference,
                fmt::format("'{}' refers to another file, which is not read; put the geometry into this file", shown),
                node.offset, featureId_);
    } else {
        report_(Severity::Warning, Code::DanglingReference,
                fmt::format("nothing in this file has the id '{}'", idOfHref(shown)), node.offset, featureId_);
    }
    return kNone;
}

void GeometryResolver::walkReference(NodeIndex index, bool isReversed, Resolved& into) {
    const NodeIndex target = follow(index);
    if (target == kNone) return;
    if (isActive_[target]) {
        report_(
            Severity::Warning, Code::ReferenceCycle,
            fmt::format("'{}' leads back to itself; it is not followed again", part_.hrefs[part_.nodes[index].payload]),
            part_.nodes[index].offset, featureId_);
        return;
    }
    walk(target, isReversed, into);
}

void GeometryResolver::walkImplicit(NodeIndex index, bool isReversed, Resolved& into) {
    const Node& node = part_.nodes[index];
    // A reference to an ImplicitGeometry from inside another one means its prototype.
    if (insidePlacement_) return walkChildren(index, isReversed, into);
    if (node.payload == kNone) return;
    Resolved prototype;
    insidePlacement_ = true;
    walkChildren(index, isReversed, prototype);
    insidePlacement_ = false;

    const Placement& placement = part_.placements[node.payload];
    const std::size_t firstPlaced = placed_.size();
    std::unordered_map<PolygonIndex, PolygonIndex> known;
    model::forEachUse(prototype, [&](SurfaceUse& use) { use.polygon = placed(use.polygon, placement, known); });
    const bool isPlaceable = std::all_of(placed_.begin() + static_cast<std::ptrdiff_t>(firstPlaced), placed_.end(),
                                         [](const Polygon& polygon) { return isWithinEarth(polygon); });
    if (!isPlaceable) {
        report_(Severity::Warning, Code::BadCoordinate,
                "the matrix moves the shape to coordinates that are absurdly large; it is left out", node.offset,
                featureId_);
        placed_.resize(firstPlaced);
        anchors_.resize(firstPlaced);
        return;
    }
    into.surfaces.insert(into.surfaces.end(), prototype.surfaces.begin(), prototype.surfaces.end());
    std::move(prototype.solids.begin(), prototype.solids.end(), std::back_inserter(into.solids));
}

PolygonIndex GeometryResolver::placed(PolygonIndex index, const Placement& placement,
                                      std::unordered_map<PolygonIndex, PolygonIndex>& known) {
    const auto [entry, isNew] = known.emplace(index, index);
    const Polygon& prototype = part_.polygons[index];
    if (!isNew || !chargeBudget(kCostPerPlacedPoint * (prototype.points.size() + 4))) return entry->second;
    Polygon polygon = prototype;
    for (Vec3d& point : polygon.points) point = place(placement, point);
    placed_.push_back(std::move(polygon));
    anchors_.push_back(placement.referencePoint);
    entry->second = static_cast<PolygonIndex>(part_.polygons.size() + placed_.size() - 1);
    return entry->second;
}

void GeometryResolver::forEachPolygon(NodeIndex start, const std::function<void(PolygonIndex)>& visit) {
    ++visit_;
    std::vector<NodeIndex> open{start};
    while (!open.empty()) {
        const NodeIndex index = open.back();
        open.pop_back();
        if (visitedBy_[index] == visit_ || !chargeBudget(1)) continue;
        visitedBy_[index] = visit_;
        const Node& node = part_.nodes[index];
        if (node.kind == NodeKind::Polygon) visit(node.payload);
        if (node.kind == NodeKind::Reference) {
            const Target target = references_.geometry(part_.hrefs[node.payload]);
            if (target.kind == Target::Kind::Node) open.push_back(target.index);
        }
        for (NodeIndex child = node.firstChild; child != kNone; child = part_.nodes[child].nextSibling)
            open.push_back(child);
    }
}

}  // namespace svt::readers::citygml
