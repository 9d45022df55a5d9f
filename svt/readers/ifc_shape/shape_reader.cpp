#include <svt/readers/ifc_shape/shape_reader.hpp>

#include <svt/readers/ifc_shape/curved_face.hpp>
#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/sectioned.hpp>
#include <svt/readers/ifc_shape/solid_boolean.hpp>
#include <svt/readers/ifc_shape/sweeps.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::readers::ifc {
namespace {

using Polygons = std::vector<model::Polygon>;

bool isIn(std::string_view word, std::initializer_list<std::string_view> words) noexcept {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Preference of a representation as the body of a product; 0: it is not a body.
int bodyRank(std::string_view identifier, std::string_view type) noexcept {
    if (isIn(identifier,
             {"Axis", "FootPrint", "Annotation", "Plan", "Profile", "CoG", "Clearance", "Lighting", "Survey"}))
        return 0;
    if (isIn(type, {"Curve2D", "Curve3D", "Curve", "GeometricCurveSet", "Annotation2D", "Point", "PointCloud",
                    "LightSource", "Text", "Segment"}))
        return 0;
    if (identifier == "Box" || type == "BoundingBox") return 1;
    if (identifier == "Body") return 6;
    if (isIn(identifier, {"Facetation", "Tessellation"})) return 5;
    if (isIn(identifier, {"Body-FallBack", "Body-Fallback", "Surface"})) return 4;
    if (identifier == "Reference") return 2;
    return 3;
}

// Reverses a ring, which still begins where an edge begins, and the ends of its edges.
void turnLoop(std::vector<Vec3d>& ring, std::vector<std::size_t>& ends) {
    if (ring.empty()) return;
    std::reverse(ring.begin() + 1, ring.end());
    if (ends.empty()) return;
    for (std::size_t& end : ends) end = ring.size() - end;
    std::reverse(ends.begin(), ends.end());
    ends.erase(ends.begin());  // the 0 that was the last end
    ends.push_back(ring.size());
}

}  // namespace

ShapeReader::ShapeReader(const IfcFile& file, std::unordered_map<RecordIndex, std::int32_t> materialOfItem,
                         std::unordered_map<RecordIndex, std::vector<std::int32_t>> materialOfFaces)
    : file_(file), materialOfItem_(std::move(materialOfItem)), materialOfFaces_(std::move(materialOfFaces)) {}

void ShapeReader::leaveOut(std::string what) {
    if (leftOut_.size() == kMaxLeftOut || !file_.guard().takeSteps(leftOut_.size())) return;
    if (std::find(leftOut_.begin(), leftOut_.end(), what) == leftOut_.end()) leftOut_.push_back(std::move(what));
}

// Reports references to missing records since the last call as parts of the current item.
void ShapeReader::leaveOutMissing() {
    for (std::string& what : file_.missing().take()) leaveOut(std::move(what));
}

// Drops a body beyond the budget, which discards the whole product later.
void ShapeReader::addBody(Body body, Bodies& bodies) {
    if (file_.guard().takeElements(pointCount(body.faces))) bodies.push_back(std::move(body));
}

// Whether the budget has room for a number of points; if not, reports the item as left out.
bool ShapeReader::affords(std::uint64_t points) {
    if (file_.guard().affords(points)) return true;
    leaveOut(file_.guard().whatIsSpent());
    return false;
}

Shape ShapeReader::readShape(RecordIndex definition) {
    Shape shape;
    leftOut_.clear();
    std::vector<std::pair<int, RecordIndex>> ranked;
    for (const RecordIndex representation : file_.representations(definition)) {
        const Fields fields = file_.fieldsOf(representation);
        const int rank = bodyRank(fields[at::Representation::RepresentationIdentifier].string().value_or(""),
                                  fields[at::Representation::RepresentationType].string().value_or(""));
        if (rank > 0) ranked.emplace_back(-rank, representation);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    leaveOutMissing();
    shape.hasRepresentation = !ranked.empty() || !leftOut_.empty();
    std::vector<std::string> leftOut;
    for (std::size_t i = 0; i < ranked.size() && shape.bodies.empty(); ++i) {
        const int rank = ranked[i].first;
        readRepresentation(ranked[i].second, shape.bodies);
        // Several representations of one kind are parts of one body.
        for (; i + 1 < ranked.size() && ranked[i + 1].first == rank && rank == -6; ++i)
            readRepresentation(ranked[i + 1].second, shape.bodies);
        if (rank != -1 || shape.bodies.empty()) continue;
        // A box says how far the product reaches, not how much of the box it fills.
        for (Body& body : shape.bodies) body.isSolid = false;
        shape.isBoundingBox = true;
        leaveOut("all but its bounding box, which is kept as a surface without volume");
    }
    leaveOutMissing();
    shape.leftOut = std::move(leftOut_);
    leftOut_.clear();
    return shape;
}

void ShapeReader::readRepresentation(RecordIndex representation, Bodies& bodies) {
    for (const RecordIndex item : file_.items(representation)) readItem(item, bodies);
}

void ShapeReader::readItem(RecordIndex item, Bodies& bodies) {
    ReadGuard::Scope scope(file_.guard());
    if (!scope.enter(item)) return leaveOut(scope.why());
    const std::size_t first = bodies.size();
    readKnownItem(item, file_.fieldsOf(item), bodies);
    const auto style = materialOfItem_.find(item);
    if (style == materialOfItem_.end()) return;
    for (std::size_t b = first; b < bodies.size(); ++b)
        if (bodies[b].material < 0) bodies[b].material = style->second;
}

void ShapeReader::readKnownItem(RecordIndex item, const Fields& fields, Bodies& bodies) {
    switch (file_.entityOf(item)) {
        case Entity::ExtrudedAreaSolid:
        case Entity::ExtrudedAreaSolidTapered:
        case Entity::RevolvedAreaSolid: return readSweep(item, fields, bodies);
        case Entity::FixedReferenceSweptAreaSolid:
        case Entity::DirectrixDerivedReferenceSweptAreaSolid:
        case Entity::SurfaceCurveSweptAreaSolid: return readDirectedSweep(item, fields, bodies);
        case Entity::SectionedSolidHorizontal:
        case Entity::SectionedSpine: {
            std::string why;
            for (Polygons& faces : readSectioned(file_, item, why)) addSolid(std::move(faces), bodies, item);
            if (!why.empty()) leaveOut(std::move(why));
            return;
        }
        case Entity::SweptDiskSolid:
        case Entity::SweptDiskSolidPolygonal: return readDisk(fields, bodies);
        case Entity::FacetedBrep:
        case Entity::FacetedBrepWithVoids:
        case Entity::AdvancedBrep:
        case Entity::AdvancedBrepWithVoids: return readBrep(item, fields, bodies);
        case Entity::FaceBasedSurfaceModel:
            for (const RecordIndex shell : file_.followAll(fields[at::FaceBasedSurfaceModel::FbsmFaces]))
                addShell(shell, bodies);
            return;
        case Entity::ShellBasedSurfaceModel:
            for (const RecordIndex shell : file_.followAll(fields[at::ShellBasedSurfaceModel::SbsmBoundary]))
                addShell(shell, bodies);
            return;
        case Entity::ConnectedFaceSet:
        case Entity::OpenShell:
        case Entity::ClosedShell: return addShell(item, bodies);
        case Entity::TriangulatedFaceSet:
        case Entity::TriangulatedIrregularNetwork:
        case Entity::PolygonalFaceSet: return readFaceSet(item, fields, bodies);
        case Entity::MappedItem: return readMappedItem(fields, bodies);
        case Entity::BooleanResult:
        case Entity::BooleanClippingResult: return readBoolean(fields, bodies);
        case Entity::CsgSolid: return readItem(file_.follow(fields[at::CsgSolid::TreeRootExpression]), bodies);
        case Entity::Block:
        case Entity::RectangularPyramid:
        case Entity::RightCircularCone:
        case Entity::RightCircularCylinder:
        case Entity::Sphere:
        case Entity::BoundingBox: return readPrimitive(item, fields, bodies);
        default:
            if (item == kNoRecord)
                leaveOut("an item that is not in the file");
            else
                leaveOut(fmt::format("an item {}", file_.typeName(item).substr(0, 80)));
    }
}

void ShapeReader::addSolid(Polygons faces, Bodies& bodies, RecordIndex item) {
    if (faces.empty())
        leaveOut(fmt::format("an {} whose measures make no body", file_.typeName(item)));
    else
        addBody({std::move(faces), true, -1}, bodies);
}

void ShapeReader::readSweep(RecordIndex item, const Fields& fields, Bodies& bodies) {
    const Entity entity = file_.entityOf(item);
    std::vector<Region> regions, ends;
    std::string why;
    if (!readProfile(file_, file_.follow(fields[at::SweptAreaSolid::SweptArea]), regions, why)) return leaveOut(why);
    const Transform position = file_.axes(fields[at::SweptAreaSolid::Position]);
    if (entity == Entity::RevolvedAreaSolid) {
        const Transform axis = file_.axes(fields[at::RevolvedAreaSolid::Axis]);
        const double angle = file_.radians(fields[at::RevolvedAreaSolid::Angle]);
        for (const Region& region : regions) {
            if (!affords(region.pointCount() * 4 * (kMaxSegments + 1))) return;
            addSolid(transformed(revolve(region, axis, angle), position), bodies, item);
        }
        return;
    }
    namespace extrusion = at::ExtrudedAreaSolidTapered;
    const Vec3d sweep = normalized(file_.direction(fields[extrusion::ExtrudedDirection]).value_or(Vec3d{0, 0, 1})) *
                        file_.metres(fields[extrusion::Depth]);
    const bool isTapered = entity == Entity::ExtrudedAreaSolidTapered;
    if (isTapered && (!readProfile(file_, file_.follow(fields[extrusion::EndSweptArea]), ends, why) ||
                      ends.size() != regions.size()))
        return leaveOut(why.empty() ? "a tapered solid between unlike profiles" : why);
    std::uint64_t points = 0;
    for (const Region& region : regions) points += 8 * region.pointCount();
    if (!affords(points)) return;
    for (std::size_t r = 0; r < regions.size(); ++r)
        addSolid(
            transformed(isTapered ? extrudeTapered(regions[r], ends[r], sweep) : extrude(regions[r], sweep), position),
            bodies, item);
}

// A profile along a curve. Its x axis follows a direction, or the normal of the plane of the curve.
void ShapeReader::readDirectedSweep(RecordIndex item, const Fields& fields, Bodies& bodies) {
    namespace swept = at::DirectrixCurveSweptAreaSolid;
    std::vector<Region> regions;
    std::vector<Vec3d> line;
    std::string why;
    if (!readProfile(file_, file_.follow(fields[swept::SweptArea]), regions, why) ||
        !readCurve(file_, file_.follow(fields[swept::Directrix]), line, why))
        return leaveOut(why);
    Vec3d reference =
        file_.direction(fields[at::FixedReferenceSweptAreaSolid::FixedReference]).value_or(Vec3d{0, 0, 1});
    if (file_.entityOf(item) == Entity::SurfaceCurveSweptAreaSolid) {
        const RecordIndex surface = file_.follow(fields[at::SurfaceCurveSweptAreaSolid::ReferenceSurface]);
        if (file_.entityOf(surface) != Entity::Plane)
            return leaveOut(fmt::format("a profile swept along a curve on {}", file_.typeName(surface)));
        reference = file_.axes(file_.follow(surface, at::Plane::Position)).z;
    }
    if (!isWholeCurve(line, fields[swept::StartParam], fields[swept::EndParam]))
        leaveOut("the ends of a swept profile, which stand at parameters of its curve: it has the whole curve");
    const Transform position = file_.axes(fields[swept::Position]);
    for (const Region& region : regions) {
        if (!affords(region.pointCount() * 6 * line.size())) return;
        addSolid(transformed(sweepAlong(region, line, reference), position), bodies, item);
    }
}

// Writers disagree about parameters: from 0 to 1, to the number of segments, or to the length. A part of a curve would need
// the parameter of each kind of curve.
bool ShapeReader::isWholeCurve(const std::vector<Vec3d>& line, Value first, Value last) const {
    const double begin = first.number().value_or(0), end = last.number().value_or(1);
    double whole = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) whole += length(line[i + 1] - line[i]);
    const auto isEnd = [&](double value) { return std::abs(end - value) <= 1e-3 * value; };
    return begin == 0 && (isEnd(1) || isEnd(double(line.size() - 1)) || isEnd(whole / file_.lengthUnit));
}

void ShapeReader::readDisk(const Fields& fields, Bodies& bodies) {
    std::vector<Vec3d> line;
    std::string why;
    const RecordIndex directrix = file_.follow(fields[at::SweptDiskSolid::Directrix]);
    if (!readCurve(file_, directrix, line, why)) return leaveOut(why);
    const Value first = fields[at::SweptDiskSolid::StartParam], last = fields[at::SweptDiskSolid::EndParam];
    // At 1, a polyline has its second point.
    const bool isFirstSegment =
        file_.entityOf(directrix) == Entity::Polyline && line.size() > 2 && last.number().value_or(0) == 1;
    if (isFirstSegment || !isWholeCurve(line, first, last))
        leaveOut("the ends of a swept disk, which stand at parameters of its curve: it has the whole curve");
    if (!affords(line.size() * 2 * 6 * kMaxDiskSegments)) return;
    Polygons faces = sweepDisk(std::move(line), file_.metres(fields[at::SweptDiskSolid::Radius]),
                               file_.metres(fields[at::SweptDiskSolid::InnerRadius]));
    if (faces.empty()) return leaveOut("a swept disk without length or radius");
    addBody({std::move(faces), true, -1}, bodies);
}

void ShapeReader::readPrimitive(RecordIndex item, const Fields& fields, Bodies& bodies) {
    const auto size = [&](AttributePosition attribute) { return file_.metres(fields[attribute]); };
    const auto blockOf = [&](AttributePosition x, AttributePosition y, AttributePosition z) {
        return block({size(x), size(y), size(z)});
    };
    Transform position = file_.axes(fields[at::CsgPrimitive3D::Position]);
    Polygons faces;
    switch (file_.entityOf(item)) {
        case Entity::Block: faces = blockOf(at::Block::XLength, at::Block::YLength, at::Block::ZLength); break;
        case Entity::RectangularPyramid:
            faces = pyramid(size(at::RectangularPyramid::XLength), size(at::RectangularPyramid::YLength),
                            size(at::RectangularPyramid::Height));
            break;
        case Entity::RightCircularCone:
            faces = cone(size(at::RightCircularCone::BottomRadius), 0, size(at::RightCircularCone::Height));
            break;
        case Entity::RightCircularCylinder: {
            const double radius = size(at::RightCircularCylinder::Radius);
            faces = cone(radius, radius, size(at::RightCircularCylinder::Height));
            break;
        }
        case Entity::Sphere: faces = sphere(size(at::Sphere::Radius)); break;
        default:
            faces = blockOf(at::BoundingBox::XDim, at::BoundingBox::YDim, at::BoundingBox::ZDim);
            position = {};
            position.origin = file_.point(fields[at::BoundingBox::Corner]).value_or(Vec3d{});
    }
    addSolid(transformed(faces, position), bodies, item);
}

// The items of a representation map, read once.
void ShapeReader::readMap(RecordIndex map) {
    leaveOutMissing();
    const Fields source = file_.fieldsOf(map);
    const RecordIndex shown = file_.follow(source[at::RepresentationMap::MappedRepresentation]);
    ReadGuard::Scope scope(file_.guard());
    if (!scope.enter(map) || !scope.enter(shown)) return leaveOut(scope.why());
    std::vector<std::string> outside;
    std::swap(outside, leftOut_);
    Bodies made;
    readRepresentation(shown, made);
    const Transform origin = file_.axes(source[at::RepresentationMap::MappingOrigin]);
    if (origin != Transform{})
        for (Body& body : made) body = transformed(body, origin.inverse());
    leaveOutMissing();
    std::swap(outside, leftOut_);
    // Keeps a map only if the budget of this product sufficed, because other products use it too.
    if (file_.guard().isSpent()) return leaveOut(file_.guard().whatIsSpent());
    leftOutOfMap_[map] = std::move(outside);
    mapped_.emplace(map, std::make_shared<const Bodies>(std::move(made)));
}

void ShapeReader::readMappedItem(const Fields& fields, Bodies& bodies) {
    const RecordIndex map = file_.follow(fields[at::MappedItem::MappingSource]);
    if (mapped_.find(map) == mapped_.end()) readMap(map);
    const auto found = mapped_.find(map);
    if (found == mapped_.end()) return;
    for (const std::string& what : leftOutOfMap_[map]) leaveOut(what);
    const Transform target = file_.transformation(fields[at::MappedItem::MappingTarget]);
    if (!(std::abs(target.determinant()) > 1e-30)) return leaveOut("a mapped item with a scale of 0");
    const std::shared_ptr<const Bodies> source = found->second;
    std::uint64_t points = 0;
    for (const Body& body : *source) points += pointCount(body.faces);
    if (!affords(points)) return;
    for (const Body& body : *source) addBody(transformed(body, target), bodies);
}

void ShapeReader::readBrep(RecordIndex item, const Fields& fields, Bodies& bodies) {
    const Entity entity = file_.entityOf(item);
    Polygons faces = readShell(file_.follow(fields[at::ManifoldSolidBrep::Outer]));
    if (faces.empty()) return leaveOut(fmt::format("an {} without faces", entityName(entity)));
    if (entity == Entity::FacetedBrepWithVoids || entity == Entity::AdvancedBrepWithVoids) {
        if (enclosedVolume(faces) < 0) turnOver(faces);
        for (const RecordIndex shell : file_.followAll(fields[at::FacetedBrepWithVoids::Voids])) {
            Polygons hollow = readShell(shell);
            if (enclosedVolume(hollow) > 0) turnOver(hollow);
            faces.insert(faces.end(), hollow.begin(), hollow.end());
        }
    }
    addBody({std::move(faces), true, -1}, bodies);
}

void ShapeReader::addShell(RecordIndex shell, Bodies& bodies) {
    Body body{readShell(shell), file_.entityOf(shell) == Entity::ClosedShell, -1};
    if (!body.faces.empty()) addBody(std::move(body), bodies);
}

Polygons ShapeReader::readShell(RecordIndex shell) {
    Polygons faces;
    step::ValueCursor cursor(file_.fieldsOf(shell)[at::ConnectedFaceSet::CfsFaces]);
    for (Value item; cursor.next(item);) {
        const RecordIndex face = file_.follow(item);
        if (!readFace(face, faces))
            leaveOut(fmt::format("a face {}", face == kNoRecord ? "that is not in the file" : file_.typeName(face)));
    }
    return faces;
}

bool ShapeReader::readLoop(RecordIndex loop, std::vector<Vec3d>& ring, std::vector<std::size_t>& edgeEnds) {
    const Fields fields = file_.fieldsOf(loop);
    if (file_.entityOf(loop) == Entity::PolyLoop) {
        step::ValueCursor corners(fields[at::PolyLoop::Polygon]);
        for (Value item; corners.next(item);) {
            const auto point = file_.point(item);
            if (!point) return false;
            ring.push_back(*point);
        }
        return true;
    }
    if (file_.entityOf(loop) != Entity::EdgeLoop) return false;
    step::ValueCursor cursor(fields[at::EdgeLoop::EdgeList]);
    for (Value item; cursor.next(item);) {
        const Fields oriented = file_.fieldsOf(file_.follow(item));
        std::vector<Vec3d> points;
        if (!readEdge(file_.follow(oriented[at::OrientedEdge::EdgeElement]), points)) return false;
        if (oriented[at::OrientedEdge::Orientation].enumeration() == "F") std::reverse(points.begin(), points.end());
        if (points.empty() || !affords(ring.size() + points.size())) return false;
        ring.insert(ring.end(), points.begin(), points.end() - 1);
        edgeEnds.push_back(ring.size());
    }
    return !ring.empty();
}

// Points of an edge from its start to its end, read once.
bool ShapeReader::readEdge(RecordIndex edge, std::vector<Vec3d>& points) {
    if (const auto found = edges_.find(edge); found != edges_.end()) {
        points = *found->second;
        return true;
    }
    const Fields fields = file_.fieldsOf(edge);
    const auto from = file_.vertexPoint(fields[at::Edge::EdgeStart]), to = file_.vertexPoint(fields[at::Edge::EdgeEnd]);
    std::string why;
    if (!from || !to) return false;
    const bool isForward = fields[at::EdgeCurve::SameSense].enumeration() != "F";
    if (file_.entityOf(edge) != Entity::EdgeCurve)
        points = {*from, *to};
    else if (!readCurveBetween(file_, file_.follow(fields[at::EdgeCurve::EdgeGeometry]), *from, *to, isForward, points,
                               why))
        return false;
    // An edge with a missing reference is read again, so that each product with it reports it.
    if (!file_.missing().isAny()) edges_.emplace(edge, std::make_shared<const std::vector<Vec3d>>(points));
    return true;
}

bool ShapeReader::readFace(RecordIndex face, Polygons& faces) {
    const Entity entity = file_.entityOf(face);
    if (entity != Entity::Face && entity != Entity::FaceSurface && entity != Entity::AdvancedFace) return false;
    const Fields fields = file_.fieldsOf(face);
    const RecordIndex surface = entity == Entity::Face ? kNoRecord : file_.follow(fields[at::FaceSurface::FaceSurface]);
    const Entity kind = file_.entityOf(surface);
    const bool isCurved = surface != kNoRecord && kind != Entity::Plane;
    std::vector<std::vector<Vec3d>> rings;
    std::vector<std::size_t> edgeEnds;
    bool hasOuter = false;
    step::ValueCursor cursor(fields[at::Face::Bounds]);
    for (Value item; cursor.next(item);) {
        const RecordIndex bound = file_.follow(item);
        const Fields of = file_.fieldsOf(bound);
        std::vector<Vec3d> ring;
        std::vector<std::size_t> ends;
        if (!readLoop(file_.follow(of[at::FaceBound::Bound]), ring, ends) || !file_.guard().takeElements(ring.size()))
            return false;
        if (of[at::FaceBound::Orientation].enumeration() == "F") turnLoop(ring, ends);
        const bool isOuter = file_.entityOf(bound) == Entity::FaceOuterBound && !hasOuter;
        hasOuter = hasOuter || isOuter;
        if (rings.empty()) edgeEnds = ends;
        rings.insert(isOuter ? rings.begin() : rings.end(), std::move(ring));
    }
    if (rings.empty()) return false;
    // Four straight edges do not determine a B-spline surface between them.
    const bool isSpline = kind == Entity::BSplineSurfaceWithKnots || kind == Entity::RationalBSplineSurfaceWithKnots;
    if (isCurved && !isSpline && addRuledFace(rings, edgeEnds, faces)) return true;
    if (isCurved && addCurvedFace(file_, surface, rings, faces)) return true;
    if (isCurved) leaveOut(fmt::format("the curvature of a face on {}", file_.typeName(surface)));
    if (!hasOuter && rings.size() > 1) {
        const auto largest = std::max_element(rings.begin(), rings.end(), [&](const auto& p, const auto& q) {
            return length(newellNormal(p)) < length(newellNormal(q));
        });
        std::iter_swap(rings.begin(), largest);
    }
    const Vec3d normal = newellNormal(rings[0]);
    for (std::size_t r = 1; r < rings.size(); ++r)
        if (dot(newellNormal(rings[r]), normal) > 0) std::reverse(rings[r].begin(), rings[r].end());
    addFace(faces, rings);
    return true;
}

// A face between two curves of equally many points: the sides of a cylinder or cone, whole, half or as a fillet.
bool ShapeReader::addRuledFace(const std::vector<std::vector<Vec3d>>& rings, const std::vector<std::size_t>& edgeEnds,
                               Polygons& faces) {
    if (rings.size() == 2 && rings[0].size() == rings[1].size() && rings[0].size() >= 8) {
        const std::size_t n = rings[0].size();
        std::vector<Vec3d> other(rings[1].rbegin(), rings[1].rend());
        const auto nearest = std::min_element(other.begin(), other.end(), [&](Vec3d p, Vec3d q) {
            return length(p - rings[0][0]) < length(q - rings[0][0]);
        });
        std::rotate(other.begin(), nearest, other.end());
        for (std::size_t i = 0; i < n; ++i)
            addQuad(faces, rings[0][i], rings[0][(i + 1) % n], other[(i + 1) % n], other[i]);
        return true;
    }
    if (rings.size() != 1 || edgeEnds.size() != 4) return false;
    std::vector<std::vector<Vec3d>> edges;
    std::size_t begin = 0;
    for (const std::size_t end : edgeEnds) {
        edges.emplace_back(rings[0].begin() + std::ptrdiff_t(begin), rings[0].begin() + std::ptrdiff_t(end));
        edges.back().push_back(rings[0][end % rings[0].size()]);
        begin = end;
    }
    if (edges[0].size() == 2) std::rotate(edges.begin(), edges.begin() + 1, edges.end());
    if (edges[1].size() != 2 || edges[3].size() != 2 || edges[0].size() != edges[2].size()) return false;
    std::reverse(edges[2].begin(), edges[2].end());
    for (std::size_t i = 0; i + 1 < edges[0].size(); ++i)
        addQuad(faces, edges[0][i], edges[0][i + 1], edges[2][i + 1], edges[2][i]);
    return true;
}

void ShapeReader::readFaceSet(RecordIndex item, const Fields& fields, Bodies& bodies) {
    const auto points = file_.pointList(fields[at::TessellatedFaceSet::Coordinates]);
    if (!points)
        return leaveOut(fmt::format("an {} with a point that does not have three numbers", file_.typeName(item)));
    bool isWrong = false;
    const auto ringOf = [&](Value numbers) {
        std::vector<Vec3d> ring;
        if (!appendNumbered(numbers, *points, ring)) isWrong = true;
        return ring;
    };
    Body body;
    const bool isTriangles = file_.entityOf(item) != Entity::PolygonalFaceSet;
    const Value closed = fields[at::TessellatedFaceSet::Closed];
    body.isSolid =
        (closed.enumeration().empty() ? fields[at::TriangulatedFaceSetOfIfc4::Closed] : closed).enumeration() == "T";
    step::ValueCursor cursor(isTriangles ? fields[at::TriangulatedFaceSet::CoordIndex]
                                         : fields[at::PolygonalFaceSet::Faces]);
    const auto colors = materialOfFaces_.find(item);
    std::size_t number = 0;
    // A face without area is left out, together with its colour.
    const auto add = [&](const std::vector<std::vector<Vec3d>>& rings) {
        const std::size_t before = body.faces.size();
        addFace(body.faces, rings);
        if (colors != materialOfFaces_.end() && number < colors->second.size() && body.faces.size() > before)
            body.faces.back().material = colors->second[number];
        ++number;
    };
    for (Value face; cursor.next(face) && !file_.guard().isSpent();) {
        if (isTriangles) {
            add({ringOf(face)});
            continue;
        }
        const RecordIndex record = file_.follow(face);
        const Fields of = file_.fieldsOf(record);
        std::vector<std::vector<Vec3d>> rings{ringOf(of[at::IndexedPolygonalFace::CoordIndex])};
        if (file_.entityOf(record) == Entity::IndexedPolygonalFaceWithVoids) {
            step::ValueCursor inner(of[at::IndexedPolygonalFaceWithVoids::InnerCoordIndices]);
            for (Value ring; inner.next(ring);) rings.push_back(ringOf(ring));
        }
        add(rings);
        // A face may be listed any number of times, so that the file size does not limit the number of faces.
        if (!body.faces.empty()) file_.guard().takeElements(body.faces.back().points.size());
    }
    if (isWrong) leaveOut(fmt::format("corners of an {} with an index that is out of range", file_.typeName(item)));
    if (body.faces.empty()) return leaveOut(fmt::format("an {} without faces", file_.typeName(item)));
    addBody(std::move(body), bodies);
}

// A plain, boxed or polygonal half-space, as a closed body that reaches beyond `around`.
bool ShapeReader::readHalfSpace(RecordIndex item, const Box3d& around, Bodies& bodies) {
    const Entity entity = file_.entityOf(item);
    const Fields fields = file_.fieldsOf(item);
    const RecordIndex surface = file_.follow(fields[at::HalfSpaceSolid::BaseSurface]);
    if (file_.entityOf(surface) != Entity::Plane) {
        leaveOut(fmt::format("a half-space bounded by {}", file_.typeName(surface)));
        return false;
    }
    const Transform plane = file_.axes(file_.follow(surface, at::Plane::Position));
    const Vec3d inside = fields[at::HalfSpaceSolid::AgreementFlag].enumeration() == "F" ? plane.z : -plane.z;
    Polygons half = halfSpaceAround(around, plane.origin, inside);
    if (entity == Entity::PolygonalBoundedHalfSpace) {
        const Transform position = file_.axes(fields[at::PolygonalBoundedHalfSpace::Position]);
        Region region;
        std::string why;
        if (!readCurve(file_, file_.follow(fields[at::PolygonalBoundedHalfSpace::PolygonalBoundary]), region.outer,
                       why)) {
            leaveOut(why);
            return false;
        }
        closeRing(region.outer);
        if (twiceArea(region.outer) < 0) std::reverse(region.outer.begin(), region.outer.end());
        const double middle = dot(around.center() - position.origin, position.z), reach = length(around.size()) + 1;
        for (Vec3d& p : region.outer) p.z = middle - reach;
        auto both = evaluateBoolean(BooleanOperator::Intersection,
                                    {transformed(extrude(region, {0, 0, 2 * reach}), position), half}, file_.guard());
        if (!both) {
            leaveOut("a polygonal half-space that is not closed");
            return false;
        }
        half = std::move(*both);
    }
    if (!half.empty()) bodies.push_back({std::move(half), true, -1});
    return true;
}

// The second operand of a boolean as closed bodies; false, and reported, if it is not closed.
bool ShapeReader::readOperand(RecordIndex operand, std::string_view op, const Box3d& around, Bodies& bodies) {
    const auto refuse = [&](std::string_view why) {
        leaveOut(fmt::format("the {} with an {}: {}", op, file_.typeName(operand), why));
        return false;
    };
    switch (file_.entityOf(operand)) {
        case Entity::HalfSpaceSolid:
        case Entity::BoxedHalfSpace:
        case Entity::PolygonalBoundedHalfSpace:
            if (around.isEmpty()) return refuse("there is nothing that it could bound");
            if (!readHalfSpace(operand, around, bodies)) return refuse("it cannot be read");
            break;
        default:
            readItem(operand, bodies);
            if (bodies.empty()) return refuse("it cannot be read");
    }
    if (std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !isClosed(body.faces); }))
        return refuse("it is not closed");
    return true;
}

