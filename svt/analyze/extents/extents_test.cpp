#include <svt/analyze/extents.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace svt::analyze {
namespace {

using volume::Filling;
using volume::kNoLabel;
using Labels = std::vector<std::uint32_t>;

// A house of one flat.
volume::SemanticVolume house() {
    volume::SemanticVolume volume = volume::test::emptyVolume({24, 8, 8}, {0.5, 0.5, 0.5});
    const auto add = [&](const char* id, const char* className, std::uint32_t parent, Filling filling) {
        volume::Label& label = filling == Filling::None ? volume::test::addGroup(volume, id, className, parent)
                                                        : volume::test::addObject(volume, id, className, parent);
        label.filling = filling;
    };
    add("building", "Building", kNoLabel, Filling::Solid);           // 0
    add("storey", "Storey", 0, Filling::None);                       // 1
    add("flat", "BuildingUnit", 1, Filling::Solid);                  // 2
    add("kitchen", "BuildingRoom", 0, Filling::Solid);               // 3: of the flat and the storey
    add("floor", "FloorSurface", 3, Filling::Surface);               // 4: a sheet
    add("wall", "InteriorWallSurface", 3, Filling::Body);            // 5: material
    add("window", "Window", 5, Filling::Surface);                    // 6
    add("stove", "BuildingFurniture", 3, Filling::Solid);            // 7
    add("inner", "BuildingConstructiveElement", 0, Filling::Solid);  // 8: of the flat
    add("door", "Door", 8, Filling::Solid);                          // 9
    add("stair", "BuildingInstallation", 0, Filling::None);          // 10: an assembly
    add("step", "BuildingInstallation", 10, Filling::Solid);         // 11
    add("zone", "CityObjectGroup", kNoLabel, Filling::None);         // 12: the flat and the stair
    volume.labels.labels[3].groups = {1, 2};
    volume.labels.labels[8].groups = {2};
    volume.labels.labels[2].groups = {12};
    volume.labels.labels[10].groups = {12};
    return volume;
}

TEST(Extents, AreTheUnionOfPartsAndMembers) {
    const volume::SemanticVolume volume = house();
    const Extents extents(volume.labels);
    EXPECT_EQ(extents.of(2), (Labels{2, 3, 4, 7, 8, 9})) << "a flat: rooms, their sheets and furniture, inner walls";
    EXPECT_EQ(extents.of(3), (Labels{3, 4, 7})) << "the material around a room belongs to the building";
    EXPECT_EQ(extents.of(1), (Labels{1, 2, 3, 4, 5, 6, 7, 8, 9})) << "a storey has that material";
    EXPECT_EQ(extents.of(0), (Labels{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
    EXPECT_EQ(extents.of(5), (Labels{5, 6}));
    EXPECT_EQ(extents.of(12), (Labels{2, 3, 4, 7, 8, 9, 10, 11, 12}));
    EXPECT_EQ(extents.of(11), (Labels{11}));
    EXPECT_EQ(extents.of(Labels{2, 8, 11}), (Labels{2, 3, 4, 7, 8, 9, 11}));
}

TEST(Extents, OfCyclicGroupsEnd) {
    volume::SemanticVolume volume = house();
    volume.labels.labels[12].groups = {2};
    const Extents extents(volume.labels);
    EXPECT_EQ(extents.of(12), (Labels{2, 3, 4, 7, 8, 9, 10, 11, 12}));
    EXPECT_EQ(extents.of(2), extents.of(12));
}

TEST(Extents, ASpaceStandsForItsPartsUnlessOneOfThemIsSelected) {
    const volume::SemanticVolume volume = house();
    const LabelRows rows(volume.labels);
    const auto selected = [&](const char* query) { return *selectWithParts(rows, query); };
    EXPECT_EQ(selected("class=BuildingUnit"), (Labels{2, 3, 4, 7, 8, 9}));
    EXPECT_EQ(selected("class=BuildingUnit or class=BuildingRoom"), (Labels{2, 3})) << "only the air of both";
    EXPECT_EQ(selected("class=BuildingRoom"), (Labels{3})) << "furniture is selected apart";
    EXPECT_EQ(selected("id=stair"), (Labels{10, 11})) << "an assembly without a body";
    EXPECT_EQ(selected("id=inner"), (Labels{8}));
    EXPECT_EQ(selected("not class=Door"), (Labels{0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12}));
    EXPECT_EQ(selected("all").size(), 13u);
    const auto wholes = rows.extents().wholes(Labels{1, 8});
    EXPECT_EQ(wholes, (std::vector<Labels>{{1}, {8}})) << "a part of the storey is selected";
    EXPECT_EQ(rows.extents().wholes(Labels{2, 10}), (std::vector<Labels>{{2, 3, 4, 7, 8, 9}, {10, 11}}));
}

// The definition, as sets that grow until nothing changes: pairs of a label and whether its material counts.
Labels definedExtent(const volume::LabelTable& table, std::uint32_t root) {
    enum Kind { Sheets, Space, All };
    const std::set<std::string> spaces{"BuildingRoom", "BuildingUnit", "CityObjectGroup"};
    const std::set<std::string> surfaces{"FloorSurface", "InteriorWallSurface"};
    const auto kindOf = [&](std::uint32_t l) { return spaces.count(table.labels[l].className) != 0 ? Space : All; };
    std::set<std::pair<std::uint32_t, Kind>> reached{{root, kindOf(root)}};
    for (std::size_t before = 0; before != reached.size();) {
        before = reached.size();
        const auto now = reached;
        for (const auto& [above, kind] : now)
            for (std::uint32_t l = 0; l < table.labels.size(); ++l) {
                const volume::Label& label = table.labels[l];
                const bool isPart =
                    label.parent == above || std::count(label.groups.begin(), label.groups.end(), above);
                if (!isPart) continue;
                const bool isSheet = label.filling == Filling::Surface || label.filling == Filling::None;
                if (kind == All)
                    reached.insert({l, All});
                else if (kind == Sheets || surfaces.count(label.className) != 0)
                    isSheet ? void(reached.insert({l, Sheets})) : void();
                else
                    reached.insert({l, kindOf(l)});
            }
    }
    std::set<std::uint32_t> labels;
    for (const auto& [label, kind] : reached) labels.insert(label);
    return {labels.begin(), labels.end()};
}

// A random tree with random members, also in cycles. Every label has voxels, in blocks of 8 x 8 x 8.
volume::SemanticVolume randomVolume(std::uint32_t seed) {
    constexpr const char* kClasses[] = {"Building",     "Storey",          "BuildingUnit",
                                        "BuildingRoom", "FloorSurface",    "InteriorWallSurface",
                                        "Window",       "CityObjectGroup", "BuildingConstructiveElement"};
    constexpr Filling kFillings[] = {Filling::Solid, Filling::Surface, Filling::Body};
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
    volume::SemanticVolume volume = volume::test::emptyVolume({40, 32, 24}, {0.5, 0.25, 1});
    std::vector<std::uint32_t> path;  // from a root to the last label
    for (std::uint32_t l = 0; l < 30; ++l) {
        path.resize(below(path.size() + 1));
        volume::Label& label = volume::test::addObject(volume, std::to_string(l), kClasses[below(9)],
                                                       path.empty() ? kNoLabel : path.back());
        label.filling = kFillings[below(3)];
        path.push_back(l);
    }
    for (int n = 0; n < 20; ++n) volume.labels.labels[below(30)].groups.push_back(below(30));
    for (volume::Label& label : volume.labels.labels) {
        std::sort(label.groups.begin(), label.groups.end());
        label.groups.erase(std::unique(label.groups.begin(), label.groups.end()), label.groups.end());
    }
    std::vector<volume::Scalar> blocks(5 * 4 * 3);
    for (volume::Scalar& block : blocks) block = below(31);
    volume::test::paint(volume, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        return blocks[std::size_t(i / 8 + 5 * (j / 8 + 4 * (k / 8)))];
    });
    return volume;
}

TEST(Extents, AreThoseOfTheirDefinition) {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const volume::SemanticVolume volume = randomVolume(seed);
        const Extents extents(volume.labels);
        for (std::uint32_t l = 0; l < 30; ++l)
            ASSERT_EQ(extents.of(l), definedExtent(volume.labels, l)) << "seed " << seed << " label " << l;
    }
}

// Counts of a dense array: whether each voxel belongs to the extent.
struct Dense {
    std::uint64_t voxels = 0;
    SampleBox box;
    double area = 0, outside = 0;
};

Dense countDense(const volume::SemanticVolume& volume, const Labels& extent) {
    const Vec3i n = volume.grid.dimension();
    const Vec3d s = volume.grid.spacing();
    const auto labelOf = volume.labels.labelOfScalar();
    const auto at = [&](Vec3i v) {
        const bool isInGrid = v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < n.x && v.y < n.y && v.z < n.z;
        return isInGrid ? labelOf[volume.columns.scalarAt(v.x, v.y, v.z)] : kNoLabel;
    };
    const auto isIn = [&](std::uint32_t l) { return std::binary_search(extent.begin(), extent.end(), l); };
    Dense dense;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                if (!isIn(at({i, j, k}))) continue;
                ++dense.voxels;
                dense.box.add({{i, j, k}, {i, j, k}});
                for (int axis = 0; axis < 3; ++axis)
                    for (const int step : {-1, 1}) {
                        Vec3i beside{i, j, k};
                        beside[axis] += step;
                        const std::uint32_t other = at(beside);
                        if (isIn(other)) continue;
                        const double face = s.x * s.y * s.z / s[axis];
                        dense.area += face;
                        if (other == kNoLabel) dense.outside += face;
                    }
            }
    return dense;
}

// Voxels of a body and of the sheets that bound it: surfaces and fillings below it, and all sheets below these.
std::uint64_t voxelsWithSheets(const std::vector<volume::Label>& labels, std::uint32_t body) {
    if (labels[body].filling == Filling::Surface) return 0;
    std::uint64_t voxels = labels[body].voxels;
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        std::uint32_t top = l;
        if (labels[l].filling != Filling::Surface) continue;
        while (labels[top].parent != kNoLabel && labels[labels[top].parent].filling == Filling::Surface)
            top = labels[top].parent;
        const std::set<std::string> shells{"FloorSurface", "InteriorWallSurface", "Window"};
        if (labels[top].parent == body && shells.count(labels[top].className) != 0) voxels += labels[l].voxels;
    }
    return voxels;
}

