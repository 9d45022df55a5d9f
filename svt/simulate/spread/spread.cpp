#include <svt/simulate/spread.hpp>

#include <svt/fields/check_field.hpp>
#include <svt/fields/nearest_voxel.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/simulate/spread/air_distance.hpp>
#include <svt/simulate/spread/room_air.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace svt::simulate {
namespace {

using Json = nlohmann::ordered_json;
using volume::kNoLabel;

constexpr std::uint64_t kMostValues = std::uint64_t{1} << 31;
constexpr std::uint64_t kMostDistances = std::uint64_t{1} << 28;
constexpr float kLeast = 1e-3f;  // metres: a node at a sensor has its value to 1e-6 of the difference to others

struct NodeDistance {
    std::uint32_t node = 0;
    float metres = 0;
};

Result<void> checkInput(const fields::Field& sensors, const SpreadOptions& options) {
    const fields::FieldHead& head = sensors.head;
    if (head.kind != fields::FieldKind::Points || head.components != 1)
        return Error(
            Code::BadField,
            fmt::format("the field '{}' is of kind {}{}; only values of points, such as sensors, can be spread",
                        head.name, nameOf(head.kind), head.components > 1 ? " with vectors" : ""));
    if (!(options.step > 0 && options.step <= 1000))
        return Error(Code::BadArgument,
                     fmt::format("the step {} m is not a number above 0 and at most 1000", options.step));
    return {};
}

fields::FieldHead spreadHead(const volume::Grid& grid, const fields::FieldHead& sensors, const SpreadOptions& options) {
    fields::FieldHead head;
    head.name = options.name;
    head.quantity = sensors.quantity;
    head.unit = sensors.unit;
    head.medium = "air";
    head.times = sensors.times;
    head.epoch = sensors.epoch;
    head.by = "svt simulate spread";
    for (int axis = 0; axis < 3; ++axis) {
        const double voxels = std::round(options.step / grid.spacing()[axis]);
        const auto step = static_cast<std::int32_t>(std::clamp(voxels, 1.0, double(grid.dimension()[axis])));
        const std::int32_t first = (step - 1) / 2;
        head.lattice.first[axis] = first;
        head.lattice.step[axis] = step;
        // The last node is at the last voxel or beyond, so that the lattice covers all voxels.
        head.lattice.size[axis] = (grid.dimension()[axis] - 1 - first + step - 1) / step + 1;
    }
    return head;
}

// The distances of the nodes from one sensor after the other.
class Spreader {
public:
    Spreader(const volume::SemanticVolume& volume, const fields::Field& sensors, const SpreadOptions& options,
             const RoomAir& air)
        : volume_(volume), sensors_(sensors), options_(options), air_(air) {
        result_.field.head = spreadHead(volume.grid, sensors.head, options);
    }

    Result<SpreadResult> spread() {
        const fields::Lattice& lattice = result_.field.head.lattice;
        SVT_DO(fields::checkHead(result_.field.head));
        const std::uint64_t count = fields::valueCount(result_.field.head, 0);
        if (count > kMostValues)
            return Error(
                Code::GridTooLarge,
                fmt::format("the field would have {} values; at most {} are possible; choose a coarser --step or "
                            "fewer times ('svt field add --every')",
                            count, kMostValues));
        nodes_ = static_cast<std::size_t>(count / sensors_.head.times.size());
        findNodes(lattice);
        SVT_DO(measure());
        if (std::none_of(distances_.begin(), distances_.end(), [](const auto& one) { return !one.empty(); }))
            return Error(
                Code::BadArgument,
                fmt::format("no point of the field '{}' lies in a room, or within {} m of one; check its places",
                            sensors_.head.name, fields::kWallReach));
        addValues();
        findDry();
        result_.field.head.precision = precisionOf();
        result_.field.head.parameters = parameters();
        return std::move(result_);
    }

private:
    void findNodes(const fields::Lattice& lattice) {
        nodeOfVoxel_.reserve(nodes_);
        for (std::int32_t k = 0; k < lattice.size.z; ++k)
            for (std::int32_t j = 0; j < lattice.size.y; ++j)
                for (std::int32_t i = 0; i < lattice.size.x; ++i) {
                    const Vec3i at{i, j, k};
                    Vec3i voxel;
                    bool isInside = true;
                    for (int axis = 0; axis < 3; ++axis) {
                        voxel[axis] = static_cast<std::int32_t>(lattice.first[axis] + at[axis] * lattice.step[axis]);
                        isInside = isInside && voxel[axis] < air_.size[axis];
                    }
                    if (isInside && air_.zones[air_.number(voxel)] != RoomAir::kNone)
                        nodeOfVoxel_.emplace_back(static_cast<std::uint32_t>(air_.number(voxel)), node_);
                    ++node_;
                }
    }

