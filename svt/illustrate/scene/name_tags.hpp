#pragma once
/// \file
/// Names of components at the sides of a picture, with leader lines to what they name.

#include <svt/render/ray_caster.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::illustrate {

/// A name and where its leader ends.
struct NameTag {
    std::string text;
    double x = 0, y = 0;    ///< pixels, in the picture
    bool isHidden = false;  ///< nothing of it is seen; the leader ends where its middle would be
};

/// Names for a picture, and between which columns of pixels it shows anything.
struct NameTags {
    std::vector<NameTag> tags;  ///< by label
    double left = 0, right = 0;
};

/// Names of the labels that `queries` select: where they are seen, in the middle of their largest part; where they are
/// not, where the middle of their box lies. Labels without voxels or out of the picture have none. A label without a
/// name has its id.
/// \param frame  what `spec` shows
/// \return the tags, or BadQuery, NothingSelected
[[nodiscard]] Result<NameTags> findNameTags(const std::vector<std::string>& queries,
                                            const volume::SemanticVolume& volume, const render::FrameSpec& spec,
                                            const render::Frame& frame);

/// Draws tags into a picture: texts one below the other to the left and right of what is shown, as far as there is
/// room, in the order of the places they name. Tags that find no room are left out. \param textHeight  pixels; 0: a
/// fiftieth of the picture, 11 at least \param color, halo  of texts and leaders, and around them; sRGB \return how
/// many were drawn
std::size_t drawNameTags(const NameTags& tags, double textHeight, Vec3f color, Vec3f halo,
                         image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
