#include <svt/readers/ifc_shape/profiles.hpp>

#include <svt/readers/ifc_shape/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::readers::ifc {
namespace {

using Ring = std::vector<Vec3d>;

// A corner of an outline, rounded by an arc that touches both sides.
struct Corner {
    double x, y, radius = 0;
};

Ring outline(const std::vector<Corner>& corners) {
    Ring ring;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Corner &before = corners[(i + n - 1) % n], &at = corners[i], &behind = corners[(i + 1) % n];
        const Vec3d p{at.x, at.y, 0};
        const Vec3d toBefore = Vec3d{before.x, before.y, 0} - p, toBehind = Vec3d{behind.x, behind.y, 0} - p;
        const Vec3d u = normalized(toBefore), v = normalized(toBehind);
        const double cosine = dot(u, v), sine = std::abs(u.x * v.y - u.y * v.x);
        if (at.radius <= 0 || sine < 1e-6) {
            ring.push_back(p);
            continue;
        }
        const double halfTangent = sine / (1 + cosine);  // of half the angle between the sides
        const double reach = std::min({at.radius / halfTangent, length(toBefore), length(toBehind)});
        const double radius = reach * halfTangent;
        const Vec3d center = p + normalized(u + v) * std::hypot(reach, radius);
        const Vec3d from = p + u * reach - center, to = p + v * reach - center;
        const double begin = std::atan2(from.y, from.x);
        double turn = std::atan2(to.y, to.x) - begin;
        if (turn > kPi) turn -= 2 * kPi;
        if (turn < -kPi) turn += 2 * kPi;
        Transform axes;
        axes.origin = center;
        appendArc(axes, radius, radius, begin, begin + turn, ring);
    }
    closeRing(ring);
    return ring;
}

Ring rectangle(double width, double height, double radius = 0) {
    const double x = width / 2, y = height / 2;
    return outline({{-x, -y, radius}, {x, -y, radius}, {x, y, radius}, {-x, y, radius}});
}

Ring ellipse(double radiusX, double radiusY) {
    Ring ring;
    appendArc({}, radiusX, radiusY, 0, 2 * kPi, ring);
    ring.pop_back();
    return ring;
}

// I and asymmetric I: the flanges have their own width, thickness and fillets. A slope inclines the inner face of a
// flange, whose thickness is measured in the middle between web and edge.
struct Flange {
    double width, thickness, fillet, edge, slope;
};
Ring iShape(double depth, double web, const Flange& bottom, const Flange& top) {
    const double h = depth / 2, w = web / 2;
    const auto rise = [&](const Flange& f) { return std::tan(f.slope) * (f.width / 2 - w) / 2; };
    const double b = bottom.width / 2, t = top.width / 2;
    return outline({{-b, -h},
                    {b, -h},
                    {b, -h + bottom.thickness - rise(bottom), bottom.edge},
                    {w, -h + bottom.thickness + rise(bottom), bottom.fillet},
                    {w, h - top.thickness - rise(top), top.fillet},
                    {t, h - top.thickness + rise(top), top.edge},
                    {t, h},
                    {-t, h},
                    {-t, h - top.thickness + rise(top), top.edge},
                    {-w, h - top.thickness - rise(top), top.fillet},
                    {-w, -h + bottom.thickness + rise(bottom), bottom.fillet},
                    {-b, -h + bottom.thickness - rise(bottom), bottom.edge}});
}

// Attributes of a parameterized profile.
struct Parameters {
    const IfcFile& file;
    Fields fields;
    [[nodiscard]] double length(AttributePosition at) const { return std::max(0.0, file.metres(fields[at])); }
    [[nodiscard]] double angle(AttributePosition at) const { return file.radians(fields[at]); }
};

Ring lShape(const Parameters& p) {
    namespace shape = at::LShapeProfileDef;
    const double height = p.length(shape::Depth), t = p.length(shape::Thickness);
    const double width = p.fields[shape::Width].isNothing() ? height : p.length(shape::Width);
    const double x = width / 2, y = height / 2, slope = std::tan(p.angle(shape::LegSlope));
    const double fillet = p.length(shape::FilletRadius), edge = p.length(shape::EdgeRadius);
    const double riseX = slope * (width - t) / 2, riseY = slope * (height - t) / 2;
    return outline({{-x, -y},
                    {x, -y},
                    {x, -y + t - riseX, edge},
                    {-x + t + riseY, -y + t + riseX, fillet},
                    {-x + t - riseY, y, edge},
                    {-x, y}});
}

