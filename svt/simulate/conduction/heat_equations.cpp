#include <svt/simulate/conduction/heat_equations.hpp>

#include <svt/core/parallel.hpp>
#include <svt/simulate/conduction/row_resistance.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace svt::simulate {
namespace {

using volume::Run;

constexpr double kSlopeOfHorizontal = 0.5;  // sin 30 degrees: ISO 6946, 6.8
constexpr double kParallel = 1 - 1e-6;
constexpr double kThinnestAir = 1e-3;  // voxels
constexpr double kFlattest = 1e-3;     // of faces along a row, so that no resistance is infinite

class EquationMaker {
public:
    explicit EquationMaker(const EquationParts& parts)
        : parts_(parts),
          volume_(parts.volume),
          roles_(parts.roles),
          map_(parts.map),
          spacing_(parts.volume.grid.spacing()) {
        const ThermalRoles& roles = parts.roles;
        keys_.reserve(roles.ofScalar.size());
        for (const ScalarRole& role : roles.ofScalar) {
            const bool isSolid = role.role == Role::Solid || role.role == Role::Ground;
            const bool isAir = role.role == Role::Background || role.role == Role::Room || role.role == Role::Passive;
            keys_.push_back(isSolid ? role.conductivity : isAir ? kAirKey : kOtherKey);
            isThin_.push_back(role.label != volume::kNoLabel && volume_.labels.labels[role.label].thinVoxels > 0);
        }
    }

    HeatEquations make() {
        addRuns();
        equations_.cells.allocate();
        for (const int axis : {0, 1, 2}) {
            if (parts_.faces != nullptr)
                rays_.emplace(volume_, parts_.finder.bricks(), *parts_.faces, axis, parts_.threads);
            addAxis(axis);
            if (rays_) addThinAir(axis);
            rays_.reset();
        }
        for (const BoundaryFace& face : equations_.faces) equations_.cells.toZones[face.cell] += face.conductance;
        return std::move(equations_);
    }

private:
    // A run of a column that touches another one.
    struct Side {
        RunPlace place;
        volume::Scalar scalar = 0;
        std::uint32_t begin = 0;  // height
        [[nodiscard]] std::uint32_t cellAt(std::int32_t k) const noexcept {
            return place.number + static_cast<std::uint32_t>(k) - begin;
        }
    };
    struct Sink {
        std::vector<BoundaryFace>& faces;
        FaceAreas& areas;
    };

    void addAxis(int axis) {
        const auto rows = static_cast<std::size_t>(map_.size.y);
        addInParts(rows, [&](std::size_t j, Sink& sink) {
            for (std::int32_t i = 0; i < map_.size.x; ++i) addColumn(i, static_cast<std::int32_t>(j), axis, sink);
        });
    }

