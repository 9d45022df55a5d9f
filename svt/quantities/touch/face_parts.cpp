#include <svt/quantities/touch/face_parts.hpp>

#include <svt/plane/arrangement.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace svt::quantities {
namespace {

using plane::Point;

constexpr double kFinestStep = 0x1p-20;       // metres per unit
constexpr double kMostUnits = 0x1p28;         // an arrangement accepts twice as much
constexpr double kSnap = 4e-6;                // metres
constexpr double kMargin = 1e-3;              // metres of the frame around the face
constexpr std::int64_t kOpenUnits = 64;       // by which the ends of a section may differ
constexpr std::size_t kMostCuts = 1U << 20U;  // of edges by lines

// Brings segments into a frame around the face. Points beyond it move to its border: sections stay closed, and
// enclose the same places of the frame.
class Framed {
public:
    explicit Framed(std::span<const FlatSegment> segments) {
        for (const FlatSegment& segment : segments)
            if (segment.claim == 0)
                for (std::size_t a = 0; a < 2; ++a) {
                    low_[a] = std::min(low_[a], segment.from[a] - kMargin);
                    high_[a] = std::max(high_[a], segment.from[a] + kMargin);
                }
        while (std::max(high_[0] - low_[0], high_[1] - low_[1]) / unit_ > kMostUnits) unit_ *= 2;
        for (const FlatSegment& segment : segments) add(segment);
    }

    [[nodiscard]] bool areClosed() const {
        std::map<std::uint32_t, Point> sums;
        for (const plane::ClaimSegment& segment : framed_) {
            Point& sum = sums[segment.claim];
            sum = sum - (segment.from - segment.to);
        }
        return std::all_of(sums.begin(), sums.end(), [](const auto& one) {
            return std::abs(one.second.u) <= kOpenUnits && std::abs(one.second.v) <= kOpenUnits;
        });
    }

    [[nodiscard]] std::optional<plane::Arrangement> arranged() const {
        std::optional<plane::Arrangement> result;
        auto tolerance = std::max(2, static_cast<std::int32_t>(std::lround(kSnap / unit_)));
        for (int trial = 0; trial < 2 && !result; ++trial, tolerance *= 8)
            result = plane::arrangeSegments(framed_, tolerance);
        return result;
    }
    [[nodiscard]] double unit() const noexcept { return unit_; }
    [[nodiscard]] const FlatPoint& low() const noexcept { return low_; }

private:
    [[nodiscard]] Point placed(const FlatPoint& p) const {
        const auto at = [&](std::size_t a) {
            return std::llround((std::clamp(p[a], low_[a], high_[a]) - low_[a]) / unit_);
        };
        return {at(0), at(1)};
    }

    void add(const FlatSegment& segment) {
        const FlatPoint p = segment.from, q = segment.to;
        std::array<double, 6> cuts{0, 1, 1, 1, 1, 1};
        std::size_t count = 1;
        for (std::size_t a = 0; a < 2; ++a)
            for (const double line : {low_[a], high_[a]})
                if ((p[a] < line) != (q[a] < line)) cuts[count++] = (line - p[a]) / (q[a] - p[a]);
        std::sort(cuts.begin(), cuts.begin() + std::ptrdiff_t(count));
        Point from = placed(p);
        for (std::size_t n = 1; n <= count; ++n) {
            const double t = cuts[n];
            const Point to = n == count ? placed(q) : placed({p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t});
            if (!(from == to)) framed_.push_back({from, to, segment.claim, 1});
            from = to;
        }
    }

    FlatPoint low_{kInfinity, kInfinity}, high_{-kInfinity, -kInfinity};
    double unit_ = kFinestStep;
    std::vector<plane::ClaimSegment> framed_;
};

// Parts between the vertical lines through all ends of edges.
class Strips {
public:
    Strips(const plane::Arrangement& arrangement, const Framed& framed) : arranged_(arrangement), framed_(framed) {}

    std::optional<FaceParts> run() {
        std::vector<std::int64_t> lines;
        for (const auto& edge : arranged_.edges) {
            lines.push_back(edge.from.u);
            lines.push_back(edge.to.u);
        }
        std::sort(lines.begin(), lines.end());
        lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
        std::vector<std::uint32_t> open;
        std::size_t next = 0, cuts = 0;
        for (std::size_t n = 0; n + 1 < lines.size(); ++n) {
            std::erase_if(open, [&](std::uint32_t e) { return arranged_.edges[e].to.u <= lines[n]; });
            for (; next < arranged_.edges.size() && arranged_.edges[next].from.u <= lines[n]; ++next)
                if (arranged_.edges[next].to.u > lines[n]) open.push_back(std::uint32_t(next));
            cuts += open.size();
            if (cuts > kMostCuts) return std::nullopt;
            addStrip(double(lines[n]), double(lines[n + 1]), open);
        }
        numberRegions();
        return std::move(result_);
    }

private:
    struct Cut {
        double low, high;  // v at both lines
        std::uint32_t edge;
    };

