#include <svt/core/temporary_folder_test.hpp>
#include <svt/image/png.hpp>
#include <svt/voxelize/patterns.hpp>
#include <svt/voxelize/solids_test.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::voxelize {
namespace {

using test::TemporaryFolder;
using volume::Grid;

Pattern made(PatternKind kind, Vec3d size = {}, double line = 0, double angle = 45) {
    Pattern pattern;
    pattern.kind = kind;
    pattern.size = size;
    pattern.line = line;
    pattern.angleDegrees = angle;
    const auto result = makePattern(pattern);
    EXPECT_TRUE(result) << result.error().toString();
    return result ? *result : pattern;
}

// Texels of 4 x 3 x `nz`, phases by their number.
std::shared_ptr<const PatternTexels> texelsOf(std::int32_t nz, std::uint32_t phases) {
    auto texels = std::make_shared<PatternTexels>();
    texels->dimension = {4, 3, nz};
    texels->phaseCount = phases;
    for (std::int32_t c = 0; c < 12 * nz; ++c)
        texels->phases.push_back(static_cast<std::uint8_t>(std::uint32_t(c) % phases));
    return texels;
}

std::vector<Pattern> allKinds() {
    std::vector<Pattern> patterns;
    for (const auto& known : kNames<PatternKind>) {
        Pattern pattern;
        pattern.kind = known.value;
        if (pattern.kind == PatternKind::Image) pattern.texels = texelsOf(1, 5);
        if (pattern.kind == PatternKind::Raw) pattern.texels = texelsOf(2, 7);
        patterns.push_back(*makePattern(pattern));
    }
    return patterns;
}

double shareOf(const Pattern& pattern, std::uint32_t phase, Vec3d reach = {10, 10, 10}) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    int hits = 0;
    constexpr int kSamples = 200000;
    for (int n = 0; n < kSamples; ++n)
        hits +=
            pattern.phaseAt({uniform(random) * reach.x, uniform(random) * reach.y, uniform(random) * reach.z}) == phase;
    return double(hits) / kSamples;
}

TEST(Pattern, NamesGoThereAndBack) {
    EXPECT_EQ(kNames<PatternKind>.size(), 12u);
    for (const auto& [kind, name] : kNames<PatternKind>) EXPECT_EQ(fromName<PatternKind>(nameOf(kind)), kind);
    EXPECT_FALSE(fromName<PatternKind>("Brick "));
}

TEST(Pattern, PhasesStayInRangeAndAllOccur) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-8, 8);
    for (const Pattern& pattern : allKinds()) {
        std::vector<int> hits(pattern.phaseCount(), 0);
        for (int n = 0; n < 50000; ++n) {
            const std::uint32_t phase = pattern.phaseAt({uniform(random), uniform(random), uniform(random)});
            ASSERT_LT(phase, pattern.phaseCount()) << nameOf(pattern.kind);
            ++hits[phase];
        }
        for (std::uint32_t phase = 0; phase < pattern.phaseCount(); ++phase)
            EXPECT_GT(hits[phase], 0) << nameOf(pattern.kind) << ' ' << phase;
    }
}

