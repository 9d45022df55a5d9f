#include <svt/readers/ifc_shape/curves.hpp>

#include <svt/readers/ifc_shape/bspline.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::readers::ifc {
namespace {

constexpr std::size_t kMaxPoints = 1'000'000;

// Joins `part` to `points`; a first point equal to the last one is left out.
void appendPart(const std::vector<Vec3d>& part, std::vector<Vec3d>& points) {
    for (const Vec3d p : part)
        if (points.empty() || length(p - points.back()) > 1e-9) points.push_back(p);
}

// Arc through three points; a straight line if they are collinear.
void appendArcThrough(Vec3d a, Vec3d b, Vec3d c, std::vector<Vec3d>& points) {
    const Vec3d ab = b - a, ac = c - a, normal = cross(ab, ac);
    const double area = dot(normal, normal);
    if (area < 1e-24 || area < 1e-16 * dot(ab, ab) * dot(ac, ac)) return appendPart({a, b, c}, points);
    const Vec3d center = a + (cross(normal, ab) * dot(ac, ac) + cross(ac, normal) * dot(ab, ab)) / (2 * area);
    const Transform axes = axesFrom(center, normal, a - center);
    const auto angleOf = [&](Vec3d p) {
        const double angle = std::atan2(dot(p - center, axes.y), dot(p - center, axes.x));
        return angle < 0 ? angle + 2 * kPi : angle;
    };
    const double radius = length(a - center), end = angleOf(c);
    std::vector<Vec3d> arc;
    appendArc(axes, radius, radius, 0, end, arc);
    arc.front() = a;
    arc.back() = c;
    appendPart(arc, points);
}

bool readIndexedPolyCurve(const IfcFile& file, const Fields& fields, std::vector<Vec3d>& points) {
    const auto list = file.pointList(fields[at::IndexedPolyCurve::Points]);
    if (!list || list->empty()) return false;
    const Value segmentList = fields[at::IndexedPolyCurve::Segments];
    if (!segmentList.isList()) {
        appendPart(*list, points);
        return true;
    }
    step::ValueCursor segments(segmentList);
    for (Value segment; segments.next(segment);) {
        std::vector<Vec3d> at;
        if (!appendNumbered(segment.inner(), *list, at)) return false;
        if (segment.typeName() == "IFCARCINDEX" && at.size() == 3)
            appendArcThrough(at[0], at[1], at[2], points);
        else
            appendPart(at, points);
        if (points.size() > kMaxPoints) return false;
    }
    return points.size() >= 2;
}

struct Conic {
    Transform axes;
    double radiusX = 0, radiusY = 0;

    [[nodiscard]] double angleOf(Vec3d p) const noexcept {
        const Vec3d local = p - axes.origin;
        return std::atan2(dot(local, axes.y) / radiusY, dot(local, axes.x) / radiusX);
    }
};

bool readConic(const IfcFile& file, RecordIndex curve, Conic& conic) {
    const Fields fields = file.fieldsOf(curve);
    const bool isCircle = file.entityOf(curve) == Entity::Circle;
    conic.axes = file.axes(fields[at::Conic::Position]);
    conic.radiusX = file.metres(isCircle ? fields[at::Circle::Radius] : fields[at::Ellipse::SemiAxis1]);
    conic.radiusY = isCircle ? conic.radiusX : file.metres(fields[at::Ellipse::SemiAxis2]);
    return conic.radiusX > 0 && conic.radiusY > 0;
}

// A trim of a curve: a point, a parameter, or both.
struct Trim {
    std::optional<Vec3d> point;
    std::optional<double> parameter;
};

Trim readTrim(const IfcFile& file, Value list) {
    Trim trim;
    step::ValueCursor cursor(list);
    for (Value item; cursor.next(item);) {
        if (item.reference())
            trim.point = file.point(item);
        else
            trim.parameter = item.number();
    }
    return trim;
}

bool readTrimmedConic(const IfcFile& file, RecordIndex basis, Trim from, Trim to, bool isForward, bool prefersPoints,
                      std::vector<Vec3d>& points) {
    Conic conic;
    if (!readConic(file, basis, conic)) return false;
    const auto angleOf = [&](const Trim& trim) -> std::optional<double> {
        if (trim.point && (prefersPoints || !trim.parameter)) return conic.angleOf(*trim.point);
        if (trim.parameter) return *trim.parameter * file.angleUnit;
        return std::nullopt;
    };
    const auto begin = angleOf(from), end = angleOf(to);
    if (!begin || !end) return false;
    double turn = std::fmod(isForward ? *end - *begin : *begin - *end, 2 * kPi);
    if (turn < 1e-9) turn += 2 * kPi;
    std::vector<Vec3d> arc;
    appendArc(conic.axes, conic.radiusX, conic.radiusY, *begin, isForward ? *begin + turn : *begin - turn, arc);
    appendPart(arc, points);
    return true;
}

double distanceToSegment(Vec3d p, Vec3d a, Vec3d b, double& share) noexcept {
    const Vec3d ab = b - a;
    const double size = dot(ab, ab);
    share = size > 0 ? std::clamp(dot(p - a, ab) / size, 0.0, 1.0) : 0;
    return length(p - (a + ab * share));
}

// The position of a point on a polyline: number of the segment plus the share of it.
double parameterOf(const std::vector<Vec3d>& line, Vec3d p) noexcept {
    double best = kInfinity, parameter = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        double share = 0;
        const double distance = distanceToSegment(p, line[i], line[i + 1], share);
        if (distance < best) {
            best = distance;
            parameter = double(i) + share;
        }
    }
    return parameter;
}

