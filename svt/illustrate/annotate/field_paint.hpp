#pragma once
/// \file
/// A field as the colours of opaque surfaces, and lines of equal value on them.
///
///     surface                       | place of the sample
///     of a label of the medium      | just behind it, in a voxel of the label
///     other, field of air, no cap   | just in front of it
///
/// A surface lies on the exact face of an object, up to a voxel away from the voxels of its label. Then the sample is moved
/// to the nearest of these voxels, so it never comes from the other side of a wall.

#include <svt/analyze/selection.hpp>
#include <svt/fields/field.hpp>
#include <svt/fields/field_sampler.hpp>
#include <svt/illustrate/color_by.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/camera_rays.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace svt::illustrate {

/// A field of a volume, prepared for pictures. It shows the lengths of vectors.
class FieldView {
public:
    /// \param field, volume  must outlive the view
    /// \return or an error of fields::FieldSampler::make() and fields::mediumOf()
    [[nodiscard]] static Result<FieldView> make(const fields::Field& field, const volume::SemanticVolume& volume);
    FieldView(FieldView&&) = default;
    virtual ~FieldView() = default;

    [[nodiscard]] const std::string& name() const noexcept { return field_->head.name; }
    [[nodiscard]] const fields::FieldHead& head() const noexcept { return field_->head; }
    [[nodiscard]] const fields::FieldSampler& sampler() const noexcept { return sampler_; }
    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return *volume_; }

    /// Where a surface takes its value from.
    struct Surface {
        volume::Scalar label = 0;
        Vec3d world{}, normal{};  ///< towards the viewer, unit length
        bool isCap = false;
    };
    /// The value at a surface; NaN: missing.
    [[nodiscard]] float valueAt(const Surface& surface, double seconds) const noexcept;
    /// Whether a label belongs to the medium.
    [[nodiscard]] bool isOfMedium(volume::Scalar label) const noexcept {
        return label < isMedium_.size() && isMedium_[label] != 0;
    }

    /// The figure of each label over its own voxels at a time, by label; NaN: none. `range` receives the least and the
    /// largest of all labels and times, if there is any.
    /// Cost: that of fields::sumField().
    [[nodiscard]] Result<std::vector<float>> figures(FieldFigure figure, double seconds,
                                                     std::optional<std::pair<float, float>>& range) const;
    /// The label of a scalar, or volume::kNoLabel.
    [[nodiscard]] std::uint32_t labelOf(volume::Scalar scalar) const noexcept {
        return scalar < labelOf_.size() ? labelOf_[scalar] : volume::kNoLabel;
    }

    /// Prepares the passes of a frame. Cut faces of the medium lose their hatch. Where the field is of air, passes that cut
    /// the volume draw rooms up to the cut, unless the scene chooses the visible labels or hides the rooms.
    [[nodiscard]] Result<void> adapt(const Scene& scene, const analyze::LabelRows& rows, render::FrameSpec& spec) const;

    /// The colours and the legend of a frame.
    struct FramePaint {
        std::unique_ptr<const render::SurfacePaint> colors;  ///< refers to this view
        ColorScale scale;
    };
    /// adapt(), then FieldPaint::make(). Virtual, so that programs that show no field do not contain it.
    [[nodiscard]] virtual Result<FramePaint> paintFrame(const Scene& scene, const analyze::LabelRows& rows,
                                                        render::FrameSpec& spec) const;

private:
    explicit FieldView(fields::FieldSampler sampler) : sampler_(std::move(sampler)) {}
    [[nodiscard]] volume::Scalar scalarAt(Vec3i voxel) const noexcept;
    [[nodiscard]] std::optional<Vec3d> inLabel(volume::Scalar label, Vec3d index) const noexcept;
    [[nodiscard]] std::optional<Vec3d> inFront(Vec3d index, Vec3d normal) const noexcept;

    const fields::Field* field_ = nullptr;
    std::shared_ptr<const fields::Field> lengths_;  // of a field of vectors
    const volume::SemanticVolume* volume_ = nullptr;
    fields::FieldSampler sampler_;
    std::vector<char> isMedium_;          // by scalar
    std::vector<std::uint32_t> labelOf_;  // by scalar
    bool isOfAir_ = false;                // the medium has no solid labels
    double eps_ = 0;                      // metres from a surface into its medium
};

/// The colours of one frame.
class FieldPaint final : public render::SurfacePaint {
public:
    /// \param view  must outlive the paint
    /// \return or BadArgument for a time outside of the field, a field without values, or isolines that are too dense
    [[nodiscard]] static Result<FieldPaint> make(const FieldView& view, const SceneField& look,
                                                 const render::FrameSpec& spec);
    [[nodiscard]] Vec3f colorAt(const Point& point) const noexcept override;
    /// The legend.
    [[nodiscard]] const ColorScale& scale() const noexcept { return scale_; }

private:
    FieldPaint(const FieldView& view, const render::CameraRays& rays, const render::Camera& camera)
        : view_(&view), rays_(rays), eye_(camera.eye) {}
    [[nodiscard]] float valueAt(const Point& point) const noexcept;
    [[nodiscard]] double lineAt(const Point& point, double value) const noexcept;

    const FieldView* view_;
    render::CameraRays rays_;
    Vec3d eye_;
    double seconds_ = 0, isolines_ = 0;
    std::vector<float> figures_;  // by label; empty: by place
    ColorScale scale_;
    std::vector<Vec3f> linear_;  // colours of the range in linear light
    std::vector<bool> isDark_;   // the same, whether a line on it is light
};

/// The time of a picture: `wanted`, or the first of the field.
/// \return seconds, or BadArgument outside of its times
[[nodiscard]] Result<double> timeOfField(const fields::FieldHead& head, std::optional<double> wanted);

}  // namespace svt::illustrate
