// The generated house at places of the world in degrees and feet: the same building comes out as from metres.
#include <svt/core/temporary_folder_test.hpp>
#include <svt/crs/projection.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/samples/sample.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace svt::pipeline {
namespace {

// x and y in the source of a projection of a point in metres: Newton's method.
Vec3d sourceOf(const crs::Projection& projection, Vec3d metres, Vec3d guess, double step) {
    for (int i = 0; i < 5; ++i) {
        Vec3d points[3] = {guess, guess + Vec3d{step, 0, 0}, guess + Vec3d{0, step, 0}};
        projection.apply(points);
        const Vec3d wanted = metres - points[0], alongX = points[1] - points[0], alongY = points[2] - points[0];
        const double det = alongX.x * alongY.y - alongX.y * alongY.x;
        guess.x += step * (wanted.x * alongY.y - wanted.y * alongY.x) / det;
        guess.y += step * (alongX.x * wanted.y - alongX.y * wanted.x) / det;
    }
    return {guess.x, guess.y, metres.z};
}

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

// The document with the numbers of all its posLists taken through `change`.
template <class Change>
std::string withPoints(const std::string& gml, Change&& change) {
    constexpr std::string_view kBegin = "<gml:posList>", kEnd = "</gml:posList>";
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = gml.find(kBegin); at != std::string::npos; at = gml.find(kBegin, done)) {
        at += kBegin.size();
        result.append(gml, done, at - done);
        done = gml.find(kEnd, at);
        const char* text = gml.c_str() + at;
        while (text < gml.c_str() + done) {
            char* next = nullptr;
            const double x = std::strtod(text, &next), y = std::strtod(next, &next), z = std::strtod(next, &next);
            const Vec3d point = change(Vec3d{x, y, z});
            result += fmt::format("{:.13f} {:.13f} {:.9f} ", point.x, point.y, point.z);
            text = next;
            while (*text == ' ' || *text == '\n') ++text;
        }
    }
    return result + gml.substr(done);
}

struct World {
    const char* name;
    std::string crsName;  // as the file names it
    int source, metres;   // codes
    Vec3d origin;         // of the house, in metres
    Vec3d guess;          // somewhere near, x: east
    bool isNorthFirst;
    double heightUnit;
};

void PrintTo(const World& world, std::ostream* out) { *out << world.name; }

class Coordinates : public ::testing::TestWithParam<World> {};

volume::SemanticVolume built(const std::string& gml, Diagnostics& log) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "house.gml";
    test::writeText(file, gml);
    BuildOptions options;
    options.spacing = Vec3d{0.1, 0.1, 0.1};
    auto output = buildVolume(std::span(&file, 1), options, &log);
    EXPECT_TRUE(output) << output.error().toString();
    return output ? std::move(output->volume) : volume::SemanticVolume{};
}

struct Amount {
    double cubicMetres = 0, voxels = 0;
};

// Of all objects of a class; of all objects for an empty name.
Amount amountOf(const volume::SemanticVolume& volume, std::string_view className) {
    Amount amount;
    for (const volume::Label& label : volume.labels.labels) {
        if (!className.empty() && label.className != className) continue;
        amount.cubicMetres += label.volume;
        amount.voxels += static_cast<double>(label.voxels);
    }
    return amount;
}

TEST_P(Coordinates, AHouseHasTheVolumesAndThePlaceThatItHasInMetres) {
    const World& world = GetParam();
    samples::SampleOptions sample;
    sample.origin = world.origin;
    auto house = samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, sample);
    ASSERT_TRUE(house);
    const std::string own = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837";
    ASSERT_NE(house->find(own), std::string::npos);
    const std::string metric = replacedAll(*house, own, fmt::format("EPSG:{}", world.metres));
    const auto projection = crs::Projection::between(world.source, world.metres, world.guess);
    ASSERT_TRUE(projection) << projection.error().toString();
    const double step = std::abs(world.guess.x) > 360 ? 100 : 1e-3;
    const std::string foreign = withPoints(replacedAll(*house, own, world.crsName), [&](Vec3d point) {
        Vec3d source = sourceOf(*projection, point, world.guess, step);
        if (world.isNorthFirst) std::swap(source.x, source.y);
        source.z /= world.heightUnit;
        return source;
    });

    Diagnostics log, metricLog;
    const volume::SemanticVolume expected = built(metric, metricLog), found = built(foreign, log);
    EXPECT_EQ(found.crsName, fmt::format("EPSG:{} (from EPSG:{})", world.metres, world.source));
    EXPECT_EQ(log.count(Severity::Warning), metricLog.count(Severity::Warning));
    EXPECT_NEAR(length(found.grid.origin() - expected.grid.origin()), 0, 1e-3);
    ASSERT_EQ(found.labels.labels.size(), expected.labels.labels.size());
    for (const char* const className :
         {"BuildingRoom", "BuildingConstructiveElement", "Window", "Door", "BuildingFurniture"}) {
        const double expectedVolume = amountOf(expected, className).cubicMetres;
        EXPECT_GT(expectedVolume, 0) << className;
        EXPECT_NEAR(amountOf(found, className).cubicMetres, expectedVolume, 0.001 * expectedVolume) << className;
    }
    // Samples that lie on a face of the house within a micrometre may change sides.
    const Amount all = amountOf(expected, "");
    EXPECT_NEAR(amountOf(found, "").voxels, all.voxels, 0.001 * all.voxels);
}

INSTANTIATE_TEST_SUITE_P(
    World, Coordinates,
    ::testing::Values(
        World{"Tokyo",
              "http://www.opengis.net/def/crs/EPSG/0/6697",
              6697,
              6677,
              {-5995, -35367, 3},
              {139.767, 35.681, 0},
              true,
              1},
        World{"Munich", "EPSG:4326", 4326, 32632, {691603, 5334780, 520}, {11.5755, 48.1374, 0}, false, 1},
        World{"NewYork", "EPSG:2263", 2263, 32118, {299041, 59601, 10}, {981106, 195544, 0}, false, 1200.0 / 3937}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace svt::pipeline
