#include <apps/cli/output/messages.hpp>

#include <apps/cli/output/finding_kinds.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <utility>
#include <vector>

namespace svt::cli {
namespace {

bool isQuiet_ = false, isVerbose_ = false, isStdoutReserved = false;

// Paths of temporary files, and their names in messages.
std::vector<std::pair<std::string, std::string>>& shownNames() {
    static std::vector<std::pair<std::string, std::string>> names;
    return names;
}

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
        case Code::BadArgument:
        case Code::BadDefaults: return kUsage;
        case Code::Internal: return kInternal;
        case Code::NoGraphics:
        case Code::NoCairo: return kNoGraphics;
        default: return kInput;
    }
}

void beQuiet() noexcept { isQuiet_ = true; }
bool isQuiet() noexcept { return isQuiet_; }

void beVerbose() noexcept { isVerbose_ = true; }
bool isVerbose() noexcept { return isVerbose_; }

void reserveStdout() noexcept { isStdoutReserved = true; }
std::FILE* resultStream() noexcept { return isStdoutReserved ? stderr : stdout; }

void summarize(const std::string& text) {
    if (isQuiet()) return;
    if (isStdoutReserved) return printMessage(text + "\n");
    fmt::print("{}\n", shownText(text));
}

void showAs(const std::filesystem::path& file, std::string name) {
    shownNames().emplace_back(file.string(), std::move(name));
}

std::string shownText(std::string text) {
    for (const auto& [path, name] : shownNames())
        for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at + name.size()))
            text.replace(at, path.size(), name);
    return text;
}

void printMessage(std::string_view text) noexcept {
    try {
        const std::string shown = shownText(std::string(text));
        static_cast<void>(std::fwrite(shown.data(), 1, shown.size(), stderr));
    } catch (const std::bad_alloc&) {
        static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
    }
}

namespace {

// The next step if a command got the folder of a planned city, which is not built yet.
std::string cityHint(const Error& error) {
    std::error_code failed;
    const std::filesystem::path folder = error.where().file;
    if (error.code() != Code::CannotOpen) return {};
    if (std::filesystem::exists(folder / "city.json", failed))
        return fmt::format(
            ". It is a city, which this command does not read: 'svt city extract {} -o part.svt' makes a "
            "volume of a part",
            folder.string());
    if (!std::filesystem::exists(folder / "plan" / "plan.json", failed)) return {};
    return fmt::format(". It is a city that is planned, but not built: 'svt city run {}' builds it", folder.string());
}

}  // namespace

int fail(const Error& error) {
    TerminalProgress::hide();
    printMessage(fmt::format("svt: error {}{}\n", error.toString(), cityHint(error)));
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

bool isAlwaysShown(const Diagnostic& item) noexcept {
    return item.severity == Severity::Note &&
           (item.code == Code::ProductsRead || item.code == Code::AxisOrder || item.code == Code::FeatureEnded);
}

void printDiagnostics(const Diagnostics& diagnostics, bool hasAll) {
    const bool showsAll = hasAll || isVerbose_;
    TerminalProgress::hide();
    const std::vector<FindingKind> kinds = kindsOf(diagnostics);
    if (!isQuiet() && !showsAll) printKinds(kinds);
    for (const Diagnostic& item : diagnostics.items()) {
        const bool isShown = isQuiet() ? item.severity == Severity::Error : showsAll || isAlwaysShown(item);
        if (isShown) printMessage(fmt::format("svt: {}\n", item.toString()));
    }
    if (!isQuiet() && !showsAll) printTotals(diagnostics, kinds);
}

void printVolumeFindings(const Diagnostics& findings, const std::string& source, const std::filesystem::path& input) {
    if (input == "-") return printDiagnostics(findings, true);
    Diagnostics named;
    for (Diagnostic item : findings.items()) {
        if (item.where.file == source) item.where.file = input.string();
        named.add(item.severity, item.code, std::move(item.message), std::move(item.where));
    }
    printDiagnostics(named, true);
}

void printTotals(const Diagnostics& diagnostics, std::span<const FindingKind> kinds) {
    const std::size_t serious = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
    const auto shown = std::count_if(diagnostics.items().begin(), diagnostics.items().end(), isAlwaysShown);
    const std::size_t notes = diagnostics.count(Severity::Note) - static_cast<std::size_t>(shown);
    if (serious > kinds.size())
        printMessage(fmt::format("svt: {} warnings of {} kind{}; --verbose shows each\n", serious, kinds.size(),
                                 kinds.size() == 1 ? "" : "s"));
    if (notes != 0) printMessage(fmt::format("svt: {} notes; --verbose shows them\n", notes));
}

}  // namespace svt::cli
