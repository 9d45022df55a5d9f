#include <svt/simulate/heat_over_time.hpp>

#include <svt/analyze/label_measures.hpp>
#include <svt/simulate/conduction/heat_model.hpp>
#include <svt/simulate/conduction/heat_report.hpp>
#include <svt/simulate/materials/thermal_words.hpp>
#include <svt/simulate/over_time/time_stepper.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace svt::simulate {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostHours = 1e6, kLeastStep = 0.001, kMostSteps = 1e8;
constexpr double kMostValues = double(std::uint64_t{1} << 31);
constexpr double kFineRange = 600;  // kelvins: 16 bits hold them in steps of 0.01
constexpr double kHour = 3600;

bool isWhole(double number) noexcept { return std::abs(number - std::round(number)) < 1e-6; }

Result<void> checkTimes(const volume::SemanticVolume& volume, const TimeOptions& time) {
    const auto wrong = [](std::string text) { return Error(Code::BadArgument, std::move(text)); };
    if (!(time.hours > 0 && time.hours <= kMostHours))
        return wrong(fmt::format("{} hours are not a number above 0 and at most {}", time.hours, kMostHours));
    if (!(time.step >= kLeastStep && time.step <= time.hours * kHour))
        return wrong(fmt::format("a step of {} s is not a number from {} to the whole time, {} s", time.step,
                                 kLeastStep, time.hours * kHour));
    if (!(time.every >= time.step && isWhole(time.every / time.step)))
        return wrong(fmt::format("results every {} s are not a whole number of steps of {} s", time.every, time.step));
    if (!isWhole(time.hours * kHour / time.every))
        return wrong(fmt::format("{} hours are not a whole number of times {} s, the time between results", time.hours,
                                 time.every));
    if (!(time.hours * kHour / time.step <= kMostSteps))
        return wrong(fmt::format("{} hours have more than {} steps of {} s", time.hours, kMostSteps, time.step));
    if (time.start && !(*time.start >= -273.15 && *time.start <= 5000))
        return wrong(fmt::format("start: {} is not a temperature from -273.15 to 5000 degrees Celsius", *time.start));
    if (!time.weather.rows.empty() && time.weather.rows.back().seconds < time.hours * kHour - 1e-6)
        return wrong(
            fmt::format("the weather ends after {:.6g} h, but {} hours are asked for; give a longer table, or "
                        "fewer hours",
                        time.weather.rows.back().seconds / kHour, time.hours));
    const double values = (time.hours * kHour / time.every + 1) * double(volume.grid.sampleCount());
    if (values > kMostValues)
        return Error(
            Code::GridTooLarge,
            fmt::format("the field would have {:.0f} values; at most {:.0f} are possible; choose fewer results "
                        "(--every), or a coarser --spacing",
                        values, kMostValues));
    return {};
}

double outsideAt(const Weather& weather, double seconds, double otherwise) {
    const std::vector<Weather::Row>& rows = weather.rows;
    if (rows.empty()) return otherwise;
    const auto after = std::upper_bound(rows.begin(), rows.end(), seconds,
                                        [](double s, const Weather::Row& row) { return s < row.seconds; });
    if (after == rows.begin()) return rows.front().celsius;
    if (after == rows.end()) return rows.back().celsius;
    const Weather::Row &a = *(after - 1), &b = *after;
    return a.celsius + (b.celsius - a.celsius) * (seconds - a.seconds) / (b.seconds - a.seconds);
}

// J/K of each cell; count + 2 entries.
std::vector<double> capacitiesOf(const volume::SemanticVolume& volume, const HeatModel& model) {
    const Vec3d spacing = volume.grid.spacing();
    const double voxel = spacing.x * spacing.y * spacing.z;
    // m3 of a voxel of each label: its own volume, divided equally.
    const std::vector<analyze::Measure> measures = analyze::ownMeasures(volume.labels, volume.grid);
    const std::vector<std::uint32_t> labelOfScalar = volume.labels.labelOfScalar();
    const auto part = [&](volume::Scalar scalar) {
        const std::uint32_t label = labelOfScalar[scalar];
        if (label == volume::kNoLabel) return voxel;
        const analyze::Measure& own = measures[label];
        return own.volume && own.voxels > 0 ? *own.volume / double(own.voxels) : voxel;
    };
    std::vector<double> capacities(std::size_t{model.map.cells} + 2, 0);
    std::size_t r = 0;
    for (std::int32_t j = 0; j < model.map.size.y; ++j)
        for (std::int32_t i = 0; i < model.map.size.x; ++i) {
            std::uint32_t begin = 0;
            for (const volume::Run& run : model.map.columns->column(i, j)) {
                const RunPlace& place = model.map.runs[r++];
                const double capacity = place.kind == RunKind::Cavity
                                            ? kAirCapacity * voxel
                                            : model.roles.ofScalar[run.scalar].heatCapacity * part(run.scalar);
                if (place.hasCells()) std::fill_n(capacities.begin() + place.number, run.end - begin, capacity);
                begin = run.end;
            }
        }
    return capacities;
}

