#include <svt/core/hash.hpp>
#include <svt/core/hash_index.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/bricks/brick_clusters.hpp>
#include <svt/volume/bricks/code_boxes.hpp>
#include <svt/volume/bricks/face_cuts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <unordered_map>

namespace svt::volume {
namespace {

constexpr std::uint32_t kMixedBit = 0x80000000u;
constexpr std::int32_t kClusterSize = BrickVolume::kClusterSize;
constexpr std::int32_t kBricksPerTile = ColumnVolume::kTileSize / BrickVolume::kBrickSize;
static_assert(kBricksPerTile % kClusterSize == 0);

// The bricks of a tile. `entries` holds the distinct columns of bricks, bricksZ entries each. An entry is an index in
// `scalars`, or with kMixedBit an index in `patterns`.
struct TileBricks {
    std::array<std::uint8_t, kBricksPerTile * kBricksPerTile> columnOf{};
    std::vector<std::uint32_t> entries;
    std::vector<Scalar> scalars;
    std::vector<BrickPattern> patterns;
    // Results of TileCoding:
    std::vector<BrickPlane> planes;
    TileBoxes boxes;
    // The clusters of the tile, x fastest, as BrickClusters with the numbers of the tile.
    std::vector<std::uint32_t> clusters;
    std::vector<ClusterEntries> mixed;
    std::vector<std::uint32_t> codedPatterns;  // per coded brick, by cluster: its pattern

    [[nodiscard]] std::uint32_t entryAt(std::int32_t x, std::int32_t y, std::int32_t z,
                                        std::int32_t bricksZ) const noexcept {
        const std::size_t column = columnOf[static_cast<std::size_t>(x + kBricksPerTile * y)];
        return entries[column * static_cast<std::size_t>(bricksZ) + static_cast<std::size_t>(z)];
    }
};

// One of the distinct columns in the 8 x 8 footprint of a brick.
struct FootprintColumn {
    std::uint64_t mask = 0;  // bit i + 8 j: column (i, j) of the footprint is this one
    const Run* run = nullptr;
};

// Makes the bricks of a tile from its columns. Equal footprints share a column of bricks.
class TileBricker {
public:
    TileBricker(const ColumnTile& tile, std::int32_t width, std::int32_t height, std::int32_t bricksZ)
        : tile_(tile),
          width_(width),
          height_(height),
          nz_(tile.runs.back().end),
          top_(static_cast<std::uint32_t>(bricksZ) * 8) {}

    TileBricks make() {
        std::vector<std::array<std::uint16_t, 64>> footprints;
        for (std::int32_t by = 0; by * 8 < height_; ++by)
            for (std::int32_t bx = 0; bx * 8 < width_; ++bx) {
                const std::array<std::uint16_t, 64> footprint = footprintAt(bx, by);
                const auto known = std::find(footprints.rbegin(), footprints.rend(), footprint);
                std::size_t number = static_cast<std::size_t>(footprints.rend() - known) - 1;
                if (known == footprints.rend()) {
                    number = footprints.size();
                    footprints.push_back(footprint);
                    addBrickColumn(footprint);
                }
                result_.columnOf[static_cast<std::size_t>(bx + kBricksPerTile * by)] =
                    static_cast<std::uint8_t>(number);
            }
        return std::move(result_);
    }

private:
    // Column numbers of the 8 x 8 footprint. Beyond the border of the volume, the columns at the border are repeated.
    [[nodiscard]] std::array<std::uint16_t, 64> footprintAt(std::int32_t bx, std::int32_t by) const {
        std::array<std::uint16_t, 64> footprint;
        for (std::int32_t j = 0; j < 8; ++j) {
            const auto row = static_cast<std::size_t>(std::min(by * 8 + j, height_ - 1));
            const std::uint16_t* numbers =
                tile_.rowColumns.data() + static_cast<std::size_t>(tile_.rowOf[row]) * static_cast<std::size_t>(width_);
            for (std::int32_t i = 0; i < 8; ++i)
                footprint[static_cast<std::size_t>(i + 8 * j)] = numbers[std::min(bx * 8 + i, width_ - 1)];
        }
        return footprint;
    }

