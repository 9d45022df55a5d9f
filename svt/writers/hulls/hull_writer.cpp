/// \file
/// Writes the surface of each label as triangles in the plain formats that CAD, print and mesh programs read. The
/// surfaces are those of a .glb (see GlbOptions::faces): closed for each label.
///
/// - OBJ: one object per label, named by its id, in a group named by its class. Materials by colour are in `<stem>.mtl`
///   beside it. World coordinates, metres.
/// - PLY: binary, world coordinates as doubles. Each face has `label` (its number in the table) and colour. Comments
///   list id, class and name of each label.
/// - STL: binary, without names. Coordinates are 32-bit floats, so they are metres from the lower corner of the grid,
///   along world axes. The header of 80 bytes states the position of this corner.

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/hulls/label_hulls.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/x3d/texture_files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

enum class HullFormat : std::uint8_t { Obj, Ply, Stl };

using volume::Label;

/// A text on one line without blanks at its ends.
std::string lineText(std::string_view text, bool hasBlanks) {
    std::string line;
    for (const char c : text) {
        const bool isControl = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
        line += isControl || (c == ' ' && !hasBlanks) ? (hasBlanks ? ' ' : '_') : c;
    }
    return line.empty() ? "_" : line;
}

Result<void> writeMaterials(const LabelHulls& hulls, const std::filesystem::path& path) {
    SVT_DO(checkSibling(path, "# Semantic volume"));
    std::string text = "# Semantic volume texture: colours of labels\n";
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s) {
        const Label& label = hulls.label(s);
        text += fmt::format("newmtl label_{}\nKd {} {} {}\nd {}\n", hulls.surfaces[s].label, label.color.x,
                            label.color.y, label.color.z, surfaceOpacity(label));
    }
    auto bytes = writeFileAtomically(path, text);
    return bytes ? Result<void>() : Result<void>(bytes.error());
}

Result<void> writeObj(const LabelHulls& hulls, const std::string& materials, PieceWriter& out) {
    out.text = fmt::format("# Semantic volume texture; metres, {}\nmtllib {}\n", lineText(hulls.volume->crsName, true),
                           lineText(materials, true));
    const Vec3d corner = hulls.corner();
    std::uint64_t first = 1;
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s) {
        const Label& label = hulls.label(s);
        out.text += fmt::format("o {}\ng {}\nusemtl label_{}\n", lineText(label.id, false),
                                lineText(label.className, false), hulls.surfaces[s].label);
        for (std::size_t v = 0; v < hulls.positions[s].size(); ++v) {
            const Vec3d p = corner + hulls.fromCorner(s, v);
            fmt::format_to(std::back_inserter(out.text), "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
            SVT_DO(out.flush());
        }
        for (const auto& [a, b, c] : hulls.surfaces[s].triangles) {
            fmt::format_to(std::back_inserter(out.text), "f {} {} {}\n", first + a, first + b, first + c);
            SVT_DO(out.flush());
        }
        first += hulls.positions[s].size();
    }
    return out.flush(true);
}

Result<void> writePly(const LabelHulls& hulls, PieceWriter& out) {
    std::uint64_t vertices = 0, faces = 0;
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s) {
        vertices += hulls.positions[s].size();
        faces += hulls.surfaces[s].triangles.size();
    }
    out.text = "ply\nformat binary_little_endian 1.0\n";
    out.text += fmt::format("comment Semantic volume texture; metres, {}\n", lineText(hulls.volume->crsName, true));
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s) {
        const Label& label = hulls.label(s);
        out.text +=
            fmt::format("comment label {} id {} class {} name {}\n", hulls.surfaces[s].label, lineText(label.id, false),
                        lineText(label.className, false), lineText(label.name, true));
    }
    out.text += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", vertices);
    out.text += fmt::format(
        "element face {}\nproperty list uchar int vertex_indices\nproperty int label\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nend_header\n",
        faces);
    const Vec3d corner = hulls.corner();
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s)
        for (std::size_t v = 0; v < hulls.positions[s].size(); ++v) {
            const Vec3d p = corner + hulls.fromCorner(s, v);
            for (int axis = 0; axis < 3; ++axis) appendBytes(out.text, p[axis]);
            SVT_DO(out.flush());
        }
    std::uint32_t first = 0;
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s) {
        const Vec3f color = hulls.label(s).color;
        for (const auto& triangle : hulls.surfaces[s].triangles) {
            appendBytes(out.text, std::uint8_t{3});
            for (const std::uint32_t vertex : triangle)
                appendBytes(out.text, static_cast<std::int32_t>(first + vertex));
            appendBytes(out.text, static_cast<std::int32_t>(hulls.surfaces[s].label));
            for (int axis = 0; axis < 3; ++axis) appendBytes(out.text, colorByte(color[axis]));
            SVT_DO(out.flush());
        }
        first += static_cast<std::uint32_t>(hulls.positions[s].size());
    }
    return out.flush(true);
}

