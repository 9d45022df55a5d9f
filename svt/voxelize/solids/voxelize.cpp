#include <svt/voxelize/voxelize.hpp>

#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>
#include <svt/voxelize/rewrite/rewrite.hpp>
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

namespace svt::voxelize {
namespace {

using volume::ColumnVolume;

// Every object has two claims: one as a solid, and one for its thin parts or as a sheet.
struct Claims {
    std::vector<OrderedClaim> ordered;
    std::vector<std::uint32_t> solidOrder, thinOrder;  // per object
};

Claims orderClaims(const mesh::MeshScene& scene, std::span<const ObjectClaim> claims) {
    struct Entry {
        std::uint32_t object;
        bool isThin;
    };
    std::vector<Entry> entries;
    for (std::uint32_t o = 0; o < claims.size(); ++o) {
        entries.push_back({o, false});
        entries.push_back({o, true});
    }
    // Lower rank first; at equal rank solids before thin parts and sheets, then the smaller volume, then the id.
    std::sort(entries.begin(), entries.end(), [&](const Entry& p, const Entry& q) {
        const auto key = [&](const Entry& e) {
            return std::tuple<std::uint8_t, bool, double, std::string_view, std::uint32_t>(
                claims[e.object].rank, e.isThin, scene.objects[e.object].volume, claims[e.object].id, e.object);
        };
        return key(p) < key(q);
    });
    Claims result;
    result.solidOrder.resize(claims.size());
    result.thinOrder.resize(claims.size());
    for (std::uint32_t order = 0; order < entries.size(); ++order) {
        const Entry& entry = entries[order];
        (entry.isThin ? result.thinOrder : result.solidOrder)[entry.object] = order;
        const bool isSolid = !entry.isThin && scene.objects[entry.object].closure != mesh::Closure::Surface;
        result.ordered.push_back({claims[entry.object].scalar, entry.object, isSolid});
    }
    return result;
}

// The parts that touch each tile, stored tile after tile; within a tile by object, then by number.
struct TileBins {
    std::vector<std::uint32_t> first;
    std::vector<PartNumber> parts;
    [[nodiscard]] std::span<const PartNumber> of(std::size_t tile) const {
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
        PartNumber part;
    };
    struct Stretch {
        std::uint32_t object, begin, end;
        std::vector<Entry> entries;
    };
    constexpr std::size_t kStretch = 1024;
    std::vector<Stretch> stretches;
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
        const std::size_t count = items(objects[o]).size();
        for (std::size_t begin = 0; begin < count; begin += kStretch)
            stretches.push_back({o,
                                 static_cast<std::uint32_t>(begin),
                                 static_cast<std::uint32_t>(std::min(count, begin + kStretch)),
                                 {}});
    }
    parallelFor(stretches.size(), 1, threads, [&](std::size_t firstStretch, std::size_t endStretch) {
        for (std::size_t s = firstStretch; s < endStretch; ++s) {
            Stretch& stretch = stretches[s];
            const ObjectParts& object = objects[stretch.object];
            stretch.entries.reserve(2 * std::size_t{stretch.end - stretch.begin});
            for (std::uint32_t n = stretch.begin; n < stretch.end; ++n) {
                const auto& item = items(object)[n];
                std::int32_t x0, x1, y0, y1;
                rangeOf(item, x0, x1, y0, y1);
                const bool isBlock = x1 - x0 > 1 && y1 - y0 > 1;
                for (std::int32_t y = y0; y < y1; ++y)
                    for (std::int32_t x = x0; x < x1; ++x)
                        if (!isBlock || touches(object, item, x, y))
                            stretch.entries.push_back(
                                {static_cast<std::uint32_t>(x + tilesX * y), {stretch.object, n}});
            }
        }
    });
    TileBins bins;
    bins.first.assign(std::size_t(tilesX) * std::size_t(tilesY) + 1, 0);
    for (const Stretch& stretch : stretches)
        for (const Entry& entry : stretch.entries) ++bins.first[entry.tile + 1];
    std::partial_sum(bins.first.begin(), bins.first.end(), bins.first.begin());
    bins.parts.resize(bins.first.back());
    std::vector<std::uint32_t> next(bins.first.begin(), bins.first.end() - 1);
    for (const Stretch& stretch : stretches)
        for (const Entry& entry : stretch.entries) bins.parts[next[entry.tile]++] = entry.part;
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
    LevelTable levels;
    std::vector<ObjectParts> objects;
    std::vector<std::uint64_t> thinVoxels, uncertainVoxels;  // per object
};

// Prepares the parts of object number `object`; levels without a shared plane go to `ownLevels`.
void prepareObject(const mesh::MeshScene& scene, const volume::Grid& grid, const IndexFromLocal& indexFromLocal,
                   std::span<const std::uint32_t> planeLevels, const Claims& claims, const VoxelizeOptions& options,
                   std::uint32_t object, LevelTable& ownLevels, Geometry& all) {
    const mesh::ObjectMesh& mesh = scene.objects[object];
    if (mesh.closure == mesh::Closure::Open) return;  // filled by winding number later, one at a time on all cores
    const IndexMesh index = makeIndexMesh(mesh, indexFromLocal);
    ObjectParts& parts = all.objects[object];
    if (mesh.closure == mesh::Closure::Surface) {
        const auto addSheet = options.sheets == SheetMode::Thin ? addThinSheet : addConservativeSheet;
        addSheet(index, grid.dimension(), claims.thinOrder[object], parts.boxes);
        return;
    }
    const Vec3i dimension = grid.dimension();
    parts.faces = makeFaces(index, planeLevels, dimension, claims.solidOrder[object], ownLevels);
    if (options.keepThinParts)
        all.thinVoxels[object] = addThinParts(index, indexFromLocal, dimension, claims.thinOrder[object], parts.boxes);
}

// Number of voxels of all sheets, estimated by area. The memory of the sheet pass is proportional to it.
double estimateSheetVoxels(const mesh::MeshScene& scene, const IndexFromLocal& indexFromLocal) {
    double voxels = 0;
    for (const mesh::ObjectMesh& object : scene.objects) {
        if (object.closure != mesh::Closure::Surface) continue;
        for (const mesh::Triangle& triangle : object.triangles) {
            const Vec3d a = object.vertices[triangle.corners[0]];
            const Vec3d normal = cross(indexFromLocal.direction(object.vertices[triangle.corners[1]] - a),
                                       indexFromLocal.direction(object.vertices[triangle.corners[2]] - a));
            voxels += (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) / 2;
        }
    }
    return voxels;
}

// An object that lost every voxel gets the one nearest to the centroid of one of its triangles: the first that lies in
// the grid and is not another object's last voxel.
ColumnVolume keepVanished(ColumnVolume columns, const mesh::MeshScene& scene, const volume::Grid& grid,
                          const IndexFromLocal& indexFromLocal, std::span<const ObjectClaim> claims,
                          std::span<const std::uint8_t> isPresent, std::vector<std::uint64_t>& thinVoxels,
                          int threads) {
    if (std::all_of(claims.begin(), claims.end(),
                    [&](const ObjectClaim& claim) { return isPresent[claim.scalar] != 0; }))
        return columns;
    std::vector<std::uint64_t> counts = columns.countVoxels(static_cast<volume::Scalar>(isPresent.size()));
    std::vector<VoxelEdit> edits;
    const Vec3i dimension = grid.dimension();
    for (std::uint32_t o = 0; o < claims.size(); ++o) {
        if (counts[claims[o].scalar] != 0) continue;
        const mesh::ObjectMesh& mesh = scene.objects[o];
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
            const bool isTaken =
                std::any_of(edits.begin(), edits.end(), [&](const VoxelEdit& edit) { return edit.voxel == voxel; });
            const volume::Scalar owner = columns.scalarAt(voxel.x, voxel.y, voxel.z);
            if (isTaken || (owner != 0 && counts[owner] <= 1)) continue;
            if (owner != 0) --counts[owner];
            edits.push_back({voxel, claims[o].scalar});
            ++thinVoxels[o];
            break;
        }
    }
    return edits.empty() ? columns : editVoxels(columns, std::move(edits), threads);
}

