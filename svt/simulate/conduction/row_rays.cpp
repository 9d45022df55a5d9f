#include <svt/simulate/conduction/row_rays.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace svt::simulate {
namespace {

constexpr std::size_t kRowsOfBlock = 128;

// The axes across: the first runs fastest in the numbers of rows.
constexpr int firstAcross(int axis) noexcept { return axis == 0 ? 1 : 0; }
constexpr int secondAcross(int axis) noexcept { return axis == 2 ? 1 : 2; }

class PartCollector final : public render::RunVisitor {
public:
    PartCollector(const volume::Grid& grid, const volume::BrickVolume& bricks, int axis, std::vector<RowPart>& parts)
        : grid_(grid), bricks_(bricks), axis_(axis), parts_(parts) {}

    // Surfaces without an inside do not conduct.
    [[nodiscard]] bool isDrawn(volume::Scalar) const override { return false; }
    bool enter(volume::Scalar scalar, double from, const render::RunStart& start) override {
        RowPart& part = parts_.emplace_back();
        part.from = from;
        part.scalar = scalar;
        part.upwards = axis_ == 2 ? 1.0f : 0.0f;
        Vec3d normal{};  // along the grid's axes
        if (start.normal != nullptr) {
            for (int a = 0; a < 3; ++a) normal[a] = dot(*start.normal, grid_.axes()[static_cast<std::size_t>(a)]);
        } else if (start.plane != volume::BrickVolume::kNoPlane) {
            const Vec3d& own = bricks_.planes()[start.plane].normal;
            normal = normalized(Vec3d{own.x / grid_.spacing().x, own.y / grid_.spacing().y, own.z / grid_.spacing().z});
        } else {
            return false;
        }
        if (normal[axis_] == 0) return false;
        part.hasFace = true;
        part.slope = static_cast<float>(std::abs(normal[axis_]));
        part.upwards = static_cast<float>(normal[axis_] < 0 ? -normal.z : normal.z);
        return false;
    }
    bool leave(volume::Scalar, double, double) override { return false; }

private:
    const volume::Grid& grid_;
    const volume::BrickVolume& bricks_;
    int axis_;
    std::vector<RowPart>& parts_;
};

}  // namespace

RowRays::RowRays(const volume::SemanticVolume& volume, const volume::BrickVolume& bricks,
                 const render::FaceModel& faces, int axis, int threads)
    : axis_(axis), size_(volume.grid.dimension()) {
    const auto across = static_cast<std::size_t>(size_[firstAcross(axis)]);
    const std::size_t rows = across * static_cast<std::size_t>(size_[secondAcross(axis)]);
    blocks_.resize((rows + kRowsOfBlock - 1) / kRowsOfBlock);
    Vec3d along{};
    along[axis] = 1;
    parallelFor(blocks_.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            Block& block = blocks_[b];
            for (std::size_t r = b * kRowsOfBlock; r < std::min((b + 1) * kRowsOfBlock, rows); ++r) {
                block.start.push_back(static_cast<std::uint32_t>(block.parts.size()));
                Vec3d from{};
                const std::size_t row = r / across;
                from[firstAcross(axis)] = double(r % across) + 0.5;
                from[secondAcross(axis)] = double(row) + 0.5;
                PartCollector collector(volume.grid, bricks, axis, block.parts);
                faces.walk(bricks, render::VoxelRay(from, along), volume.grid.spacing()[axis], 0, size_[axis],
                           collector);
                // The walk begins with the owner of the start, so a row has a part.
                block.parts[block.start.back()].from = 0;
            }
            block.start.push_back(static_cast<std::uint32_t>(block.parts.size()));
            block.parts.shrink_to_fit();
        }
    });
}

std::size_t RowRays::rows() const noexcept {
    return static_cast<std::size_t>(size_[firstAcross(axis_)]) * static_cast<std::size_t>(size_[secondAcross(axis_)]);
}

Vec3i RowRays::firstVoxel(std::size_t row) const noexcept {
    const auto across = static_cast<std::size_t>(size_[firstAcross(axis_)]);
    Vec3i voxel{};
    voxel[firstAcross(axis_)] = static_cast<std::int32_t>(row % across);
    voxel[secondAcross(axis_)] = static_cast<std::int32_t>(row / across);
    return voxel;
}

std::span<const RowPart> RowRays::row(Vec3i voxel) const noexcept {
    const std::size_t r =
        static_cast<std::size_t>(voxel[firstAcross(axis_)]) +
        static_cast<std::size_t>(size_[firstAcross(axis_)]) * static_cast<std::size_t>(voxel[secondAcross(axis_)]);
    const Block& block = blocks_[r / kRowsOfBlock];
    const std::size_t n = r % kRowsOfBlock;
    return std::span(block.parts).subspan(block.start[n], block.start[n + 1] - block.start[n]);
}

}  // namespace svt::simulate
