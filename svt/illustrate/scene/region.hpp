#pragma once
/// \file
/// Regions of space, parsed from text: planes, boxes, balls, ..., combined by and, or, not (Diepstraten 2003 cuts by
/// such Boolean combinations of half-spaces). Lens, section and cutaway are all regions.
///
///     z>1.2 and not box(2,2,0,4,4,3)         storey(EG)         cutaway(name="Unterzug-1")
///
/// Grammar (keywords are case-insensitive):
///
///     region    := and ('or' and)*
///     and       := not ('and' not)*
///     not       := 'not' not | '(' region ')' | primitive
///     primitive := a plane, see parseSectionPlane(): the side that it cuts away.
///                | box(x0,y0,z0, x1,y1,z1) | ball(x,y,z, r) | cylinder(x,y,z, dx,dy,dz, r)
///                | prism(x1,y1, x2,y2, ...; z0,z1)   vertical, over a simple polygon
///                | storey(NAME)                      from its floor to its ceiling
///                | around(QUERY[; margin])           box around the selection of the query
///                | view(x,y, r)                      the space visible in a circle of the picture: x and y
///                                                    from its upper left corner, as shares of its width
///                                                    and height; r as a share of its height.
///                | cutaway(QUERY[; margin])          the space that hides the selection of the query: a cone
///                                                    that opens towards the viewer, with its apex behind
///                                                    the target.
///
/// A plane that lies in faces of the model is moved slightly off them, see hairOffFaces(). Lengths are in metres;
/// coordinates in metres from the grid's lower corner along its axes.

#include <svt/analyze/selection.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string_view>
#include <vector>

namespace svt::illustrate {

/// Data on which a region may depend.
struct RegionContext {
    const volume::SemanticVolume& volume;
    const analyze::LabelRows& rows;  ///< of volume.labels
    render::Camera camera;
    double aspect = 1;                         ///< width / height of the picture
    std::vector<MovedPlane>* moved = nullptr;  ///< receives the planes that lie in faces; may be null
};

/// Parses a region into a union of convex parts.
/// \return the parts, or
///         - BadSection                 the text cannot be parsed (the message states column, found and expected
///                                      text), a size is not positive, a plane misses the volume, or `not` of a round
///                                      primitive. Also for more than Pass::kMaxClipParts parts, or a part with more
///                                      than ConvexPart::kMaxFaces faces.
///         - BadQuery, NothingSelected  of a query in it
[[nodiscard]] Result<std::vector<render::ConvexPart>> parseRegion(std::string_view text, const RegionContext& context);

/// Whether a region may have parts that depend on the camera. Cost: O(length of the text).
[[nodiscard]] bool dependsOnView(std::string_view region);

}  // namespace svt::illustrate
