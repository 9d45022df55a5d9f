#pragma once
/// \file
/// Parts of the C++20 standard library that the code uses and Emscripten 3.1.6 (libc++ 13) lacks. Included before every
/// source of the web build; each part can be removed once Debian's Emscripten provides it.

#ifdef __cplusplus
#include <version>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <system_error>
#include <type_traits>
#include <utility>

namespace std {

/// As in libstdc++, which also uses fast_float; a number out of range leaves `value` unchanged.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    double parsed = 0;
    const auto [end, error] = fast_float::from_chars(first, last, parsed);
    if (error != errc()) return {end, error};
    const char* digit = first != last && *first == '-' ? first + 1 : first;
    const bool isNumber = digit != last && (*digit == '.' || (*digit >= '0' && *digit <= '9'));
    if (isNumber && isinf(parsed)) return {end, errc::result_out_of_range};
    if (isNumber && parsed == 0)
        for (const char* at = digit; at != end && *at != 'e' && *at != 'E'; ++at)
            if (*at >= '1' && *at <= '9') return {end, errc::result_out_of_range};
    value = parsed;
    return {end, errc()};
}

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

template <class T>
requires is_unbounded_array_v<T> unique_ptr<T> make_unique_for_overwrite(size_t count) {
    return unique_ptr<T>(new remove_extent_t<T>[count]);
}

/// The algorithms of ranges, with projections, over types that begin() and end() take.
namespace ranges {

template <class Less, class Projection>
auto projected(Less less, Projection projection) {
    return [=](const auto& a, const auto& b) { return invoke(less, invoke(projection, a), invoke(projection, b)); };
}

template <class Range, class Less = std::less<>, class Projection = identity>
void sort(Range&& range, Less less = {}, Projection projection = {}) {
    std::sort(std::begin(range), std::end(range), projected(less, projection));
}
template <class Range, class Less = std::less<>, class Projection = identity>
void stable_sort(Range&& range, Less less = {}, Projection projection = {}) {
    std::stable_sort(std::begin(range), std::end(range), projected(less, projection));
}
template <class Range, class Value, class Projection = identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
    return std::find_if(std::begin(range), std::end(range),
                        [&](const auto& item) { return invoke(projection, item) == value; });
}
template <class Range, class Predicate>
auto find_if(Range&& range, Predicate predicate) {
    return std::find_if(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
bool any_of(Range&& range, Predicate predicate) {
    return std::any_of(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
auto count_if(Range&& range, Predicate predicate) {
    return std::count_if(std::begin(range), std::end(range), predicate);
}
template <class Range, class Value>
void fill(Range&& range, const Value& value) {
    std::fill(std::begin(range), std::end(range), value);
}
template <class A, class B>
bool equal(A&& a, B&& b) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b));
}
template <class Range, class Less = std::less<>, class Projection = identity>
auto min_element(Range&& range, Less less = {}, Projection projection = {}) {
    return std::min_element(std::begin(range), std::end(range), projected(less, projection));
}
template <class Range, class Less = std::less<>, class Projection = identity>
auto max_element(Range&& range, Less less = {}, Projection projection = {}) {
    return std::max_element(std::begin(range), std::end(range), projected(less, projection));
}
template <class T>
struct min_max_result {
    T min, max;
};
template <class Range, class Less = std::less<>, class Projection = identity>
auto minmax(Range&& range, Less less = {}, Projection projection = {}) {
    const auto [low, high] = std::minmax_element(std::begin(range), std::end(range), projected(less, projection));
    return min_max_result<iter_value_t<decltype(low)>>{*low, *high};
}

}  // namespace ranges
}  // namespace std

#endif
#endif
