#include <svt/core/hash.hpp>
#include <svt/core/hash_index.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/brick_volume.hpp>
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
// Tag bits of index entries during construction. The other bits are a box of coded bricks, or a palette brick.
constexpr std::uint32_t kCodedBit = 0x40000000u, kVoxelsBit = 0x80000000u;
constexpr std::uint32_t kAnyMixed = kCodedBit | kVoxelsBit;
// Parallel loops over bricks take at least so many rows of bricks, or 64 times as many bricks, at once.
constexpr std::size_t kRowsAtOnce = 256, kBricksAtOnce = 64 * kRowsAtOnce;
constexpr std::int32_t kBricksPerTile = ColumnVolume::kTileSize / BrickVolume::kBrickSize;

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
    std::vector<std::uint32_t> codedPatterns;  // per coded brick, in order of places: its pattern

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

// Codes the bricks of a tile: first each pattern by cuts alone, then single bricks by planes.
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

    // Fills boxes, planes and codedPatterns of the tile. Returns the entries by place: index of the scalar, or
    // kCodedBit and the box, or kVoxelsBit and the pattern.
    std::vector<std::uint32_t> run(BrickFaces faces, std::span<const FacePlane> planes, const ColumnVolume& columns) {
        codeIndex_.assign(places_.patternOf.size(), TileBoxes::kNone);
        if (faces == BrickFaces::Planes || (faces == BrickFaces::Slopes && !tile_.patterns.empty()))
            codeBricks(planes, faces == BrickFaces::Planes ? &columns : nullptr);
        std::vector<std::uint32_t> index;
        index.reserve(codeIndex_.size());
        std::size_t place = 0;
        for (std::int32_t z = 0; z < places_.count.z; ++z)
            for (std::int32_t y = 0; y < places_.count.y; ++y)
                for (std::int32_t x = 0; x < places_.count.x; ++x, ++place) {
                    const std::uint32_t pattern = places_.patternOf[place];
                    if (codeIndex_[place] != TileBoxes::kNone) {
                        index.push_back(tile_.boxes.boxOf[place] | kCodedBit);
                        tile_.codedPatterns.push_back(
                            pattern != TilePlaces::kUniform ? pattern : uniformPattern(places_.scalarOf[place]));
                    } else {
                        index.push_back(pattern != TilePlaces::kUniform ? pattern | kVoxelsBit
                                                                        : tile_.entryAt(x, y, z, places_.count.z));
                    }
                }
        tile_.entries = {};
        return index;
    }

private:
    // Borders parallel to an axis go onto faces where `columns` is given.
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

// A box of bricks that are all uniform with one scalar.
struct BrickBox {
    Vec3i min, max;
    std::uint32_t entry = 0;  // the index entry that all its bricks have
};

// Covers the uniform bricks with boxes, greedily: each box is grown from the first brick without a box, along x, then
// y, then z, over all bricks of its scalar, including those of other boxes. So boxes may overlap, and a ray goes far in
// each. A budget of tests bounds the cost; when it is spent, boxes grow only over bricks without a box.
class BoxFinder {
public:
    BoxFinder(const std::vector<std::uint32_t>& index, Vec3i count, int threads) : index_(index), count_(count) {
        findRuns(threads);
        boxOf_.assign(index_.size(), kNone);
        budget_ = 12 * static_cast<std::int64_t>(index_.size());
        std::size_t brick = 0;
        for (std::int32_t z = 0; z < count_.z; ++z)
            for (std::int32_t y = 0; y < count_.y; ++y)
                for (std::int32_t x = 0; x < count_.x; ++x, ++brick)
                    if ((index_[brick] & kAnyMixed) == 0 && boxOf_[brick] == kNone) addBoxAt({x, y, z});
    }

    [[nodiscard]] const std::vector<BrickBox>& boxes() const noexcept { return boxes_; }
    /// By brick; kNone for mixed ones.
    [[nodiscard]] const std::vector<std::uint32_t>& boxOf() const noexcept { return boxOf_; }

    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

private:
    [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(count_.x) *
                   (static_cast<std::size_t>(y) + static_cast<std::size_t>(count_.y) * static_cast<std::size_t>(z));
    }

