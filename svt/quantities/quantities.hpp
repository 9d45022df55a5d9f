#pragma once
/// \file
/// Quantities of single objects: volumes, areas, lengths and openings, from the meshes that a volume keeps.
///
/// Most figures come from the closed mesh of an object and are exact. The openings of a wall are the voids between its
/// two faces, whatever doors, windows or relations a file has:
///
///     +---------------------+      seen across the thickness: the two faces of the wall
///     |      +---+          |      a hole is enclosed by material
///     |      |   |   +---+  |      a notch reaches the lower edge, with material at its sides and above
///     |      +---+   |   |  |
///     +--------------+   +--+

#include <svt/core/names.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::quantities {

/// The source of a volume.
enum class Trust : std::uint8_t {
    Unknown,  ///< no volume: sheets, or no geometry
    Exact,    ///< a closed mesh
    Tight,    ///< a mesh that closes up to T-junctions, or with faces shared by XLink
    Caps,     ///< a mesh that planar caps close
    Voxels,   ///< counted
    Assumed   ///< counted space of a building that belongs to no room: the material behind its boundary surfaces
};
constexpr auto namesOf(Trust) {
    return std::to_array<Name<Trust>>({{Trust::Unknown, ""},
                                       {Trust::Exact, "exact"},
                                       {Trust::Tight, "tight"},
                                       {Trust::Caps, "caps"},
                                       {Trust::Voxels, "voxels"},
                                       {Trust::Assumed, "assumed"}});
}

/// A face whose unit normal has more than this along z, up or down, is a top or a bottom: 45 degrees.
inline constexpr double kLeastRise = 0.70710678118654752;

/// The quantities of one object. Metres, m2, m3. Empty: unknown, or not defined for this object.
struct ObjectQuantities {
    std::uint32_t label = 0;
    std::vector<std::uint32_t> parts;  ///< the labels that are measured: itself, and the panes and frames of a window
    std::optional<double> netVolume;
    std::optional<double> bound;  ///< by which netVolume may be off; rounding of points for closed meshes
    Trust trust = Trust::Unknown;
    std::optional<double> grossVolume;  ///< netVolume and the voids of the openings; of walls, slabs and the like
    std::optional<double> grossBound;   ///< by which grossVolume may be off in addition to `bound`
    /// Distance of the two largest parallel faces of a component, if each has at least half of the visible area, and if it
    /// is the smallest extent. Curved walls have that of the two concentric faces. Unknown for buildings and rooms.
    std::optional<double> thickness;
    /// Extents across the thickness: of an upright body horizontally (no width), of others the longer and the shorter.
    std::optional<double> length, width;
    std::optional<double> height;       ///< vertical extent of the mesh
    std::optional<double> sideArea;     ///< of an upright body: one side, without openings; else all faces at the sides
    std::optional<double> topArea;      ///< of all faces that look up, within 45 degrees; sills count
    std::optional<double> bottomArea;   ///< of all faces that look down, within 45 degrees; lintels count
    std::optional<double> outerArea;    ///< of all faces
    std::optional<double> perimeter;    ///< around the object, seen across the thickness, with closed openings
    std::optional<double> openingArea;  ///< of the openings, seen across the thickness
    std::optional<std::size_t> openings;  ///< number of them
};

/// The objects of a selection: each label with geometry, without the phases of selected windows and doors. A label that
/// lacks geometry stands for the objects in its extent that are neither spaces nor buildings.
/// \param selected  ascending
/// \return labels, ascending
/// Cost: O(n log n) in labels.
[[nodiscard]] std::vector<std::uint32_t> objectsOf(const volume::SemanticVolume& volume,
                                                   std::span<const std::uint32_t> selected);

/// The objects that are measured without a selection: all components; without any, all other bodies; without any, all
/// objects with geometry.
/// \return labels, ascending. Cost: that of objectsOf()
[[nodiscard]] std::vector<std::uint32_t> defaultObjects(const volume::SemanticVolume& volume);

/// Whether an object is a component: neither a space nor a building as a whole, nor terrain, nor a face of another object.
[[nodiscard]] bool isComponent(const volume::Label& label);

/// Whether an object is a face of a space or a building, such as a WallSurface without a body of its own.
[[nodiscard]] bool isBoundarySheet(const volume::Label& label);

/// The quantities of each object.
/// \param objects  of objectsOf()
/// \param threads  0: all cores; the result does not depend on it
/// Cost: O(t log t) for the t triangles of each object.
[[nodiscard]] std::vector<ObjectQuantities> measureObjects(const volume::SemanticVolume& volume,
                                                           std::span<const std::uint32_t> objects, int threads = 0);

/// The buildings of a volume as wholes: labels without parent that are buildings, bridges or tunnels. Each has the sums of
/// its bodies and their parts; without bodies those of its components; without both those of its surfaces. A figure that
/// one of them lacks is unknown, and so are lengths of several. Faces between parts count.
/// \param objects  of measureObjects(), for all labels with geometry
/// \return one per building, by label. Volumes of parts that overlap add up; see countedVolumes()
/// Cost: O(n log n).
[[nodiscard]] std::vector<ObjectQuantities> buildingQuantities(const volume::SemanticVolume& volume,
                                                               std::span<const ObjectQuantities> objects);

/// The part of an object's volume that counts in sums.
struct CountedVolume {
    std::optional<double> volume;  ///< m3
    bool isExact = false;          ///< from meshes; else counted in voxels
};

/// Volumes that add up to that of the union of the objects. Space that two of them share counts once; other objects of the
/// volume do not matter.
/// \param objects  of measureObjects()
/// Cost: that of analyze::exclusiveMeasures(), for the meshes of the objects.
[[nodiscard]] std::vector<CountedVolume> countedVolumes(const volume::SemanticVolume& volume,
                                                        std::span<const ObjectQuantities> objects);

}  // namespace svt::quantities
