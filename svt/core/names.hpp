#pragma once
/// \file
/// Names of enum values. Each name is defined once, next to its enum, by a function namesOf().

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace svt {

/// A value, and its name in files, options and reports.
template <class E>
struct Name {
    E value;
    std::string_view name;
};

/// An enum is Named if a function `namesOf(E)` next to it lists its values and their names, in the order of help:
/// `constexpr auto namesOf(Look) { return std::to_array<Name<Look>>({{Look::Plain, "plain"}, {Look::Dark, "dark"}}); }`
template <class E>
concept Named = requires {
    namesOf(E{}).front().name;
};

template <Named E>
inline constexpr auto kNames = namesOf(E{});

/// The name of `value`; empty if the enum has no such value.
template <Named E>
[[nodiscard]] constexpr std::string_view nameOf(E value) noexcept {
    for (const Name<E>& known : kNames<E>)
        if (known.value == value) return known.name;
    return {};
}

/// The value with this name, or nothing. Case-sensitive.
template <Named E>
[[nodiscard]] constexpr std::optional<E> fromName(std::string_view name) noexcept {
    for (const Name<E>& known : kNames<E>)
        if (known.name == name) return known.value;
    return {};
}

namespace detail {

template <Named E>
struct JoinedNames {
    static constexpr std::size_t size() {
        std::size_t sum = kNames<E>.size() - 1;
        for (const Name<E>& known : kNames<E>) sum += known.name.size();
        return sum;
    }
    static constexpr auto kText = [] {
        std::array<char, size()> text{};
        std::size_t at = 0;
        for (const Name<E>& known : kNames<E>) {
            if (at > 0) text[at++] = '|';
            for (const char c : known.name) text[at++] = c;
        }
        return text;
    }();
};

}  // namespace detail

/// All names in the format of Option::choices: "plain|paper|dark". Valid for the lifetime of the program.
template <Named E>
[[nodiscard]] constexpr std::string_view choicesOf() noexcept {
    return {detail::JoinedNames<E>::kText.data(), detail::JoinedNames<E>::kText.size()};
}

/// All names, separated by commas, for messages.
template <Named E>
[[nodiscard]] std::string listedNames() {
    std::string text;
    for (const Name<E>& known : kNames<E>) text.append(text.empty() ? "" : ", ").append(known.name);
    return text;
}

}  // namespace svt
