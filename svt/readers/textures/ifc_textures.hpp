#pragma once
/// \file
/// Textures of IFC surface styles: IfcImageTexture, IfcBlobTexture and IfcPixelTexture.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>
#include <svt/readers/read_options.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace svt::readers::textures {

/// A surface style with a texture, and without a colour or with one that isPlainGrey().
struct TexturedStyle {
    step::RecordIndex style = step::kNoRecord;  ///< IfcSurfaceStyleWithTextures
    std::size_t material = 0;                   ///< that gets its colour
    bool hasGrey = false;                       ///< the material keeps its grey if the image cannot be used
};

[[nodiscard]] bool isTexturedStyle(const ifc::IfcFile& file, step::RecordIndex record);

/// Gives each style the mean colour of its first texture: of the texels that texture coordinates of the file cover
/// (IfcIndexedTriangleTextureMap, IfcIndexedPolygonalTextureMap, IfcTextureMap), else of the whole image. Materials
/// whose image cannot be used have no colour, or keep their grey.
void colorTexturedStyles(const ifc::IfcFile& file, const std::vector<TexturedStyle>& styles,
                         std::vector<model::Material>& materials, std::string_view fileName, const ReadOptions& options,
                         Diagnostics& diagnostics);

}  // namespace svt::readers::textures
