#pragma once
/// \file
/// Names of components at the sides of a picture, with leader lines to the components.

#include <svt/analyze/selection.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::illustrate {

/// A name, and the end point of its leader line.
struct NameTag {
    std::string text;
    double x = 0, y = 0;    ///< pixels, in the picture
    bool isHidden = false;  ///< the component is not visible; the leader ends where its centre would be seen
};

/// Name tags of a picture.
struct NameTags {
    std::vector<NameTag> tags;  ///< by label
    /// Range of pixel columns that are not background.
    double left = 0, right = 0;
};

/// Name tags of the labels that `queries` select. Leaders of visible labels end at the pixel farthest from the label's
/// outline in the picture, those of hidden labels at the projected centre of the label's box. Labels without voxels or
/// outside the picture get no tag. A label without a name is named by its id.
/// \param rows   of volume.labels
/// \param frame  the frame drawn from `spec`
/// \return the tags, or BadQuery, NothingSelected
[[nodiscard]] Result<NameTags> findNameTags(const std::vector<std::string>& queries,
                                            const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                                            const render::FrameSpec& spec, const render::Frame& frame);

/// Draws tags into a picture: texts one below the other, to the left and right of what is shown, in the order of the
/// points that they name. Tags for which there is no room are left out.
/// \param textHeight   pixels; 0: a fiftieth of the picture's height, at least 11
/// \param color, halo  of texts and leaders, and of the outline around them; sRGB
/// \return number of tags drawn
std::size_t drawNameTags(const NameTags& tags, double textHeight, Vec3f color, Vec3f halo,
                         image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
