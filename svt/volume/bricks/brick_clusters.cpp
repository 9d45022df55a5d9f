#include <svt/core/parallel.hpp>
#include <svt/volume/bricks/brick_clusters.hpp>

#include <algorithm>
#include <bit>

namespace svt::volume {
namespace {

constexpr std::int32_t kPerCluster = BrickClusters::kSize;
constexpr std::uint32_t kNoBox = 0xFFFFFFFFu;
constexpr std::uint64_t kWholeCluster = ~std::uint64_t{0};

// Bricks [from, to) of a cluster along an axis, as bits.
constexpr std::uint64_t layersAlong(int axis, std::int32_t from, std::int32_t to) noexcept {
    std::uint64_t bits = 0;
    for (std::int32_t brick = 0; brick < 64; ++brick) {
        const std::int32_t place = axis == 0 ? brick & 3 : axis == 1 ? brick >> 2 & 3 : brick >> 4;
        if (place >= from && place < to) bits |= std::uint64_t{1} << brick;
    }
    return bits;
}
using LayerTable = std::array<std::array<std::array<std::uint64_t, kPerCluster + 1>, kPerCluster + 1>, 3>;
constexpr LayerTable makeLayers() noexcept {
    LayerTable table{};
    for (int axis = 0; axis < 3; ++axis)
        for (std::int32_t from = 0; from <= kPerCluster; ++from)
            for (std::int32_t to = 0; to <= kPerCluster; ++to)
                table[std::size_t(axis)][std::size_t(from)][std::size_t(to)] = layersAlong(axis, from, to);
    return table;
}
constexpr LayerTable kLayerBits = makeLayers();

class BoxFinder {
public:
    BoxFinder(BrickClusters& volume, int threads) : volume_(volume) {
        boxOfCluster_.assign(volume_.entries.size(), kNoBox);
        findScalars(threads);
        // As many as there are bricks, but limited to a fraction of a second.
        budget_ = std::min<std::int64_t>(512 * static_cast<std::int64_t>(volume_.entries.size()), kMostLooks);
    }

    std::vector<BrickBox> find() {
        forEachCluster([&](Vec3i at, std::size_t cluster) {
            const std::uint32_t entry = volume_.entries[cluster];
            if ((entry & BrickClusters::kMixed) != 0 || boxOfCluster_[cluster] != kNoBox) return;
            addBox({at * kPerCluster, clipped(at * kPerCluster + Vec3i{kPerCluster, kPerCluster, kPerCluster}), entry});
        });
        forEachCluster([&](Vec3i at, std::size_t cluster) {
            if ((volume_.entries[cluster] & BrickClusters::kMixed) == 0) return;
            const std::size_t mixed = volume_.entries[cluster] & ~BrickClusters::kMixed;
            for (std::size_t brick = 0; brick < 64; ++brick) {
                const std::uint32_t entry = volume_.mixed[mixed][brick];
                const auto n = static_cast<std::int32_t>(brick);
                const Vec3i seed = at * kPerCluster + Vec3i{n & 3, n >> 2 & 3, n >> 4};
                if ((entry & BrickTag::kBoxed) != 0 || !isInside(seed)) continue;
                addBox({seed, seed + Vec3i{1, 1, 1}, entry});
            }
        });
        for (std::size_t cluster = 0; cluster < boxOfCluster_.size(); ++cluster)
            if ((volume_.entries[cluster] & BrickClusters::kMixed) == 0)
                volume_.entries[cluster] = boxOfCluster_[cluster];
        repeatAtBorder();
        return std::move(boxes_);
    }

private:
    // Maximum number of inspected clusters for all boxes, and for each further box when these are used up.
    static constexpr std::int64_t kMostLooks = std::int64_t{1} << 24, kLooksOfSmall = 256;

    // The bricks of a mixed cluster that have a scalar, with one list for all clusters.
    struct ScalarBricks {
        std::uint32_t scalar;
        std::uint64_t bricks;
    };