TEST(Pattern, RepeatsAfterItsPeriod) {
    // Dimensions and points that are exact in binary, so that a shift by one period gives exactly the same point of the
    // unit; hatch angles whose sine and cosine are integers.
    struct Case {
        Pattern pattern;
        std::vector<Vec3d> periods;
    };
    const Vec3d size{0.25, 0.125, 0.0625};
    Pattern image = made(PatternKind::None), raw = made(PatternKind::None);
    image.kind = PatternKind::Image;
    image.texels = texelsOf(1, 5);
    image.size = size;
    raw.kind = PatternKind::Raw;
    raw.texels = texelsOf(2, 7);
    raw.size = size;
    const std::vector<Case> cases{
        {made(PatternKind::Brick, size, 0.015625),
         {{0.25, 0, 0}, {0, 0.125, 0}, {0, 0, 0.125}, {0.125, 0.0625, 0.0625}}},
        {made(PatternKind::Block, size, 0.015625), {{0.25, 0, 0}, {0, 0.125, 0}, {0, 0, 0.125}}},
        {made(PatternKind::Hatch, size, 0.015625, 0), {{1, 0, 0}, {0, 0, 0.0625}, {0, 1, 0}}},
        {made(PatternKind::Hatch, size, 0.015625, 90), {{0.0625, 0, 0}, {0, 0.0625, 0}, {0, 0, 1}}},
        {made(PatternKind::Stripes, size, 0.015625), {{0, 0, 0.0625}, {1, 0, 0}, {0, 1, 0}}},
        {made(PatternKind::Checker, size), {{0.5, 0, 0}, {0, 0.25, 0}, {0, 0, 0.125}, {0.25, 0.125, 0}}},
        {made(PatternKind::Grid, size, 0.015625), {{0.25, 0, 0}, {0, 0.125, 0}, {0, 0, 0.0625}}},
        {made(PatternKind::Insulation, size, 0.015625), {{0.25, 0, 0}, {0, 0.125, 0}, {0, 0, 0.03125}}},
        {image, {{0.25, 0, 0}, {0, 1, 0}, {0, 0, 0.0625}}},
        {raw, {{0.25, 0, 0}, {0, 0.125, 0}, {0, 0, 0.0625}}},
    };
    std::mt19937 random(7);
    for (const Case& entry : cases)
        for (int n = 0; n < 3000; ++n) {
            const auto coordinate = [&] { return double(random() % 8192) / 1024 - 4 + 1.0 / 4096; };
            const Vec3d p{coordinate(), coordinate(), coordinate()};
            for (const Vec3d& period : entry.periods)
                ASSERT_EQ(entry.pattern.phaseAt(p + period), entry.pattern.phaseAt(p))
                    << nameOf(entry.pattern.kind) << " at " << p.x << ' ' << p.y << ' ' << p.z;
        }
}

TEST(Pattern, ShareOfTheLinesIsTheAnalyticOne) {
    const Vec3d size{0.25, 0.125, 0.0833};
    const double joint = 0.012;
    const double bricks = (1 - joint / size.x) * (1 - joint / size.y) * (1 - joint / size.z);
    EXPECT_NEAR(shareOf(made(PatternKind::Brick, size, joint), 1), 1 - bricks, 0.005);
    EXPECT_NEAR(shareOf(made(PatternKind::Block, size, joint), 1), 1 - bricks, 0.005);
    EXPECT_NEAR(shareOf(made(PatternKind::Stripes, {1, 1, 0.2}, 0.05), 1), 0.25, 0.005);
    EXPECT_NEAR(shareOf(made(PatternKind::Checker, {0.2, 0.3, 0.1}), 1), 0.5, 0.005);
    EXPECT_NEAR(shareOf(made(PatternKind::Grid, {0.25, 0.2, 0.1}, 0.02), 1), 1 - 0.92 * 0.9 * 0.8, 0.005);
    for (const double angle : {0.0, 30.0, 45.0, -60.0, 135.0, 360.0})
        EXPECT_NEAR(shareOf(made(PatternKind::Hatch, {1, 1, 0.12}, 0.02, angle), 1), 0.02 / 0.12, 0.005) << angle;
    EXPECT_NEAR(shareOf(made(PatternKind::Insulation, {0.16, 0.16, 0.16}, 0.02), 1), 0.02 / 0.08, 0.005);
    EXPECT_NEAR(shareOf(made(PatternKind::WoodGrain, {0.03, 0.03, 0.03}, 0.01), 1), 1.0 / 3, 0.02);
}

TEST(Pattern, EverySecondCourseIsShiftedByHalfABrick) {
    const Pattern pattern = made(PatternKind::Brick, {0.25, 0.125, 0.08}, 0.01);
    // A perpend of the first course stands over the middle of a brick of the next.
    EXPECT_EQ(pattern.phaseAt({0.245, 0.05, 0.04}), 1u);
    EXPECT_EQ(pattern.phaseAt({0.245, 0.05, 0.12}), 0u);
    EXPECT_EQ(pattern.phaseAt({0.12, 0.05, 0.12}), 1u);
    EXPECT_EQ(pattern.phaseAt({0.12, 0.05, 0.04}), 0u);
    EXPECT_EQ(pattern.phaseAt({0.2, 0.05, 0.075}), 1u);  // bed joint
}

