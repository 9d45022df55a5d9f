#include <svt/voxelize/voxelize.hpp>

#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>
#include <svt/voxelize/rewrite.hpp>
#include <svt/voxelize/sheets.hpp>
#include <svt/voxelize/tile_columns.hpp>
#include <svt/voxelize/winding.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>

namespace svt::voxelize {
namespace {

using volume::ColumnVolume;

// Every object claims twice: as a solid, and with its thin parts or as a sheet.
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
    // The finer component first; at equal rank what is truly inside before what is only near, then the smaller, then
    // the id.
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

// Numbers of what touches each tile, tile after tile, in ascending order within one.
struct TileBins {
    std::vector<std::uint32_t> first, items;
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t tile) const {
        return std::span(items).subspan(first[tile], first[tile + 1] - first[tile]);
    }
};

// `rangeOf(n, tx0, tx1, ty0, ty1)` gives the half-open range of tiles of item n, `touches(n, tx, ty)` has the last
// word.
template <class RangeOf, class Touches>
TileBins fillBins(std::size_t count, std::int32_t tilesX, std::int32_t tilesY, int threads, RangeOf&& rangeOf,
                  Touches&& touches) {
    struct Entry {
        std::uint32_t tile, item;
    };
    constexpr std::size_t kPart = 1024;
    std::vector<std::vector<Entry>> parts((count + kPart - 1) / kPart);
    parallelFor(parts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) {
            const std::size_t last = std::min(count, (part + 1) * kPart);
            parts[part].reserve(2 * kPart);
            for (auto n = static_cast<std::uint32_t>(part * kPart); n < last; ++n) {
                std::int32_t x0, x1, y0, y1;
                rangeOf(n, x0, x1, y0, y1);
                const bool isBlock = x1 - x0 > 1 && y1 - y0 > 1;
                for (std::int32_t y = y0; y < y1; ++y)
                    for (std::int32_t x = x0; x < x1; ++x)
                        if (!isBlock || touches(n, x, y))
                            parts[part].push_back({static_cast<std::uint32_t>(x + tilesX * y), n});
            }
        }
    });
    TileBins bins;
    bins.first.assign(std::size_t(tilesX) * std::size_t(tilesY) + 1, 0);
    for (const auto& part : parts)
        for (const Entry& entry : part) ++bins.first[entry.tile + 1];
    std::partial_sum(bins.first.begin(), bins.first.end(), bins.first.begin());
    bins.items.resize(bins.first.back());
    std::vector<std::uint32_t> next(bins.first.begin(), bins.first.end() - 1);
    for (const auto& part : parts)
        for (const Entry& entry : part) bins.items[next[entry.tile]++] = entry.item;
    return bins;
}

void tileRange(std::int32_t first, std::int32_t end, std::int32_t dimension, std::int32_t& tileFirst,
               std::int32_t& tileEnd) {
    first = std::clamp(first, 0, dimension);
    end = std::clamp(end, 0, dimension);
    tileFirst = first / ColumnVolume::kTileSize;
    tileEnd = first < end ? (end - 1) / ColumnVolume::kTileSize + 1 : tileFirst;
}

// What one object brings to the sweep.
struct Prepared {
    IndexMesh index;
    FaceList faces;
    LevelTable ownLevels;
    std::vector<ClaimedBox> boxes;
    std::uint64_t thinVoxels = 0;
    std::uint64_t uncertainVoxels = 0;
};

void prepareObject(const mesh::MeshScene& scene, const volume::Grid& grid, const IndexFromLocal& indexFromLocal,
                   std::span<const std::uint32_t> planeLevels, const Claims& claims, const VoxelizeOptions& options,
                   std::uint32_t object, Prepared& out) {
    const mesh::ObjectMesh& mesh = scene.objects[object];
    out.index = makeIndexMesh(mesh, indexFromLocal);
    if (mesh.closure == mesh::Closure::Surface) {
        const auto addSheet = options.sheets == SheetMode::Thin ? addThinSheet : addConservativeSheet;
        addSheet(out.index, grid.dimension(), claims.thinOrder[object], out.boxes);
        return;
    }
    if (!mesh.isSolid()) return;  // open: filled by winding number, all cores on one object
    const Vec3i dimension = grid.dimension();
    out.faces = makeFaces(out.index, planeLevels, dimension, claims.solidOrder[object], out.ownLevels);
    if (options.keepThinParts)
        out.thinVoxels = addThinParts(out.index, indexFromLocal, dimension, claims.thinOrder[object], out.boxes);
    out.index = {};
}

// Voxels of all sheets, estimated by their area: what the pass for them keeps in memory grows with it.
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

// Objects that lost every voxel get the one nearest to the middle of their first face, if no other object lives by it
// alone.
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

// Everything of all objects, in object order.
struct Geometry {
    LevelTable levels;
    FaceList faces;
    std::vector<ClaimedBox> boxes;
    std::vector<std::uint64_t> thinVoxels, uncertainVoxels;  // per object
};

