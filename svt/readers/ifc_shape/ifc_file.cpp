#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/ifc_shape/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::readers::ifc {
namespace {

using std::string_view;

// The origin of a placement that nothing gives.
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3d kUnknownPlace{kNoNumber, kNoNumber, kNoNumber};

// The first three items of a list, and the number of them; (0, 0, 0) and 0 where one of them is not a number.
std::pair<Vec3d, int> firstNumbers(Value list) noexcept {
    step::ValueCursor cursor(list);
    Vec3d numbers{};
    int count = 0;
    for (Value item; count < 3 && cursor.next(item); ++count) {
        const auto number = item.number();
        if (!number) return {};
        numbers[count] = *number;
    }
    return {numbers, count};
}

}  // namespace

Fields::Fields(string_view values) noexcept {
    step::ValueCursor cursor(values);
    while (count_ < values_.size() && cursor.next(values_[count_])) ++count_;
}

IfcFile::IfcFile(const step::StepFile& file) : step_(file), missing_(file), guard_(file) {
    for (const string_view type : file.typeNames()) entityOfType_.push_back(entityNamed(type));
    for (RecordIndex i = 0; i < file.records().size(); ++i) {
        if (!equalsIgnoringCase(typeName(i), "IfcGrid")) continue;
        const Fields fields = fieldsOf(i);
        for (const auto list : {at::Grid::UAxes, at::Grid::VAxes, at::Grid::WAxes})
            for (const RecordIndex axis : followAll(fields[list]))
                placementOfAxis_[axis] = follow(fields[at::Grid::ObjectPlacement]);
    }
}

RecordIndex IfcFile::follow(Value reference) const {
    const auto id = reference.reference();
    const RecordIndex record = id ? step_.find(*id) : kNoRecord;
    if (record == kNoRecord && reference.text().starts_with('#')) missing_.note(reference);
    return record;
}

std::vector<RecordIndex> IfcFile::followAll(Value list) const {
    std::vector<RecordIndex> records;
    step::ValueCursor cursor(list);
    for (Value item; cursor.next(item);)
        if (const RecordIndex record = follow(item); record != kNoRecord) records.push_back(record);
    return records;
}

std::vector<RecordIndex> IfcFile::all(Entity entity) const {
    std::vector<RecordIndex> records;
    for (RecordIndex i = 0; i < step_.records().size(); ++i)
        if (entityOf(i) == entity) records.push_back(i);
    return records;
}

double IfcFile::metres(Value length, double otherwise) const noexcept {
    const auto number = length.number();
    return number ? *number * lengthUnit : otherwise;
}

double IfcFile::radians(Value angle, double otherwise) const noexcept {
    const auto number = angle.number();
    return number ? *number * angleUnit : otherwise;
}

std::optional<Vec3d> IfcFile::coordinates(Value list) const noexcept {
    const auto [numbers, count] = firstNumbers(list);
    return count >= 2 ? std::optional(numbers * lengthUnit) : std::nullopt;
}

std::optional<std::vector<Vec3d>> IfcFile::pointList(Value reference) const {
    std::vector<Vec3d> points;
    step::ValueCursor cursor(fieldsOf(follow(reference))[at::CartesianPointList::CoordList]);
    for (Value item; cursor.next(item);) {
        const auto point = coordinates(item);
        if (!point) return std::nullopt;
        points.push_back(*point);
    }
    return points;
}

std::optional<Vec3d> IfcFile::point(RecordIndex record) const noexcept {
    if (entityOf(record) != Entity::CartesianPoint) return std::nullopt;
    return coordinates(fieldsOf(record)[at::CartesianPoint::Coordinates]);
}

std::optional<Vec3d> IfcFile::vertexPoint(Value reference) const {
    return point(follow(follow(reference), at::VertexPoint::VertexGeometry));
}

