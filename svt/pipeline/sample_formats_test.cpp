// One generated building in several formats: the same volumes and the same labels.
#include <svt/core/temporary_folder_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/samples/sample.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <variant>

namespace svt::pipeline {
namespace {

using samples::SampleFormat;
using samples::SampleKind;
using samples::SampleOptions;

// IFC has no boundary surfaces of rooms; those of the others, which are sheets of voxels, are taken out.
volume::SemanticVolume built(SampleKind kind, SampleFormat format, const SampleOptions& sample, const char* ending,
                             BuildOptions options, Diagnostics& log) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / (std::string("model") + ending);
    const auto text = samples::writeSample(kind, format, sample);
    EXPECT_TRUE(text);
    if (text) test::writeText(file, *text);
    auto model = readModels(std::span(&file, 1), {}, &log);
    EXPECT_TRUE(model) << model.error().toString();
    if (!model) return {};
    for (model::Feature& feature : model->features)
        if (feature.className.ends_with("Surface")) feature.geometries.clear();
    auto output = buildVolume(*model, options, &log);
    EXPECT_TRUE(output) << output.error().toString();
    return output ? std::move(output->volume) : volume::SemanticVolume{};
}

std::string textOf(const volume::Label& label, std::string_view name) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name) return toText(attribute.value);
    return {};
}

// The id that a component has in the other formats: IFC ids are GlobalIds, so it stands in the tag, or in the number of
// a room.
std::string sampleId(const volume::Label& label) {
    if (const std::string tag = textOf(label, "tag"); !tag.empty()) return tag;
    if (const std::string number = textOf(label, "number"); !number.empty()) return number;
    return label.id;
}

// Scalar of `a` -> scalar of `b` for the same component.
std::vector<volume::Scalar> matched(const volume::SemanticVolume& a, const volume::SemanticVolume& b) {
    std::map<std::string, volume::Scalar> ofB;
    for (const volume::Label& label : b.labels.labels)
        if (label.count > 0) ofB[sampleId(label)] = label.first;
    std::vector<volume::Scalar> scalars(a.labels.scalarCount(), 0);
    for (const volume::Label& label : a.labels.labels) {
        if (label.count == 0) continue;
        const auto found = ofB.find(sampleId(label));
        EXPECT_TRUE(found != ofB.end()) << sampleId(label) << " " << label.className;
        if (found != ofB.end()) scalars[label.first] = found->second;
    }
    return scalars;
}

// Voxels whose label is another one; both volumes lie on one grid.
std::size_t differences(const volume::SemanticVolume& a, const volume::SemanticVolume& b) {
    const std::vector<volume::Scalar> scalarInB = matched(a, b);
    const Vec3i size = a.columns.dimension();
    EXPECT_EQ(size, b.columns.dimension());
    std::size_t count = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                count += scalarInB[a.columns.scalarAt(i, j, k)] != b.columns.scalarAt(i, j, k) ? 1 : 0;
    {
    std::map<std::pair<std::string,std::string>,int> pairs; auto la=a.labels.labelOfScalar(), lb=b.labels.labelOfScalar();
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
               auto p=a.columns.scalarAt(i, j, k), q=b.columns.scalarAt(i,j,k);
               if (scalarInB[p]!=q) ++pairs[{p?sampleId(a.labels.labels[la[p]]):"-", q?sampleId(b.labels.labels[lb[q]])+b.labels.labels[lb[q]].className:"-"}];
            }
    for (auto& [p,n]: pairs) printf("%s %s %d\n",p.first.c_str(),p.second.c_str(),n);
    printf("======\n");
    }
    return count;
}

void expectVolumesAsDescribed(const volume::SemanticVolume& volume, SampleKind kind, const SampleOptions& sample) {
    std::map<std::string, double> described;
    const auto components = samples::describeSample(kind, sample);
    ASSERT_TRUE(components);
    for (const samples::SampleComponent& component : *components)
        if (!component.solids.empty()) described[component.id] = component.volume;
    std::set<std::string> found;
    for (const volume::Label& label : volume.labels.labels) {
        if (label.count == 0) continue;
        const std::string id = sampleId(label);
        ASSERT_TRUE(described.count(id) != 0) << id;
        found.insert(id);
        EXPECT_NEAR(label.volume, described[id], 2e-6 * std::max(1.0, described[id])) << id;
        EXPECT_NEAR(std::strtod(textOf(label, "BaseQuantities.NetVolume").c_str(), nullptr), described[id], 1e-8) << id;
    }
    EXPECT_EQ(found.size(), described.size());
}

BuildOptions coarse() {
    BuildOptions options;
    options.spacing = Vec3d{0.1, 0.1, 0.1};
    return options;
}

TEST(SampleFormats, TheHouseAsIfcHasTheDescribedVolumes) {
    Diagnostics log;
    const auto house = built(SampleKind::House, SampleFormat::Ifc4, {}, ".ifc", coarse(), log);
    expectVolumesAsDescribed(house, SampleKind::House, {});
    EXPECT_EQ(log.count(Severity::Warning), 0u);
}

TEST(SampleFormats, TheTowerAsIfcHasTheDescribedVolumes) {
    SampleOptions sample;
    sample.storeys = 3;
    Diagnostics log;
    const auto tower = built(SampleKind::Tower, SampleFormat::Ifc4, sample, ".ifc", coarse(), log);
    expectVolumesAsDescribed(tower, SampleKind::Tower, sample);
    EXPECT_EQ(log.count(Severity::Warning), 0u);
}

TEST(SampleFormats, TheHouseHasTheSameLabelsInThreeFormats) {
    for (const double turn : {0.0, 12.5}) {
        SampleOptions sample;
        sample.turnDegrees = turn;
        BuildOptions options = coarse();
        Diagnostics log;
        const auto ifc = built(SampleKind::House, SampleFormat::Ifc4, sample, ".ifc", options, log);
        options.grid = ifc.grid;
        const auto gml = built(SampleKind::House, SampleFormat::CityGml3, sample, ".gml", options, log);
        const auto json = built(SampleKind::House, SampleFormat::CityJson2, sample, ".city.json", options, log);
        const Vec3i size = ifc.columns.dimension();
        const double all = double(size.x) * size.y * size.z;
        const std::size_t toGml = differences(ifc, gml), toJson = differences(ifc, json),
                          between = differences(gml, json);
        RecordProperty(fmt::format("differ_at_{}_degrees", int(turn)),
                       fmt::format("{} {} {} of {}", toGml, toJson, between, all));
        // Turned coordinates are rounded to micrometres in the other formats, so that faces on samples may fall either way.
        EXPECT_LE(double(toGml), turn == 0 ? 0 : 1e-5 * all);
        EXPECT_LE(double(toJson), turn == 0 ? 0 : 1e-5 * all);
        EXPECT_LE(double(between), turn == 0 ? 0 : 1e-5 * all);
    }
}

TEST(SampleFormats, TheTowerHasTheSameLabelsInTwoFormats) {
    SampleOptions sample;
    sample.storeys = 2;
    BuildOptions options = coarse();
    Diagnostics log;
    const auto ifc = built(SampleKind::Tower, SampleFormat::Ifc4, sample, ".ifc", options, log);
    options.grid = ifc.grid;
    const auto json = built(SampleKind::Tower, SampleFormat::CityJson2, sample, ".city.json", options, log);
    EXPECT_EQ(differences(ifc, json), 0u);
}

}  // namespace
}  // namespace svt::pipeline
