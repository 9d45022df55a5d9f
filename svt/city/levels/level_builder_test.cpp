// Coarse levels beside a second way to count: every column of detail 1 on its own, in a map.
#include <svt/city/levels/level_builder.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/svt_file.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace svt::city {
namespace {

constexpr double kSpacing = 0.5;

struct Sample {
    std::vector<volume::SemanticVolume> volumes;
    std::vector<ColumnRange> ranges;
};

volume::SemanticVolume boxes(std::array<std::int64_t, 3> first, Vec3i size, std::uint32_t seed) {
    volume::SemanticVolume result =
        volume::test::emptyVolume(size, {2 * kSpacing, 2 * kSpacing, 2 * kSpacing},
                                  {double(first[0]) + 0.5, double(first[1]) + 0.5, double(first[2]) + 0.5});
    std::uint32_t state = seed;
    const auto next = [&](std::uint32_t below) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::int32_t>((state >> 8) % below);
    };
    std::vector<volume::test::PaintedBox> painted;
    for (std::uint32_t l = 0; l < 5; ++l) {
        // The third is a part of the second.
        const char* className = l == 1 ? "Bridge" : l == 2 ? "RoofSurface" : l == 3 ? "Tunnel" : "Building";
        volume::Label& label =
            volume::test::addObject(result, "b" + std::to_string(l), className, l == 2 ? 1 : volume::kNoLabel);
        label.color = l == 1 ? Vec3f{1, 0, 0} : l == 3 ? Vec3f{0, 0, 1} : Vec3f{0, 1, 0};
        const std::int32_t x = next(std::uint32_t(size.x) - 8), y = next(std::uint32_t(size.y) - 8), top = 2 + next(9);
        painted.push_back({label.first, {x, y, 0}, {x + 5, y + 7, top}});
    }
    volume::test::paintBoxes(result, painted);
    return result;
}

// Volumes around the origin, over borders of tiles, some of them far away.
Sample sampleOf(std::int64_t reach) {
    Sample sample;
    for (std::uint32_t n = 0; n < 24; ++n) {
        const std::int64_t x = (std::int64_t(n) * 7919) % (2 * reach) - reach,
                           y = (std::int64_t(n) * 104729) % (2 * reach) - reach;
        const Vec3i size{40 + std::int32_t(n % 3) * 4, 36, 12};
        sample.volumes.push_back(boxes({x, y, std::int64_t(n % 5) * 2 - 4}, size, n + 1));
        const auto tile = [](std::int64_t first, std::int32_t length) {
            return std::int32_t((first + length / 2) >> 6);
        };
        sample.ranges.push_back({{x, y}, {x + size.x - 1, y + size.y - 1}, {6, tile(x, size.x), tile(y, size.y)}});
    }
    return sample;
}

using Shares = std::map<std::string, std::int64_t>;
struct Column {
    std::int64_t area = 0, low = 0, top = 0;
    Shares roof, side;
};
using Columns = std::map<std::pair<std::int64_t, std::int64_t>, Column>;

std::string nameOf(const volume::SemanticVolume& volume, volume::Scalar scalar) {
    const volume::Label& label = volume.labels.labels[scalar - 1];
    if (label.parent == volume::kNoLabel) return label.className;
    return volume.labels.labels[label.parent].className + "/" + label.className;
}

