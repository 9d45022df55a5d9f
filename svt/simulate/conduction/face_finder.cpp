#include <svt/simulate/conduction/face_finder.hpp>

#include <algorithm>
#include <utility>

namespace svt::simulate {
namespace {

constexpr std::size_t kMostEntries = std::size_t{1} << 24;  // only a malicious file needs more
constexpr double kReach = 0.75;                             // voxels by which faces may reach beyond their stated box
constexpr double kLeastSlope = 1e-3;

// Calls use(brick) for the bricks next to the faces of a plane that the plane crosses.
template <class Use>
void forBricksOf(const volume::FacePlane& face, Vec3i bricks, const Use& use) {
    Vec3i low, high;
    for (int a = 0; a < 3; ++a) {
        const auto n = static_cast<std::size_t>(a);
        low[a] = std::max(face.min[n] - 1, 0) >> 3;
        high[a] = std::min<std::int32_t>(face.max[n] >> 3, bricks[a] - 1);
    }
    const Vec3d& normal = face.plane.normal;
    const double radius = 5 * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    for (std::int32_t z = low.z; z <= high.z; ++z)
        for (std::int32_t y = low.y; y <= high.y; ++y)
            for (std::int32_t x = low.x; x <= high.x; ++x) {
                const Vec3d centre{8.0 * x + 4, 8.0 * y + 4, 8.0 * z + 4};
                if (std::abs(dot(normal, centre) + face.plane.offset) > radius) continue;
                use(static_cast<std::size_t>(x) +
                    static_cast<std::size_t>(bricks.x) *
                        (static_cast<std::size_t>(y) +
                         static_cast<std::size_t>(bricks.y) * static_cast<std::size_t>(z)));
            }
}

}  // namespace

Result<FaceFinder> FaceFinder::make(const volume::SemanticVolume& volume, int threads, const Progress* progress) {
    FaceFinder finder(volume);
    volume::BrickVolume::Options options;
    options.planes = volume.planes;
    options.threads = threads;
    options.progress = progress;
    SVT_TRY(bricks, volume::BrickVolume::fromColumns(volume.columns, options));
    finder.bricks_ = std::move(*bricks);
    finder.indexPlanes();
    return finder;
}

void FaceFinder::indexPlanes() {
    const Vec3i bricks = bricks_.brickCount();
    const std::size_t count =
        static_cast<std::size_t>(bricks.x) * static_cast<std::size_t>(bricks.y) * static_cast<std::size_t>(bricks.z);
    start_.assign(count + 1, 0);
    std::size_t entries = 0, faces = 0;
    for (; faces < volume_->planes.size() && entries < kMostEntries; ++faces)
        forBricksOf(volume_->planes[faces], bricks, [&](std::size_t brick) {
            ++start_[brick + 1];
            ++entries;
        });
    for (std::size_t b = 0; b < count; ++b) start_[b + 1] += start_[b];
    byBrick_.resize(entries);
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t f = 0; f < faces; ++f)
        forBricksOf(volume_->planes[f], bricks,
                    [&](std::size_t brick) { byBrick_[next[brick]++] = static_cast<std::uint32_t>(f); });
}

FaceCrossing FaceFinder::crossingOf(const volume::BrickPlane& plane, int axis, double at, FaceSource source) const {
    const Vec3d spacing = volume_->grid.spacing();
    Vec3d normal{plane.normal.x / spacing.x, plane.normal.y / spacing.y, plane.normal.z / spacing.z};
    normal = normalized(normal);
    if (normal[axis] < 0) normal = -normal;
    return {at, normal, source};
}

FaceCrossing FaceFinder::findInModel(Vec3i voxel, Vec3i next, int axis, double least, double most) const {
    const Vec3i bricks = bricks_.brickCount();
    const Vec3d start = toDouble(voxel) + Vec3d{0.5, 0.5, 0.5};
    std::uint32_t best = volume::BrickVolume::kNoPlane;
    double bestAt = 0.5;
    const auto look = [&](Vec3i in) {
        const std::size_t brick = static_cast<std::size_t>(in.x >> 3) +
                                  static_cast<std::size_t>(bricks.x) *
                                      (static_cast<std::size_t>(in.y >> 3) +
                                       static_cast<std::size_t>(bricks.y) * static_cast<std::size_t>(in.z >> 3));
        for (std::size_t n = start_[brick]; n < start_[brick + 1] && byBrick_[n] < best; ++n) {
            const volume::FacePlane& face = volume_->planes[byBrick_[n]];
            const double rise = face.plane.normal[axis];
            if (std::abs(rise) < kLeastSlope) continue;
            const double at = -(dot(face.plane.normal, start) + face.plane.offset) / rise;
            if (!(at >= least && at <= most)) continue;
            Vec3d point = start;
            point[axis] += at;
            bool isNear = true;
            for (int a = 0; a < 3; ++a)
                isNear = isNear && point[a] >= face.min[static_cast<std::size_t>(a)] - kReach &&
                         point[a] <= face.max[static_cast<std::size_t>(a)] + kReach;
            if (!isNear) continue;
            best = byBrick_[n];
            bestAt = std::clamp(at, 0.0, 1.0);
        }
    };
    look(voxel);
    if ((voxel[axis] >> 3) != (next[axis] >> 3)) look(next);
    if (best != volume::BrickVolume::kNoPlane)
        return crossingOf(volume_->planes[best].plane, axis, bestAt, FaceSource::Model);
    FaceCrossing face;
    face.normal[axis] = 1;
    return face;
}

}  // namespace svt::simulate
