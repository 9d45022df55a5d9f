#pragma once
/// \file
/// SVT_CHECK stops the program on a programmer's error. Input can never reach one.

namespace svt {
/// Prints the condition and place to stderr and aborts.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line) noexcept;
}  // namespace svt

#define SVT_CHECK(condition) ((condition) ? void(0) : ::svt::checkFailed(#condition, __FILE__, __LINE__))
