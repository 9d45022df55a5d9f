#pragma once
/// \file
/// Draws scenes of one volume. Keeps the forms of the volume (shells, levels of detail, bricks), each made when first
/// needed.

#include <svt/illustrate/details.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::illustrate {

/// A drawn scene, and the frame description that it was drawn from.
struct Painting {
    /// What became of the names that Scene::names asks for.
    struct Names {
        std::size_t drawn = 0;
        std::size_t hidden = 0;       ///< of what is not seen: not drawn
        std::size_t withoutRoom = 0;  ///< not drawn either
    };
    render::Frame frame;
    render::FrameSpec spec;
    Names names{};
};

/// Not thread-safe.
class ScenePainter {
public:
    /// \param volume   must outlive the painter
    /// \param threads  for making forms; 0: all cores
    explicit ScenePainter(const volume::SemanticVolume& volume, int threads = 0);
    ~ScenePainter();
    ScenePainter(ScenePainter&&) noexcept;

    /// From now on a query that selects nothing is no error: it is told in `nothing`, and the picture is drawn as if the
    /// query were one that nothing in the model answers. nullptr: an error again.
    void tolerateNothing(std::vector<std::string>* nothing) noexcept { nothing_ = nothing; }

    /// From now on `progress` is told of the stage "prepare" while a form of the volume is made; may be null.
    void reportTo(const Progress* progress) noexcept { progress_ = progress; }

    /// From now on `detail` is drawn in place of what it has of the volume, see details.hpp. Drafts are without it.
    /// \param detail  of joinLabels(); must outlive the painter
    void addDetail(const volume::SemanticVolume& detail);

    /// From now on `part` is drawn with the volume: a part of one model that is divided among several volumes, none of whose
    /// objects has voxels in another one. So parts take no place of others, and have shells of their own.
    /// \param part       of joinLabels(); must outlive the painter
    /// \param hasSlopes  whether its slopes are seen; else its voxels are drawn, whose bricks are made in a third of the time
    void addPart(const volume::SemanticVolume& part, bool hasSlopes = true);

    /// A scalar that stands for several others: a place too far away to tell them apart.
    struct StyleMixture {
        volume::Scalar scalar = 0;
        std::vector<std::pair<volume::Scalar, float>> parts;  ///< others, and their shares
        float empty =
            0;  ///< the share of none: there the background is seen, fully from above and less the flatter the view
    };
    /// From now on these scalars look as the styles of a scene say of their parts: the mean, by share, of those that are
    /// shown, and of the background where there is one; hidden where none is shown.
    void mixStyles(std::vector<StyleMixture> mixtures) { mixtures_ = std::move(mixtures); }

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

    /// The painter of the volume with storeys drawn `distance` apart, made when first asked for; itself for 0. It lives until
    /// another distance is asked for.
    /// \return the painter, or an error of explodeStoreys()
    [[nodiscard]] Result<ScenePainter*> apart(double distance);
    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return volume_; }

    /// A form of the volume for the frame `spec`. It lives as long as the painter.
    [[nodiscard]] Result<render::DrawnVolume> form(const VolumeForm& form, const render::FrameSpec& spec);

private:
    // The volume or a shell of it, with its bricks and levels of detail.
    struct Forms;
    Result<Forms*> findForms(std::size_t number, std::optional<ShellLevel> shell);
    [[nodiscard]] Result<render::DrawnVolume> formOf(std::size_t number, const VolumeForm& wanted,
                                                     const render::FrameSpec& spec);
    [[nodiscard]] Result<std::vector<render::DrawnVolume>> drawnVolumes(const Scene& scene, render::FrameSpec& spec);
    struct Apart;
    using Paint = std::function<Result<Painting>(const Scene&)>;
    [[nodiscard]] Result<void> addInsets(const Scene& scene, const Paint& paint, Painting& painting) const;
    [[nodiscard]] std::optional<analyze::SampleBox> targetOf(const Scene& scene) const;
    [[nodiscard]] Result<Painting> paintPlain(const Scene& scene, const Draw& draw);
    [[nodiscard]] Result<Painting> draftPlain(const Scene& scene, const render::CastOptions& options);
    [[nodiscard]] Result<Painting> finish(const Scene& scene, const analyze::LabelRows& rows, const ColorScale& scale,
                                          render::FrameSpec spec, std::span<const render::DrawnVolume> drawn,
                                          const Draw& draw) const;

    const volume::SemanticVolume& volume_;
    int threads_;
    std::vector<std::string>* nothing_ = nullptr;
    const Progress* progress_ = nullptr;
    std::vector<std::unique_ptr<Forms>> forms_;
    std::unique_ptr<Apart> apart_;
    struct Detail {
        const volume::SemanticVolume* volume;
        DetailPlace place;
        bool isPart = false, hasSlopes = true;
    };
    std::vector<Detail> details_;
    std::vector<StyleMixture> mixtures_;
};

}  // namespace svt::illustrate
