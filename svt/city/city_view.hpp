#pragma once
/// \file
/// The tiles of a city that a camera needs, and their volumes: one for each level of detail, however many tiles.
///
///     far   |  top tile      detail 5, voxels of 16 m    ...+---+---+
///           |                                               |   5   |     A tile is drawn at the coarsest detail whose
///           |                                           +---+---+---+     voxels are at most a pixel. So the volumes
///     near  |                                           | 4 |1|0| 4 |     together have some voxels for each pixel,
///     eye   +---------------                            +---+---+---+     whatever the size of the city.
///
/// Volumes of one detail lie on one lattice and are joined, so that the empty space between thousands of tiles is skipped
/// like that within a volume.

#include <svt/city/city_folder.hpp>
#include <svt/render/frame_spec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::city {

/// What a camera sees. All in world space, metres; the three axes are of unit length.
struct CameraView {
    bool isPerspective = true;
    Vec3d eye, forward, right, up;
    double halfWidth = 1, halfHeight = 1;  ///< of the picture: metres; of a perspective one at depth 1
    double pixel = 0.001;                  ///< height of a pixel: metres; of a perspective one at depth 1
    Vec3d towardsLight;                    ///< of a light that casts shadows, unit length; zero: there is none
};

/// What the camera of a frame sees of a frame's grid, and the light that casts shadows there.
[[nodiscard]] CameraView cameraViewOf(const render::FrameSpec& spec, const volume::Grid& grid);

/// What is chosen for a picture.
struct ChosenTiles {
    std::vector<IndexEntry>
        entries;              ///< by detail, the coarsest first, then along the Morton curve; the near ones last
    std::size_t near = 0;     ///< so many of the finest detail have voxels wider than kNearPixels
    std::uint64_t bytes = 0;  ///< of the members
    double pixels = 1;        ///< voxels are at most as wide; above 1 where memory is short
};

/// The tiles that a camera sees, and those whose shadows it may see.
/// \param memoryBytes  what they may take when they are decoded and joined (a guess: kBytesAByte for each byte of theirs)
/// \param finest       no finer detail than this
/// \return the tiles, or the errors of City::find()
/// Cost: O(tiles chosen); reads the pages of the index that have them.
[[nodiscard]] Result<ChosenTiles> chooseTiles(const City& city, const CameraView& view, std::uint64_t memoryBytes,
                                              int finest = 0);
inline constexpr std::uint64_t kBytesAByte = 60;
inline constexpr double kNearPixels = 1.5;  ///< what is wider shows whether its slopes are flat

/// What is seen in a picture of a view: metres along the view direction, by row from the top, infinity where nothing is.
struct SeenDepths {
    std::int32_t width = 0, height = 0;
    std::span<const float> depth;
};
/// For each entry whether it, and its shadow, is behind what is seen in all of the pixels where it could be.
[[nodiscard]] std::vector<bool> areHidden(const City& city, const CameraView& view, const SeenDepths& seen,
                                          std::span<const IndexEntry> entries);
/// The entries that are nearest to the eye: at least one, and then so many as have `share` of the bytes.
[[nodiscard]] ChosenTiles nearestOf(const City& city, const CameraView& view, const ChosenTiles& chosen, double share);

/// Reads tiles and joins those of one detail, near ones apart. \return volumes, the coarsest first, near ones last; or the errors of City::read(),
/// GridTooLarge, TooManyLabels, Cancelled
/// Memory: the volumes.
[[nodiscard]] Result<std::vector<volume::SemanticVolume>> readTiles(const City& city, const ChosenTiles& chosen,
                                                                    int threads = 0,
                                                                    const Progress* progress = nullptr);

/// A volume without labels in the box of the city, with two samples along each axis: what positions of cameras, planes and
/// regions refer to.
[[nodiscard]] Result<volume::SemanticVolume> frameVolume(const City& city);

/// A label for each class of the city and, below it, of its parts, with a scalar each and the ids "Building" and
/// "Building/RoofSurface": what mixtures of coarse details are made of (coverageOf()).
[[nodiscard]] volume::LabelTable classTable(const City& city);

}  // namespace svt::city
