#include <svt/city/search/words.hpp>

#include <svt/analyze/stated_facts.hpp>
#include <svt/core/text.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace svt::city {
namespace {

// Letters and digits of all scripts. All characters beyond U+00BF count as letters, except punctuation.
bool isOfWord(char32_t code) noexcept {
    if (code < 0x80) return isLetter(static_cast<char>(code)) || isDigit(static_cast<char>(code));
    if (code < 0xC0) return code == 0xAA || code == 0xB5 || code == 0xBA;
    const bool isPunctuation = (code >= 0x2000 && code < 0x2070) || (code >= 0x3000 && code < 0x3004) ||
                               (code >= 0x3008 && code < 0x3020) || code == 0xD7 || code == 0xF7 || code == 0xFEFF;
    return !isPunctuation;
}

void addWordsOf(std::string_view text, std::vector<std::string>& to) {
    const std::string lower = lowerCase(text);
    std::string word;
    const auto end = [&] {
        if (!word.empty()) to.emplace_back(shortened(word, kMostWordBytes));
        word.clear();
    };
    for (std::string_view rest = lower; !rest.empty();) {
        const auto [code, size] = firstCharacter(rest);
        if (isOfWord(code))
            word += rest.substr(0, size);
        else
            end();
        rest.remove_prefix(size);
    }
    end();
}

// "name=value", in lower case and without repeated blanks. Only the part after the last '/' of "set/name" counts.
std::string pairWord(std::string_view name, std::string_view value) {
    std::string word = lowerCase(name.substr(name.rfind('/') + 1)) + "=";
    const std::size_t begin = word.size();
    for (const char c : lowerCase(value)) {
        if (!isBlank(c))
            word += c;
        else if (word.size() > begin && word.back() != ' ')
            word += ' ';
    }
    if (word.back() == ' ') word.pop_back();
    return std::string(shortened(word, kMostWordBytes));
}

// The value as text; nothing for numbers with decimals, which have no words.
std::optional<std::string> searchedValue(const AttributeValue& value) {
    if (const double* number = std::get_if<double>(&value))
        if (*number != std::floor(*number) || std::abs(*number) > 1e15) return std::nullopt;
    return toText(value);
}

void addWordsOf(const volume::Label& label, std::vector<std::string>& to) {
    addWordsOf(label.name, to);
    for (const Attribute& attribute : label.attributes) {
        const auto value = searchedValue(attribute.value);
        if (!value || value->empty()) continue;
        if (!std::holds_alternative<bool>(attribute.value)) addWordsOf(*value, to);
        to.push_back(pairWord(attribute.name, *value));
    }
}

}  // namespace

WordsOfBuilding wordsOfBuilding(const volume::LabelTable& labels, std::uint32_t building) {
    const volume::Label& own = labels.labels[building];
    WordsOfBuilding result{own.id,
                           own.name,
                           own.className,
                           analyze::postalAddress(own),
                           {pairWord("class", own.className), pairWord("name", own.name)}};
    addWordsOf(own, result.words);
    for (std::uint32_t part = building + 1; part < own.subtreeEnd; ++part) {
        const std::string& name = labels.labels[part].className;
        if (!name.ends_with("Part") && !name.ends_with("Unit")) continue;
        addWordsOf(labels.labels[part], result.words);
        if (result.address.empty()) result.address = analyze::postalAddress(labels.labels[part]);
    }
    std::sort(result.words.begin(), result.words.end());
    result.words.erase(std::unique(result.words.begin(), result.words.end()), result.words.end());
    return result;
}

std::vector<WantedWord> wantedWords(std::string_view query) {
    std::vector<WantedWord> wanted;
    for (std::size_t at = 0; at < query.size();) {
        if (isBlank(query[at])) {
            ++at;
            continue;
        }
        // Up to a blank outside quotes, without the quotes.
        std::string piece;
        bool isQuoted = false, hasQuotes = false;
        for (; at < query.size() && (isQuoted || !isBlank(query[at])); ++at) {
            if (query[at] != '"')
                piece += query[at];
            else {
                isQuoted = !isQuoted;
                hasQuotes = true;
            }
        }
        const std::size_t before = wanted.size(), sign = piece.find('=');
        if (sign != std::string::npos && sign > 0) {
            wanted.push_back({pairWord(piece.substr(0, sign), piece.substr(sign + 1))});
        } else {
            std::vector<std::string> words;
            addWordsOf(piece, words);
            for (std::string& word : words) wanted.push_back({std::move(word)});
        }
        if (at == query.size() && !hasQuotes && wanted.size() > before) wanted.back().isBeginning = true;
    }
    return wanted;
}

}  // namespace svt::city
