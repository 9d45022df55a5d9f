#pragma once
/// \file
/// How a long call tells where it is, and how it is told to stop.

#include <atomic>
#include <functional>
#include <string_view>

namespace svt {

/// Given to long calls by the caller, who may be on another thread.
/// `report` is called from one thread at a time, at most a few hundred times a call.
struct Progress {
    /// stage such as "read" or "voxelize", and how much of it is done, 0..1
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
