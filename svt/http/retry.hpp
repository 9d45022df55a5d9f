#pragma once
/// \file
/// When a failed request is sent again: later each time, or when the server asks for it.

#include <cstdint>
#include <functional>
#include <string_view>

namespace svt::http {

/// The clock and the waiting function. Tests replace them.
struct RetryClock {
    std::function<void(double seconds)> wait;
    std::function<std::int64_t()> now;  ///< seconds since 1970 in UTC
};

/// The clock of this machine.
[[nodiscard]] RetryClock machineClock();

/// Requests for one range, the first one included.
constexpr int kMostAttempts = 4;
/// Longest time to wait if a server asks for it.
constexpr double kLongestRetrySeconds = 60;

/// Seconds until the next request: 0.25, 0.5, 1, ... after the first, second, third attempt; longer if the server
/// asks for it.
/// \param attempt     number of requests so far, from 1
/// \param retryAfter  value of the header Retry-After: seconds or a date (RFC 9110, 10.2.3); empty or malformed:
///                    ignored
/// \param now         seconds since 1970 in UTC
[[nodiscard]] double retrySeconds(int attempt, std::string_view retryAfter, std::int64_t now);

}  // namespace svt::http
