#pragma once
/// \file
/// The plan of a city: the features of each tile, with their files, and the tiles of each pack. It is made in one pass
/// over all files. Later, the build of a pack reads only the features of its tiles. docs/formats/city.md specifies the
/// files of a plan.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/readers/feature_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace svt::city {

/// Options that determine the content of a city, in addition to its files.
struct CityOptions {
    double spacing = 0.5;     ///< metres between samples of the finest level, 0.001..100
    double lod = -1;          ///< finest level of detail of the models to use; -1: the finest that each feature has
    int crs = 0;              ///< EPSG code of a projection in metres; 0: that of the first file
    double packSeconds = 10;  ///< expected work in a pack
    friend bool operator==(const CityOptions&, const CityOptions&) = default;
};

/// A square of 2^level metres: x from `x` * 2^level on, y likewise.
struct TileKey {
    int level = 10;
    std::int32_t x = 0, y = 0;
    friend bool operator==(const TileKey&, const TileKey&) = default;
    /// "10/383/5812".
    [[nodiscard]] std::string toString() const;
    /// \param most  the largest level
    [[nodiscard]] static Result<TileKey> fromString(const std::string& text, int most = 10);
};

/// An input file, with the options for reading all of its features.
struct PlanFile {
    std::string path;  ///< absolute
    std::uint64_t size = 0;
    int crs = 0;                 ///< for ReadOptions::crs
    int axisOrder = 0;           ///< for ReadOptions::axisOrder
    std::uint64_t headHash = 0;  ///< of the head of the file, which is read with each feature
};

struct PlanFeature {
    std::uint32_t file = 0;
    readers::FeatureSpan span;
    std::uint64_t contentHash = 0;
};

struct PlanTile {
    TileKey key;
    std::uint64_t firstFeature = 0;
    std::uint32_t featureCount = 0;
    std::uint32_t pack = 0;
    std::uint64_t cost = 0;  ///< microseconds, estimated
};

/// A plan without its features, which are read tile by tile.
struct Plan {
    static constexpr int kTopLevel = 10;  ///< tiles are squares of 1024 m and their quarters
    static constexpr std::uint32_t kMaxFeatures = 256;

    CityOptions options;
    std::string program;         ///< version of the program that made it
    std::string digest;          ///< SHA-256 of the whole plan, 64 hexadecimal digits
    std::string featuresDigest;  ///< SHA-256 of features.bin, likewise
    int crs = 0;
    std::string crsName;
    std::vector<PlanFile> files;
    std::vector<PlanTile> tiles;  ///< ordered along the Morton curve
    /// By pack, 64 hexadecimal digits: SHA-256 of everything that determines its bytes. Packs of two plans with equal
    /// digests are the same.
    std::vector<std::string> packDigests;
    std::uint64_t features = 0, replicas = 0, skipped = 0;
    std::uint32_t packs = 0;
    std::uint32_t tasks = 0;  ///< for a cluster of machines: each task builds packs / tasks packs

    /// The tiles of a pack: [first, second) in `tiles`.
    [[nodiscard]] std::array<std::size_t, 2> tilesOf(std::uint32_t pack) const;
    /// The packs of task `task` of `tasks`: [first, second).
    [[nodiscard]] std::array<std::uint32_t, 2> packsOf(std::uint32_t task, std::uint32_t tasks) const;
};

struct PlanOptions {
    CityOptions city;
    std::string program;      ///< version of the program
    std::uint32_t tasks = 0;  ///< 0: by cost, about 5 minutes each, at most 1000
    int threads = 0;
    bool allowTruncated = false;  ///< for ReadOptions::allowTruncated
    const Progress* progress = nullptr;
};

/// All files that `inputs` name, in order of names. A folder stands for all entries below it that have the ending of a
/// model and are not folders themselves.
/// \return the files, or CannotOpen for a missing input or a folder without models
[[nodiscard]] Result<std::vector<std::filesystem::path>> cityInputs(std::span<const std::filesystem::path> inputs);

/// Reads all files once and writes the plan into `folder`/plan.
///
/// A feature belongs to the tile that holds the middle of its box. A feature is left out if an earlier file has one
/// with the same id and text (finding Replica, one per file). Features that refer to others are reported
/// (LinkedFeature). Features that cannot be read or have no geometry are left out and reported (FeatureSkipped).
/// \return the plan, or the error of a file that cannot be cut into features; Truncated; EmptyModel if nothing is left;
///         BadArgument; CannotWrite, DiskFull; Cancelled
/// Cost: about that of reading the files. Memory: 52 bytes per feature, and a few hundred MB.
[[nodiscard]] Result<Plan> makePlan(std::span<const std::filesystem::path> files, const std::filesystem::path& folder,
                                    const PlanOptions& options, Diagnostics& diagnostics);

/// Differences of a plan from the previous one.
struct PlanChanges {
    std::uint64_t newFeatures = 0, goneFeatures = 0;  ///< by content
    std::uint64_t newTiles = 0, changedTiles = 0, goneTiles = 0;
    std::uint64_t keptPacks = 0;  ///< built packs that also belong to the new plan
};
/// Replaces the plan of a folder with a new one of the same program, made like makePlan() does. Built packs whose
/// content stays the same keep their bytes under a new number. Unused packs are removed, and the city must be merged
/// again. May be called again after a crash; then at most one pack is built again.
/// \return the plan; BadPlan if the folder does not have one
[[nodiscard]] Result<Plan> updatePlan(std::span<const std::filesystem::path> files, const std::filesystem::path& folder,
                                      const PlanOptions& options, Diagnostics& diagnostics, PlanChanges& changes);

/// Reads the plan of a folder.
/// \param program  version of this program; a plan of another version is PlanVersion; empty: any
/// \return the plan, or BadPlan (missing or damaged), PlanVersion
[[nodiscard]] Result<Plan> readPlan(const std::filesystem::path& folder, const std::string& program);

/// The features of tiles [first, last) of a plan, in their order.
/// \return the features, or BadPlan
[[nodiscard]] Result<std::vector<PlanFeature>> readPlanFeatures(const std::filesystem::path& folder, const Plan& plan,
                                                                std::size_t first, std::size_t last);

/// Morton number of a tile's south-western corner, in cells of one metre: the order of tiles.
[[nodiscard]] std::uint64_t mortonOf(const TileKey& key) noexcept;

}  // namespace svt::city
