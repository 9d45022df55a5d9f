/// \file
/// Writes the hulls of labels as USD in its text form (.usda), which Blender, Omniverse, Houdini, Maya and usdview
/// open.
///
/// Each label with a hull in or below it is a prim `Xform`, nested as the labels are and named by its id. `displayName`
/// is its name. The attributes are `svt:id`, `svt:class`, `svt:name` and `svt:volume` (m3, if known). Its hull is the
/// `Mesh` below it, `Hull`, of closed triangles. `displayColor` is linear, as in USD. `displayOpacity` is the fraction of
/// light that a metre of it stops. Metres, z up. Points are metres from the grid's lower corner along its
/// axes; the matrix of the root, in doubles, leads to world coordinates.

#include <svt/analyze/label_measures.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/hulls/label_hulls.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

/// A text in quotes on one line.
std::string usdText(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : validText(text)) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    }
    return quoted + '"';
}

/// Names of prims: letters, digits and '_', no digit first, each once.
class PrimNames {
public:
    std::string nameFor(std::string_view id) {
        std::string name;
        for (const char c : id) {
            const bool isPlain = isLetter(c) || isDigit(c);
            name += isPlain ? c : '_';
        }
        if (name.empty() || isDigit(name.front())) name.insert(name.begin(), '_');
        std::string unique = name;
        for (int n = 2; !used_.insert(unique).second; ++n) unique = fmt::format("{}_{}", name, n);
        return unique;
    }

private:
    std::set<std::string> used_{"Hull"};
};

class UsdDocument {
public:
    UsdDocument(const LabelHulls& hulls, AtomicFile& file) : hulls_(hulls), out_(file) {}

    Result<void> write() {
        const volume::SemanticVolume& volume = *hulls_.volume;
        const auto& labels = volume.labels.labels;
        std::vector<std::int64_t> surfaceOf(labels.size(), -1);
        for (std::size_t s = 0; s < hulls_.surfaces.size(); ++s)
            surfaceOf[hulls_.surfaces[s].label] = static_cast<std::int64_t>(s);
        std::vector<bool> isUsed(labels.size(), false);
        for (std::size_t l = labels.size(); l-- > 0;) {
            isUsed[l] = isUsed[l] || surfaceOf[l] >= 0;
            if (isUsed[l] && labels[l].parent < l) isUsed[labels[l].parent] = true;
        }
        volumes_ = analyze::ownVolumes(volume.labels, volume.grid);
        begin();
        std::vector<std::uint32_t> open;  // labels whose prims are not ended
        for (std::size_t l = 0; l < labels.size(); ++l) {
            if (!isUsed[l]) continue;
            for (; !open.empty() && open.back() != labels[l].parent; open.pop_back()) out_.text += "}\n";
            beginLabel(l);
            if (surfaceOf[l] >= 0) SVT_DO(writeMesh(static_cast<std::size_t>(surfaceOf[l])));
            open.push_back(static_cast<std::uint32_t>(l));
        }
        for (std::size_t n = 0; n <= open.size(); ++n) out_.text += "}\n";
        return out_.flush(true);
    }

private:
    void begin() {
        const volume::SemanticVolume& volume = *hulls_.volume;
        const std::string root = names_.nameFor(volume.modelName.empty() ? "model" : volume.modelName);
        append("#usda 1.0\n(\n    defaultPrim = \"{}\"\n    metersPerUnit = 1\n    upAxis = \"Z\"\n", root);
        append("    customLayerData = {{\n        string crs = {}\n        string source = {}\n    }}\n)\n\n",
               usdText(volume.crsName), usdText(volume.source));
        append("def Xform \"{}\" (\n    kind = \"assembly\"\n    displayName = {}\n)\n{{\n", root,
               usdText(volume.modelName));
        const auto& [x, y, z] = volume.grid.axes();
        const Vec3d o = hulls_.corner();
        append("matrix4d xformOp:transform = ( ({}, {}, {}, 0), ({}, {}, {}, 0), ({}, {}, {}, 0), ({}, {}, {}, 1) )\n",
               x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, o.x, o.y, o.z);
        append("uniform token[] xformOpOrder = [\"xformOp:transform\"]\n");
    }

