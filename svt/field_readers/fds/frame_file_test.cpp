#include <svt/field_readers/fds/frame_file.hpp>

#include <svt/field_readers/fds/fds_case_test.hpp>
#include <svt/field_readers/fds/smoke_codes.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::field_readers {
namespace {

using test::evenNodes;
using test::FdsCase;

double slope(Vec3d at, double time) { return at.x + 10 * at.y + 100 * at.z + 1000 * time; }

TEST(Runs, UnpackEveryLengthAndValue) {
    for (std::size_t count = 1; count <= 600; ++count)
        for (const int value : {0, 1, 127, 254}) {
            std::string plain(count, static_cast<char>(value));
            plain += std::string(1, '\x07') + std::string(3, '\x05');
            std::vector<std::uint8_t> bytes{42};
            ASSERT_TRUE(unpackRuns(test::packRuns(plain), plain.size(), bytes)) << count;
            ASSERT_EQ(std::string(bytes.begin() + 1, bytes.end()), plain) << count;
        }
}

TEST(Runs, RefuseOtherSizesAndCutRuns) {
    std::vector<std::uint8_t> bytes;
    const std::string packed = test::packRuns(std::string(10, 'a'));
    EXPECT_FALSE(unpackRuns(packed, 9, bytes));
    bytes.clear();
    EXPECT_FALSE(unpackRuns(packed, 11, bytes));
    bytes.clear();
    EXPECT_FALSE(unpackRuns(packed.substr(0, 2), 10, bytes));
    bytes.clear();
    EXPECT_FALSE(unpackRuns("\xFF", 10, bytes));
    EXPECT_FALSE(unpackRuns("abc", 2, bytes));
}

TEST(Frames, EveryCutOfASliceKeepsTheWholeFrames) {
    const svt::test::TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 1, 2), evenNodes(0, 1, 1), evenNodes(0, 1, 1)}});
    const auto path = fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 2, 0, 1, 0, 1}, {0, 1, 2}, slope);
    const std::string all = svt::test::readText(path);
    const std::size_t frame = 12 + 8 + 4 * 12, head = all.size() - 3 * frame;
    for (std::size_t size = head; size <= all.size(); ++size) {
        svt::test::writeText(path, all.substr(0, size));
        const auto list = listSliceFrames(path);
        ASSERT_TRUE(list) << size;
        const std::size_t whole = (size - head) / frame;
        EXPECT_EQ(list->times.size(), whole) << size;
        EXPECT_EQ(list->cutAt.has_value(), (size - head) % frame != 0) << size;
        EXPECT_EQ(list->cutAt.value_or(head + whole * frame), head + whole * frame);
    }
    for (std::size_t size = 0; size < head; ++size) {
        svt::test::writeText(path, all.substr(0, size));
        const auto list = listSliceFrames(path);
        ASSERT_FALSE(list) << size;
        EXPECT_EQ(list.error().code(), Code::BadField);
    }
}

TEST(Frames, EveryCutOfSmokeKeepsTheWholeFrames) {
    const svt::test::TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 1, 9), evenNodes(0, 1, 1), evenNodes(0, 1, 1)}});
    const auto path = fds.addSmoke(0, "SOOT DENSITY", "kg/m3", 8700, {0, 1, 2},
                                   [](Vec3d at, double time) { return std::floor(at.x * 9) + time; });
    const std::string all = svt::test::readText(path);
    std::vector<std::size_t> ends{40};
    const auto whole = listSmokeFrames(path);
    ASSERT_TRUE(whole);
    for (const auto& frame : whole->frames) ends.push_back(static_cast<std::size_t>(frame.next()));
    ASSERT_EQ(ends.back(), all.size());
    for (std::size_t size = 40; size <= all.size(); ++size) {
        svt::test::writeText(path, all.substr(0, size));
        const auto list = listSmokeFrames(path);
        ASSERT_TRUE(list) << size;
        std::size_t count = 0;
        while (count + 1 < ends.size() && ends[count + 1] <= size) ++count;
        EXPECT_EQ(list->times.size(), count) << size;
        EXPECT_EQ(list->cutAt.has_value(), ends[count] != size) << size;
    }
}

