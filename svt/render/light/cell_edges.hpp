#pragma once
/// \file
/// Edges of voxels, where a picture shows the cells themselves (figure 8 of the paper).

#include <svt/render/light/sample.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

namespace svt::render {

/// Draws the edges of the voxel, or cell of a level, on which a sample lies. Where cells are less than three pixels
/// wide they are left out: they would only darken the picture.
/// \param pass  whose sample it is
/// \param u, v  see CameraRays::at()
void drawCellEdges(const PreparedFrame& frame, std::size_t pass, double u, double v, Sample& sample) noexcept;

}  // namespace svt::render
