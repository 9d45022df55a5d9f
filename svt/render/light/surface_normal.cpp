#include <svt/render/light/surface_normal.hpp>

#include <algorithm>
#include <cstdlib>

namespace svt::render {
namespace {

constexpr VoxelWindow makeBall() {
    VoxelWindow ball{};
    for (int z = 0; z < 7; ++z)
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 7; ++x)
                if (4 * ((x - 3) * (x - 3) + (y - 3) * (y - 3) + (z - 3) * (z - 3)) <= 7 * 7)
                    ball[static_cast<std::size_t>(z)] |= std::uint64_t{1} << (x + 8 * y);
    return ball;
}
constexpr VoxelWindow kBall = makeBall();
constexpr std::uint64_t kDisc = kBall[3];   // the ball's central layer: 37 cells
constexpr std::int32_t kDiscSquares = 108;  // sum of (x - 3)^2 over the disc, and of (y - 3)^2
constexpr std::uint64_t kMiddle = std::uint64_t{1} << (3 + 8 * 3);

// Population count, and sums of x - 3 and of y - 3 over the set bits. SIMD within a register: counts of pairs, then
// nibbles, then bytes, each with the sum of x of its bits. Written out because the baseline instruction set has no
// population count.
struct BitSums {
    std::int32_t count, x, y;

    explicit constexpr BitSums(std::uint64_t bits) noexcept : count(0), x(0), y(0) {
        constexpr std::uint64_t kPairs = 0x5555555555555555ull, kNibbles = 0x3333333333333333ull,
                                kBytes = 0x0F0F0F0F0F0F0F0Full;
        const std::uint64_t xOfPair = (bits >> 1) & kPairs;
        const std::uint64_t ofPair = bits - xOfPair;
        const std::uint64_t upper = (ofPair >> 2) & kNibbles;
        const std::uint64_t ofNibble = (ofPair & kNibbles) + upper;
        const std::uint64_t xOfNibble = (xOfPair & kNibbles) + ((xOfPair >> 2) & kNibbles) + 2 * upper;
        const std::uint64_t upperNibble = (ofNibble >> 4) & kBytes;
        const std::uint64_t ofByte = (ofNibble & kBytes) + upperNibble;
        const std::uint64_t xOfByte = (xOfNibble & kBytes) + ((xOfNibble >> 4) & kBytes) + 4 * upperNibble;
        count = sum(ofByte * 0x0101010101010101ull);
        x = sum(xOfByte * 0x0101010101010101ull) - 3 * count;
        y = sum(ofByte * 0x0001020304050607ull) - 3 * count;
    }

private:
    static constexpr std::int32_t sum(std::uint64_t product) noexcept {
        return static_cast<std::int32_t>(product >> 56);
    }
};
constexpr std::int32_t count(std::uint64_t bits) noexcept { return BitSums(bits).count; }

// Sum of seven one-bit numbers per cell, as bit-sliced digits: words of ones, twos and fours.
struct PlaceSums {
    std::uint64_t digits[3];

    explicit PlaceSums(const VoxelWindow& w) noexcept {
        const auto add = [](std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t& carry) {
            carry = (a & b) | (c & (a ^ b));
            return a ^ b ^ c;
        };
        std::uint64_t carryA, carryB, carryC;
        const std::uint64_t a = add(w[0], w[1], w[2], carryA);
        const std::uint64_t b = add(w[3], w[4], w[5], carryB);
        digits[0] = add(a, b, w[6], carryC);
        digits[1] = add(carryA, carryB, carryC, digits[2]);
    }
};

// First moment: the sum of the offsets of the body's voxels in the ball from the centre.
Vec3i momentOf(const VoxelWindow& body, const PlaceSums& sums) noexcept {
    Vec3i moment;
    for (std::int32_t z = 0; z < 7; ++z) moment.z += (z - 3) * count(body[static_cast<std::size_t>(z)]);
    for (int digit = 0; digit < 3; ++digit) {
        const BitSums ones(sums.digits[digit]);
        moment.x += ones.x * (1 << digit);
        moment.y += ones.y * (1 << digit);
    }
    return moment;
}

VoxelWindow inBall(const VoxelWindow& window) noexcept {
    VoxelWindow body;
    for (std::size_t z = 0; z < 7; ++z) body[z] = window[z] & kBall[z];
    return body;
}

// Transposes an 8 x 8 bit matrix, swapping x and y of a word (Warren, Hacker's Delight, 7-3).
constexpr std::uint64_t transposed(std::uint64_t a) noexcept {
    std::uint64_t t = (a ^ (a >> 7)) & 0x00AA00AA00AA00AAull;
    a ^= t ^ (t << 7);
    t = (a ^ (a >> 14)) & 0x0000CCCC0000CCCCull;
    a ^= t ^ (t << 14);
    t = (a ^ (a >> 28)) & 0x00000000F0F0F0F0ull;
    return a ^ t ^ (t << 28);
}

// The window as seven layers across `axis`, from inside (0) to outside (6) in the direction of `sign`. The bits of a
// layer run along (y, z), (x, z) or (x, y).
VoxelWindow layersAlong(const VoxelWindow& window, int axis, int sign) noexcept {
    VoxelWindow layers{};
    if (axis == 2) {
        layers = window;
    } else {
        for (int z = 0; z < 7; ++z) {
            const std::uint64_t word =
                axis == 1 ? window[static_cast<std::size_t>(z)] : transposed(window[static_cast<std::size_t>(z)]);
            for (int layer = 0; layer < 7; ++layer)
                layers[static_cast<std::size_t>(layer)] |= ((word >> (8 * layer)) & 0xFF) << (8 * z);
        }
    }
    if (sign < 0) std::reverse(layers.begin(), layers.end());
    return layers;
}

// The body's surface as a height field over the plane across an axis. Bit (p, q) of tops[h] is set if the voxel of
// layer h is body and the voxel of layer h + 1 is not.
struct Heights {
    VoxelWindow tops{};
    std::uint64_t places = 0;

