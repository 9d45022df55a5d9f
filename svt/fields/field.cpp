#include <svt/fields/field.hpp>

#include <algorithm>
#include <cmath>

namespace svt::fields {

std::size_t placeCount(const FieldHead& head, std::size_t labelCount) noexcept {
    switch (head.kind) {
        case FieldKind::Grid:
            return static_cast<std::size_t>(head.lattice.size.x) * static_cast<std::size_t>(head.lattice.size.y) *
                   static_cast<std::size_t>(head.lattice.size.z);
        case FieldKind::Label: return labelCount;
        case FieldKind::Points: return head.points.size();
    }
    return 0;
}

std::optional<std::pair<float, float>> rangeOf(const Field& field) noexcept {
    std::optional<std::pair<float, float>> range;
    for (const float value : field.values) {
        if (std::isnan(value)) continue;
        if (!range) range.emplace(value, value);
        range->first = std::min(range->first, value);
        range->second = std::max(range->second, value);
    }
    return range;
}

Field lengthsOf(const Field& vectors) {
    Field lengths;
    lengths.head = vectors.head;
    lengths.head.components = 1;
    const auto components = static_cast<std::size_t>(vectors.head.components);
    const std::size_t times = std::max<std::size_t>(1, vectors.head.times.size());
    const std::size_t places = vectors.values.size() / (times * components);
    lengths.values.reserve(times * places);
    for (std::size_t t = 0; t < times; ++t)
        for (std::size_t p = 0; p < places; ++p) {
            double sum = 0;
            for (std::size_t c = 0; c < components; ++c) {
                const double value = vectors.values[p + places * (c + components * t)];
                sum += value * value;
            }
            lengths.values.push_back(static_cast<float>(std::sqrt(sum)));
        }
    return lengths;
}

}  // namespace svt::fields
