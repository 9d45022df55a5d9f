#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/sensors/places.hpp>
#include <svt/field_readers/sensors/sensor_series.hpp>
#include <svt/record/csv_reader.hpp>
#include <svt/record/times.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace svt::field_readers {
namespace {

// "temperature [Cel]" has a unit in brackets.
std::string_view takeUnit(std::string_view& title) {
    if (!title.ends_with(']')) return {};
    const std::size_t begin = title.rfind(" [");
    if (begin == std::string_view::npos) return {};
    const std::string_view unit = title.substr(begin + 2, title.size() - begin - 3);
    title = withoutBlanks(title.substr(0, begin));
    return unit;
}

bool isOneOf(std::string_view text, std::string_view choices) {
    for (const std::string_view choice : splitChoices(choices))
        if (equalsIgnoringCase(text, choice)) return true;
    return false;
}

class SensorTable {
public:
    SensorTable(Reading& reading, std::string_view text, const std::map<std::string, SensorPlace, std::less<>>& places)
        : reading_(reading), csv_(text), places_(places) {}

    Result<fields::Field> read() {
        if (!csv_.next(cells_)) return badField("the table is empty", reading_.path);
        SVT_DO(readHeader());
        while (csv_.next(cells_)) {
            if (csv_.isQuoteOpen()) return bad("a quote is not closed");
            SVT_DO(isLong_ ? addLongRow() : addWideRow());
        }
        series_.isDated = times_.isDated();
        series_.hasNoZone = times_.hasNoZone();
        series_.quantity = reading_.options.quantity.empty() ? series_.quantity : reading_.options.quantity;
        series_.name = fieldName(series_.quantity, fieldName(reading_.path.stem().string(), "sensors"));
        if (series_.samples.empty()) return badField("the table has no row with values", reading_.path);
        noteUnusedPlaces();
        Assumptions assumptions;
        assumptions.add("places", reading_.options.places.filename().string());
        for (const SensorOfSeries& sensor : series_.sensors) {
            const SensorPlace& place = places_.find(sensor.id)->second;
            if (!place.room.empty())
                assumptions.add("place of " + sensor.id,
                                fmt::format("voxel nearest to the centroid of room '{}'", place.room));
        }
        return fieldOfSeries(series_, reading_, std::move(assumptions));
    }

private:
    [[nodiscard]] Error bad(std::string message) const {
        return badField(std::move(message), reading_.path, csv_.line());
    }

    Result<void> readHeader() {
        std::optional<std::size_t> time, sensor, value;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (!time && isOneOf(cells_[c], "time|timestamp|date|datetime|seconds|t")) time = c;
            if (!sensor && isOneOf(cells_[c], "sensor|name|id")) sensor = c;
            std::string_view title = cells_[c];
            (void)takeUnit(title);
            if (!value && isOneOf(title, "value|result")) value = c;
        }
        if (!time) return bad("the first line must name a column 'time'");
        time_ = *time;
        isLong_ = sensor.has_value();
        if (!isLong_) return readWideHeader();
        sensor_ = *sensor;
        // With three columns, the value is the one that is left, and its title is the quantity.
        if (!value && cells_.size() == 3) value = 3 - *time - *sensor;
        if (!value) return bad("a table with a column 'sensor' must have a column 'value'");
        value_ = *value;
        std::string_view title = cells_[value_];
        series_.unit = std::string(takeUnit(title));
        if (!isOneOf(title, "value|result")) series_.quantity = std::string(title);
        return {};
    }

