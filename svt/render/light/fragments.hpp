#pragma once
/// \file
/// What a ray meets of lines and triangles, and how it joins the light of the volume. Internal to render.
///
/// Both casters find fragments and blend them by the code here, so that they cannot differ. Where a ray meets a
/// fragment within a run, the run's light is added up to there, then the fragment's, and the run goes on: it is not lit
/// anew, and no second walk is made.

#include <svt/render/light/line_kernel.hpp>
#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

#include <limits>
#include <span>
#include <vector>

namespace svt::render {

/// A surface that a ray meets.
struct MetSurface {
    volume::Scalar label;
    std::uint32_t object;
    Vec3d normal;        ///< world space, unit length, towards the viewer
    bool isCap = false;  ///< on a clip plane
};

/// What a ray meets at one depth: a line or a surface.
struct Fragment {
    double depth;               ///< the ray's parameter
    double opacity;             ///< 0..1
    double hidden;              ///< opacity behind something opaque; surfaces: 0
    Vec3d color;                ///< linear light, lit
    std::int32_t surface = -1;  ///< its number; -1: a line, which has no label

    [[nodiscard]] bool isLine() const noexcept { return surface < 0; }
};

/// Of a ray, or of all rays of a packet.
struct Fragments {
    std::vector<Fragment> items;  ///< those of one ray stand together, by ascending depth
    std::vector<MetSurface> surfaces;
    void clear() noexcept {
        items.clear();
        surfaces.clear();
    }
};

/// Adds a fragment to what a ray has gathered.
/// \param transmittance  of voxels and surfaces \param lines  of lines: apart, so that a line ends no ray and the label
///                       behind it is found as if there were no line
inline void blend(const Fragment& fragment, Vec3d& color, double& transmittance, double& lines) noexcept {
    const double share = transmittance * fragment.opacity;
    color = color + fragment.color * (share * lines);
    if (fragment.isLine())
        lines *= 1 - fragment.opacity;
    else
        transmittance -= share;
}

/// Hidden lines over the sample of a ray that has ended: of all, the strongest.
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

/// Finds fragments; keeps its buffers. Belongs to one thread.
class FragmentFinder {
public:
    explicit FragmentFinder(const PreparedFrame& frame);

    /// What kLineRays rays come upon of the lines of a pass; `u` and `v` as CameraRays::at() takes them.
    /// \return the hits in the order of rays, `starts[n]` to `starts[n + 1]` those of ray n; valid until the next call
    std::span<LineHit> findLines(std::size_t pass, const double* u, const double* v,
                                 std::array<std::size_t, kLineRays + 1>& starts);
    /// The same for one ray.
    std::span<LineHit> findLines(std::size_t pass, double u, double v);
    /// Appends what is drawn of one ray's hits to `fragments`, by ascending depth.
    void addLines(std::size_t pass, std::span<LineHit> hits, Fragments& fragments) const;

    /// Adds the surfaces that the ray through (u, v) meets in `drawn`, up to the first opaque one, to those of its
    /// fragments that begin at `first`; all are then by ascending depth.
    /// \return depth of that opaque one, where the ray ends; infinity if there is none
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
    const PictureTriangle* cutOpen(const PassShapes& shapes, double depth);

    const PreparedFrame& frame_;
    NormalCache cache_;
    std::vector<Hit> hits_;
    std::vector<std::uint32_t> near_;  // lines near a few rays
    std::vector<LineHit> lineHits_, sortedHits_;
    struct Body {
        std::uint32_t object;
        int balance = 0, inside = 0;  // how much oftener entered than left: by the whole ray, up to the cut
        const PictureTriangle* entered = nullptr;
        std::ptrdiff_t order = 0;
    };
    std::vector<Body> bodies_;
};

}  // namespace svt::render
