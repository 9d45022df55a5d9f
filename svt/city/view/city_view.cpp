#include <svt/city/city_view.hpp>

#include <svt/city/city_levels.hpp>
#include <svt/city/join/join_volumes.hpp>
#include <svt/core/parallel.hpp>
#include <svt/core/text.hpp>
#include <svt/render/camera_rays.hpp>

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
// In cities of version 1: a building may stand over the border of its tile by half its length.
constexpr double kOverhang = 30;
constexpr double kMostPixels = 256;

double voxelOf(const City& city, int detail) { return spacingOf(detail, city.spacing()).x; }

// The box of an entry's samples.
Box3d boxOf(const City& city, const IndexEntry& entry) {
    if (entry.detail == city.topDetail()) return city.box();
    const double low = entry.lowest, high = entry.highest;
    const auto& [west, south, east, north] = entry.rectangle;
    if (entry.hasRectangle()) return {{double(west), double(south), low}, {double(east), double(north), high}};
    const double side = tileSide(entry.tile, entry.detail, city.spacing());
    const double around = kOverhang + voxelOf(city, entry.detail);
    return {{entry.tile.x * side - around, entry.tile.y * side - around, low},
            {(entry.tile.x + 1) * side + around, (entry.tile.y + 1) * side + around, high}};
}

// The box of an entry with the shadow that it may cast on the lowest ground.
Box3d boxWithShadow(const City& city, const CameraView& view, const IndexEntry& entry) {
    Box3d box = boxOf(city, entry);
    const Vec3d light = view.towardsLight;
    if (light.z <= 0) return box;
    constexpr double kMostShadow = 2000;
    const double height = std::max(0.0, box.max.z - city.box().min.z);
    const double reach = std::min(height / light.z, kMostShadow);
    const Box3d own = box;
    for (int corner = 0; corner < 4; ++corner) {
        const Vec3d at{(corner & 1) != 0 ? own.min.x : own.max.x, (corner & 2) != 0 ? own.min.y : own.max.y, own.max.z};
        box.add(at - light * reach);
    }
    return box;
}