Ring tShape(const Parameters& p) {
    namespace shape = at::TShapeProfileDef;
    const double depth = p.length(shape::Depth), flange = p.length(shape::FlangeThickness);
    const double y = depth / 2, x = p.length(shape::FlangeWidth) / 2, w = p.length(shape::WebThickness) / 2;
    const double riseF = std::tan(p.angle(shape::FlangeSlope)) * (x - w) / 2;
    const double riseW = std::tan(p.angle(shape::WebSlope)) * (depth - flange) / 2;
    const double fillet = p.length(shape::FilletRadius), edge = p.length(shape::FlangeEdgeRadius),
                 webEdge = p.length(shape::WebEdgeRadius);
    return outline({{-w + riseW, -y, webEdge},
                    {w - riseW, -y, webEdge},
                    {w + riseW, y - flange - riseF, fillet},
                    {x, y - flange + riseF, edge},
                    {x, y},
                    {-x, y},
                    {-x, y - flange + riseF, edge},
                    {-w - riseW, y - flange - riseF, fillet}});
}

Ring uShape(const Parameters& p) {
    namespace shape = at::UShapeProfileDef;
    const double y = p.length(shape::Depth) / 2, width = p.length(shape::FlangeWidth), x = width / 2;
    const double web = p.length(shape::WebThickness), t = p.length(shape::FlangeThickness);
    const double fillet = p.length(shape::FilletRadius), edge = p.length(shape::EdgeRadius);
    const double rise = std::tan(p.angle(shape::FlangeSlope)) * (width - web) / 2;
    return outline({{-x, -y},
                    {x, -y},
                    {x, -y + t - rise, edge},
                    {-x + web, -y + t + rise, fillet},
                    {-x + web, y - t - rise, fillet},
                    {x, y - t + rise, edge},
                    {x, y},
                    {-x, y}});
}

Ring cShape(const Parameters& p) {
    namespace shape = at::CShapeProfileDef;
    const double y = p.length(shape::Depth) / 2, x = p.length(shape::Width) / 2, t = p.length(shape::WallThickness);
    const double girth = p.length(shape::Girth), inner = p.length(shape::InternalFilletRadius);
    const double outer = inner > 0 ? inner + t : 0;
    return outline({{-x, -y, outer},
                    {x, -y, outer},
                    {x, -y + girth},
                    {x - t, -y + girth},
                    {x - t, -y + t, inner},
                    {-x + t, -y + t, inner},
                    {-x + t, y - t, inner},
                    {x - t, y - t, inner},
                    {x - t, y - girth},
                    {x, y - girth},
                    {x, y, outer},
                    {-x, y, outer}});
}

Ring zShape(const Parameters& p) {
    namespace shape = at::ZShapeProfileDef;
    const double y = p.length(shape::Depth) / 2, t = p.length(shape::FlangeThickness);
    const double w = p.length(shape::WebThickness) / 2, x = p.length(shape::FlangeWidth) - w;
    const double fillet = p.length(shape::FilletRadius), edge = p.length(shape::EdgeRadius);
    return outline({{-w, -y},
                    {x, -y},
                    {x, -y + t, edge},
                    {w, -y + t, fillet},
                    {w, y},
                    {-x, y},
                    {-x, y - t, edge},
                    {-w, y - t, fillet}});
}

Ring trapezium(const Parameters& p) {
    namespace shape = at::TrapeziumProfileDef;
    const double left = -p.length(shape::BottomXDim) / 2, y = p.length(shape::YDim) / 2;
    const double topLeft = left + p.file.metres(p.fields[shape::TopXOffset]);
    Ring ring{{left, -y, 0}, {-left, -y, 0}, {topLeft + p.length(shape::TopXDim), y, 0}, {topLeft, y, 0}};
    closeRing(ring);
    return ring;
}

Region hollowRectangle(const Parameters& p) {
    namespace shape = at::RectangleHollowProfileDef;
    const double x = p.length(shape::XDim), y = p.length(shape::YDim), t = p.length(shape::WallThickness);
    Region region{rectangle(x, y, p.length(shape::OuterFilletRadius)), {}};
    if (t > 0 && 2 * t < std::min(x, y))
        region.holes = {rectangle(x - 2 * t, y - 2 * t, p.length(shape::InnerFilletRadius))};
    return region;
}

