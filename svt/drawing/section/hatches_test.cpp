#include <svt/drawing/hatches.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

using render::Hatch;

volume::Label label(const char* className, const char* name, const char* material = nullptr) {
    volume::Label label;
    label.id = name;
    label.className = className;
    label.name = name;
    if (material != nullptr) label.attributes.push_back({"material", std::string(material), ""});
    return label;
}

TEST(Hatches, MaterialWinsOverNameAndNameOverClass) {
    volume::LabelTable table;
    table.labels = {label("WallSurface", "w"),
                    label("WallSurface", "w2", "concrete"),
                    label("BuildingConstructiveElement", "Slab-033"),
                    label("BuildingConstructiveElement", "Unterzug-1"),
                    label("BuildingConstructiveElement", "Sparren-2"),
                    label("BuildingConstructiveElement", "Sparren-3", "steel"),
                    label("BuildingConstructiveElement", "something"),
                    label("BuildingRoom", "room"),
                    label("BuildingConstructiveElement", "layer", "insulation"),
                    label("BuildingConstructiveElement", "wall", "plaster, brick, insulation, plaster"),
                    label("BuildingConstructiveElement", "floor", "screed, insulation, concrete")};
    EXPECT_EQ(labelHatches(table),
              (std::vector<Hatch>{Hatch::Masonry, Hatch::ReinforcedConcrete, Hatch::ReinforcedConcrete,
                                  Hatch::ReinforcedConcrete, Hatch::Timber, Hatch::Steel, Hatch::General, Hatch::None,
                                  Hatch::Insulation, Hatch::Masonry, Hatch::ReinforcedConcrete}));
}

TEST(Hatches, HaveNames) {
    for (const auto& [hatch, name] : kNames<render::Hatch>) EXPECT_EQ(fromName<render::Hatch>(name), hatch);
    EXPECT_FALSE(fromName<render::Hatch>("bricks"));
}

}  // namespace
}  // namespace svt::drawing
