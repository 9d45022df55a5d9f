#include <svt/simulate/conduction/heat_report.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace svt::simulate {
namespace {

using Json = nlohmann::ordered_json;
using volume::Run;

constexpr double kFineRange = 600;  // kelvins: 16 bits hold them in steps of 0.01
constexpr double kRim = 0.05;       // metres from openings within which surfaces have no extremes

class Reporter {
public:
    explicit Reporter(const SolvedHeat& solved)
        : solved_(solved), zones_(solved.roles.zones), extremes_(solved.roles.zones.size()) {}

    HeatResult report() {
        HeatResult result;
        addFaces();
        result.openings = addOpenings();
        double sum = 0, amounts = 0;
        for (const ZoneHeat& zone : zones_) {
            sum += zone.watts;
            amounts += std::abs(zone.watts);
        }
        result.balance = amounts > 0 ? std::abs(sum) / (amounts / 2) : 0;
        addExtremes();
        result.outside = std::move(zones_.front());
        result.rooms.assign(std::make_move_iterator(zones_.begin() + 1), std::make_move_iterator(zones_.end()));
        result.assumed = solved_.roles.assumed;
        const FaceAreas& areas = solved_.equations.areas;
        for (const double area : areas.bySource) result.faceArea += area;
        if (result.faceArea > 0)
            result.planeShare = 1 - areas.bySource[std::size_t(FaceSource::Voxel)] / result.faceArea;
        result.areaByBrick = areas.parallel[std::size_t(FaceSource::Brick)];
        result.areaByModel = areas.parallel[std::size_t(FaceSource::Model)];
        result.areaByVoxel = areas.parallel[std::size_t(FaceSource::Voxel)];
        return result;
    }

private:
    struct Extremes {
        const BoundaryFace *lowest = nullptr, *highest = nullptr;
        double low = std::numeric_limits<double>::infinity(), high = -low;
    };

    [[nodiscard]] double wattsOf(const BoundaryFace& face) const {
        const double air = solved_.roles.zones[face.zone].celsius;
        return double{face.conductance} * (air - solved_.celsius[face.cell]);
    }
    [[nodiscard]] double surfaceOf(const BoundaryFace& face) const {
        return solved_.roles.zones[face.zone].celsius - wattsOf(face) * double{face.film};
    }

    [[nodiscard]] Vec3i voxelOf(std::uint32_t cell) const {
        const CellEquations& cells = solved_.equations.cells;
        const auto after = std::upper_bound(cells.runs.begin(), cells.runs.end(), cell,
                                            [](std::uint32_t c, const CellRun& run) { return c < run.first; });
        const auto run = static_cast<std::size_t>(after - cells.runs.begin()) - 1;
        const auto start = std::upper_bound(cells.columnStart.begin(), cells.columnStart.end(), run);
        const auto column = static_cast<std::size_t>(start - cells.columnStart.begin()) - 1;
        const auto across = static_cast<std::size_t>(cells.columnsX);
        return {static_cast<std::int32_t>(column % across), static_cast<std::int32_t>(column / across),
                cells.runs[run].k + static_cast<std::int32_t>(cell - cells.runs[run].first)};
    }

    [[nodiscard]] bool isAtOpening(const BoundaryFace& face) const {
        const Vec3i voxel = voxelOf(face.cell);
        const Vec3d spacing = solved_.volume.grid.spacing();
        for (const OpeningPlace& place : solved_.openings) {
            bool isNear = place.max.z > 0;
            for (int a = 0; a < 3 && isNear; ++a) {
                const auto reach = static_cast<std::int32_t>(std::ceil(kRim / spacing[a]));
                isNear = voxel[a] >= place.min[a] - reach && voxel[a] < place.max[a] + reach;
            }
            if (isNear) return true;
        }
        return false;
    }

