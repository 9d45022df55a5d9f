#pragma once
/// \file
/// JSON printed by commands. Stable; described in docs/user/json.md.

#include <svt/core/diagnostics.hpp>
#include <svt/frontend/volume_json.hpp>

namespace svt::cli {

using record::Json, frontend::toJson, frontend::gridJson, frontend::labelJson, frontend::overlapsJson,
    frontend::infoJson;

[[nodiscard]] Json diagnosticsJson(const Diagnostics& diagnostics);

/// Prints with two spaces of indentation; invalid UTF-8 is replaced.
void print(const Json& json);

}  // namespace svt::cli
