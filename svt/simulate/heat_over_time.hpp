#pragma once
/// \file
/// Temperatures of components over time, while the temperature outside changes: the conduction of heat.hpp with the
/// heat that solids store.
///
/// Steps in time: TR-BDF2 with gamma = 2 - sqrt(2) (Bank and others, "Transient simulation of silicon devices and
/// circuits", 1985; Hosea and Shampine, "Analysis and implementation of TR-BDF2", 1996). It is of second order and
/// L-stable, so steps may be longer than the time that heat needs to pass a voxel. Both stages have one matrix.

#include <svt/simulate/heat.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::simulate {

/// The temperature of outside air over time; linear between rows.
struct Weather {
    struct Row {
        double seconds = 0;  ///< since the first row
        double celsius = 0;
        friend bool operator==(const Row&, const Row&) = default;
    };
    std::vector<Row> rows;             ///< ascending; the first at 0
    std::optional<std::string> epoch;  ///< date and time of 0 s, ISO 8601, if the file has dates
    bool hasNoZone = false;            ///< dates without a zone, taken as UTC
};

/// Parses CSV (record::CsvReader) with the columns `time` (seconds, or ISO 8601) and `temperature` (degrees Celsius).
/// \param file  for messages
/// \return the weather, or BadValue with the line; also if times do not ascend, or a temperature is below -273.15 or
///         above 5000
[[nodiscard]] Result<Weather> parseWeather(std::string_view text, const std::string& file);

struct TimeOptions {
    double hours = 24;
    double step = 900;    ///< seconds
    double every = 3600;  ///< seconds between results; a whole number of steps
    Weather weather;      ///< without rows: HeatOptions::outside
    /// Degrees Celsius of all components at first; unset: the steady state of the first weather.
    std::optional<double> start;
};

/// Results at one time.
struct HeatAtTime {
    double seconds = 0;
    ZoneHeat outside;
    std::vector<ZoneHeat> rooms;  ///< ascending by label
};

struct HeatOverTime {
    fields::Field temperature;      ///< as HeatResult::temperature, at the times of the results
    std::vector<HeatAtTime> times;  ///< from 0 to `hours`
    std::vector<ThermalAssumption> assumed;
    std::vector<CapacityAssumption> capacities;
    std::vector<AirLeak> leaks;
    double planeShare = 0, faceArea = 0;  ///< as in HeatResult
    double capacity = 0;                  ///< J/K of all components
    double stored = 0;                    ///< J, from the first to the last time
    double received = 0;                  ///< J, from the air of all zones into components
    std::uint64_t cells = 0, undetermined = 0;
    std::int64_t steps = 0, iterations = 0;
};

/// Computes temperatures over time. Rooms keep their temperatures. The heat capacity of a component is that of its own
/// volume (analyze::ownMeasures()), divided equally among its voxels. Windows and doors store no heat.
///
/// \param findings  as simulateHeat()
/// \return the result, or
///         - the errors of simulateHeat()
///         - BadArgument: times out of range or that are not whole multiples of each other; weather that ends too early
///         - GridTooLarge: a field of more than 2^31 values
/// Cost: two solutions for each step, each with a few iterations. Memory: that of simulateHeat(), 60 bytes more for
/// each cell, and 4 for each voxel of the grid and result.
[[nodiscard]] Result<HeatOverTime> simulateHeatOverTime(const volume::SemanticVolume& volume,
                                                        const HeatOptions& options, const TimeOptions& time,
                                                        Diagnostics& findings);

}  // namespace svt::simulate
