#include <svt/readers/model_joiner.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

namespace svt::readers {
namespace {

model::BuildingModel modelOf(const std::string& source, std::initializer_list<const char*> ids) {
    model::BuildingModel model;
    model.source = source;
    for (const char* id : ids) {
        model::Feature feature;
        feature.id = id;
        feature.className = "Building";
        model.roots.push_back(model.addFeature(std::move(feature), model::kNoFeature));
    }
    return model;
}

TEST(ModelJoiner, KeepsIdsApart) {
    Diagnostics log;
    ModelJoiner joiner(&log);
    joiner.add(modelOf("a", {"x", "y"}));
    joiner.add(modelOf("b", {"x", "z"}));
    joiner.add(modelOf("c", {"z", "x", "w"}));
    std::vector<std::string> ids;
    for (const model::Feature& feature : joiner.joined().features) ids.push_back(feature.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"x", "y", "x@2", "z", "z@3", "x@3", "w"}));
    EXPECT_EQ(log.count(Code::DuplicateId), 3u);
    EXPECT_EQ(joiner.count(), 3u);
}

TEST(ModelJoiner, PlacesNameTheFileOfEachFeature) {
    ModelJoiner joiner(nullptr);
    for (const char* name : {"first.gml", "second.gml", "third.gml"}) {
        model::BuildingModel model;
        model.source = name;
        model::Feature feature;
        feature.id = std::string("of ") + name;
        feature.line = 7;
        const auto root = model.addFeature(feature, model::kNoFeature);
        model.addFeature(feature, root);
        model.addPolygon({{}, {}, "polygon", -1});
        joiner.add(std::move(model));
    }
    model::BuildingModel& joined = joiner.joined();
    joined.addFeature({}, 2);  // made later, below a feature of the second file
    const auto fileOf = [&](model::FeatureIndex feature) { return joined.placeOf(feature).file; };
    EXPECT_EQ(fileOf(0), "first.gml");
    EXPECT_EQ(fileOf(1), "first.gml");
    EXPECT_EQ(fileOf(3), "second.gml");
    EXPECT_EQ(fileOf(5), "third.gml");
    EXPECT_EQ(fileOf(6), "second.gml");
    EXPECT_EQ(joined.placeOf(2).line, 7u);
    EXPECT_EQ(joined.placeOf(2).id, "of second.gml");
    EXPECT_EQ(joined.placeOfPolygon(0).file, "first.gml");
    EXPECT_EQ(joined.placeOfPolygon(2).file, "third.gml");
}

TEST(ModelJoiner, OneModelStaysAsItIs) {
    ModelJoiner joiner(nullptr);
    joiner.add(modelOf("a", {"x", "x"}));
    EXPECT_EQ(joiner.joined().features[1].id, "x") << "ids of one file are its reader's";
    EXPECT_EQ(joiner.joined().source, "a");
    EXPECT_EQ(joiner.lookups(), 0u);
}

// The ids of earlier files are collected once, not anew for each file.
TEST(ModelJoiner, LooksUpEachIdOnce) {
    ModelJoiner joiner(nullptr);
    for (int file = 0; file < 200; ++file) {
        const std::string a = fmt::format("a{}", file), b = fmt::format("b{}", file);
        joiner.add(modelOf("f", {a.c_str(), b.c_str()}));
    }
    EXPECT_EQ(joiner.joined().features.size(), 400u);
    EXPECT_EQ(joiner.lookups(), 400u);
}

}  // namespace
}  // namespace svt::readers
