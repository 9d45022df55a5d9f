#include <svt/analyze/shared_voxels.hpp>

#include <svt/core/parallel.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

namespace svt::analyze {
namespace {

// Whether the grids have the same samples at the same positions: dimensions and all corners are equal.
bool isSameGrid(const volume::Grid& a, const volume::Grid& b) noexcept {
    if (a.dimension() != b.dimension()) return false;
    const Vec3i n = a.dimension();
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d index;
        for (int axis = 0; axis < 3; ++axis) index[axis] = (corner >> axis & 1) != 0 ? n[axis] - 1 : 0;
        const Vec3d apart = a.indexFromWorld(b.worldFromIndex(index)) - index;
        if (std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)}) > 1e-6) return false;
    }
    return true;
}

std::string textOf(const volume::Grid& grid) {
    return fmt::format("{} x {} x {} samples of {:.6g} x {:.6g} x {:.6g} m from ({:.3f}, {:.3f}, {:.3f})",
                       grid.dimension().x, grid.dimension().y, grid.dimension().z, grid.spacing().x, grid.spacing().y,
                       grid.spacing().z, grid.origin().x, grid.origin().y, grid.origin().z);
}

using Counts = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t>;

Counts countTile(const volume::ColumnTile& first, const volume::ColumnTile& second, std::size_t width,
                 const std::vector<std::uint32_t>& labelOfFirst, const std::vector<std::uint32_t>& labelOfSecond) {
    std::unordered_map<std::uint32_t, std::uint64_t> rowPairs, columnPairs;
    for (std::size_t y = 0; y < first.rowOf.size(); ++y)
        ++rowPairs[std::uint32_t(first.rowOf[y]) << 16 | second.rowOf[y]];
    for (const auto& [rows, times] : rowPairs)
        for (std::size_t x = 0; x < width; ++x)
            columnPairs[std::uint32_t(first.rowColumns[(rows >> 16) * width + x]) << 16 |
                        second.rowColumns[(rows & 0xFFFFu) * width + x]] += times;
    Counts counts;
    for (const auto& [pair, times] : columnPairs) {
        const std::span<const volume::Run> a = first.column(pair >> 16), b = second.column(pair & 0xFFFFu);
        std::uint32_t begin = 0;
        for (std::size_t r = 0, s = 0; r < a.size() && s < b.size();) {
            const std::uint32_t end = std::min(a[r].end, b[s].end);
            const std::uint32_t one = labelOfFirst[a[r].scalar], other = labelOfSecond[b[s].scalar];
            if (one != volume::kNoLabel || other != volume::kNoLabel) counts[{one, other}] += times * (end - begin);
            begin = end;
            if (a[r].end == end) ++r;
            if (b[s].end == end) ++s;
        }
    }
    return counts;
}

}  // namespace

Result<std::vector<SharedVoxels>> sharedVoxels(const volume::SemanticVolume& first,
                                               const volume::SemanticVolume& second, int threads) {
    if (!isSameGrid(first.grid, second.grid))
        return Error(Code::BadArgument,
                     fmt::format("the volumes have different grids: {}, and {}; build the second one on the grid of "
                                 "the first (svt build --grid-of)",
                                 textOf(first.grid), textOf(second.grid)));
    const std::vector<std::uint32_t> labelOfFirst = first.labels.labelOfScalar();
    const std::vector<std::uint32_t> labelOfSecond = second.labels.labelOfScalar();
    const std::size_t count = first.columns.tiles().size(), across = std::size_t(first.columns.tilesX());
    std::vector<Counts> tiles(count);
    parallelFor(count, 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            tiles[t] =
                countTile(first.columns.tiles()[t], second.columns.tiles()[t],
                          std::size_t(first.columns.tileWidth(std::int32_t(t % across))), labelOfFirst, labelOfSecond);
    });
    Counts all;
    for (const Counts& tile : tiles)
        for (const auto& [pair, voxels] : tile) all[pair] += voxels;
    std::vector<SharedVoxels> shared;
    shared.reserve(all.size());
    for (const auto& [pair, voxels] : all) shared.push_back({pair.first, pair.second, voxels});
    return shared;
}

}  // namespace svt::analyze
