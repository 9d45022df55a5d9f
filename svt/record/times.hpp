#pragma once
/// \file
/// Times in tables: seconds, or ISO 8601 texts.

#include <optional>
#include <string>
#include <string_view>

namespace svt::record {

struct IsoTime {
    double seconds = 0;  ///< since 1970-01-01T00:00:00Z; of the zone, or else as if the zone were UTC
    bool hasZone = false;
};

/// Reads `YYYY-MM-DD`, followed by nothing or by `T` or a blank, `HH:MM`, seconds with a fraction or none, and `Z`, an
/// offset such as `+01:00`, `+0100` or `+01`, or nothing. Leap seconds count as the last second of the minute.
/// \return nothing for any other text, and for dates that do not exist
[[nodiscard]] std::optional<IsoTime> parseIsoTime(std::string_view text) noexcept;

/// "2026-01-05T00:00:00Z"; with milliseconds if the seconds are not whole.
[[nodiscard]] std::string isoText(double seconds);

/// Reads the times of a file: seconds, or ISO 8601 texts. The first time decides for all.
class TimeReader {
public:
    /// \param number  of the text, if it is one
    /// \param to      receives the time; of dates, seconds since 1970
    /// \param fault   receives the reason of a failure
    /// \return whether the text is a time of the same kind as the first one
    [[nodiscard]] bool read(std::string_view text, std::optional<double> number, double& to, std::string& fault);
    [[nodiscard]] bool isDated() const noexcept { return isDated_; }
    /// Whether the times are dates without a zone.
    [[nodiscard]] bool hasNoZone() const noexcept { return hasNoZone_; }

private:
    bool isFirst_ = true, isDated_ = false, hasNoZone_ = false;
};

}  // namespace svt::record
