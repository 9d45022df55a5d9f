#include <svt/readers/citygml/gml_geometry.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/gml/gml_numbers.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::readers::gml {
namespace {

using citygml::kNone;
using citygml::Placement;
using std::string_view;
using xml::Vocabulary;

constexpr int kMaxCurveDepth = 16;

constexpr std::pair<string_view, Shape> kShapes[] = {
    {"Polygon", Shape::Polygon},
    {"Triangle", Shape::Polygon},
    {"PolygonPatch", Shape::Polygon},
    {"MultiSurface", Shape::Surfaces},
    {"CompositeSurface", Shape::Surfaces},
    {"OrientableSurface", Shape::Orientable},
    {"Solid", Shape::Solid},
    {"Shell", Shape::Surfaces},
    {"Surface", Shape::Surfaces},
    {"TriangulatedSurface", Shape::Surfaces},
    {"Tin", Shape::Surfaces},
    {"TIN", Shape::Surfaces},
    {"PolyhedralSurface", Shape::Surfaces},
    {"MultiPolygon", Shape::Surfaces},
    {"Rectangle", Shape::Polygon},
    {"SimpleTrianglePatch", Shape::Compact},
    {"MultiSolid", Shape::Bodies},
    {"CompositeSolid", Shape::Bodies},
    {"MultiGeometry", Shape::Bodies},
    {"GeometricComplex", Shape::Bodies},
    {"Point", Shape::NoVolume},
    {"MultiPoint", Shape::NoVolume},
    {"LineString", Shape::NoVolume},
    {"MultiLineString", Shape::NoVolume},
    {"Curve", Shape::NoVolume},
    {"MultiCurve", Shape::NoVolume},
    {"CompositeCurve", Shape::NoVolume},
    {"OrientableCurve", Shape::NoVolume},
    {"LinearRing", Shape::NoVolume},
    {"Ring", Shape::NoVolume},
    {"Grid", Shape::NoVolume},
    {"RectifiedGrid", Shape::NoVolume},
    {"RectifiedGridCoverage", Shape::NoVolume},
    {"Envelope", Shape::NoVolume},
};

// Members of a surface that are not faces.
bool isNotFace(string_view property) noexcept {
    return property == "stopLines" || property == "breakLines" || property == "maxLength" ||
           property == "controlPoint" || property == "name" || property == "description" ||
           property == "metaDataProperty" || property == "boundedBy" || property == "identifier";
}

bool isExterior(string_view name) noexcept { return name == "exterior" || name == "outerBoundaryIs"; }
bool isInterior(string_view name) noexcept { return name == "interior" || name == "innerBoundaryIs"; }

bool hasThreeDistinct(const std::vector<Vec3d>& points) noexcept {
    if (points.empty()) return false;
    const Vec3d first = points.front();
    const auto second = std::find_if(points.begin(), points.end(), [&](Vec3d p) { return !(p == first); });
    return std::any_of(second, points.end(), [&](Vec3d p) { return !(p == first) && !(p == *second); });
}

// Whether `numbers`, read as points with `dimension` coordinates, form a closed ring.
bool closes(const std::vector<double>& numbers, std::size_t dimension) noexcept {
    return numbers.size() >= 2 * dimension &&
           std::equal(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(dimension),
                      numbers.end() - static_cast<std::ptrdiff_t>(dimension));
}

// CityGML is three-dimensional, but two-dimensional rings occur, often with a wrong srsDimension on an ancestor.
// The dimension stated by the list itself wins; else the first of (inherited, 3, 2) that divides the count and closes
// the ring, else the first that divides it. 0: none does.
int dimensionOf(const std::vector<double>& numbers, int stated, int inherited) noexcept {
    const int count = static_cast<int>(numbers.size() % 6);
    const auto divides = [&](int dimension) { return (dimension == 2 || dimension == 3) && count % dimension == 0; };
    if (divides(stated)) return stated;
    const int candidates[] = {inherited, 3, 2};
    for (const int dimension : candidates)
        if (divides(dimension) && closes(numbers, static_cast<std::size_t>(dimension))) return dimension;
    for (const int dimension : candidates)
        if (divides(dimension)) return dimension;
    return 0;
}

int firstNonZero(int a, int b) noexcept { return a != 0 ? a : b; }

}  // namespace