TEST(Pattern, FittedBricksShowNoJointOnAnyFaceOfTheirWall) {
    for (const Vec3d extent :
         {Vec3d{4.03, 0.365, 2.61}, Vec3d{1.17, 0.24, 2.5}, Vec3d{7.3, 0.1, 0.9}, Vec3d{0.5, 0.5, 3}}) {
        PatternedObject wall{1, made(PatternKind::Brick), {}};
        wall.axes.extent = extent;
        fitPattern(wall, {0.005, 0.005, 0.005});
        const Pattern& pattern = wall.pattern;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(pattern.size[axis], made(PatternKind::Brick).size[axis], 0.35 * pattern.size[axis]);
            // Just within each face: joints of the other directions alone.
            Vec3d p{0.01, 0.01, 0.01};
            p[axis] = 1e-6;
            EXPECT_EQ(pattern.phaseAt(p), 0u) << axis;
            p[axis] = extent[axis] - 1e-6;
            if (axis == 0) p.z = 0.5 * pattern.size.z;
            EXPECT_EQ(pattern.phaseAt(p), 0u) << axis << ' ' << extent.x;
        }
    }
}

TEST(Pattern, EveryJointIsAsWideAsAVoxelWhereBricksAreWider) {
    PatternedObject wall{1, made(PatternKind::Brick), {}};
    wall.axes.extent = {3, 0.24, 2.5};
    fitPattern(wall, {0.02, 0.02, 0.02});
    EXPECT_EQ(wall.pattern.line, 0.02);
    // Samples along w meet each bed joint once.
    int joints = 0;
    for (double w = 0.0031; w < 2.5; w += 0.02) joints += wall.pattern.phaseAt({0.05, 0.01, w}) == 1 ? 1 : 0;
    EXPECT_NEAR(joints, std::lround(2.52 / wall.pattern.size.z) - 1, 1);
    PatternedObject coarse{1, made(PatternKind::Brick), {}};
    coarse.axes.extent = wall.axes.extent;
    fitPattern(coarse, {0.05, 0.05, 0.05});
    EXPECT_EQ(coarse.pattern.line, 0.012);
}

TEST(Pattern, AFittedSheetLiesWithinBricksOnBothSides) {
    PatternedObject sheet{1, made(PatternKind::Brick), {}};
    sheet.axes.extent = {3, 0, 2.5};
    fitPattern(sheet, {0.005, 0.005, 0.005});
    for (const double v : {-0.02, -1e-6, 1e-6, 0.02}) {
        const Vec3d local{0.01 - sheet.axes.origin.x, v - sheet.axes.origin.y, 0.01 - sheet.axes.origin.z};
        EXPECT_EQ(sheet.pattern.phaseAt(local), 0u) << v;
    }
}

TEST(Pattern, HatchLinesRunAtTheirAngle) {
    const Pattern pattern = made(PatternKind::Hatch, {1, 1, 0.2}, 0.05, 30);
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    for (double along = -3; along < 3; along += 0.1) {
        EXPECT_EQ(pattern.phaseAt({along * c - 0.025 * s, 0, along * s + 0.025 * c}), 1u) << along;
        EXPECT_EQ(pattern.phaseAt({along * c - 0.125 * s, 0, along * s + 0.125 * c}), 0u) << along;
    }
}

TEST(Pattern, SeedChangesGrains) {
    Pattern a = made(PatternKind::Concrete), b = a;
    b.seed = 2;
    int different = 0;
    for (int n = 0; n < 1000; ++n)
        different += a.phaseAt({n * 0.0137, n * 0.0071, n * 0.0093}) != b.phaseAt({n * 0.0137, n * 0.0071, n * 0.0093});
    EXPECT_GT(different, 50);
}

