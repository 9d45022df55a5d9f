#pragma once
/// \file
/// Progress reports and cancellation of long calls.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>

namespace svt {

/// The caller passes it to long calls, and can cancel them from another thread. `report` is called by one thread at a
/// time, at most a few hundred times per call.
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

/// Reports the completed fraction of a stage, at most a hundred times. For loops whose threads count their completed
/// items.
class ProgressCounter {
public:
    /// \param progress  may be null
    /// \param stage     must outlive the counter
    /// \param total     of the counts passed to add()
    ProgressCounter(const Progress* progress, std::string_view stage, std::uint64_t total)
        : progress_(progress), stage_(stage), total_(std::max<std::uint64_t>(total, 1)) {
        Progress::tell(progress_, stage_, 0);
    }

    /// Threads: any. Skips the report if another thread is reporting.
    void add(std::uint64_t count = 1) {
        if (progress_ == nullptr) return;
        const std::uint64_t done = done_.fetch_add(count, std::memory_order_relaxed) + count;
        const double share = std::min(1.0, double(done) / double(total_));
        const int percent = static_cast<int>(share * 100);
        if (percent <= told_.load(std::memory_order_relaxed)) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock || percent <= told_.load(std::memory_order_relaxed)) return;
        told_.store(percent, std::memory_order_relaxed);
        Progress::tell(progress_, stage_, share);
    }

private:
    const Progress* progress_;
    std::string_view stage_;
    std::uint64_t total_;
    std::atomic<std::uint64_t> done_{0};
    std::atomic<int> told_{0};
    std::mutex mutex_;
};

}  // namespace svt
