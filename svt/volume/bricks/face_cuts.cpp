#include <svt/volume/bricks/face_cuts.hpp>
#include <svt/volume/face_planes.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

namespace svt::volume {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
// Voxels: if a plane is closer than this to the border of voxels, the cut stays.
constexpr double kSame = 1.0 / 256;

// Sides of a brick while its code is made: first cuts, then planes.
struct SideList {
    struct Side {
        int axis = -1;         // of a cut
        std::uint8_t cut = 0;  // voxels of the brick below it
        std::uint32_t plane = kNone;
        [[nodiscard]] bool isCut() const noexcept { return plane == kNone; }
    };
    std::array<Side, BrickVolume::kMaxSides> sides{};
    std::size_t count = 0;

    [[nodiscard]] bool hasCut(int axis) const noexcept {
        return std::any_of(sides.begin(), sides.begin() + std::ptrdiff_t(count),
                           [&](const Side& side) { return side.isCut() && side.axis == axis; });
    }
    [[nodiscard]] bool hasPlane(std::uint32_t plane) const noexcept {
        return std::any_of(sides.begin(), sides.begin() + std::ptrdiff_t(count),
                           [&](const Side& side) { return side.plane == plane; });
    }
    [[nodiscard]] std::size_t find(std::uint32_t plane) const noexcept {
        std::size_t s = 0;
        while (s < count && sides[s].plane != plane) ++s;
        return s;
    }
};

SideList sidesOf(const BrickCode& code) noexcept {
    SideList list;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (code.cut[axis] != 0) list.sides[list.count++] = {static_cast<int>(axis), code.cut[axis], kNone};
        if (code.cutPlane[axis] != BrickVolume::kNoPlane) list.sides[list.count++] = {-1, 0, code.cutPlane[axis]};
    }
    for (const std::uint32_t plane : code.plane)
        if (plane != BrickVolume::kNoPlane) list.sides[list.count++] = {-1, 0, plane};
    return list;
}

// The axis that a plane is exactly across; -1: none.
int axisOf(const BrickPlane& plane) noexcept {
    for (int axis = 0; axis < 3; ++axis)
        if (plane.normal[axis] == 1) return axis;
    return -1;
}

// The place of each side in a code; nullopt if there are too many. Places 0 to 2 are for the cut across each axis, or
// for one plane across it. The places of planes follow.
using Places = std::array<std::size_t, BrickVolume::kMaxSides>;
std::optional<Places> placesOf(const SideList& list, const std::vector<BrickPlane>& planes) noexcept {
    Places places{};
    std::array<bool, BrickVolume::kMaxSides> isTaken{};
    for (std::size_t s = 0; s < list.count; ++s)
        if (list.sides[s].isCut()) isTaken[places[s] = static_cast<std::size_t>(list.sides[s].axis)] = true;
    for (std::size_t s = 0; s < list.count; ++s) {
        if (list.sides[s].isCut()) continue;
        const int axis = axisOf(planes[list.sides[s].plane]);
        std::size_t place = axis < 0 ? 3 : static_cast<std::size_t>(axis);
        if (isTaken[place]) place = 3;
        while (place < isTaken.size() && isTaken[place]) ++place;
        // Planes beyond three take free places of cuts.
        if (place == isTaken.size())
            for (place = 0; place < 3 && isTaken[place]; ++place) {
            }
        if (place == 3 && isTaken[3]) return std::nullopt;
        isTaken[places[s] = place] = true;
    }
    return places;
}