TEST(Pattern, ImageStandsUprightAndReachesThroughTheDepth) {
    Pattern pattern;
    pattern.kind = PatternKind::Image;
    auto texels = std::make_shared<PatternTexels>();
    texels->dimension = {2, 2, 1};
    texels->phaseCount = 4;
    texels->phases = {0, 1, 2, 3};  // lower left, lower right, upper left, upper right
    pattern.texels = texels;
    pattern.size = {2, 7, 2};
    for (const double v : {-3.0, 0.1, 5.0}) {
        EXPECT_EQ(pattern.phaseAt({0.5, v, 0.5}), 0u);
        EXPECT_EQ(pattern.phaseAt({1.5, v, 0.5}), 1u);
        EXPECT_EQ(pattern.phaseAt({0.5, v, 1.5}), 2u);
        EXPECT_EQ(pattern.phaseAt({1.5, v, 1.5}), 3u);
    }
}

TEST(MakePattern, MeasuresOutOfRangeAreNamed) {
    const auto refuse = [](Pattern pattern, const char* word) {
        const auto result = makePattern(pattern);
        ASSERT_FALSE(result) << word;
        EXPECT_EQ(result.error().code(), Code::BadPattern);
        EXPECT_NE(result.error().message().find(word), std::string::npos) << result.error().message();
    };
    Pattern pattern;
    pattern.kind = PatternKind::Brick;
    for (const double bad : {-0.1, 1e-5, 2e3, std::numeric_limits<double>::quiet_NaN()}) {
        Pattern size = pattern, line = pattern;
        size.size.y = bad;
        line.line = bad;
        refuse(size, "along v");
        refuse(line, "line");
    }
    Pattern angle = pattern;
    angle.angleDegrees = 361;
    refuse(angle, "angle");
    pattern.kind = PatternKind::Image;
    refuse(pattern, "needs a file");
    pattern.kind = PatternKind::Raw;
    refuse(pattern, "needs a file");
}

TEST(DominantFrame, RunsAlongTheLongestHorizontalEdges) {
    for (const double degrees : {0.0, 30.0, 89.9, 90.0, 135.0, 179.8}) {
        const auto mesh = test::turnedBox({2, 3, 1}, {12, 5, 4}, degrees);
        const ObjectAxes axes = dominantAxes(mesh);
        const double angle = degrees * std::numbers::pi / 180;
        const Vec3d expected{std::cos(angle), std::sin(angle), 0};
        EXPECT_NEAR(std::abs(dot(axes.directions[0], expected)), 1, 1e-9) << degrees;
        EXPECT_NEAR(dot(axes.directions[0], axes.directions[1]), 0, 1e-12);
        EXPECT_EQ(cross(axes.directions[0], axes.directions[1]).z > 0, true);
        EXPECT_EQ(axes.directions[2], (Vec3d{0, 0, 1}));
        // The lower corner of the envelope along these axes: all vertices lie within 10 x 2 x 3 m of it.
        for (const Vec3d& vertex : mesh.vertices) {
            const Vec3d d = vertex - axes.origin;
            const Vec3d uvw{dot(d, axes.directions[0]), dot(d, axes.directions[1]), dot(d, axes.directions[2])};
            EXPECT_GT(uvw.x, -1e-9);
            EXPECT_LT(uvw.x, 10 + 1e-9);
            EXPECT_GT(uvw.y, -1e-9);
            EXPECT_LT(uvw.y, 2 + 1e-9);
            EXPECT_GT(uvw.z, -1e-9);
            EXPECT_LT(uvw.z, 3 + 1e-9);
        }
    }
}

TEST(DominantFrame, WithoutHorizontalEdgesItIsTheWorlds) {
    mesh::ObjectMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 5}, {0, 1, 9}};
    test::addTriangle(mesh, 0, 1, 2);
    EXPECT_EQ(dominantAxes(mesh).directions[0], (Vec3d{1, 0, 0}));
    EXPECT_EQ(dominantAxes({}).origin, Vec3d{});
}