// The part of a line of two or more points between two points on it.
std::vector<Vec3d> partBetween(std::vector<Vec3d> whole, Vec3d from, Vec3d to, bool isForward) {
    if (!isForward) std::reverse(whole.begin(), whole.end());
    const bool isClosed = length(whole.front() - whole.back()) < 1e-6;
    const double begin = parameterOf(whole, from);
    double end = parameterOf(whole, to);
    const std::size_t count = whole.size() - 1;
    if (isClosed && end <= begin + 1e-9) end += double(count);
    std::vector<Vec3d> part{from};
    for (std::size_t i = std::size_t(begin) + 1; double(i) < end; ++i)
        part.push_back(whole[i >= count ? i - count : i]);
    part.push_back(to);
    return part;
}

bool isOnSurface(Entity entity) noexcept {
    return entity == Entity::SurfaceCurve || entity == Entity::SeamCurve || entity == Entity::IntersectionCurve;
}

// readCurveBetween() with the points of the curve, or none to read them. Reading a curve only once keeps a chain of
// curves that trim each other from doubling the work at each level.
bool readBetween(const IfcFile& file, RecordIndex curve, std::vector<Vec3d> whole, Vec3d from, Vec3d to, bool isForward,
                 std::vector<Vec3d>& points, std::string& why) {
    ReadGuard::Scope scope(file.guard());
    const Entity entity = file.entityOf(curve);
    if (entity == Entity::Line) {
        appendPart({from, to}, points);
        return true;
    }
    std::vector<Vec3d> part;
    if (isOnSurface(entity)) {
        if (!scope.enter(curve, why)) return false;
        return readBetween(file, file.follow(curve, at::SurfaceCurve::Curve3D), std::move(whole), from, to, isForward,
                           points, why);
    }
    if (entity == Entity::Circle || entity == Entity::Ellipse) {
        if (!readTrimmedConic(file, curve, {from, {}}, {to, {}}, isForward, true, part)) return false;
    } else {
        if (whole.empty() && !readCurve(file, curve, whole, why)) return false;
        if (whole.size() < 2) return false;
        part = partBetween(std::move(whole), from, to, isForward);
    }
    part.front() = from;
    part.back() = to;
    appendPart(part, points);
    return true;
}

