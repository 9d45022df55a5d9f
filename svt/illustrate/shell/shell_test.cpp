#include <svt/illustrate/shell.hpp>
#include <svt/volume/random_columns_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_json.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <map>
#include <set>

namespace svt::illustrate {
namespace {

using volume::ColumnVolume;
using volume::kNoLabel;
using volume::Scalar;
using volume::SemanticVolume;

volume::Label label(const char* id, const char* className, std::uint32_t parent, Scalar first, Scalar count = 1) {
    volume::Label result;
    result.id = id;
    result.className = className;
    result.parent = parent;
    result.first = first;
    result.count = count;
    return result;
}

// A cube grid of 0.1 m with `paint(i, j, k)` as scalars.
template <class Paint>
SemanticVolume painted(Vec3i n, const Paint& paint, std::vector<volume::Label> labels,
                       Vec3d spacing = {0.1, 0.1, 0.1}) {
    SemanticVolume result = volume::test::emptyVolume(n, spacing);
    for (volume::Label& own : labels) volume::test::addLabel(result, std::move(own));
    volume::test::paint(result, paint);
    return result;
}

// A hull of one voxel, which is 0.1 m wide.
ShellOptions thin() {
    ShellOptions options;
    options.thickness = 0.1;
    return options;
}

// The definition, voxel by voxel: background by flood fill, boxes by looking at each of their voxels.
class BruteForce {
public:
    BruteForce(const SemanticVolume& volume, const std::vector<std::uint32_t>& groupOf)
        : volume_(volume), n_(volume.grid.dimension()) {
        const auto labelOf = volume.labels.labelOfScalar();
        for (std::int32_t k = 0; k < n_.z; ++k)
            for (std::int32_t j = 0; j < n_.y; ++j)
                for (std::int32_t i = 0; i < n_.x; ++i) {
                    const std::uint32_t l = labelOf[volume.columns.scalarAt(i, j, k)];
                    group_.push_back(l == kNoLabel ? kAir : groupOf[l] == kNoLabel ? kOther : groupOf[l]);
                    all_.push_back({i, j, k});
                }
        giveAirToGroups();
    }

    [[nodiscard]] std::vector<Scalar> shell(Vec3i reach, const std::set<std::uint32_t>& keptGroups) const {
        std::vector<Scalar> shell;
        for (const Vec3i p : all_) {
            const std::int64_t own = group_[index(p)];
            const bool isKept = own >= 0 && keptGroups.contains(static_cast<std::uint32_t>(own));
            shell.push_back(isHull(p, reach) && isKept ? volume_.columns.scalarAt(p.x, p.y, p.z) : 0);
        }
        return shell;
    }

private:
    static constexpr std::int64_t kAir = -1, kOther = -2;

    [[nodiscard]] std::size_t index(Vec3i p) const {
        return std::size_t(p.x) + std::size_t(n_.x) * (std::size_t(p.y) + std::size_t(n_.y) * std::size_t(p.z));
    }

    [[nodiscard]] bool isInGrid(Vec3i p) const {
        return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < n_.x && p.y < n_.y && p.z < n_.z;
    }

    // Air that only one group shuts in belongs to it.
    void giveAirToGroups() {
        std::vector<bool> isSeen(group_.size(), false);
        for (const Vec3i start : all_) {
            if (group_[index(start)] != kAir || isSeen[index(start)]) continue;
            std::vector<Vec3i> part;
            const std::set<std::int64_t> around = fill(start, isSeen, part);
            // Not seen again: the part keeps its place, but has the group's number from here on.
            if (around.size() == 1 && *around.begin() != kOther)
                for (const Vec3i p : part) group_[index(p)] = *around.begin();
        }
    }

