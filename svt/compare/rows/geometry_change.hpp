#pragma once
/// \file
/// The change of space of matched objects.

#include <svt/analyze/common_spaces.hpp>
#include <svt/compare/comparison.hpp>
#include <svt/compare/match/match_objects.hpp>
#include <svt/compare/match/voxel_overlaps.hpp>
#include <svt/compare/shape/surface_distance.hpp>

namespace svt::compare {

/// Measures the change of one match: `change`, `vector`, `rotation`, `added`, `removed`, `bound`, `distance` and `isExact` of a row.
class GeometryMeasurer {
public:
    GeometryMeasurer(const Sides& sides, const CompareOptions& options, analyze::CommonSpaces& spaces,
                     const VoxelOverlaps& voxels)
        : sides_(sides), options_(options), spaces_(spaces), voxels_(voxels) {}

    /// Distances and moves of a pair: parallel use is possible.
    void measureFaces(const Match& match, ComparisonRow& row) const;
    /// Volumes of any match, before measureFaces(). Not thread-safe, because it takes from the work of CommonSpaces.
    void measureVolumes(const Match& match, ComparisonRow& row);

private:
    [[nodiscard]] bool measureExactly(const Match& match, ComparisonRow& row);
    void measureMove(const Shape& a, const FaceTree& treeOfA, const Shape& b, const FaceTree& treeOfB,
                     ComparisonRow& row) const;
    void measureVoxels(const Match& match, ComparisonRow& row) const;
    [[nodiscard]] double voxelBound(const Match& match) const;

    Sides sides_;
    CompareOptions options_;
    analyze::CommonSpaces& spaces_;
    const VoxelOverlaps& voxels_;
};

}  // namespace svt::compare
