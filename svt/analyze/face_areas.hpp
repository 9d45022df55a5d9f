#pragma once
/// \file
/// Areas of faces of the model, from the meshes that a volume keeps.

#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace svt::analyze {

/// Classes of faces that are measured together, such as Window and WindowSurface.
enum class FaceKind : std::uint8_t { Roof, Wall, Ground, Window, Door };
inline constexpr std::array<std::string_view, 5> kFaceKindNames{"roof", "wall", "ground", "window", "door"};

/// m2 of the mesh of each label; empty where the volume keeps none. Faces of sheets have one side, closed meshes of
/// windows and doors all of theirs. Cost: O(labels + triangles).
[[nodiscard]] std::vector<std::optional<double>> meshAreas(const volume::SemanticVolume& volume);

/// A label whose faces count. A part of such a label, such as a pane, does not count.
struct CountedFaces {
    std::uint32_t label = 0;
    FaceKind kind = FaceKind::Roof;
    std::optional<double> area;  ///< m2; empty: unknown, it has no mesh
};
/// The labels of each kind in an extent, ascending. Each face of the model is one of one label.
/// \param extent  ascending, see Extents
/// \param areas   of meshAreas()
[[nodiscard]] std::vector<CountedFaces> countedFaces(const volume::LabelTable& labels,
                                                     std::span<const std::uint32_t> extent,
                                                     std::span<const std::optional<double>> areas);

/// Removes the windows and doors of rooms from the faces of one feature that also has others: a window often has a surface
/// in the room, too.
void dropOpeningsOfRooms(const volume::LabelTable& labels, std::vector<CountedFaces>& counted);

/// m2 of the faces of each kind in an extent, by FaceKind, without those that dropOpeningsOfRooms() removes. Empty: unknown, because the extent has no label of this kind,
/// or one without a mesh. The parameters are those of countedFaces().
[[nodiscard]] std::array<std::optional<double>, 5> faceAreas(const volume::LabelTable& labels,
                                                             std::span<const std::uint32_t> extent,
                                                             std::span<const std::optional<double>> areas);

}  // namespace svt::analyze