    // Fills the part of the air that `start` lies in; returns the groups around it.
    std::set<std::int64_t> fill(Vec3i start, std::vector<bool>& isSeen, std::vector<Vec3i>& part) const {
        const std::vector<Vec3i> sides{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        std::deque<Vec3i> open{start};
        std::set<std::int64_t> around;
        isSeen[index(start)] = true;
        while (!open.empty()) {
            const Vec3i p = open.front();
            open.pop_front();
            part.push_back(p);
            for (const Vec3i side : sides) {
                const Vec3i q = p + side;
                if (!isInGrid(q)) {
                    around.insert(kOther);
                } else if (group_[index(q)] != kAir) {
                    around.insert(group_[index(q)]);
                } else if (!isSeen[index(q)]) {
                    isSeen[index(q)] = true;
                    open.push_back(q);
                }
            }
        }
        return around;
    }

    [[nodiscard]] bool isHull(Vec3i p, Vec3i reach) const {
        bool result = false;
        for (std::int32_t dz = -reach.z; dz <= reach.z; ++dz)
            for (std::int32_t dy = -reach.y; dy <= reach.y; ++dy)
                for (std::int32_t dx = -reach.x; dx <= reach.x; ++dx) {
                    const Vec3i q = p + Vec3i{dx, dy, dz};
                    result = result || !isInGrid(q) || group_[index(q)] != group_[index(p)];
                }
        return result;
    }

    const SemanticVolume& volume_;
    Vec3i n_;
    std::vector<std::int64_t> group_;  // of each voxel, or kAir, or kOther
    std::vector<Vec3i> all_;
};

std::vector<volume::Label> oneLabelPerScalar(std::uint32_t scalars) {
    std::vector<volume::Label> labels;
    for (Scalar s = 1; s < scalars; ++s) labels.push_back(label("l", "BuildingConstructiveElement", kNoLabel, s));
    return labels;
}

TEST(Shell, IsThatOfVoxelByVoxel) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        SemanticVolume volume;
        const Vec3i n{66 + std::int32_t(seed % 3), 65, 17};
        volume.grid =
            *volume::Grid::fromParts(n, {0.1, 0.1, 0.1}, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
        volume.columns = volume::test::randomColumns(n, seed);
        volume.labels.labels = oneLabelPerScalar(volume::test::kRandomScalars);
        // Four groups, and every ninth label in none.
        std::vector<std::uint32_t> groupOf;
        for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l)
            groupOf.push_back(l % 9 == 8 ? kNoLabel : l % 4);
        ShellOptions options;
        options.thickness = seed % 3 == 0 ? 0.1 : seed % 3 == 1 ? 0 : 0.25;
        if (seed % 5 == 4) options.of = {2, 5};
        const std::set<std::uint32_t> kept =
            seed % 5 == 4 ? std::set<std::uint32_t>{1, 2} : std::set<std::uint32_t>{0, 1, 2, 3};
        const std::int32_t reach = 1 + static_cast<std::int32_t>(seed % 3);
        const auto shell = extractShell(volume, groupOf, options);
        const auto expected =
            ColumnVolume::fromDense(n, BruteForce(volume, groupOf).shell({reach, reach, reach}, kept));
        if (!shell) {
            EXPECT_EQ(shell.error().code(), Code::NothingSelected) << shell.error().toString();
            EXPECT_EQ(ColumnVolume::fromDense(n, std::vector<Scalar>(std::size_t(n.x * n.y * n.z), 0)), expected);
            continue;
        }
        EXPECT_EQ(shell->columns, expected) << "seed " << seed;
        options.threads = 1;
        EXPECT_EQ(extractShell(volume, groupOf, options)->columns, shell->columns);
    }
}

// Boxes in boxes with cavities, wide enough for a reach beyond a tile; reaches differ along the axes.
TEST(Shell, WideReachAndCavities) {
    const Vec3i n{150, 80, 30};
    const auto isIn = [](Vec3i p, Vec3i from, Vec3i to) {
        return p.x >= from.x && p.y >= from.y && p.z >= from.z && p.x < to.x && p.y < to.y && p.z < to.z;
    };
    const auto paint = [&](std::int32_t i, std::int32_t j, std::int32_t k) -> Scalar {
        const Vec3i p{i, j, k};
        if (isIn(p, {60, 30, 10}, {70, 40, 20})) return 0;    // a cavity in the inner box
        if (isIn(p, {120, 60, 20}, {122, 62, 22})) return 0;  // a cavity in the outer box
        if (isIn(p, {50, 20, 5}, {80, 50, 25})) return 2;
        return isIn(p, {2, 2, 2}, {140, 76, 28}) ? 1u : 0u;
    };
    const std::vector<volume::Label> labels{label("outer", "Building", kNoLabel, 1),
                                            label("inner", "BuildingRoom", 0, 2)};
    const auto volume = painted(n, paint, labels, {0.01, 0.02, 0.1});
    ShellOptions options;
    options.thickness = 0.1;
    for (const std::vector<std::uint32_t>& groupOf : {std::vector<std::uint32_t>{0, 1}, {0, 0}}) {
        const auto shell = extractShell(volume, groupOf, options);
        ASSERT_TRUE(shell) << shell.error().toString();
        EXPECT_EQ(shell->columns, ColumnVolume::fromDense(n, BruteForce(volume, groupOf).shell({10, 5, 1}, {0, 1})));
    }
    // A reach of more than a tile, 66 x 33 x 7 voxels: only the middle of the one group is deep inside.
    options.thickness = 0.66;
    const auto shell = extractShell(volume, std::vector<std::uint32_t>{0, 0}, options);
    ASSERT_TRUE(shell) << shell.error().toString();
    const auto withoutMiddle = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        return isIn({i, j, k}, {68, 35, 9}, {74, 43, 21}) ? 0u : paint(i, j, k);
    };
    EXPECT_EQ(shell->columns, painted(n, withoutMiddle, labels).columns);
    // A reach as wide as the grid leaves all.
    options.thickness = 10;
    EXPECT_EQ(extractShell(volume, std::vector<std::uint32_t>{0, 0}, options)->columns, volume.columns);
}

