// Glass from file to volume: panes are phases of their windows, whatever the size of the voxels.
#include <svt/core/temporary_folder_test.hpp>
#include <svt/model/phases.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace svt::pipeline {
namespace {

volume::SemanticVolume volumeOf(std::string_view text, const char* name, double spacing) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / name;
    test::writeText(file, std::string(text));
    BuildOptions options;
    options.spacing = Vec3d{spacing, spacing, spacing};
    auto output = buildVolume(std::span(&file, 1), options);
    EXPECT_TRUE(output) << output.error().toString();
    return output ? std::move(output->volume) : volume::SemanticVolume{};
}

std::string valueOf(const volume::Label& label, std::string_view name) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name) return toText(attribute.value);
    return "-";
}

const volume::Label* labelWith(const volume::SemanticVolume& volume, std::string_view className) {
    for (const volume::Label& label : volume.labels.labels)
        if (label.className == className) return &label;
    return nullptr;
}

// Ring of a box of solids with 12 numbers per face; vertices are 8 corners.
std::string cityJsonOfWindow(double thickness) {
    const std::string t = std::to_string(static_cast<int>(std::lround(thickness * 1000)));
    // Two bars of a frame, and a pane between them, one metre wide and high.
    std::string vertices;
    const auto box = [&](const std::string& x0, const std::string& x1, const std::string& y1) {
        for (const char* z : {"0", "1000"})
            for (const auto& [x, y] : {std::pair{x0, std::string("0")}, {x1, std::string("0")}, {x1, y1}, {x0, y1}})
                vertices += (vertices.empty() ? "[" : ",[") + x + "," + y + "," + z + "]";
    };
    box("0", "100", "80");
    box("100", "1100", t);
    box("1100", "1200", "80");
    std::string solids, values;
    for (int s = 0; s < 3; ++s) {
        const auto face = [&](int a, int b, int c, int d) {
            std::string ring = "[[";
            for (const int i : {a, b, c, d}) ring += std::to_string(8 * s + i) + (i == d ? "" : ",");
            return ring + "]]";
        };
        solids += std::string(s == 0 ? "" : ",") + "[[" + face(0, 3, 2, 1) + "," + face(4, 5, 6, 7) + "," +
                  face(0, 1, 5, 4) + "," + face(1, 2, 6, 5) + "," + face(2, 3, 7, 6) + "," + face(3, 0, 4, 7) + "]]";
        values += std::string(s == 0 ? "" : ",") + (s == 1 ? "[[1,1,1,1,1,1]]" : "[[0,0,0,0,0,0]]");
    }
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[0,0,0]},
"extensions":{"Openings":{"url":"https://example.org/o.json","version":"1.0"}},
"appearance":{"default-theme-material":"m","materials":[
{"name":"oak","diffuseColor":[0.6,0.4,0.2]},{"name":"clear","diffuseColor":[0.2,0.6,0.8],"transparency":0.5}]},
"CityObjects":{"b":{"type":"Building","children":["w"]},"w":{"type":"+Window","parents":["b"],
"geometry":[{"type":"MultiSolid","lod":"3","boundaries":[)" +
           solids + R"(],"material":{"m":{"values":[)" + values + "]}}}]}},\"vertices\":[" + vertices + "]}";
}

TEST(Glass, APaneThinnerThanAVoxelIsNeitherLostNorCountedThicker) {
    for (const double spacing : {0.05, 0.021}) {
        const volume::SemanticVolume volume = volumeOf(cityJsonOfWindow(0.007), "w.city.json", spacing);
        const volume::Label* pane = labelWith(volume, "WindowPhase");
        const volume::Label* window = labelWith(volume, "Window");
        ASSERT_TRUE(pane != nullptr && window != nullptr);
        EXPECT_EQ(valueOf(*pane, "phase"), "glass");
        EXPECT_EQ(valueOf(*window, "phase"), "oak");
        EXPECT_EQ(pane->color, (Vec3f{0.2f, 0.6f, 0.8f}));
        EXPECT_EQ(window->color, (Vec3f{0.6f, 0.4f, 0.2f}));
        EXPECT_NEAR(pane->volume, 0.007, 1e-9);
        EXPECT_NEAR(window->volume, 2 * 0.1 * 0.08, 1e-9);
        // One voxel thick, over one square metre.
        const double side = 1 / spacing;
        EXPECT_GE(double(pane->voxels), std::pow(std::floor(side), 2));
        EXPECT_LE(double(pane->voxels), std::pow(std::ceil(side), 2));
        // As much light passes as the file states.
        EXPECT_LT(pane->opacity, 1);
        EXPECT_EQ(window->opacity, 1);
        EXPECT_NEAR(std::pow(1 - double(pane->opacity), spacing), 0.5, spacing < 0.04 ? 0.3 : 0.02);
        // The window and its pane are one range of scalars.
        EXPECT_EQ(pane->first, window->first + window->count);
    }
}

TEST(Glass, WindowsOfTheGeneratedHouseHavePanesInAllFormats) {
    using samples::SampleFormat;
    for (const auto& [format, name] :
         {std::pair{SampleFormat::Ifc4, "house.ifc"}, std::pair{SampleFormat::CityGml3, "house.gml"},
          std::pair{SampleFormat::CityJson2, "house.city.json"}}) {
        const auto text = samples::writeSample(samples::SampleKind::House, format, {});
        ASSERT_TRUE(text);
        const volume::SemanticVolume volume = volumeOf(*text, name, 0.1);
        std::size_t windows = 0, panes = 0;
        for (const volume::Label& label : volume.labels.labels) {
            if (label.className == "Window" && label.filling == volume::Filling::Solid) ++windows;
            if (label.className != "WindowPhase") continue;
            ++panes;
            EXPECT_EQ(valueOf(label, "phase"), "glass") << name;
            EXPECT_EQ(valueOf(label, "transparency"), "0.6") << name;
            EXPECT_LT(label.opacity, 1) << name;
            EXPECT_GT(label.voxels, 0u) << name;
        }
        EXPECT_GT(windows, 5u) << name;
        EXPECT_EQ(panes, windows) << name;
    }
}

TEST(Glass, AStyleThatSetsTheOpacityReplacesTheTransparency) {
    const auto sheet = parseStyleSheet(R"({"rules":[{"select":"phase=glass","opacity":1,"color":"red"}]})", {});
    ASSERT_TRUE(sheet);
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "w.city.json";
    test::writeText(file, cityJsonOfWindow(0.02));
    BuildOptions options;
    options.spacing = Vec3d{0.05, 0.05, 0.05};
    options.style = &*sheet;
    const auto output = buildVolume(std::span(&file, 1), options);
    ASSERT_TRUE(output) << output.error().toString();
    const volume::Label* pane = labelWith(output->volume, "WindowPhase");
    ASSERT_NE(pane, nullptr);
    EXPECT_EQ(pane->opacity, 1);
    EXPECT_EQ(pane->color, (Vec3f{1, 0, 0}));
    EXPECT_EQ(valueOf(*pane, "transparency"), "-");
}

}  // namespace
}  // namespace svt::pipeline
