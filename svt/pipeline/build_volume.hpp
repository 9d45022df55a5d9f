#pragma once
/// \file
/// One call from model files to a semantic volume texture.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/mesh/mesh_scene.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/pipeline/vector_parts.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <filesystem>
#include <optional>
#include <span>

namespace svt::pipeline {

enum class FrameKind : std::uint8_t {
    World,    ///< axes of the CRS
    Building  ///< turned about z to the dominant horizontal edge of the model
};

struct BuildOptions {
    std::optional<Vec3i> dimension;  ///< samples along x, y, z; else by spacing
    std::optional<Vec3d> spacing;    ///< metres; neither: the longest side gets kDefaultSamples
    static constexpr int kDefaultSamples = 400;
    FrameKind frame = FrameKind::World;
    std::optional<volume::Grid> grid;  ///< that of another volume; dimension, spacing and frame do not count then
    model::LodChoice lod;
    bool giveThematicBodies = true;  ///< material between hull and rooms goes to the nearest boundary surface
    bool usePatterns = false;        ///< patterns of the built-in style
    voxelize::SheetMode sheets = voxelize::SheetMode::Thin;
    bool keepThinParts = true;
    VectorChoice vectors;               ///< what SemanticVolume::vectors gets; nothing by default
    const StyleSheet* style = nullptr;  ///< on top of the built-in style
    int threads = 0;
    const Progress* progress = nullptr;
};

/// Figures of a build; what `svt build --json` prints.
struct BuildReport {
    std::size_t objects = 0;  ///< features that were voxelized
    std::size_t triangles = 0;
    std::size_t open = 0;        ///< objects with solid meaning whose shell leaks as read, however it was closed
    std::size_t tJunctions = 0;  ///< tight objects with edges that match only up to T-junctions
    struct Seconds {
        double read = 0, mesh = 0, voxelize = 0, pack = 0, write = 0, total = 0;
    } seconds;  ///< voxelize: meshes in memory to the finished canonical volume; pack: labels, counts, checks
};

struct BuildOutput {
    volume::SemanticVolume volume;
    BuildReport report;
};

/// Reads all files into one model (ids made unique), meshes, voxelizes, labels.
/// \param log  gets all findings; may be null
/// \return the volume and its figures, or the first error of a stage; EmptyModel where nothing lies in a given grid
[[nodiscard]] Result<BuildOutput> buildVolume(std::span<const std::filesystem::path> files,
                                              const BuildOptions& options = {}, Diagnostics* log = nullptr);

/// The same from a model in memory; `model` gains ClosureSurface features for caps.
[[nodiscard]] Result<BuildOutput> buildVolume(model::BuildingModel& model, const BuildOptions& options = {},
                                              Diagnostics* log = nullptr);

/// Reads all files into one model.
[[nodiscard]] Result<model::BuildingModel> readModels(std::span<const std::filesystem::path> files, int threads,
                                                      const Progress* progress, Diagnostics* log);

/// The grid that `options` ask for over the meshes.
[[nodiscard]] Result<volume::Grid> chooseGrid(const mesh::MeshScene& scene, const BuildOptions& options);

}  // namespace svt::pipeline
