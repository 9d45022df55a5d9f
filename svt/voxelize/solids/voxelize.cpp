#include <svt/voxelize/voxelize.hpp>

#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>
#include <svt/voxelize/rewrite/rewrite.hpp>
#include <svt/voxelize/surfaces/bare_voxels.hpp>
#include <svt/voxelize/surfaces/lost_faces.hpp>
#include <svt/voxelize/surfaces/sheets.hpp>
#include <svt/voxelize/surfaces/winding.hpp>
#include <svt/voxelize/tiles/tile_columns.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>

namespace svt::voxelize {
namespace {

using volume::ColumnVolume;

// Every object has three claims: as a solid; for thin parts with a sample on one of their sides; for other thin parts,
// or as a sheet.
struct Claims {
    std::vector<PrioritizedClaim> ordered;
    std::vector<std::uint32_t> solidOrder, tiedOrder, thinOrder;  // per object
    std::vector<bool> boundsBody;
};

Claims orderClaims(const mesh::MeshSet& meshes, std::span<const ObjectClaim> claims) {
    enum class Kind : std::uint8_t { Solid, Tied, Thin };
    struct Entry {
        std::uint32_t object;
        Kind kind;
    };
    std::vector<Entry> entries;
    for (std::uint32_t o = 0; o < claims.size(); ++o)
        for (const Kind kind : {Kind::Solid, Kind::Tied, Kind::Thin}) entries.push_back({o, kind});
    // Lower rank first; at equal rank solids and ties before other thin parts and sheets, then the smaller volume, then
    // the id.
    std::sort(entries.begin(), entries.end(), [&](const Entry& p, const Entry& q) {
        const auto key = [&](const Entry& e) {
            return std::tuple<std::uint8_t, bool, double, std::string_view, std::uint32_t, Kind>(
                claims[e.object].rank, e.kind == Kind::Thin, meshes.objects[e.object].volume, claims[e.object].id,
                e.object, e.kind);
        };
        return key(p) < key(q);
    });
    Claims result;
    for (const ObjectClaim& claim : claims) result.boundsBody.push_back(claim.body != kNoBody);
    for (auto* orders : {&result.solidOrder, &result.tiedOrder, &result.thinOrder}) orders->resize(claims.size());
    for (std::uint32_t order = 0; order < entries.size(); ++order) {
        const auto [object, kind] = entries[order];
        (kind == Kind::Solid  ? result.solidOrder
         : kind == Kind::Tied ? result.tiedOrder
                              : result.thinOrder)[object] = order;
        const bool isSolid =
            kind == Kind::Solid && meshes.objects[object].closingMethod != mesh::ClosingMethod::Surface;
        result.ordered.push_back({claims[object].scalar, object, isSolid});
    }
    return result;
}

// The parts that touch each tile, stored tile after tile; within a tile by object, then by number.
struct TileBins {
    std::vector<std::uint32_t> first;
    std::vector<PartRef> parts;
    [[nodiscard]] std::span<const PartRef> of(std::size_t tile) const {
        return std::span(parts).subspan(first[tile], first[tile + 1] - first[tile]);
    }
};

// Bins the items of all objects by tile (counting sort). `items(object)` returns the vector of an object's items,
// `rangeOf(item, tx0, tx1, ty0, ty1)` the half-open range of tiles of an item's bounding box, and
// `touches(object, item, tx, ty)` decides for ranges of several rows and columns.
template <class Items, class RangeOf, class Touches>
TileBins fillBins(std::span<const ObjectParts> objects, std::int32_t tilesX, std::int32_t tilesY, int threads,
                  Items&& items, RangeOf&& rangeOf, Touches&& touches) {
    struct Entry {
        std::uint32_t tile;
        PartRef part;
    };
    struct Chunk {
        std::uint32_t object, begin, end;
        std::vector<Entry> entries;
    };
    constexpr std::size_t kChunk = 1024;
    std::vector<Chunk> chunks;
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
        const std::size_t count = items(objects[o]).size();
        for (std::size_t begin = 0; begin < count; begin += kChunk)
            chunks.push_back({o,
                              static_cast<std::uint32_t>(begin),
                              static_cast<std::uint32_t>(std::min(count, begin + kChunk)),
                              {}});
    }
    parallelFor(chunks.size(), 1, threads, [&](std::size_t firstChunk, std::size_t endChunk) {
        for (std::size_t s = firstChunk; s < endChunk; ++s) {
            Chunk& chunk = chunks[s];
            const ObjectParts& object = objects[chunk.object];
            chunk.entries.reserve(2 * std::size_t{chunk.end - chunk.begin});
            for (std::uint32_t n = chunk.begin; n < chunk.end; ++n) {
                const auto& item = items(object)[n];
                std::int32_t x0, x1, y0, y1;
                rangeOf(item, x0, x1, y0, y1);
                const bool isBlock = x1 - x0 > 1 && y1 - y0 > 1;
                for (std::int32_t y = y0; y < y1; ++y)
                    for (std::int32_t x = x0; x < x1; ++x)
                        if (!isBlock || touches(object, item, x, y))
                            chunk.entries.push_back({static_cast<std::uint32_t>(x + tilesX * y), {chunk.object, n}});
            }
        }
    });
    TileBins bins;
    bins.first.assign(std::size_t(tilesX) * std::size_t(tilesY) + 1, 0);
    for (const Chunk& chunk : chunks)
        for (const Entry& entry : chunk.entries) ++bins.first[entry.tile + 1];
    std::partial_sum(bins.first.begin(), bins.first.end(), bins.first.begin());
    bins.parts.resize(bins.first.back());
    std::vector<std::uint32_t> next(bins.first.begin(), bins.first.end() - 1);
    for (const Chunk& chunk : chunks)
        for (const Entry& entry : chunk.entries) bins.parts[next[entry.tile]++] = entry.part;
    return bins;
}

void tileRange(std::int32_t first, std::int32_t end, std::int32_t dimension, std::int32_t& tileFirst,
               std::int32_t& tileEnd) {
    first = std::clamp(first, 0, dimension);
    end = std::clamp(end, 0, dimension);
    tileFirst = first / ColumnVolume::kTileSize;
    tileEnd = first < end ? (end - 1) / ColumnVolume::kTileSize + 1 : tileFirst;
}

// The prepared geometry of all objects.
struct Geometry {
    HeightPlanes heightPlanes;
    std::vector<ObjectParts> objects;
    std::vector<std::uint64_t> thinVoxels, uncertainVoxels;  // per object
    std::vector<std::uint32_t> unfilled;
    std::vector<BoundedBody> bodies;
    std::vector<mesh::ObjectMesh> bodyFaces;  // per object; see makeBodyFaces()
};

void addSheet(const IndexMesh& index, const volume::Grid& grid, std::uint32_t claim, bool boundsBody,
              const VoxelizeOptions& options, ObjectParts& parts) {
    if (options.sheets == SheetMode::Thin)
        addThinSheet(index, grid.dimension(), claim, boundsBody, parts.boxes);
    else
        addConservativeSheet(index, grid.dimension(), claim, parts.boxes);
    // If faces are closer together than voxels, most boxes are the same. Each would take 300 bytes in its tiles.
    constexpr std::size_t kMany = 1 << 16;
    if (parts.boxes.size() <= kMany) return;
    std::ranges::sort(parts.boxes);
    parts.boxes.erase(std::unique(parts.boxes.begin(), parts.boxes.end()), parts.boxes.end());
}

// Prepares the parts of object number `object`; height planes without a shared plane go to `ownHeightPlanes`.
void prepareObject(const mesh::MeshSet& meshes, const volume::Grid& grid, const IndexFromLocal& indexFromLocal,
                   std::span<const std::uint32_t> heightPlaneOfPlane, const Claims& claims,
                   const VoxelizeOptions& options, std::uint32_t object, HeightPlanes& ownHeightPlanes, Geometry& all) {
    const mesh::ObjectMesh& mesh = meshes.objects[object];
    if (mesh.closingMethod == mesh::ClosingMethod::Open) return;  // see fillOpenShells()
    ObjectParts& parts = all.objects[object];
    if (mesh.closingMethod == mesh::ClosingMethod::Surface) {
        const bool boundsBody = claims.boundsBody[object];
        addSheet(makeIndexMesh(boundsBody ? all.bodyFaces[object] : mesh, indexFromLocal), grid,
                 claims.thinOrder[object], boundsBody, options, parts);
        return;
    }
    const IndexMesh index = makeIndexMesh(mesh, indexFromLocal);
    const Vec3i dimension = grid.dimension();
    parts.faces = groupCoplanarFaces(index, heightPlaneOfPlane, dimension, claims.solidOrder[object], ownHeightPlanes);
    if (options.keepThinParts)
        all.thinVoxels[object] = addThinParts(index, indexFromLocal, dimension,
                                              {claims.thinOrder[object], claims.tiedOrder[object]}, parts.boxes);
}

// Number of voxels of an object as a sheet, estimated by area. The memory of the sheet pass is proportional to it.
double estimateSheetVoxels(const mesh::ObjectMesh& object, const IndexFromLocal& indexFromLocal) {
    double voxels = 0;
    for (const mesh::Triangle& triangle : object.triangles) {
        const Vec3d a = object.vertices[triangle.corners[0]];
        const Vec3d normal = cross(indexFromLocal.direction(object.vertices[triangle.corners[1]] - a),
                                   indexFromLocal.direction(object.vertices[triangle.corners[2]] - a));
        voxels += (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) / 2;
    }
    return voxels;
}

Result<void> checkSheetVoxels(double voxels) {
    constexpr double kMaxSheetVoxels = 5e8;
    if (voxels <= kMaxSheetVoxels) return {};
    return Error(Code::GridTooLarge,
                 fmt::format("the open surfaces of the model need about {:.2g} voxels, over the limit of {:.2g}; "
                             "choose a coarser spacing",
                             voxels, kMaxSheetVoxels));
}

// An object that lost every voxel gets the one nearest to the centroid of one of its triangles: the first that lies in
// the grid and is not another object's last voxel.
ColumnVolume restoreVanishedObjects(ColumnVolume columns, const mesh::MeshSet& meshes, const volume::Grid& grid,
                                    const IndexFromLocal& indexFromLocal, std::span<const ObjectClaim> claims,
                                    std::span<const std::uint8_t> usedScalars, std::vector<std::uint64_t>& thinVoxels,
                                    int threads) {
    if (std::all_of(claims.begin(), claims.end(),
                    [&](const ObjectClaim& claim) { return usedScalars[claim.scalar] != 0; }))
        return columns;
    std::vector<std::uint64_t> counts = columns.countVoxels(static_cast<volume::Scalar>(usedScalars.size()));
    std::vector<VoxelEdit> edits;
    std::set<Vec3i> taken;
    const Vec3i dimension = grid.dimension();
    for (std::uint32_t o = 0; o < claims.size(); ++o) {
        if (counts[claims[o].scalar] != 0) continue;
        const mesh::ObjectMesh& mesh = meshes.objects[o];
        for (const mesh::Triangle& triangle : mesh.triangles) {
            const Vec3d center = (mesh.vertices[triangle.corners[0]] + mesh.vertices[triangle.corners[1]] +
                                  mesh.vertices[triangle.corners[2]]) /
                                 3.0;
            const Vec3d index = indexFromLocal.point(center);
            const Vec3i voxel{static_cast<std::int32_t>(std::lrint(std::clamp(index.x, -1.0, 1e6))),
                              static_cast<std::int32_t>(std::lrint(std::clamp(index.y, -1.0, 1e6))),
                              static_cast<std::int32_t>(std::lrint(std::clamp(index.z, -1.0, 1e6)))};
            if (voxel.x < 0 || voxel.y < 0 || voxel.z < 0 || voxel.x >= dimension.x || voxel.y >= dimension.y ||
                voxel.z >= dimension.z)
                continue;
            const volume::Scalar owner = columns.scalarAt(voxel.x, voxel.y, voxel.z);
            if (taken.contains(voxel) || (owner != 0 && counts[owner] <= 1)) continue;
            if (owner != 0) --counts[owner];
            taken.insert(voxel);
            edits.push_back({voxel, claims[o].scalar});
            ++thinVoxels[o];
            break;
        }
    }
    return edits.empty() ? columns : editVoxels(columns, std::move(edits), threads);
}

// Adds the faces that the filling of open shells left out, and lists these shells.
void addLostFaces(const mesh::MeshSet& meshes, const IndexFromLocal& indexFromLocal,
                  std::span<const ObjectClaim> claims, int threads, std::vector<std::uint8_t>& usedScalars,
                  VoxelizeResult& result) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o)
        if (meshes.objects[o].closingMethod == mesh::ClosingMethod::Open &&
            std::ranges::find(result.unfilled, o) == result.unfilled.end())
            open.push_back(o);
    if (open.empty()) return;
    std::stable_sort(open.begin(), open.end(),
                     [&](std::uint32_t p, std::uint32_t q) { return claims[p].rank < claims[q].rank; });
    constexpr std::uint8_t kBackground = 255;
    std::vector<std::uint8_t> ranks(usedScalars.size(), kBackground);
    for (const ObjectClaim& claim : claims) {
        if (ranks.size() <= claim.scalar) ranks.resize(std::size_t{claim.scalar} + 1, kBackground);
        ranks[claim.scalar] = claim.rank;
    }
    std::vector<LostFaces> lost(open.size());
    parallelFor(open.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n)
            lost[n] = findLostFaces(makeIndexMesh(meshes.objects[open[n]], indexFromLocal), result.columns, ranks,
                                    claims[open[n]].scalar);
    });
    std::vector<VoxelEdit> edits;
    for (std::size_t n = 0; n < open.size(); ++n) {
        if (lost[n].voxels.empty()) continue;
        edits.insert(edits.end(), lost[n].voxels.begin(), lost[n].voxels.end());
        result.thinVoxels[open[n]] += lost[n].voxels.size();
        result.lostFaces.push_back({open[n], lost[n].share});
    }
    if (edits.empty()) return;
    result.columns = editVoxels(result.columns, std::move(edits), threads);
    const std::vector<std::uint64_t> counts = result.columns.countVoxels(static_cast<volume::Scalar>(ranks.size()));
    usedScalars.assign(counts.size(), 0);
    for (std::size_t scalar = 0; scalar < counts.size(); ++scalar) usedScalars[scalar] = counts[scalar] != 0;
    std::ranges::sort(result.lostFaces, {}, &LostShare::object);
}