TEST(Frames, LaterStartOfTheRunReplacesItsTimes) {
    const svt::test::TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 1, 1), evenNodes(0, 1, 1), evenNodes(0, 1, 1)}});
    const auto path = fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 1, 0, 1, 0, 1}, {0, 1, 2, 1, 3}, slope);
    const auto list = listSliceFrames(path);
    ASSERT_TRUE(list);
    EXPECT_EQ(list->times, (std::vector<double>{0, 1, 3}));
    EXPECT_EQ(list->replaced, 2u);
}

TEST(Frames, DamageInTheMiddleEndsTheWholeFrames) {
    const svt::test::TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 1, 1), evenNodes(0, 1, 1), evenNodes(0, 1, 1)}});
    const auto path = fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 1, 0, 1, 0, 1}, {0, 1, 2}, slope);
    std::string all = svt::test::readText(path);
    const std::size_t frame = 12 + 8 + 32;
    all[all.size() - 2 * frame] = '\x05';  // the size of the record of the second time
    svt::test::writeText(path, all);
    const auto list = listSliceFrames(path);
    ASSERT_TRUE(list);
    EXPECT_EQ(list->times.size(), 1u);
    EXPECT_EQ(list->cutAt, all.size() - 2 * frame);
}

// The rule of FDS: v = round(254 (1 - exp(-s dx rho))).
TEST(Smoke, DensityHasTheOpacityOfItsByte) {
    const auto volume = volume::test::emptyVolume({4, 4, 4}, {1, 1, 1});
    Diagnostics diagnostics;
    const std::filesystem::path path = "house.smv";
    const FieldReadOptions options;
    const Reading reading{path, volume, options, diagnostics};
    SmvFile file;
    file.quantity = "SOOT DENSITY";
    file.extinction = 8700;
    for (const double side : {0.05, 0.1, 1.0}) {
        SmvMesh mesh;
        mesh.nodes[0] = {2, 2 + side};
        Assumptions assumptions;
        const auto values = smokeValues(file, mesh, {}, reading, assumptions);
        ASSERT_TRUE(values);
        EXPECT_EQ((*values)[0], 0.0f);
        // Any density comes back with the opacity of its cell within half a step of the code.
        for (int n = 0; n <= 20000; ++n) {
            const double density = 6.0 / (8700 * side) * n / 20000;
            const double opacity = 1 - std::exp(-8700 * density * side);
            const auto byte = static_cast<std::size_t>(std::lround(254 * opacity));
            const double back = 1 - std::exp(-8700 * double{(*values)[byte]} * side);
            ASSERT_LE(std::abs(back - opacity) * 255, 0.51) << density;
        }
        // A slab of 1 m with a density that a byte stands for.
        for (std::size_t byte = 0; byte < 254; ++byte) {
            const double density = -std::log(1 - static_cast<double>(byte) / 254) / (8700 * side);
            EXPECT_NEAR(std::exp(-8700 * double{(*values)[byte]}) * 255, std::exp(-8700 * density) * 255, 0.001);
        }
        EXPECT_TRUE(std::isnan((*values)[255]));
        EXPECT_GT((*values)[254], (*values)[253]);
    }
}

TEST(Smoke, HeatAndTemperatureHaveTheRangesOfTheCaseOrOfFds) {
    const auto volume = volume::test::emptyVolume({4, 4, 4}, {1, 1, 1});
    Diagnostics diagnostics;
    const std::filesystem::path path = "house.smv";
    const FieldReadOptions options;
    const Reading reading{path, volume, options, diagnostics};
    SmvFile file;
    file.quantity = "HRRPUV";
    Assumptions assumptions;
    SmvCase fds;
    const auto heat = smokeValues(file, {}, fds, reading, assumptions);
    ASSERT_TRUE(heat);
    EXPECT_EQ((*heat)[254], 1200.0f);
    EXPECT_NE(assumptions.json().find("defaults of FDS"), std::string::npos);
    fds.ranges["TEMP_MINMAX"] = {20, 528};
    file.quantity = "TEMPERATURE";
    const auto temperature = smokeValues(file, {}, fds, reading, assumptions);
    ASSERT_TRUE(temperature);
    EXPECT_EQ((*temperature)[127], 20.0f + 254.0f);
    file.quantity = "CARBON DIOXIDE";
    const auto other = smokeValues(file, {}, fds, reading, assumptions);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code(), Code::BadField);
}

}  // namespace
}  // namespace svt::field_readers
