#pragma once
/// \file
/// Entities of IFC and positions of their attributes: one table, in the words and the order of the EXPRESS schema.
///
///     E(SweptAreaSolid, None, SweptArea, Position)                     #7=IFCEXTRUDEDAREASOLID(#1,#2,#3,2.5);
///     E(ExtrudedAreaSolid, SweptAreaSolid, ExtrudedDirection, Depth)   at::ExtrudedAreaSolid::Depth is 3: 2.5
///
/// As in the schema, an entity continues its supertype. Attributes behind the last one that is read are absent.
/// IFC2x3, IFC4 and IFC4.3 agree on these positions; rows named ...OfIfc4 give those that IFC4.3 moved.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace svt::readers::ifc {

// clang-format off
// Rows with attributes only: supertypes, products (which product_classes.hpp lists), types, and earlier orders.
#define SVT_IFC_SUPERTYPES(E) \
    E(Root, None, GlobalId, OwnerHistory, Name, Description) E(Object, Root, ObjectType) \
    E(Product, Object, ObjectPlacement, Representation) E(SpatialElement, Product, LongName) \
    E(SpatialZone, SpatialElement, PredefinedType) E(SpatialStructureElement, SpatialElement, CompositionType) \
    E(Space, SpatialStructureElement, PredefinedType) \
    E(Site, SpatialStructureElement, RefLatitude, RefLongitude, RefElevation, LandTitleNumber, SiteAddress) \
    E(Building, SpatialStructureElement, ElevationOfRefHeight, ElevationOfTerrain, BuildingAddress) \
    E(PostalAddress, None, Purpose, Description, UserDefinedPurpose, InternalLocation, AddressLines, PostalBox, Town, \
      Region, PostalCode, Country) \
    E(BuildingStorey, SpatialStructureElement, Elevation) E(Annotation, Product, PredefinedType) \
    E(Grid, Product, UAxes, VAxes, WAxes, PredefinedType) \
    E(Element, Product, Tag) E(Wall, Element, PredefinedType) \
    E(Door, Element, OverallHeight, OverallWidth, PredefinedType, OperationType) \
    E(Window, Element, OverallHeight, OverallWidth, PredefinedType) \
    E(StairFlight, Element, NumberOfRisers, NumberOfTreads, RiserHeight, TreadLength, PredefinedType) \
    E(ElementAssembly, Element, AssemblyPlace, PredefinedType) E(ReinforcingElement, Element, SteelGrade) \
    E(ReinforcingBar, ReinforcingElement, NominalDiameter, CrossSectionArea, BarLength, PredefinedType) \
    E(ReinforcingMesh, ReinforcingElement, MeshLength, MeshWidth, LongitudinalBarNominalDiameter, \
      TransverseBarNominalDiameter, LongitudinalBarCrossSectionArea, TransverseBarCrossSectionArea, \
      LongitudinalBarSpacing, TransverseBarSpacing, PredefinedType) \
    E(Tendon, ReinforcingElement, PredefinedType) \
    E(MechanicalFastener, Element, NominalDiameter, NominalLength, PredefinedType) \
    E(TypeObject, Root, ApplicableOccurrence, HasPropertySets) E(TypeProduct, TypeObject, RepresentationMaps, Tag) \
    E(DoorType, TypeProduct, ElementType, PredefinedType, OperationType) E(DoorStyle, TypeProduct, OperationType) \
    E(RelDefines, Root, RelatedObjects) E(RelAssociates, Root, RelatedObjects) \
    E(RelDecomposes, Root, RelatingObject, RelatedObjects) \
    E(NamedUnit, None, Dimensions, UnitType) E(CoordinateOperation, None, SourceCRS, TargetCRS) \
    E(ObjectPlacement, None, PlacementRelTo) E(GridPlacementOfIfc4, None, PlacementLocation, PlacementRefDirection) \
    E(LinearPlacementOfIfc4x1, None, PlacementRelTo, Distance, Orientation, CartesianPosition) \
    E(Placement, None, Location) E(CartesianTransformationOperator, None, Axis1, Axis2, LocalOrigin, Scale) \
    E(ProductRepresentation, None, Name, Description, Representations) \
    E(Representation, None, ContextOfItems, RepresentationIdentifier, RepresentationType, Items) \
    E(SweptAreaSolid, None, SweptArea, Position) \
    E(DirectrixCurveSweptAreaSolid, SweptAreaSolid, Directrix, StartParam, EndParam) \
    E(ManifoldSolidBrep, None, Outer) E(ElementarySurface, None, Position) E(SweptSurface, None, SweptCurve, Position) \
    E(BSplineSurface, None, UDegree, VDegree, ControlPointsList, SurfaceForm, UClosed, VClosed, SelfIntersect) \
    E(BSplineCurve, None, Degree, ControlPointsList, CurveForm, ClosedCurve, SelfIntersect) \
    E(TessellatedFaceSet, None, Coordinates, Closed) \
    E(TriangulatedFaceSetOfIfc4, None, Coordinates, Normals, Closed, CoordIndex) \
    E(CartesianPointList, None, CoordList) E(CsgPrimitive3D, None, Position) \
    E(ProfileDef, None, ProfileType, ProfileName) \
    E(ParameterizedProfileDef, ProfileDef, Position) E(Conic, None, Position) \
    E(Property, None, Name, Description) E(PhysicalSimpleQuantity, None, Name, Description, Unit) \
    E(SurfaceStyleWithTextures, None, Textures) \
    E(SurfaceTexture, None, RepeatS, RepeatT, Mode, TextureTransform, Parameter) \
    E(ImageTexture, SurfaceTexture, URLReference) E(BlobTexture, SurfaceTexture, RasterFormat, RasterCode) \
    E(PixelTexture, SurfaceTexture, Width, Height, ColourComponents, Pixel) \
    E(SurfaceTextureOfIfc2x3, None, RepeatS, RepeatT, TextureType, TextureTransform) \
    E(ImageTextureOfIfc2x3, SurfaceTextureOfIfc2x3, UrlReference) \
    E(BlobTextureOfIfc2x3, SurfaceTextureOfIfc2x3, RasterFormat, RasterCode) \
    E(PixelTextureOfIfc2x3, SurfaceTextureOfIfc2x3, Width, Height, ColourComponents, Pixel) \
    E(TextureCoordinate, None, Maps) E(TextureMap, TextureCoordinate, Vertices, MappedTo) \
    E(IndexedTextureMap, TextureCoordinate, MappedTo, TexCoords) \
    E(IndexedTriangleTextureMap, IndexedTextureMap, TexCoordIndex) \
    E(IndexedPolygonalTextureMap, IndexedTextureMap, TexCoordIndices) \
    E(TextureCoordinateIndices, None, TexCoordIndex, TexCoordsOf) E(TextureVertexList, None, TexCoordsList) \
    E(TextureVertex, None, Coordinates)