// What a detail's columns are by definition, by tile.
std::map<std::string, Columns> count(const Sample& sample, int detail, bool isTop) {
    std::map<std::string, Columns> tiles;
    for (std::size_t v = 0; v < sample.volumes.size(); ++v) {
        const volume::SemanticVolume& volume = sample.volumes[v];
        const TileKey own = sample.ranges[v].tile;
        const double side = 512 * std::pow(2, detail - 2);
        const TileKey tile{detail - 2, std::int32_t(std::floor((own.x * 64 + 32) / side)),
                           std::int32_t(std::floor((own.y * 64 + 32) / side))};
        Columns& columns = tiles[isTop ? "top" : tile.toString()];
        const Vec3i n = volume.grid.dimension();
        const auto at = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
            const bool isIn = i >= 0 && j >= 0 && k >= 0 && i < n.x && j < n.y && k < n.z;
            return isIn ? volume.columns.scalarAt(i, j, k) : 0;
        };
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                std::int32_t low = n.z, top = -1;
                for (std::int32_t k = 0; k < n.z; ++k)
                    if (at(i, j, k) != 0) {
                        low = std::min(low, k);
                        top = k;
                    }
                if (top < 0) continue;
                const double cell = kSpacing * std::pow(2, detail);
                Column& to = columns[{std::int64_t(std::floor((volume.grid.origin().x + i) / cell)),
                                      std::int64_t(std::floor((volume.grid.origin().y + j) / cell))}];
                const auto ground = std::int64_t(std::floor(volume.grid.origin().z));
                ++to.area;
                to.low += ground + low;
                to.top += ground + top + 1;
                ++to.roof[nameOf(volume, at(i, j, top))];
                for (std::int32_t k = low; k < top; ++k) {
                    if (at(i, j, k) == 0) continue;
                    const int open = (at(i - 1, j, k) == 0) + (at(i + 1, j, k) == 0) + (at(i, j - 1, k) == 0) +
                                     (at(i, j + 1, k) == 0);
                    if (open > 0) to.side[nameOf(volume, at(i, j, k))] += open;
                }
            }
    }
    return tiles;
}

// Whether a label says what a column has. \param whole  what counts as all eighths
void expectShares(const volume::Label& label, const Shares& shares, double whole, int detail) {
    std::string most;
    for (const auto& [name, area] : shares)
        if (most.empty() || area > shares.at(most)) most = name;
    if (detail == 2) {
        EXPECT_EQ(label.id, most);
        return;
    }
    const auto coverage = coverageOf(label);
    ASSERT_EQ(coverage.size(), std::min<std::size_t>(4, shares.size())) << label.id;
    EXPECT_EQ(coverage[0].first, most);
    for (const auto& [name, eighths] : coverage) {
        const double share = 8 * double(shares.at(name)) / whole;
        EXPECT_LE(std::abs(eighths - std::clamp(share, 1.0, 8.0)), shares.size() > 1 ? 2.0 : 0.5) << label.id;
    }
}

// Compares a column with its definition.
void expectColumn(const volume::SemanticVolume& made, std::int32_t i, std::int32_t j, const Column& own, int detail) {
    const auto runs = made.columns.column(i, j);
    const std::vector<std::uint32_t> labelOf = made.labels.labelOfScalar();
    const auto labelAt = [&](volume::Scalar scalar) -> const volume::Label& {
        return made.labels.labels[labelOf[scalar]];
    };
    const bool isFloating = runs[0].scalar == 0;
    const std::size_t highest = runs.size() - (runs.back().scalar == 0 ? 2 : 1);
    const double step = made.grid.spacing().z, bottom = made.grid.origin().z - step / 2;
    const double low = bottom + step * (isFloating ? runs[0].end : 0), high = bottom + step * runs[highest].end;
    EXPECT_LE(std::abs(low - double(own.low) / double(own.area)), step / 2);
    // At least one sample high.
    if (high - low > step) {
        EXPECT_LE(std::abs(high - double(own.top) / double(own.area)), step / 2);
    }
    expectShares(labelAt(runs[highest].scalar), own.roof, std::pow(4, detail - 1), detail);
    if (runs[highest].end - (isFloating ? runs[0].end : 0) < 2 || own.side.empty()) return;
    double faces = 0;
    for (const auto& entry : own.side) faces += double(entry.second);
    expectShares(labelAt(runs[isFloating ? 1 : 0].scalar), own.side, faces, detail);
}

using Members = std::map<std::pair<int, std::string>, std::vector<std::byte>>;

Members build(const Sample& sample, std::size_t batch, int threads, std::vector<LevelMember>* all = nullptr) {
    LevelBuilder builder(sample.ranges, kSpacing, "EPSG:25832", threads);
    Members members;
    std::map<int, std::uint64_t> last;
    for (std::size_t begin = 0; begin < sample.volumes.size(); begin += batch) {
        const auto done =
            builder.add(std::span(sample.volumes).subspan(begin, std::min(batch, sample.volumes.size() - begin)),
                        [&](LevelMember member) -> Result<void> {
                            // Each detail along the curve.
                            const std::uint64_t morton = mortonOf(member.member.tile) + 1;
                            EXPECT_GT(morton, last[member.member.detail]);
                            last[member.member.detail] = morton;
                            members[{member.member.detail, member.member.tile.toString()}] = member.bytes;
                            if (all != nullptr) all->push_back(std::move(member));
                            return {};
                        });
        EXPECT_TRUE(done);
    }
    return members;
}

