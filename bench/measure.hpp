#pragma once
/// \file
/// Timing in turns: A B C A B C ..., so that what else the machine does hits all alike. Medians, not means. A short
/// contestant runs several times in each of its turns, so that it is seen at steady work and not just after another one
/// has let a core fall asleep and filled the caches.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace svt::bench {

/// One thing that is timed. `run` must do all its work before it returns.
struct Contestant {
    std::string name;
    std::function<void()> run;
};

/// What was measured of a contestant.
struct Measurement {
    std::string name;
    double median = 0;            ///< seconds, wall clock
    double least = 0, most = 0;   ///< seconds
    int runs = 0;                 ///< timed turns, the warm-up not counted
    std::uint64_t peakBytes = 0;  ///< most memory over what was there before, in the warm-up run; 0: not known
};

struct MeasureOptions {
    double secondsATurn = 0.15;  ///< a turn repeats what takes less, and counts as the median of its runs
    int leastRuns = 5;
    int mostRuns = 15;
    double secondsInAll = 12;  ///< no new round begins after this, once all had `leastRuns`
    double secondsEach =
        8;  ///< a contestant that has used this much after three runs, or four times this after any, stops
};

/// Runs all contestants once to warm up (and for the memory), then in turns.
/// \return one per contestant, same order
[[nodiscard]] std::vector<Measurement> measureInTurns(const std::vector<Contestant>& contestants,
                                                      const MeasureOptions& options);

/// A fixed piece of work, about 50 ms on one core of a 2023 server: sorting 2^19 numbers of a fixed sequence, then
/// adding up a block of 64 MB. Stages without a peer are compared with it, so that a stored figure means something on
/// another machine.
void yardstick();

/// Bytes of memory that `run` needs at most beyond what the process has when it begins. 0 where the system does not
/// tell.
[[nodiscard]] std::uint64_t peakMemoryOf(const std::function<void()>& run);

}  // namespace svt::bench
