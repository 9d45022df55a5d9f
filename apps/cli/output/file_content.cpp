#include <apps/cli/output/file_content.hpp>

#include <svt/volume/svt_file.hpp>
#include <svt/writers/volume_formats.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace svt::cli {
namespace {

constexpr std::size_t kHeadBytes = 4096;

constexpr FileFormat kFormats[] = {
    {"png", ".png", FileContent::Png, "a picture", {}},
    {"svt", ".svt", FileContent::Volume, "a semantic volume texture", "svt"},
    {"svg", ".svg", FileContent::Svg, "a vector drawing", "browsers, Inkscape, Illustrator"},
    {"pdf", ".pdf", FileContent::Pdf, "drawings or sheets to scale", {}},
    {"gpkg", ".gpkg", FileContent::GeoPackage, "features or areas as GeoPackage", "QGIS, ArcGIS, GDAL"},
    {"webm", ".webm", FileContent::Webm, "a film", {}},
    {"mp4", ".mp4", FileContent::Mp4, "a film", {}},
    {"gif", ".gif", FileContent::Gif, "a moving picture", {}},
    {"webp", ".webp", FileContent::Webp, "a moving picture", {}},
    {"dxf", ".dxf", FileContent::Dxf, "a drawing for CAD", "AutoCAD, LibreCAD, QGIS"},
    {"geojson", ".geojson", FileContent::GeoJson, "a drawing, or features with their outlines", "QGIS, web maps, GDAL"},
    {"scene", ".json", FileContent::PlainJson, "a scene file", "svt"},
    {"sheets", ".json", FileContent::PlainJson, "a set of sheets", "svt"},
    {"json", ".json", FileContent::PlainJson, "a table as JSON", {}},
    {"html", ".html", FileContent::Html, "a report: a check, or two states", "browsers"},
    {"bcf", ".bcf", FileContent::Zip, "issues with cameras and pictures (BCF 3.0)", "BIM programs"},
    {"vtr", ".vtr", FileContent::Vtk, "values on a lattice", "ParaView, VTK, PyVista"},
    {"csv", ".csv", FileContent::Text, "a table", "spreadsheets"},
    {"xlsx", ".xlsx", FileContent::Zip, "tables as a workbook", "Excel, LibreOffice Calc"},
    {"citygml", ".gml|.xml", FileContent::CityGml, "a CityGML model", {}},
    {"cityjson", ".json", FileContent::CityJson, "a CityJSON model", {}},
    {"cityjsonseq", ".jsonl", FileContent::CityJson, "a CityJSONSeq model", {}},
    {"ifc", ".ifc", FileContent::Ifc, "an IFC model", {}},
};

std::vector<FileFormat> volumeFileFormats() {
    std::vector<FileFormat> formats;
    for (const writers::VolumeFormat& format : writers::volumeFormats())
        formats.push_back({format.name, format.endings, format.content, format.holds, format.readers});
    return formats;
}

bool has(std::string_view text, std::string_view word) { return text.find(word) != std::string_view::npos; }

FileContent contentOfXml(std::string_view text) {
    if (has(text, "<html") || has(text, "<!DOCTYPE html")) return FileContent::Html;
    if (has(text, "<svg") || has(text, ":svg")) return FileContent::Svg;
    if (has(text, "<VTKFile")) return FileContent::Vtk;
    if (has(text, "<X3D")) return FileContent::X3d;
    if (has(text, "IndoorFeatures")) return FileContent::IndoorGml;
    return has(text, "CityModel") ? FileContent::CityGml : FileContent::Xml;
}

FileContent contentOfJson(std::string_view text) {
    if (has(text, "\"CityJSON")) return FileContent::CityJson;
    if (has(text, "\"FeatureCollection\"")) return FileContent::GeoJson;
    return has(text, "\"rules\"") ? FileContent::Style : FileContent::PlainJson;
}

// The first pair of a DXF is "0, SECTION", or a comment with the group code 999.
bool isDxf(std::string_view text) {
    const std::size_t line = text.find('\n');
    if (line == std::string_view::npos) return false;
    std::string_view code = text.substr(0, line), value = text.substr(line + 1);
    if (code.ends_with('\r')) code.remove_suffix(1);
    return code == "999" || (code == "0" && value.starts_with("SECTION"));
}

bool isText(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r' && byte != '\f';
    });
}

}  // namespace

