#include <svt/illustrate/scene/region.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace svt::illustrate {
namespace {

// Air of 10 x 10 x 10 m around a block of 2 m in its middle, turned by 90 degrees: the grid's x is the world's y.
volume::SemanticVolume turnedBlock() {
    volume::SemanticVolume volume = volume::test::emptyVolume({21, 21, 21}, {0.5, 0.5, 0.5}, {100, 200, 30},
                                                              {Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}});
    volume::test::addObject(volume, "b1", "Building");
    volume::test::paintBoxes(volume, {{1, {8, 8, 8}, {13, 13, 13}}});
    return volume;
}

render::Camera frontCamera() {
    render::Camera camera;
    camera.eye = {95, 170, 35};
    camera.target = {95, 205, 35};
    camera.verticalFovDegrees = 30;
    return camera;
}

bool contains(const std::vector<render::ConvexPart>& parts, Vec3d p) {
    return std::any_of(parts.begin(), parts.end(), [&](const render::ConvexPart& part) {
        return std::all_of(part.halfSpaces.begin(), part.halfSpaces.end(),
                           [&](const render::HalfSpace& half) { return dot(half.normal, p) + half.offset > 0; }) &&
               std::all_of(part.rounds.begin(), part.rounds.end(),
                           [&](const render::RoundBody& round) { return round.contains(p); });
    });
}

class RegionTest : public ::testing::Test {
protected:
    const volume::SemanticVolume volume_ = turnedBlock();
    const analyze::LabelRows rows_{volume_.labels};
    const RegionContext context_{volume_, rows_, frontCamera(), 1.5};

    // At metres from the grid's lower corner along its axes.
    bool isIn(const std::string& text, double x, double y, double z) {
        const auto parts = parseRegion(text, context_);
        EXPECT_TRUE(parts) << (parts ? "" : parts.error().message());
        return parts && contains(*parts, {100 - y, 200 + x, 30 + z});
    }
    std::string errorOf(const std::string& text) {
        const auto parts = parseRegion(text, context_);
        return parts ? "" : parts.error().toString();
    }
};

TEST_F(RegionTest, PrimitivesHoldWhatTheySay) {
    EXPECT_TRUE(isIn("z>1.2", 5, 5, 1.3));
    EXPECT_FALSE(isIn("z>1.2", 5, 5, 1.1));
    EXPECT_TRUE(isIn("box(3,2,1, 1,4,2)", 2, 3, 1.5));
    EXPECT_FALSE(isIn("box(1,2,1,3,4,2)", 3.5, 3, 1.5));
    EXPECT_TRUE(isIn("ball(1,2,3,1)", 1.9, 2, 3));
    EXPECT_FALSE(isIn("ball(1,2,3,1)", 1.9, 2.9, 3));
    EXPECT_TRUE(isIn("cylinder(1,2,3, 2,0,0, 0.5)", 9, 2.4, 3));
    EXPECT_FALSE(isIn("cylinder(1,2,3, 2,0,0, 0.5)", 9, 2.6, 3));
    // From k = 8 to 12, half a voxel more to both sides.
    EXPECT_TRUE(isIn("around(id=b1)", 3.8, 5, 5));
    EXPECT_FALSE(isIn("around(id=b1)", 3.7, 5, 5));
    EXPECT_TRUE(isIn("around(id=b1; 0.5)", 3.3, 5, 5));
}

TEST_F(RegionTest, PrismsStandOverAnyPolygon) {
    // An L, either way around.
    for (const char* text : {"prism(0,0, 4,0, 4,1, 1,1, 1,4, 0,4; 1,2)", "prism(0,4, 1,4, 1,1, 4,1, 4,0, 0,0; 2,1)"}) {
        EXPECT_TRUE(isIn(text, 0.5, 3.5, 1.5)) << text;
        EXPECT_TRUE(isIn(text, 3.5, 0.5, 1.5)) << text;
        EXPECT_FALSE(isIn(text, 2, 2, 1.5)) << text;
        EXPECT_FALSE(isIn(text, 0.5, 3.5, 2.5)) << text;
    }
}

