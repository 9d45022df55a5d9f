#include <svt/readers/cityjson/cityjson_textures.hpp>

namespace svt::readers::cityjson {
namespace {

using textures::TexturePoint, textures::TextureUse, textures::Wrap;

Wrap wrapOf(json::object texture) {
    const std::string_view name = asString(findMember(texture, "wrapMode")).value_or(std::string_view());
    if (name == "mirror") return Wrap::Mirror;
    if (name == "clamp") return Wrap::Clamp;
    return name == "none" || name == "border" ? Wrap::None : Wrap::Repeat;
}

// The coordinates of one ring; false if a vertex does not exist.
bool addRing(json::array ring, const TextureSource& source, TextureUse& use) {
    bool isFirst = true;
    for (const json::element item : ring) {
        const auto index = asInteger(item);
        const bool isImage = isFirst;
        isFirst = false;
        if (isImage) continue;
        if (!index || *index < 0 || static_cast<std::size_t>(*index) >= source.vertices.size()) return false;
        use.points.push_back(source.vertices[static_cast<std::size_t>(*index)]);
    }
    use.ringEnds.push_back(static_cast<std::uint32_t>(use.points.size()));
    return true;
}

}  // namespace

TextureSource readTextures(const OptionalElement& appearance) {
    TextureSource source;
    const auto object = asObject(appearance);
    if (const auto images = asArray(findMember(object, "textures")))
        for (const json::element item : *images) {
            const auto image = asObject(item);
            source.images.push_back(
                {std::string(asString(findMember(image, "image")).value_or(std::string_view())), {}, false, {}});
            source.wraps.push_back(image ? wrapOf(*image) : Wrap::Repeat);
        }
    if (const auto vertices = asArray(findMember(object, "vertices-texture")))
        for (const json::element item : *vertices) {
            const auto pair = asArray(item);
            TexturePoint& point = source.vertices.emplace_back();
            if (!pair || pair->size() != 2) continue;
            point = {asNumber(pair->at(0).value_unsafe()).value_or(0),
                     asNumber(pair->at(1).value_unsafe()).value_or(0)};
        }
    source.theme = asString(findMember(object, "default-theme-texture")).value_or(std::string_view());
    return source;
}

OptionalElement textureValues(json::object geometry, std::string_view theme) {
    const auto themes = asObject(findMember(geometry, "texture"));
    if (!themes) return std::nullopt;
    OptionalElement chosen;
    std::string_view chosenName;
    for (const auto [name, value] : *themes) {
        const bool isDefault = !theme.empty() && name == theme;
        if (!chosen || isDefault || name < chosenName) {
            chosen = value;
            chosenName = name;
        }
        if (isDefault) break;
    }
    return findMember(asObject(chosen), "values");
}

std::optional<TextureUse> readTextureUse(const json::element& rings, const TextureSource& source) {
    const auto array = asArray(rings);
    if (!array || array->size() == 0) return std::nullopt;
    std::optional<TextureUse> use;
    for (const json::element item : *array) {
        const auto ring = asArray(item);
        if (!ring || ring->size() == 0) return use;
        if (!use) {
            const auto image = asInteger(ring->at(0).value_unsafe());
            if (!image || *image < 0 || static_cast<std::size_t>(*image) >= source.images.size()) return std::nullopt;
            use.emplace();
            use->image = static_cast<std::uint32_t>(*image);
            use->wrap = source.wraps[use->image];
        }
        if (!addRing(*ring, source, *use)) {
            // Without all coordinates, the whole image gives the colour.
            use->points.clear();
            use->ringEnds.clear();
            return use;
        }
    }
    return use;
}

}  // namespace svt::readers::cityjson