// Follows results of one kind down to the first operand of the innermost; enters all of them into the scope.
bool ShapeReader::readChain(const Fields& fields, Chain& chain, ReadGuard::Scope& scope) {
    const std::string_view op = fields[at::BooleanResult::Operator].enumeration();
    chain = {file_.follow(fields[at::BooleanResult::FirstOperand]),
             {file_.follow(fields[at::BooleanResult::SecondOperand])}};
    while (op != "INTERSECTION") {
        const Entity entity = file_.entityOf(chain.base);
        if (entity != Entity::BooleanResult && entity != Entity::BooleanClippingResult) break;
        const Fields inner = file_.fieldsOf(chain.base);
        if (inner[at::BooleanResult::Operator].enumeration() != op) break;
        if (!scope.enter(chain.base)) {
            leaveOut(scope.why());
            return false;
        }
        chain.operands.push_back(file_.follow(inner[at::BooleanResult::SecondOperand]));
        chain.base = file_.follow(inner[at::BooleanResult::FirstOperand]);
    }
    return true;
}

// ((a - b) - c) - d is a - (b, c, d), and unions likewise. So a chain of any length, such as some programs write for
// the openings of a wall, is evaluated in one step.
void ShapeReader::readBoolean(const Fields& fields, Bodies& bodies) {
    const std::string_view op = fields[at::BooleanResult::Operator].enumeration();
    ReadGuard::Scope scope(file_.guard());
    Chain chain;
    if (!readChain(fields, chain, scope)) return;
    const std::vector<RecordIndex>& operands = chain.operands;
    Bodies first, second;
    readItem(chain.base, first);
    if (first.empty() && op != "UNION") return;
    if (std::any_of(first.begin(), first.end(), [](const Body& body) { return !isClosed(body.faces); })) {
        leaveOut(fmt::format("the {} with an {}: the body that it is applied to is not closed", op,
                             file_.typeName(operands.back())));
        bodies.insert(bodies.end(), first.begin(), first.end());
        return;
    }
    Box3d around;
    for (const Body& body : first) around.add(boundsOf(body.faces));
    bool isRead = true;
    for (auto operand = operands.rbegin(); operand != operands.rend(); ++operand) {
        Bodies part;
        if (readOperand(*operand, op, around, part))
            second.insert(second.end(), part.begin(), part.end());
        else
            isRead = false;
        // The operand of an outer result is not part of the inner ones.
        scope.leave();
    }
    // An intersection with an empty half-space is empty; a difference with one changes nothing.
    if (second.empty() && (op != "INTERSECTION" || !isRead)) {
        bodies.insert(bodies.end(), first.begin(), first.end());
        return;
    }
    evaluate(op, first, second, bodies);
}