TEST_F(RegionTest, WordsJoinThem) {
    EXPECT_TRUE(isIn("z>1 and x>1 or y>9", 2, 2, 2));
    EXPECT_FALSE(isIn("z>1 and x>1 or y>9", 0.5, 2, 2));
    EXPECT_TRUE(isIn("z>1 and x>1 or y>9", 0.5, 9.5, 0));
    EXPECT_FALSE(isIn("z>1 AND (x>1 or y>9)", 0.5, 9.5, 0));
    EXPECT_FALSE(isIn("not box(1,1,1,2,2,2)", 1.5, 1.5, 1.5));
    EXPECT_TRUE(isIn("not box(1,1,1,2,2,2)", 1.5, 1.5, 2.5));
    EXPECT_TRUE(isIn("not (z>1 or x>1)", 0.5, 5, 0.5));
    EXPECT_FALSE(isIn("not (z>1 or x>1)", 1.5, 5, 0.5));
    EXPECT_TRUE(isIn("not not z>1", 0.5, 5, 1.5));
    // As many planes as there are ways through them: any point is where the words say.
    const char* text = "(z>1 or y<4) and not (x>2 and x<3) and not box(5,5,0,6,6,9)";
    for (int n = 0; n < 500; ++n) {
        const double x = n % 7 + 0.4, y = n / 7 % 9 + 0.3, z = n % 11 * 0.7;
        const bool isBox = x > 5 && x < 6 && y > 5 && y < 6 && z > 0 && z < 9;
        EXPECT_EQ(isIn(text, x, y, z), (z > 1 || y < 4) && !(x > 2 && x < 3) && !isBox);
    }
}

TEST_F(RegionTest, AViewIsACircleOfThePicture) {
    const auto inPicture = [](Vec3d p) {
        // Eye 30 m before the grid's middle, looking along the world's y.
        const double half = std::tan(15 * 3.14159265358979 / 180), depth = p.y - 170;
        return Vec3d{((p.x - 95) / (depth * half * 1.5) + 1) / 2, (1 - (p.z - 35) / (depth * half)) / 2, 0};
    };
    const auto parts = parseRegion("view(0.6,0.4,0.2)", context_);
    ASSERT_TRUE(parts);
    for (int n = 0; n < 400; ++n) {
        const Vec3d p{90.0 + n % 10, 200.0 + n / 10 % 10, 31 + n / 100 * 2.0};
        const Vec3d seen = inPicture(p);
        const double distance = std::hypot((seen.x - 0.6) * 1.5, seen.y - 0.4);
        if (std::abs(distance - 0.2) > 0.02) {
            EXPECT_EQ(contains(*parts, p), distance < 0.2) << p.x << " " << p.y;
        }
    }
}

TEST_F(RegionTest, ACutawayFreesTheLinesOfSight) {
    const auto parts = parseRegion("cutaway(id=b1; 0.1)", context_);
    ASSERT_TRUE(parts);
    const Vec3d eye = context_.camera.eye;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d p{corner & 1 ? 93.75 : 96.25, corner & 2 ? 203.75 : 206.25, corner & 4 ? 33.75 : 36.25};
        for (double t = 0.01; t < 1; t += 0.01)
            EXPECT_TRUE(contains(*parts, eye + (p - eye) * t)) << corner << " " << t;
    }
    // Context stays beside it and behind.
    EXPECT_FALSE(contains(*parts, {95, 212, 35}));
    EXPECT_FALSE(contains(*parts, {90, 205, 35}));
    EXPECT_FALSE(contains(*parts, {95, 205, 39.9}));
}

TEST_F(RegionTest, SaysWhatIsWrong) {
    EXPECT_NE(errorOf("z>1 x>1").find("column 5: expected 'and', 'or' or the end, found 'x>1'"), std::string::npos);
    EXPECT_NE(errorOf("").find("expected a region"), std::string::npos);
    EXPECT_NE(errorOf("(z>1").find("expected ')', found the end"), std::string::npos);
    EXPECT_NE(errorOf("sphere(1,1,1,1)").find("ball"), std::string::npos);
    EXPECT_NE(errorOf("ball(1,1,1,0)").find("radius"), std::string::npos);
    EXPECT_NE(errorOf("ball(1,1,1)").find("expected x,y,z,r"), std::string::npos);
    EXPECT_NE(errorOf("box(1,1,1,1,2,2)").find("no inside"), std::string::npos);
    EXPECT_NE(errorOf("prism(0,0,1,1,1,0,0,1;0,1)").find("prism"), std::string::npos);
    EXPECT_NE(errorOf("not ball(1,1,1,1)").find("round"), std::string::npos);
    EXPECT_NE(errorOf("z>99").find("E503"), std::string::npos);
    EXPECT_NE(errorOf("storey(Attic)").find("E902"), std::string::npos);
    EXPECT_NE(errorOf("around(clas=Building)").find("E902"), std::string::npos);
    EXPECT_NE(errorOf("cutaway(id=)").find("E901"), std::string::npos);
    EXPECT_NE(errorOf("around(id=b1; -1)").find("margin"), std::string::npos);
    std::string many = "x>1";
    for (int n = 0; n < 40; ++n) many += " or y>" + std::to_string(1 + n * 0.1);
    EXPECT_NE(errorOf(many).find("32 convex parts"), std::string::npos);
    many = "x>1";
    for (int n = 0; n < 20; ++n) many += " and y>" + std::to_string(1 + n * 0.1);
    EXPECT_NE(errorOf(many).find("16"), std::string::npos);
    EXPECT_NE(errorOf(std::string(5000, '(')).find("deeply"), std::string::npos);
}

}  // namespace
}  // namespace svt::illustrate
