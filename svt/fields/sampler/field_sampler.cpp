#include <svt/fields/field_sampler.hpp>

#include <svt/fields/check_field.hpp>
#include <svt/fields/sampler/cell_table.hpp>
#include <svt/fields/sampler/lattice_axes.hpp>
#include <svt/fields/sampler/medium.hpp>
#include <svt/fields/sampler/medium_grid.hpp>
#include <svt/fields/sampler/room_points.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace svt::fields {
namespace {

using volume::kNoLabel;
using volume::SemanticVolume;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

// The corners of a cell of 2 x 2 x 2 voxels that corner `from` reaches by faces through corners of the set `in`.
constexpr std::uint8_t joinedCorners(unsigned in, unsigned from) {
    unsigned reached = 1u << from;
    for (int step = 0; step < 7; ++step) {
        unsigned next = reached;
        next |= (reached & 0x55u) << 1 | (reached & 0xAAu) >> 1;
        next |= (reached & 0x33u) << 2 | (reached & 0xCCu) >> 2;
        next |= (reached & 0x0Fu) << 4 | (reached & 0xF0u) >> 4;
        reached = next & in;
    }
    return static_cast<std::uint8_t>(reached);
}

constexpr auto makeJoined() {
    std::array<std::array<std::uint8_t, 8>, 256> table{};
    for (unsigned in = 0; in < 256; ++in)
        for (unsigned from = 0; from < 8; ++from)
            table[in][from] = (in >> from & 1u) != 0 ? joinedCorners(in, from) : std::uint8_t{0};
    return table;
}
constexpr auto kJoined = makeJoined();

// Whether a place can be turned into a voxel; false for NaN.
bool isPlace(Vec3d index) noexcept {
    return std::abs(index.x) < kMaxPlace && std::abs(index.y) < kMaxPlace && std::abs(index.z) < kMaxPlace;
}

Vec3i voxelOfPlace(Vec3d index) noexcept { return {voxelAt(index.x), voxelAt(index.y), voxelAt(index.z)}; }

// The values of one time and component.
struct Layer {
    const float* values;
    [[nodiscard]] float at(std::size_t place) const noexcept { return values[place]; }
};

}  // namespace

struct FieldSampler::Parts {
    const Field* field = nullptr;
    const SemanticVolume* volume = nullptr;
    std::size_t places = 0;
    MediumGrid media;
    LatticeAxes axes;                          // of a grid
    CellTable cells;                           // of a coarse grid
    std::vector<Medium> mediumOfScalar;        // of labels and points
    std::vector<std::uint32_t> labelOfScalar;  // of labels and points
    RoomPoints rooms;                          // of points

    [[nodiscard]] Layer layer(std::size_t time, std::int32_t component) const noexcept {
        return {field->values.data() + (time * std::size_t(field->head.components) + std::size_t(component)) * places};
    }
    [[nodiscard]] float sample(Vec3d index, Layer layer) const noexcept {
        if (!isPlace(index)) return kMissing;
        switch (field->head.kind) {
            case FieldKind::Grid: return onGrid(index, layer);
            case FieldKind::Label: return onLabel(index, layer);
            case FieldKind::Points: return onPoint(index, layer);
        }
        return kMissing;
    }

private:
    // ------------------------------------------------------------------------------------------------- a grid
    [[nodiscard]] float onGrid(Vec3d index, Layer layer) const noexcept {
        LatticeAxes::Spot spot;
        if (!axes.locate(index, spot)) return kMissing;
        return axes.isFine ? onFineGrid(index, spot, layer) : onCoarseGrid(index, spot, layer);
    }

