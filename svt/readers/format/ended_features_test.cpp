#include <svt/readers/format/ended_features.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace svt::readers {
namespace {

model::FeatureIndex add(model::BuildingModel& model, std::string id, model::FeatureIndex parent,
                        std::vector<Attribute> attributes = {}) {
    model::Feature feature;
    feature.id = std::move(id);
    feature.className = "Building";
    feature.attributes = std::move(attributes);
    return model.addFeature(std::move(feature), parent);
}

// A building that stays, one that ended in 2015 with a part, one that ends in the year 2999, one of the years 2010 on.
model::BuildingModel buildings() {
    model::BuildingModel model;
    model.source = "town.gml";
    add(model, "stays", model::kNoFeature);
    const auto old = add(model, "old", model::kNoFeature, {{"terminationDate", std::string("2015-06-01"), {}}});
    add(model, "old part", old);
    add(model, "temporary", model::kNoFeature, {{"validTo", std::string("2999-12-31T00:00:00Z"), {}}});
    const auto young = add(model, "young", model::kNoFeature, {{"validFrom", std::string("2010-01-01"), {}}});
    add(model, "young part", young, {{"terminationDate", std::string("2012-01-01"), {}}});
    model.memberships = {{0, old, "a"}, {0, young, "b"}};
    model.lines = {{old, {{0, 0, 0}}}, {young, {{1, 1, 1}}}};
    return model;
}

std::string idsOf(const model::BuildingModel& model) {
    std::string ids;
    for (const model::Feature& feature : model.features) ids += feature.id + ";";
    return ids;
}

TEST(EndedFeatures, AreLeftOutAndNamed) {
    model::BuildingModel model = buildings();
    Diagnostics diagnostics;
    EXPECT_EQ(removeEnded(model, "", &diagnostics), 2u);
    EXPECT_EQ(idsOf(model), "stays;temporary;young;");
    EXPECT_EQ(model.roots, (std::vector<model::FeatureIndex>{0, 1, 2}));
    EXPECT_TRUE(model.features[2].children.empty());
    ASSERT_EQ(model.memberships.size(), 1u);
    EXPECT_EQ(model.memberships[0], (model::Membership{0, 2, "b"}));
    ASSERT_EQ(model.lines.size(), 1u);
    EXPECT_EQ(model.lines[0].feature, 2u);
    ASSERT_EQ(diagnostics.count(Code::FeatureEnded), 1u);
    const std::string message = diagnostics.items()[0].message;
    EXPECT_NE(message.find("Building 'old' (ended 2015-06-01)"), std::string::npos) << message;
    EXPECT_NE(message.find("--date"), std::string::npos);
}

TEST(EndedFeatures, TheDateChooses) {
    const std::pair<std::string, std::string> cases[] = {
        {"all", "stays;old;old part;temporary;young;young part;"},
        {"2009-12-31", "stays;old;old part;temporary;"},
        {"2011-01-01", "stays;old;old part;temporary;young;young part;"},
        {"2015-05-31", "stays;old;old part;temporary;young;"},
        {"2015-06-01", "stays;temporary;young;"},
        {"3000-01-01", "stays;young;"},
    };
    for (const auto& [date, ids] : cases) {
        model::BuildingModel model = buildings();
        removeEnded(model, date, nullptr);
        EXPECT_EQ(idsOf(model), ids) << date;
    }
    for (const std::string_view text : {"2015-06-01", "0001-12-31"}) EXPECT_TRUE(isDay(text)) << text;
    for (const std::string_view text : {"", "2015", "2015-6-1", "2015-13-01", "2015-00-01", "2015-01-32", "2015/01/01"})
        EXPECT_FALSE(isDay(text)) << text;
}

// CityGML 3.0: two versions of a building. The dates are those of the file.
TEST(EndedFeatures, VersionsOfCityGmlAreReadByDate) {
    const auto version = [](int number, const std::string& dates, double height) {
        return fmt::format("<core:cityObjectMember><bldg:Building gml:id=\"b_v{}\">{}", number, dates) +
               "<core:lod1Solid><gml:Solid><gml:exterior><gml:Shell><gml:surfaceMember><gml:Polygon><gml:exterior>"
               "<gml:LinearRing><gml:posList>" +
               fmt::format("0 0 0 8 0 0 8 8 {} 0 0 0", height) +
               "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:Shell>"
               "</gml:exterior></gml:Solid></core:lod1Solid></bldg:Building></core:cityObjectMember>";
    };
    const std::string text =
        "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/3.0\" "
        "xmlns:bldg=\"http://www.opengis.net/citygml/building/3.0\" xmlns:gml=\"http://www.opengis.net/gml/3.2\">" +
        version(1,
                "<core:creationDate>2010-01-01T00:00:00</core:creationDate>"
                "<core:terminationDate>2018-03-01T00:00:00</core:terminationDate>",
                5) +
        version(2, "<core:creationDate>2018-03-01T00:00:00</core:creationDate>", 9) + "</core:CityModel>";
    const std::pair<std::string, std::string> cases[] = {{"", "b_v2;"}, {"2017-01-01", "b_v1;"}, {"all", "b_v1;b_v2;"}};
    for (const auto& [date, ids] : cases) {
        ReadOptions options;
        options.date = date;
        Diagnostics diagnostics;
        const auto model =
            readModel(std::as_bytes(std::span(text.data(), text.size())), "town.gml", options, &diagnostics);
        ASSERT_TRUE(model) << model.error().toString();
        EXPECT_EQ(idsOf(*model), ids) << date;
        EXPECT_EQ(diagnostics.count(Code::FeatureEnded), date == "all" ? 0u : 1u);
    }
}

}  // namespace
}  // namespace svt::readers
