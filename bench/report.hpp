#pragma once
/// \file
/// All measurements, as rows of JSON. scripts/bench.py makes the tables.

#include <bench/measure.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::bench {

using Json = nlohmann::ordered_json;

/// The time of a peer (or of ours run in another way), compared with our time of the same row.
struct Comparison {
    Measurement measurement;
    std::string note;  ///< agreement with ours, or omissions
    Json extra = Json::object();
    bool isPeer = true;  ///< false: ours, run in another way; the ratio is not monitored
};

/// One measured task.
struct Row {
    std::string stage;  ///< "voxelize"
    std::string input;  ///< "FZK-Haus"
    std::string size;   ///< "800 x 700 x 400", or another measure of size
    Measurement ours;
    std::string note;
    Json extra = Json::object();
    std::vector<Comparison> comparisons;
    std::vector<std::string> missing;  ///< missing peers, with the reason
    bool isStage = false;              ///< belongs to the table of stages: time, memory, size
    double yardsticks = 0;             ///< our time in units of yardstick(); 0 if that was not measured
    std::uint64_t resultBytes = 0;     ///< size of the stage's output; 0: not reported

    /// "voxelize/fzk-haus/800x700x400"
    [[nodiscard]] std::string id() const;
};

struct Report {
    Json machine;
    std::vector<Row> rows;
    std::vector<std::string> skipped;  ///< missing inputs

    [[nodiscard]] Json json() const;
};

/// Lower case, words joined by '-'; "800 x 700 x 400" is "800x700x400".
[[nodiscard]] std::string slug(const std::string& text);
/// "1.23 MB" (10^6)
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace svt::bench
