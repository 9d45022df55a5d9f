#include <svt/drawing/hatches.hpp>

#include <gtest/gtest.h>

#include <utility>

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

volume::Label element(std::vector<std::pair<const char*, const char*>> attributes) {
    volume::Label made = label("BuildingConstructiveElement", "element");
    for (const auto& [name, value] : attributes) made.attributes.push_back({name, std::string(value), ""});
    return made;
}

HatchChoice choiceOf(volume::Label made, const MaterialTable& materials = MaterialTable::builtIn()) {
    volume::LabelTable table;
    table.labels = {std::move(made)};
    return chooseHatches(table, materials).front();
}

Hatch ofMaterial(const char* name) { return choiceOf(element({{"material", name}})).hatch; }

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

TEST(Hatches, AWallIsItsThickestLoadBearingLayer) {
    // A word inside of another word decides nothing.
    const HatchChoice brick = choiceOf(element(
        {{"ifcType", "IfcWall"},
         {"material", "Brick, Common; Fiberglass Batt; Metal Stud Layer; Gypsum Wall Board"},
         {"materialLayers",
          "Brick, Common 0.09 m; Fiberglass Batt 0.2 m; Metal Stud Layer 0.152 m; Gypsum Wall Board 0.016 m"}}));
    EXPECT_EQ(brick, (HatchChoice{Hatch::Masonry, HatchSource::Thickest, "Brick, Common", "brick"}));
    const HatchChoice thick = choiceOf(element({{"materialLayers", "Brick 0.1 m; Concrete 0.2 m; Brick 0.1 m"}}));
    EXPECT_EQ(thick.hatch, Hatch::ReinforcedConcrete);
    // Without a load-bearing layer, the thickest decides: studs do not make a wall steel.
    const HatchChoice studs =
        choiceOf(element({{"materialLayers", "Plaster 0.0125 m; Metal Stud Layer 0.07 m; Plaster 0.0125 m"}}));
    EXPECT_EQ(studs, (HatchChoice{Hatch::General, HatchSource::Thickest, "Metal Stud Layer", "metal stud"}));
    // Without thickness, the first load-bearing one; air never decides.
    const HatchChoice list = choiceOf(element({{"material", "Air; Fiberglass Batt; Masonry - Concrete Block; Steel"}}));
    EXPECT_EQ(list, (HatchChoice{Hatch::Masonry, HatchSource::First, "Masonry - Concrete Block", "concrete block"}));
    // A property may name the structure.
    const HatchChoice stated = choiceOf(element(
        {{"Materials and Finishes.Structural Material", "Timber"}, {"materialLayers", "Brick 0.1 m; Timber 0.05 m"}}));
    EXPECT_EQ(stated, (HatchChoice{Hatch::Timber, HatchSource::Structure, "Timber", "timber"}));
    volume::Label layer =
        element({{"Materials and Finishes.Structural Material", "Timber"}, {"material", "Brick, Common"}});
    layer.attributes.push_back({"layer", std::int64_t{1}, ""});
    EXPECT_EQ(choiceOf(layer), (HatchChoice{Hatch::Masonry, HatchSource::Material, "Brick, Common", "brick"}));
    const HatchChoice one = choiceOf(element({{"material", "Gypsum Wall Board"}}));
    EXPECT_EQ(one, (HatchChoice{Hatch::Concrete, HatchSource::Material, "Gypsum Wall Board", "gypsum"}));
}

TEST(Hatches, WithoutAMatchingWordAreAssumed) {
    const HatchChoice wall = choiceOf(element({{"ifcType", "IfcWall"}, {"material", "Solid 397409098"}}));
    EXPECT_EQ(wall, (HatchChoice{Hatch::Masonry, HatchSource::Class, "Solid 397409098", ""}));
    EXPECT_TRUE(wall.isAssumed());
    EXPECT_FALSE(choiceOf(label("BuildingRoom", "room")).isAssumed());
    volume::LabelTable table;
    table.labels = {element({{"ifcType", "IfcWall"}, {"material", "Solid 1"}}), element({{"ifcType", "IfcWall"}}),
                    element({{"ifcType", "IfcWall"}, {"material", "brick"}})};
    const auto uses = hatchUses(chooseHatches(table), {2, 0, 1, 1});
    ASSERT_EQ(uses.size(), 3u);
    EXPECT_EQ(assumedHatches(uses),
              "the hatches of 2 components are assumed from their class and name: 1 without material, 1 with materials "
              "without a matching word ('Solid 1'); name these in a table for --materials");
    EXPECT_EQ(assumedHatches(hatchUses(chooseHatches(table), {2})), "");
}

