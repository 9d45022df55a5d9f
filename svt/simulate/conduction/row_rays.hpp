#pragma once
/// \file
/// The labels along all rows of voxels of one axis, by one ray per row through the model's faces.

#include <svt/render/face_model.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::simulate {

/// The part of a row from `from` to the next part.
struct RowPart {
    double from = 0;  ///< voxels from the lower side of the grid: voxel i is [i, i + 1]
    volume::Scalar scalar = 0;
    float slope = 1;       ///< of the face at `from`: the amount of its normal along the axis, in metres
    float upwards = 0;     ///< of this normal, turned towards higher voxels: the part along z
    bool hasFace = false;  ///< false: no face of the model is there, and the normal is along the axis
};

/// Immutable. Thread-safe to read.
class RowRays {
public:
    /// Cost: that of FaceModel::walk() for each row. Memory: 32 bytes a part.
    RowRays(const volume::SemanticVolume& volume, const volume::BrickVolume& bricks, const render::FaceModel& faces,
            int axis, int threads);

    /// The parts of the row through a voxel; never empty, the first from 0.
    [[nodiscard]] std::span<const RowPart> row(Vec3i voxel) const noexcept;
    [[nodiscard]] std::size_t rows() const noexcept;
    /// The first voxel of a row by its number.
    [[nodiscard]] Vec3i firstVoxel(std::size_t row) const noexcept;

private:
    struct Block {
        std::vector<RowPart> parts;
        std::vector<std::uint32_t> start;  // of each row; one more at the end
    };
    int axis_;
    Vec3i size_;
    std::vector<Block> blocks_;
};

}  // namespace svt::simulate
