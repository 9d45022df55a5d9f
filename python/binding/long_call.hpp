#pragma once
/// \file
/// Long work without the GIL, so that other threads of Python go on. The work runs on a thread of its own, while the
/// calling one hands progress to Python and looks for Ctrl-C a few times a second: Python runs the handlers of signals on its
/// main thread alone, and a thread of the library's pool is not that one.

#include "failure.hpp"

#include <svt/core/progress.hpp>

#include <functional>
#include <optional>
#include <utility>

namespace svt::python {

/// Runs `work` and returns when it has ended, also where it was told to stop.
/// \param report  None, or what is called with (stage, fraction) on the calling thread; an exception of it stops the work
/// Throws what `report`, a handler of a signal (KeyboardInterrupt) or `work` throw, in this order.
void runLong(const py::object& report, const std::function<void(const Progress*)>& work);

/// The same for work that gives a Result; its error is thrown as Failure.
template <class Work>
auto longCall(const py::object& report, const Work& work) {
    using Returned = decltype(work(static_cast<const Progress*>(nullptr)));
    std::optional<Returned> result;
    runLong(report, [&](const Progress* progress) { result.emplace(work(progress)); });
    return valueOf(std::move(*result));
}

}  // namespace svt::python
