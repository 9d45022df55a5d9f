#include <svt/voxelize/surfaces/bare_voxels.hpp>

#include <svt/core/parallel.hpp>
#include <svt/core/triangle_distance.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace svt::voxelize {
namespace {

using volume::ColumnTile;
using volume::ColumnVolume;
using volume::Run;
using volume::Scalar;

constexpr std::uint32_t kNoGroup = 0xFFFFFFFFu;

// The number of the body that each scalar belongs to.
struct Groups {
    std::vector<std::uint32_t> groupOf;
    [[nodiscard]] bool isOfBody(Scalar scalar) const noexcept {
        return scalar < groupOf.size() && groupOf[scalar] != kNoGroup;
    }
};

Groups groupScalars(std::span<const BoundedBody> bodies, std::span<const ObjectClaim> claims) {
    Scalar most = 0;
    for (const ObjectClaim& claim : claims) most = std::max(most, claim.scalar);
    Groups groups{std::vector<std::uint32_t>(std::size_t{most} + 1, kNoGroup)};
    for (std::uint32_t g = 0; g < bodies.size(); ++g) groups.groupOf[claims[bodies[g].body].scalar] = g;
    return groups;
}

// A voxel of a body on its outside.
struct BareVoxel {
    std::uint32_t group;
    Vec3i voxel;
    Vec3d point;  // its centre, local space
};

// A column in short: whether its bodies end behind surfaces. Samples from `bodyLow` to below `bodyHigh` contain
// all bodies; those from `coverLow` to below `coverHigh` all objects, if these have no gap, else the range is empty.
struct Summary {
    std::uint32_t bodyLow = 0xFFFFFFFFu, bodyHigh = 0, coverLow = 0xFFFFFFFFu, coverHigh = 0;
    std::uint32_t endsBare = 0;  // 1: a body has no object above or below it
};

// The summaries of the columns of a row, and of one column beside it on each side (at 0 and width + 1).
struct RowSummaries {
    static constexpr std::size_t kSize = ColumnVolume::kTileSize + 2;
    std::array<std::uint32_t, kSize> bodyLow, bodyHigh, coverLow, coverHigh, endsBare;

    void set(std::size_t place, const Summary& summary) noexcept {
        bodyLow[place] = summary.bodyLow;
        bodyHigh[place] = summary.bodyHigh;
        coverLow[place] = summary.coverLow;
        coverHigh[place] = summary.coverHigh;
        endsBare[place] = summary.endsBare;
    }
};

Summary summarize(const Groups& groups, std::span<const Run> runs) {
    Summary summary;
    std::uint32_t begin = 0, covers = 0;
    bool isLastBody = false, isLastBare = true;
    for (const Run& run : runs) {
        const bool isBare = run.scalar == 0, isBody = groups.isOfBody(run.scalar);
        if ((isBody && isLastBare) || (isBare && isLastBody)) summary.endsBare = 1;
        if (isBody) {
            summary.bodyLow = std::min(summary.bodyLow, begin);
            summary.bodyHigh = run.end;
        }
        if (!isBare) {
            if (isLastBare) ++covers;
            summary.coverLow = std::min(summary.coverLow, begin);
            summary.coverHigh = run.end;
        }
        isLastBody = isBody;
        isLastBare = isBare;
        begin = run.end;
    }
    if (isLastBody) summary.endsBare = 1;
    if (covers != 1) {
        summary.coverLow = 0xFFFFFFFFu;
        summary.coverHigh = 0;
    }
    return summary;
}

// Appends the samples of [begin, end) that are background in a column, or all outside of the grid.
void addBackground(std::span<const Run> column, std::uint32_t begin, std::uint32_t end,
                   std::vector<std::uint32_t>& samples) {
    std::uint32_t low = 0;
    for (const Run& run : column) {
        if (run.scalar == 0)
            for (std::uint32_t k = std::max(low, begin); k < std::min(run.end, end); ++k) samples.push_back(k);
        low = run.end;
    }
    for (std::uint32_t k = std::max(low, begin); k < end; ++k) samples.push_back(k);
}

// Finds the bare voxels of a tile.
class TileScan {
public:
    TileScan(const ColumnVolume& columns, const Groups& groups, std::size_t tile)
        : columns_(columns),
          groups_(groups),
          tile_(columns.tiles()[tile]),
          tileX_(static_cast<std::int32_t>(tile % std::size_t(columns.tilesX()))),
          tileY_(static_cast<std::int32_t>(tile / std::size_t(columns.tilesX()))),
          width_(columns.tileWidth(tileX_)),
          height_(columns.tileHeight(tileY_)) {}

