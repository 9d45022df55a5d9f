#pragma once
/// \file
/// Assigns X3DMaterials and textures to polygons.

#include <svt/readers/citygml/citygml_resolver.hpp>
#include <svt/readers/textures/texture_set.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <vector>

namespace svt::readers::citygml {

/// Sets Polygon::material for the targets of the materials of one theme: the first theme of the file that has
/// materials. A material of a polygon takes precedence over one of its surface, that over one of its feature; among
/// equals the later takes precedence.
/// \param materials  receives the materials of the theme, without duplicates
void applyMaterials(Part& part, const References& references, GeometryResolver& resolver,
                    const GeometriesByFeature& geometries, std::vector<model::Material>& materials);

// Not in the WebAssembly module, see kReadsTextures.

/// Reads a ParameterizedTexture or GeoreferencedTexture of the front of surfaces. Unusable numbers are left out, so that
/// their surface gets the mean of the image.
/// \param record  with the theme
/// \param to      receives the record with its image and targets; nothing for a texture of backs
void readTexture(xml::NameScope& scope, const xml::Element& texture, TextureRecord record,
                 std::vector<TextureRecord>& to);

/// Refers the polygons without material, or with one that isPlainGrey(), to the textures of one theme: the first theme of
/// the file that has textures. A texture of a polygon takes precedence over one of its surface; among equals the later
/// takes precedence. Call it behind applyMaterials().
/// \param materials  of the polygons
[[nodiscard]] textures::TextureSet applyTextures(Part& part, const References& references, GeometryResolver& resolver,
                                                 const std::vector<model::Material>& materials);

}  // namespace svt::readers::citygml
