#pragma once
/// \file
/// Records of an IFC file by entity and attribute number, lengths in metres. Attributes stand at the same place in IFC2x3,
/// IFC4 and IFC4.3 wherever this reader looks; the few that moved are told apart where they are read.

#include <svt/core/vec.hpp>
#include <svt/readers/ifc_shape/transform.hpp>
#include <svt/readers/step/missing_records.hpp>
#include <svt/readers/step/read_guard.hpp>
#include <svt/readers/step/step_file.hpp>
#include <svt/readers/step/step_value.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace svt::readers::ifc {

using step::kNoRecord;
using step::ReadGuard;
using step::RecordIndex;
using step::Value;

// Entities that the reader knows besides products, as they are named in the schema.
// clang-format off
#define SVT_IFC_ENTITIES(X) \
    X(Project) X(UnitAssignment) X(SIUnit) X(ConversionBasedUnit) X(ConversionBasedUnitWithOffset) \
    X(MeasureWithUnit) X(GeometricRepresentationContext) X(GeometricRepresentationSubContext) X(MapConversion) \
    X(MapConversionScaled) X(RigidOperation) X(ProjectedCRS) X(LocalPlacement) X(GridPlacement) X(LinearPlacement) \
    X(Axis1Placement) X(Axis2Placement2D) X(Axis2Placement3D) X(Axis2PlacementLinear) X(PointByDistanceExpression) X(CartesianPoint) X(Direction) \
    X(Vector) X(CartesianTransformationOperator2D) X(CartesianTransformationOperator2DnonUniform) \
    X(CartesianTransformationOperator3D) X(CartesianTransformationOperator3DnonUniform) X(ProductDefinitionShape) \
    X(ShapeRepresentation) X(TopologyRepresentation) X(RepresentationMap) X(MappedItem) X(StyledItem) \
    X(PresentationStyleAssignment) X(SurfaceStyle) X(SurfaceStyleRendering) X(SurfaceStyleShading) X(ColourRgb) X(ColourRgbList) X(IndexedColourMap) \
    X(MaterialDefinitionRepresentation) X(StyledRepresentation) X(ExtrudedAreaSolid) X(ExtrudedAreaSolidTapered) \
    X(RevolvedAreaSolid) X(FixedReferenceSweptAreaSolid) X(DirectrixDerivedReferenceSweptAreaSolid) \
    X(SurfaceCurveSweptAreaSolid) X(SectionedSolidHorizontal) X(SectionedSpine) X(AnnotationFillArea) X(SweptDiskSolid) X(SweptDiskSolidPolygonal) X(FacetedBrep) X(FacetedBrepWithVoids) \
    X(AdvancedBrep) X(AdvancedBrepWithVoids) X(ClosedShell) X(OpenShell) X(ConnectedFaceSet) \
    X(FaceBasedSurfaceModel) X(ShellBasedSurfaceModel) X(Face) X(FaceSurface) X(AdvancedFace) X(FaceBound) \
    X(FaceOuterBound) X(PolyLoop) X(EdgeLoop) X(OrientedEdge) X(EdgeCurve) X(Edge) X(VertexPoint) X(Plane) \
    X(CylindricalSurface) X(ConicalSurface) X(SphericalSurface) X(ToroidalSurface) X(BSplineSurfaceWithKnots) \
    X(RationalBSplineSurfaceWithKnots) X(SurfaceOfLinearExtrusion) X(SurfaceOfRevolution) X(TriangulatedFaceSet) \
    X(TriangulatedIrregularNetwork) X(PolygonalFaceSet) X(IndexedPolygonalFace) X(IndexedPolygonalFaceWithVoids) \
    X(CartesianPointList2D) X(CartesianPointList3D) X(BooleanResult) X(BooleanClippingResult) X(HalfSpaceSolid) \
    X(BoxedHalfSpace) X(PolygonalBoundedHalfSpace) X(CsgSolid) X(Block) X(RectangularPyramid) X(RightCircularCone) \
    X(RightCircularCylinder) X(Sphere) X(BoundingBox) X(GeometricSet) X(GeometricCurveSet) X(CurveBoundedPlane) \
    X(RectangleProfileDef) X(RoundedRectangleProfileDef) X(RectangleHollowProfileDef) X(CircleProfileDef) \
    X(CircleHollowProfileDef) X(EllipseProfileDef) X(IShapeProfileDef) X(AsymmetricIShapeProfileDef) \
    X(LShapeProfileDef) X(TShapeProfileDef) X(UShapeProfileDef) X(CShapeProfileDef) X(ZShapeProfileDef) \
    X(TrapeziumProfileDef) X(ArbitraryClosedProfileDef) X(ArbitraryProfileDefWithVoids) X(ArbitraryOpenProfileDef) \
    X(CenterLineProfileDef) X(CompositeProfileDef) X(DerivedProfileDef) X(MirroredProfileDef) X(Polyline) \
    X(CompositeCurve) X(CompositeCurveOnSurface) X(CompositeCurveSegment) X(ReparametrisedCompositeCurveSegment) \
    X(TrimmedCurve) X(Circle) X(Ellipse) X(Line) X(IndexedPolyCurve) X(BSplineCurveWithKnots) \
    X(RationalBSplineCurveWithKnots) X(BezierCurve) X(SurfaceCurve) X(SeamCurve) X(IntersectionCurve) X(PropertySet) \
    X(PropertySingleValue) X(PropertyEnumeratedValue) X(PropertyListValue) X(PropertyBoundedValue) X(ComplexProperty) X(PropertyTableValue) \
    X(ElementQuantity) X(QuantityLength) X(QuantityArea) X(QuantityVolume) X(QuantityCount) X(QuantityWeight) \
    X(QuantityTime) X(RelAggregates) X(RelNests) X(RelContainedInSpatialStructure) X(RelVoidsElement) \
    X(RelFillsElement) X(RelProjectsElement) X(RelDefinesByProperties) X(RelDefinesByType) X(RelAssociatesMaterial) \
    X(RelAssociatesClassification) X(RelAssignsToGroup) X(RelReferencedInSpatialStructure) X(Material) \
    X(MaterialList) X(MaterialLayer) X(MaterialLayerWithOffsets) X(MaterialLayerSet) X(MaterialLayerSetUsage) \
    X(MaterialConstituent) X(MaterialConstituentSet) X(MaterialProfile) X(MaterialProfileSet) \
    X(MaterialProfileSetUsage) X(ClassificationReference) X(Classification) X(System) X(DistributionSystem) \
    X(BuildingSystem) X(Group) X(Zone) X(PresentationLayerAssignment) X(PresentationLayerWithStyle) \
    X(VirtualGridIntersection) X(GridAxis)