Vec3d cornerOf(const Box3d& box, int corner) {
    return {(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
            (corner & 4) != 0 ? box.max.z : box.min.z};
}

double distanceFrom(Vec3d eye, const Box3d& box) {
    Vec3d nearest;
    for (int axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(eye[axis], box.min[axis], box.max[axis]);
    return length(nearest - eye);
}

// Width in pixels of a voxel of an entry at its distance from the eye. The distance counts, not the depth, which can be
// smaller at the side of the view.
double pixelsOf(const City& city, const CameraView& view, const IndexEntry& entry) {
    const double pixel = view.isPerspective ? view.pixel * distanceFrom(view.eye, boxOf(city, entry)) : view.pixel;
    return voxelOf(city, entry.detail) / std::max(pixel, 1e-12);
}

void sortEntries(const City& city, const CameraView& view, ChosenTiles& chosen) {
    std::vector<IndexEntry>& entries = chosen.entries;
    int finest = std::numeric_limits<int>::max();
    for (const IndexEntry& entry : entries) finest = std::min(finest, entry.detail);
    const auto isNear = [&](const IndexEntry& entry) {
        return entry.detail == finest && pixelsOf(city, view, entry) > kNearPixels;
    };
    std::sort(entries.begin(), entries.end(), [](const IndexEntry& a, const IndexEntry& b) {
        return std::tuple(-a.detail, mortonOf(a.tile), a.tile.level) <
               std::tuple(-b.detail, mortonOf(b.tile), b.tile.level);
    });
    const auto near = std::stable_partition(entries.begin(), entries.end(), [&](const auto& e) { return !isNear(e); });
    chosen.near = static_cast<std::size_t>(entries.end() - near);
    chosen.bytes = 0;
    for (const IndexEntry& entry : entries) chosen.bytes += entry.size;
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
                    chosen.entries.push_back(entry);
            open = below(fine);
            if (!open) return open.error();
        }
        sortEntries(city_, view_, chosen);
        return chosen;
    }

private:
    // The needed tiles of the next finer detail that replace `entries`: those that belong to them, so that each
    // building is drawn once, and complete.
    Result<std::vector<IndexEntry>> below(const std::vector<IndexEntry>& entries) const {
        std::vector<IndexEntry> found;
        if (entries.empty()) return found;
        std::array<double, 4> around{kInfinity, kInfinity, -kInfinity, -kInfinity};
        std::set<std::tuple<int, std::int32_t, std::int32_t>> tiles;
        for (const IndexEntry& entry : entries) {
            const Box3d box = boxOf(city_, entry);
            tiles.emplace(entry.tile.level, entry.tile.x, entry.tile.y);
            around = {std::min(around[0], box.min.x), std::min(around[1], box.min.y), std::max(around[2], box.max.x),
                      std::max(around[3], box.max.y)};
        }
        const int detail = entries.front().detail;
        SVT_TRY(finer, city_.find(detail - 1, around));
        for (const IndexEntry& entry : *finer) {
            const TileKey above = tileAbove(entry.tile, entry.detail, city_.spacing());
            const bool isBelow = detail == city_.topDetail() || tiles.contains({above.level, above.x, above.y});
            if (isBelow && isNeeded(entry)) found.push_back(entry);
        }
        return found;
    }

    // Whether part of a box is in the picture, or part of the shadow that it may cast on the lowest ground.
    [[nodiscard]] bool isNeeded(const IndexEntry& entry) const { return isSeen(boxWithShadow(city_, view_, entry)); }

    // Whether no plane of the picture's frustum has all of a box at its outer side.
    [[nodiscard]] bool isSeen(const Box3d& box) const {
        std::array<int, 5> outside{};
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3d from = cornerOf(box, corner) - view_.eye;
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

    [[nodiscard]] bool isTooCoarse(const IndexEntry& entry) const { return pixelsOf(city_, view_, entry) > pixels_; }

    const City& city_;
    const CameraView& view_;
    int finest_;
    double pixels_;
};

}  // namespace

CameraView cameraViewOf(const render::FrameSpec& spec, const volume::Grid& grid) {
    const render::CameraRays rays(spec, grid);
    const auto basis = rays.basis();
    CameraView view;
    view.isPerspective = rays.isPerspective();
    view.eye = spec.camera.eye;
    view.forward = basis.forward;
    view.right = basis.right;
    view.up = basis.up;
    view.halfWidth = basis.halfWidth;
    view.halfHeight = basis.halfHeight;
    view.pixel = rays.pixelSize(1);
    if (spec.light.hasShadows && spec.light.space == render::Light::Space::World && spec.light.key > 0)
        view.towardsLight = normalized(spec.light.direction);
    return view;
}

Result<ChosenTiles> chooseTiles(const City& city, const CameraView& view, std::uint64_t memoryBytes, int finest) {
    for (double pixels = 1;; pixels *= std::sqrt(2.0)) {
        auto chosen = Chooser(city, view, finest, pixels).run();
        if (!chosen || chosen->bytes <= memoryBytes / kBytesAByte || pixels > kMostPixels) return chosen;
    }
}

