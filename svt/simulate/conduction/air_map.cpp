#include <svt/simulate/conduction/air_map.hpp>

#include <map>
#include <utility>

namespace svt::simulate {
namespace {

using volume::Run;

constexpr std::uint32_t kOutside = 0;  // the zone
constexpr std::uint32_t kUnresolved = 0xFFFFFFFFu;

class AirMapMaker {
public:
    AirMapMaker(const volume::SemanticVolume& volume, const ThermalRoles& roles)
        : volume_(volume), roles_(roles), columns_(volume.columns) {
        map_.columns = &columns_;
        map_.size = volume.grid.dimension();
    }

    Result<AirMap> make() {
        std::size_t count = 0;
        for (std::int32_t j = 0; j < map_.size.y; ++j)
            for (std::int32_t i = 0; i < map_.size.x; ++i) {
                map_.columnStart.push_back(count);
                count += columns_.column(i, j).size();
            }
        map_.columnStart.push_back(count);
        if (count >= kUnresolved) return tooLarge();
        parent_.resize(count);
        for (std::size_t r = 0; r < count; ++r) parent_[r] = static_cast<std::uint32_t>(r);
        zone_.assign(count, kUnresolved);
        joinAll();
        resolve(Role::Background);
        resolve(Role::Passive);
        return number();
    }

private:
    static Error tooLarge() {
        return {Code::GridTooLarge, "the volume has over 2^31 cells of solids; choose a coarser --spacing"};
    }

    [[nodiscard]] const ScalarRole& roleOf(const Run& run) const { return roles_.ofScalar[run.scalar]; }

    [[nodiscard]] std::uint32_t rootOf(std::uint32_t r) {
        while (parent_[r] != r) {
            parent_[r] = parent_[parent_[r]];
            r = parent_[r];
        }
        return r;
    }

    // The lower run is the root, so that roots do not depend on the order of joins.
    void join(std::uint32_t a, std::uint32_t b) {
        a = rootOf(a);
        b = rootOf(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

    // Calls touch(run, run, from, to, axis) for all pairs of runs that share faces; along z, from == to is the height of the
    // face.
    template <class Touch>
    void forContacts(const Touch& touch) {
        for (std::int32_t j = 0; j < map_.size.y; ++j)
            for (std::int32_t i = 0; i < map_.size.x; ++i) {
                const std::size_t own = map_.columnStart[map_.columnNumber(i, j)];
                const std::span<const Run> runs = columns_.column(i, j);
                place_ = {i, j, 0};
                for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
                    const auto height = static_cast<std::int32_t>(runs[r].end);
                    touch(own + r, runs[r], own + r + 1, runs[r + 1], height, height);
                }
                for (const auto& [x, y] : {std::pair(i + 1, j), std::pair(i, j + 1)}) {
                    if (x == map_.size.x || y == map_.size.y) continue;
                    const std::size_t next = map_.columnStart[map_.columnNumber(x, y)];
                    const std::span<const Run> others = columns_.column(x, y);
                    axis_ = x > i ? 0 : 1;
                    forCommonHeights(runs, others,
                                     [&](std::size_t a, std::size_t b, std::int32_t from, std::int32_t to) {
                                         touch(own + a, runs[a], next + b, others[b], from, to);
                                     });
                }
            }
    }

    void joinAll() {
        forContacts([&](std::size_t a, const Run& one, std::size_t b, const Run& other, std::int32_t, std::int32_t) {
            const ScalarRole &first = roleOf(one), &second = roleOf(other);
            const bool isAir = first.role == Role::Background || first.role == Role::Passive;
            if (isAir && first.role == second.role && first.label == second.label)
                join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        });
        // Background at the border of the grid is outside air.
        for (std::int32_t j = 0; j < map_.size.y; ++j)
            for (std::int32_t i = 0; i < map_.size.x; ++i) {
                const std::span<const Run> runs = columns_.column(i, j);
                const bool isSide = i == 0 || j == 0 || i + 1 == map_.size.x || j + 1 == map_.size.y;
                for (std::size_t r = 0; r < runs.size(); ++r) {
                    const bool isBorder = isSide || r == 0 || r + 1 == runs.size();
                    if (isBorder && roleOf(runs[r]).role == Role::Background) {
                        const std::size_t run = map_.columnStart[map_.columnNumber(i, j)] + r;
                        zone_[rootOf(static_cast<std::uint32_t>(run))] = kOutside;
                    }
                }
            }
    }

    // The zone of a run as far as it is known.
    [[nodiscard]] std::uint32_t zoneOf(std::size_t r, const Run& run) {
        const ScalarRole& role = roleOf(run);
        if (role.role == Role::Room) return role.number;
        if (role.role != Role::Background && role.role != Role::Passive) return kUnresolved;
        return zone_[rootOf(static_cast<std::uint32_t>(r))];
    }

    // Gives the pieces of air of a role the zone that they touch most.
    void resolve(Role role) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, double> areas;  // piece and zone
        const Vec3d spacing = volume_.grid.spacing();
        const auto count = [&](std::size_t piece, const Run& own, std::uint32_t zone, double area) {
            if (roleOf(own).role != role || zone == kUnresolved) return;
            const std::uint32_t root = rootOf(static_cast<std::uint32_t>(piece));
            if (zone_[root] == kUnresolved) areas[{root, zone}] += area;
        };
        forContacts(
            [&](std::size_t a, const Run& one, std::size_t b, const Run& other, std::int32_t from, std::int32_t to) {
                if (roleOf(one).role != role && roleOf(other).role != role) return;
                const double area =
                    from == to ? spacing.x * spacing.y : (to - from) * spacing.z * (axis_ == 0 ? spacing.y : spacing.x);
                count(a, one, zoneOf(b, other), area);
                count(b, other, zoneOf(a, one), area);
            });
        std::map<std::uint32_t, std::pair<double, std::uint32_t>> most;
        for (const auto& [key, area] : areas) {
            auto& best = most.try_emplace(key.first, 0.0, kUnresolved).first->second;
            if (area > best.first) best = {area, key.second};
        }
        for (const auto& [root, best] : most) zone_[root] = best.second;
    }

