#pragma once
/// \file
/// Quantities of a city, tile by tile.

#include <apps/cli/quantities/take_off.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::cli {

struct CityTakeOff {
    std::filesystem::path input, output;  ///< output: .csv, .json or .parquet; empty: none
    TakeOffQuestion question;
    enum class Form : std::uint8_t { None, Text, Csv, JsonText };
    Form form = Form::Text;  ///< on stdout
};

/// Writes and prints one row per building, or per object of a query, and sums by keys. Areas by neighbours see the buildings
/// of neighbouring tiles. Space that buildings of two tiles share counts twice in sums; an assumption says so.
/// \return the exit code; or an error of City::open(), of the tiles, of a query, or CannotWrite, DiskFull
/// Memory: some tiles, and the rows of Parquet and of exterior areas in JSON.
[[nodiscard]] Result<int> runCityTakeOff(const CityTakeOff& take);

}  // namespace svt::cli
