#include <apps/cli/options/catalog.hpp>

#include <svt/core/text.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::cli {
namespace {

using enum OptionKind;

// Options that several commands have.

constexpr Option kModelInput[] = {{.name = "input",
                                   .value = "FILE",
                                   .help = "a .svt, a model file, or a city: its folder or address",
                                   .isRequired = true,
                                   .file = FileUse::ModelOrVolume}};
constexpr Option kSiteInputs[] = {{.name = "input",
                                   .value = "FILE",
                                   .help = "what the page opens: .svt, model files, folders of cities",
                                   .isRequired = true,
                                   .mayRepeat = true,
                                   .file = FileUse::ModelOrVolume}};

constexpr Option kGrid[] = {
    {.name = "--dimension",
     .value = "X,Y,Z",
     .help = "samples along x, y and z, such as 800,700,400 (2 to 65535)",
     .group = "Grid",
     .isForModels = true},
    {.name = "--spacing",
     .value = "M",
     .otherwise = "0.05; coarser for large models, finer for small ones",
     .help = "distance of samples in metres, one number or three",
     .group = "Grid",
     .isForModels = true},
    {.name = "--axes",
     .choices = "world|building",
     .byDefault = "world",
     .help = "axes of the grid: world, or building (turned to its dominant edge)",
     .group = "Grid",
     .isForModels = true},
};
constexpr Option kModel[] = {
    {.name = "--lod",
     .kind = Number,
     .least = 0,
     .most = 4,
     .otherwise = "the finest that each feature has",
     .help = "use no finer level of detail than this",
     .group = "Model",
     .isForModels = true},
    {.name = "--no-bodies",
     .kind = Flag,
     .help = "leave the material between hull and rooms to the building, not to its walls and slabs",
     .group = "Model",
     .isForModels = true},
    {.name = "--crs",
     .value = "CODE",
     .otherwise = "the file's own; degrees and feet become metres of the usual projection of the place",
     .help = "bring the model to this projection in metres, such as EPSG:25832",
     .group = "Model",
     .isForModels = true},
    {.name = "--keep-far-features",
     .kind = Flag,
     .help = "keep features that lie far away from all others",
     .group = "Model",
     .isForModels = true},
    {.name = "--extrude-footprints",
     .kind = Flag,
     .help = "what has a footprint alone, and a height as attribute, becomes a body",
     .group = "Model",
     .isForModels = true},
    {.name = "--allow-truncated",
     .kind = Flag,
     .help = "read a file that was cut off (IFC, CityJSONSeq) up to the cut, with a warning",
     .group = "Model",
     .isForModels = true},
    {.name = "--layers",
     .kind = Flag,
     .help = "IFC: split walls and slabs into the layers of their material, each an object of its own",
     .group = "Model",
     .isForModels = true},
};
constexpr Option kMemory[] = {
    {.name = "--memory",
     .kind = Whole,
     .unit = "MB",
     .least = 64,
     .most = 16777216,
     .otherwise = "what the machine has, or a control group or ulimit grants",
     .help =
         "memory that the work may take; where it needs more, it ends with a message. Pictures of cities give half of "
         "it to tiles (1 GB without the option), and become coarser",
     .group = "Model"},
};
constexpr Option kStyle[] = {
    {.name = "--style",
     .value = "FILE",
     .help = "style file (JSON): colours, opacities and patterns by query",
     .group = "Style",
     .file = FileUse::Style,
     .isForModels = true},
    {.name = "--patterns",
     .kind = Flag,
     .help = "embed the built-in patterns: brick, concrete, timber, ...",
     .group = "Style",
     .isForModels = true},
};
constexpr Option kVoxels[] = {
    {.name = "--sheets",
     .choices = "thin|conservative",
     .byDefault = "thin",
     .help = "open surfaces: thin (6-separating) or conservative (every voxel touched)",
     .group = "Voxels",
     .isForModels = true},
    {.name = "--no-thin",
     .kind = Flag,
     .help = "drop parts of solids that are thinner than a voxel",
     .group = "Voxels",
     .isForModels = true},
    {.name = "--threads",
     .kind = Whole,
     .least = 0,
     .most = 1024,
     .otherwise = "all cores",
     .help = "number of threads; the result does not depend on it",
     .group = "Voxels"},
};
constexpr Option kQuiet[] = {
    {.name = "-q,--quiet",
     .kind = Flag,
     .help = "print errors and results only: no progress, findings, notes or summary",
     .group = "Output"},
};
constexpr Option kVerbose[] = {
    {.name = "-v,--verbose", .kind = Flag, .help = "show all findings", .group = "Output", .excludes = "--quiet"},
};

// sample

constexpr Option kSample[] = {
    {.name = "kind", .choices = "house|tower|district", .help = "house, tower or district", .isRequired = true},
    {.name = "-o,--output",
     .value = "FILE",
     .help = "model to write: .gml (CityGML 3.0), .json (CityJSON 2.0), .jsonl (CityJSONSeq), .ifc (IFC4)",
     .isRequired = true,
     .file = FileUse::Output,
     .formats = "citygml|cityjson|cityjsonseq|ifc"},
    {.name = "--format",
     .choices = "citygml3|citygml2|cityjson|cityjsonseq|ifc",
     .otherwise = "by extension",
     .help = "format of the model"},
    {.name = "--seed",
     .kind = Whole,
     .least = 0,
     .byDefault = "1",
     .help = "decides owners and the houses of a district"},
    {.name = "--storeys", .kind = Whole, .least = 1, .most = 200, .byDefault = "8", .help = "tower: number of storeys"},
    {.name = "--flats", .kind = Whole, .least = 2, .most = 8, .byDefault = "4", .help = "tower: flats on each storey"},
    {.name = "--columns",
     .kind = Whole,
     .least = 1,
     .most = 1000,
     .byDefault = "4",
     .help = "district: houses from west to east"},
    {.name = "--rows",
     .kind = Whole,
     .least = 1,
     .most = 1000,
     .byDefault = "3",
     .help = "district: houses from south to north"},
    {.name = "--turn",
     .kind = Number,
     .unit = "degrees counter-clockwise",
     .least = -360,
     .most = 360,
     .byDefault = "0",
     .help = "turn in plan"},
    {.name = "--thematic", .kind = Flag, .help = "CityGML 2.0: walls only as surfaces, as LoD4 has them"},
};

// sample-city

constexpr Option kThreads[] = {
    {.name = "--threads",
     .kind = Whole,
     .least = 0,
     .most = 1024,
     .otherwise = "all cores",
     .help = "number of threads; the result does not depend on it"},
};
constexpr Option kSampleCity[] = {
    {.name = "--profile",
     .choices = "3dbag|berlin|nyc|plateau",
     .byDefault = "berlin",
     .help = "whose files the city resembles: formats, versions, CRS and units"},
    {.name = "--buildings",
     .kind = Whole,
     .least = 1,
     .most = 100000000,
     .byDefault = "1000",
     .help = "number of buildings, those that stand in two files counted once"},
    {.name = "--files", .kind = Whole, .least = 1, .most = 100000, .byDefault = "1", .help = "number of files"},
    {.name = "--seed", .kind = Whole, .least = 0, .byDefault = "1", .help = "decides all buildings"},
    {.name = "-o,--output",
     .value = "DIR",
     .help = "folder that the files are written into",
     .isRequired = true,
     .file = FileUse::OutputFolder},
};

// build

constexpr Option kBuild[] = {
    {.name = "input",
     .value = "FILE",
     .help =
         "model files: CityGML 1.0 to 3.0, CityJSON 1.0 to 2.0, CityJSONSeq, IFC 2x3 to 4.3, IndoorGML; or one label "
         "volume: NRRD, VTI, NIfTI, TIFF, a folder of Zarr, CityGML with a volume in it",
     .isRequired = true,
     .mayRepeat = true,
     .file = FileUse::Model},
    {.name = "-o,--output",
     .value = "F.svt",
     .help = "the volume to write",
     .isRequired = true,
     .file = FileUse::Output,
     .formats = "svt"},
};
constexpr Option kGridOf[] = {
    {.name = "--only",
     .value = "QUERY",
     .help = "keep the voxels of what the query selects alone, in the box around them",
     .group = "Part"},
    {.name = "--box",
     .kind = Number,
     .value = "X0,Y0,Z0,X1,Y1,Z1",
     .unit = "metres",
     .help = "keep only the samples in this box of world coordinates",
     .group = "Part",
     .count = 6,
     .leastCount = 6},
    {.name = "--labels",
     .value = "FILE",
     .otherwise = "what the file tells, else a label per value",
     .help = "of a label volume: a table (JSON) that says which label each value is",
     .file = FileUse::OtherInput},
    {.name = "--grid-of",
     .value = "F.svt",
     .help = "samples where this volume has them, so that the two can be compared voxel by voxel",
     .group = "Grid",
     .file = FileUse::OtherInput},
};
constexpr Option kBuildOutput[] = {
    {.name = "--vectors",
     .choices = "edges|meshes|none",
     .byDefault = "meshes",
     .help =
         "edges: keep the feature edges beside the meshes, to be drawn inside the volume; none: no meshes either, so "
         "that sections are cut from voxels",
     .group = "Output",
     .count = 2},
    {.name = "--json", .kind = Flag, .help = "print figures as JSON on stdout", .group = "Output"},
    {.name = "--strict",
     .kind = Flag,
     .help = "exit 4 where the model has defects; the volume is written all the same",
     .group = "Output"},
};

// info, check

constexpr Option kInfoOutput[] = {
    {.name = "--json", .kind = Flag, .help = "print everything as JSON on stdout", .group = "Output"},
    {.name = "--tree", .kind = Flag, .help = "print the tree of features", .group = "Output"},
};
constexpr Option kCheck[] = {
    {.name = "input",
     .value = "FILE",
     .help = "model files, or a city: its folder or address",
     .isRequired = true,
     .mayRepeat = true,
     .file = FileUse::Model},
    kModel[0],
    kModel[2],
    kModel[3],
    kModel[4],
    kModel[5],
    {.name = "--planarity",
     .kind = Number,
     .unit = "m",
     .least = 1e-6,
     .most = 1000,
     .byDefault = "0.01",
     .help = "how far a point may lie from the plane of its polygon",
     .group = "Tolerances"},
    {.name = "--overlap",
     .kind = Number,
     .unit = "m",
     .least = 0,
     .most = 1000,
     .otherwise = "solids that overlap by more than 1 mm are reported",
     .help = "leave solids be that overlap by up to twice this",
     .group = "Tolerances"},
    {.name = "--report",
     .value = "R.html",
     .help = "also write a page with counts, findings and a picture of each defect",
     .group = "Output",
     .file = FileUse::Output,
     .formats = "html"},
    {.name = "--format",
     .choices = "text|json|val3dity",
     .byDefault = "text",
     .help = "what to print on stdout: text, JSON, or JSON as val3dity reports it",
     .group = "Output"},
    kInfoOutput[0],
};

// render

constexpr Option kRender[] = {
    kModelInput[0],
    {.name = "-o,--output",
     .value = "P.png",
     .help = "the picture to write: .png; as lines .svg or .pdf; or a film: .webm, .mp4, .gif or .webp",
     .isRequired = true,
     .file = FileUse::Output,
     .formats = "png|svg|pdf|webm|mp4|gif|webp",
     .mayLackEnding = true,
     .numberedBy = "--frames"},
    {.name = "--size",
     .value = "WxH",
     .byDefault = "1280x720",
     .help = "width x height in pixels, or such as 160x90mm",
     .group = "View"},
    {.name = "--dpi",
     .kind = Whole,
     .least = 1,
     .most = 4800,
     .byDefault = "300",
     .help = "pixels per inch, for sizes in mm; stored in the picture",
     .group = "View"},
    {.name = "--section",
     .value = "PLANE",
     .help =
         "cut away: z=1.2 or z>1.2 (above), y<3 (before), storey=NAME+1.1 (above 1.1 m over its floor), or A,B,C,D; "
         "metres from the lower corner; z=0..6 moves in films and with --frames",
     .group = "Cut",
     .mayRepeat = true},
    {.name = "--cut", .group = "Cut", .like = "/passes/*/cut"},
    {.name = "--lens",
     .value = "REGION",
     .help = "S-Lens: in this region the model is cut by --section, the rest is the context",
     .group = "Illustrate",
     .excludes = "--highlight|--cutaway"},
    {.name = "--highlight",
     .value = "QUERY",
     .help = "light the selected, whatever stands in front; the rest is the context",
     .group = "Illustrate",
     .excludes = "--lens|--cutaway",
     .mayRepeat = true},
    {.name = "--cutaway",
     .value = "QUERY",
     .help = "take away what hides the selected, and no more than that",
     .group = "Illustrate",
     .excludes = "--lens|--highlight"},
    {.name = "--context",
     .choices = choicesOf<illustrate::Context>(),
     .byDefault = "ghost",
     .help = "what is around a lens or highlight",
     .group = "Illustrate"},
    {.name = "--context-level",
     .help = "level of detail of what is around a lens, highlight or cutaway, 0 is the finest",
     .group = "Illustrate",
     .like = "/passes/*/level"},
    {.name = "--inset",
     .value = "QUERY",
     .help = "draw what the query selects once more, larger, in a corner, with a frame that shows where",
     .group = "Illustrate",
     .mayRepeat = true},
    {.name = "--with",
     .value = "F.svt",
     .help =
         "another volume of the model, such as a flat at a finer spacing, drawn in place of what it has of the first",
     .group = "Illustrate",
     .mayRepeat = true,
     .file = FileUse::OtherInput},
    {.name = "--cells", .kind = Flag, .group = "Illustrate", .like = "/passes/*/cells"},
    {.name = "--owners",
     .value = "T.csv",
     .help = "who owns what, for --color-by owner: a table of feature and owner",
     .group = "Illustrate",
     .file = FileUse::OtherInput},
    {.name = "--wireframe",
     .value = "QUERY",
     .help =
         "draw the edges of what the query selects, at their depth inside the volume; without a query: of all that is "
         "visible",
     .group = "Lines",
     .leastCount = 0},
    {.name = "--hidden-lines", .group = "Lines", .like = "/passes/*/lines/*/hidden"},
    {.name = "--wire-width", .help = "width of the edges", .group = "Lines", .like = "/passes/*/lines/*/width"},
    {.name = "--wire-color", .group = "Lines", .like = "/passes/*/lines/*/color"},
    {.name = "--color",
     .value = "QUERY:COLOR",
     .help = "colour by query, such as 'name=\"Unterzug-1\":red'",
     .group = "Style",
     .mayRepeat = true},
    {.name = "--opacity",
     .value = "QUERY:VALUE",
     .help = "share of light stopped by 1 m, 0 to 1, by query",
     .group = "Style",
     .mayRepeat = true},
    {.name = "--hatch-of",
     .value = "QUERY:HATCH",
     .help =
         "hatch by query: masonry, concrete, reinforced-concrete, timber, insulation, earth, steel, glass, general or "
         "none",
     .group = "Style",
     .mayRepeat = true},
    {.name = "--level", .group = "Style", .like = "/passes/*/level", .excludes = "--gl"},
    {.name = "--scene",
     .value = "S.scene.json",
     .help = "scene file; the other options change it",
     .group = "Scene",
     .file = FileUse::OtherInput},
    {.name = "--write-scene",
     .value = "S.scene.json",
     .help = "also write the scene that these options make",
     .group = "Scene",
     .file = FileUse::Output,
     .formats = "scene"},
    {.name = "--frames",
     .kind = Whole,
     .least = 1,
     .most = 10000,
     .byDefault = "1",
     .help = "number of pictures P_0000.png, ... of a section that moves, or of the scene's motion",
     .group = "Motion"},
    {.name = "--gl",
     .kind = Flag,
     .help = "draw by OpenGL ES 3.0, the finest level; needs a driver, but no display",
     .group = "Output",
     .excludes = "--level"},
    {.name = "--labels",
     .value = "L.png",
     .help = "also write the scalar of each pixel, 16-bit gray",
     .group = "Output",
     .file = FileUse::Output,
     .formats = "png",
     .numberedBy = "--frames"},
    {.name = "--depth",
     .value = "D.png",
     .help = "also write the depth of each pixel in millimetres, 16-bit gray",
     .group = "Output",
     .file = FileUse::Output,
     .formats = "png",
     .numberedBy = "--frames"},
};

// section

constexpr Option kSection[] = {
    kModelInput[0],
    {.name = "-o,--output",
     .value = "D.svg",
     .help = "the drawing to write: .svg, .pdf, .dxf or .geojson",
     .mayRepeat = true,
     .file = FileUse::Output,
     .formats = "svg|pdf|dxf|geojson"},
    {.name = "--plane",
     .value = "PLANE",
     .otherwise = "1.1 m above the floor of the lowest storey, or the middle",
     .help = "z=1.2, y<3, x>4, z=abs(112.3) in the CRS, storey=NAME+1.1 (1.1 m over its floor), or A,B,C,D; metres "
             "from the lower corner",
     .group = "Drawing"},
    {.name = "--elevation",
     .choices = "north|east|south|west",
     .help = "the outside, seen from there: what stands behind a plane before the model",
     .group = "Drawing"},
    {.name = "--beyond", .kind = Flag, .help = "also draw what is seen behind the plane", .group = "Drawing"},
    {.name = "--hidden",
     .kind = Flag,
     .help = "also draw the edges behind it that are hidden, dashed",
     .group = "Drawing"},
    {.name = "--above",
     .kind = Flag,
     .help = "also draw what is cut away, as seen from the plane, dashed and dotted",
     .group = "Drawing"},
    {.name = "--dimensions",
     .kind = Flag,
     .help = "plans: chains of dimensions around the building: openings, rooms, overall",
     .group = "Drawing"},
    {.name = "--iso-layers", .kind = Flag, .help = "DXF: names of layers after ISO 13567", .group = "Drawing"},
    {.name = "--world",
     .kind = Flag,
     .help = "DXF: coordinates of the model's CRS; upright drawings stand in space",
     .group = "Drawing"},
    {.name = "--scale",
     .value = "1:N",
     .byDefault = "1:100",
     .help = "scale of the SVG: 1:50 draws 1 m as 20 mm",
     .group = "Drawing"},
    {.name = "--hide",
     .value = "QUERY",
     .help = "leave out what the query selects",
     .group = "Drawing",
     .mayRepeat = true},
    {.name = "--show",
     .value = "QUERY",
     .help = "draw only what the query selects",
     .group = "Drawing",
     .mayRepeat = true},
    {.name = "--no-rooms", .kind = Flag, .help = "leave out rooms, units and storeys", .group = "Drawing"},
    {.name = "--min-area",
     .kind = Number,
     .unit = "m2",
     .least = 0,
     .most = 1e9,
     .byDefault = "0.0001",
     .help = "leave out polygons smaller than this",
     .group = "Drawing"},
    {.name = "--table",
     .value = "T.csv",
     .help = "areas per component and class: .json or .csv",
     .group = "Output",
     .mayRepeat = true,
     .file = FileUse::Output,
     .formats = "json|csv"},
    {.name = "--json", .kind = Flag, .help = "print the areas as JSON on stdout", .group = "Output"},
};

// query

constexpr Option kQuery[] = {
    kModelInput[0],
    {.name = "query", .value = "QUERY", .help = "such as 'class=BuildingRoom and volume>20'", .isRequired = true},
    {.name = "--with",
     .value = "LIST",
     .help = "more columns, any of volume (by voxels), surface (m2) and box, such as volume,surface",
     .group = "Report"},
    {.name = "--neighbours",
     .kind = Flag,
     .help = "what each feature touches, with the shared area",
     .group = "Report"},
    {.name = "--along",
     .value = "X,Y,Z:DX,DY,DZ",
     .help = "what lies along a ray: a point in metres from the lower corner, and a direction",
     .group = "Report"},
    {.name = "--overlaps", .kind = Flag, .help = "space that two features claim", .group = "Report"},
    {.name = "--gaps", .kind = Flag, .help = "enclosed air that belongs to no feature", .group = "Report"},
    {.name = "--areas",
     .kind = Flag,
     .help = "rooms with area, height and volume, then floor areas after DIN 277-1 of each storey and in all",
     .group = "Report"},
    {.name = "--owners",
     .value = "T.csv",
     .help = "who owns what: a table of feature and owner; walls between owners are divided",
     .group = "Report",
     .file = FileUse::OtherInput},
    {.name = "--parcels",
     .value = "FILE",
     .help = "how much of each feature lies in which parcel: a volume on the same grid, or a model",
     .group = "Report",
     .file = FileUse::ModelOrVolume},
    {.name = "-o,--output",
     .value = "FILE",
     .help = "write rows with outline, height, volume and attributes: .csv, .geojson, .gpkg or .parquet",
     .group = "Features",
     .file = FileUse::Output,
     .formats = "csv|geojson|gpkg|objectparquet"},
    {.name = "--box",
     .kind = Number,
     .value = "X0,Y0,Z0,X1,Y1,Z1",
     .unit = "metres",
     .help = "only features whose box meets this box of world coordinates",
     .group = "Features",
     .count = 6,
     .leastCount = 6},
    {.name = "--by",
     .value = "KEYS",
     .help = "sums of m3 and m2 by attributes or class, such as function,district",
     .group = "Features"},
    {.name = "--cut",
     .value = "PLANE",
     .help = "only features that a plane cuts, such as 'z=abs(120)' (metres above datum)",
     .group = "Features"},
    {.name = "--sort", .choices = "volume|area|height", .help = "the largest first", .group = "Features"},
    {.name = "--first",
     .kind = Whole,
     .least = 1,
     .most = 1000000,
     .otherwise = "all; 100 with --sort",
     .help = "only so many",
     .group = "Features"},
    {.name = "--leaks",
     .kind = Flag,
     .help = "only solids whose shell has holes in the model, which were closed or filled all the same",
     .group = "Features"},
    {.name = "--json", .kind = Flag, .help = "print rows as JSON on stdout", .group = "Output"},
    {.name = "--csv", .kind = Flag, .help = "print rows as CSV on stdout", .group = "Output"},
};

// shell, convert

// Stands for the table writers::volumeFormats(), from which names and help are made.
constexpr std::string_view kVolumeFormats = "volume formats";

constexpr Option kFaces = {
    .name = "--faces",
    .choices = "planes|voxels",
    .byDefault = "planes",
    .help = "slopes of a .glb: planes (flat, as far as the volume knows them) or voxels (stairs)",
    .group = "Output"};
constexpr Option kShell[] = {
    kModelInput[0],
    {.name = "-o,--output",
     .value = "FILE",
     .help = "what to write; the extension selects the format: .svt (volume) or .glb (triangles)",
     .file = FileUse::Output,
     .formats = "svt|glb"},
    {.name = "--level",
     .choices = "component|room|unit|storey|building",
     .byDefault = "building",
     .help = "whose hull stays",
     .group = "Shell"},
    {.name = "--of",
     .value = "QUERY",
     .help = "only the groups that have something of what the query selects",
     .group = "Shell"},
    {.name = "--thickness",
     .kind = Number,
     .value = "M",
     .least = 0,
     .otherwise = "two voxels",
     .help = "thickness of the hull in metres, rounded up to voxels",
     .group = "Shell"},
    {.name = "--labels",
     .choices = "components|groups",
     .byDefault = "components",
     .help = "whose label the voxels keep: that of their component, or one per group",
     .group = "Shell"},
    kFaces,
    {.name = "--levels",
     .kind = Flag,
     .help = "list which levels the model has, as --level names them, and write nothing",
     .group = "Output"},
    kBuildOutput[1],
};
constexpr Option kConvert[] = {
    kModelInput[0],
    {.name = "output",
     .value = "FILE",
     .help = kVolumeFormats,
     .isRequired = true,
     .file = FileUse::Output,
     .formats = kVolumeFormats},
    {.name = "--select",
     .value = "QUERY",
     .help = "only the voxels of what the query selects; the rest becomes background",
     .group = "Part"},
    {.name = "--box",
     .kind = Number,
     .value = "X0,Y0,Z0,X1,Y1,Z1",
     .unit = "metres",
     .help = "only the samples in this box of world coordinates",
     .group = "Part",
     .count = 6,
     .leastCount = 6},
    {.name = "--level",
     .kind = Whole,
     .least = 0,
     .most = 6,
     .byDefault = "0",
     .help = "coarser by 2^level along each axis: a cell has the label that fills most of it",
     .group = "Part"},
    {.name = "--encoding",
     .choices = "gzip|raw",
     .byDefault = "gzip",
     .help = "samples of NRRD, VTI and TIFF: compressed or raw",
     .group = "Output"},
    {.name = "--texture",
     .choices = "pixel|image|composed|atlas",
     .byDefault = "pixel",
     .help = "samples of X3D and of CityGML: pixel (numbers in the document), image (an NRRD beside it) or composed "
             "(PNG slices beside it); of X3D also atlas (one PNG of colours beside it, as X3DOM shows volumes)",
     .group = "Output"},
    {.name = "--model",
     .value = "FILE",
     .otherwise = "the input, where that is CityGML",
     .help = "of an .ade.gml: the CityGML that the volume was built from, which is kept as it is",
     .group = "Output",
     .file = FileUse::OtherInput},
    {.name = "--citygml",
     .choices = "2.0|3.0",
     .otherwise = "that of the model; 3.0 without one",
     .help = "of an .ade.gml: the version of CityGML",
     .group = "Output"},
    {.name = "--zarr",
     .choices = "2|3",
     .byDefault = "2",
     .help = "of a .zarr: 2 (OME-NGFF 0.4) or 3 (OME-NGFF 0.5, sharded)",
     .group = "Output"},
    {.name = "--meshes",
     .kind = Flag,
     .help = "of a .precomputed: also the surface of each label, for the 3D view",
     .group = "Output"},
    {.name = "--sharded",
     .kind = Flag,
     .help = "of a .precomputed: up to 64 chunks in a file, packed; the web server has to answer requests for ranges",
     .group = "Output"},
    {.name = "--place",
     .kind = Number,
     .value = "LAT,LON,HEIGHT",
     .unit = "degrees and metres",
     .otherwise = "that of the CRS",
     .help = "of a .3dtiles: where on the globe the lower corner is",
     .group = "Output",
     .count = 3,
     .leastCount = 3},
    {.name = "--lift",
     .kind = Number,
     .value = "M",
     .byDefault = "0",
     .help = "of a .3dtiles: metres added to heights, such as the height of the geoid where they are over the sea",
     .group = "Output"},
    {.name = "--voxels",
     .kind = Flag,
     .help = "of a .3dtiles: voxels by draft extensions, as Cesium has them for trial, not surfaces",
     .group = "Output"},
    {.name = "--level-sets",
     .kind = Flag,
     .help = "of a .vdb: each class as signed distances to its surface, three voxels to both sides, not as a mask",
     .group = "Output"},
    {.name = "--max-voxels",
     .kind = Whole,
     .least = 1,
     .most = 1e12,
     .byDefault = "16777216",
     .help = "most samples that a document is to hold as numbers, most voxels of a .vox",
     .group = "Output"},
    {.name = "--merge",
     .choices = "label|class|material",
     .byDefault = "label",
     .help = "of an .fds and of lists of boxes: what becomes boxes together",
     .group = "Output"},
    {.name = "--max-boxes",
     .kind = Whole,
     .least = 1,
     .most = 1e8,
     .byDefault = "1000000",
     .help = "of an .fds and of lists of boxes: more are refused",
     .group = "Output"},
    {.name = "--holes",
     .value = "QUERY",
     .help = "of an .fds: components that are open, such as doors",
     .group = "Output"},
    {.name = "--vents",
     .value = "QUERY",
     .help = "of an .fds: components with a vent on both sides, such as windows",
     .group = "Output"},
    kFaces,
};

// serve, view, publish

constexpr Option kServe[] = {
    {.name = "input",
     .value = "FILE",
     .help = "what the page opens: .svt or model files",
     .mayRepeat = true,
     .file = FileUse::ModelOrVolume},
    {.name = "--port",
     .kind = Whole,
     .least = 0,
     .most = 65535,
     .otherwise = "8080, or the next free one",
     .help = "port to listen at; 0: any that is free",
     .group = "Server"},
    {.name = "--host",
     .value = "ADDRESS",
     .byDefault = "127.0.0.1",
     .help = "address to listen at; others than 127.0.0.1 let other machines in, without password",
     .group = "Server"},
    {.name = "--allow-host",
     .value = "NAME",
     .help = "a further name by which browsers may call this server",
     .group = "Server",
     .mayRepeat = true},
    {.name = "--allow-uploads", .kind = Flag, .help = "convert models that the page sends", .group = "Uploads"},
    {.name = "--max-upload",
     .kind = Whole,
     .unit = "MB",
     .least = 1,
     .most = 1048576,
     .byDefault = "200",
     .help = "largest model that may be sent",
     .group = "Uploads"},
    {.name = "--convert-memory",
     .kind = Whole,
     .unit = "MB",
     .least = 64,
     .most = 1048576,
     .byDefault = "2048",
     .help = "memory that a conversion may use",
     .group = "Uploads"},
    {.name = "--convert-seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.1,
     .most = 86400,
     .byDefault = "120",
     .help = "time that a conversion may take",
     .group = "Uploads"},
};
constexpr Option kView[] = {
    kSiteInputs[0],
    {.name = "--no-browser", .kind = Flag, .help = "print the address, start no browser", .group = "Page"},
};
constexpr Option kPublish[] = {
    kSiteInputs[0],
    {.name = "-o,--output",
     .value = "DIR",
     .help = "the folder to write",
     .isRequired = true,
     .file = FileUse::OutputFolder},
    {.name = "--force", .kind = Flag, .help = "write into a folder that is not empty; what is not of the page stays"},
    {.name = "--url",
     .value = "URL",
     .help = "where the page will be, such as https://example.org/house/, for previews of links to it"},
};
constexpr Option kPage[] = {
    {.name = "--viewer",
     .value = "DIR",
     .otherwise = "share/svt/viewer beside the program's folder",
     .help = "folder of the page",
     .group = "Page",
     .file = FileUse::InputFolder},
    {.name = "-v,--verbose", .kind = Flag, .help = "show all findings", .group = "Page", .excludes = "--quiet"},
};

// sheets

constexpr Option kSheets[] = {
    kModelInput[0],
    {.name = "-o,--output",
     .value = "P.pdf",
     .help = "the sheets as one PDF, or the views as one GeoPackage (.gpkg)",
     .file = FileUse::Output,
     .formats = "pdf|gpkg"},
    {.name = "--svg", .value = "DIR", .help = "also write each sheet as sheet-N.svg", .file = FileUse::OutputFolder},
    {.name = "--dxf",
     .value = "DIR",
     .help = "also write each view as NAME.dxf, in metres",
     .file = FileUse::OutputFolder},
    {.name = "--from",
     .value = "S.sheets.json",
     .help = "which views stand on which sheets; the other options change it",
     .group = "Sheets",
     .file = FileUse::OtherInput},
    {.name = "--write-sheets",
     .value = "S.sheets.json",
     .help = "also write which views stand on which sheets",
     .group = "Sheets",
     .file = FileUse::Output,
     .formats = "sheets"},
    {.name = "--scale",
     .value = "1:N",
     .otherwise = "1:100, or the next of 1:200, 1:500, ... at which all views fit",
     .help = "scale of all views: 1:50 draws 1 m as 20 mm",
     .group = "Sheets"},
    {.name = "--paper",
     .choices = "A4|A3|A2|A1|A0",
     .otherwise = "A3",
     .help = "size of a sheet, landscape",
     .group = "Sheets"},
    {.name = "--hide",
     .value = "QUERY",
     .help = "leave out what the query selects",
     .group = "Sheets",
     .mayRepeat = true},
    {.name = "--iso-layers", .kind = Flag, .help = "DXF: names of layers after ISO 13567", .group = "Sheets"},
    {.name = "--world",
     .kind = Flag,
     .help = "DXF: coordinates of the model's CRS; upright drawings stand in space",
     .group = "Sheets"},
    {.name = "--no-above", .kind = Flag, .help = "plans without what is above the cut", .group = "Sheets"},
    {.name = "--no-dimensions", .kind = Flag, .help = "plans without chains of dimensions", .group = "Sheets"},
    {.name = "--no-tables", .kind = Flag, .help = "no tables of rooms, floor areas and components", .group = "Sheets"},
    {.name = "--language", .choices = "en|de", .otherwise = "en", .help = "of the words on sheets", .group = "Sheets"},
    {.name = "--verbose", .kind = Flag, .help = "show all findings", .group = "Output"},
};

// city-...

// Stands for the endings readers::modelEndings(), from which the help is made.
constexpr std::string_view kModelFiles = "model files";

constexpr Option kCityFolder[] = {
    {.name = "folder",
     .value = "DIR",
     .help = "the folder of the city",
     .isRequired = true,
     .file = FileUse::InputFolder},
};
constexpr Option kCityPlan[] = {
    {.name = "input",
     .value = "FILE",
     .help = kModelFiles,
     .isRequired = true,
     .mayRepeat = true,
     .file = FileUse::Model},
    {.name = "-o,--output",
     .value = "DIR",
     .help = "the folder of the city",
     .isRequired = true,
     .file = FileUse::OutputFolder},
    {.name = "--spacing",
     .kind = Number,
     .unit = "metres",
     .least = 0.001,
     .most = 100,
     .byDefault = "0.5",
     .help = "distance of samples of the finest level",
     .group = "Grid"},
    kModel[0],
    kModel[2],
    kModel[5],
    {.name = "--tasks",
     .kind = Whole,
     .least = 1,
     .most = 1000000,
     .otherwise = "some 5 minutes each, at most 1000",
     .help = "number of tasks that a cluster is to run; the city does not depend on it",
     .group = "Work"},
    {.name = "--pack-seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.01,
     .most = 3600,
     .byDefault = "10",
     .help = "expected work in a pack, the smallest part that is built, proven and built again",
     .group = "Work"},
    {.name = "--update",
     .kind = Flag,
     .help = "the folder has a plan: say which tiles change, and keep packs whose content stays",
     .group = "Work"},
};
constexpr Option kCityLimits[] = {
    {.name = "--tile-seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.1,
     .most = 1000000,
     .byDefault = "120",
     .help = "what a tile may take before its features are tried one by one",
     .group = "Limits"},
    {.name = "--feature-seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.1,
     .most = 1000000,
     .byDefault = "20",
     .help = "what a feature may take that is tried alone; beyond, it is left out",
     .group = "Limits"},
};
constexpr Option kCityRun[] = {
    {.name = "options",
     .value = "OPTION",
     .help =
         "after --: with slurm, options of sbatch, such as --partition=batch; with kubernetes, image=, claim=, mount=, "
         "namespace=, cpu=, memory=, parallelism=",
     .mayRepeat = true},
    {.name = "--engine",
     .choices = "local|slurm|kubernetes",
     .byDefault = "local",
     .help = "where: on this machine; as a job array of Slurm; as an Indexed Job of Kubernetes, which is printed",
     .group = "Work"},
    {.name = "--print", .kind = Flag, .help = "print what would be submitted, and do nothing", .group = "Work"},
    {.name = "--jobs",
     .kind = Whole,
     .least = 0,
     .most = 1024,
     .otherwise = "one for each core",
     .help = "packs that are built at a time; the city does not depend on it",
     .group = "Work"},
};
constexpr Option kCityTask[] = {
    {.name = "task", .kind = Whole, .least = 0, .help = "number of the task, from 0", .isRequired = true},
    {.name = "--of",
     .kind = Whole,
     .least = 1,
     .otherwise = "that of the plan",
     .help = "number of tasks; each builds its share of the packs",
     .group = "Work"},
    {.name = "--threads",
     .kind = Whole,
     .least = 0,
     .most = 1024,
     .byDefault = "1",
     .help = "number of threads, 0 for all cores; the result does not depend on it",
     .group = "Work"},
};
constexpr Option kCityStatus[] = {
    kInfoOutput[0],
    {.name = "--proven",
     .kind = Flag,
     .help = "read all packs and compare their SHA-256 with the reports, not their sizes alone"},
};
constexpr Option kCityInfo[] = {kInfoOutput[0]};
constexpr Option kCityExtract[] = {
    {.name = "-o,--output",
     .value = "F.svt",
     .help = "the volume to write",
     .isRequired = true,
     .file = FileUse::Output,
     .formats = "svt"},
    {.name = "--tile",
     .value = "L/X/Y",
     .help = "a whole tile, such as 9/754/11352",
     .group = "Part",
     .mayRepeat = true},
    {.name = "--id", .value = "ID", .help = "a building by its id", .group = "Part", .mayRepeat = true},
    {.name = "--box",
     .kind = Number,
     .value = "X,Y,Z,X,Y,Z",
     .unit = "metres",
     .help = "lower and upper corner in the CRS of the city",
     .group = "Part",
     .count = 6,
     .leastCount = 6},
    {.name = "--detail",
     .kind = Whole,
     .least = 0,
     .most = 26,
     .byDefault = "0",
     .help = "0: all labels; 1: one label a building, at twice the spacing; 2: one label a class, at four times; 3 and "
             "up: mixtures of classes, each at twice the spacing of the one before",
     .group = "Part"},
};

// doctor, describe

constexpr Option kDoctor[] = {kInfoOutput[0]};
constexpr Option kDescribe[] = {
    {.name = "what",
     .choices = "json|man|bash|zsh|fish",
     .help = "json: all commands and options; man: a manual page; bash, zsh, fish: completions for that shell",
     .isRequired = true},
    {.name = "command", .otherwise = "the page of svt itself", .help = "with man: the command whose page is printed"},
};

// "nrrd|glb|..."; kept for the time of the program, as options refer to it.
std::string_view volumeFormatNames() {
    static const std::string kNames = [] {
        std::string names;
        for (const writers::VolumeFormat& format : writers::volumeFormats())
            names += fmt::format("{}{}", names.empty() ? "" : "|", format.name);
        return names + "|geojson|gpkg";  // features one by one: writers::FeatureLayer
    }();
    return kNames;
}

std::string_view volumeFormatHelp() {
    static const std::string kHelp = [] {
        std::vector<std::string_view> endings;
        for (const writers::VolumeFormat& format : writers::volumeFormats())
            for (const std::string_view ending : splitChoices(format.endings)) endings.push_back(ending);
        endings.insert(endings.end(), {".geojson", ".gpkg"});
        return fmt::format("file to write; the extension selects the format: {}", fmt::join(endings, ", "));
    }();
    return kHelp;
}

std::string_view modelFilesHelp() {
    static const std::string kHelp = fmt::format("model files ({}, each also with .gz), and folders with such files",
                                                 fmt::join(readers::modelEndings(), ", "));
    return kHelp;
}

}  // namespace

