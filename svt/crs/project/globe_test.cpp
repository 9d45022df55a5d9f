#include <svt/crs/globe.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/crs/projection.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace svt::crs {
namespace {

/// What cs2cs makes of points of a projection on the globe (EPSG:4978); empty where the program is missing.
std::vector<Vec3d> centredByCs2cs(const std::string& source, const std::vector<Vec3d>& points) {
    if (std::system("command -v cs2cs > /dev/null 2>&1") != 0) return {};
    const test::TemporaryFolder folder;
    std::ofstream file(folder / "in");
    for (const Vec3d p : points) file << fmt::format("{:.9f} {:.9f} {:.9f}\n", p.x, p.y, p.z);
    file.close();
    const std::string command =
        fmt::format("PROJ_NETWORK=OFF cs2cs -f %.6f {} +to +proj=geocent +ellps=WGS84 +units=m < {} > {}", source,
                    (folder / "in").string(), (folder / "out").string());
    if (std::system(command.c_str()) != 0) return {};
    std::ifstream answers(folder / "out");
    std::vector<Vec3d> results;
    for (Vec3d p; answers >> p.x >> p.y >> p.z;) results.push_back(p);
    return results;
}

TEST(Globe, KnownPlacesAreMetresFromTheCentre) {
    EXPECT_LT(length(earthCentred({0, 0, 0}) - Vec3d{6378137, 0, 0}), 1e-9);
    EXPECT_LT(length(earthCentred({90, 0, 100}) - Vec3d{0, 6378237, 0}), 1e-8);
    EXPECT_LT(length(earthCentred({12, 90, 0}) - Vec3d{0, 0, 6356752.314245179}), 1e-8);
}

TEST(Globe, FramesAreWherePeersPutTheirPoints) {
    const std::vector<Vec3d> offsets{{0, 0, 0}, {30, 0, 0}, {0, 30, 0}, {0, 0, 30}, {20, -10, 8}};
    struct Case {
        int epsg;
        const char* proj;
        Vec3d place;
    };
    // A zone of UTM east of its meridian, one of the south, a projection that needs PROJ.
    for (const auto& [epsg, proj, place] :
         {Case{25832, "+proj=utm +zone=32 +ellps=GRS80 +units=m", {691000.5, 5334765.25, 520}},
          Case{32756, "+proj=utm +zone=56 +south +ellps=WGS84 +units=m", {334873, 6252266, 12}},
          Case{3035, "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80", {4432500, 2780000, 5}}}) {
        if (epsg == 3035 && projVersion().empty()) continue;
        const auto frame = frameOf(epsg, place);
        ASSERT_TRUE(frame) << frame.error().toString();
        std::vector<Vec3d> points;
        for (const Vec3d o : offsets) points.push_back(place + o);
        const auto expected = centredByCs2cs(proj, points);
        if (expected.empty()) GTEST_SKIP() << "cs2cs is not installed";
        ASSERT_EQ(expected.size(), points.size());
        for (std::size_t n = 0; n < points.size(); ++n) {
            const Vec3d found = frame->origin + frame->axes[0] * offsets[n].x + frame->axes[1] * offsets[n].y +
                                frame->axes[2] * offsets[n].z;
            EXPECT_LT(length(found - expected[n]), 5e-4) << epsg << " " << n;
        }
    }
}

TEST(Globe, AFrameIsEastNorthAndUp) {
    const GlobeFrame frame = frameAt({11.5, 48.1, 500});
    for (const Vec3d axis : frame.axes) EXPECT_NEAR(length(axis), 1, 1e-12);
    EXPECT_NEAR(dot(cross(frame.axes[0], frame.axes[1]), frame.axes[2]), 1, 1e-12);
    EXPECT_LT(length(earthCentred({11.5, 48.1, 510}) - frame.origin - frame.axes[2] * 10), 1e-6);
    EXPECT_GT(dot(earthCentred({11.5, 48.11, 500}) - frame.origin, frame.axes[1]), 1000);
}

TEST(Globe, WhatIsNowhereIsRefused) {
    EXPECT_EQ(frameOf(4326, {11, 48, 0}).error().code(), Code::CannotProject);
    EXPECT_EQ(frameOf(25832, {5e9, 5e9, 0}).error().code(), Code::CannotProject);
    EXPECT_EQ(frameOf(999999, {11, 48, 0}).error().code(), Code::CannotProject);
}

}  // namespace
}  // namespace svt::crs
