#pragma once
/// \file
/// A value or an error. Every public function that can fail returns one;
/// no exception leaves the library except std::bad_alloc.

#include <svt/core/error.hpp>

#include <type_traits>
#include <utility>
#include <variant>

namespace svt {

/// Holds either a `T` or an `Error`, like C++23 std::expected<T, Error>.
///
///     Result<Grid> grid = Grid::fromDimension(box, {800, 700, 400});
///     if (!grid) return grid.error();
///     use(*grid);
///
/// SVT_TRY(grid, Grid::fromDimension(box, {800, 700, 400})) stands for the first two lines.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool hasValue() const noexcept { return state_.index() == 0; }
    [[nodiscard]] explicit operator bool() const noexcept { return hasValue(); }

    /// The value. Requires hasValue(); otherwise the program stops with the error's text.
    [[nodiscard]] T& value() & {
        requireValue();
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const T& value() const& {
        requireValue();
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T&& value() && {
        requireValue();
        return std::move(*std::get_if<0>(&state_));
    }
    [[nodiscard]] T& operator*() & { return value(); }
    [[nodiscard]] const T& operator*() const& { return value(); }
    [[nodiscard]] T&& operator*() && { return std::move(*this).value(); }
    [[nodiscard]] T* operator->() { return &value(); }
    [[nodiscard]] const T* operator->() const { return &value(); }

    /// The error. Requires !hasValue(); otherwise the program stops.
    [[nodiscard]] const Error& error() const& {
        if (hasValue()) errorMissing();
        return *std::get_if<1>(&state_);
    }
    [[nodiscard]] Error&& error() && {
        if (hasValue()) errorMissing();
        return std::move(*std::get_if<1>(&state_));
    }

private:
    void requireValue() const {
        if (!hasValue()) valueMissing(*std::get_if<1>(&state_));
    }

    std::variant<T, Error> state_;
};

/// Success, or an error.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), failed_(true) {}

    [[nodiscard]] bool hasValue() const noexcept { return !failed_; }
    [[nodiscard]] explicit operator bool() const noexcept { return hasValue(); }
    /// The error. Requires !hasValue(); otherwise the program stops.
    [[nodiscard]] const Error& error() const {
        if (hasValue()) errorMissing();
        return error_;
    }

private:
    Error error_;
    bool failed_ = false;
};

}  // namespace svt

/// Declares `name` as the Result of an expression. If that failed, the function returns its error.
#define SVT_TRY(name, ...)   \
    auto name = __VA_ARGS__; \
    if (!name) return std::move(name).error()

/// Evaluates an expression of type Result<void>. If that failed, the function returns its error.
#define SVT_DO(...)                                                                           \
    do {                                                                                      \
        if (auto svt_result = __VA_ARGS__; !svt_result) return std::move(svt_result).error(); \
    } while (false)