    void addStrip(double from, double to, const std::vector<std::uint32_t>& open) {
        std::vector<Cut> cuts;
        cuts.reserve(open.size());
        for (const std::uint32_t e : open) {
            const auto& edge = arranged_.edges[e];
            const double slope = double(edge.to.v - edge.from.v) / double(edge.to.u - edge.from.u);
            cuts.push_back({double(edge.from.v) + slope * (from - double(edge.from.u)),
                            double(edge.from.v) + slope * (to - double(edge.from.u)), e});
        }
        std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.low + a.high < b.low + b.high; });
        const std::size_t previous = current_;
        current_ = result_.parts.size();
        std::map<std::uint32_t, std::int32_t> counts;
        for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
            const auto& edge = arranged_.edges[cuts[n].edge];
            for (std::uint32_t m = edge.firstMark; m < edge.endMark; ++m)
                counts[arranged_.marks[m].claim] += arranged_.marks[m].winding;
            if (counts[0] <= 0) continue;
            addPart(from, to, cuts[n], cuts[n + 1], counts);
        }
        join(previous);
    }

    void addPart(double from, double to, const Cut& below, const Cut& above,
                 const std::map<std::uint32_t, std::int32_t>& counts) {
        std::vector<std::uint32_t> set;
        for (const auto& [claim, count] : counts)
            if (claim != 0 && count > 0) set.push_back(claim);
        const auto known = sets_.try_emplace(std::move(set), std::uint32_t(sets_.size())).first;
        const double unit = framed_.unit(), u = framed_.low()[0], v = framed_.low()[1];
        FacePart part;
        part.u = {u + from * unit, u + to * unit};
        part.low = {v + below.low * unit, v + below.high * unit};
        part.high = {v + above.low * unit, v + above.high * unit};
        part.area = 0.5 * (to - from) * std::max(0.0, above.low - below.low + above.high - below.high) * unit * unit;
        part.claims = known->second;
        part.region = std::uint32_t(parent_.size());
        parent_.push_back(part.region);
        result_.parts.push_back(part);
    }

    // Joins parts to those of the strip before that they touch.
    void join(std::size_t previous) {
        std::size_t before = previous;
        for (std::size_t n = current_; n < result_.parts.size(); ++n) {
            const FacePart& part = result_.parts[n];
            while (before < current_ && result_.parts[before].high[1] <= part.low[0]) ++before;
            for (std::size_t m = before; m < current_ && result_.parts[m].low[1] < part.high[0]; ++m) {
                const FacePart& other = result_.parts[m];
                const double shared = std::min(part.high[0], other.high[1]) - std::max(part.low[0], other.low[1]);
                const bool isBeside = other.u[1] == part.u[0] && other.claims == part.claims && shared > 2 * kSnap;
                if (isBeside) parent_[rootOf(part.region)] = rootOf(other.region);
            }
        }
    }

    std::uint32_t rootOf(std::uint32_t n) {
        while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
        return n;
    }

    void numberRegions() {
        std::map<std::uint32_t, std::uint32_t> numbers;
        for (FacePart& part : result_.parts)
            part.region = numbers.try_emplace(rootOf(part.region), std::uint32_t(numbers.size())).first->second;
        result_.regions = numbers.size();
        result_.claims.resize(sets_.size());
        for (const auto& [set, number] : sets_) result_.claims[number] = set;
    }

    const plane::Arrangement& arranged_;
    const Framed& framed_;
    FaceParts result_;
    std::size_t current_ = 0;  // first part of the strip
    std::map<std::vector<std::uint32_t>, std::uint32_t> sets_;
    std::vector<std::uint32_t> parent_;  // by part
};

}  // namespace

std::optional<std::vector<std::uint32_t>> claimsOfAll(std::span<const FlatSegment> sections, const FlatPoint& low,
                                                      const FlatPoint& high) {
    constexpr double kNear = 5 * kSnap;
    const double u = (low[0] + high[0]) / 2, v = (low[1] + high[1]) / 2;
    std::map<std::uint32_t, int> counts;
    for (const auto& [from, to, claim] : sections) {
        const bool isBeside = std::max(from[0], to[0]) < low[0] - kNear || std::min(from[0], to[0]) > high[0] + kNear ||
                              std::max(from[1], to[1]) < low[1] - kNear || std::min(from[1], to[1]) > high[1] + kNear;
        if (!isBeside) return std::nullopt;
        // Borders above the middle: one that leads back has the claim below it.
        if ((from[0] <= u) == (to[0] <= u)) continue;
        if (from[1] + (to[1] - from[1]) * (u - from[0]) / (to[0] - from[0]) > v)
            counts[claim] += from[0] > to[0] ? 1 : -1;
    }
    std::vector<std::uint32_t> claims;
    for (const auto& [claim, count] : counts)
        if (count > 0) claims.push_back(claim);
    return claims;
}

std::optional<FaceParts> divideFace(std::span<const FlatSegment> segments) {
    const Framed framed(segments);
    if (!framed.areClosed()) return std::nullopt;
    const std::optional<plane::Arrangement> arranged = framed.arranged();
    if (!arranged) return std::nullopt;
    return Strips(*arranged, framed).run();
}

}  // namespace svt::quantities
