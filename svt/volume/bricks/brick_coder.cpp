#include <svt/volume/bricks/brick_coder.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace svt::volume {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};
// Mask of the voxels whose next voxel along x (along y) is in the same brick.
constexpr std::uint64_t kNotLastX = 0x7F7F7F7F7F7F7F7Full, kNotLastY = 0x00FFFFFFFFFFFFFFull;
// A sample closer to a plane than this, in voxels, counts as on neither side.
constexpr double kMargin = 1e-6;

void addChanges(const std::uint64_t* words, Changes& changes) noexcept {
    for (std::size_t k = 0; k < 8; ++k) {
        changes[0][k] |= (words[k] ^ (words[k] >> 1)) & kNotLastX;
        changes[1][k] |= (words[k] ^ (words[k] >> 8)) & kNotLastY;
        if (k < 7) changes[2][k] |= words[k] ^ words[k + 1];
    }
}

// Projects `changes` to the axis: bit p is set if any voxels at p and p + 1 along it differ.
std::uint32_t placesOf(const SideMask& changes, int axis) noexcept {
    std::uint32_t found = 0;
    if (axis == 2) {
        for (std::size_t k = 0; k < 8; ++k) found |= static_cast<std::uint32_t>(changes[k] != 0) << k;
        return found;
    }
    std::uint64_t all = 0;
    for (const std::uint64_t word : changes) all |= word;
    for (int b = 0; b < 8; ++b) {
        const auto byte = static_cast<std::uint32_t>(all >> (8 * b)) & 0xFFu;
        found |= axis == 0 ? byte : static_cast<std::uint32_t>(byte != 0) << b;
    }
    return found;
}

SideMask cutMask(int axis, std::uint32_t cut) noexcept {
    SideMask mask;
    for (std::uint32_t k = 0; k < 8; ++k)
        mask[k] = axis == 0   ? 0x0101010101010101ull * ((0xFFu << cut) & 0xFFu)
                  : axis == 1 ? kAll << (8 * cut)
                  : k >= cut  ? kAll
                              : 0;
    return mask;
}

// Palette index of all voxels in `part`; nullopt if they differ.
std::optional<std::uint32_t> indexIn(const BrickPattern& pattern, const SideMask& part) noexcept {
    std::uint32_t index = 0;
    for (std::size_t p = 0; 8 * p < pattern.bitPlanes.size(); ++p) {
        std::uint64_t ones = 0, zeros = 0;
        for (std::size_t k = 0; k < 8; ++k) {
            ones |= pattern.bitPlanes[8 * p + k] & part[k];
            zeros |= ~pattern.bitPlanes[8 * p + k] & part[k];
        }
        if (ones != 0 && zeros != 0) return std::nullopt;
        if (ones != 0) index |= std::uint32_t{1} << p;
    }
    return index;
}

// Finds the label of each side combination; returns false if one has voxels of two labels. Those without a sample are
// slivers between the others. They take the label of the nearest combination with samples. Crossing a cut costs less
// than crossing a plane. Crossing a later plane costs less than an earlier one, because it is less likely to be a face
// of the model.
bool findSideScalars(const BrickPattern& pattern, std::span<const SideMask> sides, std::size_t cuts,
                     std::vector<Scalar>& scalars) {
    const std::size_t count = std::size_t{1} << sides.size();
    std::array<SideMask, std::size_t{1} << BrickVolume::kMaxSides> parts;  // by combination of the sides so far
    parts[0].fill(kAll);
    for (std::size_t s = 0; s < sides.size(); ++s)
        for (std::size_t part = 0; part < std::size_t{1} << s; ++part) {
            SideMask &below = parts[part], &beyond = parts[part | std::size_t{1} << s];
            for (std::size_t k = 0; k < 8; ++k) {
                beyond[k] = below[k] & sides[s][k];
                below[k] &= ~sides[s][k];
            }
        }
    std::array<Scalar, std::size_t{1} << BrickVolume::kMaxSides> found{};
    std::uint64_t known = 0;
    for (std::size_t combination = 0; combination < count; ++combination) {
        const SideMask& mask = parts[combination];
        std::uint64_t any = 0;
        for (const std::uint64_t word : mask) any |= word;
        if (any == 0) continue;
        const auto index = indexIn(pattern, mask);
        if (!index) return false;
        found[combination] = pattern.palette[*index];
        known |= std::uint64_t{1} << combination;
    }
    scalars.assign(found.begin(), found.begin() + std::ptrdiff_t(count));
    fillUnknown(
        sides.size(), known, [&](std::size_t s) { return s < cuts ? 1 : std::size_t{1} << (sides.size() - s); },
        scalars);
    return true;
}

}  // namespace

BrickSide::BrickSide(const SideMask& sideMask) noexcept : mask(sideMask) { addChanges(mask.data(), changes); }

Changes findChanges(const BrickPattern& pattern) noexcept {
    Changes changes{};
    for (std::size_t p = 0; 8 * p < pattern.bitPlanes.size(); ++p)
        addChanges(pattern.bitPlanes.data() + 8 * p, changes);
    return changes;
}

namespace {

// Two changes along one axis at different places that no plane of a set explains and a single cut cannot explain both.
struct CutConflict {
    int axis = -1;  // none
    std::array<std::size_t, 2> word{};
    std::array<std::uint64_t, 2> bit{};

