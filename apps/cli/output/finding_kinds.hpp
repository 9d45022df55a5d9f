#pragma once
/// \file
/// Findings grouped by their cause, for messages: a house with hundreds of warnings has a few kinds of them.

#include <svt/core/diagnostics.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace svt::cli {

/// Findings with the same severity, code and wording; numbers and quoted names in the wording may differ.
struct FindingKind {
    const Diagnostic* first = nullptr;  ///< in the diagnostics
    std::size_t count = 0;
    std::vector<std::string> ids;  ///< up to three different ids
    std::size_t idCount = 0;       ///< number of different ids
};

/// The kinds of all warnings and errors, in the order in which they begin. Findings that a code has beyond those kept
/// count as its most frequent kind.
[[nodiscard]] std::vector<FindingKind> kindsOf(const Diagnostics& diagnostics);

/// Prints the first finding of each kind to stderr, and the number and the ids of the others. Prints up to a dozen
/// kinds, then the number of the rest.
void printKinds(std::span<const FindingKind> kinds);

}  // namespace svt::cli
