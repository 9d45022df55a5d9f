#pragma once
/// \file
/// Scales of drawings as people write them.

#include <svt/core/result.hpp>

#include <string>

namespace svt::cli {

/// The number N of "1:N", or of "N" alone; 0.01 to 10000000.
/// \return the number, or BadArgument
[[nodiscard]] Result<double> parseScale(const std::string& text);

}  // namespace svt::cli