std::optional<Vec3d> IfcFile::direction(Value reference) const {
    const RecordIndex record = follow(reference);
    if (entityOf(record) != Entity::Direction) return std::nullopt;
    const Vec3d ratios = firstNumbers(fieldsOf(record)[at::Direction::DirectionRatios]).first;
    return length(ratios) > 0 ? std::optional(ratios) : std::nullopt;
}

Transform IfcFile::axes(RecordIndex record) const {
    const Fields fields = fieldsOf(record);
    const Vec3d origin = point(fields[at::Placement::Location]).value_or(Vec3d{});
    switch (entityOf(record)) {
        case Entity::Axis2Placement2D:
            return axesFrom(origin, {0, 0, 1},
                            direction(fields[at::Axis2Placement2D::RefDirection]).value_or(Vec3d{1, 0, 0}));
        case Entity::Axis2Placement3D:
            return axesFrom(origin, direction(fields[at::Axis2Placement3D::Axis]).value_or(Vec3d{0, 0, 1}),
                            direction(fields[at::Axis2Placement3D::RefDirection]).value_or(Vec3d{1, 0, 0}));
        case Entity::Axis1Placement:
            return axesFrom(origin, direction(fields[at::Axis1Placement::Axis]).value_or(Vec3d{0, 0, 1}), {1, 0, 0});
        default: return {};
    }
}

// ISO 10303-42, base_axis: the second axis is made orthogonal to the first, and the third to both, but each keeps the
// side that the file gives it, so a mirrored operator stays mirrored.
Transform IfcFile::transformation(Value reference) const {
    namespace op = at::CartesianTransformationOperator3DnonUniform;
    const RecordIndex record = follow(reference);
    const Fields fields = fieldsOf(record);
    const Entity entity = entityOf(record);
    const bool isFlat = entity == Entity::CartesianTransformationOperator2D ||
                        entity == Entity::CartesianTransformationOperator2DnonUniform;
    Transform result;
    result.origin = point(fields[op::LocalOrigin]).value_or(Vec3d{});
    const double scale = fields[op::Scale].number().value_or(1);
    double scaleY = scale, scaleZ = scale;
    if (isFlat) {
        const Vec3d x = normalized(direction(fields[op::Axis1]).value_or(Vec3d{1, 0, 0}));
        const Vec3d left = cross(Vec3d{0, 0, 1}, x);
        const auto y = direction(fields[op::Axis2]);
        if (entity == Entity::CartesianTransformationOperator2DnonUniform)
            scaleY = fields[at::CartesianTransformationOperator2DnonUniform::Scale2].number().value_or(scale);
        result.x = x * scale;
        result.y = (y && dot(*y, left) < 0 ? -left : left) * scaleY;
        return result;
    }
    if (entity == Entity::CartesianTransformationOperator3DnonUniform) {
        scaleY = fields[op::Scale2].number().value_or(scale);
        scaleZ = fields[op::Scale3].number().value_or(scale);
    }
    const auto axis1 = direction(fields[op::Axis1]), axis2 = direction(fields[op::Axis2]),
               axis3 = direction(fields[op::Axis3]);
    Vec3d z = normalized(axis3.value_or(axis1 && axis2 ? cross(*axis1, *axis2) : Vec3d{0, 0, 1}));
    if (length(z) < 0.5) z = {0, 0, 1};
    const Transform base = axesFrom({}, z, axis1.value_or(Vec3d{1, 0, 0}));
    result.x = base.x * scale;
    result.y = (axis2 && dot(*axis2, base.y) < 0 ? -base.y : base.y) * scaleY;
    result.z = base.z * scaleZ;
    return result;
}