bool readTrimmedCurve(const IfcFile& file, const Fields& fields, std::vector<Vec3d>& points, std::string& why) {
    const RecordIndex basis = file.follow(fields[at::TrimmedCurve::BasisCurve]);
    const Trim from = readTrim(file, fields[at::TrimmedCurve::Trim1]),
               to = readTrim(file, fields[at::TrimmedCurve::Trim2]);
    const bool isForward = fields[at::TrimmedCurve::SenseAgreement].enumeration() != "F",
               prefersPoints = fields[at::TrimmedCurve::MasterRepresentation].enumeration() != "PARAMETER";
    switch (file.entityOf(basis)) {
        case Entity::Circle:
        case Entity::Ellipse: return readTrimmedConic(file, basis, from, to, isForward, prefersPoints, points);
        case Entity::Line: {
            const Fields line = file.fieldsOf(basis), vector = file.fieldsOf(file.follow(line[at::Line::Dir]));
            const Vec3d origin = file.point(line[at::Line::Pnt]).value_or(Vec3d{});
            const Vec3d step = normalized(file.direction(vector[at::Vector::Orientation]).value_or(Vec3d{1, 0, 0})) *
                               file.metres(vector[at::Vector::Magnitude], 1);
            const auto pointOf = [&](const Trim& trim) {
                return trim.point && (prefersPoints || !trim.parameter) ? *trim.point
                                                                        : origin + step * trim.parameter.value_or(0);
            };
            appendPart({pointOf(from), pointOf(to)}, points);
            return true;
        }
        default: {
            // Trims are nearly always the ends of the curve.
            std::vector<Vec3d> whole;
            if (!readCurve(file, basis, whole, why) || whole.size() < 2) return false;
            if (from.point && to.point)
                return readBetween(file, basis, std::move(whole), *from.point, *to.point, isForward, points, why);
            why = "a trimmed curve by parameters of another curve than a line or conic";
            return false;
        }
    }
}

bool readBSpline(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points) {
    const auto spline = readBSplineCurve(file, curve);
    if (!spline) return false;
    const KnotVector& knots = spline->knots;
    // Each of 17 points of a span is a sum over the square of the order.
    if (!file.guard().takeSteps(17 * knots.count * (knots.degree + 1) * (knots.degree + 1))) return false;
    std::vector<Vec3d> sampled;
    for (std::size_t span = knots.degree; span < knots.count; ++span) {
        const double low = knots.knots[span], high = knots.knots[span + 1];
        if (high <= low) continue;
        const int steps = knots.degree == 1 ? 1 : 16;
        for (int s = 0; s <= steps; ++s)
            sampled.push_back(spline->at(s == steps ? high : low + (high - low) * s / steps));
    }
    appendPart(sampled, points);
    return points.size() >= 2;
}

bool readComposite(const IfcFile& file, const Fields& fields, std::vector<Vec3d>& points, std::string& why) {
    std::vector<std::vector<Vec3d>> pieces;
    for (const RecordIndex segment : file.followAll(fields[at::CompositeCurve::Segments])) {
        const Fields part = file.fieldsOf(segment);
        std::vector<Vec3d> piece;
        if (!readCurve(file, file.follow(part[at::CompositeCurveSegment::ParentCurve]), piece, why)) return false;
        if (part[at::CompositeCurveSegment::SameSense].enumeration() == "F") std::reverse(piece.begin(), piece.end());
        if (!piece.empty()) pieces.push_back(std::move(piece));
    }
    // Writers disagree about the sense of trimmed lines, so pieces are turned until they connect.
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Vec3d from = pieces[i].front(), to = pieces[i].back();
        if (i > 0) {
            const Vec3d end = pieces[i - 1].back();
            if (length(from - end) > 1e-6 && length(to - end) < length(from - end))
                std::reverse(pieces[i].begin(), pieces[i].end());
        } else if (pieces.size() > 1) {
            const Vec3d a = pieces[1].front(), b = pieces[1].back();
            const double ahead = std::min(length(to - a), length(to - b)),
                         behind = std::min(length(from - a), length(from - b));
            if (ahead > 1e-6 && behind < 1e-6) std::reverse(pieces[0].begin(), pieces[0].end());
        }
    }
    for (const std::vector<Vec3d>& piece : pieces) appendPart(piece, points);
    return points.size() >= 2;
}

}  // namespace

SineCosine sineCosine(double angle) noexcept {
    constexpr double kDigits = 1e12;
    return {std::round(std::sin(angle) * kDigits) / kDigits, std::round(std::cos(angle) * kDigits) / kDigits};
}