void ShapeReader::evaluate(std::string_view op, const Bodies& first, const Bodies& second, Bodies& bodies) {
    std::vector<Polygons> operands;
    for (const Body& body : second) operands.push_back(body.faces);
    if (op == "UNION") {
        for (const Body& body : first) operands.push_back(body.faces);
        auto joined = evaluateBoolean(BooleanOperator::Union, operands, file_.guard());
        if (!joined) {
            bodies.insert(bodies.end(), second.begin(), second.end());
            bodies.insert(bodies.end(), first.begin(), first.end());
        } else if (!joined->empty()) {
            addBody({std::move(*joined), true, (first.empty() ? second : first).front().material}, bodies);
        }
        return;
    }
    // The second operand as one body.
    if (op == "INTERSECTION" && operands.size() > 1) {
        auto joined = evaluateBoolean(BooleanOperator::Union, operands, file_.guard());
        if (!joined) {
            leaveOut("the INTERSECTION with parts that cannot be joined");
            bodies.insert(bodies.end(), first.begin(), first.end());
            return;
        }
        operands = {std::move(*joined)};
    }
    if (op == "INTERSECTION" && operands.empty()) return;
    for (const Body& body : first) {
        std::vector<Polygons> all{body.faces};
        all.insert(all.end(), operands.begin(), operands.end());
        std::size_t failed = 0;
        auto result = op == "INTERSECTION" ? evaluateBoolean(BooleanOperator::Intersection, all, file_.guard())
                                           : differenceOf(std::move(all), failed);
        if (!result || failed > 0) leaveOut(fmt::format("a {}: its result is not closed", op));
        if (!result) {
            bodies.push_back(body);
        } else if (!result->empty()) {
            addBody({std::move(*result), true, body.material}, bodies);
        }
    }
}

