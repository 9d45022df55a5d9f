#pragma once
/// \file
/// The bytes of a `.s3d` as values.

#include <svt/core/result.hpp>
#include <svt/field_readers/common/reading.hpp>
#include <svt/field_readers/fds/smv_file.hpp>

#include <array>

namespace svt::field_readers {

/// Entry v is the value of byte v. After SMOKE3D_TO_FILE of FDS (firemodels/fds, Source/smvv.f90):
///
///     SOOT DENSITY  v = round(254 (1 - exp(-s dx rho))).
///     HRRPUV        v = floor(254 q / q_max); q_max of HRRPUV_MINMAX, or else 1200 kW/m3.
///     TEMPERATURE   v = floor(254 (T - T_min) / (T_max - T_min)) of TEMP_MINMAX, or else 20 to 2000 degrees Celsius.
///
/// s is the extinction of the keyword, dx the side of the first cell.
/// Byte 254 of soot has no upper bound; its entry is the least density that becomes 254. Entry 255, which FDS does not
/// write, is NaN.
/// \param assumptions  receives the numbers of the code
/// \return the values, or BadField for a quantity that is not among these, or without an extinction
[[nodiscard]] Result<std::array<float, 256>> smokeValues(const SmvFile& file, const SmvMesh& mesh, const SmvCase& fds,
                                                         const Reading& reading, Assumptions& assumptions);

}  // namespace svt::field_readers
