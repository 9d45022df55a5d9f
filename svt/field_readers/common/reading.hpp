#pragma once
/// \file
/// Code of all formats: the request, the choice of times, the bound of memory, names, units and notes.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/field_readers/read_fields.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::field_readers {

/// A call of readFields() while it runs.
struct Reading {
    const std::filesystem::path& path;
    const volume::SemanticVolume& volume;
    const FieldReadOptions& options;
    Diagnostics& diagnostics;
    std::uint64_t usedBytes = 0;  ///< of the values so far

    void note(std::string message, std::string file = {}) const;
    void warn(Code code, std::string message, std::string file = {}) const;
    /// Counts the values of a further field.
    /// \return InputTooBig if they exceed FieldReadOptions::maxBytes
    [[nodiscard]] Result<void> addValues(std::uint64_t places, std::uint64_t times, std::string_view name);
};

/// Assumptions about a field, in the order in which they were made. They become FieldHead::parameters.
class Assumptions {
public:
    void add(std::string key, std::string text) { texts_.emplace_back(std::move(key), std::move(text)); }
    /// A JSON object with a string for each.
    [[nodiscard]] std::string json() const;

private:
    std::vector<std::pair<std::string, std::string>> texts_;
};

/// An error of a file.
[[nodiscard]] Error badField(std::string message, const std::filesystem::path& file, std::uint64_t line = 0);

/// Whether a cell of a table stands for a missing value: empty, NaN, NA, N/A, null, none, or a dash, whatever its case.
[[nodiscard]] bool isMissingCell(std::string_view cell) noexcept;

/// A name that FieldHead allows: "SOOT DENSITY" becomes "soot_density".
/// \param otherwise  for a text without letters
[[nodiscard]] std::string fieldName(std::string_view text, std::string_view otherwise);

/// Whether a quantity is asked for by FieldReadOptions::quantity: it is empty, or one of the texts, ignoring letter case.
[[nodiscard]] bool isAskedFor(const FieldReadOptions& options, std::span<const std::string_view> texts);

/// The times to keep, as indices: within FieldReadOptions::firstTime and lastTime, and timeStep apart.
/// \param times  ascending
/// \return or BadArgument with the span of the times, if none is left
[[nodiscard]] Result<std::vector<std::size_t>> keptTimes(std::span<const double> times, const Reading& reading,
                                                         std::string_view name);

/// Sets FieldHead::unit from that of the file and FieldReadOptions::unit, and converts the values between Cel and K.
/// \param fileUnit  as in the file; empty: unknown
/// \return nothing, or BadArgument where the units do not fit or none is known
[[nodiscard]] Result<void> setUnit(fields::Field& field, std::string_view fileUnit, const Reading& reading,
                                   Assumptions& assumptions);

/// Sets FieldHead::precision to that of the options, or else to fields::precisionFor() of the values.
void setPrecision(fields::Field& field, const Reading& reading, Assumptions& assumptions);

}  // namespace svt::field_readers
