#pragma once
/// \file
/// Scenes of one volume as pictures. Keeps the forms of the volume that pictures need, each made when first needed.

#include <svt/illustrate/scene.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace svt::illustrate {

/// A drawn scene, and the frame it was drawn as.
struct Painting {
    render::Frame frame;
    render::FrameSpec spec;
};

/// Not for several threads at once.
class ScenePainter {
public:
    /// \param volume   must outlive the painter
    /// \param threads  for the forms; 0: all cores
    explicit ScenePainter(const volume::SemanticVolume& volume, int threads = 0);
    ~ScenePainter();
    ScenePainter(ScenePainter&&) noexcept;

    /// Draws `scene`, with its names.
    /// \return picture and frame, or what frameOf(), extractShell() or castRays() returns
    /// Cost: that of castRays(); and once, of each form.
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const render::CastOptions& options = {});

    /// A draft of the same, for a first and coarse picture: surfaces are voxels, far views are not smoothed. Keeps no
    /// bricks and no levels, and comes about three times sooner than a picture for which these must be made.
    /// \return as paint(), or what BrickVolume::fromColumns() returns
    /// Cost: that of castRays() and of bricks of voxels, each time.
    [[nodiscard]] Result<Painting> paintDraft(const Scene& scene, const render::CastOptions& options = {});

    /// The same as paint() by another renderer: `draw` is given the volumes that the passes draw and the frame.
    using Draw = std::function<Result<render::Frame>(std::span<const render::DrawnVolume>, const render::FrameSpec&)>;
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const Draw& draw);

    /// A form of the volume, for a picture that is `spec`. It lives as long as the painter.
    [[nodiscard]] Result<render::DrawnVolume> form(const VolumeForm& form, const render::FrameSpec& spec);

private:
    // The volume or a shell of it, with what is made of it.
    struct Forms;
    Result<Forms*> formsOf(std::optional<ShellLevel> shell);
    Result<Painting> finish(const Scene& scene, render::FrameSpec spec, std::span<const render::DrawnVolume> drawn,
                            const Draw& draw) const;

    const volume::SemanticVolume& volume_;
    int threads_;
    std::vector<std::unique_ptr<Forms>> forms_;
};

}  // namespace svt::illustrate
