#pragma once
/// \file
/// Reads one city object independently of the others, so objects can be read in parallel.

#include <svt/readers/cityjson/cityjson_json.hpp>

#include <svt/core/vec.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::cityjson {

inline constexpr std::int32_t kNoSurface = -1;

/// Template geometries of the header.
struct TemplateSet {
    std::vector<json::element> geometries;
    std::vector<std::uint64_t> textBytes;  ///< per geometry, as compact JSON
    std::vector<Vec3d> vertices;           ///< never transformed
};

/// The member `appearance` of a text, as far as it is about textures.
struct TextureSource {
    std::vector<textures::TextureImage> images;
    std::vector<textures::Wrap> wraps;  ///< of each image
    std::vector<textures::TexturePoint> vertices;
    std::string theme;  ///< default-theme-texture, or empty
};

/// Data shared by the objects of one JSON text. An unusable vertex has x = NaN.
struct TextContext {
    TextOrigin origin;
    std::span<const Vec3d> vertices;
    const TemplateSet* templates = nullptr;  ///< never null
    std::size_t materialBegin = 0;           ///< materials of this text are [begin, end) of the numbering in polygons
    std::size_t materialEnd = 0;
    std::size_t templateMaterialEnd = 0;  ///< materials of templates are [0, end)
    std::string_view materialTheme;       ///< default-theme-material, or empty
    // Images of the uses of `own` follow those of the header. Null: textures are not read.
    const TextureSource* ownTextures = nullptr;
    const std::vector<model::Material>* headMaterials = nullptr;  ///< [0, templateMaterialEnd) of the numbering
    const std::vector<model::Material>* ownMaterials = nullptr;   ///< from templateMaterialEnd on; null: none
    const TextureSource* headTextures = nullptr;  ///< also of templates; the same as ownTextures within the header
};

/// A semantic surface that has polygons, or an ancestor of one.
struct SemanticSurface {
    model::Feature feature;            ///< id empty if the file does not give one; parent and children unused
    std::int32_t parent = kNoSurface;  ///< into ParsedObject::surfaces
};

/// A city object; its polygon indices count from 0 in its own list of polygons.
struct ParsedObject {
    std::string id;
    bool isGroup = false;
    model::Feature feature;
    std::vector<std::string> parents, children, childrenRoles;
    std::vector<model::Polygon> polygons;
    std::vector<textures::TextureUse> textureUses;  ///< that materials of polygons refer to
    std::vector<Vec3d> anchors;             ///< of polygons of instances, see GivenCrs; may end before `polygons` does
    std::vector<SemanticSurface> surfaces;  ///< parents precede their children
    Diagnostics diagnostics;
};

/// Reads the member `id`: `value` of CityObjects. Cost: linear in its text.
[[nodiscard]] ParsedObject readCityObject(std::string_view id, json::element value, const TextContext& context);

/// Appends the members of `object` as attributes; `prefix` is empty or ends with '/'.
void appendAttributes(json::object object, std::string_view prefix, std::vector<Attribute>& attributes);
void appendAttribute(std::string_view name, json::element value, std::vector<Attribute>& attributes);

/// Value of the text attribute "name", else "gml:name", else empty.
[[nodiscard]] std::string nameOf(std::span<const Attribute> attributes);

/// Turns `parents` (index of the parent, -1: none) into a forest: in every cycle the lowest index loses its parent.
/// \return those indices, ascending. Cost: O(n).
[[nodiscard]] std::vector<std::int32_t> breakCycles(std::span<std::int32_t> parents);

}  // namespace svt::readers::cityjson
