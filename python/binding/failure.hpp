#pragma once
/// \file
/// Errors of the library as exceptions of Python: svt.Error with code, place and message (python/svt/errors.py); findings and
/// attributes as objects of Python.

#include <svt/core/attribute.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>

#include <pybind11/pybind11.h>

#include <exception>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::python {

namespace py = pybind11;

/// Thrown by the binding alone; the translator of registerFailures() makes a svt.Error of it.
class Failure : public std::exception {
public:
    explicit Failure(Error error) : error_(std::move(error)) {}
    [[nodiscard]] const Error& error() const noexcept { return error_; }
    [[nodiscard]] const char* what() const noexcept override { return error_.message().c_str(); }

private:
    Error error_;
};

/// The value, or the error thrown.
template <class T>
T valueOf(Result<T> result) {
    if (!result) throw Failure(result.error());
    if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

void registerFailures();

/// The findings as a list of svt.Finding. Needs the GIL.
[[nodiscard]] py::list toPython(const Diagnostics& findings);

/// Text as Python has it; bytes that are no UTF-8, which a file name may hold, become U+FFFD. Needs the GIL.
[[nodiscard]] py::str textOf(std::string_view text);

/// Attributes by name. Needs the GIL.
[[nodiscard]] py::dict attributesOf(const std::vector<Attribute>& attributes);

}  // namespace svt::python
