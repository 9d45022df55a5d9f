#include <svt/drawing/dimension/border_strips.hpp>

#include <algorithm>
#include <cmath>

namespace svt::drawing {

BorderStrips::BorderStrips(const SectionDrawing& drawing) {
    constexpr double kLeastHeight = 1;  // metres
    constexpr std::size_t kMostStrips = 4096;
    double high = -kInfinity;
    low_ = kInfinity;
    for (const SectionBorder& border : drawing.borders)
        for (std::size_t n = 0; n + 1 < border.points.size(); ++n) {
            edges_.push_back({&border, border.points[n], border.points[n + 1]});
            low_ = std::min({low_, border.points[n].v, border.points[n + 1].v});
            high = std::max({high, border.points[n].v, border.points[n + 1].v});
        }
    if (edges_.empty()) return;
    height_ = std::max(kLeastHeight, (high - low_) / static_cast<double>(kMostStrips - 1));
    strips_.resize(1 + std::min(kMostStrips - 1, static_cast<std::size_t>((high - low_) / height_)));
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        const auto [from, to] = std::minmax(edges_[e].a.v, edges_[e].b.v);
        for (std::size_t strip = stripOf(from); strip <= stripOf(to); ++strip) strips_[strip].push_back(e);
    }
}

std::size_t BorderStrips::stripOf(double v) const noexcept {
    return static_cast<std::size_t>(std::clamp((v - low_) / height_, 0.0, static_cast<double>(strips_.size() - 1)));
}

std::vector<BorderStrips::Edge> BorderStrips::between(double low, double high) const {
    std::vector<Edge> found;
    if (strips_.empty()) return found;
    std::vector<std::uint32_t> numbers;
    for (std::size_t strip = stripOf(low); strip <= stripOf(high); ++strip)
        numbers.insert(numbers.end(), strips_[strip].begin(), strips_[strip].end());
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (const std::uint32_t n : numbers) found.push_back(edges_[n]);
    return found;
}

}  // namespace svt::drawing
