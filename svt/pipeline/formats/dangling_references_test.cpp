/// No reference of a generated IFC house changes a body in silence where it is made to lead nowhere.

#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace svt::pipeline {
namespace {

constexpr std::size_t kTried = 120;  // of some ten thousand, evenly

using Points = std::vector<std::tuple<double, double, double>>;

// The corners of all faces of each feature.
std::map<std::string, Points> bodiesOf(const model::BuildingModel& model) {
    std::map<std::string, Points> bodies;
    for (const model::Feature& feature : model.features) {
        const auto add = [&](const std::vector<model::SurfaceUse>& uses) {
            for (const model::SurfaceUse& use : uses)
                for (const Vec3d p : model.polygons[use.polygon].points) bodies[feature.id].emplace_back(p.x, p.y, p.z);
        };
        for (const model::Geometry& geometry : feature.geometries) {
            add(geometry.surfaces);
            for (const model::Solid& solid : geometry.solids) add(solid.exterior);
        }
    }
    return bodies;
}

TEST(DanglingReferences, OfAGeneratedHouseChangeNoBodyInSilence) {
    const auto house = samples::writeSample(samples::SampleKind::House, samples::SampleFormat::Ifc4, {});
    ASSERT_TRUE(house);
    const auto read = [](const std::string& text, Diagnostics& log) {
        return readers::readModel(std::as_bytes(std::span(text)), "house.ifc", {}, &log);
    };
    Diagnostics none;
    const auto whole = read(*house, none);
    ASSERT_TRUE(whole);
    EXPECT_EQ(none.count(Code::DanglingReference), 0u);
    const auto bodies = bodiesOf(*whole);
    std::vector<std::size_t> references;
    for (std::size_t at = house->find("DATA;"); (at = house->find('#', at + 1)) != std::string::npos;)
        if ((*house)[at - 1] != '\n') references.push_back(at);
    ASSERT_GT(references.size(), 1000u);
    std::size_t changed = 0;
    for (std::size_t n = 0; n < kTried; ++n) {
        const std::size_t at = references[n * references.size() / kTried];
        std::string text = *house;
        text.replace(at, house->find_first_not_of("0123456789", at + 1) - at, "#99999999");
        Diagnostics log;
        const auto model = read(text, log);
        if (model && bodiesOf(*model) == bodies) continue;
        ++changed;
        EXPECT_TRUE(!model || log.count(Code::DanglingReference) == 1)
            << house->substr(house->rfind('\n', at) + 1, house->find('\n', at) - house->rfind('\n', at) - 1);
    }
    EXPECT_GT(changed, kTried / 4);
}

}  // namespace
}  // namespace svt::pipeline
