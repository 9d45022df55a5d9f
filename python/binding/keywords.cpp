#include "keywords.hpp"

#include <svt/core/edit_distance.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace svt::python {
namespace {

// Options of the process, which a module does not set for whoever imports it.
bool isOfProcess(std::span<const Option> set) {
    return std::any_of(set.begin(), set.end(), [](const Option& option) {
        return longName(option) == "--memory" || longName(option) == "--quiet";
    });
}

cli::CommandText commandTextOf(std::string_view name) {
    for (cli::CommandText text : cli::commandTexts())
        if (text.name == name) {
            std::erase_if(text.sets, isOfProcess);
            return text;
        }
    throw std::logic_error("no such command");
}

std::string keywordOf(const Option& option) {
    std::string name(longName(option));
    name.erase(0, name.find_first_not_of('-'));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

// One value as it would be written on the command line. Paths are what os.fspath() says.
std::string valueTextOf(const py::handle& value) {
    const py::object fspath = py::module_::import("os").attr("fspath");
    if (py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__")) return py::str(fspath(value));
    if (py::isinstance<py::tuple>(value)) {
        std::string joined;
        for (const py::handle& member : value) joined += (joined.empty() ? "" : ",") + valueTextOf(member);
        return joined;
    }
    if (py::hasattr(value, "item") && !PyFloat_Check(value.ptr()))
        return valueTextOf(value.attr("item")());  // of numpy
    return py::str(value);
}

// All values of an option.
std::vector<std::string> textsOf(const py::handle& value) {
    std::vector<std::string> texts;
    if (py::isinstance<py::dict>(value)) {
        for (const auto& [key, member] : py::reinterpret_borrow<py::dict>(value))
            texts.push_back(valueTextOf(key) + ":" + valueTextOf(member));
    } else if (py::isinstance<py::list>(value)) {
        for (const py::handle& member : value) texts.push_back(valueTextOf(member));
    } else {
        texts.push_back(valueTextOf(value));
    }
    return texts;
}

Failure badValue(const std::string& keyword, const std::string& what) {
    return Failure(Error(Code::BadArgument, fmt::format("{}: {}", keyword, what)));
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> values(1);
    for (const char c : text) c == ',' ? static_cast<void>(values.emplace_back()) : values.back().push_back(c);
    return values;
}

std::vector<std::string> valuesFor(const Option& option, const std::string& keyword, const py::handle& value) {
    if (option.kind == OptionKind::Flag) {
        if (!py::isinstance<py::bool_>(value)) throw badValue(keyword, "expected True or False");
        return {};
    }
    std::vector<std::string> values;
    if (option.leastCount == 0 && py::isinstance<py::bool_>(value)) return values;
    const std::vector<std::string> texts = textsOf(value);
    if (texts.size() > 1 && !option.mayRepeat)
        throw badValue(keyword,
                       fmt::format("{} values, and it takes one; for several numbers give a tuple", texts.size()));
    for (const std::string& text : texts) {
        const std::vector<std::string> parts = option.count == 1 ? std::vector{text} : split(text);
        const auto count = static_cast<int>(parts.size());
        if (option.count > 1 && (count < option.leastCount || count > option.count))
            throw badValue(keyword, fmt::format("'{}': expected {} values", text, option.count));
        for (const std::string& part : parts) {
            if (const std::string fault = faultOf(option, part); !fault.empty()) throw badValue(keyword, fault);
            values.push_back(part);
        }
    }
    return values;
}

}  // namespace

Keywords::Keywords(std::string_view command) : text_(commandTextOf(command)), command_(text_) {}

void Keywords::take(const py::dict& given) const {
    std::vector<std::string_view> names;
    for (const auto& [key, value] : given) {
        if (value.is_none() || (py::isinstance<py::bool_>(value) && !value.cast<bool>())) continue;
        const std::string keyword = py::str(key);
        const auto& connections = command_.connections();
        const auto found = std::find_if(connections.begin(), connections.end(), [&](const auto& connection) {
            return connection.take != nullptr && keywordOf(connection.option) == keyword;
        });
        if (found == connections.end()) {
            std::string nearest;
            std::size_t best = 3;
            for (const auto& [option, take] : connections)
                if (const std::string other = keywordOf(option); take != nullptr)
                    if (const std::size_t distance = editDistance(keyword, other, 2); distance < best) {
                        best = distance;
                        nearest = other;
                    }
            throw py::type_error(fmt::format("unexpected keyword argument '{}'{}", keyword,
                                             nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
        }
        for (const std::string_view other : splitChoices(found->option.excludes))
            if (std::find(names.begin(), names.end(), other) != names.end())
                throw badValue(keyword, fmt::format("excludes {}; give one of them", other.substr(2)));
        names.push_back(longName(found->option));
        found->take(valuesFor(found->option, keyword, value));
    }
}

std::string Keywords::describe() const {
    std::string text;
    for (const auto& [option, take] : command_.connections())
        if (take != nullptr)
            text += fmt::format("{} : {}\n    {}\n", keywordOf(option),
                                option.kind == OptionKind::Flag ? "bool" : cli::valueText(option),
                                cli::descriptionOf(option));
    return text;
}

}  // namespace svt::python
