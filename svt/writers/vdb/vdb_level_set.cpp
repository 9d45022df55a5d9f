#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/vdb/vdb_level_set.hpp>

#include <svt/writers/vdb/vdb_nodes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace svt::writers {
namespace {

constexpr std::int32_t kBandMargin = VdbLevelSet::kHalfWidth;
constexpr auto kBandRow = static_cast<std::size_t>(VdbBlocks::kSide + 2 * kBandMargin);
constexpr float kFar = std::numeric_limits<float>::max();

std::int32_t floorDivided(std::int32_t a, std::int32_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// Square of the distance along an axis from a sample to the cube of the sample `steps` away.
constexpr float axisSquare(std::int32_t steps) {
    const float beyond = steps == 0 ? 0.0f : float(steps > 0 ? steps : -steps) - 0.5f;
    return beyond * beyond;
}

/// A box of samples in a block with its margin, [begin, end) along each axis, x fastest.
struct BandBox {
    std::array<std::size_t, 3> begin{kBandRow, kBandRow, kBandRow}, end{0, 0, 0};
    [[nodiscard]] bool isEmpty() const noexcept { return begin[0] >= end[0]; }
    [[nodiscard]] std::size_t size(std::size_t axis) const noexcept { return end[axis] - begin[axis]; }
    [[nodiscard]] std::size_t count() const noexcept { return size(0) * size(1) * size(2); }
    void add(std::size_t axis, std::size_t first, std::size_t last) noexcept {
        begin[axis] = std::min(begin[axis], first);
        end[axis] = std::max(end[axis], last + 1);
    }
    void grow() noexcept {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            begin[axis] -= std::min<std::size_t>(begin[axis], std::size_t(kBandMargin));
            end[axis] = std::min(end[axis] + std::size_t(kBandMargin), kBandRow);
        }
    }
};

/// The samples that can have a distance within the band: samples inside, and their surroundings.
/// \param there  the samples of the volume; all samples beyond are outside
BandBox bandBoxOf(const std::vector<volume::Scalar>& samples, const BandBox& there, const std::vector<bool>& isInside) {
    BandBox box;
    for (std::size_t z = there.begin[2]; z < there.end[2]; ++z)
        for (std::size_t y = there.begin[1]; y < there.end[1]; ++y) {
            const volume::Scalar* row = samples.data() + kBandRow * (y + kBandRow * z);
            std::size_t first = there.begin[0], last = there.end[0];
            while (first < last && !isInside[row[first]]) ++first;
            if (first == last) continue;
            while (!isInside[row[last - 1]]) --last;
            box.add(0, first, last - 1);
            box.add(1, y, y);
            box.add(2, z, z);
        }
    if (!box.isEmpty()) box.grow();
    return box;
}

/// One pass of the squared distances: the least sum of a value on the line and the square to its place. `from` has the
/// values before, `to` those after.
void spread(const std::vector<float>& from, std::vector<float>& to, const BandBox& box, std::size_t axis) {
    to = from;
    // Samples in front of an axis move together: `inner` of them, for each place on it, for each of those behind it.
    std::size_t inner = 1, outer = 1;
    for (std::size_t a = 0; a < axis; ++a) inner *= box.size(a);
    for (std::size_t a = axis + 1; a < 3; ++a) outer *= box.size(a);
    const std::size_t length = box.size(axis) * inner;
    for (std::int32_t steps = 1; steps <= kBandMargin; ++steps) {
        const std::size_t shift = std::size_t(steps) * inner;
        if (shift >= length) break;
        const float square = axisSquare(steps);
        for (std::size_t o = 0; o < outer; ++o) {
            const float* in = from.data() + o * length;
            float* out = to.data() + o * length;
            for (std::size_t n = 0; n + shift < length; ++n) out[n] = std::min(out[n], in[n + shift] + square);
            for (std::size_t n = shift; n < length; ++n) out[n] = std::min(out[n], in[n - shift] + square);
        }
    }
}

/// A leaf in the file's order, z fastest.
void gatherLeaf(const std::vector<float>& block, Vec3i leaf, std::array<float, 512>& values) {
    constexpr auto kSide = static_cast<std::size_t>(VdbBlocks::kSide);
    const float* corner = block.data() + std::size_t(leaf.x * kLeafSide) +
                          kSide * (std::size_t(leaf.y * kLeafSide) + kSide * std::size_t(leaf.z * kLeafSide));
    for (std::size_t z = 0; z < 8; ++z)
        for (std::size_t y = 0; y < 8; ++y)
            for (std::size_t x = 0; x < 8; ++x) values[x << 6 | y << 3 | z] = corner[x + kSide * (y + kSide * z)];
}

/// The nodes of a block: which leaves there are, with the values of the others, and the leaves.
struct LowerNode {
    VdbBytes topology, buffers;
};

LowerNode lowerNode(const std::vector<float>& block, float background) {
    NodeMask<4096> children;
    const NodeMask<4096> tiles;
    std::vector<float> tileValues(4096, 0.0f);
    VdbBytes masks;
    LowerNode node;
    NodeValues nodeValues;
    std::array<float, 512> values{};
    std::size_t number = 0;
    for (std::int32_t x = 0; x < kLeavesAlong; ++x)
        for (std::int32_t y = 0; y < kLeavesAlong; ++y)
            for (std::int32_t z = 0; z < kLeavesAlong; ++z, ++number) {
                gatherLeaf(block, {x, y, z}, values);
                NodeMask<512> active;
                bool isAny = false;
                for (std::size_t n = 0; n < values.size(); ++n)
                    if (std::abs(values[n]) < background) {
                        active.set(n);
                        isAny = true;
                    }
                if (!isAny) {
                    tileValues[number] = values[0];
                    continue;
                }
                children.set(number);
                appendBytes(masks, active);
                appendBytes(node.buffers, active);
                nodeValues.putAll(node.buffers, values);
            }
    appendBytes(node.topology, children, tiles);
    nodeValues.putAll(node.topology, tileValues);
    node.topology.insert(node.topology.end(), masks.begin(), masks.end());
    return node;
}

}  // namespace

