#include <bench/benches.hpp>
#include <bench/compare.hpp>
#include <bench/peers.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <fmt/format.h>

#include <numeric>
#include <utility>

namespace svt::bench {
namespace {

Json comparisonJson(const VoxelComparison& comparison) {
    return {{"filled_svt", comparison.filledOurs},
            {"filled_peer", comparison.filledTheirs},
            {"differing", comparison.differing},
            {"differing_on_border", comparison.differingOnBorder},
            {"differing_percent", comparison.differingPercent()}};
}

// Only the closed objects, since the peers can fill no others.
struct Solids {
    mesh::MeshSet meshes;
    std::vector<voxelize::ObjectClaim> claims;
    std::vector<std::uint16_t> scalars;
    std::vector<std::uint32_t> order;  // in increasing priority
};

Solids solidsOf(const Workload& workload) {
    Solids solids;
    solids.meshes.origin = workload.meshes.origin;
    solids.meshes.planes = workload.meshes.planes;
    solids.meshes.bounds = workload.meshes.bounds;
    for (std::size_t o = 0; o < workload.meshes.objects.size(); ++o) {
        if (!workload.meshes.objects[o].isSolid()) continue;
        solids.meshes.objects.push_back(workload.meshes.objects[o]);
        solids.claims.push_back(workload.labels.claims[o]);
        solids.scalars.push_back(static_cast<std::uint16_t>(workload.labels.claims[o].scalar));
    }
    solids.order = paintOrder(solids.meshes, solids.claims);
    return solids;
}

// How a peer performs one step, and remarks for the reader.
struct PeerRun {
    SolidPeer* peer = nullptr;
    SolidStep step = SolidStep::Inside;
    const char* what = "";
    const char* note = "";
};

Result<Row> voxelizeRow(const Workload& workload, const Solids& solids, Vec3i dimension, bool withOpenVdb,
                        const BenchOptions& options) {
    tell(fmt::format("voxelize {} {}", workload.name, sizeText(dimension)));
    const auto grid = gridOver(workload, dimension);
    if (!grid) return grid.error();

    const auto run = [&](int threads, bool keepThinParts) {
        voxelize::VoxelizeOptions voxelizeOptions;
        voxelizeOptions.threads = threads;
        voxelizeOptions.keepThinParts = keepThinParts;
        return voxelize::voxelize(solids.meshes, *grid, solids.claims, voxelizeOptions);
    };
    const auto ours = run(0, true);
    if (!ours) return ours.error();

    Row row;
    row.stage = "voxelize";
    row.input = workload.name;
    row.size = sizeText(dimension);
    const Peer<SolidPeer> vtk = makeVtkStencils(), openVdb = withOpenVdb ? makeOpenVdb() : Peer<SolidPeer>{};
    std::vector<PeerRun> peerRuns;
    for (const Peer<SolidPeer>* peer : {&vtk, &openVdb}) {
        if (peer->peer != nullptr)
            peer->peer->load(solids.meshes, *grid);
        else if (!peer->missing.empty())
            row.missing.push_back(peer->missing);
    }
    if (vtk.peer != nullptr) {
        peerRuns.push_back({vtk.peer.get(), SolidStep::Inside, "", "stencil per object; no image, no labels"});
        peerRuns.push_back(
            {vtk.peer.get(), SolidStep::Mask, " + images", "stencil and 8-bit image per object; no labels"});
        peerRuns.push_back(
            {vtk.peer.get(), SolidStep::Labels, " + labels", "stencils written into one dense 16-bit volume"});
    }
    if (openVdb.peer != nullptr)
        peerRuns.push_back(
            {openVdb.peer.get(), SolidStep::Inside, "", "signed distances per object, band of one voxel; no labels"});

    DenseLabels labels;
    std::vector<Contestant> contestants;
    contestants.push_back({"SVT", [&] { static_cast<void>(run(0, true).hasValue()); }});
    contestants.push_back({"SVT, one thread", [&] { static_cast<void>(run(1, true).hasValue()); }});
    for (const PeerRun& p : peerRuns)
        contestants.push_back({p.peer->name() + p.what, [&, p] {
                                   labels = {};
                                   p.peer->run(p.step, solids.order, solids.scalars, &labels);
                               }});
    const auto measured = measureInTurns(contestants, options.measure);
    // The peers use voxel centers and lose parts thinner than a voxel, so they are compared with the same rule.
    const auto centersOnly = run(0, false);
    if (!centersOnly) return centersOnly.error();
    row.ours = measured[0];
    row.resultBytes = ours->columns.sizeBytes();
    row.extra["objects"] = solids.meshes.objects.size();
    row.extra["triangles"] = solids.meshes.triangleCount();
    row.extra["thin_voxels"] = std::accumulate(ours->thinVoxels.begin(), ours->thinVoxels.end(), std::uint64_t{0});
    row.comparisons.push_back({measured[1], "the same work on one core", Json::object(), false});
    for (std::size_t p = 0; p < peerRuns.size(); ++p) {
        Comparison comparison{measured[p + 2], peerRuns[p].note, Json::object(), true};
        const bool isLastOfPeer = p + 1 == peerRuns.size() || peerRuns[p + 1].peer != peerRuns[p].peer;
        if (isLastOfPeer) {
            labels = {};
            peerRuns[p].peer->run(SolidStep::Labels, solids.order, solids.scalars, &labels);
            comparison.extra["agreement"] = comparisonJson(compareVoxels(centersOnly->columns, labels));
        }
        row.comparisons.push_back(std::move(comparison));
    }
    return row;
}

}  // namespace

Result<void> benchVoxelize(const Workload& workload, const BenchOptions& options, Report& report) {
    const Solids solids = solidsOf(workload);
    // OpenVDB computes distances, which takes seconds; one row is sufficient.
    const bool isHouse = workload.name == kHouse;
    std::vector<Vec3i> sizes{gridSize(options.isQuick)};
    if (isHouse && !options.isQuick) sizes.insert(sizes.begin(), kSmallGrid);
    for (const Vec3i dimension : sizes) {
        auto row = voxelizeRow(workload, solids, dimension, isHouse && dimension == kSmallGrid, options);
        if (!row) return row.error();
        report.rows.push_back(std::move(*row));
    }
    return {};
}

}  // namespace svt::bench
