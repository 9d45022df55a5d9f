#pragma once
/// \file
/// Processor time of a piece of work: what else the machine does hardly changes it, so a test may bound it.

#include <ctime>

namespace svt::test {

/// Seconds of processor time, of all threads of this process together, since the object was made.
class ProcessorTime {
public:
    [[nodiscard]] double seconds() const { return double(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
    std::clock_t start_ = std::clock();
};

}  // namespace svt::test
