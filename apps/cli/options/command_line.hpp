#pragma once
/// \file
/// Connects the options that the catalog declares with the variables of a command, and reads the command line.

#include <apps/cli/options/catalog.hpp>

#include <svt/core/file.hpp>
#include <svt/core/names.hpp>
#include <svt/illustrate/scene_members.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace svt::cli {

/// A command while its options are connected. Each option of the catalog is connected exactly once.
class Command {
public:
    /// What the values of an option, held against its declaration, are handed to; flags have none.
    using Take = std::function<void(const std::vector<std::string>&)>;

    struct Connection {
        Option option;
        Take take;  ///< null until connected
    };

    explicit Command(const CommandText& text);

    /// Values of `option` (by its long name, "--fov" or "input") go to `to`, which takes the option's default at once:
    /// bool, a number, std::string, a path, std::optional of these, or std::vector of texts, paths or numbers.
    template <class T>
    void set(std::string_view option, T& to);
    /// Values go to a function.
    void take(std::string_view option, Take take);

    /// Values of all options that set a member of a scene (Option::member) go to `to`, in the order of the catalog.
    void takeMembers(std::vector<illustrate::GivenMember>& to);

    [[nodiscard]] bool has(std::string_view option) const noexcept;

    /// The default of an option, as it would be written; empty: none.
    [[nodiscard]] std::string_view byDefault(std::string_view option) { return connection(option).option.byDefault; }

    [[nodiscard]] const CommandText& text() const noexcept { return *text_; }
    [[nodiscard]] const std::vector<Connection>& connections() const noexcept { return connections_; }

private:
    template <class T>
    static void assign(const std::string& text, T& to);
    static double number(const std::string& text);
    Connection& connection(std::string_view option);

    const CommandText* text_;
    std::vector<Connection> connections_;
};

/// Reads the command line and runs the command that it names; prints help, the version, or what is wrong with it.
/// \return the exit code
int runCommandLine(int argc, char** argv);

/// The help text of a command; of all where `command` is empty.
[[nodiscard]] std::string helpText(std::string_view command);

// ---------------------------------------------------------------------------------------------------------------------

template <class T>
void Command::assign(const std::string& text, T& to) {
    if constexpr (std::is_same_v<T, bool>)
        to = text == "true";
    else if constexpr (std::is_arithmetic_v<T>)
        to = static_cast<T>(number(text));
    else if constexpr (Named<T>)
        to = fromName<T>(text).value_or(to);  // faultOf() has seen it
    else if constexpr (std::is_same_v<T, std::filesystem::path>)
        to = userPath(text);
    else
        to = T(text);
}

template <class T>
void Command::set(std::string_view option, T& to) {
    const std::string_view byDefault = connection(option).option.byDefault;
    if constexpr (requires {
                      to.reset();
                      to.value();
                  }) {
        // Nothing where nothing is given: who asks for an optional wants to know.
        take(option, [&to](const std::vector<std::string>& values) {
            to.emplace();
            assign(values.empty() ? std::string() : values.front(), *to);
        });
    } else if constexpr (std::is_same_v<T, bool>) {
        take(option, [&to](const std::vector<std::string>&) { to = true; });
    } else if constexpr (requires { to.push_back(typename T::value_type()); } && !std::is_same_v<T, std::string>) {
        take(option, [&to](const std::vector<std::string>& values) {
            for (const std::string& value : values) assign(value, to.emplace_back());
        });
    } else {
        if (!byDefault.empty()) assign(std::string(byDefault), to);
        take(option, [&to](const std::vector<std::string>& values) { assign(values.front(), to); });
    }
}

}  // namespace svt::cli
