#include <svt/readers/ifc_shape/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>

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

constexpr std::size_t kPowers = 9;

// The direction of a parent curve against that at its zero, in radians: the sum of powers[k] s^k, sine * sin(wave s) and
// cosine * (1 - cos(wave s)).
struct Turning {
    std::array<double, kPowers> powers{};
    double sine = 0, cosine = 0, wave = 0;

    [[nodiscard]] double at(double s) const noexcept {
        double turn = 0;
        for (std::size_t k = kPowers; k-- > 0;) turn = turn * s + powers[k];
        if (wave == 0) return turn;
        const SineCosine round = sineCosine(wave * s);
        return turn + sine * round.sine + cosine * (1 - round.cosine);
    }
    // At least the greatest curvature up to a distance from zero.
    [[nodiscard]] double sharpestUpTo(double s) const noexcept {
        double sharpest = wave * (std::abs(sine) + std::abs(cosine)), power = 1;
        for (std::size_t k = 1; k < kPowers; ++k, power *= s)
            sharpest += static_cast<double>(k) * std::abs(powers[k]) * power;
        return sharpest;
    }
};

// The curvature of a spiral of IFC is a sum of terms. The one of the power k is (s / constant)^k / constant, and keeps the
// sign of its constant also for even numbers of factors.
bool addTerm(const IfcFile& file, Value constant, std::size_t power, Turning& turning) {
    const auto number = constant.number();
    if (!number) return constant.isNothing();  // optional
    const double length = file.metres(constant);
    if (!(std::abs(length) > 0)) return false;
    double whole = length;
    for (std::size_t k = 0; k < power; ++k) whole *= std::abs(length);
    turning.powers[power + 1] = 1 / (whole * static_cast<double>(power + 1));
    return true;
}

// The terms of a polynomial spiral, from the highest power.
bool addTerms(const IfcFile& file, const Fields& fields, std::initializer_list<AttributePosition> terms,
              Turning& turning) {
    std::size_t power = terms.size();
    bool isValid = true;
    for (const AttributePosition term : terms) isValid = addTerm(file, fields[term], --power, turning) && isValid;
    return isValid;
}

// Nothing for a parent curve of another kind, or invalid values.
// \param size  of the segment, metres: the period of waves follows from it
std::optional<Turning> turningOf(const IfcFile& file, RecordIndex parent, double size) {
    Turning turning;
    const Fields fields = file.fieldsOf(parent);
    switch (file.entityOf(parent)) {
        case Entity::Line: return turning;
        case Entity::Circle: {
            const double radius = file.metres(fields[at::Circle::Radius]);
            turning.powers[1] = 1 / radius;
            return radius > 0 ? std::optional(turning) : std::nullopt;
        }
        case Entity::Clothoid: {
            const bool isValid = fields[at::Clothoid::ClothoidConstant].number() &&
                                 addTerm(file, fields[at::Clothoid::ClothoidConstant], 1, turning);
            return isValid ? std::optional(turning) : std::nullopt;
        }
        case Entity::CosineSpiral: {
            const double term = file.metres(fields[at::CosineSpiral::CosineTerm]);
            if (!(std::abs(term) > 0) || !addTerm(file, fields[at::CosineSpiral::ConstantTerm], 0, turning))
                return std::nullopt;
            turning.wave = kPi / size;
            turning.sine = 1 / (term * turning.wave);
            return turning;
        }
        case Entity::SineSpiral: {
            const double term = file.metres(fields[at::SineSpiral::SineTerm]);
            if (!(std::abs(term) > 0) ||
                !addTerms(file, fields, {at::SineSpiral::LinearTerm, at::SineSpiral::ConstantTerm}, turning))
                return std::nullopt;
            turning.wave = 2 * kPi / size;
            turning.cosine = 1 / (term * turning.wave);
            return turning;
        }
        case Entity::SecondOrderPolynomialSpiral: {
            namespace of = at::SecondOrderPolynomialSpiral;
            const bool isValid = addTerms(file, fields, {of::QuadraticTerm, of::LinearTerm, of::ConstantTerm}, turning);
            return isValid ? std::optional(turning) : std::nullopt;
        }
        case Entity::ThirdOrderPolynomialSpiral: {
            namespace of = at::ThirdOrderPolynomialSpiral;
            const bool isValid =
                addTerms(file, fields, {of::CubicTerm, of::QuadraticTerm, of::LinearTerm, of::ConstantTerm}, turning);
            return isValid ? std::optional(turning) : std::nullopt;
        }
        case Entity::SeventhOrderPolynomialSpiral: {
            namespace of = at::SeventhOrderPolynomialSpiral;
            const bool isValid = addTerms(file, fields,
                                          {of::SepticTerm, of::SexticTerm, of::QuinticTerm, of::QuarticTerm,
                                           of::CubicTerm, of::QuadraticTerm, of::LinearTerm, of::ConstantTerm},
                                          turning);
            return isValid ? std::optional(turning) : std::nullopt;
        }
        default: return std::nullopt;
    }
}