TEST(FeatureMeasures, AreThoseOfADenseArray) {
    Labels all(30);
    for (std::uint32_t l = 0; l < 30; ++l) all[l] = l;
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const volume::SemanticVolume volume = randomVolume(seed);
        const Extents extents(volume.labels);
        const auto contacts = findContacts(volume.columns, volume.grid, volume.labels, 1);
        const auto own = measureLabels(volume, contacts);
        for (const FeatureMeasure& measure : measureFeatures(extents, all, own, contacts)) {
            const Labels extent = extents.of(measure.label);
            const Dense total = countDense(volume, extent), alone = countDense(volume, {measure.label});
            ASSERT_EQ(measure.total.voxels, total.voxels) << seed;
            EXPECT_EQ(measure.own.voxels, alone.voxels);
            const auto expectBox = [&](const Box3d& box, const SampleBox& samples) {
                const Box3d expected = worldBox(samples, volume.grid);
                EXPECT_EQ(box.isEmpty(), expected.isEmpty());
                if (!box.isEmpty()) {
                    EXPECT_TRUE(box.min == expected.min && box.max == expected.max) << seed;
                }
            };
            expectBox(measure.total.box, total.box);
            expectBox(measure.own.box, alone.box);
            EXPECT_NEAR(measure.total.area, total.area, 1e-9 * (1 + total.area));
            EXPECT_NEAR(measure.total.outsideArea, total.outside, 1e-9 * (1 + total.outside));
            EXPECT_NEAR(measure.own.area, alone.area, 1e-9 * (1 + alone.area));
            std::uint64_t solid = 0;
            for (const std::uint32_t l : extent) solid += voxelsWithSheets(volume.labels.labels, l);
            EXPECT_NEAR(measure.total.volume.value_or(0), double(solid) * 0.125, 1e-9);
        }
    }
}