ElementAttributes attributesOf(const xml::NameScope& scope, pugi::xml_node node) {
    ElementAttributes result;
    for (pugi::xml_attribute attribute = node.first_attribute(); attribute; attribute = attribute.next_attribute()) {
        const xml::QualifiedName name = xml::splitName(attribute.name());
        const string_view value = attribute.value();
        if (name.localName == "id" || name.localName == "gml_id") {
            const bool isRight = name.localName == "id" && scope.ofAttribute(name.prefix, node) == Vocabulary::Gml;
            if (!isRight && (!name.prefix.empty() || !result.id.empty())) continue;
            result.id = withoutBlanks(value);
            result.isIdMisspelled = !isRight;
        } else if (name.localName == "href") {
            if (scope.ofAttribute(name.prefix, node) != Vocabulary::XLink && name.prefix != "xlink") continue;
            result.href = withoutBlanks(value);
            result.hasHref = true;
        } else if (name.localName == "srsName") {
            result.srsName = withoutBlanks(value);
        } else if (name.localName == "uomLabels") {
            result.units = withoutBlanks(value);
        } else if (name.localName == "srsDimension") {
            result.dimension = value == "2" ? 2 : value == "3" ? 3 : 0;
        } else if (name.localName == "orientation") {
            result.orientation = withoutBlanks(value);
        }
    }
    return result;
}

Shape shapeOf(const Element& element) noexcept {
    if (element.vocabulary == Vocabulary::GmlCompact) {
        if (element.localName == "SimplePolygon" || element.localName == "SimpleRectangle" ||
            element.localName == "SimpleTriangle")
            return Shape::Compact;
        return Shape::NoVolume;
    }
    if (element.vocabulary == Vocabulary::Gml) {
        for (const auto& [name, shape] : kShapes)
            if (name == element.localName) return shape;
        return Shape::None;
    }
    // The TexturedSurface module of CityGML 1.0 and 2.0 defines its own surface type.
    return element.is(Vocabulary::Module, "TexturedSurface") ? Shape::Orientable : Shape::None;
}

GeometryReader::GeometryReader(xml::NameScope& scope, Part& part, std::function<std::uint64_t(pugi::xml_node)> offsetOf)
    : scope_(scope), part_(part), offsetOf_(std::move(offsetOf)) {}

NodeIndex GeometryReader::addNode(NodeKind kind, pugi::xml_node at, string_view id) {
    citygml::Node node;
    node.kind = kind;
    node.offset = offsetOf_(at);
    if (!id.empty()) {
        node.id = static_cast<std::uint32_t>(part_.ids.size());
        part_.ids.emplace_back(id);
    }
    part_.nodes.push_back(node);
    lastChild_.resize(part_.nodes.size(), kNone);
    return static_cast<NodeIndex>(part_.nodes.size() - 1);
}

void GeometryReader::addChild(NodeIndex parent, NodeIndex child) {
    if (child == kNone) return;
    if (lastChild_[parent] == kNone)
        part_.nodes[parent].firstChild = child;
    else
        part_.nodes[lastChild_[parent]].nextSibling = child;
    lastChild_[parent] = child;
}

NodeIndex GeometryReader::read(const Element& element) { return readElement(element, shapeOf(element), 0); }

NodeIndex GeometryReader::readReference(string_view href, pugi::xml_node at) {
    const NodeIndex index = addNode(NodeKind::Reference, at, {});
    part_.nodes[index].payload = static_cast<std::uint32_t>(part_.hrefs.size());
    part_.hrefs.emplace_back(href);
    return index;
}

