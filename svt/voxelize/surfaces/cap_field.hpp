#pragma once
/// \file
/// The winding number of caps, c(p): the solid angle under which p sees them, divided by 4 pi.
///
/// Where p crosses a cap, c jumps by one. Elsewhere it is harmonic, and its derivatives need the rim alone (the law of
/// Biot and Savart): the caps may be placed anywhere.

#include <svt/voxelize/lattice/height_planes.hpp>
#include <svt/voxelize/surfaces/rim.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// Quadratic approximation about a centre: value + gradient . d + d . hessian d / 2, off by at most `error` within the
/// ball for which it was made.
struct Jet {
    double value = 0;
    Vec3d gradient{};
    Vec3d diagonal{};  ///< of the hessian: xx, yy, zz
    Vec3d mixed{};     ///< yz, xz, xy
    double error = 0;

    [[nodiscard]] Vec3d hessianTimes(Vec3d d) const noexcept {
        return {diagonal.x * d.x + mixed.z * d.y + mixed.y * d.z, mixed.z * d.x + diagonal.y * d.y + mixed.x * d.z,
                mixed.y * d.x + mixed.x * d.y + diagonal.z * d.z};
    }
    [[nodiscard]] double at(Vec3d d) const noexcept { return value + dot(gradient, d) + dot(d, hessianTimes(d)) / 2; }
    /// The same function about a centre moved by `d`.
    [[nodiscard]] Jet movedBy(Vec3d d) const noexcept {
        Jet moved = *this;
        moved.value = at(d);
        moved.gradient = gradient + hessianTimes(d);
        return moved;
    }
    Jet& operator+=(const Jet& other) noexcept {
        value += other.value;
        gradient = gradient + other.gradient;
        diagonal = diagonal + other.diagonal;
        mixed = mixed + other.mixed;
        error += other.error;
        return *this;
    }
};

/// A loop and its cap, in local space.
struct CapLoop {
    std::uint32_t first = 0, count = 0;  ///< range of the points
    bool hasOwnApex = false;             ///< else the first point is the apex
    Vec3d apex{};
    Box3d bounds;
    double area = 0;    ///< of the cap's triangles
    double length = 0;  ///< of the rim
};

/// A triangle of a cap on the lattice. Decides on which side of it a sample lies, exactly as the sweep does.
struct CapSide {
    QuantaPoint corners[3] = {};
    HeightPlane height;        // of a triangle that is not vertical
    bool isVertical = false;   // in the lattice: it has no area in plan
    bool looksUp = false;      // of a triangle that is not vertical
    double normalX = 0, normalY = 0;

    CapSide() = default;
    CapSide(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, std::int32_t depth) noexcept;
    /// True if the sample is on the side that the triangle does not face.
    [[nodiscard]] bool isBehind(Vec3i sample) const noexcept;
};

/// The caps of one shell.
class CapField {
public:
    CapField(const CappedShell& shell, const IndexMesh& lattice, const volume::Grid& grid, Vec3d localOrigin);

    [[nodiscard]] std::span<const CapLoop> loops() const noexcept { return loops_; }
    /// Position of index-space coordinates, local space.
    [[nodiscard]] Vec3d localFromIndex(Vec3d index) const noexcept {
        return origin_ + steps_[0] * index.x + steps_[1] * index.y + steps_[2] * index.z;
    }
    [[nodiscard]] const Vec3d& step(int axis) const noexcept { return steps_[axis]; }

    /// Winding number of a cap at `p`.
    [[nodiscard]] double winding(const CapLoop& loop, Vec3d p) const noexcept {
        return windingOf(std::span(points_).subspan(loop.first, loop.count), loop.apex, loop.hasOwnApex, p);
    }
    /// The same at a sample that may be close to the cap: on which side it is, is decided as in the sweep. `loop` is
    /// one of loops().
    [[nodiscard]] double windingNear(const CapLoop& loop, Vec3i sample) const noexcept;
    /// The jet of a cap at `p`, with the error for distances up to `radius`. Infinite error: the rim is too near.
    [[nodiscard]] Jet jet(const CapLoop& loop, Vec3d p, double radius) const noexcept;

private:
    static double windingOf(std::span<const Vec3d> ring, Vec3d apex, bool hasOwnApex, Vec3d p) noexcept;

    Vec3d origin_;
    Vec3d steps_[3];
    std::vector<CapLoop> loops_;
    std::vector<Vec3d> points_;          // rings of all loops, local space
    std::vector<double> lengths_;        // of the edge from each point to the next one of its ring
    std::vector<Vec3d> latticePoints_;   // the same points as snapped, local space
    std::vector<Vec3d> latticeApexes_;   // per loop
    std::vector<CapSide> sides_;         // per point: the triangle of the edge that begins there
};

}  // namespace svt::voxelize