    explicit Heights(const VoxelWindow& layers) noexcept {
        for (std::size_t h = 0; h < 6; ++h) {
            tops[h] = layers[h] & ~layers[h + 1];
            places |= tops[h];
        }
    }

    // Keeps one height per cell: those connected to the central cell by height steps of at most one voxel.
    void keepJoined() noexcept {
        VoxelWindow joined{};
        std::uint64_t reached = 0;
        // Seed: the height of the hit voxel's face, else the nearest one below or above.
        for (const std::size_t h : {2, 1, 3, 0, 4})
            if (reached == 0) reached = joined[h] = tops[h] & kMiddle;
        for (int round = 0; round < 3; ++round) {
            const std::uint64_t before = reached;
            std::uint64_t spread[8] = {};
            for (std::size_t h = 0; h < 6; ++h) {
                const std::uint64_t row = joined[h] | joined[h] << 1 | joined[h] >> 1;
                spread[h + 1] = row | row << 8 | row >> 8;
            }
            for (std::size_t h = 0; h < 6; ++h) {
                const std::uint64_t added = tops[h] & (spread[h] | spread[h + 1] | spread[h + 2]) & ~reached;
                joined[h] |= added;
                reached |= added;
            }
            if (reached == before) break;
        }
        tops = joined;
        places = reached;
    }
};

// Least-squares plane through the heights: slopes along p and q.
struct Slopes {
    double p = 0, q = 0;
    std::int32_t places = 0;  // number of heights fitted
    bool isValid = false;

    // Fits the heights in the disc around the centre. All sums are of integers, so they are exact.
    explicit Slopes(const Heights& heights) noexcept {
        const std::uint64_t disc = heights.places & kDisc;
        const BitSums all(disc);
        const std::int32_t n = places = all.count;
        if (n < kFacePlaces) return;
        // Sums of p, q, p p, q q, p q over the cells.
        const std::int32_t sp = all.x, sq = all.y;
        std::int32_t spp = kDiscSquares, sqq = kDiscSquares, spq = 0;
        if (disc != kDisc) {
            spp = sqq = 0;
            for (int row = 0; row < 7; ++row) {
                const BitSums inRow(disc & (0x7Full << (8 * row)));
                const int r = row - 3;
                sqq += r * r * inRow.count;
                spp += r * r * count(disc & (0x0001010101010101ull << row));
                spq += r * inRow.x;
            }
        }
        // Sums of h, h p, h q from the binary digits of the heights.
        const VoxelWindow& t = heights.tops;
        const std::uint64_t digits[3] = {(t[1] | t[3] | t[5]) & kDisc, (t[2] | t[3]) & kDisc, (t[4] | t[5]) & kDisc};
        std::int32_t sh = 0, shp = 0, shq = 0;
        for (int digit = 0; digit < 3; ++digit) {
            const BitSums ones(digits[digit]);
            sh += ones.count * (1 << digit);
            shp += ones.x * (1 << digit);
            shq += ones.y * (1 << digit);
        }
        const std::int64_t cpp = n * spp - sp * sp, cqq = n * sqq - sq * sq, cpq = n * spq - sp * sq;
        const std::int64_t chp = n * shp - sh * sp, chq = n * shq - sh * sq;
        const auto scale = static_cast<double>(cpp * cqq - cpq * cpq);
        isValid = scale > 0;
        if (!isValid) return;
        p = static_cast<double>(chp * cqq - chq * cpq) / scale;
        q = static_cast<double>(chq * cpp - chp * cpq) / scale;
    }

