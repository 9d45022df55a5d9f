#pragma once
/// \file
/// Lattices of ParaView and of imaging programs.

#include <svt/field_readers/common/reading.hpp>

#include <vector>

namespace svt::field_readers {

/// Image data (`.vti`) or a rectilinear grid (`.vtr`) of VTK: a field for each array of floats, or the arrays that are asked
/// for. Formats: ascii, base64, appended raw and appended base64, with zlib or without; little-endian. In one piece.
[[nodiscard]] Result<std::vector<fields::Field>> readVtkFields(Reading& reading);

/// A list of such files over time (`.pvd`). All files have one lattice.
[[nodiscard]] Result<std::vector<fields::Field>> readVtkSeries(Reading& reading);

/// An NRRD image of three axes in one file, raw or gzip, of floats or whole numbers.
[[nodiscard]] Result<std::vector<fields::Field>> readNrrdField(Reading& reading);

}  // namespace svt::field_readers
