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
    int axisOrder = 0;        ///< ReadOptions::axisOrder of all files
    double unit = 0;          ///< ReadOptions::unit of all files
    std::string date{};       ///< ReadOptions::date
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
    std::uint32_t idHash = 0;  ///< of its id; of its content if the file gives no id; 0 in plans of earlier programs
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
    static constexpr std::size_t kNamedConflicts = 20;
    std::uint64_t conflicts = 0;
    std::vector<std::string> conflictIds;  ///< of the first kNamedConflicts
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
    double mostLeftOut = 20;      ///< percent of the features that may be left out because they cannot be read
    const Progress* progress = nullptr;
};

/// All files that `inputs` name, in order of names. A folder stands for all entries below it that have the ending of a
/// model and are not folders themselves.
/// \return the files, or CannotOpen for a missing input or a folder without models
[[nodiscard]] Result<std::vector<std::filesystem::path>> cityInputs(std::span<const std::filesystem::path> inputs);

/// Reads all files once and writes the plan into `folder`/plan.
///
/// A feature belongs to the tile that holds the middle of its box. A feature is left out if an earlier file has one
/// with the same id: Replica if the text is equal, one finding per file, else IdConflict. Features that do not exist on
/// the date are left out, too (FeatureEnded), and features that cannot be read or have no geometry (FeatureSkipped).
/// Features that refer to others are reported (LinkedFeature).
/// \return the plan, or the error of a file that cannot be cut into features; Truncated; EmptyModel if nothing is left;
///         ManySkipped if more features cannot be read than allowed; BadArgument; CannotWrite, DiskFull; Cancelled
/// Cost: about that of reading the files. Memory: 52 bytes per feature, and a few hundred MB.
[[nodiscard]] Result<Plan> makePlan(std::span<const std::filesystem::path> files, const std::filesystem::path& folder,
                                    const PlanOptions& options, Diagnostics& diagnostics);

/// Differences of a plan from the previous one.
struct PlanChanges {
    std::uint64_t newFeatures = 0, goneFeatures = 0;  ///< by id
    std::uint64_t changedFeatures = 0;                ///< the same id with other content
    std::uint64_t newTiles = 0, changedTiles = 0, goneTiles = 0;
    std::uint64_t keptPacks = 0;  ///< built packs that also belong to the new plan
};
/// Replaces the plan of a folder with a new one of the same program, made like makePlan() does. The packs of the new plan
/// are built in a folder of their own (workFolder()), so the city stays readable until mergeCity() replaces it. Built
/// packs whose content stays the same are taken over. May be called again after a crash.
/// \return the plan; BadPlan if the folder does not have one
[[nodiscard]] Result<Plan> updatePlan(std::span<const std::filesystem::path> files, const std::filesystem::path& folder,
                                      const PlanOptions& options, Diagnostics& diagnostics, PlanChanges& changes);

/// The folder of the packs and reports of the plan: `folder`, or `folder`/update during an update.
[[nodiscard]] std::filesystem::path workFolder(const std::filesystem::path& folder);

/// Ends an update: moves a merged update to the place of the city before it. Without one it does nothing. May be called
/// again after a crash. \return nothing, or CannotWrite
Result<void> publishUpdate(const std::filesystem::path& folder);

/// A source file that is not the one of the plan.
struct ChangedInput {
    std::string path;
    bool isRemoved = false;  ///< else its content changed
};
/// Compares the source files with the plan: all by size, and those that were written after the plan by the content of
/// their features.
/// \param isProven  compares the content of all files
/// \return the removed and changed files, in the order of the plan; BadPlan
[[nodiscard]] Result<std::vector<ChangedInput>> changedInputs(const std::filesystem::path& folder, const Plan& plan,
                                                              bool isProven);

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
