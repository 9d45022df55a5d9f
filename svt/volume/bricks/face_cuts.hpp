#pragma once
/// \file
/// Puts borders that are parallel to an axis onto the planes of the model's faces.
///
///      voxels            7     8     9     10     of bricks 0 and 1
///      samples         o     o     o     o
///      a face              |
///      its border            ^                   at the face of the voxel, which is that of the bricks, too
///
/// A cut of a brick lies between voxels. If a face of the model is known between the samples on both sides of a cut,
/// the plane of the face replaces the cut. A face may lie in the brick next to the one whose samples it bounds, as in
/// the drawing. Then this brick is coded, too: beyond the plane it has the labels of the samples beyond, up to the
/// corners.

#include <svt/volume/bricks/brick_coder.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// The codes of a tile: by place an index in `codes`, or TileBoxes::kNone. BrickCode::plane are indices in `planes`.
struct TileBrickCodes {
    std::vector<std::uint32_t> codeIndex;
    std::vector<BrickCode> codes;
    std::vector<BrickPlane> planes;
};

/// Replaces cuts of `tile` by planes of `faces` that are (nearly) across an axis, and codes uniform bricks that they
/// cross. All samples keep their labels. A brick has at most three planes and one more across each axis; a cut stays if
/// there is no room. Bricks without a code and without an oblique face nearby are first coded by sides at all places
/// where labels change, at most six.
/// Cost: O(bricks), and about 2 us for each brick that a face crosses in the half voxel at its side.
void moveCutsToFaces(const TilePlaces& places, const std::vector<BrickPattern>& patterns,
                     std::span<const FacePlane> faces, const ColumnVolume& columns, TileBrickCodes& tile);

}  // namespace svt::volume
