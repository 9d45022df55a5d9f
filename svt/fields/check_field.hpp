#pragma once
/// \file
/// The invariants of a field. Readers and writers of fields call these before they trust one.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>

#include <cstddef>
#include <cstdint>

namespace svt::fields {

inline constexpr std::size_t kMaxFields = 1000;                  ///< in a file
inline constexpr std::size_t kMaxNameBytes = 100;                ///< of the name of a field
inline constexpr std::size_t kMaxTimes = std::size_t{1} << 20;   ///< of a field
inline constexpr std::size_t kMaxPoints = std::size_t{1} << 20;  ///< of a field
inline constexpr std::int32_t kMaxNodes = 1 << 20;               ///< of a lattice along an axis
/// Places of a lattice are at most this far from the origin of the index space, so that voxels have whole numbers.
inline constexpr double kMaxPlace = 1 << 29;

/// Checks the numbers of nodes, first node and steps; or the positions.
/// \return success, or BadField
[[nodiscard]] Result<void> checkLattice(const Lattice& lattice);

/// Checks everything in a head: names, unit, times, lattice, points, precision. Also that the number of values is below 2^40.
/// \return success, or BadField that names the field and the member
[[nodiscard]] Result<void> checkHead(const FieldHead& head);

/// checkHead(), and that the values are times * components * places.
/// \param labelCount  entries of the volume's label table
/// \return success, or BadField
[[nodiscard]] Result<void> checkField(const Field& field, std::size_t labelCount);

/// Number of values of a field: times * components * places.
[[nodiscard]] std::uint64_t valueCount(const FieldHead& head, std::size_t labelCount) noexcept;

}  // namespace svt::fields