    // The cell touches at most two voxels along each axis.
    [[nodiscard]] float onFineGrid(Vec3d index, const LatticeAxes::Spot& spot, Layer layer) const noexcept {
        const Vec3i low = axes.voxelOf(axes.nodeOf(spot.cell, 0)), high = axes.voxelOf(axes.nodeOf(spot.cell, 7));
        const Vec3i own = voxelOfPlace(index);
        Vec3i voxel;
        for (int axis = 0; axis < 3; ++axis) voxel[axis] = std::clamp(own[axis], low[axis], high[axis]);
        if (voxel != own && !isOneMedium(own, voxel)) return kMissing;
        if (media.areInUniformBrick(low, high)) {
            if (media.at(low) == Medium::None) return kMissing;
            const float value = mean(spot, 0xFF, layer);
            return std::isnan(value) ? nearby(index, spot.cell, voxel, layer) : value;
        }
        const Medium medium = media.at(voxel);
        if (medium == Medium::None) return kMissing;
        unsigned in = 0;
        for (unsigned c = 0; c < 8; ++c) {
            const Vec3i corner{(c & 1u) != 0 ? high.x : low.x, (c & 2u) != 0 ? high.y : low.y,
                               (c & 4u) != 0 ? high.z : low.z};
            if (media.at(corner) == medium) in |= 1u << c;
        }
        const unsigned from =
            (voxel.x != low.x ? 1u : 0u) | (voxel.y != low.y ? 2u : 0u) | (voxel.z != low.z ? 4u : 0u);
        const float value = mean(spot, kJoined[in][from], layer);
        return std::isnan(value) ? nearby(index, spot.cell, voxel, layer) : value;
    }

    // Whether all voxels of the box between two voxels have one medium.
    [[nodiscard]] bool isOneMedium(Vec3i a, Vec3i b) const noexcept {
        const Medium medium = media.at(a);
        for (std::int32_t z = std::min(a.z, b.z); z <= std::max(a.z, b.z); ++z)
            for (std::int32_t y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y)
                for (std::int32_t x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x)
                    if (media.at({x, y, z}) != medium) return false;
        return true;
    }

    [[nodiscard]] float onCoarseGrid(Vec3d index, const LatticeAxes::Spot& spot, Layer layer) const noexcept {
        const VoxelBox box = axes.boxOf(spot.cell);
        Vec3i voxel = voxelOfPlace(index);
        for (int axis = 0; axis < 3; ++axis) voxel[axis] = std::clamp(voxel[axis], box.low[axis], box.high[axis]);
        const Reach reach = cells.at(axes, spot.cell, voxel);
        const float value = mean(spot, reach.corners, layer);
        if (!std::isnan(value) || reach.elsewhere == kNoNode) return value;
        return layer.at(reach.elsewhere);
    }

    // The mean of some corners by their trilinear weights; missing values do not count.
    [[nodiscard]] float mean(const LatticeAxes::Spot& spot, unsigned corners, Layer layer) const noexcept {
        const Sum sum = weighted(spot, spot.fraction, corners, layer);
        if (sum.weights > kLeastWeight) return static_cast<float>(sum.values / sum.weights);
        if (!sum.hasValue) return kMissing;
        // All nodes with a value have no weight: the limit from their side.
        constexpr double kInside = 1e-9;
        Vec3d inside;
        for (int axis = 0; axis < 3; ++axis) inside[axis] = std::clamp(spot.fraction[axis], kInside, 1 - kInside);
        const Sum limit = weighted(spot, inside, corners, layer);
        return static_cast<float>(limit.values / limit.weights);
    }

    struct Sum {
        double values = 0, weights = 0;
        bool hasValue = false;
    };
    static constexpr double kLeastWeight = 1e-9;

    [[nodiscard]] Sum weighted(const LatticeAxes::Spot& spot, Vec3d f, unsigned corners, Layer layer) const noexcept {
        const std::size_t first = axes.nodeIndex(spot.cell);
        const std::size_t stepX = axes.axes[0].size > 1 ? 1 : 0;
        const std::size_t stepY = axes.axes[1].size > 1 ? std::size_t(axes.axes[0].size) : 0;
        const std::size_t stepZ =
            axes.axes[2].size > 1 ? std::size_t(axes.axes[0].size) * std::size_t(axes.axes[1].size) : 0;
        Sum sum;
        for (unsigned c = 0; c < 8; ++c) {
            if ((corners >> c & 1u) == 0) continue;
            const float value = layer.at(first + ((c & 1u) != 0 ? stepX : 0) + ((c & 2u) != 0 ? stepY : 0) +
                                         ((c & 4u) != 0 ? stepZ : 0));
            if (std::isnan(value)) continue;
            const double weight =
                ((c & 1u) != 0 ? f.x : 1 - f.x) * ((c & 2u) != 0 ? f.y : 1 - f.y) * ((c & 4u) != 0 ? f.z : 1 - f.z);
            sum.values += weight * double{value};
            sum.weights += weight;
            sum.hasValue = true;
        }
        return sum;
    }

