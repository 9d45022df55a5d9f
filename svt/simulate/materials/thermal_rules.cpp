#include <svt/simulate/heat.hpp>

#include <svt/core/text.hpp>
#include <svt/record/csv_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace svt::simulate {
namespace {

constexpr std::array<std::string_view, 4> kColumns{"query", "conductivity", "density", "specificHeat"};

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

    Result<ThermalRule> readRule(const std::vector<std::string>& fields, const record::CsvReader& reader) const {
        const std::uint64_t line = reader.line();
        ThermalRule rule;
        rule.query = text(fields, 0);
        if (rule.query.empty()) return bad(line, "the query is empty; write one such as class=Slab");
        const std::array<double*, 3> values{&rule.conductivity, &rule.density, &rule.specificHeat};
        for (std::size_t v = 0; v < values.size(); ++v) {
            const std::string value = text(fields, v + 1);
            if (value.empty() && v > 0) continue;
            const auto number = reader.number(value);
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
    SVT_DO(record::checkTableText(text, file));
    std::vector<ThermalRule> rules;
    RuleParser parser(file);
    record::CsvReader reader(text);
    std::vector<std::string> cells;
    bool hasHead = false;
    while (reader.next(cells)) {
        if (reader.isQuoteOpen())
            return Error(Code::BadValue, "thermal materials: a quote that is opened here is never closed",
                         {file, reader.line(), 0, {}});
        if (std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); })) continue;
        if (!hasHead) {
            SVT_DO(parser.readHead(cells, reader.line()));
            hasHead = true;
            continue;
        }
        SVT_TRY(rule, parser.readRule(cells, reader));
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
