#include <bench/benches.hpp>
#include <bench/compare.hpp>
#include <bench/peers.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <fmt/format.h>

#include <numeric>
#include <utility>

namespace svt::bench {
namespace {

std::string agreement(const VoxelComparison& comparison) {
    return fmt::format("{} of {} filled voxels differ ({:.4f} %)", comparison.differing, comparison.filledOurs,
                       comparison.differingPercent());
}

Json comparisonJson(const VoxelComparison& comparison) {
    return {{"filled_svt", comparison.filledOurs},
            {"filled_peer", comparison.filledTheirs},
            {"differing", comparison.differing},
            {"differing_percent", comparison.differingPercent()}};
}

// How a peer does one step, and what the reader must know of it.
struct PeerRun {
    SolidPeer* peer = nullptr;
    SolidStep step = SolidStep::Inside;
    const char* what = "";
    const char* note = "";
};

Result<Row> voxelizeRow(const Scene& scene, Vec3i dimension, const BenchOptions& options) {
    tell(fmt::format("voxelize {} {}", scene.name, sizeText(dimension)));
    const auto grid = gridOver(scene, dimension);
    if (!grid) return grid.error();
    const std::vector<std::uint32_t> order = paintOrder(scene);
    std::vector<std::uint16_t> scalars;
    for (const voxelize::ObjectClaim& claim : scene.labels.claims) scalars.push_back(static_cast<std::uint16_t>(claim.scalar));

    const auto run = [&](int threads) {
        voxelize::VoxelizeOptions voxelizeOptions;
        voxelizeOptions.threads = threads;
        return voxelize::voxelize(scene.meshes, *grid, scene.labels.claims, voxelizeOptions);
    };
    const auto ours = run(0);
    if (!ours) return ours.error();

    Row row;
    row.stage = "voxelize";
    row.input = scene.name;
    row.size = sizeText(dimension);
    const Peer<SolidPeer> vtk = makeVtkStencils(), openVdb = makeOpenVdb();
    std::vector<PeerRun> peerRuns;
    for (const Peer<SolidPeer>* peer : {&vtk, &openVdb}) {
        if (peer->peer == nullptr)
            row.missing.push_back(peer->missing);
        else
            peer->peer->load(scene.meshes, *grid);
    }
    if (vtk.peer != nullptr) {
        peerRuns.push_back({vtk.peer.get(), SolidStep::Inside, "", "stencil per object; no image, no labels"});
        peerRuns.push_back({vtk.peer.get(), SolidStep::Mask, " + images", "stencil and 8-bit image per object; no labels"});
        peerRuns.push_back({vtk.peer.get(), SolidStep::Labels, " + labels", "stencils written into one dense 16-bit volume"});
    }
    if (openVdb.peer != nullptr)
        peerRuns.push_back({openVdb.peer.get(), SolidStep::Inside, "", "signed distances per object, band of one voxel; no labels"});

    DenseLabels labels;
    std::vector<Contestant> contestants;
    contestants.push_back({"SVT", [&] { static_cast<void>(run(0).hasValue()); }});
    contestants.push_back({"SVT, one thread", [&] { static_cast<void>(run(1).hasValue()); }});
    for (const PeerRun& p : peerRuns)
        contestants.push_back({p.peer->name() + p.what, [&, p] {
                                   labels = {};
                                   p.peer->run(p.step, order, scalars, &labels);
                               }});
    const auto measured = measureInTurns(contestants, options.measure);
    row.ours = measured[0];
    row.resultBytes = ours->columns.sizeBytes();
    row.extra["objects"] = scene.meshes.objects.size();
    row.extra["triangles"] = scene.meshes.triangleCount();
    row.extra["thin_voxels"] = std::accumulate(ours->thinVoxels.begin(), ours->thinVoxels.end(), std::uint64_t{0});
    row.beside.push_back({measured[1], "the same work on one core", Json::object(), false});
    for (std::size_t p = 0; p < peerRuns.size(); ++p) {
        Beside beside{measured[p + 2], peerRuns[p].note, Json::object(), true};
        const bool isLastOfPeer = p + 1 == peerRuns.size() || peerRuns[p + 1].peer != peerRuns[p].peer;
        if (isLastOfPeer) {
            labels = {};
            peerRuns[p].peer->run(SolidStep::Labels, order, scalars, &labels);
            const VoxelComparison comparison = compareVoxels(ours->columns, labels);
            beside.note += "; " + agreement(comparison);
            beside.extra["agreement"] = comparisonJson(comparison);
        }
        row.beside.push_back(std::move(beside));
    }
    return row;
}

}  // namespace

Result<void> benchVoxelize(const Scene& scene, const BenchOptions& options, Report& report) {
    for (const Vec3i dimension : gridSizes(options.isQuick)) {
        auto row = voxelizeRow(scene, dimension, options);
        if (!row) return row.error();
        report.rows.push_back(std::move(*row));
    }
    return {};
}

}  // namespace svt::bench
