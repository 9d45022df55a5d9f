#include <svt/readers/ifc_shape/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::readers::ifc {
namespace {

constexpr double kNoLength = 1e-6;    // metres; segments up to this only mark the end of a curve
constexpr double kGradientStep = 5;   // metres in plan between points of a gradient
constexpr double kLongestChord = 25;  // metres
constexpr double kMostSteps = 100'000;

// The beginning of a segment: a place, and the direction ahead.
struct SegmentStart {
    RecordIndex record = kNoRecord;
    Vec3d at{}, ahead{1, 0, 0};
    double length = 0;  // metres; negative: against the parent curve
};

std::vector<SegmentStart> readStarts(const IfcFile& file, RecordIndex curve) {
    std::vector<SegmentStart> starts;
    for (const RecordIndex record : file.followAll(curve, at::CompositeCurve::Segments)) {
        if (file.entityOf(record) != Entity::CurveSegment) continue;
        const Fields fields = file.fieldsOf(record);
        const Transform axes = file.axes(fields[at::CurveSegment::Placement]);
        starts.push_back({record, axes.origin, axes.x, file.metres(fields[at::CurveSegment::SegmentLength])});
    }
    return starts;
}

// Curvature along a segment, in the direction of travel and counter-clockwise: `start` + `rate` * distance.
struct Curvature {
    double start = 0, rate = 0;
};

// Nothing for a parent curve whose curvature is of another kind, or invalid values.
std::optional<Curvature> curvatureOf(const IfcFile& file, const SegmentStart& segment) {
    const Fields fields = file.fieldsOf(segment.record);
    const RecordIndex parent = file.follow(fields[at::CurveSegment::ParentCurve]);
    const double sense = segment.length < 0 ? -1 : 1;
    switch (file.entityOf(parent)) {
        case Entity::Line: return Curvature{};
        case Entity::Circle: {
            const double radius = file.metres(file.fieldsOf(parent)[at::Circle::Radius]);
            return radius > 0 ? std::optional(Curvature{sense / radius, 0}) : std::nullopt;
        }
        case Entity::Clothoid: {
            const double constant = file.metres(file.fieldsOf(parent)[at::Clothoid::ClothoidConstant]);
            const Value from = fields[at::CurveSegment::SegmentStart];
            if (!(std::abs(constant) > 0) || from.typeName() == "IFCPARAMETERVALUE") return std::nullopt;
            const double rate = 1 / (constant * std::abs(constant));
            return Curvature{sense * file.metres(from) * rate, rate};
        }
        default: return std::nullopt;
    }
}

// Moves along a segment. The direction is known at every distance, and three Gauss points per step give the place.
bool appendCurved(const IfcFile& file, const SegmentStart& segment, Curvature curvature, std::vector<Vec3d>& points) {
    constexpr std::array<std::pair<double, double>, 3> kGauss{
        {{0.1127016653792583, 5.0 / 18}, {0.5, 8.0 / 18}, {0.8872983346207417, 5.0 / 18}}};
    const double size = std::abs(segment.length);
    const double sharpest = std::max(std::abs(curvature.start), std::abs(curvature.start + curvature.rate * size));
    const double chord = sharpest > 0 ? std::min(kLongestChord, std::sqrt(8 * kChordError / sharpest)) : size;
    const double steps = std::ceil(size / chord);
    if (!(steps >= 1 && steps <= kMostSteps) || !file.guard().takeSteps(std::uint64_t(steps) * 8)) return false;
    const double first = std::atan2(segment.ahead.y, segment.ahead.x), step = size / steps;
    Vec3d at = segment.at;
    points.push_back(at);
    for (double done = 0; done < steps; ++done) {
        for (const auto& [share, weight] : kGauss) {
            const double distance = (done + share) * step;
            const auto [sine, cosine] =
                sineCosine(first + curvature.start * distance + curvature.rate * distance * distance / 2);
            at = at + Vec3d{cosine, sine, 0} * (weight * step);
        }
        points.push_back(at);
    }
    return true;
}

// The cubic curve between the starts of two segments.
bool appendCubic(const IfcFile& file, const SegmentStart& from, const SegmentStart& to, std::vector<Vec3d>& points) {
    const double size = std::abs(from.length), steps = std::ceil(std::clamp(size, 16.0, 1000.0));
    if (!file.guard().takeSteps(std::uint64_t(steps) * 4)) return false;
    for (double done = 0; done <= steps; ++done) {
        const double t = done / steps, u = 1 - t;
        points.push_back(from.at * (u * u * (1 + 2 * t)) + from.ahead * (size * t * u * u) +
                         to.at * (t * t * (1 + 2 * u)) - to.ahead * (size * t * t * u));
    }
    return true;
}

bool readPlan(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points, std::string& why) {
    const std::vector<SegmentStart> starts = readStarts(file, curve);
    std::vector<Vec3d> all;
    for (std::size_t s = 0; s < starts.size(); ++s) {
        if (!(std::abs(starts[s].length) > kNoLength)) continue;
        // The start of a segment stands for the end of the one before.
        if (!all.empty()) all.pop_back();
        bool isRead = false;
        if (const auto curvature = curvatureOf(file, starts[s]))
            isRead = appendCurved(file, starts[s], *curvature, all);
        else if (s + 1 < starts.size())
            isRead = appendCubic(file, starts[s], starts[s + 1], all);
        if (!isRead) {
            const RecordIndex parent = file.follow(starts[s].record, at::CurveSegment::ParentCurve);
            why = fmt::format("a segment of an alignment along the curve {}", file.typeName(parent).substr(0, 60));
            return false;
        }
    }
    points.insert(points.end(), all.begin(), all.end());
    return all.size() >= 2;
}

// Heights over the distance in plan: x of a start is the distance, y the height. Lines and parabolas are cubics, so
// that the values are exact for them.
class Gradient {
public:
    explicit Gradient(std::vector<SegmentStart> starts) : starts_(std::move(starts)) {}

