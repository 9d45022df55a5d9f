#pragma once
/// \file
/// The tiles of a city that a camera needs, and their volumes: one for each level of detail, for any number of tiles.
///
///     far   |  top tile      detail 5, voxels of 16 m    ...+---+---+
///           |                                               |   5   |     A tile is drawn at the coarsest detail whose
///           |                                           +---+---+---+     voxels are at most a pixel. So the volumes
///     near  |                                           | 4 |1|0| 4 |     together have some voxels for each pixel,
///     eye   +---------------                            +---+---+---+     whatever the size of the city.
///
/// Volumes of one detail lie on one lattice and are joined. The empty space between thousands of tiles is therefore
/// skipped in the same way as within a volume.

#include <svt/city/city_folder.hpp>
#include <svt/render/frame_spec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::city {

/// The view of a camera. All in world space, metres; the three axes have unit length.
struct CameraView {
    bool isPerspective = true;
    Vec3d eye, forward, right, up;
    double halfWidth = 1, halfHeight = 1;  ///< of the picture: metres; in a perspective picture, at depth 1
    double pixel = 0.001;                  ///< height of a pixel: metres; in a perspective picture, at depth 1
    Vec3d towardsLight;                    ///< of the light that casts shadows, unit length; zero: no such light
};

/// The view of a frame's camera on the frame's grid, and the light that casts shadows there.
[[nodiscard]] CameraView cameraViewOf(const render::FrameSpec& spec, const volume::Grid& grid);

/// The tiles for a picture.
struct ChosenTiles {
    std::vector<IndexEntry>
        entries;              ///< by detail, the coarsest first, then along the Morton curve; the near ones last
    std::size_t near = 0;     ///< number of tiles of the finest detail whose voxels are wider than kNearPixels
    std::uint64_t bytes = 0;  ///< of the members
    double pixels = 1;        ///< maximum width of voxels in pixels; above 1 if memory is short
};

/// The tiles that a camera sees, and those whose shadows it may see.
/// \param memoryBytes  limit for the decoded and joined tiles (an estimate: kBytesAByte per byte of a member)
/// \param finest       finest detail to choose
/// \return the tiles, or the errors of City::find()
/// Cost: O(chosen tiles); reads only the pages of the index that hold them.
[[nodiscard]] Result<ChosenTiles> chooseTiles(const City& city, const CameraView& view, std::uint64_t memoryBytes,
                                              int finest = 0);
inline constexpr std::uint64_t kBytesAByte = 60;
inline constexpr double kNearPixels = 1.5;  ///< wider voxels show whether slopes are flat

/// Depths of a picture of a view: metres along the view direction, by row from the top; infinity where it is empty.
struct SeenDepths {
    std::int32_t width = 0, height = 0;
    std::span<const float> depth;
};
/// For each entry, whether the entry and its shadow are behind the depths of all pixels that they could cover.
[[nodiscard]] std::vector<bool> areHidden(const City& city, const CameraView& view, const SeenDepths& seen,
                                          std::span<const IndexEntry> entries);
/// The entries nearest to the eye: at least one, until they have `share` of the bytes.
[[nodiscard]] ChosenTiles nearestOf(const City& city, const CameraView& view, const ChosenTiles& chosen, double share);

/// Reads tiles and joins those of one detail; near ones become a volume of their own.
/// \return the volumes, the coarsest first, near ones last; or the errors of City::read(), GridTooLarge, TooManyLabels,
///         Cancelled
/// Memory: the volumes.
[[nodiscard]] Result<std::vector<volume::SemanticVolume>> readTiles(const City& city, const ChosenTiles& chosen,
                                                                    int threads = 0,
                                                                    const Progress* progress = nullptr);

/// A volume without labels in the box of the city, with 129 x 129 x 33 samples. Positions of cameras, planes and
/// regions refer to it.
[[nodiscard]] Result<volume::SemanticVolume> frameVolume(const City& city);

/// A table with a label for each class of the city and, below it, for the classes of its parts. Each has one scalar and
/// an id such as "Building" or "Building/RoofSurface". Mixtures of coarse details refer to these ids (coverageOf()).
[[nodiscard]] volume::LabelTable classTable(const City& city);

}  // namespace svt::city
