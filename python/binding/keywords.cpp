#include "keywords.hpp"

#include <svt/core/edit_distance.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace svt::python {
namespace {

// Options of the process. A module does not set them for the program that imports it.
bool isOfProcess(const Option& option) { return longName(option) == "--memory" || longName(option) == "--quiet"; }

std::string keywordOf(const Option& option) {
    std::string name(longName(option));
    name.erase(0, name.find_first_not_of('-'));
    std::replace(name.begin(), name.end(), '-', '_');
    if (name == "from") name += '_';  // a reserved word of Python
    return name;
}

// One value in the syntax of the command line. Paths are converted by os.fspath().
std::string valueTextOf(const py::handle& value) {
    const py::object fspath = py::module_::import("os").attr("fspath");
    if (py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__")) return py::str(fspath(value));
    if (py::isinstance<py::tuple>(value)) {
        std::string joined;
        for (const py::handle& member : value) joined += (joined.empty() ? "" : ",") + valueTextOf(member);
        return joined;
    }
    if (py::hasattr(value, "item") && !PyFloat_Check(value.ptr()))
        return valueTextOf(value.attr("item")());  // a numpy scalar
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
                       fmt::format("{} values, but one is expected; give several numbers as a tuple", texts.size()));
    for (const std::string& text : texts) {
        // True means an option without a value; an empty text is an error.
        const std::string fault = text.empty() ? faultOf(option, text) : frontend::faultOfValues(option, text);
        if (!fault.empty()) throw badValue(keyword, fault);
        for (std::string& part : frontend::valuesOf(option, text)) values.push_back(std::move(part));
    }
    return values;
}

// Throws TypeError for an unknown keyword, with the nearest known one.
[[noreturn]] void refuse(const std::string& keyword, std::span<const frontend::BoundOption> options) {
    std::string nearest;
    std::size_t best = 3;
    for (const Option& option : options)
        if (const std::string other = keywordOf(option); !isOfProcess(option))
            if (const std::size_t distance = editDistance(keyword, other, 2); distance < best) {
                best = distance;
                nearest = other;
            }
    throw py::type_error(fmt::format("unexpected keyword argument '{}'{}", keyword,
                                     nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

}  // namespace

std::vector<frontend::GivenOption> givenOptions(const py::dict& keywords,
                                                std::span<const frontend::BoundOption> options) {
    std::vector<frontend::GivenOption> given;
    for (const auto& [key, value] : keywords) {
        if (value.is_none() || (py::isinstance<py::bool_>(value) && !value.cast<bool>())) continue;
        const std::string keyword = py::str(key);
        const auto found = std::ranges::find_if(
            options, [&](const Option& option) { return !isOfProcess(option) && keywordOf(option) == keyword; });
        if (found == options.end()) refuse(keyword, options);
        given.push_back({&*found, valuesFor(*found, keyword, value)});
    }
    if (const auto checked = frontend::checkExclusions(given); !checked) throw Failure(checked.error());
    return given;
}

std::string describeKeywords(std::span<const frontend::BoundOption> options) {
    std::string text;
    for (const Option& option : options)
        if (!isOfProcess(option))
            text += fmt::format("{} : {}\n    {}\n", keywordOf(option),
                                option.kind == OptionKind::Flag ? "bool" : frontend::valueText(option),
                                frontend::descriptionOf(option));
    return text;
}

}  // namespace svt::python