TEST(Shell, NestedBoxesLeaveTheirHulls) {
    // A box of 20^3 around one of 10^3, alone in a grid of 30^3.
    const auto volume = painted({30, 30, 30},
                                [](std::int32_t i, std::int32_t j, std::int32_t k) -> Scalar {
                                    const auto isIn = [&](std::int32_t from, std::int32_t to) {
                                        return std::min({i, j, k}) >= from && std::max({i, j, k}) < to;
                                    };
                                    return isIn(10, 20) ? 2u : isIn(5, 25) ? 1u : 0u;
                                },
                                {label("house", "Building", kNoLabel, 1), label("room", "BuildingRoom", 0, 2)});
    const auto apart = extractShell(volume, ShellLevel::Component, thin());
    ASSERT_TRUE(apart);
    // The outer box: its outer layer, and the layer around the inner box, edges and corners included.
    EXPECT_EQ(apart->labels.labels[0].voxels, 8000u - 18 * 18 * 18 + 12 * 12 * 12 - 1000);
    EXPECT_EQ(apart->labels.labels[1].voxels, 1000u - 512);
    const auto together = extractShell(volume, ShellLevel::Building, thin());
    ASSERT_TRUE(together);
    EXPECT_EQ(together->labels.labels[0].voxels, 8000u - 18 * 18 * 18);
    EXPECT_EQ(together->labels.labels[1].voxels, 0u);
    EXPECT_TRUE(volume::checkLabels(together->labels));
}