    void findScalars(int threads) {
        scalars_.resize(volume_.mixed.size());
        parallelFor(volume_.mixed.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t mixed = begin; mixed < end; ++mixed) {
                std::vector<ScalarBricks>& found = scalars_[mixed];
                for (std::size_t brick = 0; brick < 64; ++brick) {
                    const std::uint32_t entry = volume_.mixed[mixed][brick];
                    if ((entry & BrickTag::kBoxed) != 0) continue;
                    auto known = std::find_if(found.begin(), found.end(),
                                              [&](const ScalarBricks& other) { return other.scalar == entry; });
                    if (known == found.end()) known = found.insert(known, {entry, 0});
                    known->bricks |= std::uint64_t{1} << brick;
                }
            }
        });
    }

    template <class Body>
    void forEachCluster(const Body& body) const {
        std::size_t cluster = 0;
        for (std::int32_t z = 0; z < volume_.clusters.z; ++z)
            for (std::int32_t y = 0; y < volume_.clusters.y; ++y)
                for (std::int32_t x = 0; x < volume_.clusters.x; ++x) body(Vec3i{x, y, z}, cluster++);
    }
    [[nodiscard]] bool isInside(Vec3i brick) const noexcept {
        return brick.x < volume_.bricks.x && brick.y < volume_.bricks.y && brick.z < volume_.bricks.z;
    }
    [[nodiscard]] Vec3i clipped(Vec3i brick) const noexcept {
        return {std::min(brick.x, volume_.bricks.x), std::min(brick.y, volume_.bricks.y),
                std::min(brick.z, volume_.bricks.z)};
    }

    // Calls body(cluster, bricks) for each cluster that contains some of the bricks [min, max), with these bricks as
    // bits. Stops when `body` returns false; returns true if all calls returned true.
    template <class Body>
    bool forEachIn(Vec3i min, Vec3i max, const Body& body) {
        const auto bitsOf = [&](int axis, std::int32_t cluster) {
            const std::int32_t first = cluster * kPerCluster;
            return kLayerBits[std::size_t(axis)][std::size_t(std::max(min[axis] - first, 0))]
                             [std::size_t(std::min(max[axis] - first, kPerCluster))];
        };
        for (std::int32_t z = min.z / kPerCluster; z * kPerCluster < max.z; ++z)
            for (std::int32_t y = min.y / kPerCluster; y * kPerCluster < max.y; ++y) {
                const std::uint64_t ofRow = bitsOf(1, y) & bitsOf(2, z);
                std::int32_t x = min.x / kPerCluster;
                for (std::size_t cluster = volume_.at(x, y, z); x * kPerCluster < max.x; ++x, ++cluster) {
                    --budget_;
                    if (!body(cluster, ofRow & bitsOf(0, x))) return false;
                }
            }
        return true;
    }

    [[nodiscard]] std::uint64_t bricksOf(std::uint32_t mixed, std::uint32_t scalar) const noexcept {
        for (const ScalarBricks& known : scalars_[mixed & ~BrickClusters::kMixed])
            if (known.scalar == scalar) return known.bricks;
        return 0;
    }
    [[nodiscard]] bool haveScalar(Vec3i min, Vec3i max, std::uint32_t scalar) {
        return forEachIn(min, max, [&](std::size_t cluster, std::uint64_t bricks) {
            const std::uint32_t entry = volume_.entries[cluster];
            if ((entry & BrickClusters::kMixed) == 0) return entry == scalar;
            return (bricks & ~bricksOf(entry, scalar)) == 0;
        });
    }

    // Moves one side of the box outwards by as many bricks as possible: to the next border of clusters, or one by one.
    void growAlong(BrickBox& box, int axis, bool isUpper, std::int64_t looks) {
        const std::int64_t least = budget_ - looks;
        while (budget_ > least) {
            std::int32_t& side = isUpper ? box.max[axis] : box.min[axis];
            const std::int32_t end = isUpper ? volume_.bricks[axis] : 0;
            const std::int32_t room = std::abs(end - side);
            if (room == 0) return;
            const std::int32_t toBorder =
                isUpper ? kPerCluster - side % kPerCluster : (side + kPerCluster - 1) % kPerCluster + 1;
            bool isGrown = false;
            for (std::int32_t step = std::min(toBorder, room); step > 0; step = step == 1 ? 0 : 1) {
                Vec3i min = box.min, max = box.max;
                min[axis] = isUpper ? side : side - step;
                max[axis] = isUpper ? side + step : side;
                if (!haveScalar(min, max, box.scalar)) continue;
                side += isUpper ? step : -step;
                isGrown = true;
                break;
            }
            if (!isGrown) return;
        }
    }

