#pragma once
/// \file
/// The winding number of lids, c(p): the solid angle under which p sees them, divided by 4 pi.
///
/// Where p crosses a lid, c jumps by one. Elsewhere it is harmonic, and its derivatives need only the border (the law
/// of Biot and Savart). It is evaluated for sets of pieces, the triangles of the lids; edges that two neighbouring
/// pieces of a set share cancel.

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

/// A part of a lid, local space: the triangle of the apex and a straight stretch of the rim, from `from` to `to`. It
/// stands for one or more triangles of the lid.
struct LidPiece {
    Vec3d apex, from, to;
    std::uint32_t previous = 0,
                  next = 0;       ///< pieces that share the sides apex-from and apex-to; kNone: an edge of the rim
    double area = 0, length = 0;  ///< length: of its three sides
    std::uint32_t firstSide = 0, sideEnd = 0;  ///< its triangles on the lattice
    Box3d bounds;
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
};

/// A triangle of a lid on the lattice. Decides on which side of it a sample lies, exactly as the sweep does.
struct LidSide {
    QuantaPoint corners[3] = {};
    Vec3d local[3] = {};      ///< the corners, local space
    HeightPlane height;       // of a triangle that is not vertical
    bool isVertical = false;  // in the lattice: it has no area in plan
    bool looksUp = false;     // of a triangle that is not vertical
    double normalX = 0, normalY = 0;

    LidSide() = default;
    LidSide(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, std::int32_t depth) noexcept;
    /// True if the sample is on the side that the triangle does not face.
    [[nodiscard]] bool isBehind(Vec3i sample) const noexcept;
};

/// The lids of one shell. Sets of pieces are given by ascending numbers.
class LidField {
public:
    LidField(const CoveredShell& shell, const IndexMesh& lattice, const volume::Grid& grid, Vec3d localOrigin);

    [[nodiscard]] std::span<const LidPiece> pieces() const noexcept { return pieces_; }
    /// Position of index-space coordinates, local space.
    [[nodiscard]] Vec3d localFromIndex(Vec3d index) const noexcept {
        return origin_ + steps_[0] * index.x + steps_[1] * index.y + steps_[2] * index.z;
    }
    /// Position of a sample, local space.
    [[nodiscard]] Vec3d localOfSample(Vec3i sample) const noexcept {
        constexpr double kShift = 1.0 / double(kQuanta);  // samples lie this far beyond their index
        return localFromIndex({sample.x + kShift, sample.y + kShift, sample.z + kShift});
    }
    [[nodiscard]] const Vec3d& step(int axis) const noexcept { return steps_[axis]; }

    /// Winding number of a set of pieces at `p`.
    [[nodiscard]] double winding(std::span<const std::uint32_t> set, Vec3d p) const noexcept;
    /// The same at a sample that may be close to some of them. The side of the sample is decided as in the sweep.
    [[nodiscard]] double windingNear(std::span<const std::uint32_t> set, Vec3i sample) const noexcept;
    /// Contribution of one piece to windingNear() - winding(); NaN if rounding decides the side of the piece. The sum
    /// over all pieces close to the sample is a whole number, except in strips thinner than 1/256 voxel.
    [[nodiscard]] double latticeDifference(std::uint32_t piece, Vec3i sample) const noexcept;
    /// The jet of a set of pieces at `p`, with a bound of its error for distances up to `radius`. If that is more than
    /// `limit`, the rest is not computed.
    [[nodiscard]] Jet jet(std::span<const std::uint32_t> set, Vec3d p, double radius,
                          double limit = kInfinity) const noexcept;

private:
    void addLoop(const CoveredShell& shell, const RimLoop& loop, const IndexMesh& lattice, std::int32_t depth);
    [[nodiscard]] double jetError(std::span<const std::uint32_t> set, Vec3d p, double radius) const noexcept;
    template <class Body>
    void forEachEdge(std::span<const std::uint32_t> set, Body&& body) const;

    Vec3d origin_;
    Vec3d steps_[3];
    std::vector<LidPiece> pieces_;
    std::vector<LidSide> sides_;
};

}  // namespace svt::voxelize
