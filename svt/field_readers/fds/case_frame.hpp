#pragma once
/// \file
/// The place of an FDS case in world space.

#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/common/reading.hpp>
#include <svt/field_readers/fds/smv_file.hpp>

namespace svt::field_readers {

/// The frame of a case: FieldReadOptions::at and the comment of its input file, which is looked for beside the `.smv`; else
/// world coordinates, with a note.
[[nodiscard]] Frame frameOfCase(const SmvCase& fds, const Reading& reading, Assumptions& assumptions);

}  // namespace svt::field_readers