TEST(Shell, CavityOfOneGroupHasNoInnerWalls) {
    // A hollow box; then the same with a part of another group that touches the cavity.
    const auto paint = [](std::int32_t i, std::int32_t j, std::int32_t k) -> Scalar {
        const auto isIn = [&](std::int32_t from, std::int32_t to) {
            return std::min({i, j, k}) >= from && std::max({i, j, k}) < to;
        };
        if (i == 6 && j == 9 && k == 9) return 2;
        return isIn(7, 13) || !isIn(2, 18) ? 0u : 1u;
    };
    const auto volume =
        painted({20, 20, 20}, paint, {label("a", "Building", kNoLabel, 1), label("b", "Building", kNoLabel, 2)});
    const auto whole = extractShell(volume, std::vector<std::uint32_t>{0, 0}, thin());
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->labels.labels[0].voxels, 16u * 16 * 16 - 14 * 14 * 14);
    const auto apart = extractShell(volume, std::vector<std::uint32_t>{0, 1}, thin());
    ASSERT_TRUE(apart);
    EXPECT_GT(apart->labels.labels[0].voxels, 16u * 16 * 16 - 14 * 14 * 14 + 8 * 8 * 8 - 6 * 6 * 6 - 10);
}

// 2 x 2 x 2 rooms of 6^3 voxels, walls and slabs of 2 between and around them, one label each kind of wall:
//
//     20 +-------------+    along each axis: 0 1 | 2 .. 7 | 8 9 | 10 .. 15 | 16 17
//        |  r  |  r    |    Flats are the pairs of rooms along x, storeys the pairs of flats along y.
//        |-----+-------|    Labels: walls in flats (x = 8, 9), walls between flats, the slab between the storeys,
//        |  r  |  r    |    and the outer walls.
//      0 +-------------+
SemanticVolume shellHouse() {
    const auto cell = [](std::int32_t x) { return x < 2 || x >= 16 ? -1 : x < 8 ? 0 : x < 10 ? 2 : 1; };
    std::vector<volume::Label> labels;
    labels.push_back(label("building", "Building", kNoLabel, 0, 0));
    // Labels 1 and 4: storeys, each with its two flats.
    for (const std::uint32_t storey : {1u, 4u}) {
        labels.push_back(label("storey", "Storey", 0, 0, 0));
        for (int flat = 0; flat < 2; ++flat) labels.push_back(label("flat", "BuildingUnit", storey, 0, 0));
    }
    Scalar next = 1;
    // Labels 7 to 14: rooms, children of the building and members of their flats.
    for (std::uint32_t room = 0; room < 8; ++room) {
        labels.push_back(label("room", "BuildingRoom", 0, next++));
        labels.back().groups = {room < 4 ? 2 + room / 2 : 3 + room / 2};
    }
    // 15 to 18: the wall in each flat; 19 and 20: between the flats of a storey; 21: the slab between; 22: around.
    for (int wall = 0; wall < 8; ++wall) labels.push_back(label("wall", "BuildingConstructiveElement", 0, next++));
    return painted(
        {22, 22, 22},
        [&](std::int32_t i, std::int32_t j, std::int32_t k) -> Scalar {
            if (std::min({i, j, k}) < 2 || std::max({i, j, k}) >= 20) return 0;
            const int x = cell(i - 2), y = cell(j - 2), z = cell(k - 2);
            if (x < 0 || y < 0 || z < 0) return 16;
            if (z == 2) return 15;
            if (y == 2) return Scalar(13 + z);
            if (x == 2) return Scalar(9 + y + 2 * z);
            return Scalar(1 + x + 2 * y + 4 * z);
        },
        labels);
}

TEST(Shell, HouseOfEightRoomsHasItsSteps) {
    const auto steps = shellLevels(shellHouse());
    ASSERT_EQ(steps.size(), 5u);
    EXPECT_EQ(steps[0], (ShellStep{ShellLevel::Component, 16, 16}));
    EXPECT_EQ(steps[1], (ShellStep{ShellLevel::Room, 8, 16}));   // all walls touch more than one room
    EXPECT_EQ(steps[2], (ShellStep{ShellLevel::Unit, 4, 8}));    // flats, 2 walls between, slab, outer walls
    EXPECT_EQ(steps[3], (ShellStep{ShellLevel::Storey, 2, 4}));  // storeys, slab, outer walls
    EXPECT_EQ(steps[4], (ShellStep{ShellLevel::Building, 1, 1}));
}

