#pragma once
/// \file
/// Line drawings in three dimensions: the view of a camera as exact lines and filled cuts instead of pixels.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::drawing {

struct LineViewOptions {
    bool hidden = false;  ///< also draw hidden edges
    int threads = 0;      ///< 0: all cores; the result does not depend on it
};

/// A line drawing: polygons of the cut, its borders, and lines. All lie in the plane through the camera's target,
/// perpendicular to the view direction.
struct LineView {
    SectionDrawing drawing;        ///< u to the right, v upwards, metres in that plane; areas are those of the picture
    double width = 0, height = 0;  ///< of the picture, metres in that plane; its middle is the drawing's zero
};

/// Draws the view of `frame` from the meshes that the volume stores. Uses the camera, and the visible labels and
/// cutting plane of the only pass. Everything drawn is opaque. Cut components are filled if the camera looks at the
/// cut. A perspective camera shows nothing nearer than 50 mm. It shows the inside of closed solids that it stands in.
/// \return the view, or
///         - BadFrame   the frame has several passes, or clips other than one plane.
///         - BadCamera  the camera stands in a component that the plane cuts.
///         - BadArgument  the volume stores no meshes.
///         - errors of drawSection()
/// Cost: that of a section with lines beyond it.
[[nodiscard]] Result<LineView> drawLineView(const volume::SemanticVolume& volume, const render::FrameSpec& frame,
                                            const LineViewOptions& options = {});

}  // namespace svt::drawing