// clang-format on

enum class Entity : std::uint16_t {
    Other,  ///< none of these: a product, or something that is not read
#define X(name) name,
    SVT_IFC_ENTITIES(X)
#undef X
};

/// Number of reasons kept for parts of a product that are left out; the finding names a few of them.
inline constexpr std::size_t kMaxLeftOut = 1000;

/// "IfcPolyline"
[[nodiscard]] std::string_view entityName(Entity entity) noexcept;

/// The attributes of one record by number, beginning with 0. Those beyond the 24th are left out.
class Fields {
public:
    explicit Fields(std::string_view values) noexcept;
    /// Nothing where the record has no such attribute.
    [[nodiscard]] Value operator[](std::size_t number) const noexcept {
        return number < count_ ? values_[number] : Value();
    }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

private:
    std::array<Value, 24> values_;
    std::size_t count_ = 0;
};

class IfcFile {
public:
    explicit IfcFile(const step::StepFile& file);

    [[nodiscard]] const step::StepFile& step() const noexcept { return step_; }
    [[nodiscard]] Entity entityOf(RecordIndex record) const noexcept {
        return record == kNoRecord ? Entity::Other : entityOfType_[step_.records()[record].type];
    }
    /// None once the budget of guard() is spent: this is where the steps of reading are counted.
    [[nodiscard]] Fields fieldsOf(RecordIndex record) const noexcept {
        if (record == kNoRecord || !guard_.takeSteps(kStepsPerRecord + step_.records()[record].size))
            return Fields(std::string_view());
        return Fields(step_.valuesOf(step_.records()[record]));
    }
    /// Bounds what is read of the file: every function that follows references from record to record asks it.
    [[nodiscard]] ReadGuard& guard() const noexcept { return guard_; }
    /// Type name as the file has it, such as IFCPOLYLINE; empty for kNoRecord.
    [[nodiscard]] std::string_view typeName(RecordIndex record) const noexcept {
        return record == kNoRecord ? std::string_view() : step_.typeName(step_.records()[record]);
    }
    /// The record that a value refers to; kNoRecord where there is none. A reference to a record that the file lacks is
    /// noted in missing(), by this and all that follow references.
    [[nodiscard]] RecordIndex follow(Value reference) const;
    /// The records that a list refers to, those that are there.
    [[nodiscard]] std::vector<RecordIndex> followAll(Value list) const;
    /// References followed so far that lead nowhere.
    [[nodiscard]] step::MissingRecords& missing() const noexcept { return missing_; }
    /// Records of an entity in the order of the file.
    [[nodiscard]] std::vector<RecordIndex> all(Entity entity) const;