    void addBrickColumn(const std::array<std::uint16_t, 64>& footprint) {
        columns_.clear();
        numbers_.clear();
        std::size_t known = 0;
        for (std::size_t n = 0; n < 64; ++n) {
            if (n == 0 || footprint[n] != footprint[n - 1]) {
                known = 0;
                while (known < numbers_.size() && numbers_[known] != footprint[n]) ++known;
                if (known == numbers_.size()) {
                    numbers_.push_back(footprint[n]);
                    columns_.push_back({0, tile_.column(footprint[n]).data()});
                }
            }
            columns_[known].mask |= std::uint64_t{1} << n;
        }
        std::uint32_t bottom = 0;
        while (bottom < top_) {
            // No run ends inside [bottom, same), so all whole bricks in this range are equal.
            std::uint32_t same = top_;
            bool isUniform = true;
            for (FootprintColumn& column : columns_) {
                while (column.run->end <= bottom) ++column.run;
                same = std::min(same, endOf(*column.run));
                isUniform = isUniform && column.run->scalar == columns_.front().run->scalar;
            }
            const std::uint32_t bricks = std::max<std::uint32_t>(same / 8 - bottom / 8, 1);
            isUniform = isUniform && same >= bottom + 8;
            const std::uint32_t entry = isUniform ? scalarNumber(columns_.front().run->scalar) : brickNumber(bottom);
            result_.entries.insert(result_.entries.end(), bricks, entry);
            bottom += bricks * 8;
        }
    }

    // The last run is extended to fill the last brick.
    [[nodiscard]] std::uint32_t endOf(const Run& run) const { return run.end == nz_ ? top_ : run.end; }

    std::uint32_t scalarNumber(Scalar scalar) {
        const auto known = std::find(result_.scalars.rbegin(), result_.scalars.rend(), scalar);
        if (known != result_.scalars.rend()) return static_cast<std::uint32_t>(result_.scalars.rend() - known) - 1;
        result_.scalars.push_back(scalar);
        return static_cast<std::uint32_t>(result_.scalars.size()) - 1;
    }

    std::uint32_t brickNumber(std::uint32_t bottom) {
        palette_.clear();
        words_.fill(0);
        // In voxel order, so that the palette is in order of first use and bit planes do not depend on the labels.
        std::uint32_t same = 0;  // layers below this one equal the current layer
        for (std::uint32_t k = 0; k < 8; ++k) {
            if (k < same) {
                for (std::size_t word = k; word < words_.size(); word += 8) words_[word] = words_[word - 1];
                continue;
            }
            same = 8;
            for (const FootprintColumn& column : columns_) {
                const Run* run = column.run;
                while (endOf(*run) <= bottom + k) ++run;
                same = std::min(same, endOf(*run) - bottom);
                std::size_t index = 0;
                while (index < palette_.size() && palette_[index] != run->scalar) ++index;
                if (index == palette_.size()) palette_.push_back(run->scalar);
                for (std::size_t plane = 0; (index >> plane) != 0; ++plane)
                    if (((index >> plane) & 1u) != 0) words_[8 * plane + k] |= column.mask;
            }
        }
        const std::span<const std::uint64_t> planes(
            words_.data(), 8 * std::max<std::size_t>(1, static_cast<std::size_t>(std::bit_width(palette_.size() - 1))));
        std::uint64_t hash = planes.size();
        for (const std::uint64_t word : planes) hash = mixHash(hash, word);
        for (const Scalar scalar : palette_) hash = mixHash(hash, scalar);
        const auto isEqual = [&](std::uint32_t other) {
            const BrickPattern& pattern = result_.patterns[other];
            return pattern.palette == palette_ && std::equal(planes.begin(), planes.end(), pattern.bitPlanes.begin());
        };
        const std::uint32_t number = patternIndex_.findOrAdd(hash, isEqual, [&] {
            result_.patterns.push_back({palette_, {planes.begin(), planes.end()}});
            return static_cast<std::uint32_t>(result_.patterns.size() - 1);
        });
        return number | kMixedBit;
    }

    ColumnTile tile_;
    std::int32_t width_, height_;
    std::uint32_t nz_, top_;  // heights of the volume and of its bricks, voxels
    std::vector<FootprintColumn> columns_;
    std::vector<std::uint16_t> numbers_;  // of columns_, same order
    std::vector<Scalar> palette_;
    std::array<std::uint64_t, 8 * 9> words_{};
    HashIndex patternIndex_;
    TileBricks result_;
};

// Codes the bricks of a tile: first each pattern by cuts, then single bricks by planes.
class TileCoding {
public:
    TileCoding(TileBricks& tile, Vec3i origin, Vec3i count) : tile_(tile), places_{origin, count, {}, {}} {
        places_.patternOf.resize(places_.at(0, 0, count.z));
        places_.scalarOf.resize(places_.patternOf.size());
        std::size_t place = 0;
        for (std::int32_t z = 0; z < count.z; ++z)
            for (std::int32_t y = 0; y < count.y; ++y)
                for (std::int32_t x = 0; x < count.x; ++x, ++place) {
                    const std::uint32_t entry = tile_.entryAt(x, y, z, count.z);
                    const bool isMixed = (entry & kMixedBit) != 0;
                    places_.patternOf[place] = isMixed ? entry & ~kMixedBit : TilePlaces::kUniform;
                    places_.scalarOf[place] = isMixed ? 0 : tile_.scalars[entry];
                }
    }