int arcSegments(double radius, double angle, int minSegments) noexcept {
    const double share = std::min(std::abs(angle) / (2 * kPi), 4.0);
    double whole = minSegments;
    if (radius > kChordError) whole = std::max(whole, kPi / std::acos(1 - kChordError / radius));
    whole = std::min<double>(whole, kMaxSegments);
    const double count = std::ceil(share * std::ceil(whole / 4) * 4 - 1e-6);
    return std::max(1, static_cast<int>(count));
}

void appendArc(const Transform& axes, double radiusX, double radiusY, double from, double to,
               std::vector<Vec3d>& points) {
    const int count = arcSegments(std::max(radiusX, radiusY), to - from);
    for (int i = 0; i <= count; ++i) {
        const auto [sine, cosine] = sineCosine(i == count ? to : from + (to - from) * i / count);
        points.push_back(axes.point({radiusX * cosine, radiusY * sine, 0}));
    }
}

bool readCurve(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points, std::string& why) {
    ReadGuard::Scope scope(file.guard());
    if (!scope.enter(curve, why)) return false;
    const Entity entity = file.entityOf(curve);
    const std::size_t before = points.size();
    const Fields fields = file.fieldsOf(curve);
    bool isRead = false;
    switch (entity) {
        case Entity::Polyline:
            isRead = true;
            for (const RecordIndex record : file.followAll(fields[at::Polyline::Points])) {
                const auto point = file.point(record);
                isRead = isRead && point;
                if (point) appendPart({*point}, points);
            }
            break;
        case Entity::IndexedPolyCurve: isRead = readIndexedPolyCurve(file, fields, points); break;
        case Entity::CompositeCurve:
        case Entity::CompositeCurveOnSurface:
        case Entity::GradientCurve:
        case Entity::SegmentedReferenceCurve:
            isRead = isOfCurveSegments(file, curve) ? readCurveSegments(file, curve, points, why)
                                                    : readComposite(file, fields, points, why);
            break;
        case Entity::TrimmedCurve: isRead = readTrimmedCurve(file, fields, points, why); break;
        case Entity::Circle:
        case Entity::Ellipse:
            if (Conic conic; readConic(file, curve, conic)) {
                appendArc(conic.axes, conic.radiusX, conic.radiusY, 0, 2 * kPi, points);
                points.back() = points.front();
                isRead = true;
            }
            break;
        case Entity::BSplineCurveWithKnots:
        case Entity::RationalBSplineCurveWithKnots: isRead = readBSpline(file, curve, points); break;
        case Entity::SurfaceCurve:
        case Entity::SeamCurve:
        case Entity::IntersectionCurve:
            return readCurve(file, file.follow(fields[at::SurfaceCurve::Curve3D]), points, why);
        default:
            if (why.empty()) why = fmt::format("the curve {}", file.typeName(curve).substr(0, 60));
            return false;
    }
    isRead = isRead && points.size() <= kMaxPoints;
    if (!file.guard().takeElements(points.size() - before)) {
        why = file.guard().whatIsSpent();
        return false;
    }
    if (!isRead && why.empty()) why = fmt::format("values of a curve {}", entityName(entity));
    return isRead;
}

bool readCurveBetween(const IfcFile& file, RecordIndex curve, Vec3d from, Vec3d to, bool isForward,
                      std::vector<Vec3d>& points, std::string& why) {
    return readBetween(file, curve, {}, from, to, isForward, points, why);
}

bool appendNumbered(Value numbers, const std::vector<Vec3d>& points, std::vector<Vec3d>& result) {
    bool areInRange = true;
    step::ValueCursor cursor(numbers);
    for (Value item; cursor.next(item);) {
        const auto number = item.integer();
        if (number && *number >= 1 && *number <= std::int64_t(points.size()))
            result.push_back(points[std::size_t(*number - 1)]);
        else
            areInRange = false;
    }
    return areInRange;
}

void closeRing(std::vector<Vec3d>& points, double distance) {
    std::vector<Vec3d> kept;
    for (const Vec3d p : points)
        if (kept.empty() || length(p - kept.back()) > distance) kept.push_back(p);
    while (kept.size() > 1 && length(kept.front() - kept.back()) <= distance) kept.pop_back();
    points = std::move(kept);
}

double twiceArea(const std::vector<Vec3d>& ring) noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3d a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

}  // namespace svt::readers::ifc