    // The first node with a value that the medium leads to within kReachCells; among those of equal steps, the nearest.
    [[nodiscard]] float nearby(Vec3d index, Vec3i cell, Vec3i start, Layer layer) const noexcept {
        // A fine lattice has at most one voxel per step, so a cell and those around it touch at most 6 along each axis.
        constexpr std::int32_t kSide = 2 * kReachCells + 2;
        Vec3i firstNode, lastNode, low, side;
        for (int axis = 0; axis < 3; ++axis) {
            const LatticeAxis& one = axes.axes[std::size_t(axis)];
            firstNode[axis] = std::max(0, cell[axis] - kReachCells);
            lastNode[axis] = std::min(one.size - 1, cell[axis] + 1 + kReachCells);
            low[axis] = one.voxelOf[std::size_t(firstNode[axis])];
            side[axis] = std::min(one.voxelOf[std::size_t(lastNode[axis])] - low[axis] + 1, kSide);
        }
        const Medium medium = media.at(start);
        if (medium == Medium::None) return kMissing;
        std::array<std::int8_t, kSide * kSide * kSide> steps{};  // 0: not reached, else 1 + steps
        const auto slot = [&](Vec3i v) { return std::size_t(v.x + kSide * (v.y + kSide * v.z)); };
        std::array<Vec3i, kSide * kSide * kSide> queue{};
        std::size_t count = 0;
        queue[count++] = start - low;
        steps[slot(start - low)] = 1;
        for (std::size_t q = 0; q < count; ++q)
            for (int axis = 0; axis < 3; ++axis)
                for (const std::int32_t way : {-1, 1}) {
                    Vec3i next = queue[q];
                    next[axis] += way;
                    if (next[axis] < 0 || next[axis] >= side[axis] || steps[slot(next)] != 0 ||
                        media.at(low + next) != medium)
                        continue;
                    steps[slot(next)] = static_cast<std::int8_t>(steps[slot(queue[q])] + 1);
                    queue[count++] = next;
                }
        float best = kMissing;
        int fewest = 0;
        double nearest = 0;
        for (std::int32_t k = firstNode.z; k <= lastNode.z; ++k)
            for (std::int32_t j = firstNode.y; j <= lastNode.y; ++j)
                for (std::int32_t i = firstNode.x; i <= lastNode.x; ++i) {
                    const int taken = steps[slot(axes.voxelOf({i, j, k}) - low)];
                    if (taken == 0 || (fewest != 0 && taken > fewest)) continue;
                    const float value = layer.at(axes.nodeIndex({i, j, k}));
                    if (std::isnan(value)) continue;
                    const Vec3d way = axes.placeOf({i, j, k}) - index;
                    if (fewest == 0 || taken < fewest || dot(way, way) < nearest) {
                        best = value;
                        fewest = taken;
                        nearest = dot(way, way);
                    }
                }
        return best;
    }