    // Whether the side explains change n.
    [[nodiscard]] bool isExplained(std::size_t n, const BrickSide& side) const noexcept {
        return (side.changes[static_cast<std::size_t>(axis)][word[n]] & bit[n]) != 0;
    }
};

// The voxel with the lowest place along the axis (or the highest) in a mask that is not empty.
void findExtreme(const SideMask& mask, int axis, bool isHighest, std::size_t& word, std::uint64_t& bit) noexcept {
    const std::uint32_t places = placesOf(mask, axis);
    if (places == 0) return;  // not for masks that this file passes
    const auto place = static_cast<std::uint32_t>(isHighest ? std::bit_width(places) - 1 : std::countr_zero(places));
    const std::uint64_t layer = axis == 0 ? 0x0101010101010101ull << place : axis == 1 ? 0xFFull << (8 * place) : kAll;
    word = axis == 2 ? place : 0;
    while ((mask[word] & layer) == 0) ++word;
    bit = mask[word] & layer;
    bit &= ~bit + 1;
}

// As codeBySides(), but planes beyond kMaxPlanes replace cuts that the code does not have. If two changes make a cut
// impossible, `conflict` receives them.
std::optional<BrickCode> codeByPlanes(const BrickPattern& pattern, const Changes& changes,
                                      std::span<const BrickSide* const> planes, CutConflict& conflict) {
    BrickCode code;
    std::array<SideMask, BrickVolume::kMaxSides> sides;
    std::size_t count = 0, inCuts = std::min(planes.size(), BrickVolume::kMaxPlanes);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        SideMask rest = changes[a];  // changes that no plane explains
        for (const BrickSide* plane : planes)
            for (std::size_t k = 0; k < 8; ++k) rest[k] &= ~plane->changes[a][k];
        const std::uint32_t cuts = placesOf(rest, axis);
        if (cuts == 0) {
            if (inCuts < planes.size()) sides[count++] = planes[inCuts++]->mask;
            continue;
        }
        if ((cuts & (cuts - 1)) != 0) {
            conflict.axis = axis;
            for (const std::size_t n : {0, 1}) findExtreme(rest, axis, n == 1, conflict.word[n], conflict.bit[n]);
            return std::nullopt;
        }
        code.cut[a] = static_cast<std::uint8_t>(std::countr_zero(cuts) + 1);
        sides[count++] = cutMask(axis, code.cut[a]);
    }
    if (inCuts < planes.size()) return std::nullopt;
    const std::size_t cuts = count;
    for (const BrickSide* plane : planes.first(std::min(planes.size(), BrickVolume::kMaxPlanes)))
        sides[count++] = plane->mask;
    if (!findSideScalars(pattern, std::span(sides).first(count), cuts, code.sideScalars)) return std::nullopt;
    return code;
}

// Sets the numbers of the planes of a code from codeByPlanes(), in the order in which the planes were given.
void setPlanes(std::span<const std::uint32_t> numbers, BrickCode& code) {
    const std::size_t own = std::min(numbers.size(), BrickVolume::kMaxPlanes);
    std::copy(numbers.begin(), numbers.begin() + std::ptrdiff_t(own), code.plane.begin());
    std::size_t next = own;
    for (std::size_t axis = 0; axis < 3 && next < numbers.size(); ++axis)
        if (code.cut[axis] == 0) code.cutPlane[axis] = numbers[next++];
}

}  // namespace

std::optional<BrickCode> codeBySides(const BrickPattern& pattern, const Changes& changes,
                                     std::initializer_list<const BrickSide*> planes) {
    CutConflict conflict;
    return codeByPlanes(pattern, changes, {planes.begin(), planes.size()}, conflict);
}

namespace {

// A pattern of two labels as a height field over one axis: the count of voxels of the lower label in each line.
struct Heights {
    bool isSurface = false;  // each line along the axis changes at most once, always with the same label below
    std::array<std::int8_t, 64> height{};  // at p + 8 q, where p and q run along the other two axes
    Scalar low = 0, high = 0;
};

constexpr std::array<std::array<int, 2>, 3> kAcross{{{1, 2}, {0, 2}, {0, 1}}};

Heights heightsAlong(const BrickPattern& pattern, int axis) {
    Heights heights;
    if (pattern.palette.size() != 2) return heights;
    const auto bit = [&](int p, int q, int h) {
        const int i = axis == 0 ? h : p, j = axis == 0 ? p : axis == 1 ? h : q, k = axis == 2 ? h : q;
        return static_cast<int>(pattern.bitPlanes[std::size_t(k)] >> (i + 8 * j)) & 1;
    };
    int low = -1;
    for (int q = 0; q < 8; ++q)
        for (int p = 0; p < 8; ++p) {
            int line = 0;
            for (int h = 0; h < 8; ++h) line |= bit(p, q, h) << h;
            if (line == 0 || line == 0xFF) continue;
            const int first = line & 1;
            if (low < 0) low = first;
            // The upper label must fill the line from its first voxel to the top.
            const int above = first != 0 ? ~line & 0xFF : line;
            if (low != first || above + (above & -above) != 0x100) return heights;
        }
    if (low < 0) return heights;
    for (int q = 0; q < 8; ++q)
        for (int p = 0; p < 8; ++p) {
            int count = 0;
            for (int h = 0; h < 8; ++h) count += bit(p, q, h) == low ? 1 : 0;
            heights.height[std::size_t(p + 8 * q)] = static_cast<std::int8_t>(count);
        }
    heights.isSurface = true;
    heights.low = pattern.palette[std::size_t(low)];
    heights.high = pattern.palette[std::size_t(1 - low)];
    return heights;
}

int steepestAxis(const BrickPattern& pattern) noexcept {
    const Changes changes = findChanges(pattern);
    int best = 0, most = -1;
    for (int axis = 0; axis < 3; ++axis) {
        int count = 0;
        for (const std::uint64_t word : changes[std::size_t(axis)]) count += std::popcount(word);
        if (count > most) best = axis, most = count;
    }
    return best;
}

// A plane as height over (p, q): a p + b q + c, in voxels from the corner of the brick.
struct Slope {
    double a = 0, b = 0, c = 0;
    [[nodiscard]] double at(double p, double q) const noexcept { return a * p + b * q + c; }
};

// Least-squares fit of a Slope to samples (p, q, h).
class SlopeFit {
public:
    void add(double p, double q, double h) noexcept {
        n_ += 1;
        p_ += p, q_ += q, h_ += h;
        pp_ += p * p, pq_ += p * q, qq_ += q * q, ph_ += p * h, qh_ += q * h;
    }
    [[nodiscard]] std::optional<Slope> solve() const noexcept {
        if (n_ < 6) return std::nullopt;
        const double pp = pp_ - p_ * p_ / n_, pq = pq_ - p_ * q_ / n_, qq = qq_ - q_ * q_ / n_;
        const double ph = ph_ - p_ * h_ / n_, qh = qh_ - q_ * h_ / n_;
        const double determinant = pp * qq - pq * pq;
        if (!(determinant > 0.02 * n_ * n_)) return std::nullopt;  // the samples are (nearly) collinear
        Slope slope;
        slope.a = (ph * qq - qh * pq) / determinant;
        slope.b = (qh * pp - ph * pq) / determinant;
        slope.c = (h_ - slope.a * p_ - slope.b * q_) / n_;
        return slope;
    }

private:
    double n_ = 0, p_ = 0, q_ = 0, h_ = 0, pp_ = 0, pq_ = 0, qq_ = 0, ph_ = 0, qh_ = 0;
};

// Shifts the plane up or down by the least amount that separates the voxels of the brick; false if none does.
bool shiftToSeparate(const Heights& heights, Slope& slope) noexcept {
    double low = -1e9, high = 1e9;
    for (int q = 0; q < 8; ++q)
        for (int p = 0; p < 8; ++p) {
            const int h = heights.height[std::size_t(p + 8 * q)];
            const double rest = h - (slope.a * (p + 0.5) + slope.b * (q + 0.5));
            if (h > 0) low = std::max(low, rest - 0.5);
            if (h < 8) high = std::min(high, rest + 0.5);
        }
    const double room = high - low;
    if (!(room > 1e-4)) return false;
    const double inset = std::min(0.02, room / 4);
    slope.c = std::clamp(slope.c, low + inset, high - inset);
    return true;
}

// True for planes across an axis: they are handled as cuts between voxels.
bool isAcrossAxis(Vec3d normal) noexcept {
    return std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}) > 1 - 1e-12;
}