    // Geometry in metres. Two-dimensional things have z = 0.
    [[nodiscard]] double metres(Value length, double otherwise = 0) const noexcept;
    [[nodiscard]] double radians(Value angle, double otherwise = 0) const noexcept;
    [[nodiscard]] std::optional<Vec3d> point(RecordIndex record) const noexcept;  ///< IfcCartesianPoint
    [[nodiscard]] std::optional<Vec3d> coordinates(Value list) const noexcept;    ///< (1.,2.,3.), in metres
    [[nodiscard]] std::optional<Vec3d> direction(Value reference) const;          ///< IfcDirection, as it is
    /// IfcAxis2Placement2D or 3D, IfcAxis1Placement (z is the axis); identity for anything else.
    [[nodiscard]] Transform axes(RecordIndex record) const;
    /// IfcCartesianTransformationOperator...
    [[nodiscard]] Transform transformation(RecordIndex record) const;
    /// IfcLocalPlacement, IfcGridPlacement (on straight axes) or IfcLinearPlacement (by its distance along a curve that
    /// readCurve() knows, else by its Cartesian position) and those above it, in the world of the project.
    /// \param lost  set to what of the way up could not be read, in words; unchanged if all was. There the placement is
    ///              that of the levels that could: a circle ends it
    [[nodiscard]] Transform placement(RecordIndex record, std::string& lost) const;

    /// IfcAxis2PlacementLinear at a distance along a curve that readCurve() knows: x along it, y to its left.
    [[nodiscard]] std::optional<Transform> linearAxes(RecordIndex relative) const;

    double lengthUnit = 1;  ///< metres
    double angleUnit = 1;   ///< radians

private:
    static constexpr std::uint64_t kStepsPerRecord = 64;

    [[nodiscard]] std::optional<Transform> gridAxes(RecordIndex placement, RecordIndex& above) const;
    bool readGridAxis(RecordIndex axis, double offset, Vec3d& from, Vec3d& along) const;

    const step::StepFile& step_;
    // Of what was read of a file, not of what it is.
    mutable step::MissingRecords missing_;
    mutable ReadGuard guard_;
    std::vector<Entity> entityOfType_;
    std::unordered_map<RecordIndex, RecordIndex> placementOfAxis_;  // grid axis -> placement of its grid
};

}  // namespace svt::readers::ifc