    // Calls `body(voxel, group)` for each, by row, column and height.
    template <class Body>
    void forEach(Body&& body) {
        const bool hasBody = std::any_of(tile_.runs.begin(), tile_.runs.end(),
                                         [&](const Run& run) { return groups_.isOfBody(run.scalar); });
        if (!hasBody) return;
        for (std::size_t c = 0; c + 1 < tile_.columnStart.size(); ++c)
            summaries_.push_back(summarize(groups_, tile_.column(static_cast<std::uint32_t>(c))));
        RowSummaries rows[3] = {};
        RowSummaries *below = &rows[0], *row = &rows[1], *above = &rows[2];
        fillRow(-1, *below);
        fillRow(0, *row);
        for (std::int32_t y = 0; y < height_; ++y) {
            fillRow(y + 1, *above);
            if (findBare(*below, *row, *above))
                for (std::int32_t x = 0; x < width_; ++x)
                    if (isBare_[std::size_t(x)] != 0) scanColumn(x, y, body);
            RowSummaries* const done = std::exchange(below, std::exchange(row, above));
            above = done;
        }
    }

private:
    [[nodiscard]] std::uint32_t numberOf(std::int32_t x, std::int32_t y) const {
        return tile_.rowColumns[std::size_t(tile_.rowOf[std::size_t(y)]) * std::size_t(width_) + std::size_t(x)];
    }
    // Runs of a column of this tile or beside it; none outside of the grid.
    [[nodiscard]] std::span<const Run> runsOf(std::int32_t x, std::int32_t y) const {
        const std::int32_t i = tileX_ * ColumnVolume::kTileSize + x, j = tileY_ * ColumnVolume::kTileSize + y;
        if (i < 0 || j < 0 || i >= columns_.dimension().x || j >= columns_.dimension().y) return {};
        return columns_.column(i, j);
    }
    // The summary of a column beside this tile. Neighbouring columns often share their runs.
    const Summary& summaryBeside(std::int32_t x, std::int32_t y) {
        const std::span<const Run> runs = runsOf(x, y);
        if (runs.data() != lastRuns_ || runs.empty()) last_ = summarize(groups_, runs);
        lastRuns_ = runs.data();
        return last_;
    }
    void fillRow(std::int32_t y, RowSummaries& row) {
        const bool isInside = y >= 0 && y < height_;
        for (std::int32_t x = 0; x < width_; ++x)
            row.set(std::size_t(x) + 1, isInside ? summaries_[numberOf(x, y)] : summaryBeside(x, y));
        if (!isInside) return;
        for (const std::int32_t x : {-1, width_})
            if (row.bodyHigh[std::size_t(x < 0 ? 1 : width_)] != 0) row.set(std::size_t(x + 1), summaryBeside(x, y));
    }
    // Finds the columns of a row that may have bare voxels. \return whether there is one
    bool findBare(const RowSummaries& below, const RowSummaries& row, const RowSummaries& above) {
        std::uint32_t any = 0;
        for (std::size_t x = 1; x <= std::size_t(width_); ++x) {
            const std::uint32_t low = row.bodyLow[x], high = row.bodyHigh[x];
            const std::uint32_t coverLow =
                std::max({row.coverLow[x - 1], row.coverLow[x + 1], below.coverLow[x], above.coverLow[x]});
            const std::uint32_t coverHigh =
                std::min({row.coverHigh[x - 1], row.coverHigh[x + 1], below.coverHigh[x], above.coverHigh[x]});
            isBare_[x - 1] = row.endsBare[x] | std::uint32_t(high != 0 && (low < coverLow || high > coverHigh));
            any |= isBare_[x - 1];
        }
        return any != 0;
    }

    template <class Body>
    void scanColumn(std::int32_t x, std::int32_t y, Body&& body) {
        std::uint32_t begin = 0;
        const std::span<const Run> runs = runsOf(x, y);
        for (std::size_t r = 0; r < runs.size(); begin = runs[r++].end) {
            if (!groups_.isOfBody(runs[r].scalar)) continue;
            samples_.clear();
            if (r == 0 || runs[r - 1].scalar == 0) samples_.push_back(begin);
            if (r + 1 == runs.size() || runs[r + 1].scalar == 0) samples_.push_back(runs[r].end - 1);
            for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}})
                addBackground(runsOf(x + dx, y + dy), begin, runs[r].end, samples_);
            std::ranges::sort(samples_);
            samples_.erase(std::unique(samples_.begin(), samples_.end()), samples_.end());
            for (const std::uint32_t k : samples_)
                body(Vec3i{tileX_ * ColumnVolume::kTileSize + x, tileY_ * ColumnVolume::kTileSize + y,
                           static_cast<std::int32_t>(k)},
                     groups_.groupOf[runs[r].scalar]);
        }
    }

    const ColumnVolume& columns_;
    const Groups& groups_;
    ColumnTile tile_;
    std::int32_t tileX_, tileY_, width_, height_;
    std::vector<Summary> summaries_;  // per distinct column
    const Run* lastRuns_ = nullptr;
    Summary last_;
    std::array<std::uint32_t, ColumnVolume::kTileSize> isBare_{};
    std::vector<std::uint32_t> samples_;
};

