#include <svt/readers/ifc_shape/bspline.hpp>

#include <algorithm>
#include <cmath>

namespace svt::readers::ifc {
namespace {

constexpr std::int64_t kMaxDegree = 16, kMaxMultiplicity = 1000;
constexpr std::size_t kMaxControlPoints = 1'000'000;

bool readWeights(Value list, std::size_t perList, std::vector<double>& weights) {
    const std::vector<Value> values = step::itemsOf(list);
    if (values.size() != perList) return false;
    for (const Value value : values) {
        weights.push_back(value.number().value_or(0));
        if (!(weights.back() > 0) || !std::isfinite(weights.back())) return false;
    }
    return true;
}

bool readControlPoints(const IfcFile& file, Value list, std::vector<Vec3d>& points) {
    step::ValueCursor cursor(list);
    for (Value item; cursor.next(item);) {
        const auto point = file.point(item);
        if (!point || points.size() >= kMaxControlPoints) return false;
        points.push_back(*point);
    }
    return true;
}

}  // namespace

// Piegl and Tiller, The NURBS Book, A2.2.
std::size_t KnotVector::basis(double t, std::vector<double>& values) const {
    t = std::clamp(t, begin(), end());
    const auto above =
        std::upper_bound(knots.begin() + std::ptrdiff_t(degree), knots.begin() + std::ptrdiff_t(count), t);
    const std::size_t span = std::size_t(above - knots.begin()) - 1;
    std::vector<double> left(degree + 1), right(degree + 1);
    values.assign(degree + 1, 0);
    values[0] = 1;
    for (std::size_t j = 1; j <= degree; ++j) {
        left[j] = t - knots[span + 1 - j];
        right[j] = knots[span + j] - t;
        double saved = 0;
        for (std::size_t r = 0; r < j; ++r) {
            const double width = right[r + 1] + left[j - r];
            const double part = width > 0 ? values[r] / width : 0;
            values[r] = saved + right[r + 1] * part;
            saved = left[j - r] * part;
        }
        values[j] = saved;
    }
    return span - degree;
}

std::optional<KnotVector> readKnots(Value degree, Value multiplicities, Value knots, std::size_t count) {
    const auto order = degree.integer();
    if (!order || *order < 1 || *order > kMaxDegree || count <= std::size_t(*order)) return std::nullopt;
    const std::vector<Value> times = step::itemsOf(multiplicities), values = step::itemsOf(knots);
    if (times.size() != values.size()) return std::nullopt;
    KnotVector result{std::size_t(*order), count, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto repeat = times[i].integer();
        const auto knot = values[i].number();
        if (!repeat || !knot || *repeat < 1 || *repeat > kMaxMultiplicity || !std::isfinite(*knot) ||
            (i > 0 && *knot < result.knots.back()))
            return std::nullopt;
        result.knots.insert(result.knots.end(), std::size_t(*repeat), *knot);
    }
    if (result.knots.size() != count + result.degree + 1 || !(result.begin() < result.end())) return std::nullopt;
    return result;
}

Vec3d BSplineCurve::at(double t) const {
    std::vector<double> basis;
    const std::size_t first = knots.basis(t, basis);
    Vec3d sum{};
    double weight = 0;
    for (std::size_t i = 0; i < basis.size(); ++i) {
        sum = sum + points[first + i] * (basis[i] * weights[first + i]);
        weight += basis[i] * weights[first + i];
    }
    return sum / weight;
}

Vec3d BSplineSurface::at(double atU, double atV) const {
    std::vector<double> alongU, alongV;
    const std::size_t firstU = u.basis(atU, alongU), firstV = v.basis(atV, alongV);
    Vec3d sum{};
    double weight = 0;
    for (std::size_t i = 0; i < alongU.size(); ++i)
        for (std::size_t j = 0; j < alongV.size(); ++j) {
            const std::size_t n = (firstU + i) * v.count + firstV + j;
            const double share = alongU[i] * alongV[j] * weights[n];
            sum = sum + points[n] * share;
            weight += share;
        }
    return sum / weight;
}

std::optional<BSplineCurve> readBSplineCurve(const IfcFile& file, RecordIndex curve) {
    namespace spline = at::RationalBSplineCurveWithKnots;
    const Fields fields = file.fieldsOf(curve);
    BSplineCurve result;
    if (!readControlPoints(file, fields[spline::ControlPointsList], result.points)) return std::nullopt;
    auto knots = readKnots(fields[spline::Degree], fields[spline::KnotMultiplicities], fields[spline::Knots],
                           result.points.size());
    if (!knots) return std::nullopt;
    result.knots = std::move(*knots);
    if (file.entityOf(curve) != Entity::RationalBSplineCurveWithKnots)
        result.weights.assign(result.points.size(), 1);
    else if (!readWeights(fields[spline::WeightsData], result.points.size(), result.weights))
        return std::nullopt;
    return result;
}

std::optional<BSplineSurface> readBSplineSurface(const IfcFile& file, RecordIndex surface) {
    namespace spline = at::RationalBSplineSurfaceWithKnots;
    const Fields fields = file.fieldsOf(surface);
    BSplineSurface result;
    const std::vector<Value> rows = step::itemsOf(fields[spline::ControlPointsList]);
    if (rows.empty()) return std::nullopt;
    for (const Value row : rows)
        if (!readControlPoints(file, row, result.points)) return std::nullopt;
    if (result.points.empty() || result.points.size() % rows.size() != 0) return std::nullopt;
    const std::size_t countV = result.points.size() / rows.size();
    auto u = readKnots(fields[spline::UDegree], fields[spline::UMultiplicities], fields[spline::UKnots], rows.size()),
         v = readKnots(fields[spline::VDegree], fields[spline::VMultiplicities], fields[spline::VKnots], countV);
    if (!u || !v) return std::nullopt;
    result.u = std::move(*u);
    result.v = std::move(*v);
    if (file.entityOf(surface) != Entity::RationalBSplineSurfaceWithKnots) {
        result.weights.assign(result.points.size(), 1);
        return result;
    }
    const std::vector<Value> weights = step::itemsOf(fields[spline::WeightsData]);
    if (weights.size() != rows.size()) return std::nullopt;
    for (const Value row : weights)
        if (!readWeights(row, countV, result.weights)) return std::nullopt;
    return result;
}

}  // namespace svt::readers::ifc
