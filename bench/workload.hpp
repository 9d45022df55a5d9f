#pragma once
/// \file
/// The fixed inputs and sizes.

#include <svt/core/result.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/labels.hpp>
#include <svt/volume/grid.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace svt::bench {

/// A model file of the benchmark.
struct Input {
    std::string name;  ///< "FZK-Haus"
    std::filesystem::path file;
};

inline constexpr const char* kHouse = "FZK-Haus";
inline constexpr const char* kTurnedHouse = "FZK-Haus, turned";
inline constexpr double kTurnDegrees = 30;

/// The available models: the FZK-Haus of the data directory ($SVT_DATA_DIR, else ../shared/data); the same rotated
/// by kTurnDegrees in plan, so that hardly any face is parallel to the grid; the generated tower. The last two are
/// written to `scratch`.
/// \param skipped  receives a sentence for each missing input
[[nodiscard]] Result<std::vector<Input>> findInputs(const std::filesystem::path& scratch,
                                                    std::vector<std::string>& skipped);

/// The generated tower as classical CityGML 2.0, without its storey groups: libcitygml rejects files with references to
/// features.
[[nodiscard]] Result<Input> writeTowerCityGml2(const std::filesystem::path& scratch);

/// CityGML with all coordinates rotated counter-clockwise about the first point, in plan; written with six decimals.
[[nodiscard]] std::string turnedCityGml(const std::string& text, double degrees);

/// 20 x 20 generated houses in one CityGML 3.0 file.
[[nodiscard]] Result<Input> writeDistrict(const std::filesystem::path& scratch);

/// $SVT_DATA_DIR, else ../shared/data beside the checkout.
[[nodiscard]] std::filesystem::path dataDir();

/// A model prepared for voxelization.
struct Workload {
    std::string name;
    model::BuildingModel model;
    mesh::MeshSet meshes;
    pipeline::LabelledObjects labels;
};

[[nodiscard]] Result<Workload> loadWorkload(const Input& input);

inline constexpr Vec3i kSmallGrid{271, 230, 163}, kGrid{800, 700, 400}, kLargeGrid{1000, 1200, 600};  // the paper's

/// The grid used for most rows.
[[nodiscard]] Vec3i gridSize(bool isQuick);
/// "800 x 700 x 400"
[[nodiscard]] std::string sizeText(Vec3i dimension);
[[nodiscard]] Result<volume::Grid> gridOver(const Workload& workload, Vec3i dimension);

/// Objects in increasing priority where they overlap: painting labels in this order gives the same owners as the
/// voxelizer.
/// \param claims  one per object, same order
[[nodiscard]] std::vector<std::uint32_t> paintOrder(const mesh::MeshSet& meshes,
                                                    const std::vector<voxelize::ObjectClaim>& claims);

}  // namespace svt::bench
