#pragma once
/// \file
/// Line drawings in three dimensions: what a camera sees, as exact lines and filled cuts instead of pixels.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::drawing {

struct LineViewOptions {
    bool hidden = false;  ///< also edges that are hidden
    int threads = 0;      ///< 0: all cores; the result does not depend on it
};

/// A line drawing: polygons of the cut, its borders, and lines, in the plane through the camera's target across the view.
struct LineView {
    SectionDrawing drawing;        ///< u to the right, v upwards, metres in that plane; areas are those of the picture
    double width = 0, height = 0;  ///< of the picture, metres in that plane; its middle is the drawing's zero
};

/// Draws what `frame` shows of the meshes that the volume keeps: its camera, and of its only pass what is not hidden and
/// the plane that cuts it. Everything drawn is opaque. What is cut is filled where the camera looks at the cut; a
/// perspective camera shows nothing nearer than 50 mm, and closed bodies that it stands in from within.
/// \return the view, or
///         - BadFrame   the frame has several passes, or clips other than one plane
///         - BadCamera  the camera stands in the plane's cut
///         - BadArgument  the volume keeps no meshes
///         - errors of drawSection()
/// Cost: that of a section with lines beyond it.
[[nodiscard]] Result<LineView> drawLineView(const volume::SemanticVolume& volume, const render::FrameSpec& frame,
                                            const LineViewOptions& options = {});

}  // namespace svt::drawing