    // For each brick: the end along x of its run of equal entries.
    void findRuns(int threads) {
        runEnd_.resize(index_.size());
        const auto width = static_cast<std::size_t>(count_.x);
        parallelFor(index_.size() / width, kRowsAtOnce, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin * width; row < end * width; row += width)
                for (std::int32_t x = count_.x - 1, stop = count_.x; x >= 0; --x) {
                    const std::size_t brick = row + static_cast<std::size_t>(x);
                    if (x + 1 < count_.x && index_[brick + 1] != index_[brick]) stop = x + 1;
                    runEnd_[brick] = static_cast<std::uint16_t>(stop);
                }
        });
    }

    // Can the bricks [box.min.x, box.max.x) of row (y, z) join the box?
    [[nodiscard]] bool mayJoin(const BrickBox& box, std::int32_t y, std::int32_t z) {
        const std::size_t first = at(box.min.x, y, z);
        --budget_;
        if (index_[first] != box.entry || runEnd_[first] < box.max.x) return false;
        if (budget_ > 0) return true;
        for (std::int32_t x = box.min.x; x < box.max.x; ++x)
            if (boxOf_[first + static_cast<std::size_t>(x - box.min.x)] != kNone) return false;
        return true;
    }
    [[nodiscard]] bool mayJoinLayer(const BrickBox& box, std::int32_t z) {
        for (std::int32_t y = box.min.y; y < box.max.y; ++y)
            if (!mayJoin(box, y, z)) return false;
        return true;
    }

    void addBoxAt(Vec3i seed) {
        const std::size_t brick = at(seed.x, seed.y, seed.z);
        BrickBox box{seed, {seed.x + 1, seed.y + 1, seed.z + 1}, index_[brick]};
        const auto isSame = [&](std::int32_t x) {
            const std::size_t other = at(x, seed.y, seed.z);
            return index_[other] == box.entry && (budget_ > 0 || boxOf_[other] == kNone);
        };
        while (box.max.x < count_.x && isSame(box.max.x)) ++box.max.x;
        while (box.min.x > 0 && isSame(box.min.x - 1)) --box.min.x;
        while (box.max.y < count_.y && mayJoin(box, box.max.y, seed.z)) ++box.max.y;
        while (box.min.y > 0 && mayJoin(box, box.min.y - 1, seed.z)) --box.min.y;
        while (box.max.z < count_.z && mayJoinLayer(box, box.max.z)) ++box.max.z;
        while (box.min.z > 0 && mayJoinLayer(box, box.min.z - 1)) --box.min.z;
        const auto number = static_cast<std::uint32_t>(boxes_.size());
        // All bricks before the seed have a box already.
        for (std::int32_t z = seed.z; z < box.max.z; ++z)
            for (std::int32_t y = z == seed.z ? seed.y : box.min.y; y < box.max.y; ++y) {
                std::uint32_t* row = boxOf_.data() + at(0, y, z);
                // Boxes come in ascending order, and kNone is above them all: the least is the first.
                for (std::int32_t x = box.min.x; x < box.max.x; ++x) row[x] = std::min(row[x], number);
                budget_ -= (box.max.x - box.min.x) / 8;
            }
        boxes_.push_back(box);
    }

    const std::vector<std::uint32_t>& index_;
    Vec3i count_;
    std::int64_t budget_ = 0;
    std::vector<std::uint16_t> runEnd_;
    std::vector<std::uint32_t> boxOf_;
    std::vector<BrickBox> boxes_;
};

}  // namespace

// Merges the bricks of all tiles, in tile order, into one volume.
class BrickMerger {
public:
    BrickMerger(BrickVolume& volume, std::int32_t tilesX) : volume_(volume), tilesX_(tilesX) {}

    // Allocates the index; placeTile() and numberTile() fill it.
    void begin(std::size_t tiles) {
        const Vec3i count = volume_.brickCount_;
        volume_.wide_.resize(volume_.brickIndex(0, 0, count.z));
        numbers_.resize(tiles);
    }
    // Writes the entries of a tile, still with the numbers of the tile. Thread-safe for different tiles.
    void placeTile(std::size_t tile, const std::vector<std::uint32_t>& index) {
        std::size_t place = 0;
        forEachPlace(tile, [&](std::size_t brick) { volume_.wide_[brick] = index[place++]; });
    }

