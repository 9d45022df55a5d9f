#pragma once
/// \file
/// What a ray meets of lines and triangles, and how it joins the light of the volume. Internal to render.
///
/// Both casters find fragments and blend them by the code here, so that they cannot differ. Where a ray meets a
/// fragment within a run, the run's light is added up to there, then the fragment's, and the run goes on: it is not lit
/// anew, and no second walk is made.

#include <svt/render/sample_caster.hpp>

#include <limits>
#include <span>
#include <vector>

namespace svt::render {

/// A line or a surface that a ray meets.
struct Fragment {
    double depth;        ///< the ray's parameter
    Vec3d color;         ///< linear light, lit
    double opacity;      ///< 0..1
    double hidden;       ///< opacity behind something opaque; surfaces: 0
    bool isLine;         ///< has no label
    bool isCap = false;  ///< on a clip plane
    volume::Scalar label = 0;
    std::uint32_t object = 0;
    Vec3d normal{};  ///< world space, unit length, towards the viewer
};

/// Adds a fragment to what a ray has gathered.
/// \param transmittance  of voxels and surfaces \param lines  of lines: apart, so that a line ends no ray and the label
///                       behind it is found as if there were no line
inline void blend(const Fragment& fragment, Vec3d& color, double& transmittance, double& lines) noexcept {
    const double share = transmittance * fragment.opacity;
    color = color + fragment.color * (share * lines);
    if (fragment.isLine)
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
}

/// Finds fragments; keeps its buffers. Belongs to one thread.
class FragmentFinder {
public:
    explicit FragmentFinder(const Scene& scene);

    /// Appends to `fragments`, by ascending depth, what the ray through (u, v), see CameraRays::at(), meets of the
    /// shapes of a pass that lie near it (PassShapes::near()): of surfaces those in `drawn`, up to the first opaque
    /// one. \param withLines  false: surfaces alone \return depth of that opaque one, where the ray ends; infinity if
    /// there is none
    double find(std::size_t pass, double u, double v, const CameraRay& ray, std::span<const DrawnInterval> drawn,
                bool withLines, std::vector<Fragment>& fragments);

private:
    struct Hit {
        double depth;
        std::uint32_t triangle;
        bool isEntering;
    };

    void addLine(const PassShapes& shapes, const PictureLine& line, double x, double y,
                 std::vector<Fragment>& fragments) const;
    void joinLines(std::size_t first, std::vector<Fragment>& fragments) const;
    void addHit(const PictureTriangle& triangle, std::uint32_t number, Vec3d origin, Vec3d direction);
    double addSurfaces(std::size_t pass, const CameraRay& ray, std::span<const DrawnInterval> drawn,
                       std::vector<Fragment>& fragments);
    void sortHits(const PassShapes& shapes);
    [[nodiscard]] Fragment surface(std::size_t pass, const CameraRay& ray, const PictureTriangle& triangle,
                                   double depth, Vec3d normal);
    const PictureTriangle* cutOpen(const PassShapes& shapes, double depth);

    const Scene& scene_;
    double perPixel_;   // samples along a pixel
    double voxelSize_;  // metres, the largest spacing
    NormalCache cache_;
    std::vector<Hit> hits_;
    std::vector<std::pair<std::uint32_t, int>> inside_;  // labels, how often entered
};

}  // namespace svt::render
