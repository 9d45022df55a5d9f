#pragma once
/// \file
/// The formats that svt reads and writes, as `svt --formats` prints them.

#include <svt/writers/table.hpp>

namespace svt::cli {

/// One row per format: name, endings, kind of input (model, volume, or empty), commands that write it, content, and
/// programs that read it.
[[nodiscard]] writers::Table formatTable();

}  // namespace svt::cli
