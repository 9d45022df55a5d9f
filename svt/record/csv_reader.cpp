#include <svt/record/csv_reader.hpp>

#include <svt/core/text.hpp>

#include <algorithm>

namespace svt::record {

Result<void> checkTableText(std::string_view text, const std::string& file) {
    const std::size_t at = findInvalidUtf8(text);
    if (at == std::string_view::npos) return {};
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return Error(Code::BadValue, "the table is not in UTF-8; save it as CSV UTF-8",
                 {file, static_cast<std::uint64_t>(line), 0, {}});
}

CsvReader::CsvReader(std::string_view text) : text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    std::string_view rest = text_;
    while (rest.starts_with('#') || rest.starts_with('\n') || rest.starts_with('\r'))
        rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    bool isQuoted = false;
    for (const char c : rest.substr(0, rest.find('\n'))) {
        if (c == '"') isQuoted = !isQuoted;
        if (!isQuoted && (c == ';' || c == '\t')) {
            separator_ = c;
            return;
        }
    }
}

bool CsvReader::next(std::vector<std::string>& cells) {
    cells.clear();
    while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '#')) {
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        at_ = std::min(end + 1, text_.size());
        ++line_;
    }
    if (at_ >= text_.size()) return false;
    rowLine_ = line_;
    std::string cell;
    bool isQuoted = false, wasQuoted = false;
    const auto finish = [&] {
        cells.push_back(wasQuoted ? std::move(cell) : std::string(withoutBlanks(cell)));
        cell.clear();
        wasQuoted = false;
    };
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '\n') ++line_;
        if (isQuoted) {
            if (c != '"') {
                cell += c;
            } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
                cell += c;
                ++at_;
            } else {
                isQuoted = false;
            }
        } else if (c == '"' && withoutBlanks(cell).empty()) {
            cell.clear();
            isQuoted = wasQuoted = true;
        } else if (c == separator_) {
            finish();
        } else if (c == '\n') {
            ++at_;
            finish();
            return true;
        } else if (!(wasQuoted && isBlank(c))) {
            cell += c;
        }
    }
    isWhole_ = false;
    isQuoteOpen_ = isQuoted;
    finish();
    return true;
}

std::optional<double> CsvReader::number(std::string_view cell) const {
    if (const auto number = parseNumber(cell)) return number;
    if (separator_ == ',' || std::count(cell.begin(), cell.end(), ',') != 1) return std::nullopt;
    std::string text(cell);
    std::replace(text.begin(), text.end(), ',', '.');
    return parseNumber(text);
}

}  // namespace svt::record