NodeIndex GeometryReader::readElement(const Element& element, Shape shape, int dimension) {
    if (shape == Shape::None || shape == Shape::NoVolume) return kNone;
    if (shape == Shape::Polygon || shape == Shape::Compact)
        return readPolygon(element, shape == Shape::Compact, dimension);

    const ElementAttributes attributes = attributesOf(scope_, element.node);
    if (!isPrototype_) part_.addCrsName(attributes.srsName, attributes.units, offsetOf_(element.node));
    dimension = firstNonZero(attributes.dimension, dimension);
    if (shape == Shape::Solid) return readSolid(element, dimension);

    const NodeIndex index =
        addNode(shape == Shape::Bodies ? NodeKind::Bodies : NodeKind::Surfaces, element.node, attributes.id);
    part_.nodes[index].isReversed = shape == Shape::Orientable && attributes.orientation == "-";
    part_.nodes[index].isComposite = element.localName == "CompositeSolid" || element.localName == "CompositeSurface";
    readMembers(element, index, dimension);
    if (element.localName == "Tin" && part_.nodes[index].firstChild == kNone)
        part_.findings.add(Severity::Warning, Code::NoGeometry,
                           "this Tin has control points but no triangles; it is left out, triangulate it first",
                           offsetOf_(element.node), std::string(attributes.id));
    return index;
}

void GeometryReader::readMembers(const Element& element, NodeIndex parent, int dimension) {
    scope_.forEachChild(element.node, [&](const Element& property) {
        if (isNotFace(property.localName)) return;
        const pugi::xml_node first = xml::firstChildElement(property.node);
        if (!first) {
            const ElementAttributes attributes = attributesOf(scope_, property.node);
            if (attributes.hasHref) addChild(parent, readReference(attributes.href, property.node));
            return;
        }
        scope_.forEachChild(property.node, [&](const Element& member) {
            const Shape shape = shapeOf(member);
            if (shape == Shape::None)
                part_.addUnknown(member.node.name(), offsetOf_(member.node));
            else
                addChild(parent, readElement(member, shape, dimension));
        });
    });
}

NodeIndex GeometryReader::readSolid(const Element& element, int dimension) {
    const ElementAttributes attributes = attributesOf(scope_, element.node);
    const NodeIndex index = addNode(NodeKind::Solid, element.node, attributes.id);
    scope_.forEachChild(element.node, [&](const Element& property) {
        if (isExterior(property.localName))
            addChild(index, readShell(property, NodeKind::Surfaces, dimension));
        else if (isInterior(property.localName))
            addChild(index, readShell(property, NodeKind::Interior, dimension));
    });
    return index;
}

// `property` holds a Shell (GML 3.2), any surface (GML 3.1) or a reference to one.
NodeIndex GeometryReader::readShell(const Element& property, NodeKind kind, int dimension) {
    const NodeIndex index = addNode(kind, property.node, {});
    const ElementAttributes attributes = attributesOf(scope_, property.node);
    if (attributes.hasHref && !xml::firstChildElement(property.node)) {
        addChild(index, readReference(attributes.href, property.node));
        return index;
    }
    scope_.forEachChild(property.node, [&](const Element& surface) {
        const Shape shape = shapeOf(surface);
        if (shape == Shape::None)
            part_.addUnknown(surface.node.name(), offsetOf_(surface.node));
        else
            addChild(index, readElement(surface, shape, dimension));
    });
    return index;
}

