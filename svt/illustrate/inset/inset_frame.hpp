#pragma once
/// \file
/// An inset in its picture: where it stands, what of the picture it shows, and the frame and lines that say so.

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

/// Where an inset stands in a picture: at its corner, away from the rim by 2 % of the height.
[[nodiscard]] PictureBox insetPlace(const Scene& scene, const Inset& inset);

/// Shares of the width that a view leaves free for insets at the left and at the right, 0 to 0.4.
struct InsetMargins {
    double left = 0, right = 0;
};
[[nodiscard]] InsetMargins insetMargins(const Scene& scene) noexcept;

/// What is seen in `frame`, as a box in the picture `other`, which has another camera on the same model. Nothing where
/// nothing of it lies in `other`.
[[nodiscard]] std::optional<PictureBox> boxOfSeen(const render::Frame& frame, const render::FrameSpec& spec,
                                                  const volume::Grid& grid, const render::FrameSpec& other);

/// The same of a box of samples, with a little air around it.
[[nodiscard]] std::optional<PictureBox> boxOfSamples(const analyze::SampleBox& box, const volume::Grid& grid,
                                                     const render::FrameSpec& other);

/// The two lines that join corners of boxes side by side: those edges of the hull of both that lead from one to the other.
/// Fewer where one lies within the other's breadth and height.
[[nodiscard]] std::vector<std::pair<Vec3d, Vec3d>> leadersBetween(const PictureBox& a, const PictureBox& b);

/// Marks of what an inset shows: in the picture or, where the inset shows most of that and more, in the inset.
struct InsetMarks {
    std::optional<PictureBox> inPicture, inInset;
};
[[nodiscard]] InsetMarks findMarks(const render::Frame& inset, const render::FrameSpec& insetSpec,
                                   const render::Frame& picture, const render::FrameSpec& spec,
                                   const volume::Grid& grid);

/// Copies an inset into its picture: colours, labels and depths. Draws its frame and, if `shown`, the frame around what it
/// shows and the lines between them.
/// \param shown  in the picture
void drawInset(const render::Frame& inset, const PictureBox& place, const std::optional<PictureBox>& shown, Vec3f color,
               Vec3f halo, render::Frame& picture);

/// Draws the frame around what the picture shows into an inset that shows more.
void drawMark(const PictureBox& shown, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