    // Calls add(part, sink) for each part, and appends their faces in order.
    template <class Add>
    void addInParts(std::size_t rows, const Add& add) {
        std::vector<std::vector<BoundaryFace>> faces(rows);
        std::vector<FaceAreas> areas(rows);
        parallelFor(rows, 1, parts_.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t j = begin; j < end; ++j) {
                Sink sink{faces[j], areas[j]};
                add(j, sink);
            }
        });
        std::size_t count = equations_.faces.size();
        for (const auto& row : faces) count += row.size();
        equations_.faces.reserve(count);
        for (std::size_t j = 0; j < rows; ++j) {
            equations_.faces.insert(equations_.faces.end(), faces[j].begin(), faces[j].end());
            faces[j] = {};
            for (std::size_t s = 0; s < 3; ++s) {
                equations_.areas.bySource[s] += areas[j].bySource[s];
                equations_.areas.parallel[s] += areas[j].parallel[s];
            }
        }
    }

    void addRuns() {
        CellEquations& cells = equations_.cells;
        cells.columnsX = map_.size.x;
        cells.columnsY = map_.size.y;
        cells.count = map_.cells;
        for (std::int32_t j = 0; j < map_.size.y; ++j)
            for (std::int32_t i = 0; i < map_.size.x; ++i) {
                cells.columnStart.push_back(cells.runs.size());
                std::size_t r = map_.columnStart[map_.columnNumber(i, j)];
                std::uint32_t begin = 0;
                bool isJoined = false;
                for (const Run& run : volume_.columns.column(i, j)) {
                    const RunPlace& place = map_.runs[r++];
                    if (place.hasCells() && isJoined)
                        cells.runs.back().count += run.end - begin;
                    else if (place.hasCells())
                        cells.runs.push_back({place.number, run.end - begin, static_cast<std::int32_t>(begin)});
                    isJoined = place.hasCells();
                    begin = run.end;
                }
            }
        cells.columnStart.push_back(cells.runs.size());
    }

    [[nodiscard]] std::vector<Side> sidesOf(std::int32_t i, std::int32_t j) const {
        std::vector<Side> sides;
        std::size_t r = map_.columnStart[map_.columnNumber(i, j)];
        std::uint32_t begin = 0;
        for (const Run& run : volume_.columns.column(i, j)) {
            sides.push_back({map_.runs[r++], run.scalar, begin});
            begin = run.end;
        }
        return sides;
    }

    // The contacts of a column along one axis, upwards.
    void addColumn(std::int32_t i, std::int32_t j, int axis, Sink& sink) {
        const std::span<const Run> runs = volume_.columns.column(i, j);
        const std::vector<Side> own = sidesOf(i, j);
        if (axis < 2) {
            const std::int32_t x = axis == 0 ? i + 1 : i, y = axis == 0 ? j : j + 1;
            if (x == map_.size.x || y == map_.size.y) return;
            const std::vector<Side> next = sidesOf(x, y);
            forCommonHeights(runs, volume_.columns.column(x, y),
                             [&](std::size_t a, std::size_t b, std::int32_t from, std::int32_t to) {
                                 addContact(own[a], next[b], {i, j, from}, axis, to, sink);
                             });
            return;
        }
        for (std::size_t r = 0; r < own.size(); ++r) {
            const auto begin = static_cast<std::int32_t>(own[r].begin), end = static_cast<std::int32_t>(runs[r].end);
            if (own[r].place.hasCells() && end - begin > 1) addContact(own[r], own[r], {i, j, begin}, 2, end - 1, sink);
            if (r + 1 < own.size()) addContact(own[r], own[r + 1], {i, j, end - 1}, 2, end, sink);
        }
    }

    [[nodiscard]] double keyOf(const Side& side) const {
        return side.place.kind == RunKind::Cavity ? kAirKey : keys_[side.scalar];
    }
    [[nodiscard]] double conductivityOf(const Side& side) const {
        return side.place.kind == RunKind::Cavity ? kMixedAir : keys_[side.scalar];
    }
    [[nodiscard]] double areaAcross(int axis) const noexcept {
        return spacing_.x * spacing_.y * spacing_.z / spacing_[axis];
    }

    // Links equal material at the heights [from, to), each with the next voxel along the axis.
    void linkEqual(const Side& lower, const Side& upper, int axis, std::int32_t from, std::int32_t to) {
        const auto conductance = static_cast<float>(areaAcross(axis) * conductivityOf(lower) / spacing_[axis]);
        const std::int32_t up = axis == 2 ? 1 : 0;
        for (std::int32_t k = from; k < to; ++k)
            equations_.cells.link(axis, lower.cellAt(k), upper.cellAt(k + up), conductance);
    }

    // The contact of two sides from `voxel`, which is in `lower`, up to below height `end`; one face along z.
    void addContact(const Side& lower, const Side& upper, Vec3i voxel, int axis, std::int32_t end, Sink& sink) {
        const bool isLowerCell = lower.place.hasCells(), isUpperCell = upper.place.hasCells();
        if (isLowerCell && isUpperCell) {
            const bool isThin = rays_ && (isThin_[lower.scalar] != 0 || isThin_[upper.scalar] != 0);
            if (keyOf(lower) == keyOf(upper) && !isThin) {
                linkEqual(lower, upper, axis, voxel.z, end);
                return;
            }
            for (; voxel.z < end; ++voxel.z) linkDifferent(lower, upper, voxel, axis);
        } else if (isLowerCell && upper.place.kind == RunKind::Air) {
            for (; voxel.z < end; ++voxel.z) addFace(lower, upper.place.number, true, voxel, axis, sink);
        } else if (isUpperCell && lower.place.kind == RunKind::Air) {
            for (; voxel.z < end; ++voxel.z) addFace(upper, lower.place.number, false, voxel, axis, sink);
        }
    }

    void linkDifferent(const Side& lower, const Side& upper, Vec3i voxel, int axis) {
        const std::optional<double> resistance =
            rays_ ? resistanceByRay(lower, upper, voxel, axis) : resistanceByFace(lower, upper, voxel, axis);
        if (!resistance) return;
        const double least = 0.1 * spacing_[axis] / std::max(conductivityOf(lower), conductivityOf(upper));
        equations_.cells.link(axis, lower.cellAt(voxel.z), upper.cellAt(voxel.z + (axis == 2 ? 1 : 0)),
                              static_cast<float>(areaAcross(axis) / std::max(*resistance, least)));
    }

    [[nodiscard]] double resistanceByFace(const Side& lower, const Side& upper, Vec3i voxel, int axis) const {
        const double own = keyOf(lower);
        const FaceCrossing face =
            parts_.finder.find(voxel, axis, [&](volume::Scalar scalar) { return keys_[scalar] == own; });
        const double h = spacing_[axis];
        double resistance = face.at * h / conductivityOf(lower) + (1 - face.at) * h / conductivityOf(upper);
        if (lower.place.kind == RunKind::Cavity || upper.place.kind == RunKind::Cavity)
            resistance += kCavityFilm / partOf(face, axis);
        return resistance;
    }

    [[nodiscard]] std::optional<double> nodeOf(const RowResistance& row, const Side& cell, std::int32_t voxel) const {
        return row.nodeOf(voxel, cell.scalar, isThin_[cell.scalar] != 0);
    }

    // Between two cells. A cavity ends where the solid does, with the resistance of its air there.
    [[nodiscard]] std::optional<double> resistanceByRay(const Side& lower, const Side& upper, Vec3i voxel,
                                                        int axis) const {
        const RowResistance row(rays_->row(voxel), keys_, spacing_[axis]);
        const bool isLowerCavity = lower.place.kind == RunKind::Cavity,
                   isUpperCavity = upper.place.kind == RunKind::Cavity;
        if (isLowerCavity && isUpperCavity) return spacing_[axis] / kMixedAir;
        const auto byFace = [&] { return std::optional(resistanceByFace(lower, upper, voxel, axis)); };
        const std::int32_t at = voxel[axis];
        if (isLowerCavity || isUpperCavity) {
            const Side& cell = isUpperCavity ? lower : upper;
            const auto node = nodeOf(row, cell, isUpperCavity ? at : at + 1);
            const auto end = node ? row.endOf(*node, isUpperCavity) : std::nullopt;
            if (!end) return isThin_[cell.scalar] != 0 ? std::nullopt : byFace();
            const auto solid = row.between(std::min(*node, end->at), std::max(*node, end->at));
            if (!solid) return std::nullopt;
            return *solid + kCavityFilm / std::max(end->slope, kFlattest) + spacing_[axis] / 2 / kMixedAir;
        }
        const auto from = nodeOf(row, lower, at), to = nodeOf(row, upper, at + 1);
        if (!from || !to) return isThin_[lower.scalar] != 0 || isThin_[upper.scalar] != 0 ? std::nullopt : byFace();
        return row.between(std::min(*from, *to), std::max(*from, *to));
    }

    [[nodiscard]] static double partOf(const FaceCrossing& face, int axis) noexcept {
        return std::max(std::abs(face.normal[axis]), kFlattest);
    }

    // The cut of terrain at the border of the grid, where the terrain goes on.
    [[nodiscard]] bool isCutOfGround(const Side& cell, std::uint32_t zone, bool isAirAbove, Vec3i voxel,
                                     int axis) const {
        if (zone != 0 || roles_.ofScalar[cell.scalar].role != Role::Ground || (axis == 2 && isAirAbove)) return false;
        return isAirAbove ? voxel[axis] + 2 == map_.size[axis] : voxel[axis] == 0;
    }

    // Where the surface of a cell is.
    struct Surface {
        double distance = 0.5;  // voxels from the centre of the cell
        double solid = 0;       // m2 K/W from the cell's node to the surface
        double slope = 1, upwards = 0;
        FaceSource source = FaceSource::Voxel;
    };
    [[nodiscard]] Surface surfaceByFace(const Side& cell, bool isAirAbove, Vec3i voxel, int axis) const {
        const FaceCrossing face =
            parts_.finder.find(voxel, axis, [&](volume::Scalar scalar) { return (keys_[scalar] > 0) == isAirAbove; });
        const double distance = isAirAbove ? face.at : 1 - face.at;
        return {distance, distance * spacing_[axis] / conductivityOf(cell), partOf(face, axis),
                isAirAbove ? face.normal.z : -face.normal.z, face.source};
    }
    // Nothing if the row meets no solid of the cell.
    [[nodiscard]] std::optional<Surface> surfaceByRay(const Side& cell, bool isAirAbove, Vec3i voxel, int axis) const {
        const RowResistance row(rays_->row(voxel), keys_, spacing_[axis]);
        const std::int32_t at = voxel[axis] + (isAirAbove ? 0 : 1);
        const auto node = nodeOf(row, cell, at);
        if (!node && isThin_[cell.scalar] != 0) return std::nullopt;
        const auto end = node ? row.endOf(*node, isAirAbove) : std::nullopt;
        if (!end) return surfaceByFace(cell, isAirAbove, voxel, axis);
        const auto solid = row.between(std::min(*node, end->at), std::max(*node, end->at));
        if (!solid) return std::nullopt;
        return Surface{isAirAbove ? end->at - (at + 0.5) : at + 0.5 - end->at, *solid, std::max(end->slope, kFlattest),
                       end->upwards, end->hasFace ? FaceSource::Brick : FaceSource::Voxel};
    }

    // The face between a cell and air; `voxel` is the lower of both.
    void addFace(const Side& cell, std::uint32_t zone, bool isAirAbove, Vec3i voxel, int axis, Sink& sink) {
        if (isCutOfGround(cell, zone, isAirAbove, voxel, axis)) return;
        const std::optional<Surface> surface =
            rays_ ? surfaceByRay(cell, isAirAbove, voxel, axis) : surfaceByFace(cell, isAirAbove, voxel, axis);
        if (surface) addSurface(cell, zone, *surface, isAirAbove, voxel, axis, sink);
    }

    void addSurface(const Side& cell, std::uint32_t zone, const Surface& surface, bool isAirAbove, Vec3i voxel,
                    int axis, Sink& sink) const {
        const double area = areaAcross(axis), film = filmOf(zone, surface.upwards) / surface.slope;
        // Without a film, a face through the centre of the cell would have no resistance.
        const double least = film > 0 ? 0.0 : 1e-3 * spacing_[axis] / conductivityOf(cell);
        const std::int32_t k = voxel.z + (axis == 2 && !isAirAbove ? 1 : 0);
        BoundaryFace& one = sink.faces.emplace_back();
        one.cell = cell.cellAt(k);
        one.zone = zone;
        one.conductance = static_cast<float>(area / (std::max(surface.solid, least) + film));
        one.film = static_cast<float>(film / area);
        one.distance = static_cast<float>(surface.distance);
        one.area = static_cast<float>(area * surface.slope);
        one.direction = static_cast<std::uint8_t>(2 * axis + (isAirAbove ? 1 : 0));
        const auto source = static_cast<std::size_t>(surface.source);
        sink.areas.bySource[source] += area;
        if (surface.source == FaceSource::Voxel || surface.slope > kParallel) sink.areas.parallel[source] += area;
    }

    // Air between the centres of two cells, as in the inner edge of a turned room: no voxel has its label.
    void addThinAir(int axis) {
        constexpr std::size_t kRows = 256;
        addInParts((rays_->rows() + kRows - 1) / kRows, [&](std::size_t part, Sink& sink) {
            for (std::size_t r = part * kRows; r < std::min((part + 1) * kRows, rays_->rows()); ++r)
                addThinAirOf(rays_->firstVoxel(r), axis, sink);
        });
    }
    void addThinAirOf(Vec3i voxel, int axis, Sink& sink) {
        const std::span<const RowPart> parts = rays_->row(voxel);
        for (std::size_t n = 1; n + 1 < parts.size(); ++n) {
            const double from = parts[n].from, to = parts[n + 1].from;
            if (keys_[parts[n].scalar] != kAirKey || to - from < kThinnestAir) continue;
            voxel[axis] = static_cast<std::int32_t>(std::floor(from - 0.5));
            if (voxel[axis] < 0 || voxel[axis] + 1 >= map_.size[axis] || to > voxel[axis] + 1.5) continue;
            Vec3i next = voxel;
            ++next[axis];
            const AirMap::Found low = map_.find(voxel), high = map_.find(next);
            if (!low.place.hasCells() || !high.place.hasCells()) continue;
            const std::optional<std::uint32_t> zone = zoneNear(voxel, next);
            if (!zone) continue;
            const Side lower{low.place, low.scalar, low.begin}, upper{high.place, high.scalar, high.begin};
            equations_.cells.g[static_cast<std::size_t>(axis)][lower.cellAt(voxel.z)] = 0;
            addFace(lower, *zone, true, voxel, axis, sink);
            addFace(upper, *zone, false, voxel, axis, sink);
        }
    }
    // The zone of the air next to two voxels.
    [[nodiscard]] std::optional<std::uint32_t> zoneNear(Vec3i low, Vec3i high) const {
        for (int a = 0; a < 3; ++a) {
            low[a] = std::max(low[a] - 1, 0);
            high[a] = std::min(high[a] + 1, map_.size[a] - 1);
        }
        Vec3i at{};
        for (at.z = low.z; at.z <= high.z; ++at.z)
            for (at.y = low.y; at.y <= high.y; ++at.y)
                for (at.x = low.x; at.x <= high.x; ++at.x)
                    if (const RunPlace place = map_.at(at); place.kind == RunKind::Air) return place.number;
        return std::nullopt;
    }

    // \param upwards  the part of the normal towards the air along z
    [[nodiscard]] double filmOf(std::uint32_t zone, double upwards) const noexcept {
        if (zone == 0) return parts_.resistances.outside;
        if (upwards > kSlopeOfHorizontal) return parts_.resistances.insideDownwards;
        if (upwards < -kSlopeOfHorizontal) return parts_.resistances.insideUpwards;
        return parts_.resistances.inside;
    }

    const EquationParts& parts_;
    const volume::SemanticVolume& volume_;
    const ThermalRoles& roles_;
    const AirMap& map_;
    Vec3d spacing_;
    std::vector<double> keys_;     // by scalar
    std::vector<char> isThin_;     // by scalar: its label has voxels of thin parts
    std::optional<RowRays> rays_;  // of the axis at work
    HeatEquations equations_;
};

}  // namespace

