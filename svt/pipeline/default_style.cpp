#include <svt/pipeline/default_style.hpp>

namespace svt::pipeline {

// Later rules win: by class, then by the names of construction elements and their function, then by IFC type with its
// predefined type, and material. Rooms and other spaces are thin coloured air regardless of their names, so that their
// contents are visible.
const char* const kDefaultStyleJson = R"json({
  "rules": [
    {"select": "all", "color": "#c9c4ba", "opacity": 1},
    {"select": "class=Building or class=BuildingPart", "color": "#d5cfc4"},
    {"select": "class=BuildingRoom", "color": "#8fb8d8", "opacity": 0.08},
    {"select": "class=BuildingUnit", "color": "#e0b66c", "opacity": 0.10},
    {"select": "class=Storey", "color": "#cfd8dc", "opacity": 0.05},
    {"select": "class=BuildingConstructiveElement", "color": "#d8c9ae"},
    {"select": "class=WallSurface", "color": "#d9c7a8"},
    {"select": "class=InteriorWallSurface", "color": "#e6dcc8"},
    {"select": "class=RoofSurface", "color": "#a8483a"},
    {"select": "class=GroundSurface or class=OuterFloorSurface", "color": "#8d8a83"},
    {"select": "class=FloorSurface", "color": "#b58d61"},
    {"select": "class=CeilingSurface or class=OuterCeilingSurface", "color": "#ece8df"},
    {"select": "class=ClosureSurface", "color": "#b0c4de", "opacity": 0.3},
    {"select": "class=Door or class=DoorSurface", "color": "#8a5a33"},
    {"select": "class=Window or class=WindowSurface", "color": "#7fa9c4"},
    {"select": "class=BuildingInstallation", "color": "#8f9aa3"},
    {"select": "class=BuildingFurniture", "color": "#b0763f"},
    {"select": "class=CityFurniture", "color": "#7d7f86"},
    {"select": "class~Vegetation or class=PlantCover", "color": "#6b8e4e"},
    {"select": "class=TINRelief or class=ReliefFeature or class=LandUse", "color": "#9aa67c"},
    {"select": "class~Water", "color": "#5b8fb9", "opacity": 0.9},
    {"select": "class~Traffic or class=Road or class=Track or class=Square", "color": "#8c8c8c"},

    {"select": "class=BuildingConstructiveElement and name~'[Ss]lab|[Dd]ecke|[Bb]odenplatte'", "color": "#a9a59c"},
    {"select": "class=BuildingConstructiveElement and name~'[Bb]eam|Unterzug'", "color": "#7c6f64"},
    {"select": "class=BuildingConstructiveElement and name~'[Rr]after|Sparren'", "color": "#b98a52"},
    {"select": "class=BuildingConstructiveElement and name~'[Rr]oof|Dach'", "color": "#a8483a"},

    {"select": "class=BuildingConstructiveElement and function~'[Ss]lab|[Dd]ecke|[Bb]odenplatte'", "color": "#a9a59c"},
    {"select": "class=BuildingConstructiveElement and function~'[Ww]all|[Ww]and'", "color": "#dcc9a6"},
    {"select": "class=BuildingConstructiveElement and function~'[Bb]eam|Unterzug'", "color": "#7c6f64"},
    {"select": "class=BuildingConstructiveElement and function~'[Rr]after|Sparren'", "color": "#b98a52"},
    {"select": "class=BuildingConstructiveElement and function~'[Rr]oof|Dach'", "color": "#a8483a"},

    {"select": "ifcType~Slab", "color": "#a9a59c"},
    {"select": "ifcType~Slab and predefinedType=BASESLAB or ifcType~Footing or ifcType~Pile", "color": "#8d8a83"},
    {"select": "ifcType~Wall", "color": "#dcc9a6"},
    {"select": "ifcType~Beam", "color": "#7c6f64"},
    {"select": "ifcType~Column", "color": "#9c9184"},
    {"select": "ifcType~Member", "color": "#b98a52"},
    {"select": "ifcType~Window", "color": "#7fa9c4"},
    {"select": "ifcType~Door", "color": "#8a5a33"},
    {"select": "ifcType~Stair or ifcType~Railing", "color": "#8f9aa3"},
    {"select": "ifcType~Roof or ifcType=IfcSlab and (predefinedType=ROOF or name~'[Rr]oof|Dach')", "color": "#a8483a"},
    {"select": "ifcType~Covering", "color": "#ddd6c8"},
    {"select": "ifcType~Covering and predefinedType=CEILING", "color": "#ece8df"},
    {"select": "ifcType~Covering and predefinedType=FLOORING", "color": "#b58d61"},
    {"select": "ifcType~Covering and predefinedType=ROOFING", "color": "#a8483a"},
    {"select": "ifcType~Covering and predefinedType=INSULATION", "color": "#e7d98c"},
    {"select": "material=brick", "color": "#c88d6b"},
    {"select": "material=concrete", "color": "#aaa69e"},
    {"select": "material=timber or material=wood", "color": "#b98a52"},
    {"select": "material=tiles", "color": "#a8483a"},
    {"select": "material=glass", "color": "#9cc3d8", "opacity": 0.9},
    {"select": "material=insulation", "color": "#e7d98c"},
    {"select": "material=steel", "color": "#8b959c"},
    {"select": "phase=glass", "color": "#9cc3d8"}
  ]
})json";

const char* const kDefaultPatternsJson = R"json({
  "rules": [
    {"select": "class=WallSurface or class=InteriorWallSurface or ifcType~Wall or material=brick",
     "pattern": {"type": "brick", "colors": ["#b9744f", "#e4ddd0"]}},
    {"select": "class=GroundSurface or class=FloorSurface or ifcType~Slab or material=concrete",
     "pattern": {"type": "concrete", "colors": ["#b3b0a8", "#8f8c85", "#75726c"]}},
    {"select": "class=RoofSurface or ifcType~Roof or predefinedType=ROOF or material=tiles or (ifcType=IfcSlab or class=BuildingConstructiveElement and not ifcType~Covering) and name~'[Rr]oof|Dach'",
     "pattern": {"type": "stripes", "size": 0.16, "line": 0.03, "colors": ["#a8483a", "#80372d"]}},
    {"select": "ifcType~Member or ifcType~Beam or material=timber or material=wood",
     "pattern": {"type": "wood-grain", "colors": ["#cf9f63", "#8f6232"]}},
    {"select": "material=insulation", "pattern": {"type": "insulation", "colors": ["#f1e6a7", "#a8923a"]}},
    {"select": "material=block", "pattern": {"type": "block", "colors": ["#cfc8ba", "#8f897d"]}}
  ]
})json";

}  // namespace svt::pipeline
