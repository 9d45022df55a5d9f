#pragma once
/// \file
/// The findings of `svt check` that prevent the use of a model, and all others.

#include <svt/core/diagnostics.hpp>

namespace svt::cli {

/// Whether a finding prevents use: a warning or error whose code does (validate::preventsUse()).
[[nodiscard]] bool preventsUse(const Diagnostic& finding) noexcept;
/// Whether one of the findings does.
[[nodiscard]] bool preventsUse(const Diagnostics& diagnostics) noexcept;

/// Prints the findings to stderr in two parts, those that prevent use first: by kind, or each with --verbose or
/// `hasAll`. Prints nothing with --quiet.
void printByUse(const Diagnostics& diagnostics, bool hasAll);

}  // namespace svt::cli