TEST(LayPatterns, OnlyTheObjectIsStencilledWithinItsRange) {
    const Vec3d origin{458877.1, 5438353.6, 11};
    const auto meshes =
        test::meshSetOf({test::turnedBox({0, 0, 0}, {5, 1, 3}, 20), test::box({6, 0, 0}, {8, 2, 2})}, origin);
    const Grid grid = *Grid::fromDimension({meshes.bounds.min + origin, meshes.bounds.max + origin}, {141, 71, 65});
    for (Pattern& pattern : allKinds()) {
        if (pattern.kind == PatternKind::None) continue;
        const std::uint32_t phases = pattern.phaseCount();
        const std::vector<ObjectClaim> claims{{3, 3, "wall"}, {3 + phases, 3, "block"}};
        const auto before = voxelize(meshes, grid, claims);
        ASSERT_TRUE(before);
        const PatternedObject object{3, pattern, dominantAxes(meshes.objects[0])};
        const auto after = layPatterns(before->columns, grid, origin, {object}, 1);
        std::uint64_t changed = 0;
        for (std::int32_t j = 0; j < 71; ++j)
            for (std::int32_t i = 0; i < 141; ++i)
                for (std::int32_t k = 0; k < 65; ++k) {
                    const volume::Scalar was = before->columns.scalarAt(i, j, k), is = after.scalarAt(i, j, k);
                    if (was != 3) {
                        ASSERT_EQ(is, was);
                        continue;
                    }
                    const Vec3d local =
                        grid.worldFromIndex({double(i), double(j), double(k)}) - origin - object.axes.origin;
                    const Vec3d uvw{dot(local, object.axes.directions[0]), dot(local, object.axes.directions[1]),
                                    dot(local, object.axes.directions[2])};
                    ASSERT_EQ(is, 3 + pattern.phaseAt(uvw));
                    changed += is != was;
                }
        EXPECT_GT(changed, 100u) << nameOf(pattern.kind);
        EXPECT_TRUE(after == layPatterns(before->columns, grid, origin, {object}, 4)) << nameOf(pattern.kind);
    }
}

TEST(LayPatterns, OnePhaseChangesNothing) {
    const auto columns = volume::ColumnVolume::fromDense({3, 3, 3}, std::vector<volume::Scalar>(27, 1));
    const Grid grid = *Grid::fromDimension({{0, 0, 0}, {1, 1, 1}}, {3, 3, 3});
    EXPECT_TRUE(layPatterns(columns, grid, {}, {{1, Pattern{}, {}}}, 1) == columns);
}

// Writes an RGB picture, rows from the top.
void writePng(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
              const std::vector<std::uint8_t>& rgb) {
    image::Image<image::Rgba8> image(static_cast<std::int32_t>(width), static_cast<std::int32_t>(height));
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        image.pixels()[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], 255};
    ASSERT_TRUE(image::writePng(path, image));
}

