#pragma once
/// \file
/// The content of one piece of a CityGML file before references are resolved: features, polygons
/// and a graph of geometry nodes with links by id. Parts are read in parallel and joined in
/// document order; all indices refer to the same part.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::readers::citygml {

using NodeIndex = std::uint32_t;
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

enum class NodeKind : std::uint8_t {
    Empty,      ///< geometry that was present but unusable
    Polygon,    ///< payload: polygon
    Surfaces,   ///< children: polygons, surfaces, references
    Interior,   ///< like Surfaces: the shell of a void
    Solid,      ///< children: Surfaces (exterior), Interior*
    Bodies,     ///< children of any kind: MultiSolid, CompositeSolid, MultiGeometry
    Reference,  ///< payload: href
    Implicit    ///< payload: placement; child: the prototype or a reference to it
};

/// A geometry element. Children form a linked list: firstChild, then nextSibling.
struct Node {
    NodeKind kind = NodeKind::Empty;
    bool isReversed = false;   ///< OrientableSurface "-": reverses everything below
    bool isComposite = false;  ///< CompositeSolid, CompositeSurface
    std::uint32_t payload = kNone;
    NodeIndex firstChild = kNone;
    NodeIndex nextSibling = kNone;
    std::uint32_t id = kNone;  ///< into Part::ids; the id of a polygon is stored in the polygon
    std::uint64_t offset = 0;  ///< byte offset of the element in the document
};

/// world = matrix * (x, y, z, 1) + referencePoint; the 4 x 4 matrix is row-major.
struct Placement {
    std::array<double, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    Vec3d referencePoint;
};

/// A geometry property of a feature.
struct FeatureGeometry {
    model::FeatureIndex feature = 0;
    NodeIndex node = kNone;
    double lod = -1;
};

/// A property that is a reference: a room of a storey, a member of a group, possibly a geometry.
struct Link {
    model::FeatureIndex feature = 0;
    std::uint32_t href = 0;
    std::string property;  ///< local name
    std::string role;      ///< of a group member
    std::uint64_t offset = 0;
};

/// An X3DMaterial, or a reference to one, within an Appearance.
struct MaterialRecord {
    std::string theme;
    bool inheritsTheme = false;  ///< the Appearance began in the previous part
    bool isReference = false;    ///< `id` names a material defined elsewhere
    std::string id;
    model::Material material;
    std::vector<std::string> targets;
};

/// A surface, and the part of an image that lies on it.
struct TextureTarget {
    std::string href;
    std::vector<textures::TexturePoint> points;  ///< of all rings
    std::vector<std::uint32_t> ringEnds;         ///< index behind the last point of each ring
    std::vector<double> worldToTexture;          ///< 3 x 4 matrix of a TexCoordGen, or empty
};

/// A ParameterizedTexture or GeoreferencedTexture within an Appearance.
struct TextureRecord {
    std::string theme;
    bool inheritsTheme = false;  ///< the Appearance began in the previous part
    std::string id;
    textures::TextureImage image;
    textures::Wrap wrap = textures::Wrap::Repeat;
    std::vector<TextureTarget> targets;
};

/// A srsName and its first occurrence.
struct CrsName {
    std::string name;
    std::string units;  ///< uomLabels beside it, or empty
    std::uint64_t offset = 0;
};

/// A diagnostic whose line is not yet known.
struct Finding {
    Severity severity = Severity::Warning;
    Code code = Code::Internal;
    std::string message;
    std::string id;
    std::uint64_t offset = 0;
};

/// Keeps at most as many findings as Diagnostics would, but counts all.
struct Findings {
    struct Count {
        Severity severity;
        Code code;
        std::size_t kept;
        std::size_t dropped;
    };
    std::vector<Finding> items;
    std::vector<Count> counts;

    void add(Severity severity, Code code, std::string message, std::uint64_t offset, std::string id = {});
};

struct Part {
    // Features; `Feature::line` is relative to the part until it is joined.
    std::vector<model::Feature> features;
    std::vector<std::uint64_t> featureOffsets;
    std::vector<model::FeatureIndex> roots;
    bool continuesRoot = false;  ///< feature 0 continues the last root of the previous part
    std::vector<FeatureGeometry> geometries;
    std::vector<Link> links;
    std::vector<model::Membership> memberships;  ///< inline members with a role

    // Geometry.
    std::vector<model::Polygon> polygons;
    std::vector<Node> nodes;
    std::vector<std::string> ids;
    std::vector<std::string> hrefs;
    std::vector<Placement> placements;

    // The rest.
    std::vector<MaterialRecord> materials;
    std::vector<TextureRecord> textures;   ///< none where kReadsTextures is false
    std::optional<std::string> lastTheme;  ///< theme of the last Appearance, which may continue in the next part
    std::vector<CrsName> crsNames;
    std::uint64_t flatRings = 0, fullRings = 0;  ///< rings of two and of three numbers for each point
    std::uint64_t firstFlat = 0;                 ///< offset of the first of two
    std::string modelName;
    std::vector<std::string> unknownNames;  ///< skipped elements, each name once
    std::vector<std::uint64_t> unknownOffsets;
    struct Prefix {
        std::string name, element;
        std::uint64_t offset = 0;
    };
    std::vector<Prefix> undeclared;  ///< prefixes without a declaration, each once, with the first element
    Findings findings;
    std::optional<Error> error;

    /// Appends `next` and offsets its indices.
    void join(Part&& next);

    /// Records an unknown element; each name is kept once.
    void addUnknown(std::string_view name, std::uint64_t offset);
    void addUndeclared(Prefix prefix);
    void addCrsName(std::string_view name, std::string_view units, std::uint64_t offset);
};

}  // namespace svt::readers::citygml