    void addBox(BrickBox box) {
        const std::int64_t looks = std::max(budget_, kLooksOfSmall);
        const std::int64_t before = budget_;
        for (int axis = 0; axis < 3; ++axis)
            for (const bool isUpper : {true, false}) growAlong(box, axis, isUpper, looks - (before - budget_));
        const auto number = static_cast<std::uint32_t>(boxes_.size());
        forEachIn(box.min, box.max, [&](std::size_t cluster, std::uint64_t bricks) {
            const std::uint32_t entry = volume_.entries[cluster];
            if ((entry & BrickClusters::kMixed) == 0) {
                if (boxOfCluster_[cluster] == kNoBox && hasAll(box, cluster, bricks)) boxOfCluster_[cluster] = number;
                return true;
            }
            ClusterEntries& entries = volume_.mixed[entry & ~BrickClusters::kMixed];
            for (std::uint64_t rest = bricks; rest != 0; rest &= rest - 1) {
                std::uint32_t& own = entries[std::size_t(std::countr_zero(rest))];
                if ((own & BrickTag::kBoxed) == 0) own = number | BrickTag::kBoxed;
            }
            return true;
        });
        boxes_.push_back(box);
    }
    // Whether `bricks` are all bricks of a cluster within the volume.
    [[nodiscard]] bool hasAll(const BrickBox& box, std::size_t cluster, std::uint64_t bricks) const noexcept {
        if (bricks == kWholeCluster) return true;
        const auto width = static_cast<std::size_t>(volume_.clusters.x), depth = std::size_t(volume_.clusters.y);
        const Vec3i first =
            Vec3i{static_cast<std::int32_t>(cluster % width), static_cast<std::int32_t>(cluster / width % depth),
                  static_cast<std::int32_t>(cluster / width / depth)} *
            kPerCluster;
        const Vec3i end = clipped(first + Vec3i{kPerCluster, kPerCluster, kPerCluster});
        for (int axis = 0; axis < 3; ++axis)
            if (box.min[axis] > first[axis] || box.max[axis] < end[axis]) return false;
        return true;
    }

    // Repeats the entries at the border of the volume beyond it.
    void repeatAtBorder() {
        forEachCluster([&](Vec3i at, std::size_t cluster) {
            const std::uint32_t entry = volume_.entries[cluster];
            const Vec3i first = at * kPerCluster, end = clipped(first + Vec3i{kPerCluster, kPerCluster, kPerCluster});
            if ((entry & BrickClusters::kMixed) == 0 || end == first + Vec3i{kPerCluster, kPerCluster, kPerCluster})
                return;
            ClusterEntries& entries = volume_.mixed[entry & ~BrickClusters::kMixed];
            for (std::int32_t n = 0; n < 64; ++n) {
                const Vec3i brick{std::min(n & 3, end.x - first.x - 1), std::min(n >> 2 & 3, end.y - first.y - 1),
                                  std::min(n >> 4, end.z - first.z - 1)};
                entries[std::size_t(n)] = entries[std::size_t(brick.x + 4 * brick.y + 16 * brick.z)];
            }
        });
    }

    BrickClusters& volume_;
    std::vector<std::vector<ScalarBricks>> scalars_;  // of mixed clusters
    std::vector<std::uint32_t> boxOfCluster_;         // of clusters of one scalar: the first box that has all of it
    std::int64_t budget_ = 0;
    std::vector<BrickBox> boxes_;
};

}  // namespace

std::vector<BrickBox> boxUniformBricks(BrickClusters& volume, int threads) { return BoxFinder(volume, threads).find(); }

}  // namespace svt::volume