// All objects' parts, in object order; levels of their own are numbered anew.
void join(std::vector<Prepared>& prepared, Geometry& all) {
    std::size_t faceCount = 0, triangleCount = 0, boxCount = 0;
    for (const Prepared& object : prepared) {
        faceCount += object.faces.faces.size();
        triangleCount += object.faces.triangles.size();
        boxCount += object.boxes.size();
    }
    all.faces.faces.reserve(faceCount);
    all.faces.triangles.reserve(triangleCount);
    all.boxes.reserve(boxCount);
    for (Prepared& object : prepared) {
        const auto firstFace = static_cast<std::uint32_t>(all.faces.faces.size());
        const std::uint32_t firstLevel = all.levels.next();
        for (Boundary face : object.faces.faces) {
            if (face.level >= object.ownLevels.first) face.level += firstLevel - object.ownLevels.first;
            all.faces.faces.push_back(face);
        }
        for (FaceTriangle triangle : object.faces.triangles) {
            triangle.face += firstFace;
            all.faces.triangles.push_back(triangle);
        }
        const auto& own = object.ownLevels.sloped;
        all.levels.sloped.insert(all.levels.sloped.end(), own.begin(), own.end());
        all.boxes.insert(all.boxes.end(), object.boxes.begin(), object.boxes.end());
        all.thinVoxels.push_back(object.thinVoxels);
        all.uncertainVoxels.push_back(object.uncertainVoxels);
        object = {};
    }
}

Result<Geometry> prepareObjects(const mesh::MeshScene& scene, const volume::Grid& grid,
                                const IndexFromLocal& indexFromLocal, const Claims& claims,
                                const VoxelizeOptions& options) {
    Geometry all;
    all.levels.depth = grid.dimension().z;
    all.levels.first = static_cast<std::uint32_t>(grid.dimension().z) + 1;
    std::vector<std::uint32_t> planeLevels;
    if (indexFromLocal.keepsVertical()) {
        std::vector<std::optional<Level>> levels(scene.planes.size());
        parallelFor(levels.size(), 256, options.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const mesh::Plane plane = indexFromLocal.plane(scene.planes[n]);
                if (isScanPlane(plane)) levels[n].emplace(planeHeight(plane), grid.dimension().z);
            }
        });
        planeLevels.reserve(levels.size());
        for (const auto& level : levels) planeLevels.push_back(level ? all.levels.add(*level) : kNoLevel);
    }
    std::vector<Prepared> prepared(scene.objects.size());
    parallelFor(scene.objects.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t o = begin; o < end; ++o) {
            prepared[o].ownLevels.depth = all.levels.depth;
            prepared[o].ownLevels.first = all.levels.next();
            prepareObject(scene, grid, indexFromLocal, planeLevels, claims, options, static_cast<std::uint32_t>(o),
                          prepared[o]);
        }
    });
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        if (scene.objects[o].closure != mesh::Closure::Open) continue;
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while voxelizing");
        prepared[o].uncertainVoxels =
            addWindingFill(prepared[o].index, scene, grid, claims.solidOrder[o], options.threads, prepared[o].boxes);
    }
    join(prepared, all);
    return all;
}

// Tells the progress from whichever thread is free to.
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

// Tile makers with their buffers, lent from task to task.
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
    // What all makers counted.
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
    // Per scalar: some maker met it.
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
    const auto& triangles = geometry.faces.triangles;
    const auto& boxes = geometry.boxes;
    constexpr std::int32_t kTile = ColumnVolume::kTileSize;
    const TileBins triangleBins = fillBins(
        triangles.size(), tilesX, tilesY, options.threads,
        [&](std::uint32_t n, auto& x0, auto& x1, auto& y0, auto& y1) {
            tileRange(triangles[n].firstColumn, triangles[n].endColumn, dimension.x, x0, x1);
            tileRange(triangles[n].firstRow, triangles[n].endRow, dimension.y, y0, y1);
        },
        [&](std::uint32_t n, std::int32_t x, std::int32_t y) {
            return touchesSamples(triangles[n], geometry.faces.faces[triangles[n].face].isEntry, x * kTile, y * kTile,
                                  kTile, kTile);
        });
    const TileBins boxBins = fillBins(
        boxes.size(), tilesX, tilesY, options.threads,
        [&](std::uint32_t n, auto& x0, auto& x1, auto& y0, auto& y1) {
            tileRange(boxes[n].begin, boxes[n].end, dimension.x, x0, x1);
            tileRange(boxes[n].firstRow, boxes[n].endRow, dimension.y, y0, y1);
        },
        [](std::uint32_t, std::int32_t, std::int32_t) { return true; });

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
            input.faces = geometry.faces.faces;
            input.triangles = triangles;
            input.triangleIndices = triangleBins.of(tile);
            input.boxes = boxes;
            input.boxIndices = boxBins.of(tile);
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
    constexpr double kMostSheetVoxels = 5e8;
    if (const double sheets = estimateSheetVoxels(scene, indexFromLocal); sheets > kMostSheetVoxels)
        return Error(Code::GridTooLarge,
                     fmt::format("the open surfaces of the model need about {:.2g} voxels, over the limit of {:.2g}; "
                                 "choose a coarser spacing",
                                 sheets, kMostSheetVoxels));
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
