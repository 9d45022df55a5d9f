#include <svt/volume/bricks/code_boxes.hpp>

#include <algorithm>
#include <cmath>

namespace svt::volume {
namespace {

class CodeBoxFinder {
public:
    CodeBoxFinder(const TilePlaces& places, const std::vector<std::uint32_t>& codeIndex,
                  const std::vector<BrickCode>& codes, const std::vector<BrickPlane>& planes)
        : places_(places), codeIndex_(codeIndex), codes_(codes), planes_(planes) {}

    TileBoxes find() {
        result_.boxOf.assign(codeIndex_.size(), TileBoxes::kNone);
        std::int64_t coded = 0;
        for (const std::uint32_t code : codeIndex_) coded += code != TileBoxes::kNone ? 1 : 0;
        budget_ = 16 * coded;
        leastBudget_ = -64 * coded;
        std::size_t place = 0;
        for (std::int32_t z = 0; z < places_.count.z; ++z)
            for (std::int32_t y = 0; y < places_.count.y; ++y)
                for (std::int32_t x = 0; x < places_.count.x; ++x, ++place)
                    if (codeIndex_[place] != TileBoxes::kNone && result_.boxOf[place] == TileBoxes::kNone)
                        addBoxAt({x, y, z});
        return std::move(result_);
    }

private:
    [[nodiscard]] Vec3i corner(Vec3i at) const noexcept { return places_.origin + at * 8; }

    // The sides of the box's code that cut a brick, and for all others the side on which the brick lies.
    struct Sides {
        std::array<bool, BrickVolume::kMaxSides> cuts{};
        std::size_t fixed = 0;                                   // bits of the sides that do not cut it
        std::array<std::size_t, BrickVolume::kMaxSides> bits{};  // bits of the sides that do, in order
        std::size_t count = 0;
    };
    [[nodiscard]] Sides sidesOf(Vec3i at) const noexcept {
        Sides sides;
        const Vec3i low = corner(at);
        std::size_t bit = 1;
        const auto add = [&](std::size_t side, int where) {
            if (where == 0) {
                sides.cuts[side] = true;
                sides.bits[sides.count++] = bit;
            } else if (where > 0) {
                sides.fixed |= bit;
            }
            bit <<= 1;
        };
        const auto addPlane = [&](std::size_t side, std::uint32_t number) {
            const BrickPlane& plane = planes_[number];
            const Vec3d n = plane.normal;
            const double middle = dot(n, Vec3d{low.x + 4.0, low.y + 4.0, low.z + 4.0}) + plane.offset;
            const double reach = 4 * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) + 1e-6;
            add(side, middle > reach ? 1 : middle < -reach ? -1 : 0);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (code_.cutPlane[axis] != BrickVolume::kNoPlane) addPlane(axis, code_.cutPlane[axis]);
            const std::int32_t cut = code_.cut[axis];
            if (cut == BoxCode::kNoCut) continue;
            const std::int32_t first = low[static_cast<int>(axis)];
            add(axis, cut <= first ? 1 : cut >= first + 8 ? -1 : 0);
        }
        for (std::size_t p = 0; p < BrickVolume::kMaxPlanes; ++p)
            if (code_.plane[p] != BrickVolume::kNoPlane) addPlane(3 + p, code_.plane[p]);
        return sides;
    }

    // Whether the code of the box gives this brick the same labels as its own code.
    [[nodiscard]] bool mayJoin(Vec3i at) {
        --budget_;
        const std::size_t place = places_.at(at.x, at.y, at.z);
        const std::uint32_t own = codeIndex_[place];
        if (own == TileBoxes::kNone) {
            if (places_.patternOf[place] != TilePlaces::kUniform) return false;
            const Sides sides = sidesOf(at);
            return sides.count == 0 && code_.sideScalars[sides.fixed] == places_.scalarOf[place];
        }
        const Sides sides = sidesOf(at);
        if (sides.count == 0) return false;
        const BrickCode& code = codes_[own];
        const Vec3i low = corner(at);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int cut = code.cut[axis] == 0 ? BoxCode::kNoCut : low[static_cast<int>(axis)] + code.cut[axis];
            if (cut != (sides.cuts[axis] ? code_.cut[axis] : BoxCode::kNoCut)) return false;
            if (code.cutPlane[axis] != (sides.cuts[axis] ? code_.cutPlane[axis] : BrickVolume::kNoPlane)) return false;
        }
        decltype(code.plane) planes = BrickCode().plane;
        std::size_t count = 0;
        for (std::size_t p = 0; p < BrickVolume::kMaxPlanes; ++p)
            if (sides.cuts[3 + p]) planes[count++] = code_.plane[p];
        if (planes != code.plane) return false;
        for (std::size_t part = 0; part < code.sideScalars.size(); ++part) {
            std::size_t whole = sides.fixed;
            for (std::size_t s = 0; s < sides.count; ++s)
                if (((part >> s) & 1u) != 0) whole |= sides.bits[s];
            if (code_.sideScalars[whole] != code.sideScalars[part]) return false;
        }
        return true;
    }
    [[nodiscard]] bool mayJoinAll(Vec3i min, Vec3i max) {
        for (std::int32_t z = min.z; z < max.z; ++z)
            for (std::int32_t y = min.y; y < max.y; ++y)
                for (std::int32_t x = min.x; x < max.x; ++x)
                    if (!mayJoin({x, y, z})) return false;
        return true;
    }