Result<Geometry> prepareObjects(const mesh::MeshScene& scene, const volume::Grid& grid,
                                const IndexFromLocal& indexFromLocal, const Claims& claims,
                                const VoxelizeOptions& options) {
    Geometry all;
    all.levels.depth = grid.dimension().z;
    all.levels.first = static_cast<std::uint32_t>(grid.dimension().z) + 1;
    std::vector<std::uint32_t> planeLevels;
    if (indexFromLocal.keepsVertical()) {
        planeLevels.resize(scene.planes.size(), kNoLevel);
        all.levels.sloped.resize(scene.planes.size());
        parallelFor(planeLevels.size(), 256, options.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const mesh::Plane plane = indexFromLocal.plane(scene.planes[n]);
                if (isScanPlane(plane))
                    planeLevels[n] = all.levels.put(n, Level(planeHeight(plane), grid.dimension().z));
            }
        });
    }
    all.objects.resize(scene.objects.size());
    all.thinVoxels.resize(scene.objects.size(), 0);
    all.uncertainVoxels.resize(scene.objects.size(), 0);
    std::vector<LevelTable> ownLevels(scene.objects.size());
    parallelFor(scene.objects.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t o = begin; o < end; ++o) {
            ownLevels[o].depth = all.levels.depth;
            ownLevels[o].first = all.levels.next();
            prepareObject(scene, grid, indexFromLocal, planeLevels, claims, options, static_cast<std::uint32_t>(o),
                          ownLevels[o], all);
        }
    });
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        if (scene.objects[o].closure != mesh::Closure::Open) continue;
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while voxelizing");
        all.uncertainVoxels[o] = addWindingFill(makeIndexMesh(scene.objects[o], indexFromLocal), scene, grid,
                                                claims.solidOrder[o], options.threads, all.objects[o].boxes);
    }
    // Append the levels of single objects to the common table, in object order, and renumber them.
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const LevelTable& own = ownLevels[o];
        if (own.sloped.empty()) continue;
        const std::uint32_t shift = all.levels.next() - own.first;
        for (Boundary& face : all.objects[o].faces.faces)
            if (face.level >= own.first) face.level += shift;
        all.levels.sloped.insert(all.levels.sloped.end(), own.sloped.begin(), own.sloped.end());
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
    MakerPool(std::span<const OrderedClaim> claims, const LevelTable& levels) : claims_(claims), levels_(levels) {}
    std::unique_ptr<TileColumns> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::make_unique<TileColumns>(claims_, levels_);
        auto maker = std::move(free_.back());
        free_.pop_back();
        return maker;
    }
    void giveBack(std::unique_ptr<TileColumns> maker) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(maker));
    }
    // Sum of the counts of all makers.
    SharedCounts takeCounts(int threads) {
        std::vector<SharedCounts> taken(free_.size());
        parallelFor(free_.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t maker = begin; maker < end; ++maker) taken[maker] = free_[maker]->takeCounts();
        });
        SharedCounts counts;
        for (const SharedCounts& ofMaker : taken)
            for (const SharedCount& sum : ofMaker.sums()) counts.add(sum);
        return counts;
    }
    // Per scalar: 1 if some maker has written it.
    [[nodiscard]] std::vector<std::uint8_t> isPresent() const {
        std::vector<std::uint8_t> present;
        for (const auto& maker : free_) {
            present.resize(maker->isPresent().size(), 0);
            for (std::size_t scalar = 0; scalar < present.size(); ++scalar)
                present[scalar] |= maker->isPresent()[scalar];
        }
        return present;
    }

