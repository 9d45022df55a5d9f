#pragma once
/// \file
/// What a file holds, told by its first bytes, and the formats that commands write.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace svt::cli {

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
    Xml,  ///< another XML
    CityJson,
    Ifc,
    IndoorGml,
    GeoJson,
    Style,
    PlainJson,  ///< another JSON
    Dxf,
    Text,
    Unknown
};

/// \param head  the first bytes of the file, a few KiB, or all of it
[[nodiscard]] FileContent contentOf(std::string_view head);

/// The same of a regular file; Unknown if it cannot be read. Cost: 4 KiB are read.
[[nodiscard]] FileContent contentOf(const std::filesystem::path& file);

/// In words with an article: "a PNG picture".
[[nodiscard]] std::string_view contentName(FileContent content) noexcept;

/// A format of output.
struct FileFormat {
    std::string_view name;     ///< as Option::formats has it
    std::string_view endings;  ///< ".gml|.xml"
    FileContent content;       ///< what it may take the place of, besides nothing
};

/// The format of that name; null: there is none.
[[nodiscard]] const FileFormat* formatOfName(std::string_view name);

}  // namespace svt::cli
