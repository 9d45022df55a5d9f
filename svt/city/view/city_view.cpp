#include <svt/city/city_view.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/city/join/join_volumes.hpp>
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>

namespace svt::city {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A building may stand over the border of its tile by half its length.
constexpr double kOverhang = 30;
constexpr double kMostPixels = 256;

struct Square {
    double west, south, east, north;
};

double sideOf(const City& city, const IndexEntry& entry) { return tileSide(entry.tile, entry.detail, city.spacing()); }
double voxelOf(const City& city, int detail) { return spacingOf(detail, city.spacing()).x; }

Square squareOf(const City& city, const IndexEntry& entry) {
    const double side = sideOf(city, entry);
    return {entry.tile.x * side, entry.tile.y * side, (entry.tile.x + 1) * side, (entry.tile.y + 1) * side};
}

bool overlap(const Square& a, const Square& b) {
    constexpr double kSlack = 1e-6;
    return a.west < b.east - kSlack && b.west < a.east - kSlack && a.south < b.north - kSlack &&
           b.south < a.north - kSlack;
}

class Chooser {
public:
    Chooser(const City& city, const CameraView& view, int finest, double pixels)
        : city_(city), view_(view), finest_(finest), pixels_(pixels) {}

    Result<ChosenTiles> run() {
        ChosenTiles chosen;
        chosen.pixels = pixels_;
        Result<std::vector<IndexEntry>> open(std::vector<IndexEntry>{city_.top()});
        if (!isNeeded(city_.top())) return chosen;
        for (int detail = city_.topDetail(); !open->empty(); --detail) {
            std::vector<IndexEntry> fine;
            for (const IndexEntry& entry : *open)
                if (detail > finest_ && isTooCoarse(entry))
                    fine.push_back(entry);
                else
                    take(entry, chosen);
            open = below(fine);
            if (!open) return open.error();
        }
        std::sort(chosen.entries.begin(), chosen.entries.end(), [](const IndexEntry& a, const IndexEntry& b) {
            return std::tuple(-a.detail, mortonOf(a.tile), a.tile.level) <
                   std::tuple(-b.detail, mortonOf(b.tile), b.tile.level);
        });
        return chosen;
    }

private:
    static void take(const IndexEntry& entry, ChosenTiles& chosen) {
        chosen.entries.push_back(entry);
        chosen.bytes += entry.size;
    }

    // The tiles of the next finer detail that take the place of `entries`, and are needed.
    Result<std::vector<IndexEntry>> below(const std::vector<IndexEntry>& entries) const {
        std::vector<IndexEntry> found;
        if (entries.empty()) return found;
        std::array<double, 4> around{kInfinity, kInfinity, -kInfinity, -kInfinity};
        std::vector<Square> squares;
        for (const IndexEntry& entry : entries) {
            Square square = squareOf(city_, entry);
            // The tile that holds all may reach over its square.
            if (entry.detail == city_.topDetail()) {
                const Box3d& all = city_.box();
                square = {all.min.x - 1, all.min.y - 1, all.max.x + 1, all.max.y + 1};
            }
            squares.push_back(square);
            around = {std::min(around[0], square.west), std::min(around[1], square.south),
                      std::max(around[2], square.east), std::max(around[3], square.north)};
        }
        std::sort(squares.begin(), squares.end(), [](const Square& a, const Square& b) {
            return std::tie(a.south, a.west) < std::tie(b.south, b.west);
        });
        auto finer = city_.find(entries.front().detail - 1, around);
        if (!finer) return finer;
        for (const IndexEntry& entry : *finer)
            if (isNeeded(entry) && meetsAny(squareOf(city_, entry), squares)) found.push_back(entry);
        return found;
    }

    // \param squares  ordered by south
    static bool meetsAny(const Square& square, const std::vector<Square>& squares) {
        if (squares.empty()) return false;
        const double side = squares.front().north - squares.front().south;
        const auto first = std::partition_point(squares.begin(), squares.end(), [&](const Square& other) {
            return other.south < square.south - std::max(side, other.north - other.south) - 1;
        });
        for (auto other = first; other != squares.end() && other->south < square.north; ++other)
            if (overlap(square, *other)) return true;
        return false;
    }

    Box3d boxOf(const IndexEntry& entry) const {
        const Square square = squareOf(city_, entry);
        const double around = kOverhang + voxelOf(city_, entry.detail);
        Box3d box{{square.west - around, square.south - around, double(entry.lowest)},
                  {square.east + around, square.north + around, double(entry.highest)}};
        if (entry.detail == city_.topDetail()) box = city_.box();
        return box;
    }

