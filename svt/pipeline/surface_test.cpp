/// Compares voxel surface areas with mesh surface areas, on individual real solids.

#include <svt/analyze/contacts.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::pipeline {
namespace {

// Surface area of one object voxelized alone, m2.
double surfaceByVoxels(const mesh::MeshSet& meshes, const mesh::ObjectMesh& object, double spacing) {
    mesh::MeshSet alone;
    alone.origin = meshes.origin;
    alone.planes = meshes.planes;
    alone.objects = {object};
    alone.bounds = object.bounds;
    BuildOptions options;
    options.spacing = Vec3d{spacing, spacing, spacing};
    const auto grid = chooseGrid(alone, options);
    volume::LabelTable table;
    table.labels.resize(1);
    table.labels[0].first = table.labels[0].count = 1;
    const voxelize::ObjectClaim claim{1, 0, "only"};
    const auto voxels = voxelize::voxelize(alone, *grid, std::span(&claim, 1));
    const auto contacts = analyze::findContacts(voxels->columns, *grid, table);
    return contacts.size() == 1 ? contacts[0].area : -1;
}

TEST(Surfaces, OfTheFzkHausAreThoseOfItsMeshes) {
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    const auto model = readers::readModel(file);
    ASSERT_TRUE(model);
    const auto meshes = mesh::buildMeshes(*model);
    ASSERT_TRUE(meshes);
    int checked = 0, near = 0;
    double mesh = 0, voxels = 0;
    for (const mesh::ObjectMesh& object : meshes->objects) {
        // Rafters, doors and windows are a few voxels thin; walls, slabs, roofs and rooms are not.
        if (object.volume < 1) continue;
        const double area = surfaceByVoxels(*meshes, object, 0.03);
        // The gables deviate most: 0.2 m thin, with slanted edges.
        EXPECT_NEAR(area, object.area, 0.07 * object.area) << model->features[object.feature].name;
        ++checked;
        near += std::abs(area - object.area) < 0.015 * object.area ? 1 : 0;
        mesh += object.area;
        voxels += area;
    }
    EXPECT_GE(checked, 20);
    EXPECT_GE(near, checked - 4);  // all but the walls of the upper floor, two of which are gables
    EXPECT_NEAR(voxels, mesh, 0.01 * mesh);
}

}  // namespace
}  // namespace svt::pipeline