// Gives the voxels on the outside of bodies that no surface took to the nearest surface.
void coverBareVoxels(const Geometry& geometry, const volume::Grid& grid, Vec3d origin,
                     std::span<const ObjectClaim> claims, int threads, std::vector<std::uint8_t>& usedScalars,
                     ColumnVolume& columns) {
    std::vector<VoxelEdit> edits =
        findBareVoxels(columns, grid, origin, geometry.bodies, geometry.bodyFaces, claims, threads);
    if (edits.empty()) return;
    columns = editVoxels(columns, std::move(edits), threads);
    // Every run in the dictionary of a tile is in use.
    std::ranges::fill(usedScalars, std::uint8_t{0});
    for (const volume::ColumnTile& tile : columns.tiles())
        for (const volume::Run& run : tile.runs) usedScalars[run.scalar] = 1;
}

// Fills the open objects by winding number: all their parts on all cores.
Result<void> fillOpenShells(const mesh::MeshSet& meshes, const volume::Grid& grid, const IndexFromLocal& indexFromLocal,
                            std::span<const std::uint32_t> heightPlaneOfPlane, const Claims& claims,
                            const VoxelizeOptions& options, std::vector<HeightPlanes>& ownHeightPlanes, Geometry& all) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o)
        if (meshes.objects[o].closingMethod == mesh::ClosingMethod::Open) open.push_back(o);
    std::vector<std::unique_ptr<WindingFill>> fills(open.size());
    parallelFor(open.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const std::uint32_t o = open[n], claim = claims.solidOrder[o];
            fills[n] = std::make_unique<WindingFill>(meshes.objects[o], meshes, grid, indexFromLocal, claim,
                                                     options.solidAngles);
            all.objects[o].faces = groupCoplanarFaces(fills[n]->covered(), heightPlaneOfPlane, grid.dimension(), claim,
                                                      ownHeightPlanes[o]);
        }
    });
    struct FillPart {
        std::size_t fill, part;
    };
    std::vector<FillPart> parts;
    for (std::size_t n = 0; n < fills.size(); ++n)
        for (std::size_t part = 0; part < fills[n]->partCount(); ++part) parts.push_back({n, part});
    constexpr std::uint64_t kMaxRuns = 30'000'000;  // about 1.5 GB as boxes
    std::atomic<std::uint64_t> runs{0};
    ProgressCounter progress(parts.empty() ? nullptr : options.progress, "fill", parts.size());
    parallelFor(parts.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end && runs <= kMaxRuns; ++n) {
            if (Progress::isCancelled(options.progress)) return;
            runs += fills[parts[n].fill]->runPart(parts[n].part);
            progress.add();
        }
    });
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while voxelizing");
    if (runs > kMaxRuns)
        return Error(
            Code::GridTooLarge,
            fmt::format("filling the open shells of the model needs over {} runs of voxels next to their holes; "
                        "choose a coarser spacing, or close the shells",
                        kMaxRuns));
    parallelFor(open.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n)
            all.uncertainVoxels[open[n]] = fills[n]->finish(all.objects[open[n]].boxes);
    });
    double sheetVoxels = 0;
    for (std::size_t n = 0; n < open.size(); ++n)
        if (fills[n]->isOverBound()) {
            all.unfilled.push_back(open[n]);
            sheetVoxels += estimateSheetVoxels(meshes.objects[open[n]], indexFromLocal);
        }
    SVT_DO(checkSheetVoxels(sheetVoxels));
    for (const std::uint32_t o : all.unfilled) {
        all.objects[o].faces = {};
        addSheet(makeIndexMesh(meshes.objects[o], indexFromLocal), grid, claims.thinOrder[o], false, options,
                 all.objects[o]);
    }
    return {};
}

