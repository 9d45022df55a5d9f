#pragma once
/// \file
/// Which labels of a volume touch each other, and by how many voxel faces.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Two labels with voxels face to face.
struct Contact {
    std::uint32_t a = 0, b = 0;            ///< labels, a < b
    std::array<std::uint64_t, 3> faces{};  ///< across the x, y and z axis; a face across x has dy * dz m2
    friend bool operator==(const Contact&, const Contact&) = default;
};

/// All pairs of labels that touch, ordered by (a, b). Background touches nobody.
/// \param labelOfScalar  entry s owns scalar s, kNoLabel for none (LabelTable::labelOfScalar); scalars beyond it have
///                       none
/// \param threads        0: all cores; the result does not depend on it
/// Cost: O(runs of neighbouring columns that differ), each pair of a distinct row once, not the volume.
[[nodiscard]] std::vector<Contact> labelContacts(const ColumnVolume& columns,
                                                 std::span<const std::uint32_t> labelOfScalar, int threads = 0);

}  // namespace svt::volume
