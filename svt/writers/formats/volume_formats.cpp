#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/ade/ade_writer.hpp>
#include <svt/writers/hulls/hull_writer.hpp>
#include <svt/writers/indoorgml/indoorgml_writer.hpp>
#include <svt/writers/nifti/nifti_writer.hpp>
#include <svt/writers/nrrd_writer.hpp>
#include <svt/writers/precomputed/precomputed_writer.hpp>
#include <svt/writers/simulation/adjacency_graph.hpp>
#include <svt/writers/simulation/box_list.hpp>
#include <svt/writers/simulation/fds_writer.hpp>
#include <svt/writers/tables/table_writer.hpp>
#include <svt/writers/tiff/tiff_writer.hpp>
#include <svt/writers/tiles3d/tileset_writer.hpp>
#include <svt/writers/usd/usd_writer.hpp>
#include <svt/writers/vdb/vdb_writer.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/vox/vox_writer.hpp>
#include <svt/writers/vtk/vti_writer.hpp>
#include <svt/writers/vtk/vtm_writer.hpp>
#include <svt/writers/x3d/x3d_writer.hpp>
#include <svt/writers/zarr/zarr_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace svt::writers {
namespace {

using volume::SemanticVolume;
using Path = std::filesystem::path;
using Written = Result<std::uint64_t>;

Written writeAnyNrrd(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options,
                     bool hasSegments) {
    return writeNrrd(volume, path,
                     {options.isCompressed ? NrrdEncoding::Gzip : NrrdEncoding::Raw, options.threads, options.progress,
                      hasSegments});
}

DenseOptions denseOptions(const VolumeWriteOptions& options) {
    return {options.isCompressed, options.threads, options.progress};
}

Written asNrrd(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeAnyNrrd(volume, path, options, false);
}
Written asSegNrrd(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeAnyNrrd(volume, path, options, true);
}
Written asGlb(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    GlbOptions glb;
    glb.faces = options.faces;
    glb.threads = options.threads;
    glb.progress = options.progress;
    const auto report = writeGlb(volume, path, glb);
    if (!report) return report.error();
    return report->bytes;
}
Written asVti(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeVti(volume, path, denseOptions(options));
}
Written asNifti(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeNifti(volume, path, denseOptions(options));
}
Written asTiff(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeTiff(volume, path, TiffMetadata::ImageJ, denseOptions(options));
}
Written asOmeTiff(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeTiff(volume, path, TiffMetadata::Ome, denseOptions(options));
}
Written asX3d(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeX3d(volume, path, options.texture, options.maxVoxels, denseOptions(options));
}
Written asAde(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeAde(volume, path, options);
}
Written asZarr(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeZarr(volume, path, options.zarrVersion, denseOptions(options));
}
Written asPrecomputed(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writePrecomputed(volume, path, options);
}
Written asObj(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeHulls(volume, path, HullFormat::Obj, options);
}
Written asPly(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeHulls(volume, path, HullFormat::Ply, options);
}
Written asStl(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeHulls(volume, path, HullFormat::Stl, options);
}
Written asTileset(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeTileset(volume, path, options);
}
Written asObjects(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeFileAtomically(path, makeCsv(makeObjectTable(volume, options.threads)));
}
Written asContacts(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeFileAtomically(path, makeCsv(makeContactTable(volume, options.threads)));
}
Written writeAnyParquet(const Table& table, const Path& path) {
    const auto bytes = makeParquet(table);
    if (!bytes) return bytes.error();
    return writeFileAtomically(path, *bytes);
}
Written asObjectParquet(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeAnyParquet(makeObjectTable(volume, options.threads), path);
}
Written asContactParquet(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeAnyParquet(makeContactTable(volume, options.threads), path);
}
Written asVtm(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeVtm(volume, path, denseOptions(options));
}
Written asVdb(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeVdb(volume, path, denseOptions(options), options.hasLevelSets);
}
Written asUsd(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeUsd(volume, path, options);
}
Written asVox(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeVox(volume, path, options);
}

Written asFds(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    const auto document = makeFds(volume, path.stem().string(), options);
    if (!document) return document.error();
    return writeFileAtomically(path, *document);
}
Written asBoxTable(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    const auto table = makeBoxTable(volume, options);
    if (!table) return table.error();
    return writeFileAtomically(path, *table);
}
Written asBoxJson(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    const auto json = makeBoxJson(volume, options);
    if (!json) return json.error();
    return writeFileAtomically(path, *json);
}
Written asAdjacency(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeFileAtomically(path, makeAdjacencyJson(volume, options.threads));
}
Written asGraphMl(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    return writeFileAtomically(path, makeGraphMl(volume, options.threads));
}

Written asIndoorGml(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    const auto document = makeIndoorGml(volume, options);
    if (!document) return document.error();
    return writeFileAtomically(path, *document);
}

constexpr VolumeFormat kVolumeFormats[] = {
    {"nrrd", ".nrrd", "NRRD: samples, with the table of labels as keys", "VTK, ITK, 3D Slicer, teem, MATLAB, pynrrd",
     true},
    {"glb", ".glb", "binary glTF 2.0: the surface of each label as triangles", "Blender, Windows, three.js, Cesium"},
    {"segnrrd", ".seg.nrrd", "NRRD as a segmentation: a segment per label, with name, colour, class", "3D Slicer",
     true},
    {"vti", ".vti", "VTK image data: a cell per voxel, the table of labels as field data", "ParaView, VTK, PyVista",
     true},
    {"vtm", ".vtm", "VTK multi-block data: all levels, each a .vti beside it", "ParaView, VTK", true},
    {"nifti", ".nii", "NIfTI-1, or NIfTI-2 where coordinates need it", "nibabel, ITK, 3D Slicer, FSL, SPM", true},
    {"niftigz", ".nii.gz", "the same, compressed", "nibabel, ITK, 3D Slicer, FSL, SPM", true},
    {"tiff", ".tif|.tiff", "TIFF stack: a page per slice, with ImageJ's metadata",
     "Fiji/ImageJ, tifffile, napari, GDAL", true},
    {"ometiff", ".ome.tif|.ome.tiff", "TIFF stack with OME-XML", "Bio-Formats, tifffile, napari, QuPath", true},
    {"zarr", ".zarr", "Zarr v2 or v3 with OME-NGFF: a folder with all levels, colours and names",
     "zarr-python, zarrita, napari, neuroglancer, vizarr", true},
    {"precomputed", ".precomputed",
     "neuroglancer's precomputed segmentation: a folder with all levels, names and colours",
     "neuroglancer, CloudVolume", true},
    {"vdb", ".vdb", "OpenVDB: a grid of labels, a fog volume or level set for each class",
     "Blender, Houdini, Maya, Unreal, OpenVDB", true},
    {"vox", ".vox", "MagicaVoxel: voxels, a group for each label", "MagicaVoxel, Blender, Goxel, Unity, Godot", true},
    {"x3d", ".x3d", "X3D 4.0: a 3D texture as SegmentedVolumeData, with transfer function and features",
     "X_ITE, Castle, InstantReality; X3DOM by --texture atlas", true},
    {"ade", ".ade.gml", "CityGML 2.0 or 3.0: the model with the volume in it, by an application domain extension",
     "svt build; any CityGML reader sees the model", true},
    {"obj", ".obj", "Wavefront OBJ: an object per label, colours in an .mtl beside it", "Blender, MeshLab, CAD, VTK"},
    {"ply", ".ply", "PLY, binary: triangles with label and colour", "MeshLab, CloudCompare, Open3D, VTK"},
    {"stl", ".stl", "STL, binary: triangles alone", "printers, CAD, simulation"},
    {"usd", ".usda", "USD, as text: the surface of each label, nested as the model is",
     "Blender, Omniverse, Houdini, Maya, usdview"},
    {"tileset", ".3dtiles", "3D Tiles 1.1: a folder with the surfaces on the globe, a table of components in each tile",
     "Cesium, Unreal, Unity, ArcGIS"},
    {"objects", ".csv", "a line per object: class, name, parent, volume, surface, box, attributes",
     "spreadsheets, pandas, databases"},
    {"contacts", ".contacts.csv", "a line per pair of objects that touch: area, faces",
     "spreadsheets, pandas, databases"},
    {"objectparquet", ".parquet", "the table of objects as Apache Parquet", "pandas, DuckDB, Spark, GDAL, R"},
    {"contactparquet", ".contacts.parquet", "the table of contacts as Apache Parquet",
     "pandas, DuckDB, Spark, GDAL, R"},
    {"fds", ".fds", "geometry for fire and smoke: components as boxes on a mesh of the voxels",
     "FDS and Smokeview (NIST), PyroSim"},
    {"boxes", ".boxes.csv", "the same boxes as a table", "other solvers, spreadsheets"},
    {"boxesjson", ".boxes.json", "the same as JSON, with the grid's place", "other solvers"},
    {"adjacency", ".adjacency.json", "what touches what, and what lies between rooms and outside, layer by layer",
     "energy and acoustic models"},
    {"graphml", ".graphml", "the same as a graph", "NetworkX, Gephi, yEd"},
    {"indoorgml", ".indoor.gml", "IndoorGML 1.0.3: rooms and doors as cell spaces, their graph",
     "InViewer, FME, navigation, svt build"},
};

using Write = Written (*)(const SemanticVolume&, const Path&, const VolumeWriteOptions&);
constexpr Write kWriters[] = {asNrrd,  asGlb,      asSegNrrd, asVti,       asVtm,           asNifti,
                              asNifti, asTiff,     asOmeTiff, asZarr,      asPrecomputed,   asVdb,
                              asVox,   asX3d,      asAde,     asObj,       asPly,           asStl,
                              asUsd,   asTileset,  asObjects, asContacts,  asObjectParquet, asContactParquet,
                              asFds,   asBoxTable, asBoxJson, asAdjacency, asGraphMl,       asIndoorGml};
static_assert(std::size(kWriters) == std::size(kVolumeFormats));

}  // namespace

std::span<const VolumeFormat> volumeFormats() noexcept { return kVolumeFormats; }

const VolumeFormat* volumeFormatOf(const Path& path) {
    const std::string name = lowerAscii(path.filename().string());
    const VolumeFormat* found = nullptr;
    std::size_t longest = 0;
    for (const VolumeFormat& format : kVolumeFormats)
        for (std::string_view rest = format.endings; !rest.empty();) {
            const std::string_view ending = rest.substr(0, rest.find('|'));
            rest.remove_prefix(std::min(rest.size(), ending.size() + 1));
            if (ending.size() <= longest || name.size() <= ending.size() || !name.ends_with(ending)) continue;
            longest = ending.size();
            found = &format;
        }
    return found;
}

Written writeVolume(const SemanticVolume& volume, const Path& path, const VolumeWriteOptions& options) {
    const VolumeFormat* format = volumeFormatOf(path);
    if (format == nullptr)
        return Error(Code::BadArgument, fmt::format("'{}' ends as none of the formats that a volume can be written in",
                                                    path.filename().string()));
    return kWriters[format - kVolumeFormats](volume, path, options);
}

}  // namespace svt::writers