    // -------------------------------------------------------------------------------------- labels and points
    [[nodiscard]] std::uint32_t labelAt(Vec3d index) const noexcept {
        const Vec3i voxel = voxelOfPlace(index), n = volume->grid.dimension();
        if (voxel.x < 0 || voxel.y < 0 || voxel.z < 0 || voxel.x >= n.x || voxel.y >= n.y || voxel.z >= n.z)
            return kNoLabel;
        const volume::Scalar scalar = volume->columns.scalarAt(voxel.x, voxel.y, voxel.z);
        return mediumOfScalar[scalar] == Medium::None ? kNoLabel : labelOfScalar[scalar];
    }
    [[nodiscard]] float onLabel(Vec3d index, Layer layer) const noexcept {
        for (std::uint32_t l = labelAt(index); l != kNoLabel; l = volume->labels.labels[l].parent)
            if (!std::isnan(layer.at(l))) return layer.at(l);
        return kMissing;
    }
    [[nodiscard]] float onPoint(Vec3d index, Layer layer) const noexcept {
        const std::size_t point =
            rooms.nearest(labelAt(index), index, [&](std::size_t p) { return !std::isnan(layer.at(p)); });
        return point == RoomPoints::kNoPoint ? kMissing : layer.at(point);
    }
};

namespace {

// True for each node that has a value at any time in any component.
std::vector<bool> nodesWithValue(const Field& field, std::size_t places) {
    std::vector<bool> has(places, false);
    for (std::size_t v = 0, place = 0; v < field.values.size(); ++v) {
        if (!std::isnan(field.values[v])) has[place] = true;
        if (++place == places) place = 0;
    }
    return has;
}

}  // namespace

Result<FieldSampler> FieldSampler::make(const Field& field, const SemanticVolume& volume) {
    SVT_DO(checkField(field, volume.labels.labels.size()));
    SVT_TRY(media, mediaOf(field.head, volume));
    auto parts = std::make_shared<Parts>();
    parts->field = &field;
    parts->volume = &volume;
    parts->places = placeCount(field.head, volume.labels.labels.size());
    parts->media = MediumGrid(volume.columns, *media);
    if (field.head.kind == FieldKind::Grid) {
        SVT_TRY(axes, LatticeAxes::make(field.head.lattice));
        parts->axes = std::move(*axes);
        if (parts->axes.largestCell > kMaxCellVoxels)
            return Error(
                Code::InputTooBig,
                fmt::format("field '{}': a cell of its lattice holds {} voxels of the volume, {} are possible. "
                            "Use a finer lattice or a coarser volume.",
                            field.head.name, parts->axes.largestCell, kMaxCellVoxels));
        if (!parts->axes.isFine)
            parts->cells = CellTable(parts->axes, parts->media, nodesWithValue(field, parts->places));
    } else {
        parts->mediumOfScalar = std::move(*media);
        parts->labelOfScalar = volume.labels.labelOfScalar();
        if (field.head.kind == FieldKind::Points) parts->rooms = RoomPoints(field.head, volume);
    }
    FieldSampler sampler;
    sampler.range_ = rangeOf(field);
    sampler.parts_ = std::move(parts);
    return sampler;
}

float FieldSampler::at(Vec3d index, std::size_t time, std::int32_t component) const noexcept {
    const FieldHead& head = parts_->field->head;
    if (time >= head.times.size() || component < 0 || component >= head.components) return kMissing;
    return parts_->sample(index, parts_->layer(time, component));
}

float FieldSampler::atSeconds(Vec3d index, double seconds, std::int32_t component) const noexcept {
    const std::vector<double>& times = parts_->field->head.times;
    if (std::isnan(seconds)) return kMissing;
    const auto above = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
    if (above == 0) return at(index, 0, component);
    if (above == times.size() || seconds == times[above - 1]) return at(index, above - 1, component);
    const double share = (seconds - times[above - 1]) / (times[above] - times[above - 1]);
    const auto before = double{at(index, above - 1, component)}, after = double{at(index, above, component)};
    return static_cast<float>(before + share * (after - before));
}

bool FieldSampler::isInMedium(Vec3d index) const noexcept {
    return isPlace(index) && parts_->media.at(voxelOfPlace(index)) != Medium::None;
}

std::size_t FieldSampler::sizeBytes() const noexcept {
    return parts_->media.sizeBytes() + parts_->cells.sizeBytes() +
           parts_->labelOfScalar.size() * (sizeof(std::uint32_t) + sizeof(Medium));
}

}  // namespace svt::fields