NodeIndex GeometryReader::readPolygon(const Element& element, bool isCompact, int dimension) {
    const ElementAttributes attributes = attributesOf(scope_, element.node);
    if (!isPrototype_) part_.addCrsName(attributes.srsName, attributes.units, offsetOf_(element.node));
    dimension = firstNonZero(attributes.dimension, dimension);
    polygonId_ = attributes.id;

    model::Polygon polygon;
    bool hasExterior = false;
    if (isCompact) {
        points_.clear();
        ringFailed_ = false;
        readPositions(element, dimension);
        hasExterior = finishRing(polygon, element.node, true);
    } else {
        bool sawExterior = false;
        scope_.forEachChild(element.node, [&](const Element& property) {
            if (isExterior(property.localName) && !sawExterior) {
                sawExterior = true;
                hasExterior = readRing(property, dimension, polygon);
            } else if (isInterior(property.localName) && hasExterior) {
                readRing(property, dimension, polygon);
            }
        });
        if (!sawExterior) reportRing(Code::TooFewPoints, "a polygon without exterior ring is left out", element.node);
    }
    if (!hasExterior) return addNode(NodeKind::Empty, element.node, attributes.id);

    polygon.id = attributes.id;
    const NodeIndex index = addNode(NodeKind::Polygon, element.node, {});
    part_.nodes[index].payload = static_cast<std::uint32_t>(part_.polygons.size());
    part_.polygons.push_back(std::move(polygon));
    return index;
}

bool GeometryReader::readRing(const Element& property, int dimension, model::Polygon& polygon) {
    points_.clear();
    ringFailed_ = false;
    bool hasRing = false;
    scope_.forEachChild(property.node, [&](const Element& ring) {
        if (hasRing) return;
        hasRing = true;
        dimension = firstNonZero(attributesOf(scope_, ring.node).dimension, dimension);
        if (ring.localName == "LinearRing")
            readPositions(ring, dimension);
        else
            readCurve(ring, dimension, 0);
    });
    return finishRing(polygon, property.node, false);
}

// A boundary made of curves: the positions of their segments, concatenated.
void GeometryReader::readCurve(const Element& element, int dimension, int depth) {
    if (depth > kMaxCurveDepth) return;
    const ElementAttributes attributes = attributesOf(scope_, element.node);
    const std::size_t first = points_.size();
    bool hasPositions = false;
    scope_.forEachChild(element.node, [&](const Element& child) {
        const string_view name = child.localName;
        if (name == "posList" || name == "pos" || name == "coordinates" || name == "coord" || name == "pointProperty" ||
            name == "pointRep") {
            hasPositions = true;
            readPosition(child, dimension);
        } else if (name == "curveMember" || name == "baseCurve" || name == "segments" || name == "curveMembers") {
            scope_.forEachChild(child.node, [&](const Element& curve) {
                readCurve(curve, firstNonZero(attributes.dimension, dimension), depth + 1);
            });
        }
    });
    if (hasPositions && element.localName != "LineString" && element.localName != "LineStringSegment")
        part_.addUnknown(element.node.name(), offsetOf_(element.node));  // an arc, read as its control polygon
    if (attributes.orientation == "-")
        std::reverse(points_.begin() + static_cast<std::ptrdiff_t>(first), points_.end());
    // A curve starts at the end of the previous one.
    if (first > 0 && first < points_.size() && points_[first] == points_[first - 1])
        points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(first));
}

void GeometryReader::readPositions(const Element& element, int dimension) {
    scope_.forEachChild(element.node, [&](const Element& child) { readPosition(child, dimension); });
}

