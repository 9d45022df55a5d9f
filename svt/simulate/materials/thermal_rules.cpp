#include <svt/simulate/heat.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace svt::simulate {
namespace {

constexpr std::array<std::string_view, 4> kColumns{"query", "conductivity", "density", "specificHeat"};

// The fields of a line of CSV; quotes around a field are removed, doubled ones within it are single.
std::vector<std::string> fieldsOf(std::string_view line) {
    std::vector<std::string> fields(1);
    bool isQuoted = false;
    for (std::size_t n = 0; n < line.size(); ++n) {
        const char c = line[n];
        if (c == '"') {
            if (isQuoted && n + 1 < line.size() && line[n + 1] == '"') {
                fields.back() += c;
                ++n;
            } else {
                isQuoted = !isQuoted;
            }
        } else if (c == ',' && !isQuoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    for (std::string& field : fields) field = std::string(withoutBlanks(field));
    return fields;
}

class RuleParser {
public:
    explicit RuleParser(const std::string& file) : file_(file) {}

    Result<void> readHead(const std::vector<std::string>& names, std::uint64_t line) {
        for (std::size_t f = 0; f < names.size(); ++f) {
            std::size_t column = 0;
            while (column < kColumns.size() && !equalsIgnoringCase(names[f], kColumns[column])) ++column;
            if (column == kColumns.size())
                return bad(line, fmt::format("unknown column '{}'; possible are query, conductivity, density and "
                                             "specificHeat",
                                             names[f]));
            place_[column] = f;
        }
        if (place_[0] == kNowhere || place_[1] == kNowhere)
            return bad(line, "the first line must name the columns query and conductivity");
        return {};
    }

    Result<ThermalRule> readRule(const std::vector<std::string>& fields, std::uint64_t line) const {
        ThermalRule rule;
        rule.query = text(fields, 0);
        if (rule.query.empty()) return bad(line, "the query is empty; write one such as class=Slab");
        const std::array<double*, 3> values{&rule.conductivity, &rule.density, &rule.specificHeat};
        for (std::size_t v = 0; v < values.size(); ++v) {
            const std::string value = text(fields, v + 1);
            if (value.empty() && v > 0) continue;
            const auto number = parseNumber(value);
            if (!number || *number < 0 || *number > 1e5)
                return bad(line, fmt::format("'{}' in the column {}; expected a number from 0 to 100000", value,
                                             kColumns[v + 1]));
            *values[v] = *number;
        }
        return rule;
    }

private:
    static constexpr std::size_t kNowhere = ~std::size_t{0};
    [[nodiscard]] std::string text(const std::vector<std::string>& fields, std::size_t column) const {
        return place_[column] < fields.size() ? fields[place_[column]] : std::string();
    }
    [[nodiscard]] Error bad(std::uint64_t line, const std::string& reason) const {
        return {Code::BadValue, "thermal materials: " + reason, {file_, line, 0, {}}};
    }

    const std::string& file_;
    std::array<std::size_t, 4> place_{kNowhere, kNowhere, kNowhere, kNowhere};
};

}  // namespace

Result<std::vector<ThermalRule>> parseThermalRules(std::string_view text, const std::string& file) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::vector<ThermalRule> rules;
    RuleParser parser(file);
    bool hasHead = false;
    for (std::uint64_t number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::string_view content = withoutBlanks(line);
        if (content.empty() || content.starts_with('#')) continue;
        if (!hasHead) {
            SVT_DO(parser.readHead(fieldsOf(content), number));
            hasHead = true;
            continue;
        }
        SVT_TRY(rule, parser.readRule(fieldsOf(content), number));
        rules.push_back(std::move(*rule));
    }
    if (!hasHead)
        return Error(Code::BadValue,
                     "thermal materials: the file is empty; its first line names the columns query and "
                     "conductivity",
                     {file, 0, 0, {}});
    return rules;
}

}  // namespace svt::simulate
