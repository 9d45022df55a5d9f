#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>

#include <svt/core/file.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/gltf/label_surface.hpp>
#include <svt/writers/gltf/sheet_surfaces.hpp>
#include <svt/writers/gltf/surface_positions.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they stand in memory");

using Json = nlohmann::ordered_json;
using volume::kNoLabel;

// Numbers that glTF takes from OpenGL.
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126, kArrayBuffer = 34962,
              kElementArrayBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

bool isShort(const LabelSurface& surface) { return surface.vertices.size() <= 65535; }

// Bytes of the indices, padded to whole 4-byte words.
std::uint64_t indexBytes(const LabelSurface& surface) {
    const std::uint64_t bytes = std::uint64_t(surface.triangles.size()) * 3 * (isShort(surface) ? 2 : 4);
    return (bytes + 3) / 4 * 4;
}

Json materialOf(const volume::Label& label, const std::string& name, bool isInvisible) {
    Json material;
    material["name"] = name;
    const double opacity = isInvisible ? 0 : double(surfaceOpacity(label));
    const double alpha = std::round(std::clamp(opacity, 0.0, 1.0) * 1e4) / 1e4;
    material["pbrMetallicRoughness"] = {{"baseColorFactor",
                                         {roundedLinearChannel(label.color.x), roundedLinearChannel(label.color.y),
                                          roundedLinearChannel(label.color.z), alpha}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", 1}};
    if (alpha < 1) material["alphaMode"] = "BLEND";
    if (label.filling == volume::Filling::Surface || label.filling == volume::Filling::Winding)
        material["doubleSided"] = true;
    return material;
}

// World directions with y up.
void appendYUp(Json& matrix, Vec3d v) {
    for (const double value : {v.x, v.z, -v.y}) matrix.push_back(value + 0.0);
}

Json rootNode(const volume::SemanticVolume& volume) {
    Json root;
    root["name"] = volume.modelName.empty() ? "model" : volume.modelName;
    Json matrix = Json::array();
    for (const Vec3d axis : volume.grid.axes()) {
        appendYUp(matrix, axis);
        matrix.push_back(0);
    }
    for (const int value : {0, 0, 0, 1}) matrix.push_back(value);
    root["matrix"] = std::move(matrix);
    root["children"] = Json::array();
    return root;
}

// Node 0 is the root; the labels follow in tree order, except those without a mesh in or below them.
Json nodesOf(const volume::SemanticVolume& volume, std::span<const LabelSurface> surfaces) {
    const auto& labels = volume.labels.labels;
    std::vector<std::int64_t> meshOf(labels.size(), -1);
    for (std::size_t m = 0; m < surfaces.size(); ++m) meshOf[surfaces[m].label] = static_cast<std::int64_t>(m);
    std::vector<bool> isUsed(labels.size(), false);
    for (std::size_t l = labels.size(); l-- > 0;) {
        isUsed[l] = isUsed[l] || meshOf[l] >= 0;
        if (isUsed[l] && labels[l].parent < l) isUsed[labels[l].parent] = true;
    }
    Json nodes = Json::array({rootNode(volume)});
    std::vector<std::size_t> nodeOf(labels.size(), 0);
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (!isUsed[l]) continue;
        nodeOf[l] = nodes.size();
        Json node;
        node["name"] = shownName(labels[l]);
        if (meshOf[l] >= 0) node["mesh"] = meshOf[l];
        node["extras"] = {{"id", labels[l].id}, {"class", labels[l].className}};
        nodes.push_back(std::move(node));
        nodes[labels[l].parent < l ? nodeOf[labels[l].parent] : 0]["children"].push_back(nodeOf[l]);
    }
    return nodes;
}

// Accessors 2 m (positions) and 2 m + 1 (indices) of mesh m.
Json accessorsOf(std::span<const LabelSurface> surfaces, std::span<const Positions> positions) {
    Json accessors = Json::array();
    std::uint64_t positionOffset = 0, indexOffset = 0;
    for (std::size_t m = 0; m < surfaces.size(); ++m) {
        const LabelSurface& surface = surfaces[m];
        const auto [min, max] = extentOf(positions[m]);
        accessors.push_back({{"bufferView", 0},
                             {"byteOffset", positionOffset},
                             {"componentType", kFloat},
                             {"count", surface.vertices.size()},
                             {"type", "VEC3"},
                             {"min", {min.x, min.y, min.z}},
                             {"max", {max.x, max.y, max.z}}});
        accessors.push_back({{"bufferView", 1},
                             {"byteOffset", indexOffset},
                             {"componentType", isShort(surface) ? kUnsignedShort : kUnsignedInt},
                             {"count", surface.triangles.size() * 3},
                             {"type", "SCALAR"}});
        positionOffset += surface.vertices.size() * sizeof(Vec3f);
        indexOffset += indexBytes(surface);
    }
    return accessors;
}

Json assetOf(const volume::SemanticVolume& volume) {
    const Vec3d origin = lowerCorner(volume.grid);
    Json extras;
    extras["origin"] = {origin.x, origin.y, origin.z};
    extras["crs"] = volume.crsName;
    extras["source"] = volume.source;
    return {{"version", "2.0"}, {"generator", "svt"}, {"extras", std::move(extras)}};
}

std::string sceneText(const volume::SemanticVolume& volume, std::span<const LabelSurface> surfaces,
                      std::span<const Positions> positions, std::uint64_t positionBytes, std::uint64_t binBytes) {
    Json json;
    json["asset"] = assetOf(volume);
    json["scene"] = 0;
    json["scenes"] = Json::array({{{"nodes", {0}}}});
    json["nodes"] = nodesOf(volume, surfaces);
    Json meshes = Json::array(), materials = Json::array();
    const auto isAir = [&](const LabelSurface& surface) {
        return model::isSpace(volume.labels.labels[surface.label].className);
    };
    const bool isAirOnly = std::all_of(surfaces.begin(), surfaces.end(), isAir);
    for (std::size_t m = 0; m < surfaces.size(); ++m) {
        const volume::Label& label = volume.labels.labels[surfaces[m].label];
        const std::string& name = shownName(label);
        Json primitive = {{"attributes", {{"POSITION", 2 * m}}}, {"indices", 2 * m + 1}, {"material", m}};
        meshes.push_back({{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
        materials.push_back(materialOf(label, name, !isAirOnly && isAir(surfaces[m])));
    }
    json["meshes"] = std::move(meshes);
    json["materials"] = std::move(materials);
    json["accessors"] = accessorsOf(surfaces, positions);
    json["bufferViews"] = Json::array({{{"buffer", 0},
                                        {"byteOffset", 0},
                                        {"byteLength", positionBytes},
                                        {"byteStride", sizeof(Vec3f)},
                                        {"target", kArrayBuffer}},
                                       {{"buffer", 0},
                                        {"byteOffset", positionBytes},
                                        {"byteLength", binBytes - positionBytes},
                                        {"target", kElementArrayBuffer}}});
    json["buffers"] = Json::array({{{"byteLength", binBytes}}});
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return text;
}

// The labels whose triangles are written.
MeshChoice meshChoiceOf(const GlbOptions& options) {
    if (options.faces == GlbFaces::Voxels || options.planesOf != nullptr) return MeshChoice::None;
    return options.faces == GlbFaces::Meshes ? MeshChoice::All : options.meshes;
}

Result<void> writeWords(AtomicFile& file, std::initializer_list<std::uint64_t> words) {
    std::vector<std::uint32_t> values;
    for (const std::uint64_t word : words) values.push_back(static_cast<std::uint32_t>(word));
    return file.write(std::as_bytes(std::span(values)));
}

Result<void> writeIndices(AtomicFile& file, const LabelSurface& surface) {
    if (!isShort(surface)) return file.write(std::as_bytes(std::span(surface.triangles)));
    std::vector<std::uint16_t> indices;
    indices.reserve(surface.triangles.size() * 3 + 1);
    for (const auto& triangle : surface.triangles)
        for (const std::uint32_t vertex : triangle) indices.push_back(static_cast<std::uint16_t>(vertex));
    if (indices.size() % 2 != 0) indices.push_back(0);
    return file.write(std::as_bytes(std::span(indices)));
}

}  // namespace

Result<GlbReport> writeGlb(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                           const GlbOptions& options) {
    for (const volume::SemanticVolume* v : {&volume, options.planesOf})
        if (v != nullptr) SVT_DO(checkDimension(volume.grid, v->columns));
    SheetSurfaces sheets = sheetSurfaces(volume, meshChoiceOf(options));
    SVT_TRY(surfaces, labelSurfaces(volume.columns, withoutSheets(volume.labels.labelOfScalar(), volume.labels, sheets),
                                    {options.maxTriangles, options.threads, options.progress}));
    if (surfaces->empty() && sheets.surfaces.empty())
        return Error(Code::NothingSelected, "the volume has no voxels and therefore no surface");

    Progress::tell(options.progress, "vertices", 0);
    SVT_TRY(positions,
            placeVertices(volume, *surfaces, options.faces, options.planesOf, options.threads, options.progress));
    for (std::size_t s = 0; s < sheets.surfaces.size(); ++s) {
        if (sheets.surfaces[s].triangles.empty()) continue;
        surfaces->push_back(std::move(sheets.surfaces[s]));
        positions->push_back(std::move(sheets.positions[s]));
    }

    GlbReport report;
    std::uint64_t positionBytes = 0, binBytes = 0;
    for (const LabelSurface& surface : *surfaces) {
        positionBytes += surface.vertices.size() * sizeof(Vec3f);
        binBytes += indexBytes(surface);
        report.triangles += surface.triangles.size();
        report.vertices += surface.vertices.size();
    }
    binBytes += positionBytes;
    report.meshes = surfaces->size();
    const std::string text = sceneText(volume, *surfaces, *positions, positionBytes, binBytes);
    const std::uint64_t length = 12 + 8 + text.size() + 8 + binBytes;
    if (length > 0xFFFFFFFFu)
        return Error(
            Code::GridTooLarge,
            fmt::format("the .glb would have {} bytes, but none can have more than {}; use a coarser volume or "
                        "fewer features",
                        length, 0xFFFFFFFFu));
    Progress::tell(options.progress, "write", 0);
    SVT_TRY(file, AtomicFile::create(path));
    auto done = writeWords(*file, {kMagic, 2, length, text.size(), kJsonChunk});
    if (done) done = file->write(text);
    if (done) done = writeWords(*file, {binBytes, kBinChunk});
    for (std::size_t m = 0; done && m < surfaces->size(); ++m)
        done = file->write(std::as_bytes(std::span((*positions)[m])));
    for (std::size_t m = 0; done && m < surfaces->size(); ++m) done = writeIndices(*file, (*surfaces)[m]);
    if (!done) return done.error();
    SVT_TRY(bytes, file->commit());
    report.bytes = *bytes;
    return report;
}

extern const VolumeFormat kGlb{
    .name = "glb",
    .endings = ".glb",
    .holds = "binary glTF 2.0: the surface of each label as triangles",
    .readers = "Blender, Windows, three.js, Cesium",
    .content = FileContent::Gltf,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(report, writeGlb(volume, path,
                                 {.faces = options.faces,
                                  .meshes = meshChoice(options, MeshChoice::Closed),
                                  .threads = options.threads,
                                  .progress = options.progress}));
        return report->bytes;
    }};

}  // namespace svt::writers
