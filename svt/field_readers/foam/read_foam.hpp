#pragma once
/// \file
/// Results of OpenFOAM.

#include <svt/field_readers/common/reading.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace svt::field_readers {

/// The folder of an OpenFOAM case: `path` itself, or the folder of a `.foam` file. It has `system/controlDict`.
[[nodiscard]] std::optional<std::filesystem::path> foamFolder(const std::filesystem::path& path);

/// A field for each volScalarField and volVectorField in the folders of times, with a node per cell. Results of
/// decomposed cases (`processor0` and so on) are joined where the case itself lacks the time. The time 0 has initial
/// values, so it counts only where no other has results. The place is that of the note of `svt convert` in the mesh,
/// or that of FieldReadOptions::at.
/// Errors as readFields(), and those of readCellLattice().
[[nodiscard]] Result<std::vector<fields::Field>> readFoam(Reading& reading);

}  // namespace svt::field_readers
