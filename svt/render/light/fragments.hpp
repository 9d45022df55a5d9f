#pragma once
/// \file
/// Fragments: the lines and triangles that a ray meets, and how they are blended with the volume.
///
/// Both casters use this code to find and blend fragments, so that they cannot differ. If a ray meets a fragment inside
/// a run, the run is blended up to the fragment, then the fragment, then the rest of the run. The run is not lit again,
/// and the ray is not walked twice.

#include <svt/render/light/line_kernel.hpp>
#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

#include <limits>
#include <span>
#include <vector>

namespace svt::render {

/// A triangle, or the cap of a mesh, that a ray meets.
struct SurfaceFragment {
    volume::Scalar label;
    std::uint32_t object;
    Vec3d normal;        ///< world space, unit length, towards the viewer
    bool isCap = false;  ///< on a clip face
};

/// A line or a surface that a ray meets.
struct Fragment {
    double depth;               ///< the ray's parameter
    double opacity;             ///< 0..1
    double hidden;              ///< opacity as a hidden line, behind something opaque; surfaces: 0
    Vec3d color;                ///< linear light, lit
    std::int32_t surface = -1;  ///< index into Fragments::surfaces; -1: a line, which has no label

    [[nodiscard]] bool isLine() const noexcept { return surface < 0; }
};

/// The fragments of a ray, or of all rays of a packet.
struct Fragments {
    std::vector<Fragment> items;  ///< those of one ray are contiguous, by ascending depth
    std::vector<SurfaceFragment> surfaces;
    void clear() noexcept {
        items.clear();
        surfaces.clear();
    }
};

/// Blends a fragment behind the light that a ray has accumulated, front to back.
/// \param transmittance  of voxels and surfaces
/// \param lines          transmittance of lines: separate, so that a line ends no ray and does not change the label
inline void blend(const Fragment& fragment, Vec3d& color, double& transmittance, double& lines) noexcept {
    const double share = transmittance * fragment.opacity;
    color = color + fragment.color * (share * lines);
    if (fragment.isLine())
        lines *= 1 - fragment.opacity;
    else
        transmittance -= share;
}

/// Draws the strongest of the hidden lines over the sample of a ray that has ended.
inline void drawHidden(std::span<const Fragment> fragments, Sample& sample) noexcept {
    const Fragment* strongest = nullptr;
    for (const Fragment& fragment : fragments)
        if (fragment.hidden > (strongest == nullptr ? 0 : strongest->hidden)) strongest = &fragment;
    if (strongest == nullptr) return;
    const auto share = static_cast<float>(strongest->hidden);
    sample.color = sample.color * (1 - share) + toFloat(strongest->color) * share;
    sample.alpha = sample.alpha + (1 - sample.alpha) * share;
    sample.hasLine = true;
}

/// Finds fragments. Keeps buffers between calls; one per thread.
class FragmentFinder {
public:
    explicit FragmentFinder(const PreparedFrame& frame);

    /// Finds the lines of a pass that kLineRays rays meet.
    /// \param u, v    kLineRays places in the picture, see CameraRays::at()
    /// \param starts  out: the hits of ray n are [starts[n], starts[n + 1])
    /// \return the hits by ray; valid until the next call
    std::span<LineHit> findLines(std::size_t pass, const double* u, const double* v,
                                 std::array<std::size_t, kLineRays + 1>& starts);
    /// The same for one ray.
    std::span<LineHit> findLines(std::size_t pass, double u, double v);
    /// Appends the hits of one ray to `fragments`, by ascending depth; lines at about the same depth become one.
    void addLines(std::size_t pass, std::span<LineHit> hits, Fragments& fragments) const;

    /// Appends the surfaces that the ray through (u, v) meets in the intervals `drawn`, up to the first opaque one, and
    /// sorts the ray's fragments, from index `first` on, by depth.
    /// \return depth of the first opaque surface, where the ray ends; infinity if there is none
    double addSurfaces(std::size_t pass, double u, double v, const CameraRay& ray, std::span<const DrawnInterval> drawn,
                       std::size_t first, Fragments& fragments);

private:
    struct Hit {
        double depth;
        std::uint32_t triangle;
        bool isEntering;
    };

    [[nodiscard]] LineView viewOf(std::size_t pass) const noexcept;
    void addHit(const PictureTriangle& triangle, std::uint32_t number, Vec3d origin, Vec3d direction);
    void sortHits(const PassShapes& shapes);
    void addSurface(std::size_t pass, const CameraRay& ray, const PictureTriangle& triangle, double depth, Vec3d normal,
                    bool isCap, Fragments& fragments);
    const PictureTriangle* findCutBody(const PassShapes& shapes, double depth);

    const PreparedFrame& frame_;
    NormalCache cache_;
    std::vector<Hit> hits_;
    std::vector<std::uint32_t> near_;  // lines near a few rays
    std::vector<LineHit> lineHits_, sortedHits_;
    struct Body {
        std::uint32_t object;
        int balance = 0, inside = 0;  // entries minus exits: along the whole ray, and up to the cut
        const PictureTriangle* entered = nullptr;
        std::ptrdiff_t order = 0;
    };
    std::vector<Body> bodies_;
};

}  // namespace svt::render
