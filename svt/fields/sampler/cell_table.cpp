#include <svt/fields/sampler/cell_table.hpp>

#include <svt/core/parallel.hpp>

#include <array>
#include <bit>
#include <utility>

namespace svt::fields {
namespace {

constexpr std::array<Vec3i, 6> kFaces{Vec3i{1, 0, 0},  Vec3i{-1, 0, 0}, Vec3i{0, 1, 0},
                                      Vec3i{0, -1, 0}, Vec3i{0, 0, 1},  Vec3i{0, 0, -1}};
/// Voxels around a cell that a search for a node may visit.
constexpr std::uint64_t kMaxSearched = std::uint64_t{1} << 24;

bool isIn(const VoxelBox& box, Vec3i voxel) noexcept {
    return voxel.x >= box.low.x && voxel.y >= box.low.y && voxel.z >= box.low.z && voxel.x <= box.high.x &&
           voxel.y <= box.high.y && voxel.z <= box.high.z;
}

std::uint64_t planesOf(std::size_t parts) noexcept { return std::uint64_t(std::bit_width(parts - 1)); }

}  // namespace

// Divides one cell after the other, with buffers that are kept.
class CellTableBuilder {
public:
    CellTableBuilder(const LatticeAxes& axes, const MediumGrid& media, const std::vector<bool>& hasValue)
        : axes_(axes), media_(media), hasValue_(hasValue) {}

    // The entry of a cell; its record is appended to `records`.
    std::uint32_t add(Vec3i cell, std::vector<std::uint32_t>& records) {
        const VoxelBox box = axes_.boxOf(cell);
        const bool hasCorner = hasValueIn(cell, cell);
        if (!hasCorner && !hasValueIn(firstAround(cell), lastAround(cell))) return CellTable::kMissing;
        const bool isUniform = media_.isUniform(box);
        if (isUniform && media_.at(box.low) == Medium::None) return CellTable::kMissing;
        if (isUniform && hasCorner) return CellTable::kJoined;
        voxels_.resize(box.count());
        media_.copy(box, voxels_);
        const Medium first = voxels_[0];
        if (std::all_of(voxels_.begin(), voxels_.end(), [&](Medium m) { return m == first; })) {
            if (first == Medium::None) return CellTable::kMissing;
            if (hasCorner) return CellTable::kJoined;
        }
        parts_.assign(1, Reach());
        partOf_.assign(voxels_.size(), kUnseen);
        for (std::int32_t z = box.low.z; z <= box.high.z; ++z)
            for (std::int32_t y = box.low.y; y <= box.high.y; ++y)
                for (std::int32_t x = box.low.x; x <= box.high.x; ++x)
                    if (const std::size_t v = box.indexOf({x, y, z}); partOf_[v] == kUnseen) {
                        if (voxels_[v] == Medium::None)
                            partOf_[v] = 0;
                        else
                            addPart(cell, box, {x, y, z});
                    }
        return writeRecord(records);
    }

private:
    static constexpr std::uint32_t kUnseen = 0xFFFFFFFFu, kOpen = 0xFFFFFFFEu;

    [[nodiscard]] static Vec3i firstAround(Vec3i cell) noexcept {
        return {std::max(0, cell.x - kReachCells), std::max(0, cell.y - kReachCells),
                std::max(0, cell.z - kReachCells)};
    }
    [[nodiscard]] Vec3i lastAround(Vec3i cell) const noexcept {
        return {std::min(axes_.axes[0].cells() - 1, cell.x + kReachCells),
                std::min(axes_.axes[1].cells() - 1, cell.y + kReachCells),
                std::min(axes_.axes[2].cells() - 1, cell.z + kReachCells)};
    }
    // Whether a node of the cells from `first` to `last` has a value.
    [[nodiscard]] bool hasValueIn(Vec3i first, Vec3i last) const noexcept {
        const Vec3i end = axes_.nodeOf(last, 7);
        for (std::int32_t k = first.z; k <= end.z; ++k)
            for (std::int32_t j = first.y; j <= end.y; ++j)
                for (std::int32_t i = first.x; i <= end.x; ++i)
                    if (hasValue_[axes_.nodeIndex({i, j, k})]) return true;
        return false;
    }

