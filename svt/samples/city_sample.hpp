#pragma once
/// \file
/// Generated cities: many buildings in many files, as published by cities. They are load and ground truth for whole
/// cities; a house of the district (sample.hpp) is 20 times as large as a real one.

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/samples/sample.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace svt::samples {

/// The publisher whose files the city resembles.
enum class CityProfile : std::uint8_t {
    Dutch,    ///< CityJSONSeq 2.0, EPSG:7415, levels 1.2 and 2.2, parts: the 3DBAG
    Berlin,   ///< CityGML 1.0, EPSG:25833, LoD2 surfaces and solids by XLink
    NewYork,  ///< CityGML 1.0 and 2.0 alternately, EPSG:2263 with heights, US survey feet, only LoD2 surfaces
    Plateau   ///< CityGML 2.0, EPSG:6697 (degrees, north first), LoD1 and LoD2
};
constexpr auto namesOf(CityProfile) {
    using enum CityProfile;
    return std::to_array<Name<CityProfile>>(
        {{Dutch, "3dbag"}, {Berlin, "berlin"}, {NewYork, "nyc"}, {Plateau, "plateau"}});
}

struct CitySampleOptions {
    CityProfile profile = CityProfile::Berlin;
    std::uint64_t buildings = 1000;  ///< number of different buildings, 1..100,000,000
    int files = 1;                   ///< 1..100,000, up to one per 16 buildings
    std::uint64_t seed = 1;
};

struct CitySampleCount {
    std::uint64_t buildings = 0;  ///< including replicas
    std::uint64_t replicas = 0;   ///< buildings that an earlier file contains too, with the same bytes
    std::uint64_t broken = 0;     ///< buildings whose shell lacks a face, without replicas
    std::uint64_t vertices = 0;   ///< different vertices of the finest geometry of each building, without replicas
};

/// "0007.gml" or "0007.city.jsonl".
[[nodiscard]] std::string citySampleFileName(const CitySampleOptions& options, int file);

/// Writes file `file` (0-based) of the city. The same arguments give the same bytes, regardless of the files written
/// before.
///
/// The city has blocks of 16 lots between streets, rotated by 17 degrees. Buildings near the centre are taller. Two
/// thirds of all rows are terraces, whose houses share their party walls. The vertices of a building are log-normal
/// (median 22, sigma 1.1); 10 % are LoD1, 1 % LoD3 with windows, 0.2 % have rooms (LoD4). One in 100 heights is -9999
/// or 9999. One in 1000 shells lacks a face. One in eight buildings at the western and southern border of a file's area
/// is also in the file of the neighbour.
/// \return counts of the written buildings, or BadArgument for an option out of range, CannotWrite if the sink
///         returned false
/// Memory: one building.
Result<CitySampleCount> writeCitySample(const CitySampleOptions& options, int file, const SampleSink& sink);

}  // namespace svt::samples
