#include <bench/report.hpp>

#include <fmt/format.h>

#include <cctype>

namespace svt::bench {
namespace {

// Lower case, words joined by '-'; "800 x 700 x 400" is "800x700x400".
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

double ratioOf(const Row& row, const Beside& beside) {
    return row.ours.median > 0 ? beside.measurement.median / row.ours.median : 0;
}

std::string ratioText(double ratio) {
    return ratio >= 10  ? fmt::format("{:.0f} x", ratio)
           : ratio >= 1 ? fmt::format("{:.1f} x", ratio)
                        : fmt::format("{:.2f} x", ratio);
}

Json measurementJson(const Measurement& m) {
    Json json{{"name", m.name}, {"median_s", m.median}, {"least_s", m.least}, {"most_s", m.most}, {"runs", m.runs}};
    if (m.peakBytes != 0) json["peak_bytes"] = m.peakBytes;
    return json;
}

std::string memoryText(const Measurement& m) { return m.peakBytes == 0 ? "-" : bytesText(m.peakBytes); }

}  // namespace

std::string secondsText(double seconds) {
    if (seconds >= 1) return fmt::format("{:.2f} s", seconds);
    if (seconds >= 0.1) return fmt::format("{:.0f} ms", seconds * 1e3);
    if (seconds >= 0.01) return fmt::format("{:.1f} ms", seconds * 1e3);
    return fmt::format("{:.2f} ms", seconds * 1e3);
}

std::string bytesText(std::uint64_t bytes) {
    const double megabytes = double(bytes) / 1e6;
    if (megabytes >= 100) return fmt::format("{:.0f} MB", megabytes);
    return megabytes >= 0.01 ? fmt::format("{:.2f} MB", megabytes) : fmt::format("{:.1f} KB", megabytes * 1e3);
}

std::string Row::id() const { return slug(stage) + '/' + slug(input) + '/' + slug(size); }

std::string Report::markdown() const {
    std::string text =
        "| work | input | size | SVT | beside it | its time | ratio | memory | its memory | notes "
        "|\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Row& row : rows) {
        if (row.isStage) continue;
        const std::string head =
            fmt::format("| {} | {} | {} | {} |", row.stage, row.input, row.size, secondsText(row.ours.median));
        if (row.beside.empty() && row.missing.empty())
            text += fmt::format("{} - | - | - | {} | - | {} |\n", head, memoryText(row.ours), row.note);
        for (const Beside& beside : row.beside)
            text += fmt::format("{} {} | {} | {} | {} | {} | {} |\n", head, beside.measurement.name,
                                secondsText(beside.measurement.median), ratioText(ratioOf(row, beside)),
                                memoryText(row.ours), memoryText(beside.measurement), beside.note);
        for (const std::string& missing : row.missing)
            text += fmt::format("{} - | - | - | {} | - | {} |\n", head, memoryText(row.ours), missing);
    }
    text += "\n| stage | input | size | time | most memory | result |\n|---|---|---|---|---|---|\n";
    for (const Row& row : rows) {
        if (!row.isStage) continue;
        text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.stage, row.input, row.size,
                            secondsText(row.ours.median), memoryText(row.ours),
                            row.resultBytes == 0 ? "-" : bytesText(row.resultBytes));
    }
    for (const std::string& reason : skipped) text += fmt::format("\nSkipped: {}\n", reason);
    return text;
}

Json Report::json() const {
    Json list = Json::array();
    for (const Row& row : rows) {
        Json entry{{"id", row.id()},
                   {"stage", row.stage},
                   {"input", row.input},
                   {"size", row.size},
                   {"ours", measurementJson(row.ours)}};
        if (row.yardsticks > 0) entry["yardsticks"] = row.yardsticks;
        if (row.resultBytes != 0) entry["result_bytes"] = row.resultBytes;
        if (!row.note.empty()) entry["note"] = row.note;
        for (const auto& [key, value] : row.extra.items()) entry[key] = value;
        for (const Beside& beside : row.beside) {
            Json other = measurementJson(beside.measurement);
            other["is_peer"] = beside.isPeer;
            other["ratio"] = ratioOf(row, beside);
            if (!beside.note.empty()) other["note"] = beside.note;
            for (const auto& [key, value] : beside.extra.items()) other[key] = value;
            entry["beside"].push_back(std::move(other));
        }
        for (const std::string& missing : row.missing) entry["missing"].push_back(missing);
        list.push_back(std::move(entry));
    }
    return {{"schema", 1},        {"commit", commit},           {"quick", isQuick},
            {"machine", machine}, {"results", std::move(list)}, {"skipped", skipped}};
}

}  // namespace svt::bench
