#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <cstdio>

namespace svt::cli {
namespace {

bool isQuiet_ = false;

}  // namespace

int exitCodeOf(Code code) noexcept {
    switch (code) {
        case Code::InputTooBig:
        case Code::GridTooLarge:
        case Code::TooManyLabels: return kLimit;
        case Code::CannotWrite:
        case Code::WouldDestroy:
        case Code::DiskFull: return kOutput;
        case Code::Cancelled: return kCancelled;
        case Code::BadDimension:
        case Code::BadCamera:
        case Code::BadFrame:
        case Code::BadSection:
        case Code::BadQuery:
        case Code::NothingSelected:
        case Code::BadArgument: return kUsage;
        case Code::Internal: return kInternal;
        case Code::NoGraphics:
        case Code::NoCairo: return kNoGraphics;
        default: return kInput;
    }
}

void beQuiet() noexcept { isQuiet_ = true; }
bool isQuiet() noexcept { return isQuiet_; }

void printMessage(std::string_view text) noexcept {
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

int fail(const Error& error) {
    TerminalProgress::hide();
    printMessage(fmt::format("svt: error {}\n", error.toString()));
    return exitCodeOf(error.code());
}

void note(std::string_view text) {
    if (isQuiet()) return;
    TerminalProgress::hide();
    printMessage(fmt::format("svt: {}\n", text));
}

int failOfMemory() {
    TerminalProgress::hide();
    const auto grant = memoryGrant();
    printMessage(fmt::format(
        "svt: error: out of memory: the work needs more than {}; choose a coarser --spacing, give a smaller model, "
        "or grant more\n",
        grant ? grant->text : "there is"));
    return kLimit;
}

void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose) {
    constexpr int kShown = 12;
    int shown = 0;
    TerminalProgress::hide();
    for (const Diagnostic& item : diagnostics.items()) {
        if (isQuiet() && item.severity != Severity::Error) continue;
        // The summary of read products is always printed.
        const bool isSummary = item.code == Code::ProductsRead;
        if (!isVerbose && !isSummary && (item.severity == Severity::Note || shown == kShown)) continue;
        if (!isSummary) ++shown;
        printMessage(fmt::format("svt: {}\n", item.toString()));
    }
    if (isQuiet()) return;
    const std::size_t serious = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
    const std::size_t notes = diagnostics.count(Severity::Note) - diagnostics.count(Code::ProductsRead);
    if (!isVerbose && serious > std::size_t(shown))
        printMessage(fmt::format("svt: {} more warnings; --verbose shows them\n", serious - std::size_t(shown)));
    if (!isVerbose && notes != 0) printMessage(fmt::format("svt: {} notes; --verbose shows them\n", notes));
}

}  // namespace svt::cli