    // Fills boxes, planes, clusters and codedPatterns of the tile.
    void run(BrickFaces faces, std::span<const FacePlane> planes, const ColumnVolume& columns) {
        codeIndex_.assign(places_.patternOf.size(), TileBoxes::kNone);
        if (faces == BrickFaces::Planes || (faces == BrickFaces::Slopes && !tile_.patterns.empty()))
            codeBricks(planes, faces == BrickFaces::Planes ? &columns : nullptr);
        const Vec3i count = places_.count;
        for (std::int32_t z = 0; z < count.z; z += kClusterSize)
            for (std::int32_t y = 0; y < count.y; y += kClusterSize)
                for (std::int32_t x = 0; x < count.x; x += kClusterSize) addCluster({x, y, z});
        tile_.entries = {};
        tile_.boxes.boxOf = {};
    }

private:
    // If `columns` is given, borders parallel to an axis move to faces.
    void codeBricks(std::span<const FacePlane> planes, const ColumnVolume* columns) {
        std::vector<std::uint8_t> kinds;
        std::vector<BrickCode> codes;
        std::vector<std::uint32_t> byCuts;  // by pattern: its code, or kNone
        bool isAllCoded = true;
        for (const BrickPattern& pattern : tile_.patterns) {
            auto code = codeBySides(pattern, findChanges(pattern));
            const BrickKind kind = !code                          ? BrickKind::Uncoded
                                   : code->sideScalars.size() > 2 ? BrickKind::Step
                                                                  : BrickKind::Coded;
            kinds.push_back(static_cast<std::uint8_t>(kind));
            isAllCoded = isAllCoded && kind == BrickKind::Coded;
            byCuts.push_back(code ? static_cast<std::uint32_t>(codes.size()) : TileBoxes::kNone);
            if (code) codes.push_back(std::move(*code));
        }
        for (std::size_t place = 0; place < codeIndex_.size(); ++place)
            if (places_.patternOf[place] != TilePlaces::kUniform) codeIndex_[place] = byCuts[places_.patternOf[place]];
        if (!isAllCoded) {
            TileCodes found = codeTile(places_, tile_.patterns, kinds, planes);
            tile_.planes = std::move(found.planes);
            for (PlacedCode& placed : found.codes) {
                codeIndex_[placed.place] = static_cast<std::uint32_t>(codes.size());
                codes.push_back(std::move(placed.code));
            }
        }
        TileBrickCodes coded{std::move(codeIndex_), std::move(codes), std::move(tile_.planes)};
        if (columns != nullptr) moveCutsToFaces(places_, tile_.patterns, planes, *columns, coded);
        codeIndex_ = std::move(coded.codeIndex);
        tile_.planes = std::move(coded.planes);
        tile_.boxes = findCodeBoxes(places_, codeIndex_, coded.codes, tile_.planes);
    }

    void addCluster(Vec3i first) {
        const Vec3i count = places_.count;
        const std::uint32_t corner = entryAt(first);
        ClusterEntries entries;
        bool isUniform = (corner & BrickTag::kBoxed) == 0;
        for (std::int32_t n = 0; n < 64; ++n) {
            const Vec3i at{std::min(first.x + (n & 3), count.x - 1), std::min(first.y + (n >> 2 & 3), count.y - 1),
                           std::min(first.z + (n >> 4), count.z - 1)};
            entries[std::size_t(n)] = entryAt(at);
            isUniform = isUniform && entries[std::size_t(n)] == corner;
        }
        if (isUniform) {
            tile_.clusters.push_back(corner);
            return;
        }
        tile_.clusters.push_back(static_cast<std::uint32_t>(tile_.mixed.size()) | BrickClusters::kMixed);
        tile_.mixed.push_back(entries);
        for (std::int32_t n = 0; n < 64; ++n) {
            if ((entries[std::size_t(n)] & BrickTag::kCoded) == 0) continue;
            const std::size_t place =
                places_.at(std::min(first.x + (n & 3), count.x - 1), std::min(first.y + (n >> 2 & 3), count.y - 1),
                           std::min(first.z + (n >> 4), count.z - 1));
            const std::uint32_t pattern = places_.patternOf[place];
            tile_.codedPatterns.push_back(pattern != TilePlaces::kUniform ? pattern
                                                                          : uniformPattern(places_.scalarOf[place]));
        }
    }

