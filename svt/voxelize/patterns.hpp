#pragma once
/// \file
/// Spatial patterns: solid textures in metres, laid along an object's own axes, repeated to fill its envelope and
/// masked by its voxels (paper, section 4.2.2 and figure 9). They are continuous in all three directions, so that every
/// section shows them correctly.

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace svt::voxelize {

enum class PatternKind : std::uint8_t {
    None,
    Brick,       ///< running bond: 0 brick, 1 joint
    Block,       ///< large blocks in running bond with thin joints: 0 block, 1 joint
    Hatch,       ///< oblique layers: 0 ground, 1 line
    Stripes,     ///< layers along one direction, alternating: 0, 1
    Checker,     ///< cubes, alternating: 0, 1
    Grid,        ///< lattice of planes: 0 ground, 1 line
    WoodGrain,   ///< growth rings around the long axis: 0 early wood, 1 late wood
    Concrete,    ///< grains in cement: 0 cement, 1 fine grain, 2 coarse grain
    Insulation,  ///< soft waves: 0 ground, 1 line
    Image,       ///< an image over length and height, constant through the depth: one phase per colour
    Raw          ///< a 3D file of bytes: one phase per value
};
constexpr auto namesOf(PatternKind) {
    using enum PatternKind;
    return std::to_array<Name<PatternKind>>({{None, "none"},
                                             {Brick, "brick"},
                                             {Block, "block"},
                                             {Hatch, "hatch"},
                                             {Stripes, "stripes"},
                                             {Checker, "checker"},
                                             {Grid, "grid"},
                                             {WoodGrain, "wood-grain"},
                                             {Concrete, "concrete"},
                                             {Insulation, "insulation"},
                                             {Image, "image"},
                                             {Raw, "raw"}});
}

/// Texels of a pattern read from a file: x fastest, then y (rows bottom up), then z.
struct PatternTexels {
    Vec3i dimension{};
    std::uint32_t phaseCount = 1;
    std::vector<std::uint8_t> phases;
    std::vector<Vec3f> colors;  ///< per phase, sRGB; empty for raw files
};

/// A pattern and its dimensions in metres. u runs along the object's dominant horizontal edge, v across it, w up.
struct Pattern {
    PatternKind kind = PatternKind::None;
    Vec3d size{
        0, 0,
        0};  ///< of one unit along u, v, w; hatch, stripes, wood grain and concrete use only w; 0: the kind's default
    double line = 0;                              ///< width of joints and lines; 0: the kind's default
    double angleDegrees = 45;                     ///< hatch: from u towards w
    std::uint32_t seed = 1;                       ///< grains, rings
    std::shared_ptr<const PatternTexels> texels;  ///< image, raw

    /// Number of scalars that an object with this pattern owns; 1 for None.
    [[nodiscard]] std::uint32_t phaseCount() const noexcept;
    /// Phase at a point along the object's axes (metres from the lower corner of its envelope along them), 0 to
    /// phaseCount() - 1. The result is the same on every machine: only sqrt and floor of the math library are used.
    [[nodiscard]] std::uint32_t phaseAt(Vec3d uvw) const noexcept;
};

/// Fills in the defaults of the kind and checks the dimensions.
/// \return the pattern, or BadPattern that names the dimension and its valid range (1e-4 to 1e3 m)
[[nodiscard]] Result<Pattern> makePattern(Pattern pattern);

/// Reads a PNG as texels; colours are reduced to at most `maxColors` (2..64) by median cut. Limits: 4096 x 4096.
[[nodiscard]] Result<std::shared_ptr<const PatternTexels>> readPatternImage(const std::filesystem::path& file,
                                                                            int maxColors = 8);
/// Reads a raw file of one byte per texel (x fastest). Its distinct values, at most 64, become phases in ascending
/// order. Limit: 1024 texels along an axis.
[[nodiscard]] Result<std::shared_ptr<const PatternTexels>> readPatternRaw(const std::filesystem::path& file,
                                                                          Vec3i dimension);

/// An object's own axes: u along its dominant horizontal edge direction, w up; origin at the lower corner of its
/// envelope.
struct ObjectAxes {
    Vec3d origin{};  ///< local space
    std::array<Vec3d, 3> directions{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    Vec3d extent{};  ///< of its envelope along them, metres
};
/// Finds the dominant horizontal edge direction: the fullest bin of a length-weighted histogram of one-degree bins,
/// refined to the mean direction within the bin.
[[nodiscard]] ObjectAxes dominantAxes(const mesh::ObjectMesh& mesh) noexcept;

struct PatternedObject {
    volume::Scalar first = 0;  ///< its range is [first, first + pattern.phaseCount())
    Pattern pattern;
    ObjectAxes axes;
};

/// Fits brick and block to an object and a grid. Units are scaled so that whole units fill the object's extent (half
/// units along u and v, since every second course begins with one). So its faces show bricks, and not a joint inside.
/// Joints thinner than a voxel become one voxel wide if a unit has at least three voxels. Otherwise samples would hit
/// some joints and miss others. Other kinds stay.
/// \param spacing  of the grid, metres
void fitPattern(PatternedObject& object, Vec3d spacing) noexcept;

/// Applies the patterns: a voxel with scalar `first` of a patterned object becomes first + phase at its centre.
/// Cost: O(voxels of patterned objects).
[[nodiscard]] volume::ColumnVolume layPatterns(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                               Vec3d localOrigin, const std::vector<PatternedObject>& objects,
                                               int threads);

}  // namespace svt::voxelize
