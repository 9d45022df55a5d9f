#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>

namespace svt::cli {
namespace {

std::atomic<bool>* interruptTarget = nullptr;

void onInterrupt(int) {
    if (interruptTarget != nullptr) interruptTarget->store(true);
}

}  // namespace

int exitCodeOf(Code code) noexcept {
    switch (code) {
        case Code::InputTooBig:
        case Code::GridTooLarge:
        case Code::TooManyLabels: return kLimit;
        case Code::CannotWrite:
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
        case Code::NoGraphics: return kNoGraphics;
        default: return kInput;
    }
}

int fail(const Error& error) {
    fmt::print(stderr, "svt: error {}\n", error.toString());
    return exitCodeOf(error.code());
}

void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose) {
    constexpr int kShown = 12;
    int shown = 0;
    for (const Diagnostic& item : diagnostics.items()) {
        if (!isVerbose && (item.severity == Severity::Note || shown == kShown)) continue;
        ++shown;
        fmt::print(stderr, "svt: {}\n", item.toString());
    }
    const std::size_t serious = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
    const std::size_t notes = diagnostics.count(Severity::Note);
    if (!isVerbose && serious > std::size_t(shown))
        fmt::print(stderr, "svt: {} more warnings; --verbose shows them\n", serious - std::size_t(shown));
    if (!isVerbose && notes != 0) fmt::print(stderr, "svt: {} notes; --verbose shows them\n", notes);
}

TerminalProgress::TerminalProgress() {
    interruptTarget = &progress_.cancel;
    std::signal(SIGINT, onInterrupt);
    if (!isErrorTerminal()) return;
    const auto start = std::chrono::steady_clock::now();
    progress_.report = [this, start](std::string_view stage, double fraction) {
        if (std::chrono::steady_clock::now() - start < std::chrono::seconds(1)) return;
        constexpr int kWidth = 30;
        const int full = static_cast<int>(fraction * kWidth);
        fmt::print(stderr, "\r{:<9} [{}{}] {:3.0f} %", stage, std::string(std::size_t(full), '#'),
                   std::string(std::size_t(kWidth - full), ' '), fraction * 100);
        std::fflush(stderr);
        hasDrawn_ = true;
    };
}

TerminalProgress::~TerminalProgress() {
    if (hasDrawn_) fmt::print(stderr, "\r{:60}\r", "");
    std::signal(SIGINT, SIG_DFL);
    interruptTarget = nullptr;
}

}  // namespace svt::cli
