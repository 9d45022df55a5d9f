#pragma once
/// \file
/// Options that several commands have, and the placeholders that optionsOf() replaces.

#include <svt/core/option.hpp>

#include <string_view>

namespace svt::cli {

using enum OptionKind;

inline constexpr Option kModelInput[] = {{.name = "input",
                                          .value = "FILE",
                                          .help = "a .svt, a model file, or a city: its folder or address",
                                          .isRequired = true,
                                          .file = FileUse::ModelOrVolume}};
inline constexpr Option kSiteInputs[] = {{.name = "input",
                                          .value = "FILE",
                                          .help = "what the page opens: .svt, model files, folders of cities",
                                          .isRequired = true,
                                          .mayRepeat = true,
                                          .file = FileUse::ModelOrVolume}};
inline constexpr Option kGrid[] = {
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
inline constexpr Option kModel[] = {
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
     .help = "make bodies of features that have only a footprint and a height as attribute",
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
inline constexpr Option kMemory[] = {
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
inline constexpr Option kStyle[] = {
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
inline constexpr Option kVoxels[] = {
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
inline constexpr Option kQuiet[] = {
    {.name = "-q,--quiet",
     .kind = Flag,
     .help = "print errors and results only: no progress, findings, notes or summary",
     .group = "Output"},
};
inline constexpr Option kVerbose[] = {
    {.name = "-v,--verbose", .kind = Flag, .help = "show all findings", .group = "Output", .excludes = "--quiet"},
};
inline constexpr Option kThreads[] = {
    {.name = "--threads",
     .kind = Whole,
     .least = 0,
     .most = 1024,
     .otherwise = "all cores",
     .help = "number of threads; the result does not depend on it"},
};
inline constexpr Option kBuildOutput[] = {
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
inline constexpr Option kInfoOutput[] = {
    {.name = "--json", .kind = Flag, .help = "print everything as JSON on stdout", .group = "Output"},
    {.name = "--tree", .kind = Flag, .help = "print the tree of features", .group = "Output"},
};
/// Stands for the table writers::volumeFormats(), from which names and help are made.
inline constexpr std::string_view kVolumeFormats = "volume formats";
inline constexpr Option kFaces = {
    .name = "--faces",
    .choices = "planes|voxels",
    .byDefault = "planes",
    .help = "slopes of a .glb: planes (flat, as far as the volume knows them) or voxels (stairs)",
    .group = "Output"};
inline constexpr Option kPage[] = {
    {.name = "--viewer",
     .value = "DIR",
     .otherwise = "share/svt/viewer beside the program's folder",
     .help = "folder of the page",
     .group = "Page",
     .file = FileUse::InputFolder},
    {.name = "-v,--verbose", .kind = Flag, .help = "show all findings", .group = "Page", .excludes = "--quiet"},
};
/// Stands for the endings readers::modelEndings(), from which the help is made.
inline constexpr std::string_view kModelFiles = "model files";
inline constexpr Option kCityFolder[] = {
    {.name = "folder",
     .value = "DIR",
     .help = "the folder of the city",
     .isRequired = true,
     .file = FileUse::InputFolder},
};

}  // namespace svt::cli