    void beginLabel(std::size_t l) {
        const volume::Label& label = hulls_.volume->labels.labels[l];
        append("def Xform \"{}\"", names_.nameFor(label.id));
        if (!label.name.empty()) append(" (\n    displayName = {}\n)", usdText(label.name));
        append("\n{{\ncustom string svt:id = {}\ncustom string svt:class = {}\n", usdText(label.id),
               usdText(label.className));
        append("custom string svt:name = {}\n", usdText(label.name));
        if (volumes_[l] > 0) append("custom double svt:volume = {}\n", volumes_[l]);
    }

    Result<void> writeMesh(std::size_t s) {
        const Positions& points = hulls_.positions[s];
        const volume::Label& label = hulls_.label(s);
        const auto [min, max] = extentOf(points);
        append("def Mesh \"Hull\"\n{{\nfloat3[] extent = [({}, {}, {}), ({}, {}, {})]\n", min.x, min.y, min.z, max.x,
               max.y, max.z);
        const auto& triangles = hulls_.surfaces[s].triangles;
        const auto list = [&](const char* name, std::size_t count, const auto& item) -> Result<void> {
            append("{} = [", name);
            for (std::size_t n = 0; n < count; ++n) {
                if (n != 0) out_.text += ", ";
                item(n);
                SVT_DO(out_.flush());
            }
            out_.text += "]\n";
            return {};
        };
        auto done = list("int[] faceVertexCounts", triangles.size(), [&](std::size_t) { out_.text += '3'; });
        if (done)
            done = list("int[] faceVertexIndices", triangles.size(), [&](std::size_t n) {
                append("{}, {}, {}", triangles[n][0], triangles[n][1], triangles[n][2]);
            });
        if (done)
            done = list("point3f[] points", points.size(),
                        [&](std::size_t n) { append("({}, {}, {})", points[n].x, points[n].y, points[n].z); });
        append("color3f[] primvars:displayColor = [({}, {}, {})] (\n    interpolation = \"constant\"\n)\n",
               roundedLinearChannel(label.color.x), roundedLinearChannel(label.color.y),
               roundedLinearChannel(label.color.z));
        append("float[] primvars:displayOpacity = [{}] (\n    interpolation = \"constant\"\n)\n",
               surfaceOpacity(label));
        append("uniform token orientation = \"rightHanded\"\nuniform token subdivisionScheme = \"none\"\n}}\n");
        return done;
    }

    template <class... T>
    void append(fmt::format_string<T...> format, T&&... values) {
        fmt::format_to(std::back_inserter(out_.text), format, std::forward<T>(values)...);
    }

    const LabelHulls& hulls_;
    PieceWriter out_;
    PrimNames names_;
    std::vector<double> volumes_;
};

/// Writes one file, all or nothing. Equal volumes give equal bytes. Memory: that of labelSurfaces().
/// \return bytes, or NothingSelected if no label has voxels, GridTooLarge for too many triangles, CannotWrite,
///         DiskFull, Cancelled
Result<std::uint64_t> writeUsd(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    SVT_TRY(hulls, makeLabelHulls(volume, options));
    for (const Positions& points : hulls->positions)
        if (points.size() > 0x7FFFFFFF)
            return Error(Code::GridTooLarge, "a hull has more points than USD can number; use --level");
    SVT_TRY(file, AtomicFile::create(path));
    SVT_DO(UsdDocument(*hulls, *file).write());
    return file->commit();
}

}  // namespace

extern const VolumeFormat kUsd{.name = "usd",
                               .endings = ".usda",
                               .holds = "USD, as text: the surface of each label, nested as the model is",
                               .readers = "Blender, Omniverse, Houdini, Maya, usdview",
                               .content = FileContent::Usd,
                               .write = writeUsd};

}  // namespace svt::writers
