#include <svt/analyze/scalar_boxes.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

TEST(ScalarBoxes, AreThoseOfEverySample) {
    const Vec3i dimension{130, 70, 23};
    std::vector<volume::Scalar> dense(std::size_t(130) * 70 * 23, 0);
    std::vector<SampleBox> expected(6);
    std::uint32_t state = 1;
    for (std::size_t n = 0; n < dense.size(); ++n) {
        state = state * 1664525u + 1013904223u;
        // Sparse, so that boxes do not reach everywhere; scalar 5 stays without samples.
        if ((state >> 16) % 20000 == 0) dense[n] = 1 + (state >> 8) % 4;
        const Vec3i at{static_cast<std::int32_t>(n % 130), static_cast<std::int32_t>(n / 130 % 70),
                       static_cast<std::int32_t>(n / (130 * 70))};
        expected[dense[n]].add({at, at});
    }
    EXPECT_EQ(scalarBoxes(volume::ColumnVolume::fromDense(dimension, dense), 6), expected);
    EXPECT_TRUE(expected[5].isEmpty());
}

TEST(LabelBoxes, JoinThePhasesOfALabel) {
    std::vector<volume::Scalar> dense(8 * 8 * 8, 0);
    dense[0] = 1;
    dense[7 + 8 * (6 + 8 * 5)] = 2;
    volume::LabelTable table;
    table.labels.resize(2);
    table.labels[0].first = 1;
    table.labels[0].count = 2;
    const auto boxes = labelBoxes(volume::ColumnVolume::fromDense({8, 8, 8}, dense), table);
    EXPECT_EQ(boxes[0], (SampleBox{{0, 0, 0}, {7, 6, 5}}));
    EXPECT_TRUE(boxes[1].isEmpty());
}

}  // namespace
}  // namespace svt::analyze
