#include <svt/writers/tiles3d/tile_glb.hpp>

#include <svt/writers/gltf/surface_positions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

namespace svt::writers {
namespace {

using TileJson = nlohmann::ordered_json;

constexpr int kByte = 5120, kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr std::size_t kMostColors = 16;  // primitives of one colour each
constexpr float kSteps = 65535;
constexpr double kStepsOfEdge = 64;  // of a short edge

/// The triangles of a primitive. All primitives share the vertices, in the order of features: corners of a feature that
/// lie close to each other compress well.
struct TilePart {
    VertexColor color{};
    bool hasColors = false;  // colours differ, and are an attribute
    std::vector<std::uint32_t> indices;

    [[nodiscard]] bool isClear() const noexcept { return color[3] < 255; }
};

/// Opaque parts come first. A mesh of many colours has at most two parts.
std::vector<TilePart> partsOf(const TileMesh& mesh) {
    std::map<VertexColor, std::size_t> partOf;
    for (const std::uint32_t vertex : mesh.indices)
        if (partOf.size() <= kMostColors) partOf.try_emplace(mesh.colors[vertex], partOf.size());
    const bool hasColors = partOf.size() > kMostColors;
    std::vector<TilePart> parts(hasColors ? 2 : partOf.size());
    for (const std::uint32_t vertex : mesh.indices) {
        const VertexColor& color = mesh.colors[vertex];
        TilePart& part = parts[hasColors ? std::size_t(color[3] < 255) : partOf.at(color)];
        part.indices.push_back(vertex);
        part.color = color;
        part.hasColors = hasColors;
    }
    std::erase_if(parts, [](const TilePart& part) { return part.indices.empty(); });
    std::stable_partition(parts.begin(), parts.end(), [](const TilePart& part) { return !part.isClear(); });
    return parts;
}

/// The length that a tenth of the edges does not reach, metres.
double detailOf(const TileMesh& mesh) {
    std::vector<float> lengths;
    lengths.reserve(mesh.indices.size());
    for (std::size_t n = 0; n < mesh.indices.size(); ++n) {
        const std::size_t next = n % 3 == 2 ? n - 2 : n + 1;
        const Vec3d edge = toDouble(mesh.positions[mesh.indices[next]]) - toDouble(mesh.positions[mesh.indices[n]]);
        lengths.push_back(static_cast<float>(length(edge)));
    }
    const auto tenth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 10);
    std::nth_element(lengths.begin(), tenth, lengths.end());
    return *tenth;
}

/// Most places are those of several vertices, one per face. The compression of a web server finds them again, but not in
/// differences between vertices.
bool isRepeated(std::vector<std::array<std::uint16_t, 4>> places) {
    const std::size_t count = places.size();
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places.size() * 5 < count * 3;
}

/// The buffer and accessors while primitives are added.
class TileBuffer {
public:
    TileBuffer(const TileMesh& mesh, GltfBuffer& buffer, const TileCoding& coding) : mesh_(mesh), buffer_(buffer) {
        const auto [low, high] = extentOf(mesh.positions);
        low_ = low;
        const float longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        isQuantized_ = double(longest / kSteps) <= coding.mostStep && longest > 0;
        // Larger steps than necessary: smaller numbers, of fewer digits.
        scale_ =
            std::max(longest / kSteps, static_cast<float>(std::min(coding.mostStep, detailOf(mesh) / kStepsOfEdge)));
    }

