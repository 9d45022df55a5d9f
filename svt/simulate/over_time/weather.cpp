#include <svt/simulate/heat_over_time.hpp>

#include <svt/core/text.hpp>
#include <svt/record/csv_reader.hpp>
#include <svt/record/times.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::simulate {
namespace {

constexpr std::size_t kNowhere = ~std::size_t{0};

class WeatherParser {
public:
    WeatherParser(std::string_view text, const std::string& file) : reader_(text), file_(file) {}

    Result<Weather> parse() {
        std::vector<std::string> cells;
        while (reader_.next(cells)) {
            if (reader_.isQuoteOpen()) return bad("a quote that is opened here is never closed");
            if (time_ == kNowhere)
                SVT_DO(readHead(cells));
            else
                SVT_DO(readRow(cells));
        }
        if (weather_.rows.empty())
            return Error(Code::BadValue,
                         "weather: the file has no rows; its first line names the columns time and temperature",
                         {file_, 0, 0, {}});
        if (times_.isDated()) weather_.epoch = record::isoText(first_);
        weather_.hasNoZone = times_.hasNoZone();
        return std::move(weather_);
    }

private:
    Result<void> readHead(const std::vector<std::string>& names) {
        for (std::size_t n = 0; n < names.size(); ++n) {
            if (equalsIgnoringCase(names[n], "time")) time_ = n;
            if (equalsIgnoringCase(names[n], "temperature")) temperature_ = n;
        }
        if (time_ == kNowhere || temperature_ == kNowhere)
            return bad("the first line must name the columns time and temperature");
        return {};
    }

    Result<void> readRow(const std::vector<std::string>& cells) {
        if (cells.size() <= std::max(time_, temperature_)) return bad("the row has too few cells");
        Weather::Row row;
        std::string fault;
        if (!times_.read(cells[time_], reader_.number(cells[time_]), row.seconds, fault)) return bad(fault);
        const auto celsius = reader_.number(cells[temperature_]);
        if (!celsius || !(*celsius >= -273.15 && *celsius <= 5000))
            return bad(
                fmt::format("'{}' is not a temperature from -273.15 to 5000 degrees Celsius", cells[temperature_]));
        row.celsius = *celsius;
        if (weather_.rows.empty()) first_ = row.seconds;
        row.seconds -= first_;
        if (!weather_.rows.empty() && !(row.seconds > weather_.rows.back().seconds))
            return bad("the time is not after that of the row before");
        weather_.rows.push_back(row);
        return {};
    }

    [[nodiscard]] Error bad(const std::string& reason) const {
        return {Code::BadValue, "weather: " + reason, {file_, reader_.line(), 0, {}}};
    }

    record::CsvReader reader_;
    const std::string& file_;
    record::TimeReader times_;
    std::size_t time_ = kNowhere, temperature_ = kNowhere;
    double first_ = 0;
    Weather weather_;
};

}  // namespace

Result<Weather> parseWeather(std::string_view text, const std::string& file) {
    SVT_DO(record::checkTableText(text, file));
    return WeatherParser(text, file).parse();
}

}  // namespace svt::simulate
