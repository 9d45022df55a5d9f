#include <svt/compare/comparison.hpp>

#include <svt/compare/shape/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

namespace svt::compare {
namespace {

constexpr std::uint32_t kSeveral = 0xFFFFFFFFu;

// The shapes whose class and area occur once. A translation changes neither.
using UniqueShapes = std::map<std::tuple<std::string_view, std::int64_t>, std::uint32_t>;

UniqueShapes uniqueShapes(const volume::SemanticVolume& volume, const std::vector<Shape>& shapes) {
    UniqueShapes found;
    for (std::uint32_t s = 0; s < shapes.size(); ++s) {
        const double area = std::min(shapes[s].area * 1e4, 9e18);
        const std::tuple key(std::string_view(volume.labels.labels[shapes[s].label].className),
                             static_cast<std::int64_t>(std::llround(area)));
        if (const auto [at, isNew] = found.try_emplace(key, s); !isNew) at->second = kSeveral;
    }
    return found;
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::optional<Vec3d> estimateTranslation(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                                         double tolerance) {
    const std::vector<Shape> before = findShapes(was, {}), after = findShapes(is, is.grid.origin() - was.grid.origin());
    const UniqueShapes first = uniqueShapes(was, before), second = uniqueShapes(is, after);
    std::vector<Vec3d> offsets;
    std::array<std::vector<double>, 3> coordinates;
    for (const auto& [key, s] : first) {
        const auto at = second.find(key);
        if (s == kSeveral || at == second.end() || at->second == kSeveral) continue;
        if (!areAlike(before[s], after[at->second], tolerance)) continue;
        offsets.push_back(after[at->second].center - before[s].center);
        for (int axis = 0; axis < 3; ++axis) coordinates[std::size_t(axis)].push_back(offsets.back()[axis]);
    }
    if (offsets.empty()) return std::nullopt;
    const Vec3d median{medianOf(coordinates[0]), medianOf(coordinates[1]), medianOf(coordinates[2])};
    const auto agreeing = std::count_if(offsets.begin(), offsets.end(),
                                        [&](Vec3d offset) { return length(offset - median) <= 2 * tolerance; });
    if (static_cast<std::size_t>(agreeing) * 2 < offsets.size()) return std::nullopt;
    return median;
}

}  // namespace svt::compare
