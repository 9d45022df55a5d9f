#include <svt/analyze/overlaps/common_volume_of_all.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace svt::analyze {
namespace {

using Convex = std::vector<std::array<double, 2>>;  // counter-clockwise, seen from above

// The part of a convex polygon where `valueAt`, a linear function, is not negative.
template <class ValueAt>
Convex convexPart(const Convex& polygon, const ValueAt& valueAt) {
    Convex kept;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
        const auto &p = polygon[n], &q = polygon[(n + 1) % polygon.size()];
        const double atP = valueAt(p), atQ = valueAt(q);
        if (atP >= 0) kept.push_back(p);
        if ((atP >= 0) == (atQ >= 0)) continue;
        const double share = atP / (atP - atQ);
        kept.push_back({p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share});
    }
    return kept;
}

class CommonPrisms {
public:
    CommonPrisms(std::span<const std::vector<plane::RoofTriangle>* const> meshes, double ground, std::uint64_t& work)
        : meshes_(meshes), ground_(ground), work_(work), chosen_(meshes.size(), nullptr) {}

    std::optional<double> run() {
        add(0, {}, 1);
        if (!isComplete_) return std::nullopt;
        return sum_;
    }

private:
    // Adds all tuples that begin with the chosen triangles, whose projections overlap in `polygon`.
    void add(std::size_t level, const Convex& polygon, double sign) {
        if (level == meshes_.size()) {
            sum_ += sign * lowest(polygon, level, nullptr);
            return;
        }
        double minX = -kInfinity, maxX = kInfinity;
        if (level > 0) {
            minX = std::min_element(polygon.begin(), polygon.end())->front();
            maxX = std::max_element(polygon.begin(), polygon.end())->front();
        }
        for (const plane::RoofTriangle& triangle : *meshes_[level]) {
            if (triangle.minX > maxX || !isComplete_) break;
            if (triangle.maxX < minX) continue;
            if (work_ == 0) {
                isComplete_ = false;
                break;
            }
            --work_;
            const Convex part = level == 0 ? planOf(triangle) : clipTo(polygon, triangle);
            if (part.size() < 3) continue;
            chosen_[level] = &triangle;
            add(level + 1, part, sign * triangle.sign);
        }
    }

    static Convex planOf(const plane::RoofTriangle& triangle) {
        Convex plan;
        for (const Vec3d& corner : triangle.corners) plan.push_back({corner.x, corner.y});
        return plan;
    }

    static Convex clipTo(Convex polygon, const plane::RoofTriangle& triangle) {
        for (std::size_t n = 0; n < 3 && polygon.size() >= 3; ++n) {
            const Vec3d p = triangle.corners[n], way = triangle.corners[(n + 1) % 3] - p;
            polygon = convexPart(polygon, [&](const auto& q) { return way.x * (q[1] - p.y) - way.y * (q[0] - p.x); });
        }
        return polygon;
    }

    [[nodiscard]] double heightOf(const plane::RoofTriangle* triangle, const std::array<double, 2>& p) const {
        return triangle == nullptr ? ground_ : triangle->heightAt(p[0], p[1]);
    }

    // The integral of the lowest of the first `count` planes over `base`; null: the ground.
    [[nodiscard]] double lowest(const Convex& polygon, std::size_t count, const plane::RoofTriangle* base) const {
        if (polygon.size() < 3) return 0;
        if (count == 1) return integral(polygon, chosen_[0], base);
        const plane::RoofTriangle* last = chosen_[count - 1];
        Convex above = polygon;
        for (std::size_t n = 0; n + 1 < count && above.size() >= 3; ++n)
            above = convexPart(above, [&](const auto& p) { return heightOf(chosen_[n], p) - heightOf(last, p); });
        return lowest(polygon, count - 1, base) - lowest(above, count - 1, last);
    }

    [[nodiscard]] double integral(const Convex& polygon, const plane::RoofTriangle* roof,
                                  const plane::RoofTriangle* base) const {
        const auto valueAt = [&](const auto& p) { return heightOf(roof, p) - heightOf(base, p); };
        double sum = 0;
        for (std::size_t n = 1; n + 1 < polygon.size(); ++n) {
            const auto &o = polygon[0], &p = polygon[n], &q = polygon[n + 1];
            const double twice = (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
            sum += twice * (valueAt(o) + valueAt(p) + valueAt(q));
        }
        return sum / 6;
    }

    std::span<const std::vector<plane::RoofTriangle>* const> meshes_;
    double ground_;
    std::uint64_t& work_;
    std::vector<const plane::RoofTriangle*> chosen_;
    double sum_ = 0;
    bool isComplete_ = true;
};

}  // namespace

std::optional<double> commonVolumeOfAll(std::span<const std::vector<plane::RoofTriangle>* const> meshes, double ground,
                                        std::uint64_t& work) {
    return CommonPrisms(meshes, ground, work).run();
}

}  // namespace svt::analyze
