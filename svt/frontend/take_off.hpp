#pragma once
/// \file
/// The take-off of `svt quantities`: objects with their quantities, and sums of them, as tables and as JSON.

#include <svt/quantities/quantities.hpp>
#include <svt/quantities/touching_faces.hpp>
#include <svt/record/record.hpp>
#include <svt/writers/table.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::frontend {

using record::Json;
using writers::Cell, writers::Column, writers::Row, writers::Table;

/// The rows of a take-off, with the figures that were asked for beside the quantities.
struct TakeOff {
    const volume::SemanticVolume& volume;
    std::vector<quantities::ObjectQuantities> objects{};
    std::vector<quantities::CountedVolume> counted{};  ///< by object
    bool hasExterior = false, hasFormwork = false;     ///< asked for
    /// By object and quantities::Facing: m2 that outside air touches. Empty if not asked for.
    std::vector<std::optional<std::array<double, 10>>> exterior{};
    std::vector<std::optional<double>> exteriorCounted{};  ///< by object, m2 of it: TouchingArea::countedArea
    std::vector<std::optional<double>> formwork{};         ///< by object, m2; likewise
    std::vector<std::optional<double>> formworkTop{};      ///< by object, m2 of these faces that look up
    std::vector<std::string> storeys{};                    ///< by object
    std::vector<std::string> materials{};                  ///< by object
    std::vector<std::string> keys{};                       ///< of --by
    std::vector<std::vector<std::string>> values{};        ///< by object and key
};

/// One row per object, then the sum. \param hasSum  the last row is the sum of all
[[nodiscard]] Table takeOffTable(const TakeOff& takeOff, bool hasSum);

/// One row for each combination of the values of the keys. \param hasSum  the last row is the sum of all
[[nodiscard]] Table takeOffSums(const TakeOff& takeOff, bool hasSum);

/// Sums over several take-offs with the same keys and figures, such as the tiles of a city.
class TakeOffTotals {
public:
    TakeOffTotals();
    TakeOffTotals(TakeOffTotals&&) noexcept;
    TakeOffTotals& operator=(TakeOffTotals&&) noexcept;
    ~TakeOffTotals();

    /// Cost: O(objects * log(combinations of values)).
    void add(const TakeOff& takeOff);

    [[nodiscard]] std::size_t objects() const noexcept;
    /// The sum of all, for the end of takeOffTable().
    [[nodiscard]] Row totalRow() const;
    /// As takeOffSums().
    [[nodiscard]] Table sums(bool hasSum) const;
    /// Members of takeOffJson(): an array; the sum of all.
    [[nodiscard]] Json sumsJson() const;
    [[nodiscard]] Json totalJson() const;
    /// As takeOffNotes(). \param hasGross  whether unknown gross volumes have a note: buildings do not have any
    [[nodiscard]] std::vector<std::string> notes(bool hasGross = true) const;

private:
    struct All;
    std::unique_ptr<All> all_;
};

/// A measured quantity by its name in sets `Qto_...` of IFC: m, m2, m3.
struct StatedFigure {
    std::string_view name;
    double value = 0;
};
/// The known quantities of an object that such sets name.
[[nodiscard]] std::vector<StatedFigure> statedFigures(const quantities::ObjectQuantities& object);

/// Quantities that the file states, beside the measured ones: one row per object and quantity.
[[nodiscard]] Table statedTable(const TakeOff& takeOff);

/// The table that files have: the stated quantities, else the sums if there are keys, else the rows.
/// \param hasSum  of rows and sums: the last row is the sum of all
[[nodiscard]] Table chosenTable(const TakeOff& takeOff, bool hasStated, bool hasSum);

/// See docs/user/json.md. \param hasStated  adds the rows of statedTable()
[[nodiscard]] Json takeOffJson(const TakeOff& takeOff, bool hasStated);

/// The JSON as a file, byte for byte what `svt quantities -o F.json` writes. Invalid UTF-8 is replaced.
[[nodiscard]] std::string takeOffFile(const TakeOff& takeOff, bool hasStated);

/// An entry of `rows`, and one of `exterior`, of takeOffJson(). \param n  number of the object
[[nodiscard]] Json takeOffRowJson(const TakeOff& takeOff, std::size_t n);
[[nodiscard]] Json takeOffExteriorJson(const TakeOff& takeOff, std::size_t n);

/// The assumptions of the figures, as sentences.
[[nodiscard]] std::vector<std::string> takeOffAssumptions(const TakeOff& takeOff);

/// Notes on quantities that sums exclude, and on volumes counted in voxels.
[[nodiscard]] std::vector<std::string> takeOffNotes(const TakeOff& takeOff);

}  // namespace svt::frontend