// Entities that the reader distinguishes.
#define SVT_IFC_ENTITIES(E) \
    E(Project, Object, LongName, Phase, RepresentationContexts, UnitsInContext) E(UnitAssignment, None, Units) \
    E(SIUnit, NamedUnit, Prefix, Name) E(ConversionBasedUnit, NamedUnit, Name, ConversionFactor) \
    E(ConversionBasedUnitWithOffset, ConversionBasedUnit) E(MeasureWithUnit, None, ValueComponent, UnitComponent) \
    E(GeometricRepresentationContext, None, ContextIdentifier, ContextType, CoordinateSpaceDimension, Precision, \
      WorldCoordinateSystem, TrueNorth) \
    E(GeometricRepresentationSubContext, GeometricRepresentationContext) \
    E(MapConversion, CoordinateOperation, Eastings, Northings, OrthogonalHeight, XAxisAbscissa, XAxisOrdinate, Scale) \
    E(MapConversionScaled, MapConversion) \
    E(RigidOperation, CoordinateOperation, FirstCoordinate, SecondCoordinate, Height) \
    E(ProjectedCRS, None, Name, Description, GeodeticDatum, VerticalDatum, MapProjection, MapZone, MapUnit) \
    E(LocalPlacement, ObjectPlacement, RelativePlacement) \
    E(GridPlacement, ObjectPlacement, PlacementLocation, PlacementRefDirection) \
    E(LinearPlacement, ObjectPlacement, RelativePlacement, CartesianPosition) E(Axis1Placement, Placement, Axis) \
    E(Axis2Placement2D, Placement, RefDirection) E(Axis2Placement3D, Placement, Axis, RefDirection) \
    E(Axis2PlacementLinear, Placement, Axis, RefDirection) \
    E(PointByDistanceExpression, None, DistanceAlong, OffsetLateral, OffsetVertical, OffsetLongitudinal, BasisCurve) \
    E(CartesianPoint, None, Coordinates) E(Direction, None, DirectionRatios) E(Vector, None, Orientation, Magnitude) \
    E(CartesianTransformationOperator2D, CartesianTransformationOperator) \
    E(CartesianTransformationOperator2DnonUniform, CartesianTransformationOperator2D, Scale2) \
    E(CartesianTransformationOperator3D, CartesianTransformationOperator, Axis3) \
    E(CartesianTransformationOperator3DnonUniform, CartesianTransformationOperator3D, Scale2, Scale3) \
    E(ProductDefinitionShape, ProductRepresentation) E(ShapeRepresentation, Representation) \
    E(TopologyRepresentation, Representation) E(StyledRepresentation, Representation) \
    E(RepresentationMap, None, MappingOrigin, MappedRepresentation) E(MappedItem, None, MappingSource, MappingTarget) \
    E(StyledItem, None, Item, Styles) E(PresentationStyleAssignment, None, Styles) \
    E(SurfaceStyle, None, Name, Side, Styles) E(SurfaceStyleShading, None, SurfaceColour, Transparency) \
    E(SurfaceStyleRendering, SurfaceStyleShading) E(ColourRgb, None, Name, Red, Green, Blue) \
    E(ColourRgbList, None, ColourList) E(IndexedColourMap, None, MappedTo, Opacity, Colours, ColourIndex) \
    E(MaterialDefinitionRepresentation, ProductRepresentation, RepresentedMaterial) \
    E(ExtrudedAreaSolid, SweptAreaSolid, ExtrudedDirection, Depth) \
    E(ExtrudedAreaSolidTapered, ExtrudedAreaSolid, EndSweptArea) E(RevolvedAreaSolid, SweptAreaSolid, Axis, Angle) \
    E(FixedReferenceSweptAreaSolid, DirectrixCurveSweptAreaSolid, FixedReference) \
    E(DirectrixDerivedReferenceSweptAreaSolid, FixedReferenceSweptAreaSolid) \
    E(SurfaceCurveSweptAreaSolid, DirectrixCurveSweptAreaSolid, ReferenceSurface) \
    E(SectionedSolidHorizontal, None, Directrix, CrossSections, CrossSectionPositions, FixedAxisVertical) \
    E(SectionedSpine, None, SpineCurve, CrossSections, CrossSectionPositions) \
    E(AnnotationFillArea, None, OuterBoundary, InnerBoundaries) \
    E(SweptDiskSolid, None, Directrix, Radius, InnerRadius, StartParam, EndParam) \
    E(SweptDiskSolidPolygonal, SweptDiskSolid) E(FacetedBrep, ManifoldSolidBrep) \
    E(FacetedBrepWithVoids, FacetedBrep, Voids) E(AdvancedBrep, ManifoldSolidBrep) \
    E(AdvancedBrepWithVoids, AdvancedBrep, Voids) E(ConnectedFaceSet, None, CfsFaces) \
    E(ClosedShell, ConnectedFaceSet) E(OpenShell, ConnectedFaceSet) E(FaceBasedSurfaceModel, None, FbsmFaces) \
    E(ShellBasedSurfaceModel, None, SbsmBoundary) E(Face, None, Bounds) E(FaceSurface, Face, FaceSurface, SameSense) \
    E(AdvancedFace, FaceSurface) E(FaceBound, None, Bound, Orientation) E(FaceOuterBound, FaceBound) \
    E(PolyLoop, None, Polygon) E(EdgeLoop, None, EdgeList) E(Edge, None, EdgeStart, EdgeEnd) \
    E(OrientedEdge, Edge, EdgeElement, Orientation) E(EdgeCurve, Edge, EdgeGeometry, SameSense) \
    E(VertexPoint, None, VertexGeometry) E(Plane, ElementarySurface) E(CylindricalSurface, ElementarySurface, Radius) \
    E(ConicalSurface, ElementarySurface, Radius, SemiAngle) E(SphericalSurface, ElementarySurface, Radius) \
    E(ToroidalSurface, ElementarySurface, MajorRadius, MinorRadius) \
    E(BSplineSurfaceWithKnots, BSplineSurface, UMultiplicities, VMultiplicities, UKnots, VKnots, KnotSpec) \
    E(RationalBSplineSurfaceWithKnots, BSplineSurfaceWithKnots, WeightsData) \
    E(SurfaceOfLinearExtrusion, SweptSurface, ExtrudedDirection) E(SurfaceOfRevolution, SweptSurface, AxisPosition) \
    E(TriangulatedFaceSet, TessellatedFaceSet, Normals, CoordIndex) \
    E(TriangulatedIrregularNetwork, TriangulatedFaceSet) E(PolygonalFaceSet, TessellatedFaceSet, Faces) \
    E(IndexedPolygonalFace, None, CoordIndex) \
    E(IndexedPolygonalFaceWithVoids, IndexedPolygonalFace, InnerCoordIndices) \
    E(CartesianPointList2D, CartesianPointList) E(CartesianPointList3D, CartesianPointList) \
    E(BooleanResult, None, Operator, FirstOperand, SecondOperand) E(BooleanClippingResult, BooleanResult) \
    E(HalfSpaceSolid, None, BaseSurface, AgreementFlag) E(BoxedHalfSpace, HalfSpaceSolid) \
    E(PolygonalBoundedHalfSpace, HalfSpaceSolid, Position, PolygonalBoundary) E(CsgSolid, None, TreeRootExpression) \
    E(Block, CsgPrimitive3D, XLength, YLength, ZLength) \
    E(RectangularPyramid, CsgPrimitive3D, XLength, YLength, Height) \
    E(RightCircularCone, CsgPrimitive3D, Height, BottomRadius) \
    E(RightCircularCylinder, CsgPrimitive3D, Height, Radius) \
    E(Sphere, CsgPrimitive3D, Radius) E(BoundingBox, None, Corner, XDim, YDim, ZDim) E(GeometricSet, None, Elements) \
    E(GeometricCurveSet, GeometricSet) E(CurveBoundedPlane, None) \
    E(RectangleProfileDef, ParameterizedProfileDef, XDim, YDim) \
    E(RoundedRectangleProfileDef, RectangleProfileDef, RoundingRadius) \
    E(RectangleHollowProfileDef, RectangleProfileDef, WallThickness, InnerFilletRadius, OuterFilletRadius) \
    E(CircleProfileDef, ParameterizedProfileDef, Radius) E(CircleHollowProfileDef, CircleProfileDef, WallThickness) \
    E(EllipseProfileDef, ParameterizedProfileDef, SemiAxis1, SemiAxis2) \
    E(IShapeProfileDef, ParameterizedProfileDef, OverallWidth, OverallDepth, WebThickness, FlangeThickness, \
      FilletRadius, FlangeEdgeRadius, FlangeSlope) \
    E(AsymmetricIShapeProfileDef, ParameterizedProfileDef, BottomFlangeWidth, OverallDepth, WebThickness, \
      BottomFlangeThickness, BottomFlangeFilletRadius, TopFlangeWidth, TopFlangeThickness, TopFlangeFilletRadius) \
    E(LShapeProfileDef, ParameterizedProfileDef, Depth, Width, Thickness, FilletRadius, EdgeRadius, LegSlope) \
    E(TShapeProfileDef, ParameterizedProfileDef, Depth, FlangeWidth, WebThickness, FlangeThickness, FilletRadius, \
      FlangeEdgeRadius, WebEdgeRadius, WebSlope, FlangeSlope) \
    E(UShapeProfileDef, ParameterizedProfileDef, Depth, FlangeWidth, WebThickness, FlangeThickness, FilletRadius, \
      EdgeRadius, FlangeSlope) \
    E(CShapeProfileDef, ParameterizedProfileDef, Depth, Width, WallThickness, Girth, InternalFilletRadius) \
    E(ZShapeProfileDef, ParameterizedProfileDef, Depth, FlangeWidth, WebThickness, FlangeThickness, FilletRadius, \
      EdgeRadius) \
    E(TrapeziumProfileDef, ParameterizedProfileDef, BottomXDim, TopXDim, YDim, TopXOffset) \
    E(ArbitraryClosedProfileDef, ProfileDef, OuterCurve) \
    E(ArbitraryProfileDefWithVoids, ArbitraryClosedProfileDef, InnerCurves) \
    E(ArbitraryOpenProfileDef, ProfileDef, Curve) E(CenterLineProfileDef, ArbitraryOpenProfileDef, Thickness) \
    E(CompositeProfileDef, ProfileDef, Profiles) E(DerivedProfileDef, ProfileDef, ParentProfile, Operator) \
    E(MirroredProfileDef, DerivedProfileDef) E(Polyline, None, Points) E(CompositeCurve, None, Segments) \
    E(CompositeCurveOnSurface, CompositeCurve) E(GradientCurve, CompositeCurve, SelfIntersect, BaseCurve) \
    E(SegmentedReferenceCurve, GradientCurve) \
    E(CurveSegment, None, Transition, Placement, SegmentStart, SegmentLength, ParentCurve) \
    E(Clothoid, Conic, ClothoidConstant) E(CosineSpiral, Conic, CosineTerm, ConstantTerm) \
    E(SineSpiral, Conic, SineTerm, LinearTerm, ConstantTerm) \
    E(SecondOrderPolynomialSpiral, Conic, QuadraticTerm, LinearTerm, ConstantTerm) \
    E(ThirdOrderPolynomialSpiral, Conic, CubicTerm, QuadraticTerm, LinearTerm, ConstantTerm) \
    E(SeventhOrderPolynomialSpiral, Conic, SepticTerm, SexticTerm, QuinticTerm, QuarticTerm, CubicTerm, QuadraticTerm, \
      LinearTerm, ConstantTerm) \
    E(CompositeCurveSegment, None, Transition, SameSense, ParentCurve) \
    E(ReparametrisedCompositeCurveSegment, CompositeCurveSegment) \
    E(TrimmedCurve, None, BasisCurve, Trim1, Trim2, SenseAgreement, MasterRepresentation) E(Circle, Conic, Radius) \
    E(Ellipse, Conic, SemiAxis1, SemiAxis2) E(Line, None, Pnt, Dir) E(IndexedPolyCurve, None, Points, Segments) \
    E(BSplineCurveWithKnots, BSplineCurve, KnotMultiplicities, Knots, KnotSpec) \
    E(RationalBSplineCurveWithKnots, BSplineCurveWithKnots, WeightsData) E(BezierCurve, BSplineCurve) \
    E(SurfaceCurve, None, Curve3D) E(SeamCurve, SurfaceCurve) E(IntersectionCurve, SurfaceCurve) \
    E(PropertySet, Root, HasProperties) E(DoorLiningProperties, Root, LiningDepth, LiningThickness) \
    E(PropertySingleValue, Property, NominalValue, Unit) \
    E(PropertyEnumeratedValue, Property, EnumerationValues) E(PropertyListValue, Property, ListValues) \
    E(PropertyBoundedValue, Property, UpperBoundValue, LowerBoundValue) \
    E(ComplexProperty, Property, UsageName, HasProperties) \
    E(PropertyTableValue, Property, DefiningValues, DefinedValues) \
    E(ElementQuantity, Root, MethodOfMeasurement, Quantities) E(QuantityLength, PhysicalSimpleQuantity, LengthValue) \
    E(QuantityArea, PhysicalSimpleQuantity, AreaValue) E(QuantityVolume, PhysicalSimpleQuantity, VolumeValue) \
    E(QuantityCount, PhysicalSimpleQuantity, CountValue) E(QuantityWeight, PhysicalSimpleQuantity, WeightValue) \
    E(QuantityTime, PhysicalSimpleQuantity, TimeValue) E(RelAggregates, RelDecomposes) E(RelNests, RelDecomposes) \
    E(RelContainedInSpatialStructure, Root, RelatedElements, RelatingStructure) \
    E(RelReferencedInSpatialStructure, RelContainedInSpatialStructure) \
    E(RelVoidsElement, Root, RelatingBuildingElement, RelatedOpeningElement) \
    E(RelFillsElement, Root, RelatingOpeningElement, RelatedBuildingElement) \
    E(RelProjectsElement, Root, RelatingElement, RelatedFeatureElement) \
    E(RelDefinesByProperties, RelDefines, RelatingPropertyDefinition) E(RelDefinesByType, RelDefines, RelatingType) \
    E(RelAssociatesMaterial, RelAssociates, RelatingMaterial) \
    E(RelAssociatesClassification, RelAssociates, RelatingClassification) \
    E(RelAssignsToGroup, Root, RelatedObjects, RelatedObjectsType, RelatingGroup) \
    E(Material, None, Name, Description, Category) E(MaterialList, None, Materials) \
    E(MaterialLayer, None, Material, LayerThickness, IsVentilated, Name, Description, Category) \
    E(MaterialLayerWithOffsets, MaterialLayer) E(MaterialLayerSet, None, MaterialLayers) \
    E(MaterialLayerSetUsage, None, ForLayerSet, LayerSetDirection, DirectionSense, OffsetFromReferenceLine) \
    E(ShapeAspect, None, ShapeRepresentations, Name) \
    E(MaterialConstituent, None, Name, Description, Material) \
    E(MaterialConstituentSet, None, Name, Description, MaterialConstituents) \
    E(MaterialProfile, None, Name, Description, Material) \
    E(MaterialProfileSet, None, Name, Description, MaterialProfiles) E(MaterialProfileSetUsage, None, ForProfileSet) \
    E(ClassificationReference, None, Location, Identification, Name) E(Classification, None) E(System, Object) \
    E(DistributionSystem, Object) E(BuildingSystem, Object) E(Group, Object) E(Zone, Object) \
    E(PresentationLayerAssignment, None, Name, Description, AssignedItems) \
    E(PresentationLayerWithStyle, PresentationLayerAssignment) \
    E(VirtualGridIntersection, None, IntersectingAxes, OffsetDistances) E(GridAxis, None, AxisTag, AxisCurve, SameSense)
