// Generated cities: the same bytes again, closed shells but for the broken ones, the distributions that are promised.
#include <svt/samples/city/city_building.hpp>
#include <svt/samples/city_sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace svt::samples {
namespace {

std::string textOf(const CitySampleOptions& options, int file, CitySampleCount* count = nullptr) {
    std::string text;
    const auto written = writeCitySample(options, file, [&](std::string_view part) {
        text += part;
        return true;
    });
    EXPECT_TRUE(written) << written.error().toString();
    if (count != nullptr) *count = *written;
    return text;
}

std::size_t countOf(const std::string& text, std::string_view word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

// Edges of a body that are not used as often forwards as backwards.
std::size_t openEdges(const city::Body& body) {
    std::map<std::pair<city::Point, city::Point>, int> uses;
    const auto add = [&](const city::Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const city::Point a = ring[i], b = ring[(i + 1) % ring.size()];
            a < b ? ++uses[{a, b}] : --uses[{b, a}];
        }
    };
    for (const city::Face& face : body.faces)
        for (const city::Ring& ring : face.rings) add(ring);
    return static_cast<std::size_t>(
        std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 0; }));
}

// Six times the volume, by the divergence theorem; whole numbers as double, exact enough for the sign.
double volumeOf(const city::Body& body) {
    double volume = 0;
    const city::Point origin = body.faces.front().rings.front().front();
    for (const city::Face& face : body.faces) {
        const city::Ring& exterior = face.rings.front();
        for (std::size_t i = 1; i + 1 < exterior.size(); ++i) {
            const Vec3d a = toDouble(exterior[0] - origin), b = toDouble(exterior[i] - origin),
                        c = toDouble(exterior[i + 1] - origin);
            volume += dot(a, cross(b, c));
        }
    }
    return volume;
}

TEST(CitySample, IsClosedButForWhatIsBroken) {
    const CitySampleOptions options{CityProfile::Berlin, 5000, 1, 4};
    const city::Layout layout = city::Layout::of(options);
    std::size_t broken = 0, rooms = 0, windows = 0;
    std::vector<double> vertices;
    for (std::uint64_t n = 0; n < options.buildings; ++n) {
        const auto block = static_cast<std::int64_t>(n) / city::Layout::kLots;
        const city::Building building = makeBuilding(options, layout, block % layout.columns, block / layout.columns,
                                                     static_cast<std::int64_t>(n) % city::Layout::kLots);
        ASSERT_EQ(building.number, n);
        vertices.push_back(double(vertexCount(building)));
        broken += building.isBroken ? 1 : 0;
        for (const city::Body& body : building.bodies) {
            rooms += body.isRoom ? 1 : 0;
            for (const city::Face& face : body.faces) windows += face.kind == city::FaceKind::Window ? 1 : 0;
            if (building.isBroken && &body == &building.bodies.front()) {
                EXPECT_GT(openEdges(body), 0u) << n;
            } else {
                EXPECT_EQ(openEdges(body), 0u) << n;
                EXPECT_GT(volumeOf(body), 0) << n;
            }
        }
    }
    EXPECT_GE(broken, 1u);
    EXPECT_LE(broken, 15u);
    EXPECT_GT(rooms, 10u);
    EXPECT_GT(windows, 100u);
    std::sort(vertices.begin(), vertices.end());
    EXPECT_NEAR(vertices[vertices.size() / 2], 20, 8);
    EXPECT_GT(vertices.back(), 300);
}

TEST(CitySample, WritesTheSameBytesAgainAndOthersForAnotherSeed) {
    for (const auto profile : {CityProfile::Dutch, CityProfile::Berlin, CityProfile::NewYork, CityProfile::Plateau}) {
        const CitySampleOptions options{profile, 200, 3, 5};
        const std::string second = textOf(options, 1);
        EXPECT_EQ(textOf(options, 1), second);
        EXPECT_NE(textOf({profile, 200, 3, 6}, 1), second);
    }
}

// All buildings are there, and those of the border have the same text in both files.
TEST(CitySample, RepeatsBuildingsOfTheBorder) {
    const CitySampleOptions options{CityProfile::Dutch, 500, 4, 2};
    std::map<std::string, std::string> lines;
    std::uint64_t replicas = 0, buildings = 0;
    for (int file = 0; file < 4; ++file) {
        CitySampleCount count;
        const std::string text = textOf(options, file, &count);
        replicas += count.replicas;
        buildings += count.buildings;
        std::size_t at = text.find('\n') + 1;
        while (at < text.size()) {
            const std::size_t end = text.find('\n', at);
            const std::string line = text.substr(at, end - at), id = line.substr(0, line.find("CityObjects"));
            const auto [entry, isNew] = lines.emplace(id, line);
            EXPECT_EQ(entry->second, line);
            at = end + 1;
        }
    }
    EXPECT_EQ(lines.size(), 500u);
    EXPECT_EQ(buildings, 500u + replicas);
    EXPECT_GT(replicas, 5u);
}

TEST(CitySample, HasTheVersionsAndMissingValuesOfItsProfile) {
    const CitySampleOptions newYork{CityProfile::NewYork, 2000, 2, 1};
    EXPECT_NE(textOf(newYork, 0).find("citygml/1.0"), std::string::npos);
    EXPECT_NE(textOf(newYork, 1).find("citygml/2.0"), std::string::npos);
    EXPECT_EQ(countOf(textOf(newYork, 0), "lod2Solid"), 0u);
    const std::string plateau = textOf({CityProfile::Plateau, 2000, 1, 1}, 0);
    EXPECT_GT(countOf(plateau, ">-9999<"), 2u);
    EXPECT_GT(countOf(plateau, ">9999<"), 2u);
    EXPECT_GT(countOf(plateau, "lod1Solid>"), 200u);
    EXPECT_EQ(countOf(plateau, "</core:cityObjectMember>"), 2000u);
}

TEST(CitySample, RefusesWhatIsOutOfRange) {
    const SampleSink sink = [](std::string_view) { return true; };
    for (const CitySampleOptions& options :
         {CitySampleOptions{CityProfile::Berlin, 0, 1, 1}, CitySampleOptions{CityProfile::Berlin, 10, 0, 1},
          CitySampleOptions{CityProfile::Berlin, 10, 2, 1}, CitySampleOptions{CityProfile::Berlin, 100'000'001, 1, 1}})
        EXPECT_EQ(writeCitySample(options, 0, sink).error().code(), Code::BadArgument);
    EXPECT_EQ(writeCitySample({}, 1, sink).error().code(), Code::BadArgument);
    EXPECT_EQ(writeCitySample({}, 0, [](std::string_view) { return false; }).error().code(), Code::CannotWrite);
}

}  // namespace
}  // namespace svt::samples
