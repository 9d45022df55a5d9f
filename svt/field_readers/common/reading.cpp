#include <svt/field_readers/common/reading.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/fields/units.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace svt::field_readers {

void Reading::note(std::string message, std::string file) const {
    diagnostics.add(Severity::Note, Code::BadField, std::move(message),
                    {file.empty() ? path.string() : std::move(file), 0, 0, {}});
}

void Reading::warn(Code code, std::string message, std::string file) const {
    diagnostics.add(Severity::Warning, code, std::move(message),
                    {file.empty() ? path.string() : std::move(file), 0, 0, {}});
}

Result<void> Reading::addValues(std::uint64_t places, std::uint64_t times, std::string_view name) {
    const std::uint64_t left = options.maxBytes - std::min(options.maxBytes, usedBytes);
    const std::uint64_t most = left / sizeof(float);
    if (places > 0 && times > most / places)
        return Error(
            Code::InputTooBig,
            fmt::format("the values of '{}' at {} places and {} times need more than the {} that fields may "
                        "take; choose fewer times with --from, --to and --every, or one of the quantities with "
                        "--quantity",
                        name, places, times, bytesText(options.maxBytes)),
            {path.string(), 0, 0, {}});
    usedBytes += places * times * sizeof(float);
    return {};
}

std::string Assumptions::json() const {
    if (texts_.empty()) return {};
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (const auto& [key, text] : texts_) object[key] = text;
    return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Error badField(std::string message, const std::filesystem::path& file, std::uint64_t line) {
    return Error(Code::BadField, std::move(message), {file.string(), line, 0, {}});
}

std::string fieldName(std::string_view text, std::string_view otherwise) {
    std::string name;
    for (const char c : text) {
        if (isLetter(c) || isDigit(c) || c == '.' || c == '-')
            name += lowerAscii(c);
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    while (!name.empty() && name.back() == '_') name.pop_back();
    const auto begin = std::find_if(name.begin(), name.end(), [](char c) { return isLetter(c); });
    name.erase(name.begin(), begin);
    if (name.size() > 60) name.resize(60);
    return name.empty() ? std::string(otherwise) : name;
}

bool isAskedFor(const FieldReadOptions& options, std::span<const std::string_view> texts) {
    if (options.quantity.empty()) return true;
    return std::find_if(texts.begin(), texts.end(), [&](std::string_view text) {
               return equalsIgnoringCase(text, options.quantity);
           }) != texts.end();
}

Result<std::vector<std::size_t>> keptTimes(std::span<const double> times, const Reading& reading,
                                           std::string_view name) {
    const FieldReadOptions& options = reading.options;
    // Times of files have 24 bits, so that 9.99999 s stands for 10 s.
    const auto slack = [](double time) { return std::min(1e-3, 1e-6 * std::max(1.0, std::abs(time))); };
    std::vector<std::size_t> kept;
    for (std::size_t t = 0; t < times.size(); ++t) {
        if (times[t] < options.firstTime - slack(times[t]) || times[t] > options.lastTime + slack(times[t])) continue;
        if (!kept.empty() && times[t] - times[kept.back()] < options.timeStep - slack(times[t])) continue;
        kept.push_back(t);
    }
    if (kept.empty() && times.empty()) return badField(fmt::format("'{}' has no time with values", name), reading.path);
    if (kept.empty())
        return Error(
            Code::BadArgument,
            fmt::format("no time of '{}' lies between --from and --to: the file has {} times from {} s to {} s", name,
                        times.size(), times.front(), times.back()),
            {reading.path.string(), 0, 0, {}});
    return kept;
}

Result<void> setUnit(fields::Field& field, std::string_view fileUnit, const Reading& reading,
                     Assumptions& assumptions) {
    const Place where{reading.path.string(), 0, 0, {}};
    const std::string& asked = reading.options.unit;
    const auto ofFile = fields::unitCode(fileUnit);
    const auto wanted = fields::unitCode(asked);
    if (!asked.empty() && !wanted)
        return Error(Code::BadArgument,
                     fmt::format("'{}' is not a unit; give a UCUM code, such as Cel, K, kg/m3 or [ppm]", asked));
    if (!ofFile && !wanted)
        return Error(Code::BadArgument,
                     withoutBlanks(fileUnit).empty()
                         ? fmt::format("the file states no unit of '{}'; give it with --unit, such as --unit Cel, or "
                                       "--unit 1 for a number without unit",
                                       field.head.name)
                         : fmt::format("the unit '{}' of '{}' is not a UCUM code; give it with --unit", fileUnit,
                                       field.head.name),
                     where);
    field.head.unit = wanted ? *wanted : *ofFile;
    if (!wanted) return {};
    // A unit that the table lacks may be any spelling of the given one.
    if (!ofFile || fields::findUnit(*ofFile) == nullptr) {
        const bool isStated = !withoutBlanks(fileUnit).empty();
        assumptions.add("unit", isStated ? fmt::format("given, {}; the file states '{}'", *wanted, fileUnit)
                                         : fmt::format("given, {}; the file states none", *wanted));
        if (isStated && ofFile != wanted)
            reading.note(
                fmt::format("the file states the unit '{}' of '{}'; its values are taken as {} without a "
                            "conversion, as --unit says",
                            fileUnit, field.head.name, *wanted));
        return {};
    }
    const auto conversion = fields::unitConversion(*ofFile, *wanted);
    if (!conversion)
        return Error(
            Code::BadArgument,
            fmt::format(
                "'{}' is in {} and cannot become {}: only Cel, K and [degF] are converted; leave out --unit, or "
                "choose a quantity with --quantity",
                field.head.name, *ofFile, *wanted),
            where);
    if (*conversion == fields::UnitConversion{}) return {};
    for (float& value : field.values)
        value = static_cast<float>(double{value} * conversion->scale + conversion->offset);
    assumptions.add("unit", fmt::format("converted from {} to {}", *ofFile, *wanted));
    return {};
}

void setPrecision(fields::Field& field, const Reading& reading, Assumptions& assumptions) {
    if (reading.options.precision) {
        field.head.precision = *reading.options.precision;
        return;
    }
    if (const auto range = fields::rangeOf(field))
        field.head.precision = fields::precisionFor(double{range->first}, double{range->second});
    if (field.head.precision > 0)
        assumptions.add("precision",
                        fmt::format("values are rounded to multiples of {} {}", field.head.precision, field.head.unit));
}

bool isMissingCell(std::string_view cell) noexcept {
    for (const std::string_view missing : {"", "nan", "na", "n/a", "null", "none", "-"})
        if (equalsIgnoringCase(cell, missing)) return true;
    return false;
}

}  // namespace svt::field_readers