    void addFaces() {
        for (const BoundaryFace& face : solved_.equations.faces) {
            ZoneHeat& zone = zones_[face.zone];
            zone.watts += wattsOf(face);
            zone.area += double{face.area};
            const double surface = surfaceOf(face);
            Extremes& extremes = extremes_[face.zone];
            const bool isLower = surface<extremes.low, isHigher = surface> extremes.high;
            if ((!isLower && !isHigher) || isAtOpening(face)) continue;
            if (isLower) {
                extremes.low = surface;
                extremes.lowest = &face;
            }
            if (isHigher) {
                extremes.high = surface;
                extremes.highest = &face;
            }
        }
    }

    std::vector<OpeningHeat> addOpenings() {
        std::vector<OpeningHeat> openings = solved_.roles.openings;
        for (std::size_t n = 0; n < openings.size(); ++n)
            for (const auto& [zones, area] : solved_.openings[n].areas) {
                ZoneHeat &a = zones_[zones.first], &b = zones_[zones.second];
                const double watts = openings[n].transmittance * area * (a.celsius - b.celsius);
                openings[n].area += area;
                openings[n].watts += std::abs(watts);
                for (const auto& [zone, sign] : {std::pair(&a, 1.0), std::pair(&b, -1.0)}) {
                    zone->watts += sign * watts;
                    zone->openingWatts += sign * watts;
                }
            }
        return openings;
    }

    // The face of a cell towards a direction; null if there is none.
    [[nodiscard]] const BoundaryFace* findFace(std::uint32_t cell, std::uint8_t direction) const {
        for (const BoundaryFace& face : solved_.equations.faces)
            if (face.cell == cell && face.direction == direction) return &face;
        return nullptr;
    }

    [[nodiscard]] std::uint32_t cellAt(Vec3i voxel) const {
        for (int a = 0; a < 3; ++a)
            if (voxel[a] < 0 || voxel[a] >= solved_.map.size[a]) return 0;
        return solved_.map.cellAt(voxel);
    }

    // The temperature at the inner edges next to a face, extrapolated along the surface: temperatures of cells converge to
    // that of an edge only with the spacing.
    [[nodiscard]] double atEdges(const BoundaryFace& face) const {
        const Vec3i cell = voxelOf(face.cell);
        const int axis = face.direction / 2;
        Vec3i air = cell;
        air[axis] += (face.direction & 1) != 0 ? 1 : -1;
        const double own = surfaceOf(face);
        double surface = own;
        for (int across = 0; across < 3; ++across) {
            if (across == axis) continue;
            for (const int sign : {-1, 1}) {
                Vec3i beside = air, back = cell;
                beside[across] += sign;
                back[across] -= sign;
                const std::uint32_t wall = cellAt(beside), behind = cellAt(back);
                if (wall == 0 || behind == 0) continue;
                const BoundaryFace* edge = findFace(wall, static_cast<std::uint8_t>(2 * across + (sign < 0 ? 1 : 0)));
                const BoundaryFace* previous = findFace(behind, face.direction);
                if (edge == nullptr || previous == nullptr || edge->zone != face.zone || previous->zone != face.zone)
                    continue;
                surface += (own - surfaceOf(*previous)) * (1 - double{edge->distance});
            }
        }
        return surface;
    }

    [[nodiscard]] SurfacePoint pointOf(const BoundaryFace& face, double celsius) const {
        Vec3d index = toDouble(voxelOf(face.cell));
        index[face.direction / 2] += (face.direction & 1) != 0 ? double{face.distance} : -double{face.distance};
        return {celsius, solved_.volume.grid.worldFromIndex(index)};
    }

    void addExtremes() {
        for (std::size_t z = 0; z < zones_.size(); ++z) {
            const Extremes& extremes = extremes_[z];
            if (extremes.lowest != nullptr)
                zones_[z].lowest = pointOf(*extremes.lowest, std::min(extremes.low, atEdges(*extremes.lowest)));
            if (extremes.highest != nullptr)
                zones_[z].highest = pointOf(*extremes.highest, std::max(extremes.high, atEdges(*extremes.highest)));
        }
    }