HeatEquations makeHeatEquations(const EquationParts& parts) { return EquationMaker(parts).make(); }

std::vector<char> findDetermined(const HeatEquations& equations) {
    const CellEquations& cells = equations.cells;
    std::vector<std::uint32_t> parent(std::size_t{cells.count} + 2);
    for (std::size_t u = 0; u < parent.size(); ++u) parent[u] = static_cast<std::uint32_t>(u);
    const auto rootOf = [&](std::uint32_t u) {
        while (parent[u] != u) {
            parent[u] = parent[parent[u]];
            u = parent[u];
        }
        return u;
    };
    for (std::uint32_t u = 1; u <= cells.count; ++u)
        for (std::size_t a = 0; a < 3; ++a) {
            if (!(cells.g[a][u] > 0)) continue;
            const std::uint32_t one = rootOf(u), other = rootOf(a == 2 ? u + 1 : cells.next[a][u]);
            if (one != other) parent[std::max(one, other)] = std::min(one, other);
        }
    std::vector<char> isRootDetermined(parent.size(), 0);
    for (const BoundaryFace& face : equations.faces)
        if (face.conductance > 0) isRootDetermined[rootOf(face.cell)] = 1;
    std::vector<char> isDetermined(parent.size(), 0);
    for (std::uint32_t u = 1; u <= cells.count; ++u) isDetermined[u] = isRootDetermined[rootOf(u)];
    return isDetermined;
}

}  // namespace svt::simulate
