#pragma once
/// \file
/// Cuts rays by clip regions before any voxel is looked at. Internal to render.

#include <svt/render/frame_spec.hpp>
#include <svt/render/voxel_ray.hpp>
#include <svt/volume/grid.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace svt::render {

/// The plane or round surface that cuts something open; neither: nothing does. CapFace{} is none; nothing is set
/// without the braces, since rays have room for many.
struct CapFace {
    const HalfSpace* plane;
    const RoundBody* round;

    [[nodiscard]] explicit operator bool() const noexcept { return plane != nullptr || round != nullptr; }
    /// At a point of world space, length 1, to either side.
    [[nodiscard]] Vec3d normalAt(Vec3d point) const noexcept {
        return plane != nullptr ? normalized(plane->normal) : round->normalAt(point);
    }
};

/// A stretch of a ray that is drawn.
struct DrawnInterval {
    double from, to;
    CapFace cap;  ///< at `from`; none where no clip made this start
};

/// The intervals of one ray, ascending. Each part of a clip adds one at most.
class DrawnIntervals {
public:
    DrawnIntervals() = default;
    DrawnIntervals(const DrawnIntervals& other) noexcept { *this = other; }
    DrawnIntervals& operator=(const DrawnIntervals& other) noexcept {
        std::copy(other.begin(), other.end(), items_.begin());
        count_ = other.count_;
        return *this;
    }
    [[nodiscard]] bool isEmpty() const noexcept { return count_ == 0; }
    [[nodiscard]] const DrawnInterval* begin() const noexcept { return items_.data(); }
    [[nodiscard]] const DrawnInterval* end() const noexcept { return items_.data() + count_; }
    void add(const DrawnInterval& interval) noexcept {
        if (interval.from < interval.to) items_[count_++] = interval;
    }

private:
    std::array<DrawnInterval, Pass::kMaxClipParts + 1> items_;
    std::size_t count_ = 0;
};

/// The clip regions of a pass in voxel space. Keeps pointers into `clips`.
class Clipper {
public:
    Clipper(std::span<const ClipRegion> clips, const volume::Grid& grid);

    [[nodiscard]] bool isEmpty() const noexcept { return regions_.empty(); }
    /// What is left of `span` on a ray of voxel space.
    [[nodiscard]] DrawnIntervals cut(Vec3d origin, Vec3d direction, RaySpan span) const noexcept;
    [[nodiscard]] DrawnIntervals cut(const VoxelRay& ray, RaySpan span) const noexcept {
        return cut(ray.origin, ray.direction, span);
    }
    /// Is this point (voxel space) drawn?
    [[nodiscard]] bool keeps(Vec3d point) const noexcept;

private:
    struct Plane {
        Vec3d normal;  // voxel space
        double offset;
        const HalfSpace* source;
    };
    struct Round {
        RoundBody body;  // voxel space
        const RoundBody* source;
    };
    struct Part {
        std::vector<Plane> planes;
        std::vector<Round> rounds;
    };
    struct Region {
        std::vector<Part> parts;
        ClipRegion::Mode mode;
    };
    // A stretch of a ray within a region, and the faces at its two ends.
    struct Stretch {
        double enter, exit;
        CapFace enterFace, exitFace;
        void meet(double from, double to, CapFace face) noexcept;
    };
    using Stretches = std::array<Stretch, Pass::kMaxClipParts>;

    struct Line {
        Vec3d origin, direction;
    };
    static Stretch within(const Part& part, const Line& line) noexcept;
    static void meetRound(const Round& round, const Line& line, Stretch& stretch) noexcept;
    static std::size_t within(const Region& region, const Line& line, Stretches& stretches) noexcept;

    std::vector<Region> regions_;
};

}  // namespace svt::render