Transform IfcFile::placement(RecordIndex record, std::string& lost) const {
    Transform result;
    ReadGuard::Scope scope(guard_);
    while (record != kNoRecord) {
        if (!scope.enter(record, lost)) break;
        const Fields fields = fieldsOf(record);
        RecordIndex above = follow(fields[at::ObjectPlacement::PlacementRelTo]);
        switch (entityOf(record)) {
            case Entity::LocalPlacement:
                if (fields[at::LocalPlacement::RelativePlacement].isNothing()) lost = "its place, which is not given";
                result = axes(fields[at::LocalPlacement::RelativePlacement]).after(result);
                break;
            case Entity::GridPlacement:
                if (const auto axes = gridAxes(record, above))
                    result = axes->after(result);
                else
                    lost = "its place on a grid (of straight axes that meet)";
                break;
            case Entity::LinearPlacement:
                if (const RecordIndex relative = follow(fields[at::LinearPlacement::RelativePlacement]);
                    const auto axes = linearAxes(relative)) {
                    result = axes->after(result);
                    const RecordIndex location = follow(relative, at::Axis2PlacementLinear::Location);
                    std::string inexact =
                        inexactParts(*this, follow(location, at::PointByDistanceExpression::BasisCurve));
                    if (!inexact.empty()) lost = std::move(inexact);
                    break;
                }
                if (const auto axes = cartesianAxes(fields, above)) {
                    result = axes->after(result);
                    break;
                }
                lost = "its place along a curve (without Cartesian position)";
                result.origin = kUnknownPlace;
                above = kNoRecord;
                break;
            default: lost = fmt::format("a placement of the type {}", typeName(record)); above = kNoRecord;
        }
        record = above;
    }
    return result;
}

// The Cartesian position beside a place along a curve. In IFC 4.1 it comes later, and the placement is in the world.
std::optional<Transform> IfcFile::cartesianAxes(const Fields& fields, RecordIndex& above) const {
    const RecordIndex position = follow(fields[at::LinearPlacement::CartesianPosition]);
    if (entityOf(position) == Entity::Axis2Placement3D) return axes(position);
    const RecordIndex later = follow(fields[at::LinearPlacementOfIfc4x1::CartesianPosition]);
    if (entityOf(later) != Entity::Axis2Placement3D) return std::nullopt;
    above = kNoRecord;
    return axes(later);
}

// A straight axis of a grid, moved to its left.
bool IfcFile::readGridAxis(RecordIndex axis, double offset, Vec3d& from, Vec3d& along) const {
    const Fields fields = fieldsOf(axis);
    const RecordIndex curve = follow(fields[at::GridAxis::AxisCurve]);
    if (entityOf(curve) == Entity::Polyline) {
        const std::vector<RecordIndex> points = followAll(curve, at::Polyline::Points);
        if (points.size() < 2) return false;
        from = point(points.front()).value_or(Vec3d{});
        along = point(points.back()).value_or(Vec3d{}) - from;
    } else if (entityOf(curve) == Entity::Line) {
        const Fields line = fieldsOf(curve);
        from = point(line[at::Line::Pnt]).value_or(Vec3d{});
        along = direction(fieldsOf(follow(line[at::Line::Dir]))[at::Vector::Orientation]).value_or(Vec3d{});
    } else {
        return false;
    }
    if (!(length(along) > 0)) return false;
    along = normalized(fields[at::GridAxis::SameSense].enumeration() == "F" ? -along : along);
    from = from + Vec3d{-along.y, along.x, 0} * offset;
    return true;
}

