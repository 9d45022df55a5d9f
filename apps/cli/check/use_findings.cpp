#include <apps/cli/check/use_findings.hpp>

#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/validate/validate.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace svt::cli {
namespace {

void printPart(std::span<const FindingKind> kinds, const Diagnostics& diagnostics, bool hasAll, bool prevents) {
    if (kinds.empty()) return;
    std::size_t count = 0;
    for (const FindingKind& kind : kinds) count += kind.count;
    const std::string_view verb =
        prevents ? (count == 1 ? "prevents" : "prevent") : (count == 1 ? "does not prevent" : "do not prevent");
    printMessage(fmt::format("svt: {} finding{} {} use:\n", count, count == 1 ? "" : "s", verb));
    if (!hasAll) return printKinds(kinds);
    for (const Diagnostic& item : diagnostics.items())
        if (item.severity != Severity::Note && preventsUse(item) == prevents)
            printMessage(fmt::format("svt: {}\n", item.toString()));
}

}  // namespace

bool preventsUse(const Diagnostic& finding) noexcept {
    return finding.severity != Severity::Note && validate::preventsUse(finding.code);
}

bool preventsUse(const Diagnostics& diagnostics) noexcept {
    return std::any_of(diagnostics.items().begin(), diagnostics.items().end(),
                       [](const Diagnostic& finding) { return preventsUse(finding); });
}

void printByUse(const Diagnostics& diagnostics, bool hasAll) {
    if (isQuiet()) return;
    TerminalProgress::hide();
    const bool showsAll = hasAll || isVerbose();
    std::vector<FindingKind> kinds = kindsOf(diagnostics);
    const auto middle = std::stable_partition(kinds.begin(), kinds.end(),
                                              [](const FindingKind& kind) { return preventsUse(*kind.first); });
    const auto preventing = static_cast<std::size_t>(middle - kinds.begin());
    const std::span<const FindingKind> all(kinds.data(), kinds.size());
    printPart(all.first(preventing), diagnostics, showsAll, true);
    printPart(all.subspan(preventing), diagnostics, showsAll, false);
    for (const Diagnostic& item : diagnostics.items())
        if (item.severity == Severity::Note && (showsAll || isAlwaysShown(item)))
            printMessage(fmt::format("svt: {}\n", item.toString()));
    if (!showsAll) printTotals(diagnostics, kinds);
}

}  // namespace svt::cli
