#include <svt/quantities/measure/ring.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace svt::quantities {
namespace {

constexpr std::size_t kMostStrips = 512, kMostTrianglesOfRing = 50000, kSeeds = 16, kLeastFacets = 3;
constexpr double kUprightNormal = 1e-3, kSamePlane = 1 - 1e-9, kLeastTurn = 0.02, kTurn = 2 * std::numbers::pi;
constexpr int kCuts = 6;

struct PlanPoint {
    double x = 0, y = 0;
};
PlanPoint operator-(PlanPoint a, PlanPoint b) { return {a.x - b.x, a.y - b.y}; }
double dotOf(PlanPoint a, PlanPoint b) { return a.x * b.x + a.y * b.y; }
PlanPoint planOf(const Vec3d& p) { return {p.x, p.y}; }
double angleOf(PlanPoint p) { return std::atan2(p.y, p.x); }
// In (-pi, pi].
double shortest(double angle) { return angle - kTurn * std::round(angle / kTurn); }

// All triangles in one upright plane.
struct Strip {
    PlanPoint normal;
    double place = 0, area = 0;
    double low = 1e300, high = -1e300;  // along the tangent
    bool isOuter = false, isInner = false;
    [[nodiscard]] PlanPoint tangent() const { return {-normal.y, normal.x}; }
    [[nodiscard]] PlanPoint at(double along) const {
        return {normal.x * place - normal.y * along, normal.y * place + normal.x * along};
    }
    [[nodiscard]] PlanPoint middle() const { return at((low + high) / 2); }
    [[nodiscard]] double chord() const { return high - low; }
};

constexpr std::size_t kNoStrip = ~std::size_t{0};

class RingFinder {
public:
    explicit RingFinder(std::span<const Corners> triangles) : triangles_(triangles) {}

    std::vector<UnrolledRing> find() {
        std::vector<UnrolledRing> rings;
        if (triangles_.size() > kMostTrianglesOfRing || !makeStrips() || !findCenter() || !findCircles()) return rings;
        const auto [gap, middle] = largestGap();
        const bool isClosed = gap < kLeastTurn;
        for (int n = 0; n < (isClosed ? kCuts : 1); ++n)
            rings.push_back(unrolled(isClosed ? cutAfter(kTurn * n / kCuts) : middle, isClosed));
        return rings;
    }

private:
    bool makeStrips() {
        stripOf_.assign(triangles_.size(), kNoStrip);
        for (std::size_t n = 0; n < triangles_.size(); ++n) {
            const Corners& t = triangles_[n];
            const Vec3d across = cross(t[1] - t[0], t[2] - t[0]);
            const double twice = length(across);
            if (!(twice > 0) || std::abs(across.z) > kUprightNormal * twice) continue;
            const double flat = std::hypot(across.x, across.y);
            const PlanPoint normal{across.x / flat, across.y / flat};
            const double place = dotOf(normal, planOf((t[0] + t[1] + t[2]) / 3.0));
            std::size_t s = 0;
            while (s < strips_.size() && (dotOf(strips_[s].normal, normal) < kSamePlane ||
                                          std::abs(strips_[s].place - place) > kFlatness / 2))
                ++s;
            if (s == kMostStrips) return false;
            if (s == strips_.size()) strips_.push_back({normal, place});
            Strip& strip = strips_[s];
            stripOf_[n] = s;
            strip.area += twice / 2;
            for (const Vec3d& p : t) {
                const double along = dotOf(strip.tangent(), planOf(p));
                strip.low = std::min(strip.low, along);
                strip.high = std::max(strip.high, along);
            }
        }
        return strips_.size() >= 2 * kLeastFacets;
    }

    // The middle of a chord lies on the line from the centre along its normal.
    static bool isCentred(const Strip& strip, PlanPoint center) {
        const PlanPoint to = center - strip.middle();
        const double reach = std::hypot(to.x, to.y);
        return strip.chord() > kFlatness &&
               std::abs(dotOf(strip.tangent(), to)) <= kFlatness * (1 + reach / strip.chord()) &&
               strip.chord() <= kWidestFacet * 1.05 * reach;
    }

