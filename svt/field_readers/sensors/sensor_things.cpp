#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/sensors/places.hpp>
#include <svt/field_readers/sensors/sensor_series.hpp>
#include <svt/record/times.hpp>

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <limits>

namespace svt::field_readers {
namespace {

using Element = simdjson::dom::element;

// A member of an object as text; empty if it is missing or of another type.
std::string_view textOf(const Element& object, std::string_view key) {
    std::string_view text;
    return object[key].get(text) == simdjson::SUCCESS ? text : std::string_view();
}

std::optional<Element> memberOf(const Element& object, std::string_view key) {
    Element member;
    if (object[key].get(member) != simdjson::SUCCESS) return std::nullopt;
    return member;
}

// The entries of an array, or the object itself, since a service expands a single entity to an object.
std::vector<Element> entriesOf(const std::optional<Element>& value) {
    std::vector<Element> entries;
    if (!value) return entries;
    simdjson::dom::array array;
    if (value->get(array) == simdjson::SUCCESS)
        for (const Element entry : array) entries.push_back(entry);
    else if (value->is_object())
        entries.push_back(*value);
    return entries;
}

// The point of a GeoJSON geometry or feature.
std::optional<Vec3d> pointOf(const Element& location) {
    const auto geometry = memberOf(location, "geometry");
    const auto coordinates = memberOf(geometry ? *geometry : location, "coordinates");
    simdjson::dom::array numbers;
    if (!coordinates || coordinates->get(numbers) != simdjson::SUCCESS) return std::nullopt;
    Vec3d point;
    int axis = 0;
    for (const Element entry : numbers) {
        double number = 0;
        if (axis == 3 || entry.get(number) != simdjson::SUCCESS) return std::nullopt;
        point[axis++] = number;
    }
    return axis == 3 ? std::optional(point) : std::nullopt;
}

class ThingsReader {
public:
    ThingsReader(Reading& reading, std::map<std::string, SensorPlace, std::less<>> places)
        : reading_(reading), places_(std::move(places)) {}

    Result<std::vector<fields::Field>> read(const Element& root) {
        noteLink(root, "@iot.nextLink", "the Things");
        auto things = entriesOf(memberOf(root, "value"));
        if (things.empty() && memberOf(root, "Datastreams")) things.push_back(root);
        for (const Element& thing : things) SVT_DO(addThing(thing));
        if (series_.empty())
            return badField(
                "the answer has no Thing with Datastreams and Observations; ask for "
                "Things?$expand=Locations,Datastreams($expand=Observations)",
                reading_.path);
        if (texts_ > 0)
            reading_.warn(Code::BadField, fmt::format("{} results are not numbers; they count as missing", texts_));
        if (intervals_ > 0) reading_.note(fmt::format("{} times are intervals; their begin counts", intervals_));
        std::vector<fields::Field> fields;
        for (auto& [key, series] : series_) {
            if (series.samples.empty()) continue;
            Assumptions assumptions;
            assumptions.add("places", reading_.options.places.empty()
                                          ? "coordinates of the Locations, taken as world space"
                                          : reading_.options.places.filename().string());
            series.isDated = times_.isDated();
            series.hasNoZone = times_.hasNoZone();
            SVT_TRY(field, fieldOfSeries(series, reading_, std::move(assumptions)));
            fields.push_back(std::move(*field));
        }
        if (fields.empty()) return badField("no Datastream that is asked for has Observations", reading_.path);
        return fields;
    }

private:
    void noteLink(const Element& object, std::string_view key, std::string_view what) const {
        const std::string_view link = textOf(object, key);
        if (!link.empty())
            reading_.warn(
                Code::FieldInPart,
                fmt::format("{} go on at {}, which is not followed; save all pages in one file, for example with "
                            "$top",
                            what, link));
    }

    Result<void> addThing(const Element& thing) {
        const std::string name(textOf(thing, "name"));
        std::optional<Vec3d> at;
        if (const auto place = places_.find(name); place != places_.end()) at = place->second.at;
        if (!at && places_.empty())
            for (const Element& location : entriesOf(memberOf(thing, "Locations")))
                if (const auto geometry = memberOf(location, "location"); geometry && !at) at = pointOf(*geometry);
        noteLink(thing, "Datastreams@iot.nextLink", fmt::format("the Datastreams of '{}'", name));
        const auto streams = entriesOf(memberOf(thing, "Datastreams"));
        for (const Element& stream : streams) {
            SensorSeries* series = seriesOf(stream);
            if (series == nullptr) continue;
            if (!at)
                return badField(
                    places_.empty()
                        ? fmt::format("Thing '{}' has no Location with three coordinates; give its "
                                      "place with --places",
                                      name)
                        : fmt::format("Thing '{}' has no place in {}", name, reading_.options.places.string()),
                    reading_.path);
            SVT_DO(addStream(name, stream, *at, *series));
        }
        return {};
    }