    void addAttributes(bool hasColors, std::size_t features) {
        attributes_["POSITION"] = positions();
        attributes_["NORMAL"] = normalized(mesh_.normals, kByte, "VEC3");
        if (hasColors) attributes_["COLOR_0"] = normalized(mesh_.colors, kUnsignedByte, "VEC4");
        attributes_["_FEATURE_ID_0"] = featureIds(features);
    }
    [[nodiscard]] TileJson primitive(const TilePart& part, std::size_t material, std::size_t features) {
        const TileJson ids = TileJson::array(
            {{{"featureCount", features}, {"attribute", 0}, {"label", "component"}, {"propertyTable", 0}}});
        return {{"attributes", attributes_},
                {"indices", indices(part)},
                {"material", material},
                {"extensions", {{"EXT_mesh_features", {{"featureIds", ids}}}}}};
    }
    [[nodiscard]] TileJson node(Vec3d place) const {
        const Vec3d corner = isQuantized_ ? toDouble(low_) : Vec3d{};
        TileJson node{{"mesh", 0},
                      {"translation", {place.x + corner.x, place.z + corner.y, -place.y + corner.z + 0.0}}};
        if (isQuantized_) node["scale"] = {scale_, scale_, scale_};
        return node;
    }
    [[nodiscard]] const TileJson& accessors() const noexcept { return accessors_; }

private:
    std::size_t add(TileJson accessor) {
        accessors_.push_back(std::move(accessor));
        return accessors_.size() - 1;
    }
    template <class T>
    std::size_t addVertices(const std::vector<T>& values, int type, const char* shape, bool isPacked = true) {
        const auto bytes = std::as_bytes(std::span(values));
        const std::size_t view = isPacked ? buffer_.addVertices(bytes, sizeof(T), kVertexTarget)
                                          : buffer_.add(bytes, sizeof(T), kVertexTarget);
        return add({{"bufferView", view}, {"componentType", type}, {"count", values.size()}, {"type", shape}});
    }
    template <class T>
    std::size_t normalized(const std::vector<T>& values, int type, const char* shape) {
        const std::size_t number = addVertices(values, type, shape);
        accessors_[number]["normalized"] = true;
        return number;
    }

    std::size_t positions() {
        if (!isQuantized_) {
            const auto [min, max] = extentOf(mesh_.positions);
            const std::size_t number = addVertices(mesh_.positions, kFloat, "VEC3");
            accessors_[number]["min"] = {min.x, min.y, min.z};
            accessors_[number]["max"] = {max.x, max.y, max.z};
            return number;
        }
        std::vector<std::array<std::uint16_t, 4>> places;
        places.reserve(mesh_.positions.size());
        std::array<std::uint16_t, 3> least{0xFFFF, 0xFFFF, 0xFFFF}, most{0, 0, 0};
        for (const Vec3f& position : mesh_.positions) {
            std::array<std::uint16_t, 4>& place = places.emplace_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int a = static_cast<int>(axis);
                const long step = std::lround((position[a] - low_[a]) / scale_);
                place[axis] = static_cast<std::uint16_t>(std::clamp(step, 0L, long(kSteps)));
                least[axis] = std::min(least[axis], place[axis]);
                most[axis] = std::max(most[axis], place[axis]);
            }
        }
        const std::size_t number = addVertices(places, kUnsignedShort, "VEC3", !isRepeated(places));
        accessors_[number]["min"] = least;
        accessors_[number]["max"] = most;
        return number;
    }

    std::size_t featureIds(std::size_t features) {
        // glTF has no larger whole numbers for vertices.
        if (features > 65536)
            return addVertices(std::vector<float>(mesh_.features.begin(), mesh_.features.end()), kFloat, "SCALAR");
        std::vector<std::array<std::uint16_t, 2>> numbers;
        numbers.reserve(mesh_.features.size());
        for (const std::uint32_t feature : mesh_.features) numbers.push_back({static_cast<std::uint16_t>(feature), 0});
        return addVertices(numbers, kUnsignedShort, "SCALAR");
    }

    std::size_t indices(const TilePart& part) {
        const bool isShort = mesh_.positions.size() < 65535;
        const std::size_t view = buffer_.addIndices(part.indices, isShort ? 2 : 4, kIndexTarget);
        return add({{"bufferView", view},
                    {"componentType", isShort ? kUnsignedShort : kUnsignedInt},
                    {"count", part.indices.size()},
                    {"type", "SCALAR"}});
    }

    const TileMesh& mesh_;
    GltfBuffer& buffer_;
    TileJson accessors_ = TileJson::array(), attributes_ = TileJson::object();
    Vec3f low_{};
    float scale_ = 1;
    bool isQuantized_ = true;
};

