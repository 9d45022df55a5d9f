#pragma once
/// \file
/// Fields from the files of other programs, placed in the index space of a volume.
///
///     | files                          | fields
///     | .smv with .sf, .s3d, _devc.csv | results of FDS
///     | .csv with a table of places    | values of sensors
///     | .json of OGC SensorThings      | values of sensors
///     | .vti, .vtr, .pvd, .nrrd        | lattices of ParaView and others
///     | folder, or the .foam in it     | results of OpenFOAM

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace svt::field_readers {

struct FieldReadOptions {
    std::string quantity;  ///< of files with several: the one to read; empty: all
    std::string unit;      ///< in place of the file's unit; needed if the file states no unit
    std::string medium;    ///< as FieldHead::medium; empty: the default of the format
    double firstTime = -std::numeric_limits<double>::infinity();  ///< seconds
    double lastTime = std::numeric_limits<double>::infinity();    ///< seconds
    double timeStep = 0;  ///< seconds between times that are kept, at least; 0: all
    /// As FieldHead::precision; unset: 0 for sensors, else fields::precisionFor() of the values.
    std::optional<double> precision;
    std::optional<Vec3d> at;       ///< world space: where the origin of the file lies; unset: as the file says
    std::filesystem::path places;  ///< table of sensors: name,x,y,z or name,room
    std::uint64_t maxBytes = std::uint64_t{4} << 30;  ///< of values in memory
};

/// Reads the fields of a file. Its ending or content gives the format. All that was assumed stands in FieldHead::parameters.
/// \param diagnostics  receives what was assumed or left out; FieldInPart for each file that ends within a frame
/// \return at least one field with a name of its own, or
///         - CannotOpen.
///         - BadField      with the file and the byte or line.
///         - BadArgument   for options that do not fit the file.
///         - InputTooBig   with the options that help.
///         - FieldOutside  with both boxes where no field covers a part of the volume.
/// Cost: O(values). Memory: the values of the chosen times, and one frame.
[[nodiscard]] Result<std::vector<fields::Field>> readFields(const std::filesystem::path& path,
                                                            const volume::SemanticVolume& volume,
                                                            const FieldReadOptions& options, Diagnostics& diagnostics);

}  // namespace svt::field_readers
