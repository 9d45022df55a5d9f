/// Sections of volumes that keep no meshes against those that do: how far areas are off where only voxels and the planes of
/// the model's faces are left. exact_section_test.cpp compares the latter with the triangles.

#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/drawing/section_planes_test.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

namespace svt::pipeline {
namespace {

struct AreaErrors {
    std::vector<double> relative;  // of components at least two voxels thick, ascending
    std::size_t planes = 0;

    [[nodiscard]] double at(double part) const {
        return relative.empty() ? 0 : relative[static_cast<std::size_t>(part * double(relative.size() - 1))];
    }
};

double lengthOf(const drawing::Ring& ring) {
    double sum = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const auto a = ring[n], b = ring[(n + 1) % ring.size()];
        sum += std::hypot(b.u - a.u, b.v - a.v);
    }
    return sum;
}

// A strip of width w has twice its area over its border; so this is about the width of the narrowest part.
double thicknessOf(const drawing::SectionComponent& component) {
    double border = 0;
    for (const drawing::SectionPolygon& polygon : component.polygons) {
        border += lengthOf(polygon.outer);
        for (const drawing::Ring& hole : polygon.holes) border += lengthOf(hole);
    }
    return 2 * component.area / border;
}

AreaErrors compareWithMeshes(model::BuildingModel model, const std::string& name, Vec3d spacing) {
    AreaErrors errors;
    BuildOptions options;
    options.vectors.meshes = true;
    options.spacing = spacing;
    const auto built = buildVolume(model, options);
    EXPECT_TRUE(built);
    if (!built) return errors;
    const volume::SemanticVolume& volume = built->volume;
    const auto bricks = volume::BrickVolume::fromColumns(volume.columns, {.planes = volume.planes});
    for (const drawing::SectionPlane& plane : test::axisPlanesThrough(volume.grid)) {
        drawing::SectionOptions byVoxels;
        byVoxels.useMeshes = false;
        const auto exact = drawing::drawSection(volume, plane);
        const auto drawn = drawing::drawSection(volume, *bricks, plane, byVoxels);
        EXPECT_TRUE(exact && drawn);
        if (!exact || !drawn) continue;
        ++errors.planes;
        std::map<std::uint32_t, double> areas;
        for (const drawing::SectionComponent& component : drawn->components) areas[component.label] = component.area;
        for (const drawing::SectionComponent& component : exact->components)
            if (component.isExact && component.area > 0 && thicknessOf(component) >= 2 * spacing.x) {
                errors.relative.push_back(std::abs(areas[component.label] - component.area) / component.area);
                if (std::getenv("SVT_TELL") != nullptr && errors.relative.back() > 0.02)
                    std::printf("  %s plane %zu %s %s: %.4f m2, drawn %.4f, %.3f thick\n", name.c_str(), errors.planes,
                                volume.labels.labels[component.label].id.c_str(),
                                volume.labels.labels[component.label].className.c_str(), component.area,
                                areas[component.label], thicknessOf(component));
            }
    }
    std::sort(errors.relative.begin(), errors.relative.end());
    // The row of docs/dev/drawings.md.
    std::printf("| %s | %.3g | %zu | %zu | %.2f | %.2f | %.2f |\n", name.c_str(), spacing.x, errors.planes,
                errors.relative.size(), 100 * errors.at(0.5), 100 * errors.at(0.95), 100 * errors.at(1));
    return errors;
}

void expectNear(const AreaErrors& errors, double worst = 0.05) {
    ASSERT_GT(errors.relative.size(), 20u);
    EXPECT_LE(errors.at(0.5), 0.01);
    EXPECT_LE(errors.at(0.95), worst);
}

TEST(VoxelSection, OfFilesIsNearTheirMeshes) {
    for (const char* const file : {"fzk_haus_citygml3.gml", "fzk_haus.ifc", "largebuilding.ifc"}) {
        SVT_NEEDS_DATA(path, file);
        const auto model = readers::readModels(std::span(&path, 1), {}, nullptr);
        ASSERT_TRUE(model);
        expectNear(compareWithMeshes(*model, file, {0.05, 0.05, 0.05}));
    }
}

TEST(VoxelSection, OfTheHouseIsNearItsMeshesAlsoWhereItIsTurned) {
    for (const double turn : {0.0, 30.0}) {
        samples::SampleOptions sample;
        sample.turnDegrees = turn;
        const auto text = samples::writeSample(samples::SampleKind::House, samples::SampleFormat::Ifc4, sample);
        ASSERT_TRUE(text);
        auto model = readers::readModel(std::as_bytes(std::span(*text)), "house.ifc");
        ASSERT_TRUE(model);
        // Thin walls at an angle fall into bricks with too many planes.
        expectNear(compareWithMeshes(*model, turn == 0 ? "house" : "house, turned", {0.05, 0.05, 0.05}),
                   turn == 0 ? 0.05 : 0.08);
    }
}

// Any further files, separated by colons: see scripts/check_sections.sh.
TEST(VoxelSection, OfFurtherFiles) {
    const char* const files = std::getenv("SVT_SECTION_FILES");
    if (files == nullptr) GTEST_SKIP() << "SVT_SECTION_FILES names no files";
    std::stringstream list(files);
    for (std::string name; std::getline(list, name, ':');) {
        const std::filesystem::path file = name;
        const auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
        ASSERT_TRUE(model) << name;
        (void)compareWithMeshes(*model, file.filename().string(), {0.05, 0.05, 0.05});
    }
}

}  // namespace
}  // namespace svt::pipeline
