#include <bench/report.hpp>

#include <fmt/format.h>

#include <cctype>

namespace svt::bench {
namespace {

double ratioOf(const Row& row, const Comparison& comparison) {
    return row.ours.median > 0 ? comparison.measurement.median / row.ours.median : 0;
}

Json measurementJson(const Measurement& m) {
    Json json{{"name", m.name}, {"median_s", m.median}, {"least_s", m.least}, {"most_s", m.most}, {"runs", m.runs}};
    if (m.peakBytes != 0) json["peak_bytes"] = m.peakBytes;
    return json;
}

}  // namespace

std::string slug(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 3, " x ") == 0) {
            result += 'x';
            i += 2;
        } else if (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.') {
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
        } else if (!result.empty() && result.back() != '-') {
            result += '-';
        }
    }
    while (!result.empty() && result.back() == '-') result.pop_back();
    return result;
}

std::string bytesText(std::uint64_t bytes) {
    const double megabytes = double(bytes) / 1e6;
    if (megabytes >= 100) return fmt::format("{:.0f} MB", megabytes);
    return megabytes >= 0.01 ? fmt::format("{:.2f} MB", megabytes) : fmt::format("{:.1f} KB", megabytes * 1e3);
}

std::string Row::id() const { return slug(stage) + '/' + slug(input) + '/' + slug(size); }

Json Report::json() const {
    Json list = Json::array();
    for (const Row& row : rows) {
        Json entry{{"id", row.id()},
                   {"stage", row.stage},
                   {"input", row.input},
                   {"size", row.size},
                   {"ours", measurementJson(row.ours)}};
        if (row.isStage) entry["is_stage"] = true;
        if (row.yardsticks > 0) entry["yardsticks"] = row.yardsticks;
        if (row.resultBytes != 0) entry["result_bytes"] = row.resultBytes;
        if (!row.note.empty()) entry["note"] = row.note;
        for (const auto& [key, value] : row.extra.items()) entry[key] = value;
        for (const Comparison& comparison : row.comparisons) {
            Json other = measurementJson(comparison.measurement);
            other["is_peer"] = comparison.isPeer;
            other["ratio"] = ratioOf(row, comparison);
            if (!comparison.note.empty()) other["note"] = comparison.note;
            for (const auto& [key, value] : comparison.extra.items()) other[key] = value;
            entry["beside"].push_back(std::move(other));
        }
        for (const std::string& missing : row.missing) entry["missing"].push_back(missing);
        list.push_back(std::move(entry));
    }
    return {{"machine", machine}, {"results", std::move(list)}, {"skipped", skipped}};
}

}  // namespace svt::bench