    Result<void> measure() {
        const Vec3d spacing = volume_.grid.spacing();
        AirDistance distance(air_, spacing);
        isReached_.assign(volume_.labels.labels.size(), 0);
        const std::size_t points = sensors_.head.points.size();
        distances_.resize(points);
        std::uint64_t sum = 0;
        for (std::size_t p = 0; p < points; ++p) {
            if (Progress::isCancelled(options_.progress)) return Error(Code::Cancelled, "the simulation was stopped");
            Progress::tell(options_.progress, "sensors", double(p) / double(points));
            SensorPlace& sensor = result_.sensors.emplace_back();
            sensor.point = p;
            const Vec3d index = volume_.grid.indexFromWorld(sensors_.head.points[p].at);
            const auto voxel = fields::nearestVoxel(volume_.grid, index, fields::kWallReach,
                                                    [&](Vec3i at) { return roomAt(at) != kNoLabel; });
            if (!voxel) continue;
            sensor.label = roomAt(*voxel);
            const std::span<const std::uint32_t> reached = distance.from(index, *voxel);
            sensor.volume = double(reached.size()) * spacing.x * spacing.y * spacing.z;
            for (const std::uint32_t v : reached) markRoom(v);
            for (const auto& [v, node] : nodeOfVoxel_)
                if (distance.isReached(v)) distances_[p].push_back({node, distance.at(v)});
            sum += distances_[p].size();
            if (sum > kMostDistances)
                return Error(Code::GridTooLarge,
                             fmt::format("{} sensors have more than {} distances to nodes; choose a coarser --step",
                                         points, kMostDistances));
        }
        return {};
    }

    // The room of a voxel of air; kNoLabel: none.
    [[nodiscard]] std::uint32_t roomAt(Vec3i voxel) const {
        if (air_.zones[air_.number(voxel)] == RoomAir::kNone) return kNoLabel;
        return air_.roomOfScalar[volume_.columns.scalarAt(voxel.x, voxel.y, voxel.z)];
    }

    void markRoom(std::uint32_t voxel) {
        const std::uint32_t zone = air_.zones[voxel];
        const std::uint32_t room = zone > RoomAir::kCommon ? zone - 2 : roomAt(air_.place(voxel));
        if (room != kNoLabel) isReached_[room] = 1;
    }

    void addValues() {
        const std::size_t times = sensors_.head.times.size(), points = sensors_.head.points.size();
        result_.field.values.assign(times * nodes_, std::numeric_limits<float>::quiet_NaN());
        std::vector<double> weights(nodes_), sums(nodes_);
        for (std::size_t t = 0; t < times; ++t) {
            std::fill(weights.begin(), weights.end(), 0);
            std::fill(sums.begin(), sums.end(), 0);
            for (std::size_t p = 0; p < points; ++p) {
                const double value = sensors_.values[t * points + p];
                if (!std::isfinite(value)) continue;
                for (const NodeDistance& one : distances_[p]) {
                    const double metres = std::max(one.metres, kLeast);
                    weights[one.node] += 1 / (metres * metres);
                    sums[one.node] += value / (metres * metres);
                }
            }
            for (std::size_t n = 0; n < nodes_; ++n) {
                if (!(weights[n] > 0)) continue;
                result_.field.values[t * nodes_ + n] = static_cast<float>(sums[n] / weights[n]);
            }
        }
        for (std::size_t n = 0; n < nodes_; ++n) {
            bool hasValue = false;
            for (std::size_t t = 0; t < times; ++t)
                hasValue = hasValue || std::isfinite(result_.field.values[t * nodes_ + n]);
            result_.nodes += hasValue;
        }
    }

    void findDry() {
        for (const std::uint32_t room : air_.rooms)
            if (isReached_[room] == 0) result_.dry.push_back(room);
        result_.touching = air_.touching;
    }

    [[nodiscard]] double precisionOf() const {
        const auto range = fields::rangeOf(result_.field);
        return range ? fields::precisionFor(double{range->first}, double{range->second}) : 0;
    }

    [[nodiscard]] std::string parameters() const {
        const std::vector<fields::FieldPoint>& points = sensors_.head.points;
        Json without = Json::array();
        for (const SensorPlace& sensor : result_.sensors)
            if (sensor.label == kNoLabel) without.push_back(points[sensor.point].id);
        const Json json{{"sensors", sensors_.head.name},
                        {"weights", "1 / distance^2 through air"},
                        {"open", options_.open},
                        {"sensorsWithoutRoom", std::move(without)}};
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    const volume::SemanticVolume& volume_;
    const fields::Field& sensors_;
    const SpreadOptions& options_;
    const RoomAir& air_;
    SpreadResult result_;
    std::size_t nodes_ = 0;
    std::uint32_t node_ = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> nodeOfVoxel_;  // voxel and node, of air
    std::vector<std::vector<NodeDistance>> distances_;                  // of each point
    std::vector<char> isReached_;                                       // of each label
};

}  // namespace

Result<SpreadResult> spreadSensors(const volume::SemanticVolume& volume, const fields::Field& sensors,
                                   const SpreadOptions& options) {
    SVT_DO(checkInput(sensors, options));
    SVT_TRY(air, findRoomAir(volume, options.open));
    return Spreader(volume, sensors, options, *air).spread();
}

}  // namespace svt::simulate