// One of the ways to write positions; they may be mixed within a ring.
void GeometryReader::readPosition(const Element& element, int dimension) {
    const string_view name = element.localName;
    if (name == "posList" || name == "pos") {
        const int stated = attributesOf(scope_, element.node).dimension;
        addNumbers(xml::textOf(element.node, scratch_), stated, dimension, element.node);
    } else if (name == "coordinates") {
        const auto separator = [&](const char* attribute, char otherwise) {
            const string_view value = element.node.attribute(attribute).value();
            return value.empty() ? otherwise : value.front();
        };
        const std::optional<Tuples> tuples = parseTuples(xml::textOf(element.node, scratch_), separator("decimal", '.'),
                                                         separator("cs", ','), separator("ts", ' '));
        if (!tuples) return reportRing(Code::BadValue, "gml:coordinates that are not tuples of numbers", element.node);
        numbers_ = tuples->numbers;
        const int size = static_cast<int>(std::min<std::size_t>(tuples->dimension, 4));
        const int found = dimensionOf(numbers_, size, dimension);
        if (found == 0) return reportRing(Code::BadValue, "gml:coordinates that are neither 2-D nor 3-D", element.node);
        addPoints(found);
    } else if (name == "coord") {
        numbers_.clear();
        scope_.forEachChild(element.node, [&](const Element& axis) {
            if (const std::optional<double> value = parseNumber(xml::textOf(axis.node, scratch_)))
                numbers_.push_back(*value);
        });
        if (numbers_.size() != 2 && numbers_.size() != 3)
            return reportRing(Code::BadValue, "gml:coord without X and Y", element.node);
        addPoints(static_cast<int>(numbers_.size()));
    } else if (name == "pointProperty" || name == "pointRep") {
        scope_.forEachChild(element.node, [&](const Element& point) {
            if (point.localName == "Point") readPositions(point, dimension);
        });
    }
}

// Parses `text` and adds its points. On an error the ring is marked as failed.
void GeometryReader::addNumbers(string_view text, int stated, int inherited, pugi::xml_node at) {
    numbers_.clear();
    const string_view bad = parseNumbers(text, numbers_);
    if (!bad.empty())
        return reportRing(Code::BadCoordinate, fmt::format("'{}' is not a number", bad.substr(0, 40)), at);
    const int dimension = dimensionOf(numbers_, stated, inherited);
    if (dimension == 0)
        return reportRing(Code::BadValue,
                          fmt::format("{} numbers cannot be divided into 3-D or 2-D positions", numbers_.size()), at);
    addPoints(dimension);
}

void GeometryReader::addPoints(int dimension) {
    isFlat_ = dimension == 2;
    points_.reserve(points_.size() + numbers_.size() / static_cast<std::size_t>(dimension));
    if (dimension == 3)
        for (std::size_t i = 0; i + 2 < numbers_.size(); i += 3)
            points_.push_back({numbers_[i], numbers_[i + 1], numbers_[i + 2]});
    else
        for (std::size_t i = 0; i + 1 < numbers_.size(); i += 2) points_.push_back({numbers_[i], numbers_[i + 1], 0});
}

// Moves the points read into `polygon` as its next ring; false if the ring is unusable. A patch lists each point once.
bool GeometryReader::finishRing(model::Polygon& polygon, pugi::xml_node at, bool isPatch) {
    if (ringFailed_) return false;
    for (const Vec3d& point : points_) {
        const bool isGood = std::abs(point.x) <= kLargestCoordinate && std::abs(point.y) <= kLargestCoordinate &&
                            std::abs(point.z) <= kLargestCoordinate;  // false for NaN too
        if (isGood) continue;
        reportRing(Code::BadCoordinate,
                   fmt::format("the coordinate {} {} {} is not finite or absurdly large", point.x, point.y, point.z),
                   at);
        return false;
    }
    const bool isClosed = points_.size() > 1 && points_.front() == points_.back();
    if (isClosed) points_.pop_back();
    if (!hasThreeDistinct(points_)) {
        reportRing(Code::TooFewPoints,
                   fmt::format("a ring of {} points, fewer than three of them distinct", points_.size()), at);
        return false;
    }
    constexpr double kOnePoint = 0.001;  // metres; ends within this distance are meant to be one point
    if (!isClosed && !isPatch && length(points_.front() - points_.back()) > kOnePoint)
        part_.findings.add(
            Severity::Warning, Code::RingNotClosed,
            fmt::format("the last point of a ring of {} is not its first; the ring is closed between them",
                        points_.size()),
            offsetOf_(at), std::string(polygonId_));
    polygon.points.insert(polygon.points.end(), points_.begin(), points_.end());
    polygon.ringEnds.push_back(static_cast<std::uint32_t>(polygon.points.size()));
    if (isFlat_ && part_.flatRings++ == 0) part_.firstFlat = offsetOf_(at);
    if (!isFlat_) ++part_.fullRings;
    return true;
}

