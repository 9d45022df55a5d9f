#pragma once
/// \file
/// Vector geometry of a model, stored with its voxels: feature edges and triangles, each with its label.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Lines and triangles by label. Points are integer multiples of `unit`, relative to Grid::origin(), along the axes of
/// world space (also in a rotated grid). Memory and file hold the same numbers; rounding moves a point by at most half
/// a unit per axis.
struct VectorParts {
    /// Unit of models within 1 km of the grid's lower corner, metres: about a micrometre.
    static constexpr double kFinestUnit = 0x1p-20;
    static constexpr double kCoarsestUnit = 0x1p-10;  ///< metres

    struct Segment {
        std::uint32_t label = 0;              ///< index into LabelTable::labels
        std::array<std::uint32_t, 2> ends{};  ///< indices into points
        friend bool operator==(const Segment&, const Segment&) = default;
    };
    struct Triangle {
        std::uint32_t label = 0;
        std::array<std::uint32_t, 3> corners{};  ///< counter-clockwise from outside
        friend bool operator==(const Triangle&, const Triangle&) = default;
    };

    double unit = kFinestUnit;  ///< metres, a power of two from kFinestUnit to kCoarsestUnit
    std::vector<Vec3i> points;
    std::vector<Segment> segments;    ///< labels ascend
    std::vector<Triangle> triangles;  ///< labels ascend

    [[nodiscard]] bool isEmpty() const noexcept { return segments.empty() && triangles.empty(); }
    /// Position of a point in world space, metres.
    /// \param origin  Grid::origin()
    [[nodiscard]] Vec3d position(std::uint32_t point, Vec3d origin) const noexcept {
        const Vec3i p = points[point];
        return origin + toDouble(p) * unit;
    }
    friend bool operator==(const VectorParts&, const VectorParts&) = default;
};

/// The triangles of a label. Cost: O(log n) for n triangles of all labels.
[[nodiscard]] std::span<const VectorParts::Triangle> trianglesOf(const VectorParts& parts,
                                                                 std::uint32_t label) noexcept;

/// A digest of the places of the corners, with their orientation, from any first corner. The sum over the triangles of a
/// label does not depend on their order.
/// \param seed  other seeds give independent digests
[[nodiscard]] std::uint64_t digestOf(const VectorParts& parts, const VectorParts::Triangle& triangle,
                                     std::uint64_t seed = 1) noexcept;

/// Checks parts from an untrusted source.
/// \return success, or BadVolume that names the unit if it is invalid, or the part that is out of order or refers to a
///         missing label or point
[[nodiscard]] Result<void> checkVectorParts(const VectorParts& parts, std::size_t labelCount);

/// The parts as one zstd frame, see docs/formats/svt.md. Equal parts give equal bytes.
/// \return the frame, or BadArgument if the parts take more than 4 GiB, or more than 1 MiB + 1024 times the frame
[[nodiscard]] Result<std::vector<std::byte>> compressVectorParts(const VectorParts& parts);

/// Decompresses parts. Safe for any bytes: everything is checked before it is used or allocated. Memory is bounded by
/// 8 MiB + 8192 times the frame.
/// \return the parts, or BadVolume
[[nodiscard]] Result<VectorParts> readVectorParts(std::span<const std::byte> frame, std::size_t labelCount);

/// The same for the frame of older files, with points in 0.1 mm (`meshes/parts`).
[[nodiscard]] Result<VectorParts> readTenthParts(std::span<const std::byte> frame, std::size_t labelCount);

}  // namespace svt::volume