TEST(Hatches, OfWindowsAreGlassWhateverTheirFramesAreMadeOf) {
    volume::Label window = label("Window", "window", "Softwood; Glass");
    EXPECT_EQ(choiceOf(window), (HatchChoice{Hatch::Glass, HatchSource::Window, "Softwood; Glass", ""}));
    EXPECT_EQ(choiceOf(label("Door", "door", "Glass")).hatch, Hatch::Glass);
}

TEST(Hatches, OfPhasesAreThoseOfTheirObjectsExceptForGlass) {
    volume::LabelTable table;
    table.labels = {label("Door", "door", "steel"), label("DoorPhase", "leaf"), label("DoorPhase", "sill", "timber"),
                    label("WindowPhase", "glass")};
    for (std::uint32_t l = 1; l < 4; ++l) table.labels[l].parent = 0;
    EXPECT_EQ(labelHatches(table), (std::vector<Hatch>{Hatch::Steel, Hatch::Steel, Hatch::Timber, Hatch::Glass}));
    EXPECT_EQ(chooseHatches(table)[1].source, HatchSource::Material);
}

TEST(Hatches, OfTheGroundOfASiteAreEarth) {
    volume::Label site = label("GenericLogicalSpace", "plot");
    site.attributes.push_back({"ifcType", std::string("IfcSite"), ""});
    EXPECT_EQ(choiceOf(site).hatch, Hatch::Earth);
}

TEST(Hatches, AreStatedByAnAttribute) {
    EXPECT_EQ(choiceOf(element({{"hatch", "earth"}, {"material", "brick"}})),
              (HatchChoice{Hatch::Earth, HatchSource::Stated, "", ""}));
    EXPECT_EQ(choiceOf(element({{"hatch", "unknown"}, {"material", "brick"}})).hatch, Hatch::Masonry);
    volume::LabelTable table;
    table.labels = {element({{"material", "Poroton"}}), element({{"hatch", "no"}, {"material", "brick"}}),
                    label("BuildingRoom", "room")};
    MaterialTable own;
    own.add({Hatch::Steel, true}, "poroton");
    stateHatches(chooseHatches(table, own), table);
    EXPECT_EQ(labelHatches(table), (std::vector<Hatch>{Hatch::Steel, Hatch::General, Hatch::None}))
        << "the table of the user replaces the other one";
}

TEST(Hatches, HaveNames) {
    for (const auto& [hatch, name] : kNames<render::Hatch>) EXPECT_EQ(fromName<render::Hatch>(name), hatch);
    EXPECT_FALSE(fromName<render::Hatch>("bricks"));
    EXPECT_EQ(hatchSourceName(HatchSource::Stated), "stated");
    EXPECT_EQ(hatchSourceName(HatchSource::Class), "class");
}

