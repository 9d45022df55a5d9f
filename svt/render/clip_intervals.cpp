#include <svt/render/clip_intervals.hpp>

#include <algorithm>
#include <limits>

namespace svt::render {

Clipper::Clipper(std::span<const ClipRegion> clips, const volume::Grid& grid) {
    for (const ClipRegion& clip : clips) {
        Region region{{}, clip.mode};
        for (const HalfSpace& half : clip.halfSpaces) {
            // dot(n, origin + axes * (index * spacing)) + offset, and voxel space is index space plus one half.
            Plane plane{{}, half.offset + dot(half.normal, grid.origin()), &half};
            for (int axis = 0; axis < 3; ++axis) {
                plane.normal[axis] =
                    dot(half.normal, grid.axes()[static_cast<std::size_t>(axis)]) * grid.spacing()[axis];
                plane.offset -= plane.normal[axis] / 2;
            }
            region.planes.push_back(plane);
        }
        regions_.push_back(std::move(region));
    }
}

DrawnIntervals Clipper::cut(const IndexRay& ray, RaySpan span) const noexcept {
    DrawnIntervals drawn;
    drawn.add({span.from, span.to, nullptr});
    if (regions_.empty()) return drawn;
    for (const Region& region : regions_) {
        // The stretch of the ray inside the region, and the planes at its two ends.
        double enter = -std::numeric_limits<double>::infinity(), exit = -enter;
        const HalfSpace *enterPlane = nullptr, *exitPlane = nullptr;
        for (const Plane& plane : region.planes) {
            const double at = dot(plane.normal, ray.origin) + plane.offset;
            const double slope = dot(plane.normal, ray.direction);
            if (slope == 0) {
                if (!(at > 0)) exit = -std::numeric_limits<double>::infinity();
                continue;
            }
            const double t = -at / slope;
            if (slope > 0 && t > enter) {
                enter = t;
                enterPlane = plane.source;
            } else if (slope < 0 && t < exit) {
                exit = t;
                exitPlane = plane.source;
            }
        }
        DrawnIntervals next;
        for (const DrawnInterval& interval : drawn) {
            if (region.mode == ClipRegion::Mode::KeepOnly) {
                DrawnInterval kept = interval;
                if (enter > kept.from) {
                    kept.from = enter;
                    kept.capPlane = enterPlane;
                }
                kept.to = std::min(kept.to, exit);
                next.add(kept);
            } else if (!(enter < exit)) {
                next.add(interval);
            } else {
                next.add({interval.from, std::min(interval.to, enter), interval.capPlane});
                next.add(exit > interval.from ? DrawnInterval{exit, interval.to, exitPlane} : interval);
            }
        }
        drawn = next;
    }
    return drawn;
}

bool Clipper::keeps(Vec3d point) const noexcept {
    return std::all_of(regions_.begin(), regions_.end(), [&](const Region& region) {
        const bool isInside = std::all_of(region.planes.begin(), region.planes.end(), [&](const Plane& plane) {
            return dot(plane.normal, point) + plane.offset > 0;
        });
        return isInside == (region.mode == ClipRegion::Mode::KeepOnly);
    });
}

}  // namespace svt::render
