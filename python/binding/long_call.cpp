#include "long_call.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace svt::python {
namespace {

// State that the working thread and the calling thread share.
struct Shared {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::pair<std::string, double>> reports;
    bool isDone = false;
    std::exception_ptr thrown;
};

// Requires the GIL. Throws Python exceptions as py::error_already_set.
void tell(const py::object& report, std::deque<std::pair<std::string, double>>& reports) {
    for (const auto& [stage, fraction] : reports) report(stage, fraction);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void runLong(const py::object& report, const std::function<void(const Progress*)>& work) {
    constexpr std::chrono::milliseconds kPause(50);
    Shared shared;
    Progress progress;
    if (!report.is_none())
        progress.report = [&shared](std::string_view stage, double fraction) {
            const std::lock_guard lock(shared.mutex);
            shared.reports.emplace_back(stage, fraction);
            shared.changed.notify_one();
        };
    std::optional<py::error_already_set> raised;
    const py::gil_scoped_release released;
    std::thread worker([&] {
        std::exception_ptr thrown;
        try {
            work(&progress);
        } catch (...) {
            thrown = std::current_exception();
        }
        const std::lock_guard lock(shared.mutex);
        shared.thrown = thrown;
        shared.isDone = true;
        shared.changed.notify_one();
    });
    while (true) {
        std::deque<std::pair<std::string, double>> reports;
        bool isDone = false;
        {
            std::unique_lock lock(shared.mutex);
            shared.changed.wait_for(lock, kPause, [&] { return shared.isDone || !shared.reports.empty(); });
            isDone = shared.isDone;
            reports.swap(shared.reports);
        }
        if (!raised) {
            const py::gil_scoped_acquire acquired;
            try {
                tell(report, reports);
            } catch (py::error_already_set& error) {
                raised.emplace(std::move(error));
                progress.cancel = true;
            }
        }
        if (isDone) break;
    }
    worker.join();
    if (raised) {
        const py::gil_scoped_acquire acquired;
        py::error_already_set error = std::move(*raised);
        raised.reset();
        throw error;
    }
    if (shared.thrown) std::rethrow_exception(shared.thrown);
}

}  // namespace svt::python
