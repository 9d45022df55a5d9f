#pragma once
/// \file
/// Surface styles as materials of the model.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>
#include <svt/readers/read_options.hpp>

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace svt::readers::ifc {

struct Styles {
    std::vector<model::Material> materials;
    /// Representation item -> material. Items of an IfcShapeAspect have a material with its name as `part`, without
    /// colour if the item has no style.
    std::unordered_map<RecordIndex, std::int32_t> ofItem;
    std::unordered_map<RecordIndex, std::int32_t> ofMaterial;  ///< IfcMaterial -> material
    /// Face set -> material of each of its faces.
    std::unordered_map<RecordIndex, std::vector<std::int32_t>> ofFaces;
};

/// Representation or item -> name of the presentation layer that it is assigned to.
[[nodiscard]] std::unordered_map<RecordIndex, std::string> readPresentationLayers(const IfcFile& file);

/// A surface style of textures only gets a colour from these, see textures/ifc_textures.hpp.
/// \param fileName  of the file, for findings
[[nodiscard]] Styles readStyles(const IfcFile& file, std::string_view fileName, const ReadOptions& options,
                                Diagnostics& diagnostics);

}  // namespace svt::readers::ifc
