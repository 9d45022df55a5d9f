#pragma once
/// \file
/// Everything that was measured, as rows of JSON. scripts/bench.py makes the tables.

#include <bench/measure.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::bench {

using Json = nlohmann::ordered_json;

/// A peer (or another way to run ours) beside our time of the same row.
struct Beside {
    Measurement measurement;
    std::string note;  ///< how it agrees with ours, or what it leaves out
    Json extra = Json::object();
    bool isPeer = true;  ///< false: ours, run in another way; no ratio is watched
};

/// One piece of work.
struct Row {
    std::string stage;  ///< "voxelize"
    std::string input;  ///< "FZK-Haus"
    std::string size;   ///< "800 x 700 x 400", or what else says how much
    Measurement ours;
    std::string note;
    Json extra = Json::object();
    std::vector<Beside> beside;
    std::vector<std::string> missing;  ///< peers that were not there, with the reason
    bool isStage = false;              ///< stands in the table of stages: time, memory, size
    double yardsticks = 0;             ///< our time in units of yardstick(); 0 where it was not run beside
    std::uint64_t resultBytes = 0;     ///< size of what the stage makes; 0: not told

    /// "voxelize/fzk-haus/800x700x400"
    [[nodiscard]] std::string id() const;
};

struct Report {
    Json machine;
    std::vector<Row> rows;
    std::vector<std::string> skipped;  ///< inputs that were not there

    [[nodiscard]] Json json() const;
};

/// Lower case, words joined by '-'; "800 x 700 x 400" is "800x700x400".
[[nodiscard]] std::string slug(const std::string& text);
/// "1.23 MB" (10^6)
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace svt::bench