    Result<void> readWideHeader() {
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (c == time_) continue;
            std::string_view title = cells_[c];
            const std::string_view unit = takeUnit(title);
            const bool isFirst = wide_.empty();
            if (title.empty()) return bad(fmt::format("column {} has no name", c + 1));
            if (!isFirst && unit != series_.unit)
                return bad(fmt::format("the sensors have different units, '{}' and '{}'; write a table for each unit",
                                       series_.unit, unit));
            series_.unit = std::string(unit);
            SVT_TRY(sensor, sensorOf(title));
            wide_.emplace_back(c, *sensor);
        }
        if (wide_.empty()) return bad("the table has a column of times, but no column of values");
        return {};
    }

    // The sensor with a name; its first mention adds it.
    Result<std::uint32_t> sensorOf(std::string_view name) {
        if (const auto known = index_.find(name); known != index_.end()) return known->second;
        const auto place = places_.find(name);
        if (place == places_.end())
            return bad(fmt::format("sensor '{}' has no place in {}", name, reading_.options.places.string()));
        const auto index = static_cast<std::uint32_t>(series_.sensors.size());
        series_.sensors.push_back({std::string(name), place->second.at, csv_.line()});
        index_.emplace(std::string(name), index);
        return index;
    }

    Result<void> add(std::string_view time, std::uint32_t sensor, std::string_view cell) {
        SensorSample sample;
        sample.sensor = sensor;
        sample.line = csv_.line();
        std::string fault;
        if (!times_.read(time, csv_.number(time), sample.time, fault)) return bad(std::move(fault));
        const auto number = csv_.number(cell);
        if (!number && !isMissingCell(cell))
            return bad(fmt::format("'{}' is not a number; a missing value is an empty cell or NaN", cell));
        sample.value = number ? static_cast<float>(*number) : std::numeric_limits<float>::quiet_NaN();
        series_.samples.push_back(sample);
        return {};
    }

    Result<void> addLongRow() {
        const std::size_t columns = std::max({time_, sensor_, value_}) + 1;
        if (cells_.size() < columns) return bad(fmt::format("the row has {} cells of {}", cells_.size(), columns));
        SVT_TRY(sensor, sensorOf(cells_[sensor_]));
        return add(cells_[time_], *sensor, cells_[value_]);
    }

    Result<void> addWideRow() {
        if (cells_.size() <= time_) return bad("the row has no time");
        if (cells_.size() > wide_.size() + 1)
            return bad(fmt::format("the row has {} cells, but the first line {}", cells_.size(), wide_.size() + 1));
        for (const auto& [column, sensor] : wide_)
            SVT_DO(add(cells_[time_], sensor, column < cells_.size() ? std::string_view(cells_[column]) : ""));
        return {};
    }

    void noteUnusedPlaces() const {
        std::string unused;
        std::size_t count = 0;
        for (const auto& [name, place] : places_)
            if (index_.count(name) == 0 && ++count <= 5) unused += (unused.empty() ? "'" : ", '") + name + "'";
        if (count > 0)
            reading_.note(fmt::format("{} sensors with a place have no values: {}{}", count, unused,
                                      count > 5 ? " and others" : ""));
    }

    Reading& reading_;
    record::CsvReader csv_;
    const std::map<std::string, SensorPlace, std::less<>>& places_;
    std::vector<std::string> cells_;
    bool isLong_ = false;
    std::size_t time_ = 0, sensor_ = 0, value_ = 0;
    std::vector<std::pair<std::size_t, std::uint32_t>> wide_;  // column and sensor
    std::map<std::string, std::uint32_t, std::less<>> index_;
    record::TimeReader times_;
    SensorSeries series_;
};

}  // namespace

Result<std::vector<fields::Field>> readSensorTable(Reading& reading) {
    if (reading.options.places.empty())
        return Error(
            Code::BadArgument,
            "the sensors of the table have no places; give a table with the columns name,x,y,z or name,room with "
            "--places",
            {reading.path.string(), 0, 0, {}});
    SVT_TRY(bytes, FileBytes::read(reading.path, reading.options.maxBytes));
    SVT_DO(record::checkTableText(bytes->text(), reading.path.string()));
    SVT_TRY(places, readPlaces(reading));
    SensorTable table(reading, bytes->text(), *places);
    SVT_TRY(field, table.read());
    std::vector<fields::Field> fields;
    fields.push_back(std::move(*field));
    return fields;
}

}  // namespace svt::field_readers