    // Adds scalars, patterns, planes, codes and boxes of a tile to the volume, and records their numbers there.
    void addTile(std::size_t number, TileBricks& tile) {
        Numbers& numbers = numbers_[number];
        for (const Scalar scalar : tile.scalars) numbers.scalars.push_back(scalarNumber(scalar));
        for (const BrickPattern& pattern : tile.patterns) numbers.patterns.push_back(brickNumber(pattern));
        numbers.firstBox = static_cast<std::uint32_t>(codeBoxes_.size());
        const auto firstCode = static_cast<std::uint32_t>(volume_.codes_.size());
        std::vector<std::uint32_t> planes;
        for (const BrickPlane& plane : tile.planes) planes.push_back(planeNumber(plane));
        for (const BoxCode& code : tile.boxes.codes) addCode(code, planes);
        const Vec3i first = firstBrick(number);
        for (const CodeBox& found : tile.boxes.boxes)
            codeBoxes_.push_back(boxOf(first + found.min, first + found.max, firstCode + found.code));
        numbers.codedPatterns = std::move(tile.codedPatterns);
        tile = {};
    }

    // Replaces the numbers of the tile by those of the volume. Thread-safe for different tiles.
    void numberTile(std::size_t tile) {
        const Numbers& numbers = numbers_[tile];
        forEachPlace(tile, [&](std::size_t brick) {
            std::uint32_t& entry = volume_.wide_[brick];
            if ((entry & kCodedBit) != 0)
                entry += numbers.firstBox;
            else if ((entry & kVoxelsBit) != 0)
                entry = numbers.patterns[entry & ~kVoxelsBit] | kVoxelsBit;
            else
                entry = numbers.scalars[entry];
        });
    }

    void takeBoxes(const BoxFinder& finder, int threads) {
        for (const BrickBox& found : finder.boxes())
            volume_.boxes_.push_back(boxOf(found.min, found.max, scalars_[found.entry]));
        volume_.uniformBoxes_ = volume_.boxes_.size();
        volume_.boxes_.insert(volume_.boxes_.end(), codeBoxes_.begin(), codeBoxes_.end());
        parallelFor(volume_.wide_.size(), kBricksAtOnce, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t brick = begin; brick < end; ++brick) {
                std::uint32_t& entry = volume_.wide_[brick];
                if ((entry & kAnyMixed) == 0) entry = finder.boxOf()[brick];
            }
        });
    }

    // Converts the index from tagged entries to its final form, with 16 bits if they suffice.
    void finishIndex(int threads) {
        const auto uniform = static_cast<std::uint32_t>(volume_.uniformBoxes_);
        const auto boxes = static_cast<std::uint32_t>(volume_.boxes_.size());
        const auto finished = [&](std::uint32_t entry) {
            if ((entry & kCodedBit) != 0) return (entry & ~kCodedBit) + uniform;
            if ((entry & kVoxelsBit) != 0) return (entry & ~kVoxelsBit) + boxes;
            return entry;
        };
        const std::size_t count = volume_.wide_.size();
        if (boxes + volume_.bricks_.size() <= 65536) {
            volume_.narrow_.resize(count + 4);
            parallelFor(count, kBricksAtOnce, threads, [&](std::size_t begin, std::size_t end) {
                for (std::size_t brick = begin; brick < end; ++brick)
                    volume_.narrow_[brick] = static_cast<std::uint16_t>(finished(volume_.wide_[brick]));
            });
            volume_.wide_ = {};
        } else {
            parallelFor(count, kBricksAtOnce, threads, [&](std::size_t begin, std::size_t end) {
                for (std::size_t brick = begin; brick < end; ++brick)
                    volume_.wide_[brick] = finished(volume_.wide_[brick]);
            });
            volume_.wide_.insert(volume_.wide_.end(), 2, 0);
        }
        volume_.palettes_.insert(volume_.palettes_.end(), 7, 0);
    }

    // Makes the bit vector of coded bricks and the table of their palette bricks, by rank.
    void rankCoded(int threads) {
        const std::size_t count = volume_.wide_.size(), words = count / 64 + 1;
        volume_.codedBricks_.resize(words);
        volume_.codedBefore_.resize(words);
        parallelFor(words, kRowsAtOnce, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t word = begin; word < end; ++word) {
                std::uint64_t coded = 0;
                for (std::size_t brick = 64 * word; brick < std::min(64 * word + 64, count); ++brick)
                    coded |= std::uint64_t{(volume_.wide_[brick] & kCodedBit) != 0} << (brick % 64);
                volume_.codedBricks_[word] = coded;
            }
        });
        std::uint32_t before = 0;
        for (std::size_t word = 0; word < words; ++word) {
            volume_.codedBefore_[word] = before;
            before += static_cast<std::uint32_t>(std::popcount(volume_.codedBricks_[word]));
        }
        volume_.codedPatterns_.resize(before);
        parallelFor(numbers_.size(), 4, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t tile = begin; tile < end; ++tile) {
                const Numbers& numbers = numbers_[tile];
                std::size_t next = 0;
                forEachPlace(tile, [&](std::size_t brick) {
                    if ((volume_.wide_[brick] & kCodedBit) != 0)
                        volume_.codedPatterns_[volume_.rankOf(brick)] = numbers.patterns[numbers.codedPatterns[next++]];
                });
            }
        });
    }

