#include <svt/fields/field_sampler.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>

namespace svt::fields {
namespace {

using volume::SemanticVolume;
using volume::test::addObject;
using volume::test::emptyVolume;
using volume::test::paintBoxes;

constexpr Vec3i kSize{40, 20, 12};

// Two rooms with a wall of one voxel between, all around of walls of one voxel. Scalars: 1 wall, 2 and 3 rooms.
SemanticVolume twoRooms() {
    SemanticVolume volume = emptyVolume(kSize, {0.1, 0.1, 0.1});
    addObject(volume, "wall", "Wall");
    addObject(volume, "west", "BuildingRoom");
    addObject(volume, "east", "BuildingRoom");
    paintBoxes(volume, {{1, {0, 0, 0}, kSize}, {2, {1, 1, 1}, {19, 19, 11}}, {3, {20, 1, 1}, {39, 19, 11}}});
    return volume;
}

Field gridField(const Lattice& lattice, std::string medium) {
    Field field;
    field.head.name = "t";
    field.head.unit = "Cel";
    field.head.medium = std::move(medium);
    field.head.lattice = lattice;
    field.values.resize(placeCount(field.head, 0));
    return field;
}

// valueAt(place) at each node.
template <class ValueAt>
void fill(Field& field, const ValueAt& valueAt) {
    const Lattice& l = field.head.lattice;
    std::size_t next = 0;
    for (std::int32_t k = 0; k < l.size.z; ++k)
        for (std::int32_t j = 0; j < l.size.y; ++j)
            for (std::int32_t i = 0; i < l.size.x; ++i)
                field.values[next++] = static_cast<float>(valueAt(l.first + scaled(l.step, toDouble(Vec3i{i, j, k}))));
}

// Numbers in [0, 1), the same in each run.
class Numbers {
public:
    double next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }
    Vec3d in(Vec3d low, Vec3d high) {
        const double x = next(), y = next(), z = next();
        return {low.x + x * (high.x - low.x), low.y + y * (high.y - low.y), low.z + z * (high.z - low.z)};
    }

private:
    std::uint64_t state_ = 1;
};

volume::Scalar scalarAt(const SemanticVolume& volume, Vec3d p) {
    return volume.columns.scalarAt(static_cast<std::int32_t>(std::floor(p.x + 0.5)),
                                   static_cast<std::int32_t>(std::floor(p.y + 0.5)),
                                   static_cast<std::int32_t>(std::floor(p.z + 0.5)));
}

// 20 and 30 in the rooms, 0 in walls: every sample in a room has exactly its value.
void expectNoLeak(const SemanticVolume& volume, const Lattice& lattice, const std::string& medium, int samples) {
    Field field = gridField(lattice, medium);
    fill(field, [&](Vec3d p) {
        const volume::Scalar s =
            scalarAt(volume, {std::clamp(p.x, 0.0, 39.0), std::clamp(p.y, 0.0, 19.0), std::clamp(p.z, 0.0, 11.0)});
        return s == 1 ? 0 : s == 2 ? 20 : 30;
    });
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    Numbers numbers;
    int wrong = 0, missing = 0, inRoom = 0;
    for (int n = 0; n < samples; ++n) {
        const Vec3d p = numbers.in({-0.5, -0.5, -0.5}, {39.499, 19.499, 11.499});
        const volume::Scalar s = scalarAt(volume, p);
        const float value = sampler.at(p);
        if (s == 1) {
            if (medium == "air" ? !std::isnan(value) : value != 0) ++wrong;
            continue;
        }
        ++inRoom;
        if (std::isnan(value))
            ++missing;
        else if (value != (s == 2 ? 20.0f : 30.0f))
            ++wrong;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(missing, 0);
    EXPECT_GT(inRoom, samples / 2);
}

TEST(FieldSampler, ValuesDoNotCrossAWallOfOneVoxel) {
    const SemanticVolume volume = twoRooms();
    expectNoLeak(volume, {kSize, {0, 0, 0}, {1, 1, 1}, {}}, "air", 1000000);
    expectNoLeak(volume, {kSize, {0, 0, 0}, {1, 1, 1}, {}}, "all", 1000000);
}

TEST(FieldSampler, ValuesDoNotCrossAWallThinnerThanAStep) {
    const SemanticVolume volume = twoRooms();
    expectNoLeak(volume, {{14, 8, 5}, {0, 0, 0}, {3, 3, 3}, {}}, "air", 200000);
    expectNoLeak(volume, {{8, 4, 4}, {1.5, 2.5, 1.5}, {5.3, 5, 3.1}, {}}, "air", 200000);
}

TEST(FieldSampler, ValuesDoNotCrossAWallOnFineAndShiftedLattices) {
    const SemanticVolume volume = twoRooms();
    expectNoLeak(volume, {{80, 40, 24}, {-0.25, -0.25, -0.25}, {0.5, 0.5, 0.5}, {}}, "air", 200000);
    expectNoLeak(volume, {{41, 21, 13}, {-0.3, -0.3, -0.3}, {1, 1, 1}, {}}, "air", 200000);
}

TEST(FieldSampler, ALinearFieldIsExactInsideAMedium) {
    const SemanticVolume volume = twoRooms();
    const auto linear = [](Vec3d p) { return 0.25 * p.x - 0.5 * p.y + 0.125 * p.z + 1; };
    const Lattice regular{{42, 22, 14}, {-1, -1, -1}, {1, 1, 1}, {}}, coarse{{8, 5, 4}, {0, 0, 0}, {6, 5, 4}, {}};
    Lattice uneven{{4, 3, 3}, {0, 0, 0}, {1, 1, 1}, {}};
    uneven.positions = {{{0, 3, 19, 40}, {0, 5, 20}, {0, 8, 12}}};
    for (const Lattice& lattice : {regular, coarse, uneven}) {
        Field field = gridField(lattice, "all");
        const Lattice& l = lattice;
        std::size_t next = 0;
        const auto place = [&](int axis, std::int32_t n) {
            const auto& list = l.positions[static_cast<std::size_t>(axis)];
            return list.empty() ? l.first[axis] + l.step[axis] * n : list[static_cast<std::size_t>(n)];
        };
        for (std::int32_t k = 0; k < l.size.z; ++k)
            for (std::int32_t j = 0; j < l.size.y; ++j)
                for (std::int32_t i = 0; i < l.size.x; ++i)
                    field.values[next++] = static_cast<float>(linear({place(0, i), place(1, j), place(2, k)}));
        SemanticVolume open = emptyVolume(kSize, {0.1, 0.1, 0.1});
        const FieldSampler sampler = *FieldSampler::make(field, open);
        Numbers numbers;
        double worst = 0;
        for (int n = 0; n < 100000; ++n) {
            const Vec3d p = numbers.in({0, 0, 0}, {39, 19, 11});
            worst = std::max(worst, std::abs(double{sampler.at(p)} - linear(p)));
        }
        EXPECT_LT(worst, 1e-6);
    }
    // Inside the rooms with their walls, a voxel away from these.
    Field field = gridField(regular, "air");
    fill(field, linear);
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    Numbers numbers;
    double worst = 0;
    for (int n = 0; n < 100000; ++n) {
        const Vec3d p = numbers.in({1, 1, 1}, {18, 18, 10});
        worst = std::max(worst, std::abs(double{sampler.at(p)} - linear(p)));
    }
    EXPECT_LT(worst, 1e-6);
}

TEST(FieldSampler, ACellWithoutReachedNodeTakesTheNearestNodeOfItsMedium) {
    const SemanticVolume volume = twoRooms();
    // The nodes at x = 9 and 29 only; the corner of the west room at x = 18 has its nearest node at 9.
    Field field = gridField({{4, 2, 2}, {-11, 5, 3}, {20, 8, 4}, {}}, "air");
    fill(field, [](Vec3d p) { return p.x; });
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    EXPECT_EQ(sampler.at({18, 9, 5}), 9);
    EXPECT_EQ(sampler.at({20, 9, 5}), 29);
    EXPECT_TRUE(std::isnan(sampler.at({19, 9, 5})));
    // A missing node: its neighbour stands in.
    Field fine = gridField({kSize, {0, 0, 0}, {1, 1, 1}, {}}, "air");
    fill(fine, [](Vec3d p) { return p.x < 5 ? std::nan("") : p.x; });
    const FieldSampler ofFine = *FieldSampler::make(fine, volume);
    EXPECT_EQ(ofFine.at({4, 9, 5}), 5);
    EXPECT_EQ(ofFine.at({2, 9, 5}), 5);
    EXPECT_TRUE(std::isnan(ofFine.at({1, 9, 5}))) << "farther than two cells";
}

TEST(FieldSampler, ANicheWithoutNodeTakesTheNodeThatItsAirLeadsTo) {
    SemanticVolume volume = emptyVolume(kSize, {0.1, 0.1, 0.1});
    addObject(volume, "wall", "Wall");
    addObject(volume, "room", "BuildingRoom");
    paintBoxes(volume, {{1, {0, 0, 0}, kSize}, {2, {1, 1, 1}, {19, 19, 11}}, {2, {19, 9, 5}, {24, 12, 8}}});
    Field field = gridField({{11, 6, 4}, {0, 0, 0}, {4, 4, 4}, {}}, "air");
    fill(field, [](Vec3d p) { return p.x; });
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    EXPECT_EQ(sampler.at({21, 10, 6}), 16);
    EXPECT_TRUE(std::isnan(sampler.at({25, 10, 6})));
}

TEST(FieldSampler, PlacesOutsideOfTheLatticeAndNoPlacesAreMissing) {
    const SemanticVolume volume = twoRooms();
    Field field = gridField({{5, 5, 5}, {2, 2, 2}, {1, 1, 1}, {}}, "all");
    fill(field, [](Vec3d p) { return p.y; });
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    EXPECT_EQ(sampler.at({1.6, 3, 3}), 3);
    EXPECT_TRUE(std::isnan(sampler.at({1.4, 3, 3})));
    EXPECT_TRUE(std::isnan(sampler.at({6.6, 3, 3})));
    EXPECT_TRUE(std::isnan(sampler.at({std::nan(""), 3, 3})));
    EXPECT_TRUE(std::isnan(sampler.at({1e300, 3, 3})));
    EXPECT_TRUE(std::isnan(sampler.at({3, 3, 3}, 1))) << "there is one time";
    EXPECT_TRUE(std::isnan(sampler.at({3, 3, 3}, 0, 1))) << "there is one component";
    EXPECT_EQ(sampler.range(), std::pair(2.0f, 6.0f));
}

TEST(FieldSampler, TimesAreInterpolated) {
    const SemanticVolume volume = twoRooms();
    Field field = gridField({{2, 2, 2}, {2, 2, 2}, {1, 1, 1}, {}}, "all");
    field.head.times = {0, 10, 40};
    field.values.assign(24, 1);
    for (std::size_t v = 8; v < 24; ++v) field.values[v] = v < 16 ? 3 : 9;
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    EXPECT_EQ(sampler.atSeconds({2, 2, 2}, -5), 1);
    EXPECT_EQ(sampler.atSeconds({2, 2, 2}, 5), 2);
    EXPECT_EQ(sampler.atSeconds({2, 2, 2}, 10), 3);
    EXPECT_EQ(sampler.atSeconds({2, 2, 2}, 25), 6);
    EXPECT_EQ(sampler.atSeconds({2, 2, 2}, 99), 9);
    EXPECT_TRUE(std::isnan(sampler.atSeconds({2, 2, 2}, std::nan(""))));
}

TEST(FieldSampler, LabelsGiveTheValueOfTheComponentOrItsAncestor) {
    SemanticVolume volume = emptyVolume(kSize, {0.1, 0.1, 0.1});
    volume::test::addGroup(volume, "building", "Building");
    addObject(volume, "room", "BuildingRoom", 0);
    addObject(volume, "table", "BuildingFurniture", 1);
    paintBoxes(volume, {{1, {1, 1, 1}, {19, 19, 11}}, {2, {2, 2, 2}, {4, 4, 4}}});
    Field field;
    field.head.name = "heating";
    field.head.kind = FieldKind::Label;
    field.head.unit = "W";
    field.values = {5, std::nanf(""), 7};
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    EXPECT_EQ(sampler.at({3, 3, 3}), 7);
    EXPECT_EQ(sampler.at({8, 8, 8}), 5);
    EXPECT_TRUE(std::isnan(sampler.at({30, 8, 8})));
    EXPECT_TRUE(std::isnan(sampler.at({-30, 8, 8})));
}

TEST(FieldSampler, APointStandsForItsRoom) {
    const SemanticVolume volume = twoRooms();
    Field field;
    field.head.name = "co2";
    field.head.kind = FieldKind::Points;
    field.head.unit = "[ppm]";
    // The last one is in a wall of the east room.
    field.head.points = {{"a", {0.2, 0.9, 0.5}}, {"b", {1.7, 0.9, 0.5}}, {"c", {3.9, 0.9, 0.5}}};
    field.values = {400, 500, 600};
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    EXPECT_EQ(sampler.at({3, 9, 5}), 400);
    EXPECT_EQ(sampler.at({16, 9, 5}), 500);
    EXPECT_EQ(sampler.at({20, 9, 5}), 600) << "the nearest point is in the other room";
    EXPECT_TRUE(std::isnan(sampler.at({19, 9, 5}))) << "in the wall";
}

TEST(FieldSampler, MediumOfKnowsAirSolidAndQueries) {
    const SemanticVolume volume = twoRooms();
    FieldHead head;
    const auto of = [&](std::string medium) {
        head.medium = std::move(medium);
        return *mediumOf(head, volume);
    };
    EXPECT_EQ(of("all"), (std::vector<char>{1, 1, 1, 1}));
    EXPECT_EQ(of("air"), (std::vector<char>{1, 0, 1, 1}));
    EXPECT_EQ(of("solid"), (std::vector<char>{0, 1, 0, 0}));
    EXPECT_EQ(of("id=east"), (std::vector<char>{0, 0, 0, 1}));
    head.medium = "class=(";
    EXPECT_EQ(mediumOf(head, volume).error().code(), Code::BadQuery);
    head.medium = "class=Slab";
    EXPECT_EQ(mediumOf(head, volume).error().code(), Code::NothingSelected);
}

TEST(FieldSampler, AFieldWithTheWrongNumberOfValuesIsRejected) {
    const SemanticVolume volume = twoRooms();
    Field field = gridField({{5, 5, 5}, {2, 2, 2}, {1, 1, 1}, {}}, "all");
    field.values.pop_back();
    EXPECT_EQ(FieldSampler::make(field, volume).error().code(), Code::BadField);
    field.values.push_back(INFINITY);
    EXPECT_EQ(FieldSampler::make(field, volume).error().code(), Code::BadField);
}

TEST(FieldSampler, ACellWithTooManyVoxelsIsRejected) {
    const SemanticVolume volume = twoRooms();
    Field field = gridField({{2, 2, 2}, {0, 0, 0}, {1e4, 1e4, 1e4}, {}}, "all");
    EXPECT_EQ(FieldSampler::make(field, volume).error().code(), Code::InputTooBig);
}

TEST(FieldSampler, SamplesMillionsOfPlacesPerSecond) {
    SemanticVolume volume = emptyVolume({200, 200, 100}, {0.1, 0.1, 0.1});
    Field field = gridField({{200, 200, 100}, {0, 0, 0}, {1, 1, 1}, {}}, "air");
    fill(field, [](Vec3d p) { return p.x; });
    const FieldSampler sampler = *FieldSampler::make(field, volume);
    const auto start = std::chrono::steady_clock::now();
    double sum = 0;
    constexpr int kSamples = 2000000;
    for (int n = 0; n < kSamples; ++n)
        sum += double{sampler.at({n % 199 + 0.3, n / 199 % 199 + 0.2, n / 39601 % 99 + 0.4})};
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_GT(sum, 0);
    RecordProperty("samplesPerSecond", std::to_string(kSamples / seconds));
    EXPECT_LT(seconds, 4) << "half a million per second, also on a loaded machine";
}

}  // namespace
}  // namespace svt::fields