// The code of sides in any order: `scalars` by combination in the order of `list`.
BrickCode codeOf(const SideList& list, const Places& places, const std::vector<Scalar>& scalars) {
    BrickCode code;
    std::array<std::size_t, BrickVolume::kMaxSides> order{};
    for (std::size_t s = 0; s < list.count; ++s) order[s] = s;
    std::sort(order.begin(), order.begin() + std::ptrdiff_t(list.count),
              [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    for (std::size_t s = 0; s < list.count; ++s) {
        const SideList::Side& side = list.sides[s];
        if (side.isCut())
            code.cut[places[s]] = side.cut;
        else
            (places[s] < 3 ? code.cutPlane[places[s]] : code.plane[places[s] - 3]) = side.plane;
    }
    code.sideScalars.resize(std::size_t{1} << list.count);
    for (std::size_t part = 0; part < code.sideScalars.size(); ++part) {
        std::size_t from = 0;
        for (std::size_t s = 0; s < list.count; ++s)
            if (((part >> s) & 1u) != 0) from |= std::size_t{1} << order[s];
        code.sideScalars[part] = scalars[from];
    }
    return code;
}

// A brick and a layer of samples around it.
struct Around {
    static constexpr std::size_t kWidth = 10;
    Vec3i min, max;  // of the samples known, -1 to 9
    std::array<Scalar, kWidth * kWidth * kWidth> scalars{};
    [[nodiscard]] static std::size_t at(Vec3i p) noexcept {
        return static_cast<std::size_t>(p.x + 1) +
               kWidth * (static_cast<std::size_t>(p.y + 1) + kWidth * static_cast<std::size_t>(p.z + 1));
    }
    // All known samples except those of the brick itself.
    template <class Body>
    void forEachBeside(const Body& body) const {
        for (std::int32_t z = min.z; z < max.z; ++z)
            for (std::int32_t y = min.y; y < max.y; ++y) {
                const bool isOwnRow = z >= 0 && z < 8 && y >= 0 && y < 8;
                for (std::int32_t x = min.x; x < max.x; ++x) {
                    if (isOwnRow && x == 0) x = 8;
                    if (x < max.x) body(Vec3i{x, y, z});
                }
            }
    }
    [[nodiscard]] bool isKnown(Vec3i p) const noexcept {
        const auto isOwn = [](std::int32_t n) { return n >= 0 && n < 8; };
        return p.x >= min.x && p.y >= min.y && p.z >= min.z && !(isOwn(p.x) && isOwn(p.y) && isOwn(p.z));
    }
};

class CutMover {
public:
    CutMover(const TilePlaces& places, const std::vector<BrickPattern>& patterns, const FaceBorders& faces,
             std::span<const FacePlane> planes, const ColumnVolume& columns, TileBrickCodes& tile)
        : places_(places), patterns_(patterns), faces_(faces), columns_(columns), tile_(tile) {
        for (const FacePlane& face : planes) {
            const Vec3d n = face.plane.normal;
            if (std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) < 1 - 1e-6) oblique_.push_back(face);
        }
    }

    void run() {
        forEachPlace([&](Vec3i at) { codeByBorders(at); });
        forEachPlace([&](Vec3i at) { replaceCuts(at); });
        forEachPlace([&](Vec3i at) { takeFacesAtSides(at); });
    }

private:
    struct SideFace {
        int axis = 0;
        bool isUpper = false;
        BrickPlane plane;
    };

    template <class Body>
    void forEachPlace(const Body& body) const {
        for (std::int32_t z = 0; z < places_.count.z; ++z)
            for (std::int32_t y = 0; y < places_.count.y; ++y)
                for (std::int32_t x = 0; x < places_.count.x; ++x) body(Vec3i{x, y, z});
    }
    [[nodiscard]] std::size_t place(Vec3i at) const noexcept { return places_.at(at.x, at.y, at.z); }
    [[nodiscard]] Vec3i corner(Vec3i at) const noexcept { return places_.origin + at * 8; }

    std::uint32_t numberOf(const BrickPlane& plane) {
        const auto known = std::find(tile_.planes.rbegin(), tile_.planes.rend(), plane);
        if (known != tile_.planes.rend()) return static_cast<std::uint32_t>(tile_.planes.rend() - known) - 1;
        tile_.planes.push_back(plane);
        return static_cast<std::uint32_t>(tile_.planes.size() - 1);
    }

    // The number of the face's plane at a border; kNone if there is none, or if it lies on the border.
    std::uint32_t faceAt(int axis, std::int32_t border, Vec3i at) {
        const auto plane = faces_.find(axis, border, corner(at));
        if (!plane || std::abs(plane->offset + border) < kSame) return kNone;
        return numberOf(*plane);
    }

    // Border at which a plane of a code cuts between voxels; nullopt if it is another plane.
    static std::optional<std::pair<int, std::int32_t>> borderOf(const BrickPlane& plane) noexcept {
        for (int axis = 0; axis < 3; ++axis)
            if (plane.normal[axis] == 1 && plane.offset == std::floor(plane.offset))
                return std::pair{axis, static_cast<std::int32_t>(-plane.offset)};
        return std::nullopt;
    }

    void replaceCuts(Vec3i at) {
        std::uint32_t& index = tile_.codeIndex[place(at)];
        if (index == kNone) return;
        SideList list = sidesOf(tile_.codes[index]);
        // The plane that replaces each side, or kNone.
        std::array<std::uint32_t, BrickVolume::kMaxSides> becomes;
        becomes.fill(kNone);
        bool isAny = false;
        for (std::size_t s = 0; s < list.count; ++s) {
            const SideList::Side side = list.sides[s];
            if (side.isCut()) {
                becomes[s] = faceAt(side.axis, corner(at)[side.axis] + side.cut, at);
            } else if (const auto border = borderOf(tile_.planes[side.plane])) {
                becomes[s] = faceAt(border->first, border->second, at);
            }
            isAny = isAny || becomes[s] != kNone;
        }
        if (!isAny) return;
        const auto [known, isNew] = replaced_.try_emplace({index, becomes}, kNone);
        if (isNew) {
            for (std::size_t n = 0; n < list.count; ++n) {
                if (becomes[n] == kNone || list.hasPlane(becomes[n])) continue;
                const SideList before = list;
                list.sides[n] = {-1, 0, becomes[n]};
                if (!placesOf(list, tile_.planes)) list = before;
            }
            known->second = static_cast<std::uint32_t>(tile_.codes.size());
            const std::vector<Scalar> scalars = tile_.codes[index].sideScalars;
            tile_.codes.push_back(codeOf(list, *placesOf(list, tile_.planes), scalars));
        }
        index = known->second;
    }

    // Codes a brick that has no code and whose labels change at few places: by sides at all of them. At oblique faces,
    // these places are steps, and voxels look better.
    void codeByBorders(Vec3i at) {
        const std::size_t number = place(at);
        if (tile_.codeIndex[number] != kNone || places_.patternOf[number] == TilePlaces::kUniform) return;
        if (isBesideOblique(at)) return;
        const Changes changes = findChanges(patterns_[places_.patternOf[number]]);
        SideList list;
        for (int axis = 0; axis < 3; ++axis) {
            bool isFirst = true;
            for (std::uint32_t borders = bordersOf(changes[static_cast<std::size_t>(axis)], axis); borders != 0;
                 borders &= borders - 1) {
                if (list.count == list.sides.size()) return;
                const int border = std::countr_zero(borders) + 1;
                BrickPlane plane;
                plane.normal[axis] = 1;
                plane.offset = -(corner(at)[axis] + border);
                SideList::Side& side = list.sides[list.count++];
                if (isFirst)
                    side = {axis, static_cast<std::uint8_t>(border), kNone};
                else
                    side = {-1, 0, numberOf(plane)};
                isFirst = false;
            }
        }
        const auto places = placesOf(list, tile_.planes);
        if (!places) return;
        // Cells between borders have one label.
        std::vector<Scalar> scalars(std::size_t{1} << list.count);
        std::uint64_t known = 0;
        for (std::int32_t n = 0; n < 512; ++n) {
            const Vec3i p{n & 7, n >> 3 & 7, n >> 6};
            std::size_t combination = 0;
            for (std::size_t s = 0; s < list.count; ++s) {
                const SideList::Side& side = list.sides[s];
                const int axis = side.isCut() ? side.axis : axisOf(tile_.planes[side.plane]);
                const double border = side.isCut() ? side.cut : -tile_.planes[side.plane].offset - corner(at)[axis];
                if (p[axis] >= border) combination |= std::size_t{1} << s;
            }
            scalars[combination] = scalarAt(corner(at) + p);
            known |= std::uint64_t{1} << combination;
        }
        fillUnknown(
            list.count, known, [](std::size_t) { return std::size_t{1}; }, scalars);
        tile_.codeIndex[number] = static_cast<std::uint32_t>(tile_.codes.size());
        tile_.codes.push_back(codeOf(list, *places, scalars));
    }

    // Whether faces that are not across an axis reach the brick.
    [[nodiscard]] bool isBesideOblique(Vec3i at) const noexcept {
        const Vec3i low = corner(at);
        return std::any_of(oblique_.begin(), oblique_.end(), [&](const FacePlane& face) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                if (face.min[a] > low[axis] + 8 || face.max[a] < low[axis]) return false;
            }
            const Vec3d n = face.plane.normal;
            const double middle = dot(n, toDouble(low) + Vec3d{4, 4, 4}) + face.plane.offset;
            return std::abs(middle) <= 5 * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
        });
    }

    // Places along an axis where labels change: bit p between the voxels at p and p + 1.
    static std::uint32_t bordersOf(const SideMask& changes, int axis) noexcept {
        std::uint32_t found = 0;
        for (std::uint32_t k = 0; k < 8; ++k)
            for (std::uint64_t bits = changes[k]; bits != 0; bits &= bits - 1) {
                const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
                found |= 1u << (axis == 0 ? bit % 8 : axis == 1 ? bit / 8 : k);
            }
        return found;
    }

    // Handles faces in the half voxel at the sides of a brick; they bound samples of adjacent bricks.
    void takeFacesAtSides(Vec3i at) {
        const bool isUniform = places_.patternOf[place(at)] == TilePlaces::kUniform;
        if (tile_.codeIndex[place(at)] == kNone && !isUniform) return;
        std::array<SideFace, 6> faces;
        std::size_t count = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (const bool isUpper : {false, true}) {
                const std::int32_t border = corner(at)[axis] + (isUpper ? 8 : 0);
                if (border <= 0 || border >= columns_.dimension()[axis]) continue;
                const auto plane = faces_.find(axis, border, corner(at));
                if (!plane) continue;
                const double away = -plane->offset - border;
                if (plane->normal[axis] != 1 || (isUpper ? -away : away) < kSame) continue;
                faces[count++] = {axis, isUpper, *plane};
            }
        if (count == 0 || isAloneAmongEquals(at, std::span(faces).first(count))) return;
        if (count == 1 && isSameBeyond(at, faces[0])) return;
        if (codeAround(at, std::span(faces).first(count))) return;
        if (count == 1) return;
        // All faces together have no code: take them one after the other.
        std::array<SideFace, 6> taken;
        std::size_t takenCount = 0;
        for (std::size_t n = 0; n < count; ++n) {
            taken[takenCount] = faces[n];
            if (codeAround(at, std::span(taken).first(takenCount + 1))) ++takenCount;
        }
    }

    // A quick test, after which most bricks are done: the brick and its surroundings have one label.
    [[nodiscard]] bool isAloneAmongEquals(Vec3i at, std::span<const SideFace> faces) const noexcept {
        if (places_.patternOf[place(at)] != TilePlaces::kUniform) return false;
        Vec3i min = at, max = at;
        for (const SideFace& face : faces) (face.isUpper ? max : min)[face.axis] += face.isUpper ? 1 : -1;
        for (std::int32_t z = min.z; z <= max.z; ++z)
            for (std::int32_t y = min.y; y <= max.y; ++y)
                for (std::int32_t x = min.x; x <= max.x; ++x) {
                    if (x < 0 || y < 0 || z < 0 || x >= places_.count.x || y >= places_.count.y || z >= places_.count.z)
                        return false;
                    const std::size_t other = places_.at(x, y, z);
                    if (places_.patternOf[other] != TilePlaces::kUniform ||
                        places_.scalarOf[other] != places_.scalarOf[place(at)])
                        return false;
                }
        return true;
    }

    // Whether the samples on both sides of a side of the brick are the same.
    [[nodiscard]] bool isSameBeyond(Vec3i at, const SideFace& face) const noexcept {
        const int b = (face.axis + 1) % 3, c = (face.axis + 2) % 3;
        Vec3i voxel = corner(at);
        voxel[face.axis] += face.isUpper ? 7 : 0;
        for (int q = 0; q < 8; ++q)
            for (int p = 0; p < 8; ++p) {
                Vec3i own = voxel;
                own[b] += p;
                own[c] += q;
                Vec3i beyond = own;
                beyond[face.axis] += face.isUpper ? 1 : -1;
                if (scalarAt(own) != scalarAt(beyond)) return false;
            }
        return true;
    }

    [[nodiscard]] Scalar scalarAt(Vec3i voxel) const noexcept {
        const Vec3i n = columns_.dimension();
        const Vec3i inside{std::min(voxel.x, n.x - 1), std::min(voxel.y, n.y - 1), std::min(voxel.z, n.z - 1)};
        const Vec3i away = inside - places_.origin;
        const Vec3i at{away.x >> 3, away.y >> 3, away.z >> 3};
        if (at.x < 0 || at.y < 0 || at.x >= places_.count.x || at.y >= places_.count.y)
            return columns_.scalarAt(inside.x, inside.y, inside.z);
        const std::size_t number = places_.at(at.x, at.y, at.z);
        if (places_.patternOf[number] == TilePlaces::kUniform) return places_.scalarOf[number];
        const BrickPattern& pattern = patterns_[places_.patternOf[number]];
        const std::size_t word = static_cast<std::size_t>(away.z & 7);
        const int bit = (away.x & 7) + 8 * (away.y & 7);
        std::size_t index = 0;
        for (std::size_t p = 0; 8 * p < pattern.bitPlanes.size(); ++p)
            index |= static_cast<std::size_t>((pattern.bitPlanes[8 * p + word] >> bit) & 1u) << p;
        return pattern.palette[index];
    }

    // Codes a brick so that its labels are also valid for the adjacent samples on the sides of `faces`.
    bool codeAround(Vec3i at, std::span<const SideFace> faces) {
        around_.min = {0, 0, 0};
        around_.max = {8, 8, 8};
        for (const SideFace& face : faces) (face.isUpper ? around_.max[face.axis] = 9 : around_.min[face.axis] = -1);
        around_.forEachBeside([&](Vec3i p) { around_.scalars[Around::at(p)] = scalarAt(corner(at) + p); });
        const std::uint32_t own = tile_.codeIndex[place(at)];
        SideList list;
        if (own == kNone) {
            ownScalars_.assign(1, places_.scalarOf[place(at)]);
        } else {
            list = sidesOf(tile_.codes[own]);
            ownScalars_ = tile_.codes[own].sideScalars;
        }
        nearMask_ = insideBits_ = 0;
        for (const SideFace& face : faces) {
            const std::uint32_t plane = numberOf(face.plane);
            if (!addPlane(list, plane)) return false;
            const std::size_t bit = std::size_t{1} << list.find(plane);
            nearMask_ |= bit;
            if (!face.isUpper) insideBits_ |= bit;
        }
        if (!findScalars(at, list)) {
            if (!addMissingSides(at, list)) return false;
            if (!findScalars(at, list)) return false;
        }
        dropNeedless(list);
        if (list.count == 0) return true;
        const auto places = placesOf(list, tile_.planes);
        if (!places) return false;
        BrickCode code = codeOf(list, *places, scalars_);
        if (own != kNone && code == tile_.codes[own]) return true;
        const auto end = tile_.codes.rbegin() + std::min<std::ptrdiff_t>(32, std::ssize(tile_.codes));
        const auto same = std::find(tile_.codes.rbegin(), end, code);
        if (same != end) {
            tile_.codeIndex[place(at)] = static_cast<std::uint32_t>(tile_.codes.rend() - same) - 1;
            return true;
        }
        tile_.codeIndex[place(at)] = static_cast<std::uint32_t>(tile_.codes.size());
        tile_.codes.push_back(std::move(code));
        return true;
    }

    // Adds a plane to sides; false if there is no place for it.
    bool addPlane(SideList& list, std::uint32_t plane) const noexcept {
        if (list.hasPlane(plane)) return true;
        if (list.count == list.sides.size()) return false;
        list.sides[list.count++] = {-1, 0, plane};
        if (placesOf(list, tile_.planes)) return true;
        --list.count;
        return false;
    }

    // Finds the side combination of each sample next to the brick.
    void findCombinations(Vec3i at, const SideList& list) {
        const Vec3d first = toDouble(corner(at)) + Vec3d{0.5, 0.5, 0.5};
        std::array<std::array<std::uint8_t, Around::kWidth>, 3> bits{};  // of sides across an axis
        std::uint32_t oblique = 0;
        for (std::size_t s = 0; s < list.count; ++s) {
            const SideList::Side& side = list.sides[s];
            int axis = side.axis;
            double border = side.cut;
            if (!side.isCut()) {
                const BrickPlane& plane = tile_.planes[side.plane];
                for (int n = 0; n < 3; ++n)
                    if (plane.normal[n] == 1) axis = n;
                if (axis < 0)
                    oblique |= 1u << s;
                else
                    border = -plane.offset - corner(at)[axis];
            }
            if (axis < 0) continue;
            for (int n = -1; n < 9; ++n)
                if (n + 0.5 > border)
                    bits[static_cast<std::size_t>(axis)][static_cast<std::size_t>(n + 1)] |=
                        static_cast<std::uint8_t>(1u << s);
        }
        around_.forEachBeside([&](Vec3i p) {
            auto all = static_cast<std::uint32_t>(bits[0][std::size_t(p.x + 1)] | bits[1][std::size_t(p.y + 1)] |
                                                  bits[2][std::size_t(p.z + 1)]);
            for (std::uint32_t rest = oblique; rest != 0; rest &= rest - 1) {
                const int s = std::countr_zero(rest);
                const BrickPlane& plane = tile_.planes[list.sides[std::size_t(s)].plane];
                if (dot(plane.normal, first + toDouble(p)) + plane.offset > 0) all |= 1u << s;
            }
            combinations_[Around::at(p)] = static_cast<std::uint8_t>(all);
        });
    }

    // Finds the label of each side combination; false if a combination has samples of two labels. Combinations without
    // samples take the label of the nearest one, see fillUnknown().
    bool findScalars(Vec3i at, const SideList& list) {
        findCombinations(at, list);
        const std::size_t count = std::size_t{1} << list.count;
        scalars_.assign(count, 0);
        std::uint64_t known = 0;
        bool isValid = true;
        // Between the planes at its sides, the brick keeps its labels.
        for (std::size_t combination = 0; combination < count; ++combination) {
            if ((combination & nearMask_) != insideBits_) continue;
            scalars_[combination] = ownScalars_[combination & (ownScalars_.size() - 1)];
            known |= std::uint64_t{1} << combination;
        }
        around_.forEachBeside([&](Vec3i p) {
            const std::size_t combination = combinations_[Around::at(p)];
            const Scalar scalar = around_.scalars[Around::at(p)];
            if (((known >> combination) & 1u) == 0) {
                scalars_[combination] = scalar;
                known |= std::uint64_t{1} << combination;
            } else if (scalars_[combination] != scalar) {
                isValid = false;
            }
        });
        if (!isValid) return false;
        fillUnknown(
            list.count, known,
            [&](std::size_t n) { return isAcross(list.sides[n]) ? 1 : std::size_t{8} << (list.count - n); }, scalars_);
        return true;
    }
    [[nodiscard]] bool isAcross(const SideList::Side& side) const noexcept {
        if (side.isCut()) return true;
        const Vec3d n = tile_.planes[side.plane].normal;
        return n.x == 1 || n.y == 1 || n.z == 1;
    }

    // Adds sides at changes of label around the brick that no side explains yet; false if there are too many.
    bool addMissingSides(Vec3i at, SideList& list) {
        for (int axis = 0; axis < 3; ++axis) {
            std::uint32_t borders = 0;
            around_.forEachBeside([&](Vec3i p) {
                Vec3i before = p;
                --before[axis];
                if (!around_.isKnown(before)) return;
                if (around_.scalars[Around::at(p)] != around_.scalars[Around::at(before)] &&
                    combinations_[Around::at(p)] == combinations_[Around::at(before)])
                    borders |= 1u << p[axis];
            });
            for (; borders != 0; borders &= borders - 1) {
                const auto border = std::countr_zero(borders);
                if (border < 1 || border > 7) return false;
                const std::uint32_t face = faceAt(axis, corner(at)[axis] + border, at);
                if (face != kNone && addPlane(list, face)) continue;
                if (list.hasCut(axis)) return false;
                if (list.count == list.sides.size()) return false;
                list.sides[list.count++] = {axis, static_cast<std::uint8_t>(border), kNone};
                if (!placesOf(list, tile_.planes)) return false;
            }
        }
        return true;
    }

    // Drops sides across which no label changes.
    void dropNeedless(SideList& list) {
        for (std::size_t s = list.count; s-- > 0;) {
            const std::size_t bit = std::size_t{1} << s;
            bool isNeeded = false;
            for (std::size_t part = 0; part < scalars_.size(); ++part)
                isNeeded = isNeeded || scalars_[part] != scalars_[part ^ bit];
            if (isNeeded) continue;
            std::vector<Scalar> rest;
            for (std::size_t part = 0; part < scalars_.size(); ++part)
                if ((part & bit) == 0) rest.push_back(scalars_[part]);
            scalars_ = std::move(rest);
            std::copy(list.sides.begin() + std::ptrdiff_t(s) + 1, list.sides.begin() + std::ptrdiff_t(list.count),
                      list.sides.begin() + std::ptrdiff_t(s));
            --list.count;
        }
    }

    const TilePlaces& places_;
    const std::vector<BrickPattern>& patterns_;
    const FaceBorders& faces_;
    std::vector<FacePlane> oblique_;  // across no axis
    const ColumnVolume& columns_;
    TileBrickCodes& tile_;
    std::map<std::pair<std::uint32_t, std::array<std::uint32_t, BrickVolume::kMaxSides>>, std::uint32_t> replaced_;
    Around around_;
    std::array<std::uint8_t, Around::kWidth * Around::kWidth * Around::kWidth> combinations_{};
    std::vector<Scalar> scalars_, ownScalars_;   // by side combination; the latter before the planes at its sides
    std::size_t nearMask_ = 0, insideBits_ = 0;  // bits of planes at its sides, and those of the brick's own samples
};

}  // namespace

void moveCutsToFaces(const TilePlaces& places, const std::vector<BrickPattern>& patterns,
                     std::span<const FacePlane> faces, const ColumnVolume& columns, TileBrickCodes& tile) {
    const FaceBorders byBorder(places.origin, places.count * 8, faces);
    if (!byBorder.isEmpty()) CutMover(places, patterns, byBorder, faces, columns, tile).run();
}

}  // namespace svt::volume
