#include <svt/writers/tiles3d/quadtree_index.hpp>

#include <svt/core/bytes.hpp>
#include <svt/writers/tiles3d/property_table.hpp>

#include <algorithm>
#include <cstddef>

namespace svt::writers {
namespace {

using Json = nlohmann::ordered_json;

// Flags of existing tiles: a constant if there are none, otherwise one bit per tile.
Json availability(const std::vector<bool>& bits, GltfBuffer& buffer) {
    const auto count = std::count(bits.begin(), bits.end(), true);
    if (count == 0) return {{"constant", 0}};
    const std::string bytes = packedBits(bits.size(), [&](std::size_t n) { return bits[n]; });
    return {{"bitstream", buffer.add(std::as_bytes(std::span(bytes)))}, {"availableCount", count}};
}

}  // namespace

std::string makeSubtreeFile(nlohmann::ordered_json json, std::string binary) {
    binary.resize((binary.size() + 7) / 8 * 8, '\0');
    json["buffers"] = nlohmann::ordered_json::array({{{"byteLength", binary.size()}}});
    std::string text = json.dump();
    text.resize((text.size() + 7) / 8 * 8, ' ');
    std::string bytes = "subt";
    appendBytes(bytes, std::uint32_t{1});
    appendBytes(bytes, static_cast<std::uint64_t>(text.size()));
    appendBytes(bytes, static_cast<std::uint64_t>(binary.size()));
    return bytes + text + binary;
}

std::uint64_t mortonOf(QuadtreeNode node) noexcept {
    std::uint64_t morton = 0;
    for (int bit = 0; bit < 32; ++bit)
        morton |= std::uint64_t(node.x >> bit & 1) << (2 * bit) | std::uint64_t(node.y >> bit & 1) << (2 * bit + 1);
    return morton;
}

void QuadtreeIndex::add(QuadtreeNode node, const Box3d& box, double error) {
    Square& square = squares_[{node.level, mortonOf(node)}];
    square.box.add(box);
    square.error = error;
    square.hasContent = true;
}

void QuadtreeIndex::close() {
    // From the finest level up. New squares are on coarser levels, which precede the current position in the map and
    // are visited later.
    if (squares_.empty()) return;
    for (int level = squares_.rbegin()->first.first; level > 0; --level) {
        const auto end = squares_.lower_bound({level + 1, 0});
        for (auto square = squares_.lower_bound({level, 0}); square != end; ++square) {
            Square& parent = squares_[{level - 1, square->first.second >> 2}];
            parent.box.add(square->second.box);
            parent.error = std::max(parent.error, square->second.error);
        }
    }
}

Result<void> QuadtreeIndex::forEachSubtree(
    const std::function<Result<void>(QuadtreeNode, const std::string&)>& take) const {
    for (const auto& [key, square] : squares_) {
        const auto& [level, morton] = key;
        if (level % kSubtreeLevels != 0) continue;
        QuadtreeNode node{level, 0, 0};
        for (int bit = 0; bit < level; ++bit) {
            node.x |= static_cast<std::uint32_t>(morton >> (2 * bit) & 1) << bit;
            node.y |= static_cast<std::uint32_t>(morton >> (2 * bit + 1) & 1) << bit;
        }
        SVT_DO(take(node, subtreeAt(level, morton)));
    }
    return {};
}

std::string QuadtreeIndex::subtreeAt(int level, std::uint64_t morton) const {
    std::vector<bool> isThere, hasContent, hasChild(std::size_t{1} << (2 * kSubtreeLevels), false);
    std::string boxes, errors;
    std::size_t count = 0;
    for (int below = 0; below <= kSubtreeLevels; ++below) {
        const std::uint64_t first = morton << (2 * below), end = (morton + 1) << (2 * below);
        std::vector<bool> there(end - first, false), content(end - first, false);
        const auto last = squares_.lower_bound({level + below, end});
        for (auto square = squares_.lower_bound({level + below, first}); square != last; ++square) {
            const std::uint64_t n = square->first.second - first;
            there[n] = true;
            content[n] = square->second.hasContent;
            if (below == kSubtreeLevels) continue;
            ++count;
            const Vec3d centre = square->second.box.center(), half = square->second.box.size() * 0.5;
            for (const double value :
                 {centre.x, centre.y, centre.z, half.x, 0.0, 0.0, 0.0, half.y, 0.0, 0.0, 0.0, half.z})
                appendBytes(boxes, value);
            appendBytes(errors, square->second.error);
        }
        if (below == kSubtreeLevels) {
            hasChild = std::move(there);
            continue;
        }
        isThere.insert(isThere.end(), there.begin(), there.end());
        hasContent.insert(hasContent.end(), content.begin(), content.end());
    }
    GltfBuffer buffer;
    Json json;
    json["tileAvailability"] = availability(isThere, buffer);
    json["contentAvailability"] = Json::array({availability(hasContent, buffer)});
    json["childSubtreeAvailability"] = availability(hasChild, buffer);
    const std::size_t boxView = buffer.add(std::as_bytes(std::span(boxes))),
                      errorView = buffer.add(std::as_bytes(std::span(errors)));
    const Json properties{{"boundingBox", {{"values", boxView}}}, {"geometricError", {{"values", errorView}}}};
    json["propertyTables"] = Json::array({{{"class", "tile"}, {"count", count}, {"properties", properties}}});
    json["tileMetadata"] = 0;
    json["bufferViews"] = buffer.views();
    return makeSubtreeFile(std::move(json), buffer.bytes());
}

}  // namespace svt::writers