TEST(LevelBuilder, HoldsTheColumnsOfEachDetail) {
    const Sample sample = sampleOf(1500);
    std::vector<LevelMember> members;
    build(sample, 5, 1, &members);
    int top = 0;
    for (const LevelMember& made : members) top = std::max(top, made.member.detail);
    ASSERT_GE(top, 4);
    std::map<int, std::map<std::string, Columns>> expected;
    for (int detail = 2; detail <= top; ++detail) expected[detail] = count(sample, detail, detail == top);
    for (const LevelMember& made : members) {
        const int detail = made.member.detail;
        const auto volume = volume::readSvt(made.bytes);
        ASSERT_TRUE(volume) << volume.error().toString();
        EXPECT_EQ(volume->grid.spacing(), spacingOf(detail, kSpacing));
        auto& tiles = expected[detail];
        const auto tile = tiles.find(detail == top ? "top" : made.member.tile.toString());
        ASSERT_TRUE(tile != tiles.end()) << made.member.tile.toString();
        Columns columns = std::move(tile->second);
        tiles.erase(tile);
        const Vec3i n = volume->grid.dimension();
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                const Vec3d at = volume->grid.origin() + scaled(Vec3d{double(i), double(j), 0}, volume->grid.spacing());
                const double cell = volume->grid.spacing().x;
                const std::pair key{std::int64_t(std::floor(at.x / cell)), std::int64_t(std::floor(at.y / cell))};
                const auto runs = volume->columns.column(i, j);
                const auto found = columns.find(key);
                if (runs.size() == 1 && runs[0].scalar == 0) {
                    EXPECT_TRUE(found == columns.end());
                    continue;
                }
                ASSERT_TRUE(found != columns.end());
                expectColumn(*volume, i, j, found->second, detail);
                columns.erase(found);
            }
        EXPECT_TRUE(columns.empty()) << detail;
    }
    for (int detail = 2; detail <= top; ++detail) EXPECT_TRUE(expected[detail].empty()) << detail;
}

TEST(LevelBuilder, GivesTheSameForAnyBatchesAndThreads) {
    const Sample sample = sampleOf(1500);
    const Members once = build(sample, 24, 1);
    EXPECT_GT(once.size(), 20u);
    EXPECT_EQ(build(sample, 1, 1), once);
    EXPECT_EQ(build(sample, 7, 3), once);
}

TEST(LevelBuilder, HasOneTileOfASmallCity) {
    Sample sample = sampleOf(40);
    std::vector<LevelMember> members;
    build(sample, 24, 1, &members);
    ASSERT_EQ(members.size(), 1u);
    EXPECT_EQ(members[0].member.detail, 2);
}

TEST(Levels, KnowTheirSizes) {
    EXPECT_EQ(spacingOf(0, 0.5), (Vec3d{0.5, 0.5, 0.5}));
    EXPECT_EQ(spacingOf(1, 0.5), (Vec3d{1, 1, 1}));
    EXPECT_EQ(spacingOf(2, 0.5), (Vec3d{2, 2, 1}));
    EXPECT_EQ(spacingOf(3, 0.5), (Vec3d{4, 4, 2}));
    EXPECT_EQ(spacingOf(9, 0.5), (Vec3d{256, 256, 4}));
    EXPECT_EQ(spacingOf(3, 5), (Vec3d{40, 40, 10}));
    EXPECT_EQ(tileSide({0, 0, 0}, 2, 0.5), 512);
    EXPECT_EQ(tileSide({3, 0, 0}, 5, 0.5), 4096);
    EXPECT_EQ(tileSide({9, 0, 0}, 1, 0.5), 512);
}

}  // namespace
}  // namespace svt::city
