#pragma once
/// \file
/// Builds a semantic volume texture from model files in one call.

#include <svt/core/diagnostics.hpp>
#include <svt/core/names.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/default_spacing.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/pipeline/vector_parts.hpp>
#include <svt/readers/read_options.hpp>
#include <svt/record/members.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace svt::pipeline {

enum class AxesKind : std::uint8_t {
    World,    ///< along the axes of the CRS
    Building  ///< rotated about z to the dominant horizontal edge of the model
};
constexpr auto namesOf(AxesKind) {
    return std::to_array<Name<AxesKind>>({{AxesKind::World, "world"}, {AxesKind::Building, "building"}});
}

struct BuildOptions {
    std::optional<Vec3i> dimension;  ///< samples along x, y, z; overrides spacing
    std::optional<Vec3d> spacing;    ///< metres; without dimension and spacing see chooseSpacing()
    std::uint64_t memoryBytes = SpacingChoice::kMemoryBytes;  ///< limit for a default spacing
    AxesKind axes = AxesKind::World;
    std::optional<volume::Grid> grid;  ///< grid of another volume; dimension, spacing and axes are then ignored
    bool extendsGrid = false;          ///< only the sample positions of `grid` count: the volume covers the model
    model::LodChoice lod;
    readers::ReadOptions read;         ///< for files; threads and progress are those below
    bool assignThematicBodies = true;  ///< assigns material between hull and rooms to the nearest boundary surface
    bool usePatterns = false;          ///< use the patterns of the built-in style
    voxelize::SheetMode sheets = voxelize::SheetMode::Thin;
    bool keepThinParts = true;
    VectorChoice vectors;               ///< content of SemanticVolume::vectors; empty by default
    const StyleSheet* style = nullptr;  ///< applied after the built-in style
    std::filesystem::path styleFile;    ///< read and applied if `style` is null; empty: none
    int threads = 0;
    const Progress* progress = nullptr;
};

/// The options that a user can set.
record::Members<BuildOptions> membersOf(const BuildOptions*) noexcept;

/// Figures of a build, printed by `svt build --json`.
struct BuildReport {
    std::size_t objects = 0;  ///< voxelized features
    std::size_t triangles = 0;
    std::size_t open = 0;        ///< objects with solid meaning whose shell is open as read, however it was closed
    std::size_t tJunctions = 0;  ///< closed objects with edges that match only up to T-junctions
    std::array<std::size_t, 6> closingMethods{};  ///< objects per mesh::ClosingMethod: how they were closed
    std::uint64_t uncertainVoxels = 0;     ///< of all open shells: voxels with a winding number between 0.25 and 0.75
    std::optional<SpacingChoice> spacing;  ///< the chosen spacing; empty if one was requested
    struct Seconds {
        double read = 0, mesh = 0, voxelize = 0, pack = 0, write = 0, total = 0;
    } seconds;  ///< voxelize: meshes in memory to the finished canonical volume; pack: labels, counts, checks
};

struct BuildOutput {
    volume::SemanticVolume volume;
    BuildReport report;
};

/// Reads all files into one model (ids made unique), meshes, voxelizes, labels.
/// \param log  receives all findings; may be null
/// \return the volume and its figures, or the first error of a stage or of readStyleSheet(); EmptyModel if the model is
///         outside a given grid
[[nodiscard]] Result<BuildOutput> buildVolume(std::span<const std::filesystem::path> files,
                                              const BuildOptions& options = {}, Diagnostics* log = nullptr);

/// The same for a model in memory; `model` gains the phases of its objects (model/phases.hpp) and ClosureSurface
/// features for caps.
[[nodiscard]] Result<BuildOutput> buildVolume(model::BuildingModel& model, const BuildOptions& options = {},
                                              Diagnostics* log = nullptr);

/// The grid requested by `options` for the meshes.
/// \param choice  receives the chosen spacing if none was requested; may be null
[[nodiscard]] Result<volume::Grid> chooseGrid(const mesh::MeshSet& meshes, const BuildOptions& options,
                                              std::optional<SpacingChoice>* choice = nullptr);

}  // namespace svt::pipeline