    // Index of the scalar, or a box or pattern with its tag.
    [[nodiscard]] std::uint32_t entryAt(Vec3i at) const noexcept {
        const std::size_t place = places_.at(at.x, at.y, at.z);
        if (codeIndex_[place] != TileBoxes::kNone) return tile_.boxes.boxOf[place] | BrickTag::kCoded;
        const std::uint32_t pattern = places_.patternOf[place];
        return pattern != TilePlaces::kUniform ? pattern | BrickTag::kVoxels
                                               : tile_.entryAt(at.x, at.y, at.z, places_.count.z);
    }

    std::uint32_t uniformPattern(Scalar scalar) {
        const auto [place, isNew] = uniform_.try_emplace(scalar, static_cast<std::uint32_t>(tile_.patterns.size()));
        if (isNew) tile_.patterns.push_back({{scalar}, std::vector<std::uint64_t>(8, 0)});
        return place->second;
    }

    TileBricks& tile_;
    TilePlaces places_;
    std::vector<std::uint32_t> codeIndex_;  // by place: index of its code, or kNone
    std::unordered_map<Scalar, std::uint32_t> uniform_;
};

}  // namespace

// Merges the bricks of all tiles, in tile order, into one volume.
class BrickMerger {
public:
    BrickMerger(BrickVolume& volume, std::int32_t tilesX, std::size_t tiles)
        : volume_(volume), tilesX_(tilesX), numbers_(tiles) {}

    // Adds scalars, patterns, planes, codes and boxes of a tile to the volume, and records their numbers there.
    // takeTile() adds the clusters of the tile.
    void addTile(std::size_t number, const TileBricks& tile) {
        Numbers& numbers = numbers_[number];
        for (const Scalar scalar : tile.scalars) numbers.scalars.push_back(scalarNumber(scalar));
        for (const BrickPattern& pattern : tile.patterns) numbers.patterns.push_back(brickNumber(pattern));
        numbers.firstBox = static_cast<std::uint32_t>(codeBoxes_.size());
        numbers.firstMixed = mixedCount_;
        numbers.firstCoded = codedCount_;
        mixedCount_ += tile.mixed.size();
        codedCount_ += tile.codedPatterns.size();
        const auto firstCode = static_cast<std::uint32_t>(volume_.codes_.size());
        std::vector<std::uint32_t> planes;
        for (const BrickPlane& plane : tile.planes) planes.push_back(planeNumber(plane));
        for (const BoxCode& code : tile.boxes.codes) addCode(code, planes);
        const Vec3i first = firstBrick(number);
        for (const CodeBox& found : tile.boxes.boxes)
            codeBoxes_.push_back(boxOf(first + found.min, first + found.max, firstCode + found.code));
    }

    // Allocates what takeTile() fills, once all tiles are added.
    void beginClusters() {
        clusters_.bricks = volume_.brickCount_;
        clusters_.clusters = volume_.clusterCount_;
        clusters_.entries.resize(clusters_.at(0, 0, clusters_.clusters.z));
        clusters_.mixed.resize(mixedCount_);
        volume_.codedPatterns_.resize(codedCount_);
    }

    // Takes the clusters of a tile, with the numbers of the volume. Thread-safe for different tiles.
    void takeTile(std::size_t number, TileBricks& tile) {
        const Numbers& numbers = numbers_[number];
        const Vec3i first = firstBrick(number), bricks = volume_.brickCount_, count = volume_.clusterCount_;
        const std::int32_t endX = (std::min(first.x + kBricksPerTile, bricks.x) + kClusterSize - 1) / kClusterSize,
                           endY = (std::min(first.y + kBricksPerTile, bricks.y) + kClusterSize - 1) / kClusterSize;
        std::size_t next = 0;
        for (std::int32_t z = 0; z < count.z; ++z)
            for (std::int32_t y = first.y / kClusterSize; y < endY; ++y)
                for (std::int32_t x = first.x / kClusterSize; x < endX; ++x) {
                    const std::uint32_t cluster = tile.clusters[next++];
                    clusters_.entries[clusters_.at(x, y, z)] =
                        (cluster & BrickClusters::kMixed) != 0
                            ? cluster + static_cast<std::uint32_t>(numbers.firstMixed)
                            : numbers.scalars[cluster];
                }
        for (std::size_t n = 0; n < tile.mixed.size(); ++n)
            for (std::size_t brick = 0; brick < 64; ++brick) {
                std::uint32_t entry = tile.mixed[n][brick];
                if ((entry & BrickTag::kCoded) != 0)
                    entry += numbers.firstBox;
                else if ((entry & BrickTag::kVoxels) != 0)
                    entry = numbers.patterns[entry & ~BrickTag::kVoxels] | BrickTag::kVoxels;
                else
                    entry = numbers.scalars[entry];
                clusters_.mixed[numbers.firstMixed + n][brick] = entry;
            }
        for (std::size_t n = 0; n < tile.codedPatterns.size(); ++n)
            volume_.codedPatterns_[numbers.firstCoded + n] = numbers.patterns[tile.codedPatterns[n]];
        tile = {};
    }

