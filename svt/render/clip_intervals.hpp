#pragma once
/// \file
/// Cuts rays by clip regions before any voxel is looked at. Internal to render.

#include <svt/render/frame_spec.hpp>
#include <svt/render/index_ray.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <span>
#include <vector>

namespace svt::render {

/// A stretch of a ray that is drawn, and the plane that cut it open.
struct DrawnInterval {
    double from, to;
    const HalfSpace* capPlane;  ///< plane at `from`; null where no clip made this start
};

/// The intervals of one ray, ascending. Each clip region adds one at most.
class DrawnIntervals {
public:
    [[nodiscard]] const DrawnInterval* begin() const noexcept { return items_.data(); }
    [[nodiscard]] const DrawnInterval* end() const noexcept { return items_.data() + count_; }
    void add(const DrawnInterval& interval) noexcept {
        if (interval.from < interval.to) items_[count_++] = interval;
    }

private:
    std::array<DrawnInterval, 2 * (Pass::kMaxClips + 1)> items_;
    std::size_t count_ = 0;
};

/// The clip regions of a pass in voxel space. Keeps a pointer to `clips`.
class Clipper {
public:
    Clipper(std::span<const ClipRegion> clips, const volume::Grid& grid);

    [[nodiscard]] bool isEmpty() const noexcept { return regions_.empty(); }
    /// What is left of `span`.
    [[nodiscard]] DrawnIntervals cut(const IndexRay& ray, RaySpan span) const noexcept;
    /// Is this point (voxel space) drawn?
    [[nodiscard]] bool keeps(Vec3d point) const noexcept;

private:
    struct Plane {
        Vec3d normal;  // voxel space
        double offset;
        const HalfSpace* source;
    };
    struct Region {
        std::vector<Plane> planes;
        ClipRegion::Mode mode;
    };

    std::vector<Region> regions_;
};

}  // namespace svt::render
