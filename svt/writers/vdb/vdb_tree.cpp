#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/vdb/vdb_tree.hpp>

#include <svt/volume/dense.hpp>
#include <svt/writers/vdb/vdb_nodes.hpp>

#include <algorithm>
#include <array>
#include <iterator>

namespace svt::writers {
namespace {

/// A leaf in the file's order, z fastest; the block is read in its own order, x fastest.
/// \return whether all samples are alike
bool gatherLeaf(const std::vector<std::uint32_t>& block, Vec3i leaf, std::array<std::uint32_t, 512>& values) {
    constexpr auto kSide = static_cast<std::size_t>(VdbBlocks::kSide);
    const std::uint32_t* corner = block.data() + std::size_t(leaf.x * kLeafSide) +
                                  kSide * (std::size_t(leaf.y * kLeafSide) + kSide * std::size_t(leaf.z * kLeafSide));
    const std::uint32_t first = *corner;
    std::uint32_t difference = 0;
    for (std::size_t z = 0; z < 8; ++z)
        for (std::size_t y = 0; y < 8; ++y) {
            const std::uint32_t* row = corner + kSide * (y + kSide * z);
            for (std::size_t x = 0; x < 8; ++x) {
                values[x << 6 | y << 3 | z] = row[x];
                difference |= row[x] ^ first;
            }
        }
    return difference == 0;
}

/// Calls visit(number, values, isUniform) for the leaves of a block in the file's order: z fastest.
template <class Visit>
void forEachLeaf(const std::vector<std::uint32_t>& block, const Visit& visit) {
    std::array<std::uint32_t, 512> values{};
    std::size_t number = 0;
    for (std::int32_t x = 0; x < kLeavesAlong; ++x)
        for (std::int32_t y = 0; y < kLeavesAlong; ++y)
            for (std::int32_t z = 0; z < kLeavesAlong; ++z) {
                const bool isUniform = gatherLeaf(block, {x, y, z}, values);
                visit(number++, values, isUniform);
            }
}

NodeMask<512> maskOf(const std::array<std::uint32_t, 512>& values) {
    NodeMask<512> mask;
    for (std::size_t n = 0; n < 512; ++n)
        if (values[n] != 0) mask.set(n);
    return mask;
}

/// A node of 16^3 leaves: masks, tiles, then the masks of its leaves.
VdbBytes lowerTopology(const std::vector<std::uint32_t>& block) {
    NodeMask<4096> children, tiles;
    std::vector<std::uint32_t> tileValues;
    VdbBytes leaves;
    forEachLeaf(block, [&](std::size_t n, const std::array<std::uint32_t, 512>& values, bool isUniform) {
        if (isUniform) {
            if (values[0] == 0) return;
            tiles.set(n);
            tileValues.push_back(values[0]);
            return;
        }
        children.set(n);
        appendBytes(leaves, maskOf(values));
    });
    VdbBytes bytes;
    appendBytes(bytes, children, tiles);
    NodeValues().put(bytes, tileValues);
    bytes.insert(bytes.end(), leaves.begin(), leaves.end());
    return bytes;
}

/// The leaves of a block: the mask again, and the active values.
VdbBytes leafBuffers(const std::vector<std::uint32_t>& block) {
    VdbBytes bytes;
    NodeValues nodeValues;
    std::vector<std::uint32_t> active;
    forEachLeaf(block, [&](std::size_t, const std::array<std::uint32_t, 512>& values, bool isUniform) {
        if (isUniform) return;
        appendBytes(bytes, maskOf(values));
        active.clear();
        std::copy_if(values.begin(), values.end(), std::back_inserter(active), [](std::uint32_t v) { return v != 0; });
        nodeValues.put(bytes, active);
    });
    return bytes;
}

}  // namespace

VdbBlocks::VdbBlocks(const volume::ColumnVolume& columns, int threads, const Progress* progress)
    : columns_(columns), threads_(threads), progress_(progress) {
    for (int axis = 0; axis < 3; ++axis) count_[axis] = (columns.dimension()[axis] + kSide - 1) / kSide;
}

Result<VdbBlocks> VdbBlocks::of(const volume::ColumnVolume& columns, int threads, const Progress* progress) {
    VdbBlocks blocks(columns, threads, progress);
    std::vector<volume::Scalar> samples;
    std::vector<bool> isSeen(std::size_t(volume::largestScalar(columns)) + 1);
    for (std::int32_t z = 0; z < blocks.count_.z; ++z) {
        SVT_DO(checkNotStopped(progress));
        for (std::int32_t y = 0; y < blocks.count_.y; ++y)
            for (std::int32_t x = 0; x < blocks.count_.x; ++x) {
                blocks.samples({x, y, z}, 0, samples);
                std::vector<volume::Scalar> found;
                for (std::size_t n = 0; n < samples.size(); ++n) {
                    if (n > 0 && samples[n] == samples[n - 1]) continue;
                    if (isSeen[samples[n]]) continue;
                    isSeen[samples[n]] = true;
                    found.push_back(samples[n]);
                }
                for (const volume::Scalar scalar : found) isSeen[scalar] = false;
                std::sort(found.begin(), found.end());
                blocks.scalars_.push_back(std::move(found));
            }
    }
    return blocks;
}

void VdbBlocks::samples(Vec3i block, std::int32_t margin, std::vector<volume::Scalar>& out) const {
    const std::int32_t side = kSide + 2 * margin;
    const Vec3i corner = block * kSide - Vec3i{margin, margin, margin};
    Vec3i first = corner, end = corner + Vec3i{side, side, side};
    const auto row = static_cast<std::size_t>(side);
    out.assign(row * row * row, 0);
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = std::max(first[axis], 0);
        end[axis] = std::min(end[axis], columns_.dimension()[axis]);
        if (first[axis] >= end[axis]) return;
    }
    const Vec3i size = end - first, shift = first - corner;
    inside_.resize(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
    volume::copyBox<volume::Scalar>(columns_, {first.y, end.y, first.z, end.z, first.x, end.x}, inside_, threads_);
    for (std::int32_t k = 0; k < size.z; ++k)
        for (std::int32_t j = 0; j < size.y; ++j)
            std::copy_n(inside_.begin() + std::ptrdiff_t(size.x) * (j + std::ptrdiff_t(size.y) * k), size.x,
                        out.begin() +
                            static_cast<std::ptrdiff_t>(std::size_t(shift.x) + row * (std::size_t(j + shift.y) +
                                                                                      row * std::size_t(k + shift.z))));
}

VdbTree::VdbTree(const VdbBlocks& blocks, std::vector<std::uint32_t> valueOf)
    : blocks_(blocks), valueOf_(std::move(valueOf)) {
    const Vec3i count = blocks.count();
    for (std::int32_t x = 0; x < count.x; x += kUpperSide)
        for (std::int32_t y = 0; y < count.y; y += kUpperSide)
            for (std::int32_t z = 0; z < count.z; z += kUpperSide) {
                bool isUsed = false;
                const Vec3i end{std::min(x + kUpperSide, count.x), std::min(y + kUpperSide, count.y),
                                std::min(z + kUpperSide, count.z)};
                std::uint32_t value = 0;
                for (std::int32_t i = x; i < end.x && !isUsed; ++i)
                    for (std::int32_t j = y; j < end.y && !isUsed; ++j)
                        for (std::int32_t k = z; k < end.z && !isUsed; ++k)
                            isUsed = stateOf({i, j, k}, value) != State::Empty;
                if (isUsed) roots_.push_back({{x, y, z}});
            }
}

VdbTree::State VdbTree::stateOf(Vec3i block, std::uint32_t& value) const {
    const auto scalars = blocks_.scalars(block);
    value = valueOf_[scalars.front()];
    const bool isSame =
        std::all_of(scalars.begin(), scalars.end(), [&](volume::Scalar s) { return valueOf_[s] == value; });
    return !isSame ? State::Child : value == 0 ? State::Empty : State::Tile;
}

void VdbTree::readBlock(Vec3i block, std::vector<std::uint32_t>& values) const {
    blocks_.samples(block, 0, values);
    for (std::uint32_t& value : values) value = valueOf_[value];
}

/// Calls visit(number, block, state, value) for non-empty children, in the file's order: z fastest.
template <class Visit>
Result<void> VdbTree::forEachChild(const Upper& upper, const Visit& visit) const {
    const Vec3i count = blocks_.count();
    for (std::int32_t x = 0; x < std::min(kUpperSide, count.x - upper.first.x); ++x) {
        SVT_DO(checkNotStopped(blocks_.progress()));
        for (std::int32_t y = 0; y < std::min(kUpperSide, count.y - upper.first.y); ++y)
            for (std::int32_t z = 0; z < std::min(kUpperSide, count.z - upper.first.z); ++z) {
                const Vec3i block = upper.first + Vec3i{x, y, z};
                std::uint32_t value = 0;
                const State state = stateOf(block, value);
                if (state == State::Empty) continue;
                const auto number = static_cast<std::size_t>((x * kUpperSide + y) * kUpperSide + z);
                SVT_DO(visit(number, block, state, value));
            }
    }
    return {};
}

Result<void> VdbTree::writeUpper(const Upper& upper, const VdbSink& topology, const VdbSink& buffers) const {
    NodeMask<32768> children, tiles;
    std::vector<std::uint32_t> tileValues;
    auto done = forEachChild(upper, [&](std::size_t number, Vec3i, State state, std::uint32_t value) -> Result<void> {
        if (state == State::Child) {
            children.set(number);
        } else {
            tiles.set(number);
            tileValues.push_back(value);
        }
        return {};
    });
    if (!done) return done;
    VdbBytes bytes;
    appendBytes(bytes, upper.first * VdbBlocks::kSide, children, tiles);
    NodeValues().put(bytes, tileValues);
    if (topology)
        if (done = topology(bytes); !done) return done;
    std::vector<std::uint32_t> values;
    return forEachChild(upper, [&](std::size_t, Vec3i block, State state, std::uint32_t) -> Result<void> {
        if (state != State::Child) return {};
        readBlock(block, values);
        if (topology) SVT_DO(topology(lowerTopology(values)));
        return buffers ? buffers(leafBuffers(values)) : Result<void>();
    });
}

Result<void> VdbTree::write(const VdbSink& topology, const VdbSink& buffers) const {
    VdbBytes bytes;
    // Buffers of a leaf, background, tiles and children of the root.
    appendAs<std::uint32_t>(bytes, 1, 0, 0, roots_.size());
    if (topology) SVT_DO(topology(bytes));
    for (const Upper& upper : roots_) SVT_DO(writeUpper(upper, topology, buffers));
    return {};
}

}  // namespace svt::writers
