#pragma once
/// \file
/// The volume opened by a page, for drawing, picking and queries. Caches expensive results between calls.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/city/city_painter.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/render/ray_labels.hpp>
#include <svt/render/view_ray.hpp>
#include <svt/render_gl/gl_renderer.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::web {

/// The hit at a position in a picture.
struct Picked {
    volume::Scalar scalar = 0;
    std::uint32_t label = 0;
    Vec3d point{};  ///< metres from the grid's lower corner
};

using readers::NamedBytes;

/// How models become volumes.
struct OpenOptions {
    /// Coarse voxels without edges, for a first picture. No difference for `.svt`.
    bool isDraft = false;
    /// Size limit of a volume without a given spacing, bytes; 0: as for `svt build`.
    std::uint64_t memoryBytes = 0;
};

class Session {
public:
    /// Opens one or several files: a `.svt`, or a model, whose feature edges are stored. Several models become one, as
    /// in `svt build A B`. With a `.svt` among them, the first file is drawn with the others as in `svt render --with`.
    /// \return the session, or an error of readSvt(), readModel(), buildVolume() or joinLabels()
    [[nodiscard]] static Result<std::unique_ptr<Session>> open(std::span<const NamedBytes> files,
                                                               const OpenOptions& options, const Progress* progress);

    /// A session of the visible part of a city.
    [[nodiscard]] static std::unique_ptr<Session> ofTiles(city::JoinedTiles tiles);
    /// Whether the volume is a frame around parts.
    [[nodiscard]] bool isOfParts() const noexcept { return isOfParts_; }
    /// The volume in which a label has its voxels. Cost of parts: O(runs).
    [[nodiscard]] const volume::SemanticVolume& volumeOf(std::uint32_t label) const;
    /// A camera that shows the selection of a query, see illustrate::makeView().
    [[nodiscard]] Result<illustrate::SceneCamera> view(const std::string& query, const std::string& preset,
                                                       const illustrate::SceneCamera& now) const;

    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return volume_; }
    /// Findings of building the volume from a model.
    [[nodiscard]] const Diagnostics& findings() const noexcept { return findings_; }
    /// The reason for the spacing of the volume; empty if it was not built here.
    [[nodiscard]] const std::string& spacingReason() const noexcept { return spacingReason_; }
    /// Number of volumes that are drawn together with the first.
    [[nodiscard]] std::size_t details() const noexcept { return isOfParts_ ? 0 : details_.size(); }

    /// Sets the owners of features, as attributes `owner`, and removes those of an earlier table.
    /// \param table  CSV, see analyze::parseOwners()
    /// \return a warning for each row that names no feature, or an error of parseOwners(); the features then have no owners
    [[nodiscard]] Result<Diagnostics> setOwners(std::string_view table, std::string_view file);

    /// Whether a person can be at a point: in the air of a room, outside, in a door, or in features that the last
    /// picture does not draw at all. Cost: O(log runs of a column).
    /// \param point  metres from the grid's lower corner along world axes
    [[nodiscard]] bool isAir(Vec3d point) const;
    /// Whether a point is in a room.
    [[nodiscard]] bool isInRoom(Vec3d point) const;

    /// Draws `scene` as `svt render` does; pick() and along() then refer to this picture.
    /// \param isDraft  true for a first picture, see ScenePainter::paintDraft()
    [[nodiscard]] Result<const render::Frame*> draw(const illustrate::Scene& scene, bool isDraft = false);
    /// Whether pick() and along() refer to a picture.
    enum class Purpose : std::uint8_t { Shown, Trial };
    /// The same with WebGL2, into the lower left of the framebuffer of the current context; always the same context.
    /// \return nothing, or an error of draw() or GlRenderer; BadArgument if the scene needs the CPU: names, shells
    ///         besides the volume, levels of detail, cells, insets, storeys apart, sun, exact surfaces
    [[nodiscard]] Result<void> drawGl(const illustrate::Scene& scene, Purpose purpose);
    /// Discards the resources in the context, for example after it was lost.
    void dropGl();
    /// Width by height of the last picture; 16 : 9 before the first.
    [[nodiscard]] double aspect() const noexcept;
    /// A picture as PNG; does not replace the last picture for pick() and along().
    [[nodiscard]] Result<std::vector<std::byte>> picture(const illustrate::Scene& scene);

    /// The scalars of such a picture, as written by `svt render --labels`.
    [[nodiscard]] Result<std::vector<std::byte>> labels(const illustrate::Scene& scene);

    /// \param x, y  fractions of the last picture's width and height
    /// \return the object that a person sees at this position: the first object that hides more than half of everything
    ///         behind it, else the first object other than a room, else the room; or nothing
    [[nodiscard]] std::optional<Picked> pick(double x, double y);
    /// All intervals along the ray through a position of the last picture, nearest first.
    [[nodiscard]] Result<std::vector<render::LabelInterval>> along(double x, double y);

    /// From now on scenes with this field are drawn, see ScenePainter::showField(). Only in the whole module.
    [[nodiscard]] Result<void> showField(fields::Field field);
    /// The field of showField(); null: none.
    [[nodiscard]] const fields::Field* shownField() const noexcept { return field_ ? &*field_ : nullptr; }
    /// The object at a position of the last picture, and the values of the field there at all of its times; NaN: missing.
    struct FieldSeries {
        std::optional<Picked> picked;
        std::vector<float> values;
    };
    [[nodiscard]] Result<FieldSeries> fieldAt(double x, double y);
    /// The legend of a scene with a field, see ScenePainter::scaleOfField().
    [[nodiscard]] Result<illustrate::ColorScale> scaleOfField(const illustrate::Scene& scene) const {
        return painter_.scaleOfField(scene);
    }

    /// A feature of a city with its surroundings, as a separate volume; null if the feature lacks own voxels.
    [[nodiscard]] std::unique_ptr<Session> around(std::uint32_t label) const;
    /// Contacts between features; computed on first use.
    [[nodiscard]] const std::vector<analyze::Contact>& contacts();
    [[nodiscard]] const std::vector<analyze::Measure>& measures();
    /// Floor areas of rooms by label, m2, 0 for other labels; empty if the model has no levels. Computed on first use.
    [[nodiscard]] const std::vector<double>& floorAreas();

