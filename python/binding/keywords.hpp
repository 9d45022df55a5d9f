#pragma once
/// \file
/// Keyword arguments of Python as options of a command: each option that apps/cli/options/catalog.hpp declares is a keyword
/// of the same name with '_' for '-', is held against the same declaration, and goes into the same struct. So what can be
/// asked for, its ranges and defaults are those of the command.
///
///     v.render(section="y<4", opacity={"class=BuildingRoom": 0.2}, scale_bar=True)
///       --section 'y<4' --opacity 'class=BuildingRoom:0.2' --scale-bar

#include "failure.hpp"

#include <apps/cli/options/command_line.hpp>

#include <string>
#include <string_view>

namespace svt::python {

class Keywords {
public:
    /// \param command  name of the command, such as "render". Its options of the whole process (memory, quiet) are left out.
    explicit Keywords(std::string_view command);

    /// What the structs of options connect themselves to.
    [[nodiscard]] cli::Command& command() noexcept { return command_; }

    /// Hands the values on to what is connected. None and False are not given; True is a flag; a tuple joins its members
    /// with commas, a list repeats the option, a dict gives "key:value" each.
    /// Throws TypeError for a keyword that nothing is connected to (with the nearest), Failure of BadArgument for a value.
    void take(const py::dict& given) const;

    /// One line for each keyword that is connected: name, value and what it does; for docstrings.
    [[nodiscard]] std::string describe() const;

private:
    cli::CommandText text_;
    cli::Command command_;
};

}  // namespace svt::python
