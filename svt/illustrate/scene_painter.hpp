#pragma once
/// \file
/// Scenes of one volume as pictures. Keeps the forms of the volume that pictures need, each made when first needed.

#include <svt/illustrate/scene.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <optional>
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

    /// Draws `scene`, with its names.
    /// \param level  level of detail, 0 (finest) to 6; nothing: as fine as the pixels show
    /// \return picture and frame, or what frameOf() or castRays() returns
    /// Cost: that of castRays(); and once, of a volume's bricks or levels.
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const render::CastOptions& options = {},
                                         std::optional<int> level = {});

    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return volume_; }
    /// The volume's bricks, made when first asked for.
    [[nodiscard]] Result<const volume::BrickVolume*> bricks();

private:
    Result<render::Frame> cast(const render::FrameSpec& spec, int level, const render::CastOptions& options);

    const volume::SemanticVolume& volume_;
    int threads_;
    std::optional<volume::BrickVolume> bricks_;
    std::optional<std::vector<volume::LodLevel>> levels_;
};

}  // namespace svt::illustrate
