#pragma once
/// \file
/// Timing in turns: A B C A B C ..., so that other load on the machine affects all equally. Medians, not means. A short
/// contestant runs several times in each of its turns, so that it is measured in steady state and not just after
/// another has let a core sleep and filled the caches.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace svt::bench {

/// Work to be timed. `run` must do all its work before it returns.
struct Contestant {
    std::string name;
    std::function<void()> run;
};

/// The measurement of a contestant.
struct Measurement {
    std::string name;
    double median = 0;            ///< seconds, wall clock
    double least = 0, most = 0;   ///< seconds
    int runs = 0;                 ///< timed turns, without the warm-up
    std::uint64_t peakBytes = 0;  ///< peak memory above the level before, in the warm-up run; 0: unknown
};

struct MeasureOptions {
    double secondsPerTurn = 0.15;  ///< shorter work is repeated within a turn, which counts as the median of its runs
    int leastRuns = 5;
    int mostRuns = 15;
    double maxTotalSeconds = 12;  ///< no new round begins after this, once all have had `leastRuns`
    double maxSecondsPerContestant =
        8;  ///< a contestant stops once it has used this much after three runs, or four times this after any run
};

/// Runs all contestants once as warm-up (and to measure memory), then in turns.
/// \return one per contestant, same order
[[nodiscard]] std::vector<Measurement> measureInTurns(const std::vector<Contestant>& contestants,
                                                      const MeasureOptions& options);

/// A fixed piece of work, about 50 ms on one core of a 2023 server: sorts 2^19 numbers of a fixed sequence, then
/// sums a block of 64 MB. Stages without a peer are compared with it, so that stored figures can be compared with those
/// of another machine.
void yardstick();

/// Peak memory of `run` in bytes above the level at its start. 0 if unknown.
[[nodiscard]] std::uint64_t peakMemoryOf(const std::function<void()>& run);

}  // namespace svt::bench