    // Makes the boxes, and the index in its final form.
    Result<void> finish(int threads) {
        codedOf_.resize(clusters_.mixed.size());
        parallelFor(codedOf_.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n)
                for (std::size_t brick = 0; brick < 64; ++brick)
                    codedOf_[n] |= std::uint64_t{(clusters_.mixed[n][brick] & BrickTag::kCoded) != 0} << brick;
        });
        for (const BrickBox& found : boxUniformBricks(clusters_, threads))
            volume_.boxes_.push_back(boxOf(found.min, found.max, scalars_[found.scalar]));
        volume_.uniformBoxes_ = volume_.boxes_.size();
        volume_.boxes_.insert(volume_.boxes_.end(), codeBoxes_.begin(), codeBoxes_.end());
        volume_.palettes_.insert(volume_.palettes_.end(), 7, 0);
        return writeLists(threads);
    }

private:
    // Per number of the tile, the number of the volume.
    struct Numbers {
        std::vector<std::uint32_t> scalars, patterns;
        std::uint32_t firstBox = 0;
        std::size_t firstMixed = 0, firstCoded = 0;
    };

    // Writes the lists of mixed clusters one after the other, and where each begins into the index.
    Result<void> writeLists(int threads) {
        constexpr std::size_t kAtOnce = 512;
        const std::size_t count = clusters_.mixed.size(), parts = (count + kAtOnce - 1) / kAtOnce;
        std::vector<std::uint32_t> sizeOf(count), codedBefore(count);
        std::vector<std::vector<std::uint32_t>> words(parts);
        std::uint32_t coded = 0;
        for (std::size_t n = 0; n < count; ++n) {
            codedBefore[n] = coded;
            coded += static_cast<std::uint32_t>(std::popcount(codedOf_[n]));
        }
        parallelFor(parts, 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t part = begin; part < end; ++part)
                for (std::size_t n = part * kAtOnce; n < std::min((part + 1) * kAtOnce, count); ++n)
                    sizeOf[n] = writeList(clusters_.mixed[n], codedOf_[n], codedBefore[n], words[part]);
        });
        std::vector<std::uint32_t> begins(count);
        std::size_t total = 0;
        for (std::size_t n = 0; n < count; ++n) {
            begins[n] = static_cast<std::uint32_t>(total);
            total += sizeOf[n];
        }
        if (total >= BrickVolume::kMixedCluster)
            return Error(Code::GridTooLarge,
                         fmt::format("the index of the bricks takes {} words, over the limit of {}; "
                                     "choose a coarser spacing or a coarser level of detail",
                                     total, BrickVolume::kMixedCluster - 1));
        volume_.clusterWords_.resize(total);
        parallelFor(parts, 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t part = begin; part < end; ++part)
                std::copy(words[part].begin(), words[part].end(),
                          volume_.clusterWords_.begin() + std::ptrdiff_t(begins[part * kAtOnce]));
        });
        volume_.clusters_ = std::move(clusters_.entries);
        parallelFor(volume_.clusters_.size(), 16384, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t cluster = begin; cluster < end; ++cluster) {
                std::uint32_t& entry = volume_.clusters_[cluster];
                if ((entry & BrickClusters::kMixed) != 0)
                    entry = begins[entry & ~BrickClusters::kMixed] | BrickVolume::kMixedCluster;
            }
        });
        return {};
    }

    // Appends the list of a cluster to `words`; returns how many they are.
    std::uint32_t writeList(const ClusterEntries& entries, std::uint64_t coded, std::uint32_t codedBefore,
                            std::vector<std::uint32_t>& words) const {
        const auto uniform = static_cast<std::uint32_t>(volume_.uniformBoxes_);
        const auto boxes = static_cast<std::uint32_t>(volume_.boxes_.size());
        std::array<std::uint32_t, BrickVolume::kListEntries + 64> list{};
        list[0] = static_cast<std::uint32_t>(coded);
        list[1] = static_cast<std::uint32_t>(coded >> 32);
        list[2] = codedBefore;
        std::uint32_t distinct = 0;
        std::uint32_t* const known = list.data() + BrickVolume::kListEntries;
        for (std::uint32_t brick = 0; brick < 64; ++brick) {
            std::uint32_t entry = entries[brick];
            const std::uint32_t tag = entry & BrickTag::kBoxed;
            entry &= ~BrickTag::kBoxed;
            if (tag == BrickTag::kCoded) entry += uniform;
            if (tag == BrickTag::kVoxels) entry += boxes;
            std::uint32_t place = distinct;
            while (place > 0 && known[place - 1] != entry) --place;
            if (place == 0) {
                known[distinct++] = entry;
                place = distinct;
            }
            list[BrickVolume::kListPlaces + brick / 4] |= (place - 1) << (8 * (brick % 4));
        }
        const std::size_t size = BrickVolume::kListEntries + distinct;
        words.insert(words.end(), list.begin(), list.begin() + std::ptrdiff_t(size));
        return static_cast<std::uint32_t>(size);
    }

    [[nodiscard]] Vec3i firstBrick(std::size_t tile) const noexcept {
        return {static_cast<std::int32_t>(tile) % tilesX_ * kBricksPerTile,
                static_cast<std::int32_t>(tile) / tilesX_ * kBricksPerTile, 0};
    }
    [[nodiscard]] SameLabelBox boxOf(Vec3i min, Vec3i max, std::uint32_t value) const noexcept {
        SameLabelBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            box.min[a] = static_cast<std::uint16_t>(min[axis] * 8);
            box.max[a] = static_cast<std::uint16_t>(std::min(max[axis] * 8, volume_.dimension_[axis]));
        }
        box.scalar = value;
        return box;
    }

    void addCode(const BoxCode& code, const std::vector<std::uint32_t>& planes) {
        BrickVolume::BoxCoding coding;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::int32_t cut = code.cut[axis];
            if (code.cutPlane[axis] != BrickVolume::kNoPlane) {
                const std::uint32_t number = planes[code.cutPlane[axis]];
                if (number < BrickVolume::BoxCoding::kMostPlanesInCuts) {
                    coding.setPlaneInCut(axis, number);
                    continue;
                }
                cut = static_cast<std::int32_t>(
                    std::lround(-volume_.planes_[number].offset));  // between the same samples
            }
            if (cut == BoxCode::kNoCut) continue;
            coding.cut[axis] = static_cast<std::uint16_t>(cut);
            coding.cutAxes = static_cast<std::uint16_t>(coding.cutAxes | (1u << axis));
        }
        for (std::size_t p = 0; p < BrickVolume::kMaxPlanes; ++p)
            if (code.plane[p] != BrickVolume::kNoPlane) coding.plane[p] = planes[code.plane[p]];
        coding.firstSideScalar = offsetOf(code.sideScalars, volume_.palettes_, palettes_);
        volume_.codes_.push_back(coding);
    }

    std::uint32_t scalarNumber(Scalar scalar) {
        const auto [place, isNew] = scalarNumbers_.try_emplace(scalar, static_cast<std::uint32_t>(scalars_.size()));
        if (isNew) {
            scalars_.push_back(scalar);
            volume_.scalarCount_ = std::max(volume_.scalarCount_, std::uint64_t{scalar} + 1);
        }
        return place->second;
    }

    // Equal planes, such as those of the model, are shared by all tiles.
    std::uint32_t planeNumber(const BrickPlane& plane) {
        std::uint64_t hash = 0;
        for (const double part : {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset})
            hash = mixHash(hash, std::bit_cast<std::uint64_t>(part));
        return planeIndex_.findOrAdd(
            hash, [&](std::uint32_t other) { return volume_.planes_[other] == plane; },
            [&] {
                volume_.planes_.push_back(plane);
                return static_cast<std::uint32_t>(volume_.planes_.size() - 1);
            });
    }

    std::uint32_t brickNumber(const BrickPattern& pattern) {
        std::uint64_t hash = pattern.bitPlanes.size();
        for (const std::uint64_t word : pattern.bitPlanes) hash = mixHash(hash, word);
        for (const Scalar scalar : pattern.palette) hash = mixHash(hash, scalar);
        const auto equals = [](const auto& wanted, const auto& stored, std::uint32_t first) {
            return std::equal(wanted.begin(), wanted.end(), stored.begin() + first);
        };
        const auto isEqual = [&](std::uint32_t other) {
            const BrickVolume::PaletteBrick& candidate = volume_.bricks_[other];
            return candidate.paletteSize == pattern.palette.size() &&
                   equals(pattern.palette, volume_.palettes_, candidate.palette) &&
                   equals(pattern.bitPlanes, volume_.bitPlanes_, candidate.bitPlanes);
        };
        return brickIndex_.findOrAdd(hash, isEqual, [&] { return addBrick(pattern); });
    }

    std::uint32_t addBrick(const BrickPattern& pattern) {
        BrickVolume::PaletteBrick added;
        added.palette = offsetOf(pattern.palette, volume_.palettes_, palettes_);
        added.bitPlanes = offsetOf(pattern.bitPlanes, volume_.bitPlanes_, bitPlaneSets_);
        added.bitPlaneCount = static_cast<std::uint32_t>(pattern.bitPlanes.size() / 8);
        added.paletteSize = static_cast<std::uint32_t>(pattern.palette.size());
        for (const Scalar scalar : pattern.palette)
            volume_.scalarCount_ = std::max(volume_.scalarCount_, std::uint64_t{scalar} + 1);
        volume_.bricks_.push_back(added);
        return static_cast<std::uint32_t>(volume_.bricks_.size() - 1);
    }

    // Sets of values in one array, each stored once.
    struct SharedSets {
        HashIndex index;
        std::vector<std::pair<std::uint32_t, std::size_t>> sets;  // first, size
    };
    template <class T>
    static std::uint32_t offsetOf(const std::vector<T>& set, std::vector<T>& store, SharedSets& shared) {
        std::uint64_t hash = set.size();
        for (const T value : set) hash = mixHash(hash, value);
        const auto isEqual = [&](std::uint32_t other) {
            const auto [first, size] = shared.sets[other];
            return size == set.size() && std::equal(set.begin(), set.end(), store.begin() + first);
        };
        const std::uint32_t number = shared.index.findOrAdd(hash, isEqual, [&] {
            shared.sets.emplace_back(static_cast<std::uint32_t>(store.size()), set.size());
            store.insert(store.end(), set.begin(), set.end());
            return static_cast<std::uint32_t>(shared.sets.size() - 1);
        });
        return shared.sets[number].first;
    }

    BrickVolume& volume_;
    std::int32_t tilesX_;
    std::vector<Numbers> numbers_;  // by tile
    std::size_t mixedCount_ = 0, codedCount_ = 0;
    BrickClusters clusters_;
    std::vector<std::uint64_t> codedOf_;  // by mixed cluster: its coded bricks
    std::vector<SameLabelBox> codeBoxes_;
    std::vector<Scalar> scalars_;
    std::unordered_map<Scalar, std::uint32_t> scalarNumbers_;
    HashIndex brickIndex_, planeIndex_;
    SharedSets palettes_, bitPlaneSets_;
};

