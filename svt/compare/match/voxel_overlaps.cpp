#include <svt/compare/match/voxel_overlaps.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace svt::compare {
namespace {

// Counts per pair of labels. Neighbouring columns repeat the same pairs, so the last one is kept at hand.
class PairCounter {
public:
    void add(std::uint32_t was, std::uint32_t is, std::uint64_t voxels) {
        const std::uint64_t key = std::uint64_t{was} << 32 | is;
        if (last_ == nullptr || key != lastKey_) {
            last_ = &counts_[key];
            lastKey_ = key;
        }
        *last_ += voxels;
    }
    [[nodiscard]] std::vector<VoxelOverlaps::Entry> entries() const {
        std::vector<VoxelOverlaps::Entry> found;
        found.reserve(counts_.size());
        for (const auto& [key, voxels] : counts_)
            found.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key), voxels});
        std::sort(found.begin(), found.end(),
                  [](const auto& s, const auto& t) { return std::tie(s.was, s.is) < std::tie(t.was, t.is); });
        return found;
    }

private:
    std::unordered_map<std::uint64_t, std::uint64_t> counts_;
    std::uint64_t* last_ = nullptr;
    std::uint64_t lastKey_ = 0;
};

// The runs of two columns over their common samples. \param up  old sample at sample 0 of the new column
template <class Use>
void forEachCommonRun(std::span<const volume::Run> was, std::span<const volume::Run> is, std::int64_t up,
                      const Use& use) {
    if (was.empty() || is.empty()) return;
    std::int64_t at = std::max<std::int64_t>(0, up);
    std::size_t p = 0, q = 0;
    const std::int64_t end = std::min<std::int64_t>(was.back().end, is.back().end + up);
    while (at < end) {
        while (was[p].end <= at) ++p;
        while (is[q].end + up <= at) ++q;
        const std::int64_t next = std::min<std::int64_t>(was[p].end, is[q].end + up);
        use(was[p].scalar, is[q].scalar, static_cast<std::uint64_t>(next - at));
        at = next;
    }
}

}  // namespace

std::optional<Vec3i> latticeOffset(const volume::Grid& was, const volume::Grid& is) noexcept {
    constexpr double kOff = 1e-3;  // of a voxel
    if (was.axes() != is.axes()) return std::nullopt;
    const Vec3d at = was.indexFromWorld(is.origin());
    Vec3i offset{};
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(was.spacing()[axis] - is.spacing()[axis]) > 1e-9 * was.spacing()[axis]) return std::nullopt;
        if (!(std::abs(at[axis]) < 1e9) || std::abs(at[axis] - std::round(at[axis])) > kOff) return std::nullopt;
        offset[axis] = static_cast<std::int32_t>(std::round(at[axis]));
    }
    return offset;
}

VoxelOverlaps::VoxelOverlaps(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                             const std::vector<char>& isWantedOfWas, const std::vector<char>& isWantedOfIs) {
    const auto offset = latticeOffset(was.grid, is.grid);
    isOnOneLattice_ = offset.has_value();
    if (!offset) return;
    const bool isEmpty = std::find(isWantedOfWas.begin(), isWantedOfWas.end(), 1) == isWantedOfWas.end() &&
                         std::find(isWantedOfIs.begin(), isWantedOfIs.end(), 1) == isWantedOfIs.end();
    if (isEmpty) return;
    const std::vector<std::uint32_t> wasOf = was.labels.labelOfScalar(), isOf = is.labels.labelOfScalar();
    const Vec3i n = was.grid.dimension(), m = is.grid.dimension();
    PairCounter counter;
    for (std::int32_t j = std::max(0, offset->y); j < std::min(n.y, m.y + offset->y); ++j)
        for (std::int32_t i = std::max(0, offset->x); i < std::min(n.x, m.x + offset->x); ++i)
            forEachCommonRun(was.columns.column(i, j), is.columns.column(i - offset->x, j - offset->y), offset->z,
                             [&](volume::Scalar s, volume::Scalar t, std::uint64_t voxels) {
                                 const std::uint32_t a = wasOf[s], b = isOf[t];
                                 if (a == volume::kNoLabel || b == volume::kNoLabel) return;
                                 if (isWantedOfWas[a] != 0 || isWantedOfIs[b] != 0) counter.add(a, b, voxels);
                             });
    entries_ = counter.entries();
}

std::uint64_t VoxelOverlaps::of(std::uint32_t was, std::uint32_t is) const noexcept {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), std::tuple(was, is),
                                     [](const Entry& e, const auto& key) { return std::tuple(e.was, e.is) < key; });
    return at != entries_.end() && at->was == was && at->is == is ? at->voxels : 0;
}

}  // namespace svt::compare