TileJson materialOf(const TilePart& part, bool isDoubleSided) {
    TileJson looks{{"metallicFactor", 0}, {"roughnessFactor", 1}};
    if (!part.hasColors) {
        TileJson factor = TileJson::array();
        for (const std::uint8_t channel : part.color) factor.push_back(std::round(channel / 255.0 * 1e4) / 1e4);
        looks["baseColorFactor"] = std::move(factor);
    }
    TileJson material{{"pbrMetallicRoughness", std::move(looks)}};
    if (part.isClear()) material["alphaMode"] = "BLEND";
    if (isDoubleSided) material["doubleSided"] = true;
    return material;
}

}  // namespace

Result<std::string> makeTileGlb(const TileMesh& mesh, std::size_t features,
                                const std::function<TileJson(GltfBuffer&)>& metadata, Vec3d place,
                                const TileCoding& coding) {
    const std::uint64_t bytes = std::uint64_t(mesh.positions.size()) * 24 + std::uint64_t(mesh.indices.size()) * 4;
    if (bytes > 0xF0000000u)
        return Error(Code::GridTooLarge,
                     fmt::format("a tile of {} bytes is more than a .glb can be; use --level", bytes));
    if (mesh.indices.empty()) return Error(Code::NothingSelected, "the surfaces have no area");
    GltfBuffer buffer(coding.isCompressed);
    TileBuffer tile(mesh, buffer, coding);
    TileJson primitives = TileJson::array(), materials = TileJson::array();
    const std::vector<TilePart> parts = partsOf(mesh);
    tile.addAttributes(parts.front().hasColors, features);
    for (const TilePart& part : parts) {
        primitives.push_back(tile.primitive(part, materials.size(), features));
        materials.push_back(materialOf(part, mesh.isDoubleSided));
    }
    TileJson extension = metadata(buffer);
    std::string binary = buffer.bytes();
    binary.resize((binary.size() + 7) / 8 * 8, '\0');
    TileJson buffers = TileJson::array({{{"byteLength", binary.size()}}});
    TileJson used = {"EXT_mesh_features", "EXT_structural_metadata", "KHR_mesh_quantization"};
    TileJson required = TileJson::array({"KHR_mesh_quantization"});
    if (coding.isCompressed) {
        for (TileJson* list : {&used, &required}) list->push_back("EXT_meshopt_compression");
        buffers.push_back({{"byteLength", buffer.decodedBytes()},
                           {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    }
    const TileJson json{{"asset", {{"version", "2.0"}, {"generator", "svt"}}},
                        {"extensionsUsed", std::move(used)},
                        {"extensionsRequired", std::move(required)},
                        {"extensions", {{"EXT_structural_metadata", std::move(extension)}}},
                        {"scene", 0},
                        {"scenes", TileJson::array({{{"nodes", {0}}}})},
                        {"nodes", TileJson::array({tile.node(place)})},
                        {"meshes", TileJson::array({{{"primitives", std::move(primitives)}}})},
                        {"materials", std::move(materials)},
                        {"accessors", tile.accessors()},
                        {"bufferViews", buffer.views()},
                        {"buffers", std::move(buffers)}};
    return asGlbFile(json, binary);
}

std::string asGlbFile(const nlohmann::ordered_json& json, const std::string& binary) {
    std::string text = json.dump(-1, ' ', false, TileJson::error_handler_t::replace);
    text.resize((text.size() + 7) / 8 * 8 + 4, ' ');  // so that the binary begins at a multiple of 8, as tables want it
    const std::array<std::uint32_t, 5> head{0x46546C67, 2, static_cast<std::uint32_t>(28 + text.size() + binary.size()),
                                            static_cast<std::uint32_t>(text.size()), 0x4E4F534A};
    const std::array<std::uint32_t, 2> chunk{static_cast<std::uint32_t>(binary.size()), 0x004E4942};
    std::string file(reinterpret_cast<const char*>(head.data()), sizeof head);
    file += text;
    file.append(reinterpret_cast<const char*>(chunk.data()), sizeof chunk);
    return file += binary;
}

}  // namespace svt::writers
