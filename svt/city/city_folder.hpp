#pragma once
/// \file
/// A whole city on disk: merged from its packs, and searched by tile, box, id and words. docs/formats/city.md specifies
/// city.json, index.bin, ids.bin and words.bin.

#include <svt/city/city_pack.hpp>
#include <svt/city/city_plan.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::city {

class Store;

/// The place of a tile's volume at one level of detail. At details 2 and up, the tile is a square of 1024 * 2^level
/// samples (tileSide()). The coarsest detail is one tile that may reach over its square.
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

/// A rectangle (west, south, east, north) without bounds: City::find() finds all tiles in it.
inline constexpr std::array<double, 4> kEverywhere{
    -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

/// Maximum distance that a building may reach over the square of its tile, in metres. The middle of its box is inside.
inline constexpr double kMostReach = 500;

/// The finished part of a plan.
struct CityStatus {
    std::uint32_t packs = 0;
    std::vector<std::uint32_t> missing;  ///< packs without a matching report, or with another size
    std::uint64_t bytes = 0, buildings = 0;
    std::vector<SkippedFeature> skipped;
    bool isUpdate = false;  ///< the packs are those of an update; the city before it is readable
};
/// \param isProven  whether the SHA-256 of each pack is compared as well
[[nodiscard]] CityStatus cityStatus(const std::filesystem::path& folder, const Plan& plan, bool isProven);

/// Merges the existing packs of a plan. Makes the coarse levels (city_levels.hpp) in packs numbered after those of the
/// plan. Writes packs.bin, index.bin, ids.bin, words.bin and, last, city.json. Copies no pack.
/// An update (updatePlan()) replaces the city only when all of its packs exist; otherwise nothing is written.
/// \param threads  0: all cores; the result does not depend on it
/// \return the merged and the missing parts, or BadPack, CannotWrite, DiskFull; CityIncomplete if no pack is done
/// Memory: 80 bytes per tile, 24 per building, 256 MB for words, and 2 MB per tile along the border of the finished
/// part: 4 sqrt(n) MB for n tiles. More words are sorted in temporary files.
[[nodiscard]] Result<CityStatus> mergeCity(const std::filesystem::path& folder, const Plan& plan, int threads = 0,
                                           const Progress* progress = nullptr);

/// Sizes and digests that city.json states for the files next to it.
struct CityProof {
    struct File {
        std::uint64_t bytes = 0;
        std::string sha256;
    };
    File index, ids, packs;
    std::uint64_t root = 0, fence = 0;  ///< checksums of the root of the index and of the fence of the ids
    std::uint64_t idCount = 0;
    struct Words : File {
        std::uint64_t count = 0;    ///< buildings
        std::uint64_t fenceAt = 0;  ///< offset of the fence, which ends with the file
        std::uint64_t fence = 0;    ///< its checksum
    };
    std::optional<Words> words;  ///< none of cities of earlier programs
};

/// A merged city.
class City {
public:
    /// Version of city.json. Older versions are read as well.
    static constexpr int kVersion = 2;

    /// Reads city.json and the root of the index, and verifies them. city.json is verified by its digest. In a folder,
    /// index.bin, ids.bin, words.bin and packs.bin are verified by size and SHA-256; files over 64 MiB only by size. Those and the
    /// files of a server are verified page by page when they are read. Cities of earlier programs have no digests: only
    /// their pages are verified.
    /// \param folder  a folder, or the address of one (http://, https://), which is read by requests for ranges
    /// \return the city, or BadCity if one of the files is missing or damaged; PlanVersion; CannotOpen if a server does
    ///         not answer, or answers with other ranges than requested
    [[nodiscard]] static Result<City> open(const std::filesystem::path& folder);
    /// The same for an open store. \param folder  for messages
    [[nodiscard]] static Result<City> open(std::shared_ptr<const Store> store, const std::filesystem::path& folder);

    [[nodiscard]] double spacing() const noexcept { return spacing_; }
    [[nodiscard]] const std::string& crsName() const noexcept { return crsName_; }
    [[nodiscard]] std::uint64_t buildings() const noexcept { return buildings_; }
    [[nodiscard]] std::uint64_t tiles() const noexcept { return tiles_; }
    [[nodiscard]] std::uint32_t packs() const noexcept { return packs_; }
    [[nodiscard]] std::uint64_t packBytes() const noexcept { return packBytes_; }
    [[nodiscard]] std::uint64_t missingPacks() const noexcept { return missing_; }
    [[nodiscard]] std::uint64_t skippedFeatures() const noexcept { return skipped_; }
    /// Features that the city lacks because an earlier file had another feature with their id; the ids of the first.
    [[nodiscard]] std::uint64_t idConflicts() const noexcept { return conflicts_; }
    [[nodiscard]] const std::vector<std::string>& conflictIds() const noexcept { return conflictIds_; }
    [[nodiscard]] const std::string& planDigest() const noexcept { return plan_; }
    [[nodiscard]] const Box3d& box() const noexcept { return box_; }
    /// The coarsest level of detail: one tile.
    [[nodiscard]] int topDetail() const noexcept { return top_.detail; }
    /// The tile of topDetail(). city.json names it, so it is known without the index.
    [[nodiscard]] const IndexEntry& top() const noexcept { return top_; }
    /// A class of buildings that city.json lists.
    struct Class {
        std::string name;
        std::string color;  ///< "#rrggbb", by default
        std::uint64_t buildings = 0;
        /// Classes of their parts (such as RoofSurface), and colours.
        std::vector<std::pair<std::string, std::string>> parts;
    };
    [[nodiscard]] const std::vector<Class>& classes() const noexcept { return classes_; }

    /// Entries of a level of detail whose tiles meet the rectangle [west, south, east, north] (metres); all for
    /// kEverywhere. Reads only the pages of the index that meet the rectangle.
    [[nodiscard]] Result<std::vector<IndexEntry>> find(int detail, const std::array<double, 4>& rectangle) const;
    /// A building with an id: its tile, and its label at detail 0. Reads the fence and one or two pages of ids.bin.
    struct Place {
        TileKey tile;
        std::uint32_t label = 0;
    };
    [[nodiscard]] Result<std::vector<Place>> find(const std::string& id) const;

    /// Buildings that a search found.
    struct Found {
        struct Building {
            std::string id, name, className, address;
        };
        std::uint64_t count = 0;          ///< of all
        std::vector<Building> buildings;  ///< the first ones, in the order of tiles: neighbours are near each other
    };
    /// Buildings with all words of a text in their name, in their attributes, or in those of their parts and units. Case
    /// does not matter. The last word is the beginning of a word, unless a blank follows. "year=1965" is the value of an
    /// attribute, and class=Bridge a class; quotes keep blanks: street="Main Road". Ids are for find().
    /// Reads the fence of words.bin, and the pages of these words and buildings.
    /// \param most  maximum of Found::buildings
    /// \return the buildings; BadArgument for a text without words, and if too many words have the beginning (their pages
    ///         exceed 16 MiB); BadCity if words.bin is damaged, or missing because an earlier program merged the city
    [[nodiscard]] Result<Found> search(std::string_view text, std::size_t most) const;

    /// The volume of an entry. Reads only its bytes. May be called from several threads. Its meshes are moved to
    /// SemanticVolume::footprints, because joined volumes have no meshes.
    /// \return the volume, or BadPack if it is damaged or belongs to another tile; CannotOpen or BadCity for servers
    [[nodiscard]] Result<volume::SemanticVolume> read(const IndexEntry& entry) const;
    /// The same with its meshes, if the tile keeps any.
    [[nodiscard]] Result<volume::SemanticVolume> readWithMeshes(const IndexEntry& entry) const;
    /// The bytes of an entry: a `.svt` file. \return the bytes, or BadPack, CannotOpen, BadCity
    [[nodiscard]] Result<std::string> readBytes(const IndexEntry& entry) const;

private:
    struct Page;
    friend class WordSearch;
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
    std::uint64_t buildings_ = 0, tiles_ = 0, packBytes_ = 0, missing_ = 0, skipped_ = 0, conflicts_ = 0;
    std::vector<std::string> conflictIds_;
    std::uint32_t packs_ = 0;
    Box3d box_;
    IndexEntry top_;
    std::vector<Class> classes_;
    std::string root_;  // of the index
    std::optional<CityProof> proof_;
    std::vector<std::uint64_t> packSizes_;
};

/// Moves the meshes of a tile to SemanticVolume::footprints, as City::read() does.
void keepAsFootprints(volume::SemanticVolume& tile);

/// Chosen parts of a city as one volume.
struct Extract {
    std::vector<TileKey> tiles;    ///< whole tiles
    std::vector<std::string> ids;  ///< buildings by id
    std::array<double, 6> box{};   ///< west, south, lowest, east, north, highest
    bool hasBox = false;
    int detail = 0;
};

/// Joins the selected parts of a city into one volume on its lattice. With ids: only the labels of these buildings,
/// cropped to the samples around them. Samples of a single tile equal those of its member. Where several tiles fill a
/// sample, the first tile along the Morton curve determines it.
/// \return the volume, or NothingSelected, BadArgument, GridTooLarge, BadPack, BadCity
[[nodiscard]] Result<volume::SemanticVolume> extractVolume(const City& city, const Extract& extract);

/// The whole city at the finest detail within both limits; at the coarsest detail if none is.
/// \param mostBytes    of all members of the detail
/// \param mostSamples  along the longer side of the city
/// \return the volume, or an error of City::find() or extractVolume()
[[nodiscard]] Result<volume::SemanticVolume> wholeVolume(const City& city, std::uint64_t mostBytes, double mostSamples);

}  // namespace svt::city