// Axes at a distance along a curve: x along it, z as far up as possible, unless the placement has axes of its own.
// Offsets go to the left, upwards and ahead.
std::optional<Transform> IfcFile::linearAxes(RecordIndex relative) const {
    if (entityOf(relative) != Entity::Axis2PlacementLinear) return std::nullopt;
    namespace expression = at::PointByDistanceExpression;
    const Fields fields = fieldsOf(relative), point = fieldsOf(follow(fields[at::Axis2PlacementLinear::Location]));
    const Value distance = point[expression::DistanceAlong];
    std::vector<Vec3d> line;
    std::string why;
    if (!distance.number() || distance.typeName() == "IFCPARAMETERVALUE" ||
        !readCurve(*this, follow(point[expression::BasisCurve]), line, why))
        return std::nullopt;
    const bool isInPlan = isMeasuredInPlan(*this, follow(point[expression::BasisCurve]));
    const auto sizeOf = [&](std::size_t s) {
        const Vec3d step = line[s + 1] - line[s];
        return isInPlan ? std::hypot(step.x, step.y) : length(step);
    };
    double left = metres(distance), whole = 0;
    std::size_t segment = 0;
    for (; segment + 2 < line.size() && left > sizeOf(segment); ++segment) {
        left -= sizeOf(segment);
        whole += sizeOf(segment);
    }
    if (segment + 1 >= line.size()) return std::nullopt;
    const Vec3d along = normalized(line[segment + 1] - line[segment]);
    const double size = sizeOf(segment);
    // Chords are a little shorter than the curve.
    constexpr double kShortened = 1e-4, kRounded = 1e-6;
    if (!(length(along) > 0.5) || !(size > 0) || left > size + kRounded + kShortened * (whole + size))
        return std::nullopt;
    const Vec3d flat = cross(Vec3d{0, 0, 1}, along);
    const Vec3d lateral = length(flat) > 1e-9 ? normalized(flat) : Vec3d{0, 1, 0};
    const Vec3d up = cross(along, lateral);
    const Vec3d origin = line[segment] + (line[segment + 1] - line[segment]) * (left / size) +
                         along * metres(point[expression::OffsetLongitudinal]) +
                         lateral * metres(point[expression::OffsetLateral]) +
                         up * metres(point[expression::OffsetVertical]);
    return axesFrom(origin, direction(fields[at::Axis2PlacementLinear::Axis]).value_or(up),
                    direction(fields[at::Axis2PlacementLinear::RefDirection]).value_or(along));
}

// The intersection of two axes of a grid, with x along the first one or in the direction of the placement.
std::optional<Transform> IfcFile::gridAxes(RecordIndex placement, RecordIndex& above) const {
    const Fields fields = fieldsOf(placement);
    const RecordIndex ofIfc4 = follow(fields[at::GridPlacementOfIfc4::PlacementLocation]);
    const bool isOfIfc4 = entityOf(ofIfc4) == Entity::VirtualGridIntersection;
    const Fields intersection = fieldsOf(isOfIfc4 ? ofIfc4 : follow(fields[at::GridPlacement::PlacementLocation]));
    const std::vector<RecordIndex> crossing = followAll(intersection[at::VirtualGridIntersection::IntersectingAxes]);
    const std::vector<Value> offsets = step::itemsOf(intersection[at::VirtualGridIntersection::OffsetDistances]);
    const auto offset = [&](std::size_t i) { return i < offsets.size() ? metres(offsets[i]) : 0.0; };
    if (isOfIfc4) above = kNoRecord;
    Vec3d p, u, q, v;
    if (crossing.size() != 2 || !readGridAxis(crossing[0], offset(0), p, u) ||
        !readGridAxis(crossing[1], offset(1), q, v))
        return std::nullopt;
    if (above == kNoRecord)
        if (const auto grid = placementOfAxis_.find(crossing[0]); grid != placementOfAxis_.end()) above = grid->second;
    const double turn = u.x * v.y - u.y * v.x;
    if (std::abs(turn) < 1e-9) return std::nullopt;
    const double along = ((q.x - p.x) * v.y - (q.y - p.y) * v.x) / turn;
    const Vec3d x = direction(isOfIfc4 ? fields[at::GridPlacementOfIfc4::PlacementRefDirection]
                                       : fields[at::GridPlacement::PlacementRefDirection])
                        .value_or(u);
    return axesFrom(p + u * along + Vec3d{0, 0, offset(2)}, {0, 0, 1}, x);
}

}  // namespace svt::readers::ifc