TEST(Shell, HouseOfEightRoomsHasKnownHulls) {
    const auto volume = shellHouse();
    const auto sum = [&](ShellLevel level, std::uint32_t from, std::uint32_t to) {
        const auto shell = extractShell(volume, level, thin());
        EXPECT_TRUE(shell);
        std::uint64_t voxels = 0;
        for (std::uint32_t l = from; l < to; ++l) voxels += shell->labels.labels[l].voxels;
        return voxels;
    };
    const std::uint64_t room = 216 - 64;  // 6^3 less 4^3
    EXPECT_EQ(sum(ShellLevel::Component, 7, 15), 8 * room);
    EXPECT_EQ(sum(ShellLevel::Room, 7, 15), 8 * room);
    EXPECT_EQ(sum(ShellLevel::Component, 15, 19), 4u * 2 * 6 * 6);  // two voxels thick: nothing is deep inside
    // A flat with its wall is a box of 14 x 6 x 6.
    EXPECT_EQ(sum(ShellLevel::Unit, 7, 19), 4u * (14 * 6 * 6 - 12 * 4 * 4));
    // A storey: 14 x 14 x 6.
    EXPECT_EQ(sum(ShellLevel::Storey, 7, 21), 2u * (14 * 14 * 6 - 12 * 12 * 4));
    // All: 18^3, of which only the outer walls are seen.
    EXPECT_EQ(sum(ShellLevel::Building, 22, 23), 18u * 18 * 18 - 16 * 16 * 16);
    EXPECT_EQ(sum(ShellLevel::Building, 0, 22), 0u);
}

TEST(Shell, GroupsAreUnionsOfTheStepBelow) {
    const auto hierarchy = ShellHierarchy::ofVolume(shellHouse());
    for (std::size_t step = 1; step < kNames<ShellLevel>.size(); ++step) {
        const auto below = hierarchy.groups(kNames<ShellLevel>[step - 1].value),
                   above = hierarchy.groups(kNames<ShellLevel>[step].value);
        std::map<std::uint32_t, std::uint32_t> groupOfGroup;
        for (std::size_t l = 7; l < below.size(); ++l)
            EXPECT_EQ(groupOfGroup.try_emplace(below[l], above[l]).first->second, above[l])
                << "step " << step << " label " << l;
    }
}

TEST(Shell, MembersStayWhereTheModelHasThem) {
    auto volume = shellHouse();
    // The slab is a member of the upper storey: it stays there, though it touches both.
    volume.labels.labels[21].groups = {4};
    EXPECT_EQ(ShellHierarchy::ofVolume(volume).groups(ShellLevel::Storey)[21], 4u);
    // The wall of the first flat is a member of the other storey, which its own contacts do not change.
    volume.labels.labels[15].groups = {4};
    const auto hierarchy = ShellHierarchy::ofVolume(volume);
    EXPECT_EQ(hierarchy.groups(ShellLevel::Unit)[15], 15u);
    EXPECT_EQ(hierarchy.groups(ShellLevel::Storey)[15], 4u);
}

