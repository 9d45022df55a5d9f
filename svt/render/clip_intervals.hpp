#pragma once
/// \file
/// Clips rays against clip regions, before any voxel is read. For renderers: used by render and render_gl.

#include <svt/render/frame_spec.hpp>
#include <svt/render/voxel_ray.hpp>
#include <svt/volume/grid.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace svt::render {

/// The clip face, plane or round, on which a cap (cut face) lies; both null, as in CapFace{}: no cap. There are no
/// default initializers, because arrays of many are kept per ray: always write the braces.
struct CapFace {
    const HalfSpace* plane;
    const RoundBody* round;

    [[nodiscard]] explicit operator bool() const noexcept { return plane != nullptr || round != nullptr; }
    /// Normal of the face at a point of world space; unit length, to either side.
    [[nodiscard]] Vec3d normalAt(Vec3d point) const noexcept {
        return plane != nullptr ? normalized(plane->normal) : round->normalAt(point);
    }
};

/// An interval of a ray that is drawn.
struct DrawnInterval {
    double from, to;
    CapFace cap;  ///< the clip face at `from`; none if no clip made this start
};

/// The drawn intervals of one ray, ascending. Each convex part of a clip adds at most one.
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
    /// The intervals that the clips leave of `span`; the ray is in voxel space.
    [[nodiscard]] DrawnIntervals cut(Vec3d origin, Vec3d direction, RaySpan span) const noexcept;
    [[nodiscard]] DrawnIntervals cut(const VoxelRay& ray, RaySpan span) const noexcept {
        return cut(ray.origin, ray.direction, span);
    }
    /// Whether a point (voxel space) is drawn; clips that depend on the line of sight (gaps) are ignored.
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
        std::size_t gap;
    };
    // The interval of a ray inside a part of a region, and the faces at its ends.
    struct PartInterval {
        double enter, exit;
        CapFace enterFace, exitFace;
        void meet(double from, double to, CapFace face) noexcept;
    };
    using PartIntervals = std::array<PartInterval, Pass::kMaxClipParts>;

    struct Line {
        Vec3d origin, direction;
    };
    static PartInterval within(const Part& part, const Line& line) noexcept;
    static void meetRound(const Round& round, const Line& line, PartInterval& inside) noexcept;
    static DrawnInterval inGap(const DrawnInterval& interval, const Region& region, const PartIntervals& insides,
                               std::size_t count) noexcept;
    static std::size_t within(const Region& region, const Line& line, PartIntervals& insides) noexcept;

    std::vector<Region> regions_;
};

}  // namespace svt::render
