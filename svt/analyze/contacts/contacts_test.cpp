#include <svt/analyze/contacts.hpp>

#include <svt/volume/random_columns_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace svt::analyze {
namespace {

volume::Grid gridOf(Vec3i dimension, Vec3d spacing = {1, 1, 1}) {
    return *volume::Grid::fromParts(dimension, spacing, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

// Label l has the scalars [first[l], first[l + 1]).
volume::LabelTable labelsFrom(const std::vector<volume::Scalar>& first) {
    volume::LabelTable table;
    for (std::size_t l = 0; l + 1 < first.size(); ++l) {
        volume::Label label;
        label.first = first[l];
        label.count = first[l + 1] - first[l];
        table.labels.push_back(label);
    }
    return table;
}

// A volume of unit voxels; scalars by the point in the middle of a voxel, voxel i from i to i + 1.
volume::ColumnVolume sample(Vec3i n, const std::function<volume::Scalar(Vec3d)>& scalarAt) {
    std::vector<volume::Scalar> dense;
    dense.reserve(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) dense.push_back(scalarAt({i + 0.5, j + 0.5, k + 0.5}));
    return volume::ColumnVolume::fromDense(n, dense);
}

// Surface of what `isInside` says, by contact with background.
double surfaceOf(Vec3i n, const std::function<bool(Vec3d)>& isInside) {
    const volume::ColumnVolume columns = sample(n, [&](Vec3d p) { return isInside(p) ? 1u : 0u; });
    const auto contacts = findContacts(columns, gridOf(n), labelsFrom({1, 2}), 1);
    return contacts.size() == 1 && contacts[0].b == volume::kNoLabel ? contacts[0].area : -1;
}

// Contact of the two sides of a face that cuts the volume.
double contactAcross(Vec3i n, const std::function<bool(Vec3d)>& isAbove) {
    const volume::ColumnVolume columns = sample(n, [&](Vec3d p) { return isAbove(p) ? 2u : 1u; });
    for (const Contact& contact : findContacts(columns, gridOf(n), labelsFrom({1, 2, 3}), 1))
        if (contact.a == 0 && contact.b == 1) return contact.area;
    return -1;
}

double squared(Vec3d v) { return dot(v, v); }

TEST(Contacts, BoxesAlongTheGridAreExact) {
    for (int shift = 0; shift < 8; ++shift) {
        const Vec3d low{9.0 + shift, 10.0, 11.0 + shift}, size{20, 31, 17};
        const double area = surfaceOf({48, 48, 48}, [&](Vec3d p) { return Box3d{low, low + size}.contains(p); });
        const double expected = 2 * (20 * 31 + 31 * 17 + 20 * 17);
        EXPECT_LE(area, expected + 1e-9);
        EXPECT_GE(area, expected * 0.985) << shift;
    }
}

TEST(Contacts, ARodHasAllItsFacesAndAVoxelThoseOfASlope) {
    const auto isVoxel = [](Vec3d p) { return squared(p - Vec3d{12.5, 12.5, 12.5}) < 0.5; };
    EXPECT_NEAR(surfaceOf({24, 24, 24}, isVoxel), std::sqrt(12), 1e-9);  // its corners may be those of a slope
    for (int shift = 0; shift < 8; ++shift) {
        const Box3d rod{{10.0 + shift, 3, 9}, {13.0 + shift, 43, 12}};
        EXPECT_NEAR(surfaceOf({48, 48, 24}, [&](Vec3d p) { return rod.contains(p); }), 4 * 120 + 18, 0.03 * 498);
    }
}

TEST(Contacts, SlopesAreWithinTheirBound) {
    for (const double slope : {0.03, 1 / 12.0, 0.125, 0.2, 0.25, 1 / 3.0, 0.5, 0.577, 0.8, 1.0, 2.0})
        for (int shift = 0; shift < 8; ++shift) {
            const double area =
                contactAcross({48, 16, 128}, [&](Vec3d p) { return p.z > 12 + 1.37 * shift + slope * p.x; });
            const double exact = 48 * 16 * std::sqrt(1 + slope * slope);
            EXPECT_GT(area, exact * 0.985) << slope;
            EXPECT_LT(area, exact * 1.04) << slope;
        }
}

TEST(Contacts, DiscsOfAnyTurnAreWithinTheirBound) {
    for (int turn = 0; turn < 12; ++turn) {
        const double a = 0.7 + turn * 2.4, z = 2 * (turn + 0.5) / 12 - 1, r = std::sqrt(1 - z * z);
        const Vec3d normal{r * std::cos(a), r * std::sin(a), z}, center{36.3, 36.7, 35.9};
        const volume::ColumnVolume columns = sample({72, 72, 72}, [&](Vec3d p) {
            return squared(p - center) > 32 * 32 ? 0u : dot(p - center, normal) > 0.3 ? 1u : 2u;
        });
        const auto contacts = findContacts(columns, gridOf({72, 72, 72}), labelsFrom({1, 2, 3}), 1);
        const double exact = std::numbers::pi * (32 * 32 - 0.09);
        EXPECT_NEAR(contacts.at(0).area, exact, 0.015 * exact) << turn;
    }
}

TEST(Contacts, SpheresAreWithinTheirBound) {
    const std::pair<double, double> bounds[] = {{10, 0.045}, {15, 0.025}, {20, 0.01}, {30, 0.005}};
    for (const auto& [ballRadius, bound] : bounds) {
        const double radius = ballRadius;  // clang 14 captures no structured binding
        const Vec3d center{36.3, 36.6, 36.1};
        const double area = surfaceOf({72, 72, 72}, [&](Vec3d p) { return squared(p - center) < radius * radius; });
        const double exact = 4 * std::numbers::pi * radius * radius;
        EXPECT_NEAR(area, exact, bound * exact) << radius;
    }
}

TEST(Contacts, BoxesTurnedBy30DegreesAreWithinTheirBound) {
    const std::pair<double, double> bounds[] = {{20, 0.11}, {30, 0.05}, {50, 0.03}};
    const Vec3d u{std::cos(std::numbers::pi / 6), 0.5, 0}, v{-0.5, std::cos(std::numbers::pi / 6), 0};
    for (const auto& [size, bound] : bounds)
        for (int shift = 0; shift < 4; ++shift) {
            const Vec3d center{44.3 + shift * 1.7, 45.1 - shift, 40 + shift * 2.1};
            const double area = surfaceOf({96, 96, 96}, [&, half = size / 2](Vec3d p) {
                const Vec3d d = p - center;
                return std::abs(dot(d, u)) < half && std::abs(dot(d, v)) < half && std::abs(d.z) < half;
            });
            EXPECT_NEAR(area, 6 * size * size, bound * 6 * size * size) << size;
        }
}

TEST(Contacts, SpacingsCount) {
    const Vec3i n{24, 24, 24};
    const volume::ColumnVolume columns = sample(n, [](Vec3d p) { return p.x > 12 ? 1u : p.z > 12 ? 2u : 0u; });
    const auto contacts = findContacts(columns, gridOf(n, {0.1, 0.2, 0.5}), labelsFrom({1, 2, 3}), 1);
    ASSERT_EQ(contacts.size(), 3u);
    EXPECT_EQ(contacts[0].b, 1u);
    EXPECT_NEAR(contacts[0].area, 24 * 12 * 0.2 * 0.5, 1e-9);
    EXPECT_EQ(contacts[0].faces, (std::array<std::uint64_t, 3>{24 * 12, 0, 0}));
    EXPECT_EQ(contacts[1].b, volume::kNoLabel);
}

TEST(Contacts, PhasesOfAPatternAreOneBody) {
    const Vec3i n{16, 16, 16};
    const volume::ColumnVolume columns =
        sample(n, [](Vec3d p) { return 1 + static_cast<volume::Scalar>(p.x + p.z) % 3; });
    const auto contacts = findContacts(columns, gridOf(n), labelsFrom({1, 4}), 1);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].area, 6 * 256, 1e-9);
}

// A face of a voxel between two labels, in a cube of 8 x 8 x 8 voxels.
struct Face {
    int axis, side;
    Vec3i at;  // within the cube
};
using Faces = std::vector<Face>;
using FacesByPair = std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<Vec3i, Faces>>;

// All faces between two labels, by the pair of labels and by cube.
FacesByPair findFaces(const volume::ColumnVolume& columns, const volume::LabelTable& table) {
    const auto labelOf = table.labelOfScalar();
    const Vec3i n = columns.dimension();
    const auto labelAt = [&](Vec3i p) {
        for (int axis = 0; axis < 3; ++axis)
            if (p[axis] < 0 || p[axis] >= n[axis]) return volume::kNoLabel;
        return labelOf[columns.scalarAt(p.x, p.y, p.z)];
    };
    FacesByPair found;
    for (std::int32_t k = 0; k <= n.z; ++k)
        for (std::int32_t j = 0; j <= n.y; ++j)
            for (std::int32_t i = 0; i <= n.x; ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    Vec3i below{i, j, k};
                    --below[axis];
                    const std::uint32_t low = labelAt(below), high = labelAt({i, j, k});
                    if (low != high)
                        found[{std::min(low, high), std::max(low, high)}][{i / 8, j / 8, k / 8}].push_back(
                            {axis, low < high ? 1 : 0, {i & 7, j & 7, k & 7}});
                }
    return found;
}

// How far the faces across `axis` that look to one side lie apart along `along`, the larger of both sides.
int reachOf(const Faces& faces, int axis, int along) {
    int longest = 0;
    for (int side = 0; side < 2; ++side) {
        int low = 8, high = -1;
        for (const Face& face : faces) {
            if (face.axis != axis || face.side != side) continue;
            low = std::min(low, face.at[along]);
            high = std::max(high, face.at[along]);
        }
        longest = std::max(longest, high - low + 1);
    }
    return longest;
}

bool meetsSide(const Faces& faces, int axis, int along) {
    return std::any_of(faces.begin(), faces.end(), [&](const Face& face) {
        return face.axis == axis && (face.at[along] == 0 || face.at[along] == 7);
    });
}

// True if the faces of a cube are sides of a box rather than steps of a slope.
bool isBox(const Faces& faces, const std::array<std::size_t, 3>& counts) {
    bool result = true;
    for (int a = 0; a < 3; ++a) {
        if (counts[std::size_t(a)] == 0) continue;
        result = result && reachOf(faces, a, a) == 1;
        for (int b = 0; b < 3; ++b) {
            if (a == b || counts[std::size_t(b)] == 0) continue;
            const bool isLong = reachOf(faces, a, b) >= 2;
            result = result && (isLong || (meetsSide(faces, a, b) && reachOf(faces, b, a) >= 2));
        }
    }
    return result;
}

void addCube(const Faces& faces, const volume::Grid& grid, Contact& contact) {
    Vec3d area;
    std::array<std::size_t, 3> counts{};
    for (const Face& face : faces) {
        ++counts[std::size_t(face.axis)];
        ++contact.faces[std::size_t(face.axis)];
        area[face.axis] += grid.voxelVolume() / grid.spacing()[face.axis];
    }
    const bool areSides = isBox(faces, counts);
    double squares = 0;
    for (int a = 0; a < 3; ++a) {
        bool isApart = counts[std::size_t(a)] > 16 && reachOf(faces, a, a) == 1;
        for (int b = 0; b < 3; ++b)
            if (b != a && counts[std::size_t(b)] != 0) isApart = isApart && reachOf(faces, b, a) >= 3;
        if (areSides || isApart)
            contact.area += area[a];
        else
            squares += area[a] * area[a];
    }
    contact.area += std::sqrt(squares);
}

// The same from a dense array, face by face.
std::vector<Contact> contactsByVoxels(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                      const volume::LabelTable& table) {
    std::vector<Contact> contacts;
    for (const auto& [pair, cubes] : findFaces(columns, table)) {
        Contact contact{pair.first, pair.second, 0, {}};
        for (const auto& [place, faces] : cubes) addCube(faces, grid, contact);
        contacts.push_back(contact);
    }
    return contacts;
}

TEST(Contacts, AreThoseOfEveryVoxel) {
    const Vec3i dimensions[] = {{130, 70, 23}, {64, 64, 8}, {65, 9, 40}, {2, 2, 2}, {7, 128, 17}};
    std::uint32_t seed = 1;
    for (const Vec3i n : dimensions) {
        const volume::ColumnVolume columns = volume::test::randomColumns(n, seed++);
        // Some labels of several scalars, some scalars of none.
        volume::LabelTable table = labelsFrom({1, 2, 3, 6, 7, 8, 20, 21, 22, 30, volume::test::kRandomScalars});
        table.labels[4].count = 0;
        const volume::Grid grid = gridOf(n, {0.5, 0.25, 2});
        const auto expected = contactsByVoxels(columns, grid, table);
        const auto contacts = findContacts(columns, grid, table, 1);
        ASSERT_EQ(contacts.size(), expected.size());
        for (std::size_t c = 0; c < contacts.size(); ++c) {
            EXPECT_EQ(contacts[c].a, expected[c].a);
            EXPECT_EQ(contacts[c].b, expected[c].b);
            EXPECT_EQ(contacts[c].faces, expected[c].faces);
            EXPECT_NEAR(contacts[c].area, expected[c].area, 1e-9 * expected[c].area);
        }
        for (const int threads : {0, 3, 8}) EXPECT_EQ(findContacts(columns, grid, table, threads), contacts);
    }
}

TEST(Contacts, NeighborsComeByArea) {
    const std::vector<Contact> contacts{
        {0, 1, 2.0, {}}, {0, 2, 5.0, {}}, {0, volume::kNoLabel, 2.0, {}}, {1, 2, 9.0, {}}};
    EXPECT_EQ(findNeighbors(0, contacts), (std::vector<Neighbor>{{2, 5.0}, {1, 2.0}, {volume::kNoLabel, 2.0}}));
    EXPECT_EQ(findNeighbors(2, contacts), (std::vector<Neighbor>{{1, 9.0}, {0, 5.0}}));
    EXPECT_TRUE(findNeighbors(7, contacts).empty());
}

}  // namespace
}  // namespace svt::analyze
