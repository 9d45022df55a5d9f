#include <svt/field_readers/sensors/sensor_series.hpp>

#include <svt/core/text.hpp>
#include <svt/fields/check_field.hpp>
#include <svt/record/times.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::field_readers {

namespace {

// The distinct times, ascending.
std::vector<double> distinctTimes(const SensorSeries& series) {
    std::vector<double> times;
    times.reserve(series.samples.size());
    for (const SensorSample& sample : series.samples) times.push_back(sample.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

// Writes the samples of the kept times into the field.
Result<void> placeSamples(const SensorSeries& series, std::span<const double> times, const Reading& reading,
                          fields::Field& field) {
    constexpr std::uint64_t kNoLine = 0;
    const std::size_t sensors = series.sensors.size();
    std::vector<std::uint64_t> lines(field.values.size(), kNoLine);
    for (const SensorSample& sample : series.samples) {
        const auto at = std::lower_bound(times.begin(), times.end(), sample.time);
        if (at == times.end() || *at != sample.time || std::isnan(sample.value)) continue;
        const auto index = static_cast<std::size_t>(at - times.begin()) * sensors + sample.sensor;
        float& value = field.values[index];
        if (!std::isnan(value) && value != sample.value)
            return badField(fmt::format("sensor '{}' has two values at one time: {} and {}{}",
                                        series.sensors[sample.sensor].id, value, sample.value,
                                        lines[index] > 0 ? fmt::format(", the first on line {}", lines[index]) : ""),
                            reading.path, sample.line);
        value = sample.value;
        lines[index] = sample.line;
    }
    return {};
}

}  // namespace

Result<fields::Field> fieldOfSeries(const SensorSeries& series, Reading& reading, Assumptions assumptions) {
    fields::Field field;
    fields::FieldHead& head = field.head;
    head.name = series.name;
    head.kind = fields::FieldKind::Points;
    head.quantity = lowerAscii(series.quantity);
    head.medium = reading.options.medium.empty() ? "air" : reading.options.medium;
    std::vector<double> times = distinctTimes(series);
    double epoch = 0;
    if (series.isDated && !times.empty()) {
        epoch = std::floor(times.front());
        head.epoch = record::isoText(epoch);
        if (series.hasNoZone) {
            assumptions.add("zone", "times without a zone taken as UTC");
            reading.note("the times have no zone; they count as UTC");
        }
    }
    std::vector<double> seconds;
    for (const double time : times) seconds.push_back(time - epoch);
    SVT_TRY(kept, keptTimes(seconds, reading, head.name));
    if (kept->size() > fields::kMaxTimes || series.sensors.size() > fields::kMaxPoints)
        return Error(
            Code::InputTooBig,
            fmt::format("'{}' has {} times of {} sensors; at most {} times are possible, choose fewer with --from, "
                        "--to and --every",
                        head.name, kept->size(), series.sensors.size(), fields::kMaxTimes));
    SVT_DO(reading.addValues(series.sensors.size(), kept->size(), head.name));
    std::vector<double> keptSeries;
    head.times.clear();
    for (const std::size_t t : *kept) {
        keptSeries.push_back(times[t]);
        head.times.push_back(seconds[t]);
    }
    for (const SensorOfSeries& sensor : series.sensors) head.points.push_back({sensor.id, sensor.at});
    field.values.assign(keptSeries.size() * series.sensors.size(), std::numeric_limits<float>::quiet_NaN());
    SVT_DO(placeSamples(series, keptSeries, reading, field));
    const auto missing = std::count_if(field.values.begin(), field.values.end(), [](float v) { return std::isnan(v); });
    if (missing > 0)
        reading.note(
            fmt::format("'{}': {} of {} values are missing: empty cells, or sensors with values at different times",
                        head.name, missing, field.values.size()));
    SVT_DO(setUnit(field, series.unit, reading, assumptions));
    if (reading.options.precision) head.precision = *reading.options.precision;
    head.parameters = assumptions.json();
    return field;
}

}  // namespace svt::field_readers
