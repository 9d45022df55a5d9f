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

// The peers that are there, loaded with the solids.
struct Peers {
    Peer<SolidPeer> vtk, openVdb;
    std::vector<PeerRun> runs;  // those of one peer side by side
};

Peers loadPeers(const Solids& solids, const volume::Grid& grid, bool withOpenVdb, Row& row) {
    Peers peers{makeVtkStencils(), withOpenVdb ? makeOpenVdb() : Peer<SolidPeer>{}, {}};
    for (const Peer<SolidPeer>* peer : {&peers.vtk, &peers.openVdb}) {
        if (peer->peer != nullptr)
            peer->peer->load(solids.meshes, grid);
        else if (!peer->missing.empty())
            row.missing.push_back(peer->missing);
    }
    if (SolidPeer* vtk = peers.vtk.peer.get(); vtk != nullptr) {
        peers.runs.push_back({vtk, SolidStep::Inside, "", "stencil per object; no image, no labels"});
        peers.runs.push_back({vtk, SolidStep::Mask, " + images", "stencil and 8-bit image per object; no labels"});
        peers.runs.push_back({vtk, SolidStep::Labels, " + labels", "stencils written into one dense 16-bit volume"});
    }
    if (SolidPeer* openVdb = peers.openVdb.peer.get(); openVdb != nullptr)
        peers.runs.push_back(
            {openVdb, SolidStep::Inside, "", "signed distances per object, band of one voxel; no labels"});
    return peers;
}

Result<voxelize::VoxelizeResult> runOurs(const Solids& solids, const volume::Grid& grid, int threads,
                                         bool keepThinParts) {
    voxelize::VoxelizeOptions options;
    options.threads = threads;
    options.keepThinParts = keepThinParts;
    return voxelize::voxelize(solids.meshes, grid, solids.claims, options);
}

Result<Row> voxelizeRow(const Workload& workload, const Solids& solids, Vec3i dimension, bool withOpenVdb,
                        const BenchOptions& options) {
    tell(fmt::format("voxelize {} {}", workload.name, sizeText(dimension)));
    SVT_TRY(grid, gridOver(workload, dimension));
    SVT_TRY(ours, runOurs(solids, *grid, 0, true));

    Row row;
    row.stage = "voxelize";
    row.input = workload.name;
    row.size = sizeText(dimension);
    const Peers peers = loadPeers(solids, *grid, withOpenVdb, row);
    DenseLabels labels;
    std::vector<Contestant> contestants;
    contestants.push_back({"SVT", [&] { static_cast<void>(runOurs(solids, *grid, 0, true).hasValue()); }});
    contestants.push_back({"SVT, one thread", [&] { static_cast<void>(runOurs(solids, *grid, 1, true).hasValue()); }});
    for (const PeerRun& p : peers.runs)
        contestants.push_back({p.peer->name() + p.what, [&, p] {
                                   labels = {};
                                   p.peer->run(p.step, solids.order, solids.scalars, &labels);
                               }});
    const auto measured = measureInTurns(contestants, options.measure);
    // The peers use voxel centers and lose parts thinner than a voxel, so they are compared with the same rule.
    SVT_TRY(centersOnly, runOurs(solids, *grid, 0, false));
    row.ours = measured[0];
    row.resultBytes = ours->columns.sizeBytes();
    row.extra["objects"] = solids.meshes.objects.size();
    row.extra["triangles"] = solids.meshes.triangleCount();
    row.extra["thin_voxels"] = std::accumulate(ours->thinVoxels.begin(), ours->thinVoxels.end(), std::uint64_t{0});
    row.comparisons.push_back({measured[1], "the same work on one core", Json::object(), false});
    for (std::size_t p = 0; p < peers.runs.size(); ++p) {
        const PeerRun& run = peers.runs[p];
        Comparison comparison{measured[p + 2], run.note, Json::object(), true};
        const bool isLastOfPeer = p + 1 == peers.runs.size() || peers.runs[p + 1].peer != run.peer;
        if (isLastOfPeer) {
            labels = {};
            run.peer->run(SolidStep::Labels, solids.order, solids.scalars, &labels);
            comparison.extra["agreement"] = comparisonJson(compareVoxels(centersOnly->columns, labels));
        }
        row.comparisons.push_back(std::move(comparison));
    }
    return row;
}

// The solids as open shells: each without one triangle, in the middle of its list.
Solids openedSolids(const Solids& solids) {
    Solids opened = solids;
    for (mesh::ObjectMesh& object : opened.meshes.objects) {
        const std::size_t removed = object.triangles.size() / 2;
        const auto corners = object.triangles[removed].corners;
        object.triangles.erase(object.triangles.begin() + static_cast<std::ptrdiff_t>(removed));
        for (std::size_t c = 0; c < 3; ++c) object.openEdges.push_back({corners[(c + 1) % 3], corners[c]});
        object.closingMethod = mesh::ClosingMethod::Open;
    }
    return opened;
}

// How many times as long open shells take as the same shells closed.
Result<Row> openShellsRow(const Workload& workload, const Solids& solids, Vec3i dimension,
                          const BenchOptions& options) {
    tell(fmt::format("voxelize {}, opened, {}", workload.name, sizeText(dimension)));
    SVT_TRY(grid, gridOver(workload, dimension));
    const Solids opened = openedSolids(solids);
    // Parts thinner than a voxel are kept for closed solids alone.
    SVT_DO(runOurs(opened, *grid, 0, false));
    const auto measured =
        measureInTurns({{"SVT", [&] { static_cast<void>(runOurs(opened, *grid, 0, false).hasValue()); }},
                        {"SVT, closed", [&] { static_cast<void>(runOurs(solids, *grid, 0, false).hasValue()); }}},
                       options.measure);
    Row row;
    row.stage = "voxelize";
    row.input = workload.name + ", opened";
    row.size = sizeText(dimension);
    row.ours = measured[0];
    row.extra["objects"] = opened.meshes.objects.size();
    row.extra["times_closed"] = measured[0].median / measured[1].median;
    row.comparisons.push_back({measured[1], "the same solids, closed", Json::object(), false});
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
        SVT_TRY(row, voxelizeRow(workload, solids, dimension, isHouse && dimension == kSmallGrid, options));
        report.rows.push_back(std::move(*row));
    }
    if (!isHouse) return {};
    for (const Vec3i dimension : {Vec3i{300, 300, 200}, Vec3i{800, 700, 400}}) {
        SVT_TRY(row, openShellsRow(workload, solids, dimension, options));
        report.rows.push_back(std::move(*row));
    }
    return {};
}

}  // namespace svt::bench
