#pragma once
/// \file
/// Several volumes of different spacing in one frame: a fine flat in a coarse tower (the paper's non-uniform texture).
///
///     tower, 5 cm                         along a ray: gap 0 of the tower, the flat, gap 1 of the tower
///     +---------------------------+
///     |        +--------+         |       ----gap 0----|====flat====|----gap 1---->
///     |        | flat,  |         |
///     |        | 1 cm   |         |       Each is a pass; the later passes are parts of the first (Pass::Join::Part),
///     |        +--------+         |       so that they are composited from front to back as one.
///     +---------------------------+
///
/// All volumes share one table of labels, so queries, styles, names and the labels of pixels are the same for all of
/// them.

#include <svt/core/result.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <optional>
#include <span>
#include <vector>

namespace svt::illustrate {

/// The part of the surrounding volume that a detail replaces.
struct DetailPlace {
    /// The box of its samples, in which no other part of the volume is drawn. Unset if the detail contains all of its
    /// components completely: then only these components are omitted from the volume.
    std::optional<render::ConvexPart> box;
    std::vector<volume::Scalar> replaced;  ///< scalars of these components; empty with a box
};

/// Gives all volumes one table of labels: that of `volume`, followed by labels that only the details have (by id).
/// \return BadArgument if the reference systems differ, or there are too many scalars
[[nodiscard]] Result<void> joinLabels(volume::SemanticVolume& volume, std::span<volume::SemanticVolume> details);

/// \param detail  processed by joinLabels()
/// Cost: that of labelBoxes() of both.
[[nodiscard]] DetailPlace placeOfDetail(const volume::SemanticVolume& volume, const volume::SemanticVolume& detail);

/// Divides each pass of the volume into its gaps, and adds the details as parts of it. Shells are drawn without
/// details, unless the details have shells of their own.
/// \param representations  representations of the scene; detail d in representation r is volume (d + 1) * representations.size() + r
/// \return BadFrame if there are too many passes or clips, BadArgument if a pass has lines or meshes
[[nodiscard]] Result<void> addDetailPasses(std::span<const DetailPlace> details,
                                           std::span<const VolumeRepresentation> representations,
                                           render::FrameSpec& spec, bool haveShells = false);

}  // namespace svt::illustrate
