#include <svt/drawing/levels/two_storeys_test.hpp>
#include <svt/drawing/section_plane.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

double heightOf(const Result<SectionPlane>& plane) { return plane ? dot(plane->normal, plane->point) : -1; }

TEST(SectionPlane, AxesCountFromTheLowerCorner) {
    const auto volume = twoStoreys();
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("z=1.2", volume)), 31.2);
    EXPECT_EQ(parseSectionPlane("z>1.2", volume)->normal, (Vec3d{0, 0, 1}));
    EXPECT_EQ(parseSectionPlane("y<0.5", volume)->normal, (Vec3d{0, -1, 0}));
    EXPECT_DOUBLE_EQ(parseSectionPlane("x=0.5", volume)->point.x, 100.5);
}

TEST(SectionPlane, CoordinatesOfTheCrsAreAbsolute) {
    auto volume = twoStoreys();
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("z=abs(31.2)", volume)), 31.2);
    EXPECT_DOUBLE_EQ(parseSectionPlane("x<abs(100.5)", volume)->point.x, 100.5);
    EXPECT_EQ(parseSectionPlane("x<abs(100.5)", volume)->normal, (Vec3d{-1, 0, 0}));
    for (const char* const wrong : {"z=abs(1.2)", "z=abs()", "z=abs(31", "z=abs31.2", "z=abs(31.2)x"})
        EXPECT_EQ(parseSectionPlane(wrong, volume).error().code(), Code::BadSection) << wrong;
    // Axes of a turned grid have no coordinate of their own, but for the height.
    volume.grid = *volume::Grid::fromParts({5, 5, 21}, {0.25, 0.25, 0.25}, {100, 200, 30},
                                           {Vec3d{0.6, 0.8, 0}, Vec3d{-0.8, 0.6, 0}, Vec3d{0, 0, 1}});
    EXPECT_EQ(parseSectionPlane("x=abs(100.5)", volume).error().code(), Code::BadSection);
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("z=abs(31.2)", volume)), 31.2);
}

TEST(SectionPlane, StoreysCountFromTheFloorOfTheirRooms) {
    const auto volume = twoStoreys();
    // The room's lowest sample is k = 2, its voxel begins half a spacing lower. Voxels tell it to one voxel.
    EXPECT_DOUBLE_EQ(parseSectionPlane("storey=EG+1.1", volume)->bound, 0.25);
    EXPECT_DOUBLE_EQ(parseSectionPlane("z=1.2", volume)->bound, 0);
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("storey=EG+1.1", volume)), 30 + 0.375 + 1.1);
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("storey=EG", volume)), 30 + 0.375 + 1);
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("storey=1-OG+0.5", volume)), 30 + 2.875 + 0.5);
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("storey=s1-0.25", volume)), 30 + 2.875 - 0.25);
    EXPECT_DOUBLE_EQ(heightOf(parseSectionPlane("storey=\"1-OG\"+0.5", volume)), 30 + 2.875 + 0.5);
}

TEST(SectionPlane, DefaultIsAPlanOfTheLowestFloor) {
    auto volume = twoStoreys();
    EXPECT_DOUBLE_EQ(heightOf(defaultSectionPlane(volume)), 30 + 0.375 + 1.1);
    EXPECT_EQ(defaultSectionPlane(volume).normal, (Vec3d{0, 0, 1}));
    // CityGML 2.0 has storeys as groups.
    auto groups = volume;
    for (volume::Label& label : groups.labels.labels) {
        if (label.className != "Storey") continue;
        label.className = "CityObjectGroup";
        label.attributes.push_back({"class", std::string("building storey"), {}});
    }
    EXPECT_DOUBLE_EQ(heightOf(defaultSectionPlane(groups)), 30 + 0.375 + 1.1);
    for (volume::Label& label : volume.labels.labels)
        if (label.className == "Storey") label.className = "CityObjectGroup";
    // Without storeys the floors of rooms tell; without rooms it is the middle.
    EXPECT_DOUBLE_EQ(heightOf(defaultSectionPlane(volume)), 30 + 0.375 + 1.1);
    for (volume::Label& label : volume.labels.labels)
        if (label.className != "Building") label.className = "GenericCityObject";
    EXPECT_DOUBLE_EQ(heightOf(defaultSectionPlane(volume)), 30 + 2.5);
}

