#pragma once
/// \file
/// The volume that a page has open: drawn, picked and asked. Holds what is dear to make between calls.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/render/ray_labels.hpp>
#include <svt/render_gl/gl_renderer.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::web {

/// What lies under a place of a picture.
struct Picked {
    volume::Scalar scalar = 0;
    std::uint32_t label = 0;
    Vec3d point{};  ///< metres from the grid's lower corner
};

class Session {
public:
    /// A volume from the bytes of a `.svt`, or of a model, whose feature edges are kept.
    /// \param name  stands for the file in messages
    /// \return the session, or what readSvt(), readModel() or buildVolume() returns
    [[nodiscard]] static Result<std::unique_ptr<Session>> open(std::span<const std::byte> bytes,
                                                               const std::string& name, const Progress* progress);

    [[nodiscard]] const volume::SemanticVolume& volume() const noexcept { return volume_; }
    /// Of building it from a model.
    [[nodiscard]] const Diagnostics& findings() const noexcept { return findings_; }

    /// Draws `scene` as `svt render` does; pick() and along() are of this picture then.
    /// \param isDraft  it is a first picture, see ScenePainter::paintDraft()
    [[nodiscard]] Result<const render::Frame*> draw(const illustrate::Scene& scene, bool isDraft = false);
    /// Whether pick() and along() are of a picture.
    enum class Purpose : std::uint8_t { Shown, Trial };
    /// The same by WebGL2, into the lower left of the framebuffer of the context that is current; always the same one.
    /// \return nothing, or what draw() and GlRenderer return; BadArgument where the scene needs the CPU: names, shells
    ///         beside the volume, levels of detail
    [[nodiscard]] Result<void> drawGl(const illustrate::Scene& scene, Purpose purpose);
    /// Forgets what the context holds, as where it was lost.
    void dropGl();
    /// Width by height of the last picture; 16 : 9 before the first.
    [[nodiscard]] double aspect() const noexcept;
    /// The same as a PNG; the picture on the screen stays the last one.
    [[nodiscard]] Result<std::vector<std::byte>> picture(const illustrate::Scene& scene);

    /// The scalars of such a picture, as `svt render --labels` writes them.
    [[nodiscard]] Result<std::vector<std::byte>> labels(const illustrate::Scene& scene);

    /// \param x, y  share of the last picture's width and height
    /// \return what is seen there, or nothing
    [[nodiscard]] std::optional<Picked> pick(double x, double y);
    /// All along the ray through a place of the last picture, nearest first.
    [[nodiscard]] Result<std::vector<render::RayStretch>> along(double x, double y);

    /// Who touches whom; made when first asked for.
    [[nodiscard]] const std::vector<analyze::Contact>& contacts();
    [[nodiscard]] const std::vector<analyze::LabelMeasure>& measures();

private:
    Session(volume::SemanticVolume volume, Diagnostics findings)
        : volume_(std::move(volume)), findings_(std::move(findings)), painter_(volume_) {}

    volume::SemanticVolume volume_;
    Diagnostics findings_;
    illustrate::ScenePainter painter_;
    std::optional<render::FrameSpec> lastSpec_;
    std::optional<render::Frame> lastFrame_;  // none where WebGL2 drew
    std::optional<render_gl::GlRenderer> gl_;
    std::vector<std::uint32_t> labelOfScalar_;
    std::optional<std::vector<analyze::Contact>> contacts_;
    std::optional<std::vector<analyze::LabelMeasure>> measures_;
};

}  // namespace svt::web
