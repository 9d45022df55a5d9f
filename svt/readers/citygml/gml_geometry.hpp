#pragma once
/// \file
/// Reads geometry elements of GML 3.1 to 3.3 into polygons and the node graph of a part.
/// Unusable rings are reported and left out here; later stages check everything else about
/// the shape of a polygon.

#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::readers::gml {

using citygml::NodeIndex;
using citygml::NodeKind;
using citygml::Part;
using xml::Element;

/// No location on Earth has coordinates this large in any unit of length.
inline constexpr double kLargestCoordinate = 1e10;

/// Relevant attributes, collected in one pass.
struct ElementAttributes {
    std::string_view id;  ///< gml:id, else the misspellings gml_id and id
    bool isIdMisspelled = false;
    std::string_view href;  ///< xlink:href
    bool hasHref = false;
    std::string_view srsName;
    std::string_view units;  ///< uomLabels
    std::string_view orientation;
    int dimension = 0;  ///< srsDimension, 0: not stated
};
[[nodiscard]] ElementAttributes attributesOf(const xml::NameScope& scope, pugi::xml_node node);

/// Role of a geometry element for a volume.
enum class Shape : std::uint8_t {
    None,        ///< not a geometry element
    NoVolume,    ///< points, curves, grids: known but skipped
    Polygon,     ///< Polygon, PolygonPatch, Triangle, Rectangle
    Compact,     ///< GML 3.3: one list of positions
    Surfaces,    ///< MultiSurface, CompositeSurface, Surface, Tin, ...
    Orientable,  ///< OrientableSurface
    Solid,
    Bodies  ///< MultiSolid, CompositeSolid, MultiGeometry, GeometricComplex
};
[[nodiscard]] Shape shapeOf(const Element& element) noexcept;

class GeometryReader {
public:
    /// \param offsetOf  byte offset in the document of a node of the traversed tree
    GeometryReader(xml::NameScope& scope, Part& part, std::function<std::uint64_t(pugi::xml_node)> offsetOf);

    /// Reads a geometry element with all its descendants.
    /// \return its node, or kNone if it has no surface or solid
    NodeIndex read(const Element& element);

    /// A node for a reference to the geometry `href`.
    NodeIndex readReference(std::string_view href, pugi::xml_node at);

    /// core:ImplicitGeometry: prototype, matrix and reference point.
    NodeIndex readImplicit(const Element& element);

private:
    NodeIndex readElement(const Element& element, Shape shape, int dimension);
    NodeIndex readPolygon(const Element& element, bool isCompact, int dimension);
    NodeIndex readSolid(const Element& element, int dimension);
    NodeIndex readShell(const Element& property, NodeKind kind, int dimension);
    void readMembers(const Element& element, NodeIndex parent, int dimension);

    bool readRing(const Element& property, int dimension, model::Polygon& polygon);
    void readCurve(const Element& element, int dimension, int depth);
    void readPositions(const Element& element, int dimension);
    void readPosition(const Element& element, int dimension);
    bool readMatrix(const Element& element, citygml::Placement& placement);

    void addNumbers(std::string_view text, int statedDimension, int inheritedDimension, pugi::xml_node at);
    void addPoints(int dimension);
    bool finishRing(model::Polygon& polygon, pugi::xml_node at, bool isPatch);
    void reportRing(Code code, const std::string& message, pugi::xml_node at);

    NodeIndex addNode(NodeKind kind, pugi::xml_node at, std::string_view id);
    void addChild(NodeIndex parent, NodeIndex child);

    xml::NameScope& scope_;
    Part& part_;
    std::function<std::uint64_t(pugi::xml_node)> offsetOf_;
    std::vector<NodeIndex> lastChild_;  // of each node, to append children in order
    std::string_view polygonId_;        // of the polygon being read, for messages
    bool isPrototype_ = false;          // inside an ImplicitGeometry: no CRS
    bool ringFailed_ = false;
    bool isFlat_ = false;  // the ring being read has points of two numbers
    std::vector<double> numbers_;
    std::vector<Vec3d> points_;  // of the ring being read
    std::string scratch_;
};

}  // namespace svt::readers::gml