void GeometryReader::reportRing(Code code, const std::string& message, pugi::xml_node at) {
    ringFailed_ = true;
    part_.findings.add(Severity::Warning, code, message + "; the ring is left out", offsetOf_(at),
                       std::string(polygonId_));
}

NodeIndex GeometryReader::readImplicit(const Element& element) {
    const ElementAttributes attributes = attributesOf(scope_, element.node);
    const NodeIndex index = addNode(NodeKind::Implicit, element.node, attributes.id);
    Placement placement;
    bool hasPoint = false;
    bool isUsable = true;
    scope_.forEachChild(element.node, [&](const Element& property) {
        const string_view name = property.localName;
        if (name == "transformationMatrix") {
            isUsable = readMatrix(property, placement) && isUsable;
        } else if (name == "referencePoint") {
            points_.clear();
            ringFailed_ = false;
            scope_.forEachChild(property.node, [&](const Element& point) {
                part_.addCrsName(attributesOf(scope_, point.node).srsName, {}, offsetOf_(point.node));
                readPositions(point, 0);
            });
            hasPoint = points_.size() == 1 && std::abs(points_[0].x) <= kLargestCoordinate &&
                       std::abs(points_[0].y) <= kLargestCoordinate && std::abs(points_[0].z) <= kLargestCoordinate;
            if (hasPoint) placement.referencePoint = points_[0];
        } else if (name == "libraryObject") {
            const ElementAttributes library = attributesOf(scope_, property.node);
            const string_view file = library.hasHref ? library.href : xml::textOf(property.node, scratch_);
            part_.findings.add(
                Severity::Warning, Code::ExternalReference,
                fmt::format("the shape is in another file, '{}', which is not read", file.substr(0, 200)),
                offsetOf_(property.node), std::string(attributes.id));
        } else if (name == "relativeGMLGeometry" || name == "relativeGeometry") {
            const bool wasPrototype = std::exchange(isPrototype_, true);
            const ElementAttributes relative = attributesOf(scope_, property.node);
            if (relative.hasHref && !xml::firstChildElement(property.node))
                addChild(index, readReference(relative.href, property.node));
            else
                scope_.forEachChild(property.node, [&](const Element& shape) { addChild(index, read(shape)); });
            isPrototype_ = wasPrototype;
        }
    });
    polygonId_ = {};
    if (!hasPoint) {
        part_.findings.add(Severity::Warning, Code::BadValue,
                           "an ImplicitGeometry without a usable referencePoint is left out", offsetOf_(element.node),
                           std::string(attributes.id));
        isUsable = false;
    }
    if (!isUsable) {
        // The prototype stays in the graph, since other references may use it.
        return kNone;
    }
    part_.nodes[index].payload = static_cast<std::uint32_t>(part_.placements.size());
    part_.placements.push_back(placement);
    return index;
}

bool GeometryReader::readMatrix(const Element& element, Placement& placement) {
    numbers_.clear();
    const string_view bad = parseNumbers(xml::textOf(element.node, scratch_), numbers_);
    const bool isGood = bad.empty() && numbers_.size() == placement.matrix.size() &&
                        std::all_of(numbers_.begin(), numbers_.end(),
                                    [](double value) { return std::abs(value) <= kLargestCoordinate; });
    if (isGood)
        std::copy(numbers_.begin(), numbers_.end(), placement.matrix.begin());
    else
        part_.findings.add(
            Severity::Warning, Code::BadValue,
            fmt::format("a transformationMatrix of {} numbers; expected 16. The geometry is left out", numbers_.size()),
            offsetOf_(element.node));
    return isGood;
}

}  // namespace svt::readers::gml
