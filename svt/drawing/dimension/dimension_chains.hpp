#pragma once
/// \file
/// Chains of dimensions around a plan, as architects draw them: the parts of the building that are visible from each
/// side.
///
///     +==[ ]====+=====[     ]==+        walls and openings of the face that is seen
///     |         |              |
///     |  room   |     room     |
///
///     |--|-|----|-----|-----|--|        row 0: alternating walls and openings, and steps of the face
///     |-|-----|---|----------|-|        row 1: walls and rooms behind the face
///     |------------------------|        row 2: overall

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::drawing {

/// Finds the chains of a horizontal section; other sections have no chains.
///
/// A side is viewed along lines perpendicular to it. The first wall or filling on each line is the face. A stop is a
/// place where walls and fillings alternate, or where the face steps by 50 mm. Behind a face up to 1 m thick follow the
/// rooms, or the air between walls if no rooms are drawn. Furniture, installations and terrain do not count. If less
/// than 60 % of the length of walls runs along u or v, a side has only its overall length. Oblique parts of a face have
/// no stops. Parts below 15 mm, chains of more than 80 parts, and chains that repeat the next one are omitted.
/// \param drawing  with borders and lines
/// Cost: O(borders * stops that one spans); beyond 50 million of these, only the overall length is given.
[[nodiscard]] std::vector<DimensionChain> findDimensions(const SectionDrawing& drawing,
                                                         const volume::SemanticVolume& volume);

}  // namespace svt::drawing