Result<Geometry> prepareObjects(const mesh::MeshSet& meshes, const volume::Grid& grid,
                                const IndexFromLocal& indexFromLocal, std::span<const ObjectClaim> objectClaims,
                                const Claims& claims, const VoxelizeOptions& options) {
    Geometry all;
    all.bodies = findBoundedBodies(meshes, objectClaims);
    all.bodyFaces = makeBodyFaces(meshes, all.bodies, options.threads);
    all.heightPlanes.depth = grid.dimension().z;
    all.heightPlanes.first = static_cast<std::uint32_t>(grid.dimension().z) + 1;
    std::vector<std::uint32_t> heightPlaneOfPlane;
    if (indexFromLocal.keepsVertical()) {
        heightPlaneOfPlane.resize(meshes.planes.size(), kNoHeightPlane);
        all.heightPlanes.sloped.resize(meshes.planes.size());
        parallelFor(heightPlaneOfPlane.size(), 256, options.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const mesh::Plane plane = indexFromLocal.plane(meshes.planes[n]);
                if (isScanPlane(plane))
                    heightPlaneOfPlane[n] =
                        all.heightPlanes.put(n, HeightPlane(planeHeight(plane), grid.dimension().z));
            }
        });
    }
    all.objects.resize(meshes.objects.size());
    all.thinVoxels.resize(meshes.objects.size(), 0);
    all.uncertainVoxels.resize(meshes.objects.size(), 0);
    std::vector<HeightPlanes> ownHeightPlanes(meshes.objects.size());
    parallelFor(meshes.objects.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t o = begin; o < end; ++o) {
            ownHeightPlanes[o].depth = all.heightPlanes.depth;
            ownHeightPlanes[o].first = all.heightPlanes.next();
            prepareObject(meshes, grid, indexFromLocal, heightPlaneOfPlane, claims, options,
                          static_cast<std::uint32_t>(o), ownHeightPlanes[o], all);
        }
    });
    if (auto filled =
            fillOpenShells(meshes, grid, indexFromLocal, heightPlaneOfPlane, claims, options, ownHeightPlanes, all);
        !filled)
        return filled.error();
    // Append the height planes of single objects to the common table, in object order, and renumber them.
    for (std::size_t o = 0; o < meshes.objects.size(); ++o) {
        const HeightPlanes& own = ownHeightPlanes[o];
        if (own.sloped.empty()) continue;
        const std::uint32_t shift = all.heightPlanes.next() - own.first;
        for (Boundary& face : all.objects[o].faces.faces)
            if (face.heightPlane >= own.first) face.heightPlane += shift;
        all.heightPlanes.sloped.insert(all.heightPlanes.sloped.end(), own.sloped.begin(), own.sloped.end());
    }
    return all;
}

