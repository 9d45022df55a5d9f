#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/tiles3d/feature_glb.hpp>

#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/writers/tiles3d/property_table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace svt::writers {
namespace {

using GltfJson = nlohmann::ordered_json;

constexpr int kFloatType = 5126, kByteType = 5121, kIndexType = 5125, kVertices = 34962, kIndices = 34963;
constexpr float kOpaque = 0.999f;

void appendSurface(const LabelHulls& hulls, std::size_t surface, float feature, FlatMesh& mesh) {
    const volume::Label& label = hulls.label(surface);
    const VertexColor color = linearColor(label.color, surfaceOpacity(label));
    std::vector<Vec3d> places;
    for (std::size_t v = 0; v < hulls.positions[surface].size(); ++v) places.push_back(hulls.fromCorner(surface, v));
    mesh.append(hulls.surfaces[surface], places, feature, [&](Vec3d) { return color; });
}

template <class T>
std::size_t addVertices(GltfBuffer& buffer, const std::vector<T>& values) {
    return buffer.add(std::as_bytes(std::span(values)), static_cast<int>(sizeof(T)), kVertices);
}

GltfJson accessor(std::size_t view, int type, std::size_t count, const char* shape) {
    return {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}};
}

GltfJson primitiveOf(const FlatMesh& mesh, std::size_t features, std::size_t material, GltfBuffer& buffer,
                     GltfJson& accessors) {
    const auto [min, max] = extentOf(mesh.positions);
    const std::size_t first = accessors.size(), count = mesh.positions.size();
    accessors.push_back(accessor(addVertices(buffer, mesh.positions), kFloatType, count, "VEC3"));
    accessors.back()["min"] = {min.x, min.y, min.z};
    accessors.back()["max"] = {max.x, max.y, max.z};
    accessors.push_back(accessor(addVertices(buffer, mesh.normals), kFloatType, count, "VEC3"));
    accessors.push_back(accessor(addVertices(buffer, mesh.colors), kByteType, count, "VEC4"));
    accessors.back()["normalized"] = true;
    accessors.push_back(accessor(addVertices(buffer, mesh.features), kFloatType, count, "SCALAR"));
    accessors.push_back(accessor(buffer.add(std::as_bytes(std::span(mesh.indices)), 0, kIndices), kIndexType,
                                 mesh.indices.size(), "SCALAR"));
    const GltfJson ids =
        GltfJson::array({{{"featureCount", features}, {"attribute", 0}, {"label", "component"}, {"propertyTable", 0}}});
    return {{"attributes",
             {{"POSITION", first}, {"NORMAL", first + 1}, {"COLOR_0", first + 2}, {"_FEATURE_ID_0", first + 3}}},
            {"indices", first + 4},
            {"material", material},
            {"extensions", {{"EXT_mesh_features", {{"featureIds", ids}}}}}};
}

/// The same in 20 bytes per vertex. \param node receives the scale of the places, and is moved to their lower corner
GltfJson quantizedPrimitive(const FlatMesh& mesh, std::size_t features, GltfBuffer& buffer, GltfJson& accessors,
                            GltfJson& node) {
    constexpr int kShortType = 5123, kSignedByteType = 5120;
    constexpr float kSteps = 65535;
    const auto [min, max] = extentOf(mesh.positions);
    const float scale = std::max({max.x - min.x, max.y - min.y, max.z - min.z}) / kSteps;
    std::vector<std::array<std::uint16_t, 4>> places;
    std::vector<std::array<std::int8_t, 4>> normals;
    std::vector<std::array<std::uint16_t, 2>> numbers;
    std::array<std::uint16_t, 3> least{0xFFFF, 0xFFFF, 0xFFFF}, most{0, 0, 0};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        std::array<std::uint16_t, 4> place{};
        std::array<std::int8_t, 4> normal{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            place[axis] = static_cast<std::uint16_t>(std::lround((mesh.positions[v][a] - min[a]) / scale));
            normal[axis] = static_cast<std::int8_t>(std::lround(mesh.normals[v][a] * 127));
            least[axis] = std::min(least[axis], place[axis]);
            most[axis] = std::max(most[axis], place[axis]);
        }
        places.push_back(place);
        normals.push_back(normal);
        numbers.push_back({static_cast<std::uint16_t>(mesh.features[v]), 0});
    }
    const std::size_t first = accessors.size(), count = places.size();
    accessors.push_back(accessor(addVertices(buffer, places), kShortType, count, "VEC3"));
    accessors.back()["min"] = least;
    accessors.back()["max"] = most;
    accessors.push_back(accessor(addVertices(buffer, normals), kSignedByteType, count, "VEC3"));
    accessors.back()["normalized"] = true;
    accessors.push_back(accessor(addVertices(buffer, mesh.colors), kByteType, count, "VEC4"));
    accessors.back()["normalized"] = true;
    accessors.push_back(accessor(addVertices(buffer, numbers), kShortType, count, "SCALAR"));
    const std::vector<std::uint16_t> small(mesh.indices.begin(), mesh.indices.end());
    const bool isSmall = count < 65535;
    const auto bytes = isSmall ? std::as_bytes(std::span(small)) : std::as_bytes(std::span(mesh.indices));
    accessors.push_back(
        accessor(buffer.add(bytes, 0, kIndices), isSmall ? kShortType : kIndexType, mesh.indices.size(), "SCALAR"));
    const std::array<float, 3> corner{min.x, min.y, min.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        node["translation"][axis] = node["translation"][axis].get<double>() + double(corner[axis]);
    node["scale"] = {scale, scale, scale};
    const GltfJson ids =
        GltfJson::array({{{"featureCount", features}, {"attribute", 0}, {"label", "component"}, {"propertyTable", 0}}});
    return {{"attributes",
             {{"POSITION", first}, {"NORMAL", first + 1}, {"COLOR_0", first + 2}, {"_FEATURE_ID_0", first + 3}}},
            {"indices", first + 4},
            {"material", 0},
            {"extensions", {{"EXT_mesh_features", {{"featureIds", ids}}}}}};
}

