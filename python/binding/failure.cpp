#include "failure.hpp"

#include <svt/core/text.hpp>

#include <string>
#include <string_view>

namespace svt::python {
namespace {

py::object placeOf(const Place& place) {
    return py::module_::import("svt.errors")
        .attr("Place")(textOf(place.file), place.line, place.column, textOf(place.id));
}

bool isLowerCase(char c) { return isLetter(c) && lowerAscii(c) == c; }

// Messages name options in the syntax of the command, "--min-area 3"; in Python they are keywords, "min_area 3". Quoted
// commands, 'svt build --vectors edges', do not change.
std::string inKeywords(const std::string& message) {
    std::string text;
    std::size_t typed = 0;  // end of the quoted command
    for (std::size_t at = 0; at < message.size(); ++at) {
        if (message.compare(at, 5, "'svt ") == 0) typed = message.find('\'', at + 1);
        const bool isOption = (typed == 0 || at > typed) && message.compare(at, 2, "--") == 0 &&
                              at + 2 < message.size() && isLowerCase(message[at + 2]) &&
                              (at == 0 || std::string_view(" '(").find(message[at - 1]) != std::string_view::npos);
        if (!isOption) {
            text += message[at];
            continue;
        }
        for (at += 2; at < message.size() && (isLowerCase(message[at]) || message[at] == '-'); ++at)
            text += message[at] == '-' ? '_' : message[at];
        --at;
    }
    return text;
}

py::object attributeValue(const Attribute* attribute) {
    if (attribute == nullptr) return py::none();
    return std::visit(
        [](const auto& value) -> py::object {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
                return textOf(value);
            else
                return py::cast(value);
        },
        attribute->value);
}

// The array of toJsonText() as a list: a record with several values is a list in it.
py::list attributeValues(const AttributeList& list) {
    const auto& items = list.items;
    const bool hasRecords = items.front().record != items.back().record;
    py::list values;
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
        end = begin + 1;
        while (hasRecords && end < items.size() && items[end].record == items[begin].record) ++end;
        py::list ofRecord;
        for (std::size_t n = begin; n < end; ++n) ofRecord.append(attributeValue(items[n].attribute));
        values.append(end - begin > 1 ? py::object(ofRecord) : py::object(ofRecord[0]));
    }
    return values;
}

}  // namespace

void registerFailures() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            const Error& error = failure.error();
            const py::object type = py::module_::import("svt.errors").attr("Error");
            const py::object made = type(codeTag(error.code()), std::string(codeName(error.code())),
                                         textOf(inKeywords(error.message())), placeOf(error.where()));
            PyErr_SetObject(type.ptr(), made.ptr());
        }
    });
}

py::list toPython(const Diagnostics& findings) {
    const py::object type = py::module_::import("svt.errors").attr("Finding");
    py::list list;
    for (const Diagnostic& item : findings.items())
        list.append(type(std::string(severityName(item.severity)), codeTag(item.code), std::string(codeName(item.code)),
                         textOf(inKeywords(item.message)), placeOf(item.where)));
    return list;
}

py::str textOf(std::string_view text) {
    PyObject* decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace");
    if (decoded == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}

py::dict attributesOf(const std::vector<Attribute>& attributes) {
    py::dict dict;
    for (const AttributeList& list : attributeLists(attributes))
        dict[textOf(list.name)] =
            list.isSingle() ? attributeValue(list.items.front().attribute) : py::object(attributeValues(list));
    return dict;
}

}  // namespace svt::python
