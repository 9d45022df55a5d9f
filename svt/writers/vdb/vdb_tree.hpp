#pragma once
/// \file
/// One tree of an OpenVDB file (5-4-3: 4096^3, 128^3 and 8^3 samples) from the columns of a volume, block by block. The
/// file contains the existing nodes with their uniform tiles (topology), then the values of the leaves (buffers).

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace svt::writers {

/// The scalars in each block of 128^3 samples.
class VdbBlocks {
public:
    static constexpr std::int32_t kSide = 128;

    /// Cost: O(samples), once. Memory: the scalars of each block, and a block.
    [[nodiscard]] static Result<VdbBlocks> of(const volume::ColumnVolume& columns, int threads,
                                              const Progress* progress);

    [[nodiscard]] Vec3i count() const noexcept { return count_; }
    [[nodiscard]] Vec3i dimension() const noexcept { return columns_.dimension(); }
    /// Includes background if it is in the block.
    [[nodiscard]] std::span<const volume::Scalar> scalars(Vec3i block) const { return scalars_[index(block)]; }
    /// The samples of a block and of `margin` around it, x fastest; those beyond the volume are background.
    void samples(Vec3i block, std::int32_t margin, std::vector<volume::Scalar>& out) const;
    [[nodiscard]] const Progress* progress() const noexcept { return progress_; }

private:
    VdbBlocks(const volume::ColumnVolume& columns, int threads, const Progress* progress);
    [[nodiscard]] std::size_t index(Vec3i block) const noexcept {
        return std::size_t(block.x) +
               std::size_t(count_.x) * (std::size_t(block.y) + std::size_t(count_.y) * std::size_t(block.z));
    }

    volume::ColumnVolume columns_;
    int threads_;
    const Progress* progress_;
    Vec3i count_;
    std::vector<std::vector<volume::Scalar>> scalars_;
    mutable std::vector<volume::Scalar> inside_;
};

/// Takes the next bytes.
using VdbSink = std::function<Result<void>(std::span<const std::byte>)>;

/// A tree whose value at a sample is `valueOf` of its scalar; 0 is background and inactive.
class VdbTree {
public:
    /// \param blocks   must outlive the tree
    /// \param valueOf  bits of the value (a 32-bit integer or float) of each scalar
    VdbTree(const VdbBlocks& blocks, std::vector<std::uint32_t> valueOf);

    [[nodiscard]] bool isEmpty() const noexcept { return roots_.empty(); }
    /// Visits the samples once. \param topology, buffers may be empty: then that part is not made
    /// \return nothing, or Cancelled, or the first error of a sink
    [[nodiscard]] Result<void> write(const VdbSink& topology, const VdbSink& buffers) const;

private:
    enum class State : std::uint8_t { Empty, Tile, Child };
    struct Upper {
        Vec3i first;  ///< block
    };
    [[nodiscard]] State stateOf(Vec3i block, std::uint32_t& value) const;
    [[nodiscard]] Result<void> writeUpper(const Upper& upper, const VdbSink& topology, const VdbSink& buffers) const;
    template <class Visit>
    [[nodiscard]] Result<void> forEachChild(const Upper& upper, const Visit& visit) const;
    void readBlock(Vec3i block, std::vector<std::uint32_t>& values) const;

    const VdbBlocks& blocks_;
    std::vector<std::uint32_t> valueOf_;
    std::vector<Upper> roots_;
};

}  // namespace svt::writers
