#pragma once
/// \file
/// Space that solids of two volumes have in common, exact from closed meshes: the same building at two times.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace svt::analyze {

/// Space of a label of the first volume and a label of the second.
struct CommonSpace {
    std::uint32_t a = 0, b = 0;  ///< labels of the first and the second volume
    double volume = 0;           ///< m3
    double bound = 0;            ///< m3 by which `volume` may be off, because points are rounded to VectorParts::unit
};

/// Compares closed meshes of two volumes in one world space. Their grids may differ. Not thread-safe.
class CommonSpaces {
public:
    /// \param a, b  must outlive the object, unchanged
    /// \param work  maximum number of steps: inspected triangles and compared pairs of triangles
    /// Cost: O(triangles).
    CommonSpaces(const volume::SemanticVolume& a, const volume::SemanticVolume& b, std::uint64_t work);
    ~CommonSpaces();
    CommonSpaces(const CommonSpaces&) = delete;
    CommonSpaces& operator=(const CommonSpaces&) = delete;

    /// The common space of two labels; nothing if one of them has no closed mesh, or if the work does not suffice.
    /// Cost: see plane::commonVolume() of plane/common_volume.hpp: pairs of triangles whose extents overlap.
    [[nodiscard]] std::optional<CommonSpace> of(std::uint32_t a, std::uint32_t b);

    /// All pairs of these labels with common space beyond its bound, ordered by (a, b).
    /// \param ofA, ofB  labels of the two volumes, ascending; those without a closed mesh are left out
    /// Cost: O(n log n) in labels, then that of of() for each pair whose boxes overlap.
    [[nodiscard]] std::vector<CommonSpace> among(std::span<const std::uint32_t> ofA,
                                                 std::span<const std::uint32_t> ofB);

    /// False if the work did not suffice for a pair.
    [[nodiscard]] bool isComplete() const noexcept { return isComplete_; }

private:
    struct Solids;
    [[nodiscard]] bool take(std::uint64_t steps) noexcept;

    std::unique_ptr<const Solids> a_, b_;
    double unit_ = 0;
    std::uint64_t work_ = 0;
    bool isComplete_ = true;
};

}  // namespace svt::analyze