private:
    std::span<const OrderedClaim> claims_;
    const LevelTable& levels_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<TileColumns>> free_;
};

struct Tiles {
    std::vector<volume::ColumnTileData> tiles;
    SharedCounts shared;
    std::vector<std::uint8_t> isPresent;  // per scalar
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
    MakerPool makers(claims.ordered, geometry.levels);
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
    result.isPresent = makers.isPresent();
    return result;
}

}  // namespace

Result<VoxelizeResult> voxelize(const mesh::MeshScene& scene, const volume::Grid& grid,
                                std::span<const ObjectClaim> claims, const VoxelizeOptions& options) {
    SVT_CHECK(claims.size() == scene.objects.size());
    Progress::tell(options.progress, "voxelize", 0);
    const IndexFromLocal indexFromLocal(scene, grid);
    constexpr double kMaxSheetVoxels = 5e8;
    if (const double sheets = estimateSheetVoxels(scene, indexFromLocal); sheets > kMaxSheetVoxels)
        return Error(Code::GridTooLarge,
                     fmt::format("the open surfaces of the model need about {:.2g} voxels, over the limit of {:.2g}; "
                                 "choose a coarser spacing",
                                 sheets, kMaxSheetVoxels));
    const Claims ordered = orderClaims(scene, claims);
    auto geometry = prepareObjects(scene, grid, indexFromLocal, ordered, options);
    if (!geometry) return geometry.error();
    Tiles swept = sweepTiles(*geometry, grid.dimension(), ordered, options);
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while voxelizing");

    VoxelizeResult result;
    result.thinVoxels = std::move(geometry->thinVoxels);
    result.uncertainVoxels = std::move(geometry->uncertainVoxels);
    for (const SharedCount& pair : swept.shared.sums())
        result.overlaps.push_back(
            {ordered.ordered[pair.first].object, ordered.ordered[pair.second].object, pair.voxels});
    std::sort(result.overlaps.begin(), result.overlaps.end(),
              [](const ClaimPair& p, const ClaimPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
    result.columns = keepVanished(ColumnVolume::fromTiles(grid.dimension(), std::move(swept.tiles)), scene, grid,
                                  indexFromLocal, claims, swept.isPresent, result.thinVoxels, options.threads);
    Progress::tell(options.progress, "voxelize", 1);
    return result;
}

}  // namespace svt::voxelize
