#pragma once
/// \file
/// Draws scenes of one volume. Keeps the forms of the volume (shells, levels of detail, bricks), each made when first
/// needed.

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

/// A drawn scene, and the frame description that it was drawn from.
struct Painting {
    render::Frame frame;
    render::FrameSpec spec;
};

/// Not thread-safe.
class ScenePainter {
public:
    /// \param volume   must outlive the painter
    /// \param threads  for making forms; 0: all cores
    explicit ScenePainter(const volume::SemanticVolume& volume, int threads = 0);
    ~ScenePainter();
    ScenePainter(ScenePainter&&) noexcept;

    /// Draws `scene`, with its name tags.
    /// \return picture and frame, or an error of makeFrameSpec(), extractShell() or castRays()
    /// Cost: that of castRays(), and once that of each form.
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const render::CastOptions& options = {});

    /// Draws a draft of the same, for a quick first picture: surfaces show their voxels, distant parts may alias. Keeps
    /// no bricks and no levels; about three times faster than a picture for which these must be made first.
    /// \return as paint(), or an error of BrickVolume::fromColumns()
    /// Cost: that of castRays() and of bricks of voxels, at each call.
    [[nodiscard]] Result<Painting> paintDraft(const Scene& scene, const render::CastOptions& options = {});

    /// Renders a frame: gets the volumes that the passes draw, and the frame description.
    using Draw = std::function<Result<render::Frame>(std::span<const render::DrawnVolume>, const render::FrameSpec&)>;
    /// As the first paint(), with another renderer.
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const Draw& draw);

    /// A form of the volume for the frame `spec`. It lives as long as the painter.
    [[nodiscard]] Result<render::DrawnVolume> form(const VolumeForm& form, const render::FrameSpec& spec);

private:
    // The volume or a shell of it, with its bricks and levels of detail.
    struct Forms;
    Result<Forms*> findForms(std::optional<ShellLevel> shell);
    [[nodiscard]] Result<Painting> finish(const Scene& scene, const analyze::LabelRows& rows, render::FrameSpec spec,
                                          std::span<const render::DrawnVolume> drawn, const Draw& draw) const;

    const volume::SemanticVolume& volume_;
    int threads_;
    std::vector<std::unique_ptr<Forms>> forms_;
};

}  // namespace svt::illustrate
