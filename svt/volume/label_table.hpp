#pragma once
/// \file
/// The component that each scalar stands for. Every object owns a contiguous range of scalars, numbered in tree order,
/// so that a subtree (a storey with all its rooms) is one range.

#include <svt/core/attribute.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::volume {

inline constexpr std::uint32_t kNoLabel = 0xFFFFFFFFu;
/// Maximum number of scalars, background included. It bounds tables indexed by scalar, whatever a file claims.
inline constexpr Scalar kMaxScalarCount = 1u << 26;

/// How an object got its voxels.
enum class Filling : std::uint8_t {
    None,          ///< no geometry, so no voxels (e.g. a storey that only groups)
    Solid,         ///< closed mesh, filled exactly
    TJunctions,    ///< closed up to T-junctions, filled exactly
    Complemented,  ///< open shell, closed with faces shared by XLink
    Capped,        ///< open shell, closed by planar caps (ClosureSurface)
    Winding,       ///< open shell, filled by generalized winding number
    Surface,       ///< no solid meaning: a sheet, one voxel thick
    Body           ///< boundary surface with the material behind it (thematic body)
};
/// Whether the mesh of the object is closed: as read, up to T-junctions, by shared faces, or by caps. Then its volume is
/// exact.
[[nodiscard]] constexpr bool hasClosedMesh(Filling filling) noexcept {
    return filling >= Filling::Solid && filling <= Filling::Capped;
}
[[nodiscard]] std::string_view fillingName(Filling filling) noexcept;  ///< "solid", "t-junctions", ...
[[nodiscard]] bool fillingFromName(std::string_view name, Filling& filling) noexcept;

/// One feature of the model. An object is a feature with `count` > 0.
struct Label {
    std::string id;
    std::string className;
    std::string name;
    std::vector<Attribute> attributes;
    std::uint32_t parent = kNoLabel;    ///< index of the parent label
    std::uint32_t subtreeEnd = 0;       ///< labels [own index, subtreeEnd) are this feature and its descendants
    std::vector<std::uint32_t> groups;  ///< labels of groups, storeys and units that have it as a member
    Scalar first = 0;                   ///< scalars [first, first + count)
    Scalar count = 0;                   ///< 0: not an object; 1: no pattern; else one scalar per pattern phase
    std::uint64_t voxels = 0;
    /// m3: of the closed mesh; of the voxels for bodies. 0: unknown, for surfaces and open shells. Never show it as it
    /// is, see analyze::KnownVolumes.
    double volume = 0;
    double area = 0;  ///< m2 of its mesh, if voxels decide its volume or that of another label; 0: unknown
    Filling filling = Filling::None;
    std::uint64_t thinVoxels = 0;       ///< voxels from the pass for thin parts only
    std::uint64_t uncertainVoxels = 0;  ///< voxels with a winding number over 0.25 from a whole number
    Vec3f color{0.8f, 0.8f, 0.8f};      ///< default style: sRGB, 0..1
    float opacity = 1;                  ///< default style: fraction of light stopped by 1 m; 1 = opaque surface

    friend bool operator==(const Label&, const Label&) = default;
};

/// Whether triangles of a label are the closed mesh whose volume the label states. Those of a file may not be, whatever
/// it states.
/// \param enclosed  m3: the sum over signed tetrahedra of the triangles
/// \param area      m2 of the triangles
/// \param unit      metres: VectorParts::unit
[[nodiscard]] bool enclosesStatedVolume(const Label& label, double enclosed, double area, double unit) noexcept;

/// Voxels claimed by two objects and assigned to `a`.
struct Overlap {
    std::uint32_t a = 0, b = 0;  ///< labels
    std::uint64_t voxels = 0;
    bool isNested = false;  ///< one contains the other in the hierarchy or grouping of the model (room in building)
    friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// All labels in tree order, and the owner of each scalar.
struct LabelTable {
    std::vector<Label> labels;
    std::vector<Overlap> overlaps;  ///< ordered by (a, b)
    /// Colour of each pattern phase: entry s belongs to scalar s. Has scalarCount() entries, or none if no object has a
    /// pattern.
    std::vector<Vec3f> phaseColors;

    /// 1 + the largest scalar.
    [[nodiscard]] Scalar scalarCount() const noexcept;
    /// Bits of the smallest unsigned type that holds all scalars: 8, 16 or 32.
    [[nodiscard]] int scalarBits() const noexcept;
    /// Entry s = label that owns scalar s; kNoLabel for background.
    [[nodiscard]] std::vector<std::uint32_t> labelOfScalar() const;

    friend bool operator==(const LabelTable&, const LabelTable&) = default;
};

}  // namespace svt::volume