VdbLevelSet::VdbLevelSet(const VdbBlocks& blocks, std::vector<bool> isInside, double spacing)
    : blocks_(blocks),
      isInside_(std::move(isInside)),
      spacing_(static_cast<float>(spacing)),
      background_(static_cast<float>(spacing) * float(kHalfWidth)) {}

/// By the scalars of the block and of those around it, into which its margin reaches.
VdbLevelSet::State VdbLevelSet::stateOf(Vec3i block) const {
    bool hasInside = false, hasOutside = false;
    for (std::int32_t z = -1; z <= 1; ++z)
        for (std::int32_t y = -1; y <= 1; ++y)
            for (std::int32_t x = -1; x <= 1; ++x) {
                const Vec3i other = block + Vec3i{x, y, z};
                bool isThere = true;
                for (int axis = 0; axis < 3; ++axis)
                    isThere = isThere && other[axis] >= 0 && other[axis] < blocks_.count()[axis];
                if (!isThere) {
                    hasOutside = true;
                    continue;
                }
                for (const volume::Scalar scalar : blocks_.scalars(other))
                    (isInside_[scalar] ? hasInside : hasOutside) = true;
            }
    return hasInside && hasOutside ? State::Band : hasInside ? State::Inside : State::Outside;
}

/// Signed distances of a block, metres, x fastest. \return false: all of it is outside, beyond the band
bool VdbLevelSet::distances(Vec3i block, std::vector<float>& values) const {
    constexpr auto kSide = static_cast<std::size_t>(VdbBlocks::kSide);
    BandBox there;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t corner = block[axis] * VdbBlocks::kSide - kBandMargin;
        const auto place = [&](std::int32_t sample) {
            return static_cast<std::size_t>(std::clamp(sample - corner, 0, static_cast<std::int32_t>(kBandRow)));
        };
        there.begin[std::size_t(axis)] = place(0);
        there.end[std::size_t(axis)] = place(blocks_.dimension()[axis]);
    }
    std::vector<volume::Scalar> samples;
    blocks_.samples(block, kBandMargin, samples);
    const BandBox box = bandBoxOf(samples, there, isInside_);
    if (box.isEmpty()) return false;
    std::vector<bool> isIn(box.count());
    std::array<std::vector<float>, 2> squares;  // squared distances to the outside, to the inside
    for (auto& some : squares) some.assign(box.count(), kFar);
    std::size_t sample = 0;
    for (std::size_t z = box.begin[2]; z < box.end[2]; ++z)
        for (std::size_t y = box.begin[1]; y < box.end[1]; ++y)
            for (std::size_t x = box.begin[0]; x < box.end[0]; ++x, ++sample) {
                isIn[sample] = isInside_[samples[x + kBandRow * (y + kBandRow * z)]];
                squares[isIn[sample] ? 1 : 0][sample] = 0;
            }
    std::vector<float> moved;
    for (auto& some : squares)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            spread(some, moved, box, axis);
            std::swap(some, moved);
        }
    values.assign(kSide * kSide * kSide, background_);
    sample = 0;
    const auto isOfBlock = [](std::size_t n) {
        return n >= std::size_t(kBandMargin) && n < kBandRow - std::size_t(kBandMargin);
    };
    for (std::size_t z = box.begin[2]; z < box.end[2]; ++z)
        for (std::size_t y = box.begin[1]; y < box.end[1]; ++y)
            for (std::size_t x = box.begin[0]; x < box.end[0]; ++x, ++sample) {
                if (!isOfBlock(x) || !isOfBlock(y) || !isOfBlock(z)) continue;
                const float distance =
                    std::min(std::sqrt(squares[isIn[sample] ? 0 : 1][sample]) * spacing_, background_);
                values[x - std::size_t(kBandMargin) +
                       kSide * (y - std::size_t(kBandMargin) + kSide * (z - std::size_t(kBandMargin)))] =
                    isIn[sample] ? -distance : distance;
            }
    return true;
}