// A face of a surface.
struct NearFace {
    std::array<Vec3d, 3> corners;  // local space
    Box3d box;                     // of the points within reach
    std::uint32_t surface;         // object index
};

// Finds the surfaces nearest to the bare voxels of one body. Halves the set of voxels until few faces are close to it.
class NearestSurfaces {
public:
    NearestSurfaces(const BoundedBody& body, std::span<const mesh::ObjectMesh> faces,
                    std::span<const ObjectClaim> claims, double reach)
        : claims_(claims), reach_(reach) {
        for (const std::uint32_t surface : body.surfaces)
            for (const mesh::Triangle& triangle : faces[surface].triangles) {
                NearFace face;
                for (std::size_t c = 0; c < 3; ++c) {
                    face.corners[c] = faces[surface].vertices[triangle.corners[c]];
                    face.box.add(face.corners[c]);
                }
                face.box.min = face.box.min - Vec3d{reach, reach, reach};
                face.box.max = face.box.max + Vec3d{reach, reach, reach};
                face.surface = surface;
                faces_.push_back(face);
            }
    }

    // Appends the edits of the voxels that have a face within reach; reorders the voxels.
    void assign(std::span<BareVoxel> voxels, std::vector<VoxelEdit>& edits) const {
        std::vector<const NearFace*> all;
        all.reserve(faces_.size());
        for (const NearFace& face : faces_) all.push_back(&face);
        divide(voxels, all, edits);
    }

private:
    void divide(std::span<BareVoxel> voxels, std::span<const NearFace* const> candidates,
                std::vector<VoxelEdit>& edits) const {
        constexpr std::size_t kFewFaces = 8, kFewVoxels = 4;
        Box3d box;
        for (const BareVoxel& voxel : voxels) box.add(voxel.point);
        std::vector<const NearFace*> close;
        for (const NearFace* const face : candidates)
            if (face->box.overlaps(box)) close.push_back(face);
        if (close.empty()) return;
        if (close.size() <= kFewFaces || voxels.size() <= kFewVoxels) {
            for (const BareVoxel& voxel : voxels) assignOne(voxel, close, edits);
            return;
        }
        const Vec3d size = box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto half = voxels.begin() + std::ptrdiff_t(voxels.size() / 2);
        std::nth_element(voxels.begin(), half, voxels.end(),
                         [axis](const BareVoxel& p, const BareVoxel& q) { return p.point[axis] < q.point[axis]; });
        divide(voxels.first(voxels.size() / 2), close, edits);
        divide(voxels.subspan(voxels.size() / 2), close, edits);
    }

    void assignOne(const BareVoxel& voxel, std::span<const NearFace* const> faces,
                   std::vector<VoxelEdit>& edits) const {
        double nearest = reach_;
        std::uint32_t surface = kNoBody;
        for (const NearFace* const face : faces) {
            if (!face->box.contains(voxel.point)) continue;
            const double distance =
                distanceToTriangle(voxel.point, face->corners[0], face->corners[1], face->corners[2]);
            if (distance > nearest || (distance == nearest && face->surface >= surface)) continue;
            nearest = distance;
            surface = face->surface;
        }
        if (surface != kNoBody) edits.push_back({voxel.voxel, claims_[surface].scalar});
    }

    std::span<const ObjectClaim> claims_;
    double reach_;
    std::vector<NearFace> faces_;
};

}  // namespace

std::vector<VoxelEdit> findBareVoxels(const ColumnVolume& columns, const volume::Grid& grid, Vec3d origin,
                                      std::span<const BoundedBody> bodies, std::span<const mesh::ObjectMesh> faces,
                                      std::span<const ObjectClaim> claims, int threads) {
    if (bodies.empty()) return {};
    const Groups groups = groupScalars(bodies, claims);
    std::vector<std::vector<BareVoxel>> found(columns.tiles().size());
    parallelFor(found.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            TileScan scan(columns, groups, t);
            scan.forEach([&](const Vec3i& v, std::uint32_t group) {
                found[t].push_back({group, v, grid.worldFromIndex({double(v.x), double(v.y), double(v.z)}) - origin});
            });
        }
    });
    std::vector<std::vector<BareVoxel>> ofGroup(bodies.size());
    for (const std::vector<BareVoxel>& tile : found)
        for (const BareVoxel& voxel : tile) ofGroup[voxel.group].push_back(voxel);
    const Vec3d spacing = grid.spacing();
    const double reach = kBareReach * std::max({spacing.x, spacing.y, spacing.z});
    std::vector<std::vector<VoxelEdit>> edits(bodies.size());
    parallelFor(bodies.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t g = begin; g < end; ++g)
            if (!ofGroup[g].empty()) NearestSurfaces(bodies[g], faces, claims, reach).assign(ofGroup[g], edits[g]);
    });
    std::vector<VoxelEdit> all;
    for (const std::vector<VoxelEdit>& ofBody : edits) all.insert(all.end(), ofBody.begin(), ofBody.end());
    return all;
}

}  // namespace svt::voxelize
