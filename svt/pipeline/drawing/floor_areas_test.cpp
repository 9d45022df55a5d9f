/// Floor areas against those that the program that wrote a model measured itself.

#include <svt/core/test_data_test.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>

#include <gtest/gtest.h>

namespace svt::pipeline {
namespace {

// The IFC file of the FZK-Haus has the area of each room as its author program measured it.
TEST(FloorAreasOfFile, RoomsOfTheFzkHausHaveTheAreasThatItsAuthorMeasured) {
    SVT_NEEDS_DATA(file, "fzk_haus.ifc");
    auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
    ASSERT_TRUE(model);
    BuildOptions options;
    options.vectors.meshes = true;
    const auto built = buildVolume(*model, options);
    ASSERT_TRUE(built);
    const volume::SemanticVolume& volume = built->volume;
    const auto levels = drawing::findLevels(volume);
    ASSERT_EQ(levels.size(), 2u);
    const auto areas = drawing::measureFloorAreas(volume, levels);
    ASSERT_TRUE(areas);
    ASSERT_EQ(areas->rooms.size(), 7u);
    for (const drawing::RoomArea& room : areas->rooms) {
        double measured = 0;
        for (const Attribute& attribute : volume.labels.labels[room.label].attributes)
            if (attribute.name == "BaseQuantities.GrossFloorArea") measured = std::get<double>(attribute.value);
        EXPECT_NEAR(room.area, measured, 2e-5) << room.name;
        EXPECT_EQ(room.use, room.name == "Flur" ? drawing::RoomUse::Traffic : drawing::RoomUse::Use);
        EXPECT_FALSE(room.number.empty());
    }
    // The house has 12 x 10 m; the doors and the terrace door are a part of it.
    EXPECT_NEAR(areas->levels[0].gross, 120, 0.01);
    EXPECT_NEAR(areas->levels[1].gross, 120, 0.01);
}

}  // namespace
}  // namespace svt::pipeline
