#pragma once
/// \file
/// The semantic tree that every reader fills: features with attributes, parents, groups
/// and their geometry as stored in the file (rings, shells, solids; world space, metres).
/// Data only: nothing is repaired, closed or triangulated here.

#include <svt/core/attribute.hpp>
#include <svt/core/error.hpp>
#include <svt/core/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::model {

/// The attribute of a feature whose shape was read in part. It names the missing parts. Quantities are unknown.
inline constexpr std::string_view kReadInPartAttribute = "readInPart";
[[nodiscard]] bool isReadInPart(std::span<const Attribute> attributes) noexcept;

using FeatureIndex = std::uint32_t;  ///< into BuildingModel::features
using PolygonIndex = std::uint32_t;  ///< into BuildingModel::polygons
inline constexpr FeatureIndex kNoFeature = 0xFFFFFFFFu;

/// A polygon with holes, as read. World space, double precision.
///
///     points:   e0 e1 e2 e3 h0 h1 h2        one exterior ring of 4, one hole of 3
///     ringEnds:             4        7      ends of the rings in `points`; first ring = exterior
///
/// Rings keep the order and direction of the file; a closing point equal to the first is dropped.
/// Counter-clockwise seen from outside if the file is correct.
struct Polygon {
    std::vector<Vec3d> points;
    std::vector<std::uint32_t> ringEnds;
    std::string id;              ///< gml:id, or empty
    std::int32_t material = -1;  ///< into BuildingModel::materials, -1: none
};

/// A reference to a polygon. A wall face shared by two rooms is one polygon with two uses,
/// one of them reversed (gml:OrientableSurface "-").
struct SurfaceUse {
    PolygonIndex polygon = 0;
    bool isReversed = false;
    friend bool operator==(const SurfaceUse&, const SurfaceUse&) = default;
};

/// Exterior shell and the shells of its voids.
struct Solid {
    std::string id;
    std::vector<SurfaceUse> exterior;
    std::vector<std::vector<SurfaceUse>> interiors;
};

enum class GeometryKind : std::uint8_t {
    Solid,    ///< gml:Solid, CompositeSolid, MultiSolid: `solids` is filled
    Surface,  ///< MultiSurface, CompositeSurface, Surface, TIN, ...: `surfaces` is filled
};

/// One geometry of a feature at one level of detail.
struct Geometry {
    GeometryKind kind = GeometryKind::Surface;
    bool isComposite = false;  ///< CompositeSolid, CompositeSurface: the members are connected and do not overlap
    double lod = -1;           ///< 0..4; CityJSON 2.2 is 2.2; -1: not stated
    std::string id;            ///< gml:id of the solid or (multi)surface, or empty
    std::vector<Solid> solids;
    std::vector<SurfaceUse> surfaces;
};

/// A semantic object: building, storey, room, wall, window, table, parcel, tree.
struct Feature {
    std::string id;  ///< unique in the model; made from the path if the file has no id
    /// CityGML 3.0 local name where one exists: Building, BuildingRoom, WallSurface (see classes.hpp).
    std::string className;
    std::string name;  ///< gml:name, or empty
    std::vector<Attribute> attributes;
    FeatureIndex parent = kNoFeature;
    std::vector<FeatureIndex> children;  ///< in document order
    std::vector<Geometry> geometries;    ///< all levels of detail in the file
    std::uint64_t line = 0;              ///< 1-based line in the input, 0: unknown
};

/// Aggregation outside the hierarchy: a storey, unit or CityObjectGroup that references its members.
struct Membership {
    FeatureIndex group = kNoFeature;
    FeatureIndex member = kNoFeature;
    std::string role;
    friend bool operator==(const Membership&, const Membership&) = default;
};

/// A line of a feature, such as a path through a building or an axis in a plan; a single point is a place. Lines have
/// no voxels: volumes store them separately and draw them (volume::VectorParts).
struct Polyline {
    FeatureIndex feature = kNoFeature;
    std::vector<Vec3d> points;  ///< world space; a closed line ends where it begins
    friend bool operator==(const Polyline&, const Polyline&) = default;
};

/// Colour of a surface (X3DMaterial, CityJSON material, IfcSurfaceStyle).
struct Material {
    std::string name;
    std::string part{};               ///< part of an object that it is for (IfcShapeAspect: "Framing"), or empty
    Vec3f diffuse{0.8f, 0.8f, 0.8f};  ///< sRGB, 0..1
    float transparency = 0;           ///< 0 opaque .. 1 invisible
    bool hasColor = true;             ///< false: the file names the part only; diffuse and transparency are unknown
};

/// Coordinate reference system of the model: that of the file, or the projection in metres to which its degrees or feet
/// were converted. Axes are always (east, north, up).
struct Crs {
    std::string name;          ///< srsName or referenceSystem, or empty; "EPSG:6677 (from EPSG:6697)" if projected
    int epsg = 0;              ///< horizontal EPSG code if the name contains one, else 0
    bool axesSwapped = false;  ///< true if the file's order is (north, east); the model's is always (east, north)
};

/// A whole model. Index-based: features and polygons refer to each other by index.
struct BuildingModel {
    /// A file of a model that was joined from several.
    struct JoinedFile {
        std::string source;
        FeatureIndex firstFeature = 0;
        PolygonIndex firstPolygon = 0;
    };

    std::string source;  ///< path or name as given by the caller; of the first file
    std::string format;  ///< "CityGML 2.0", "CityJSON 1.1", "CityJSONSeq 2.0"
    Crs crs;
    std::string name;                 ///< name of the whole model, or empty
    std::vector<Feature> features;    ///< parents precede their children
    std::vector<FeatureIndex> roots;  ///< features without parent, in document order
    std::vector<Membership> memberships;
    std::vector<Polygon> polygons;
    std::vector<Material> materials;
    std::vector<Polyline> lines;          ///< in the order of their features
    std::vector<JoinedFile> joinedFiles;  ///< the files after the first

    /// Adds a feature under `parent` (kNoFeature: as a root) and returns its index.
    FeatureIndex addFeature(Feature feature, FeatureIndex parent);
    /// Adds a polygon and returns its index.
    PolygonIndex addPolygon(Polygon polygon);
    /// Features in tree order (depth first, children in document order). Cost: O(features).
    [[nodiscard]] std::vector<FeatureIndex> treeOrder() const;
    /// The file, line and id of a feature, for findings. Cost: O(depth of the feature + files).
    [[nodiscard]] Place placeOf(FeatureIndex feature) const;
    /// The file and id of a polygon, for findings. Cost: O(files).
    [[nodiscard]] Place placeOfPolygon(PolygonIndex polygon) const;
    /// Box around all points of `geometry`; empty for none. World space, metres.
    [[nodiscard]] Box3d bounds(const Geometry& geometry) const;
};

/// The level of detail to use for a feature that has several.
struct LodChoice {
    /// -1: the finest level of each feature; otherwise the finest level not above this. A whole level includes its
    /// refinements (2 includes 2.2); a refined level does not (2.1 excludes 2.2).
    double lod = -1;
    [[nodiscard]] static LodChoice finest() { return {}; }

    /// Index into `feature.geometries` of the geometry to use, or -1 if there is none. Solids are preferred
    /// to surfaces of the same level.
    [[nodiscard]] int choose(const Feature& feature) const;
};

}  // namespace svt::model
