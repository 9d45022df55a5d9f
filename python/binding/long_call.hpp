#pragma once
/// \file
/// Long work without the GIL, so that other Python threads continue. The work runs on a separate thread. The calling
/// thread reports progress to Python and checks for Ctrl-C several times per second. Python runs signal handlers only
/// on its main thread, which is not a thread of the library's pool.

#include "failure.hpp"

#include <svt/core/progress.hpp>

#include <functional>
#include <optional>
#include <utility>

namespace svt::python {

/// Runs `work` and returns when it has ended, even if it was cancelled.
/// \param report  None, or a function that gets (stage, fraction) on the calling thread; an exception from it stops the
///                work
/// Throws the exception of `report`, of a signal handler (KeyboardInterrupt) or of `work`, in this order.
void runLong(const py::object& report, const std::function<void(const Progress*)>& work);

/// The same for work that returns a Result; its error is thrown as Failure.
template <class Work>
auto longCall(const py::object& report, const Work& work) {
    using Returned = decltype(work(static_cast<const Progress*>(nullptr)));
    std::optional<Returned> result;
    runLong(report, [&](const Progress* progress) { result.emplace(work(progress)); });
    return valueOf(std::move(*result));
}

}  // namespace svt::python
