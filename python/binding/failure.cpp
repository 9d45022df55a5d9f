#include "failure.hpp"

namespace svt::python {
namespace {

py::object placeOf(const Place& place) {
    return py::module_::import("svt.errors").attr("Place")(place.file, place.line, place.column, place.id);
}

}  // namespace

void registerFailures() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            const Error& error = failure.error();
            const py::object type = py::module_::import("svt.errors").attr("Error");
            const py::object made = type(codeTag(error.code()), std::string(codeName(error.code())), error.message(),
                                         placeOf(error.where()));
            PyErr_SetObject(type.ptr(), made.ptr());
        }
    });
}

py::list toPython(const Diagnostics& findings) {
    const py::object type = py::module_::import("svt.errors").attr("Finding");
    py::list list;
    for (const Diagnostic& item : findings.items())
        list.append(type(std::string(severityName(item.severity)), codeTag(item.code), std::string(codeName(item.code)),
                         item.message, placeOf(item.where)));
    return list;
}

py::dict attributesOf(const std::vector<Attribute>& attributes) {
    py::dict dict;
    for (const Attribute& attribute : attributes)
        dict[py::str(attribute.name)] =
            std::visit([](const auto& value) -> py::object { return py::cast(value); }, attribute.value);
    return dict;
}

}  // namespace svt::python
