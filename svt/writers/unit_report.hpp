#pragma once
/// \file
/// A report about a legal unit, one page of A4 per unit, as PDF:
///
///     +---------------------------+
///     | name, id, building        |
///     | plan, the     | 3D view,  |
///     | unit lit      | the unit  |
///     |               | in lines  |
///     | section                   |
///     | areas and     | neighbours|
///     | rooms         | owners    |
///     | sources                   |
///     +---------------------------+

#include <svt/analyze/land_administration.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/pdf_file.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace svt::writers {

/// \param spaces   indices into LegalSpaces::spaces, one page each; none of them is SpaceBody::None
/// \param view     the building from a parallel camera, the lines around the unit; null: no 3D view
/// \param threads  0: all cores; the result does not depend on it
/// \return the file; equal input gives equal bytes with one release of cairo. Errors: NothingSelected for a space
///         without geometry, NoCairo, CannotWrite, and those of drawSection() and measureFloorAreas()
[[nodiscard]] Result<PdfFile> makeUnitReports(const analyze::LandAdministration& administration,
                                              std::span<const std::uint32_t> spaces,
                                              const volume::SemanticVolume& volume, const drawing::LineView* view,
                                              int threads = 0);

}  // namespace svt::writers
