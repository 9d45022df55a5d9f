#pragma once
/// \file
/// SVT_CHECK stops the program on a programming error. Input data can never cause one.

namespace svt {
/// Prints the condition and its location to stderr and aborts.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line) noexcept;
}  // namespace svt

#define SVT_CHECK(condition) ((condition) ? void(0) : ::svt::checkFailed(#condition, __FILE__, __LINE__))