    bool findCenter() {
        std::vector<const Strip*> largest;
        for (const Strip& strip : strips_) largest.push_back(&strip);
        std::stable_sort(largest.begin(), largest.end(),
                         [](const Strip* a, const Strip* b) { return a->area > b->area; });
        largest.resize(std::min(largest.size(), kSeeds));
        double best = 0;
        for (const Strip* a : largest)
            for (const Strip* b : largest) {
                const PlanPoint t = a->tangent(), s = b->tangent();
                const double turn = t.x * s.y - t.y * s.x;
                if (a >= b || std::abs(turn) < kLeastTurn) continue;
                const double d = dotOf(t, a->middle()), e = dotOf(s, b->middle());
                const PlanPoint center{(d * s.y - e * t.y) / turn, (e * t.x - d * s.x) / turn};
                double score = 0;
                for (const Strip& strip : strips_) score += isCentred(strip, center) ? strip.area : 0;
                if (score <= best) continue;
                best = score;
                center_ = center;
            }
        if (best == 0) return false;
        refineCenter();
        return true;
    }

    // Least squares over all chords around the centre.
    void refineCenter() {
        double xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
        for (const Strip& strip : strips_) {
            if (!isCentred(strip, center_)) continue;
            const PlanPoint t = strip.tangent();
            const double d = dotOf(t, strip.middle()), w = strip.area;
            xx += w * t.x * t.x;
            xy += w * t.x * t.y;
            yy += w * t.y * t.y;
            xd += w * t.x * d;
            yd += w * t.y * d;
        }
        const double turn = xx * yy - xy * xy;
        if (turn > 1e-9 * xx * yy) center_ = {(xd * yy - yd * xy) / turn, (yd * xx - xd * xy) / turn};
    }

    [[nodiscard]] double radiusOf(const Strip& strip) const {
        const PlanPoint a = strip.at(strip.low) - center_, b = strip.at(strip.high) - center_;
        return (std::hypot(a.x, a.y) + std::hypot(b.x, b.y)) / 2;
    }
    [[nodiscard]] bool looksOut(const Strip& strip) const { return dotOf(strip.normal, strip.middle() - center_) > 0; }

    // Marks the facets of the largest circle on one side, if they are at least half of the faces that are seen there.
    std::optional<double> circleOf(bool isOuter) {
        std::vector<std::pair<double, Strip*>> places;
        for (Strip& strip : strips_)
            if (isCentred(strip, center_) && looksOut(strip) == isOuter) places.emplace_back(radiusOf(strip), &strip);
        std::sort(places.begin(), places.end());
        std::size_t from = 0, to = 0;
        double most = 0, radius = 0;
        for (std::size_t begin = 0; begin < places.size(); ++begin) {
            double area = 0, moment = 0;
            std::size_t end = begin;
            for (; end < places.size() && places[end].first - places[begin].first <= 2 * kFlatness; ++end) {
                area += places[end].second->area;
                moment += places[end].second->area * places[end].first;
            }
            if (area <= most) continue;
            most = area;
            radius = moment / area;
            from = begin;
            to = end;
        }
        double seen = 0;
        for (const Corners& t : triangles_) {
            const Vec3d across = cross(t[1] - t[0], t[2] - t[0]) / 2.0;
            const PlanPoint out = planOf((t[0] + t[1] + t[2]) / 3.0) - center_;
            const double reach = std::hypot(out.x, out.y);
            if (reach > 0) seen += std::max(0.0, (isOuter ? 1 : -1) * (across.x * out.x + across.y * out.y) / reach);
        }
        if (to - from < kLeastFacets || most < 0.5 * seen) return {};
        for (std::size_t n = from; n < to; ++n)
            (isOuter ? places[n].second->isOuter : places[n].second->isInner) = true;
        return radius;
    }

    bool findCircles() {
        const auto outer = circleOf(true), inner = circleOf(false);
        if (!outer || !inner || *outer - *inner <= kFlatness) return false;
        outer_ = *outer;
        inner_ = *inner;
        return true;
    }

    [[nodiscard]] std::pair<double, double> anglesOf(const Strip& strip) const {
        const double a = angleOf(strip.at(strip.low) - center_), b = angleOf(strip.at(strip.high) - center_);
        const double middle = angleOf(strip.middle() - center_);
        return std::minmax(middle + shortest(a - middle), middle + shortest(b - middle));
    }

