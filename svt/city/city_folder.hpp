#pragma once
/// \file
/// A city on disk as a whole: merged from its packs, and asked for tiles, boxes and ids. docs/formats/city.md specifies
/// city.json, index.bin and ids.bin.

#include <svt/city/city_pack.hpp>
#include <svt/city/city_plan.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace svt::city {

class Store;

/// Where a tile stands at one level of detail. Of details 2 and up the tile is a square of 1024 * 2^level samples
/// (tileSide()), and the coarsest detail is one tile that may reach over its square.
struct IndexEntry {
    TileKey tile;
    int detail = 0;
    std::uint32_t pack = 0;
    std::uint64_t offset = 0, size = 0;
    std::int32_t lowest = 0, highest = 0;  ///< metres above datum, rounded outwards
    std::uint32_t buildings = 0;
    /// West, south, east, north of its samples in metres, rounded outwards; nothing (all 0) in cities of version 1.
    std::array<std::int32_t, 4> rectangle{};
    [[nodiscard]] bool hasRectangle() const noexcept { return rectangle[0] < rectangle[2]; }
};

/// A rectangle (west, south, east, north) without bounds, for which City::find() finds all tiles.
inline constexpr std::array<double, 4> kEverywhere{
    -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

/// How far a building may reach over the square of its tile, in metres: its middle is inside.
inline constexpr double kMostReach = 500;

/// What is done of a plan.
struct CityStatus {
    std::uint32_t packs = 0;
    std::vector<std::uint32_t> missing;  ///< packs without a report that fits, or with another size
    std::uint64_t bytes = 0, buildings = 0;
    std::vector<SkippedFeature> skipped;
};
/// \param isProven  whether the SHA-256 of each pack is compared, too
[[nodiscard]] CityStatus cityStatus(const std::filesystem::path& folder, const Plan& plan, bool isProven);

/// Merges the packs of a plan that are there: makes the coarse levels (city_levels.hpp) in packs behind those of the plan;
/// writes packs.bin, index.bin, ids.bin and, last, city.json. Copies no pack.
/// \param threads  0: all cores; the result does not depend on it
/// \return what is merged and what is missing, or BadPack, CannotWrite, DiskFull; CityIncomplete if no pack is done
/// Memory: 80 bytes a tile, 24 a building, and 2 MB a tile along the border of what is done: 4 sqrt(tiles) MB.
[[nodiscard]] Result<CityStatus> mergeCity(const std::filesystem::path& folder, const Plan& plan, int threads = 0,
                                           const Progress* progress = nullptr);

/// What city.json tells of the files beside it.
struct CityProof {
    struct File {
        std::uint64_t bytes = 0;
        std::string sha256;
    };
    File index, ids, packs;
    std::uint64_t root = 0, fence = 0;  ///< checksums of the root of the index and of the fence of the ids
    std::uint64_t idCount = 0;
};

/// A merged city.
class City {
public:
    /// Of city.json. Older ones are read, too.
    static constexpr int kVersion = 2;

    /// Reads city.json and the root of the index, and proves what it reads: city.json by its digest, in a folder index.bin,
    /// ids.bin and packs.bin by size and SHA-256 (of files over 64 MiB the size alone). The files of a server, and larger
    /// ones, are proven page by page when they are read. Cities of earlier programs have no digests: only their pages are
    /// proven.
    /// \param folder  or the address of one (http://, https://), which is read by requests for ranges
    /// \return the city, or BadCity where one of them is missing or damaged; PlanVersion; CannotOpen where a server does
    ///         not answer, or not with the ranges that are asked for
    [[nodiscard]] static Result<City> open(const std::filesystem::path& folder);
    /// The same of files that are open. \param folder  for messages
    [[nodiscard]] static Result<City> open(std::shared_ptr<const Store> store, const std::filesystem::path& folder);

    [[nodiscard]] double spacing() const noexcept { return spacing_; }
    [[nodiscard]] const std::string& crsName() const noexcept { return crsName_; }
    [[nodiscard]] std::uint64_t buildings() const noexcept { return buildings_; }
    [[nodiscard]] std::uint64_t tiles() const noexcept { return tiles_; }
    [[nodiscard]] std::uint32_t packs() const noexcept { return packs_; }
    [[nodiscard]] std::uint64_t packBytes() const noexcept { return packBytes_; }
    [[nodiscard]] std::uint64_t missingPacks() const noexcept { return missing_; }
    [[nodiscard]] std::uint64_t skippedFeatures() const noexcept { return skipped_; }
    [[nodiscard]] const std::string& planDigest() const noexcept { return plan_; }
    [[nodiscard]] const Box3d& box() const noexcept { return box_; }
    /// The coarsest level of detail: one tile.
    [[nodiscard]] int topDetail() const noexcept { return top_.detail; }
    /// Its tile, which city.json names, so that it is there without a look into the index.
    [[nodiscard]] const IndexEntry& top() const noexcept { return top_; }
    /// Classes of the buildings, as far as city.json lists them.
    struct Class {
        std::string name;
        std::string color;  ///< "#rrggbb", by default
        std::uint64_t buildings = 0;
        /// Classes of their parts (RoofSurface), and colours.
        std::vector<std::pair<std::string, std::string>> parts;
    };
    [[nodiscard]] const std::vector<Class>& classes() const noexcept { return classes_; }

    /// Entries of a level of detail whose tiles meet [west, south, east, north] (metres); all for kEverywhere.
    /// Reads only the pages of the index that meet it.
    [[nodiscard]] Result<std::vector<IndexEntry>> find(int detail, const std::array<double, 4>& rectangle) const;
    /// Where buildings with an id stand: tile and label of detail 0. Reads the fence and one or two pages of ids.bin.
    struct Place {
        TileKey tile;
        std::uint32_t label = 0;
    };
    [[nodiscard]] Result<std::vector<Place>> find(const std::string& id) const;

    /// The volume of an entry. Reads its bytes alone. May be called from several threads.
    /// \return the volume, or BadPack where it is damaged or that of another tile; CannotOpen, BadCity of servers
    [[nodiscard]] Result<volume::SemanticVolume> read(const IndexEntry& entry) const;
    /// The bytes of an entry: a `.svt` file. \return the bytes, or BadPack, CannotOpen, BadCity
    [[nodiscard]] Result<std::string> readBytes(const IndexEntry& entry) const;

private:
    struct Page;
    explicit City(std::filesystem::path folder) : folder_(std::move(folder)) {}
    [[nodiscard]] Error damaged(const char* file, std::string_view what) const;
    Result<void> readJson(const std::string& text);
    Result<void> readRoot();
    Result<void> readPackSizes();
    Result<void> proveFolder() const;
    Result<void> readEntries(const Page& page, std::vector<IndexEntry>& to) const;

    std::filesystem::path folder_;
    std::shared_ptr<const Store> store_;
    double spacing_ = 0;
    std::string crsName_, plan_;
    std::uint64_t buildings_ = 0, tiles_ = 0, packBytes_ = 0, missing_ = 0, skipped_ = 0;
    std::uint32_t packs_ = 0;
    Box3d box_;
    IndexEntry top_;
    std::vector<Class> classes_;
    std::string root_;  // of the index
    std::optional<CityProof> proof_;
    std::vector<std::uint64_t> packSizes_;
};

/// Chosen parts of a city as one volume.
struct Extract {
    std::vector<TileKey> tiles;    ///< whole tiles
    std::vector<std::string> ids;  ///< buildings by id
    std::array<double, 6> box{};   ///< west, south, lowest, east, north, highest
    bool hasBox = false;
    int detail = 0;
};

/// Puts parts of a city together on its lattice. Of buildings by id, the samples around them and their labels alone. Samples of one tile are those of its member; where several tiles fill a
/// sample, the first along the Morton curve has it.
/// \return the volume, or NothingSelected, BadArgument, GridTooLarge, BadPack, BadCity
[[nodiscard]] Result<volume::SemanticVolume> extractVolume(const City& city, const Extract& extract);

/// The whole city at the finest detail that keeps both limits; at the coarsest one if none does.
/// \param mostBytes    of all members of the detail
/// \param mostSamples  along the longer side of the city
/// \return the volume, or an error of City::find() or extractVolume()
[[nodiscard]] Result<volume::SemanticVolume> wholeVolume(const City& city, std::uint64_t mostBytes, double mostSamples);

}  // namespace svt::city
