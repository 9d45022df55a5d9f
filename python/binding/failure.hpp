#pragma once
/// \file
/// Errors of the library as Python exceptions: svt.Error with code, place and message (python/svt/errors.py). Findings
/// and attributes as Python objects.

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

/// Only the binding throws this exception; the translator of registerFailures() converts it to svt.Error.
class Failure : public std::exception {
public:
    explicit Failure(Error error) : error_(std::move(error)) {}
    [[nodiscard]] const Error& error() const noexcept { return error_; }
    [[nodiscard]] const char* what() const noexcept override { return error_.message().c_str(); }

private:
    Error error_;
};

/// The value; throws the error as Failure.
template <class T>
T valueOf(Result<T> result) {
    if (!result) throw Failure(result.error());
    if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

void registerFailures();

/// The findings as a list of svt.Finding. Needs the GIL.
[[nodiscard]] py::list toPython(const Diagnostics& findings);

/// Text as a Python string. Bytes that are not UTF-8, as in some file names, become U+FFFD. Needs the GIL.
[[nodiscard]] py::str textOf(std::string_view text);

/// Attributes by name. Several values are a list as toJsonText() writes it: None for a record without a value, a list
/// for one with several. Needs the GIL.
[[nodiscard]] py::dict attributesOf(const std::vector<Attribute>& attributes);

}  // namespace svt::python