    // Whether some of a box is in the picture, or the shadow that it may throw upon the lowest ground.
    bool isNeeded(const IndexEntry& entry) const {
        Box3d box = boxOf(entry);
        const Vec3d light = view_.towardsLight;
        if (light.z > 0) {
            constexpr double kMostShadow = 2000;
            const double height = std::max(0.0, box.max.z - city_.box().min.z);
            const double reach = std::min(height / light.z, kMostShadow);
            for (int corner = 0; corner < 4; ++corner) {
                const Vec3d at{(corner & 1) != 0 ? box.min.x : box.max.x, (corner & 2) != 0 ? box.min.y : box.max.y,
                               box.max.z};
                box.add(at - light * reach);
            }
        }
        return isSeen(box);
    }

    // Whether no plane of the picture's frustum has all of a box at its outer side.
    bool isSeen(const Box3d& box) const {
        std::array<int, 5> outside{};
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3d from =
                Vec3d{(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                      (corner & 4) != 0 ? box.max.z : box.min.z} -
                view_.eye;
            const double depth = dot(from, view_.forward), scale = view_.isPerspective ? depth : 1;
            const double x = dot(from, view_.right), y = dot(from, view_.up);
            outside[0] += depth < 0;
            outside[1] += x > view_.halfWidth * scale;
            outside[2] += x < -view_.halfWidth * scale;
            outside[3] += y > view_.halfHeight * scale;
            outside[4] += y < -view_.halfHeight * scale;
        }
        return std::find(outside.begin(), outside.end(), 8) == outside.end();
    }

    bool isTooCoarse(const IndexEntry& entry) const {
        double pixel = view_.pixel;
        if (view_.isPerspective) {
            // The point of the box that is nearest to the eye; not that of least depth, which may be aside.
            const Box3d box = boxOf(entry);
            Vec3d nearest;
            for (int axis = 0; axis < 3; ++axis)
                nearest[axis] = std::clamp(view_.eye[axis], box.min[axis], box.max[axis]);
            pixel *= length(nearest - view_.eye);
        }
        return voxelOf(city_, entry.detail) > pixel * pixels_;
    }

    const City& city_;
    const CameraView& view_;
    int finest_;
    double pixels_;
};

}  // namespace

Result<ChosenTiles> chooseTiles(const City& city, const CameraView& view, std::uint64_t memoryBytes, int finest) {
    for (double pixels = 1;; pixels *= std::sqrt(2.0)) {
        auto chosen = Chooser(city, view, finest, pixels).run();
        if (!chosen || chosen->bytes <= memoryBytes / kBytesAByte || pixels > kMostPixels) return chosen;
    }
}

Result<std::vector<volume::SemanticVolume>> readTiles(const City& city, const ChosenTiles& chosen, int threads,
                                                      const Progress* progress) {
    const std::vector<IndexEntry>& entries = chosen.entries;
    std::vector<std::optional<volume::SemanticVolume>> read(entries.size());
    std::mutex mutex;
    std::optional<Error> failed;
    std::atomic<bool> isOver{false};
    ProgressCounter counter(progress, "read", entries.size());
    parallelFor(entries.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end && !isOver; ++n) {
            auto volume = city.read(entries[n]);
            if (volume) {
                read[n].emplace(std::move(*volume));
            } else {
                const std::lock_guard lock(mutex);
                isOver = true;
                if (!failed) failed = volume.error();
            }
            if (Progress::isCancelled(progress)) isOver = true;
            counter.add();
        }
    });
    if (failed) return *failed;
    if (isOver) return Error(Code::Cancelled, "stopped while reading tiles");
    std::vector<volume::SemanticVolume> joined;
    for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
        std::vector<volume::SemanticVolume> parts;
        for (; end < entries.size() && entries[end].detail == entries[begin].detail; ++end)
            parts.push_back(std::move(*read[end]));
        if (parts.size() == 1) {
            joined.push_back(std::move(parts.front()));
            continue;
        }
        auto volume = joinVolumes(parts, entries[begin].detail >= kFirstClassDetail);
        if (!volume) return volume.error();
        joined.push_back(std::move(*volume));
    }
    return joined;
}

Result<volume::SemanticVolume> frameVolume(const City& city) {
    const Box3d& box = city.box();
    // So many that a camera which is fitted to its voxels fits the city.
    constexpr Vec3i kSamples{129, 129, 33};
    Vec3d spacing = box.max - box.min;
    for (int axis = 0; axis < 3; ++axis) spacing[axis] = std::max(spacing[axis] / (kSamples[axis] - 1), 1e-3);
    volume::SemanticVolume frame;
    const auto grid =
        volume::Grid::fromParts(kSamples, spacing, box.min, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    if (!grid) return grid.error();
    frame.grid = *grid;
    std::vector<volume::Scalar> nothing(std::size_t{129} * 129 * 33, 0);
    frame.columns = volume::ColumnVolume::fromDense(kSamples, nothing);
    frame.crsName = city.crsName();
    return frame;
}

Result<std::vector<IndexEntry>> allTiles(const City& city, int detail) {
    return city.find(detail, {-kInfinity, -kInfinity, kInfinity, kInfinity});
}

}  // namespace svt::city
