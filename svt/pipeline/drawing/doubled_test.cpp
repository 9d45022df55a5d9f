/// A house with a copy of each closed solid: the overlaps pair each solid with its copy, and their common volume is the whole
/// volume. Solids thinner than a voxel share no voxel with their copies. Only their meshes show the overlap.

#include <svt/analyze/solid_overlaps.hpp>
#include <svt/model/phases.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::pipeline {
namespace {

constexpr std::string_view kCopy = "-copy";

bool isCopy(const std::string& id) { return id.ends_with(kCopy); }

model::BuildingModel readHouse(samples::SampleFormat format) {
    const auto text = samples::writeSample(samples::SampleKind::House, format, {});
    EXPECT_TRUE(text);
    if (!text) return {};
    auto model = readers::readModel(std::as_bytes(std::span(*text)),
                                    format == samples::SampleFormat::Ifc4 ? "house.ifc" : "house.gml");
    EXPECT_TRUE(model);
    return model ? std::move(*model) : model::BuildingModel{};
}

// Adds a copy of each feature that has solids, with faces of its own.
void doubleSolids(model::BuildingModel& model) {
    const auto ownFaces = [&](std::vector<model::SurfaceUse>& shell) {
        for (model::SurfaceUse& use : shell) {
            model::Polygon face = model.polygons[use.polygon];
            face.id.clear();
            use.polygon = model.addPolygon(std::move(face));
        }
    };
    for (model::FeatureIndex f = 0, count = static_cast<model::FeatureIndex>(model.features.size()); f < count; ++f) {
        model::Feature copy;
        copy.className = model.features[f].className;
        copy.id = model.features[f].id + std::string(kCopy);
        for (const model::Geometry& geometry : model.features[f].geometries)
            if (geometry.kind == model::GeometryKind::Solid) copy.geometries.push_back(geometry);
        if (copy.geometries.empty()) continue;
        for (model::Geometry& geometry : copy.geometries) {
            geometry.id.clear();
            for (model::Solid& solid : geometry.solids) {
                solid.id.clear();
                ownFaces(solid.exterior);
                for (auto& shell : solid.interiors) ownFaces(shell);
            }
        }
        model.addFeature(std::move(copy), model.features[f].parent);
    }
}

volume::SemanticVolume buildDoubled(samples::SampleFormat format) {
    model::BuildingModel model = readHouse(format);
    model::splitPhases(model);  // so that panes have copies, too
    doubleSolids(model);
    BuildOptions options;
    options.spacing = Vec3d{0.2, 0.2, 0.2};
    options.vectors.meshes = true;
    auto built = buildVolume(model, options);
    EXPECT_TRUE(built);
    return built ? std::move(built->volume) : volume::SemanticVolume{};
}

void expectEachWithItsCopy(samples::SampleFormat format, std::size_t leastSolids) {
    const volume::SemanticVolume volume = buildDoubled(format);
    const auto& labels = volume.labels.labels;
    std::set<std::string> missing;
    for (const volume::Label& label : labels)
        if (label.filling != volume::Filling::None && label.filling != volume::Filling::Surface && !isCopy(label.id))
            missing.insert(label.id);
    EXPECT_GE(missing.size(), leastSolids);
    const analyze::SolidOverlaps overlaps = analyze::solidOverlaps(volume);
    EXPECT_TRUE(overlaps.isComplete);
    EXPECT_EQ(overlaps.withoutMesh, 0u);
    std::size_t betweenSamples = 0;
    for (const analyze::SolidOverlap& overlap : overlaps.pairs) {
        const volume::Label &a = labels[overlap.a], &b = labels[overlap.b];
        if (a.id + std::string(kCopy) != b.id && b.id + std::string(kCopy) != a.id) continue;
        EXPECT_FALSE(isCopy(a.id)) << "of two alike, the first id has the space";
        EXPECT_EQ(missing.erase(a.id), 1u) << a.id;
        EXPECT_TRUE(overlap.isExact) << a.id;
        EXPECT_NEAR(overlap.volume, a.volume, overlap.bound + 1e-9 * a.volume) << a.id;
        EXPECT_LT(overlap.bound, 1e-3 + 1e-3 * a.volume) << a.id;
        EXPECT_FALSE(overlap.isNested) << a.id;
        betweenSamples += overlap.voxels == 0 ? 1 : 0;
    }
    for (const std::string& id : missing) ADD_FAILURE() << id << " has a copy that is not found";
    EXPECT_GT(betweenSamples, 10u) << "at this spacing some have no voxel that both claim";
}

TEST(DoubledSolids, OfCityGmlAreFoundWithTheirWholeVolume) {
    expectEachWithItsCopy(samples::SampleFormat::CityGml3, 141);
}

TEST(DoubledSolids, OfIfcAreFoundWithTheirWholeVolume) { expectEachWithItsCopy(samples::SampleFormat::Ifc4, 141); }

}  // namespace
}  // namespace svt::pipeline