    // Whether the slopes are at most 1 and most of the disc has a height: then no other axis gives a better fit.
    [[nodiscard]] bool isGentle() const noexcept {
        return isValid && places >= kGentlePlaces && std::max(std::abs(p), std::abs(q)) <= 1;
    }
    [[nodiscard]] Vec3f normal(int axis, int sign) const noexcept {
        Vec3f n;
        n[axis] = static_cast<float>(sign);
        n[axis == 0 ? 1 : 0] = static_cast<float>(-p);
        n[axis == 2 ? 1 : 2] = static_cast<float>(-q);
        return n;
    }
};

Vec3f axisNormal(int axis, int sign) noexcept {
    Vec3f normal{};
    normal[axis] = static_cast<float>(sign);
    return normal;
}

int longestAxis(Vec3i v, int preferred) noexcept {
    int longest = preferred;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(v[axis]) > std::abs(v[longest])) longest = axis;
    return longest;
}

// Whether all tops along the axis are at the height of the hit face. Decides most hits without transposing the window
// to layers: tops along x are found by shifting bits within a byte, along y by shifting bytes within a word.
bool isFlatFace(const VoxelWindow& window, int axis, int sign) noexcept {
    std::uint64_t face = 0, other = 0;
    if (axis == 2) {
        for (std::size_t h = 0; h < 6; ++h) {
            const std::uint64_t top = sign > 0 ? window[h] & ~window[h + 1] : window[6 - h] & ~window[5 - h];
            (h == 2 ? face : other) |= top;
        }
    } else {
        const int step = axis == 0 ? 1 : 8;
        const std::uint64_t unit = axis == 0 ? 0x0001010101010101ull : 0x7Full;
        // Cells of layer 2, and of layers 0, 1, 3, 4, 5; layer h is coordinate h, or 6 - h if the sign is negative.
        const int middle = sign > 0 ? 2 : 4;
        std::uint64_t others = 0;
        for (int h = 0; h < 6; ++h)
            if (h != 2) others |= unit << (step * (sign > 0 ? h : 6 - h));
        for (int z = 0; z < 7; ++z) {
            const std::uint64_t word = window[static_cast<std::size_t>(z)];
            const std::uint64_t top = word & ~(sign > 0 ? word >> step : word << step);
            other |= top & others;
            const std::uint64_t places = (top >> (step * middle)) & unit;
            face |= axis == 0 ? places << z : places << (8 * z);
        }
    }
    return other == 0 && count(face) >= kFacePlaces;
}

}  // namespace

SurfaceNormal fitNormal(const VoxelWindow& window, int faceAxis, int faceSign) noexcept {
    const VoxelWindow body = inBall(window);
    SurfaceNormal normal{axisNormal(faceAxis, faceSign), 0};
    std::int32_t voxels = 0;
    const PlaceSums sums(body);
    for (int digit = 0; digit < 3; ++digit) voxels += count(sums.digits[digit]) * (1 << digit);
    normal.filledShare = static_cast<float>(voxels) / kBallVoxels;
    if (isFlatFace(window, faceAxis, faceSign)) return normal;

    Heights heights(layersAlong(window, faceAxis, faceSign));
    heights.keepJoined();
    if (heights.places == heights.tops[2] && count(heights.places) >= kFacePlaces) return normal;

    const Slopes onFace(heights);
    if (onFace.isGentle()) {
        normal.indexNormal = onFace.normal(faceAxis, faceSign);
        return normal;
    }
    const Vec3i moment = momentOf(body, sums);
    const int axis = longestAxis(moment, faceAxis);
    const int sign = moment[axis] > 0 ? -1 : 1;
    if (moment[axis] == 0) return normal;
    if (axis != faceAxis) {
        heights = Heights(layersAlong(window, axis, sign));
        heights.keepJoined();
    }
    const Slopes slopes = axis != faceAxis ? Slopes(heights) : onFace;
    const Vec3f fitted = slopes.isValid ? slopes.normal(axis, sign)
                                        : Vec3f{static_cast<float>(-moment.x), static_cast<float>(-moment.y),
                                                static_cast<float>(-moment.z)};
    // The fitted normal must not point away from the side of the face that was hit.
    if (fitted[faceAxis] * static_cast<float>(faceSign) > 0) normal.indexNormal = fitted;
    return normal;
}

}  // namespace svt::render