// clang-format on

enum class Entity : std::uint16_t {
    Other,  ///< none of these: a product, or something that is not read
#define E(name, ...) name,
    SVT_IFC_ENTITIES(E)
#undef E
};

/// Positions of attributes, beginning with 0: at::ExtrudedAreaSolid::Depth.
namespace at {
namespace None {
enum Attribute : int { kCount };
}
#define E(name, supertype, ...)                                                                      \
    namespace name {                                                                                 \
    using namespace at::supertype;                                                                   \
    enum Attribute : int { kBefore = at::supertype::kCount - 1 __VA_OPT__(, ) __VA_ARGS__, kCount }; \
    }
SVT_IFC_SUPERTYPES(E)
SVT_IFC_ENTITIES(E)
#undef E
}  // namespace at

/// The position of an attribute: a name of `at`, never a bare number.
struct AttributePosition {
    template <class Attribute>
    requires std::is_enum_v<Attribute> && std::is_convertible_v<Attribute, int>  // no enum class, such as Entity
    constexpr AttributePosition(Attribute attribute) noexcept : number(static_cast<std::size_t>(attribute)) {}
    std::size_t number;
};

/// "IfcPolyline"
[[nodiscard]] std::string_view entityName(Entity entity) noexcept;
/// The entity of a type name of a STEP file, whatever its case.
[[nodiscard]] Entity entityNamed(std::string_view typeName) noexcept;

}  // namespace svt::readers::ifc