TEST(MaterialTable, KnowsWordsOfSeveralLanguages) {
    using Case = std::pair<const char*, Hatch>;
    for (const auto& [name, hatch] : {Case{"Brick, Common", Hatch::Masonry},
                                      {"Concrete Masonry Units _Low Density", Hatch::Masonry},
                                      {"MASONRY - CONCRETE BLOCKS", Hatch::Masonry},
                                      {"Concrete, Precast", Hatch::ReinforcedConcrete},
                                      {"Plain concrete C12/15", Hatch::Concrete},
                                      {"Fiberglass Batt", Hatch::Insulation},
                                      {"Rigid insulation", Hatch::Insulation},
                                      {"Wood fibre insulation board", Hatch::Insulation},
                                      {"Wood Stud", Hatch::Timber},
                                      {"Glass, clear", Hatch::Glass},
                                      {"Glass Wool", Hatch::Insulation},
                                      {"Sand/Cement Screed", Hatch::Concrete},
                                      {"Sand-lime brick", Hatch::Masonry},
                                      {"Stahlbeton 65690", Hatch::ReinforcedConcrete},
                                      {"Leichtbeton", Hatch::ReinforcedConcrete},
                                      {"Kalksandsteinmauerwerk", Hatch::Masonry},
                                      {"Hochlochziegel", Hatch::Masonry},
                                      {"Mineralwolldämmung", Hatch::Insulation},
                                      {"MINERALISCHE DÄMMUNG", Hatch::Insulation},
                                      {"Zementestrich", Hatch::Concrete},
                                      {"Gipskartonplatte", Hatch::Concrete},
                                      {"Brettschichtholz", Hatch::Timber},
                                      {"Stahl S235", Hatch::Steel},
                                      {"Isolierglas", Hatch::Glass},
                                      {"Béton armé", Hatch::ReinforcedConcrete},
                                      {"BÉTON", Hatch::ReinforcedConcrete},
                                      {"Béton cellulaire", Hatch::Masonry},
                                      {"Laine de verre", Hatch::Insulation},
                                      {"Briques creuses", Hatch::Masonry},
                                      {"Bois massif", Hatch::Timber},
                                      {"Acier galvanisé", Hatch::Steel},
                                      {"Verre trempé", Hatch::Glass},
                                      {"Gewapend beton", Hatch::ReinforcedConcrete},
                                      {"Baksteen", Hatch::Masonry},
                                      {"Kalkzandsteen", Hatch::Masonry},
                                      {"Minerale wol", Hatch::Insulation},
                                      {"Isolatieplaat", Hatch::Insulation},
                                      {"Vurenhout", Hatch::Timber},
                                      {"Betong B30", Hatch::ReinforcedConcrete},
                                      {"Armerad betong", Hatch::ReinforcedConcrete},
                                      {"Teglstein", Hatch::Masonry},
                                      {"Lättbetong", Hatch::Masonry},
                                      {"Mineralull", Hatch::Insulation},
                                      {"Konstruktionsstål", Hatch::Steel},
                                      {"Limtre", Hatch::Timber},
                                      {"Teräsbetoni", Hatch::ReinforcedConcrete},
                                      {"Kalkkihiekkatiili", Hatch::Masonry},
                                      {"Mineraalivilla", Hatch::Insulation},
                                      {"Lämmöneriste", Hatch::Insulation},
                                      {"Liimapuu", Hatch::Timber},
                                      {"Rakenneteräs", Hatch::Steel},
                                      {"Hormigón armado", Hatch::ReinforcedConcrete},
                                      {"Ladrillo cerámico", Hatch::Masonry},
                                      {"Lana de roca", Hatch::Insulation},
                                      {"Madera laminada", Hatch::Timber},
                                      {"Acero", Hatch::Steel},
                                      {"Vidrio", Hatch::Glass},
                                      {"Calcestruzzo armato", Hatch::ReinforcedConcrete},
                                      {"Cemento armato", Hatch::ReinforcedConcrete},
                                      {"Mattoni pieni", Hatch::Masonry},
                                      {"Lana di roccia", Hatch::Insulation},
                                      {"Intonaco", Hatch::Concrete},
                                      {"Legno lamellare", Hatch::Timber},
                                      {"鉄筋コンクリート", Hatch::ReinforcedConcrete},
                                      {"コンクリートブロック", Hatch::Masonry},
                                      {"普通レンガ", Hatch::Masonry},
                                      {"グラスウール断熱材", Hatch::Insulation},
                                      {"石膏ボード", Hatch::Concrete},
                                      {"木材", Hatch::Timber},
                                      {"鉄骨", Hatch::Steel},
                                      {"ガラス", Hatch::Glass},
                                      {"砕石", Hatch::Earth}})
        EXPECT_EQ(ofMaterial(name), hatch) << name;
    EXPECT_FALSE(MaterialTable::builtIn().find("Fibreglassy"));
    EXPECT_FALSE(MaterialTable::builtIn().find(""));
    EXPECT_FALSE(MaterialTable::builtIn().find("\xFF\xFE"));
}

