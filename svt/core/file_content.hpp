#pragma once
/// \file
/// Kinds of files, identified by their first bytes. A command replaces only files of the kind that it writes.

#include <svt/core/names.hpp>

#include <array>
#include <cstdint>

namespace svt {

enum class FileContent : std::uint8_t {
    Nothing,  ///< no bytes
    Png,
    Volume,  ///< a .svt
    Zip,
    Gzip,
    Gltf,
    Nrrd,
    Vtk,  ///< XML of VTK
    X3d,
    Ply,
    Usd,
    Vox,
    Vdb,
    Parquet,
    Nifti,
    Tiff,
    Svg,
    Pdf,
    GeoPackage,
    Webm,
    Mp4,
    Gif,
    Webp,
    Html,
    CityGml,
    Xml,  ///< any other XML
    CityJson,
    Ifc,
    IndoorGml,
    GeoJson,
    Style,
    PlainJson,  ///< any other JSON
    Dxf,
    Text,
    Unknown
};
/// Names in words, with an article.
constexpr auto namesOf(FileContent) {
    using enum FileContent;
    return std::to_array<Name<FileContent>>({{Nothing, "an empty file"},
                                             {Png, "a PNG picture"},
                                             {Volume, "a volume (.svt)"},
                                             {Zip, "a ZIP archive"},
                                             {Gzip, "a gzip file"},
                                             {Gltf, "a glTF (.glb)"},
                                             {Nrrd, "an NRRD"},
                                             {Vtk, "a file of VTK"},
                                             {X3d, "an X3D scene"},
                                             {Ply, "a PLY"},
                                             {Usd, "a USD stage"},
                                             {Vox, "a model of MagicaVoxel"},
                                             {Vdb, "an OpenVDB"},
                                             {Parquet, "a Parquet table"},
                                             {Nifti, "a NIfTI"},
                                             {Tiff, "a TIFF"},
                                             {Svg, "an SVG drawing"},
                                             {Pdf, "a PDF"},
                                             {GeoPackage, "a SQLite database"},
                                             {Webm, "a WebM film"},
                                             {Mp4, "an MP4 film"},
                                             {Gif, "a GIF"},
                                             {Webp, "a WebP picture"},
                                             {Html, "an HTML page"},
                                             {CityGml, "a CityGML model"},
                                             {Xml, "an XML file"},
                                             {CityJson, "a CityJSON model"},
                                             {Ifc, "an IFC model"},
                                             {IndoorGml, "an IndoorGML model"},
                                             {GeoJson, "a GeoJSON drawing"},
                                             {Style, "a style file"},
                                             {PlainJson, "a JSON file"},
                                             {Dxf, "a DXF drawing"},
                                             {Text, "a text file"},
                                             {Unknown, "of another kind"}});
}

}  // namespace svt