namespace {

// The planes with faces in or next to each tile, in their given order.
class PlanesByTile {
public:
    PlanesByTile(std::span<const FacePlane> planes, const ColumnVolume& columns) : tilesX_(columns.tilesX()) {
        // Limit on the total work, so that a malicious file does not take forever. Real files stay far below.
        constexpr std::int64_t kMaxTests = std::int64_t{1} << 27;
        constexpr std::size_t kMaxPlanes = 256;
        std::int64_t tests = 0;
        planes_.resize(columns.tiles().size());
        for (const FacePlane& plane : planes) {
            const Vec3i low = tileAt(plane.min, columns, -1), high = tileAt(plane.max, columns, 1);
            tests += std::int64_t{1} * (high.x - low.x + 1) * (high.y - low.y + 1);
            if (tests > kMaxTests) return;
            for (std::int32_t y = low.y; y <= high.y; ++y)
                for (std::int32_t x = low.x; x <= high.x; ++x) {
                    std::vector<FacePlane>& ofTile = planes_[static_cast<std::size_t>(x + tilesX_ * y)];
                    if (ofTile.size() < kMaxPlanes && isIn(plane, x, y, columns.dimension().z)) ofTile.push_back(plane);
                }
        }
    }
    [[nodiscard]] std::span<const FacePlane> of(std::size_t tile) const noexcept { return planes_[tile]; }

private:
    static constexpr std::int32_t kTile = ColumnVolume::kTileSize;

