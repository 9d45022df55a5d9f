#pragma once
/// \file
/// A field: numbers with a unit, over time, beside the labels of a volume. Temperature, smoke, or the values of sensors.
///
///     kind   | values stand at                              | examples
///     grid   | the nodes of a lattice in the volume's index space | temperature, soot density
///     label  | the components of the volume                 | heating power of a room
///     points | named points                                 | sensors, probes
///
/// Values never cross a wall: a sampler interpolates only within the medium of the field (see FieldSampler).

#include <svt/core/names.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace svt::fields {

enum class FieldKind : std::uint8_t { Grid, Label, Points };
constexpr auto namesOf(FieldKind) {
    return std::to_array<Name<FieldKind>>(
        {{FieldKind::Grid, "grid"}, {FieldKind::Label, "label"}, {FieldKind::Points, "points"}});
}

/// The nodes of a grid field, in the index space of the volume: a node at (1, 2, 3) is the centre of voxel (1, 2, 3).
/// So a lattice follows a rotated grid. x runs fastest: node (i, j, k) has the index i + size.x * (j + size.y * k).
struct Lattice {
    Vec3i size{};         ///< nodes per axis, each at least 1
    Vec3d first{};        ///< node (0, 0, 0)
    Vec3d step{1, 1, 1};  ///< between nodes, each above 0
    /// Positions of the nodes of a rectilinear lattice, strictly ascending, one list per axis with `size` entries. All empty for
    /// a regular lattice; then `first` and `step` count.
    std::array<std::vector<double>, 3> positions;

    friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// A named point of a field of points.
struct FieldPoint {
    std::string id;
    Vec3d at{};  ///< world space, metres

    friend bool operator==(const FieldPoint&, const FieldPoint&) = default;
};

/// Everything about a field except its values.
struct FieldHead {
    std::string name;  ///< unique in its volume: letters, digits, '_', '-', '.'; starts with a letter
    FieldKind kind = FieldKind::Grid;
    std::string quantity;         ///< such as "temperature"; may be empty
    std::string unit;             ///< UCUM code, such as "Cel", "kg/m3"; "1" for a number without unit
    std::int32_t components = 1;  ///< 1, or 3 for vectors along x, y, z of the volume's index space
    /// The voxels that have values: "air" (empty space and rooms), "solid", "all", or a query such as "class=Slab".
    std::string medium = "all";
    Lattice lattice;                   ///< of a grid field
    std::vector<FieldPoint> points;    ///< of a field of points
    std::vector<double> times{0};      ///< seconds, strictly ascending, at least one
    std::optional<std::string> epoch;  ///< date and time of 0 s, ISO 8601 with zone
    /// Step between stored values, in the unit: values are rounded to multiples of it. 0 stores 32-bit floats as they are.
    double precision = 0;
    std::string by;          ///< program that made the values
    std::string parameters;  ///< JSON object of everything that was assumed for the values, or empty

    friend bool operator==(const FieldHead&, const FieldHead&) = default;
};

/// A field with all values in memory.
struct Field {
    FieldHead head;
    /// NaN where a value is missing. Time is slowest, then component, then place: the nodes of the lattice; the entries of the
    /// volume's label table in their order; or the points.
    std::vector<float> values;
};

/// Places of a field: nodes, labels or points.
/// \param labelCount  entries of the volume's label table, for fields of kind Label
[[nodiscard]] std::size_t placeCount(const FieldHead& head, std::size_t labelCount) noexcept;

/// The lengths of the vectors of a field, as a field of one component; NaN where a component is missing.
[[nodiscard]] Field lengthsOf(const Field& vectors);

/// The least and the greatest of all values, in the unit of the field; nothing if all values are missing.
[[nodiscard]] std::optional<std::pair<float, float>> rangeOf(const Field& field) noexcept;

}  // namespace svt::fields
