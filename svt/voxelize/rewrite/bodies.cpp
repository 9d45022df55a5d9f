#include <svt/voxelize/bodies.hpp>

#include <svt/core/triangle_distance.hpp>
#include <svt/voxelize/rewrite/rewrite.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace svt::voxelize {
namespace {

using volume::ColumnVolume;
using volume::Run;
using volume::Scalar;

struct Face {
    Vec3d a, b, c;          // local space
    std::uint32_t surface;  // index into BodyGroup::surfaces
};

struct PreparedGroup {
    const BodyGroup* source = nullptr;
    std::vector<Face> faces;
};

// An interval of a tile's column, up to `end`, and the surface nearest to it.
struct Piece {
    std::int32_t end;
    std::uint32_t surface;
};

struct Block {
    std::array<std::int32_t, 3> low, size;  // samples
};

// The columns of a tile.
struct TileArea {
    std::int32_t firstColumn, firstRow, width, height;
};

// The lowest sample and one past the highest sample of a group in each column of a tile; low >= high: no sample.
struct SampleRanges {
    std::vector<std::int32_t> low, high;
};

// Splits a tile of one group into pieces per column, bottom up.
class TileSplitter {
public:
    TileSplitter(const PreparedGroup& group, const volume::Grid& grid, Vec3d origin, const TileArea& area,
                 SampleRanges ranges)
        : group_(group),
          grid_(grid),
          origin_(origin),
          firstColumn_(area.firstColumn),
          firstRow_(area.firstRow),
          width_(area.width),
          height_(area.height),
          ranges_(std::move(ranges)),
          pieces_(std::size_t(width_) * std::size_t(height_)),
          spacing_(grid.spacing()) {
        split();
    }

    [[nodiscard]] const BodyGroup& source() const { return *group_.source; }

    [[nodiscard]] const std::vector<Piece>& pieces(std::int32_t i, std::int32_t j) const {
        return pieces_[std::size_t(i - firstColumn_) + std::size_t(width_) * std::size_t(j - firstRow_)];
    }

private:
    void split() {
        std::int32_t bottom = INT32_MAX, top = 0;
        for (std::size_t c = 0; c < ranges_.low.size(); ++c) {
            if (ranges_.low[c] >= ranges_.high[c]) continue;
            bottom = std::min(bottom, ranges_.low[c]);
            top = std::max(top, ranges_.high[c]);
        }
        if (bottom >= top) return;
        std::vector<std::uint32_t> all(group_.faces.size());
        for (std::uint32_t f = 0; f < all.size(); ++f) all[f] = f;
        constexpr std::int32_t kSlab = 64;
        for (std::int32_t z = bottom / kSlab * kSlab; z < top; z += kSlab)
            visit({{0, 0, z}, {kSlab, kSlab, kSlab}}, all);
    }

    [[nodiscard]] bool isNeeded(const Block& block) const {
        for (std::int32_t y = block.low[1]; y < std::min(block.low[1] + block.size[1], height_); ++y)
            for (std::int32_t x = block.low[0]; x < std::min(block.low[0] + block.size[0], width_); ++x) {
                const std::size_t column = std::size_t(x) + std::size_t(width_) * std::size_t(y);
                if (ranges_.low[column] < block.low[2] + block.size[2] && ranges_.high[column] > block.low[2])
                    return true;
            }
        return false;
    }

    void fill(const Block& block, std::uint32_t surface) {
        for (std::int32_t y = block.low[1]; y < std::min(block.low[1] + block.size[1], height_); ++y)
            for (std::int32_t x = block.low[0]; x < std::min(block.low[0] + block.size[0], width_); ++x) {
                auto& column = pieces_[std::size_t(x) + std::size_t(width_) * std::size_t(y)];
                const std::int32_t end = block.low[2] + block.size[2];
                if (!column.empty() && column.back().surface == surface)
                    column.back().end = end;
                else
                    column.push_back({end, surface});
            }
    }

    void visit(const Block& block, const std::vector<std::uint32_t>& candidates) {
        if (block.low[0] >= width_ || block.low[1] >= height_) return;
        if (!isNeeded(block)) {
            fill(block, 0);  // unused samples, filled with any surface so that columns have no gaps
            return;
        }
        const Vec3d center{firstColumn_ + block.low[0] + (block.size[0] - 1) / 2.0,
                           firstRow_ + block.low[1] + (block.size[1] - 1) / 2.0,
                           block.low[2] + (block.size[2] - 1) / 2.0};
        const Vec3d point = grid_.worldFromIndex(center) - origin_;
        const double radius = length(
            scaled(Vec3d{(block.size[0] - 1) / 2.0, (block.size[1] - 1) / 2.0, (block.size[2] - 1) / 2.0}, spacing_));
        double nearest = 1e300, nearestOther = 1e300;
        std::uint32_t best = 0;
        std::vector<double> distances(candidates.size());
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            const Face& face = group_.faces[candidates[c]];
            const double distance = distances[c] = distanceToTriangle(point, face.a, face.b, face.c);
            if (distance < nearest || (distance == nearest && face.surface < best)) {
                if (face.surface != best) nearestOther = nearest;
                nearest = distance;
                best = face.surface;
            } else if (face.surface != best) {
                nearestOther = std::min(nearestOther, distance);
            }
        }
        const bool isVoxel = block.size[0] == 1 && block.size[1] == 1 && block.size[2] == 1;
        if (isVoxel || nearestOther - nearest > 2 * radius) {
            fill(block, best);
            return;
        }
        std::vector<std::uint32_t> kept;
        for (std::size_t c = 0; c < candidates.size(); ++c)
            if (distances[c] <= nearest + 2 * radius) kept.push_back(candidates[c]);
        const std::int32_t half = block.size[0] / 2;
        // Visit lower children first, since columns are filled bottom up.
        for (std::int32_t z = 0; z < 2; ++z)
            for (std::int32_t y = 0; y < 2; ++y)
                for (std::int32_t x = 0; x < 2; ++x)
                    visit({{block.low[0] + x * half, block.low[1] + y * half, block.low[2] + z * half},
                           {half, half, half}},
                          kept);
    }