GltfJson materialOf(bool isOpaque) {
    GltfJson material{{"name", isOpaque ? "opaque" : "clear"},
                      {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    if (!isOpaque) material["alphaMode"] = "BLEND";
    return material;
}

GltfJson metadataOf(const LabelHulls& hulls, std::size_t begin, std::size_t end, const FeatureTexts& texts,
                    GltfBuffer& buffer) {
    std::vector<std::string> ids, names, classes, parents, storeys, attributes;
    std::vector<double> volumes;
    std::vector<std::uint32_t> firsts, counts;
    const auto& labels = hulls.volume->labels.labels;
    for (std::size_t s = begin; s < end; ++s) {
        const volume::Label& label = hulls.label(s);
        ids.push_back(label.id);
        names.push_back(label.name);
        classes.push_back(label.className);
        parents.push_back(label.parent < labels.size() ? labels[label.parent].id : std::string());
        storeys.push_back(texts.storeys[hulls.surfaces[s].label]);
        volumes.push_back(texts.volumes[hulls.surfaces[s].label]);
        firsts.push_back(label.first);
        counts.push_back(label.count);
        attributes.push_back(attributesText(label));
    }
    PropertyTable table(buffer, end - begin);
    table.strings("id", "id of the feature in the model", ids);
    table.strings("name", "name of the feature, may be empty", names);
    table.strings("class", "class of CityGML", classes);
    table.strings("parent", "id of the feature that it is a part of", parents);
    table.strings("storey", "name of its storey, may be empty", storeys);
    table.knownNumbers("volume", "cubic metres", volumes);
    table.numbers("firstScalar", "first value of its voxels in the volume", firsts);
    table.numbers("scalarCount", "number of values of its voxels", counts);
    table.strings("attributes", "attributes of the feature as JSON", attributes);
    return table.extension("component", "a component of a building");
}

}  // namespace

VertexColor linearColor(Vec3f color, float opacity) noexcept {
    const auto byteOf = [](float channel) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(linearChannel(channel), 0.0, 1.0) * 255));
    };
    return {byteOf(color.x), byteOf(color.y), byteOf(color.z),
            static_cast<std::uint8_t>(std::lround(std::clamp(opacity, 0.0f, 1.0f) * 255))};
}

Vec3f withYUp(Vec3d v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.z), static_cast<float>(-v.y + 0.0)};
}

void FlatMesh::append(const LabelSurface& surface, std::span<const Vec3d> places, float feature,
                      const std::function<VertexColor(Vec3d)>& colorOf) {
    // Faces share a vertex where corner and normal are equal, the normal to 10 bits for each axis.
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    known.reserve(places.size() * 2);
    for (const auto& triangle : surface.triangles) {
        const Vec3d across =
            cross(places[triangle[1]] - places[triangle[0]], places[triangle[2]] - places[triangle[0]]);
        const double size = length(across);
        if (!(size > 0)) continue;  // moved onto a plane, it has no area and no normal
        const Vec3d normal = across * (1 / size);
        for (const std::uint32_t corner : triangle) {
            std::uint64_t key = corner;
            for (int axis = 0; axis < 3; ++axis)
                key = key << 10 | static_cast<std::uint64_t>(std::lround((normal[axis] + 1) * 511));
            const auto [vertex, isNew] = known.try_emplace(key, static_cast<std::uint32_t>(positions.size()));
            if (isNew) {
                positions.push_back(withYUp(places[corner]));
                normals.push_back(withYUp(normal));
                colors.push_back(colorOf(normal));
                features.push_back(feature);
            }
            indices.push_back(vertex->second);
        }
    }
}