    [[nodiscard]] bool isValid() const noexcept {
        if (starts_.empty()) return false;
        for (std::size_t s = 0; s < starts_.size(); ++s)
            if (!(starts_[s].ahead.x > 0) || (s > 0 && starts_[s].at.x < starts_[s - 1].at.x)) return false;
        return true;
    }
    [[nodiscard]] double heightAt(double distance) const {
        const auto after = std::upper_bound(starts_.begin(), starts_.end(), distance,
                                            [](double d, const SegmentStart& start) { return d < start.at.x; });
        const SegmentStart& from = after == starts_.begin() ? *after : *(after - 1);
        const double size = after == starts_.end() ? 0 : after->at.x - from.at.x;
        if (after == starts_.begin() || !(size > kNoLength)) return from.at.y + slopeOf(from) * (distance - from.at.x);
        const double t = (distance - from.at.x) / size, u = 1 - t;
        return from.at.y * u * u * (1 + 2 * t) + slopeOf(from) * size * t * u * u + after->at.y * t * t * (1 + 2 * u) -
               slopeOf(*after) * size * t * t * u;
    }

private:
    static double slopeOf(const SegmentStart& start) noexcept { return start.ahead.y / start.ahead.x; }

    std::vector<SegmentStart> starts_;
};

bool readGradient(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points, std::string& why) {
    std::vector<Vec3d> plan;
    if (!readCurve(file, file.follow(curve, at::GradientCurve::BaseCurve), plan, why)) return false;
    const Gradient gradient(readStarts(file, curve));
    if (plan.size() < 2 || !gradient.isValid()) {
        why = "a gradient curve without segments in the order of their distances";
        return false;
    }
    double done = 0;
    points.push_back(plan.front() + Vec3d{0, 0, gradient.heightAt(0)});
    for (std::size_t p = 1; p < plan.size(); ++p) {
        const Vec3d step = plan[p] - plan[p - 1];
        const double size = std::hypot(step.x, step.y), parts = std::max(1.0, std::ceil(size / kGradientStep));
        if (!(parts <= kMostSteps) || !file.guard().takeSteps(std::uint64_t(parts) * 8)) return false;
        for (double part = 1; part <= parts; ++part) {
            const double share = part / parts;
            points.push_back(plan[p - 1] + step * share + Vec3d{0, 0, gradient.heightAt(done + size * share)});
        }
        done += size;
    }
    return true;
}

}  // namespace

bool isOfCurveSegments(const IfcFile& file, RecordIndex curve) {
    if (isMeasuredInPlan(file, curve)) return true;
    if (file.entityOf(curve) != Entity::CompositeCurve) return false;
    const std::vector<RecordIndex> segments = file.followAll(curve, at::CompositeCurve::Segments);
    return !segments.empty() && file.entityOf(segments.front()) == Entity::CurveSegment;
}

bool isMeasuredInPlan(const IfcFile& file, RecordIndex curve) noexcept {
    return file.entityOf(curve) == Entity::GradientCurve || file.entityOf(curve) == Entity::SegmentedReferenceCurve;
}

bool readCurveSegments(const IfcFile& file, RecordIndex curve, std::vector<Vec3d>& points, std::string& why) {
    switch (file.entityOf(curve)) {
        case Entity::GradientCurve: return readGradient(file, curve, points, why);
        case Entity::SegmentedReferenceCurve:
            return readCurve(file, file.follow(curve, at::GradientCurve::BaseCurve), points, why);
        default: return readPlan(file, curve, points, why);
    }
}

}  // namespace svt::readers::ifc
