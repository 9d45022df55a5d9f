#pragma once
/// \file
/// Changes of IFC files that know records and references: bytes that change by chance seldom make records that refer to each
/// other.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace svt::fuzz {

/// A piece of the text.
struct Span {
    std::size_t at = 0, size = 0;
    [[nodiscard]] std::size_t end() const { return at + size; }
};

/// Where the records, references and numbers of a file stand; strings are passed over.
struct Outline {
    std::vector<Span> records;     // "#7=IFCWALL(...);" with the end of its line
    std::vector<std::string> ids;  // "#7", of each record
    std::vector<Span> references, numbers;
    std::uint64_t highest = 0;  // id

    explicit Outline(const std::string& text) {
        const auto isDigit = [&](std::size_t i) {
            return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
        };
        for (std::size_t i = 0; i < text.size();) {
            const std::size_t begin = i++;
            if (text[begin] == '\'') {
                i = std::min(text.find('\'', i), text.size() - 1) + 1;
            } else if (text[begin] == '#' && isDigit(i)) {
                while (isDigit(i)) ++i;
                add(text, {begin, i - begin});
            } else if (isDigit(begin) && begin > 0 && (text[begin - 1] == '(' || text[begin - 1] == ',')) {
                while (isDigit(i) || (i < text.size() && text[i] == '.')) ++i;
                numbers.push_back({begin, i - begin});
            }
        }
    }

private:
    void add(const std::string& text, Span id) {
        if (id.end() >= text.size() || text[id.end()] != '=') return references.push_back(id);
        const std::size_t semicolon = text.find(";\n", id.end());
        if (semicolon == std::string::npos) return;
        records.push_back({id.at, semicolon + 2 - id.at});
        ids.push_back(text.substr(id.at, id.size));
        constexpr std::uint64_t kMostId = 1'000'000'000;
        highest = std::max<std::uint64_t>(highest, std::strtoull(ids.back().c_str() + 1, nullptr, 10) % kMostId);
    }
};

/// One change of a file, of a kind drawn by chance.
class IfcMutator {
public:
    IfcMutator(std::string text, unsigned seed) : text_(std::move(text)), outline_(text_), random_(seed) {}

    /// The text as it was where there is nothing to change.
    std::string run() {
        if (outline_.records.empty() || outline_.references.empty()) return text_;
        switch (below(6)) {
            case 0: replace(any(outline_.references), any(outline_.ids)); break;
            case 1: closeCircle(); break;
            case 2: duplicate(); break;
            case 3: nest(); break;
            case 4: repeat(); break;
            default: changeNumber(); break;
        }
        return text_;
    }

private:
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
    template <class T>
    const T& any(const std::vector<T>& all) {
        return all[below(all.size())];
    }
    void replace(Span span, const std::string& by) { text_.replace(span.at, span.size, by); }
    [[nodiscard]] bool isTo(Span reference, const std::string& id) const {
        return text_.compare(reference.at, reference.size, id) == 0;
    }

    [[nodiscard]] std::vector<Span> referencesIn(Span record) const {
        std::vector<Span> found;
        for (const Span reference : outline_.references)
            if (reference.at > record.at && reference.at < record.end()) found.push_back(reference);
        return found;
    }
    [[nodiscard]] std::string newId() const { return "#" + std::to_string(outline_.highest + 1); }

    // A reference of a record to itself, or to one that refers to it.
    void closeCircle() {
        const std::size_t record = below(outline_.records.size());
        const std::vector<Span> own = referencesIn(outline_.records[record]);
        if (own.empty()) return;
        std::vector<std::string> targets{outline_.ids[record]};
        for (std::size_t r = 0; r < outline_.records.size(); ++r)
            for (const Span reference : referencesIn(outline_.records[r]))
                if (isTo(reference, outline_.ids[record])) targets.push_back(outline_.ids[r]);
        replace(any(own), any(targets));
    }

    // A copy of a record, used in one place.
    void duplicate() {
        const std::size_t record = below(outline_.records.size());
        const Span span = outline_.records[record];
        const std::string copy = newId() + text_.substr(span.at, span.size).substr(outline_.ids[record].size());
        const Span user = any(outline_.references);
        if (user.at < span.end()) text_.insert(span.end(), copy);
        replace(user, newId());
        if (user.at > span.end()) text_.insert(span.end(), copy);
    }

    // A record within a copy of itself: what referred to it refers to the copy, and the copy to it.
    void nest() {
        const std::size_t record = below(outline_.records.size());
        const Span span = outline_.records[record];
        const std::string id = outline_.ids[record];
        const std::vector<Span> own = referencesIn(span);
        if (own.empty()) return;
        const Span inner = any(own);
        const std::string copy = newId() + text_.substr(span.at + id.size(), inner.at - span.at - id.size()) + id +
                                 text_.substr(inner.end(), span.end() - inner.end());
        bool isInserted = false;
        for (auto user = outline_.references.rbegin(); user != outline_.references.rend(); ++user) {
            if (user->at < span.end() && !isInserted) {
                text_.insert(span.end(), copy);
                isInserted = true;
            }
            if (isTo(*user, id)) replace(*user, newId());
        }
    }

    // An item of a list, many times.
    void repeat() {
        const Span item = any(outline_.references);
        const std::string id = text_.substr(item.at, item.size);
        std::string list = id;
        for (std::size_t i = below(40) + 1; i > 0; --i) list += "," + id;
        replace(item, list);
    }

    void changeNumber() {
        static const std::vector<std::string> kNumbers{"0",  "1",  "2",      "16",    "100",   "1000000", "4294967295",
                                                       "0.", "1.", "1.E-09", "1.E09", "1.E99", "90.",     "-1."};
        if (!outline_.numbers.empty()) replace(any(outline_.numbers), any(kNumbers));
    }

    std::string text_;
    Outline outline_;
    std::minstd_rand random_;
};

/// Several changes at once: a chain of records takes more than one.
inline std::string mutatedIfc(std::string text, std::minstd_rand& random) {
    for (auto left = random() % 6 + 1; left > 0; --left)
        text = IfcMutator(std::move(text), static_cast<unsigned>(random())).run();
    return text;
}

}  // namespace svt::fuzz
