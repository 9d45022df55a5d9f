#pragma once
/// \file
/// Times as ISO 8601 texts.

#include <optional>
#include <string>
#include <string_view>

namespace svt::field_readers {

struct IsoTime {
    double seconds = 0;  ///< since 1970-01-01T00:00:00Z; of the zone, or else as if the zone were UTC
    bool hasZone = false;
};

/// Reads `YYYY-MM-DD`, followed by nothing or by `T` or a blank, `HH:MM`, seconds with a fraction or none, and `Z`, an offset
/// such as `+01:00`, `+0100` or `+01`, or nothing. Leap seconds count as the last second of the minute.
/// \return nothing for any other text, and for dates that do not exist
[[nodiscard]] std::optional<IsoTime> parseIsoTime(std::string_view text) noexcept;

/// "2026-01-05T00:00:00Z"; with milliseconds if the seconds are not whole.
[[nodiscard]] std::string isoText(double seconds);

}  // namespace svt::field_readers
