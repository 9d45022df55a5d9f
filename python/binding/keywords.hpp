#pragma once
/// \file
/// Keyword arguments of Python as options of a struct (svt/frontend/option_set.hpp). A keyword has the name of its option
/// with '_' for '-'. The same declaration checks it, and it sets the same member. So names, ranges and defaults are those
/// of the command.
///
///     v.render(section="y<4", opacity={"class=BuildingRoom": 0.2}, scale_bar=True)
///       --section 'y<4' --opacity 'class=BuildingRoom:0.2' --scale-bar

#include "failure.hpp"

#include <svt/frontend/option_set.hpp>

#include <span>
#include <string>
#include <vector>

namespace svt::python {

/// The options that keywords give; those of the whole process (memory, quiet) are unknown. None and False are not given;
/// True is a flag; a tuple joins its members with commas, a list repeats the option, a dict gives "key:value" each.
/// Throws TypeError for an unknown keyword (with the nearest), Failure of BadArgument for a value.
[[nodiscard]] std::vector<frontend::GivenOption> givenOptions(const py::dict& keywords,
                                                              std::span<const frontend::BoundOption> options);

/// A struct with the members that keywords set. Throws as givenOptions(), and Failure of setOptions().
template <record::Recorded T>
[[nodiscard]] T fromKeywords(const py::dict& keywords) {
    T to{};
    valueOf(frontend::setOptions(to, givenOptions(keywords, frontend::optionsOf<T>())));
    return to;
}

/// The name, value and help of each keyword; for docstrings.
[[nodiscard]] std::string describeKeywords(std::span<const frontend::BoundOption> options);

}  // namespace svt::python
