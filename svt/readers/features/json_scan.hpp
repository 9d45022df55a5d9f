#pragma once
/// \file
/// Finds the bounds of members and elements in JSON text by looking only at brackets and strings. The reader that gets
/// the values checks them.

#include <cstddef>
#include <functional>
#include <string_view>

namespace svt::readers::features {

inline constexpr std::size_t kNoJson = static_cast<std::size_t>(-1);

/// Position after the value that begins at `at`, or at the next character that is not blank; kNoJson if the text ends
/// within it. Cost: O(size), without recursion.
[[nodiscard]] std::size_t skipJson(std::string_view text, std::size_t at) noexcept;
/// Position of the first character that is not blank.
[[nodiscard]] std::size_t skipJsonBlanks(std::string_view text, std::size_t at) noexcept;

/// Calls `visit(key with quotes, begin of value, end of value)` for each member of the object that begins at `at`.
/// \return position after the object; kNoJson if it is not an object
std::size_t forEachMember(std::string_view text, std::size_t at,
                          const std::function<void(std::string_view, std::size_t, std::size_t)>& visit);
/// Calls `visit(begin, end)` for each element of the array that begins at `at`. \return like forEachMember()
std::size_t forEachElement(std::string_view text, std::size_t at,
                           const std::function<void(std::size_t, std::size_t)>& visit);

}  // namespace svt::readers::features
