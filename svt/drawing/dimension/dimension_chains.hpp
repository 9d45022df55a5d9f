#pragma once
/// \file
/// Chains of dimensions around a plan, as architects draw them: what one sees of the building from each side.
///
///     +==[ ]====+=====[     ]==+        walls and openings of the face that is seen
///     |         |              |
///     |  room   |     room     |
///
///     |--|-|----|-----|-----|--|        row 0: wall and opening by turns, and steps of the face
///     |-|-----|---|----------|-|        row 1: walls and rooms behind the face
///     |------------------------|        row 2: overall

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::drawing {

/// Finds the chains of a horizontal section; others have none.
///
/// A side is looked at along lines across it: the first wall or filling on each is the face, and a stop is where one
/// turns to the other, or where the face steps by 50 mm. Behind a face at most 1 m thick the rooms follow, or the air
/// between walls where no rooms are drawn. Furniture, installations and terrain do not count. Where less than 60 % of
/// the length of walls runs along u or v, a side has its overall length only; parts of a face that are oblique have no
/// stops. Parts below 15 mm, chains of more than 80 parts, and chains that say no more than the next one are left out.
/// \param drawing  its borders and lines
/// Cost: O(borders * stops that one spans); more than 50 million of these leave the overall length.
[[nodiscard]] std::vector<DimensionChain> findDimensions(const SectionDrawing& drawing,
                                                         const volume::SemanticVolume& volume);

}  // namespace svt::drawing