    // Whether any of the bricks is coded and has no box yet.
    [[nodiscard]] bool hasNew(Vec3i min, Vec3i max) const noexcept {
        for (std::int32_t z = min.z; z < max.z; ++z)
            for (std::int32_t y = min.y; y < max.y; ++y)
                for (std::int32_t x = min.x; x < max.x; ++x) {
                    const std::size_t place = places_.at(x, y, z);
                    if (codeIndex_[place] != TileBoxes::kNone && result_.boxOf[place] == TileBoxes::kNone) return true;
                }
        return false;
    }

    void addBoxAt(Vec3i seed) {
        const BrickCode& own = codes_[codeIndex_[places_.at(seed.x, seed.y, seed.z)]];
        code_ = {};
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (own.cut[axis] != 0) code_.cut[axis] = corner(seed)[static_cast<int>(axis)] + own.cut[axis];
        code_.plane = own.plane;
        code_.cutPlane = own.cutPlane;
        code_.sideScalars = own.sideScalars;
        CodeBox box{seed, seed + Vec3i{1, 1, 1}, numberOfCode()};
        for (int axis = 0; axis < 3; ++axis) {
            const auto layer = [&](std::int32_t at) {
                Vec3i min = box.min, max = box.max;
                min[axis] = at;
                max[axis] = at + 1;
                return (budget_ > 0 || (budget_ > leastBudget_ && hasNew(min, max))) && mayJoinAll(min, max);
            };
            while (box.max[axis] < places_.count[axis] && layer(box.max[axis])) ++box.max[axis];
            while (box.min[axis] > 0 && layer(box.min[axis] - 1)) --box.min[axis];
        }
        const auto number = static_cast<std::uint32_t>(result_.boxes.size());
        for (std::int32_t z = box.min.z; z < box.max.z; ++z)
            for (std::int32_t y = box.min.y; y < box.max.y; ++y)
                for (std::int32_t x = box.min.x; x < box.max.x; ++x) {
                    const std::size_t place = places_.at(x, y, z);
                    if (codeIndex_[place] != TileBoxes::kNone && result_.boxOf[place] == TileBoxes::kNone)
                        result_.boxOf[place] = number;
                }
        result_.boxes.push_back(box);
    }

    // Index of code_, reused from the most recent codes: neighbouring boxes often share one.
    std::uint32_t numberOfCode() {
        constexpr std::ptrdiff_t kRecent = 16;
        const auto end = result_.codes.rbegin() + std::min<std::ptrdiff_t>(kRecent, std::ssize(result_.codes));
        const auto known = std::find(result_.codes.rbegin(), end, code_);
        if (known != end) return static_cast<std::uint32_t>(result_.codes.rend() - known) - 1;
        result_.codes.push_back(code_);
        return static_cast<std::uint32_t>(result_.codes.size()) - 1;
    }

    const TilePlaces& places_;
    const std::vector<std::uint32_t>& codeIndex_;
    const std::vector<BrickCode>& codes_;
    const std::vector<BrickPlane>& planes_;
    BoxCode code_;  // of the box being grown
    std::int64_t budget_ = 0, leastBudget_ = 0;
    TileBoxes result_;
};

}  // namespace

TileBoxes findCodeBoxes(const TilePlaces& places, const std::vector<std::uint32_t>& codeIndex,
                        const std::vector<BrickCode>& codes, const std::vector<BrickPlane>& planes) {
    return CodeBoxFinder(places, codeIndex, codes, planes).find();
}

}  // namespace svt::volume
