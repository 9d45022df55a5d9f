/// Pictures against a ray tracer on the model's triangles. The bounds are the figures of today, a little rounded up: a
/// change may only lower them. docs/dev/pictures.md has the table of more models.

#include <gtest/gtest.h>

#ifdef SVT_EMBREE

#include "picture_errors.hpp"

#include <svt/mesh/models_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <cstddef>
#include <iostream>
#include <span>
#include <string>

namespace svt::test {
namespace {

struct Bounds {
    double outline, label, normal;  ///< percent
    double depth50, depth95;        ///< metres
};

model::BuildingModel sampleModel(samples::SampleFormat format, bool isThematic = false) {
    samples::SampleOptions options;
    options.thematic = isThematic;
    const bool isIfc = format == samples::SampleFormat::Ifc4;
    const auto text = samples::writeSample(samples::SampleKind::House, format, options);
    EXPECT_TRUE(text);
    auto model = readers::readModel(std::as_bytes(std::span(*text)), isIfc ? "house.ifc" : "house.gml");
    EXPECT_TRUE(model);
    return std::move(*model);
}

PictureErrors sumOf(const model::BuildingModel& model, double spacing, bool isExact = false) {
    PictureOptions options;
    options.spacing = spacing;
    options.isExact = isExact;
    options.width = 320;
    options.height = 200;
    const auto all = measurePictures(model, options);
    EXPECT_TRUE(all);
    PictureErrors sum;
    if (!all) return sum;
    EXPECT_EQ(all->size(), 8u);
    for (const PictureErrors& errors : *all) {
        EXPECT_GT(errors.pixels, 1000u) << errors.camera;
        sum.add(errors);
    }
    return sum;
}

void expectWithin(const PictureErrors& errors, const Bounds& bounds) {
    EXPECT_LE(errors.percent(errors.outline), bounds.outline);
    EXPECT_LE(errors.percent(errors.label), bounds.label);
    EXPECT_LE(errors.percent(errors.normal), bounds.normal);
    EXPECT_LE(errors.depthAt(0.5), bounds.depth50);
    EXPECT_LE(errors.depthAt(0.95), bounds.depth95);
    EXPECT_LE(errors.percent(errors.undecided), 0.01);
    std::cout << "outline " << errors.percent(errors.outline) << " %, label " << errors.percent(errors.label)
              << " %, normal " << errors.percent(errors.normal) << " %, depth " << errors.depthAt(0.5) << " and "
              << errors.depthAt(0.95) << " m\n";
}

TEST(PictureOracle, FindsNoErrorWhereAllFacesLieBetweenVoxels) {
    model::BuildingModel model;
    const Vec3d corner{500000, 5400000, 100};
    const auto addBox = [&](const char* className, const char* id, Vec3d low, Vec3d high) {
        addBoxFeature(model, className, id, corner + low, corner + high);
    };
    addBox("BuildingConstructiveElement", "slab", {0, 0, 0}, {6, 5, 0.3});
    addBox("BuildingConstructiveElement", "wall", {0, 0, 0.3}, {6, 0.4, 3});
    addBox("BuildingFurniture", "cupboard", {1, 0.2, 0.3}, {2.2, 1, 2.1});  // partly in the wall, of higher priority
    addBox("BuildingRoom", "room", {0, 0.4, 0.3}, {6, 5, 3});
    PictureOptions options;
    options.spacing = 0.1;
    const auto all = measurePictures(model, options);
    ASSERT_TRUE(all);
    for (const PictureErrors& errors : *all) {
        EXPECT_GT(errors.pixels, 1000u) << errors.camera;
        for (const std::size_t count : {errors.outline, errors.label, errors.normal})
            EXPECT_LE(errors.percent(count), 0.02) << errors.camera;
        EXPECT_LE(errors.percent(errors.undecided), 0.2) << errors.camera;  // rays through edges of triangles
        EXPECT_LT(errors.depthAt(0.95), 1e-4) << errors.camera;
    }
}

TEST(PictureOracle, SampleHouseStaysAsNearToItsTriangles) {
    const model::BuildingModel model = sampleModel(samples::SampleFormat::CityGml3);
    // Shares of the pixels that show the model in the picture or by its triangles: a line in the air adds to them.
    expectWithin(sumOf(model, 0.1), {0.67, 5.17, 35.7, 0.009, 0.128});
    expectWithin(sumOf(model, 0.05), {0.07, 2.03, 9.25, 0.0001, 0.0401});
}

TEST(PictureOracle, ExactSurfacesAreThoseOfTheTrianglesAtEachSpacing) {
    for (const samples::SampleFormat format : {samples::SampleFormat::CityGml3, samples::SampleFormat::Ifc4}) {
        const model::BuildingModel model = sampleModel(format);
        for (const double spacing : {0.2, 0.05})
            expectWithin(sumOf(model, spacing, true), {0.002, 0.002, 0.005, 1e-5, 1e-5});
    }
}

TEST(PictureOracle, ExactSurfacesOfThematicBodiesDifferOnlyInTheirMaterial) {
    // Where a section cuts material, the voxel tells to which of two surfaces it belongs.
    const model::BuildingModel model = sampleModel(samples::SampleFormat::CityGml2, true);
    expectWithin(sumOf(model, 0.2, true), {0.002, 0.45, 0.005, 1e-5, 1e-5});
    expectWithin(sumOf(model, 0.05, true), {0.002, 0.12, 0.005, 1e-5, 1e-5});
}

TEST(PictureOracle, SurfacesOfTheSampleHouseStayAsNearToTheirTriangles) {
    const model::BuildingModel model = sampleModel(samples::SampleFormat::CityGml2, true);
    expectWithin(sumOf(model, 0.05), {0.19, 5.73, 27.3, 0.0025, 0.0454});
}

}  // namespace
}  // namespace svt::test

#else

TEST(PictureOracle, SampleHouseStaysAsNearToItsTriangles) {
    GTEST_SKIP() << "Embree was not installed when CMake ran (scripts/setup.sh readers)";
}

#endif