TEST(FeatureMeasures, KnowNoVolumeOfSheets) {
    volume::SemanticVolume volume = house();
    volume::test::paintBoxes(volume, {{4, {0, 0, 0}, {4, 4, 1}}, {7, {8, 0, 0}, {10, 4, 4}}});
    const auto own = ownMeasures(volume.labels, volume.grid);
    EXPECT_FALSE(own[4].volume) << "a sheet";
    EXPECT_FALSE(own[1].volume) << "a storey without a body";
    EXPECT_EQ(own[3].volume, 16 * 0.125) << "a room that lost all its voxels but those of its floor";
    EXPECT_EQ(own[2].volume, 0.0) << "a flat that lost all its voxels";
    const Extents extents(volume.labels);
    const auto measures = measureFeatures(extents, Labels{3, 4, 11}, own);
    EXPECT_EQ(measures[0].total.voxels, 16u + 32u);
    EXPECT_NEAR(*measures[0].total.volume, 48 * 0.125, 1e-12);
    EXPECT_NEAR(measures[0].total.countedVolume, 48 * 0.125, 1e-12);
    EXPECT_FALSE(measures[1].total.volume);
    EXPECT_EQ(measures[2].total.volume, 0.0);
    // A closed solid that lost nothing has the volume of its mesh.
    volume.labels.labels[7].volume = 3.9;
    const auto exact = measureFeatures(extents, Labels{3}, ownMeasures(volume.labels, volume.grid));
    EXPECT_NEAR(*exact[0].total.volume, 3.9 + 2, 1e-12);
    EXPECT_EQ(exact[0].total.countedVolume, 2);
}

TEST(NeighborFinder, FindsThoseOutsideOfAnExtent) {
    const std::vector<Contact> contacts{
        {0, 1, 2, {}}, {0, 2, 5, {}}, {0, kNoLabel, 1, {}}, {1, 2, 9, {}}, {1, kNoLabel, 4, {}}};
    const NeighborFinder finder(contacts, 3);
    EXPECT_EQ(finder.of(Labels{0}), (std::vector<Neighbor>{{2, 5.0}, {1, 2.0}, {kNoLabel, 1.0}}));
    EXPECT_EQ(finder.of(Labels{0, 1}), (std::vector<Neighbor>{{2, 14.0}, {kNoLabel, 5.0}}));
    EXPECT_EQ(finder.of(Labels{0, 1, 2}), (std::vector<Neighbor>{{kNoLabel, 5.0}}));
    EXPECT_EQ(finder.of(Labels{0}).size(), 3u) << "nothing is left from another call";
    EXPECT_TRUE(finder.of(Labels{}).empty());
}

}  // namespace
}  // namespace svt::analyze