private:
    Session(std::vector<volume::SemanticVolume> volumes, Diagnostics findings);
    explicit Session(city::JoinedTiles tiles);
    [[nodiscard]] volume::Scalar scalarAt(Vec3d point) const;

    [[nodiscard]] render_gl::PickedPixel firstAt(std::int32_t column, std::int32_t row);
    [[nodiscard]] bool isSeenThrough(volume::Scalar scalar) const;
    [[nodiscard]] std::optional<Picked> behindGlass(const render::ViewRay& ray, bool hasSpaces);
    [[nodiscard]] std::optional<Picked> pickedAt(const render_gl::PickedPixel& pixel, const render::ViewRay& ray) const;

    volume::SemanticVolume volume_;
    std::vector<volume::SemanticVolume> details_;
    Diagnostics findings_;
    std::string spacingReason_;
    bool hasOwners_ = false, isOfParts_ = false;
    std::optional<fields::Field> field_;  // outlives the painter
    std::vector<std::string> nothing_;    // queries that select no visible feature of a city
    illustrate::ScenePainter painter_;
    std::optional<render::FrameSpec> lastSpec_;
    std::vector<illustrate::VolumeRepresentation> lastRepresentations_;
    std::optional<illustrate::SurfaceSource> lastSurfaces_;
    double lastApart_ = 0;                    // Scene::explode
    std::optional<render::Frame> lastFrame_;  // none if drawn with WebGL2
    std::optional<render_gl::GlRenderer> gl_;
    std::vector<std::uint32_t> labelOfScalar_;
    std::optional<std::vector<analyze::Contact>> contacts_;
    std::optional<std::vector<analyze::Measure>> measures_;
    std::optional<std::vector<double>> floorAreas_;
};

}  // namespace svt::web