Ring symmetricIShape(const Parameters& p) {
    namespace shape = at::IShapeProfileDef;
    const Flange flange{p.length(shape::OverallWidth), p.length(shape::FlangeThickness), p.length(shape::FilletRadius),
                        p.length(shape::FlangeEdgeRadius), p.angle(shape::FlangeSlope)};
    return iShape(p.length(shape::OverallDepth), p.length(shape::WebThickness), flange, flange);
}

Ring asymmetricIShape(const Parameters& p) {
    namespace shape = at::AsymmetricIShapeProfileDef;
    const Flange bottom{p.length(shape::BottomFlangeWidth), p.length(shape::BottomFlangeThickness),
                        p.length(shape::BottomFlangeFilletRadius), 0, 0};
    const bool isAlike = p.fields[shape::TopFlangeThickness].isNothing();
    const Flange top{p.length(shape::TopFlangeWidth), isAlike ? bottom.thickness : p.length(shape::TopFlangeThickness),
                     p.length(shape::TopFlangeFilletRadius), 0, 0};
    return iShape(p.length(shape::OverallDepth), p.length(shape::WebThickness), bottom, top);
}

// The outline of a parameterized profile about its own origin; empty if its numbers are invalid.
Region parameterized(Entity entity, const Parameters& p) {
    switch (entity) {
        case Entity::RectangleProfileDef:
            return {rectangle(p.length(at::RectangleProfileDef::XDim), p.length(at::RectangleProfileDef::YDim)), {}};
        case Entity::RoundedRectangleProfileDef:
            return {rectangle(p.length(at::RectangleProfileDef::XDim), p.length(at::RectangleProfileDef::YDim),
                              p.length(at::RoundedRectangleProfileDef::RoundingRadius)),
                    {}};
        case Entity::RectangleHollowProfileDef: return hollowRectangle(p);
        case Entity::CircleProfileDef:
        case Entity::CircleHollowProfileDef: {
            const double radius = p.length(at::CircleProfileDef::Radius);
            Region region{ellipse(radius, radius), {}};
            if (entity == Entity::CircleProfileDef) return region;
            const double inner = radius - p.length(at::CircleHollowProfileDef::WallThickness);
            if (inner > 0) region.holes = {ellipse(inner, inner)};
            return region;
        }
        case Entity::EllipseProfileDef:
            return {ellipse(p.length(at::EllipseProfileDef::SemiAxis1), p.length(at::EllipseProfileDef::SemiAxis2)),
                    {}};
        case Entity::IShapeProfileDef: return {symmetricIShape(p), {}};
        case Entity::AsymmetricIShapeProfileDef: return {asymmetricIShape(p), {}};
        case Entity::LShapeProfileDef: return {lShape(p), {}};
        case Entity::TShapeProfileDef: return {tShape(p), {}};
        case Entity::UShapeProfileDef: return {uShape(p), {}};
        case Entity::CShapeProfileDef: return {cShape(p), {}};
        case Entity::ZShapeProfileDef: return {zShape(p), {}};
        case Entity::TrapeziumProfileDef: return {trapezium(p), {}};
        default: return {};
    }
}

// A wall of constant thickness along an open line, with mitred corners.
bool centerLine(const IfcFile& file, const Fields& fields, Region& region, std::string& why) {
    Ring line;
    if (!readCurve(file, file.follow(fields[at::CenterLineProfileDef::Curve]), line, why)) return false;
    const double half = file.metres(fields[at::CenterLineProfileDef::Thickness]) / 2;
    const bool isClosed = line.size() > 3 && length(line.front() - line.back()) < 1e-6;
    closeRing(line);
    const std::size_t n = line.size();
    if (n < 2 || !(half > 0)) return false;
    Ring left, right;
    for (std::size_t i = 0; i < n; ++i) {
        const bool hasBefore = isClosed || i > 0, hasBehind = isClosed || i + 1 < n;
        const Vec3d in = normalized(hasBefore ? line[i] - line[(i + n - 1) % n] : line[i + 1] - line[i]);
        const Vec3d out = normalized(hasBehind ? line[(i + 1) % n] - line[i] : line[i] - line[i - 1]);
        const Vec3d normalIn{-in.y, in.x, 0}, normalOut{-out.y, out.x, 0};
        const double share = std::max(0.1, 1 + dot(normalIn, normalOut));  // sharp corners are cut off
        const Vec3d offset = (normalIn + normalOut) * (half / share);
        left.push_back(line[i] + offset);
        right.push_back(line[i] - offset);
    }
    if (isClosed) {
        region.outer = twiceArea(left) > twiceArea(right) ? left : right;
        region.holes = {twiceArea(left) > twiceArea(right) ? right : left};
        return true;
    }
    region.outer = right;
    region.outer.insert(region.outer.end(), left.rbegin(), left.rend());
    return true;
}