FileContent contentOf(std::string_view head) {
    using namespace std::string_view_literals;
    if (head.empty()) return FileContent::Nothing;
    if (head.starts_with("\x89PNG\r\n\x1a\n"sv)) return FileContent::Png;
    if (volume::looksLikeSvt(std::as_bytes(std::span(head.data(), head.size())))) return FileContent::Volume;
    if (head.starts_with("PK\3\4"sv) || head.starts_with("PK\5\6"sv)) return FileContent::Zip;
    if (head.starts_with("\x1f\x8b"sv)) return FileContent::Gzip;
    if (head.starts_with("%PDF-"sv)) return FileContent::Pdf;
    if (head.starts_with("\x1a\x45\xdf\xa3"sv)) return FileContent::Webm;
    if (head.substr(0, 8).ends_with("ftyp"sv)) return FileContent::Mp4;
    if (head.starts_with("GIF8"sv)) return FileContent::Gif;
    if (head.starts_with("RIFF"sv) && head.substr(0, 12).ends_with("WEBP"sv)) return FileContent::Webp;
    if (head.starts_with("glTF"sv)) return FileContent::Gltf;
    if (head.starts_with("NRRD000"sv)) return FileContent::Nrrd;
    if (head.starts_with("ply\n"sv)) return FileContent::Ply;
    if (head.starts_with("#usda "sv)) return FileContent::Usd;
    if (head.starts_with("VOX \x96"sv) || head.starts_with("VOX \xc8"sv)) return FileContent::Vox;
    if (head.starts_with(" BDV\0\0\0\0"sv)) return FileContent::Vdb;
    if (head.starts_with("SQLite format 3\0"sv)) return FileContent::GeoPackage;
    if (head.starts_with("PAR1"sv)) return FileContent::Parquet;
    if (head.starts_with("II*\0"sv) || head.starts_with("II+\0"sv) || head.starts_with("MM\0"sv))
        return FileContent::Tiff;
    if (head.starts_with("\x5c\1\0\0"sv) || head.starts_with("\x1c\2\0\0n+2"sv)) return FileContent::Nifti;
    std::string plain;
    if (head.starts_with("\xff\xfe"sv) || head.starts_with("\xfe\xff"sv)) {
        // UTF-16: all searched texts are ASCII.
        std::copy_if(head.begin() + 2, head.end(), std::back_inserter(plain), [](char c) { return c != '\0'; });
        head = plain;
    } else if (head.starts_with("\xef\xbb\xbf"sv)) {
        head.remove_prefix(3);
    }
    head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
    if (head.starts_with("ISO-10303-21"sv)) return FileContent::Ifc;
    if (head.starts_with('<')) return contentOfXml(head);
    if (head.starts_with('{') || head.starts_with('[')) return contentOfJson(head);
    if (isDxf(head)) return FileContent::Dxf;
    return isText(head) ? FileContent::Text : FileContent::Unknown;
}

bool isTextContent(FileContent content) noexcept {
    using enum FileContent;
    switch (content) {
        case X3d:
        case Usd:
        case Svg:
        case Html:
        case CityGml:
        case Xml:
        case CityJson:
        case Ifc:
        case IndoorGml:
        case GeoJson:
        case Style:
        case PlainJson:
        case Dxf:
        case Text: return true;
        default: return false;
    }
}

FileContent contentOf(const std::filesystem::path& file) {
    std::array<char, kHeadBytes> head{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return FileContent::Unknown;
    stream.read(head.data(), head.size());
    return contentOf(std::string_view(head.data(), static_cast<std::size_t>(stream.gcount())));
}

const FileFormat* formatOfName(std::string_view name) {
    static const std::vector<FileFormat> kOfVolumes = volumeFileFormats();
    if (const auto volume = std::ranges::find(kOfVolumes, name, &FileFormat::name); volume != kOfVolumes.end())
        return &*volume;
    const auto* found = std::ranges::find(kFormats, name, &FileFormat::name);
    return found == std::end(kFormats) ? nullptr : found;
}

}  // namespace svt::cli
