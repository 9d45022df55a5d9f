#pragma once
/// \file
/// Builds the volumes of tiles from the features of a plan.

#include <svt/city/city_pack.hpp>
#include <svt/city/city_plan.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <map>
#include <optional>
#include <set>

namespace svt::city {

/// The features of a pack as texts, with the files that they come from. Features are named by their number in the pack.
class PackFeatures {
public:
    /// Reads the text of all features of a pack, each file once.
    /// \return the features, or InputChanged if a text differs from the planned one; or an error of FeatureFile
    [[nodiscard]] static Result<PackFeatures> read(const std::filesystem::path& folder, const Plan& plan,
                                                   std::uint32_t pack);

    /// Features [first, second) of a tile, by its number in the plan.
    [[nodiscard]] std::array<std::uint32_t, 2> ofTile(std::size_t tile) const;
    [[nodiscard]] std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(features_.size()); }
    [[nodiscard]] std::string_view text(std::uint32_t feature) const { return texts_[feature]; }
    [[nodiscard]] SkippedFeature skipped(std::uint32_t feature, std::string reason) const;

    /// Features as one model, in their order, file by file.
    [[nodiscard]] Result<model::BuildingModel> model(std::span<const std::uint32_t> features, int threads) const;

private:
    explicit PackFeatures(const Plan& plan) : plan_(&plan) {}
    Result<void> readFile(std::uint32_t file, std::span<const std::uint32_t> features);

    const Plan* plan_;
    std::uint64_t first_ = 0;  // number in the plan of the pack's first feature
    std::vector<PlanFeature> features_;
    std::vector<std::string> texts_;
    std::map<std::uint32_t, readers::FeatureFile> files_;
};

/// The volumes of a tile.
struct BuiltTile {
    volume::SemanticVolume full, buildings;  ///< details 0 and 1
    std::vector<PackBuilding> labels;        ///< of detail 0
};

/// Builds features as a tile of the city.
/// \return the tile; nothing if no voxel is filled; or the error of a stage
[[nodiscard]] Result<std::optional<BuiltTile>> buildTile(const PackFeatures& features,
                                                         std::span<const std::uint32_t> chosen,
                                                         const CityOptions& options, int threads);

/// Coarsens to twice the spacing, with one label per building (a root of the tree) and, below it, one per class of its
/// parts. Each cell takes the dominant building, then the dominant class of its parts. The building's own body is taken
/// only where no other part of it is in the cell.
[[nodiscard]] Result<volume::SemanticVolume> buildingsOf(const volume::SemanticVolume& full, int threads);

/// The grid of the city's lattice around a box: samples at (n + 1/2) * spacing, from a multiple of four on.
[[nodiscard]] Result<volume::Grid> latticeGrid(const Box3d& box, double spacing);

}  // namespace svt::city