    Result<AirMap> number() {
        findLeaks();
        map_.runs.resize(parent_.size());
        std::uint64_t cells = 0;
        for (std::int32_t j = 0; j < map_.size.y; ++j)
            for (std::int32_t i = 0; i < map_.size.x; ++i) {
                const std::size_t start = map_.columnStart[map_.columnNumber(i, j)];
                std::uint32_t begin = 0;
                std::size_t r = start;
                for (const Run& run : columns_.column(i, j)) {
                    RunPlace& place = map_.runs[r];
                    place = placeOf(r++, run);
                    if (place.hasCells()) {
                        place.number = static_cast<std::uint32_t>(cells + 1);
                        cells += run.end - begin;
                    }
                    begin = run.end;
                    if (cells > 0x7FFFFFFFu) return tooLarge();
                }
            }
        map_.cells = static_cast<std::uint32_t>(cells);
        return std::move(map_);
    }

    [[nodiscard]] RunPlace placeOf(std::size_t r, const Run& run) {
        const ScalarRole& role = roleOf(run);
        switch (role.role) {
            case Role::Room: return {RunKind::Air, role.number};
            case Role::Opening: return {RunKind::Opening, role.number};
            case Role::Blocked: return {RunKind::Blocked, 0};
            case Role::Solid:
            case Role::Ground: return {RunKind::Solid, 0};
            case Role::Background:
            case Role::Passive: break;
        }
        const std::uint32_t zone = zone_[rootOf(static_cast<std::uint32_t>(r))];
        return zone == kUnresolved ? RunPlace{RunKind::Cavity, 0} : RunPlace{RunKind::Air, zone};
    }

    // Rooms that touch background of outside.
    void findLeaks() {
        struct Touching {
            double faces = 0, area = 0;
            Vec3i first{};
        };
        std::map<std::uint32_t, Touching> found;
        const Vec3d spacing = volume_.grid.spacing();
        forContacts(
            [&](std::size_t a, const Run& one, std::size_t b, const Run& other, std::int32_t from, std::int32_t to) {
                const bool isFirst = roleOf(one).role == Role::Room;
                if (!isFirst && roleOf(other).role != Role::Room) return;
                if (roleOf(isFirst ? other : one).role != Role::Background) return;
                if (zone_[rootOf(static_cast<std::uint32_t>(isFirst ? b : a))] != kOutside) return;
                Touching& touching = found[roleOf(isFirst ? one : other).number];
                const Vec3i at{place_.x, place_.y, from};
                const bool isLower = touching.faces == 0 || at.z < touching.first.z;
                if (isLower) touching.first = at;
                const double faces = from == to ? 1 : to - from;
                touching.faces += faces;
                touching.area +=
                    from == to ? spacing.x * spacing.y : faces * spacing.z * (axis_ == 0 ? spacing.y : spacing.x);
            });
        for (const auto& [zone, touching] : found)
            if (touching.faces > 1)
                map_.leaks.push_back({zone, volume_.grid.worldFromIndex(toDouble(touching.first)), touching.area});
    }

    const volume::SemanticVolume& volume_;
    const ThermalRoles& roles_;
    const volume::ColumnVolume& columns_;
    AirMap map_;
    std::vector<std::uint32_t> parent_, zone_;
    Vec3i place_{};  // of the column of forContacts()
    int axis_ = 0;   // of a contact across x or y
};

// The number of the run that contains height k.
std::size_t runAt(std::span<const Run> runs, std::int32_t k) noexcept {
    std::size_t low = 0, high = runs.size() - 1;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (runs[middle].end > static_cast<std::uint32_t>(k))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

}  // namespace

AirMap::Found AirMap::find(Vec3i voxel) const noexcept {
    const std::span<const Run> column = columns->column(voxel.x, voxel.y);
    const std::size_t r = runAt(column, voxel.z);
    return {runs[columnStart[columnNumber(voxel.x, voxel.y)] + r], column[r].scalar, r > 0 ? column[r - 1].end : 0};
}

std::uint32_t AirMap::cellAt(Vec3i voxel) const noexcept {
    const Found found = find(voxel);
    return found.place.hasCells() ? found.place.number + static_cast<std::uint32_t>(voxel.z) - found.begin : 0;
}

Result<AirMap> makeAirMap(const volume::SemanticVolume& volume, const ThermalRoles& roles) {
    return AirMapMaker(volume, roles).make();
}

}  // namespace svt::simulate