TEST(SectionPlane, FourNumbersAreAHalfSpace) {
    const auto volume = twoStoreys();
    const auto plane = parseSectionPlane("0,0,2,-2.4", volume);
    ASSERT_TRUE(plane);
    EXPECT_DOUBLE_EQ(heightOf(plane), 31.2);
    EXPECT_DOUBLE_EQ(length(parseSectionPlane("1,1,0,-1", volume)->normal), 1);
}

TEST(SectionPlane, SaysWhatIsWrong) {
    const auto volume = twoStoreys();
    const auto codeOf = [&](const char* text) {
        const auto plane = parseSectionPlane(text, volume);
        return plane ? Code::Internal : plane.error().code();
    };
    for (const char* text : {"", "z", "z=", "z=1m", "w=1", "z=nan", "1,2,3", "1,2,3,4,5", "0,0,0,1", "inf,0,0,0"})
        EXPECT_EQ(codeOf(text), Code::BadSection) << text;
    for (const char* text : {"z=9", "z=-1", "1,0,0,5"}) EXPECT_EQ(codeOf(text), Code::BadSection) << text;
    EXPECT_NE(parseSectionPlane("z=9", volume).error().message().find("5.125"), std::string::npos);
    EXPECT_EQ(codeOf("storey=Attic+1"), Code::NothingSelected);
}

TEST(SectionPlane, MovesOffFacesToTheSideThatIsKept) {
    volume::SemanticVolume volume;
    volume.grid = *volume::Grid::fromParts({5, 5, 21}, {0.25, 0.25, 0.25}, {100, 200, 30},
                                           {Vec3d{0.6, 0.8, 0}, Vec3d{-0.8, 0.6, 0}, Vec3d{0, 0, 1}});
    const auto faceAt = [&](double metres) {
        return volume::FacePlane{{{0, 0, -1}, metres / 0.25 + 0.5 - 1.0 / 512}, {0, 0, 0}, {1, 1, 1}};
    };
    volume.planes = {faceAt(2.0), faceAt(2.0004), {{{0, 1, 0}, -2.5 + 1.0 / 512}, {0, 0, 0}, {1, 1, 1}}};
    const auto at = [](double z, double side) { return SectionPlane{{0, 0, side}, {100, 200, 30 + z}}; };
    const double hair = 2.5 * 1.5 * 0.25 / 256;
    // Kept is what lies below, where another face is as near: past both.
    EXPECT_NEAR(hairOffFaces(at(2.0, 1), volume), hair - 0.0004, 1e-9);
    EXPECT_NEAR(hairOffFaces(at(2.0004, 1), volume), hair, 1e-9);
    EXPECT_NEAR(hairOffFaces(at(2.001, -1), volume), hair - 0.001, 1e-9);
    EXPECT_NEAR(keptOffFaces(at(2.0, -1), volume).point.z, 32 + hair, 1e-9);
    EXPECT_EQ(hairOffFaces(at(2.01, 1), volume), 0);
    EXPECT_EQ(hairOffFaces(at(1.9, -1), volume), 0);
    // Along the turned y axis: the plane of voxel space 2.5 is sample 2, at 0.5 m.
    const Vec3d turned = volume.grid.origin() + Vec3d{-0.4, 0.3, 0};
    EXPECT_NEAR(hairOffFaces({{-0.8, 0.6, 0}, turned}, volume), hair, 1e-9);
    EXPECT_EQ(hairOffFaces({{0, 1, 0}, turned}, volume), 0);
    volume.planes = {{{{0, 0.6, -0.8}, 2.0 / 0.25 + 0.5}, {0, 0, 0}, {1, 1, 1}}};
    EXPECT_EQ(hairOffFaces(at(2.0, 1), volume), 0) << "a slanted face has no common plane with it";
    EXPECT_EQ(hairOffFaces(at(2.5, 1), volume), 0);
    EXPECT_EQ(hairOffFaces(at(2.58, 1), volume), 0);
    volume.planes.clear();
    EXPECT_EQ(hairOffFaces(at(2.0, 1), volume), 0);
}

}  // namespace
}  // namespace svt::drawing
