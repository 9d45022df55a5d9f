#pragma once
/// \file
/// Several volumes of different spacing in one frame: a fine flat in a coarse tower (the paper's non-uniform texture).
///
///     tower, 5 cm                         along a ray: gap 0 of the tower, the flat, gap 1 of the tower
///     +---------------------------+
///     |        +--------+         |       ----gap 0----|====flat====|----gap 1---->
///     |        | flat,  |         |
///     |        | 1 cm   |         |       Each is a pass; the passes after the first are parts of it (Pass::Join::Part),
///     |        +--------+         |       so that they are composited from front to back as one.
///     +---------------------------+
///
/// All volumes share one table of labels, so queries, styles, names and what a pixel shows are the same for all of them.

#include <svt/core/result.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <optional>
#include <span>
#include <vector>

namespace svt::illustrate {

/// How a detail takes the place of a part of the volume around it.
struct DetailPlace {
    /// The box of its samples: nothing else of the volume is drawn in it. None where the detail has each of its components
    /// as a whole: then these components alone are left out of the volume.
    std::optional<render::ConvexPart> box;
    std::vector<volume::Scalar> replaced;  ///< scalars of these components; empty with a box
};

/// Gives all volumes one table of labels: that of `volume`, with labels of the details that it has not (by id) at its end.
/// \return BadArgument where the reference systems differ, or there are too many scalars
[[nodiscard]] Result<void> joinLabels(volume::SemanticVolume& volume, std::span<volume::SemanticVolume> details);

/// \param detail  of joinLabels()
/// Cost: that of labelBoxes() of both.
[[nodiscard]] DetailPlace placeOfDetail(const volume::SemanticVolume& volume, const volume::SemanticVolume& detail);

/// Divides each pass of the volume into its gaps, and adds the details as parts of it. Shells are drawn without details,
/// unless they have shells of their own.
/// \param forms  of the scene; detail d in form f is volume (d + 1) * forms.size() + f
/// \return BadFrame where there are too many passes or clips, BadArgument where a pass has lines or meshes
[[nodiscard]] Result<void> addDetailPasses(std::span<const DetailPlace> details, std::span<const VolumeForm> forms,
                                           render::FrameSpec& spec, bool haveShells = false);

}  // namespace svt::illustrate