double valueAt(const BrickPlane& plane, Vec3d point) noexcept { return dot(plane.normal, point) + plane.offset; }

constexpr std::array<Vec3i, 26> makeNeighbors() {
    std::array<Vec3i, 26> neighbors;
    std::size_t count = 0;
    for (int distance = 1; distance <= 3; ++distance)
        for (std::int32_t z = -1; z <= 1; ++z)
            for (std::int32_t y = -1; y <= 1; ++y)
                for (std::int32_t x = -1; x <= 1; ++x)
                    if (x * x + y * y + z * z == distance) neighbors[count++] = {x, y, z};
    return neighbors;
}
constexpr std::array<Vec3i, 26> kNeighbors = makeNeighbors();

class TileCoder {
public:
    TileCoder(const TilePlaces& places, const std::vector<BrickPattern>& patterns,
              const std::vector<std::uint8_t>& kindOfPattern, std::span<const FacePlane> faces)
        : places_(places),
          patterns_(patterns),
          kindOfPattern_(kindOfPattern),
          knowsFaces_(!faces.empty()),
          heights_(patterns.size()),
          faces_(patterns.size()),
          codeIndex_(places.patternOf.size(), kNone) {
        for (int axis = 0; axis < 3; ++axis)
            cutPlanes_[std::size_t(axis)].resize(std::size_t(8 * places_.count[axis]) + 1);
        for (const FacePlane& face : faces)
            if (isAcrossAxis(face.plane.normal))
                addCutPlane(face);
            else
                addFacePlane(face);
    }

    TileCodes code() {
        findMixed();
        if (hasFacePlanes_)
            forEachMixed([&](Vec3i at) {
                if (needsCode(at) || isStep(at)) codeByFaces(at);
            });
        forEachMixed([&](Vec3i at) {
            if (needsCode(at) && patternAt(at).palette.size() == 2) codeSurface(at, true);
        });
        forEachMixed([&](Vec3i at) {
            if (!isStep(at)) return;
            if (patternAt(at).palette.size() == 2)
                codeSurface(at, false);
            else
                codeJunction(at);
        });
        forEachMixed([&](Vec3i at) {
            if (needsCode(at)) codeJunction(at);
        });
        extendToUniformNeighbors();
        std::sort(result_.codes.begin(), result_.codes.end(),
                  [](const PlacedCode& p, const PlacedCode& q) { return p.place < q.place; });
        return std::move(result_);
    }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    // Maximum candidates per brick: planes of the model, planes where surfaces meet, cuts; and those tried in triples.
    // At most 32 in total.
    static constexpr std::size_t kMaxFaces = 12, kMaxAround = 8, kMaxCuts = 4, kMaxOfThree = 7;
    // The same for bricks that may contain sheets; the planes of one code there, and the tried sets of more than three.
    static constexpr std::size_t kMaxOfSheets = 16, kMostPlanesOfSheets = 5, kMaxSetsOfSheets = 500;

    // Finds the mixed bricks that cuts do not certainly code, in the order of places.
    void findMixed() {
        std::size_t place = 0;
        for (std::int32_t z = 0; z < places_.count.z; ++z)
            for (std::int32_t y = 0; y < places_.count.y; ++y)
                for (std::int32_t x = 0; x < places_.count.x; ++x, ++place)
                    if (const std::uint32_t pattern = places_.patternOf[place];
                        pattern != TilePlaces::kUniform &&
                        kindOfPattern_[pattern] != static_cast<std::uint8_t>(BrickKind::Coded))
                        mixed_.push_back({x, y, z});
    }
    template <class Body>
    void forEachMixed(const Body& body) const {
        for (const Vec3i at : mixed_) body(at);
    }
    // The 26 neighbours of `at`: those across faces first, then edges, then corners.
    template <class Body>
    void forEachNeighbor(Vec3i at, const Body& body) const {
        for (const Vec3i away : kNeighbors)
            if (isInside(at + away)) body(at + away);
    }
    [[nodiscard]] bool isInside(Vec3i at) const noexcept {
        return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < places_.count.x && at.y < places_.count.y &&
               at.z < places_.count.z;
    }
    [[nodiscard]] std::size_t place(Vec3i at) const noexcept { return places_.at(at.x, at.y, at.z); }
    [[nodiscard]] bool isMixed(Vec3i at) const noexcept { return places_.patternOf[place(at)] != TilePlaces::kUniform; }
    [[nodiscard]] const BrickPattern& patternAt(Vec3i at) const noexcept {
        return patterns_[places_.patternOf[place(at)]];
    }
    [[nodiscard]] bool needsCode(Vec3i at) const noexcept {
        return isMixed(at) &&
               kindOfPattern_[places_.patternOf[place(at)]] == static_cast<std::uint8_t>(BrickKind::Uncoded) &&
               codeIndex_[place(at)] == kNone;
    }
    [[nodiscard]] const BrickCode* codeAt(Vec3i at) const noexcept {
        const std::uint32_t number = codeIndex_[place(at)];
        return number == kNone ? nullptr : &result_.codes[number].code;
    }
    [[nodiscard]] Vec3d corner(Vec3i at) const noexcept {
        return {places_.origin.x + 8.0 * at.x, places_.origin.y + 8.0 * at.y, places_.origin.z + 8.0 * at.z};
    }

    const Heights& heightsAt(Vec3i at, int axis) {
        auto& known = heights_[places_.patternOf[place(at)]];
        auto& heights = known[std::size_t(axis)];
        if (!heights) heights = heightsAlong(patternAt(at), axis);
        return *heights;
    }