    const SolvedHeat& solved_;
    std::vector<ZoneHeat> zones_;
    std::vector<Extremes> extremes_;
};

Json parametersOf(const SolvedHeat& solved, const HeatResult& result) {
    const std::vector<volume::Label>& labels = solved.volume.labels.labels;
    const SurfaceResistances& films = solved.options.resistances;
    Json json{{"outside", solved.options.outside},
              {"surfaceResistances",
               {{"inside", films.inside},
                {"insideUpwards", films.insideUpwards},
                {"insideDownwards", films.insideDownwards},
                {"outside", films.outside}}},
              {"rooms", Json::array()},
              {"openings", Json::array()},
              {"conductivities", Json::array()},
              {"planeShare", result.planeShare},
              {"isLeaky", !result.leaks.empty()}};
    for (const ZoneHeat& room : result.rooms)
        json["rooms"].push_back({{"id", labels[room.label].id}, {"celsius", room.celsius}, {"source", room.source}});
    for (const OpeningHeat& opening : result.openings)
        json["openings"].push_back(
            {{"id", labels[opening.label].id}, {"transmittance", opening.transmittance}, {"source", opening.source}});
    for (const ThermalAssumption& one : result.assumed) {
        Json ids = Json::array();
        for (const std::uint32_t l : one.labels) ids.push_back(labels[l].id);
        json["conductivities"].push_back({{"conductivity", one.conductivity},
                                          {"source", one.source},
                                          {"detail", one.detail},
                                          {"ids", std::move(ids)}});
    }
    return json;
}

}  // namespace

HeatResult reportHeat(const SolvedHeat& solved) { return Reporter(solved).report(); }

fields::FieldHead temperatureHead(const volume::SemanticVolume& volume, const HeatOptions& options) {
    fields::FieldHead head;
    head.name = options.name;
    head.quantity = "temperature";
    head.unit = "Cel";
    head.medium = "solid";
    head.lattice.size = volume.grid.dimension();
    head.precision = 0.01;
    head.by = "svt simulate heat";
    return head;
}

std::string temperatureParameters(const SolvedHeat& solved, const HeatResult& result) {
    return parametersOf(solved, result).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<float> temperatureValues(const SolvedHeat& solved) {
    const auto across = static_cast<std::size_t>(solved.map.size.x);
    const std::size_t layer = across * static_cast<std::size_t>(solved.map.size.y);
    std::vector<float> values(layer * static_cast<std::size_t>(solved.map.size.z),
                              std::numeric_limits<float>::quiet_NaN());
    for (std::size_t column = 0; column < layer; ++column) {
        const auto i = static_cast<std::int32_t>(column % across), j = static_cast<std::int32_t>(column / across);
        std::size_t r = solved.map.columnStart[column];
        std::uint32_t begin = 0;
        for (const Run& run : solved.volume.columns.column(i, j)) {
            const RunPlace& place = solved.map.runs[r++];
            if (place.kind == RunKind::Solid)
                for (std::uint32_t k = begin; k < run.end; ++k)
                    values[column + layer * k] = static_cast<float>(solved.celsius[place.number + k - begin]);
            begin = run.end;
        }
    }
    return values;
}

fields::Field temperatureField(const SolvedHeat& solved, const HeatResult& result) {
    fields::Field field;
    field.head = temperatureHead(solved.volume, solved.options);
    double low = solved.options.outside, high = low;
    for (const ZoneHeat& room : result.rooms) {
        low = std::min(low, room.celsius);
        high = std::max(high, room.celsius);
    }
    if (high - low > kFineRange) field.head.precision = 0.1;
    field.head.parameters = temperatureParameters(solved, result);
    field.values = temperatureValues(solved);
    return field;
}

}  // namespace svt::simulate