Result<void> writeStl(const LabelHulls& hulls, PieceWriter& out) {
    const Vec3d corner = hulls.corner();
    // Readers take a file for text if it begins with "solid".
    std::string head = fmt::format("SVT, metres from {:.4f} {:.4f} {:.4f}", corner.x, corner.y, corner.z);
    head.resize(80, ' ');
    out.text = head;
    std::uint64_t faces = 0;
    for (const LabelSurface& surface : hulls.surfaces) faces += surface.triangles.size();
    appendBytes(out.text, static_cast<std::uint32_t>(faces));
    for (std::size_t s = 0; s < hulls.surfaces.size(); ++s)
        for (const auto& [a, b, c] : hulls.surfaces[s].triangles) {
            const std::array<Vec3d, 3> points{hulls.fromCorner(s, a), hulls.fromCorner(s, b), hulls.fromCorner(s, c)};
            const Vec3d normal = normalized(cross(points[1] - points[0], points[2] - points[0]));
            for (const Vec3d v : {normal, points[0], points[1], points[2]})
                for (int axis = 0; axis < 3; ++axis) appendBytes(out.text, static_cast<float>(v[axis]));
            appendBytes(out.text, std::uint16_t{0});
            SVT_DO(out.flush());
        }
    return out.flush(true);
}

/// Writes one file (OBJ: two), all or nothing. Equal volumes give equal bytes.
/// \return bytes, or NothingSelected if no label has voxels, GridTooLarge for too many triangles, CannotWrite,
///         DiskFull, WouldDestroy (something else beside the OBJ), Cancelled
template <HullFormat format>
Result<std::uint64_t> writeHulls(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                 const VolumeWriteOptions& options) {
    SVT_TRY(made, makeLabelHulls(volume, options));
    const LabelHulls& hulls = *made;
    std::uint64_t vertices = 0;
    for (const Positions& of : hulls.positions) vertices += of.size();
    if (vertices > 0x7FFFFFFF)
        return Error(Code::GridTooLarge,
                     fmt::format("{} vertices are more than the format can number; use --level", vertices));
    const std::filesystem::path materials = std::filesystem::path(path).replace_extension(".mtl");
    if (format == HullFormat::Obj) SVT_DO(writeMaterials(hulls, materials));
    SVT_TRY(file, AtomicFile::create(path));
    PieceWriter out(*file);
    SVT_DO(format == HullFormat::Obj   ? writeObj(hulls, materials.filename().string(), out)
           : format == HullFormat::Ply ? writePly(hulls, out)
                                       : writeStl(hulls, out));
    return file->commit();
}

}  // namespace

extern const VolumeFormat kObj{.name = "obj",
                               .endings = ".obj",
                               .holds = "Wavefront OBJ: an object per label, colours in an .mtl beside it",
                               .readers = "Blender, MeshLab, CAD, VTK",
                               .content = FileContent::Text,
                               .write = writeHulls<HullFormat::Obj>};

extern const VolumeFormat kPly{.name = "ply",
                               .endings = ".ply",
                               .holds = "PLY, binary: triangles with label and colour",
                               .readers = "MeshLab, CloudCompare, Open3D, VTK",
                               .content = FileContent::Ply,
                               .write = writeHulls<HullFormat::Ply>};

extern const VolumeFormat kStl{.name = "stl",
                               .endings = ".stl",
                               .holds = "STL, binary: only triangles",
                               .readers = "printers, CAD, simulation",
                               .content = FileContent::Unknown,
                               .write = writeHulls<HullFormat::Stl>};

}  // namespace svt::writers