    // The side of each sample; nullopt if a sample is within kMargin of the plane.
    [[nodiscard]] std::optional<SideMask> sideMask(const BrickPlane& plane, Vec3i at) const noexcept {
        SideMask mask;
        if (!findSides(valueAt(plane, corner(at) + Vec3d{0.5, 0.5, 0.5}), plane.normal, kMargin, mask))
            return std::nullopt;
        return mask;
    }

    // The side of all samples: 1 if it is the positive one; nullopt if there are two, or a sample is within kMargin of
    // the plane. As sideMask(), but usually without a test of each sample.
    [[nodiscard]] std::optional<std::size_t> sideOfAll(const BrickPlane& plane, Vec3i at) const noexcept {
        constexpr double kRounding = 1e-8;
        const double middle = valueAt(plane, corner(at) + Vec3d{4, 4, 4});
        const double reach = 3.5 * (std::abs(plane.normal.x) + std::abs(plane.normal.y) + std::abs(plane.normal.z));
        if (std::abs(middle) > reach + kMargin + kRounding) return middle > 0 ? 1 : 0;
        if (std::abs(middle) < reach - kMargin - kRounding) return std::nullopt;
        const auto mask = sideMask(plane, at);
        if (!mask || !isTrivial(*mask)) return std::nullopt;
        return (*mask)[0] != 0 ? 1 : 0;
    }

    void setCode(Vec3i at, BrickCode code) {
        codeIndex_[place(at)] = static_cast<std::uint32_t>(result_.codes.size());
        result_.codes.push_back({static_cast<std::uint32_t>(place(at)), std::move(code)});
    }

    bool tryPlane(Vec3i at, std::uint32_t plane) {
        const auto mask = sideMask(result_.planes[plane], at);
        if (!mask) return false;
        const BrickSide side(*mask);
        auto code = codeBySides(patternAt(at), findChanges(patternAt(at)), {&side});
        if (!code || code->cut != std::array<std::uint8_t, 3>{}) return false;
        code->plane[0] = plane;
        setCode(at, std::move(*code));
        return true;
    }

    // True if cuts code the brick, but it may be a step of a sloped surface.
    [[nodiscard]] bool isStep(Vec3i at) const noexcept {
        return isMixed(at) && codeIndex_[place(at)] == kNone &&
               kindOfPattern_[places_.patternOf[place(at)]] == static_cast<std::uint8_t>(BrickKind::Step);
    }

    // Codes a height field of two labels by a neighbour's plane, else by a fitted one. `mayStandAlone`: also accept a
    // plane that is fitted to only this brick.
    void codeSurface(Vec3i at, bool mayStandAlone) {
        std::array<std::uint32_t, 4> tried{kNone, kNone, kNone, kNone};
        std::size_t count = 0;
        bool isDone = false;
        forEachNeighbor(at, [&](Vec3i other) {
            const BrickCode* code = codeAt(other);
            if (isDone || code == nullptr || count == tried.size()) return;
            if (std::find(tried.begin(), tried.end(), code->plane[0]) != tried.end()) return;
            tried[count++] = code->plane[0];
            isDone = tryPlane(at, code->plane[0]);
        });
        if (isDone) return;
        const int axis = steepestAxis(patternAt(at));
        const Heights& own = heightsAt(at, axis);
        if (!own.isSurface) return;
        auto local = fit(own);
        if (!local) return;
        auto wide = fitAround(at, axis, own, *local);
        if (shiftToSeparate(own, wide)) {
            if (addPlane(at, axis, wide)) return;
        }
        if (mayStandAlone && shiftToSeparate(own, *local)) addPlane(at, axis, *local);
    }

    static std::optional<Slope> fit(const Heights& heights) noexcept {
        SlopeFit sums;
        for (int q = 0; q < 8; ++q)
            for (int p = 0; p < 8; ++p) {
                const int h = heights.height[std::size_t(p + 8 * q)];
                if (h > 0 && h < 8) sums.add(p + 0.5, q + 0.5, h);
            }
        return sums.solve();
    }

    // Refines the fit with the height fields of the neighbours, as far as they continue this one.
    Slope fitAround(Vec3i at, int axis, const Heights& own, Slope slope) {
        for (const double tolerance : {1.25, 0.8}) {
            SlopeFit sums;
            const auto add = [&](Vec3i other, const Heights& heights) {
                const Vec3i away = (other - at) * 8;
                const int p0 = away[kAcross[std::size_t(axis)][0]], q0 = away[kAcross[std::size_t(axis)][1]];
                for (int q = 0; q < 8; ++q)
                    for (int p = 0; p < 8; ++p) {
                        const int h = heights.height[std::size_t(p + 8 * q)];
                        if (h <= 0 || h >= 8) continue;
                        const double x = p0 + p + 0.5, y = q0 + q + 0.5, z = away[axis] + h;
                        if (std::abs(z - slope.at(x, y)) <= tolerance) sums.add(x, y, z);
                    }
            };
            add(at, own);
            forEachNeighbor(at, [&](Vec3i other) {
                if (!isMixed(other) || patternAt(other).palette.size() != 2) return;
                const Heights& heights = heightsAt(other, axis);
                if (heights.isSurface && heights.low == own.low && heights.high == own.high) add(other, heights);
            });
            const auto better = sums.solve();
            if (!better) break;
            slope = *better;
        }
        return slope;
    }

    [[nodiscard]] BrickPlane planeOf(Vec3i at, int axis, const Slope& slope) const noexcept {
        BrickPlane plane;
        plane.normal[axis] = 1;
        plane.normal[kAcross[std::size_t(axis)][0]] = -slope.a;
        plane.normal[kAcross[std::size_t(axis)][1]] = -slope.b;
        const double scale = 1 / length(plane.normal);
        plane.normal = plane.normal * scale;
        plane.offset = -slope.c * scale - dot(plane.normal, corner(at));
        return plane;
    }

    bool addPlane(Vec3i at, int axis, const Slope& slope) {
        result_.planes.push_back(planeOf(at, axis, slope));
        if (tryPlane(at, static_cast<std::uint32_t>(result_.planes.size() - 1))) return true;
        result_.planes.pop_back();
        return false;
    }

    // Tries the planes of the model's faces near the brick.
    void codeByFaces(Vec3i at) {
        startCandidates(at);
        addFacePlanes(at, kMaxFaces);
        if (isStep(at)) {
            // Cuts code it already. Prefer planes, unless the model has faces where the cuts are.
            const auto own = codeBySides(patternAt(at), changes_);
            if (!own || hasCutsOfModel(*own, at)) return;
            if (!tryCandidates(at, 0)) codeBySheets(at);
            return;
        }
        if (!sides_.empty()) {
            addCuts(at, kMaxFaces + kMaxCuts);
            if (tryCandidates(at, 0)) return;
        }
        codeBySheets(at);
    }

