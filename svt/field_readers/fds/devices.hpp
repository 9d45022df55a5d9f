#pragma once
/// \file
/// The devices of an FDS case as fields of points.

#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/common/reading.hpp>
#include <svt/field_readers/fds/smv_file.hpp>

#include <vector>

namespace svt::field_readers {

/// Reads the table of devices that the case names, and appends a field `devices_QUANTITY` for each quantity that is asked
/// for. The places come from the `.smv`; devices without one are left out, with a note.
/// \return nothing, or CannotOpen, BadField, BadArgument, InputTooBig as readFields()
[[nodiscard]] Result<void> readDevices(const SmvCase& fds, const Frame& frame, const Assumptions& place,
                                       Reading& reading, std::vector<fields::Field>& to);

}  // namespace svt::field_readers
