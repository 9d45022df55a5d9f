#pragma once
/// \file
/// Exit codes, messages and progress of all commands.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>

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
    kCancelled = 9
};

/// Exit code for an error code.
[[nodiscard]] int exitCodeOf(Code code) noexcept;

/// Prints "svt: error ..." to stderr and returns the exit code.
int fail(const Error& error);

/// Prints findings to stderr: all with --verbose, else up to a dozen errors and warnings and the number of the rest.
void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose);

/// A progress bar on stderr if that is a terminal, shown after the first second; Ctrl-C cancels.
class TerminalProgress {
public:
    TerminalProgress();
    ~TerminalProgress();
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;
    [[nodiscard]] const Progress* get() const noexcept { return &progress_; }

private:
    Progress progress_;
    bool hasDrawn_ = false;
};

}  // namespace svt::cli