TEST(ReadPatternImage, ColoursArePhasesAndRowsRunBottomUp) {
    const TemporaryFolder folder;
    writePng(folder / "a.png", 2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
    const auto texels = readPatternImage(folder / "a.png");
    ASSERT_TRUE(texels) << texels.error().toString();
    EXPECT_EQ((*texels)->dimension, (Vec3i{2, 2, 1}));
    EXPECT_EQ((*texels)->phaseCount, 4u);
    ASSERT_EQ((*texels)->colors.size(), 4u);
    const Vec3f expected[4] = {{0, 0, 1}, {1, 1, 1}, {1, 0, 0}, {0, 1, 0}};
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ((*texels)->colors[(*texels)->phases[c]], expected[c]) << c;
}

TEST(ReadPatternImage, ColoursAreReducedToTheNumberAsked) {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> rgb;
    for (int n = 0; n < 64 * 64; ++n)
        for (const int channel : {n % 64 * 4, n / 64 * 4, 128}) rgb.push_back(static_cast<std::uint8_t>(channel));
    writePng(folder / "a.png", 64, 64, rgb);
    for (const int wanted : {2, 8, 64}) {
        const auto texels = readPatternImage(folder / "a.png", wanted);
        ASSERT_TRUE(texels);
        EXPECT_EQ((*texels)->phaseCount, std::uint32_t(wanted));
        EXPECT_EQ((*texels)->colors.size(), std::size_t(wanted));
        // The widest box is split, so no colour is far from its pixels: red and green span 252 steps.
        const double widest = 252 / std::floor(std::sqrt(double(wanted))) / 255;
        for (std::size_t n = 0; n < 64 * 64; ++n) {
            const Vec3f color = (*texels)->colors[(*texels)->phases[n]];
            ASSERT_LE(std::abs(color.x - rgb[3 * (n % 64 + 64 * (63 - n / 64))] / 255.0f), widest) << wanted;
            ASSERT_NEAR(color.z, 128 / 255.0f, 1e-6);
        }
    }
    EXPECT_EQ(readPatternImage(folder / "a.png", 1).error().code(), Code::BadArgument);
    EXPECT_EQ(readPatternImage(folder / "a.png", 65).error().code(), Code::BadArgument);
}

TEST(ReadPatternImage, BadFilesAreRefused) {
    const TemporaryFolder folder;
    EXPECT_EQ(readPatternImage(folder / "missing.png").error().code(), Code::CannotOpen);
    test::writeText(folder / "text.png", "this is no picture");
    EXPECT_EQ(readPatternImage(folder / "text.png").error().code(), Code::BadImage);
    std::vector<std::uint8_t> rgb(300 * 300 * 3);
    std::mt19937 random(1);
    for (std::uint8_t& byte : rgb) byte = static_cast<std::uint8_t>(random());
    writePng(folder / "whole.png", 300, 300, rgb);
    const std::string whole = test::readText(folder / "whole.png");
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{1}, std::size_t{8}, std::size_t{33}, whole.size() / 2, whole.size() - 100}) {
        test::writeText(folder / "cut.png", whole.substr(0, length));
        const auto texels = readPatternImage(folder / "cut.png");
        ASSERT_FALSE(texels) << length;
        EXPECT_TRUE(texels.error().code() == Code::BadImage || texels.error().code() == Code::CannotOpen)
            << texels.error().toString();
    }
    writePng(folder / "wide.png", 5000, 1, std::vector<std::uint8_t>(15000, 7));
    const auto wide = readPatternImage(folder / "wide.png");
    ASSERT_FALSE(wide);
    EXPECT_EQ(wide.error().code(), Code::BadImage);
    EXPECT_NE(wide.error().message().find("5000 x 1"), std::string::npos) << wide.error().message();
}

TEST(ReadPatternRaw, ValuesAreNumberedInAscendingOrder) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.raw", std::string("\x07\xFF\x07\x20\x20\x07", 6));
    const auto texels = readPatternRaw(folder / "a.raw", {3, 2, 1});
    ASSERT_TRUE(texels);
    EXPECT_EQ((*texels)->phaseCount, 3u);
    EXPECT_EQ((*texels)->phases, (std::vector<std::uint8_t>{0, 2, 0, 1, 1, 0}));
    EXPECT_TRUE((*texels)->colors.empty());
}

TEST(ReadPatternRaw, BadFilesAreRefused) {
    const TemporaryFolder folder;
    std::string values;
    for (int v = 0; v < 100; ++v) values.push_back(static_cast<char>(v));
    test::writeText(folder / "a.raw", values);
    const auto tooMany = readPatternRaw(folder / "a.raw", {10, 10, 1});
    ASSERT_FALSE(tooMany);
    EXPECT_EQ(tooMany.error().code(), Code::BadImage);
    EXPECT_NE(tooMany.error().message().find("100 different values"), std::string::npos) << tooMany.error().message();
    const auto wrongSize = readPatternRaw(folder / "a.raw", {10, 10, 2});
    ASSERT_FALSE(wrongSize);
    EXPECT_NE(wrongSize.error().message().find("= 200 expected"), std::string::npos) << wrongSize.error().message();
    for (const Vec3i bad : {Vec3i{0, 10, 10}, {10, 1025, 1}, {-1, 1, 1}})
        EXPECT_EQ(readPatternRaw(folder / "a.raw", bad).error().code(), Code::BadImage);
    EXPECT_EQ(readPatternRaw(folder / "missing.raw", {1, 1, 1}).error().code(), Code::CannotOpen);
}

}  // namespace
}  // namespace svt::voxelize
