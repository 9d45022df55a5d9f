#pragma once
/// \file
/// Values of sensors over time, whatever the format, and the field that they become.

#include <svt/core/result.hpp>
#include <svt/field_readers/common/reading.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace svt::field_readers {

/// A value of a sensor.
struct SensorSample {
    double time = 0;           ///< seconds; since 1970 if SensorSeries::isDated
    std::uint32_t sensor = 0;  ///< index in SensorSeries::sensors
    float value = 0;           ///< NaN: missing
    std::uint64_t line = 0;    ///< in the file; 0: unknown
};

/// A place of a sensor, and where its name stands first in the file.
struct SensorOfSeries {
    std::string id;
    Vec3d at{};
    std::uint64_t line = 0;
};

struct SensorSeries {
    std::string name, quantity, unit;
    std::vector<SensorOfSeries> sensors;
    std::vector<SensorSample> samples;
    bool isDated = false;    ///< times are dates
    bool hasNoZone = false;  ///< dates without a zone, taken as UTC
};

/// Makes a field of points. Its times are all times of the samples; with dates, FieldHead::epoch is the first whole second.
/// \return the field, or BadField for two values of a sensor at one time that differ; InputTooBig; BadArgument for units
///         and times
[[nodiscard]] Result<fields::Field> fieldOfSeries(const SensorSeries& series, Reading& reading,
                                                  Assumptions assumptions);

/// A table of sensors: long (time, sensor, value) or wide (time, and a column for each sensor), with the places of
/// FieldReadOptions::places.
[[nodiscard]] Result<std::vector<fields::Field>> readSensorTable(Reading& reading);

/// An answer of OGC SensorThings 1.0 or 1.1: Things with Locations, Datastreams and Observations.
[[nodiscard]] Result<std::vector<fields::Field>> readSensorThings(Reading& reading);

}  // namespace svt::field_readers
