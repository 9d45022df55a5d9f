#pragma once
/// \file
/// Legal spaces as a land administration registers them (ISO 19152: LA_LegalSpaceBuildingUnit): their bodies, outlines
/// in plan, boundary faces, and relations to each other.
///
///     flat A | wall | flat B        Each flat has a boundary face at the wall. Their relation is a gap.
///
///     cellar A | cellar B           Both have one shared face. A is on its minus side, B on its plus side.
///
/// A body is the closed solid of the feature itself. Without one, it is the closed solids of its spaces (rooms), and
/// without these its voxels. Results from solids are exact up to the tolerances below. All coordinates are in world
/// space, metres.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace svt::analyze {

inline constexpr std::uint32_t kNoSpace = 0xFFFFFFFFu;

/// The origin of the body of a legal space.
enum class SpaceBody : std::uint8_t {
    None,    ///< no geometry
    Solid,   ///< the closed solid of the feature itself
    Parts,   ///< the closed solids of its spaces
    Voxels,  ///< its voxels, as boxes
};
[[nodiscard]] std::string_view spaceBodyName(SpaceBody body) noexcept;  ///< "none", "solid", "parts", "voxels"

using SpaceTriangle = std::array<Vec3d, 3>;  ///< counter-clockwise seen from outside

/// Parts of the plan view: outer rings counter-clockwise, holes clockwise; first points are not repeated.
struct PlanPolygon {
    std::vector<std::array<double, 2>> outer;
    std::vector<std::vector<std::array<double, 2>>> holes;
    double area = 0;  ///< m2, without holes
};

struct LegalSpace {
    std::uint32_t label = 0;
    bool isCommon = false;  ///< see isCommonUnit()
    SpaceBody body = SpaceBody::None;
    std::vector<std::vector<SpaceTriangle>> solids;  ///< closed; of Voxels: boxes
    std::optional<double> bodyVolume;                ///< m3 that the body encloses
    std::optional<double> totalVolume;               ///< best known m3 of the feature with its parts, see KnownVolumes
    Box3d box;                                       ///< around the body
    std::vector<PlanPolygon> outline;                ///< of the body in plan
};

/// The direction to which a boundary face looks from its minus side.
enum class FaceDirection : std::uint8_t { Down, Up, Side };
[[nodiscard]] std::string_view faceDirectionName(FaceDirection direction) noexcept;  ///< "down", "up", "side"

/// A flat polygon of the boundary. The space on the minus side has it as an outer face; the normal points to the plus
/// side. A face between two spaces occurs once.
struct BoundaryFace {
    std::uint32_t minus = 0;                ///< index into LegalSpaces::spaces
    std::uint32_t plus = kNoSpace;          ///< the space on the other side; kNoSpace: none of the legal spaces
    std::vector<std::vector<Vec3d>> rings;  ///< counter-clockwise seen from the plus side, then holes, clockwise
    Vec3d normal;
    double area = 0;           ///< m2
    double low = 0, high = 0;  ///< lowest and highest point, metres
    FaceDirection direction = FaceDirection::Side;
};

enum class SpaceRelationKind : std::uint8_t {
    Overlap,     ///< both claim the same space
    SharedFace,  ///< they touch in faces
    Gap          ///< faces look at each other over a distance
};
[[nodiscard]] std::string_view relationName(SpaceRelationKind kind) noexcept;  ///< "overlap", "shared face", "gap"

/// A relation of two legal spaces that do not contain each other.
struct SpaceRelation {
    SpaceRelationKind kind = SpaceRelationKind::Overlap;
    std::uint32_t a = 0, b = 0;            ///< indices into LegalSpaces::spaces, a < b
    std::optional<double> volume{};        ///< of an overlap, m3
    std::optional<double> area{};          ///< of shared faces, or of the faces at a gap, m2
    double narrowest = 0, widest = 0;      ///< of a gap, metres
    double bound = 0;                      ///< m3 by which the volume may be off; infinite: counted in voxels
    bool isExact = false;                  ///< both bodies are solids
    std::vector<std::uint32_t> faces{};    ///< of SharedFace: indices into LegalSpaces::faces
    std::vector<std::uint32_t> between{};  ///< of a Gap: labels in its middle, ascending
    bool isOpen = false;                   ///< of a Gap: a part of it has no label
    friend bool operator==(const SpaceRelation&, const SpaceRelation&) = default;
};

struct LegalSpaces {
    std::vector<LegalSpace> spaces;        ///< by label
    std::vector<BoundaryFace> faces;       ///< by minus, then plus
    std::vector<SpaceRelation> relations;  ///< by a, b, kind
    /// Spaces whose voxels need more boxes than the limit, or whose faces did not settle: indices into `spaces`.
    std::vector<std::uint32_t> withoutFaces;
};

struct LegalSpaceOptions {
    double flatness = 0.001;       ///< faces whose distance is below this lie in one plane, metres
    double snap = 0.0001;          ///< corners nearer than this are one, metres
    double widestGap = 0.6;        ///< faces that are further apart have no relation, metres
    std::size_t maxBoxes = 20000;  ///< of a body of voxels
};

/// The units of the model (BuildingUnit), ascending.
[[nodiscard]] std::vector<std::uint32_t> unitsOf(const volume::LabelTable& labels);

/// Makes the legal spaces of features.
/// \param labels  ascending, each once
/// Cost: O(triangles * planes + n log n) for n edges of faces, and that of the pairs of planes within `widestGap`.
[[nodiscard]] LegalSpaces makeLegalSpaces(const volume::SemanticVolume& volume, std::span<const std::uint32_t> labels,
                                          const LegalSpaceOptions& options = {});

}  // namespace svt::analyze
