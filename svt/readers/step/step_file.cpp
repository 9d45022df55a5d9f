#include <svt/readers/step/step_file.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/step/step_value.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <limits>
#include <map>

namespace svt::readers::step {
namespace {

using std::string_view;

constexpr std::uint64_t kLineStep = 8;

bool isTypeLetter(char c) noexcept { return isLetter(c) || isDigit(c) || c == '_'; }

}  // namespace

// Passes over the text once. Positions are offsets; `end_` is one past the last byte.
class StepFile::Scanner {
public:
    Scanner(StepFile& file, string_view name, Diagnostics& diagnostics)
        : file_(file), text_(file.text_), name_(name), diagnostics_(diagnostics) {}

    Result<void> run() {
        std::size_t at = readHeader();
        while (at < text_.size()) {
            at = skipBlanks(at);
            if (at >= text_.size()) break;
            if (text_[at] == '#')
                at = readRecord(at);
            else
                at = skipStatement(at);
            if (file_.records_.size() >= std::size_t{1} << 31)
                return Error(Code::InputTooBig, "the file has more than 2^31 records; split it",
                             {std::string(name_), 0, 0, {}});
        }
        return {};
    }

private:
    // Behind comments and blanks.
    [[nodiscard]] std::size_t skipBlanks(std::size_t at) const noexcept {
        for (; at < text_.size(); ++at) {
            if (isBlank(text_[at])) continue;
            if (text_[at] != '/' || at + 1 >= text_.size() || text_[at + 1] != '*') break;
            const std::size_t end = text_.find("*/", at + 2);
            at = end == string_view::npos ? text_.size() : end + 1;
        }
        return std::min(at, text_.size());
    }

    // Position after the next ';' outside of strings and comments; for statements other than records: END-ISO-10303-21,
    // DATA, ENDSEC.
    [[nodiscard]] std::size_t skipStatement(std::size_t at) const noexcept {
        const std::size_t start = at;
        for (; at < text_.size(); ++at) {
            if (text_[at] == ';') return at + 1;
            if (text_[at] == '\'') {
                at = endOfString(at);
                if (at == string_view::npos) break;
            }
            if (text_[at] == '#' && at > start && text_[at - 1] == '\n') return at;  // a ';' is missing
        }
        return nextRecordLine(start);
    }

    // Offset of the quote that closes the string that opens at `at`; npos where none does before a line that begins
    // like a record. Strings do not go over the end of a line (ISO 10303-21, 6.4.3), but some writers break them.
    [[nodiscard]] std::size_t endOfString(std::size_t at) const noexcept {
        for (++at; at < text_.size(); ++at) {
            const char c = text_[at];
            if (c == '\'') {
                if (at + 1 >= text_.size() || text_[at + 1] != '\'') return at;
                ++at;
            } else if (c == '\n' && beginsRecord(at + 1)) {
                return string_view::npos;
            }
        }
        return string_view::npos;
    }

    [[nodiscard]] bool beginsRecord(std::size_t at) const noexcept {
        while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t')) ++at;
        if (at >= text_.size() || text_[at] != '#') return false;
        const std::size_t first = ++at;
        while (at < text_.size() && isDigit(text_[at])) ++at;
        if (at == first) return false;
        while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t')) ++at;
        return at < text_.size() && text_[at] == '=';
    }

    [[nodiscard]] std::size_t nextRecordLine(std::size_t at) const noexcept {
        for (at = text_.find('\n', at); at != string_view::npos; at = text_.find('\n', at + 1))
            if (beginsRecord(at + 1)) return at + 1;
        return text_.size();
    }

    // Reads FILE_SCHEMA; returns where the data begin.
    std::size_t readHeader() {
        std::size_t at = 0;
        while (at < text_.size()) {
            at = skipBlanks(at);
            if (at >= text_.size() || text_[at] == '#') break;
            const string_view rest = text_.substr(at);
            if (rest.starts_with("FILE_SCHEMA")) {
                const std::size_t quote = rest.find('\'');
                if (quote != string_view::npos && quote < 200) {
                    const std::size_t end = rest.find('\'', quote + 1);
                    if (end != string_view::npos && end - quote < 200)
                        file_.schema_ = rest.substr(quote + 1, end - quote - 1);
                }
            }
            if (rest.starts_with("DATA")) return skipStatement(at);
            at = skipStatement(at);
        }
        return at;
    }

