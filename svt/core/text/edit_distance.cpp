#include <svt/core/edit_distance.hpp>

#include <svt/core/text.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace svt {

std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit) {
    const std::size_t more = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
    if (more > limit) return limit + 1;
    std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t k = 0; k <= b.size(); ++k) last[k] = k;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        std::size_t least = i;
        for (std::size_t k = 1; k <= b.size(); ++k) {
            const bool isSame = lowerAscii(a[i - 1]) == lowerAscii(b[k - 1]);
            row[k] = std::min({last[k] + 1, row[k - 1] + 1, last[k - 1] + (isSame ? 0 : 1)});
            const bool isSwapped = i > 1 && k > 1 && lowerAscii(a[i - 1]) == lowerAscii(b[k - 2]) &&
                                   lowerAscii(a[i - 2]) == lowerAscii(b[k - 1]);
            if (isSwapped) row[k] = std::min(row[k], beforeLast[k - 2] + 1);
            least = std::min(least, row[k]);
        }
        if (least > limit) return limit + 1;
        std::swap(beforeLast, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string_view nearestName(std::string_view word, std::span<const std::string_view> names) {
    std::string_view best;
    std::size_t distance = std::max<std::size_t>(3, word.size() / 2);
    for (const std::string_view name : names)
        if (const std::size_t d = editDistance(word, name, distance); d < distance) {
            distance = d;
            best = name;
        }
    return best;
}

}  // namespace svt