// The part of a parent curve that a segment uses.
struct TurningPart {
    Turning turning;
    double start = 0;  // metres along the parent curve
};

std::optional<TurningPart> turningOf(const IfcFile& file, const SegmentStart& segment) {
    const Fields fields = file.fieldsOf(segment.record);
    const RecordIndex parent = file.follow(fields[at::CurveSegment::ParentCurve]);
    const Value from = fields[at::CurveSegment::SegmentStart];
    const auto turning = turningOf(file, parent, std::abs(segment.length));
    const Entity kind = file.entityOf(parent);
    const bool isEven = kind == Entity::Line || kind == Entity::Circle;  // the same from every start
    if (!turning || (!isEven && from.typeName() == "IFCPARAMETERVALUE")) return std::nullopt;
    return TurningPart{*turning, isEven ? 0 : file.metres(from)};
}

// Moves along a segment. The direction is known at every distance, and three Gauss points per step give the place.
bool appendCurved(const IfcFile& file, const SegmentStart& segment, const TurningPart& part,
                  std::vector<Vec3d>& points) {
    constexpr std::array<std::pair<double, double>, 3> kGauss{
        {{0.1127016653792583, 5.0 / 18}, {0.5, 8.0 / 18}, {0.8872983346207417, 5.0 / 18}}};
    const double size = std::abs(segment.length), sense = segment.length < 0 ? -1 : 1;
    const double sharpest =
        part.turning.sharpestUpTo(std::max(std::abs(part.start), std::abs(part.start + segment.length)));
    const double chord = sharpest > 0 ? std::min(kLongestChord, std::sqrt(8 * kChordError / sharpest)) : size;
    const double steps = std::ceil(size / chord);
    if (!(steps >= 1 && steps <= kMostSteps) || !file.guard().takeSteps(std::uint64_t(steps) * 16)) return false;
    const double first = std::atan2(segment.ahead.y, segment.ahead.x) - part.turning.at(part.start),
                 step = size / steps;
    Vec3d at = segment.at;
    points.push_back(at);
    for (std::size_t done = 0; double(done) < steps; ++done) {
        for (const auto& [share, weight] : kGauss) {
            const double distance = (double(done) + share) * step;
            const auto [sine, cosine] = sineCosine(first + part.turning.at(part.start + sense * distance));
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
    for (std::size_t done = 0; double(done) <= steps; ++done) {
        const double t = double(done) / steps, u = 1 - t;
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
        if (const auto part = turningOf(file, starts[s]))
            isRead = appendCurved(file, starts[s], *part, all);
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
        for (std::size_t part = 1; double(part) <= parts; ++part) {
            const double share = double(part) / parts;
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

std::string inexactParts(const IfcFile& file, RecordIndex curve) {
    ReadGuard::Scope scope(file.guard());
    std::string why;
    if (!scope.enter(curve, why) || !isOfCurveSegments(file, curve)) return {};
    if (isMeasuredInPlan(file, curve)) {
        if (file.entityOf(curve) == Entity::SegmentedReferenceCurve) return "the cant of its place along a curve";
        return inexactParts(file, file.follow(curve, at::GradientCurve::BaseCurve));
    }
    for (const SegmentStart& start : readStarts(file, curve)) {
        if (!(std::abs(start.length) > kNoLength) || turningOf(file, start)) continue;
        const RecordIndex parent = file.follow(start.record, at::CurveSegment::ParentCurve);
        return fmt::format("its exact place along a curve with a segment of the type {}",
                           file.typeName(parent).substr(0, 60));
    }
    return {};
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