class Simulation {
public:
    Simulation(const volume::SemanticVolume& volume, const HeatOptions& options, const TimeOptions& time,
               HeatModel& model)
        : volume_(volume), options_(options), time_(time), model_(model) {}

    Result<HeatOverTime> run() {
        setOutside(0);
        std::vector<double> celsius(std::size_t{model_.map.cells} + 2, 0);
        if (time_.start)
            std::fill_n(celsius.begin() + 1, model_.map.cells, *time_.start);
        else
            SVT_DO(solveSteady(model_, options_, celsius));
        isDetermined_ = findDetermined(model_.equations);
        result_.undetermined =
            static_cast<std::uint64_t>(std::count(isDetermined_.begin() + 1, isDetermined_.end() - 1, 0));
        TimeStepper stepper(model_.equations, capacitiesOf(volume_, model_), time_.step, options_);
        result_.capacity = stepper.capacity();
        const double content = stepper.content(celsius);
        addResult(0, celsius);
        const auto steps = static_cast<std::int64_t>(std::llround(time_.hours * kHour / time_.step));
        const auto every = static_cast<std::int64_t>(std::llround(time_.every / time_.step));
        for (std::int64_t n = 0; n < steps; ++n) {
            Progress::tell(options_.progress, "solve", double(n) / double(steps));
            const auto outside = [&](double part) {
                return outsideAt(time_.weather, (double(n) + part) * time_.step, options_.outside);
            };
            SVT_TRY(iterations, stepper.step(model_.roles, outside, celsius));
            result_.iterations += *iterations;
            if ((n + 1) % every == 0) addResult(double(n + 1) * time_.step, celsius);
        }
        result_.steps = steps;
        result_.stored = stepper.content(celsius) - content;
        result_.received = stepper.received();
        finish();
        return std::move(result_);
    }

private:
    void setOutside(double seconds) {
        model_.roles.zones.front().celsius = outsideAt(time_.weather, seconds, options_.outside);
        model_.roles.zones.front().source = time_.weather.rows.empty() ? "--outside" : "--weather";
    }

    void addResult(double seconds, std::vector<double> celsius) {
        setOutside(seconds);
        for (std::size_t u = 1; u + 1 < celsius.size(); ++u)
            if (isDetermined_[u] == 0) celsius[u] = std::numeric_limits<double>::quiet_NaN();
        const SolvedHeat solved{volume_,          options_,        model_.roles, model_.map,
                                model_.equations, model_.openings, celsius};
        HeatResult at = reportHeat(solved);
        if (result_.times.empty()) {
            result_.temperature.head = temperatureHead(volume_, options_);
            result_.temperature.head.parameters = temperatureParameters(solved, at);
            result_.planeShare = at.planeShare;
            result_.faceArea = at.faceArea;
            result_.assumed = std::move(at.assumed);
        }
        const std::vector<float> values = temperatureValues(solved);
        result_.temperature.values.insert(result_.temperature.values.end(), values.begin(), values.end());
        result_.times.push_back({seconds, std::move(at.outside), std::move(at.rooms)});
    }

    void finish() {
        result_.capacities = model_.roles.capacities;
        result_.leaks = model_.map.leaks;
        result_.cells = model_.map.cells;
        fields::FieldHead& head = result_.temperature.head;
        head.times.clear();
        for (const HeatAtTime& at : result_.times) head.times.push_back(at.seconds);
        head.epoch = time_.weather.epoch;
        const auto range = fields::rangeOf(result_.temperature);
        if (range && range->second - range->first > kFineRange) head.precision = 0.1;
        head.parameters = parameters(head.parameters);
    }

    // Those of the first time, and everything that is about time.
    [[nodiscard]] std::string parameters(const std::string& atFirst) const {
        Json json = Json::parse(atFirst);
        json["hours"] = time_.hours;
        json["step"] = time_.step;
        json["start"] = time_.start ? Json(*time_.start) : Json("steady");
        json["weather"] = Json::array();
        for (const Weather::Row& row : time_.weather.rows) json["weather"].push_back({row.seconds, row.celsius});
        json["heatCapacities"] = Json::array();
        for (const CapacityAssumption& one : result_.capacities) {
            Json ids = Json::array();
            for (const std::uint32_t l : one.labels) ids.push_back(volume_.labels.labels[l].id);
            json["heatCapacities"].push_back({{"heatCapacity", one.heatCapacity},
                                              {"source", one.source},
                                              {"detail", one.detail},
                                              {"ids", std::move(ids)}});
        }
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    const volume::SemanticVolume& volume_;
    const HeatOptions& options_;
    const TimeOptions& time_;
    HeatModel& model_;
    HeatOverTime result_;
    std::vector<char> isDetermined_;  // by cell
};

}  // namespace

Result<HeatOverTime> simulateHeatOverTime(const volume::SemanticVolume& volume, const HeatOptions& options,
                                          const TimeOptions& time, Diagnostics& findings) {
    SVT_DO(checkTimes(volume, time));
    SVT_TRY(model, makeHeatModel(volume, options, findings));
    return Simulation(volume, options, time, *model).run();
}

}  // namespace svt::simulate
