#pragma once
/// \file
/// Exit codes and messages of all commands.

#include <apps/cli/output/finding_kinds.hpp>

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
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
    kDifferent = 7,
    kLimit = 8,
    kCancelled = 9,
    kNoReader = 141  ///< that of SIGPIPE, even if the signal is ignored or does not exist
};

/// Exit code for an error code.
[[nodiscard]] int exitCodeOf(Code code) noexcept;

/// Implements --quiet: from now on, stderr gets only errors, and stdout gets no summary.
void beQuiet() noexcept;
[[nodiscard]] bool isQuiet() noexcept;

/// Implements --verbose of all commands: from now on, all findings are printed.
void beVerbose() noexcept;
[[nodiscard]] bool isVerbose() noexcept;

/// Reserves stdout for the bytes of an output: from now on, results and summaries go to stderr.
void reserveStdout() noexcept;
/// The stream of results: stdout, or stderr if stdout is reserved.
[[nodiscard]] std::FILE* resultStream() noexcept;

/// Prints a line about an output that was written to resultStream(), unless quiet.
void summarize(const std::string& text);

/// From now on, messages have `name` in place of the path of a temporary file.
void showAs(const std::filesystem::path& file, std::string name);
/// The text with the names given to showAs().
[[nodiscard]] std::string shownText(std::string text);

/// Prints "svt: error ..." to stderr and returns the exit code.
int fail(const Error& error);

/// Prints shownText() to stderr. Never throws: the command continues if stderr is closed or full.
void printMessage(std::string_view text) noexcept;

/// Prints "svt: ..." to stderr, unless quiet.
void note(std::string_view text);

/// Reports exhausted memory on stderr: its amount, the source of the limit, and remedies. Returns kLimit.
int failOfMemory();

/// Whether a note is always printed: the summary of read products, the order of the axes, features that have ended.
[[nodiscard]] bool isAlwaysShown(const Diagnostic& item) noexcept;

/// Prints findings to stderr: with --verbose or `hasAll` each, else the errors and warnings by kind, and the numbers of
/// all; with --quiet only errors.
void printDiagnostics(const Diagnostics& diagnostics, bool hasAll);

/// Prints each finding on a volume. They name the source of the volume, such as the model that a .svt was built from; here
/// they name the file that was read.
/// \param source  SemanticVolume::source
void printVolumeFindings(const Diagnostics& findings, const std::string& source, const std::filesystem::path& input);

/// Prints the number of warnings and errors if some kinds have several of them, and the number of notes.
void printTotals(const Diagnostics& diagnostics, std::span<const FindingKind> kinds);

}  // namespace svt::cli
