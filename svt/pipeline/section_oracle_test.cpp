/// Section drawings against a second implementation: the intersection polygons of the plane and the triangle meshes.

#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/model/classes.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace svt::pipeline {
namespace {

/// Intersection of a plane with a closed mesh.
struct MeshSection {
    double area = 0;   ///< m2
    double bound = 0;  ///< m2; error bound from half a voxel's extent across each triangle in the plane
};

MeshSection cutMesh(const mesh::ObjectMesh& object, Vec3d meshOrigin, const drawing::PlaneAxes& axes,
                    const volume::Grid& grid) {
    MeshSection section;
    const auto heightOf = [&](std::uint32_t v) {
        return dot(object.vertices[v] + (meshOrigin - axes.origin), axes.normal);
    };
    for (const mesh::Triangle& triangle : object.triangles) {
        std::array<Vec3d, 2> ends;
        int count = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = triangle.corners[n], b = triangle.corners[(n + 1) % 3];
            const double ha = heightOf(a), hb = heightOf(b);
            if ((ha > 0) == (hb > 0)) continue;
            const Vec3d p = object.vertices[a] + (object.vertices[b] - object.vertices[a]) * (ha / (ha - hb));
            ends[ha > 0 ? 0 : 1] = p + (meshOrigin - axes.origin);
            ++count;
        }
        if (count != 2) continue;
        // Counter-clockwise seen from outside: the segment begins where the edge goes down, and the inside is to the
        // left.
        const double u0 = dot(ends[0], axes.u), v0 = dot(ends[0], axes.v);
        const double u1 = dot(ends[1], axes.u), v1 = dot(ends[1], axes.v);
        section.area += 0.5 * (u0 * v1 - v0 * u1);
        const Vec3d normal =
            normalized(cross(object.vertices[triangle.corners[1]] - object.vertices[triangle.corners[0]],
                             object.vertices[triangle.corners[2]] - object.vertices[triangle.corners[0]]));
        double half = 0;
        for (int axis = 0; axis < 3; ++axis)
            half += 0.5 * grid.spacing()[axis] * std::abs(dot(normal, grid.axes()[static_cast<std::size_t>(axis)]));
        const double sine = std::sqrt(std::max(1e-6, 1 - std::pow(dot(normal, axes.normal), 2)));
        section.bound += std::hypot(u1 - u0, v1 - v0) * half / sine;
    }
    section.area = std::abs(section.area);
    return section;
}

struct Tally {
    int compared = 0;
    double area = 0, error = 0, bound = 0;
};

/// Compares all solids that lose no voxels to others; sums up their areas.
Tally compare(model::BuildingModel& model, const BuildOptions& options,
              const std::vector<drawing::SectionPlane>& planes) {
    Tally tally;
    model::BuildingModel copy = model;
    const auto meshes = mesh::buildMeshes(copy);
    const auto built = buildVolume(model, options);
    EXPECT_TRUE(meshes && built);
    if (!meshes || !built) return tally;
    const volume::SemanticVolume& volume = built->volume;
    std::set<std::uint32_t> losers;
    for (const volume::Overlap& overlap : volume.labels.overlaps) losers.insert(overlap.b);
    const bool hasSheets = !std::ranges::all_of(meshes->objects, &mesh::ObjectMesh::isSolid);
    const auto bricks = *volume::BrickVolume::fromColumns(volume.columns);
    for (const drawing::SectionPlane& relative : planes) {
        const Vec3d corner = meshes->bounds.min + meshes->origin;
        const drawing::SectionPlane plane{normalized(relative.normal), corner + relative.point};
        const auto drawing = drawing::drawSection(volume, bricks, plane);
        EXPECT_TRUE(drawing);
        if (!drawing) return tally;
        for (const mesh::ObjectMesh& object : meshes->objects) {
            if (!object.isSolid() || object.isAssembled) continue;
            const std::string& id = copy.features[object.feature].id;
            const auto label =
                std::ranges::find(volume.labels.labels, id, &volume::Label::id) - volume.labels.labels.begin();
            const auto number = static_cast<std::uint32_t>(label);
            EXPECT_LT(number, volume.labels.labels.size());
            // Sheets take their voxels from the rooms that they bound.
            if (hasSheets && model::isSpace(volume.labels.labels[number].className)) continue;
            // Parts thinner than a voxel are drawn one voxel thick.
            if (losers.contains(number) || volume.labels.labels[number].thinVoxels != 0) continue;
            const MeshSection exact = cutMesh(object, meshes->origin, drawing->axes, volume.grid);
            const auto found = std::ranges::find(drawing->components, number, &drawing::SectionComponent::label);
            const double area = found == drawing->components.end() ? 0 : found->area;
            if (exact.area == 0 && area == 0) continue;
            // Drawn outlines are slightly longer, and simplified within a hundredth of a voxel.
            const double drawnBound = found == drawing->components.end() ? 0 : found->areaBound;
            const double bound = exact.bound + 0.05 * drawnBound;
            const double error = std::abs(area - exact.area);
            EXPECT_LE(error, bound) << id << " by " << relative.normal.x << " " << relative.normal.y << " "
                                    << relative.normal.z << ": " << area << " drawn, " << exact.area << " by its mesh";
            ++tally.compared;
            tally.area += exact.area;
            tally.error += error;
            tally.bound += exact.bound;
        }
    }
    return tally;
}

const std::vector<drawing::SectionPlane> kPlanes{
    {{0, 0, 1}, {0, 0, 1.33}},      {{0, 0, 1}, {0, 0, 3.71}},       {{0, 0, 1}, {0, 0, 4.6}},
    {{1, 0, 0}, {3.97, 0, 0}},      {{0, -1, 0}, {0, 4.23, 0}},      {{0.6, 0.8, 0}, {5, 5, 0}},
    {{0.5, 0.6, 0.4}, {6, 5, 2.7}}, {{-0.2, 0.5, 0.9}, {6, 5, 2.6}}, {{0.7, -0.1, -0.3}, {6, 5, 2.1}}};

TEST(SectionOracle, FzkHausAgreesWithItsMeshes) {
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
    ASSERT_TRUE(model);
    BuildOptions options;
    options.dimension = Vec3i{400, 350, 200};
    const Tally tally = compare(*model, options, kPlanes);
    EXPECT_GT(tally.compared, 100);
    EXPECT_GT(tally.area, 200);
    // Most surfaces are represented by planes: far more accurate than half a voxel.
    EXPECT_LT(tally.error, 0.5 * tally.bound);
    RecordProperty("compared", tally.compared);
    RecordProperty("area", std::to_string(tally.area));
    RecordProperty("error", std::to_string(tally.error));
    RecordProperty("bound", std::to_string(tally.bound));
}

TEST(SectionOracle, SampleHouseAgreesWithItsMeshes) {
    const auto text = samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, {});
    ASSERT_TRUE(text);
    auto model = readers::readModel(std::as_bytes(std::span(*text)), "house.gml");
    ASSERT_TRUE(model);
    BuildOptions options;
    options.spacing = Vec3d{0.04, 0.04, 0.04};
    std::vector<drawing::SectionPlane> planes = kPlanes;
    planes[3].point.x = 4.07;  // 3.97 lies between a face of a beam and the nearest samples
    const Tally tally = compare(*model, options, planes);
    EXPECT_GT(tally.compared, 60);
    EXPECT_LT(tally.error, 0.5 * tally.bound);
}

}  // namespace
}  // namespace svt::pipeline
