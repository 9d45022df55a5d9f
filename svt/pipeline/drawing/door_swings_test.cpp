/// Doors in plans: from the operation and placement in an IFC file to leaves and arcs.

#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>
#include <svt/volume/svt_file.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace svt::pipeline {
namespace {

using drawing::DoorSwing;

volume::SemanticVolume volumeOf(model::BuildingModel model) {
    BuildOptions options;
    options.vectors.meshes = true;
    options.spacing = Vec3d{0.1, 0.1, 0.1};
    return std::move(buildVolume(model, options)->volume);
}

std::string houseWith(const std::string& operation) {
    std::string text = *samples::writeSample(samples::SampleKind::House, samples::SampleFormat::Ifc4, {});
    const std::string known = "SINGLE_SWING_LEFT";
    for (std::size_t at = text.find(known); at != std::string::npos; at = text.find(known, at + operation.size()))
        text.replace(at, known.size(), operation);
    return text;
}

volume::SemanticVolume houseVolume(const std::string& operation = "SINGLE_SWING_LEFT") {
    const std::string text = houseWith(operation);
    return volumeOf(*readers::readModel(std::as_bytes(std::span(text)), "house.ifc"));
}

drawing::SectionDrawing planOf(const volume::SemanticVolume& volume) {
    return *drawing::drawSection(volume, *drawing::parseSectionPlane("z=abs(101.1)", volume));
}

const DoorSwing* doorOf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                        const std::string& name) {
    for (const DoorSwing& door : drawing.doors)
        if (volume.labels.labels[door.label].name == name) return &door;
    return nullptr;
}

TEST(DoorSwings, OfTheHouseOpenToTheSideOfTheirLeaf) {
    const auto volume = houseVolume();
    const auto drawing = planOf(volume);
    EXPECT_EQ(drawing.doors.size(), 6u);
    // The entrance is 1.11 m wide, 4.60 to 5.71 m from the west in the northern wall (y = 9), and opens to the north. Hinges
    // are left as one looks north: in the west.
    const DoorSwing* const entrance = doorOf(drawing, volume, "Entrance door");
    ASSERT_NE(entrance, nullptr);
    ASSERT_EQ(entrance->arcs.size(), 1u);
    ASSERT_EQ(entrance->lines.size(), 1u);
    const auto world = [&](drawing::PlanePoint p) {
        return drawing.axes.worldFromPlane(p) - Vec3d{500000, 5400000, 0};
    };
    const Vec3d hinge = world(entrance->arcs[0].center), closed = world(entrance->arcs[0].from),
                open = world(entrance->arcs[0].to);
    EXPECT_NEAR(hinge.x, 4.60, 1e-3);
    EXPECT_NEAR(hinge.y, 9, 1e-3);
    EXPECT_NEAR(closed.x, 5.71, 1e-3);
    EXPECT_NEAR(closed.y, 9, 1e-3);
    EXPECT_NEAR(open.x, 4.60, 1e-3);
    EXPECT_NEAR(open.y, 10.11, 1e-3);
    EXPECT_NEAR(world(entrance->lines[0].back()).y, 10.11, 1e-3);
    // Counter-clockwise, on a circle.
    const auto points = drawing::pointsOf(entrance->arcs[0]);
    EXPECT_EQ(points.size(), 13u);
    for (const drawing::PlanePoint p : points)
        EXPECT_NEAR(std::hypot(p.u - entrance->arcs[0].center.u, p.v - entrance->arcs[0].center.v), 1.11, 1e-3);
}

TEST(DoorSwings, AreThoseOfTheOperation) {
    // Leaves and arcs of the entrance; whether the first leaf hangs in the west, and opens to the north.
    struct Case {
        const char* operation;
        std::size_t lines, arcs;
        bool isWest, isNorth;
    };
    for (const Case& wanted :
         {Case{"SINGLE_SWING_RIGHT", 1, 1, false, true}, Case{"DOUBLE_SWING_LEFT", 2, 2, true, true},
          Case{"DOUBLE_DOOR_SINGLE_SWING", 2, 2, true, true}, Case{"DOUBLE_PANEL_SINGLE_SWING", 2, 2, true, true},
          Case{"DOUBLE_DOOR_DOUBLE_SWING", 4, 4, true, true},
          Case{"DOUBLE_DOOR_SINGLE_SWING_OPPOSITE_LEFT", 2, 2, true, true},
          Case{"DOUBLE_DOOR_SINGLE_SWING_OPPOSITE_RIGHT", 2, 2, true, false},
          Case{"SWING_FIXED_RIGHT", 1, 1, false, true}}) {
        const auto volume = houseVolume(wanted.operation);
        const auto drawing = planOf(volume);
        const DoorSwing* const door = doorOf(drawing, volume, "Entrance door");
        ASSERT_NE(door, nullptr) << wanted.operation;
        EXPECT_EQ(door->lines.size(), wanted.lines) << wanted.operation;
        ASSERT_EQ(door->arcs.size(), wanted.arcs) << wanted.operation;
        const Vec3d hinge = drawing.axes.worldFromPlane(door->lines[0].front()),
                    open = drawing.axes.worldFromPlane(door->lines[0].back());
        EXPECT_EQ(hinge.x < 500005, wanted.isWest) << wanted.operation;
        EXPECT_EQ(open.y > hinge.y, wanted.isNorth) << wanted.operation;
        for (const DoorSwing::Arc& arc : door->arcs) {
            const double turn = (arc.from.u - arc.center.u) * (arc.to.v - arc.center.v) -
                                (arc.from.v - arc.center.v) * (arc.to.u - arc.center.u);
            EXPECT_GT(turn, 0.2) << wanted.operation;  // a quarter, counter-clockwise
        }
    }
    for (const std::string operation : {"SLIDING_TO_LEFT", "FOLDING_TO_RIGHT", "REVOLVING"}) {
        const auto volume = houseVolume(operation);
        EXPECT_NE(doorOf(planOf(volume), volume, "Entrance door"), nullptr) << operation;
    }
    for (const std::string operation : {"ROLLINGUP", "NOTDEFINED", "USERDEFINED"})
        EXPECT_TRUE(planOf(houseVolume(operation)).doors.empty()) << operation;
}

TEST(DoorSwings, SurviveInAFileAndStandOnlyInPlans) {
    const auto volume = houseVolume();
    test::TemporaryFolder folder;
    ASSERT_TRUE(volume::writeSvt(volume, folder.path() / "house.svt"));
    const auto again = volume::readSvt(folder.path() / "house.svt");
    ASSERT_TRUE(again);
    EXPECT_EQ(planOf(*again).doors.size(), 6u);
    const auto upright = drawing::drawSection(volume, *drawing::parseSectionPlane("y<5", volume));
    ASSERT_TRUE(upright);
    EXPECT_TRUE(upright->doors.empty());
}

TEST(DoorSwings, OfFilesAreTakenFromDoorsTypesAndStyles) {
    // FZK-Haus: types of IFC4, three hinged doors and a sliding one. The last is IFC2x3 with styles.
    for (const auto& [name, doors] :
         std::map<std::string, std::size_t>{{"fzk_haus.ifc", 4}, {"largebuilding.ifc", 18}}) {
        SVT_NEEDS_DATA(file, name.c_str());
        auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
        ASSERT_TRUE(model);
        const auto volume = volumeOf(std::move(*model));
        const auto drawing = drawing::drawSection(volume, drawing::defaultSectionPlane(volume));
        ASSERT_TRUE(drawing);
        EXPECT_EQ(drawing->doors.size(), doors) << name;
    }
}

}  // namespace
}  // namespace svt::pipeline
