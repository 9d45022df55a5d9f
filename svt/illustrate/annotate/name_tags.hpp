#pragma once
/// \file
/// Names of components in a picture: inside what is seen of them where the text fits, else at the sides of the picture
/// with leader lines that do not cross.

#include <svt/analyze/selection.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::illustrate {

/// A name, and where it belongs.
struct NameTag {
    std::string text;
    double x = 0, y = 0;    ///< pixels, in the picture: the middle of the text, or the end of its leader line
    bool isInside = false;  ///< the text stands there
    double clearance = 0;   ///< pixels from (x, y) to the outline of what is named; what has most is named first
};

/// Name tags of a picture.
struct NameTags {
    std::vector<NameTag> tags;  ///< by label
    /// Range of pixel columns that are not background.
    double left = 0, right = 0;
    double taken = 0;             ///< pixels at the right side that are not for names
    double textHeight = 0;        ///< pixels
    std::size_t hiddenCount = 0;  ///< selected labels with voxels of which nothing to speak of is seen
};

/// Height of names in a picture: a fiftieth of the picture's height, at least 11 pixels.
[[nodiscard]] double nameHeight(std::int32_t pictureHeight) noexcept;
/// What a view leaves free at each side for names, as a share of the picture's width, 0 to 0.3.
[[nodiscard]] double nameMargin(std::int32_t width, std::int32_t height) noexcept;

/// `text` (UTF-8) as far as `width` pixels reach, with an ellipsis where it is cut.
[[nodiscard]] std::string shortened(const std::string& text, double width, double height);

/// Name tags of the labels that `queries` select and that are seen, at least as a spot of 3 pixels. A name stands where a
/// text of its size lies within the label in the picture, as near as possible to the pixel farthest from the label's
/// outline; else that pixel is the end of its leader line. A label without a name is named by its id.
/// \param rows  of volume.labels
/// \return the tags, or BadQuery, NothingSelected
/// Cost: O(pixels).
[[nodiscard]] Result<NameTags> findNameTags(const std::vector<std::string>& queries,
                                            const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                                            const render::Frame& frame);

/// The leader line of a name at the side of a picture, from its place to what it names.
struct Leader {
    std::string text;       ///< shortened to the room that it has
    bool isRight = false;   ///< the name stands at the right side
    double textLeft = 0;    ///< pixels; the text is centred at y0
    double x0 = 0, y0 = 0;  ///< where the line bends, after a short piece beside the text
    double x1 = 0, y1 = 0;  ///< where it ends
};

/// Finds the places of the tags that do not stand inside: one below the other, on the side that is nearer to what they
/// name. Where there is no room for all, those of the largest parts stay. No two leaders cross: from the top, each place
/// takes the end from which all others lie below its line (Bekos, Kaufmann, Symvonis and Wolff 2007, straight leaders).
/// \param width, height  of the picture without what is taken, pixels
/// Cost: O(tags^2) of those that have room.
[[nodiscard]] std::vector<Leader> layOutLeaders(const NameTags& tags, double width, double height);

/// Draws tags into a picture.
/// \param color, halo  of texts and leaders, and of the outline around them; sRGB
/// \return number of tags drawn
std::size_t drawNameTags(const NameTags& tags, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