TEST(Shell, PartsOfAComponentGoWithIt) {
    // A window below the wall between two rooms that touches one of them alone.
    const auto volume = painted({9, 4, 4},
                                [](std::int32_t i, std::int32_t j, std::int32_t) -> Scalar {
                                    return i < 3 ? 1u : i > 5 ? 2u : i == 3 && j == 1 ? 4u : 3u;
                                },
                                {label("building", "Building", kNoLabel, 0, 0), label("left", "BuildingRoom", 0, 1),
                                 label("right", "BuildingRoom", 0, 2),
                                 label("wall", "BuildingConstructiveElement", 0, 3), label("window", "Window", 3, 4)});
    const auto hierarchy = ShellHierarchy::ofVolume(volume);
    EXPECT_EQ(hierarchy.groups(ShellLevel::Component), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(hierarchy.groups(ShellLevel::Room), (std::vector<std::uint32_t>{0, 1, 2, 3, 3}));
    EXPECT_EQ(hierarchy.groups(ShellLevel::Building), (std::vector<std::uint32_t>(5, 0)));
}

TEST(Shell, LevelsThatAreNotThereAreNamed) {
    const auto volume =
        painted({4, 4, 4}, [](auto, auto, auto) { return 1u; }, {label("wall", "WallSurface", kNoLabel, 1)});
    const auto shell = extractShell(volume, ShellLevel::Storey);
    ASSERT_FALSE(shell);
    EXPECT_EQ(shell.error().code(), Code::NothingSelected);
    EXPECT_NE(shell.error().message().find("no storeys"), std::string::npos);
    EXPECT_NE(shell.error().message().find("component"), std::string::npos);
}

TEST(Shell, CyclesOfGroupsAndParentsEnd) {
    auto volume = shellHouse();
    volume.labels.labels[1].groups = {5};
    volume.labels.labels[5].groups = {2, 1, 99};
    volume.labels.labels[0].parent = 3;
    EXPECT_FALSE(shellLevels(volume).empty());
}

TEST(Shell, OfSelectsGroups) {
    const auto volume = shellHouse();
    ShellOptions options = thin();
    options.of = {8};  // a room; its flat stays
    const auto shell = extractShell(volume, ShellLevel::Unit, options);
    ASSERT_TRUE(shell);
    std::uint64_t voxels = 0;
    for (const auto& l : shell->labels.labels) voxels += l.voxels;
    EXPECT_EQ(voxels, 14u * 6 * 6 - 12 * 4 * 4);
}

TEST(Shell, GroupsHaveOneScalarEach) {
    const auto volume = shellHouse();
    ShellOptions options = thin();
    options.labels = ShellLabels::Groups;
    const auto shell = extractShell(volume, ShellLevel::Storey, options);
    ASSERT_TRUE(shell);
    const auto checked = volume::checkLabels(shell->labels);
    EXPECT_TRUE(checked) << checked.error().toString();
    EXPECT_EQ(shell->labels.scalarCount(), 5u);
    EXPECT_EQ(shell->labels.labels[1].voxels, 14u * 14 * 6 - 12 * 12 * 4);
    EXPECT_EQ(shell->labels.labels[1].first, 1u);
    EXPECT_EQ(shell->labels.labels[7].count, 0u);
}

TEST(Shell, BadInputIsRefused) {
    const auto volume = shellHouse();
    const std::vector<std::uint32_t> groups(volume.labels.labels.size(), 0);
    for (const double thickness : {-1.0, std::nan(""), HUGE_VAL}) {
        ShellOptions options;
        options.thickness = thickness;
        EXPECT_EQ(extractShell(volume, groups, options).error().code(), Code::BadArgument);
    }
    EXPECT_EQ(extractShell(volume, std::vector<std::uint32_t>{0}).error().code(), Code::BadArgument);
    EXPECT_EQ(extractShell(volume, std::vector<std::uint32_t>(groups.size(), 99)).error().code(), Code::BadArgument);
    ShellOptions options;
    options.of = {99};
    EXPECT_EQ(extractShell(volume, groups, options).error().code(), Code::BadArgument);
    options.of = {};
    Progress progress;
    progress.cancel = true;
    options.progress = &progress;
    EXPECT_EQ(extractShell(volume, groups, options).error().code(), Code::Cancelled);
    // Nothing in a group.
    EXPECT_EQ(extractShell(volume, std::vector<std::uint32_t>(groups.size(), kNoLabel)).error().code(),
              Code::NothingSelected);
}

}  // namespace
}  // namespace svt::illustrate
