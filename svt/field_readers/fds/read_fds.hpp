#pragma once
/// \file
/// The results of an FDS case as fields.

#include <svt/field_readers/common/reading.hpp>

#include <vector>

namespace svt::field_readers {

/// \return the fields of a `.smv` and the files that it names; errors as readFields()
[[nodiscard]] Result<std::vector<fields::Field>> readFds(Reading& reading);

}  // namespace svt::field_readers
