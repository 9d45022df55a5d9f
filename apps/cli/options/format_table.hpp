#pragma once
/// \file
/// The formats that svt reads and writes, as `svt --formats` prints them.

#include <svt/writers/table.hpp>

namespace svt::cli {

/// A row for each format: name, endings, kind of input that it is read as (model, volume, or empty), commands that write
/// it, content, and programs that read it.
[[nodiscard]] writers::Table formatTable();

}  // namespace svt::cli
