#pragma once
/// \file
/// Steady heat conduction through the components of a volume: finite volumes on the volume's grid (ISO 10211), with
/// resistances along one ray per row of voxels, through the model's triangles or planes.
///
///     outside |  wall            | room
///       Te    o---.---.---.---.--o   Ti     . unknown temperatures   o exact faces
///
/// The resistance between two centres is the sum of d / lambda along the line. From a centre to the air it is this sum up to
/// the face, and Rs / |n| with the part n of the face's normal along the line.
/// Rooms and outside air have given temperatures. Windows and doors have a U-value and no unknowns.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::simulate {

/// Thermal properties of the components that a query selects. Rooms stay air.
struct ThermalRule {
    std::string query;
    /// W/(m K). 0: no heat passes (adiabatic). For a window or door: it conducts as a solid instead of by its U-value.
    double conductivity = 0;
    double density = 0;       ///< kg/m3; 0: not given. Only for temperatures over time.
    double specificHeat = 0;  ///< J/(kg K); 0: not given. Only for temperatures over time.
    friend bool operator==(const ThermalRule&, const ThermalRule&) = default;
};

/// Parses CSV (record::CsvReader) with the columns `query`, `conductivity`, `density` and `specificHeat` (the last two are
/// optional), named in the first line in any order.
/// \param file  for messages
/// \return the rules in order, or BadValue with the line
[[nodiscard]] Result<std::vector<ThermalRule>> parseThermalRules(std::string_view text, const std::string& file);

/// The temperature of the rooms that a query selects.
struct RoomTemperature {
    std::string query;
    double celsius = 20;
    friend bool operator==(const RoomTemperature&, const RoomTemperature&) = default;
};

/// Surface resistances in m2 K/W, by the direction of the heat flow: ISO 6946. A face counts as horizontal if its normal is
/// within 60 degrees of the vertical.
struct SurfaceResistances {
    double inside = 0.13;           ///< at walls
    double insideUpwards = 0.10;    ///< at ceilings
    double insideDownwards = 0.17;  ///< at floors
    double outside = 0.04;
    friend bool operator==(const SurfaceResistances&, const SurfaceResistances&) = default;
};

struct HeatOptions {
    double outside = -5;  ///< degrees Celsius
    /// Later rules take precedence. Other rooms have the attribute SpaceTemperatureMin of their file, else 20 degrees.
    std::vector<RoomTemperature> inside;
    /// Earlier rules take precedence over each other and over everything that the model states.
    std::vector<ThermalRule> materials;
    SurfaceResistances resistances;
    bool isLeaky = false;              ///< computes although a room is open to outside air
    std::string name = "temperature";  ///< of the field
    double tolerance = 1e-8;           ///< of the residual, relative
    int mostIterations = 1000;
    /// All labels, the highest priority first (analyze::labelsByPriority()): lines between voxels follow the meshes of the
    /// volume. Empty, or without meshes: they follow its planes, and thin layers have the thickness of voxels.
    std::vector<std::uint32_t> priority;
    int threads = 0;                     ///< 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;  ///< stages "cells", "equations", "solve"
};

/// A place on the surface of a component.
struct SurfacePoint {
    double celsius = 0;
    Vec3d at{};  ///< world space, metres
};

/// The heat of a room, or of outside air.
struct ZoneHeat {
    std::uint32_t label = volume::kNoLabel;  ///< of the room; kNoLabel: outside
    double celsius = 0;                      ///< of the air
    std::string source;                      ///< of this temperature: "--outside", "--inside", "model" or "default"
    double watts = 0;                        ///< from the air into components; negative if it receives heat
    double openingWatts = 0;                 ///< of it: through windows and doors
    double area = 0;                         ///< m2 of conducting surfaces that touch the air
    std::optional<SurfacePoint> lowest,
        highest;  ///< of these surfaces, apart from those within 5 cm of windows and doors
};

/// A window or a door.
struct OpeningHeat {
    std::uint32_t label = 0;
    double transmittance = 0;  ///< W/(m2 K)
    std::string source;        ///< "model" or "default"
    double area = 0;           ///< m2 between two zones; 0: none found
    double watts = 0;          ///< sum of the amounts
};

/// The components of one conductivity from one source.
struct ThermalAssumption {
    std::string source;                 ///< "table", "model", "transmittance", "word" or "default"
    std::string detail;                 ///< the query, attribute, word or class that decided
    double conductivity = 0;            ///< W/(m K)
    std::vector<std::uint32_t> labels;  ///< components, ascending
};

/// The components of one heat capacity from one source.
struct CapacityAssumption {
    std::string source;                 ///< "table", "model", "word" or "default"
    std::string detail;                 ///< the query, attribute, word or class that decided
    double heatCapacity = 0;            ///< J/(m3 K): density times specific heat
    std::vector<std::uint32_t> labels;  ///< components, ascending
};

/// A room whose air touches outside air.
struct AirLeak {
    std::uint32_t label = 0;  ///< of the room
    Vec3d at{};               ///< world space, metres: the first place, by z, y, x of the grid
    double area = 0;          ///< m2, by voxel faces
};

struct HeatResult {
    /// Degrees Celsius at the voxels of solids (medium "solid"). NaN elsewhere, and in solids that no air touches.
    fields::Field temperature;
    ZoneHeat outside;
    std::vector<ZoneHeat> rooms;  ///< ascending by label
    std::vector<OpeningHeat> openings;
    std::vector<ThermalAssumption> assumed;
    std::vector<AirLeak> leaks;
    double balance = 0;  ///< amount of the sum of all heat, divided by half of the sum of the amounts
    double planeShare =
        0;  ///< share of the area between solids and air whose face is a plane of the model; else a voxel face
    double faceArea = 0;  ///< m2 of this area
    /// The same for faces parallel to an axis of the grid, by voxel faces: by a plane of their brick, by another plane of
    /// the model, by none. m2.
    double areaByBrick = 0, areaByModel = 0, areaByVoxel = 0;
    std::uint64_t cells = 0;         ///< unknowns
    std::uint64_t undetermined = 0;  ///< cells that no air touches
    int iterations = 0;
};

/// Computes the steady temperatures.
///
/// Air: rooms, and background. Background that reaches the border of the grid is outside air. Other background belongs to
/// the room that it touches most; without one, it is a cavity: mixed air with a resistance of 0.09 m2 K/W at each surface.
/// Furniture and installations count as the air around them. Terrain is a body of 2 W/(m K) whose cut sides are adiabatic.
///
/// \param findings  receives UnknownMaterial for components with a default conductivity, and AirLeak for each leak
/// \return the result; BadQuery, NothingSelected of a query; BadArgument without rooms or for a number out of range; BadField for a
///         name that no field can have;
///         AirLeak unless HeatOptions::isLeaky; NotConverged; GridTooLarge beyond 2^31 cells; Cancelled
/// Cost: O(runs + cells), and a ray for each row of voxels along each axis; about 1 us for each cell. Memory: about 100 bytes
/// for each cell, 16 for each run of voxels, 32 for each crossing of the rays of one axis, and at the end 4 for each voxel of
/// the grid.
[[nodiscard]] Result<HeatResult> simulateHeat(const volume::SemanticVolume& volume, const HeatOptions& options,
                                              Diagnostics& findings);

}  // namespace svt::simulate