// The first body without the others. If its result is not closed, the others are taken away one after the other.
// \param failed  receives the number of those that are left out
// \return the result, or nothing if all are left out
std::optional<Polygons> ShapeReader::differenceOf(std::vector<Polygons> bodies, std::size_t& failed) {
    if (auto whole = evaluateBoolean(BooleanOperator::Difference, bodies, file_.guard())) return whole;
    failed = 0;
    Polygons rest = std::move(bodies.front());
    bool isCut = false;
    for (std::size_t n = 1; n < bodies.size(); ++n) {
        auto next = bodies.size() == 2 || rest.empty()
                        ? std::nullopt
                        : evaluateBoolean(BooleanOperator::Difference, std::vector{rest, bodies[n]}, file_.guard());
        if (!next) {
            failed += rest.empty() ? 0 : 1;
            continue;
        }
        rest = std::move(*next);
        isCut = true;
    }
    return isCut ? std::optional(std::move(rest)) : std::nullopt;
}

void ShapeReader::subtract(Shape& shape, const Bodies& openings) {
    const auto leave = [&](std::string what) {
        if (std::find(shape.leftOut.begin(), shape.leftOut.end(), what) == shape.leftOut.end())
            shape.leftOut.push_back(std::move(what));
    };
    std::vector<std::pair<Box3d, const Polygons*>> closed;
    for (const Body& opening : openings) {
        if (isClosed(opening.faces))
            closed.emplace_back(boundsOf(opening.faces), &opening.faces);
        else
            leave("an opening whose body is not closed");
    }
    if (closed.empty()) return;
    Bodies result;
    for (Body& body : shape.bodies) {
        if (!file_.guard().takeSteps(10 * closed.size())) return leave(file_.guard().whatIsSpent());
        const Box3d box = boundsOf(body.faces);
        std::vector<Polygons> all{body.faces};
        for (const auto& [around, opening] : closed)
            if (around.overlaps(box)) all.push_back(*opening);
        if (all.size() == 1) {
            result.push_back(std::move(body));
            continue;
        }
        if (!isClosed(body.faces)) {
            leave("openings in a body that is not closed");
            result.push_back(std::move(body));
            continue;
        }
        std::size_t failed = 0;
        auto cut = differenceOf(std::move(all), failed);
        if (failed > 0) leave(fmt::format("{} openings: the body would not be closed with them", failed));
        if (!cut) {
            result.push_back(std::move(body));
        } else if (!cut->empty()) {
            result.push_back({std::move(*cut), true, body.material});
        }
    }
    shape.bodies = std::move(result);
}

}  // namespace svt::readers::ifc