Result<std::string> makeMeshGlb(const FlatMesh& opaque, const FlatMesh& clear, std::size_t features,
                                const std::function<GltfJson(GltfBuffer&)>& metadata, Vec3d place,
                                VertexStorage storage) {
    const std::uint64_t bytes = opaque.sizeBytes() + clear.sizeBytes();
    if (bytes > 0xF0000000u)
        return Error(Code::GridTooLarge,
                     fmt::format("a tile of {} bytes is more than a .glb can be; use --level", bytes));
    GltfBuffer buffer;
    GltfJson primitives = GltfJson::array(), accessors = GltfJson::array();
    GltfJson materials = GltfJson::array();
    GltfJson node{{"mesh", 0}};
    if (storage == VertexStorage::Quantized || place != Vec3d{})
        node["translation"] = {place.x, place.z, -place.y + 0.0};
    for (const FlatMesh* mesh : {&opaque, &clear}) {
        if (mesh->indices.empty()) continue;
        primitives.push_back(storage == VertexStorage::Quantized
                                 ? quantizedPrimitive(*mesh, features, buffer, accessors, node)
                                 : primitiveOf(*mesh, features, materials.size(), buffer, accessors));
        materials.push_back(materialOf(mesh == &opaque));
    }
    if (primitives.empty()) return Error(Code::NothingSelected, "the surfaces have no area");
    GltfJson extension = metadata(buffer);
    std::string binary = buffer.bytes();
    binary.resize((binary.size() + 7) / 8 * 8, '\0');
    GltfJson used = GltfJson::array({"EXT_mesh_features", "EXT_structural_metadata"});
    if (storage == VertexStorage::Quantized) used.push_back("KHR_mesh_quantization");
    GltfJson json{{"asset", {{"version", "2.0"}, {"generator", "svt"}}},
                  {"extensionsUsed", std::move(used)},
                  {"extensions", {{"EXT_structural_metadata", std::move(extension)}}},
                  {"scene", 0},
                  {"scenes", GltfJson::array({{{"nodes", {0}}}})},
                  {"nodes", GltfJson::array({std::move(node)})},
                  {"meshes", GltfJson::array({{{"primitives", std::move(primitives)}}})},
                  {"materials", std::move(materials)},
                  {"accessors", std::move(accessors)},
                  {"bufferViews", buffer.views()},
                  {"buffers", GltfJson::array({{{"byteLength", binary.size()}}})}};
    if (storage == VertexStorage::Quantized) json["extensionsRequired"] = GltfJson::array({"KHR_mesh_quantization"});
    return asGlbFile(json, binary);
}

std::string asGlbFile(const nlohmann::ordered_json& json, const std::string& binary) {
    std::string text = json.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
    text.resize((text.size() + 7) / 8 * 8 + 4, ' ');  // so that the binary begins at a multiple of 8, as tables want it
    const std::array<std::uint32_t, 5> head{0x46546C67, 2, static_cast<std::uint32_t>(28 + text.size() + binary.size()),
                                            static_cast<std::uint32_t>(text.size()), 0x4E4F534A};
    const std::array<std::uint32_t, 2> chunk{static_cast<std::uint32_t>(binary.size()), 0x004E4942};
    std::string file(reinterpret_cast<const char*>(head.data()), sizeof head);
    file += text;
    file.append(reinterpret_cast<const char*>(chunk.data()), sizeof chunk);
    return file += binary;
}

FeatureTexts featureTexts(const volume::SemanticVolume& volume) {
    const auto& labels = volume.labels.labels;
    const auto rows = analyze::queryRows(volume.labels);
    FeatureTexts texts{std::vector<std::string>(labels.size()), analyze::ownVolumes(volume.labels, volume.grid)};
    // Parents precede their children; groups may be anywhere. The storey is a group of the label, or the storey of its
    // parent.
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (model::query::isStorey(rows[l])) {
            texts.storeys[l] = shownName(labels[l]);
            continue;
        }
        for (const std::uint32_t group : labels[l].groups)
            if (group < rows.size() && texts.storeys[l].empty() && model::query::isStorey(rows[group]))
                texts.storeys[l] = shownName(labels[group]);
        if (texts.storeys[l].empty() && labels[l].parent < l) texts.storeys[l] = texts.storeys[labels[l].parent];
    }
    return texts;
}

Box3d boxOfHulls(const LabelHulls& hulls, std::size_t begin, std::size_t end) {
    Box3d box;
    for (std::size_t s = begin; s < end; ++s)
        for (std::size_t v = 0; v < hulls.positions[s].size(); ++v) box.add(hulls.fromCorner(s, v));
    return box;
}

Result<std::string> makeFeatureGlb(const LabelHulls& hulls, std::size_t begin, std::size_t end,
                                   const FeatureTexts& texts) {
    FlatMesh opaque, clear;
    for (std::size_t s = begin; s < end; ++s)
        appendSurface(hulls, s, static_cast<float>(s - begin),
                      surfaceOpacity(hulls.label(s)) >= kOpaque ? opaque : clear);
    return makeMeshGlb(
        opaque, clear, end - begin, [&](GltfBuffer& buffer) { return metadataOf(hulls, begin, end, texts, buffer); },
        {}, VertexStorage::Full);
}

}  // namespace svt::writers