    static Vec3i tileAt(const std::array<std::uint16_t, 3>& corner, const ColumnVolume& columns, std::int32_t beside) {
        const Vec3i n = columns.dimension();
        return {std::clamp(corner[0] + beside, 0, n.x - 1) / kTile, std::clamp(corner[1] + beside, 0, n.y - 1) / kTile,
                0};
    }
    static bool isIn(const FacePlane& face, std::int32_t x, std::int32_t y, std::int32_t depth) noexcept {
        const Vec3d n = face.plane.normal;
        const double half = kTile / 2.0, middle = dot(n, Vec3d{(x + 0.5) * kTile, (y + 0.5) * kTile, depth / 2.0});
        const double reach = std::abs(n.x) * half + std::abs(n.y) * half + std::abs(n.z) * (depth / 2.0 + 8);
        return std::abs(middle + face.plane.offset) <= reach + 8;
    }

    std::int32_t tilesX_;
    std::vector<std::vector<FacePlane>> planes_;
};

}  // namespace

Result<BrickVolume> BrickVolume::fromColumns(const ColumnVolume& columns, const Options& options) {
    BrickVolume volume;
    const Vec3i dimension = columns.dimension();
    std::uint64_t bricks = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (dimension[axis] > 65535)
            return Error(Code::GridTooLarge,
                         fmt::format("a dimension of {} is over the limit of 65535 for bricks", dimension[axis]));
        volume.brickCount_[axis] = (dimension[axis] + kBrickSize - 1) / kBrickSize;
        volume.clusterCount_[axis] = (volume.brickCount_[axis] + kClusterSize - 1) / kClusterSize;
        bricks *= static_cast<std::uint64_t>(volume.brickCount_[axis]);
    }
    if (bricks > kMaxBricks)
        return Error(Code::GridTooLarge,
                     fmt::format("{} bricks are over the limit of {}; choose a coarser spacing or a "
                                 "coarser level of detail",
                                 bricks, kMaxBricks));
    volume.dimension_ = dimension;
    if (bricks == 0) return volume;
    const std::span<const ColumnTile> tiles = columns.tiles();
    std::vector<TileBricks> tileBricks(tiles.size());
    const auto tilesX = static_cast<std::size_t>(columns.tilesX());
    BrickMerger merger(volume, columns.tilesX(), tiles.size());
    const PlanesByTile planes(options.planes, columns);
    ProgressCounter progress(options.progress, "prepare", tiles.size());
    parallelFor(tiles.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const auto x = static_cast<std::int32_t>(n % tilesX), y = static_cast<std::int32_t>(n / tilesX);
            const std::int32_t width = columns.tileWidth(x), height = columns.tileHeight(y);
            tileBricks[n] = TileBricker(tiles[n], width, height, volume.brickCount_.z).make();
            TileCoding coding(tileBricks[n], {x * ColumnVolume::kTileSize, y * ColumnVolume::kTileSize, 0},
                              {(width + 7) / 8, (height + 7) / 8, volume.brickCount_.z});
            coding.run(options.faces, planes.of(n), columns);
            progress.add();
        }
    });
    std::uint64_t words = 0;
    for (const TileBricks& tile : tileBricks) {
        for (const BrickPattern& pattern : tile.patterns)
            words += std::max(pattern.palette.size(), pattern.bitPlanes.size());
        for (const BoxCode& code : tile.boxes.codes) words += code.sideScalars.size();
    }
    if (words > 0xFFFFFFFFu)
        return Error(Code::GridTooLarge, fmt::format("the mixed bricks hold {} words, over the limit of {}; choose a "
                                                     "coarser spacing or a coarser level of detail",
                                                     words, 0xFFFFFFFFu));
    for (std::size_t n = 0; n < tileBricks.size(); ++n) merger.addTile(n, tileBricks[n]);
    merger.beginClusters();
    parallelFor(tiles.size(), 4, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) merger.takeTile(n, tileBricks[n]);
    });
    SVT_DO(merger.finish(options.threads));
    return volume;
}

std::vector<std::uint32_t> BrickVolume::flatIndex() const {
    const Arrays all = arrays();
    std::vector<std::uint32_t> entries;
    entries.reserve(static_cast<std::size_t>(brickCount_.x) * static_cast<std::size_t>(brickCount_.y) *
                    static_cast<std::size_t>(brickCount_.z));
    for (std::int32_t z = 0; z < brickCount_.z; ++z)
        for (std::int32_t y = 0; y < brickCount_.y; ++y)
            for (std::int32_t x = 0; x < brickCount_.x; ++x) entries.push_back(all.entry(x, y, z));
    return entries;
}

std::size_t BrickVolume::sizeBytes() const noexcept {
    return clusters_.size() * sizeof(std::uint32_t) + clusterWords_.size() * sizeof(std::uint32_t) +
           boxes_.size() * sizeof(SameLabelBox) + codes_.size() * sizeof(BoxCoding) +
           planes_.size() * sizeof(BrickPlane) + bricks_.size() * sizeof(PaletteBrick) +
           palettes_.size() * sizeof(Scalar) + bitPlanes_.size() * sizeof(std::uint64_t) +
           codedPatterns_.size() * sizeof(std::uint32_t);
}

}  // namespace svt::volume