// Reports progress from any thread.
class TileProgress {
public:
    TileProgress(const Progress* progress, std::size_t count) : progress_(progress), count_(count) {}
    void tileDone() {
        const std::size_t done = ++done_;
        if (progress_ == nullptr || done % 16 != 0) return;
        const std::lock_guard lock(mutex_);
        Progress::tell(progress_, "voxelize", double(done) / double(count_));
    }

private:
    const Progress* progress_;
    std::size_t count_;
    std::atomic<std::size_t> done_{0};
    std::mutex mutex_;
};

// A pool of tile makers, so that tasks reuse their buffers and caches.
class MakerPool {
public:
    MakerPool(std::span<const PrioritizedClaim> claims, const HeightPlanes& heightPlanes)
        : claims_(claims), heightPlanes_(heightPlanes) {}
    std::unique_ptr<TileColumns> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::make_unique<TileColumns>(claims_, heightPlanes_);
        auto maker = std::move(free_.back());
        free_.pop_back();
        return maker;
    }
    void giveBack(std::unique_ptr<TileColumns> maker) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(maker));
    }
    // Sum of the counts of all makers.
    OverlapCounts takeCounts(int threads) {
        std::vector<OverlapCounts> taken(free_.size());
        parallelFor(free_.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t maker = begin; maker < end; ++maker) taken[maker] = free_[maker]->takeCounts();
        });
        OverlapCounts counts;
        for (const OverlapCounts& ofMaker : taken) {
            for (const OverlapCount& sum : ofMaker.sums()) counts.add(sum);
            counts.addCrowded(ofMaker.crowded());
        }
        return counts;
    }
    // Per scalar: 1 if some maker has written it.
    [[nodiscard]] std::vector<std::uint8_t> usedScalars() const {
        std::vector<std::uint8_t> present;
        for (const auto& maker : free_) {
            present.resize(maker->usedScalars().size(), 0);
            for (std::size_t scalar = 0; scalar < present.size(); ++scalar)
                present[scalar] |= maker->usedScalars()[scalar];
        }
        return present;
    }

