#pragma once
/// \file
/// Exit codes and messages of all commands.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>

#include <string_view>

namespace svt::cli {

/// Exit codes, as documented in docs/user/exit-codes.md.
enum Exit {
    kDone = 0,
    kInternal = 1,
    kUsage = 2,
    kInput = 3,
    kInvalid = 4,
    kOutput = 5,
    kNoGraphics = 6,
    kLimit = 8,
    kCancelled = 9,
    kNoReader = 141  ///< that of SIGPIPE, even if the signal is ignored or does not exist
};

/// Exit code for an error code.
[[nodiscard]] int exitCodeOf(Code code) noexcept;

/// Implements --quiet: from now on, stderr gets only errors, and stdout gets no summary.
void beQuiet() noexcept;
[[nodiscard]] bool isQuiet() noexcept;

/// Prints "svt: error ..." to stderr and returns the exit code.
int fail(const Error& error);

/// Prints a text to stderr, unchanged. Never throws: the command continues if stderr is closed or full.
void printMessage(std::string_view text) noexcept;

/// Prints "svt: ..." to stderr, unless quiet.
void note(std::string_view text);

/// Reports exhausted memory on stderr: its amount, the source of the limit, and remedies. Returns kLimit.
int failOfMemory();

/// Prints findings to stderr: with --verbose all, else up to a dozen errors and warnings and the number of the rest;
/// with --quiet only errors.
void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose);

}  // namespace svt::cli
