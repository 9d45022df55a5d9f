#include <bench/benches.hpp>
#include <bench/drawable.hpp>
#include <bench/machine.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::bench {
namespace {

constexpr std::int32_t kWidth = 1280, kHeight = 720;

// Number of sample columns above or below a triangle, that is, whose line crosses it. A line through an edge may count
// for both neighbours; this is a unit of work, not a result.
std::uint64_t crossingsOf(const std::array<Vec3d, 3>& p, Vec3i n) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area == 0) return 0;
    const auto [least, most] = std::minmax({p[0].y, p[1].y, p[2].y});
    std::uint64_t count = 0;
    for (auto j = std::max(0, static_cast<int>(std::ceil(least))); j <= std::min(n.y - 1, static_cast<int>(most));
         ++j) {
        double from = 0, to = n.x - 1;
        for (std::size_t e = 0; e < 3; ++e) {  // inside each edge: a + b x >= 0
            const Vec3d s = p[e], d = p[(e + 1) % 3] - s;
            const double sign = area > 0 ? 1 : -1, a = sign * (d.x * (j - s.y) + d.y * s.x), b = -sign * d.y;
            if (b > 0) from = std::max(from, -a / b);
            if (b < 0) to = std::min(to, -a / b);
            if (b == 0 && a < 0) to = -1;
        }
        if (to >= from) count += static_cast<std::uint64_t>(std::max(0.0, std::floor(to) - std::ceil(from) + 1));
    }
    return count;
}

std::uint64_t crossingsOf(const mesh::MeshSet& meshes, const volume::Grid& grid) {
    std::uint64_t count = 0;
    for (const mesh::ObjectMesh& object : meshes.objects)
        for (const mesh::Triangle& triangle : object.triangles) {
            std::array<Vec3d, 3> corners;
            for (std::size_t c = 0; c < 3; ++c)
                corners[c] = grid.indexFromWorld(object.vertices[triangle.corners[c]] + meshes.origin);
            count += crossingsOf(corners, grid.dimension());
        }
    return count;
}

}  // namespace

Result<void> runProfilePiece(ProfilePiece piece, const Input& input) {
    SVT_TRY(workload, loadWorkload(input));
    SVT_TRY(drawable, makeDrawable(*workload, kGrid, 1));
    const bool isOpaque = piece != ProfilePiece::Translucent;
    SVT_TRY(spec,
            makeFrameSpec(drawable->grid,
                          isOpaque ? opaqueStyles(workload->labels.table) : translucentStyles(workload->labels.table),
                          kWidth, kHeight));
    if (piece == ProfilePiece::Count) {
        fmt::print("{}\n", Json{{"machine", describeMachine()},
                                {"input", input.name},
                                {"crossings", crossingsOf(workload->meshes, drawable->grid)},
                                {"rays", std::uint64_t{kWidth} * kHeight}}
                               .dump());
    } else if (piece == ProfilePiece::Voxelize) {
        voxelize::VoxelizeOptions options;
        options.threads = 1;
        SVT_TRY(volume, voxelize::voxelize(workload->meshes, drawable->grid, workload->labels.claims, options));
    } else if (piece != ProfilePiece::Prepare) {
        render::CastOptions options;
        options.threads = 1;
        SVT_TRY(frame, render::castRays(drawable->bricks, drawable->grid, *spec, options));
    }
    return {};
}

}  // namespace svt::bench
