#include <svt/core/hash.hpp>
#include <svt/illustrate/shell/run_sets.hpp>

#include <algorithm>

namespace svt::illustrate {
namespace {

using volume::Run;

}  // namespace

std::uint32_t RunSets::add(std::span<const Run> runs) {
    std::uint64_t hash = runs.size();
    for (const Run& run : runs) hash = mixHash(hash, std::uint64_t(run.scalar) << 32 | run.end);
    return setIndex_.findOrAdd(
        hash * kHashFactor,
        [&](std::uint32_t known) {
            const auto other = this->runs(known);
            return std::equal(runs.begin(), runs.end(), other.begin(), other.end());
        },
        [&] {
            runs_.insert(runs_.end(), runs.begin(), runs.end());
            start_.push_back(runs_.size());
            return static_cast<std::uint32_t>(start_.size() - 2);
        });
}

std::uint32_t RunSets::common(std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    if (a == kNone || b == kNone) return kNone;
    if (b < a) std::swap(a, b);
    const std::uint32_t pair = pairIndex_.findOrAdd(
        mixHash(mixHash(0, a), b) * kHashFactor,
        [&](std::uint32_t known) { return pairs_[known].a == a && pairs_[known].b == b; },
        [&] {
            scratch_.clear();
            const auto s = runs(a), t = runs(b);
            for (std::size_t i = 0, j = 0; i < s.size() && j < t.size();) {
                const std::uint32_t end = std::min(s[i].end, t[j].end);
                appendRun(scratch_, end, s[i].scalar == t[j].scalar ? s[i].scalar : 0);
                i += s[i].end == end ? 1 : 0;
                j += t[j].end == end ? 1 : 0;
            }
            const std::uint32_t common = add(scratch_);
            pairs_.push_back({a, b, common});
            return static_cast<std::uint32_t>(pairs_.size() - 1);
        });
    return pairs_[pair].common;
}

}  // namespace svt::illustrate
