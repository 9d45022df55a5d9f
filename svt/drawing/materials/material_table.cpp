#include <svt/drawing/material_table.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace svt::drawing {
namespace {

// Lower case of the Latin, Greek and Cyrillic letters whose two cases lie at a constant distance.
char32_t lowerCase(char32_t c) noexcept {
    if (c >= 'A' && c <= 'Z') return c + 32;
    if ((c >= 0xC0 && c <= 0xDE && c != 0xD7) || (c >= 0x391 && c <= 0x3A9) || (c >= 0x410 && c <= 0x42F))
        return c + 32;
    if (c >= 0x400 && c <= 0x40F) return c + 80;
    const bool isPaired = (c >= 0x100 && c <= 0x137) || (c >= 0x14A && c <= 0x177);
    return isPaired && c % 2 == 0 ? c + 1 : c;
}

// Characters that are not written with blanks between words: kana, Chinese characters.
bool isIdeograph(char32_t c) noexcept { return (c >= 0x3041 && c <= 0x30FF) || (c >= 0x3400 && c <= 0x9FFF); }

bool isOfWord(char32_t c) noexcept {
    if (c < 0x80) return isLetter(static_cast<char>(c)) || isDigit(static_cast<char>(c));
    const bool isMark = (c >= 0x80 && c < 0xAA) || c == 0xB7 || c == 0xD7 || (c >= 0x2000 && c <= 0x206F) ||
                        (c >= 0x3000 && c <= 0x3020) || (c >= 0xFF00 && c <= 0xFF0F);
    return !isMark;
}

// The words of a text in lower case, and the text itself in lower case. Invalid UTF-8 separates words.
struct Words {
    std::vector<std::string> list;
    std::string folded;
};

Words wordsOf(std::string_view text) {
    Words words;
    bool isOpen = false;
    while (!text.empty()) {
        const auto [code, size] = firstCharacter(text);
        text.remove_prefix(std::max<std::size_t>(size, 1));
        const char32_t lower = lowerCase(code);
        if (size == 0 || !isOfWord(lower)) {
            isOpen = false;
            continue;
        }
        if (!std::exchange(isOpen, true)) words.list.emplace_back();
        appendUtf8(lower, words.list.back());
        appendUtf8(lower, words.folded);
    }
    return words;
}

bool isPlural(std::string_view word, std::string_view singular) noexcept {
    return word.size() == singular.size() + 1 && word.back() == 's' && word.starts_with(singular);
}

}  // namespace

void MaterialTable::add(const Row& row, std::string_view entries) {
    for (const std::string_view text : splitChoices(entries)) {
        Entry entry;
        std::string_view rest = withoutBlanks(text);
        entry.text = rest;
        entry.hasMoreBefore = rest.starts_with('*');
        entry.hasMoreAfter = rest.size() > 1 && rest.ends_with('*');
        Words words = wordsOf(rest);
        entry.isAnywhere = !words.folded.empty() && isIdeograph(firstCharacter(words.folded).code);
        entry.words = entry.isAnywhere ? std::vector{words.folded} : std::move(words.list);
        entry.row = rows_.size();
        if (!entry.words.empty()) entries_.push_back(std::move(entry));
    }
    rows_.push_back(row);
}

void MaterialTable::append(const MaterialTable& other) {
    for (Entry entry : other.entries_) {
        entry.row += rows_.size();
        entries_.push_back(std::move(entry));
    }
    rows_.insert(rows_.end(), other.rows_.begin(), other.rows_.end());
}

bool MaterialTable::matches(const Entry& entry, const std::vector<std::string>& words, const std::string& folded) {
    if (entry.isAnywhere) return folded.find(entry.words[0]) != std::string::npos;
    const std::size_t count = entry.words.size();
    const auto isWord = [&](std::size_t n, const std::string& word) {
        const std::string& wanted = entry.words[n];
        const bool before = entry.hasMoreBefore && n == 0, after = entry.hasMoreAfter && n + 1 == count;
        if (before && after) return word.find(wanted) != std::string::npos;
        if (before) return word.ends_with(wanted);
        if (after) return word.starts_with(wanted);
        return word == wanted || isPlural(word, wanted);
    };
    for (std::size_t at = 0; at + count <= words.size(); ++at) {
        std::size_t n = 0;
        while (n < count && isWord(n, words[at + n])) ++n;
        if (n == count) return true;
    }
    return false;
}

std::optional<MaterialTable::Match> MaterialTable::find(std::string_view name) const {
    const Words words = wordsOf(name);
    const Entry* best = nullptr;
    for (const Entry& entry : entries_) {
        if (best != nullptr && entry.words.size() <= best->words.size()) continue;
        if (matches(entry, words.list, words.folded)) best = &entry;
    }
    if (best == nullptr) return std::nullopt;
    return Match{rows_[best->row], best->text};
}

Result<MaterialTable> MaterialTable::parseCsv(std::string_view text, std::string_view file) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    MaterialTable table;
    std::uint64_t number = 0;
    const auto bad = [&](const std::string& reason) {
        return Error(Code::BadValue, "materials: " + reason, {std::string(file), number, 0, {}});
    };
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        ++number;
        std::string_view rest = withoutBlanks(line);
        if (rest.empty() || rest.starts_with('#')) continue;
        std::string_view fields[3];
        for (std::size_t f = 0; f < 3; ++f) {
            const std::size_t end = f < 2 ? std::min(rest.find(','), rest.size()) : rest.size();
            fields[f] = withoutBlanks(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
            if (fields[f].size() > 1 && fields[f].starts_with('"') && fields[f].ends_with('"'))
                fields[f] = fields[f].substr(1, fields[f].size() - 2);
        }
        if (equalsIgnoringCase(fields[0], "hatch") && equalsIgnoringCase(fields[2], "words")) continue;
        const auto hatch = fromName<render::Hatch>(fields[0]);
        if (!hatch)
            return bad(
                fmt::format("unknown hatch '{}'; possible are masonry, concrete, reinforced-concrete, timber, "
                            "insulation, earth, steel, glass, general, none",
                            fields[0]));
        if (fields[1] != "yes" && fields[1] != "no")
            return bad(fmt::format("'{}' in the column loadBearing; write yes or no", fields[1]));
        if (wordsOf(fields[2]).list.empty())
            return bad("no words; write hatch,loadBearing,words with words such as a|b");
        table.add({*hatch, fields[1] == "yes"}, fields[2]);
    }
    return table;
}

}  // namespace svt::drawing
