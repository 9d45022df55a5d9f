#pragma once
/// \file
/// SVT_CHECK stops the program on a programming error and prints the compared values. No input of a user can trigger
/// it.

#include <string>
#include <type_traits>

namespace svt {

/// Prints the condition, its values and the place in the source to stderr, and aborts.
[[noreturn]] void checkFailed(const char* condition, const std::string& values, const char* file, int line) noexcept;

namespace check {

/// A number, an enumerator or a Boolean as text; "?" for any other type.
template <class T>
std::string textOf(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_arithmetic_v<T>)
        return std::to_string(value);
    else if constexpr (std::is_enum_v<T>)
        return std::to_string(static_cast<std::underlying_type_t<T>>(value));
    else
        return "?";
}

/// Both sides of a comparison, and whether it holds.
template <class A, class B>
struct Comparison {
    const A& a;
    const B& b;
    bool holds;
    explicit operator bool() const { return holds; }
    [[nodiscard]] std::string values() const { return textOf(a) + " and " + textOf(b); }
};

/// The left operand of a comparison, or a condition that is not a comparison.
template <class A>
struct Left {
    const A& a;
    [[nodiscard]] bool holds() const { return static_cast<bool>(a); }
    explicit operator bool() const { return holds(); }
    [[nodiscard]] std::string values() const { return textOf(a); }

    template <class B>
    Comparison<A, B> operator==(const B& b) const {
        return {a, b, a == b};
    }
    template <class B>
    Comparison<A, B> operator!=(const B& b) const {
        return {a, b, a != b};
    }
    template <class B>
    Comparison<A, B> operator<(const B& b) const {
        return {a, b, a < b};
    }
    template <class B>
    Comparison<A, B> operator<=(const B& b) const {
        return {a, b, a <= b};
    }
    template <class B>
    Comparison<A, B> operator>(const B& b) const {
        return {a, b, a > b};
    }
    template <class B>
    Comparison<A, B> operator>=(const B& b) const {
        return {a, b, a >= b};
    }
};

/// `Begin() <=> a == b` is parsed as `(Begin() <=> a) == b`, because <=> binds more tightly than any other comparison.
struct Begin {
    template <class A>
    Left<A> operator<=>(const A& a) const {
        return {a};
    }
};

inline void verify(bool holds, const char* condition, const char* file, int line) {
    if (!holds) checkFailed(condition, {}, file, line);
}
template <class A, class B>
void verify(const Comparison<A, B>& comparison, const char* condition, const char* file, int line) {
    if (!comparison.holds) checkFailed(condition, comparison.values(), file, line);
}
template <class A>
void verify(const Left<A>& left, const char* condition, const char* file, int line) {
    if (!left.holds()) checkFailed(condition, left.values(), file, line);
}

}  // namespace check
}  // namespace svt

/// Aborts unless the condition holds: `SVT_CHECK(count == expected)`. Values of conditions joined by && are not
/// printed.
#define SVT_CHECK(...) ::svt::check::verify(::svt::check::Begin() <=> __VA_ARGS__, #__VA_ARGS__, __FILE__, __LINE__)
