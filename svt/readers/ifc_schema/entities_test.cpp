#include <svt/readers/ifc_schema/entities.hpp>

#include <gtest/gtest.h>

namespace svt::readers::ifc {
namespace {

std::size_t position(AttributePosition attribute) { return attribute.number; }

// #1=IFCEDGECURVE(start,end,geometry,sense), as the schema has it.
TEST(IfcEntities, AttributesContinueThoseOfTheSupertype) {
    EXPECT_EQ(position(at::Root::GlobalId), 0U);
    EXPECT_EQ(position(at::EdgeCurve::EdgeStart), 0U);
    EXPECT_EQ(position(at::EdgeCurve::SameSense), 3U);
    EXPECT_EQ(position(at::AdvancedFace::FaceSurface), 1U);
    EXPECT_EQ(position(at::Door::OperationType), 11U);
    EXPECT_EQ(position(at::DoorType::OperationType), 10U);
    EXPECT_EQ(position(at::DoorStyle::OperationType), 8U);
    EXPECT_EQ(position(at::RelAssignsToGroup::RelatingGroup), 6U);
    EXPECT_EQ(position(at::RationalBSplineSurfaceWithKnots::WeightsData), 12U);
}

TEST(IfcEntities, TypesAreFoundInAnyCaseAndProductsAreOthers) {
    EXPECT_EQ(entityNamed("IFCPOLYLINE"), Entity::Polyline);
    EXPECT_EQ(entityNamed("IfcGridAxis"), Entity::GridAxis);
    EXPECT_EQ(entityNamed("IFCWALL"), Entity::Other);
    EXPECT_EQ(entityNamed("IFCROOT"), Entity::Other);
    EXPECT_EQ(entityName(Entity::Polyline), "IfcPolyline");
}

}  // namespace
}  // namespace svt::readers::ifc