TEST(MaterialTable, IsReadFromCsvAndJson) {
    const auto csv = parseMaterials(
        "\xEF\xBB\xBFhatch,loadBearing,words\r\n# own\n"
        "steel,yes,Poroton|*wunder\n\"glass\",no,\"soft brick\"\n",
        "m.csv");
    ASSERT_TRUE(csv) << csv.error().message();
    EXPECT_EQ(csv->find("Poroton T7")->row.hatch, Hatch::Steel);
    EXPECT_TRUE(csv->find("Baustoffwunder")->row.isLoadBearing);
    EXPECT_EQ(csv->find("Soft bricks")->row.hatch, Hatch::Glass) << "two words before one";
    EXPECT_EQ(csv->find("Brick")->row.hatch, Hatch::Masonry) << "the table of the program follows";
    const auto alone = parseMaterials("#replace\nsteel,yes,Poroton\n", "m.csv");
    ASSERT_TRUE(alone);
    EXPECT_FALSE(alone->find("Brick"));
    const auto json = parseMaterials(
        R"({"replace": true, "materials": [{"words": ["Poroton", "x*"], "hatch": "earth", "loadBearing": true}]})",
        "m");
    ASSERT_TRUE(json) << json.error().message();
    EXPECT_EQ(json->find("Xyz")->row.hatch, Hatch::Earth);
    EXPECT_FALSE(json->find("Brick"));
}

// A window with its pane as a phase: the frame is not glass.
TEST(Hatches, FramesOfWindowsHaveThatOfTheirMaterial) {
    const auto hatchesOf = [](const char* windowClass, const char* material, const char* style) {
        volume::LabelTable table;
        table.labels = {label(windowClass, "window", material), label("WindowPhase", "pane"),
                        label("WindowPhase", "handle")};
        table.labels[0].attributes.push_back({"phase", std::string("frame"), ""});
        table.labels[0].attributes.push_back({"ifcType", std::string("IfcWindow"), ""});
        if (style != nullptr) table.labels[0].attributes.push_back({"style", std::string(style), ""});
        table.labels[1].attributes.push_back({"phase", std::string("glass"), ""});
        table.labels[2].attributes.push_back({"phase", std::string("handle"), ""});
        table.labels[2].attributes.push_back({"material", std::string("Aluminium"), ""});
        table.labels[1].parent = table.labels[2].parent = 0;
        if (std::string_view(windowClass) != "Window")
            table.labels[1].className = table.labels[2].className = "BuildingConstructiveElementPhase";
        return labelHatches(table);
    };
    for (const char* const name : {"Window", "BuildingConstructiveElement"}) {
        EXPECT_EQ(hatchesOf(name, nullptr, nullptr), (std::vector<Hatch>{Hatch::None, Hatch::Glass, Hatch::Steel}));
        EXPECT_EQ(hatchesOf(name, "Glass; Oak wood", nullptr).front(), Hatch::Timber) << name;
        EXPECT_EQ(hatchesOf(name, nullptr, "Aluminium, grey").front(), Hatch::Steel) << name;
        EXPECT_EQ(hatchesOf(name, "Glass", "white").front(), Hatch::None) << name;
    }
    EXPECT_EQ(choiceOf(label("Window", "whole")).hatch, Hatch::Glass) << "without parts";
}

TEST(MaterialTable, OfBadFilesIsAnError) {
    const auto errorOf = [](const char* text) { return parseMaterials(text, "m.csv").error(); };
    EXPECT_EQ(errorOf("bricks,yes,a\n").code(), Code::BadValue);
    EXPECT_EQ(errorOf("# a\nmasonry,perhaps,a\n").where().line, 2u);
    EXPECT_EQ(errorOf("masonry,yes,\n").code(), Code::BadValue);
    EXPECT_EQ(errorOf("masonry").code(), Code::BadValue);
    EXPECT_EQ(errorOf("{\"materials\": 3}").code(), Code::BadJson);
    EXPECT_EQ(errorOf("{").code(), Code::BadJson);
    EXPECT_EQ(errorOf(R"({"materials": [{"words": [], "hatch": "earth"}]})").code(), Code::BadJson);
    EXPECT_EQ(errorOf(R"({"materials": [{"words": ["a"], "hatch": "soil"}]})").code(), Code::BadJson);
}

}  // namespace
}  // namespace svt::drawing
