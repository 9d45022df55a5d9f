#pragma once
/// \file
/// The section of a volume by the meshes that it stores: the borders of all objects in one arrangement, each region
/// with the label that voxels there would have.
///
///     closed meshes       rings with their inside, at the rank of the object.
///     bodies              the material of a building, divided among its boundary surfaces.
///     sheets              lines, unless objects of higher priority are on both sides.
///     open shells         the polygons of their voxels.

#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/section/section_pieces.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::drawing {

struct ExactSection {
    std::vector<PieceEdge> edges;  ///< like cutPieces(): each edge between two labels is present in both directions
    std::vector<PieceEdge> lines;  ///< of sheets, each once
    std::vector<std::uint8_t> isExact;  ///< by label; 0: drawn by voxels
    double drawingUnit = 1;             ///< metres
    std::int32_t tolerance = 1;         ///< distance that points were moved to meet others, drawing units
    std::size_t edgesInPlane = 0;       ///< see MeshCut
    double planeShift = 0;              ///< see MeshCut
};

/// Whether the volume keeps triangles, so that cutExactly() can be used.
[[nodiscard]] bool hasMeshes(const volume::SemanticVolume& volume) noexcept;

/// Cuts `volume` with the plane through `axes`.
/// \param bricks   bricks of the volume, or null: made if open shells are cut
/// \param isDrawn  by label; other labels are gaps
/// \param tables   of the volume
/// \return the section; nothing if plane::arrangeSegments() returns nothing; or the error of
///         BrickVolume::fromColumns()
[[nodiscard]] Result<std::optional<ExactSection>> cutExactly(const volume::SemanticVolume& volume,
                                                             const volume::BrickVolume* bricks,
                                                             const SectionPlane& plane, const PlaneAxes& axes,
                                                             std::span<const std::uint8_t> isDrawn,
                                                             const DrawingTables& tables, int threads);

}  // namespace svt::drawing