    std::size_t lose(std::size_t start, std::uint64_t id, string_view why) {
        diagnostics_.add(Severity::Warning, Code::BadRecord, fmt::format("the record #{} {}; it is left out", id, why),
                         {std::string(name_), lineAt(start), 0, {}});
        return nextRecordLine(start);
    }

    [[nodiscard]] std::uint64_t lineAt(std::size_t at) {
        // Findings come in the order of the file, so each byte is counted once.
        line_ += static_cast<std::uint64_t>(
            std::count(text_.begin() + std::ptrdiff_t(lineCounted_), text_.begin() + std::ptrdiff_t(at), '\n'));
        lineCounted_ = at;
        return line_;
    }

    std::size_t readRecord(std::size_t start) {
        std::size_t at = start + 1;
        std::uint64_t id = 0;
        for (; at < text_.size() && isDigit(text_[at]); ++at)
            id = std::min<std::uint64_t>(id * 10 + std::uint64_t(text_[at] - '0'), std::uint64_t{1} << 40);
        if (at == start + 1 || id > std::numeric_limits<std::uint32_t>::max() - 1)
            return lose(start, id, "has a number that cannot be read");
        at = skipBlanks(at);
        if (at >= text_.size() || text_[at] != '=') return lose(start, id, "has no '=' behind its number");
        at = skipBlanks(at + 1);
        const std::size_t typeBegin = at;
        while (at < text_.size() && isTypeLetter(text_[at])) ++at;
        const string_view type = text_.substr(typeBegin, at - typeBegin);
        at = skipBlanks(at);
        if (at >= text_.size() || text_[at] != '(') return lose(start, id, "has no bracket behind its type");
        const std::size_t values = at + 1;
        const std::size_t close = findClosingBracket(values);
        if (close == string_view::npos) return lose(start, id, "does not end: a quote or a bracket is missing");
        if (close - values > std::numeric_limits<std::uint32_t>::max()) return lose(start, id, "is longer than 4 GiB");
        // Complex instances, #1=(A() B()), do not occur in IFC, except for units of other schemas.
        if (!type.empty())
            file_.records_.push_back(
                {values, static_cast<std::uint32_t>(close - values), static_cast<std::uint32_t>(id), typeNumber(type)});
        at = skipBlanks(close + 1);
        return at < text_.size() && text_[at] == ';' ? at + 1 : at;
    }

    // The bracket that closes the one before `at`.
    [[nodiscard]] std::size_t findClosingBracket(std::size_t at) const noexcept {
        static constexpr auto kIsSpecial = [] {
            std::array<bool, 256> special{};
            for (const char c : {'(', ')', '\'', '/', ';'}) special[static_cast<unsigned char>(c)] = true;
            return special;
        }();
        for (std::size_t depth = 1; at < text_.size(); ++at) {
            if (!kIsSpecial[static_cast<unsigned char>(text_[at])]) continue;
            switch (text_[at]) {
                case '(': ++depth; break;
                case ')':
                    if (--depth == 0) return at;
                    break;
                case ';': return string_view::npos;
                case '\'':
                    at = endOfString(at);
                    if (at == string_view::npos) return at;
                    break;
                default:
                    if (at + 1 < text_.size() && text_[at + 1] == '*') {
                        const std::size_t end = text_.find("*/", at + 2);
                        if (end == string_view::npos) return end;
                        at = end + 1;
                    }
            }
        }
        return string_view::npos;
    }

    std::uint32_t typeNumber(string_view type) {
        // Records of one type often follow each other.
        if (lastType_ < file_.typeNames_.size() && file_.typeNames_[lastType_] == type) return lastType_;
        const auto [it, isNew] = typeNumbers_.emplace(type, static_cast<std::uint32_t>(file_.typeNames_.size()));
        if (isNew) file_.typeNames_.push_back(type);
        return lastType_ = it->second;
    }

