#pragma once
/// \file
/// Draws scenes of one volume. Keeps the representations of the volume (hulls, levels of detail, bricks); each is made
/// on first use.

#include <svt/fields/field.hpp>
#include <svt/illustrate/details.hpp>
#include <svt/illustrate/exact_faces.hpp>
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

class FieldView;

/// A drawn scene, and the frame description that it was drawn from.
struct Painting {
    /// The results for the names that Scene::names requests.
    struct Names {
        std::size_t drawn = 0;
        std::size_t hidden = 0;       ///< labels that are not visible: not drawn
        std::size_t withoutRoom = 0;  ///< not drawn, for lack of space
    };
    /// The features of a picture with SurfaceSource::Exact; 0 for other pictures.
    struct Surfaces {
        std::size_t features = 0;
        std::size_t byVoxels = 0;  ///< without closed mesh, with a pattern, or with material divided among surfaces
        /// How many features voxels show, and why; empty for none.
        [[nodiscard]] std::string note() const;
    };
    render::Frame frame;
    render::FrameSpec spec;
    Names names{};
    Surfaces surfaces{};
};

/// Not thread-safe.
class ScenePainter {
public:
    /// \param volume   must outlive the painter
    /// \param threads  for making representations; 0: all cores
    explicit ScenePainter(const volume::SemanticVolume& volume, int threads = 0);
    ~ScenePainter();
    ScenePainter(ScenePainter&&) noexcept;

    /// From now on a query without matches is not an error: a message is appended to `nothing`, and the picture is
    /// drawn with an empty selection. nullptr: an error again.
    void tolerateNothing(std::vector<std::string>* nothing) noexcept { nothing_ = nothing; }

    /// From now on reports the stage "prepare" to `progress` while a representation of the volume is made; may be null.
    void reportTo(const Progress* progress) noexcept { progress_ = progress; }

    /// From now on pictures show the faces of the model, which `maker` makes on first use, where drawsFaces() and the
    /// volume has meshes. nullptr: they show voxels, and SurfaceSource::Exact is an error.
    void drawFacesBy(FaceMaker maker) noexcept { makeFaces_ = maker; }

    /// From now on scenes with Scene::field draw this field: cut faces and visible opaque surfaces have the colour of its
    /// value at their place. nullptr: scenes with a field are an error. Storeys drawn apart and details are an error.
    /// \param field  of the painter's volume; must outlive the painter
    /// \return success, or an error of fields::FieldSampler::make()
    /// Cost: that of FieldSampler::make().
    [[nodiscard]] Result<void> showField(const fields::Field* field);
    /// The legend of a scene with this field.
    /// \return the scale, or an error of paint() for such a scene
    [[nodiscard]] Result<ColorScale> scaleOfField(const Scene& scene) const;
    /// The values of this field at a surface, at all of its times; the lengths of vectors. NaN where a value is missing.
    /// \param label   scalar of the object
    /// \param world   on the surface, metres
    /// \param normal  towards the viewer, unit length
    /// \return the values, or BadArgument without a field
    [[nodiscard]] Result<std::vector<float>> fieldAt(volume::Scalar label, Vec3d world, Vec3d normal) const;

    /// From now on `detail` replaces the same part of the volume, see details.hpp. Drafts ignore it.
    /// \param detail  processed by joinLabels(); must outlive the painter
    void addDetail(const volume::SemanticVolume& detail);

    /// From now on `part` is drawn with the volume. A model may be divided among several volumes if no object has
    /// voxels in more than one. Such parts replace nothing, and have shells of their own.
    /// \param part       processed by joinLabels(); must outlive the painter
    /// \param hasSlopes  true: draws its slopes; false: draws its voxels, whose bricks take a third of the time
    void addPart(const volume::SemanticVolume& part, bool hasSlopes = true);

    /// A scalar that represents several others at a place where they are too far away to distinguish.
    struct StyleMixture {
        volume::Scalar scalar = 0;
        std::vector<std::pair<volume::Scalar, float>> parts;  ///< others, and their shares
        float empty = 0;  ///< share of gaps, where the background is visible: fully from above, less in flat views
    };
    /// From now on these scalars get the mean style of their visible parts, weighted by share, and of the background if
    /// there is one. Scalars without visible parts are hidden.
    void mixStyles(std::vector<StyleMixture> mixtures) { mixtures_ = std::move(mixtures); }