    // Tries more than three planes of faces, then also planes of the backs of sheets. The voxels of a sheet are the
    // samples behind its face that have a neighbour along an axis in front of it. So they end on a plane, too. Its
    // distance behind the face is the largest component of the normal.
    void codeBySheets(Vec3i at) {
        for (const bool withBacks : {false, true}) {
            startCandidates(at);
            addSheetPlanes(at, withBacks);
            if (sides_.empty()) continue;
            mayBeSheet_ = withBacks;
            addCuts(at, sides_.size() + kMaxCuts);
            const bool isDone = (withBacks && tryCandidates(at, 0)) || tryMoreThanThree(at);
            mayBeSheet_ = false;
            if (isDone) return;
        }
    }
    void addSheetPlanes(Vec3i at, bool withBacks) {
        for (const ColumnFace& face : facesOfColumn_[std::size_t(at.x + kColumns * at.y)]) {
            if (at.z < face.min || at.z > face.max) continue;
            const Vec3d n = face.plane.normal;
            const double depth = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
            for (const double behind : {0.0, depth, -depth}) {
                if (sides_.size() == kMaxOfSheets || (behind != 0 && !withBacks)) break;
                BrickPlane plane = face.plane;
                plane.offset += behind;
                if (cutsBox(plane, at)) addCandidate(plane, sideMask(plane, at));
            }
        }
    }

    // Tries sets of four and more candidates.
    bool tryMoreThanThree(Vec3i at) {
        std::array<std::size_t, BrickVolume::kMaxSides> set{};
        std::size_t budget = kMaxSetsOfSheets;
        if (sides_.size() <= BrickVolume::kMaxPlanes) return false;
        conflicts_.clear();
        return tryLarger(at, set, 0, 0, budget);
    }
    bool tryLarger(Vec3i at, std::array<std::size_t, BrickVolume::kMaxSides>& set, std::size_t count, std::size_t from,
                   std::size_t& budget) {
        for (std::size_t next = from; next < sides_.size(); ++next) {
            set[count] = next;
            const std::size_t size = count + 1;
            if (size > BrickVolume::kMaxPlanes) {
                if (budget == 0) return false;
                --budget;
                if (trySides(at, std::span(set).first(size))) return true;
            }
            if (size < kMostPlanesOfSheets && tryLarger(at, set, size, next + 1, budget)) return true;
        }
        return false;
    }