    StepFile& file_;
    string_view text_, name_;
    Diagnostics& diagnostics_;
    std::map<string_view, std::uint32_t> typeNumbers_;
    std::uint32_t lastType_ = 0;
    std::uint64_t line_ = 1;
    std::size_t lineCounted_ = 0;
};

Result<StepFile> StepFile::scan(string_view text, string_view name, Diagnostics& diagnostics) {
    StepFile file;
    file.text_ = text;
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == string_view::npos || !text.substr(begin).starts_with("ISO-10303-21"))
        return Error(Code::BadStep, "the file does not begin with 'ISO-10303-21;', so it is not a STEP file",
                     {std::string(name), 1, 0, {}});
    SVT_DO(Scanner(file, name, diagnostics).run());
    if (file.records_.empty())
        return Error(Code::BadStep, "the file has no record such as '#1=IFCPROJECT(...);'; it seems to be cut off",
                     {std::string(name), 1, 0, {}});
    const Record& last = file.records_.back();
    file.isTruncated_ = text.find("END-ISO-10303-21", last.values + last.size) == string_view::npos;
    file.makeIndex(name, diagnostics);
    return file;
}

void StepFile::makeIndex(string_view name, Diagnostics& diagnostics) {
    std::uint32_t highest = 0;
    for (const Record& record : records_) highest = std::max(highest, record.id);
    const auto tell = [&](RecordIndex second) {
        diagnostics.add(Severity::Warning, Code::DuplicateId,
                        fmt::format("the record #{} occurs twice; the first counts", records_[second].id),
                        {std::string(name), lineOf(records_[second]), 0, {}});
    };
    if (highest / 8 <= records_.size()) {
        byId_.assign(std::size_t(highest) + 1, kNoRecord);
        for (RecordIndex i = 0; i < records_.size(); ++i) {
            RecordIndex& entry = byId_[records_[i].id];
            if (entry == kNoRecord)
                entry = i;
            else
                tell(i);
        }
        return;
    }
    sortedIds_.reserve(records_.size());
    for (RecordIndex i = 0; i < records_.size(); ++i) sortedIds_.emplace_back(records_[i].id, i);
    std::sort(sortedIds_.begin(), sortedIds_.end());
    for (std::size_t i = 1; i < sortedIds_.size(); ++i)
        if (sortedIds_[i].first == sortedIds_[i - 1].first) tell(sortedIds_[i].second);
}

RecordIndex StepFile::find(std::uint32_t id) const noexcept {
    if (!byId_.empty()) return id < byId_.size() ? byId_[id] : kNoRecord;
    const auto found = std::lower_bound(sortedIds_.begin(), sortedIds_.end(), std::pair(id, RecordIndex{0}));
    return found != sortedIds_.end() && found->first == id ? found->second : kNoRecord;
}

RecordIndex StepFile::recordHolding(string_view part) const noexcept {
    if (std::less<>{}(part.data(), text_.data()) || std::less<>{}(text_.data() + text_.size(), part.data()))
        return kNoRecord;
    const auto at = static_cast<std::uint64_t>(part.data() - text_.data());
    const auto next =
        std::upper_bound(records_.begin(), records_.end(), at,
                         [](std::uint64_t offset, const Record& record) { return offset < record.values; });
    if (next == records_.begin() || at > std::prev(next)->values + std::prev(next)->size) return kNoRecord;
    return static_cast<RecordIndex>(next - records_.begin() - 1);
}

std::uint64_t StepFile::lineOf(const Record& record) const {
    if (lineStarts_.empty()) {
        lineStarts_.push_back(0);
        std::uint64_t count = 0;
        for (std::size_t at = text_.find('\n'); at != string_view::npos; at = text_.find('\n', at + 1))
            if (++count % kLineStep == 0) lineStarts_.push_back(at + 1);
    }
    const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), record.values);
    const auto block = static_cast<std::uint64_t>(next - lineStarts_.begin()) - 1;
    const auto begin = text_.begin() + std::ptrdiff_t(lineStarts_[block]);
    return block * kLineStep + 1 +
           static_cast<std::uint64_t>(std::count(begin, text_.begin() + std::ptrdiff_t(record.values), '\n'));
}

}  // namespace svt::readers::step
