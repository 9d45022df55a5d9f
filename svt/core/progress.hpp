#pragma once
/// \file
/// Progress reports and cancellation of long calls.

#include <atomic>
#include <functional>
#include <string_view>

namespace svt {

/// Passed to long calls by the caller, which may run on another thread.
/// `report` is called by one thread at a time, at most a few hundred times per call.
struct Progress {
    /// name of the stage, such as "read" or "voxelize", and the fraction of it that is done, 0..1
    std::function<void(std::string_view stage, double fraction)> report;
    /// set to true to stop; the call then returns Code::Cancelled
    std::atomic<bool> cancel{false};

    static void tell(const Progress* progress, std::string_view stage, double fraction) {
        if (progress != nullptr && progress->report) progress->report(stage, fraction);
    }
    [[nodiscard]] static bool isCancelled(const Progress* progress) noexcept {
        return progress != nullptr && progress->cancel.load(std::memory_order_relaxed);
    }
};

}  // namespace svt