std::span<const CommandText> commandTexts() {
    static const CommandText kCommands[] = {
        {"sample", "Write a generated model: a house, a tower of flats, a district", {kSample, kQuiet}},
        {"sample-city", "Write a generated city: many buildings in many files", {kSampleCity, kThreads, kQuiet}},
        {"build",
         "Make a volume (.svt) of one or more model files",
         {kBuild, kGrid, kGridOf, kModel, kMemory, kStyle, kVoxels, kBuildOutput, kQuiet, kVerbose}},
        {"info",
         "Show what is inside a volume or model",
         {kModelInput, kGrid, kModel, kMemory, kStyle, kVoxels, kInfoOutput, kQuiet}},
        {"check",
         "Test a model: open shells, dangling links, bad faces; exit 4 where something is wrong",
         {kCheck, kMemory, kQuiet, kVerbose}},
        {"render",
         "Draw pictures of a volume or model: PNG, films, lines as SVG and PDF",
         {kRender, kQuiet, kVerbose, kStyle, kGrid, kModel, kMemory, kVoxels},
         true},
        {"section",
         "Draw what a plane cuts (SVG, PDF, DXF, GeoJSON)",
         {kSection, kQuiet, kVerbose, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"sheets",
         "Draw plans, sections and elevations on sheets of paper (PDF, SVG)",
         {kSheets, kQuiet, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"query",
         "List the features that a query selects, and what is around them",
         {kQuery, kQuiet, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"shell",
         "Leave only the hull of rooms, flats, storeys or buildings",
         {kShell, kQuiet, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"convert", "Write a volume in another format", {kConvert, kQuiet, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"serve",
         "Show models in the browser, from this machine",
         {kServe, kQuiet, kPage, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"view", "Open models in the browser", {kView, kQuiet, kPage, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"publish",
         "Write the viewer with models as a folder for any web server",
         {kPublish, kQuiet, kPage, kGrid, kModel, kMemory, kStyle, kVoxels}},
        {"city-plan",
         "Plan a city of many files: which features make which tiles",
         {kCityPlan, kThreads, kQuiet, kVerbose}},
        {"city-run",
         "Build all of a city that is not built yet, and merge it",
         {kCityFolder, kCityRun, kCityLimits, kQuiet}},
        {"city-task", "Build one task's share of a city", {kCityFolder, kCityTask, kCityLimits, kQuiet}},
        {"city-status", "Say what of a city is built, and how to go on", {kCityFolder, kCityStatus, kQuiet}},
        {"city-merge", "Make the index of a city of all that is built", {kCityFolder, kQuiet}},
        {"city-info", "Show what is inside a city", {kCityFolder, kCityInfo, kQuiet}},
        {"city-extract", "Write a part of a city as a volume (.svt)", {kCityFolder, kCityExtract, kQuiet}},
        {"doctor", "Say what of this machine can be used, and what to do about what is missing", {kDoctor}},
        {"describe", "Print what the command offers, for other programs", {kDescribe}},
    };
    return kCommands;
}

namespace {

// Gives an option all that it does not say itself from a member of a scene.
void fillFrom(Option& option, const Option& member) {
    const auto fill = [](auto& own, const auto& other, bool isOwn) {
        if (!isOwn) own = other;
    };
    fill(option.kind, member.kind, option.kind != Text);
    fill(option.value, member.value, !option.value.empty());
    fill(option.help, member.help, !option.help.empty());
    fill(option.choices, member.choices, !option.choices.empty());
    if (option.kind != Flag) fill(option.byDefault, member.byDefault, !option.byDefault.empty());
    fill(option.otherwise, member.otherwise, !option.otherwise.empty());
    option.unit = member.unit;
    option.least = member.least;
    option.most = member.most;
    option.count = member.count;
    option.leastCount = member.leastCount;
    option.mayRepeat = member.mayRepeat;
}

// The options that set a member of a scene, each before the first option of its group.
void addSceneOptions(std::vector<Option>& options) {
    for (const Option& member : illustrate::sceneMembers()) {
        if (member.option.empty()) continue;
        Option option{.name = member.option, .group = member.group, .member = member.name};
        fillFrom(option, member);
        const auto isOfGroup = [&](const Option& other) { return other.group == option.group && other.member.empty(); };
        options.insert(std::ranges::find_if(options, isOfGroup), option);
    }
}

}  // namespace

std::vector<Option> optionsOf(const CommandText& command) {
    std::vector<Option> options;
    for (const auto set : command.sets)
        for (Option option : set) {
            if (!option.like.empty()) fillFrom(option, illustrate::sceneMember(option.like));
            if (option.formats == kVolumeFormats) {
                option.formats = volumeFormatNames();
                option.help = volumeFormatHelp();
            }
            if (option.help == kModelFiles) option.help = modelFilesHelp();
            options.push_back(option);
        }
    if (command.hasScene) addSceneOptions(options);
    return options;
}

std::string valueText(const Option& option) {
    if (option.kind == Flag) return {};
    if (!option.choices.empty()) return std::string(option.choices);
    if (!option.value.empty()) return std::string(option.value);
    return option.kind == Whole ? "N" : option.kind == Number ? "NUMBER" : "TEXT";
}

std::string descriptionOf(const Option& option) {
    std::string text(option.help);
    if (!option.unit.empty()) text += fmt::format(", {}", option.unit);
    // A range that is there only to keep out what no computer could draw tells people nothing.
    if (const std::string range = rangeText(option); option.choices.empty() && !range.empty() && option.most < 1e9)
        text += fmt::format(", {}", range);
    if (!option.byDefault.empty()) text += fmt::format("; default: {}", option.byDefault);
    if (!option.otherwise.empty()) text += fmt::format("; default: {}", option.otherwise);
    if (option.mayRepeat && option.name.starts_with("-")) text += "; may be repeated";
    return text;
}

}  // namespace svt::cli
