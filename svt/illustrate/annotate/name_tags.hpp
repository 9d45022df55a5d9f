#pragma once
/// \file
/// Names of components in a picture: inside their visible parts if the text fits, otherwise at the sides of the picture
/// with leader lines that do not cross.

#include <svt/analyze/selection.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::illustrate {

/// A name, and its place.
struct NameTag {
    std::string text;
    double x = 0, y = 0;    ///< pixels, in the picture: the centre of the text, or the end of its leader line
    bool isInside = false;  ///< the text is drawn at (x, y)
    double clearance = 0;   ///< pixels from (x, y) to the label's outline; the tag with the largest is placed first
};

/// Name tags of a picture.
struct NameTags {
    std::vector<NameTag> tags;  ///< by label
    /// Range of pixel columns that are not background.
    double left = 0, right = 0;
    double taken = 0;             ///< pixels at the right side that are reserved for other marks
    double textHeight = 0;        ///< pixels
    std::size_t hiddenCount = 0;  ///< selected labels with voxels that are not, or hardly, visible
};

/// Height of names in a picture: a fiftieth of the picture's height, at least 11 pixels.
[[nodiscard]] double nameHeight(std::int32_t pictureHeight) noexcept;
/// The margin at each side of a view for names, as a share of the picture's width, 0 to 0.3.
[[nodiscard]] double nameMargin(std::int32_t width, std::int32_t height) noexcept;

/// `text` (UTF-8), shortened to `width` pixels with an ellipsis.
[[nodiscard]] std::string shortened(const std::string& text, double width, double height);

/// Name tags of the labels that `queries` select and that are visible as a spot of at least 3 pixels. A name is placed
/// where its text lies within the label in the picture, as near as possible to the pixel farthest from the label's
/// outline. If the text does not fit, that pixel is the end of its leader line. A label without a name is named by its
/// id. A selected space of which no part is selected is named once, over all of its parts (Extents::wholes()).
/// \param rows  of volume.labels
/// \return the tags, or BadQuery, NothingSelected
/// Cost: O(pixels).
[[nodiscard]] Result<NameTags> findNameTags(const std::vector<std::string>& queries,
                                            const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                                            const render::Frame& frame);

/// The leader line of a name at the side of a picture, from the text to the label.
struct Leader {
    std::string text;       ///< shortened to the available width
    bool isRight = false;   ///< the name is at the right side
    double textLeft = 0;    ///< pixels; the text is centred at y0
    double x0 = 0, y0 = 0;  ///< bend of the line, after a short piece beside the text
    double x1 = 0, y1 = 0;  ///< end of the line
};

/// Finds the places of the tags that are not inside: one below the other, on the side that is nearer to their labels.
/// If space is short, the tags of the largest parts are kept. No two leaders cross: from the top, each place takes the
/// end whose line leaves all other ends below it (Bekos, Kaufmann, Symvonis and Wolff 2007, straight leaders).
/// \param width, height  size of the picture without reserved parts, pixels
/// Cost: O(tags^2) for the tags that fit.
[[nodiscard]] std::vector<Leader> layOutLeaders(const NameTags& tags, double width, double height);

/// Draws tags into a picture.
/// \param color, halo  colours of texts and leaders, and of the outline around them; sRGB
/// \return number of tags drawn
std::size_t drawNameTags(const NameTags& tags, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