    // Whether the model has a face at each cut of the code, or one voxel beside it if the brick may contain sheets.
    // True if no faces are known.
    [[nodiscard]] bool hasCutsOfModel(const BrickCode& code, Vec3i at) const noexcept {
        if (!knowsFaces_) return true;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            if (code.cut[a] == 0) continue;
            const std::int32_t cut = 8 * at[axis] + code.cut[a], away = mayBeSheet_ ? 1 : 0;
            bool isOfModel = false;
            for (std::int32_t near = cut - away; near <= cut + away && !isOfModel; ++near)
                isOfModel = hasFaceAt(a, near, at);
            if (!isOfModel) return false;
        }
        return true;
    }
    [[nodiscard]] bool hasFaceAt(std::size_t axis, std::int32_t cut, Vec3i at) const noexcept {
        if (cut < 0 || static_cast<std::size_t>(cut) >= cutPlanes_[axis].size()) return false;
        const auto& faces = cutPlanes_[axis][static_cast<std::size_t>(cut)];
        return std::any_of(faces.begin(), faces.end(), [&](const BrickRange& range) { return range.has(at); });
    }

    // Bricks of the tile, including max.
    struct BrickRange {
        std::array<std::int16_t, 3> min{}, max{};
        [[nodiscard]] bool has(Vec3i at) const noexcept {
            return at.x >= min[0] && at.x <= max[0] && at.y >= min[1] && at.y <= max[1] && at.z >= min[2] &&
                   at.z <= max[2];
        }
    };
    // The bricks that contain faces of the plane, and those next to the faces.
    [[nodiscard]] BrickRange bricksBeside(const FacePlane& face) const noexcept {
        BrickRange range;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int32_t first = face.min[a] - 8 - places_.origin[axis],
                               last = face.max[a] - places_.origin[axis];
            range.min[a] = static_cast<std::int16_t>(std::max((first + 7) >> 3, 0));
            range.max[a] = static_cast<std::int16_t>(std::min(last >> 3, places_.count[axis] - 1));
        }
        return range;
    }
    // A plane across an axis is listed at each cut that lies with it between the same samples.
    void addCutPlane(const FacePlane& face) {
        const BrickRange range = bricksBeside(face);
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(face.plane.normal[axis]) > 0.5)) continue;
            const double place = -face.plane.offset * face.plane.normal[axis] - places_.origin[axis];
            auto& byCut = cutPlanes_[std::size_t(axis)];
            const double most = static_cast<double>(byCut.size()) - 1;
            const auto first = static_cast<std::int32_t>(std::clamp(std::floor(place) - 1, 0.0, most));
            const auto last = static_cast<std::int32_t>(std::clamp(std::ceil(place) + 1, 0.0, most));
            for (std::int32_t cut = first; cut <= last; ++cut)
                if (std::abs(face.plane.offset * face.plane.normal[axis] + (places_.origin[axis] + double(cut))) <= 0.5)
                    byCut[std::size_t(cut)].push_back(range);
        }
    }
    void addFacePlane(const FacePlane& face) {
        hasFacePlanes_ = true;
        const BrickRange range = bricksBeside(face);
        for (std::int32_t y = range.min[1]; y <= range.max[1]; ++y)
            for (std::int32_t x = range.min[0]; x <= range.max[0]; ++x)
                facesOfColumn_[std::size_t(x + kColumns * y)].push_back({face.plane, range.min[2], range.max[2]});
    }

    void startCandidates(Vec3i at) {
        candidates_.clear();
        sides_.clear();
        changes_ = findChanges(patternAt(at));
    }

    void addFacePlanes(Vec3i at, std::size_t most) {
        for (const ColumnFace& face : facesOfColumn_[std::size_t(at.x + kColumns * at.y)]) {
            if (sides_.size() == most) return;
            if (at.z >= face.min && at.z <= face.max && cutsBox(face.plane, at))
                addCandidate(face.plane, sideMask(face.plane, at));
        }
    }

    // Codes a brick where surfaces meet: by planes of the model and of the neighbours, and further cuts across an axis;
    // then by fitted planes.
    void codeJunction(Vec3i at) {
        startCandidates(at);
        if (!isStep(at)) addFacePlanes(at, kMaxAround - 2);
        forEachNeighbor(at, [&](Vec3i other) {
            const BrickCode* code = codeAt(other);
            if (code == nullptr) return;
            for (const std::uint32_t number : code->plane) {
                if (number == BrickVolume::kNoPlane || sides_.size() == kMaxAround) continue;
                const BrickPlane& plane = result_.planes[number];
                if (!cutsBox(plane, at) ||
                    std::find(candidates_.begin(), candidates_.end(), plane) != candidates_.end())
                    continue;
                addCandidate(plane, sideMask(plane, at));
            }
        });
        if (!isStep(at)) addCuts(at, kMaxAround + kMaxCuts);
        if (tryCandidates(at, 0) || isStep(at)) return;
        const std::size_t known = sides_.size();
        addFitted(at);
        if (sides_.size() > known) tryCandidates(at, known);
    }

    // Tries one, two and three candidates, at least one of them with index `from` or higher. Additional cuts must be at
    // faces of the model: otherwise they are steps of an oblique face that is not among the candidates, and voxels look
    // better.
    bool tryCandidates(Vec3i at, std::size_t from) {
        conflicts_.clear();
        for (std::size_t a = from; a < sides_.size(); ++a)
            if (trySides(at, {a})) return true;
        for (std::size_t b = std::max<std::size_t>(from, 1); b < sides_.size(); ++b)
            for (std::size_t a = 0; a < b; ++a)
                if (trySides(at, {a, b})) return true;
        const std::size_t end = std::min(sides_.size(), kMaxOfThree);
        for (std::size_t c = std::max<std::size_t>(from, 2); c < end; ++c)
            for (std::size_t b = 1; b < c; ++b)
                for (std::size_t a = 0; a < b; ++a)
                    if (trySides(at, {a, b, c})) return true;
        return false;
    }

    // Most sets of candidates fail for one of a few reasons. So these are stored: two changes that one cut cannot
    // explain, as the candidates that explain either change.
    bool trySides(Vec3i at, std::initializer_list<std::size_t> candidates) {
        return trySides(at, std::span(candidates.begin(), candidates.size()));
    }
    bool trySides(Vec3i at, std::span<const std::size_t> candidates) {
        std::uint32_t set = 0;
        for (const std::size_t candidate : candidates) set |= 1u << candidate;
        for (std::size_t n = 0; n < conflicts_.size(); ++n) {
            if ((set & conflicts_[n][0]) != 0 || (set & conflicts_[n][1]) != 0) continue;
            if (n > 0) std::swap(conflicts_[n], conflicts_[n - 1]);
            return false;
        }
        std::array<const BrickSide*, BrickVolume::kMaxSides> sides{};
        std::array<std::uint32_t, BrickVolume::kMaxSides> numbers{};
        std::size_t count = 0;
        for (const std::size_t candidate : candidates) sides[count++] = &sides_[candidate];
        CutConflict conflict;
        auto code = codeByPlanes(patternAt(at), changes_, std::span(sides).first(count), conflict);
        if (conflict.axis >= 0) addConflict(conflict);
        if (!code || !hasCutsOfModel(*code, at)) return false;
        count = 0;
        for (const std::size_t candidate : candidates) numbers[count++] = numberOf(candidates_[candidate]);
        setPlanes(std::span(numbers).first(count), *code);
        setCode(at, std::move(*code));
        return true;
    }
    void addConflict(const CutConflict& conflict) {
        std::array<std::uint32_t, 2> explained{};
        for (std::size_t s = 0; s < sides_.size(); ++s)
            for (const std::size_t n : {0, 1})
                if (conflict.isExplained(n, sides_[s])) explained[n] |= 1u << s;
        conflicts_.push_back(explained);
    }

    // Adds a candidate; false if it separates no voxels, or the same voxels as another candidate.
    bool addCandidate(const BrickPlane& plane, const std::optional<SideMask>& mask) {
        if (!mask || isTrivial(*mask)) return false;
        if (std::any_of(sides_.begin(), sides_.end(), [&](const BrickSide& side) { return side.mask == *mask; }))
            return false;
        candidates_.push_back(plane);
        sides_.emplace_back(*mask);
        return true;
    }

    // Adds planes fitted by least squares to the voxel faces between two labels, for each axis and pair of labels.
    void addFitted(Vec3i at) {
        constexpr std::size_t kMaxPairs = 4, kMinFaces = 8;
        struct Pair {
            int axis;
            Scalar low, high;
            std::size_t faces;
        };
        std::vector<Pair> pairs;
        for (int axis = 0; axis < 3; ++axis)
            for (const FaceGroup& group : facesAt(at)[std::size_t(axis)].groups)
                if (group.size() >= kMinFaces) pairs.push_back({axis, group.low, group.high, group.size()});
        std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.faces > q.faces; });
        std::size_t added = 0;
        for (const Pair& pair : pairs) {
            if (added == kMaxPairs) break;
            const auto slope = fitFaces(at, pair.axis, pair.low, pair.high);
            // Steeper planes are found over another axis.
            if (!slope || std::max(std::abs(slope->a), std::abs(slope->b)) > 1.3) continue;
            const BrickPlane plane = planeOf(at, pair.axis, *slope);
            if (addCandidate(plane, sideMask(plane, at))) ++added;
        }
    }

    std::optional<Slope> fitFaces(Vec3i at, int axis, Scalar low, Scalar high) {
        std::optional<Slope> slope;
        for (const double tolerance : {1e9, 1.0}) {
            SlopeFit sums;
            const auto add = [&](Vec3i other) {
                const Vec3i away = (other - at) * 8;
                const int p0 = away[kAcross[std::size_t(axis)][0]], q0 = away[kAcross[std::size_t(axis)][1]];
                for (const Face& face : facesAt(other)[std::size_t(axis)].between(low, high)) {
                    const double x = p0 + face.p + 0.5, y = q0 + face.q + 0.5, z = away[axis] + face.height;
                    if (!slope || std::abs(z - slope->at(x, y)) <= tolerance) sums.add(x, y, z);
                }
            };
            add(at);
            if (slope)
                for (std::size_t n = 0; n < 6; ++n) {  // the neighbours across faces
                    const Vec3i other = at + kNeighbors[n];
                    if (isInside(other) && isMixed(other)) add(other);
                }
            const auto better = sums.solve();
            if (!better) return slope;
            slope = better;
        }
        return slope;
    }

    // A face between two voxels: at (p, q), `height` voxels above the bottom of the brick.
    struct Face {
        std::uint8_t p, q, height;
    };
    // The faces with label `low` below and `high` above.
    struct FaceGroup {
        Scalar low, high;
        std::uint32_t begin, end;  // range of AxisFaces::faces
        [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
    };
    struct AxisFaces {
        std::vector<Face> faces;
        std::vector<FaceGroup> groups;

        [[nodiscard]] std::span<const Face> between(Scalar low, Scalar high) const noexcept {
            for (const FaceGroup& group : groups)
                if (group.low == low && group.high == high) return std::span(faces).subspan(group.begin, group.size());
            return {};
        }
    };
    using Faces = std::array<AxisFaces, 3>;
    const Faces& facesAt(Vec3i at) {
        auto& faces = faces_[places_.patternOf[place(at)]];
        if (faces) return *faces;
        faces.emplace();
        const BrickPattern& pattern = patternAt(at);
        const Changes changes = findChanges(pattern);
        const std::size_t labels = pattern.palette.size(), planes = pattern.bitPlanes.size() / 8;
        const std::uint64_t* words = pattern.bitPlanes.data();
        const auto indexAt = [&](std::size_t word, std::size_t bit) {
            std::size_t index = 0;
            for (std::size_t p = 0; p < planes; ++p)
                index |= static_cast<std::size_t>((words[8 * p + word] >> bit) & 1u) << p;
            return index;
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            AxisFaces& ofAxis = (*faces)[axis];
            newFaces_.clear();
            groupOf_.assign(labels * labels, kNone);
            const auto add = [&](std::size_t word, std::size_t bit) {
                const std::size_t x = bit % 8, y = bit / 8, z = word;
                const std::size_t low = indexAt(word, bit);
                const std::size_t high = axis == 2 ? indexAt(word + 1, bit) : indexAt(word, bit + (axis == 0 ? 1 : 8));
                std::uint32_t& group = groupOf_[low * labels + high];
                if (group == kNone) {
                    group = static_cast<std::uint32_t>(ofAxis.groups.size());
                    ofAxis.groups.push_back({pattern.palette[low], pattern.palette[high], 0, 0});
                }
                ++ofAxis.groups[group].end;
                newFaces_.push_back(
                    {group,
                     {static_cast<std::uint8_t>(axis == 0 ? y : x), static_cast<std::uint8_t>(axis == 2 ? y : z),
                      static_cast<std::uint8_t>((axis == 0   ? x
                                                 : axis == 1 ? y
                                                             : z) +
                                                1)}});
            };
            for (std::size_t word = 0; word < 8; ++word)
                for (std::uint64_t bits = changes[axis][word]; bits != 0; bits &= bits - 1)
                    add(word, static_cast<std::size_t>(std::countr_zero(bits)));
            std::uint32_t begin = 0;
            for (FaceGroup& group : ofAxis.groups) {
                const std::uint32_t size = group.end;
                group.begin = group.end = begin;
                begin += size;
            }
            ofAxis.faces.resize(newFaces_.size());
            for (const auto& [group, face] : newFaces_) ofAxis.faces[ofAxis.groups[group].end++] = face;
        }
        return *faces;
    }

    // Adds cuts as candidate planes, for axes that need more than one cut.
    void addCuts(Vec3i at, std::size_t most) {
        for (int axis = 0; axis < 3; ++axis) {
            std::uint32_t places = placesOf(changes_[std::size_t(axis)], axis);
            if (std::popcount(places) < 2 || std::popcount(places) > 3) continue;
            for (; places != 0 && sides_.size() < most; places &= places - 1) {
                const auto cut = static_cast<std::uint32_t>(std::countr_zero(places)) + 1;
                BrickCode alone;
                alone.cut[std::size_t(axis)] = static_cast<std::uint8_t>(cut);
                if (!hasCutsOfModel(alone, at)) continue;
                BrickPlane plane;
                plane.normal[axis] = 1;
                plane.offset = -(corner(at)[axis] + cut);
                addCandidate(plane, cutMask(axis, cut));
            }
        }
    }

    std::uint32_t numberOf(const BrickPlane& plane) {
        const auto known = std::find(result_.planes.rbegin(), result_.planes.rend(), plane);
        if (known != result_.planes.rend()) return static_cast<std::uint32_t>(result_.planes.rend() - known) - 1;
        result_.planes.push_back(plane);
        return static_cast<std::uint32_t>(result_.planes.size() - 1);
    }

    static bool isTrivial(const SideMask& mask) noexcept {
        const auto isAll = [&](std::uint64_t value) {
            return std::all_of(mask.begin(), mask.end(), [&](std::uint64_t word) { return word == value; });
        };
        return isAll(0) || isAll(kAll);
    }

    // Does the plane intersect the box of the brick?
    [[nodiscard]] bool cutsBox(const BrickPlane& plane, Vec3i at) const noexcept {
        const double middle = valueAt(plane, corner(at) + Vec3d{4, 4, 4});
        const double reach = 4 * (std::abs(plane.normal.x) + std::abs(plane.normal.y) + std::abs(plane.normal.z));
        return std::abs(middle) < reach - 1e-3;
    }

    // Whether a point that belongs to both neighbouring bricks lies on this side of the plane.
    [[nodiscard]] bool sharePointOnSide(const BrickPlane& plane, Vec3i a, Vec3i b, bool isPositive) const noexcept {
        constexpr double kSize = BrickVolume::kBrickSize;
        double value = plane.offset;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = std::max(corner(a)[axis], corner(b)[axis]);
            const double high = std::min(corner(a)[axis], corner(b)[axis]) + kSize;
            const double n = plane.normal[axis];
            value += isPositive ? std::max(n * low, n * high) : std::min(n * low, n * high);
        }
        return isPositive ? value > 0 : value <= 0;
    }

    [[nodiscard]] bool hasLabel(Vec3i at, Scalar scalar) const noexcept {
        if (!isMixed(at)) return places_.scalarOf[place(at)] == scalar;
        const std::vector<Scalar>& palette = patternAt(at).palette;
        return std::find(palette.begin(), palette.end(), scalar) != palette.end();
    }

    // The label that rays find at a point of a brick. Voxels of the volume.
    [[nodiscard]] Scalar labelAt(Vec3i at, Vec3d point) const noexcept {
        const BrickCode* code = codeAt(at);
        if (code == nullptr) {
            if (!isMixed(at)) return places_.scalarOf[place(at)];
            std::array<int, 3> voxel{};
            for (int axis = 0; axis < 3; ++axis)
                voxel[std::size_t(axis)] = static_cast<int>(std::clamp(point[axis] - corner(at)[axis], 0.0, 7.0));
            const BrickPattern& pattern = patternAt(at);
            std::size_t index = 0;
            for (std::size_t p = 0; 8 * p < pattern.bitPlanes.size(); ++p)
                index |= ((pattern.bitPlanes[8 * p + std::size_t(voxel[2])] >> (voxel[0] + 8 * voxel[1])) & 1u) << p;
            return pattern.palette[index];
        }
        std::size_t side = 0, bit = 0;
        const auto addPlane = [&](std::uint32_t number) {
            if (number != BrickVolume::kNoPlane)
                side |= std::size_t{valueAt(result_.planes[number], point) > 0} << bit++;
        };
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint8_t cut = code->cut[std::size_t(axis)];
            if (cut != 0)
                side |= std::size_t{point[axis] >= corner(at)[axis] + cut} << bit++;
            else
                addPlane(code->cutPlane[std::size_t(axis)]);
        }
        for (const std::uint32_t number : code->plane) addPlane(number);
        return code->sideScalars[side];
    }

    // Whether the brick `next` has the label beside the sliver that the plane cuts from its neighbour `at`. The sliver
    // meets their common face in a triangle, or a part of one; three points of it are tested.
    [[nodiscard]] bool isBesideSliver(const BrickPlane& plane, Vec3i at, Vec3i next, bool isPositive,
                                      Scalar scalar) const noexcept {
        constexpr double kSize = BrickVolume::kBrickSize;
        Vec3d tip;  // the corner of the face that lies farthest beyond the plane
        Vec3d inwards{};
        for (int axis = 0; axis < 3; ++axis) {
            const double low = std::max(corner(at)[axis], corner(next)[axis]);
            const double high = std::min(corner(at)[axis], corner(next)[axis]) + kSize;
            const bool isHigh = (plane.normal[axis] > 0) == isPositive;
            tip[axis] = isHigh ? high : low;
            if (high > low) inwards[axis] = isHigh ? -1 : 1;
        }
        const double depth = std::abs(valueAt(plane, tip));
        std::array<Vec3d, 2> sides;  // from the tip along the edges of the face, to the plane or the next corner
        std::size_t count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (inwards[axis] == 0) continue;
            Vec3d& side = sides[count++];
            side[axis] = inwards[axis] * std::min(kSize, depth / std::max(std::abs(plane.normal[axis]), 1e-9));
        }
        for (const auto& [a, b] : {std::array{0.3, 0.3}, std::array{0.8, 0.1}, std::array{0.1, 0.8}})
            if (labelAt(next, tip + sides[0] * a + sides[1] * b) == scalar) return true;
        return false;
    }

    // Whether a surface on the plane reaches a uniform brick, so that the sliver on the other side of the plane has a
    // neighbour with its label. Beyond the end of a surface, its plane may cut a corner of a brick of air.
    [[nodiscard]] bool isReached(const BrickPlane& plane, Vec3i at, bool isPositive, Scalar scalar) const noexcept {
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                Vec3i next = at;
                next[axis] += step;
                if (isInside(next) && hasLabel(next, scalar) && sharePointOnSide(plane, at, next, isPositive) &&
                    isBesideSliver(plane, at, next, isPositive, scalar))
                    return true;
            }
        return false;
    }

    void extendToUniformNeighbors() {
        const std::size_t count = result_.codes.size();
        for (std::size_t n = 0; n < count; ++n) {
            if (result_.codes[n].code.sideScalars.size() != 2) continue;
            const BrickCode code = result_.codes[n].code;
            const BrickPlane& plane = result_.planes[code.plane[0]];
            const auto place = static_cast<std::int32_t>(result_.codes[n].place);
            const Vec3i from{place % places_.count.x, place / places_.count.x % places_.count.y,
                             place / (places_.count.x * places_.count.y)};
            forEachNeighbor(from, [&](Vec3i at) {
                if (isMixed(at) || codeAt(at) != nullptr || !cutsBox(plane, at)) return;
                const auto side = sideOfAll(plane, at);
                if (!side || code.sideScalars[*side] != places_.scalarOf[this->place(at)]) return;
                if (sharePointOnSide(plane, from, at, *side == 0) ||
                    isReached(plane, at, *side == 0, code.sideScalars[1 - *side]))
                    setCode(at, code);
            });
        }
    }

    const TilePlaces& places_;
    const std::vector<BrickPattern>& patterns_;
    const std::vector<std::uint8_t>& kindOfPattern_;
    // A plane with faces in or next to the bricks [min, max] of a column.
    struct ColumnFace {
        BrickPlane plane;
        std::int16_t min, max;
    };
    static constexpr std::int32_t kColumns = ColumnVolume::kTileSize / BrickVolume::kBrickSize;  // along an axis
    std::array<std::vector<ColumnFace>, kColumns * kColumns> facesOfColumn_;  // of the model, not across an axis
    std::array<std::vector<std::vector<BrickRange>>, 3>
        cutPlanes_;  // across an axis: by cut, voxels from the tile's corner
    bool knowsFaces_, hasFacePlanes_ = false;
    bool mayBeSheet_ = false;  // cuts may lie one voxel away from a face
    std::vector<Vec3i> mixed_;
    std::vector<std::array<std::optional<Heights>, 3>> heights_;
    std::vector<std::optional<Faces>> faces_;               // by pattern
    std::vector<std::pair<std::uint32_t, Face>> newFaces_;  // scratch: faces of one axis with the index of their group
    std::vector<std::uint32_t> groupOf_;                    // scratch: by low and high label of the palette
    std::vector<std::uint32_t> codeIndex_;
    std::vector<BrickPlane> candidates_;
    std::vector<BrickSide> sides_;                         // of the candidates, same order
    std::vector<std::array<std::uint32_t, 2>> conflicts_;  // sets of candidates that explain either of two changes
    Changes changes_{};                                    // of the brick being coded
    TileCodes result_;
};

}  // namespace

TileCodes codeTile(const TilePlaces& places, const std::vector<BrickPattern>& patterns,
                   const std::vector<std::uint8_t>& kindOfPattern, std::span<const FacePlane> faces) {
    return TileCoder(places, patterns, kindOfPattern, faces).code();
}

}  // namespace svt::volume