    const PreparedGroup& group_;
    const volume::Grid& grid_;
    Vec3d origin_;
    std::int32_t firstColumn_, firstRow_, width_, height_;
    SampleRanges ranges_;
    std::vector<std::vector<Piece>> pieces_;
    Vec3d spacing_;
};

// Groups without a face are left out.
std::vector<PreparedGroup> prepareGroups(const std::vector<BodyGroup>& groups, const mesh::MeshSet& meshes) {
    std::vector<PreparedGroup> prepared;
    for (const BodyGroup& source : groups) {
        PreparedGroup group;
        group.source = &source;
        for (std::uint32_t s = 0; s < source.surfaces.size(); ++s) {
            const mesh::ObjectMesh& mesh = meshes.objects[source.surfaces[s]];
            for (const mesh::Triangle& t : mesh.triangles)
                group.faces.push_back(
                    {mesh.vertices[t.corners[0]], mesh.vertices[t.corners[1]], mesh.vertices[t.corners[2]], s});
        }
        if (!group.faces.empty()) prepared.push_back(std::move(group));
    }
    return prepared;
}

// The groups with samples in a tile, in the order of its runs.
std::vector<const PreparedGroup*> groupsIn(const volume::ColumnTile& tile, const std::vector<PreparedGroup>& groups) {
    std::vector<const PreparedGroup*> present;
    for (const Run& run : tile.runs) {
        const auto group = std::find_if(groups.begin(), groups.end(),
                                        [&](const PreparedGroup& known) { return known.source->from == run.scalar; });
        if (group != groups.end() && std::find(present.begin(), present.end(), &*group) == present.end())
            present.push_back(&*group);
    }
    return present;
}

SampleRanges sampleRanges(const ColumnVolume& columns, const TileArea& area, Scalar scalar) {
    SampleRanges ranges;
    ranges.low.resize(std::size_t(area.width) * std::size_t(area.height), INT32_MAX);
    ranges.high.resize(ranges.low.size(), 0);
    for (std::int32_t y = 0; y < area.height; ++y)
        for (std::int32_t x = 0; x < area.width; ++x) {
            const std::size_t c = std::size_t(x) + std::size_t(area.width) * std::size_t(y);
            std::uint32_t begin = 0;
            for (const Run& run : columns.column(area.firstColumn + x, area.firstRow + y)) {
                if (run.scalar == scalar) {
                    ranges.low[c] = std::min(ranges.low[c], static_cast<std::int32_t>(begin));
                    ranges.high[c] = static_cast<std::int32_t>(run.end);
                }
                begin = run.end;
            }
        }
    return ranges;
}

// Appends the samples [begin, end) of column (i, j) with the scalars of the surfaces nearest to them.
void appendPieces(const TileSplitter& splitter, std::int32_t i, std::int32_t j, std::uint32_t begin, std::uint32_t end,
                  std::vector<Run>& out) {
    for (const Piece& piece : splitter.pieces(i, j)) {
        const auto pieceEnd = std::min(static_cast<std::uint32_t>(piece.end), end);
        if (pieceEnd <= begin) continue;
        out.push_back({pieceEnd, splitter.source().scalars[piece.surface]});
        begin = pieceEnd;
        if (begin == end) break;
    }
}

}  // namespace

ColumnVolume assignThematicBodies(const ColumnVolume& columns, const volume::Grid& grid, const mesh::MeshSet& meshes,
                                  const std::vector<BodyGroup>& groups, int threads, const Progress* progress) {
    ProgressCounter counter(progress, "bodies", columns.tiles().size());
    const std::vector<PreparedGroup> prepared = prepareGroups(groups, meshes);
    return rewriteColumns(
        columns,
        [&](std::int32_t tileX, std::int32_t tileY, const volume::ColumnTile& tile) -> ColumnRewriter {
            counter.add();
            const std::vector<const PreparedGroup*> present = groupsIn(tile, prepared);
            if (present.empty()) return {};
            const TileArea area{tileX * ColumnVolume::kTileSize, tileY * ColumnVolume::kTileSize,
                                columns.tileWidth(tileX), columns.tileHeight(tileY)};
            // Shared, because a rewriter can be copied.
            auto splitters = std::make_shared<std::vector<TileSplitter>>();
            splitters->reserve(present.size());
            for (const PreparedGroup* group : present)
                splitters->emplace_back(*group, grid, meshes.origin, area,
                                        sampleRanges(columns, area, group->source->from));
            return [splitters](std::int32_t i, std::int32_t j, std::span<const Run> runs, std::vector<Run>& out) {
                std::uint32_t begin = 0;
                for (const Run& run : runs) {
                    const auto found = std::find_if(
                        splitters->begin(), splitters->end(),
                        [&](const TileSplitter& splitter) { return splitter.source().from == run.scalar; });
                    if (found == splitters->end())
                        out.push_back(run);
                    else
                        appendPieces(*found, i, j, begin, run.end, out);
                    begin = run.end;
                }
            };
        },
        threads);
}

}  // namespace svt::voxelize
