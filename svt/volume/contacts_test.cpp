#include <svt/volume/contacts.hpp>
#include <svt/volume/random_columns_test.hpp>

#include <gtest/gtest.h>

#include <map>

namespace svt::volume::test {
namespace {

std::vector<std::uint32_t> labelsOfScalars(std::uint32_t scalars, std::uint32_t scalarsPerLabel) {
    std::vector<std::uint32_t> labelOfScalar{kNoLabel};
    for (std::uint32_t s = 1; s < scalars; ++s) labelOfScalar.push_back((s - 1) / scalarsPerLabel);
    return labelOfScalar;
}

std::vector<Contact> bruteForce(const ColumnVolume& columns, const std::vector<std::uint32_t>& labelOfScalar) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::uint64_t, 3>> faces;
    const Vec3i n = columns.dimension();
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    Vec3i p{i, j, k};
                    const std::uint32_t a = labelOfScalar[columns.scalarAt(p.x, p.y, p.z)];
                    if (++p[axis] >= n[axis]) continue;
                    const std::uint32_t b = labelOfScalar[columns.scalarAt(p.x, p.y, p.z)];
                    if (a != b && a != kNoLabel && b != kNoLabel)
                        ++faces[{std::min(a, b), std::max(a, b)}][std::size_t(axis)];
                }
    std::vector<Contact> contacts;
    for (const auto& [pair, count] : faces) contacts.push_back({pair.first, pair.second, count});
    return contacts;
}

TEST(Contacts, TwoBoxesTouchByOneFace) {
    // Two boxes of 2 x 3 x 4 voxels side by side along x, in the middle of nothing.
    const Vec3i n{8, 8, 8};
    std::vector<Scalar> dense(512, 0);
    for (std::size_t k = 2; k < 6; ++k)
        for (std::size_t j = 1; j < 4; ++j)
            for (std::size_t i = 2; i < 6; ++i) dense[i + 8 * (j + 8 * k)] = i < 4 ? 1 : 2;
    const auto contacts = labelContacts(ColumnVolume::fromDense(n, dense), labelsOfScalars(3, 1));
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0], (Contact{0, 1, {12, 0, 0}}));
}

TEST(Contacts, AreThoseOfVoxelByVoxel) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const ColumnVolume columns = randomColumns({70 + std::int32_t(seed), 67, 21}, seed);
        for (const std::uint32_t perLabel : {1u, 3u}) {
            const auto labels = labelsOfScalars(kRandomScalars, perLabel);
            const auto found = labelContacts(columns, labels, 2);
            EXPECT_EQ(found, bruteForce(columns, labels)) << "seed " << seed;
            EXPECT_EQ(found, labelContacts(columns, labels, 1));
        }
    }
}

TEST(Contacts, ScalarsWithoutLabelTouchNobody) {
    const ColumnVolume columns = ColumnVolume::fromDense({2, 2, 2}, std::vector<Scalar>{1, 2, 1, 2, 9, 9, 9, 9});
    const auto contacts = labelContacts(columns, labelsOfScalars(3, 1));
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0], (Contact{0, 1, {2, 0, 0}}));
}

}  // namespace
}  // namespace svt::volume::test