    // The series of a Datastream, by its property and unit; null where another quantity is asked for.
    SensorSeries* seriesOf(const Element& stream) {
        const auto property = memberOf(stream, "ObservedProperty");
        const std::string quantity(property ? textOf(*property, "name") : textOf(stream, "name"));
        if (!isAskedFor(reading_.options, std::array<std::string_view, 2>{quantity, textOf(stream, "name")}))
            return nullptr;
        const auto unit = memberOf(stream, "unitOfMeasurement");
        const std::string symbol(unit ? textOf(*unit, "symbol") : "");
        SensorSeries& series = series_[quantity + "\n" + symbol];
        series.quantity = quantity;
        series.unit = symbol;
        series.name = fieldName(quantity, "sensors");
        return &series;
    }

    Result<void> addStream(const std::string& thing, const Element& stream, Vec3d at, SensorSeries& series) {
        std::string id = thing;
        const auto isTaken = [&](const SensorOfSeries& sensor) { return sensor.id == id; };
        for (int n = 1; std::find_if(series.sensors.begin(), series.sensors.end(), isTaken) != series.sensors.end();
             ++n)
            id = n == 1 ? fmt::format("{}/{}", thing, textOf(stream, "name")) : fmt::format("{}/{}", thing, n);
        noteLink(stream, "Observations@iot.nextLink", fmt::format("the Observations of '{}'", id));
        const auto sensor = static_cast<std::uint32_t>(series.sensors.size());
        series.sensors.push_back({id, at, 0});
        for (const Element& observation : entriesOf(memberOf(stream, "Observations"))) {
            SensorSample sample;
            sample.sensor = sensor;
            std::string_view time = textOf(observation, "phenomenonTime");
            if (const std::size_t slash = time.find('/'); slash != std::string_view::npos) {
                time = time.substr(0, slash);
                ++intervals_;
            }
            std::string fault;
            if (!times_.read(time, std::nullopt, sample.time, fault))
                return badField(fmt::format("'{}': {}", id, fault), reading_.path);
            sample.value = resultOf(observation);
            series.samples.push_back(sample);
        }
        return {};
    }

    // A number, or a text that is one.
    float resultOf(const Element& observation) {
        constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
        const auto result = memberOf(observation, "result");
        double number = 0;
        if (!result || result->is_null()) return kMissing;
        if (result->get(number) == simdjson::SUCCESS) return static_cast<float>(number);
        const std::string_view text = textOf(observation, "result");
        if (const auto parsed = parseNumber(withoutBlanks(text))) return static_cast<float>(*parsed);
        if (!result->is_string() || !isMissingCell(text)) ++texts_;
        return kMissing;
    }

    Reading& reading_;
    std::map<std::string, SensorPlace, std::less<>> places_;
    std::map<std::string, SensorSeries> series_;
    record::TimeReader times_;
    std::uint64_t texts_ = 0, intervals_ = 0;
};

}  // namespace

Result<std::vector<fields::Field>> readSensorThings(Reading& reading) {
    constexpr std::uint64_t kMaxAnswer = std::uint64_t{1} << 30;
    SVT_TRY(bytes, FileBytes::read(reading.path, std::min(kMaxAnswer, reading.options.maxBytes)));
    std::map<std::string, SensorPlace, std::less<>> places;
    if (!reading.options.places.empty()) {
        SVT_TRY(table, readPlaces(reading));
        places = std::move(*table);
    }
    simdjson::dom::parser parser;
    Element root;
    const auto text = bytes->text();
    if (const auto error = parser.parse(text.data(), text.size()).get(root); error != simdjson::SUCCESS)
        return badField(fmt::format("the file is not JSON: {}", simdjson::error_message(error)), reading.path);
    return ThingsReader(reading, std::move(places)).read(root);
}

}  // namespace svt::field_readers
