#include <apps/cli/output/finding_kinds.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace svt::cli {
namespace {

constexpr std::size_t kShownKinds = 12, kShownIds = 3;

bool isPartOfNumber(char c) noexcept { return isDigit(c) || c == '.'; }

// The message without its numbers and quoted names.
std::string wordingOf(std::string_view message) {
    std::string wording;
    for (std::size_t i = 0; i < message.size();) {
        const char c = message[i];
        const std::size_t quoted = c == '\'' ? message.find('\'', i + 1) : std::string_view::npos;
        if (quoted != std::string_view::npos) {
            wording += "''";
            i = quoted + 1;
        } else if (isDigit(c)) {
            if (!wording.empty() && wording.back() == '-') wording.pop_back();
            wording += '0';
            while (i < message.size() && isPartOfNumber(message[i])) ++i;
        } else {
            wording += c;
            ++i;
        }
    }
    return wording;
}

// Adds the findings that were counted and not kept.
void addCounted(const Diagnostics& diagnostics, std::vector<FindingKind>& kinds) {
    std::map<Code, std::size_t> kept;
    for (const Diagnostic& item : diagnostics.items()) ++kept[item.code];
    std::map<Code, FindingKind*> most;
    for (FindingKind& kind : kinds) {
        FindingKind*& best = most[kind.first->code];
        if (best == nullptr || kind.count > best->count) best = &kind;
    }
    for (const auto& [code, kind] : most) kind->count += diagnostics.count(code) - kept[code];
}

std::string idsOf(const FindingKind& kind) {
    std::string text;
    for (const std::string& id : kind.ids) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", id);
    if (kind.idCount > kind.ids.size()) text += fmt::format(" and {} others", kind.idCount - kind.ids.size());
    return text;
}

}  // namespace

std::vector<FindingKind> kindsOf(const Diagnostics& diagnostics) {
    std::vector<FindingKind> kinds;
    std::map<std::tuple<Severity, Code, std::string>, std::size_t> numberOf;
    std::vector<std::unordered_set<std::string_view>> ids;
    for (const Diagnostic& item : diagnostics.items()) {
        if (item.severity == Severity::Note) continue;
        const auto [at, isNew] =
            numberOf.try_emplace({item.severity, item.code, wordingOf(item.message)}, kinds.size());
        if (isNew) {
            kinds.push_back({&item, 0, {}, 0});
            ids.emplace_back();
        }
        FindingKind& kind = kinds[at->second];
        ++kind.count;
        if (item.where.id.empty() || !ids[at->second].insert(item.where.id).second) continue;
        ++kind.idCount;
        if (kind.ids.size() < kShownIds) kind.ids.push_back(item.where.id);
    }
    addCounted(diagnostics, kinds);
    return kinds;
}

void printKinds(std::span<const FindingKind> kinds) {
    std::size_t hidden = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        if (k >= kShownKinds) {
            hidden += kinds[k].count;
            continue;
        }
        printMessage(fmt::format("svt: {}\n", kinds[k].first->toString()));
        if (kinds[k].count == 1) continue;
        const std::string ids = idsOf(kinds[k]);
        printMessage(
            fmt::format("svt:   {} findings of this kind{}{}\n", kinds[k].count, ids.empty() ? "" : ": ", ids));
    }
    if (hidden != 0)
        printMessage(fmt::format("svt: {} more findings of {} other kinds; --verbose shows them\n", hidden,
                                 kinds.size() - kShownKinds));
}

}  // namespace svt::cli
