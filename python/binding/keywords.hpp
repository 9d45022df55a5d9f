#pragma once
/// \file
/// Python keyword arguments as options of a struct (svt/frontend/option_set.hpp). A keyword has the name of its option
/// with '_' for '-'. The same declaration checks it, and it sets the same member. Names, ranges and defaults are
/// therefore those of the command.
///
///     v.render(section="y<4", opacity={"class=BuildingRoom": 0.2}, scale_bar=True)
///       --section 'y<4' --opacity 'class=BuildingRoom:0.2' --scale-bar

#include "failure.hpp"

#include <svt/frontend/option_set.hpp>

#include <span>
#include <string>
#include <vector>

namespace svt::python {

/// Converts keywords to options. Options of the whole process (memory, quiet) are unknown. None and False mean that the
/// option is not given. True is a flag, a tuple joins its members with commas, a list repeats the option, and a dict
/// repeats it with "key:value". Throws TypeError for an unknown keyword (with the nearest known one), Failure with
/// BadArgument for an invalid value.
[[nodiscard]] std::vector<frontend::GivenOption> givenOptions(const py::dict& keywords,
                                                              std::span<const frontend::BoundOption> options);

/// A struct with the members that keywords set. Throws like givenOptions(), and Failure with the error of setOptions().
template <record::Recorded T>
[[nodiscard]] T fromKeywords(const py::dict& keywords) {
    T to{};
    valueOf(frontend::setOptions(to, givenOptions(keywords, frontend::optionsOf<T>())));
    return to;
}

/// The name, value and help of each keyword; for docstrings.
[[nodiscard]] std::string describeKeywords(std::span<const frontend::BoundOption> options);

}  // namespace svt::python