std::vector<bool> areHidden(const City& city, const CameraView& view, const SeenDepths& seen,
                            std::span<const IndexEntry> entries) {
    constexpr double kAround = 10;  // metres that ambient light reaches
    std::vector<bool> hidden;
    for (const IndexEntry& entry : entries) {
        Box3d box = boxWithShadow(city, view, entry);
        for (const double by : {-kAround, kAround}) {
            const Vec3d to = (by < 0 ? box.min : box.max) + Vec3d{by, by, by};
            box.add(to);
        }
        double nearest = kInfinity, left = kInfinity, right = -kInfinity, low = kInfinity, high = -kInfinity;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3d from = cornerOf(box, corner) - view.eye;
            const double depth = dot(from, view.forward), scale = view.isPerspective ? std::max(depth, 1e-9) : 1;
            const double x = (dot(from, view.right) / (view.halfWidth * scale) + 1) / 2 * seen.width;
            const double y = (1 - dot(from, view.up) / (view.halfHeight * scale)) / 2 * seen.height;
            nearest = std::min(nearest, depth);
            left = std::min(left, x);
            right = std::max(right, x);
            low = std::min(low, y);
            high = std::max(high, y);
        }
        const auto within = [](double at, std::int32_t most) {
            return static_cast<std::int32_t>(std::clamp(at, 0.0, double(most)));
        };
        const std::int32_t iBegin = within(left - 1, seen.width), iEnd = within(right + 2, seen.width),
                           jBegin = within(low - 1, seen.height), jEnd = within(high + 2, seen.height);
        bool isHidden = nearest > 0;
        for (std::int32_t j = jBegin; j < jEnd && isHidden; ++j) {
            const auto row = seen.depth.subspan(std::size_t(j) * std::size_t(seen.width) + std::size_t(iBegin),
                                                std::size_t(iEnd - iBegin));
            isHidden = std::all_of(row.begin(), row.end(), [&](float depth) { return double(depth) < nearest; });
        }
        hidden.push_back(isHidden);
    }
    return hidden;
}

ChosenTiles nearestOf(const City& city, const CameraView& view, const ChosenTiles& chosen, double share) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t n = 0; n < chosen.entries.size(); ++n)
        order.emplace_back(distanceFrom(view.eye, boxOf(city, chosen.entries[n])), n);
    std::sort(order.begin(), order.end());
    ChosenTiles near;
    near.pixels = chosen.pixels;
    for (const auto& [distance, n] : order) {
        if (!near.entries.empty() && double(near.bytes) >= share * double(chosen.bytes)) break;
        near.entries.push_back(chosen.entries[n]);
        near.bytes += chosen.entries[n].size;
    }
    sortEntries(city, view, near);
    return near;
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
        const std::size_t far = entries.size() - chosen.near, most = begin < far ? far : entries.size();
        for (; end < most && entries[end].detail == entries[begin].detail; ++end)
            parts.push_back(std::move(*read[end]));
        if (parts.size() == 1) {
            joined.push_back(std::move(parts.front()));
            continue;
        }
        SVT_TRY(volume, joinVolumes(parts, entries[begin].detail >= kFirstClassDetail));
        joined.push_back(std::move(*volume));
    }
    return joined;
}

Result<volume::SemanticVolume> frameVolume(const City& city) {
    const Box3d& box = city.box();
    // Enough samples that a camera fitted to the voxels fits the city.
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

volume::LabelTable classTable(const City& city) {
    volume::LabelTable table;
    const auto add = [&](const std::string& id, const std::string& name, const std::string& color) {
        volume::Label& label = table.labels.emplace_back();
        label.id = id;
        label.className = name;
        label.first = static_cast<volume::Scalar>(table.labels.size());
        label.count = 1;
        label.subtreeEnd = static_cast<std::uint32_t>(table.labels.size());
        label.filling = volume::Filling::Solid;
        if (color.size() != 7 || color[0] != '#') return;
        if (const auto rgb = parseInteger<std::uint32_t>(std::string_view(color).substr(1), 16))
            label.color = {float(*rgb >> 16) / 255, float(*rgb >> 8 & 255) / 255, float(*rgb & 255) / 255};
    };
    for (const City::Class& own : city.classes()) {
        const auto root = static_cast<std::uint32_t>(table.labels.size());
        add(own.name, own.name, own.color);
        for (const auto& [name, color] : own.parts) {
            add(own.name + "/" + name, name, color);
            table.labels.back().parent = root;
        }
        table.labels[root].subtreeEnd = static_cast<std::uint32_t>(table.labels.size());
    }
    return table;
}

}  // namespace svt::city
