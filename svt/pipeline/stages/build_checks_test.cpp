/// Findings on the bounds of a built volume.

#include <svt/pipeline/stages/build_checks.hpp>

#include <gtest/gtest.h>

namespace svt::pipeline {
namespace {

// Before, each object had a note of its own.
TEST(BuildChecks, LostFacesOfManyObjectsAreOneNote) {
    model::BuildingModel model;
    mesh::MeshSet meshes;
    voxelize::VoxelizeResult voxels;
    for (std::uint32_t n = 0; n < 5; ++n) {
        model.features.emplace_back().id = "shell" + std::to_string(n);
        meshes.objects.emplace_back().feature = n;
        voxels.lostFaces.push_back({n, n == 0 ? 0.004 : 0.1 * n});
    }
    Diagnostics log;
    reportBounds(model, meshes, voxels, log);
    ASSERT_EQ(log.items().size(), 1u);
    const Diagnostic& note = log.items().front();
    EXPECT_EQ(note.code, Code::WindingFilled);
    EXPECT_NE(note.message.find("of 5 objects: 'shell0' (0.4 %), 'shell1' (10 %), 'shell2' (20 %) and 2 others"),
              std::string::npos)
        << note.message;
}

}  // namespace
}  // namespace svt::pipeline