    // The widest range of angles without facets, and its middle.
    [[nodiscard]] std::pair<double, double> largestGap() const {
        std::vector<std::pair<double, double>> ranges;
        for (const Strip& strip : strips_)
            if (strip.isOuter || strip.isInner) ranges.push_back(anglesOf(strip));
        std::sort(ranges.begin(), ranges.end());
        double reached = ranges.front().second, gap = 0, middle = 0;
        ranges.emplace_back(ranges.front().first + kTurn, 0);
        for (const auto& [low, high] : ranges) {
            if (low - reached > gap) {
                gap = low - reached;
                middle = (low + reached) / 2;
            }
            reached = std::max(reached, high);
        }
        return {gap, middle};
    }

    // The next angle at which two facets meet.
    [[nodiscard]] double cutAfter(double angle) const {
        double best = kTurn, cut = angle;
        for (const Strip& strip : strips_) {
            if (!strip.isOuter) continue;
            const double low = anglesOf(strip).first;
            const double after = low - angle - kTurn * std::floor((low - angle) / kTurn);
            if (after >= best) continue;
            best = after;
            cut = low;
        }
        return cut;
    }

    [[nodiscard]] UnrolledRing unrolled(double cut, bool isClosed) const {
        UnrolledRing ring;
        ring.outer = outer_;
        ring.inner = inner_;
        ring.isClosed = isClosed;
        ring.lowest = 1e300;
        double widest = 0, narrowest = kTurn;
        for (const Strip& strip : strips_) {
            if (!strip.isOuter && !strip.isInner) continue;
            const auto [low, high] = anglesOf(strip);
            widest = std::max(widest, high - low);
            narrowest = std::min(narrowest, high - low);
        }
        ring.leastFill = std::sin(widest) / widest;
        ring.mostFill = std::sin(narrowest) / narrowest;
        const double middle = (outer_ + inner_) / 2;
        for (std::size_t n = 0; n < triangles_.size(); ++n) {
            const Corners& t = triangles_[n];
            for (const Vec3d& p : t) {
                const PlanPoint out = planOf(p) - center_;
                ring.lowest = std::min(ring.lowest, std::hypot(out.x, out.y));
                ring.highest = std::max(ring.highest, std::hypot(out.x, out.y));
            }
            const Strip* strip = stripOf_[n] == kNoStrip ? nullptr : &strips_[stripOf_[n]];
            const bool isFacet = strip != nullptr && (strip->isOuter || strip->isInner);
            const Vec3d across = cross(t[1] - t[0], t[2] - t[0]);
            const PlanPoint place = planOf((t[0] + t[1] + t[2]) / 3.0) - center_;
            const double facing = across.x * place.x + across.y * place.y;
            if (std::abs(facing) <= 1e-6 * length(across) * std::hypot(place.x, place.y)) continue;
            if (facing < 0 && !(isFacet && strip->isInner)) continue;
            FlatTriangle& flat = ring.triangles.emplace_back();
            flat.claim = facing < 0 ? kBack : isFacet && strip->isOuter ? kFront : kSeen;
            const double base = isFacet ? angleOf(strip->middle() - center_) : angleOf(place);
            double turned = base - cut;
            turned -= kTurn * std::floor(turned / kTurn);
            for (std::size_t c = 0; c < 3; ++c)
                flat.corners[c] = {middle * (turned + offsetOf(planOf(t[c]), base, isFacet ? strip : nullptr)), t[c].z};
        }
        return ring;
    }

    // The angle of a point from the middle of its facet: linear along the facet, so that straight lines stay straight.
    [[nodiscard]] double offsetOf(PlanPoint p, double base, const Strip* strip) const {
        if (strip == nullptr) return shortest(angleOf(p - center_) - base);
        const auto [low, high] = anglesOf(*strip);
        const bool isTurned = !looksOut(*strip);  // the tangent runs clockwise
        const double along = (dotOf(strip->tangent(), p) - strip->low) / strip->chord();
        return low + (isTurned ? 1 - along : along) * (high - low) - base - kTurn * std::round((low - base) / kTurn);
    }

    std::span<const Corners> triangles_;
    std::vector<Strip> strips_;
    std::vector<std::size_t> stripOf_;  // by triangle
    PlanPoint center_;
    double outer_ = 0, inner_ = 0;
};

}  // namespace

std::vector<UnrolledRing> unrollRing(std::span<const Corners> triangles) { return RingFinder(triangles).find(); }

}  // namespace svt::quantities