private:
    // Per number of the tile, the number of the volume.
    struct Numbers {
        std::vector<std::uint32_t> scalars, patterns, codedPatterns;
        std::uint32_t firstBox = 0;
    };

    [[nodiscard]] Vec3i firstBrick(std::size_t tile) const noexcept {
        return {static_cast<std::int32_t>(tile) % tilesX_ * kBricksPerTile,
                static_cast<std::int32_t>(tile) / tilesX_ * kBricksPerTile, 0};
    }
    template <class Body>
    void forEachPlace(std::size_t tile, const Body& body) const {
        const Vec3i first = firstBrick(tile), count = volume_.brickCount_;
        const std::int32_t endX = std::min(first.x + kBricksPerTile, count.x),
                           endY = std::min(first.y + kBricksPerTile, count.y);
        for (std::int32_t z = 0; z < count.z; ++z)
            for (std::int32_t y = first.y; y < endY; ++y) {
                std::size_t brick = volume_.brickIndex(first.x, y, z);
                for (std::int32_t x = first.x; x < endX; ++x) body(brick++);
            }
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
    BrickMerger merger(volume, columns.tilesX());
    merger.begin(tiles.size());
    const PlanesByTile planes(options.planes, columns);
    ProgressCounter progress(options.progress, "prepare", tiles.size());
    parallelFor(tiles.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const auto x = static_cast<std::int32_t>(n % tilesX), y = static_cast<std::int32_t>(n / tilesX);
            const std::int32_t width = columns.tileWidth(x), height = columns.tileHeight(y);
            tileBricks[n] = TileBricker(tiles[n], width, height, volume.brickCount_.z).make();
            TileCoding coding(tileBricks[n], {x * ColumnVolume::kTileSize, y * ColumnVolume::kTileSize, 0},
                              {(width + 7) / 8, (height + 7) / 8, volume.brickCount_.z});
            merger.placeTile(n, coding.run(options.faces, planes.of(n), columns));
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
    parallelFor(tiles.size(), 4, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) merger.numberTile(n);
    });
    merger.takeBoxes(BoxFinder(volume.wide_, volume.brickCount_, options.threads), options.threads);
    merger.rankCoded(options.threads);
    merger.finishIndex(options.threads);
    return volume;
}

std::size_t BrickVolume::sizeBytes() const noexcept {
    return narrow_.size() * sizeof(std::uint16_t) + wide_.size() * sizeof(std::uint32_t) +
           boxes_.size() * sizeof(SameLabelBox) + codes_.size() * sizeof(BoxCoding) +
           planes_.size() * sizeof(BrickPlane) + bricks_.size() * sizeof(PaletteBrick) +
           palettes_.size() * sizeof(Scalar) + bitPlanes_.size() * sizeof(std::uint64_t) +
           codedBricks_.size() * sizeof(std::uint64_t) + codedBefore_.size() * sizeof(std::uint32_t) +
           codedPatterns_.size() * sizeof(std::uint32_t);
}

}  // namespace svt::volume