    /// Draws `scene`, with its name tags.
    /// \return picture and frame, or an error of makeFrameSpec(), extractShell() or castRays(); BadArgument for exact
    ///         surfaces with cells or coarse levels, or of a volume without meshes (details without meshes keep voxels)
    /// Cost: that of castRays(), and once that of each representation.
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const render::CastOptions& options = {});

    /// Draws a draft of the same scene, for a quick first picture: all surfaces show their voxels, and distant parts may
    /// alias. Keeps no bricks or levels. About three times faster than a picture that must make these first.
    /// \return like paint(), or an error of BrickVolume::fromColumns()
    /// Cost: that of castRays() and of bricks of voxels, in each call.
    [[nodiscard]] Result<Painting> paintDraft(const Scene& scene, const render::CastOptions& options = {});

    /// Renders a frame from the volumes that the passes draw, and the frame description.
    using Draw = std::function<Result<render::Frame>(std::span<const render::DrawnVolume>, const render::FrameSpec&)>;
    /// Like the first paint(), with another renderer, which draws voxels. A scene with a field or with SurfaceSource::Exact
    /// is an error.
    [[nodiscard]] Result<Painting> paint(const Scene& scene, const Draw& draw);

    /// The painter of the volume with storeys drawn `distance` apart, made on first request; this painter for 0. It
    /// lives until another distance is requested.
    /// \return the painter, or an error of explodeStoreys()
    [[nodiscard]] Result<ScenePainter*> apart(double distance);
    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return volume_; }

    /// A representation of the volume for the frame `spec`. It lives as long as the painter.
    [[nodiscard]] Result<render::DrawnVolume> representation(
        const VolumeRepresentation& representation, const render::FrameSpec& spec,
        std::optional<SurfaceSource> surfaces = SurfaceSource::Voxels);

private:
    // The volume or a shell of it, with its bricks and levels of detail.
    struct Representations;
    Result<Representations*> findRepresentations(std::size_t number, std::optional<ShellLevel> shell);
    [[nodiscard]] Result<render::DrawnVolume> representationOf(std::size_t number, const VolumeRepresentation& wanted,
                                                               std::optional<SurfaceSource> surfaces,
                                                               const render::FrameSpec& spec);
    [[nodiscard]] Result<std::vector<render::DrawnVolume>> drawnVolumes(const Scene& scene, render::FrameSpec& spec);
    struct Apart;
    using Paint = std::function<Result<Painting>(const Scene&)>;
    [[nodiscard]] Result<void> addInsets(const Scene& scene, const Paint& paint, Painting& painting) const;
    [[nodiscard]] std::optional<analyze::SampleBox> targetOf(const Scene& scene) const;
    [[nodiscard]] Result<Painting> paintWith(const Scene& scene, const Draw& draw);
    [[nodiscard]] Result<Painting> paintPlain(const Scene& scene, const Draw& draw);
    [[nodiscard]] Result<Painting> draftPlain(const Scene& scene, const render::CastOptions& options);
    [[nodiscard]] Result<Painting> finish(const Scene& scene, const analyze::LabelRows& rows, ColorScale scale,
                                          render::FrameSpec spec, std::span<render::DrawnVolume> drawn,
                                          const Draw& draw) const;
    [[nodiscard]] Result<void> checkField(const Scene& scene) const;
    [[nodiscard]] Result<const render::RunSource*> facesOf(Representations& representations, bool areRequired);
    [[nodiscard]] Painting::Surfaces countSurfaces() const;

    const volume::SemanticVolume& volume_;
    int threads_;
    std::vector<std::string>* nothing_ = nullptr;
    const Progress* progress_ = nullptr;
    FaceMaker makeFaces_ = nullptr;
    std::vector<std::unique_ptr<Representations>> representations_;
    std::unique_ptr<Apart> apart_;
    struct Detail {
        const volume::SemanticVolume* volume;
        DetailPlace place;
        bool isPart = false, hasSlopes = true;
    };
    std::vector<Detail> details_;
    std::vector<StyleMixture> mixtures_;
    std::unique_ptr<const FieldView> field_;
};

}  // namespace svt::illustrate