    // The part of the cell around a voxel.
    void addPart(Vec3i cell, const VoxelBox& box, Vec3i seed) {
        const Medium medium = voxels_[box.indexOf(seed)];
        queue_.assign(1, seed);
        partOf_[box.indexOf(seed)] = kOpen;
        for (std::size_t q = 0; q < queue_.size(); ++q)
            for (const Vec3i face : kFaces) {
                const Vec3i next = queue_[q] + face;
                if (!isIn(box, next)) continue;
                const std::size_t v = box.indexOf(next);
                if (partOf_[v] != kUnseen || voxels_[v] != medium) continue;
                partOf_[v] = kOpen;
                queue_.push_back(next);
            }
        Reach reach;
        bool isKnown = false;
        for (unsigned c = 0; c < 8; ++c) {
            const Vec3i node = axes_.nodeOf(cell, c);
            if (partOf_[box.indexOf(axes_.voxelOf(node))] != kOpen) continue;
            reach.corners = static_cast<std::uint8_t>(reach.corners | 1u << c);
            isKnown = isKnown || hasValue_[axes_.nodeIndex(node)];
        }
        const std::size_t own = queue_.size();
        if (!isKnown) reach.elsewhere = findElsewhere(cell, medium);
        const auto found = std::find(parts_.begin(), parts_.end(), reach);
        const auto part = static_cast<std::uint32_t>(found - parts_.begin());
        if (found == parts_.end()) parts_.push_back(reach);
        for (std::size_t q = 0; q < own; ++q) partOf_[box.indexOf(queue_[q])] = part;
    }

    // The first node with a value that the medium leads to from the voxels in the queue, by steps through faces; among those of
    // equal steps, the one with the lowest index.
    std::size_t findElsewhere(Vec3i cell, Medium medium) {
        const Vec3i lowCell = firstAround(cell), highCell = lastAround(cell);
        const VoxelBox area{axes_.boxOf(lowCell).low, axes_.boxOf(highCell).high};
        if (area.count() > kMaxSearched) return kNoNode;
        const Vec3i lastNode = axes_.nodeOf(highCell, 7);
        listNodes(area, lowCell, lastNode);
        isSeen_.assign(area.count(), false);
        for (const Vec3i voxel : queue_) isSeen_[area.indexOf(voxel)] = true;
        std::size_t begin = 0;
        while (begin < queue_.size()) {
            std::size_t best = kNoNode;
            const std::size_t end = queue_.size();
            for (std::size_t q = begin; q < end; ++q) best = std::min(best, nodeIn(area, queue_[q]));
            if (best != kNoNode) return best;
            for (std::size_t q = begin; q < end; ++q)
                for (const Vec3i face : kFaces) {
                    const Vec3i next = queue_[q] + face;
                    if (!isIn(area, next) || isSeen_[area.indexOf(next)] || media_.at(next) != medium) continue;
                    isSeen_[area.indexOf(next)] = true;
                    queue_.push_back(next);
                }
            begin = end;
        }
        return kNoNode;
    }

    // For each axis and voxel of the area: the first node in it.
    void listNodes(const VoxelBox& area, Vec3i first, Vec3i last) {
        for (int axis = 0; axis < 3; ++axis) {
            auto& list = nodeOfVoxel_[std::size_t(axis)];
            list.assign(std::size_t(area.size()[axis]), -1);
            for (std::int32_t n = last[axis]; n >= first[axis]; --n)
                list[std::size_t(axes_.axes[std::size_t(axis)].voxelOf[std::size_t(n)] - area.low[axis])] = n;
        }
    }

