#pragma once
/// \file
/// An inset in its picture: its place, the part of the picture that it shows, and the frame and lines that mark this
/// part.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/ray_caster.hpp>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace svt::illustrate {

/// Pixels, from the upper left corner of the picture.
struct PictureBox {
    double left = 0, top = 0, right = 0, bottom = 0;
    [[nodiscard]] double width() const noexcept { return right - left; }
    [[nodiscard]] double height() const noexcept { return bottom - top; }
    friend bool operator==(const PictureBox&, const PictureBox&) = default;
};

/// The place of an inset in a picture: at its corner, with a distance of 2 % of the height to the border.
[[nodiscard]] PictureBox insetPlace(const Scene& scene, const Inset& inset);

/// Margins of a view for insets at the left and at the right, as shares of the width, 0 to 0.4.
struct InsetMargins {
    double left = 0, right = 0;
};
[[nodiscard]] InsetMargins insetMargins(const Scene& scene) noexcept;

/// The box of the visible parts of `frame` in the picture `other`, which has another camera on the same model. Empty if
/// no part lies in `other`.
[[nodiscard]] std::optional<PictureBox> boxOfSeen(const render::Frame& frame, const render::FrameSpec& spec,
                                                  const volume::Grid& grid, const render::FrameSpec& other);

/// The same for a box of samples, with a small margin.
[[nodiscard]] std::optional<PictureBox> boxOfSamples(const analyze::SampleBox& box, const volume::Grid& grid,
                                                     const render::FrameSpec& other);

/// The two lines that join corners of adjacent boxes: the edges of their common hull that lead from one to the other.
/// Fewer if one box lies within the width and height of the other.
[[nodiscard]] std::vector<std::pair<Vec3d, Vec3d>> leadersBetween(const PictureBox& a, const PictureBox& b);

/// Marks of the part that an inset shows: in the picture, or inside the inset if the inset shows a larger area than the
/// picture.
struct InsetMarks {
    std::optional<PictureBox> inPicture, inInset;
};
[[nodiscard]] InsetMarks findMarks(const render::Frame& inset, const render::FrameSpec& insetSpec,
                                   const render::Frame& picture, const render::FrameSpec& spec,
                                   const volume::Grid& grid);

/// Copies an inset into its picture: colours, labels and depths. Draws its frame and, if `shown`, the frame around the
/// part that it shows and the lines between them.
/// \param shown  box in the picture
void drawInset(const render::Frame& inset, const PictureBox& place, const std::optional<PictureBox>& shown, Vec3f color,
               Vec3f halo, render::Frame& picture);

/// Draws the frame around the area of the picture into an inset that shows more.
void drawMark(const PictureBox& shown, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