Result<void> VdbLevelSet::writeUpper(Vec3i upper, const VdbSink& topology, const VdbSink& buffers) const {
    NodeMask<32768> children;
    const NodeMask<32768> tiles;
    std::vector<float> tileValues(32768, 0.0f);
    std::vector<std::vector<float>> kept;
    std::vector<Vec3i> bands;
    const Vec3i first = upper * kUpperSide;
    std::size_t number = 0;
    for (std::int32_t x = 0; x < kUpperSide; ++x)
        for (std::int32_t y = 0; y < kUpperSide; ++y)
            for (std::int32_t z = 0; z < kUpperSide; ++z, ++number) {
                const Vec3i block = first + Vec3i{x, y, z};
                bool isNear = true;
                for (int axis = 0; axis < 3; ++axis)
                    isNear = isNear && block[axis] >= -1 && block[axis] <= blocks_.count()[axis];
                const State state = isNear ? stateOf(block) : State::Outside;
                tileValues[number] = state == State::Inside ? -background_ : background_;
                if (state != State::Band) continue;
                children.set(number);
                bands.push_back(block);
            }
    VdbBytes bytes;
    appendBytes(bytes, first * VdbBlocks::kSide, children, tiles);
    NodeValues().putAll(bytes, tileValues);
    if (topology) SVT_DO(topology(bytes));
    std::vector<float> values(std::size_t{VdbBlocks::kSide} * VdbBlocks::kSide * VdbBlocks::kSide, background_);
    const LowerNode empty = lowerNode(values, background_);
    for (const Vec3i block : bands) {
        SVT_DO(checkNotStopped(blocks_.progress()));
        const LowerNode node = distances(block, values) ? lowerNode(values, background_) : empty;
        if (topology) SVT_DO(topology(node.topology));
        if (buffers) SVT_DO(buffers(node.buffers));
    }
    return {};
}

Result<void> VdbLevelSet::write(const VdbSink& topology, const VdbSink& buffers) const {
    // Upper nodes that have something: the band may lie in a block before or behind those of the volume.
    const auto before = [](Vec3i a, Vec3i b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::set<Vec3i, decltype(before)> uppers(before);
    const Vec3i count = blocks_.count();
    for (std::int32_t x = -1; x <= count.x; ++x)
        for (std::int32_t y = -1; y <= count.y; ++y)
            for (std::int32_t z = -1; z <= count.z; ++z) {
                const Vec3i upper{floorDivided(x, kUpperSide), floorDivided(y, kUpperSide),
                                  floorDivided(z, kUpperSide)};
                if (!uppers.contains(upper) && stateOf({x, y, z}) != State::Outside) uppers.insert(upper);
            }
    VdbBytes bytes;
    // Buffers of a leaf, background, tiles and children of the root.
    appendBytes(bytes, std::int32_t{1}, background_, std::uint32_t{0}, static_cast<std::uint32_t>(uppers.size()));
    if (topology) SVT_DO(topology(bytes));
    for (const Vec3i upper : uppers) SVT_DO(writeUpper(upper, topology, buffers));
    return {};
}

}  // namespace svt::writers