    [[nodiscard]] std::size_t nodeIn(const VoxelBox& area, Vec3i voxel) const noexcept {
        Vec3i node;
        for (int axis = 0; axis < 3; ++axis) {
            node[axis] = nodeOfVoxel_[std::size_t(axis)][std::size_t(voxel[axis] - area.low[axis])];
            if (node[axis] < 0) return kNoNode;
        }
        const std::size_t index = axes_.nodeIndex(node);
        return hasValue_[index] ? index : kNoNode;
    }

    std::uint32_t writeRecord(std::vector<std::uint32_t>& records) const {
        const auto offset = static_cast<std::uint32_t>(records.size());
        records.push_back(static_cast<std::uint32_t>(parts_.size()));
        for (const Reach& part : parts_) {
            records.push_back(part.corners);
            records.push_back(static_cast<std::uint32_t>(part.elsewhere));
            records.push_back(static_cast<std::uint32_t>(std::uint64_t{part.elsewhere} >> 32));
        }
        const std::size_t planeWords = (partOf_.size() + 31) / 32, first = records.size();
        records.resize(first + planeWords * planesOf(parts_.size()));
        for (std::size_t v = 0; v < partOf_.size(); ++v)
            for (std::size_t p = 0, part = partOf_[v]; part != 0; ++p, part >>= 1)
                if ((part & 1u) != 0) records[first + p * planeWords + v / 32] |= 1u << (v % 32);
        return CellTable::kFirstRecord + offset;
    }

    const LatticeAxes& axes_;
    const MediumGrid& media_;
    const std::vector<bool>& hasValue_;
    std::vector<Medium> voxels_;         // of the cell
    std::vector<std::uint32_t> partOf_;  // by voxel of the cell
    std::vector<Reach> parts_;           // the first one is for voxels without values
    std::vector<Vec3i> queue_;
    std::vector<bool> isSeen_;
    std::array<std::vector<std::int32_t>, 3> nodeOfVoxel_;
};

CellTable::CellTable(const LatticeAxes& axes, const MediumGrid& media, const std::vector<bool>& hasValue) {
    const Vec3i n{axes.axes[0].cells(), axes.axes[1].cells(), axes.axes[2].cells()};
    cells_.resize(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
    layers_.resize(std::size_t(n.z));
    parallelFor(layers_.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
        CellTableBuilder builder(axes, media, hasValue);
        for (auto k = static_cast<std::int32_t>(begin); k < static_cast<std::int32_t>(end); ++k)
            for (std::int32_t j = 0; j < n.y; ++j)
                for (std::int32_t i = 0; i < n.x; ++i)
                    cells_[axes.cellIndex({i, j, k})] = builder.add({i, j, k}, layers_[std::size_t(k)]);
    });
}

Reach CellTable::at(const LatticeAxes& axes, Vec3i cell, Vec3i voxel) const noexcept {
    const std::uint32_t entry = cells_[axes.cellIndex(cell)];
    if (entry == kMissing) return {};
    if (entry == kJoined) return {0xFF, kNoNode};
    const std::uint32_t* record = layers_[std::size_t(cell.z)].data() + (entry - kFirstRecord);
    const std::size_t parts = *record;
    const VoxelBox box = axes.boxOf(cell);
    const std::size_t v = box.indexOf(voxel), planeWords = (box.count() + 31) / 32;
    const std::uint32_t* planes = record + 1 + kPartWords * parts;
    std::size_t part = 0;
    for (std::uint64_t p = 0; p < planesOf(parts); ++p)
        part |= std::size_t(planes[p * planeWords + v / 32] >> (v % 32) & 1u) << p;
    const std::uint32_t* words = record + 1 + kPartWords * part;
    return {static_cast<std::uint8_t>(words[0]),
            static_cast<std::size_t>(std::uint64_t{words[1]} | std::uint64_t{words[2]} << 32)};
}

std::size_t CellTable::sizeBytes() const noexcept {
    std::size_t bytes = cells_.size() * sizeof(cells_[0]);
    for (const auto& layer : layers_) bytes += layer.size() * sizeof(std::uint32_t);
    return bytes;
}

}  // namespace svt::fields
