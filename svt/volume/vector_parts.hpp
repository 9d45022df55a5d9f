#pragma once
/// \file
/// Parts of a model that are kept beside its voxels as they were drawn: feature edges and triangles, each with the
/// label that it belongs to.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Lines and triangles by label. Points are whole numbers of kUnit from Grid::origin() along the axes of world space
/// (not of a turned grid), so memory and file hold the same: at most 0.05 mm per axis beside the model's point.
struct VectorParts {
    static constexpr double kUnit = 1e-4;  ///< metres

    struct Segment {
        std::uint32_t label = 0;              ///< into LabelTable::labels
        std::array<std::uint32_t, 2> ends{};  ///< into points
        friend bool operator==(const Segment&, const Segment&) = default;
    };
    struct Triangle {
        std::uint32_t label = 0;
        std::array<std::uint32_t, 3> corners{};  ///< counter-clockwise from outside
        friend bool operator==(const Triangle&, const Triangle&) = default;
    };

    std::vector<Vec3i> points;
    std::vector<Segment> segments;    ///< labels ascend
    std::vector<Triangle> triangles;  ///< labels ascend

    [[nodiscard]] bool isEmpty() const noexcept { return segments.empty() && triangles.empty(); }
    /// World space, metres. \param origin  Grid::origin()
    [[nodiscard]] Vec3d position(std::uint32_t point, Vec3d origin) const noexcept {
        const Vec3i p = points[point];
        return origin + Vec3d{double(p.x), double(p.y), double(p.z)} * kUnit;
    }
    friend bool operator==(const VectorParts&, const VectorParts&) = default;
};

/// \return BadVolume that says which part names a label or point that there is none of, or is out of order
[[nodiscard]] Result<void> checkVectorParts(const VectorParts& parts, std::size_t labelCount);

/// The parts as one zstd frame, see docs/formats/svt.md. Equal parts give equal bytes.
/// \return the frame, or BadArgument where the parts take over 4 GiB, or over 1 MiB + 1024 times the frame
[[nodiscard]] Result<std::vector<std::byte>> compressVectorParts(const VectorParts& parts);

/// Any bytes are safe: everything is checked before it is used or allocated; memory is bounded by 8 MiB + 8192 times
/// the frame. \return the parts, or BadVolume
[[nodiscard]] Result<VectorParts> readVectorParts(std::span<const std::byte> frame, std::size_t labelCount);

}  // namespace svt::volume