// Gives rings the orientation of a region, and drops holes without area.
bool orient(Region& region) {
    closeRing(region.outer);
    if (region.outer.size() < 3) return false;
    const double area = twiceArea(region.outer);
    if (std::abs(area) < 1e-12) return false;
    if (area < 0) std::reverse(region.outer.begin(), region.outer.end());
    for (Ring& hole : region.holes) {
        closeRing(hole);
        if (twiceArea(hole) > 0) std::reverse(hole.begin(), hole.end());
    }
    std::erase_if(region.holes, [](const Ring& hole) { return hole.size() < 3 || twiceArea(hole) > -1e-12; });
    return true;
}

void transformRegion(Region& region, const Transform& transform) {
    region = region.mapped([&](Ring ring) {
        for (Vec3d& p : ring) {
            p = transform.point(p);
            p.z = 0;
        }
        return ring;
    });
}

bool readDerived(const IfcFile& file, RecordIndex profile, const Fields& fields, std::vector<Region>& regions,
                 std::string& why) {
    std::vector<Region> parent;
    if (!readProfile(file, file.follow(fields[at::DerivedProfileDef::ParentProfile]), parent, why)) return false;
    Transform transform = file.transformation(fields[at::DerivedProfileDef::Operator]);
    if (file.entityOf(profile) == Entity::MirroredProfileDef) transform = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};
    for (Region& region : parent) {
        if (!file.guard().takeElements(region.pointCount())) break;
        transformRegion(region, transform);
        if (orient(region)) regions.push_back(std::move(region));
    }
    return !regions.empty();
}

bool readRegion(const IfcFile& file, RecordIndex profile, const Fields& fields, Region& region, std::string& why) {
    switch (file.entityOf(profile)) {
        case Entity::ArbitraryClosedProfileDef:
        case Entity::ArbitraryProfileDefWithVoids:
            if (!readCurve(file, file.follow(fields[at::ArbitraryClosedProfileDef::OuterCurve]), region.outer, why))
                return false;
            if (file.entityOf(profile) == Entity::ArbitraryClosedProfileDef) return true;
            for (const RecordIndex curve : file.followAll(fields[at::ArbitraryProfileDefWithVoids::InnerCurves])) {
                region.holes.emplace_back();
                if (!readCurve(file, curve, region.holes.back(), why)) return false;
            }
            return true;
        case Entity::CenterLineProfileDef: return centerLine(file, fields, region, why);
        default:
            region = parameterized(file.entityOf(profile), {file, fields});
            transformRegion(region, file.axes(fields[at::ParameterizedProfileDef::Position]));
            return true;
    }
}

}  // namespace

bool readProfile(const IfcFile& file, RecordIndex profile, std::vector<Region>& regions, std::string& why) {
    ReadGuard::Scope scope(file.guard());
    if (!scope.enter(profile, why)) return false;
    const Fields fields = file.fieldsOf(profile);
    const Entity entity = file.entityOf(profile);
    if (entity == Entity::DerivedProfileDef || entity == Entity::MirroredProfileDef)
        return readDerived(file, profile, fields, regions, why);
    if (entity == Entity::CompositeProfileDef) {
        for (const RecordIndex part : file.followAll(fields[at::CompositeProfileDef::Profiles]))
            if (!readProfile(file, part, regions, why)) return false;
        return !regions.empty();
    }
    const bool isKnown = entity >= Entity::RectangleProfileDef && entity <= Entity::CenterLineProfileDef &&
                         entity != Entity::ArbitraryOpenProfileDef;
    if (!isKnown) {
        why = fmt::format("the profile {}", file.typeName(profile).substr(0, 60));
        return false;
    }
    Region region;
    if (!readRegion(file, profile, fields, region, why)) {
        if (why.empty()) why = fmt::format("values of a profile {}", entityName(entity));
        return false;
    }
    if (!orient(region)) {
        why = fmt::format("a profile {} without area", entityName(entity));
        return false;
    }
    if (!file.guard().takeElements(region.pointCount())) {
        why = file.guard().whatIsSpent();
        return false;
    }
    regions.push_back(std::move(region));
    return true;
}

}  // namespace svt::readers::ifc