private:
    std::span<const PrioritizedClaim> claims_;
    const HeightPlanes& heightPlanes_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<TileColumns>> free_;
};

struct Tiles {
    std::vector<volume::ColumnTileData> tiles;
    OverlapCounts shared;
    std::vector<std::uint8_t> usedScalars;  // per scalar
};

Tiles sweepTiles(const Geometry& geometry, Vec3i dimension, const Claims& claims, const VoxelizeOptions& options) {
    const std::int32_t tilesX = (dimension.x + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize;
    const std::int32_t tilesY = (dimension.y + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize;
    constexpr std::int32_t kTile = ColumnVolume::kTileSize;
    const TileBins triangles = fillBins(
        geometry.objects, tilesX, tilesY, options.threads,
        [](const ObjectParts& object) -> const auto& { return object.faces.triangles; },
        [&](const FaceTriangle& triangle, auto& x0, auto& x1, auto& y0, auto& y1) {
            tileRange(triangle.firstColumn, triangle.endColumn, dimension.x, x0, x1);
            tileRange(triangle.firstRow, triangle.endRow, dimension.y, y0, y1);
        },
        [](const ObjectParts& object, const FaceTriangle& triangle, std::int32_t x, std::int32_t y) {
            return touchesSamples(triangle, object.faces.faces[triangle.face].isEntry, x * kTile, y * kTile, kTile,
                                  kTile);
        });
    const TileBins boxes = fillBins(
        geometry.objects, tilesX, tilesY, options.threads,
        [](const ObjectParts& object) -> const auto& { return object.boxes; },
        [&](const ClaimedBox& box, auto& x0, auto& x1, auto& y0, auto& y1) {
            tileRange(box.begin, box.end, dimension.x, x0, x1);
            tileRange(box.firstRow, box.endRow, dimension.y, y0, y1);
        },
        [](const ObjectParts&, const ClaimedBox&, std::int32_t, std::int32_t) { return true; });

    const std::size_t tileCount = std::size_t(tilesX) * std::size_t(tilesY);
    Tiles result;
    result.tiles.resize(tileCount);
    TileProgress progress(options.progress, tileCount);
    MakerPool makers(claims.ordered, geometry.heightPlanes);
    parallelFor(tileCount, 1, options.threads, [&](std::size_t begin, std::size_t end) {
        auto maker = makers.take();
        for (std::size_t tile = begin; tile < end; ++tile) {
            if (Progress::isCancelled(options.progress)) return;
            TileInput input;
            input.firstColumn = static_cast<std::int32_t>(tile % std::size_t(tilesX)) * ColumnVolume::kTileSize;
            input.firstRow = static_cast<std::int32_t>(tile / std::size_t(tilesX)) * ColumnVolume::kTileSize;
            input.width = std::min(ColumnVolume::kTileSize, dimension.x - input.firstColumn);
            input.height = std::min(ColumnVolume::kTileSize, dimension.y - input.firstRow);
            input.depth = dimension.z;
            input.objects = geometry.objects;
            input.triangles = triangles.of(tile);
            input.boxes = boxes.of(tile);
            result.tiles[tile] = maker->make(input);
            progress.tileDone();
        }
        makers.giveBack(std::move(maker));
    });
    result.shared = makers.takeCounts(options.threads);
    result.usedScalars = makers.usedScalars();
    return result;
}

}  // namespace

Result<VoxelizeResult> voxelize(const mesh::MeshSet& meshes, const volume::Grid& grid,
                                std::span<const ObjectClaim> claims, const VoxelizeOptions& options) {
    SVT_CHECK(claims.size() == meshes.objects.size());
    Progress::tell(options.progress, "voxelize", 0);
    const IndexFromLocal indexFromLocal(meshes, grid);
    double sheetVoxels = 0;
    for (const mesh::ObjectMesh& object : meshes.objects)
        if (object.closingMethod == mesh::ClosingMethod::Surface)
            sheetVoxels += estimateSheetVoxels(object, indexFromLocal);
    SVT_DO(checkSheetVoxels(sheetVoxels));
    const Claims ordered = orderClaims(meshes, claims);
    SVT_TRY(geometry, prepareObjects(meshes, grid, indexFromLocal, claims, ordered, options));
    Tiles swept = sweepTiles(*geometry, grid.dimension(), ordered, options);
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while voxelizing");

    VoxelizeResult result;
    result.thinVoxels = std::move(geometry->thinVoxels);
    result.uncertainVoxels = std::move(geometry->uncertainVoxels);
    result.unfilled = std::move(geometry->unfilled);
    for (const OverlapCount& pair : swept.shared.sums())
        result.overlaps.push_back(
            {ordered.ordered[pair.first].object, ordered.ordered[pair.second].object, pair.voxels});
    result.crowdedVoxels = swept.shared.crowded();
    std::sort(result.overlaps.begin(), result.overlaps.end(),
              [](const ClaimPair& p, const ClaimPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
    result.columns = ColumnVolume::fromTiles(grid.dimension(), std::move(swept.tiles));
    if (options.keepThinParts) addLostFaces(meshes, indexFromLocal, claims, options.threads, swept.usedScalars, result);
    coverBareVoxels(*geometry, grid, meshes.origin, claims, options.threads, swept.usedScalars, result.columns);
    result.columns = restoreVanishedObjects(std::move(result.columns), meshes, grid, indexFromLocal, claims,
                                            swept.usedScalars, result.thinVoxels, options.threads);
    Progress::tell(options.progress, "voxelize", 1);
    return result;
}

}  // namespace svt::voxelize
